//! The formulas' parameters under laxer limits on scallop: from the freest down to one that is sound, and up again by halves.

use super::{Trials, limits};
use crate::plan::parameters::VcutParameters;
use vcutc_backend_api::units::Length;
use vcutc_job::Sourced;

/// Into how many equal ratios the way from the limit to the freest bound is divided.
const RUNGS: u32 = 5;

/// How often the way between a sound limit and an unsound one is halved.
const HALVINGS: usize = 3;

impl Trials<'_> {
    /// The parameters under another limit on scallop.
    fn under(&self, limit: Option<Length>) -> Option<VcutParameters> {
        let mut assumed = limits::of_plans(self.asked);
        assumed.limits.scallop = limit.map(|value| Sourced { value, span: None });
        self.resolve(&assumed)
    }

    /// From the freest parameters down to a limit that is sound, and up again by halves.
    pub(super) fn climb(&mut self) {
        let Some(limit) = self.asked.limits.scallop else {
            return;
        };
        let Some(free) = self.under(None) else { return };
        let most = free.scallop_bound(self.asked);
        if self.is_sound(free) || most <= limit.value {
            return;
        }
        let ratio = most.to_mm() / limit.value.to_mm();
        let at = |share: f64| Some(limit.value * libm::pow(ratio, share));
        let share = |rung: u32| f64::from(rung) / f64::from(RUNGS);
        let mut unsound = 1.0;
        let mut sound = 0.0;
        for rung in (1..RUNGS).rev() {
            if self
                .under(at(share(rung)))
                .is_some_and(|found| self.is_sound(found))
            {
                sound = share(rung);
                break;
            }
            unsound = share(rung);
        }
        for _ in 0..HALVINGS {
            let middle = f64::midpoint(sound, unsound);
            if self.under(at(middle)).is_some_and(|found| self.is_sound(found)) {
                sound = middle;
            } else {
                unsound = middle;
            }
        }
    }
}
