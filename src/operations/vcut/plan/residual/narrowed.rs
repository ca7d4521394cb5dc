//! Vs that are cut with narrower flanks, layer by layer ([`super::super::avoid`]).
//!
//! They come after the regular Vs of their layer, as layers of their own, because what they leave stands steeper than other
//! flanks rise. Within such a layer any order will do, as elsewhere: a V waits for the next one where another of the same layer
//! would leave a wall in the way of one of its flanks. The widest come first.

use super::super::avoid::Swings;
use super::super::{PlannedCut, TipOrigin, Way};
use super::LayerPlanner;
use vcutc_geometry::curve::Point2;
use vcutc_simulation::surface::{Side, Vee};

/// Heights and places this close are equal: a nanometre, as in the surface.
const TOUCH: f64 = 1e-6;

/// A tip whose V does not fit as it is.
#[derive(Clone, Copy)]
pub(super) struct Unfit {
    /// Where it is cut with narrower flanks, if it is.
    pub(super) tip: Point2,
    /// What becomes of it otherwise.
    pub(super) otherwise: Option<(Point2, TipOrigin)>,
}

/// A V that can be cut now.
#[derive(Clone, Copy)]
struct Fitting {
    unfit: Unfit,
    cut: (Point2, TipOrigin, Swings),
    /// Where its flanks come out.
    exits: [Point2; 2],
}

impl Fitting {
    fn vee(&self) -> Vee {
        let (tip, _, swings) = self.cut;
        swings.vee(tip)
    }

    /// Whether what another one leaves would stand in the way of a flank that came out beyond it before.
    fn meets_what_is_left_by(&self, other: &Self) -> bool {
        [Side::Left, Side::Right]
            .into_iter()
            .any(|side| crosses(self.flank(side), other.flank(side)))
    }

    /// A flank as seen towards its side, away from the middle of the stock's x axis.
    fn flank(&self, side: Side) -> Flank {
        let (vee, [left, right]) = (self.vee(), self.exits);
        let (sign, slope, exit) = match side {
            Side::Left => (-1.0, vee.left, left),
            Side::Right => (1.0, vee.right, right),
        };
        Flank {
            out: sign * vee.tip.x,
            z: vee.tip.z,
            slope: slope.unwrap_or(f64::INFINITY),
            exit: sign * exit.x,
        }
    }
}

/// A flank seen along its own side: where it begins and comes out, and its rise.
#[derive(Clone, Copy)]
struct Flank {
    out: f64,
    z: f64,
    slope: f64,
    exit: f64,
}

/// Whether a flank runs out of the hollow that a steeper one leaves into the material beyond it, before it comes out.
fn crosses(flank: Flank, steeper: Flank) -> bool {
    if steeper.slope <= flank.slope {
        return false;
    }
    let apart = steeper.out - flank.out;
    let crossing = if steeper.slope.is_infinite() {
        apart
    } else {
        (flank.z - steeper.z + steeper.slope * apart) / (steeper.slope - flank.slope)
    };
    let above = flank.z + flank.slope * crossing.max(0.0) > steeper.z + TOUCH;
    above && crossing > TOUCH && crossing >= apart && flank.out + crossing < flank.exit - TOUCH
}

impl LayerPlanner<'_> {
    /// What becomes of a tip whose V does not fit: cut with narrower flanks where what becomes of it otherwise leaves more than
    /// may stay.
    pub(super) fn unfit(
        &mut self,
        tip: Point2,
        otherwise: Option<(Point2, TipOrigin)>,
    ) -> Result<Unfit, Option<(Point2, TipOrigin)>> {
        let Some(avoidance) = &self.avoidance else {
            return Err(otherwise);
        };
        // The tip is on the part where the lattice's is below it.
        let tip = Point2 {
            z: tip.z.max(avoidance.floor(tip.x)),
            ..tip
        };
        if !self.surface.covers(tip) {
            return Err(otherwise);
        }
        let left = match otherwise {
            Some((lifted, _)) if self.comes_free(lifted) => self.residual_under(self.vee(lifted), tip.x),
            Some(_) => f64::INFINITY,
            None => self.residual_around(tip.x),
        };
        let unfit = Unfit { tip, otherwise };
        if left <= self.tolerated || self.fitting(unfit).is_none() {
            return Err(otherwise);
        }
        Ok(unfit)
    }

    /// Whether a V fits as it is.
    pub(super) fn fits(&mut self, tip: Point2) -> bool {
        // It clears the part: the lattice's own tips lie no lower than its floor.
        self.avoidance.is_none() || self.comes_free(tip)
    }

    /// Cuts Vs that do not fit with narrower flanks.
    pub(super) fn narrow(&mut self, unfit: Vec<Unfit>) {
        let mut waiting = unfit;
        while !waiting.is_empty() {
            let mut fitting: Vec<Fitting> = Vec::new();
            for unfit in waiting.drain(..) {
                fitting.extend(self.fitting(unfit).or_else(|| self.as_otherwise(unfit)));
            }
            fitting.sort_by(|a, b| {
                let ([a, b], [left, right]) =
                    ([a, b].map(|one| one.cut.2.least()), [a, b].map(|one| one.cut.0.x));
                b.total_cmp(&a).then(left.total_cmp(&right))
            });
            let mut layer: Vec<Fitting> = Vec::new();
            for one in fitting {
                let agrees =
                    |other: &Fitting| !one.meets_what_is_left_by(other) && !other.meets_what_is_left_by(&one);
                if layer.iter().all(agrees) {
                    layer.push(one);
                } else {
                    waiting.push(one.unfit);
                }
            }
            layer.sort_by(|a, b| a.cut.0.x.total_cmp(&b.cut.0.x));
            let cuts: Vec<_> = layer.iter().map(|one| one.cut).collect();
            self.take_narrowed(&cuts);
        }
    }

    /// A V with narrower flanks, if one fits now and is worth it.
    fn fitting(&mut self, unfit: Unfit) -> Option<Fitting> {
        let tip = unfit.tip;
        if !self.surface.covers(tip) || !self.gains(tip) {
            return None;
        }
        let swings = self.avoidance.as_ref()?.swings(tip, self.surface)?;
        let regular = self.parameters.swing;
        if swings == Swings::even(regular) || swings.vee(tip).is_slit() {
            return None;
        }
        self.with_exits(unfit, (tip, TipOrigin::Lattice, swings))
    }

    /// What becomes of a tip otherwise, where that still comes free.
    fn as_otherwise(&mut self, unfit: Unfit) -> Option<Fitting> {
        let (tip, origin) = unfit.otherwise?;
        if !self.surface.covers(tip) || !self.gains(tip) || !self.comes_free(tip) {
            return None;
        }
        self.with_exits(unfit, (tip, origin, Swings::even(self.parameters.swing)))
    }

    /// None where the chip is too high for the blade to turn beside it.
    fn with_exits(&mut self, unfit: Unfit, cut: (Point2, TipOrigin, Swings)) -> Option<Fitting> {
        let (tip, _, swings) = cut;
        let vee = swings.vee(tip);
        let exits = [Side::Left, Side::Right].map(|side| self.surface.flank(vee, side).exit);
        let highest = tip.z + self.parameters.clear_height.to_mm();
        let [left, right] = exits;
        let is_low = self
            .surface
            .corners_between(left.x, right.x)
            .all(|corner| corner.z <= highest);
        (is_low && left.x < right.x).then_some(Fitting { unfit, cut, exits })
    }

    /// Takes the chips of a layer out; between its cuts the blade goes over the safe plane.
    fn take_narrowed(&mut self, cuts: &[(Point2, TipOrigin, Swings)]) {
        if cuts.is_empty() {
            return;
        }
        self.layers_cut += 1;
        for &(tip, origin, swings) in cuts {
            self.cuts.push(PlannedCut {
                layer: self.layers_cut,
                tip,
                swings,
                origin,
                way: Way::Over,
            });
            self.surface.release(swings.vee(tip));
        }
    }

    /// The most that stands on the part within half a step of x once a V is out, along the part's normal.
    fn residual_under(&mut self, vee: Vee, x: f64) -> f64 {
        let half = self.layout.step() / 2.0;
        let (from, to) = self.part.span();
        let (from, to) = ((x - half).max(from), (x + half).min(to));
        let exits = [Side::Left, Side::Right].map(|side| self.surface.flank(vee, side).exit);
        let ends = [from, to].map(|end| Point2 {
            x: end,
            z: self.surface.height(end).min(vee.height(end)),
        });
        let part = self.part;
        let stays = self
            .surface
            .corners_between(from, to)
            .filter(|corner| corner.z <= vee.height(corner.x));
        stays
            .chain(ends)
            .chain(
                exits
                    .into_iter()
                    .chain([vee.tip])
                    .filter(|point| (from..=to).contains(&point.x)),
            )
            .map(|point| part.nearest_distance(point))
            .fold(0.0, f64::max)
    }
}
