//! Freeing a pocket as an operation of a job.

use crate::asked::FreePocket;
use crate::decided::Planned;
use crate::plan;
use crate::refused::Refused;
use crate::remedy::Unfreed;
use vcutc_diagnostics::source::Span;
use vcutc_job::follow::Follow;
use vcutc_job::operation::{Ground, Laid, Operation, Unplanned};
use vcutc_job::{BladeRef, Setup, Sourced};

impl Operation for FreePocket {
    /// Its floor is level.
    fn follows(&self) -> Option<Sourced<Follow>> {
        None
    }

    fn setup(&self) -> &Setup {
        &self.setup
    }

    fn setup_mut(&mut self) -> &mut Setup {
        &mut self.setup
    }

    fn blades(&self) -> Vec<BladeRef<'_>> {
        vec![BladeRef::Straight(&self.blade), BladeRef::Disc(&self.disc)]
    }

    fn forget_places(&mut self, place: Span) {
        self.blade.forget_places(place);
        self.disc.forget_places(place);
        self.region.span = place;
        self.region_span = place;
        self.floor.forget_place(place);
        self.step.forget_place(place);
        self.layer.forget_place(place);
        self.through.forget_place(place);
        self.chip.forget_place(place);
        self.allowance.forget_place(place);
        self.plunge_feed.forget_place(place);
        self.free_feed.forget_place(place);
        self.limits.uncut.forget_place(place);
        self.limits.residual.forget_place(place);
        if let Some(pillars) = &mut self.limits.pillars {
            pillars.forget_place(place);
        }
    }

    fn plan<'j>(&'j self, ground: Ground<'j>) -> Result<Laid, Box<dyn Unplanned + 'j>> {
        match plan::plan(self, &ground) {
            Ok(plan) => Ok(Laid {
                planned: Box::new(Planned {
                    asked: self.clone(),
                    part: (*ground.job.profile).clone(),
                    plan,
                }),
                // No section shows a pocket.
                after: ground.before,
            }),
            Err(why) => Err(Box::new(Unfreed {
                refused: Refused { asked: self, why },
                ground,
            })),
        }
    }
}
