//! Lines drawn twice, whole and in part.

use super::super::outline;
use super::super::strokes::{line, stroke};
use super::*;
use proptest::prelude::*;

fn found(strokes: &[Stroke]) -> Option<Overlap> {
    drawn_over(strokes, Affine::IDENTITY, Length::mm(1e-3), Length::mm(0.01))
}

fn repeated(strokes: &[Stroke]) -> Vec<usize> {
    let joined = outline(strokes, Affine::IDENTITY, Length::mm(1e-3), Length::mm(0.01));
    joined.unwrap().repeated
}

#[test]
fn lines_that_lie_on_others_from_end_to_end_count_once() {
    let ring = [(0.0, 0.0), (80.0, 0.0), (80.0, 30.0), (0.0, 30.0), (0.0, 0.0)];
    let turned = [(80.0, 30.0), (80.0, 0.0), (0.0, 0.0), (0.0, 30.0), (80.0, 30.0)];
    // The same, back, from another corner; in pieces, before the whole and after it.
    assert_eq!(repeated(&[line(&ring), line(&ring)]), [1]);
    assert_eq!(repeated(&[line(&ring), line(&turned)]), [1]);
    let piece = line(&[(80.0, 30.0), (80.0, 0.0)]);
    assert_eq!(repeated(&[piece.clone(), line(&ring), piece]), [0, 2]);
    let half = |sweep| {
        let (from, to) = (Point2::new(0.0, 0.0), Point2::new(80.0, 0.0));
        if sweep > 0.0 {
            stroke(vec![Shape::Arc { from, to, sweep }])
        } else {
            stroke(vec![Shape::Arc {
                from: to,
                to: from,
                sweep,
            }])
        }
    };
    assert_eq!(repeated(&[half(2.0), half(-2.0)]), [1]);
    assert_eq!(found(&[half(2.0), half(-2.0)]), None);
}

#[test]
fn lines_that_lie_on_each_other_in_part_are_found() {
    let at = |x| Point2::new(x, 5.0);
    let lines = [
        line(&[(0.0, 5.0), (50.0, 5.0)]),
        line(&[(100.0, 5.0), (40.0, 5.0)]),
    ];
    let overlap = found(&lines).unwrap();
    assert_eq!(overlap.strokes, [0, 1]);
    let ends = [overlap.from.x.min(overlap.to.x), overlap.from.x.max(overlap.to.x)];
    assert!(
        (ends[0] - 40.0).abs() < 1e-9 && (ends[1] - 50.0).abs() < 1e-9,
        "{overlap:?}"
    );
    // One that leads back over itself; a touch, a gap that is joined and lines side by side do not count.
    let back = found(&[line(&[(0.0, 5.0), (50.0, 5.0), (30.0, 5.0), (30.0, 9.0)])]).unwrap();
    assert_eq!(back.strokes, [0, 0]);
    assert!(back.from.distance(at(30.0)).min(back.to.distance(at(30.0))) < 1e-9);
    for other in [
        &[(50.0, 5.0), (90.0, 5.0)][..],
        &[(49.995, 5.0), (90.0, 5.0)],
        &[(10.0, 5.001), (90.0, 5.001)],
        &[(10.0, 0.0), (10.0, 9.0)],
    ] {
        assert_eq!(found(&[lines[0].clone(), line(other)]), None, "{other:?}");
    }
}

proptest! {
    /// Arcs of one circle overlap by as much as their angles do, whichever way they are drawn.
    #[test]
    fn arcs_of_one_circle_are_compared_by_angle(
        first in (0.0..6.0f64, 0.1..3.0f64), second in (0.0..6.0f64, 0.1..3.0f64), backwards in any::<bool>(),
    ) {
        let at = |angle: f64| Point2::new(20.0 + 50.0 * libm::cos(angle), 50.0 * libm::sin(angle));
        let arc = |(start, sweep): (f64, f64), backwards: bool| {
            let (from, to) = (at(start), at(start + sweep));
            stroke(vec![if backwards {
                Shape::Arc { from: to, to: from, sweep: -sweep }
            } else {
                Shape::Arc { from, to, sweep }
            }])
        };
        // How much of one is in the other, by walking along it.
        let steps = 20_000;
        let is_within = |angle: f64, (start, sweep): (f64, f64)| (angle - start).rem_euclid(TAU) <= sweep;
        let shared = (0..steps)
            .filter(|step| is_within(first.0 + first.1 * f64::from(*step) / f64::from(steps), second))
            .count();
        let overlap = found(&[arc(first, false), arc(second, backwards)]);
        prop_assert_eq!(overlap.is_some(), shared > 60 || (shared > 0 && overlap.is_some()));
        if let Some(overlap) = overlap {
            prop_assert!((overlap.from.distance(Point2::new(20.0, 0.0)) - 50.0).abs() < 1e-6);
        }
    }
}
