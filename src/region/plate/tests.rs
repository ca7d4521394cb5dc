//! The outline of a stroke against places of the blade on its way.

use super::*;
use core::f64::consts::TAU;
use proptest::prelude::*;

/// Places of the rectangle at a share of the way.
fn places(stroke: &Stroke, share: f64) -> Vec<Place> {
    let [from, to] = stroke.reaches;
    let mix = |from: f64, to: f64| from + (to - from) * share;
    let (behind, ahead) = (mix(from.behind, to.behind), mix(from.ahead, to.ahead));
    let (at, way) = (stroke.way.at(share), stroke.way.direction(share));
    let mut places = Vec::new();
    for k in 0..=10 {
        for side in [-1.0, -0.5, 0.0, 0.5, 1.0] {
            let along = -behind + (behind + ahead) * f64::from(k) / 10.0;
            places.push(
                at.plus(way.times(along))
                    .plus(way.left().times(side * stroke.half)),
            );
        }
    }
    places
}

/// Blades of some size: of a point, rounding decides whether a place of its way is passed.
fn strokes() -> impl Strategy<Value = Stroke> {
    let reach = || (0.05..8.0_f64, 0.05..8.0_f64).prop_map(|(behind, ahead)| Reach { behind, ahead });
    let way = (
        1.0..40.0_f64,
        prop_oneof![Just(0.0), 0.1..6.0_f64, -6.0..-0.1_f64],
        0.0..TAU,
    );
    (way, reach(), reach(), 0.05..2.0_f64).prop_map(|((chord, sweep, turn), from, to, half)| {
        let (sin, cos) = libm::sincos(turn);
        let end = Place::new(10.0 + chord * cos, -5.0 + chord * sin);
        let way = Piece::arc(Place::new(10.0, -5.0), end, sweep);
        // Half the thickness of the blade stays below the radius of its way.
        let half = way.radius().map_or(half, |radius| half.min(0.9 * radius));
        Stroke {
            way,
            reaches: [from, to],
            half,
        }
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(500))]

    /// No place of the blade, at any time, is nearer to a wall than the outline, unless the wall is passed as a whole; and each is passed.
    #[test]
    fn the_outline_bounds_what_is_passed(stroke in strokes(), at in (0.0..TAU, 60.0..200.0_f64)) {
        let centre = stroke.way.at(0.5);
        let wall = centre.plus(Place::new(libm::cos(at.0), libm::sin(at.0)).times(at.1));
        let walls = Walls::of_pieces([(0, Piece::line(wall, wall.plus(Place::new(1e-3, 0.0))))]);
        prop_assume!(!stroke.passes(wall));
        let near = stroke.nearest_to(&walls).unwrap().1.distance;
        for k in 0..=60 {
            let share = f64::from(k) / 60.0;
            for place in places(&stroke, share) {
                prop_assert!(walls.distance(place) >= near - 1e-9);
                let inward = place.lerp(stroke.way.at(share), 1e-6);
                prop_assert!(stroke.passes(inward), "{place:?} at {share}");
            }
        }
    }

    /// A place that is not passed lies in no rectangle, and one far away is not passed.
    #[test]
    fn what_is_passed_is_passed_at_some_time(stroke in strokes(), x in -50.0..70.0_f64, y in -70.0..60.0_f64) {
        let place = Place::new(x, y);
        let near = (0..=4000).map(|k| {
            let share = f64::from(k) / 4000.0;
            let whole = Stroke { reaches: [stroke.widest(); 2], ..stroke };
            let (at, way) = (whole.way.at(share), whole.way.direction(share));
            let from = place.minus(at);
            let (along, aside) = (from.dot(way), from.dot(way.left()));
            let reach = whole.reaches[0];
            (along - reach.ahead).max(-reach.behind - along).max(aside.abs() - whole.half)
        }).fold(f64::INFINITY, f64::min);
        // Along a line the widest reach counts nowhere but at the end that has it.
        if !stroke.way.is_line() || stroke.reaches[0] == stroke.reaches[1] {
            if near < -0.1 { prop_assert!(stroke.passes(place), "{near}"); }
            if near > 0.1 { prop_assert!(!stroke.passes(place), "{near}"); }
        }
    }
}

/// A blade of 7.13 deg at a rake of 60 deg, 20 mm over its tip, lies 8.436 mm to 15.142 mm ahead.
#[test]
fn a_leaning_blade_is_ahead_of_its_tip() {
    let deg = f64::to_radians;
    let reach = Reach::at(deg(60.0), deg(7.13), 20.0);
    assert!(
        (reach.ahead - 15.142).abs() < 5e-4 && reach.behind == 0.0,
        "{reach:?}"
    );
    // Its back edge is where the front edge of a blade with the opposite apex would be.
    assert!((20.0 / libm::tan(deg(60.0 + 7.13)) - 8.436).abs() < 5e-4);
}
