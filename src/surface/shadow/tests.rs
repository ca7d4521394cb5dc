//! Shadows, sections and heights against dense sampling of all triangles.

use crate::mesh::Mesh;
use crate::testkit::{placed, sheets, surface_over, wavy};
use proptest::prelude::*;
use vcutc_backend_api::geometry::Point3;

/// The greatest height of all triangles over a place, by barycentric coordinates.
fn brute(mesh: &Mesh, x: f64, y: f64) -> Option<f64> {
    mesh.faces()
        .filter_map(|[a, b, c]| {
            let twice = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
            if twice == 0.0 {
                return None;
            }
            let u = ((x - a.x) * (c.y - a.y) - (y - a.y) * (c.x - a.x)) / twice;
            let v = ((b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x)) / twice;
            let inside = u >= -1e-12 && v >= -1e-12 && u + v <= 1.0 + 1e-12;
            inside.then_some(a.z + u * (b.z - a.z) + v * (c.z - a.z))
        })
        .reduce(f64::max)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn heights_sections_and_shadows_agree_with_all_triangles(
        sheets in sheets(), x in 0.0..100.0, y in 0.0..60.0, frame in placed(),
    ) {
        let mesh = sheets.over(wavy(100.0, 60.0));
        let surface = surface_over(&mesh, frame, 100.0, 60.0);
        let whole = surface.mesh();
        let wanted = brute(whole, x, y).unwrap();
        let height = surface.height(x, y).unwrap();
        prop_assert!((height - wanted).abs() < 1e-7, "{height} {wanted}");
        let section = surface.section(y).unwrap();
        prop_assert!((section.height(x) - wanted).abs() < 1e-6, "{} {wanted}", section.height(x));
        let shadow = surface.shadow().unwrap();
        let mut most = f64::NEG_INFINITY;
        for i in 0..=600 {
            most = most.max(brute(whole, x, f64::from(i) / 10.0).unwrap_or(most));
        }
        // Between samples the surface rises by no more than its slope allows, which is about 3.
        prop_assert!(shadow.height(x) >= most - 1e-7, "{} {most}", shadow.height(x));
        // It is attained: at a corner or on an edge over this x.
        let attained = whole.faces().flat_map(|[a, b, c]| [[a, b], [b, c], [c, a]]).filter_map(|[a, b]| {
            let within = a.x.min(b.x) <= x && x <= a.x.max(b.x) && a.x != b.x;
            within.then(|| a.z + (b.z - a.z) * (x - a.x) / (b.x - a.x))
        }).fold(f64::NEG_INFINITY, f64::max);
        prop_assert!((shadow.height(x) - attained).abs() < 1e-6, "{} {attained}", shadow.height(x));
    }

    #[test]
    fn triangles_in_another_order_are_the_same_surface(sheets in sheets(), seed: u64, frame in placed()) {
        let mesh = sheets.over(wavy(100.0, 60.0));
        let mut triangles = mesh.triangles().to_vec();
        let mut state = seed | 1;
        for i in (1..triangles.len()).rev() {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            triangles.swap(i, (state >> 33) as usize % (i + 1));
        }
        for (i, named) in triangles.iter_mut().enumerate() {
            named.rotate_left(i % 3);
        }
        // Corners the other way round, too.
        let count = mesh.corners().len() as u32;
        let corners: Vec<Point3> = mesh.corners().iter().rev().copied().collect();
        let triangles = triangles.iter().map(|named| named.map(|index| count - 1 - index)).collect();
        let other = Mesh::new(corners, triangles).unwrap();
        let surface = surface_over(&mesh, frame, 100.0, 60.0);
        let other = surface_over(&other, frame, 100.0, 60.0);
        prop_assert_eq!(&surface, &other);
        prop_assert_eq!(surface.shadow().unwrap(), other.shadow().unwrap());
        prop_assert_eq!(surface.section(31.0).unwrap(), other.section(31.0).unwrap());
    }
}

#[test]
fn the_shadow_of_a_dome_is_its_highest_section() {
    let dome = |x: f64, y: f64| 100.0 - ((x - 50.0) * (x - 50.0) + (y - 30.0) * (y - 30.0)) / 200.0;
    let mesh = crate::testkit::sampled(100.0, 60.0, [40, 24], &dome);
    let surface = surface_over(&mesh, crate::testkit::FIXED, 100.0, 60.0);
    let shadow = surface.shadow().unwrap();
    for i in 0..=40 {
        let x = f64::from(i) * 2.5;
        assert!((shadow.height(x) - dome(x, 30.0)).abs() < 1e-12);
    }
    assert_eq!(shadow.points().len(), 41);
    assert_eq!(surface.section(30.0).unwrap(), shadow);
}

#[test]
fn a_needle_is_seen_wherever_it_stands() {
    let flat = |_: f64, _: f64| 10.0;
    let (x, y) = (33.333, 17.7);
    let sheet = crate::testkit::sampled(100.0, 60.0, [10, 6], &flat);
    let mesh = crate::testkit::with_needle(&sheet, [x, y, 10.0], [x, y, 15.0]);
    let surface = surface_over(&mesh, crate::testkit::FIXED, 100.0, 60.0);
    assert_eq!(surface.shadow().unwrap().height(x), 15.0);
    assert_eq!(surface.height(x, y), Some(15.0));
    assert_eq!(surface.section(y).unwrap().highest().z, 15.0);
}

#[test]
fn cracks_up_to_the_weld_are_closed() {
    for (crack, is_closed) in [(1e-4, true), (2.0, false)] {
        let left = crate::testkit::sampled(100.0, 30.0 - crack, [5, 3], &|_, _| 7.0);
        let right = crate::testkit::sampled(100.0, 30.0, [4, 3], &|_, _| 9.0);
        let mut corners = left.corners().to_vec();
        let count = corners.len() as u32;
        corners.extend(right.corners().iter().map(|p| Point3::new(p.x, p.y + 30.0, p.z)));
        let mut triangles = left.triangles().to_vec();
        triangles.extend(right.triangles().iter().map(|t| t.map(|i| i + count)));
        let surface = surface_over(
            &Mesh::new(corners, triangles).unwrap(),
            crate::testkit::FIXED,
            100.0,
            60.0,
        );
        let y = 30.0 - crack / 2.0;
        assert_eq!(surface.height(41.0, y), is_closed.then_some(9.0));
        match surface.section(y) {
            Ok(section) => assert!(is_closed && section.height(50.0) == 9.0),
            Err(uncovered) => assert_eq!((is_closed, uncovered.ranges), (false, vec![[0.0, 100.0]])),
        }
        assert_eq!(surface.shadow().unwrap().height(50.0), 9.0);
    }
}
