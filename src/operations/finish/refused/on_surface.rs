//! Why there is no plan of tracks on a surface.

use super::{Refused, code, nothing, place};
use crate::on_surface::lay::Unlaid;
use crate::on_surface::plan::Refusal;
use crate::plan::MOST_TRACKS;
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::number::show;
use vcutc_diagnostics::source::Span;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_job::Auto;
use vcutc_process::verdict::words::{stays_words, strip_words};
use vcutc_surface::track::NoTrack;

fn mm(value: f64) -> String {
    show((value * 1e3).round() / 1e3)
}

impl Refused<'_> {
    pub(super) fn diagnose_on_surface(&self, refusal: &Refusal) -> Diagnostic {
        let asked = self.asked;
        let head = asked.setup.head_span;
        match refusal {
            Refusal::Allowance => Diagnostic::new(
                Code::Misplaced,
                "`finish disc` keeps no allowance on a surface",
                asked.allowance.span.unwrap_or(head),
                "only on profiles",
            )
            .and(self.ground.job.profile_span, "the part is a surface"),
            Refusal::NotLast => Diagnostic::new(
                Code::Misplaced,
                "`finish disc` on a surface is not the last operation",
                head,
                "another one comes after it",
            )
            .note("what tracks on a surface leave is not the same at every y, as operations after them would have to know it"),
            Refusal::Nothing => nothing(head),
            Refusal::TooMany { tracks } => Diagnostic::new(
                Code::TooManyCuts,
                format!("{tracks} tracks with their poses are too many to plan, at most {MOST_TRACKS} tracks are"),
                asked.step.span.or(asked.limits.scallop.span).unwrap_or(head),
                "of tracks so close",
            ),
            Refusal::Scallop { left } => {
                let (what, label) = stays_words(left.at, left.height, asked.limits.scallop.value);
                Diagnostic::new(
                    Code::ScallopOverLimit,
                    format!("beside the tracks at y {} mm, {what}", mm(left.y)),
                    asked.limits.scallop.span.unwrap_or(head),
                    label,
                )
                .and(asked.step.span.unwrap_or(head), "tracks of this operation")
            }
            Refusal::Unlaid { x, why } => self.unlaid(*x, *why),
            Refusal::Fault { lead, x, fault } => {
                let (what, label) = strip_words(fault.fault);
                let message = format!(
                    "on the track at x {} mm, y {} mm, with a lead of at least {} deg, {what}",
                    mm(*x),
                    mm(fault.y),
                    show(lead.to_deg())
                );
                let span = place(asked, fault.fault);
                self.with_roughing(Diagnostic::new(code(fault.fault), message, span, label))
            }
        }
    }

    fn unlaid(&self, x: f64, why: Unlaid) -> Diagnostic {
        let asked = self.asked;
        let head = asked.setup.head_span;
        match why {
            Unlaid::NoTrack(NoTrack::Lead { contact, lead, lift }) => Diagnostic::new(
                Code::ScallopOverLimit,
                format!(
                    "with a lead of {} deg the disc does not come down to the part at x {} mm, y {} mm",
                    show((lead.to_deg() * 1e3).round() / 1e3),
                    mm(contact.x),
                    mm(contact.y)
                ),
                self.lead_span(),
                "the greatest lead",
            )
            .note(format!(
                "there the part lifts it by {} mm: it is hollow, or rises beside the disc",
                show((lift.to_mm() * 1e4).ceil() / 1e4)
            )),
            Unlaid::NoTrack(NoTrack::TooLong | NoTrack::Demand) => Diagnostic::new(
                Code::TooManyCuts,
                format!("the track at x {} mm takes too many poses", mm(x)),
                head,
                "tracks of this operation",
            ),
            Unlaid::NoTrack(NoTrack::Posture { contact }) => self.held(contact.x, contact.y),
            Unlaid::NoTrack(NoTrack::Contact { place }) | Unlaid::Posture { place } => self.held(place.x, place.y),
            Unlaid::FaceFirst { place } => Diagnostic::new(
                Code::BladesTooSmall,
                format!(
                    "at x {} mm, y {} mm the part is so hollow along the track that the disc would go down through its own face",
                    mm(place.x),
                    mm(place.y)
                ),
                self.lead_span(),
                "with this lead",
            ),
            Unlaid::Below { tip, by } => Diagnostic::new(
                Code::BladesTooSmall,
                format!(
                    "where the track at x {} mm leaves the stock at y {} mm, the disc goes {} mm below its bottom",
                    mm(x),
                    mm(tip.y),
                    mm(by.to_mm())
                ),
                head,
                "tracks of this operation",
            )
            .note("beside the stock the disc goes on straight until its edge is clear of it"),
        }
    }

    fn held(&self, x: f64, y: f64) -> Diagnostic {
        Diagnostic::new(
            Code::BladesTooSmall,
            format!(
                "at x {} mm, y {} mm the part is too steep for the disc",
                mm(x),
                mm(y)
            ),
            self.asked.setup.head_span,
            "tracks of this operation",
        )
    }

    fn lead_span(&self) -> Span {
        let asked = self.asked;
        let limit = asked.limits.lead.span.or(asked.limits.scallop.span);
        asked.lead.span.or(limit).unwrap_or(asked.setup.head_span)
    }

    pub(super) fn advised_on_surface(&self, diagnostic: Diagnostic, refusal: &Refusal) -> Diagnostic {
        match refusal {
            Refusal::Allowance => {
                diagnostic.help("delete `allowance`, and raise the surface if material has to stay on it")
            }
            Refusal::NotLast => diagnostic.help("move this block to the end, or into a job of its own"),
            Refusal::Nothing => diagnostic.help("delete the operation, or leave more for it"),
            Refusal::TooMany { .. } => diagnostic.help("use a larger `step`, or allow more scallop"),
            Refusal::Scallop { .. } => {
                diagnostic.help("use a smaller disc where the part is hollow, or allow more scallop")
            }
            Refusal::Fault { fault, .. } => self.advised_of(diagnostic, fault.fault),
            Refusal::Unlaid { why, .. } => match why {
                Unlaid::Below { by, .. } => diagnostic.help(format!(
                    "let the part lie higher in the stock, by {} mm at least",
                    show(((*by + Length::mm(0.1)).to_mm() * 10.0).ceil() / 10.0)
                )),
                Unlaid::FaceFirst { .. } if self.asked.lead.value != Auto::Auto => {
                    diagnostic.help("give a larger `lead`, or leave it open")
                }
                Unlaid::NoTrack(_) | Unlaid::Posture { .. } | Unlaid::FaceFirst { .. } => {
                    diagnostic.help("use a smaller disc, or allow more lead in `limits`")
                }
            },
        }
    }
}
