//! What a limit costs and what a better blade would buy: rectangular roughing planned again with one thing changed.
//!
//! Times are those of the model ([`crate::plan::model`]), so that they compare; no machine is asked.

use crate::asked::RoughRect;
use crate::plan::model::Counts;
use crate::plan::{self, Blades, Limits, PlannedRect, Room, Wish, Work};
use vcutc_backend_api::units::{Duration, Length};
use vcutc_diagnostics::number::show;
use vcutc_geometry::curve::Point2;
use vcutc_geometry::offset::offset_up;
use vcutc_job::operation::Ground;

/// A plan in figures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Figures {
    /// By the model.
    pub time: Duration,
    /// Slits, strips and changes of blade.
    pub counts: Counts,
    /// The most that stays on the part.
    pub left: Length,
    pub layer: Length,
    pub step: Length,
    /// How many layers slits go through.
    pub through: u32,
}

/// A plan with one thing changed.
#[derive(Clone, Debug, PartialEq)]
pub struct Price {
    /// What is changed: `depth of wheel + 1 mm`.
    pub change: String,
    /// None where there is no such plan.
    pub plan: Option<Figures>,
}

/// By how much a speed grows, as a share.
const FASTER: f64 = 0.1;

impl RoughRect {
    /// The plan as the job asks for it; none where there is none.
    #[must_use]
    pub fn figures(&self, ground: &Ground<'_>) -> Option<Figures> {
        self.figures_of(ground, &self.blades_at(ground), self.wish().limits)
    }

    /// The plan under another limit on the scallop, without limits on time and cuts; none where no plan keeps it.
    #[must_use]
    pub fn figures_under(&self, limit: Length, ground: &Ground<'_>) -> Option<Figures> {
        let limits = Limits {
            scallop: Some(limit),
            changes: None,
            cuts: None,
            time: None,
            ..self.wish().limits
        };
        self.figures_of(ground, &self.blades_at(ground), limits)
    }

    /// The plan with one more unit of what the disc takes, with faster changes and with faster feeds.
    #[must_use]
    pub fn prices(&self, ground: &Ground<'_>) -> Vec<Price> {
        let (now, disc) = (self.blades_at(ground), &self.disc.name);
        let unit = Length::mm(1.0);
        let more = format!("{:.0} %", FASTER * 100.0);
        let mut changes: Vec<(String, Blades)> = Vec::new();
        let mut changed = |what: String, change: &dyn Fn(&mut Blades)| {
            let mut then = now.clone();
            change(&mut then);
            changes.push((what, then));
        };
        changed(format!("`depth` of `{disc}` + 1 mm"), &|blades| {
            blades.wheel.depth += unit;
        });
        changed(format!("`width` of `{disc}` + 1 mm"), &|blades| {
            blades.wheel.width += unit;
        });
        changed(
            format!("`cutting_length` of `{}` + 1 mm", self.blade.name),
            &|blades| blades.knife.edge += unit,
        );
        changed(format!("feed `free` + {more}"), &|blades| {
            blades.pace.free = blades.pace.free * (1.0 + FASTER);
        });
        changed(format!("feed `cut` + {more}"), &|blades| {
            blades.pace.slit = blades.pace.slit * (1.0 + FASTER);
        });
        let change = now.pace.change;
        if change > Duration::ZERO {
            let shorter = (change - Duration::s(1.0)).max(Duration::ZERO);
            let by = show((change - shorter).to_s());
            changed(format!("changes of blade {by} s shorter"), &|blades| {
                blades.pace.change = shorter;
            });
        }
        let limits = self.wish().limits;
        let priced = changes.into_iter().map(|(change, blades)| Price {
            change,
            plan: self.figures_of(ground, &blades, limits),
        });
        priced.collect()
    }

    fn blades_at(&self, ground: &Ground<'_>) -> Blades {
        self.pair(ground.job.machine.as_ref())
    }

    fn figures_of(&self, ground: &Ground<'_>, blades: &Blades, limits: Limits) -> Option<Figures> {
        let before: Vec<Point2> = ground.before.corners().collect();
        let bound = offset_up(&ground.job.profile, self.allowance.value);
        let work = Work {
            stock: ground.job.stock,
            part: &ground.job.profile,
            bound: &bound,
            before: &before,
            allowance: self.allowance.value,
        };
        let wish = Wish {
            limits,
            ..self.wish()
        };
        let plan = plan::plan(work, blades, &wish, ground.cuts_left).ok()?;
        (plan.room != Room::Lacking).then(|| Figures::of(&plan))
    }
}

impl Figures {
    fn of(plan: &PlannedRect) -> Self {
        Self {
            time: plan.time,
            counts: plan.counts(),
            left: plan.left,
            layer: plan.layer,
            step: plan.step,
            through: plan.through,
        }
    }
}
