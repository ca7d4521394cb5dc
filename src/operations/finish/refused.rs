//! Why there is no plan, in the user's words, with a change that was tried: of this operation on the same stock, or of the roughing
//! before it in the whole job.

mod changes;
mod on_surface;

use crate::asked::FinishDisc;
use crate::on_surface::lay::Unlaid;
use crate::on_surface::plan::Refusal as SurfaceRefusal;
use crate::plan::{MOST_TRACKS, Refusal};
use changes::Change;
use vcutc_cancellation::{Effort, Wanted};
use vcutc_diagnostics::number::show;
use vcutc_diagnostics::source::Span;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_job::operation::{Ground, Operation, Unplanned, WorksThere};
use vcutc_process::verdict::words::strip_words;
use vcutc_simulation::disc::{Hold, PassFault};
use vcutc_simulation::surface::Surface;
use vcutc_surface::track::NoTrack;

/// A refusal with what it is about.
#[derive(Debug)]
pub(crate) struct Refused<'j> {
    pub(crate) asked: &'j FinishDisc,
    pub(crate) ground: Ground<'j>,
    pub(crate) why: Why,
}

/// Why there is no plan.
#[derive(Debug)]
pub(crate) enum Why {
    OnProfile(Refusal),
    OnSurface(SurfaceRefusal),
}

impl Why {
    /// What is wrong with a pass, if that is it.
    const fn fault(&self) -> Option<PassFault> {
        match self {
            Self::OnProfile(Refusal::Fault { fault, .. }) => Some(*fault),
            Self::OnSurface(SurfaceRefusal::Fault { fault, .. }) => Some(fault.fault),
            Self::OnProfile(Refusal::Nothing | Refusal::TooMany { .. } | Refusal::Scallop { .. })
            | Self::OnSurface(
                SurfaceRefusal::Allowance
                | SurfaceRefusal::NotLast
                | SurfaceRefusal::Nothing
                | SurfaceRefusal::TooMany { .. }
                | SurfaceRefusal::Scallop { .. }
                | SurfaceRefusal::Unlaid { .. },
            ) => None,
        }
    }

    /// Whether too much stays.
    const fn stays(&self) -> bool {
        matches!(
            self,
            Self::OnProfile(Refusal::Scallop { .. }) | Self::OnSurface(SurfaceRefusal::Scallop { .. })
        )
    }

    /// Whether no lead within the limits lets the disc down on the part.
    const fn is_of_leads(&self) -> bool {
        matches!(
            self,
            Self::OnSurface(SurfaceRefusal::Unlaid {
                why: Unlaid::NoTrack(NoTrack::Lead { .. }),
                ..
            })
        )
    }

    /// What it counts as, in cuts, to lay tracks and pass them through the stock.
    const fn trial(&self) -> usize {
        match self {
            Self::OnProfile(_) => 1_000,
            Self::OnSurface(_) => 5_000,
        }
    }
}

impl Unplanned for Refused<'_> {
    fn diagnostics(
        &self,
        wanted: &Wanted,
        effort: &mut Effort,
        works: &mut WorksThere<'_>,
    ) -> Vec<Diagnostic> {
        let found = self.changes().find(|change| {
            if wanted.is_needless() || effort.is_spent() {
                return false;
            }
            effort.spend(self.why.trial());
            self.does(change, wanted, works)
        });
        let diagnostic = self.diagnostic();
        let diagnostic = match found {
            Some(change) => diagnostic.fix_all(change.title, &change.edits),
            None => self.advised(diagnostic),
        };
        vec![diagnostic]
    }
}

impl Refused<'_> {
    /// Whether the job compiles with a change.
    fn does(&self, change: &Change, wanted: &Wanted, works: &mut WorksThere<'_>) -> bool {
        let asked = change.here.as_ref().unwrap_or(self.asked);
        let ground = Ground {
            wanted: wanted.clone(),
            ..self.ground.clone()
        };
        let plans = match &change.before {
            None => asked.plan(ground).is_ok(),
            Some(roughing) => {
                let after = self.after(&**roughing, ground);
                after.is_some_and(|ground| asked.plan(ground).is_ok())
            }
        };
        plans && works(&change.edits)
    }

    /// The work with another operation in place of the one before this one; none where that has no plan.
    fn after<'j>(&'j self, roughing: &dyn Operation, ground: Ground<'j>) -> Option<Ground<'j>> {
        let own = self.asked.setup.head_span;
        let operations = self.ground.job.operations.iter();
        let mut earlier: Vec<&dyn Operation> = operations
            .take_while(|operation| operation.setup().head_span != own)
            .map(|operation| &**operation)
            .collect();
        earlier.pop();
        let mut ground = Ground {
            before: Surface::untouched(self.ground.job.stock),
            ..ground
        };
        for operation in earlier.into_iter().chain([roughing]) {
            ground.before = operation.plan(ground.clone()).ok()?.after;
        }
        Some(ground)
    }

    fn diagnostic(&self) -> Diagnostic {
        let asked = self.asked;
        let head = asked.setup.head_span;
        let refusal = match &self.why {
            Why::OnProfile(refusal) => refusal,
            Why::OnSurface(refusal) => return self.diagnose_on_surface(refusal),
        };
        match refusal {
            Refusal::Nothing => nothing(head),
            Refusal::TooMany { tracks } => Diagnostic::new(
                Code::TooManyCuts,
                format!("{tracks} tracks are too many to plan, at most {MOST_TRACKS} are"),
                asked.step.span.or(asked.limits.scallop.span).unwrap_or(head),
                "of tracks so close",
            ),
            Refusal::Scallop { left } => Diagnostic::new(
                Code::ScallopOverLimit,
                format!(
                    "finishing would leave {} mm on the part, the limit is {} mm",
                    show((left.to_mm() * 1e4).ceil() / 1e4),
                    show(asked.limits.scallop.value.to_mm())
                ),
                asked.limits.scallop.span.unwrap_or(head),
                "this limit",
            )
            .and(asked.step.span.unwrap_or(head), "tracks of this operation"),
            Refusal::Fault { lead, track, fault } => {
                let (what, label) = strip_words(*fault);
                let message = format!(
                    "on the track at x {} mm, with a lead of {} deg, {what}",
                    show((track.contact.x * 1e3).round() / 1e3),
                    show(lead.to_deg())
                );
                let diagnostic = Diagnostic::new(code(*fault), message, place(asked, *fault), label);
                self.with_roughing(diagnostic)
            }
        }
    }

    /// With the operation that has left what stands there.
    fn with_roughing(&self, diagnostic: Diagnostic) -> Diagnostic {
        match self.roughing() {
            Some(before) => diagnostic.and(
                before.setup().head_span,
                "what stands there, this operation has left",
            ),
            None => diagnostic,
        }
    }

    /// The operation before this one.
    fn roughing(&self) -> Option<&dyn Operation> {
        let own = self.asked.setup.head_span;
        let before = self.ground.job.operations.iter();
        let before = before.take_while(|operation| operation.setup().head_span != own);
        before.last().map(|operation| &**operation)
    }

    /// What may help where no change was found to.
    fn advised(&self, diagnostic: Diagnostic) -> Diagnostic {
        let refusal = match &self.why {
            Why::OnProfile(refusal) => refusal,
            Why::OnSurface(refusal) => return self.advised_on_surface(diagnostic, refusal),
        };
        match refusal {
            Refusal::Nothing => diagnostic.help("delete the operation, or leave more for it"),
            Refusal::TooMany { .. } => diagnostic.help("use a larger `step`, or allow more scallop"),
            Refusal::Scallop { .. } => {
                diagnostic.help("use a smaller disc where the part is hollow, or allow more scallop")
            }
            Refusal::Fault { fault, .. } => self.advised_of(diagnostic, *fault),
        }
    }

    /// Whether the operation before this one leaves its cuts where they are, and could lift them onto the part.
    fn may_lift(&self) -> bool {
        let least = self.asked.allowance.value;
        let variants = self.roughing().map(|before| before.leaving_less(least));
        let advice = variants
            .unwrap_or_default()
            .into_iter()
            .map(|variant| variant.advice);
        advice.into_iter().any(|advice| advice.contains("residual"))
    }

    fn advised_of(&self, diagnostic: Diagnostic, fault: PassFault) -> Diagnostic {
        if self.roughing().is_none() {
            return diagnostic.help("rough the stock first, for example with `rough vcut`");
        }
        let nearer = if self.may_lift() {
            "let roughing end its grooves nearer to the part: with `residual = lift`, a smaller `allowance`, or a smaller `step`"
        } else {
            "let roughing end its grooves nearer to the part: with a smaller `allowance`, or a smaller `step`"
        };
        match fault {
            PassFault::Attached {
                hold: Hold::Buried { .. },
                ..
            } => diagnostic
                .note("a strip comes free where the rim comes out of the surface at both of its ends")
                .help(nearer),
            PassFault::OverBody { .. } | PassFault::TooThick { .. } | PassFault::TooWide { .. } => {
                diagnostic.help(nearer)
            }
            PassFault::Attached { .. }
            | PassFault::Meets(_)
            | PassFault::EntersPart { .. }
            | PassFault::Body { .. } => diagnostic,
        }
    }
}

fn nothing(head: Span) -> Diagnostic {
    Diagnostic::new(
        Code::NothingToCut,
        "nothing stands above the part that this operation could take off",
        head,
        "this operation",
    )
}

const fn code(fault: PassFault) -> Code {
    match fault {
        PassFault::Body { .. } => Code::BodyInWork,
        PassFault::EntersPart { .. } => Code::Overcut,
        PassFault::TooThick { .. } | PassFault::TooWide { .. } | PassFault::OverBody { .. } => {
            Code::BladesTooSmall
        }
        PassFault::Attached { .. } | PassFault::Meets(_) => Code::ChipNotFreed,
    }
}

/// The value that a fault is about.
fn place(asked: &FinishDisc, fault: PassFault) -> Span {
    let field = match fault {
        PassFault::TooThick { .. } => asked.disc.depth.span,
        PassFault::TooWide { .. } => asked.disc.width.span,
        PassFault::OverBody { .. } => asked.side.span.or(asked.over_hub.span),
        PassFault::Attached { .. } => asked.lead.span.or(asked.limits.lead.span),
        PassFault::Body { .. } | PassFault::EntersPart { .. } | PassFault::Meets(_) => None,
    };
    field.unwrap_or(asked.setup.head_span)
}
