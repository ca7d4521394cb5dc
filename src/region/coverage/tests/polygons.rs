//! Uncut areas against an arrangement of polygons.

use super::*;
use crate::testkit::flat;
use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay_rule::OverlayRule;
use i_overlay::float::single::SingleFloatOverlay;

/// How far chords leave their arcs, in mm.
const TOLERANCE: f64 = 2e-4;

type Polygon = Vec<[f64; 2]>;

fn polygon(places: &[Place]) -> Polygon {
    let twice: f64 = places
        .iter()
        .zip(places.iter().cycle().skip(1))
        .map(|(a, b)| a.cross(*b))
        .sum();
    let corners = places.iter().map(|place| [place.x, place.y]);
    // All the same way round, so that those that lap do not undo each other.
    if twice < 0.0 {
        corners.rev().collect()
    } else {
        corners.collect()
    }
}

fn circle(centre: Place, radius: f64) -> Polygon {
    let [east, west] = [radius, -radius].map(|x| centre.plus(Place::new(x, 0.0)));
    polygon(&flat(
        [Piece::arc(east, west, PI), Piece::arc(west, east, PI)],
        TOLERANCE,
    ))
}

/// What a tool sweeps along a piece: circles at both ends, and the band between them.
fn sweep(piece: Piece, radius: f64) -> Vec<Polygon> {
    let normal = |t: f64| piece.direction(t).left();
    let side = |by: f64| {
        let [from, to] = [(piece.from, 0.0), (piece.to, 1.0)].map(|(end, t)| end.plus(normal(t).times(by)));
        Piece::arc(from, to, piece.sweep)
    };
    // Beyond the centre of an arc there is no band.
    let reach = |by: f64| {
        piece.radius().map_or(by, |size| {
            let inward = by * piece.sweep.signum();
            if inward > size {
                size * (1.0 - 1e-9) * piece.sweep.signum()
            } else {
                by
            }
        })
    };
    let (left, right) = (side(reach(radius)), side(reach(-radius)));
    let mut band = flat([left], TOLERANCE);
    band.push(left.to);
    band.extend(flat([right.reversed()], TOLERANCE));
    band.push(right.from);
    vec![
        circle(piece.from, radius),
        circle(piece.to, radius),
        polygon(&band),
    ]
}

fn area(shapes: &[Vec<Polygon>]) -> f64 {
    let twice = |polygon: &Polygon| {
        let next = polygon.iter().cycle().skip(1);
        polygon
            .iter()
            .zip(next)
            .map(|(a, b)| a[0] * b[1] - a[1] * b[0])
            .sum::<f64>()
    };
    shapes.iter().flatten().map(twice).sum::<f64>() / 2.0
}

/// The area of what a tool reaches and passes do not sweep, and the perimeter of that.
fn uncut(region: &Region, passes: &[Pass], radius: f64) -> (f64, f64) {
    let edge = levels(region, radius, 1e6);
    let centres: Vec<Polygon> = edge
        .iter()
        .filter(|pass| pass.is_closed())
        .map(|pass| {
            flat(pass.pieces.iter().copied(), TOLERANCE)
                .iter()
                .map(|place| [place.x, place.y])
                .collect()
        })
        .collect();
    let swept = |passes: &[Pass]| -> Vec<Polygon> {
        passes
            .iter()
            .flat_map(|pass| &pass.pieces)
            .flat_map(|&piece| sweep(piece, radius))
            .collect()
    };
    let within: Vec<Polygon> = centres
        .overlay(&Vec::<Polygon>::new(), OverlayRule::Subject, FillRule::EvenOdd)
        .into_iter()
        .flatten()
        .collect();
    let reached = within.overlay(&swept(&edge), OverlayRule::Union, FillRule::NonZero);
    let left = reached.overlay(&swept(passes), OverlayRule::Difference, FillRule::NonZero);
    let length = left.iter().flatten().map(|polygon| {
        let next = polygon.iter().cycle().skip(1);
        polygon
            .iter()
            .zip(next)
            .map(|(a, b)| libm::hypot(b[0] - a[0], b[1] - a[1]))
            .sum::<f64>()
    });
    (area(&left), length.sum())
}

#[test]
fn the_polygons_know_a_frame() {
    let region = rectangle(80.0, 60.0);
    let mut passes = rings(80.0, 60.0, 5.0, 4.0);
    passes.remove(0);
    let (area, _) = uncut(&region, &passes, 5.0);
    assert!((area - (80.0 * 60.0 - 72.0 * 52.0)).abs() < 0.05, "{area}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]
    /// Levels of random regions, with steps that leave something, some without one of the levels.
    #[test]
    fn areas_are_those_of_polygons(
        region in any_region(), radius in 2.0..7.0f64, share in 0.5..1.9f64, without in 0..6u32,
    ) {
        let mut passes = levels(&region, radius, radius * share);
        passes.retain(|pass| pass.level != without);
        let left = coverage(&region, &passes, Tool::touching(radius)).unwrap();
        let (area, length) = uncut(&region, &passes, radius);
        // Chords lie within the circles of tools, so that polygons leave too much along arcs.
        let slack = length * TOLERANCE + 1e-3;
        prop_assert!(left.uncut >= area - slack, "{} {area} {slack}", left.uncut);
        // Where the pass at the walls is missing, the edge of what is reachable counts too.
        let most = if without == 0 { 0.05 + 1e-3 * length } else { 0.05 };
        prop_assert!(left.uncut <= area + slack + most, "{} {area} {slack}", left.uncut);
    }
}
