//! Residuals against closed forms and dense sampling.

use super::*;
use crate::mesh::Mesh;
use crate::testkit::{FIXED, placed, rectangles, sampled, sheets, surface_over, wavy, with_needle};
use proptest::prelude::*;
use vcutc_backend_api::geometry::Point3;

fn machined(points: &[(f64, f64)]) -> Machined {
    Machined::new(points.iter().map(|&(x, z)| Point2::new(x, z)).collect()).unwrap()
}

#[test]
fn what_is_left_of_a_wedge_is_its_closed_form() {
    // p = 10 + y/10, E = 20 up to x = 40, then 14: left are 10 - y/10 and, up to y = 40, 4 - y/10.
    let surface = surface_over(
        &sampled(100.0, 60.0, [7, 5], &|_, y| 10.0 + y / 10.0),
        FIXED,
        100.0,
        60.0,
    );
    let residual = surface
        .residual(&machined(&[
            (0.0, 20.0),
            (40.0, 20.0),
            (40.0, 14.0),
            (100.0, 14.0),
        ]))
        .unwrap()
        .unwrap();
    let wanted = 40.0 * (10.0 * 60.0 - 180.0) + 60.0 * (4.0 * 40.0 - 80.0);
    assert!((residual.volume.to_mm3() - wanted).abs() < 1e-6, "{residual:?}");
    assert!((residual.highest.height.to_mm() - 10.0).abs() < 1e-9);
    assert_eq!(residual.highest.place[1], Length::ZERO);
    assert!((residual.lowest.height.to_mm() + 2.0).abs() < 1e-9);
    assert!((residual.lowest.place[1].to_mm() - 60.0).abs() < 1e-9);
    // At y = 0 the foot of the perpendicular lies on the slope.
    let distance = 10.0 / 1.01_f64.sqrt();
    let Between { least, most } = residual.farthest;
    assert!(
        least.to_mm() <= distance + 1e-9 && distance <= most.to_mm() + 1e-9,
        "{residual:?}"
    );
    assert!(most.to_mm() - least.to_mm() <= 0.05, "{residual:?}");
}

#[test]
fn a_dome_under_its_shadow() {
    // Heights alone: sums of squares split.
    let dome = |x: f64, y: f64| 20.0 - ((x - 50.0) * (x - 50.0) + (y - 30.0) * (y - 30.0)) / 500.0;
    let surface = surface_over(&sampled(100.0, 60.0, [50, 30], &dome), FIXED, 100.0, 60.0);
    let shadow = surface.shadow().unwrap();
    let residual = surface
        .residual(&Machined::new(shadow.points().to_vec()).unwrap())
        .unwrap()
        .unwrap();
    assert!(
        (residual.highest.height.to_mm() - 30.0 * 30.0 / 500.0).abs() < 1e-9,
        "{residual:?}"
    );
    assert!(residual.lowest.height.to_mm().abs() < 1e-9);
    // Chords of a parabola in steps of 2: the mean of the square over each step is larger by 2^2/6 than that of its ends' mean.
    let wanted = 100.0 * (2.0 * 9000.0 + 60.0 * 4.0 / 6.0) / 500.0;
    assert!((residual.volume.to_mm3() - wanted).abs() < 1e-6, "{residual:?}");
}

#[test]
fn a_floor_does_not_count_and_a_needle_does() {
    let flat = sampled(100.0, 60.0, [10, 6], &|_, _| 10.0);
    let mut corners = flat.corners().to_vec();
    let mut triangles = flat.triangles().to_vec();
    // A floor far below the sheet.
    let count = corners.len() as u32;
    corners.extend(flat.corners().iter().map(|p| Point3::new(p.x, p.y, -50.0)));
    triangles.extend(flat.triangles().iter().map(|t| t.map(|i| i + count)));
    let mesh = Mesh::new(corners, triangles).unwrap();
    let surface = surface_over(&mesh, FIXED, 100.0, 60.0);
    let level = machined(&[(0.0, 12.0), (100.0, 12.0)]);
    let residual = surface.residual(&level).unwrap().unwrap();
    assert!(
        (residual.highest.height.to_mm() - 2.0).abs() < 1e-9,
        "{residual:?}"
    );
    assert!((residual.volume.to_mm3() - 12_000.0).abs() < 1e-5);
    // The needle stands above E.
    let mesh = with_needle(&mesh, [33.333, 17.7, 10.0], [33.333, 17.701, 15.0]);
    let surface = surface_over(&mesh, FIXED, 100.0, 60.0);
    let residual = surface.residual(&level).unwrap().unwrap();
    assert!(
        (residual.highest.height.to_mm() - 2.0).abs() < 1e-9,
        "{residual:?}"
    );
    assert!(
        (residual.lowest.height.to_mm() + 3.0).abs() < 1e-9,
        "{residual:?}"
    );
}

#[test]
fn cracks_show_no_floor() {
    let mesh = rectangles([[0.0, 29.995, 10.0], [30.0, 60.0, 10.0], [0.0, 60.0, -50.0]]);
    let surface = surface_over(&mesh, FIXED, 100.0, 60.0);
    let residual = surface
        .residual(&machined(&[(0.0, 12.0), (100.0, 12.0)]))
        .unwrap()
        .unwrap();
    assert_eq!(residual.highest.height.to_mm(), 2.0);
}

/// The largest height left by straight cuts infinitely close, on 600 by 1000 mm: numbers that scripts without any code of
/// this repository computed.
#[test]
fn straight_cuts_leave_what_was_computed_elsewhere() {
    use crate::formula::formula;
    use crate::surface::{Accuracy, Plan};
    use vcutc_geometry::number::{Interval, OnPlane, Scalar};
    type Jet = OnPlane<Interval>;
    let dome = |x: Jet, y: Jet| {
        let (u, v) = (x.plus(-300.0), y.plus(-500.0));
        Some((u * u + v * v).times(-1.0).plus(9e6).root())
    };
    let bowl = |x: Jet, y: Jet| dome(x, y).map(|z| z.times(-1.0));
    let hypar = |x: Jet, y: Jet| Some((x.plus(-300.0) * y.plus(-500.0)).times(1.0 / 3000.0));
    let plan = Plan {
        width: Length::mm(600.0),
        depth: Length::mm(1000.0),
    };
    let tolerance = Length::mm(0.05);
    let accuracy = Accuracy {
        tolerance,
        weld: Length::mm(0.01),
    };
    let all: [(&crate::formula::Formula<'_>, f64); 3] = [(&dome, 42.175), (&bowl, 42.175), (&hypar, 100.0)];
    for (f, wanted) in all {
        let mesh = formula(f, plan, tolerance).unwrap();
        let surface = Surface::new(&mesh, &crate::testkit::placement(FIXED), plan, accuracy).unwrap();
        assert_eq!(surface.coverage().unwrap().uncovered.to_mm2(), 0.0);
        let shadow = surface.shadow().unwrap();
        let residual = surface
            .residual(&Machined::new(shadow.points().to_vec()).unwrap())
            .unwrap()
            .unwrap();
        let highest = residual.highest.height.to_mm();
        // Shadow and surface are each within the tolerance.
        assert!((highest - wanted).abs() <= 0.1 + 5e-4, "{highest} {wanted}");
        assert!(residual.lowest.height.to_mm() >= -1e-7, "{residual:?}");
    }
}

/// Very many sheets over each other: the uppermost counts, and nothing takes long.
#[test]
fn stacked_sheets_are_the_uppermost_one() {
    let mesh = rectangles((0..1000_u32).map(|sheet| [0.0, 60.0, f64::from(sheet) / 100.0]));
    let surface = surface_over(&mesh, FIXED, 100.0, 60.0);
    let residual = surface
        .residual(&machined(&[(0.0, 12.0), (100.0, 12.0)]))
        .unwrap()
        .unwrap();
    assert!((residual.volume.to_mm3() - 6000.0 * (12.0 - 999.0 / 100.0)).abs() < 1e-6);
    assert_eq!(surface.coverage().unwrap().uncovered.to_mm2(), 0.0);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn it_is_what_dense_sampling_finds(
        sheets in sheets(), frame in placed(),
        steps in prop::collection::vec((1.0..20.0f64, -10.0..30.0f64, prop::option::of(-10.0..30.0f64)), 2..10),
    ) {
        let mut points = vec![Point2::new(0.0, 5.0)];
        for &(step, z, jump) in &steps {
            let x = points[points.len() - 1].x + step;
            points.push(Point2::new(x, z));
            points.extend(jump.map(|z| Point2::new(x, z)));
        }
        let machined = Machined::new(points.clone()).unwrap();
        let surface = surface_over(&sheets.over(wavy(100.0, 60.0)), frame, 100.0, 60.0);
        let residual = surface.residual(&machined).unwrap().unwrap();
        // Heights of E, by a search of its own: the mean of random places does not meet steps.
        let e = |x: f64| {
            let last = points[points.len() - 1];
            let pair = points.windows(2).find(|pair| pair[0].x <= x && x < pair[1].x);
            pair.map_or(last.z, |pair| pair[0].z + (pair[1].z - pair[0].z) * (x - pair[0].x) / (pair[1].x - pair[0].x))
        };
        let (mut volume, mut most, mut least) = (0.0, f64::NEG_INFINITY, f64::INFINITY);
        const ACROSS: u32 = 250;
        const ALONG: u32 = 150;
        for i in 0..ACROSS {
            for j in 0..ALONG {
                let (x, y) = (100.0 * (f64::from(i) + 0.5) / f64::from(ACROSS), 60.0 * (f64::from(j) + 0.5) / f64::from(ALONG));
                let height = e(x) - surface.height(x, y).unwrap();
                volume += height.max(0.0) * 6000.0 / f64::from(ACROSS * ALONG);
                most = most.max(height);
                least = least.min(height);
            }
        }
        let Residual { highest, lowest, farthest, volume: found } = residual;
        prop_assert!(highest.height.to_mm() >= most - 1e-7 && lowest.height.to_mm() <= least + 1e-7, "{residual:?} {most} {least}");
        prop_assert!((found.to_mm3() - volume).abs() < 0.02 * volume + 300.0, "{} {volume}", found.to_mm3());
        // The lowest place is one of a triangle: what is not on the upper side would be higher, not lower.
        let [x, y] = lowest.place.map(Length::to_mm);
        let es = [e(x - 1e-9), e(x), e(x + 1e-9)];
        let on_it = es.into_iter().map(|e| Point3::new(x, y, e - lowest.height.to_mm()));
        let off = on_it.flat_map(|point| surface.mesh().faces().map(move |face| far(face, point))).fold(f64::INFINITY, f64::min);
        prop_assert!(off < 1e-6, "{lowest:?} {off}");
        // Beside the highest place its height is met, in whatever narrow corner between borders and steps.
        let [x, y] = highest.place.map(Length::to_mm);
        let near = (0..1440).map(|i| f64::from(i) * core::f64::consts::TAU / 1440.0).map(|turn| (x + 1e-5 * libm::cos(turn), y + 1e-5 * libm::sin(turn)));
        let best = near.map(|(x, y)| (e(x) - surface.height(x, y).unwrap() - highest.height.to_mm()).abs()).fold(f64::INFINITY, f64::min);
        prop_assert!(best < 0.02, "{highest:?} {best}");
        // Distances to all triangles, one by one, from places on E.
        prop_assert!(farthest.least <= farthest.most);
        for i in 0..40 {
            let x = 2.5 * f64::from(i) + 1.234;
            for y in [0.0, 17.3, 41.9, 60.0] {
                let point = Point3::new(x, y, e(x));
                let distance = surface.mesh().faces().map(|face| far(face, point)).fold(f64::INFINITY, f64::min);
                prop_assert!((surface.distance(point, &mut 0) - distance).abs() < 1e-6);
                prop_assert!(distance <= farthest.most.to_mm() + 1e-9, "{distance} {farthest:?}");
            }
        }
    }
}

/// The distance of a point from a triangle, by the plane where the foot lies inside and by the sides elsewhere.
fn far(face: [Point3; 3], p: Point3) -> f64 {
    let v = |a: Point3, b: Point3| [b.x - a.x, b.y - a.y, b.z - a.z];
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let [a, b, c] = face;
    let (u, w, q) = (v(a, b), v(a, c), v(a, p));
    // Least squares for the foot in the plane.
    let (uu, uw, ww, uq, wq) = (dot(u, u), dot(u, w), dot(w, w), dot(u, q), dot(w, q));
    let det = uu * ww - uw * uw;
    let (s, t) = ((uq * ww - wq * uw) / det, (wq * uu - uq * uw) / det);
    let to_side = |a: Point3, b: Point3| {
        let (d, q) = (v(a, b), v(a, p));
        let share = (dot(d, q) / dot(d, d)).clamp(0.0, 1.0);
        let rest = [q[0] - share * d[0], q[1] - share * d[1], q[2] - share * d[2]];
        dot(rest, rest).sqrt()
    };
    let sides = to_side(a, b).min(to_side(b, c)).min(to_side(c, a));
    if s >= 0.0 && t >= 0.0 && s + t <= 1.0 {
        let rest: [f64; 3] = core::array::from_fn(|i| q[i] - s * u[i] - t * w[i]);
        dot(rest, rest).sqrt().min(sides)
    } else {
        sides
    }
}
