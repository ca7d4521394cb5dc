//! Patches against closed forms: published heights, spheres, cylinders, and sums of Bernstein polynomials.

use super::*;
use crate::surface::Surface;
use crate::testkit::{FIXED, surface_over};
use proptest::prelude::*;

/// The bicubic patch of 90 x 60 that the tests of curvature use too: rows at x = 30 i, entries at y = 20 j.
fn hill() -> Vec<Point3> {
    let heights = [
        [10.0, 12.0, 13.0, 11.0],
        [14.0, 22.0, 20.0, 12.0],
        [13.0, 21.0, 26.0, 15.0],
        [9.0, 13.0, 16.0, 8.0],
    ];
    let point = |i: usize, j: usize| Point3::new(30.0 * i as f64, 20.0 * j as f64, heights[i][j]);
    (0..16).map(|k| point(k / 4, k % 4)).collect()
}

fn bernstein(degree: i32, i: i32, t: f64) -> f64 {
    let choose = (0..i).fold(1.0, |c, k| c * f64::from(degree - k) / f64::from(k + 1));
    choose * t.powi(i) * (1.0 - t).powi(degree - i)
}

#[test]
fn the_middle_of_the_hill_is_where_it_was_computed() {
    let piece = Piece {
        degrees: [3, 3],
        control: hill().iter().map(|p| [p.x, p.y, p.z, 1.0]).collect(),
    };
    assert_eq!(piece.at(0.5, 0.5), Point3::new(45.0, 30.0, 18.171_875));
}

/// How far a surface is above a point.
fn off(surface: &Surface, point: Point3) -> f64 {
    surface.height(point.x, point.y).unwrap() - point.z
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]
    #[test]
    fn height_patches_are_within_the_tolerance(
        heights in prop::collection::vec(-30.0..30.0f64, 16), tolerance in 0.01..0.5f64, spots in prop::collection::vec((0.0..1.0f64, 0.0..1.0f64), 20),
    ) {
        // Even spacing in plan: parameters are places, and the error is along z.
        let control: Vec<Point3> = hill().iter().zip(&heights).map(|(p, &z)| Point3::new(p.x, p.y, z)).collect();
        let mesh = patches(&[Bezier { degrees: [3, 3], control }], Length::mm(tolerance)).unwrap();
        let surface = surface_over(&mesh, FIXED, 90.0, 60.0);
        for (u, v) in spots {
            let z: f64 = heights.iter().enumerate()
                .map(|(k, z)| z * bernstein(3, k as i32 / 4, u) * bernstein(3, k as i32 % 4, v)).sum();
            let off = off(&surface, Point3::new(90.0 * u, 60.0 * v, z));
            prop_assert!(off.abs() <= tolerance, "{off}");
        }
    }

    #[test]
    fn splines_are_their_own_recursion(
        heights in prop::collection::vec(-30.0..30.0f64, 6 * 5),
        steps in prop::collection::vec(0.1..3.0f64, 4),
        spots in prop::collection::vec((0.0..1.0f64, 0.0..1.0f64), 20),
    ) {
        // Cubic in u with two inner knots, quadratic in v with two. Knots are uneven.
        let (a, b) = (steps[0], steps[0] + steps[1]);
        let (c, d) = (steps[2], steps[2] + steps[3]);
        let end_u = b + 1.0;
        let end_v = d + 0.5;
        let knots = [
            vec![0.0, 0.0, 0.0, 0.0, a, b, end_u, end_u, end_u, end_u],
            vec![0.0, 0.0, 0.0, c, d, end_v, end_v, end_v],
        ];
        // Greville abscissae make x and y linear in the parameters.
        let greville = |knots: &[f64], degree: usize, i: usize| knots[i + 1..=i + degree].iter().sum::<f64>() / degree as f64;
        let control = (0..30).map(|k| {
            let (i, j) = (k / 5, k % 5);
            Point3::new(90.0 * greville(&knots[0], 3, i) / end_u, 60.0 * greville(&knots[1], 2, j) / end_v, heights[k])
        }).collect();
        let surface = Nurbs { degrees: [3, 2], knots: knots.clone(), control, weights: vec![] };
        let mesh = nurbs(&surface, Length::mm(0.05)).unwrap();
        let surface = surface_over(&mesh, FIXED, 90.0, 60.0);
        for (s, t) in spots {
            let (u, v) = (s * end_u * 0.999, t * end_v * 0.999);
            let z: f64 = (0..30).map(|k| heights[k] * cox(&knots[0], k / 5, 3, u) * cox(&knots[1], k % 5, 2, v)).sum();
            let off = off(&surface, Point3::new(90.0 * u / end_u, 60.0 * v / end_v, z));
            prop_assert!(off.abs() <= 0.05 + 1e-9, "{off}");
        }
    }
}

/// Cox and de Boor's recursion.
fn cox(knots: &[f64], i: usize, degree: usize, t: f64) -> f64 {
    if degree == 0 {
        return f64::from(u8::from(knots[i] <= t && t < knots[i + 1]));
    }
    let part = |numerator: f64, denominator: f64, i: usize| {
        if denominator == 0.0 {
            0.0
        } else {
            numerator / denominator * cox(knots, i, degree - 1, t)
        }
    };
    part(t - knots[i], knots[i + degree] - knots[i], i)
        + part(
            knots[i + degree + 1] - t,
            knots[i + degree + 1] - knots[i + 1],
            i + 1,
        )
}

/// A quarter of a cylinder of this radius about the y axis, from +x to +z, 60 long, with weights.
fn quarter(radius: f64) -> Nurbs {
    let half = core::f64::consts::FRAC_1_SQRT_2;
    let arc = [(radius, 0.0), (radius, radius), (0.0, radius)];
    Nurbs {
        degrees: [2, 1],
        knots: [vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0], vec![0.0, 0.0, 1.0, 1.0]],
        control: arc
            .iter()
            .flat_map(|&(x, z)| [Point3::new(x, 0.0, z), Point3::new(x, 60.0, z)])
            .collect(),
        weights: [1.0, 1.0, half, half, 1.0, 1.0].to_vec(),
    }
}

#[test]
fn weights_make_a_cylinder_and_the_bound_holds() {
    for tolerance in [1.0, 0.1, 0.01] {
        let mesh = nurbs(&quarter(90.0), Length::mm(tolerance)).unwrap();
        assert!(
            mesh.corners()
                .iter()
                .all(|p| (libm::hypot(p.x, p.z) - 90.0).abs() < 1e-12)
        );
        // Chords of a circle are off by their sagitta, at their middles.
        let worst = mesh
            .faces()
            .flat_map(|[a, b, c]| [[a, b], [b, c], [c, a]])
            .map(|[a, b]| 90.0 - libm::hypot((a.x + b.x) / 2.0, (a.z + b.z) / 2.0))
            .fold(0.0, f64::max);
        assert!(
            worst <= tolerance && worst > tolerance / 40.0,
            "{worst} of {tolerance}"
        );
    }
}

#[test]
fn patches_side_by_side_are_a_union() {
    // The same hill twice, the second one in mirror image beyond x = 90.
    let second = hill()
        .iter()
        .map(|p| Point3::new(180.0 - p.x, p.y, p.z))
        .collect();
    let both = [hill(), second].map(|control| Bezier {
        degrees: [3, 3],
        control,
    });
    let mesh = patches(&both, Length::mm(0.01)).unwrap();
    let surface = surface_over(&mesh, FIXED, 180.0, 60.0);
    for x in [45.0, 135.0] {
        assert!((surface.height(x, 30.0).unwrap() - 18.171_875).abs() <= 0.01);
    }
}

#[test]
fn what_is_not_a_surface_is_refused() {
    let tolerance = Length::mm(0.1);
    let change = |change: &dyn Fn(&mut Nurbs)| {
        let mut surface = quarter(90.0);
        change(&mut surface);
        nurbs(&surface, tolerance).unwrap_err()
    };
    assert_eq!(change(&|s| s.degrees = [0, 1]), PatchError::Degree);
    assert_eq!(change(&|s| s.degrees = [usize::MAX, 1]), PatchError::Degree);
    assert_eq!(
        change(&|s| {
            s.control.pop();
        }),
        PatchError::ControlCount
    );
    assert_eq!(change(&|s| s.knots[0][3] = -1.0), PatchError::Knots);
    assert_eq!(change(&|s| s.knots[0][3] = f64::NAN), PatchError::Knots);
    assert_eq!(change(&|s| s.knots[1] = vec![0.0; 4]), PatchError::Knots);
    assert_eq!(
        change(&|s| s.control[2].z = f64::NAN),
        PatchError::OutOfRange { index: 2 }
    );
    assert_eq!(change(&|s| s.weights[2] = 0.0), PatchError::Weights);
    assert_eq!(change(&|s| s.weights[2] = 1e-7), PatchError::Weights);
    assert_eq!(
        nurbs(&quarter(90.0), Length::mm(1e-12)),
        Err(PatchError::Tolerance)
    );
    assert_eq!(patches(&[], tolerance), Err(PatchError::NoExtent));
    let many: Vec<f64> = (0..500).map(f64::from).collect();
    let heights = |k: usize| Point3::new((k / 475) as f64, (k % 475) as f64, 0.0);
    let rough = Nurbs {
        degrees: [24, 24],
        knots: [many.clone(), many],
        control: (0..475 * 475).map(heights).collect(),
        weights: vec![],
    };
    assert_eq!(nurbs(&rough, tolerance), Err(PatchError::TooMany));
}
