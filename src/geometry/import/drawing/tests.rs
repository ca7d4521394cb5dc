//! Outlines of drawings, against the points that ezdxf and svgpathtools put on them, and joined from random pieces.

use super::*;
use crate::curve::CurveError;
use crate::import::{csv, dxf, svg};
use crate::point::Point2;
use proptest::prelude::*;
use vcutc_backend_api::units::Length;

/// How close polylines stay to curves, as in profiles.
const FLAT: f64 = 1e-3;

fn distance_to(point: Point2, polyline: &[Point2]) -> f64 {
    let to_segment = |pair: &[Point2]| {
        let way = pair[1].minus(pair[0]);
        let share = (point.minus(pair[0]).dot(way) / way.dot(way).max(1e-300)).clamp(0.0, 1.0);
        point.distance(pair[0].lerp(pair[1], share))
    };
    polyline.windows(2).map(to_segment).fold(f64::INFINITY, f64::min)
}

fn whole(drawing: &Drawing, unit: f64, tolerance: f64) -> Result<Outline, OutlineError> {
    let map = Affine::stretch(unit, unit);
    outline(&drawing.strokes, map, Length::mm(FLAT), Length::mm(tolerance))
}

/// The outline passes all points of the reference, and nothing of it is far from them.
fn assert_agrees(name: &str, drawing: &Drawing, unit: f64, allowed: f64, points: &str) -> Outline {
    let outline = whole(drawing, unit, 0.01).unwrap();
    let points = csv(points).unwrap();
    for point in &points {
        let off = distance_to(*point, &outline.points);
        assert!(off <= allowed, "{name}: {point:?} is {off} off");
    }
    for corner in &outline.points {
        let nearest = points
            .iter()
            .map(|point| point.distance(*corner))
            .fold(f64::INFINITY, f64::min);
        assert!(nearest < 25.0, "{name}: nothing is near {corner:?}");
    }
    outline
}

macro_rules! file {
    ($name:literal) => {
        include_str!(concat!("../../../../tests/data/drawings/", $name))
    };
}

#[test]
fn drawings_of_several_programs_are_what_other_readers_see() {
    let drawing = dxf(file!("autocad.dxf"), Some("skin")).unwrap();
    assert_eq!(drawing.unit, Unit::Known(1.0));
    let ring = assert_agrees("autocad", &drawing, 1.0, FLAT, file!("autocad.points"));
    assert!(ring.is_closed);
    let kinds: Vec<(&str, Why)> = drawing.unread.iter().map(|u| (u.kind.as_str(), u.why)).collect();
    assert_eq!(kinds, [("HATCH", Why::Kind)]);

    let drawing = dxf(file!("autocad_r12.dxf"), Some("CONTOUR")).unwrap();
    assert!(matches!(drawing.unit, Unit::Unsaid(_)));
    let line = assert_agrees("autocad_r12", &drawing, 1.0, FLAT, file!("autocad_r12.points"));
    assert!(!line.is_closed);

    let drawing = dxf(file!("librecad.dxf"), Some("rib")).unwrap();
    // Where ends are joined over 4 um, both move by half of it.
    let line = assert_agrees("librecad", &drawing, 1.0, FLAT + 0.004, file!("librecad.points"));
    assert_eq!(line.repeated, [1]);
    assert!((line.widest.unwrap().size().to_mm() - 0.004).abs() < 1e-9);

    let drawing = dxf(file!("qcad.dxf"), Some("Rib")).unwrap();
    assert_eq!(drawing.unit, Unit::Known(10.0));
    assert_agrees("qcad", &drawing, 10.0, FLAT, file!("qcad.points"));

    let drawing = dxf(file!("ezdxf.dxf"), Some("SKIN")).unwrap();
    assert_eq!(drawing.unit, Unit::Known(25.4));
    let line = assert_agrees("ezdxf", &drawing, 25.4, FLAT, file!("ezdxf.points"));
    assert!(!line.is_closed);

    let drawing = svg(file!("inkscape.svg"), Some("Skin")).unwrap();
    assert_eq!(drawing.unit, Unit::Known(1.0));
    assert_agrees("inkscape", &drawing, 1.0, FLAT, file!("inkscape.points"));

    let drawing = svg(file!("illustrator.svg"), None).unwrap();
    assert_eq!(drawing.unit, Unit::Known(25.4 / 72.0));
    let ring = assert_agrees(
        "illustrator",
        &drawing,
        25.4 / 72.0,
        FLAT,
        file!("illustrator.points"),
    );
    assert!(ring.is_closed);
}

fn stroke(points: &[(f64, f64)]) -> Stroke {
    Stroke {
        kind: "LINE",
        place: Place { start: 0, end: 0 },
        shapes: vec![Shape::Polyline(
            points.iter().map(|&(x, z)| Point2::new(x, z)).collect(),
        )],
    }
}

fn joined(strokes: &[Stroke], tolerance: f64) -> Result<Outline, OutlineError> {
    outline(strokes, Affine::IDENTITY, Length::mm(FLAT), Length::mm(tolerance))
}

proptest! {
    /// A polyline cut into pieces, which are shuffled, turned round and set apart, is the polyline again.
    #[test]
    fn pieces_in_any_order_and_direction_are_joined(
        steps in prop::collection::vec((0.5..5.0f64, -10.0..10.0f64, any::<bool>(), any::<u32>()), 3..30),
        gap in prop_oneof![Just(0.0), 1e-5..9e-3f64],
    ) {
        let mut at = (0.0, 0.0);
        let mut corners = vec![at];
        for step in &steps {
            at = (at.0 + step.0, step.1);
            corners.push(at);
        }
        let mut pieces: Vec<(u32, Stroke)> = corners.windows(2).zip(&steps).map(|(pair, step)| {
            let mut ends = [pair[0], (pair[1].0 - gap, pair[1].1)];
            if step.2 {
                ends.reverse();
            }
            (step.3, stroke(&ends))
        }).collect();
        pieces.sort_by_key(|piece| piece.0);
        let strokes: Vec<Stroke> = pieces.into_iter().map(|piece| piece.1).collect();
        let outline = joined(&strokes, 0.01).unwrap();
        prop_assert_eq!(outline.points.len(), corners.len());
        prop_assert_eq!(outline.owners.len(), corners.len());
        for (point, corner) in outline.points.iter().zip(&corners) {
            prop_assert!(point.distance(Point2::new(corner.0, corner.1)) <= gap + 1e-12);
        }
        // Every stretch belongs to the stroke that drew it.
        for (pair, &owner) in outline.points.windows(2).zip(outline.owners.iter().skip(1)) {
            let Shape::Polyline(drawn) = &strokes[owner].shapes[0] else { unreachable!() };
            prop_assert!(distance_to(pair[0].lerp(pair[1], 0.5), drawn) <= gap + 1e-9);
        }
    }

    /// The sides of a ring through random heights above and below zero.
    #[test]
    fn sides_are_the_upper_and_the_lower_half(
        top in prop::collection::vec(1.0..10.0f64, 2..12), bottom in prop::collection::vec(-10.0..-1.0f64, 2..12),
        turn in 0..24usize, backwards: bool,
    ) {
        let row = |heights: &[f64]| -> Vec<(f64, f64)> {
            let last = (heights.len() - 1) as f64;
            heights.iter().enumerate().map(|(i, &z)| (100.0 * i as f64 / last, z)).collect()
        };
        let (upper, lower) = (row(&top), row(&bottom));
        let mut ring: Vec<(f64, f64)> = lower.iter().copied().chain(upper.iter().rev().copied()).collect();
        if backwards {
            ring.reverse();
        }
        let count = ring.len();
        ring.rotate_left(turn % count);
        ring.push(ring[0]);
        let outline = joined(&[stroke(&ring)], 0.01).unwrap();
        prop_assert!(outline.is_closed);
        for (wanted, expected) in [(Side::Upper, upper), (Side::Lower, lower)] {
            let found = side(&outline, wanted, Length::mm(FLAT)).unwrap();
            let found: Vec<(f64, f64)> = found.points.iter().map(|p| (p.x, p.z)).collect();
            prop_assert_eq!(found, expected);
        }
    }

    /// A map of the strokes is a map of the outline, also where it stretches arcs to ellipses.
    #[test]
    fn maps_act_on_all_shapes_alike(
        matrix in prop::array::uniform4(-3.0..3.0f64), sweep in -6.0..6.0f64, end in (1.0..20.0f64, -20.0..20.0f64),
    ) {
        let [a, b, c, d] = matrix;
        prop_assume!((a * d - b * c).abs() > 0.3 && sweep.abs() > 1e-3);
        let map = Affine::new([a, b, c, d, 5.0, -3.0]);
        let (from, to) = (Point2::new(0.0, 0.0), Point2::new(end.0, end.1));
        let arc = Stroke { shapes: vec![Shape::Arc { from, to, sweep }], ..stroke(&[]) };
        let plain = outline(core::slice::from_ref(&arc), Affine::IDENTITY, Length::mm(1e-5), Length::mm(0.01)).unwrap();
        let mapped = outline(&[arc], map, Length::mm(1e-5), Length::mm(0.01)).unwrap();
        for point in &plain.points {
            prop_assert!(distance_to(map.point(*point), &mapped.points) < 1e-4);
        }
    }
}

#[test]
fn gaps_and_branches_are_named() {
    let apart = [
        stroke(&[(0.0, 0.0), (10.0, 0.0)]),
        stroke(&[(10.5, 0.0), (20.0, 0.0)]),
    ];
    let Err(OutlineError::Several { chains, nearest }) = joined(&apart, 0.01) else {
        panic!("two chains are two chains");
    };
    assert_eq!(chains.len(), 2);
    let gap = nearest.unwrap();
    assert_eq!(gap.size().to_mm(), 0.5);
    assert_eq!(gap.strokes, [0, 1]);
    assert!(joined(&apart, 0.5).is_ok());
    let fork = [
        stroke(&[(0.0, 0.0), (10.0, 0.0)]),
        stroke(&[(10.0, 0.0), (20.0, 0.0)]),
        stroke(&[(10.0, 0.0), (20.0, 5.0)]),
    ];
    let at = Point2::new(10.0, 0.0);
    assert_eq!(
        joined(&fork, 0.01),
        Err(OutlineError::Branch {
            at,
            strokes: vec![0, 1, 2]
        })
    );
    assert_eq!(joined(&[], 0.01), Err(OutlineError::Nothing));
    let far = [stroke(&[(0.0, 0.0), (2e9, 0.0)])];
    let error = CurveError::OutOfRange { index: 1 };
    assert_eq!(joined(&far, 0.01), Err(OutlineError::Curve { stroke: 0, error }));
    let crowd: Vec<Stroke> = (0..200)
        .map(|i| stroke(&[(0.0, f64::from(i) * 0.01), (100.0 + f64::from(i), f64::from(i))]))
        .collect();
    assert!(matches!(joined(&crowd, 10.0), Err(OutlineError::Crowded { .. })));
}

#[test]
fn outlines_without_sides_are_refused() {
    let open = joined(&[stroke(&[(0.0, 0.0), (10.0, 0.0), (10.0, 5.0)])], 0.01).unwrap();
    assert!(matches!(
        side(&open, Side::Upper, Length::mm(FLAT)),
        Err(SideError::Open(_))
    ));
    let (upper, lower) = (
        [(0.0, 5.0), (10.0, 8.0), (20.0, 2.0)],
        [(30.0, 5.0), (20.0, 9.0), (10.0, 2.0), (0.0, 5.0)],
    );
    let bow = [&upper[..], &lower[..]].concat();
    let bow = joined(&[stroke(&bow)], 0.01).unwrap();
    assert!(matches!(
        side(&bow, Side::Upper, Length::mm(FLAT)),
        Err(SideError::Crossed { .. })
    ));
}

/// Corners of a ring that were joined over a gap may lean its vertical sides a little.
#[test]
fn sides_that_lean_by_a_joined_gap_are_vertical() {
    let ring = [
        stroke(&[(-0.008, 0.0), (50.0, 0.0)]),
        stroke(&[(50.0, 0.0), (50.0, 20.0), (0.0, 30.0), (0.0, 0.0)]),
    ];
    let upper = side(&joined(&ring, 0.01).unwrap(), Side::Upper, Length::mm(FLAT)).unwrap();
    assert_eq!(upper.points.len(), 2);
    assert!((upper.points[0].z - 30.0).abs() < 1e-12);
}
