//! `z(x, y) = ...`: a surface by formula.

use super::Drawn;
use super::enclosure::{Around, Compiled};
use crate::sema::dimension::Dimension;
use crate::sema::eval::{Scope, walk};
use crate::sema::part::{Part, Sampling, Strip};
use crate::sema::quantity::{Quantity, mm, to_um};
use crate::sema::report::{Checked, Reported, Reports};
use vcutc_backend_api::ir::Stock;
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::source::{Span, Spanned};
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_geometry::profile::Profile;
use vcutc_surface::bend::Exact;
use vcutc_surface::formula::{FormulaError, formula, roughest};
use vcutc_surface::surface::Surface;
use vcutc_syntax::ast::Expr;

/// A formula as it is written.
pub(super) struct Written<'a> {
    pub(super) variables: [&'a Spanned<String>; 2],
    pub(super) value: &'a Spanned<Expr>,
    pub(super) span: Span,
}

impl Written<'_> {
    /// The height at a place, both in mm.
    fn height(&self, [x, y]: [f64; 2], scope: Scope<'_>, reports: &mut Reports) -> Checked<f64> {
        let [across, along] = self.variables.map(|name| name.node.as_str());
        let variables = [(across, Quantity::length(x)), (along, Quantity::length(y))];
        let scope = Scope {
            variables: &variables,
            ..scope
        };
        scope.expect(self.value, Dimension::LENGTH, "`z`", Some("10 mm"), reports)
    }

    fn place(&self, [x, y]: [f64; 2]) -> String {
        let [across, along] = self.variables;
        let [x, y] = [x, y].map(|part| mm(to_um(part)));
        format!("{} = {x}, {} = {y}", across.node, along.node)
    }

    /// Says why there is no height at a place, both in mm.
    fn without_value(&self, place: [f64; 2], scope: Scope<'_>, reports: &mut Reports) -> Reported {
        // The reason is the same wherever the formula fails first.
        let mut why = Reports::default();
        let outcome = self.height(place, scope, &mut why);
        let diagnostic = match (outcome, why.into_vec().into_iter().next()) {
            // A value that is missing at one place may exist at others; names and dimensions are the same everywhere.
            (Err(_), Some(reason)) if reason.code == Code::NotFinite => {
                reason.note(format!("this is so at {}", self.place(place)))
            }
            (Err(_), Some(reason)) => reason,
            _ => Diagnostic::new(
                Code::NotFinite,
                format!("the formula has no value near {}", self.place(place)),
                self.value.span,
                "this gives no height",
            )
            .help("check what is divided, and what roots, powers and arcs are taken of"),
        };
        reports.push(diagnostic)
    }
}

pub(super) fn drawn(
    written: &Written<'_>,
    stock: Spanned<Stock>,
    scope: Scope<'_>,
    reports: &mut Reports,
) -> Checked<Drawn> {
    let (surface, exact) = surface(written, stock, scope, reports)?;
    Ok(Drawn {
        surface,
        exact: Some(exact),
        profile: profile(written, stock.node.width, scope),
    })
}

/// The profile of a formula without its second variable, as `profile { z(x) = ... }` has it.
fn profile(written: &Written<'_>, width: Length, scope: Scope<'_>) -> Option<Profile> {
    let [across, along] = written.variables;
    let changes =
        walk(written.value).any(|part| matches!(&part.node, Expr::Name(name) if *name == along.node));
    if changes {
        return None;
    }
    let sampling = Sampling {
        variable: &across.node,
        value: written.value,
        scope,
    };
    let points = sampling.points(width.to_mm(), Part::TOLERANCE).ok()?;
    Strip::cut(&points, width.to_mm()).profile(width.to_mm()).ok()
}

fn surface(
    written: &Written<'_>,
    stock: Spanned<Stock>,
    scope: Scope<'_>,
    reports: &mut Reports,
) -> Checked<(Surface, Exact)> {
    // Names and dimensions are the same everywhere, so one place shows what is wrong with them.
    let middle = [stock.node.width.to_mm() / 2.0, stock.node.depth.to_mm() / 2.0];
    let mut found = Reports::default();
    if written.height(middle, scope, &mut found).is_err() {
        return Err(written.without_value(middle, scope, reports));
    }
    let compiled = Compiled::of(
        written.value,
        written.variables.map(|name| name.node.as_str()),
        scope,
    );
    let Some(compiled) = compiled else {
        return Err(written.without_value(middle, scope, reports));
    };
    let meter = compiled.metered();
    let mesh = formula(
        &|x, y| meter.value(x, y),
        super::plan_of(stock.node),
        Part::SURFACE_TOLERANCE,
    );
    let span = written.value.span;
    match mesh {
        Ok(mesh) => {
            let surface =
                super::made(&mesh, stock.node).map_err(|error| reports.push(super::not_made(error, span)))?;
            Ok((surface, Exact::new(move |place| compiled.curvature(place))))
        }
        Err(FormulaError::NoValue { x, y }) if !meter.is_used_up() => match compiled.around([x, y]) {
            Around::Unknown => Err(written.without_value([x, y], scope, reports)),
            around => Err(reports.push(broken(written, [x, y], around))),
        },
        Err(FormulaError::Jump { x, y }) => {
            Err(reports.push(broken(written, [x, y], compiled.around([x, y]))))
        }
        Err(_) => {
            let meter = compiled.metered();
            let place = roughest(
                &|x, y| meter.value(x, y),
                super::plan_of(stock.node),
                Part::SURFACE_TOLERANCE,
            );
            Err(reports.push(too_rough(written, place)))
        }
    }
}

/// What a formula does where it is not continuous, or not for all that is known.
fn broken(written: &Written<'_>, place: [f64; 2], around: Around) -> Diagnostic {
    let shown = written.place(place);
    let (headline, label, help) = match around {
        Around::Grows => (
            format!("the height of the formula grows without limit near {shown}"),
            "no surface reaches there",
            "change the formula so that it divides by nothing that becomes zero over the stock and takes no tangent of 90 deg, \
             or describe the part by a mesh",
        ),
        Around::Steps | Around::Unknown => (
            format!("the formula steps at {shown}"),
            "a surface by formula has no vertical steps",
            "replace the step by a slope, as gentle as the part allows, or describe the part by a mesh",
        ),
    };
    Diagnostic::new(Code::ImpossibleSurface, headline, written.value.span, label).help(help)
}

fn too_rough(written: &Written<'_>, place: Option<[f64; 2]>) -> Diagnostic {
    let label = match place {
        Some(place) => format!("it takes too many triangles, most near {}", written.place(place)),
        None => "it takes too many triangles".to_owned(),
    };
    Diagnostic::new(
        Code::ImpossibleSurface,
        "the formula is too rough to follow within 10 um",
        written.value.span,
        label,
    )
    .help(
        "make it coarser there, for example by a radius instead of an edge or by a gentler slope, or describe the part by a \
         mesh",
    )
}
