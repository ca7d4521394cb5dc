//! Maps from sections, against heights that are looked up place by place.

use super::{Cells, Map, Standing};
use proptest::prelude::*;
use vcutc_backend_api::units::Length;
use vcutc_geometry::curve::Point2;
use vcutc_geometry::profile::Profile;

const SIZE: [f64; 2] = [100.0, 60.0];

/// Sections every 20 mm; each steps somewhere.
fn sections() -> impl Strategy<Value = Vec<Standing>> {
    let section = (prop::collection::vec(0.0..5.0f64, 6), 1.0..99.0f64);
    prop::collection::vec(section, 4).prop_map(|all| {
        let numbered = (0..).zip(all);
        numbered
            .map(|(number, (heights, step))| standing(20.0 * f64::from(number), &heights, step))
            .collect()
    })
}

fn standing(y: f64, heights: &[f64], step: f64) -> Standing {
    let places = (0..).map(|number| 20.0 * f64::from(number));
    let mut heights: Vec<Point2> = places.zip(heights).map(|(x, &z)| Point2::new(x, z)).collect();
    let at = heights.partition_point(|point| point.x <= step);
    let middle = height(&heights, step);
    heights.splice(
        at..at,
        [Point2::new(step, middle), Point2::new(step, middle + 3.0)],
    );
    Standing { y, heights }
}

/// The height over a place, looked up in another way than the map does; at a step the higher one.
fn height(heights: &[Point2], x: f64) -> f64 {
    let mut most = f64::NEG_INFINITY;
    for pair in heights.windows(2) {
        if pair[0].x <= x && x <= pair[1].x {
            let long = pair[1].x - pair[0].x;
            let share = if long > 0.0 { (x - pair[0].x) / long } else { 1.0 };
            most = most.max(pair[0].z + share * (pair[1].z - pair[0].z));
        }
    }
    most
}

proptest! {
    /// No place of a section is higher than its cell; and some place of the sections around a cell is as high.
    #[test]
    fn cells_hold_the_highest_of_their_sections(all in sections(), columns in 1..40u32, rows in 1..20u32) {
        let map = Map::of_sections(&all, Cells { columns, rows }, SIZE).unwrap();
        let cell = |column: u32, row: u32| map.cells[(row * columns + column) as usize].unwrap().to_mm();
        for row in 0..rows {
            let edges = [row, row + 1].map(|number| SIZE[1] * f64::from(number) / f64::from(rows));
            let near = all.iter().filter(|section| section.y > edges[0] - 20.0 && section.y < edges[1] + 20.0);
            let near: Vec<&Standing> = near.collect();
            for column in 0..columns {
                let [from, to] = [column, column + 1].map(|number| SIZE[0] * f64::from(number) / f64::from(columns));
                let mut most = f64::NEG_INFINITY;
                for section in &near {
                    let inside = (1..200).map(|share| from + (to - from) * f64::from(share) / 200.0);
                    let corners = section.heights.iter().map(|point| point.x);
                    let corners = corners.filter(|x| from + 1e-9 < *x && *x < to - 1e-9);
                    let highest = inside.chain(corners).map(|x| height(&section.heights, x));
                    let highest = highest.fold(f64::NEG_INFINITY, f64::max);
                    if section.y >= edges[0] && section.y <= edges[1] {
                        prop_assert!(cell(column, row) >= highest - 1e-9);
                    }
                    most = most.max(highest);
                }
                // Between the samples a height changes by no more than the steepest slope makes of their distance.
                prop_assert!(cell(column, row) <= most + 0.1, "{} {most}", cell(column, row));
            }
        }
        let highest = map.cells.iter().flatten().copied().fold(Length::ZERO, Length::max);
        prop_assert_eq!(highest, map.highest.height);
    }

    /// What stands above a profile is the difference of the heights.
    #[test]
    fn what_stands_above_a_profile_is_the_difference(
        part in prop::collection::vec(0.0..10.0f64, 7),
        contour in prop::collection::vec(0.0..10.0f64, 6),
        step in 1.0..99.0f64,
    ) {
        let places = (0..).map(|number| 100.0 / 6.0 * f64::from(number));
        let corners: Vec<Point2> = places.zip(&part).map(|(x, &z)| Point2::new(x.min(100.0), z)).collect();
        let part = Profile::new(corners).unwrap();
        let contour = standing(0.0, &contour, step).heights;
        let above = part.standing(&contour);
        for share in 0..=500 {
            let x = f64::from(share) / 5.0;
            let should = height(&contour, x) - part.height(x);
            prop_assert!((height(&above, x) - should).abs() < 1e-9, "{x}: {} {should}", height(&above, x));
        }
    }
}

/// Two sections of a wedge that rises across: mean, extremes and cells in closed form.
#[test]
fn a_wedge_is_as_computed_by_hand() {
    let wedge = |y: f64, high: f64| Standing {
        y,
        heights: vec![Point2::new(0.0, 0.0), Point2::new(100.0, high)],
    };
    let map = Map::of_sections(
        &[wedge(0.0, 2.0), wedge(60.0, 4.0)],
        Cells { columns: 2, rows: 1 },
        SIZE,
    )
    .unwrap();
    let cells: Vec<f64> = map.cells.iter().flatten().map(|cell| cell.to_mm()).collect();
    assert_eq!(cells, [2.0, 4.0]);
    assert_eq!(map.highest.place.map(Length::to_mm), [100.0, 60.0]);
    assert_eq!(map.lowest.height, Length::ZERO);
    assert!((map.mean.to_mm() - 1.5).abs() < 1e-12);
    assert_eq!(
        Map::of_sections(&[wedge(0.0, 2.0)], Cells { columns: 2, rows: 1 }, SIZE),
        None
    );
}
