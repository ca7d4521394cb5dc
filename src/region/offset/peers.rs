//! Levels beside those of two other packages: `i_overlay` clips polygons, `cavalier_contours` offsets arcs.

use super::*;
use crate::testkit::{any_region, flat, pocket};
use cavalier_contours::polyline::{PlineSource, PlineSourceMut, Polyline};
use cavalier_contours::shape_algorithms::{Shape, ShapeOffsetOptions};
use i_overlay::mesh::float::outline::offset::OutlineOffset;
use i_overlay::mesh::float::style::{LineJoin, OutlineStyle};
use proptest::prelude::*;

/// Area within the loops of a level, and the number of loops.
fn ours(region: &Region, distance: f64) -> (f64, usize) {
    let ways = level(region, 0.0, distance).unwrap();
    let loops: Vec<&Way> = ways.iter().filter(|way| way.kind == Kind::Loop).collect();
    let pieces = loops.iter().flat_map(|way| &way.pieces);
    (pieces.map(|piece| piece.twice_area() / 2.0).sum(), loops.len())
}

fn perimeter(region: &Region) -> f64 {
    region.edges().map(|edge| edge.piece.length()).sum()
}

/// By polygons whose chords leave arcs by so much.
fn clipped(region: &Region, distance: f64, chord: f64) -> f64 {
    let loops = region.loops().iter().map(|edges| {
        let places = flat(edges.iter().map(|edge| edge.piece), chord);
        places.iter().map(|place| [place.x, place.y]).collect()
    });
    let loops: Vec<Vec<[f64; 2]>> = loops.collect();
    let style = OutlineStyle::new(-distance).line_join(LineJoin::Round(0.01));
    let area = |contour: &Vec<[f64; 2]>| {
        let next = contour.iter().cycle().skip(1);
        contour
            .iter()
            .zip(next)
            .map(|(a, b)| (a[0] * b[1] - a[1] * b[0]) / 2.0)
            .sum::<f64>()
    };
    loops.outline_as::<i64>(&style).iter().flatten().map(area).sum()
}

/// By arcs: area and number of loops.
fn by_arcs(region: &Region, distance: f64) -> (f64, usize) {
    let lines = region.loops().iter().map(|edges| {
        let mut line = Polyline::new_closed();
        for edge in edges {
            let (from, bulge) = (edge.piece.from, libm::tan(edge.piece.sweep / 4.0));
            line.add(from.x, from.y, bulge);
        }
        line
    });
    let shape: Shape<f64> = Shape::from_plines(lines);
    let level = shape.parallel_offset(distance, &ShapeOffsetOptions::default());
    let lines = level.ccw_plines.iter().chain(&level.cw_plines);
    let areas: Vec<f64> = lines.map(|line| line.polyline.area()).collect();
    (areas.iter().sum(), areas.len())
}

#[test]
fn pockets_by_arcs_and_by_polygons() {
    for number in 2..=5 {
        let region = pocket(number);
        // Off the exact ties.
        for distance in (0..8).map(|n| 5.03 + 4.0 * f64::from(n)) {
            let (area, count) = ours(&region, distance);
            let (arcs, loops) = by_arcs(&region, distance);
            assert!(
                (area - arcs).abs() < 1e-6 && count == loops,
                "{number} {distance}: {area} {arcs}"
            );
            let polygons = clipped(&region, distance, 2e-3);
            assert!(
                (area - polygons).abs() < 0.4,
                "{number} {distance}: {area} {polygons}"
            );
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]
    #[test]
    fn random_regions_by_polygons(region in any_region(), distance in 0.2..20.0f64) {
        let (area, _) = ours(&region, distance);
        let other = clipped(&region, distance, 1e-3);
        prop_assert!((area - other).abs() < 1e-3 * perimeter(&region), "{area} {other} {distance} {region:?}");
    }
}
