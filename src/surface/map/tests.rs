//! Maps against closed forms and dense sampling.

use super::*;
use crate::mesh::Mesh;
use crate::testkit::{FIXED, placed, rectangles, sampled, sheets, surface_over, wavy, with_needle};
use proptest::prelude::*;
use vcutc_backend_api::geometry::Point3;
use vcutc_geometry::curve::Point2;

const fn cells(columns: u32, rows: u32) -> Cells {
    Cells { columns, rows }
}

fn machined(points: &[(f64, f64)]) -> Machined {
    Machined::new(points.iter().map(|&(x, z)| Point2::new(x, z)).collect()).unwrap()
}

fn millimetres(map: &Map) -> Vec<f64> {
    map.cells.iter().map(|cell| cell.unwrap().to_mm()).collect()
}

fn assert_near(found: &[f64], wanted: &[f64]) {
    let is_near = |(a, b): (&f64, &f64)| (a - b).abs() < 1e-9;
    assert!(
        found.len() == wanted.len() && found.iter().zip(wanted).all(is_near),
        "{found:?} {wanted:?}"
    );
}

/// p = 10 + y/10, and above it E = 20 up to x = 40, 14 from there on: a step on a border of cells.
#[test]
fn a_step_on_a_border_colours_one_side_only() {
    let wedge = sampled(100.0, 60.0, [7, 5], &|_, y| 10.0 + y / 10.0);
    let surface = surface_over(&wedge, FIXED, 100.0, 60.0);
    let heights = surface.heights(cells(5, 3)).unwrap().unwrap();
    assert_near(
        &millimetres(&heights),
        &[[12.0; 5], [14.0; 5], [16.0; 5]].concat(),
    );
    assert_near(
        &[heights.lowest, heights.highest].map(|over| over.height.to_mm()),
        &[10.0, 16.0],
    );
    assert_near(&[heights.mean.to_mm()], &[13.0]);

    let steps = machined(&[(0.0, 20.0), (40.0, 20.0), (40.0, 14.0), (100.0, 14.0)]);
    let left = surface.left_over(&steps, cells(5, 3)).unwrap().unwrap();
    let row = |far: f64, near: f64| [far, far, near, near, near];
    let wanted = [row(10.0, 4.0), row(8.0, 2.0), row(6.0, 0.0)].concat();
    assert_near(&millimetres(&left), &wanted);
    assert_near(&[left.mean.to_mm()], &[7.0 * 0.4 + 0.6]);
    let Over { height, place } = left.lowest;
    assert_near(&[height.to_mm(), place[1].to_mm()], &[-2.0, 60.0]);
    // With the step within a cell, that cell has the worse side.
    let moved = machined(&[(0.0, 20.0), (40.1, 20.0), (40.1, 14.0), (100.0, 14.0)]);
    let left = surface.left_over(&moved, cells(5, 1)).unwrap().unwrap();
    assert_near(&millimetres(&left), &[10.0, 10.0, 10.0, 4.0, 4.0]);
}

/// A wall of the part on a border of cells: the low side has what stands over the floor, the high side has not.
#[test]
fn a_wall_of_the_part_colours_its_own_sides() {
    let mesh = rectangles([[0.0, 30.0, 10.0], [30.0, 60.0, 2.0]]);
    let surface = surface_over(&mesh, FIXED, 100.0, 60.0);
    let level = machined(&[(0.0, 12.0), (100.0, 12.0)]);
    let left = surface.left_over(&level, cells(1, 4)).unwrap().unwrap();
    assert_near(&millimetres(&left), &[2.0, 2.0, 10.0, 10.0]);
    let heights = surface.heights(cells(1, 4)).unwrap().unwrap();
    assert_near(&millimetres(&heights), &[10.0, 10.0, 2.0, 2.0]);
}

#[test]
fn needles_fins_and_cracks_count_as_they_do_elsewhere() {
    let level = machined(&[(0.0, 12.0), (100.0, 12.0)]);
    let flat = sampled(100.0, 60.0, [10, 6], &|_, _| 10.0);
    let needle = with_needle(&flat, [33.333, 17.7, 10.0], [33.333, 17.701, 15.0]);
    let heights = surface_over(&needle, FIXED, 100.0, 60.0).heights(cells(10, 6));
    let heights = millimetres(&heights.unwrap().unwrap());
    assert_near(&heights[13..14], &[15.0]);
    assert_eq!(heights.iter().filter(|&&height| height > 10.0 + 1e-9).count(), 1);

    // Upright, without any area in plan.
    let mut corners = flat.corners().to_vec();
    let first = corners.len() as u32;
    corners.extend([[5.0, 33.0, 10.0], [25.0, 33.0, 10.0], [15.0, 33.0, 16.0]].map(Point3::from));
    let triangles = [flat.triangles(), &[[first, first + 1, first + 2]]].concat();
    let fin = Mesh::new(corners, triangles).unwrap();
    let map = surface_over(&fin, FIXED, 100.0, 60.0)
        .heights(cells(10, 6))
        .unwrap()
        .unwrap();
    assert_near(&millimetres(&map)[30..33], &[13.0, 16.0, 13.0]);
    assert_near(&[map.highest.height.to_mm(), map.mean.to_mm()], &[16.0, 10.0]);

    let cracked = rectangles([[0.0, 29.995, 10.0], [30.0, 60.0, 10.0], [0.0, 60.0, -50.0]]);
    let surface = surface_over(&cracked, FIXED, 100.0, 60.0);
    let left = surface.left_over(&level, cells(1, 3)).unwrap().unwrap();
    assert_near(&millimetres(&left), &[2.0; 3]);
    let heights = surface.heights(cells(1, 3)).unwrap().unwrap();
    assert_near(&millimetres(&heights), &[10.0; 3]);
    assert_near(&[heights.lowest.height.to_mm()], &[10.0]);
}

/// The height of a polyline by a search of its own; from the left at steps.
fn height_of(points: &[Point2], x: f64) -> f64 {
    let last = points[points.len() - 1];
    let pair = points.windows(2).find(|pair| pair[0].x <= x && x < pair[1].x);
    pair.map_or(last.z, |pair| {
        pair[0].z + (pair[1].z - pair[0].z) * (x - pair[0].x) / (pair[1].x - pair[0].x)
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn no_cell_is_lower_than_dense_sampling_finds(
        sheets in sheets(), frame in placed(), columns in 1..40_u32, rows in 1..30_u32,
        steps in prop::collection::vec((1.0..20.0f64, -10.0..30.0f64, prop::option::of(-10.0..30.0f64)), 2..10),
    ) {
        let mut points = vec![Point2::new(0.0, 5.0)];
        for &(step, z, jump) in &steps {
            let x = points[points.len() - 1].x + step;
            points.push(Point2::new(x, z));
            points.extend(jump.map(|z| Point2::new(x, z)));
        }
        let machined = Machined::new(points.clone()).unwrap();
        let surface = surface_over(&sheets.over(wavy(100.0, 60.0)), frame, 100.0, 60.0);
        let heights = surface.heights(cells(columns, rows)).unwrap().unwrap();
        let left = surface.left_over(&machined, cells(columns, rows)).unwrap().unwrap();
        const ACROSS: u32 = 300;
        const ALONG: u32 = 200;
        for i in 0..ACROSS {
            for j in 0..ALONG {
                let (u, v) = ((f64::from(i) + 0.513) / f64::from(ACROSS), (f64::from(j) + 0.487) / f64::from(ALONG));
                let [column, row] = [(u, columns), (v, rows)].map(|(share, count)| (share * f64::from(count)) as usize);
                let place = row * columns as usize + column;
                let (x, y) = (100.0 * u, 60.0 * v);
                let height = surface.height(x, y).unwrap();
                for (map, sample) in [(&heights, height), (&left, height_of(&points, x) - height)] {
                    let found = map.cells[place].unwrap().to_mm();
                    prop_assert!(found >= sample - 1e-9, "{x} {y}: {found} {sample}");
                    prop_assert!(found <= map.highest.height.to_mm());
                }
            }
        }
        // All cells together are the whole.
        let residual = surface.residual(&machined).unwrap().unwrap();
        let [whole, lowest] = [residual.highest, residual.lowest].map(|over| over.height.to_mm());
        prop_assert!((left.highest.height.to_mm() - whole).abs() < 1e-6, "{} {whole}", left.highest.height.to_mm());
        prop_assert!((left.lowest.height.to_mm() - lowest).abs() < 1e-6, "{} {lowest}", left.lowest.height.to_mm());
        let highest = surface.highest().unwrap().z;
        prop_assert!((heights.highest.height.to_mm() - highest).abs() < 1e-6, "{highest}");
    }

    /// On a smooth part under smooth cuts no cell is higher than a sample near its worst place by more than the slope allows.
    #[test]
    fn no_cell_is_higher_than_its_samples_allow(columns in 1..25_u32, rows in 1..15_u32, sag in 0.0..8.0_f64) {
        let surface = surface_over(&wavy(100.0, 60.0), FIXED, 100.0, 60.0);
        let points: Vec<Point2> = (0..=50).map(|i| Point2::new(2.0 * f64::from(i), 14.0 + sag * libm::sin(f64::from(i) / 3.0))).collect();
        let machined = Machined::new(points.clone()).unwrap();
        let left = surface.left_over(&machined, cells(columns, rows)).unwrap().unwrap();
        const FINE: u32 = 24;
        for row in 0..rows {
            for column in 0..columns {
                let samples = (0..=FINE).flat_map(|i| (0..=FINE).map(move |j| [i, j])).map(|[i, j]| {
                    let x = 100.0 * (f64::from(column) + f64::from(i) / f64::from(FINE)) / f64::from(columns);
                    let y = 60.0 * (f64::from(row) + f64::from(j) / f64::from(FINE)) / f64::from(rows);
                    height_of(&points, x) - surface.height(x, y).unwrap()
                });
                let most = samples.fold(f64::NEG_INFINITY, f64::max);
                let found = left.cells[(row * columns + column) as usize].unwrap().to_mm();
                // Steeper than any slope of both, over half the way between samples.
                let [dx, dy] = [100.0 / f64::from(columns * FINE), 60.0 / f64::from(rows * FINE)];
                let slack = (0.7 + 1.4) * dx / 2.0 + 0.7 * dy / 2.0;
                prop_assert!(most - 1e-9 <= found && found <= most + slack, "{column} {row}: {most} {found} {slack}");
            }
        }
    }
}
