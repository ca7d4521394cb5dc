//! Coverage against unions of intervals along many lines, and on surfaces with known gaps.

use super::*;
use crate::mesh::Mesh;
use crate::testkit::{FIXED, Sheets, placed, sampled, sheets, surface_over, wavy};
use proptest::prelude::*;

/// The area of 100 by 60 that no triangle lies over, by the intervals between them along 1500 lines.
fn uncovered(mesh: &Mesh) -> f64 {
    const LINES: u32 = 1500;
    let mut sum = 0.0;
    for line in 0..LINES {
        let y = 60.0 * (f64::from(line) + 0.5) / f64::from(LINES);
        let mut covered: Vec<(f64, f64)> = mesh
            .faces()
            .filter_map(|face| {
                let edges = [0, 1, 2].map(|i| (face[i], face[(i + 1) % 3]));
                let met = edges.into_iter().filter(|(a, b)| (a.y > y) != (b.y > y));
                let xs: Vec<f64> = met
                    .map(|(a, b)| a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y))
                    .collect();
                (xs.len() == 2).then(|| (xs[0].min(xs[1]), xs[0].max(xs[1])))
            })
            .collect();
        covered.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut reached: f64 = 0.0;
        for (from, to) in covered {
            sum += (from.min(100.0) - reached).max(0.0);
            reached = reached.max(to);
        }
        sum += (100.0 - reached).max(0.0);
    }
    sum * 60.0 / f64::from(LINES)
}

fn alone(sheets: &Sheets) -> Option<Surface> {
    let nothing = sampled(1e-3, 1e-3, [1, 1], &|_, _| 0.0);
    Some(surface_over(&sheets.over(nothing), FIXED, 100.0, 60.0))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn gaps_are_what_lines_miss(sheets in sheets()) {
        let surface = alone(&sheets).unwrap();
        let coverage = surface.coverage().unwrap();
        let wanted = uncovered(surface.mesh());
        let found = coverage.uncovered.to_mm2();
        prop_assert!((found - wanted).abs() < 6.0, "{found} {wanted}");
        for gap in &coverage.gaps {
            let [x, y] = gap.place.map(Length::to_mm);
            prop_assert_eq!(surface.height(x, y), None);
        }
    }

    #[test]
    fn a_sheet_beyond_all_sides_covers_everything(sheets in sheets(), frame in placed()) {
        let surface = surface_over(&sheets.over(wavy(100.0, 60.0)), frame, 100.0, 60.0);
        let coverage = surface.coverage().unwrap();
        prop_assert_eq!(coverage.uncovered, Area::ZERO);
        prop_assert!(coverage.gaps.is_empty());
        // Neighbours are clipped at the same points.
        let coverage = surface_over(&wavy(100.0, 60.0), frame, 100.0, 60.0).coverage().unwrap();
        prop_assert_eq!((coverage.open_edges, coverage.crowded_edges, coverage.turned_edges), (0, 0, 0));
    }
}

/// Two flat sheets with a crack between two y, at heights of 7 and 9.
fn cracked(from: f64, to: f64) -> Surface {
    let left = sampled(100.0, from, [5, 3], &|_, _| 7.0);
    let right = sampled(100.0, 60.0 - to, [4, 3], &|_, _| 9.0);
    let mut corners = left.corners().to_vec();
    let count = corners.len() as u32;
    corners.extend(right.corners().iter().map(|p| Point3::new(p.x, p.y + to, p.z)));
    let mut triangles = left.triangles().to_vec();
    triangles.extend(right.triangles().iter().map(|t| t.map(|i| i + count)));
    surface_over(&Mesh::new(corners, triangles).unwrap(), FIXED, 100.0, 60.0)
}

#[test]
fn cracks_along_lines_between_bins_are_welded() {
    let rows = cracked(29.0, 29.004).bins().rows();
    for row in 1..rows {
        let y = 60.0 * row as f64 / rows as f64;
        for (from, to) in [
            (y, y + 0.009),
            (y - 0.009, y),
            (y + 1e-6, y + 0.009),
            (y - 0.004, y + 0.004),
        ] {
            let surface = cracked(from, to);
            assert_eq!(surface.bins().rows(), rows);
            assert_eq!(surface.coverage().unwrap().uncovered, Area::ZERO, "{from} {to}");
        }
    }
}

#[test]
fn cracks_are_welded_or_reported() {
    let welded = cracked(30.0 - 1e-4, 30.0).coverage().unwrap();
    assert_eq!(
        (welded.gaps.len(), welded.uncovered, welded.open_edges),
        (0, Area::ZERO, 9)
    );
    let coverage = cracked(28.0, 30.0).coverage().unwrap();
    assert!((coverage.uncovered.to_mm2() - 200.0).abs() < 1e-6);
    assert_eq!(coverage.gaps.len(), 1);
    let gap = coverage.gaps[0];
    let [x, y] = gap.place.map(Length::to_mm);
    assert!((28.0..=30.0).contains(&y) && (0.0..=100.0).contains(&x));
    assert_eq!(gap.low.map(|l| l.to_mm().round()), [0.0, 28.0]);
    assert_eq!(gap.high.map(|l| l.to_mm().round()), [100.0, 30.0]);
}

#[test]
fn a_strip_along_the_end_is_reported() {
    let surface = surface_over(&sampled(100.0, 56.0, [40, 20], &|x, y| x + y), FIXED, 100.0, 60.0);
    let coverage = surface.coverage().unwrap();
    assert!((coverage.uncovered.to_mm2() - 400.0).abs() < 1e-6);
    assert_eq!(coverage.gaps.len(), 1);
    assert!(coverage.gaps[0].place[1].to_mm() > 56.0);
}

/// A closed body from sections in y-z with a bottom at 0, standing from x = 0 to 100, all faces outwards. `outline` is
/// given against the clock, seen from +x.
fn extruded(outline: &[[f64; 2]]) -> Mesh {
    let count = outline.len() as u32;
    let corners = [0.0, 100.0]
        .into_iter()
        .flat_map(|x| outline.iter().map(move |&[y, z]| Point3::new(x, y, z)))
        .collect();
    let mut triangles = Vec::new();
    for i in 0..count {
        let j = (i + 1) % count;
        triangles.extend([[i, count + i, count + j], [i, count + j, j]]);
    }
    Mesh::new(corners, triangles).unwrap()
}

#[test]
fn closed_bodies_with_floor_and_walls_are_fine() {
    // A step of 5 mm: its wall stands upright.
    let stepped = extruded(&[
        [0.0, 0.0],
        [60.0, 0.0],
        [60.0, 10.0],
        [20.0, 10.0],
        [20.0, 15.0],
        [0.0, 15.0],
    ]);
    let surface = surface_over(&stepped, FIXED, 100.0, 60.0);
    let coverage = surface.coverage().unwrap();
    assert_eq!((coverage.uncovered, coverage.undercut), (Area::ZERO, Area::ZERO));
    assert_eq!(
        (
            coverage.upright,
            coverage.open_edges,
            coverage.turned_edges,
            coverage.crowded_edges
        ),
        (6, 0, 0, 0)
    );
    assert_eq!(surface.height(50.0, 10.0), Some(15.0));
    assert_eq!(surface.height(50.0, 30.0), Some(10.0));
    assert_eq!(surface.shadow().unwrap().height(50.0), 15.0);
}

#[test]
fn undercuts_are_reported_with_their_area() {
    // Over y from 20 to 30 a lip hangs: 10 mm of 100.
    let lip = extruded(&[
        [0.0, 0.0],
        [60.0, 0.0],
        [60.0, 10.0],
        [20.0, 10.0],
        [20.0, 12.0],
        [30.0, 12.0],
        [30.0, 15.0],
        [0.0, 15.0],
    ]);
    for frame in [FIXED, [100.0, 60.0, 0.0, 180.0]] {
        let coverage = surface_over(&lip, frame, 100.0, 60.0).coverage().unwrap();
        assert!((coverage.undercut.to_mm2() - 1000.0).abs() < 1e-6, "{coverage:?}");
        assert_eq!(coverage.uncovered, Area::ZERO);
    }
}

#[test]
fn turned_and_crowded_edges_are_counted() {
    let mesh = sampled(100.0, 60.0, [2, 1], &|_, _| 0.0);
    let mut triangles = mesh.triangles().to_vec();
    triangles[1].swap(1, 2);
    let mut corners = mesh.corners().to_vec();
    corners.push(Point3::new(50.0, 30.0, 20.0));
    // A fin on the middle line, which has two triangles already.
    triangles.push([1, 4, 6]);
    let coverage = surface_over(&Mesh::new(corners, triangles).unwrap(), FIXED, 100.0, 60.0)
        .coverage()
        .unwrap();
    assert_eq!(
        (
            coverage.turned_edges,
            coverage.crowded_edges,
            coverage.open_edges,
            coverage.upright
        ),
        (1, 1, 2, 1)
    );
}

#[test]
fn needles_from_one_corner_are_not_too_tangled() {
    let count = 3000_u32;
    let mut corners = vec![Point3::new(0.0, 0.0, 5.0)];
    for i in 0..=count {
        let share = f64::from(i) / f64::from(count);
        corners.push(Point3::new(100.0, 120.0 * share, 5.0));
    }
    corners.push(Point3::new(0.0, 120.0, 5.0));
    let mut triangles: Vec<[u32; 3]> = (1..=count).map(|i| [0, i, i + 1]).collect();
    triangles.push([0, count + 1, count + 2]);
    let surface = surface_over(&Mesh::new(corners, triangles).unwrap(), FIXED, 100.0, 60.0);
    assert_eq!(surface.coverage().unwrap().uncovered, Area::ZERO);
}
