//! Changes of a job that may give a plan, the best first.

use super::Refused;
use crate::asked::FinishDisc;
use crate::plan::Refusal;
use vcutc_backend_api::units::{Angle, Length};
use vcutc_diagnostics::number::show;
use vcutc_diagnostics::source::Span;
use vcutc_job::operation::Operation;
use vcutc_job::{Auto, Sourced};
use vcutc_simulation::disc::PassFault;

/// More lead than that is not offered, in degrees: the disc then ploughs more than it slices.
const MOST_LEAD: u32 = 20;

/// Thicker strips than that are not offered to run over a hub, in mm.
const MOST_OVER_HUB: u32 = 30;

/// Shares of the allowance of the roughing that are tried.
const ALLOWANCES: [f64; 3] = [0.5, 0.25, 0.1];

/// A change of the job's text.
pub(super) struct Change {
    pub(super) title: String,
    pub(super) edits: Vec<(Span, String)>,
    pub(super) scope: Scope,
}

/// What a change is of.
pub(super) enum Scope {
    /// Of this operation, which is then this.
    Here(Box<FinishDisc>),
    /// Of the one before it, which is then this.
    Before(Box<dyn Operation>),
}

impl Refused<'_> {
    pub(super) fn changes(&self) -> impl Iterator<Item = Change> + '_ {
        let asked = self.asked;
        let (fault, stays) = match &self.refusal {
            Refusal::Nothing | Refusal::TooMany { .. } => (None, false),
            Refusal::Scallop { .. } => (None, true),
            Refusal::Fault { fault, .. } => (Some(*fault), false),
        };
        let runs_at_hub = matches!(fault, Some(PassFault::OverBody { .. }));
        let hangs = matches!(fault, Some(PassFault::Attached { .. }));
        let is_strip = fault.is_some_and(|fault| !matches!(fault, PassFault::EntersPart { .. }));
        let opened = [
            (stays && is_given(&asked.step)).then(|| self.opened("step")),
            (is_strip && is_given(&asked.sequence)).then(|| self.opened("sequence")),
            ((runs_at_hub || hangs) && is_given(&asked.side)).then(|| self.opened("side")),
            ((stays || hangs) && is_given(&asked.lead)).then(|| self.opened("lead")),
        ];
        let leads = (stays || hangs || runs_at_hub).then(|| self.larger_leads());
        let allowances = is_strip.then(|| self.smaller_allowances());
        let hubs = runs_at_hub.then(|| self.over_hub());
        (opened.into_iter().flatten())
            .chain(allowances.into_iter().flatten())
            .chain(leads.into_iter().flatten())
            .chain(hubs.into_iter().flatten())
    }

    /// A field that is left to the compiler.
    fn opened(&self, field: &'static str) -> Change {
        let mut asked = self.asked.clone();
        let span = match field {
            "step" => opened(&mut asked.step),
            "sequence" => opened(&mut asked.sequence),
            "side" => opened(&mut asked.side),
            _ => opened(&mut asked.lead),
        };
        Change {
            title: format!("use `{field} = auto`"),
            edits: self.written(field, span, "auto"),
            scope: Scope::Here(Box::new(asked)),
        }
    }

    fn larger_leads(&self) -> impl Iterator<Item = Change> + '_ {
        let now = match self.asked.lead.value {
            Auto::Auto => self.asked.limits.lead.value,
            Auto::Given(lead) => lead,
        };
        let leads = (1..=MOST_LEAD).map(|lead| Angle::deg(f64::from(lead)));
        leads
            .filter(move |lead| *lead > now)
            .map(move |lead| self.with_lead(lead))
    }

    fn with_lead(&self, lead: Angle) -> Change {
        let mut asked = self.asked.clone();
        let word = format!("{} deg", show(lead.to_deg()));
        let (title, edits) = match self.asked.lead.value {
            Auto::Auto => {
                asked.limits.lead.value = lead;
                // The limits are required, so there is a place for one more.
                let edits = match (self.asked.limits.lead.span, self.asked.limits.scallop.span) {
                    (Some(span), _) => vec![(span, word.clone())],
                    (None, Some(scallop)) => vec![(scallop.after(), format!(", lead <= {word}"))],
                    (None, None) => Vec::new(),
                };
                (format!("allow `lead <= {word}`"), edits)
            }
            Auto::Given(_) => {
                asked.lead.value = Auto::Given(lead);
                let edits = self.written("lead", self.asked.lead.span, &word);
                (format!("use `lead = {word}`"), edits)
            }
        };
        Change {
            title,
            edits,
            scope: Scope::Here(Box::new(asked)),
        }
    }

    /// Roughing that ends its grooves nearer to the part.
    fn smaller_allowances(&self) -> impl Iterator<Item = Change> + '_ {
        let roughing = self.roughing();
        let stated = roughing.and_then(|before| {
            let allowance = before.allowance()?;
            Some((before, allowance.value, allowance.span?))
        });
        let own = self.asked.allowance.value;
        stated.into_iter().flat_map(move |(before, now, span)| {
            let shares = ALLOWANCES.map(|share| Length::mm((now.to_mm() * share * 1e3).floor() / 1e3));
            let smaller = shares.into_iter().filter(move |smaller| *smaller >= own);
            smaller.filter_map(move |smaller| {
                let word = format!("{} mm", show(smaller.to_mm()));
                Some(Change {
                    title: format!("let roughing end its grooves nearer to the part: `allowance = {word}`"),
                    edits: vec![(span, word)],
                    scope: Scope::Before(before.with_allowance(smaller)?),
                })
            })
        })
    }

    fn over_hub(&self) -> impl Iterator<Item = Change> + '_ {
        let heights = (1..=MOST_OVER_HUB).map(|height| Length::mm(f64::from(height)));
        let more = heights.filter(|height| *height > self.asked.over_hub.value);
        more.map(|height| {
            let mut asked = self.asked.clone();
            asked.over_hub.value = height;
            let word = format!("{} mm", show(height.to_mm()));
            Change {
                title: format!(
                    "use `over_hub = {word}` if strips of that thickness run over the hub of `{}`",
                    asked.disc.name
                ),
                edits: self.written("over_hub", self.asked.over_hub.span, &word),
                scope: Scope::Here(Box::new(asked)),
            }
        })
    }

    /// What to write so that the operation states a field.
    fn written(&self, field: &str, span: Option<Span>, word: &str) -> Vec<(Span, String)> {
        let edit = match (span, self.asked.setup.clearance.span) {
            (Some(span), _) => Some((span, word.to_owned())),
            (None, Some(clearance)) => Some((clearance.after(), format!("\n  {field} = {word}"))),
            (None, None) => None,
        };
        edit.into_iter().collect()
    }
}

fn is_given<T>(field: &Sourced<Auto<T>>) -> bool {
    matches!(field.value, Auto::Given(_))
}

/// Leaves a field open, and gives the place where it was stated.
fn opened<T>(field: &mut Sourced<Auto<T>>) -> Option<Span> {
    field.value = Auto::Auto;
    field.span
}
