//! What stands while strips are taken out one by one: a step for every stretch of equal height.
//!
//! Strips are rectangles, so that the surface stays a row of steps. A pass with a lead leaves an arc; here it counts as the
//! highest place of that arc over the strip.

use super::blades::TOUCH;
use vcutc_simulation::surface::Side;

/// A surface of steps over the width of the stock.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Terrain {
    /// From left to right, each up to the next one's start; at least one, the first one starts at 0.
    steps: Vec<Step>,
    width: f64,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Step {
    pub(crate) from: f64,
    pub(crate) height: f64,
}

impl Terrain {
    /// The top of a stock.
    pub(crate) fn flat(width: f64, height: f64) -> Self {
        Self {
            steps: vec![Step { from: 0.0, height }],
            width,
        }
    }

    /// The highest step over a range; none where the range is outside. Steps that reach into it by less than [`TOUCH`] do not
    /// count.
    pub(crate) fn highest(&self, from: f64, to: f64) -> Option<f64> {
        let (from, to) = (from.max(0.0), to.min(self.width));
        if to - from <= TOUCH {
            return None;
        }
        let first = self.steps.partition_point(|step| step.from <= from + TOUCH);
        let last = self.steps.partition_point(|step| step.from < to - TOUCH);
        let within = self.steps.get(first.saturating_sub(1)..last)?;
        within.iter().map(|step| step.height).reduce(f64::max)
    }

    /// The height just beside a place; none where the stock ends.
    pub(crate) fn beside(&self, x: f64, side: Side) -> Option<f64> {
        match side {
            Side::Left => self.highest(x - 2.0 * TOUCH, x),
            Side::Right => self.highest(x, x + 2.0 * TOUCH),
        }
    }

    /// Lowers a range to a height, which is at most what stands there.
    pub(crate) fn lower(&mut self, from: f64, to: f64, height: f64) {
        let (from, to) = (from.max(0.0), to.min(self.width));
        if to - from <= TOUCH {
            return;
        }
        let first = self.steps.partition_point(|step| step.from < from - TOUCH);
        let last = self.steps.partition_point(|step| step.from < to - TOUCH);
        let after = last
            .checked_sub(1)
            .and_then(|index| self.steps.get(index))
            .map_or(height, |step| step.height);
        let ends_within = self
            .steps
            .get(last)
            .map_or(to < self.width - TOUCH, |next| next.from > to + TOUCH);
        let tail = ends_within.then_some(Step {
            from: to,
            height: after,
        });
        let before = first.checked_sub(1).and_then(|index| self.steps.get(index));
        let is_new = before.is_none_or(|step| (step.height - height).abs() > 0.0);
        let start = is_new.then_some(Step { from, height });
        self.steps.splice(first..last, start.into_iter().chain(tail));
    }

    /// The steps from left to right, each with where it ends.
    pub(crate) fn steps(&self) -> impl Iterator<Item = (Step, f64)> + '_ {
        let ends = self.steps.iter().skip(1).map(|step| step.from);
        self.steps.iter().copied().zip(ends.chain([self.width]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// Against a row of cells a millimetre wide.
        #[test]
        fn steps_are_what_cells_are(cuts in prop::collection::vec((0_usize..40, 1_usize..20, 1_u32..9), 1..30)) {
            let mut terrain = Terrain::flat(50.0, 10.0);
            let mut cells = [10.0; 50];
            for (from, width, depth) in cuts {
                let to = (from + width).min(50);
                let lowest = cells[from..to].iter().copied().fold(f64::INFINITY, f64::min);
                let height = lowest - f64::from(depth) / 4.0;
                cells[from..to].fill(height);
                terrain.lower(from as f64, to as f64, height);
                for x in 0..50 {
                    prop_assert_eq!(terrain.highest(x as f64, x as f64 + 1.0), Some(cells[x]));
                    let left = x.checked_sub(1).map(|x| cells[x]);
                    prop_assert_eq!(terrain.beside(x as f64, Side::Left), left);
                    prop_assert_eq!(terrain.beside(x as f64, Side::Right), Some(cells[x]));
                }
                let wide = cells[from..to].iter().copied().fold(f64::NEG_INFINITY, f64::max);
                prop_assert_eq!(terrain.highest(from as f64, to as f64), Some(wide));
                prop_assert!(terrain.steps().all(|(step, end)| step.from < end));
            }
        }
    }
}
