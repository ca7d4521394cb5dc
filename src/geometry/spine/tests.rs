//! Spines against walks along them.

use super::*;
use proptest::prelude::*;

/// A parabola of that radius at its apex over a depth, crest or valley, in chords of so many mm.
fn parabola(depth: f64, radius: f64, is_crest: bool, chord: f64) -> Spine {
    let count = (depth / chord).round();
    let sagitta = depth * depth / (8.0 * radius);
    let knots = (0..=count as u32).map(|k| {
        let y = depth * f64::from(k) / count;
        let bowl = (y - depth / 2.0) * (y - depth / 2.0) / (2.0 * radius);
        let rise = if is_crest { sagitta - bowl } else { bowl };
        Knot { y, rise }
    });
    let mut knots: Vec<Knot> = knots.collect();
    let least = knots.iter().map(|knot| knot.rise).fold(f64::INFINITY, f64::min);
    for knot in &mut knots {
        knot.rise -= least;
    }
    Spine::new(knots).unwrap()
}

#[test]
fn a_valley_is_cut_deeper_by_what_a_tangent_leaves_of_it() {
    // Overhang o at a radius r: about o^2 / 2 r below the tips, and as much above them in a crest.
    let (overhang, radius) = (28.0, 1000.0);
    let expected = overhang * overhang / (2.0 * radius);
    let valley = parabola(400.0, radius, false, 2.0).deviation(overhang);
    assert!((valley.below - expected).abs() < 0.03, "{valley:?}");
    // Beyond the stock a blade that turns all along a long way stands as if half of the first bend were made.
    assert!(valley.above < 0.03, "{valley:?}");
    let crest = parabola(400.0, radius, true, 2.0).deviation(overhang);
    assert!((crest.above - expected).abs() < 0.04, "{crest:?}");
    assert!(crest.below < 0.03, "{crest:?}");
}

#[test]
fn a_straight_spine_has_no_deviation_and_goes_on_beyond_its_ends() {
    let knots = [(0.0, 0.0), (100.0, 20.0)].map(|(y, rise)| Knot { y, rise });
    let spine = Spine::new(knots.to_vec()).unwrap();
    assert_eq!(spine.rise(-10.0), -2.0);
    assert_eq!(spine.rise(110.0), 22.0);
    assert_eq!(spine.end_slopes(), [0.2, 0.2]);
    let Deviation { above, below } = spine.deviation(40.0);
    assert!(above < 1e-12 && below < 1e-12);
    let places: Vec<f64> = spine.stations(5.0).iter().map(|station| station.y).collect();
    assert_eq!(places, [-5.0, 105.0]);
}

#[test]
fn knots_that_make_no_spine_are_refused() {
    let spine = |knots: &[(f64, f64)]| {
        let knots = knots.iter().map(|&(y, rise)| Knot { y, rise });
        Spine::new(knots.collect()).map(|_| ())
    };
    assert_eq!(spine(&[(0.0, 0.0)]), Err(SpineError::Order));
    assert_eq!(spine(&[(1.0, 0.0), (2.0, 0.0)]), Err(SpineError::Order));
    assert_eq!(
        spine(&[(0.0, 0.0), (2.0, 0.0), (2.0, 1.0)]),
        Err(SpineError::Order)
    );
    assert_eq!(spine(&[(0.0, 1.0), (9.0, 2.0)]), Err(SpineError::Level));
    assert_eq!(spine(&[(0.0, 0.0), (9.0, f64::NAN)]), Err(SpineError::Level));
    assert_eq!(spine(&[(0.0, 0.0), (9.0, 10.0)]), Err(SpineError::Bends));
    assert_eq!(
        spine(&[(0.0, 0.0), (50.0, 0.0), (100.0, 1.0)]),
        Err(SpineError::Bends)
    );
    assert_eq!(spine(&[(0.0, 0.0), (50.0, 0.0), (100.0, 0.3)]), Ok(()));
}

/// A spine of random bends.
fn spines() -> impl Strategy<Value = Spine> {
    (
        prop::collection::vec((3.0..20.0_f64, -1.0..=1.0_f64), 1..40),
        -0.3..0.3_f64,
    )
        .prop_map(|(pieces, slope)| {
            let mut angle = libm::atan(slope);
            let mut knot = Knot { y: 0.0, rise: 0.0 };
            let mut knots = vec![knot];
            for (length, bend) in pieces {
                knot = Knot {
                    y: knot.y + length,
                    rise: knot.rise + length * libm::tan(angle),
                };
                knots.push(knot);
                angle += 0.95 * bend * Spine::LARGEST_BEND;
            }
            let least = knots.iter().map(|knot| knot.rise).fold(f64::INFINITY, f64::min);
            for knot in &mut knots {
                knot.rise -= least;
            }
            Spine::new(knots).unwrap()
        })
}

proptest! {
    /// By walking: the blade at many places of its way, its slope turned along between stations, and many places of its edge.
    #[test]
    fn no_place_of_a_blade_is_farther_off_than_the_deviation(
        spine in spines(), overhang in 1.0..60.0_f64, beyond in prop_oneof![0.0..100.0_f64, 100.0..2000.0_f64],
        places in prop::collection::vec((0.0..1.0_f64, 0.0..=1.0_f64, -1.0..=1.0_f64), 200),
    ) {
        let bound = spine.deviation(overhang);
        let stations = spine.stations(beyond);
        for (which, share, e) in places {
            let pieces = stations.len() - 1;
            let number = ((which * pieces as f64) as usize).min(pieces - 1);
            let [from, to] = [stations[number], stations[number + 1]];
            let t = from.y + share * (to.y - from.y);
            if t < -overhang || t > spine.depth() + overhang {
                continue;
            }
            let slope = from.slope + share * (to.slope - from.slope);
            let e = e * overhang;
            let off = spine.rise(t) + slope * e - spine.rise(t + e);
            prop_assert!(off <= bound.above + 1e-9 && -off <= bound.below + 1e-9, "{off} {bound:?}");
        }
    }

    #[test]
    fn the_highest_place_of_a_stretch_is_found(spine in spines(), ends in (0.0..1.0_f64, 0.0..1.0_f64)) {
        let at = |share: f64| share * spine.depth();
        let (from, to) = (at(ends.0.min(ends.1)), at(ends.0.max(ends.1)));
        let highest = spine.highest(from, to);
        let walked = (0..=500).map(|k| spine.rise(from + (to - from) * f64::from(k) / 500.0));
        let walked = walked.fold(f64::NEG_INFINITY, f64::max);
        prop_assert!(walked <= highest + 1e-9 && highest <= walked + 0.2, "{walked} {highest}");
    }
}
