//! What a proof found wrong with V-cuts, in the user's words, and which change fixes it.

mod attempts;
mod chips;
mod given;
mod scallop;
mod stays;

pub(crate) use scallop::helped;
pub(crate) use stays::much_stays;

use crate::asked::RoughVcut;
use crate::plan::PlannedVcut;
use attempts::Attempts;
use chips::Remedy;
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::number::show;
use vcutc_diagnostics::source::Span;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_geometry::curve::Point2;
use vcutc_job::operation::{Trials, WorksThere};
use vcutc_process::verdict::{overcut, place, point};
use vcutc_simulation::prove::{CutFault, Finding};

/// Explains a cut whose chip does not come free, or whose way is blocked.
pub(crate) fn explain(
    vcut: &PlannedVcut,
    finding: Finding,
    count: usize,
    trials: &mut dyn Trials,
    works_there: &mut WorksThere<'_>,
) -> Diagnostic {
    match finding.fault {
        CutFault::NotFreed { needed, available } => {
            let chips = Chips {
                finding,
                count,
                needed,
                available,
            };
            not_freed(&mut Attempts(trials), vcut, chips, works_there)
        }
        CutFault::Blocked { at } => blocked(&vcut.asked, finding, at),
        CutFault::Overcut { at, depth } => overcut(&vcut.asked, finding, at, depth),
    }
}

/// Tips that the job gives and that cut nothing.
pub(crate) fn idle_tips(vcut: &PlannedVcut) -> Option<Diagnostic> {
    crate::plan::given::idle(vcut.course.as_ref()?, vcut.asked.tips.as_ref()?)
}

fn blocked(asked: &RoughVcut, finding: Finding, at: Point2) -> Diagnostic {
    Diagnostic::new(
        Code::BladeBlocked,
        format!(
            "above {}, uncut material is in the way of the blade",
            place(&finding)
        ),
        asked.swing.span.unwrap_or(asked.setup.head_span),
        format!("the blade meets material at {}", point(at)),
    )
    .note("an operation before this one left walls steeper than this operation's flanks")
    .help("give both operations the same `swing`, or let this one come first")
}

/// Chips that are not cut free: the one that needs the longest edge, and how many there are.
#[derive(Clone, Copy)]
struct Chips {
    finding: Finding,
    count: usize,
    needed: Length,
    available: Length,
}

fn not_freed(
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
        return given::not_freed(attempts, (asked, tips), finding, count, [needed, available]);
    }
    let edge = UsableEdge::of(asked, available);
    // Rounded up: 10.003 mm is not 10 mm.
    let needed = show((needed.to_mm() * 1000.0).ceil() / 1000.0);
    let layer = show(vcut.parameters.layer.to_mm());
    let remedy = chips::remedy(attempts, vcut, works_there);
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
            let value = chips::written(layer);
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

/// What the edge of a cut is held against: the blade's, or the limit on it.
struct UsableEdge {
    span: Span,
    /// In a sentence: `the blade has 10 mm`.
    has: String,
    /// After `more edge than`.
    than: &'static str,
    label: String,
}

impl UsableEdge {
    fn of(asked: &RoughVcut, available: Length) -> Self {
        let (blade, length) = (&asked.setup.blade, show(available.to_mm()));
        match asked.limits.edge {
            Some(limit) if limit.value < blade.cutting_length.value => Self {
                span: limit.span.unwrap_or(asked.setup.head_span),
                has: format!("the limit is {length} mm"),
                than: "the limit allows",
                label: "the limit".to_owned(),
            },
            Some(_) | None => Self {
                span: blade.cutting_length.span.unwrap_or(blade.span),
                has: format!("the blade has {length} mm"),
                than: "the blade has",
                label: format!("{length} mm of edge"),
            },
        }
    }
}
