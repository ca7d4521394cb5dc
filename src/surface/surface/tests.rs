//! Placement, units and the plan.

use super::*;
use crate::testkit::{FIXED, placement, sampled, surface_over};
use proptest::prelude::*;
use vcutc_backend_api::units::Length;

fn hill(x: f64, y: f64) -> f64 {
    10.0 + 5.0 * libm::sin(x / 17.0) + y * y / 400.0
}

#[test]
fn units_scale_and_frames_move_and_turn() {
    let plan = Plan {
        width: Length::mm(100.0),
        depth: Length::mm(60.0),
    };
    let accuracy = Accuracy {
        tolerance: Length::mm(0.01),
        weld: Length::mm(0.01),
    };
    let mesh = sampled(100.0, 60.0, [50, 30], &hill);
    let fixed = surface_over(&mesh, FIXED, 100.0, 60.0);
    // The same in inches, drawn a kilometre away and turned by 90 degrees: x was along -y.
    let far = |p: &Point3| Point3::new((p.y + 1e6) / 25.4, (-p.x - 2e6) / 25.4, (p.z + 5.0) / 25.4);
    let inches = Mesh::new(
        mesh.corners().iter().map(far).collect(),
        mesh.triangles().to_vec(),
    )
    .unwrap();
    let place = Placement {
        unit: Length::mm(25.4),
        ..placement([-2e6, -1e6, -5.0, 90.0])
    };
    let turned = Surface::new(&inches, &place, plan, accuracy).unwrap();
    for i in 1..20 {
        for j in 1..12 {
            let (x, y) = (5.0 * f64::from(i), 5.0 * f64::from(j));
            let off = turned.height(x, y).unwrap() - fixed.height(x, y).unwrap();
            assert!(off.abs() < 1e-6, "{x} {y} {off}");
        }
    }
    // Rounding at that distance leaves strips along the sides that are not gaps.
    assert_eq!(turned.coverage().unwrap().uncovered.to_mm2(), 0.0);
}

#[test]
fn a_part_turned_half_round_is_its_mirror_image() {
    let mesh = sampled(100.0, 60.0, [50, 30], &hill);
    let fixed = surface_over(&mesh, FIXED, 100.0, 60.0);
    let turned = surface_over(&mesh, [100.0, 60.0, 0.0, 180.0], 100.0, 60.0);
    assert_eq!(fixed.mesh().triangles().len(), turned.mesh().triangles().len());
    let (one, other) = (fixed.shadow().unwrap(), turned.shadow().unwrap());
    for i in 0..=100 {
        let x = f64::from(i);
        assert!((one.height(x) - other.height(100.0 - x)).abs() < 1e-9);
    }
}

#[test]
fn what_lies_elsewhere_is_reported_with_its_box() {
    let mesh = sampled(100.0, 60.0, [2, 2], &|_, _| 3.0);
    let surface = |move_by: [f64; 4], unit: f64, width: f64| {
        let plan = Plan {
            width: Length::mm(width),
            depth: Length::mm(60.0),
        };
        let accuracy = Accuracy {
            tolerance: Length::ZERO,
            weld: Length::ZERO,
        };
        let place = Placement {
            unit: Length::mm(unit),
            ..placement(move_by)
        };
        Surface::new(&mesh, &place, plan, accuracy)
    };
    assert_eq!(
        surface([500.0, 0.0, 0.0, 0.0], 1.0, 100.0),
        Err(SurfaceError::Elsewhere {
            low: Point3::new(500.0, 0.0, 3.0),
            high: Point3::new(600.0, 60.0, 3.0),
        })
    );
    assert_eq!(surface(FIXED, 1e8, 100.0), Err(SurfaceError::OutOfRange));
    for unit in [0.0, -1.0, f64::NAN] {
        assert_eq!(surface(FIXED, unit, 100.0), Err(SurfaceError::BadPlan));
    }
    for width in [0.0, f64::NAN, f64::INFINITY] {
        assert_eq!(surface(FIXED, 1.0, width), Err(SurfaceError::BadPlan));
    }
    assert_eq!(
        surface([f64::NAN, 0.0, 0.0, 0.0], 1.0, 100.0),
        Err(SurfaceError::BadPlan)
    );
}

proptest! {
    #[test]
    fn clipping_keeps_the_area_over_the_plan(corners in prop::array::uniform3((-50.0..150.0f64, -50.0..110.0f64))) {
        let face = corners.map(|(x, y)| Point3::new(x, y, x + 2.0 * y));
        let polygon = clipped(&face, [0.0, 0.0], [100.0, 60.0]);
        // All corners lie in the plan and in the triangle's plane.
        for p in &polygon {
            prop_assert!((0.0..=100.0).contains(&p.x) && (0.0..=60.0).contains(&p.y));
            prop_assert!((p.x + 2.0 * p.y - p.z).abs() < 1e-9);
        }
        // The area by counting places.
        let twice = |p: &[(f64, f64)]| (0..p.len()).map(|i| {
            let (a, b) = (p[i], p[(i + 1) % p.len()]);
            a.0 * b.1 - b.0 * a.1
        }).sum::<f64>();
        let sense = twice(&corners).signum();
        let inside = |x: f64, y: f64| (0..3).all(|i| {
            let (a, b) = (corners[i], corners[(i + 1) % 3]);
            ((b.0 - a.0) * (y - a.1) - (b.1 - a.1) * (x - a.0)) * sense >= 0.0
        });
        let count = (0..200).flat_map(|i| (0..120).map(move |j| (0.25 + 0.5 * f64::from(i), 0.25 + 0.5 * f64::from(j))))
            .filter(|&(x, y)| inside(x, y)).count();
        let flat: Vec<(f64, f64)> = polygon.iter().map(|p| (p.x, p.y)).collect();
        let area = twice(&flat).abs() / 2.0;
        // Half a cell along a border of less than 400.
        prop_assert!((area - count as f64 * 0.25).abs() < 100.0, "{area} {count}");
    }
}
