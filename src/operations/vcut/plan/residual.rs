//! Which tips are cut: the lattice's own where they clear the part, and what the residual strategy makes of the others
//! (`docs/process.md`, "Tips at the part and residual strategies").
//!
//! A layer is decided as a whole against the surface that the layers above left, whatever the order in which its cuts
//! will be made: cutting a neighbour first only lowers the surface, so a flank then comes out no later.
//!
//! With `mixed`, a tip that would cut the part is dropped where leaving its material keeps the residual within the limit;
//! otherwise it is raised, or if its chip would not come free there, moved sideways [Yu 2019]. Dropped tips make the material
//! beside them stand higher than the lattice assumes, so that a regular tip near a steep part may find its flank too
//! long: `mixed` then raises it by as little as frees its chip, and the layers below follow as far as the blade reaches.
//!
//! With `avoid = swing`, a V that does not fit is cut with narrower flanks where all this leaves too much ([`narrowed`]).

mod narrowed;

use super::avoid::{Avoidance, Swings};
use super::chip::{Chip, way};
use super::lattice::{Column, Layout, Parity, Row};
use super::parameters::VcutParameters;
use super::{Ground, PlannedCut, TipOrigin, Way, smallest_gain};
use crate::asked::{Residual, RoughVcut};
use narrowed::Unfit;
use vcutc_backend_api::units::Length;
use vcutc_geometry::curve::Point2;
use vcutc_geometry::grid;
use vcutc_geometry::profile::Profile;
use vcutc_job::PlanningJob;
use vcutc_simulation::surface::{Surface, Vee};

/// A tip of the lattice that would cut the part.
#[derive(Clone, Copy)]
struct Candidate {
    column: Column,
    z: f64,
    /// Where the tips left and right of it lie, as far as is known.
    neighbours: [Option<f64>; 2],
}

/// Whether it matters what becomes of tips that would cut the part.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Strategies {
    /// There are none, and all strategies come to the same cuts.
    Alike,
    Differing,
}

/// Smallest gain in depth for which `mixed` puts a tip onto the part: it does so only where more would stay than may, so under
/// a limit that is finer than the layer it asks for less than is worth a cut otherwise.
#[must_use]
pub fn least_gain(asked: &RoughVcut, layer: Length) -> Length {
    let worth = smallest_gain(layer);
    let limit = asked.limits.scallop;
    limit.map_or(worth, |limit| worth.min(limit.value * GAIN_OF_LIMIT))
}

/// As a share of the limit on scallop: a judgement, from no source.
const GAIN_OF_LIMIT: f64 = 0.02;

/// Decides one layer after the other.
pub struct LayerPlanner<'p> {
    layout: &'p Layout<'p>,
    strategy: Residual,
    parameters: &'p VcutParameters,
    part: &'p Profile,
    surface: &'p mut Surface,
    /// How flanks are narrowed, where the operation asks for it.
    avoidance: Option<Avoidance<'p>>,
    /// Residual that `mixed` leaves standing.
    tolerated: f64,
    smallest_gain: f64,
    /// Smallest gain in depth for which a tip is raised or moved onto the part.
    least_gain: f64,
    /// Whether flanks that do not come out are to be fixed by raising their tips. Not where the lattice as a
    /// whole needs more than the blade has: the user has to fix that.
    relieves: bool,
    /// Columns that are done with, by parity.
    closed: [Vec<bool>; 2],
    cuts: Vec<PlannedCut>,
    layers_cut: u32,
    /// Whether any tip was anything but a lattice point that comes free.
    matters: Strategies,
}

impl<'p> LayerPlanner<'p> {
    /// For one operation on the surface left by those before.
    #[must_use]
    pub fn new(
        ground: Ground<'p>,
        asked: &RoughVcut,
        strategy: Residual,
        job: &'p PlanningJob<'_>,
        surface: &'p mut Surface,
    ) -> Self {
        let Ground {
            layout,
            parameters,
            bound,
        } = ground;
        let inherent = parameters.scallop_bound(asked);
        let tolerated = asked.limits.scallop.map_or(inherent, |limit| limit.value);
        let relieves = strategy == Residual::Mixed && parameters.lattice_fits();
        Self {
            layout,
            strategy,
            parameters,
            part: &job.profile,
            surface,
            avoidance: Avoidance::of(asked, parameters, bound, job.stock),
            tolerated: tolerated.to_mm(),
            smallest_gain: smallest_gain(parameters.layer).to_mm(),
            least_gain: match strategy {
                Residual::Mixed => least_gain(asked, parameters.layer),
                Residual::Discard | Residual::Lift | Residual::Shift => smallest_gain(parameters.layer),
            }
            .to_mm(),
            relieves,
            closed: [Vec::new(), Vec::new()],
            cuts: Vec::new(),
            layers_cut: 0,
            matters: Strategies::Alike,
        }
    }

    /// The same, but `mixed` leaves nothing standing that a raised or moved tip could take.
    #[must_use]
    pub const fn thorough(mut self) -> Self {
        self.tolerated = 0.0;
        self
    }

    /// Decides a layer and takes its chips out.
    pub fn layer(&mut self, layer: u32) {
        let z = self.layout.height(layer);
        let mut tips: Vec<(Point2, TipOrigin)> = Vec::new();
        let mut unfit: Vec<Unfit> = Vec::new();
        let layout = self.layout;
        match layout.row(layer) {
            Row::Free(free) => {
                for tip in free {
                    let decided = self.reachable(tip, TipOrigin::Lattice);
                    self.decide(tip, decided, &mut tips, &mut unfit);
                }
            }
            Row::Columns { parity, columns } => {
                self.closed[parity as usize].resize(columns.len(), false);
                for (index, &column) in columns.iter().enumerate() {
                    let decided = if column.floor <= z {
                        self.reachable(Point2 { x: column.x, z }, TipOrigin::Lattice)
                    } else {
                        // The tip kept last, and the next column, whose own tip may be kept.
                        let neighbours = [
                            tips.last().map(|&(tip, _)| tip.x),
                            columns.get(index + 1).map(|next| next.x),
                        ];
                        self.false_tip(
                            parity,
                            index,
                            Candidate {
                                column,
                                z,
                                neighbours,
                            },
                        )
                    };
                    let tip = Point2 { x: column.x, z };
                    self.decide(tip, decided, &mut tips, &mut unfit);
                }
            }
        }
        self.take(tips);
        self.narrow(unfit);
    }

    /// Puts a tip of a layer where it is cut: with what was decided, or where that does not do with those that do not fit.
    fn decide(
        &mut self,
        tip: Point2,
        decided: Option<(Point2, TipOrigin)>,
        tips: &mut Vec<(Point2, TipOrigin)>,
        unfit: &mut Vec<Unfit>,
    ) {
        match decided {
            Some((at, TipOrigin::Lattice)) if self.fits(at) => tips.push((at, TipOrigin::Lattice)),
            decided => match self.unfit(tip, decided) {
                Ok(one) => unfit.push(one),
                Err(decided) => tips.extend(decided),
            },
        }
    }

    /// How many cuts have been decided so far.
    #[must_use]
    pub const fn count(&self) -> usize {
        self.cuts.len()
    }

    /// The cuts decided, and whether another strategy would have decided otherwise.
    #[must_use]
    pub fn finish(self) -> (Vec<PlannedCut>, Strategies) {
        (self.cuts, self.matters)
    }

    fn take(&mut self, tips: Vec<(Point2, TipOrigin)>) {
        if tips.is_empty() {
            return;
        }
        self.layers_cut += 1;
        let mut before: Option<Point2> = None;
        for &(tip, origin) in &tips {
            let way = before.map_or(Way::Over, |before| {
                way(self.parameters, self.surface, before, tip)
            });
            self.cuts.push(PlannedCut {
                layer: self.layers_cut,
                tip,
                swings: Swings::even(self.parameters.swing),
                origin,
                way,
            });
            before = Some(tip);
        }
        for (tip, _) in tips {
            self.surface.release(self.vee(tip));
        }
    }

    /// A tip whose V would enter the part.
    fn false_tip(
        &mut self,
        parity: Parity,
        index: usize,
        candidate: Candidate,
    ) -> Option<(Point2, TipOrigin)> {
        self.matters = Strategies::Differing;
        let column = candidate.column;
        match self.strategy {
            Residual::Discard => None,
            Residual::Lift => self.lifted(column),
            Residual::Shift => self.shifted(candidate),
            Residual::Mixed => {
                let closed = self.closed[parity as usize].get_mut(index)?;
                if *closed {
                    return None;
                }
                if self.residual_around(column.x) <= self.tolerated {
                    self.closed[parity as usize][index] = true;
                    return None;
                }
                let lifted = self.lifted(column).filter(|&(tip, _)| self.comes_free(tip));
                let shifted = |planner: &mut Self| {
                    planner
                        .shifted(candidate)
                        .filter(|&(tip, _)| planner.comes_free(tip))
                };
                lifted.or_else(|| shifted(self)).or_else(|| {
                    self.relieved(Point2 {
                        x: column.x,
                        z: column.floor,
                    })
                })
            }
        }
    }

    /// Raised onto the part, where that still cuts something.
    fn lifted(&mut self, column: Column) -> Option<(Point2, TipOrigin)> {
        let tip = Point2 {
            x: column.x,
            z: column.floor,
        };
        self.gains(tip).then_some((tip, TipOrigin::Lifted))
    }

    /// Moved sideways onto the part, where no other tip of the row is near.
    fn shifted(&mut self, candidate: Candidate) -> Option<(Point2, TipOrigin)> {
        let Candidate {
            column,
            z,
            neighbours: [left, right],
        } = candidate;
        let step = self.layout.step();
        let x = grid::nearest(self.layout.nearest_clear(column.x, z)?);
        let tip = Point2 {
            x,
            z: z.max(self.layout.floor(x)),
        };
        // Tips nearer than a quarter step cut slivers; the share is a judgement, from no source.
        let least = step / 4.0;
        let crowded =
            left.is_some_and(|left| x < left + least) || right.is_some_and(|right| x > right - least);
        let near = (x - column.x).abs() < step;
        (near && !crowded && self.gains(tip)).then_some((tip, TipOrigin::Shifted))
    }

    /// A tip that clears the part, as it is or raised until its chip comes free.
    fn reachable(&mut self, tip: Point2, origin: TipOrigin) -> Option<(Point2, TipOrigin)> {
        if !self.surface.covers(tip) {
            return None;
        }
        if !self.relieves || self.comes_free(tip) {
            return Some((tip, origin));
        }
        self.matters = Strategies::Differing;
        self.relieved(tip)
    }

    /// Raised by as little as frees the chip.
    fn relieved(&mut self, wanted: Point2) -> Option<(Point2, TipOrigin)> {
        let highest = grid::down(self.surface.height(wanted.x) - self.smallest_gain);
        let at = |z: f64| Point2 { x: wanted.x, z };
        if !self.relieves || highest <= wanted.z || !self.comes_free(at(highest)) {
            return None;
        }
        // The reach a flank needs falls as its tip rises, so the lowest tip that comes free is found by halving.
        let (mut bound, mut free) = (wanted.z, highest);
        while free - bound > grid::SPACING * 1.5 {
            let middle = grid::nearest((free + bound) / 2.0);
            if self.comes_free(at(middle)) {
                free = middle;
            } else {
                bound = middle;
            }
        }
        Some((at(free), TipOrigin::Relieved))
    }

    /// Whether a chip comes free, with room for a stated body where flanks may be narrower: elsewhere the proof looks at that.
    fn comes_free(&mut self, tip: Point2) -> bool {
        let avoidance = self.avoidance.as_ref();
        Chip::of(self.parameters, tip).comes_free(self.surface)
            && avoidance.is_none_or(|avoidance| avoidance.bodies_clear(tip, self.surface))
    }

    fn gains(&mut self, tip: Point2) -> bool {
        self.surface.height(tip.x) - tip.z >= self.least_gain
    }

    /// The most material standing on the part about x, along the part's normal: within half a step, for the flanks of the next
    /// tips take what is beyond. Where those may be narrower, within a step.
    fn residual_around(&mut self, x: f64) -> f64 {
        let within = match self.avoidance {
            None => self.layout.step() / 2.0,
            Some(_) => self.layout.step(),
        };
        let (from, to) = self.part.span();
        let (from, to) = ((x - within).max(from), (x + within).min(to));
        let ends = [from, to].map(|end| Point2 {
            x: end,
            z: self.surface.height(end),
        });
        let part = self.part;
        let inner = self
            .surface
            .corners_between(from, to)
            .map(|corner| part.nearest_distance(corner));
        inner
            .chain(ends.map(|end| part.nearest_distance(end)))
            .fold(0.0, f64::max)
    }

    const fn vee(&self, tip: Point2) -> Vee {
        Vee::even(tip, self.parameters.flanks.slope)
    }
}
