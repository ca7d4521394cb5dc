//! `loft { at 0 mm { ... } at 1000 mm { ... } }`: ruled straight between profiles.

use super::Drawn;
use crate::sema::eval::Scope;
use crate::sema::field_ranges::COORDINATE;
use crate::sema::fields::{Place, head_span};
use crate::sema::part::Part;
use crate::sema::profile;
use crate::sema::quantity::mm;
use crate::sema::read::Reader;
use crate::sema::report::Checked;
use crate::sema::session::Session;
use vcutc_backend_api::ir::Stock;
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::source::{Span, Spanned};
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_geometry::profile::Profile;
use vcutc_surface::loft::{LoftError, loft};
use vcutc_syntax::ast::{Block, Entry, Expr};

/// A profile of a loft as it is written.
struct Station<'a> {
    /// From its word to where it stands.
    head: Span,
    at: &'a Spanned<Expr>,
    entries: &'a [Entry],
    whole: Span,
}

pub(super) fn drawn(
    block: &Block,
    stock: Spanned<Stock>,
    scope: Scope<'_>,
    session: &mut Session<'_>,
) -> Checked<Drawn> {
    let head = head_span(block);
    let depth = stock.node.depth;
    let typical = mm(depth.to_mm());
    let stations = sort(block, depth, session)?;
    let read: Vec<Checked<(Length, Profile)>> = stations
        .iter()
        .map(|station| {
            let mut reader = Reader::new(scope, &mut session.reports);
            let at = reader.within(station.at, COORDINATE, "`at`", Some(&typical));
            let place = Place {
                head: station.head,
                whole: station.whole,
            };
            let profile = profile::whole(station.entries, place, stock, scope, session);
            Ok((Length::mm(at?), profile?))
        })
        .collect();
    let read: Vec<(Length, Profile)> = read.into_iter().collect::<Checked<_>>()?;
    let profiles: Vec<(Length, &Profile)> = read.iter().map(|(at, profile)| (*at, profile)).collect();
    let fault = match loft(&profiles, Part::SURFACE_TOLERANCE) {
        Ok(mesh) => match super::made(&mesh, stock.node) {
            Ok(surface) => {
                let profile = same(&profiles).cloned();
                return Ok(Drawn {
                    surface,
                    profile,
                    exact: None,
                });
            }
            Err(error) => super::not_made(error, head),
        },
        Err(LoftError::NotAscending { index }) => {
            let at = |index: usize| profiles.get(index).map_or(0.0, |(at, _)| at.to_mm());
            let span = |index: usize| stations.get(index).map_or(head, |station| station.head);
            Diagnostic::new(
                Code::ImpossibleSurface,
                "the profiles of a loft do not follow each other along y",
                span(index),
                format!("stands at y = {}", mm(at(index))),
            )
            .and(
                span(index.saturating_sub(1)),
                format!("the one before stands at y = {}", mm(at(index.saturating_sub(1)))),
            )
            .help("write them in the order of y, each once")
        }
        Err(LoftError::TooFew) => too_few(head, depth),
        Err(LoftError::Tolerance) => {
            return Err(super::impossible(
                "the loft is too twisted to follow within 10 um",
                head,
                "20 million triangles are not enough for it",
                &mut session.reports,
            ));
        }
    };
    Err(session.reports.push(fault))
}

/// The profile at every y, if all are one.
fn same<'p>(profiles: &[(Length, &'p Profile)]) -> Option<&'p Profile> {
    let (_, first) = profiles.first()?;
    profiles
        .iter()
        .all(|(_, profile)| profile == first)
        .then_some(*first)
}

fn sort<'a>(block: &'a Block, depth: Length, session: &mut Session<'_>) -> Checked<Vec<Station<'a>>> {
    let mut stations = Vec::new();
    let mut fault = None;
    for entry in &block.entries {
        let span = match entry {
            Entry::Station {
                word,
                at,
                entries,
                span,
            } => {
                stations.push(Station {
                    head: word.to(at.span),
                    at,
                    entries,
                    whole: *span,
                });
                continue;
            }
            Entry::Field { span, .. }
            | Entry::Limit { span, .. }
            | Entry::Formula { span, .. }
            | Entry::Curve { span, .. }
            | Entry::Row { span, .. }
            | Entry::ControlRow { span, .. }
            | Entry::SurfaceFile { span, .. } => *span,
            Entry::Block(inner) => head_span(inner),
        };
        let diagnostic = Diagnostic::new(
            Code::Misplaced,
            "this does not belong in `loft`",
            span,
            "a loft contains profiles and nothing else",
        );
        fault = Some(session.reports.push(diagnostic.help(format!(
            "put the pieces of a profile into `at y {{ ... }}`, for example `at {} {{ start (0 mm, 20 mm) ... }}`",
            mm(depth.to_mm())
        ))));
    }
    match fault.or_else(|| session.damage_at(block.span)) {
        Some(reported) => Err(reported),
        None if stations.len() < 2 => Err(session.reports.push(too_few(head_span(block), depth))),
        None => Ok(stations),
    }
}

fn too_few(head: Span, depth: Length) -> Diagnostic {
    Diagnostic::new(
        Code::MissingField,
        "a loft needs two profiles or more",
        head,
        "too few profiles",
    )
    .help(format!(
        "write one for each end of the stock: `loft {{ at 0 mm {{ ... }} at {} {{ ... }} }}`",
        mm(depth.to_mm())
    ))
}
