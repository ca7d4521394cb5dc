//! Slits against samples of the blade, and against published figures.

use super::*;
use crate::testkit::{any_region, bulged, circle, pocket, polygon, rectangle, region};
use proptest::prelude::*;

const fn knife(keep: f64) -> Knife {
    Knife {
        half_apex: 7.13 * core::f64::consts::PI / 180.0,
        half: 0.75,
        keep,
        height: 20.0,
        run_out: 2.0,
        grid: 0.0,
    }
}

/// Slots of a blade of 7.13 deg, 20 mm deep: half its width at the top; the tip's radius in an arc of 10 mm, with the blade's side
/// 0.75 mm off; what stays at the foot; the least radius for 0.1 mm.
#[test]
fn hollow_arcs_as_published() {
    let knife = knife(0.0);
    assert!((knife.reach(FRAC_PI_2).ahead - 2.5018).abs() < 5e-5);
    let tip = knife.radius_within(10.0).unwrap();
    assert!((tip - 8.9320).abs() < 5e-5);
    assert!((10.0 - tip - 1.068).abs() < 5e-5);
    assert!((knife.least_radius(0.1).unwrap() - 31.344).abs() < 5e-3);
    // 20 mm are too high for an arc of 10 mm: at 11.28 mm no more than 0.1 mm stays.
    assert!((knife.most_height(10.0, 0.1) - 11.277).abs() < 1e-3);
    assert!(knife.radius_within(2.5).is_none());
}

/// With its leading edge upright nothing of the blade is beyond a corner, and its back edge 5.0831 mm behind.
#[test]
fn upright_edges_at_corners_as_published() {
    let knife = knife(0.0);
    let reach = knife.reach(FRAC_PI_2 + knife.half_apex);
    assert!(
        reach.ahead < 1e-12 && (reach.behind - 5.0831).abs() < 5e-5,
        "{reach:?}"
    );
}

/// How far slits of these tests keep from walls, in mm.
const KEEP: f64 = 0.01;

/// Places of the blade at several heights and times, in the plan: its faces, with its thickness.
fn sampled(slit: &Slit, knife: Knife, mut visit: impl FnMut(Place, f64)) {
    for piece in &slit.pieces {
        for step in 0..=40 {
            let share = f64::from(step) / 40.0;
            let rake = piece.rakes[0] + (piece.rakes[1] - piece.rakes[0]) * share;
            let (at, ahead) = (piece.way.at(share), piece.way.direction(share));
            for height in [0.0, 0.4, 1.0].map(|part| part * knife.height) {
                let edge = |angle: f64| height / libm::tan(angle);
                let (back, front) = (edge(rake + knife.half_apex), edge(rake - knife.half_apex));
                for along in (0..=8).map(|k| back + (front - back) * f64::from(k) / 8.0) {
                    for side in [-knife.half, knife.half] {
                        let place = at.plus(ahead.times(along)).plus(ahead.left().times(side));
                        visit(place, height);
                    }
                }
            }
        }
    }
}

/// No place of the blade is nearer to a wall than it keeps, or outside of the region but beyond its open sides.
fn stay_out_of_walls(region: &Region, slits: &[Slit], knife: Knife) {
    let walls = Walls::of(region);
    for slit in slits {
        for pair in slit.pieces.windows(2) {
            assert!(pair[0].way.to.distance(pair[1].way.from) < 1e-3, "{slit:?}");
            assert!((pair[0].rakes[1] - pair[1].rakes[0]).abs() < 1e-12);
        }
        let runs_out = region.edges().any(|edge| edge.side == Side::Open);
        sampled(slit, knife, |place, height| {
            let near = walls.distance(place);
            assert!(
                near >= knife.keep - OFF - 2e-6,
                "{near} at {place:?}, {height} up"
            );
            assert!(
                runs_out || near < OFF + 2e-6 || region.contains(place),
                "{place:?} is outside"
            );
        });
    }
}

/// The farthest that a place of a wall is from the side of the blade, corners apart: what stays at the foot.
fn left(region: &Region, slits: &[Slit], knife: Knife) -> f64 {
    let pieces = slits.iter().flat_map(|slit| &slit.pieces).map(|piece| piece.way);
    let ways = Walls::of_pieces(pieces.enumerate());
    let corners: Vec<Place> = region
        .loops()
        .iter()
        .flat_map(|ring| {
            let next = ring.iter().cycle().skip(1);
            ring.iter().zip(next).filter_map(|(one, next)| {
                let turn = one.piece.direction(1.0).cross(next.piece.direction(0.0));
                (turn > 1e-3).then_some(one.piece.to)
            })
        })
        .collect();
    let mut most: f64 = 0.0;
    for edge in region.edges().filter(|edge| edge.side == Side::Wall) {
        for step in 0..=200 {
            let at = edge.piece.at(f64::from(step) / 200.0);
            if corners
                .iter()
                .all(|corner| corner.distance(at) > 10.0 * knife.half)
            {
                most = most.max(ways.distance(at) - knife.half - knife.keep);
            }
        }
    }
    most
}

#[test]
fn slits_follow_the_walls_of_the_pockets() {
    let knife = knife(0.01);
    // Pockets 3 and 5 have hollow arcs.
    for (number, most) in [(1, 1e-6), (2, 1e-6), (3, 0.2), (4, 1e-6)] {
        let region = pocket(number);
        let slits = slits(&region, knife).unwrap_or_else(|misfit| panic!("{number}: {misfit:?}"));
        stay_out_of_walls(&region, &slits, knife);
        let left = left(&region, &slits, knife);
        assert!(left <= most, "pocket {number}: {left}");
    }
}

/// A rectangle is four slits, each from one corner to the next, with an edge upright at both.
#[test]
fn a_rectangle_is_four_slits() {
    let knife = knife(KEEP);
    let region = region(&[rectangle(0.0, 0.0, 40.0, 30.0)]);
    let slits = slits(&region, knife).unwrap();
    assert_eq!(slits.len(), 4);
    let apex = knife.half_apex;
    for slit in &slits {
        assert_eq!(slit.pieces.len(), 1);
        assert_eq!(slit.pieces[0].rakes, [FRAC_PI_2 - apex, FRAC_PI_2 + apex]);
    }
    // The blade runs up to the walls at both ends.
    let mut lengths: Vec<f64> = slits.iter().map(|slit| slit.pieces[0].way.length()).collect();
    lengths.sort_by(f64::total_cmp);
    for (length, wall) in lengths.into_iter().zip([30.0, 30.0, 40.0, 40.0]) {
        assert!(
            (length - (wall - 2.0 * KEEP)).abs() < 2.0 * OFF + 1e-6,
            "{length}"
        );
    }
    stay_out_of_walls(&region, &slits, knife);
    assert!(left(&region, &slits, knife) < 1e-6);
}

/// Around an island of two arcs the blade goes without an end.
#[test]
fn a_round_island_is_one_slit() {
    let region = region(&[rectangle(0.0, 0.0, 80.0, 80.0), circle(40.0, 40.0, 12.0)]);
    let slits = slits(&region, knife(KEEP)).unwrap();
    let around: Vec<&Slit> = slits.iter().filter(|slit| slit.pieces.len() == 2).collect();
    assert_eq!((slits.len(), around.len()), (5, 1));
    assert_eq!(around[0].pieces[1].way.to, around[0].pieces[0].way.from);
}

/// An inner circle is hollow all around, and the blade keeps its corners off it.
#[test]
fn a_round_pocket_is_one_slit() {
    let region = region(&[circle(40.0, 40.0, 20.0)]);
    let knife = knife(KEEP);
    let slits = slits(&region, knife).unwrap();
    assert_eq!(slits.len(), 1);
    stay_out_of_walls(&region, &slits, knife);
    let free = 20.0 - KEEP;
    let expected = free - (free * free - knife.reach(FRAC_PI_2).ahead.powi(2)).sqrt();
    assert!((left(&region, &slits, knife) - expected).abs() < 1e-6);
}

/// Corners of 20 deg to 160 deg: an upright edge goes up to the other wall.
#[test]
fn corners_of_all_angles() {
    let knife = knife(KEEP);
    for angle in (20..=160).step_by(10) {
        let (sin, cos) = libm::sincos(f64::from(angle).to_radians());
        let long = 60.0;
        let corners = [(0.0, 0.0), (long, 0.0), (long * cos, long * sin)];
        let region = region(&[polygon(&corners)]);
        match slits(&region, knife) {
            Ok(slits) => stay_out_of_walls(&region, &slits, knife),
            Err(misfit) => assert!(angle >= 150, "{angle}: {misfit:?}"),
        }
    }
}

#[test]
fn walls_without_room_are_named() {
    let knife = knife(KEEP);
    // A notch 4 mm wide, and the blade is 5.08 mm wide at the top.
    let notched = polygon(&[
        (0.0, 0.0),
        (40.0, 0.0),
        (40.0, 30.0),
        (22.0, 30.0),
        (22.0, 38.0),
        (18.0, 38.0),
        (18.0, 30.0),
        (0.0, 30.0),
    ]);
    let edge = region(core::slice::from_ref(&notched))
        .edges()
        .position(|edge| edge.piece.from.y == 38.0 && edge.piece.to.y == 38.0);
    let misfit = slits(&region(&[notched]), knife);
    assert!(
        matches!(misfit, Err(Misfit::NoRoom { edge: found, .. }) if Some(found) == edge),
        "{misfit:?}, {edge:?}"
    );
    let tight = bulged(&[
        (0.0, 0.0, 0.0),
        (40.0, 0.0, 0.0),
        (40.0, 28.0, 0.414_213_562_373_095_03),
        (38.0, 30.0, 0.0),
        (0.0, 30.0, 0.0),
    ]);
    assert!(
        matches!(slits(&region(&[tight]), knife), Err(Misfit::Tight { radius, .. }) if (radius - 2.0).abs() < 1e-9)
    );
}

/// Lines and arcs with coordinates that a drawing rounds turn a little where they should not, and arcs of a spline have all radii.
#[test]
fn walls_that_hardly_turn_are_one_slit() {
    let bent = polygon(&[
        (0.0, 0.0),
        (80.0, 0.0),
        (160.0, 0.0001),
        (160.0, 60.0),
        (0.0, 60.0),
    ]);
    let slits_of = |region: &Region| slits(region, knife(KEEP)).unwrap();
    let region_of_line = region(&[bent]);
    let slits = slits_of(&region_of_line);
    assert_eq!(slits.len(), 4);
    stay_out_of_walls(&region_of_line, &slits, knife(KEEP));
    // A quarter of a circle of 60 mm that goes on into one of 40 mm.
    let corner = (40.0, 60.0);
    let rounded = bulged(&[
        (corner.0 - 40.0, 0.0, 0.0),
        (100.0, 0.0, 0.198_912_367_379_658),
        (142.426_406_871, 17.573_593_129, 0.198_912_367_379_658),
        (154.142_135_624, 45.857_864_376, 0.0),
        (154.142_135_624, 120.0, 0.0),
        (0.0, 120.0, 0.0),
    ]);
    let region_of_arcs = region(&[rounded]);
    let slits = slits_of(&region_of_arcs);
    let over_arcs = slits
        .iter()
        .filter(|slit| slit.pieces.iter().any(|piece| !piece.way.is_line()));
    assert_eq!(over_arcs.map(|slit| slit.pieces.len()).collect::<Vec<_>>(), [2]);
    stay_out_of_walls(&region_of_arcs, &slits, knife(KEEP));
    let left = left(&region_of_arcs, &slits, knife(KEEP));
    assert!(left < 0.11, "{left}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn slits_of_random_regions_stay_out_of_walls(region in any_region(), keep in 0.001..0.5_f64, height in 5.0..30.0_f64) {
        let knife = Knife { height, ..knife(keep) };
        if let Ok(slits) = slits(&region, knife) {
            stay_out_of_walls(&region, &slits, knife);
        }
    }
}
