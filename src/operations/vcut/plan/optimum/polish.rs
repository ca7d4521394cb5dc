//! The last digits of the best shape where no descent comes to rest: a search by golden sections (Kiefer 1953), for each place
//! along the first coordinate the best along the second. What is found is never worse.

use super::ground::{Found, Ground, Merit};
use vcutc_geometry::number::Interval;

/// The golden ratio's smaller part.
const PART: f64 = 0.381_966_011_250_105_2;

/// A line is narrowed to this share of its place: below it rounding hides what is better.
const FINE: f64 = 1e-11;

/// By how many widths of the box a rectangle reaches beyond the shape, one after the other.
const SPREADS: [f64; 2] = [2.0, 0.02];

/// The best shape near one, by sections.
pub(super) fn by_sections(ground: &Ground<'_>, sides: [Interval; 2], found: Found) -> Found {
    SPREADS.into_iter().fold(found, |found, spread| {
        let around = [0, 1].map(|i| {
            let (place, all) = (found.place[i], ground.chart.sides[i]);
            let reach = spread * sides[i].width();
            Interval {
                low: (place - reach).max(all.low),
                high: (place + reach).min(all.high),
            }
        });
        let second = |first: f64| best_along(around[1], |second| ground.at([first, second]).merit);
        let (first, _) = best_along(around[0], |first| second(first).1);
        ground
            .better(Some(found), [first, second(first).0])
            .unwrap_or(found)
    })
}

/// The best place on a line, which has one valley, and how good it is.
fn best_along(side: Interval, merit: impl Fn(f64) -> Merit) -> (f64, Merit) {
    let at = |place: f64| (place, merit(place));
    let better = |one: (f64, Merit), two: (f64, Merit)| if two.1.beats(one.1) { two } else { one };
    let ends = better(at(side.low), at(side.high));
    if side.width() <= 0.0 {
        return ends;
    }
    let (mut low, mut high) = (side.low, side.high);
    let mut left = at(low + PART * (high - low));
    let mut right = at(high - PART * (high - low));
    let mut best = better(ends, better(left, right));
    while high - low > FINE * high.abs().max(low.abs()) {
        if right.1.beats(left.1) {
            low = left.0;
            left = right;
            right = at(high - PART * (high - low));
            best = better(best, right);
        } else {
            high = right.0;
            right = left;
            left = at(low + PART * (high - low));
            best = better(best, left);
        }
    }
    best
}
