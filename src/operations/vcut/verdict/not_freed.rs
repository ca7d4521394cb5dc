//! The message for chips that do not come free.

use super::attempts::Attempts;
use super::chip_remedy::{self, Remedy};
use super::given_tips;
use super::usable_edge::UsableEdge;
use crate::plan::PlannedVcut;
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::number::show;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_job::operation::WorksThere;
use vcutc_process::verdict::words::place;
use vcutc_simulation::prove::Finding;

/// Chips that are not cut free: the one that needs the longest edge, and how many there are.
#[derive(Clone, Copy)]
pub(super) struct Chips {
    pub(super) finding: Finding,
    pub(super) count: usize,
    pub(super) needed: Length,
    pub(super) available: Length,
}

/// The message for chips that are not cut free, with the change that frees them.
pub(super) fn not_freed(
    attempts: &mut Attempts<'_>,
    vcut: &PlannedVcut,
    chips: Chips,
    works_there: &mut WorksThere<'_>,
) -> Diagnostic {
    let Chips {
        finding,
        count,
        needed,
        available,
    } = chips;
    let asked = &vcut.asked;
    if let Some(tips) = &asked.tips {
        return given_tips::not_freed(attempts, (asked, tips), finding, count, [needed, available]);
    }
    let edge = UsableEdge::of(asked, available);
    // Rounded up: 10.003 mm is not 10 mm.
    let needed = show((needed.to_mm() * 1000.0).ceil() / 1000.0);
    let layer = show(vcut.parameters.layer.to_mm());
    let remedy = chip_remedy::remedy(attempts, vcut, works_there);
    let (span, label) = match (&remedy, asked.step.span, asked.layer.span) {
        (Some(Remedy::Step(_) | Remedy::OpenStep), Some(span), _) => (
            span,
            format!("with this step, the blade cannot cut layers of {layer} mm free"),
        ),
        (_, _, Some(span)) => (
            span,
            format!("layers of {layer} mm are deeper than this blade can cut free"),
        ),
        (_, Some(span), None) => (
            span,
            format!("with this step, layers of {layer} mm are deeper than this blade can cut free"),
        ),
        (_, None, None) => (
            asked.setup.head_span,
            format!("with layers of {layer} mm this chip is not cut free"),
        ),
    };
    let (has, than) = (&edge.has, edge.than);
    let headline = format!("{} needs {needed} mm of edge, {has}", place(&finding));
    let mut diagnostic =
        Diagnostic::new(Code::ChipNotFreed, headline, span, label).and(edge.span, edge.label.clone());
    match count {
        0 | 1 => {}
        2 => diagnostic = diagnostic.note(format!("one more cut needs more edge than {than}")),
        _ => {
            let others = count - 1;
            diagnostic = diagnostic.note(format!("{others} more cuts need more edge than {than}"));
        }
    }
    match remedy {
        Some(Remedy::Step(step)) => {
            let value = format!("{} mm", show(step.to_mm()));
            let advice = format!("use a `step` of {value} with these layers");
            match asked.step.span {
                Some(span) => diagnostic.fix(advice, span, value),
                None => diagnostic.help(advice),
            }
        }
        Some(Remedy::OpenStep) => match asked.step.span {
            Some(span) => diagnostic.fix("let the compiler choose the step: `auto`", span, "auto"),
            None => diagnostic.help("leave the `step` `auto`"),
        },
        Some(Remedy::Layer(layer)) => {
            let value = chip_remedy::written(layer);
            let advice = format!("use a `layer` of {value}");
            match asked.layer.span {
                Some(span) => diagnostic.fix(advice, span, value),
                None => diagnostic.help(advice),
            }
        }
        Some(Remedy::ResidualMixed) => {
            let diagnostic = diagnostic.note(
                "cuts dropped, raised or moved to clear the part left more material than the lattice assumes",
            );
            match asked.residual.span {
                Some(span) => diagnostic.fix(
                    "let the compiler fix such cuts: `residual = mixed`",
                    span,
                    "mixed",
                ),
                None => diagnostic.help("add `residual = mixed`, which fixes such cuts"),
            }
        }
        Some(Remedy::Opened(offer)) => diagnostic.fix_all(offer.title, &offer.edits),
        None => diagnostic.help("use a longer blade, a smaller `swing` or a smaller `step`"),
    }
}
