//! Changes of a job that may give a plan, the best first.

use super::Refused;
use crate::asked::FinishDisc;
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

/// The leads, in degrees, that are tried together with a change of the roughing.
const LEADS_AFTER_ROUGHING: [u32; 3] = [10, 15, MOST_LEAD];

/// A change of the job's text.
pub(super) struct Change {
    pub(super) title: String,
    pub(super) edits: Vec<(Span, String)>,
    /// This operation then; none where it stays as it is.
    pub(super) here: Option<FinishDisc>,
    /// The operation before it then; none where that stays as it is.
    pub(super) before: Option<Box<dyn Operation>>,
}

impl Change {
    /// A change of this operation, after the one before it has been changed, too.
    fn after(self, roughing: Self) -> Self {
        Self {
            title: format!("{}, and {}", roughing.title, self.title),
            edits: roughing.edits.into_iter().chain(self.edits).collect(),
            here: self.here,
            before: roughing.before,
        }
    }
}

impl Refused<'_> {
    pub(super) fn changes(&self) -> impl Iterator<Item = Change> + '_ {
        let asked = self.asked;
        let (fault, stays, leads) = (self.why.fault(), self.why.stays(), self.why.is_of_leads());
        let runs_at_hub = matches!(fault, Some(PassFault::OverBody { .. }));
        let hangs = matches!(fault, Some(PassFault::Attached { .. }));
        let is_strip = fault.is_some_and(|fault| !matches!(fault, PassFault::EntersPart { .. }));
        let opened = [
            (stays && is_given(&asked.step)).then(|| self.opened("step")),
            (is_strip && is_given(&asked.sequence)).then(|| self.opened("sequence")),
            ((runs_at_hub || hangs) && is_given(&asked.side)).then(|| self.opened("side")),
            ((stays || hangs || leads) && is_given(&asked.lead)).then(|| self.opened("lead")),
        ];
        let leads = (stays || hangs || runs_at_hub || leads).then(|| self.larger_leads());
        let roughings = is_strip.then(|| self.roughings_leaving_less());
        let both = is_strip.then(|| self.roughings_and_leads());
        let hubs = runs_at_hub.then(|| self.over_hub());
        (opened.into_iter().flatten())
            .chain(roughings.into_iter().flatten())
            .chain(leads.into_iter().flatten())
            .chain(both.into_iter().flatten())
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
            here: Some(asked),
            before: None,
        }
    }

    /// The greatest lead that the job allows.
    fn lead_now(&self) -> Angle {
        match self.asked.lead.value {
            Auto::Auto => self.asked.limits.lead.value,
            Auto::Given(lead) => lead,
        }
    }

    fn larger_leads(&self) -> impl Iterator<Item = Change> + '_ {
        let now = self.lead_now();
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
                // All leads up to the limit were tried without success.
                asked.relief.value = asked.limits.lead.value;
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
            here: Some(asked),
            before: None,
        }
    }

    /// Roughing that leaves less on the part.
    fn roughings_leaving_less(&self) -> impl Iterator<Item = Change> + '_ {
        let least = self.asked.allowance.value;
        let variants = self.roughing().map(|before| before.leaving_less(least));
        let written = variants.unwrap_or_default().into_iter();
        written
            .filter(|variant| !variant.edits.is_empty())
            .map(|variant| Change {
                title: format!("let roughing leave less on the part: {}", variant.advice),
                edits: variant.edits,
                here: None,
                before: Some(variant.operation),
            })
    }

    /// The same, each with larger leads.
    fn roughings_and_leads(&self) -> impl Iterator<Item = Change> + '_ {
        let leads = LEADS_AFTER_ROUGHING.map(|lead| Angle::deg(f64::from(lead)));
        let larger = leads.into_iter().filter(|lead| *lead > self.lead_now());
        larger.flat_map(move |lead| {
            self.roughings_leaving_less()
                .map(move |roughing| self.with_lead(lead).after(roughing))
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
                here: Some(asked),
                before: None,
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
