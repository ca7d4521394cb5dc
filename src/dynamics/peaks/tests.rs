//! Peaks of functions whose most is known.

use super::*;
use proptest::prelude::*;

const WHOLE: [Whole; 2] = [
    Whole {
        op: OpId(0),
        parts: 1,
    },
    Whole {
        op: OpId(1),
        parts: 3,
    },
];

/// Of a function whose slope is at most `steepest`: a bound of the first order.
fn held(function: impl Fn(f64) -> f64, steepest: f64, part: Part) -> Held {
    let middle = function(part.middle);
    Held {
        met: middle,
        most: middle + steepest * part.half,
    }
}

const ANY: Sought = Sought {
    least: 0.0,
    limit: None,
};

proptest! {
    #[test]
    fn peaks_are_bounds_and_nearly_reached(rate in 1.0..40.0_f64, start in 0.0..6.0_f64, size in 0.1..100.0_f64) {
        let wave = |op: OpId, place: f64| size * libm::sin(start + rate * (place + f64::from(op.0)));
        let bounds = |op: OpId, part: Part| {
            let up = held(|place| wave(op, place), size * rate, part);
            let down = held(|place| -wave(op, place), size * rate, part);
            Some([up, down])
        };
        let [up, down] = peaks(&WHOLE, &[ANY, ANY], bounds).unwrap();
        let sampled = (0..2).flat_map(|op| (0..=20_000).map(move |at| (OpId(op), f64::from(at) / 20_000.0)));
        let (mut most, mut least) = (f64::MIN, f64::MAX);
        for (op, place) in sampled {
            let here = wave(op, place);
            (most, least) = (most.max(here), least.min(here));
        }
        // What is below zero does not matter.
        let is_near = |peak: &Peak, most: f64| {
            peak.most >= most && peak.most <= most.max(0.0) + 0.006 * most.abs() + 1e-6 * size
        };
        prop_assert!(is_near(&up, most), "{up:?} {most}");
        prop_assert!(is_near(&down, -least), "{down:?} {least}");
        prop_assert!((wave(up.op, up.part.middle) - up.met).abs() < 1e-9 * size);
    }
}

#[test]
fn a_limit_that_is_just_kept_is_settled() {
    // Its most is 1, in the middle of the second motion.
    let hill = |op: OpId, place: f64| f64::from(op.0) - 4.0 * (place - 0.5) * (place - 0.5);
    let bounds = |op: OpId, part: Part| Some([held(|place| hill(op, place), 4.0, part)]);
    for limit in [0.999, 1.001] {
        let sought = Sought {
            least: 0.0,
            limit: Some(limit),
        };
        let [peak] = peaks(&WHOLE, &[sought], bounds).unwrap();
        assert_eq!(peak.most <= limit, limit > 1.0, "{peak:?}");
        assert_eq!(peak.op, OpId(1));
    }
}

#[test]
fn parts_that_are_too_long_to_say_are_halved() {
    let bounds = |_: OpId, part: Part| {
        let flat = Held { met: 2.0, most: 2.0 };
        (part.half < 0.01).then_some([flat])
    };
    let [peak] = peaks(&WHOLE, &[ANY], bounds).unwrap();
    assert_eq!((peak.most, peak.met), (2.0, 2.0));
    let never = |_: OpId, _: Part| None;
    let [unknown] = peaks::<1>(&WHOLE, &[ANY], never).unwrap();
    assert_eq!(unknown.most, f64::INFINITY);
    assert_eq!(peaks::<1>(&[], &[ANY], never), None);
}
