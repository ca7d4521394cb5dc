//! Enclosures against numbers within them, against exact arithmetic of integers, and against differences.

use super::*;
use proptest::prelude::*;

fn interval() -> impl Strategy<Value = (Interval, f64)> {
    (-1e3..1e3_f64, 0.0..10.0_f64, 0.0..=1.0_f64).prop_map(|(low, width, part)| {
        let high = low + width;
        let inside = (low + part * (high - low)).clamp(low, high);
        (Interval { low, high }, inside)
    })
}

fn holds(interval: Interval, number: f64) -> bool {
    interval.low <= number && number <= interval.high
}

proptest! {
    #[test]
    fn numbers_in_intervals_give_numbers_in_results((a, x) in interval(), (b, y) in interval()) {
        prop_assert!(holds(a + b, x + y));
        prop_assert!(holds(a - b, x - y));
        prop_assert!(holds(a * b, x * y));
        prop_assert!(holds(a * y, x * y));
        prop_assert!(holds(-a, -x));
        prop_assert!(holds(a.squared(), x * x));
        prop_assert!(holds(a.squared().root(), x.abs()));
        let positive = b.squared() + Interval::exactly(0.5);
        prop_assert!(holds(a.over(positive), x / (y * y + 0.5)));
        prop_assert!(holds(a.sin_cos().0, libm::sin(x)));
        prop_assert!(holds(a.sin_cos().1, libm::cos(x)));
    }

    #[test]
    fn a_box_is_seen_under_its_direction((a, x) in interval(), turn in -3.0..3.0_f64) {
        // A box of the interval's size around a point at a distance of twice its diagonal.
        let half = 0.5 * a.width() + 1e-9;
        let distance = 4.0 * half;
        let (sin, cos) = libm::sincos(turn);
        let (cx, cy) = ((distance + 2.0 * half) * cos, (distance + 2.0 * half) * sin);
        let offset = x - a.middle();
        let seen = Interval::direction(Interval::around(cy, half), Interval::around(cx, half), distance);
        prop_assert!(holds(seen, libm::atan2(cy + offset, cx - offset)) || turn.abs() > 2.6);
    }
}

/// An integer that a double holds exactly.
fn integer() -> impl Strategy<Value = i64> {
    prop_oneof![-9_i64..9, -(1_i64 << 53)..=(1_i64 << 53)]
}

fn encloses(interval: Interval, exact: i128) -> bool {
    // Doubles below 2^127 in size are integers of 128 bits once they are rounded towards the exact one.
    interval.low.ceil() as i128 <= exact && exact <= interval.high.floor() as i128
}

/// A function of two coordinates that uses all operations; both are positive.
fn function<S: Scalar>(x: S, y: S) -> S {
    let leg = x.hypotenuse(1.5).times(0.5) + y.over_hypotenuse(2.0);
    let bent = (leg * y).root().arc_tangent() - y.under(0.75);
    bent.lesser(x.plus(-1.0)).greater(y.times(-0.5)) / (x * x).plus(1.0)
}

proptest! {
    #[test]
    fn sums_and_products_enclose_the_exact_ones(a in integer(), b in integer(), c in integer()) {
        let [x, y, z] = [a, b, c].map(|n| Interval::exactly(n as f64));
        let [a, b, c] = [a, b, c].map(i128::from);
        prop_assert!(encloses(x + y, a + b));
        prop_assert!(encloses(x - y, a - b));
        prop_assert!(encloses(x * y, a * b));
        prop_assert!(encloses(x.squared(), a * a));
        prop_assert!(encloses(x + y + z, a + b + c));
        prop_assert!(encloses(x * (b as f64) - y * z, a * b - b * c));
        prop_assert_eq!(x * Interval::ZERO + Interval::ZERO, Interval::ZERO);
    }

    #[test]
    fn boxes_enclose_values_and_slopes(low in (0.5..4.0_f64, 0.5..4.0_f64), width in 0.0..0.5_f64, at in [0.0..1.0_f64, 0.0..1.0, 0.0..1.0, 0.0..1.0]) {
        let low = [low.0, low.1];
        let sides = low.map(|low| Interval { low, high: low + width });
        let place = |part: [f64; 2]| [0, 1].map(|i| (low[i] + part[i] * width).clamp(sides[i].low, sides[i].high));
        let value = |[x, y]: [f64; 2]| function(x, y);
        let slopes = function(Slopes::coordinate(0, sides[0]), Slopes::coordinate(1, sides[1]));
        let whole = function(OnPlane::coordinate(0, sides[0]), OnPlane::coordinate(1, sides[1]));
        let [one, other] = [place([at[0], at[1]]), place([at[2], at[3]])];
        prop_assert!(holds(function(sides[0], sides[1]), value(one)));
        prop_assert!(holds(slopes.value, value(one)) && holds(whole.value, value(one)));
        // The mean value theorem, which holds across kinks too: one coordinate after the other.
        let between = [other[0], one[1]];
        for (by, from, to) in [(0, one, between), (1, between, other)] {
            let (rise, run) = (value(to) - value(from), to[by] - from[by]);
            let bounds = slopes.by[by] * run + Interval::around(0.0, 1e-14);
            prop_assert!(holds(bounds, rise), "{rise} in {bounds:?}");
            let bounds = whole.by[by] * run + Interval::around(0.0, 1e-14);
            prop_assert!(holds(bounds, rise), "{rise} in {bounds:?}");
        }
        // The same of slopes, by the curvatures.
        let slope = |[x, y]: [f64; 2]| function(OnPlane::coordinate(0, x), OnPlane::coordinate(1, y)).by;
        for (by, from, to) in [(0, one, between), (1, between, other)] {
            for i in [0, 1] {
                let (rise, run) = (slope(to)[i] - slope(from)[i], to[by] - from[by]);
                let bounds = whole.curve[i + by] * run + Interval::around(0.0, 1e-13);
                prop_assert!(holds(bounds, rise), "{rise} in {bounds:?}");
            }
        }
    }

    #[test]
    fn slopes_and_curvatures_are_those_of_differences(place in [0.5..4.0_f64, 0.5..4.0]) {
        let value = |dx: f64, dy: f64| function(place[0] + dx, place[1] + dy);
        let jet = function(OnPlane::coordinate(0, place[0]), OnPlane::coordinate(1, place[1]));
        const H: f64 = 1e-4;
        let slopes = [
            (value(H, 0.0) - value(-H, 0.0)) / (2.0 * H),
            (value(0.0, H) - value(0.0, -H)) / (2.0 * H),
        ];
        let curvatures = [
            (value(H, 0.0) - 2.0 * value(0.0, 0.0) + value(-H, 0.0)) / (H * H),
            (value(H, H) - value(H, -H) - value(-H, H) + value(-H, -H)) / (4.0 * H * H),
            (value(0.0, H) - 2.0 * value(0.0, 0.0) + value(0.0, -H)) / (H * H),
        ];
        // A kink within reach of the differences is neither side's slope.
        let sides = place.map(|at| Interval::around(at, 2.0 * H));
        let near = function(OnPlane::coordinate(0, sides[0]), OnPlane::coordinate(1, sides[1]));
        prop_assume!(near.curve[0] != Interval::UNKNOWN && near.curve[0].high < 1e30);
        for (exact, found) in jet.by.into_iter().zip(slopes) {
            prop_assert!((exact - found).abs() < 1e-6, "{exact} {found}");
        }
        for (exact, found) in jet.curve.into_iter().zip(curvatures) {
            prop_assert!((exact - found).abs() < 1e-5, "{exact} {found}");
        }
    }

    #[test]
    fn a_span_encloses_what_is_on_it(middle in 0.5..3.0_f64, slope in -0.4..0.4_f64, at in [-1.0..1.0_f64, -1.0..1.0]) {
        // A function of the parameter by all operations, as numbers and as enclosures of value, slope and curvature.
        let number = |t: f64| {
            let f = middle + slope * t;
            let (sin, cos) = libm::sincos(f);
            let root = (f * f + 2.0 * f).sqrt();
            libm::atan2(root + sin, 3.0 + cos) - 0.5 * (root * sin)
        };
        let f = Along::line(middle, slope);
        let (sin, cos) = f.sin_cos();
        let root = (f.squared() + f * 2.0).root();
        let arc = Along::arc(root.along + sin, cos.plus(3.0));
        prop_assert_eq!((root.exists, arc.exists), (1.0, 1.0));
        let whole = arc.along - root.along * sin * 0.5;
        let [one, other] = at;
        prop_assert!(holds(whole.value(), number(one)));
        prop_assert!(holds(whole.begin(), number(-1.0)) && holds(whole.end(), number(1.0)));
        let bounds = whole.rate() * (other - one) + Interval::around(0.0, 1e-14);
        prop_assert!(holds(bounds, number(other) - number(one)));
        // Of three places: the second difference is the curvature somewhere between.
        let h = 0.5 * (other - one);
        let bend = number(one) - 2.0 * number(one + h) + number(other);
        prop_assert!(holds(whole.bend() * (h * h) + Interval::around(0.0, 1e-14), bend));
    }
}
