//! Why there is no plan, in the user's words, with a change that was tried.

use crate::asked::FinishDisc;
use crate::plan::{MOST_TRACKS, Refusal, Wish, Work, plan};
use vcutc_backend_api::units::{Angle, Length};
use vcutc_diagnostics::number::show;
use vcutc_diagnostics::source::Span;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_job::Auto;
use vcutc_process::verdict::strip_words;
use vcutc_simulation::disc::{Hold, PassFault};

/// A change with which there is a plan.
pub(crate) enum Offer {
    OverHub(Length),
    Lead(Angle),
}

/// More lead than that is not offered, in degrees: the disc then ploughs more than it slices.
const MOST_LEAD: u32 = 30;

/// Looks for the least change that gives a plan.
pub(crate) fn offer(work: Work<'_>, wish: &Wish, refusal: &Refusal) -> Option<Offer> {
    let Refusal::Fault { fault, .. } = refusal else {
        return None;
    };
    match fault {
        PassFault::OverBody { .. } => {
            // Strips grow thicker from track to track, so the thickest is known only at the end.
            let most = work.before.corners().map(|corner| corner.z).fold(0.0, f64::max);
            let heights = (1..=most.ceil() as u32).map(|height| Length::mm(f64::from(height)));
            let works = |&over_hub: &Length| {
                let wish = Wish {
                    over_hub,
                    ..wish.clone()
                };
                plan(work, &wish).is_ok()
            };
            heights
                .filter(|height| *height > wish.over_hub)
                .find(works)
                .map(Offer::OverHub)
        }
        PassFault::Attached { .. } => {
            let now = match wish.lead {
                Auto::Auto => wish.steepest,
                Auto::Given(lead) => lead,
            };
            let leads = (1..=MOST_LEAD).map(|lead| Angle::deg(f64::from(lead)));
            let works = |&lead: &Angle| {
                let wish = Wish {
                    lead: Auto::Given(lead),
                    ..wish.clone()
                };
                plan(work, &wish).is_ok()
            };
            leads.filter(|lead| *lead > now).find(works).map(Offer::Lead)
        }
        PassFault::Meets(_)
        | PassFault::EntersPart { .. }
        | PassFault::Body { .. }
        | PassFault::TooThick { .. }
        | PassFault::TooWide { .. } => None,
    }
}

/// A refusal as it is reported.
pub(crate) fn diagnostic(asked: &FinishDisc, refusal: &Refusal, offer: Option<Offer>) -> Diagnostic {
    let head = asked.setup.head_span;
    match refusal {
        Refusal::Nothing => Diagnostic::new(
            Code::NothingToCut,
            "nothing stands above the part that this operation could take off",
            head,
            "this operation",
        )
        .help("delete the operation, or leave more for it"),
        Refusal::TooMany { tracks } => Diagnostic::new(
            Code::TooManyCuts,
            format!("{tracks} tracks are too many to plan, at most {MOST_TRACKS} are"),
            asked.step.span.or(asked.limits.scallop.span).unwrap_or(head),
            "of tracks so close",
        )
        .help("use a larger `step`, or allow more scallop"),
        Refusal::Scallop { left } => Diagnostic::new(
            Code::ScallopOverLimit,
            format!(
                "finishing would leave {} mm on the part, the limit is {} mm",
                show((left.to_mm() * 1e4).round() / 1e4),
                show(asked.limits.scallop.value.to_mm())
            ),
            asked.limits.scallop.span.unwrap_or(head),
            "this limit",
        )
        .and(asked.step.span.unwrap_or(head), "tracks of this operation")
        .help("use a smaller `step` or `lead`, a smaller disc where the part is hollow, or a higher limit"),
        Refusal::Fault { lead, track, fault } => {
            let (what, label) = strip_words(*fault);
            let code = match fault {
                PassFault::Body { .. } => Code::BodyInWork,
                PassFault::EntersPart { .. } => Code::Overcut,
                PassFault::TooThick { .. } | PassFault::TooWide { .. } | PassFault::OverBody { .. } => {
                    Code::BladesTooSmall
                }
                PassFault::Attached { .. } | PassFault::Meets(_) => Code::ChipNotFreed,
            };
            let message = format!(
                "on the track at x {} mm, with a lead of {} deg, {what}",
                show((track.contact.x * 1e3).round() / 1e3),
                show(lead.to_deg())
            );
            let diagnostic = Diagnostic::new(code, message, place(asked, *fault), label);
            advised(diagnostic, asked, *fault, offer)
        }
    }
}

/// The value that a fault is about.
fn place(asked: &FinishDisc, fault: PassFault) -> Span {
    let field = match fault {
        PassFault::TooThick { .. } => asked.disc.depth.span,
        PassFault::TooWide { .. } => asked.disc.width.span,
        PassFault::OverBody { .. } => asked.over_hub.span,
        PassFault::Attached { .. } => asked.lead.span.or(asked.limits.lead.span),
        PassFault::Body { .. } | PassFault::EntersPart { .. } | PassFault::Meets(_) => None,
    };
    field.unwrap_or(asked.setup.head_span)
}

fn advised(diagnostic: Diagnostic, asked: &FinishDisc, fault: PassFault, offer: Option<Offer>) -> Diagnostic {
    let nearer = "let roughing end its grooves nearer to the part: with `residual = lift`, a smaller `allowance`, or a smaller `step`";
    match (fault, offer) {
        (_, Some(Offer::OverHub(height))) => diagnostic.help(format!(
            "use `over_hub = {} mm` if strips of that thickness run over the hub of `{}`",
            show(height.to_mm()),
            asked.disc.name
        )),
        (_, Some(Offer::Lead(lead))) => diagnostic.help(match asked.lead.value {
            Auto::Auto => format!("allow `lead <= {} deg`", show(lead.to_deg())),
            Auto::Given(_) => format!("use `lead = {} deg`", show(lead.to_deg())),
        }),
        (
            PassFault::Attached {
                hold: Hold::Buried { .. },
                ..
            },
            None,
        ) => diagnostic
            .note("a strip comes free where the rim comes out of the surface at both of its ends")
            .help(nearer),
        (PassFault::OverBody { .. } | PassFault::TooThick { .. } | PassFault::TooWide { .. }, None) => {
            diagnostic.help(nearer)
        }
        (
            PassFault::Attached { .. }
            | PassFault::Meets(_)
            | PassFault::EntersPart { .. }
            | PassFault::Body { .. },
            None,
        ) => diagnostic,
    }
}
