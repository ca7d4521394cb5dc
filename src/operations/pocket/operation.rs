//! Clearing a pocket as an operation of a job.

use crate::asked::ClearPocket;
use crate::decided::Planned;
use crate::plan;
use crate::refused::Refused;
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::source::Span;
use vcutc_job::follow::Follow;
use vcutc_job::operation::{Ground, Laid, Operation, Unplanned};
use vcutc_job::{BladeRef, Setup, Sourced};

impl Operation for ClearPocket {
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
        vec![BladeRef::Crusher(&self.crusher)]
    }

    fn forget_places(&mut self, place: Span) {
        self.crusher.forget_places(place);
        self.region.span = place;
        self.region_span = place;
        self.floor.forget_place(place);
        self.pattern.forget_place(place);
        self.step.forget_place(place);
        self.layer.forget_place(place);
        self.corners.forget_place(place);
        self.angle.forget_place(place);
        self.lift.forget_place(place);
        self.axis.forget_place(place);
        self.entry.forget_place(place);
        if let Some(opening) = &mut self.opening {
            opening.forget_place(place);
        }
        self.allowance.forget_place(place);
        self.plunge_feed.forget_place(place);
        self.limits.uncut.forget_place(place);
        if let Some(engagement) = &mut self.limits.engagement {
            engagement.forget_place(place);
        }
        if let Some(deviation) = &mut self.limits.deviation {
            deviation.forget_place(place);
        }
    }

    fn deviation_limit(&self) -> Option<Sourced<Length>> {
        self.limits.deviation
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
            Err(why) => Err(Box::new(Refused {
                asked: self,
                remedy: plan::remedy(self, &ground, why),
                why,
            })),
        }
    }
}
