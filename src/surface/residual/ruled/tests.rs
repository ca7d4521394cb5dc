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
        vees in prop::collection::vec((0.0..SIZE, prop::array::uniform4(8.0..30.0_f64)), 1..12), slabs in 1..4_usize,
        cells in (1u32..6, 1u32..6), twist in -0.01..0.01_f64, flank in 0.6..3.0_f64,
    ) {
        let height = |x: f64, y: f64| 4.0 + (x - 20.0) * (y - 20.0) * twist;
        let surface = surface_over(&sampled(SIZE, SIZE, [cells.0, cells.1], &height), [0.0; 4], SIZE, SIZE);
        let knots: &[f64] = match slabs {
            1 => &[0.0, SIZE],
            2 => &[0.0, 13.3, SIZE],
            _ => &[0.0, 13.3, 30.0, SIZE],
        };
        let vees = vees.into_iter().map(|(x, tips)| Column { x, tips: tips[..=slabs].into(), flank });
        let vees: Vec<Column> = vees.collect();
        let one_by_one = vees.clone();
        let level = Machined::new(vec![Point2::new(0.0, 0.0), Point2::new(SIZE, 0.0)]).unwrap();
        let machined = level.ruled(vees, knots, Length::mm(32.0));
        let standing = surface.standing(&machined).unwrap().unwrap();
        let count = 200;
        let (mut most, mut sum) = (0.0_f64, 0.0);
        for i in 0..count {
            for j in 0..count {
                let at = |number: i32| SIZE * (f64::from(number) + 0.5) / f64::from(count);
                let (x, y) = (at(i), at(j));
                let heights = one_by_one.iter().map(|vee| vee.height([x, y], knots));
                let least = heights.fold(32.0, f64::min);
                prop_assert!((machined.height_over(x, y) - least).abs() < 1e-9);
                let left = least - surface.height(x, y).unwrap();
                most = most.max(left);
                sum += left;
            }
        }
        let volume = sum * (SIZE / f64::from(count)).powi(2);
        let highest = standing.highest.height.to_mm();
        for y in [0.0, 7.0, 13.3, 29.0, SIZE] {
            let section = machined.section(y, SIZE).unwrap();
            prop_assert!(section.windows(2).all(|pair| pair[0].x <= pair[1].x));
            for pair in section.windows(2).filter(|pair| pair[0].x < pair[1].x) {
                let x = f64::midpoint(pair[0].x, pair[1].x);
                let said = f64::midpoint(pair[0].z, pair[1].z);
                prop_assert!((said - machined.height_over(x, y)).abs() < 1e-6, "{x} {y}: {said} {}", machined.height_over(x, y));
            }
        }
        // Places are 0.2 mm apart.
        prop_assert!(most <= highest + 1e-9 && highest <= most + 0.2 * (flank + 1.0), "{most} {highest}");
        let measured = standing.volume.to_mm3();
        prop_assert!((volume - measured).abs() < 1e-3 * measured + 5.0, "{volume} {measured}");
    }
}
