//! Curvatures of triangles against closed forms of what they stand for.

use super::*;
use crate::curvature::Curvature;
use crate::testkit::{FIXED, sampled, surface_over};

const CELLS: Cells = Cells {
    columns: 20,
    rows: 12,
};

/// The second derivatives of a height by differences of it, and its slopes.
fn curvature(height: &dyn Fn(f64, f64) -> f64, [x, y]: [f64; 2]) -> [f64; 2] {
    let h = 1e-3;
    let slope = [
        (height(x + h, y) - height(x - h, y)) / (2.0 * h),
        (height(x, y + h) - height(x, y - h)) / (2.0 * h),
    ];
    let middle = height(x, y);
    let xx = (height(x + h, y) - 2.0 * middle + height(x - h, y)) / (h * h);
    let yy = (height(x, y + h) - 2.0 * middle + height(x, y - h)) / (h * h);
    let corner = |i: f64, j: f64| height(x + i * h, y + j * h);
    let xy = (corner(1.0, 1.0) - corner(1.0, -1.0) - corner(-1.0, 1.0) + corner(-1.0, -1.0)) / (4.0 * h * h);
    Curvature::of_height(slope, [xx, xy, yy]).unwrap().principal()
}

/// The largest error of an estimate, in 1/mm, over all cells, which all have one.
fn worst(height: &dyn Fn(f64, f64) -> f64, parts: [u32; 2]) -> f64 {
    let surface = surface_over(&sampled(100.0, 60.0, parts, height), FIXED, 100.0, 60.0);
    let bends = surface.bends(CELLS, None);
    let places = middles(CELLS, [100.0, 60.0]);
    let errors = bends.iter().zip(places).map(|(bend, place)| {
        let found = bend.unwrap().principal;
        let wanted = curvature(height, place);
        (found[0] - wanted[0]).abs().max((found[1] - wanted[1]).abs())
    });
    errors.fold(0.0, f64::max)
}

#[test]
fn paraboloids_are_found_exactly() {
    let saddle = |x: f64, y: f64| x * y / 300.0;
    let dome = |x: f64, y: f64| 40.0 - (x - 50.0).powi(2) / 900.0 - (y - 30.0).powi(2) / 400.0;
    for parts in [[50, 30], [20, 12], [10, 6], [37, 5]] {
        for off in [worst(&saddle, parts), worst(&dome, parts)] {
            assert!(off < 1e-6, "{parts:?}: {off}");
        }
    }
}

#[test]
fn other_surfaces_are_estimated() {
    // A ball of 200 mm and waves: the error is of the order of the reach.
    let ball = |x: f64, y: f64| (200.0_f64.powi(2) - (x - 50.0).powi(2) - (y - 30.0).powi(2)).sqrt();
    let off = worst(&ball, [50, 30]);
    assert!(off < 2e-4, "{off}");
    let wave = |x: f64, y: f64| 3.0 * libm::sin(x / 15.0) + y * y / 400.0;
    // At the sides the reach is to one side: 5 mm of a curvature that changes by 0.9 1/m for each mm.
    let off = worst(&wave, [100, 60]);
    assert!(off < 5.5e-3, "{off}");
}

/// A cylinder in strips over the whole depth, whose corners lie on two sides only.
#[test]
fn long_triangles_have_a_curvature() {
    let round = |x: f64, _: f64| (300.0_f64.powi(2) - (x - 50.0).powi(2)).sqrt();
    let surface = surface_over(&sampled(100.0, 60.0, [25, 1], &round), FIXED, 100.0, 60.0);
    for bend in surface.bends(CELLS, None) {
        let bend = bend.unwrap();
        assert!((bend.principal[1] + 1.0 / 300.0).abs() < 6e-4, "{bend:?}");
        assert_eq!(bend.class(), Class::Ridge, "{bend:?}");
    }
}

#[test]
fn edges_and_steps_have_none() {
    let roof = |x: f64, _: f64| 20.0 - (x - 50.0).abs();
    let surface = surface_over(&sampled(100.0, 60.0, [50, 30], &roof), FIXED, 100.0, 60.0);
    let bends = surface.bends(CELLS, None);
    let row = &bends[..20];
    assert_eq!(row[9], None);
    assert_eq!(row[10], None);
    for place in (0..8).chain(12..20) {
        assert_eq!(row[place].unwrap().class(), Class::Flat);
    }
}

#[test]
fn rounded_heights_are_no_saddles() {
    // Heights in steps of 0.01 mm, as measuring machines print them.
    let rounded = |x: f64, y: f64| ((30.0 + (x + y) / 9.0) * 100.0).round() / 100.0;
    let surface = surface_over(&sampled(100.0, 60.0, [20, 12], &rounded), FIXED, 100.0, 60.0);
    let bends = surface.bends(CELLS, None);
    let flat = bends.iter().filter(|bend| bend.unwrap().class() == Class::Flat);
    assert!(flat.count() * 10 > bends.len() * 8);
}

#[test]
fn a_map_of_middles_has_its_extremes_there() {
    let cells = Cells { columns: 2, rows: 2 };
    let values = vec![Some(1.0), None, Some(4.0), Some(-2.0)];
    let map = Map::of_middles(values, cells, [100.0, 60.0]).unwrap();
    assert_eq!(
        (map.highest.height, map.highest.place.map(Length::to_mm)),
        (4.0, [25.0, 45.0])
    );
    assert_eq!(
        (map.lowest.height, map.lowest.place.map(Length::to_mm)),
        (-2.0, [75.0, 45.0])
    );
    assert_eq!(map.mean, 1.0);
    assert_eq!(Map::of_middles(vec![None; 4], cells, [100.0, 60.0]), None);
}
