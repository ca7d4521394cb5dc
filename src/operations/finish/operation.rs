//! Finishing with a disc as an operation of a job.

use crate::asked::{AIR, FinishDisc};
use crate::decided::Planned;
use crate::on_surface;
use crate::plan::{self, Wish, Work};
use crate::refused::{Refused, Why};
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::source::Span;
use vcutc_geometry::offset::offset_up;
use vcutc_job::follow::Follow;
use vcutc_job::operation::{Ground, Laid, Operation, Unplanned};
use vcutc_job::{BladeRef, Setup, Sourced};
use vcutc_simulation::disc::Disc;

impl Operation for FinishDisc {
    /// Its tracks go where the part does.
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
        vec![BladeRef::Disc(&self.disc)]
    }

    fn forget_places(&mut self, place: Span) {
        self.disc.forget_places(place);
        self.step.forget_place(place);
        self.lead.forget_place(place);
        self.side.forget_place(place);
        self.sequence.forget_place(place);
        self.relief.forget_place(place);
        self.over_hub.forget_place(place);
        self.allowance.forget_place(place);
        self.limits.scallop.forget_place(place);
        self.limits.lead.forget_place(place);
    }

    fn widest_strip(&self) -> Option<Length> {
        Some(self.disc.width.value)
    }

    fn scallop_limit(&self) -> Option<Sourced<Length>> {
        Some(self.limits.scallop)
    }

    fn takes_off(&self) -> Option<Sourced<Length>> {
        Some(self.disc.depth)
    }

    fn plan<'j>(&'j self, ground: Ground<'j>) -> Result<Laid, Box<dyn Unplanned + 'j>> {
        if let Some(surface) = ground.job.job().part.surface() {
            let laid = on_surface::planned(self, &self.wish(), surface, &ground);
            return laid.map_err(|refusal| -> Box<dyn Unplanned + 'j> {
                Box::new(Refused {
                    asked: self,
                    ground,
                    why: Why::OnSurface(refusal),
                })
            });
        }
        let bound = offset_up(&ground.job.profile, self.allowance.value);
        let work = Work {
            part: &ground.job.profile,
            bound: &bound,
            before: &ground.before,
        };
        let wish = self.wish();
        match plan::plan(work, &wish) {
            Ok((plan, after)) => {
                let planned = Planned {
                    asked: self.clone(),
                    plan,
                    bound,
                    depth: ground.job.stock.depth,
                };
                Ok(Laid {
                    planned: Box::new(planned),
                    after,
                })
            }
            Err(refusal) => Err(Box::new(Refused {
                asked: self,
                ground,
                why: Why::OnProfile(refusal),
            })),
        }
    }
}

impl FinishDisc {
    fn wish(&self) -> Wish {
        Wish {
            disc: Disc {
                radius: self.disc.radius.value,
                depth: Some(self.disc.depth.value),
                width: Some(self.disc.width.value),
                body: self.disc.in_program().body.unwrap_or_default(),
            },
            step: self.step.value,
            lead: self.lead.value,
            side: self.side.value,
            sequence: self.sequence.value,
            relief: self.relief.value,
            steepest: self.limits.lead.value,
            over_hub: self.over_hub.value,
            clearance: AIR,
            scallop: self.limits.scallop.value,
        }
    }
}
