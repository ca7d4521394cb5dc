//! Loops of drawings: as they are drawn, in pieces, apart, twice, and as layers of DXF and SVG files.

use super::*;
use crate::import::drawing::strokes::{line, stroke};
use crate::import::{dxf, svg};
use core::f64::consts::{FRAC_PI_2, PI, TAU};
use proptest::prelude::*;

fn arc(from: (f64, f64), to: (f64, f64), sweep: f64) -> Stroke {
    stroke(vec![Shape::Arc {
        from: Point2::new(from.0, from.1),
        to: Point2::new(to.0, to.1),
        sweep,
    }])
}

fn found(strokes: &[Stroke]) -> Result<Loops, LoopsError> {
    loops(strokes, Affine::IDENTITY, Length::mm(0.01))
}

/// The area inside of a ring, positive counter-clockwise: that of its corners and of the segments of its arcs.
fn area(ring: &Ring) -> f64 {
    let twice = ring.iter().map(|piece| {
        let way = piece.way;
        let half_chord = way.from.distance(way.to) / 2.0;
        let segment = if way.is_line() {
            0.0
        } else {
            let radius = half_chord / libm::sin(way.sweep.abs() / 2.0);
            radius * radius * (way.sweep - libm::sin(way.sweep))
        };
        way.from.cross(way.to) + segment
    });
    twice.sum::<f64>() / 2.0
}

fn assert_closed(ring: &Ring) {
    for (place, piece) in ring.iter().enumerate() {
        assert_eq!(piece.way.to, ring[(place + 1) % ring.len()].way.from, "{ring:?}");
    }
}

/// The areas of all loops, of which each is closed.
fn areas(loops: &Loops) -> Vec<f64> {
    loops.rings.iter().for_each(assert_closed);
    loops.rings.iter().map(area).collect()
}

fn assert_near(found: &[f64], expected: &[f64], allowed: f64) {
    assert_eq!(found.len(), expected.len(), "{found:?}");
    for (one, other) in found.iter().zip(expected) {
        assert!((one - other).abs() <= allowed, "{found:?}, not {expected:?}");
    }
}

#[test]
fn all_loops_are_found_whichever_way_they_go() {
    let outline = line(&[(0.0, 0.0), (0.0, 50.0), (80.0, 50.0), (80.0, 0.0), (0.0, 0.0)]);
    let island = stroke(Shape::circle(Point2::new(20.0, 20.0), 5.0));
    let within = line(&[(18.0, 18.0), (22.0, 18.0), (20.0, 22.0), (18.0, 18.0)]);
    let beside = line(&[(80.0, 50.0), (90.0, 50.0), (90.0, 60.0), (80.0, 50.0)]);
    let loops = found(&[outline, island, within, beside]).unwrap();
    assert_near(&areas(&loops), &[-4000.0, 25.0 * PI, 8.0, 50.0], 1e-9);
    assert_eq!(loops.widest, None);
    let owners: Vec<usize> = loops.rings.iter().map(|ring| ring[0].stroke).collect();
    assert_eq!(owners, [0, 1, 2, 3]);
}

#[test]
fn ends_meet_in_the_middle_and_arcs_keep_their_angles() {
    let slot = [
        line(&[(0.0, 0.0), (40.0, 0.0)]),
        arc((40.008, 0.0), (40.0, 20.0), PI),
        line(&[(0.0, 20.0), (40.0, 20.006)]),
        arc((0.0, 20.0), (0.0, 0.0), PI),
    ];
    let loops = found(&slot).unwrap();
    assert_near(&areas(&loops), &[800.0 + 100.0 * PI], 0.3);
    let ring = &loops.rings[0];
    assert_eq!(ring.len(), 4);
    assert!(ring[1].way.from.distance(Point2::new(40.004, 0.0)) < 1e-12);
    assert!((ring[1].way.sweep - PI).abs() < 1e-15);
    assert!(ring[1].way.to.distance(Point2::new(40.0, 20.003)) < 1e-12);
    let widest = loops.widest.unwrap();
    assert!((widest.size().to_mm() - 0.008).abs() < 1e-12);
    assert_eq!(widest.strokes, [0, 1]);
    // A circle that stops short of itself keeps its radius but for the gap.
    let (sin, cos) = libm::sincos(TAU - 5e-4);
    let short = arc((10.0, 0.0), (10.0 * cos, 10.0 * sin), TAU - 5e-4);
    assert_near(&areas(&found(&[short]).unwrap()), &[100.0 * PI], 0.2);
}

#[test]
fn little_lines_at_a_gap_do_not_lead_back() {
    let hooked = [
        line(&[(0.0, 0.0), (40.0, 0.0), (40.004, 0.001)]),
        line(&[(39.998, 0.002), (40.0, 30.0), (0.0, 30.0), (0.0, 0.0)]),
    ];
    let loops = found(&hooked).unwrap();
    assert_near(&areas(&loops), &[1200.0], 0.5);
    assert_eq!(loops.rings[0].len(), 4);
}

#[test]
fn lines_drawn_twice_count_once() {
    let ring = [(0.0, 0.0), (80.0, 0.0), (80.0, 30.0), (0.0, 30.0), (0.0, 0.0)];
    let back = [(80.0, 30.0), (80.0, 0.0), (0.0, 0.0), (0.0, 30.0), (80.0, 30.0)];
    let circle = stroke(Shape::circle(Point2::new(20.0, 15.0), 5.0));
    let side = line(&[(80.0, 30.0), (80.0, 0.0)]);
    let loops = found(&[line(&ring), circle.clone(), line(&back), side, circle]).unwrap();
    assert_eq!(loops.rings.len(), 2);
    assert_eq!(loops.repeated, [2, 3, 4]);
}

#[test]
fn chains_that_do_not_close_are_named() {
    let strokes = [
        stroke(Shape::circle(Point2::new(20.0, 15.0), 5.0)),
        line(&[(41.2, 18.36), (60.0, 18.0), (60.0, 40.0)]),
        line(&[(60.0, 40.0), (41.2, 40.0), (41.2, 18.0)]),
    ];
    let Err(LoopsError::Open {
        loops: closed,
        chains,
        nearest,
    }) = found(&strokes)
    else {
        panic!("a chain that does not close is open");
    };
    assert_eq!((closed, chains.len()), (1, 1));
    let gap = nearest.unwrap();
    assert!((gap.size().to_mm() - 0.36).abs() < 1e-9);
    assert_eq!(gap.strokes, [2, 1]);
    assert!(loops(&strokes, Affine::IDENTITY, Length::mm(0.361)).is_ok());
    // Of two open chains the nearest ends are those of both.
    let apart = [
        line(&[(0.0, 0.0), (10.0, 0.0)]),
        line(&[(10.5, 0.0), (20.0, 0.0)]),
    ];
    let Err(LoopsError::Open { nearest, .. }) = found(&apart) else {
        panic!("two lines are no loop");
    };
    assert_eq!(nearest.unwrap().size().to_mm(), 0.5);
    assert_eq!(found(&[]), Err(OutlineError::Nothing.into()));
}

#[test]
fn arcs_are_mirrored_with_their_angles_and_stretched_to_ellipses() {
    let ring = stroke(vec![
        Shape::Polyline(vec![Point2::new(0.0, 0.0), Point2::new(20.0, 0.0)]),
        Shape::Arc {
            from: Point2::new(20.0, 0.0),
            to: Point2::new(0.0, 0.0),
            sweep: FRAC_PI_2,
        },
    ]);
    let whole = 100.0 * PI / 2.0 - 100.0;
    let mapped = |map: Affine| areas(&loops(core::slice::from_ref(&ring), map, Length::mm(0.01)).unwrap());
    assert_near(&mapped(Affine::IDENTITY), &[whole], 1e-9);
    assert_near(&mapped(Affine::stretch(-2.0, 2.0)), &[-4.0 * whole], 1e-9);
    // A micrometre along the curve of 68 mm at most.
    assert_near(&mapped(Affine::stretch(3.0, 1.0)), &[3.0 * whole], 0.07);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]
    /// Loops cut into pieces, which are shuffled, turned round and set apart, are the loops again.
    #[test]
    fn pieces_in_any_order_and_direction_are_joined(
        rings in prop::collection::vec(prop::collection::vec((2.0..9.0f64, -2.5..2.5f64, any::<u32>(), any::<bool>()), 3..9), 1..5),
        gap in prop_oneof![Just(0.0), 1e-5..4e-3f64],
    ) {
        let mut pieces: Vec<(u32, Stroke)> = Vec::new();
        let mut expected = Vec::new();
        for (number, ring) in rings.iter().enumerate() {
            let corner = |place: usize| {
                let (sin, cos) = libm::sincos(TAU * place as f64 / ring.len() as f64);
                let radius = ring[place % ring.len()].0;
                (40.0 * number as f64 + radius * cos, radius * sin)
            };
            let mut whole = Vec::new();
            for (place, &(_, sweep, rank, is_back)) in ring.iter().enumerate() {
                let (from, to) = (corner(place), corner((place + 1) % ring.len()));
                let shifted = (to.0 + gap, to.1);
                let piece = if is_back { arc(shifted, from, -sweep) } else { arc(from, shifted, sweep) };
                pieces.push((rank, piece));
                let way = Bow { from: Point2::new(from.0, from.1), to: Point2::new(to.0, to.1), sweep };
                whole.push(LoopPiece { way, stroke: 0 });
            }
            expected.push(area(&whole).abs());
        }
        pieces.sort_by_key(|piece| piece.0);
        let strokes: Vec<Stroke> = pieces.into_iter().map(|piece| piece.1).collect();
        let loops = found(&strokes).unwrap();
        prop_assert_eq!(loops.rings.iter().map(Vec::len).sum::<usize>(), strokes.len());
        let mut areas: Vec<f64> = areas(&loops).into_iter().map(f64::abs).collect();
        areas.sort_by(f64::total_cmp);
        expected.sort_by(f64::total_cmp);
        assert_near(&areas, &expected, 60.0 * gap + 1e-9);
    }
}

/// A file with these groups in its section ENTITIES, written `code value code value`.
fn entities(groups: &str) -> String {
    sections(&format!("0 SECTION 2 ENTITIES {groups} 0 ENDSEC"))
}

fn sections(groups: &str) -> String {
    format!("{groups} 0 EOF")
        .split(' ')
        .map(|part| format!("{part}\n"))
        .collect()
}

fn of_dxf(text: &str) -> Vec<f64> {
    let drawing = dxf(text, Some("SEAT")).unwrap();
    areas(&found(&drawing.strokes).unwrap())
}

const SQUARE: &str = "0 LWPOLYLINE 8 SEAT 90 4 70 1 10 0 20 0 10 40 20 0 10 40 20 40 10 0 20 40";

#[test]
fn layers_of_dxf_files_are_loops() {
    let hole = "0 CIRCLE 8 SEAT 10 20 20 20 40 5";
    let other = "0 LINE 8 NOTES 10 0 20 0 11 90 21 90";
    let layer = of_dxf(&entities(&format!("{SQUARE} {hole} {other}")));
    assert_near(&layer, &[1600.0, 25.0 * PI], 1e-9);
    // A slot of bulges, clockwise.
    let slot = "0 LWPOLYLINE 8 SEAT 90 4 70 1 10 0 20 0 42 -1 10 0 20 20 10 40 20 20 42 -1 10 40 20 0";
    assert_near(&of_dxf(&entities(slot)), &[-(800.0 + 100.0 * PI)], 1e-9);
    // Lines and an arc, in no order.
    let door = "0 ARC 8 SEAT 10 20 20 30 40 20 50 0 51 180 0 LINE 8 SEAT 10 0 20 30 11 0 21 0 \
                0 LINE 8 SEAT 10 40 20 0 11 40 21 30 0 LINE 8 SEAT 10 0 20 0 11 40 21 0";
    let area = of_dxf(&entities(door));
    assert_near(&[area[0].abs()], &[1200.0 + 200.0 * PI], 1e-6);
    let ellipse = "0 ELLIPSE 8 SEAT 10 50 20 50 11 30 21 0 40 0.5 41 0 42 6.283185307179586";
    assert_near(&of_dxf(&entities(ellipse)), &[450.0 * PI], 0.15);
    // A closed cubic spline with end knots: a Bezier curve whose area is 3/20 of that of the square of its control points.
    let spline = "0 SPLINE 8 SEAT 70 8 71 3 72 8 73 4 40 0 40 0 40 0 40 0 40 1 40 1 40 1 40 1 \
                  10 0 20 0 10 100 20 0 10 0 20 100 10 0 20 0";
    assert_near(&of_dxf(&entities(spline)), &[0.15 * 10_000.0], 0.2);
}

#[test]
fn blocks_are_inserted_stretched_and_mirrored() {
    let block = "0 SECTION 2 BLOCKS 0 BLOCK 2 HOLE 10 0 20 0 0 CIRCLE 8 0 10 0 20 0 40 5 0 ENDBLK 0 ENDSEC";
    let insert = |rest: &str| {
        sections(&format!(
            "{block} 0 SECTION 2 ENTITIES 0 INSERT 8 SEAT 2 HOLE 10 50 20 20 {rest} 0 ENDSEC"
        ))
    };
    assert_near(&of_dxf(&insert("41 2 42 2")), &[100.0 * PI], 1e-9);
    assert_near(&of_dxf(&insert("41 -1 42 1")), &[-25.0 * PI], 1e-9);
    assert_near(&of_dxf(&insert("41 3 42 1 50 30")), &[75.0 * PI], 0.07);
}

#[test]
fn layers_of_svg_files_are_loops() {
    let of = |body: &str| {
        let text = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"100mm\" height=\"100mm\" viewBox=\"0 0 100 100\">\
             <g id=\"SEAT\">{body}</g></svg>"
        );
        let drawing = svg(&text, Some("SEAT")).unwrap();
        let areas = areas(&found(&drawing.strokes).unwrap());
        areas.into_iter().map(f64::abs).collect::<Vec<f64>>()
    };
    let holed =
        "<rect x=\"10\" y=\"10\" width=\"60\" height=\"40\" rx=\"5\"/><circle cx=\"30\" cy=\"30\" r=\"8\"/>";
    assert_near(&of(holed), &[2400.0 - (100.0 - 25.0 * PI), 64.0 * PI], 1e-6);
    let path = "<path d=\"M10 10 H50 V40 H10 Z M20 20 h10 v10 h-10 z\"/>";
    assert_near(&of(path), &[1200.0, 100.0], 1e-9);
    let drop = "<path d=\"M50 50 C 90 50 50 90 50 50 Z\"/>";
    assert_near(&of(drop), &[0.15 * 1600.0], 0.1);
}
