//! Lofts against ruled surfaces in closed form.

use super::*;
use crate::testkit::{FIXED, surface_over};
use proptest::prelude::*;
use vcutc_geometry::curve::Point2;

fn profile(points: impl IntoIterator<Item = (f64, f64)>) -> Profile {
    Profile::new(points.into_iter().map(|(x, z)| Point2::new(x, z)).collect()).unwrap()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]
    #[test]
    fn it_stays_within_its_tolerance_of_the_rulings(
        heights in prop::collection::vec(prop::array::uniform2(0.0..40.0f64), 3..12),
        spans in prop::array::uniform2((-20.0..0.0f64, 100.0..140.0f64)),
        tolerance in 0.005..0.5f64, share in 0.01..0.99f64, y in 0.0..200.0f64,
    ) {
        let count = heights.len() - 1;
        let x = |end: usize, share: f64| spans[end].0 + share * (spans[end].1 - spans[end].0);
        let make = |end: usize| {
            profile(heights.iter().enumerate().map(|(i, h)| (x(end, i as f64 / count as f64), h[end])))
        };
        let ends = [make(0), make(1)];
        let mesh = loft(&[(Length::ZERO, &ends[0]), (Length::mm(200.0), &ends[1])], Length::mm(tolerance)).unwrap();
        // A place on the ruling of this share.
        let v = y / 200.0;
        let place = x(0, share) * (1.0 - v) + x(1, share) * v;
        prop_assume!((0.0..=100.0).contains(&place));
        let z = [0, 1].map(|end| ends[end].height(x(end, share)));
        let surface = surface_over(&mesh, FIXED, 100.0, 200.0);
        let off = surface.height(place, y).unwrap() - (z[0] * (1.0 - v) + z[1] * v);
        // The tolerance is in space; along z it grows with the slope.
        let slope = heights.windows(2).flat_map(|p| [(p[1][0] - p[0][0]).abs(), (p[1][1] - p[0][1]).abs()])
            .fold(0.0, f64::max) * count as f64 / 100.0 + 40.0 / 200.0;
        prop_assert!(off.abs() <= tolerance * (1.0 + slope), "{off}");
    }
}

#[test]
fn rulings_of_a_hypar_are_met() {
    // z = x y / 100 over 100 by 50, from two straight profiles; nothing but the corners is given.
    let ends = [
        profile([(0.0, 0.0), (100.0, 0.0)]),
        profile([(0.0, 0.0), (100.0, 50.0)]),
    ];
    let mesh = loft(
        &[(Length::ZERO, &ends[0]), (Length::mm(50.0), &ends[1])],
        Length::mm(0.05),
    )
    .unwrap();
    let surface = surface_over(&mesh, FIXED, 100.0, 50.0);
    let mut worst: f64 = 0.0;
    for i in 0..=50 {
        for j in 0..=50 {
            let (x, y) = (2.0 * f64::from(i), 0.1 + 0.998 * f64::from(j));
            worst = worst.max((surface.height(x, y).unwrap() - x * y / 100.0).abs());
        }
    }
    assert!(worst <= 0.05 && worst > 0.005, "{worst}");
}

#[test]
fn profiles_that_do_not_ascend_are_refused() {
    let flat = profile([(0.0, 1.0), (9.0, 1.0)]);
    let at = |y: f64| (Length::mm(y), &flat);
    let tolerance = Length::mm(0.01);
    assert_eq!(loft(&[at(0.0)], tolerance), Err(LoftError::TooFew));
    assert_eq!(
        loft(&[at(0.0), at(5.0), at(5.0)], tolerance),
        Err(LoftError::NotAscending { index: 2 })
    );
    assert_eq!(
        loft(&[at(0.0), at(f64::NAN)], tolerance),
        Err(LoftError::NotAscending { index: 1 })
    );
    assert_eq!(loft(&[at(0.0), at(1.0)], Length::ZERO), Err(LoftError::Tolerance));
}
