//! Rectangular roughing as an operation of a job.

use crate::asked::{AIR, Residual, RoughRect};
use crate::decided::{Extensions, Planned};
use crate::plan::blades::{Cover, Hold, Knife, Wheel};
use crate::plan::model::Pace;
use crate::plan::shank::Shank;
use crate::plan::{self, Blades, Limits, Rounding, Span as Range, WORTH, Wish, Work};
use crate::{lower, refused};
use vcutc_backend_api::ir::Flank;
use vcutc_backend_api::units::{Duration, Length};
use vcutc_diagnostics::source::Span;
use vcutc_geometry::curve::Point2;
use vcutc_geometry::offset::offset_up;
use vcutc_job::operation::less::Leaves;
use vcutc_job::operation::planning::PlanningJob;
use vcutc_job::operation::{Ground, Laid, Operation, Unplanned, Variant};
use vcutc_job::{BladeRef, Bounds, Machine, Setup, Sourced};
use vcutc_process::posture::Feed;

impl Operation for RoughRect {
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
        self.lead.forget_place(place);
        self.free_feed.forget_place(place);
        self.layer.forget_place(place);
        self.step.forget_place(place);
        self.through.forget_place(place);
        self.residual.forget_place(place);
        self.beyond.forget_place(place);
        self.down_to.forget_place(place);
        self.allowance.forget_place(place);
        self.standoff.forget_place(place);
        self.limits.layer.forget_places(place);
        self.limits.step.forget_places(place);
        forget(&mut self.limits.scallop, place);
        forget(&mut self.limits.changes, place);
        forget(&mut self.limits.cuts, place);
        forget(&mut self.limits.time, place);
    }

    /// The rim runs on under the next strip.
    fn widest_strip(&self) -> Option<Length> {
        Some(self.disc.width.value + self.beyond.value)
    }

    fn scallop_limit(&self) -> Option<Sourced<Length>> {
        self.limits.scallop
    }

    fn leaving_less(&self, least: Length) -> Vec<Variant> {
        let leaves = Leaves {
            allowance: |asked: &mut Self| &mut asked.allowance,
            scallop: |asked| &mut asked.limits.scallop,
            residual: |asked| &mut asked.residual,
            lift: Residual::Lift,
        };
        leaves.less(self, least)
    }

    fn plan<'j>(&'j self, ground: Ground<'j>) -> Result<Laid, Box<dyn Unplanned + 'j>> {
        let stock = ground.job.stock;
        let before: Vec<Point2> = ground.before.corners().collect();
        let bound = offset_up(&ground.job.profile, self.allowance.value);
        let work = Work {
            stock,
            part: &ground.job.profile,
            bound: &bound,
            before: &before,
            allowance: self.allowance.value,
        };
        let blades = self.pair(ground.job.machine.as_ref());
        let wish = self.wish();
        let plan = self
            .for_finishing(&ground.job, &wish)
            .and_then(|wish| plan::plan(work, &blades, &wish, ground.cuts_left).ok())
            .map_or_else(|| plan::plan(work, &blades, &wish, ground.cuts_left), Ok)
            .map_err(|refusal| Box::new(refused::diagnostic(self, &refusal)) as Box<dyn Unplanned>)?;
        let standoff = blades.knife.standoff;
        let planned = Planned {
            extensions: self.extensions(),
            asked: self.clone(),
            plan,
            bound,
            standoff,
        };
        let after = planned.leaves(ground.before);
        Ok(Laid {
            planned: Box::new(planned),
            after,
        })
    }
}

impl RoughRect {
    /// The blades as the planner needs them, and how fast they go.
    pub(crate) fn pair(&self, machine: Option<&Machine>) -> Blades {
        Blades {
            knife: Knife::of(
                &self.blade,
                self.setup.rake.value,
                self.standoff.value,
                Cover::Uncut,
            ),
            shank: self.blade.in_program().body.map(|stages| Shank {
                stages,
                held: lower::slit_holder(self).cutting(Flank::Left, Feed::Forward),
                extension: self.extensions().slits.to_mm(),
            }),
            wheel: Wheel::of(
                &self.disc,
                Hold {
                    lead: self.lead.value,
                    beyond: self.beyond.value,
                    clearance: AIR,
                },
            ),
            pace: self.pace(machine),
        }
    }

    fn pace(&self, machine: Option<&Machine>) -> Pace {
        let change = machine.and_then(|machine| machine.change).map(|held| held.change);
        Pace {
            slit: self.setup.cut_feed.value,
            free: self.free_feed.value,
            travel: self.setup.travel_feed.value,
            reorient: self.setup.reorient_rate.value,
            change: change.map_or(Duration::ZERO, |change| change.time),
            change_way: Duration::ZERO,
            run_out: self.setup.run_out.value,
            clearance: self.setup.clearance.value,
        }
    }

    pub(crate) fn wish(&self) -> Wish {
        let limits = &self.limits;
        let whole = |limit: Sourced<f64>| limit.value.floor();
        Wish {
            layer: self.layer.value,
            step: self.step.value,
            through: self.through.value,
            residual: self.residual.value,
            down_to: self.down_to.value,
            limits: Limits {
                layer: range(limits.layer),
                step: range(limits.step),
                scallop: limits.scallop.map(|limit| limit.value),
                changes: limits.changes.map(|limit| whole(limit) as u32),
                cuts: limits.cuts.map(|limit| whole(limit) as usize),
                time: limits.time.map(|limit| limit.value),
            },
            rounding: Rounding::Grid,
            worth: WORTH,
        }
    }

    /// Of an operation without a limit on the scallop the one that an operation after it asks for, which takes off the rest.
    fn for_finishing(&self, job: &PlanningJob<'_>, wish: &Wish) -> Option<Wish> {
        if wish.limits.scallop.is_some() {
            return None;
        }
        let own = self.setup.head_span;
        let after = job.operations.iter();
        let mut after = after
            .skip_while(|operation| operation.setup().head_span != own)
            .skip(1);
        let takes_off = after.find_map(|operation| operation.takes_off())?;
        let mut wish = wish.clone();
        wish.limits.scallop = Some(takes_off.value);
        Some(wish)
    }

    /// How far beside the work each blade is clear of it while it turns from one feed to the other.
    fn extensions(&self) -> Extensions {
        let run_out = self.setup.run_out.value;
        let slits = lower::slit_holder(self)
            .turning_overhang(self.blade.cutting_length.value, self.blade.half_apex.value);
        let holder = lower::strip_holder(self);
        let held = [Feed::Forward, Feed::Backward].map(|feed| holder.cutting(Flank::Left, feed));
        let [near, far] = self.disc.in_program().extent(held).y;
        Extensions {
            slits: slits + run_out,
            strips: Length::mm(far.max(-near)) + run_out,
        }
    }
}

fn range(bounds: Bounds<Length>) -> Range {
    Range {
        least: bounds.least.map(|bound| bound.value),
        most: bounds.most.map(|bound| bound.value),
    }
}

fn forget<T>(limit: &mut Option<Sourced<T>>, place: Span) {
    if let Some(limit) = limit {
        limit.forget_place(place);
    }
}
