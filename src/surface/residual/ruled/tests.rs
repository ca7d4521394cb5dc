//! What Vs leave over a surface, against heights at many places.

use super::super::Machined;
use super::*;
use crate::testkit::{sampled, surface_over};
use proptest::prelude::*;
use vcutc_backend_api::units::Length;
use vcutc_geometry::curve::Point2;

const SIZE: f64 = 40.0;

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    #[test]
    fn heights_and_volume_are_those_of_places(
        vees in prop::collection::vec((0.0..SIZE, 8.0..30.0_f64, 8.0..30.0_f64), 1..12),
        cells in (1u32..6, 1u32..6), twist in -0.01..0.01_f64, flank in 0.6..3.0_f64,
    ) {
        let height = |x: f64, y: f64| 4.0 + (x - 20.0) * (y - 20.0) * twist;
        let surface = surface_over(&sampled(SIZE, SIZE, [cells.0, cells.1], &height), [0.0; 4], SIZE, SIZE);
        let vees: Vec<Ruling> = vees.into_iter().map(|(x, front, back)| Ruling { x, ends: [front, back], flank }).collect();
        let level = Machined::new(vec![Point2::new(0.0, 0.0), Point2::new(SIZE, 0.0)]).unwrap();
        let machined = level.ruled(vees, SIZE, Length::mm(32.0));
        let standing = surface.standing(&machined).unwrap().unwrap();
        let count = 200;
        let (mut most, mut sum) = (0.0_f64, 0.0);
        for i in 0..count {
            for j in 0..count {
                let at = |number: i32| SIZE * (f64::from(number) + 0.5) / f64::from(count);
                let (x, y) = (at(i), at(j));
                let left = machined.height_over(x, y) - surface.height(x, y).unwrap();
                most = most.max(left);
                sum += left;
            }
        }
        let volume = sum * (SIZE / f64::from(count)).powi(2);
        let highest = standing.highest.height.to_mm();
        // Places are 0.2 mm apart.
        prop_assert!(most <= highest + 1e-9 && highest <= most + 0.2 * (flank + 1.0), "{most} {highest}");
        let measured = standing.volume.to_mm3();
        prop_assert!((volume - measured).abs() < 1e-3 * measured + 5.0, "{volume} {measured}");
    }
}
