//! Meshes of formulas against the formulas themselves, computed in plain numbers.

use super::*;
use crate::testkit::{FIXED, surface_over};
use proptest::prelude::*;
use vcutc_geometry::number::Scalar;

const PLAN: Plan = Plan {
    width: Length::mm(100.0),
    depth: Length::mm(60.0),
};

/// The largest deviation of the mesh from a formula in plain numbers, on places that fit no grid of halves.
fn worst(mesh: &Mesh, plain: impl Fn(f64, f64) -> f64) -> f64 {
    let surface = surface_over(mesh, FIXED, 100.0, 60.0);
    (0..=97)
        .flat_map(|i| (0..=61).map(move |j| (f64::from(i) * 100.0 / 97.0, f64::from(j) * 60.0 / 61.0)))
        .map(|(x, y)| (surface.height(x, y).unwrap() - plain(x, y)).abs())
        .fold(0.0, f64::max)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]
    #[test]
    fn polynomials_with_kinks_are_followed(
        a in -0.01..0.01f64, b in -0.01..0.01f64, c in -0.01..0.01f64, d in -1e-4..1e-4f64, lid in 0.0..30.0f64, tolerance in 0.05..0.5f64,
    ) {
        let plain = |x: f64, y: f64| {
            let (u, v) = (x - 37.0, y - 21.0);
            (a * u * u + b * u * v + c * v * v + d * u * u * v).min(lid)
        };
        let f = |x: OnPlane<Interval>, y: OnPlane<Interval>| {
            let (u, v) = (x.plus(-37.0), y.plus(-21.0));
            let sum = (u * u).times(a) + (u * v).times(b) + (v * v).times(c) + (u * u * v).times(d);
            Some(sum.lesser(OnPlane::constant(lid)))
        };
        let mesh = formula(&f, PLAN, Length::mm(tolerance)).unwrap();
        let worst = worst(&mesh, plain);
        prop_assert!(worst <= tolerance, "{worst}");
    }
}

#[test]
fn a_dome_takes_as_many_triangles_as_its_curvature_asks_for() {
    // Curvature 1/250 along both axes: boxes of 100/32 by 60/32 are off by (3.125^2 + 1.875^2)/2000 = 0.00664.
    let f = |x: OnPlane<Interval>, y: OnPlane<Interval>| {
        let (u, v) = (x.plus(-50.0), y.plus(-30.0));
        Some((u * u + v * v).times(-1.0 / 500.0).plus(20.0))
    };
    let mesh = formula(&f, PLAN, Length::mm(0.01)).unwrap();
    assert!(
        worst(&mesh, |x, y| 20.0
            - ((x - 50.0).powi(2) + (y - 30.0).powi(2)) / 500.0)
            <= 0.01
    );
    assert!(
        (1024..=4096).contains(&mesh.triangles().len()),
        "{}",
        mesh.triangles().len()
    );
}

#[test]
fn a_needle_between_samples_is_not_missed() {
    // 5 mm high and 0.02 mm wide, at no place that any grid of halves meets.
    let f = |x: OnPlane<Interval>, y: OnPlane<Interval>| {
        let (u, v) = (x.plus(-33.333), y.plus(-17.7));
        let cone = (u * u + v * v).plus(1e-12).root().times(-500.0).plus(5.0);
        Some(cone.greater(OnPlane::constant(0.0)))
    };
    let mesh = formula(&f, PLAN, Length::mm(0.05)).unwrap();
    let surface = surface_over(&mesh, FIXED, 100.0, 60.0);
    assert!((surface.height(33.333, 17.7).unwrap() - 5.0).abs() <= 0.05);
}

#[test]
fn steps_poles_and_missing_values_end_in_an_error() {
    let step = |x: OnPlane<Interval>, _: OnPlane<Interval>| {
        let at = 20.123;
        let value = match (x.value.high < at, x.value.low >= at) {
            (true, _) => Interval::exactly(1.0),
            (_, true) => Interval::exactly(2.0),
            _ => Interval { low: 1.0, high: 2.0 },
        };
        Some(OnPlane {
            value,
            by: [Interval::ZERO; 2],
            curve: [Interval::UNKNOWN; 3],
        })
    };
    // Such slopes are a lie over the step, where nothing is known of them.
    let step = |x: OnPlane<Interval>, y: OnPlane<Interval>| {
        step(x, y).map(|jet| {
            if jet.value.width() > 0.0 {
                OnPlane {
                    by: [Interval::UNKNOWN; 2],
                    ..jet
                }
            } else {
                jet
            }
        })
    };
    match formula(&step, PLAN, Length::mm(0.1)) {
        Err(FormulaError::Jump { x, .. }) => assert!((x - 20.123).abs() < 1e-5, "{x}"),
        other => panic!("{:?}", other.map(|mesh| mesh.triangles().len())),
    }
    let half = |x: OnPlane<Interval>, _: OnPlane<Interval>| (x.value.high < 40.0).then_some(x);
    match formula(&half, PLAN, Length::mm(0.1)) {
        Err(FormulaError::NoValue { x, .. }) => assert!((40.0..=40.001).contains(&x), "{x}"),
        other => panic!("{:?}", other.map(|mesh| mesh.triangles().len())),
    }
    let huge = |x: OnPlane<Interval>, _: OnPlane<Interval>| Some(x.times(1e8));
    assert!(matches!(
        formula(&huge, PLAN, Length::mm(0.1)),
        Err(FormulaError::NoValue { .. })
    ));
    let flat = |x: OnPlane<Interval>, _: OnPlane<Interval>| Some(x);
    assert_eq!(formula(&flat, PLAN, Length::ZERO), Err(FormulaError::TooFine));
    assert_eq!(
        formula(&flat, PLAN, Length::mm(1.0)).unwrap().triangles().len(),
        2
    );
}
