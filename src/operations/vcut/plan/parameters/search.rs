//! The open parameters by optimisation: the problem that a job poses, and its optimum on the grid.

use super::super::blade_reach;
use super::super::optimum::{self, Bound, Extension, Optimum, Problem, Range, Refused, Work};
use super::grid_forms::{fits, tips_per_step, widest_step};
use super::{Refusal, edge_overhang, flanks_at};
use crate::asked::{Formulas, Lattice, Objective, RoughVcut};
use vcutc_backend_api::units::{Angle, Length};
use vcutc_geometry::grid;
use vcutc_job::{Auto, Bounds, PlanningJob};

/// Swings to choose from where there is no limit: flatter and steeper Vs are not cuts.
const OPEN_SWINGS: Range<Angle> = Range {
    least: Angle::deg(1.0),
    most: Angle::deg(89.0),
};

/// Overlaps to choose from: neighbouring Vs meet, and each takes a twentieth of its width at least.
const OPEN_OVERLAPS: Range<f64> = Range {
    least: 0.0,
    most: 0.95,
};

/// Swings are chosen to a thousandth of a degree.
const SWINGS_PER_DEG: f64 = 1000.0;

/// How often the distance of swings from the optimum is doubled: up to a quarter of a degree.
const MOST_DOUBLINGS: u32 = 9;

/// How many grid spacings from the optimum every layer is looked at for one that keeps all limits after rounding.
const MOST_SPACINGS: i32 = 200;

/// Farther down layers are looked at whose distance from it grows by this factor.
const FARTHER: f64 = 1.05;

/// As many of them: as far as a metre.
const MOST_FARTHER: u32 = 175;

/// What was chosen, on the grid.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Chosen {
    pub(super) lattice: Lattice,
    pub(super) swing: Angle,
    pub(super) layer: Length,
    pub(super) step: Length,
    pub(super) overlap: f64,
    /// Bounds on open parameters that the optimum touches.
    pub(super) binding: Vec<Bound>,
}

/// The lattices to choose from. The formulas of the paper are those of the orthogonal one.
pub(super) fn lattices(asked: &RoughVcut) -> Vec<Lattice> {
    match (asked.lattice.value, asked.formulas.value) {
        (Auto::Given(lattice), Formulas::Paper | Formulas::Exact) => vec![lattice],
        (Auto::Auto, Formulas::Paper) => vec![Lattice::Orthogonal],
        // What interlaced lattices are good for, flanks that just pass older tips, a spine does not leave them.
        (Auto::Auto, Formulas::Exact) if asked.along.is_some() => vec![Lattice::Orthogonal, Lattice::Free],
        (Auto::Auto, Formulas::Exact) => vec![Lattice::Orthogonal, Lattice::Interlaced, Lattice::Free],
    }
}

/// The swings to choose from.
fn open_swings(asked: &RoughVcut) -> Range<Angle> {
    match asked.swing.value {
        Auto::Given(swing) => point(swing),
        Auto::Auto => within(asked.limits.swing, OPEN_SWINGS),
    }
}

/// The widest swing to choose from.
pub fn widest_swing(asked: &RoughVcut) -> Angle {
    open_swings(asked).most
}

/// The problem that a job poses for one of its operations. The rake is above the half apex angle.
pub(super) fn problem(
    job: &PlanningJob<'_>,
    asked: &RoughVcut,
    lattices: Vec<Lattice>,
    standoff: Length,
) -> Problem {
    let stock = job.stock;
    let depth = stock.height - Length::mm(job.profile.lowest().z) - asked.allowance.value - standoff;
    // Where nothing is left to cut, the planner says so; the choice only must not fail before.
    let deepest = if depth > Length::ZERO { depth } else { stock.height };
    let least = Length::mm(grid::SPACING);
    let swing = open_swings(asked);
    let open = |value: Auto<Length>, bounds: Bounds<Length>, most: Length| match value {
        Auto::Given(value) => point(value),
        Auto::Auto => within(
            bounds,
            Range {
                least,
                most: most.max(least),
            },
        ),
    };
    // A given step decides the overlap.
    let overlap = match (asked.step.value, asked.overlap.value) {
        (Auto::Auto, Auto::Given(overlap)) => point(overlap),
        (Auto::Auto, Auto::Auto) | (Auto::Given(_), _) => OPEN_OVERLAPS,
    };
    Problem {
        objective: asked.objective.value,
        formulas: asked.formulas.value,
        lattices,
        work: work(job, asked, swing, standoff),
        swing,
        layer: open(asked.layer.value, asked.limits.layer, deepest),
        step: open(asked.step.value, asked.limits.step, stock.width),
        overlap,
        scallop: asked.limits.scallop.map(|limit| limit.value),
        edge: asked.limits.edge.map(|limit| limit.value),
        time: asked.limits.time.map(|limit| limit.value),
        cuts: asked.limits.cuts.map(|limit| limit.value),
    }
}

fn work(job: &PlanningJob<'_>, asked: &RoughVcut, swing: Range<Angle>, standoff: Length) -> Work {
    let stock = job.stock;
    let extension = match (asked.setup.extension().value, asked.formulas.value) {
        (Auto::Given(extension), Formulas::Paper | Formulas::Exact) => Extension::Fixed(extension),
        (Auto::Auto, Formulas::Paper) => Extension::EdgeInUse,
        (Auto::Auto, Formulas::Exact) => Extension::Leaning {
            edge: widest_overhang(asked, swing),
            run_out: asked.setup.run_out.value,
        },
    };
    Work {
        width: stock.width,
        depth: stock.depth,
        area: job.area_to_remove(),
        clearance: asked.setup.clearance.value,
        cutting_length: asked.blade.cutting_length.value - edge_along_a_spine(asked, swing.most),
        half_apex: asked.blade.half_apex.value,
        rake: asked.setup.rake.value,
        allowance: asked.allowance.value,
        standoff,
        extension,
        cut_feed: asked.setup.cut_feed.value,
        travel_feed: asked.setup.travel_feed.value,
        reorient_rate: asked.setup.reorient_rate.value,
    }
}

/// The edge that flanks may need on top because they follow a spine, at a swing.
fn edge_along_a_spine(asked: &RoughVcut, swing: Angle) -> Length {
    let flanks = flanks_at(asked, swing);
    (flanks.lower * flanks.edge_per_reach).min(asked.blade.cutting_length.value / 2.0)
}

/// How far the edge lies over the work at either end of some swings.
fn widest_overhang(asked: &RoughVcut, swing: Range<Angle>) -> Length {
    let least = edge_overhang(asked, swing.least);
    if swing.least == swing.most {
        least
    } else {
        least.max(edge_overhang(asked, swing.most))
    }
}

const fn point<T: Copy>(value: T) -> Range<T> {
    Range {
        least: value,
        most: value,
    }
}

/// The range that limits leave. A limit beyond what is looked at otherwise takes its place.
fn within<T: Copy + PartialOrd>(bounds: Bounds<T>, open: Range<T>) -> Range<T> {
    let least = bounds.least.map(|limit| limit.value);
    let most = bounds.most.map(|limit| limit.value);
    let least_or_open = least.unwrap_or(open.least);
    let most_or_open = most.unwrap_or(open.most);
    Range {
        least: if least.is_none() && open.least > most_or_open {
            most_or_open
        } else {
            least_or_open
        },
        most: if most.is_none() && open.most < least_or_open {
            least_or_open
        } else {
            most_or_open
        },
    }
}

/// The best parameters on the grid.
pub(super) fn choose(
    job: &PlanningJob<'_>,
    asked: &RoughVcut,
    lattices: Vec<Lattice>,
    standoff: Length,
) -> Result<Chosen, Refusal> {
    let problem = problem(job, asked, lattices, standoff);
    let best = match optimum::best(&problem) {
        Ok(best) => best,
        Err(Refused::Conflict) => return Err(Refusal::Conflict(Box::new(problem))),
        Err(Refused::Unbounded) => return Err(Refusal::Unbounded),
    };
    let rounding = Rounding {
        asked,
        problem: &problem,
        best: &best,
    };
    let measure = |found: &Optimum| found.value(problem.objective);
    let (swing, (layer, step, _)) = (0..=MOST_DOUBLINGS)
        .find_map(|doublings| {
            let near = swings(asked, &problem, &best, doublings);
            near.into_iter()
                .filter_map(|swing| Some((swing, rounding.at(swing)?)))
                .min_by(|(_, (.., one)), (_, (.., two))| measure(one).total_cmp(&measure(two)))
        })
        .ok_or(Refusal::OffGrid)?;
    Ok(Chosen {
        lattice: best.lattice,
        // Not that of the optimum, which went by way of its tangent and back.
        swing,
        layer,
        step,
        overlap: rounding.overlap(),
        binding: best
            .binding
            .into_iter()
            .filter(|bound| is_open(asked, *bound))
            .collect(),
    })
}

/// Whether a bound limits what was open. A given value needs no message.
const fn is_open(asked: &RoughVcut, bound: Bound) -> bool {
    const fn open<T>(value: &Auto<T>) -> bool {
        matches!(value, Auto::Auto)
    }
    match bound {
        Bound::SwingLeast | Bound::SwingMost => open(&asked.swing.value),
        Bound::LayerLeast | Bound::LayerMost => open(&asked.layer.value),
        Bound::StepLeast | Bound::StepMost => open(&asked.step.value),
        Bound::OverlapLeast | Bound::OverlapMost => open(&asked.step.value) && open(&asked.overlap.value),
        Bound::Scallop | Bound::Edge | Bound::Time | Bound::Cuts => true,
    }
}

/// The swings next to the optimum that can be said, within the limits; a given one as it is. Where none of these do,
/// because a layer and step that touch several bounds have nowhere to be rounded to, others a little farther off, at a
/// distance that doubles.
fn swings(asked: &RoughVcut, problem: &Problem, best: &Optimum, doublings: u32) -> Vec<Angle> {
    if let Auto::Given(swing) = asked.swing.value {
        return if doublings == 0 { vec![swing] } else { Vec::new() };
    }
    let Range { least, most } = problem.swing;
    let thousandths = best.swing.to_deg() * SWINGS_PER_DEG;
    let off = if doublings == 0 {
        0.0
    } else {
        f64::from(1_u32 << (doublings - 1))
    };
    let near = [thousandths.floor() - off, thousandths.ceil() + off]
        .map(|count| Angle::deg(count / SWINGS_PER_DEG))
        .into_iter()
        .filter(|swing| *swing >= least && *swing <= most);
    // A limit that the optimum touches is taken as it is written.
    let touched = [least, most]
        .into_iter()
        .filter(|end| doublings == 0 && (*end - best.swing).to_deg().abs() < 1e-6);
    near.chain(touched).collect()
}

/// The way from the optimum to the grid.
struct Rounding<'r> {
    asked: &'r RoughVcut,
    problem: &'r Problem,
    best: &'r Optimum,
}

impl Rounding<'_> {
    /// The overlap by which an open step follows from the layer.
    fn overlap(&self) -> f64 {
        match (self.asked.step.value, self.asked.overlap.value) {
            (Auto::Auto, Auto::Given(overlap)) => overlap,
            (Auto::Auto, Auto::Auto) | (Auto::Given(_), _) => {
                self.best.overlap.clamp(0.0, OPEN_OVERLAPS.most)
            }
        }
    }

    /// The layer and step next to the optimum, at a swing, that keep all limits on the grid, and what they come to.
    fn at(&self, swing: Angle) -> Option<(Length, Length, Optimum)> {
        let flanks = flanks_at(self.asked, swing);
        let keeps = |layer: Length| {
            let step = self.step(layer, &flanks);
            // Neighbouring Vs meet, but for what rounding takes.
            let unit = Length::mm(grid::SPACING * tips_per_step(self.best.lattice));
            let meet = step <= layer * (2.0 / flanks.slope) + unit;
            if !meet || !fits(self.best.lattice, layer, step, &flanks) {
                return None;
            }
            let found = optimum::any(&self.pinned(swing, layer, step))?;
            Some((layer, step, found))
        };
        if let Auto::Given(layer) = self.asked.layer.value {
            return keeps(layer);
        }
        let best = self.best.layer.to_mm();
        let reach = blade_reach::largest_layer(self.best.lattice, self.overlap(), flanks.reach_in_lattice());
        let (down, up) = match self.asked.step.value {
            // The paper's formulas may promise more than the blade reaches on this lattice.
            Auto::Auto => (best.min(reach.to_mm()), best.min(reach.to_mm())),
            Auto::Given(_) => (best, best),
        };
        let spaced = |start: f64, count: i32| Length::mm(start + f64::from(count) * grid::SPACING);
        let downwards = (0..MOST_SPACINGS).map(|count| spaced(grid::up(down), 1 - count));
        let upwards = (0..MOST_SPACINGS).map(|count| spaced(grid::down(up), count - 1));
        let tried: Vec<Length> = match self.problem.objective {
            Objective::Time | Objective::Cuts => downwards.chain(upwards).collect(),
            Objective::Scallop | Objective::BladeLoad => upwards.chain(downwards).collect(),
        };
        let farther = (1..=MOST_FARTHER).scan(f64::from(MOST_SPACINGS), |distance, _| {
            *distance *= FARTHER;
            Some(Length::mm(grid::up(down) - *distance * grid::SPACING))
        });
        tried
            .into_iter()
            .chain(farther)
            .map(|layer| Length::mm(grid::nearest(layer.to_mm())))
            .filter(|layer| *layer > Length::ZERO)
            .filter(|layer| *layer >= self.problem.layer.least && *layer <= self.problem.layer.most)
            .find_map(keeps)
    }

    /// The step that goes with a layer.
    fn step(&self, layer: Length, flanks: &blade_reach::Flanks) -> Length {
        match self.asked.step.value {
            Auto::Given(step) => step,
            Auto::Auto => {
                let widest = widest_step(self.best.lattice, layer, self.overlap(), flanks);
                let Range { least, most } = self.problem.step;
                let unit = tips_per_step(self.best.lattice);
                // Half a step of an interlaced lattice lies on the grid too.
                let up = Length::mm(grid::up(least.to_mm() / unit) * unit);
                let down = Length::mm(grid::down(most.to_mm() / unit) * unit);
                widest.max(up).min(down)
            }
        }
    }

    /// The problem with these parameters as the only ones: whether they keep the limits, and what they come to.
    fn pinned(&self, swing: Angle, layer: Length, step: Length) -> Problem {
        let overlap = 1.0 - step.to_mm() / (2.0 * layer.to_mm() * swing.tan());
        Problem {
            lattices: vec![self.best.lattice],
            swing: point(swing),
            layer: point(layer),
            step: point(step),
            overlap: Range {
                least: overlap - 1e-6,
                most: overlap + 1e-6,
            },
            ..self.problem.clone()
        }
    }
}
