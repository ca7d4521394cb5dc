//! Arcs for curves, against the curves by their definitions and distances by centre and radius.

use super::super::{Affine, Place, Shape, Stroke, loops};
use super::*;
use crate::curve::Nurbs;
use core::f64::consts::TAU;
use proptest::prelude::*;
use vcutc_backend_api::units::Length;

/// The distance of a point from a line or an arc, by its centre and angles.
fn distance(point: Point2, bow: &Bow) -> f64 {
    let ends = point.distance(bow.from).min(point.distance(bow.to));
    if bow.is_line() {
        let way = bow.to.minus(bow.from);
        let share = (point.minus(bow.from).dot(way) / way.dot(way)).clamp(0.0, 1.0);
        return point.distance(bow.from.lerp(bow.to, share));
    }
    let Some(center) = super::super::shape::center_of_arc(bow.from, bow.to, bow.sweep) else {
        return ends;
    };
    let angle = |of: Point2| libm::atan2(of.z - center.z, of.x - center.x);
    let ahead = (angle(point) - angle(bow.from)) * bow.sweep.signum();
    if ahead.rem_euclid(TAU) <= bow.sweep.abs() {
        return (point.distance(center) - center.distance(bow.from)).abs();
    }
    ends
}

fn on(bow: &Bow, share: f64) -> Point2 {
    match super::super::shape::center_of_arc(bow.from, bow.to, bow.sweep) {
        Some(center) if !bow.is_line() => {
            let (sin, cos) = libm::sincos(bow.sweep * share);
            let way = bow.from.minus(center);
            Point2::new(
                center.x + way.x * cos - way.z * sin,
                center.z + way.x * sin + way.z * cos,
            )
        }
        _ => bow.from.lerp(bow.to, share),
    }
}

/// The arcs of a shape that straight lines close to a loop.
fn arcs_of(shape: Shape, [from, to]: [Point2; 2]) -> Vec<Bow> {
    let stroke = |shapes| Stroke {
        kind: "SPLINE",
        place: Place { start: 0, end: 0 },
        shapes,
    };
    let mut shapes = vec![shape];
    if from.distance(to) > 1e-9 {
        shapes.push(Shape::Polyline(vec![to, Point2::new(5000.0, 7000.0), from]));
    }
    let found = loops(&[stroke(shapes)], Affine::IDENTITY, Length::mm(0.01)).unwrap();
    let ways = found.rings[0].iter().map(|piece| piece.way);
    ways.filter(|way| [way.from, way.to].iter().all(|end| end.x < 4000.0))
        .collect()
}

fn assert_close(bows: &[Bow], curve: impl Fn(f64) -> Point2) {
    let samples: Vec<Point2> = (0..=600).map(|step| curve(f64::from(step) / 600.0)).collect();
    for point in &samples {
        let off = bows
            .iter()
            .map(|bow| distance(*point, bow))
            .fold(f64::INFINITY, f64::min);
        assert!(off <= 1e-3, "{point:?} is {off} off");
    }
    // No arc leads away from the curve: polylines through so many samples are near enough to it.
    let coarse = samples
        .windows(2)
        .map(|ends| ends[0].distance(ends[1]))
        .fold(0.0, f64::max);
    for bow in bows {
        for share in [0.25, 0.5, 0.75] {
            let place = on(bow, share);
            let near = samples
                .iter()
                .map(|sample| sample.distance(place))
                .fold(f64::INFINITY, f64::min);
            assert!(near <= coarse + 1e-3, "{bow:?} leaves the curve by {near}");
        }
    }
    for pair in bows.windows(2) {
        assert_eq!(pair[0].to, pair[1].from);
    }
}

fn bernstein(control: &[Point2], weights: &[f64], t: f64) -> Point2 {
    let degree = control.len() - 1;
    let mut binomial = 1.0;
    let (mut x, mut z, mut w) = (0.0, 0.0, 0.0);
    for (i, point) in control.iter().enumerate() {
        let weight = weights[i] * binomial * libm::pow(t, i as f64) * libm::pow(1.0 - t, (degree - i) as f64);
        x += weight * point.x;
        z += weight * point.z;
        w += weight;
        binomial = binomial * (degree - i) as f64 / (i + 1) as f64;
    }
    Point2::new(x / w, z / w)
}

fn points(raw: &[(f64, f64)]) -> Vec<Point2> {
    raw.iter().map(|&(x, z)| Point2::new(x, z)).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(16))]
    #[test]
    fn bezier_curves_stay_within_a_micrometre(raw in prop::collection::vec((-60.0..60.0f64, -60.0..60.0f64), 3..7)) {
        let control = points(&raw);
        let (from, to) = (control[0], control[control.len() - 1]);
        prop_assume!(from.distance(to) > 1.0);
        let weights = vec![1.0; control.len()];
        assert_close(&arcs_of(Shape::Bezier(control.clone()), [from, to]), |t| bernstein(&control, &weights, t));
    }

    #[test]
    fn splines_with_weights_stay_within_a_micrometre(
        raw in prop::collection::vec((-60.0..60.0f64, -60.0..60.0f64, 0.2..5.0f64), 4..=4),
    ) {
        let control: Vec<Point2> = raw.iter().map(|&(x, z, _)| Point2::new(x, z)).collect();
        let weights: Vec<f64> = raw.iter().map(|point| point.2).collect();
        let (from, to) = (control[0], control[3]);
        prop_assume!(from.distance(to) > 1.0);
        let knots = vec![0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0];
        let nurbs = Nurbs { degree: 3, knots, control: control.clone(), weights: weights.clone() };
        assert_close(&arcs_of(Shape::Nurbs(nurbs), [from, to]), |t| bernstein(&control, &weights, t));
    }

    #[test]
    fn ellipses_stay_within_a_micrometre(
        half in prop::array::uniform4(-80.0..80.0f64), start in -6.0..6.0f64, sweep in 0.2..TAU, is_back: bool,
    ) {
        let half = [Point2::new(half[0], half[1]), Point2::new(half[2], half[3])];
        prop_assume!(half[0].cross(half[1]).abs() > 20.0);
        let sweep = if is_back { -sweep } else { sweep };
        let center = Point2::new(10.0, -5.0);
        let at = |t: f64| {
            let (sin, cos) = libm::sincos(start + sweep * t);
            Point2::new(
                center.x + half[0].x * cos + half[1].x * sin,
                center.z + half[0].z * cos + half[1].z * sin,
            )
        };
        prop_assume!(at(0.0).distance(at(1.0)) > 0.5);
        let ellipse = Shape::Ellipse { center, half, start, sweep };
        assert_close(&arcs_of(ellipse, [at(0.0), at(1.0)]), at);
    }
}

#[test]
fn few_arcs_are_enough_for_an_ellipse_and_four_for_a_circle() {
    let ellipse = |first: f64, second: f64| Shape::Ellipse {
        center: Point2::new(0.0, 0.0),
        half: [Point2::new(first, 0.0), Point2::new(0.0, second)],
        start: 0.0,
        sweep: TAU,
    };
    let end = [Point2::new(30.0, 0.0); 2];
    let bows = arcs_of(ellipse(30.0, 20.0), end);
    assert!((32..=128).contains(&bows.len()), "{}", bows.len());
    let bows = arcs_of(ellipse(30.0, 30.0), end);
    assert_eq!(bows.len(), 4);
    for bow in &bows {
        let center = super::super::shape::center_of_arc(bow.from, bow.to, bow.sweep).unwrap();
        assert!(libm::hypot(center.x, center.z) < 1e-6, "{bow:?}");
    }
}

/// A kink of a spline, at a knot that repeats, stays one: arcs end there.
#[test]
fn kinks_stay_kinks() {
    let control = points(&[
        (0.0, 0.0),
        (10.0, 0.0),
        (20.0, 0.0),
        (30.0, 10.0),
        (20.0, 20.0),
        (10.0, 20.0),
        (0.0, 30.0),
    ]);
    let knots = vec![0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 2.0, 2.0, 2.0, 2.0];
    let nurbs = Nurbs {
        degree: 3,
        knots,
        control: control.clone(),
        weights: Vec::new(),
    };
    let bows = arcs_of(Shape::Nurbs(nurbs), [control[0], control[6]]);
    assert!(
        bows.iter()
            .any(|bow| bow.to.distance(Point2::new(30.0, 10.0)) < 1e-9)
    );
    assert!(bows.len() < 40, "{}", bows.len());
}

#[test]
fn arcs_of_more_than_half_a_turn_come_in_halves() {
    let (from, to) = (Point2::new(10.0, 0.0), Point2::new(0.0, 10.0));
    let halves = Bow::of_arc(from, to, -1.5 * PI);
    assert_eq!(halves.len(), 2);
    // To the right about the origin, past its far side.
    let top = Point2::new(-10.0 * 0.5_f64.sqrt(), -10.0 * 0.5_f64.sqrt());
    assert!(halves[0].to.distance(top) < 1e-12, "{halves:?}");
    let straight = Bow::of_arc(from, to, 1e-12);
    assert_eq!(straight, [Bow::line(from, to)]);
}
