//! Chips of given tips that do not come free: reported at the tip, with a longer edge that was tried.

use super::attempts::Attempts;
use super::usable_edge::UsableEdge;
use crate::asked::{RoughVcut, Tips};
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::number::show;
use vcutc_diagnostics::source::Span;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_geometry::grid;
use vcutc_job::Auto;
use vcutc_process::verdict::words::place;
use vcutc_simulation::prove::Finding;

/// What to change so that all chips come free.
enum Remedy {
    /// A longer edge, all else as it is.
    Edge(Length),
    /// A longer edge, and the extension that goes with it.
    EdgeAndExtension(Length, Length),
}

/// A flank of a given tip that needs more edge than there is.
pub(super) fn not_freed(
    attempts: &mut Attempts<'_>,
    (asked, tips): (&RoughVcut, &Tips),
    finding: Finding,
    count: usize,
    [needed, available]: [Length; 2],
) -> Diagnostic {
    let edge = UsableEdge::of(asked, available);
    let headline = format!(
        "{} needs {} mm of edge, {}",
        place(&finding),
        up(needed),
        edge.has
    );
    let label = "this tip lies deeper than the blade can cut free";
    let span = tip_span(tips, finding).unwrap_or(tips.span);
    let mut diagnostic =
        Diagnostic::new(Code::ChipNotFreed, headline, span, label).and(edge.span, edge.label);
    match count {
        0 | 1 => {}
        2 => diagnostic = diagnostic.note(format!("one more cut needs more edge than {}", edge.than)),
        _ => {
            let others = count - 1;
            diagnostic = diagnostic.note(format!("{others} more cuts need more edge than {}", edge.than));
        }
    }
    match remedy(attempts, needed) {
        Some(Remedy::Edge(length)) => diagnostic.help(format!(
            "use a blade with a `cutting_length` of at least {} mm, or go down in smaller layers",
            up(length)
        )),
        Some(Remedy::EdgeAndExtension(length, extension)) => diagnostic.help(format!(
            "use a blade with a `cutting_length` of at least {} mm and an `extension` of {} mm, or go down in smaller layers",
            up(length),
            up(extension)
        )),
        None => diagnostic.help("go down in smaller layers"),
    }
}

/// To a micrometre, upwards: 10.0003 mm is not 10 mm.
fn up(length: Length) -> String {
    show(grid::up(length.to_mm()))
}

/// Where the tip of a finding is written.
fn tip_span(tips: &Tips, finding: Finding) -> Option<Span> {
    let is_it = |written: f64, found: f64| (grid::nearest(written) - found).abs() < grid::SPACING / 2.0;
    let all = tips.tips.iter();
    let mut found = all.filter(|tip| is_it(tip.point.x, finding.tip.x) && is_it(tip.point.z, finding.tip.z));
    found.next().map(|tip| tip.span)
}

/// The worst flank decides what edge all of them need.
fn remedy(attempts: &mut Attempts<'_>, needed: Length) -> Option<Remedy> {
    let longer = Length::mm(grid::up(needed.to_mm()));
    let lengthen = |asked: &mut RoughVcut| {
        asked.blade.cutting_length.value = longer;
        if let Some(limit) = &mut asked.limits.edge {
            limit.value = limit.value.max(longer);
        }
    };
    if attempts.planned(lengthen).is_some() {
        return Some(Remedy::Edge(longer));
    }
    let extend = |asked: &mut RoughVcut| {
        lengthen(asked);
        if let Some(extension) = &mut asked.setup.extension {
            extension.value = Auto::Auto;
        }
    };
    let vcut = attempts.planned(extend)?;
    Some(Remedy::EdgeAndExtension(longer, vcut.parameters.extension))
}
