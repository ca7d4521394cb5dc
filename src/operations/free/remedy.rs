//! Changes of a pocket to be freed that has no plan, tried before they are offered.

use crate::asked::FreePocket;
use crate::plan::plan;
use crate::refused::{CRUSHER, Refused};
use vcutc_backend_api::units::Length;
use vcutc_cancellation::{Effort, Wanted};
use vcutc_diagnostics::Diagnostic;
use vcutc_diagnostics::number::show;
use vcutc_diagnostics::source::Span;
use vcutc_job::Auto;
use vcutc_job::operation::{Ground, Unplanned, WorksThere};

/// A change of the job with which it compiles: it was tried.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Remedy {
    /// Narrower strips.
    Step(Length),
    /// A disc with a smaller edge, and the same body.
    Radius(Length),
}

impl Remedy {
    fn made_to(self, asked: &FreePocket) -> FreePocket {
        let mut changed = asked.clone();
        match self {
            Self::Step(step) => changed.step.value = Auto::Given(step),
            Self::Radius(radius) => changed.disc.radius.value = radius,
        }
        changed
    }

    /// In the imperative.
    fn words(self, asked: &FreePocket) -> String {
        match self {
            Self::Step(step) => format!("use `step = {} mm`", show(step.to_mm())),
            Self::Radius(radius) => format!(
                "use a disc like `{}` with a radius of {} mm",
                asked.disc.name,
                show(radius.to_mm())
            ),
        }
    }

    /// What to write where.
    fn edits(self, asked: &FreePocket) -> Vec<(Span, String)> {
        let words = |length: Length| format!("{} mm", show(length.to_mm()));
        let (place, text) = match self {
            Self::Step(step) => match asked.step.span {
                Some(span) => (Some(span), words(step)),
                // A field of its own, after that of the region.
                None => {
                    let after = Span {
                        start: asked.region_span.end,
                        ..asked.region_span
                    };
                    (Some(after), format!(", step = {}", words(step)))
                }
            },
            Self::Radius(radius) => (asked.disc.radius.span, words(radius)),
        };
        place.map(|place| (place, text)).into_iter().collect()
    }
}

/// Steps and radii that are tried, as shares of those there are.
const SMALLER: [f64; 3] = [0.8, 0.6, 0.4];

/// What trying one takes, as so many cuts.
const TRIAL: usize = 1_000;

/// An operation without a plan, and the ground that it finds.
pub(crate) struct Unfreed<'j> {
    pub(crate) refused: Refused<'j>,
    pub(crate) ground: Ground<'j>,
}

impl Unplanned for Unfreed<'_> {
    fn diagnostics(
        &self,
        wanted: &Wanted,
        effort: &mut Effort,
        works: &mut WorksThere<'_>,
    ) -> Vec<Diagnostic> {
        let diagnostic = self.refused.diagnostic();
        vec![match self.refused.why.otherwise() {
            Some(otherwise) => diagnostic.help(match self.remedy(wanted, effort, works) {
                Some(remedy) => format!("{}, or {CRUSHER}", remedy.words(self.refused.asked)),
                None => format!("{otherwise}{CRUSHER}"),
            }),
            None => diagnostic,
        }]
    }
}

impl Unfreed<'_> {
    /// The first change with which the job compiles.
    fn remedy(&self, wanted: &Wanted, effort: &mut Effort, works: &mut WorksThere<'_>) -> Option<Remedy> {
        let down = |value: Length, share: f64| Length::mm(libm::floor(value.to_mm() * share * 10.0) / 10.0);
        let asked = self.refused.asked;
        let radius = asked.disc.radius.value;
        let most = asked.step.value.or(radius / 2.0);
        let steps = SMALLER.map(|share| Remedy::Step(down(most, share)));
        let radii = SMALLER.map(|share| Remedy::Radius(down(radius, share)));
        steps.into_iter().chain(radii).find(|remedy| {
            if wanted.is_needless() || effort.is_spent() {
                return false;
            }
            effort.spend(TRIAL);
            plan(&remedy.made_to(asked), &self.ground).is_ok() && works(&remedy.edits(asked))
        })
    }
}
