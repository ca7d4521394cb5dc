//! Covers of parts by straight lines, against heights.

use super::*;
use crate::testkit::{sampled, surface_over};
use proptest::prelude::*;

const SIZE: [f64; 2] = [600.0, 1000.0];

fn over(cells: [u32; 2], height: &dyn Fn(f64, f64) -> f64) -> Surface {
    let [width, depth] = SIZE;
    surface_over(&sampled(width, depth, cells, height), [0.0; 4], width, depth)
}

/// How high the cover lies above a place.
fn cover(fan: &Fan, x: f64, y: f64) -> f64 {
    let [front, back] = fan.ends();
    let share = y / fan.depth();
    front.height(x) * (1.0 - share) + back.height(x) * share
}

/// The parts of 600 x 1000 mm that the families of cuts are compared on: the largest height left with cuts infinitely close.
#[test]
fn fans_leave_what_is_published_of_them() {
    let hypar = |x: f64, y: f64| 100.0 + (x - 300.0) * (y - 500.0) / 3000.0;
    let found = over([60, 100], &hypar).fan().unwrap();
    // Its triangles bulge by as much: 10 mm * 10 mm / 3000 mm / 4.
    assert!(found.leaves < 0.0085, "{}", found.leaves);
    assert!((found.fan.slope(0.0) + 0.1).abs() < 1e-5 && (found.fan.slope(450.0) - 0.05).abs() < 1e-5);

    let dome = |x: f64, y: f64| {
        let square = (x - 300.0) * (x - 300.0) + (y - 500.0) * (y - 500.0);
        (3000.0 * 3000.0 - square).sqrt() - 2900.0
    };
    let found = over([60, 100], &dome).fan().unwrap();
    assert!((found.leaves - 42.175).abs() < 0.05, "{}", found.leaves);
    assert!(found.fan.steepest() < 1e-4, "{}", found.fan.steepest());

    let fairing = |x: f64, y: f64| {
        let across = (x - 300.0) / 400.0;
        60.0 * libm::sin(core::f64::consts::PI * y / 1000.0) * (1.0 - across * across)
    };
    let found = over([60, 100], &fairing).fan().unwrap();
    assert!((found.leaves - 60.0).abs() < 0.05, "{}", found.leaves);
}

/// Over 600 x 1000 mm, the lines of a hypar's fan leave what the triangles lie below it, and those of a ridge across the lines
/// leave half its height over all the plan.
#[test]
fn what_lies_below_the_lines_is_measured() {
    let ridge = over([60, 2], &|_, y| if (y - 500.0).abs() < 1.0 { 30.0 } else { 10.0 });
    let found = ridge.fan().unwrap();
    let litres = ridge.below_fan(&found.fan).unwrap().to_litres();
    assert!((litres - 600.0 * 1000.0 * 10.0 / 1e6).abs() < 0.01, "{litres}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// Whatever the part, its cover lies nowhere below it.
    #[test]
    fn a_fan_covers_its_surface(
        waves in prop::collection::vec((0.002..0.03_f64, -0.02..0.02_f64, -15.0..15.0_f64), 1..5),
        cells in (3u32..40, 3u32..40), looks in prop::collection::vec((0.0..1.0_f64, 0.0..1.0_f64), 200),
    ) {
        let height = |x: f64, y: f64| {
            let each = waves.iter().map(|(across, along, high)| high * libm::sin(x * across + y * along));
            70.0 + each.sum::<f64>()
        };
        let surface = over([cells.0, cells.1], &height);
        let fan = surface.fan().unwrap().fan;
        for (across, along) in looks {
            let (x, y) = (600.0 * across, 1000.0 * along);
            let part = surface.height(x, y).unwrap();
            prop_assert!(cover(&fan, x, y) >= part - 1e-6, "{x} {y}: {} {part}", cover(&fan, x, y));
        }
    }
}
