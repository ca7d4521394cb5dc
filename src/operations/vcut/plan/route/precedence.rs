//! Which stretches must be cut before which others.
//!
//! The planner decides a layer against the surface that all layers above leave. For a cut of it to come out as planned
//! somewhere else in the order, that surface need not be there as a whole, only beneath the cut's own chip and in the Vs in
//! which its flanks come out: what these leave lies nowhere above the flanks beyond, because it does not rise
//! more steeply than they do. So a stretch waits for those whose tips show in the surface between the older
//! tips that its outermost flanks meet, and for nothing else. Tips that do not show any more have been cut
//! under by one that does, and that one waits for them in turn.
//!
//! Where steeper flanks were cut before, by another operation or by narrowed Vs of this one, their walls may stand above a
//! flank farther off; a stretch then waits for all tips that show. So does one that has steeper flanks itself: what it leaves
//! would be such walls for those that it does not wait for.

use super::{TOUCH, Terrain, micrometres};
use core::ops::Range;
use std::collections::BTreeMap;
use vcutc_geometry::curve::Point2;
use vcutc_simulation::surface::{Side, Surface, Vee};

/// How many stretches each one still waits for.
pub struct Waiting {
    left: Vec<usize>,
    followers: Vec<Vec<usize>>,
}

impl Waiting {
    /// From the cuts, replayed layer by layer as they were planned.
    pub(super) fn new(terrain: Terrain<'_>, stretches: &[Range<usize>]) -> Self {
        let mut waiting = Self {
            left: vec![0; stretches.len()],
            followers: vec![Vec::new(); stretches.len()],
        };
        let mut survey = Survey::new(terrain);
        let same_layer = |a: &(usize, &Range<usize>), b: &(usize, &Range<usize>)| {
            let layer = |range: &Range<usize>| terrain.cuts.get(range.start).map(|cut| cut.layer);
            layer(a.1) == layer(b.1)
        };
        let numbered: Vec<(usize, &Range<usize>)> = stretches.iter().enumerate().collect();
        for layer in numbered.chunk_by(same_layer) {
            let chips: Vec<Chip> = layer
                .iter()
                .flat_map(|&(stretch, range)| survey.measure(stretch, range))
                .collect();
            for of_stretch in chips.chunk_by(|a, b| a.stretch == b.stretch) {
                waiting.add(of_stretch, &survey);
            }
            survey.release(&chips);
        }
        waiting
    }

    fn add(&mut self, chips: &[Chip], survey: &Survey<'_>) {
        let Some(stretch) = chips.first().map(|chip| chip.stretch) else {
            return;
        };
        let mut before = survey.shown_under(chips);
        before.sort_unstable();
        before.dedup();
        if let Some(left) = self.left.get_mut(stretch) {
            *left = before.len();
        }
        for earlier in before {
            if let Some(followers) = self.followers.get_mut(earlier) {
                followers.push(stretch);
            }
        }
    }

    /// Stretches that wait for none.
    pub(super) fn free(&self) -> Vec<usize> {
        let numbered = self.left.iter().enumerate();
        numbered
            .filter(|&(_, &left)| left == 0)
            .map(|(stretch, _)| stretch)
            .collect()
    }

    /// Takes a stretch as cut; gives those that wait for none now.
    pub(super) fn done(&mut self, stretch: usize) -> Vec<usize> {
        let mut freed = Vec::new();
        let followers = self.followers.get_mut(stretch).map(core::mem::take);
        for follower in followers.unwrap_or_default() {
            if let Some(left) = self.left.get_mut(follower) {
                *left = left.saturating_sub(1);
                if *left == 0 {
                    freed.push(follower);
                }
            }
        }
        freed
    }
}

/// What a cut takes, as it was planned.
struct Chip {
    stretch: usize,
    vee: Vee,
    /// Where its flanks come out.
    exits: [f64; 2],
    /// The older tips, or the exits, between which what is above it shows.
    met: [f64; 2],
}

/// The surface as it was planned, and whose tips show in it.
struct Survey<'p> {
    terrain: Terrain<'p>,
    surface: Surface,
    /// The tips that show and their stretches, by x in micrometres.
    shown: BTreeMap<i64, (Point2, usize)>,
}

impl<'p> Survey<'p> {
    fn new(terrain: Terrain<'p>) -> Self {
        Self {
            terrain,
            surface: terrain.before.clone(),
            shown: BTreeMap::new(),
        }
    }

    fn measure(&mut self, stretch: usize, range: &Range<usize>) -> Vec<Chip> {
        let cuts = self.terrain.cuts.get(range.clone()).unwrap_or_default();
        let mut chip = |vee: Vee| {
            let lowest = self.terrain.parameters.flanks.lowest(vee);
            let [left, right] = [Side::Left, Side::Right].map(|side| self.surface.flank(lowest, side));
            Chip {
                stretch,
                vee,
                exits: [left.exit.x, right.exit.x],
                met: [left.met, right.met],
            }
        };
        cuts.iter().map(|cut| chip(cut.vee())).collect()
    }

    /// Stretches of the tips that show between the older tips that a stretch's chips meet.
    fn shown_under(&self, chips: &[Chip]) -> Vec<usize> {
        let slope = self.terrain.parameters.flanks.slope;
        let is_steeper = |chip: &Chip| {
            let slopes = [chip.vee.left, chip.vee.right].into_iter().flatten();
            slopes.fold(0.0, f64::max) > slope
        };
        if !self.surface.is_final_for(slope) || chips.iter().any(is_steeper) {
            return self.shown.values().map(|&(_, stretch)| stretch).collect();
        }
        let from = chips.iter().map(|chip| chip.met[0]).fold(f64::INFINITY, f64::min);
        let to = chips
            .iter()
            .map(|chip| chip.met[1])
            .fold(f64::NEG_INFINITY, f64::max);
        let (from, to) = (micrometres(from), micrometres(to));
        if from > to {
            return Vec::new();
        }
        let shown = self.shown.range(from..=to);
        shown.map(|(_, &(_, stretch))| stretch).collect()
    }

    fn release(&mut self, chips: &[Chip]) {
        for chip in chips {
            self.surface.release(chip.vee);
            let [from, to] = chip.exits.map(micrometres);
            let cut_under: Vec<i64> = self
                .shown
                .range(from.min(to)..=to)
                .filter(|(_, (tip, _))| tip.z > chip.vee.height(tip.x) + TOUCH)
                .map(|(&x, _)| x)
                .collect();
            for x in cut_under {
                self.shown.remove(&x);
            }
            let tip = chip.vee.tip;
            self.shown.insert(micrometres(tip.x), (tip, chip.stretch));
        }
    }
}
