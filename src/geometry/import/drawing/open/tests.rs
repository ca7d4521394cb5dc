//! Sides that lines mark as open.

use super::*;
use crate::import::drawing::{LoopsError, Place, loops};

fn stroke(points: &[(f64, f64)]) -> Stroke {
    Stroke {
        kind: "LINE",
        place: Place { start: 0, end: 0 },
        shapes: vec![Shape::Polyline(
            points.iter().map(|&(x, z)| Point2::new(x, z)).collect(),
        )],
    }
}

fn drawn() -> Result<Loops, LoopsError> {
    let ring = stroke(&[
        (0.0, 0.0),
        (40.0, 0.0),
        (80.0, 0.0),
        (80.0, 30.0),
        (0.0, 30.0),
        (0.0, 0.0),
    ]);
    loops(&[ring], Affine::IDENTITY, Length::mm(0.01))
}

fn marked(strokes: &[Stroke]) -> Result<Vec<SideName>, OpenError> {
    open_sides(&drawn().unwrap(), strokes, Affine::IDENTITY, Length::mm(0.01))
}

#[test]
fn sides_are_marked_from_end_to_end() {
    assert_eq!(marked(&[stroke(&[(80.0, 30.0), (80.0, 0.0)])]), Ok(vec![(0, 2)]));
    // One line over two sides, within the tolerance; a polyline over a corner; two lines over one way.
    assert_eq!(
        marked(&[stroke(&[(0.008, 0.005), (80.0, -0.005)])]),
        Ok(vec![(0, 0), (0, 1)])
    );
    let corner = stroke(&[(40.0, 0.0), (80.0, 0.0), (80.0, 30.0)]);
    assert_eq!(marked(core::slice::from_ref(&corner)), Ok(vec![(0, 1), (0, 2)]));
    assert_eq!(marked(&[corner.clone(), corner]), Ok(vec![(0, 1), (0, 2)]));
}

#[test]
fn lines_off_the_sides_and_shorter_ones_are_refused() {
    let off = marked(&[
        stroke(&[(0.0, 0.0), (40.0, 0.0)]),
        stroke(&[(80.02, 0.0), (80.02, 30.0)]),
    ]);
    let line = [Point2::new(80.02, 0.0), Point2::new(80.02, 30.0)];
    assert_eq!(
        off,
        Err(OpenError::Uncovered {
            stroke: 1,
            line,
            side: None
        })
    );
    let short = marked(&[stroke(&[(80.0, 0.0), (80.0, 20.0)])]);
    let line = [Point2::new(80.0, 0.0), Point2::new(80.0, 20.0)];
    assert_eq!(
        short,
        Err(OpenError::Uncovered {
            stroke: 0,
            line,
            side: Some((0, 2))
        })
    );
    let long = marked(&[stroke(&[(80.0, 0.0), (80.0, 40.0)])]);
    assert!(
        matches!(long, Err(OpenError::Uncovered { side: None, .. })),
        "{long:?}"
    );
    assert_eq!(marked(&[]), Err(OpenError::Strokes(OutlineError::Nothing)));
    let (from, to) = (Point2::new(80.0, 0.0), Point2::new(80.0, 30.0));
    let round = Stroke {
        shapes: vec![Shape::Arc { from, to, sweep: 0.5 }],
        ..stroke(&[])
    };
    assert_eq!(marked(&[round]), Err(OpenError::Curved { stroke: 0 }));
}
