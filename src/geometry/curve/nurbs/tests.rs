//! B-splines against the recursive definition of their basis, and exact circles.

use super::super::Curve;
use super::*;
use proptest::prelude::*;
use vcutc_backend_api::units::Length;

/// The basis function by the recursion of Cox and de Boor, as printed in textbooks.
fn basis(knots: &[f64], i: usize, degree: usize, t: f64) -> f64 {
    if degree == 0 {
        return f64::from(knots[i] <= t && t < knots[i + 1]);
    }
    let part = |above: f64, below: f64| if below > 0.0 { above / below } else { 0.0 };
    part(t - knots[i], knots[i + degree] - knots[i]) * basis(knots, i, degree - 1, t)
        + part(knots[i + degree + 1] - t, knots[i + degree + 1] - knots[i + 1])
            * basis(knots, i + 1, degree - 1, t)
}

fn by_definition(nurbs: &Nurbs, t: f64) -> Point2 {
    let (mut x, mut z, mut sum) = (0.0, 0.0, 0.0);
    for (i, point) in nurbs.control.iter().enumerate() {
        let share = basis(&nurbs.knots, i, nurbs.degree, t) * nurbs.weights.get(i).unwrap_or(&1.0);
        x += share * point.x;
        z += share * point.z;
        sum += share;
    }
    Point2::new(x / sum, z / sum)
}

fn flat(nurbs: &Nurbs, tolerance: f64) -> Vec<Point2> {
    let curve = Curve::nurbs(nurbs).unwrap();
    let mut points = vec![curve.start()];
    curve.flatten(Length::mm(tolerance), &mut points).unwrap();
    points
}

fn distance_to(point: Point2, polyline: &[Point2]) -> f64 {
    let to_segment = |pair: &[Point2]| {
        let way = pair[1].minus(pair[0]);
        let share = (point.minus(pair[0]).dot(way) / way.dot(way).max(1e-300)).clamp(0.0, 1.0);
        point.distance(pair[0].lerp(pair[1], share))
    };
    polyline.windows(2).map(to_segment).fold(f64::INFINITY, f64::min)
}

prop_compose! {
    fn any_nurbs()(degree in 1..6usize, more in 1..8usize)(
        control in prop::collection::vec((-50.0..50.0f64, -50.0..50.0f64), degree + more),
        steps in prop::collection::vec(prop_oneof![Just(0.0), 0.1..2.0f64], 2 * degree + more),
        weights in prop_oneof![
            Just(Vec::new()),
            prop::collection::vec(0.1..10.0f64, degree + more),
        ],
        degree in Just(degree),
    ) -> Nurbs {
        let knots = std::iter::once(0.0).chain(steps.into_iter().scan(0.0, |at, step| { *at += step; Some(*at) }));
        Nurbs {
            degree,
            knots: knots.collect(),
            control: control.into_iter().map(|(x, z)| Point2::new(x, z)).collect(),
            weights,
        }
    }
}

proptest! {
    #[test]
    fn the_polyline_follows_the_definition(nurbs in any_nurbs(), tolerance in 1e-3..0.1f64) {
        let Ok(curve) = Curve::nurbs(&nurbs) else {
            return Ok(());
        };
        let mut points = vec![curve.start()];
        curve.flatten(Length::mm(tolerance), &mut points).unwrap();
        let (from, to) = (nurbs.knots[nurbs.degree], nurbs.knots[nurbs.control.len()]);
        for i in 0..40 {
            let point = by_definition(&nurbs, from + (to - from) * f64::from(i) / 40.0);
            prop_assert!(distance_to(point, &points) <= tolerance + 1e-9);
        }
    }
}

#[test]
fn weights_make_an_exact_quarter_circle() {
    let points = flat(
        &Nurbs {
            degree: 2,
            knots: vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0],
            control: vec![
                Point2::new(10.0, 0.0),
                Point2::new(10.0, 10.0),
                Point2::new(0.0, 10.0),
            ],
            weights: vec![1.0, core::f64::consts::FRAC_1_SQRT_2, 1.0],
        },
        1e-4,
    );
    for pair in points.windows(2) {
        assert!((libm::hypot(pair[0].x, pair[0].z) - 10.0).abs() < 1e-12);
        let middle = pair[0].lerp(pair[1], 0.5);
        assert!(libm::hypot(middle.x, middle.z) > 10.0 - 1e-4);
    }
}

#[test]
fn what_is_not_a_spline_is_refused() {
    let good = Nurbs {
        degree: 2,
        knots: vec![0.0, 0.0, 0.0, 1.0, 2.0, 2.0, 2.0],
        control: (0..4).map(|i| Point2::new(f64::from(i), 0.0)).collect(),
        weights: Vec::new(),
    };
    let why = |change: &dyn Fn(&mut Nurbs)| {
        let mut nurbs = good.clone();
        change(&mut nurbs);
        Curve::nurbs(&nurbs).unwrap_err()
    };
    assert!(Curve::nurbs(&good).is_ok());
    assert_eq!(why(&|n| n.degree = 0), NurbsError::Degree { most: 63 });
    assert_eq!(why(&|n| n.degree = 4), NurbsError::TooFewPoints { least: 5 });
    assert_eq!(why(&|n| n.knots.truncate(6)), NurbsError::KnotCount { wanted: 7 });
    assert_eq!(why(&|n| n.knots[3] = 3.0), NurbsError::KnotsDecrease { index: 4 });
    assert_eq!(
        why(&|n| n.knots[3] = f64::NAN),
        NurbsError::KnotsDecrease { index: 3 }
    );
    assert_eq!(
        why(&|n| n.knots = vec![1.0; 7]),
        NurbsError::KnotRepeats { index: 3 }
    );
    assert_eq!(why(&|n| n.weights = vec![1.0; 3]), NurbsError::WeightCount);
    assert_eq!(
        why(&|n| n.weights = vec![1.0, 0.0, 1.0, 1.0]),
        NurbsError::BadWeight { index: 1 }
    );
    let out_of_range = NurbsError::Curve(CurveError::OutOfRange { index: 0 });
    assert_eq!(why(&|n| n.control[0].x = 1e10), out_of_range);
}
