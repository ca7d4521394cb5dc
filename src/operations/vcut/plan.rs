//! From a checked job to the cuts that carry it out.
//!
//! The open parameters are decided first ([`parameters`]). [`lay_out`] lays tips out layer by layer ([`lattice`]), decides what
//! becomes of tips that would cut the part ([`residual`]), and keeps a surface of its own while it goes, because whether a
//! tip can be cut depends on what has been cut before. [`route`] puts the cuts in order. Nothing is promised: the cuts are
//! proven later, from the program. Which of several plans is taken where the job leaves the choice open, `choice` says.
//!
//! Tips lie on a grid of a micrometre ([`vcutc_geometry::grid`]), so that a program printed with three decimals says exactly what was
//! planned and proven.

pub mod avoid;
pub mod blade_reach;
mod chip;
mod complaints;
pub mod decision;
pub(crate) mod fitted;
pub mod floor;
pub mod given;
pub mod lattice;
pub mod optimum;
pub mod parameters;
pub(crate) mod redundant;
pub mod refusal;
pub mod removable;
pub mod residual;
pub mod route;
pub mod searched;
pub mod time_model;
mod wider;

#[cfg(test)]
pub(crate) mod tests;

pub use vcutc_job::planned::TipOrigin;
pub use vcutc_process::plan::MOST_CUTS;

use crate::asked::{Lattice, Redundant, Residual, RoughVcut, Sequence, Tips};
use avoid::Swings;
pub use complaints::beyond_the_stock;
use complaints::{nothing_to_cut, too_many_cuts};
use decision::Decision;
use fitted::{Fitting, Unfit};
use given::Course;
use parameters::VcutParameters;
use refusal::Refused;
use residual::Strategies;
use route::Run;
use searched::Searched;
use std::borrow::Cow;
use vcutc_backend_api::ir::Stock;
use vcutc_backend_api::units::{Duration, Length};
use vcutc_geometry::columns::Columns;
use vcutc_geometry::cone;
use vcutc_geometry::curve::Point2;
use vcutc_geometry::profile::Profile;
use vcutc_geometry::spine::Spine;
use vcutc_job::{Auto, Order, PlanningJob};
use vcutc_simulation::prove::Compensation;
use vcutc_simulation::surface::{Surface, Vee};

/// V-shaped roughing with every choice made.
#[derive(Clone, Debug, PartialEq)]
pub struct PlannedVcut {
    /// What the job asks for.
    pub asked: RoughVcut,
    /// What it came out as.
    pub parameters: VcutParameters,
    /// What became of tips that would cut the part.
    pub strategy: Residual,
    /// Order of the flanks.
    pub order: Order,
    /// Order of the Vs.
    pub sequence: Sequence,
    /// The part with its allowance: no cut's material side may go below.
    pub bound: Profile,
    /// The mean-value estimate of the time [Cui 11].
    pub estimate: Duration,
    /// How many Vs that estimate is made for.
    pub estimated_cuts: f64,
    /// The cuts, layer by layer, each layer from left to right.
    pub cuts: Vec<PlannedCut>,
    /// How many redundant Vs were skipped.
    pub skipped: usize,
    /// Which way layers go and what is not cut, where the job gives the tips.
    pub course: Option<Course>,
    /// In which order they are made: every cut in one run.
    pub runs: Vec<Run>,
    /// How far its tips are offset from their places against forces; none where they are not.
    pub compensation: Option<Compensated>,
    /// Why it came out so, where the job left the choice open.
    pub decisions: Vec<Decision>,
    /// How far its parameters were searched for; none where formulas decided them.
    pub searched: Option<Searched>,
}

/// Tips that are offset against forces.
#[derive(Clone, Debug, PartialEq)]
pub struct Compensated {
    /// Their offsets.
    pub by: Compensation,
    /// How much lower flanks come out at most than those that were planned, where nothing pushes the blade.
    pub lower: Length,
}

/// One V-cut.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlannedCut {
    /// The layer it belongs to, counted from 1 at the top. A layer that cuts nothing has no number.
    pub layer: u32,
    /// Where the blade's tip runs, in the x-z plane.
    pub tip: Point2,
    /// The swings of its flanks.
    pub swings: Swings,
    /// How the tip came to be where it is.
    pub origin: TipOrigin,
    /// How the blade gets from the cut left of it in the same layer to it, or back; over the safe plane if there is none.
    pub way: Way,
}

impl PlannedCut {
    /// What it cuts.
    #[must_use]
    pub fn vee(&self) -> Vee {
        self.swings.vee(self.tip)
    }
}

/// The way between two neighbouring cuts of a layer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// Beside the work at working height.
    Beside,
    /// Over the safe plane: material in between stands so high that the leaning blade would meet it.
    Over,
}

/// What is reported of parameters that were compared as plans.
pub const PARAMETERS: &str = "parameters";

/// Most older corners that all flanks of an operation together may pass under while they are measured, which bounds the
/// planner's work: at large overlaps every flank passes many.
const MOST_PASSED: f64 = 2e8;

/// An operation laid out.
#[derive(Clone, Debug)]
pub struct LaidOut {
    /// The operation, cut in rows.
    pub vcut: PlannedVcut,
    /// What it leaves of the stock.
    pub after: Surface,
    /// Whether another residual strategy would have given other cuts.
    pub strategies: Strategies,
}

/// The work as an operation finds it.
#[derive(Clone, Copy, Debug)]
pub struct Work<'w> {
    /// What the operations before it left of the stock.
    pub before: &'w Surface,
    /// The part with the operation's allowance.
    pub bound: &'w Profile,
    /// Most cuts that it may have.
    pub cuts_left: usize,
}

/// Lays out the cuts of an operation with these parameters on what those before left. A residual strategy that it leaves open
/// is taken as `mixed`: where there is a choice, give the operation with the choice made.
///
/// # Errors
/// What keeps the operation from being cut at all.
pub fn lay_out(
    job: &PlanningJob<'_>,
    asked: &RoughVcut,
    parameters: VcutParameters,
    work: Work<'_>,
) -> Result<LaidOut, Box<Refused>> {
    let Work {
        before,
        bound,
        cuts_left,
    } = work;
    let clearance = cone::clearance(bound, parameters.flanks.slope);
    // Level cuts lie within the stock anyhow.
    let clearance = match asked.along {
        None => clearance,
        Some(_) => clearance.not_below(parameters.lowest - parameters.drop),
    };
    let layout = lattice::Layout::new(job.stock, parameters.lattice, &parameters, &clearance);
    if let Some(tips) = &asked.tips {
        if tips.tips.len() > cuts_left || given::passed_corners(tips, &parameters) > MOST_PASSED {
            return Err(Box::new(given::too_many(tips).into()));
        }
        let ground = Ground {
            layout: &layout,
            parameters: &parameters,
            bound,
        };
        return lay_out_given(job, asked, tips, before, ground);
    }
    if layout.most_tips() > cuts_left || passed_corners(&layout, &parameters) > MOST_PASSED {
        return Err(Box::new(too_many_cuts(asked, &parameters, layout.most_tips())));
    }
    let ground = Ground {
        layout: &layout,
        parameters: &parameters,
        bound,
    };
    if parameters.lattice == Lattice::Fitted {
        return lay_out_fitted(job, asked, before, ground, cuts_left);
    }
    let strategy = asked.residual.value.or(Residual::Mixed);
    let mut after = before.clone();
    let planner = residual::LayerPlanner::new(ground, asked, strategy, job, &mut after);
    let mut decided = plan_layers(planner, &layout, cuts_left);
    if decided.as_ref().is_ok_and(|(cuts, _)| cuts.is_empty()) && strategy == Residual::Mixed {
        // Where all there is to cut is less than what may stay, `mixed` takes it rather than nothing.
        let planner = residual::LayerPlanner::new(ground, asked, strategy, job, &mut after);
        decided = plan_layers(planner.thorough(), &layout, cuts_left);
    }
    let (cuts, strategies) = match decided {
        Ok((cuts, _)) if cuts.is_empty() => {
            return Err(Box::new(nothing_to_cut(job, asked, &parameters, &clearance)));
        }
        Ok(decided) => decided,
        Err(count) => return Err(Box::new(too_many_cuts(asked, &parameters, count))),
    };
    let vcut = PlannedVcut {
        strategy,
        cuts,
        ..unplanned(job, asked, ground)
    };
    Ok(vcut.in_rows(before, job.stock, after, strategies))
}

/// What is known of an operation before its cuts are.
#[derive(Clone, Copy, Debug)]
pub struct Ground<'g> {
    /// Where its tips may lie.
    pub layout: &'g lattice::Layout<'g>,
    /// What is decided.
    pub parameters: &'g VcutParameters,
    /// The part with its allowance.
    pub bound: &'g Profile,
}

/// An operation without cuts.
fn unplanned(job: &PlanningJob<'_>, asked: &RoughVcut, ground: Ground<'_>) -> PlannedVcut {
    let parameters = ground.parameters;
    PlannedVcut {
        asked: asked.clone(),
        parameters: parameters.clone(),
        strategy: Residual::Discard,
        order: asked.order.value.or(Order::Point),
        sequence: Sequence::Rows,
        bound: ground.bound.clone(),
        estimate: parameters.estimate(job, asked),
        estimated_cuts: parameters.estimated_cuts(job, asked),
        cuts: Vec::new(),
        skipped: 0,
        course: None,
        runs: Vec::new(),
        compensation: None,
        decisions: Vec::new(),
        searched: None,
    }
}

/// As [`lay_out`], where the job gives the tips.
fn lay_out_given(
    job: &PlanningJob<'_>,
    asked: &RoughVcut,
    tips: &Tips,
    before: &Surface,
    ground: Ground<'_>,
) -> Result<LaidOut, Box<Refused>> {
    if let Some(refused) = given::in_the_part(job, tips, ground.layout) {
        return Err(Box::new(refused.into()));
    }
    let mut after = before.clone();
    let (cuts, course) = given::cuts(tips, ground.parameters, &mut after);
    if cuts.is_empty() {
        return Err(Box::new(given::nothing_to_cut(job, tips).into()));
    }
    let vcut = PlannedVcut {
        cuts,
        course: Some(course),
        ..unplanned(job, asked, ground)
    };
    Ok(vcut.in_rows(before, job.stock, after, Strategies::Alike))
}

/// As [`lay_out`], with tips fitted to the part.
fn lay_out_fitted(
    job: &PlanningJob<'_>,
    asked: &RoughVcut,
    before: &Surface,
    ground: Ground<'_>,
    cuts_left: usize,
) -> Result<LaidOut, Box<Refused>> {
    let parameters = ground.parameters;
    let clearance = ground.layout.clearance();
    let mut fitting = Fitting::new(job, asked, parameters, clearance, before, cuts_left).laxer();
    let rows = match fitting.rows(parameters) {
        Ok(rows) => rows,
        Err(Unfit::TooMany(count)) => return Err(Box::new(too_many_cuts(asked, parameters, count))),
        Err(Unfit::LeavesMore) => Vec::new(),
    };
    let mut after = before.clone();
    let regular = |tip: Point2| PlannedCut {
        layer: 0,
        tip,
        swings: Swings::even(parameters.swing),
        origin: TipOrigin::Lattice,
        way: Way::Over,
    };
    let (count, widest) = (rows.len(), fitting.widest_step_of(parameters.step));
    let layers = rows.into_iter().map(|row| row.into_iter().map(regular).collect());
    let cuts = chip::in_layers(parameters, layers.collect(), &mut after);
    if cuts.is_empty() {
        return Err(Box::new(nothing_to_cut(job, asked, parameters, clearance)));
    }
    let mut vcut = PlannedVcut {
        strategy: Residual::Mixed,
        estimate: parameters.time_of(job, asked, cuts.len(), count),
        estimated_cuts: cuts.len() as f64,
        cuts,
        ..unplanned(job, asked, ground)
    };
    if asked.step.value == Auto::Auto {
        vcut.parameters.step = parameters.step.min(widest);
    }
    Ok(vcut.in_rows(before, job.stock, after, Strategies::Alike))
}

impl PlannedVcut {
    /// Whether plans that were simulated decided the parameters, rather than formulas alone.
    #[must_use]
    pub fn is_found_by_simulation(&self) -> bool {
        self.decisions.iter().any(|decision| decision.field == PARAMETERS)
    }

    /// The plan with level cuts, where all sections along its spine are alike, and where each of them stands for a chain along a column. The
    /// cuts of a fan are chains of one piece.
    #[must_use]
    pub fn level(&self) -> Cow<'_, Self> {
        if self.spine().is_none() && self.columns().is_none_or(Columns::is_fan) {
            return Cow::Borrowed(self);
        }
        let mut level = self.clone();
        level.asked.along = None;
        Cow::Owned(level)
    }

    /// The spine of its cuts, if they follow one.
    #[must_use]
    pub fn spine(&self) -> Option<&Spine> {
        self.asked.along.as_ref()?.guide.spine()
    }

    /// The columns of its cuts, if they follow such.
    #[must_use]
    pub fn columns(&self) -> Option<&Columns> {
        self.asked.along.as_ref()?.guide.columns()
    }

    /// What becomes of its redundant Vs.
    #[must_use]
    pub const fn redundant(&self) -> Redundant {
        match self.asked.redundant.value {
            Auto::Given(redundant) => redundant,
            Auto::Auto if self.skipped > 0 => Redundant::Skip,
            Auto::Auto => Redundant::Keep,
        }
    }

    /// How many Vs it had before redundant ones were skipped.
    #[must_use]
    pub const fn laid_out(&self) -> usize {
        self.cuts.len() + self.skipped
    }

    /// The swings of the Vs that have narrower flanks than the others.
    pub fn narrowed(&self) -> impl Iterator<Item = Swings> + '_ {
        let regular = Swings::even(self.parameters.swing);
        let swings = self.cuts.iter().map(|cut| cut.swings);
        swings.filter(move |swings| *swings != regular)
    }

    /// The operation cut in rows, on what was there before, with what it leaves.
    fn in_rows(self, before: &Surface, stock: Stock, after: Surface, strategies: Strategies) -> LaidOut {
        let order = self.order;
        LaidOut {
            vcut: self.along(order, Sequence::Rows, before, stock),
            after,
            strategies,
        }
    }

    /// The same cuts in another order. Given tips keep their sequence.
    #[must_use]
    pub fn along(mut self, order: Order, sequence: Sequence, before: &Surface, stock: Stock) -> Self {
        let terrain = route::Terrain {
            cuts: &self.cuts,
            before,
            parameters: &self.parameters,
            safe: (stock.height + self.asked.setup.clearance.value).to_mm(),
        };
        self.runs = match &self.course {
            Some(course) => route::as_given(terrain, &course.headings, order),
            None => route::route(terrain, sequence, order),
        };
        self.order = order;
        self.sequence = sequence;
        self
    }
}

/// The cuts of all layers, or how many there were when there were too many.
fn plan_layers(
    mut planner: residual::LayerPlanner<'_>,
    layout: &lattice::Layout<'_>,
    cuts_left: usize,
) -> Result<(Vec<PlannedCut>, Strategies), usize> {
    for layer in 1..=layout.layers() {
        planner.layer(layer);
        if planner.count() > cuts_left {
            return Err(planner.count());
        }
    }
    Ok(planner.finish())
}

/// About how many corners the flanks of an operation pass under, and free lattices look at.
fn passed_corners(layout: &lattice::Layout<'_>, parameters: &VcutParameters) -> f64 {
    let flanks = &parameters.flanks;
    let by_flank = 2.0 * flanks.reach.to_mm() / (flanks.slope * parameters.step.to_mm());
    let per_layer = layout.corners_per_layer();
    layout.most_tips() as f64 * (1.0 + by_flank) + f64::from(layout.layers()) * per_layer as f64
}

/// Smallest gain in depth for which a tip is moved: cuts that take less are not worth their time. A twentieth of a layer is a
/// judgement, from no source.
#[must_use]
pub fn smallest_gain(layer: Length) -> Length {
    layer * 0.05
}
