//! A bound from below that is tight around the best shape, and around which shapes it proves that none is better.
//!
//! What is made least is no less than any mean of the terms whose greatest it is; nor than itself less any multiple of
//! what a bound leaves free (weak duality, Lagrange). With the multipliers that a descent came to rest with, this blend
//! has no slope there, or one that rises from the sides of the range. Where its curvature is positive over a whole box around
//! that place, by intervals, no shape of the box comes to less than the blend does there. Across a kink it need not be: there
//! the mean may be shifted to either side by the smaller of two weights, and what that gains in proportion to the
//! distance from the kink is, within a box, at least in proportion to its square.

use super::descent::{Meets, Rest};
use super::ground::{Ground, Term, swing};
use vcutc_geometry::number::{Interval, OnPlane, Scalar, Slopes};

/// How far the first box that is tried reaches, as a share of the place; each further one reaches half as far.
const WIDEST: f64 = 0.3;

/// Most boxes that are tried.
const MOST_TRIES: u32 = 7;

/// A mean of terms less multiples of what bounds leave free, all terms with a weight.
#[derive(Clone, Copy, Debug)]
pub(super) struct Blend {
    parts: [(Term, f64); 3],
    rest: Rest,
}

impl Blend {
    pub(super) fn at(rest: Rest) -> Self {
        let mut parts = [(rest.top, 1.0), (rest.top, 0.0), (rest.top, 0.0)];
        for (number, (meets, multiplier)) in (1..).zip(rest.meets.into_iter().flatten()) {
            match meets {
                Meets::Term(term) => {
                    parts[number] = (term, multiplier);
                    parts[0].1 -= multiplier;
                }
                Meets::Bound(term) => parts[number] = (term, multiplier),
                Meets::Low(_) | Meets::High(_) => {}
            }
        }
        Self { parts, rest }
    }

    /// Whether it says more than the first term alone.
    pub(super) fn is_mixed(&self) -> bool {
        self.parts[1].1 > 0.0 || self.parts[2].1 > 0.0
    }

    /// What shapes of a box that keep all bounds come to at least.
    pub(super) fn least(&self, ground: &Ground<'_>, sides: [Interval; 2]) -> f64 {
        let middle = sides.map(|side| Interval::exactly(side.middle()));
        self.slopes(ground, middle).value.low - swing(&self.slopes(ground, sides), sides)
    }

    fn slopes(&self, ground: &Ground<'_>, sides: [Interval; 2]) -> Slopes {
        let at = [Slopes::coordinate(0, sides[0]), Slopes::coordinate(1, sides[1])];
        self.blended(|term| ground.term(term, at))
    }

    fn blended<N: Scalar>(&self, value: impl Fn(Term) -> N) -> N {
        let mut sum = N::constant(0.0);
        for (term, weight) in self.parts {
            if weight > 0.0 {
                sum = sum + value(term).times(weight);
            }
        }
        sum
    }

    /// A box around the place of rest in which nothing comes to less than `least`.
    pub(super) fn region(&self, ground: &Ground<'_>, least: f64) -> Option<[Interval; 2]> {
        let place = self.rest.place;
        let here = self.jet(ground, place.map(Interval::exactly));
        let mut reach = WIDEST;
        for _ in 0..MOST_TRIES {
            let sides = [0, 1].map(|i| {
                let side = ground.chart.sides[i];
                Interval {
                    low: (place[i] * (1.0 - reach)).max(side.low),
                    high: (place[i] * (1.0 + reach)).min(side.high),
                }
            });
            if self.proves(ground, &here, sides, least) {
                return Some(sides);
            }
            reach *= 0.5;
        }
        None
    }

    fn jet(&self, ground: &Ground<'_>, sides: [Interval; 2]) -> OnPlane<Interval> {
        let at = [OnPlane::coordinate(0, sides[0]), OnPlane::coordinate(1, sides[1])];
        self.blended(|term| ground.term(term, at))
    }

    fn proves(
        &self,
        ground: &Ground<'_>,
        here: &OnPlane<Interval>,
        sides: [Interval; 2],
        least: f64,
    ) -> bool {
        let place = self.rest.place;
        let widths = [0, 1].map(|i| (place[i] - sides[i].low).max(sides[i].high - place[i]));
        let mut value = here.value.low;
        // What adds to the curvature: along the first coordinate, across, along the second.
        let mut gains = [Interval::ZERO; 3];
        for i in [0, 1] {
            let slope = here.by[i];
            let rises = match (place[i] > sides[i].low, place[i] < sides[i].high) {
                (false, true) => slope.low,
                (true, false) => -slope.high,
                (true, true) | (false, false) => 0.0,
            };
            if rises > 0.0 {
                gains[2 * i] = Interval::exactly(2.0 * rises / widths[i] * (1.0 - 1e-9));
            } else if widths[i] > 0.0 {
                value -= slope.magnitude() * widths[i];
            }
        }
        for (condition, off, shift) in self.kinks(ground, sides) {
            value -= shift * off;
            let [a, b] = condition.by;
            let far = off + a.magnitude() * widths[0] + b.magnitude() * widths[1];
            let gain = Interval::exactly(2.0 * shift / far.max(f64::MIN_POSITIVE) * (1.0 - 1e-9));
            let shares = [a.squared(), a * b, b.squared()];
            gains = [0, 1, 2].map(|k| gains[k] + gain * shares[k]);
        }
        value >= least && self.rounded(ground, sides, gains)
    }

    /// Whether the curvature is positive all over a box.
    fn rounded(&self, ground: &Ground<'_>, sides: [Interval; 2], gains: [Interval; 3]) -> bool {
        let curve = self.jet(ground, sides).curve;
        let [along, across, beside] = [0, 1, 2].map(|k| curve[k] + gains[k]);
        let mixed = across.magnitude();
        match sides.map(|side| side.width() > 0.0) {
            [false, false] => true,
            [true, false] => along.low >= 0.0,
            [false, true] => beside.low >= 0.0,
            [true, true] => {
                along.low >= 0.0
                    && beside.low >= 0.0
                    && along.low * beside.low >= mixed * mixed * (1.0 + 1e-9)
            }
        }
    }

    /// The functions that vanish along kinks and bounds that meet at the place of rest: their slopes over a box, how far they
    /// are from vanishing there, and by how much their multipliers may be shifted.
    fn kinks(
        &self,
        ground: &Ground<'_>,
        sides: [Interval; 2],
    ) -> impl Iterator<Item = (OnPlane<Interval>, f64, f64)> {
        let over = [OnPlane::coordinate(0, sides[0]), OnPlane::coordinate(1, sides[1])];
        let (first, top, place) = (self.parts[0].1, self.rest.top, self.rest.place);
        let rounding = |value: f64| 1e-12 * value.abs();
        self.rest
            .meets
            .into_iter()
            .flatten()
            .filter_map(move |(meets, multiplier)| match meets {
                Meets::Term(term) => {
                    let (one, two) = (ground.value(top, place), ground.value(term, place));
                    let off = (one - two).abs() + rounding(one);
                    // Both means may be shifted at once.
                    let shift = multiplier.min(0.5 * first);
                    Some((ground.term(top, over) - ground.term(term, over), off, shift))
                }
                Meets::Bound(term) => {
                    let off = ground.value(term, place).abs() + rounding(1.0);
                    Some((ground.term(term, over), off, multiplier))
                }
                Meets::Low(_) | Meets::High(_) => None,
            })
            .filter(|(_, _, shift)| *shift > 0.0)
    }
}
