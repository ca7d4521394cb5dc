//! The last digits of the best shape that branch and bound found.
//!
//! Where the objective is smooth along the coordinates that are not at a side, its slopes vanish at the best place, which
//! is found by bisection and by Newton's method. Where it is not, along a kink or a bound, a search by golden sections (Kiefer
//! 1953) finds it: for each place along the first coordinate the best along the second. What is found is never worse.

use super::number::Interval;
use super::search::{Found, Ground, Merit};

/// The golden ratio's smaller part.
const PART: f64 = 0.381_966_011_250_105_2;

/// A line is narrowed to this share of its place: below it rounding hides what is better.
const FINE: f64 = 1e-11;

/// By how many widths of the box a rectangle reaches beyond the shape, one after the other.
const SPREADS: [f64; 2] = [2.0, 0.02];

/// Most steps of a search for a place without slope.
const MOST_STEPS: u32 = 60;

/// The step, as a share of the place, over which slopes are compared.
const NEARBY: f64 = 1e-6;

/// A value may come out larger by this share for rounding.
const ROUNDING: f64 = 1e-14;

/// The best shape near one that was found in a box.
pub(super) fn polish(ground: &Ground<'_>, sides: [Interval; 2], found: Found) -> Found {
    let free = [0, 1].map(|i| {
        let side = ground.chart.sides[i];
        sides[i].width() > 0.0 && found.place[i] > side.low && found.place[i] < side.high
    });
    let flat = match free {
        [false, false] => return found,
        [true, false] => Some(flat_along(ground, sides, &found, 0)),
        [false, true] => Some(flat_along(ground, sides, &found, 1)),
        [true, true] => flat_over(ground, found.place),
    };
    flat.and_then(|place| as_good(ground, &found, place))
        .unwrap_or_else(|| by_sections(ground, sides, found))
}

/// The shape at a place, if it is as good as one that was found but for rounding.
fn as_good(ground: &Ground<'_>, found: &Found, place: [f64; 2]) -> Option<Found> {
    let inside = (0..2).all(|i| {
        let side = ground.chart.sides[i];
        side.low <= place[i] && place[i] <= side.high
    });
    let known = Found {
        value: found.value * (1.0 + ROUNDING),
        ..*found
    };
    let better = inside.then(|| ground.better(Some(known), place)).flatten()?;
    (better.place == place).then_some(better)
}

/// Where along one coordinate the slope changes its sign, near a place: by secants that keep it between them (the Illinois
/// method: Dowell and Jarratt 1971).
fn flat_along(ground: &Ground<'_>, sides: [Interval; 2], found: &Found, along: usize) -> [f64; 2] {
    let at = |x: f64| {
        let mut place = found.place;
        place[along] = x;
        place
    };
    let slope = |x: f64| ground.slopes(at(x))[along];
    let all = ground.chart.sides[along];
    let (mut low, mut high) = (
        (found.place[along] - sides[along].width()).max(all.low),
        (found.place[along] + sides[along].width()).min(all.high),
    );
    let (mut falls, mut rises) = (slope(low), slope(high));
    if falls >= 0.0 {
        return at(low);
    }
    if rises <= 0.0 {
        return at(high);
    }
    let mut kept = 0;
    for _ in 0..MOST_STEPS {
        if high - low <= FINE * high {
            break;
        }
        let secant = (low * rises - high * falls) / (rises - falls);
        let middle = if secant > low && secant < high {
            secant
        } else {
            0.5 * (low + high)
        };
        let here = slope(middle);
        if here < 0.0 {
            (low, falls) = (middle, here);
            if kept < 0 {
                rises *= 0.5;
            }
            kept = -1;
        } else if here > 0.0 {
            (high, rises) = (middle, here);
            if kept > 0 {
                falls *= 0.5;
            }
            kept = 1;
        } else {
            return at(middle);
        }
    }
    at(if -falls < rises { low } else { high })
}

/// Where neither coordinate has a slope, by Newton's method from a place near it.
fn flat_over(ground: &Ground<'_>, start: [f64; 2]) -> Option<[f64; 2]> {
    let mut place = start;
    for _ in 0..12 {
        let here = ground.slopes(place);
        let curvature = [0, 1].map(|i| {
            let step = NEARBY * place[i];
            let (mut before, mut behind) = (place, place);
            before[i] -= step;
            behind[i] += step;
            let (before, behind) = (ground.slopes(before), ground.slopes(behind));
            [0, 1].map(|j| (behind[j] - before[j]) / (2.0 * step))
        });
        let [[a, b], [c, d]] = curvature;
        let determinant = a * d - b * c;
        if !(a > 0.0 && determinant > 0.0) {
            return None;
        }
        let step = [
            (here[0] * d - here[1] * c) / determinant,
            (here[1] * a - here[0] * b) / determinant,
        ];
        place = [place[0] - step[0], place[1] - step[1]];
        if (0..2).all(|i| step[i].abs() <= 10.0 * FINE * place[i].abs()) {
            return Some(place);
        }
        if (0..2).any(|i| step[i].abs() > 0.5 * place[i].abs()) {
            return None;
        }
    }
    None
}

/// The best shape near one, by sections.
fn by_sections(ground: &Ground<'_>, sides: [Interval; 2], found: Found) -> Found {
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
