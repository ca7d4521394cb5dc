//! Uncut ground in closed form, by published numbers, and of rules that leave none.

use super::*;
use crate::piece::Piece;
use crate::testkit::passes::{closed, levels, open, rectangle, rings};
use crate::testkit::{any_region, pocket};
use core::f64::consts::PI;
use proptest::prelude::*;

mod polygons;
mod table;

/// What a round tool leaves in a right corner.
fn corner(radius: f64) -> f64 {
    radius * radius * (1.0 - PI / 4.0)
}

#[test]
fn corners_of_walls_are_not_reached() {
    let el = pocket(2);
    for radius in [5.0, 12.5] {
        let rest = unreachable(&el, Tool::touching(radius)).unwrap();
        let exact = 5.0 * corner(radius);
        assert!(
            rest.uncut >= exact && rest.uncut < exact + 0.05,
            "{radius}: {} {exact}",
            rest.uncut
        );
        assert_eq!(rest.spots.iter().filter(|spot| spot.area > 0.01).count(), 5);
    }
    // Half angles of 45 deg twice, and chamfers of 100 and of 119.7 deg.
    let open = unreachable(&pocket(1), Tool::touching(5.0)).unwrap();
    let left = |turn: f64| 25.0 * (libm::tan(turn / 2.0) - turn / 2.0);
    let slopes = [PI / 4.0, PI / 4.0, libm::atan2(20.0, 25.0), PI / 4.0];
    let exact = left(slopes[0]) + left(slopes[0]) + left(slopes[2]) + left(PI / 2.0 - slopes[2]);
    assert!(
        open.uncut >= exact && open.uncut < exact + 0.05,
        "{} {exact}",
        open.uncut
    );
    // With its rim kept off by 1 mm a tool leaves a strip, of which its corners are part.
    let off = unreachable(
        &rectangle(60.0, 40.0),
        Tool {
            radius: 5.0,
            keep: 6.0,
        },
    )
    .unwrap();
    let exact = 60.0 * 40.0 - 58.0 * 38.0 + 4.0 * corner(5.0);
    assert!(
        off.uncut >= exact && off.uncut < exact + 0.05,
        "{} {exact}",
        off.uncut
    );
}

/// Areas that a polygon library gives for the same passes, in mm2; steps up to the radius leave nothing.
#[test]
fn what_offsets_leave_of_the_five_pockets() {
    let known = [
        (1, 8.0, 0.0),
        (2, 6.0, 0.0),
        (2, 8.0, 7.3),
        (3, 6.0, 0.0),
        (3, 8.0, 49.9),
        (4, 6.0, 13.0),
        (4, 8.0, 148.7),
        (5, 6.0, 30.1),
        (5, 8.0, 34.0),
    ];
    for (number, step, area) in known {
        let region = pocket(number);
        let left = coverage(&region, &levels(&region, 5.0, step), Tool::touching(5.0)).unwrap();
        assert!(
            (left.uncut - area).abs() < 0.06,
            "{number} {step}: {}",
            left.uncut
        );
        assert!(left.fringe <= 1e-6);
    }
    let left = coverage(&pocket(4), &levels(&pocket(4), 5.0, 8.0), Tool::touching(5.0)).unwrap();
    assert!(
        (left.spots[0].width - 4.85).abs() < 0.02,
        "{}",
        left.spots[0].width
    );
    for number in 1..=5 {
        for step in [4.0, 5.0] {
            let region = pocket(number);
            let left = coverage(&region, &levels(&region, 5.0, step), Tool::touching(5.0)).unwrap();
            assert_eq!((left.uncut, left.spots.len()), (0.0, 0), "{number} {step}");
        }
    }
}

/// Programs have whole micrometres: passes 2 um off the walls, rounded, leave a fringe of less than that.
#[test]
fn rounded_passes_leave_a_fringe() {
    let round = |place: Place| {
        let grid = |along: f64| libm::round(along * 1e3) / 1e3;
        Place::new(grid(place.x), grid(place.y))
    };
    for number in 2..=5 {
        let region = pocket(number);
        let tool = Tool {
            radius: 5.0,
            keep: 5.002,
        };
        let mut passes = levels(&region, tool.keep, 4.0);
        for piece in passes.iter_mut().flat_map(|pass| &mut pass.pieces) {
            // The circle through three rounded places: a chord makes half the angle of its arc.
            let (from, via, to) = (round(piece.from), round(piece.at(0.5)), round(piece.to));
            let (first, second) = (via.minus(from), to.minus(via));
            let turned = 2.0 * libm::atan2(first.cross(second), first.dot(second));
            let sweep = if piece.is_line() { 0.0 } else { turned };
            *piece = Piece::arc(from, to, sweep);
        }
        let left = coverage(&region, &passes, tool).unwrap();
        assert_eq!(left.uncut, 0.0, "{number}");
        assert!(
            left.fringe > 1e-6 && left.fringe <= 2e-3,
            "{number}: {}",
            left.fringe
        );
        let least = crate::clearance::clearance(&region, &passes).least.unwrap();
        assert!(least.distance > 5.0 && least.distance < 5.002, "{least:?}");
    }
}

#[test]
fn a_missing_wall_pass_leaves_a_frame() {
    let region = rectangle(80.0, 60.0);
    let mut passes = rings(80.0, 60.0, 5.0, 4.0);
    passes.remove(0);
    let left = coverage(&region, &passes, Tool::touching(5.0)).unwrap();
    // Both outlines have the same rounded corners.
    let exact = 80.0 * 60.0 - 72.0 * 52.0;
    assert!(left.uncut >= exact && left.uncut < exact + 0.05, "{}", left.uncut);
    assert_eq!(left.spots.len(), 1);
    let width = left.spots[0].width;
    // A circle in a corner touches both walls and what the corner of the second pass sweeps: `sqrt(2) (9 - u) = u + 5`.
    let largest = 2.0 * (9.0 * 2.0_f64.sqrt() - 5.0) / (1.0 + 2.0_f64.sqrt());
    assert!(width >= largest && width < largest + 0.01, "{width} {largest}");
    // Squares cover it: the middle of each side of the frame lies in one.
    for place in [
        Place::new(40.0, 2.0),
        Place::new(2.0, 30.0),
        Place::new(78.0, 30.0),
    ] {
        assert!(left.spots[0].squares.iter().any(|square| {
            let aside = place.minus(square.low);
            (0.0..=square.side).contains(&aside.x) && (0.0..=square.side).contains(&aside.y)
        }));
    }
}

#[test]
fn without_passes_all_that_is_reachable_is_left() {
    let region = rectangle(80.0, 60.0);
    let left = coverage(&region, &[], Tool::touching(5.0)).unwrap();
    let exact = 80.0 * 60.0 - 4.0 * corner(5.0);
    assert!(left.uncut >= exact && left.uncut < exact + 0.05, "{}", left.uncut);
    assert!(
        (left.spots[0].width - 60.0).abs() < 0.07,
        "{}",
        left.spots[0].width
    );
    // A tool that does not fit reaches nothing.
    let wide = coverage(&region, &[], Tool::touching(31.0)).unwrap();
    assert_eq!(wide.uncut, 0.0);
}

#[test]
fn an_open_side_is_cut_up_to_its_end() {
    let region = pocket(1);
    let mut passes = levels(&region, 5.0, 4.0);
    assert_eq!(
        coverage(&region, &passes, Tool::touching(5.0)).unwrap().uncut,
        0.0
    );
    // Without the second level, what lies between 10 and 8 mm from the walls stays, but for corners.
    passes.retain(|pass| pass.level != 1 && pass.level != 2);
    let left = coverage(&region, &passes, Tool::touching(5.0)).unwrap();
    assert!(left.uncut > 500.0 && left.uncut < 600.0, "{}", left.uncut);
    assert!(
        left.spots[0].width > 2.0 && left.spots[0].width < 3.0,
        "{}",
        left.spots[0].width
    );
}

#[test]
fn invalid_or_too_small_tools_are_refused() {
    let region = rectangle(80.0, 60.0);
    let bad = [
        (0.0, 0.0),
        (-1.0, 5.0),
        (5.0, 4.9),
        (f64::NAN, 5.0),
        (5.0, f64::NAN),
        (5.0, f64::INFINITY),
    ];
    for (radius, keep) in bad {
        assert_eq!(
            coverage(&region, &[], Tool { radius, keep }),
            Err(CoverageFault::Tool)
        );
    }
    let fine = coverage(&region, &[], Tool::touching(1e-3));
    assert!(matches!(fine, Err(CoverageFault::Fine { .. })));
    assert!(matches!(
        coverage(&region, &[], Tool::touching(f64::MIN_POSITIVE)),
        Err(CoverageFault::Fine { .. })
    ));
}

/// Passes around a corner of 90 deg, all but the one at the wall rounded; rows clear the middle.
fn rounded_rings(step: f64, rho: f64) -> Vec<Pass> {
    let size = 160.0;
    let quarter = libm::tan(PI / 8.0);
    let mut passes = vec![closed(
        0,
        &[
            [5.0, 5.0, 0.0],
            [155.0, 5.0, 0.0],
            [155.0, 155.0, 0.0],
            [5.0, 155.0, 0.0],
        ],
    )];
    for level in 1..5 {
        let d = 5.0 + f64::from(level) * step;
        let (near, far) = (d + rho, size - d - rho);
        let end = size - d;
        passes.push(closed(
            level,
            &[
                [near, d, 0.0],
                [far, d, quarter],
                [end, near, 0.0],
                [end, far, quarter],
                [far, end, 0.0],
                [near, end, quarter],
                [d, far, 0.0],
                [d, near, quarter],
            ],
        ));
    }
    let edge = 5.0 + 4.0 * step;
    let mut y = edge;
    while y < size - edge {
        passes.push(open(&[[edge, y], [size - edge, y]]));
        y += 3.0;
    }
    passes
}

/// Between the pass at the wall and the next nothing stays iff the radius of its corners is at most
/// `(r (1 + sin phi) - s) / (1 - sin phi)`: with the vertex moved in by `rho (1 / sin phi - 1)`, the two are then as far
/// apart along the bisector as the pass at the wall reaches there, and the next one does.
#[test]
fn corners_may_be_as_round_as_the_closed_form_says() {
    let region = rectangle(160.0, 160.0);
    let sin = 0.5_f64.sqrt();
    let uncut =
        |step: f64, rho: f64| coverage(&region, &rounded_rings(step, rho), Tool::touching(5.0)).unwrap();
    for (step, known) in [(4.0, 15.4853), (5.0, 12.0711), (6.0, 8.6569)] {
        let rho = (5.0 * (1.0 + sin) - step) / (1.0 - sin);
        assert!((rho - known).abs() < 5e-5, "{rho}");
        assert!(
            uncut(step, rho).uncut < 1e-6,
            "{step}: {:?}",
            uncut(step, rho).uncut
        );
        let more = uncut(step, 1.02 * rho);
        assert!(more.uncut > 1e-4, "{step}: {:?}", more.uncut);
    }
    // On the bisector of the corner a place is as far from the legs as from the arc where
    // `u sin phi = s / sin phi + b - u`, `b` the way that the arc's vertex was moved in.
    let rho = 1.1 * 15.4853;
    let far = (4.0 / sin + rho * (1.0 / sin - 1.0)) / (1.0 + sin) * sin;
    let width = uncut(4.0, rho).spots[0].width;
    assert!(
        width >= 2.0 * (far - 5.0) && width < 2.0 * (far - 5.0) + 3e-3,
        "{width} {far}"
    );
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]
    /// Every place between two levels is within a step of the outer one.
    #[test]
    fn steps_up_to_the_radius_leave_nothing(region in any_region(), radius in 1.5..8.0f64, share in 0.3..1.0f64) {
        let passes = levels(&region, radius, radius * share);
        let left = coverage(&region, &passes, Tool::touching(radius)).unwrap();
        prop_assert!(left.uncut < 1e-6, "{} {:?}", left.uncut, left.spots.first());
        // Ends of corridors as wide as the tool are where the last nanometre decides.
        prop_assert!(left.fringe <= 2e-3, "{}", left.fringe);
    }
}
