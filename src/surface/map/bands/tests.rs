//! Maps of bands against angles that are looked up place by place.

use super::{Band, Cells};
use crate::map::Map;
use proptest::prelude::*;
use vcutc_backend_api::units::{Angle, Length};

const SIZE: [f64; 2] = [100.0, 60.0];

fn band(x: [f64; 2], angles: &[(f64, f64)]) -> Band {
    let angles = angles.iter().map(|&(y, angle)| (y, Angle::deg(angle))).collect();
    Band { x, angles }
}

/// The angle of a band at a y, looked up in another way than the map does.
fn angle(band: &Band, y: f64) -> Option<f64> {
    let after = band.angles.iter().position(|(place, _)| *place >= y)?;
    let (to, last) = band.angles[after];
    let (from, first) = band.angles[after.checked_sub(1)?];
    let share = (y - from) / (to - from);
    Some((1.0 - share) * first.to_deg() + share * last.to_deg())
}

/// Three bands beside each other, with a gap before the last one, which ends before the plan does.
fn bands() -> impl Strategy<Value = Vec<Band>> {
    let angles = prop::collection::vec(0.0..20.0f64, 7);
    prop::collection::vec(angles, 3).prop_map(|all| {
        let xs = [[0.0, 31.0], [31.0, 62.0], [80.0, 100.0]];
        let lengths = [60.0, 60.0, 40.0];
        let numbered = xs.into_iter().zip(lengths).zip(all);
        numbered
            .map(|((x, long), angles)| {
                let places = (0..).map(|number| long * f64::from(number) / 6.0);
                band(x, &places.zip(angles).collect::<Vec<_>>())
            })
            .collect()
    })
}

proptest! {
    /// No place of a band is greater than its cell, some place in the cell is as great, and cells without a band are empty.
    #[test]
    fn cells_hold_the_greatest_angle_of_their_bands(all in bands(), columns in 1..40u32, rows in 1..20u32) {
        let map = Map::of_bands(&all, Cells { columns, rows }, SIZE).unwrap().unwrap();
        for row in 0..rows {
            let [low, high] = [row, row + 1].map(|number| SIZE[1] * f64::from(number) / f64::from(rows));
            for column in 0..columns {
                let [left, right] = [column, column + 1].map(|number| SIZE[0] * f64::from(number) / f64::from(columns));
                let over = all.iter().filter(|band| band.x[0] < right - 1e-6 && band.x[1] > left + 1e-6);
                let inside = (1..400).map(|share| low + (high - low) * f64::from(share) / 400.0);
                let most = over.flat_map(|band| inside.clone().filter_map(|y| angle(band, y))).reduce(f64::max);
                let cell = map.cells[(row * columns + column) as usize].map(Angle::to_deg);
                match (most, cell) {
                    (Some(most), Some(cell)) => {
                        // Between the samples an angle changes by no more than the steepest change makes of their distance.
                        prop_assert!(cell >= most - 1e-9 && cell <= most + 0.5, "{cell} {most}");
                    }
                    (most, cell) => prop_assert!(most.is_none() && cell.is_none(), "{most:?} {cell:?}"),
                }
            }
        }
        let greatest = all.iter().flat_map(|band| &band.angles).map(|(_, angle)| angle.to_deg()).fold(0.0, f64::max);
        prop_assert!((map.highest.height.to_deg() - greatest).abs() < 1e-9);
    }
}

/// Of two bands, one level and one that rises to 12 deg and falls: mean, extremes and their places by hand. What lies beside the plan
/// is left out.
#[test]
fn two_bands_are_as_computed_by_hand() {
    let bands = [
        band([-20.0, 50.0], &[(-10.0, 4.0), (70.0, 4.0)]),
        band([50.0, 100.0], &[(0.0, 2.0), (30.0, 12.0), (60.0, 2.0)]),
    ];
    let map = Map::of_bands(&bands, Cells { columns: 2, rows: 2 }, SIZE);
    let map = map.unwrap().unwrap();
    assert!((map.mean.to_deg() - (4.0 + 7.0) / 2.0).abs() < 1e-9);
    assert!((map.lowest.height.to_deg() - 2.0).abs() < 1e-9);
    assert!((map.highest.height.to_deg() - 12.0).abs() < 1e-9);
    assert_eq!(map.highest.place[1], Length::mm(30.0));
    let cells: Vec<f64> = map.cells.iter().map(|cell| cell.unwrap().to_deg()).collect();
    let wanted = [4.0, 12.0, 4.0, 12.0];
    assert!(
        cells.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 1e-9),
        "{cells:?}"
    );
}

#[test]
fn without_bands_over_the_plan_there_is_no_map() {
    let cells = Cells { columns: 4, rows: 4 };
    let beside = band([120.0, 140.0], &[(0.0, 3.0), (60.0, 3.0)]);
    let place = band([0.0, 40.0], &[(0.0, 3.0)]);
    for bands in [&[][..], &[beside], &[place]] {
        assert_eq!(Map::of_bands(bands, cells, SIZE).unwrap(), None);
    }
}
