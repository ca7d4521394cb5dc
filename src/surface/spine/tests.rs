//! Spines of parts, and surfaces with them taken off, against heights.

use super::*;
use crate::testkit::{sampled, sheets, surface_over, wavy};
use proptest::prelude::*;

const NOWHERE: [f64; 4] = [0.0; 4];

fn over(size: [f64; 2], cells: [u32; 2], height: &dyn Fn(f64, f64) -> f64) -> Surface {
    let [width, depth] = size;
    surface_over(&sampled(width, depth, cells, height), NOWHERE, width, depth)
}

/// What cuts leave that are level, pitched and free, without what a blade lies off them.
fn best(surface: &Surface) -> [f64; 3] {
    let of = |rising| {
        let Fitted { spine, leaves } = surface.spine(rising)?;
        Some(leaves - spine.deviation(OVERHANG).both())
    };
    [
        Some(surface.left_by_straight_cuts()),
        of(Rising::Evenly),
        of(Rising::Freely),
    ]
    .map(|leaves| leaves.unwrap_or(f64::INFINITY))
}

/// The parts of 600 x 1000 mm that the families of cuts are compared on: the largest height left with cuts infinitely close.
#[test]
fn spines_leave_what_is_published_of_them() {
    let size = [600.0, 1000.0];
    let dome = |x: f64, y: f64| {
        let square = (x - 300.0) * (x - 300.0) + (y - 500.0) * (y - 500.0);
        (3000.0 * 3000.0 - square).sqrt() - 2900.0
    };
    let [straight, _, free] = best(&over(size, [60, 100], &dome));
    assert!((straight - 42.175).abs() < 0.05, "{straight}");
    // The knots are 24 mm apart, so the chords are up to 0.025 mm off.
    assert!((0.107 - 0.01..0.107 + 0.025).contains(&free), "{free}");

    let hypar = |x: f64, y: f64| 100.0 + (x - 300.0) * (y - 500.0) / 3000.0;
    let [straight, even, free] = best(&over(size, [60, 100], &hypar));
    assert!((straight - 100.0).abs() < 0.01, "{straight}");
    // No slope is better than none.
    assert!(even > 99.99 && free > 99.99, "{even} {free}");

    let fairing = |x: f64, y: f64| {
        let across = (x - 300.0) / 400.0;
        60.0 * libm::sin(core::f64::consts::PI * y / 1000.0) * (1.0 - across * across)
    };
    let [straight, _, free] = best(&over(size, [60, 100], &fairing));
    assert!((straight - 60.0).abs() < 0.05, "{straight}");
    assert!((16.875 - 0.1..16.875 + 0.1).contains(&free), "{free}");
}

#[test]
fn a_ramp_along_the_cuts_has_a_straight_spine() {
    let surface = over([200.0, 300.0], [4, 3], &|x, y| 20.0 + x / 10.0 - 0.15 * y + 45.0);
    let fitted = surface.spine(Rising::Evenly).unwrap();
    assert!(fitted.leaves < 1e-3, "{fitted:?}");
    assert_eq!(fitted.spine.knots().first().unwrap().rise, 45.0);
    assert_eq!(fitted.spine.knots().last().unwrap().rise, 0.0);
}

/// Nothing to follow.
#[test]
fn a_cylinder_along_the_cuts_has_no_spine() {
    let surface = over([200.0, 300.0], [40, 3], &|x, _| 20.0 + x * x / 2000.0);
    assert_eq!(surface.spine(Rising::Evenly), None);
    assert_eq!(surface.spine(Rising::Freely), None);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    #[test]
    fn a_levelled_surface_is_lower_by_its_spine(
        sheets in sheets(), x in 0.0..100.0, y in 0.0..60.0,
        bends in prop::collection::vec(-1.0..=1.0_f64, 1..12), slope in -0.3..0.3_f64,
    ) {
        let surface = surface_over(&sheets.over(wavy(100.0, 60.0)), NOWHERE, 100.0, 60.0);
        let spine = bent(&bends, slope);
        let levelled = surface.levelled(&spine).unwrap();
        let (before, after) = (surface.height(x, y).unwrap(), levelled.height(x, y).unwrap());
        prop_assert!((before - spine.rise(y) - after).abs() < 1e-7, "{before} {after}");
        // Its shadow is the greatest height over each x.
        let shadow = levelled.shadow().unwrap();
        let walked = (0..=600).map(|k| f64::from(k) / 10.0);
        let walked = walked.filter_map(|y| Some(surface.height(x, y)? - spine.rise(y)));
        let most = walked.fold(f64::NEG_INFINITY, f64::max);
        prop_assert!(shadow.height(x) >= most - 1e-7, "{} {most}", shadow.height(x));
    }
}

/// A spine of 60 mm whose pieces turn by shares of what they may.
fn bent(bends: &[f64], slope: f64) -> Spine {
    let apart = 60.0 / (bends.len() + 1) as f64;
    let mut angle = libm::atan(slope);
    let mut rises = vec![0.0];
    for bend in bends.iter().chain([&0.0]) {
        rises.push(rises.last().unwrap() + apart * libm::tan(angle));
        angle += 0.95 * bend * Spine::LARGEST_BEND;
    }
    let least = rises.iter().copied().fold(f64::INFINITY, f64::min);
    let last = rises.len() - 1;
    let knots = rises.iter().enumerate().map(|(number, rise)| Knot {
        y: if number == last {
            60.0
        } else {
            apart * number as f64
        },
        rise: rise - least,
    });
    Spine::new(knots.collect()).unwrap()
}
