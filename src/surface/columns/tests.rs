//! Covers of parts by straight and by curved ways, against heights.

use super::*;
use crate::testkit::{sampled, surface_over};
use proptest::prelude::*;

const SIZE: [f64; 2] = [600.0, 1000.0];

fn over(cells: [u32; 2], height: &dyn Fn(f64, f64) -> f64) -> Surface {
    let [width, depth] = SIZE;
    surface_over(&sampled(width, depth, cells, height), [0.0; 4], width, depth)
}

fn dome(x: f64, y: f64) -> f64 {
    let square = (x - 300.0) * (x - 300.0) + (y - 500.0) * (y - 500.0);
    (3000.0 * 3000.0 - square).sqrt() - 2900.0
}

fn hypar(x: f64, y: f64) -> f64 {
    100.0 + (x - 300.0) * (y - 500.0) / 3000.0
}

fn fairing(x: f64, y: f64) -> f64 {
    let across = (x - 300.0) / 400.0;
    60.0 * libm::sin(core::f64::consts::PI * y / 1000.0) * (1.0 - across * across)
}

/// The parts of 600 x 1000 mm that the families of cuts are compared on: the largest height left with cuts infinitely close.
#[test]
fn fans_leave_what_is_published_of_them() {
    let found = over([60, 100], &hypar).columns(Each::Straight).unwrap();
    // Its triangles bulge by as much: 10 mm * 10 mm / 3000 mm / 4.
    assert!(found.leaves < 0.0085, "{}", found.leaves);
    let rise = |x: f64| found.columns.rise(x, 1000.0) - found.columns.rise(x, 0.0);
    assert!((rise(0.0) + 100.0).abs() < 1e-2 && (rise(450.0) - 50.0).abs() < 1e-2);

    let found = over([60, 100], &dome).columns(Each::Straight).unwrap();
    assert!((found.leaves - 42.175).abs() < 0.05, "{}", found.leaves);
    assert!(found.columns.steepest() < 1e-4, "{}", found.columns.steepest());

    let found = over([60, 100], &fairing).columns(Each::Straight).unwrap();
    assert!((found.leaves - 60.0).abs() < 0.05, "{}", found.leaves);
}

/// Curved ways leave nothing of the same parts, but for their chords and what a blade lies off them; and the cover is as near.
#[test]
fn columns_leave_what_is_published_of_them() {
    let bowl = |x: f64, y: f64| 200.0 - dome(x, y);
    let surfaces = [
        over([120, 200], &dome),
        over([120, 200], &bowl),
        over([120, 200], &fairing),
        over([120, 200], &hypar),
    ];
    let slabs = [[40, 65], [40, 65], [40, 75], [1, 1]];
    for (number, (surface, slabs)) in surfaces.into_iter().zip(slabs).enumerate() {
        let Covered { columns, leaves } = surface.columns(Each::Curved).unwrap();
        let off = columns.deviation(OVERHANG).both();
        assert!(leaves - off < 0.06, "{number}: {leaves} {off}");
        assert!(off < 0.28, "{number}: {off}");
        assert!(
            (slabs[0]..=slabs[1]).contains(&columns.slabs()),
            "{number}: {}",
            columns.slabs()
        );
        for row in 0..=100 {
            for column in 0..=60 {
                let (x, y) = (10.0 * f64::from(column), 10.0 * f64::from(row));
                let above = columns.cover([x, y]) - surface.height(x, y).unwrap();
                assert!((-1e-6..0.1).contains(&above), "{number} {x} {y}: {above}");
            }
        }
        let litres = surface.below_columns(&columns).unwrap().to_litres();
        assert!(litres < 0.05, "{number}: {litres}");
        // What tips that are infinitely close leave: the cover, wherever it is highest over the ways.
        let shadow = columns.shadow();
        for x in [3.0, 157.0, 300.0, 441.0, 598.0] {
            for &y in columns.knots() {
                let left = shadow.height(x) + columns.rise(x, y) - surface.height(x, y).unwrap();
                assert!((-1e-6..0.11).contains(&left), "{number} {x} {y}: {left}");
            }
        }
    }
}

/// A step along y cannot be followed: ways are smoothed, and the cover lies above it all the same.
#[test]
fn steps_are_covered() {
    let step = over([20, 100], &|_, y| if y < 500.0 { 20.0 } else { 60.0 });
    let Covered { columns, leaves } = step.columns(Each::Curved).unwrap();
    assert!(leaves > 5.0, "{leaves}");
    for row in 0..=1000 {
        let y = f64::from(row);
        assert!(
            columns.cover([311.0, y]) >= step.height(311.0, y).unwrap() - 1e-6,
            "{y}"
        );
    }
}

/// Over 600 x 1000 mm, the lines of a hypar's fan leave what the triangles lie below it, and those of a ridge across the lines
/// leave half its height over all the plan.
#[test]
fn what_lies_below_the_lines_is_measured() {
    let ridge = over([60, 2], &|_, y| if (y - 500.0).abs() < 1.0 { 30.0 } else { 10.0 });
    let found = ridge.columns(Each::Straight).unwrap();
    let litres = ridge.below_columns(&found.columns).unwrap().to_litres();
    assert!((litres - 600.0 * 1000.0 * 10.0 / 1e6).abs() < 0.01, "{litres}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// Whatever the part, its cover lies nowhere below it.
    #[test]
    fn columns_cover_their_surface(
        waves in prop::collection::vec((0.002..0.03_f64, -0.02..0.02_f64, -15.0..15.0_f64), 1..5),
        cells in (3u32..40, 3u32..40), is_curved: bool, looks in prop::collection::vec((0.0..1.0_f64, 0.0..1.0_f64), 200),
    ) {
        let height = |x: f64, y: f64| {
            let each = waves.iter().map(|(across, along, high)| high * libm::sin(x * across + y * along));
            70.0 + each.sum::<f64>()
        };
        let surface = over([cells.0, cells.1], &height);
        let each = if is_curved { Each::Curved } else { Each::Straight };
        let Covered { columns, .. } = surface.columns(each).unwrap();
        for (across, along) in looks {
            let (x, y) = (600.0 * across, 1000.0 * along);
            let part = surface.height(x, y).unwrap();
            let cover = columns.cover([x, y]);
            prop_assert!(cover >= part - 1e-6, "{x} {y}: {cover} {part}");
        }
    }
}

/// The steepest place is where the formula is steepest, and what is not steeper than ways may be is not reported.
#[test]
fn what_is_steeper_than_ways_is_found() {
    let angle = |slope: f64| libm::atan(slope).to_degrees();
    let ramp = over([60, 100], &|x, y| 5.0 + y * (0.5 + x / 2000.0));
    assert_eq!(ramp.steeper_than_ways(Each::Curved), None);
    let steeper = over([60, 100], &|x, y| 5.0 + y * (0.9 + x / 1000.0));
    for (each, most) in [(Each::Straight, 1.5), (Each::Curved, 1.5)] {
        let found = steeper.steeper_than_ways(each).unwrap();
        assert!((found.angle.to_deg() - angle(most)).abs() < 0.5, "{found:?}");
        assert!(found.place[0] > 580.0, "{found:?}");
    }
    // A step is between two rows, 10 mm apart; the line nearest to it is flat.
    let step = over([20, 100], &|_, y| if y < 500.0 { 20.0 } else { 60.0 });
    let found = step.steeper_than_ways(Each::Curved).unwrap();
    assert!((found.angle.to_deg() - angle(4.0)).abs() < 1e-6, "{found:?}");
    assert!((490.0..=500.0).contains(&found.place[1]), "{found:?}");
    assert_eq!(step.steeper_than_ways(Each::Straight), None);
}
