//! Curves with control points, flattened by halving.
//!
//! A piece that is flat becomes its chord; another is cut in half by de Casteljau's construction. What flat means, and the proof
//! that halving makes pieces flat, is each kind of curve's own.

use super::{CurveError, Point2};

/// More halvings than any curve needs whose points a tolerance can distinguish.
const MOST_HALVINGS: usize = 60;

/// A control point.
pub(super) trait Control: Copy {
    /// The point a share of the way to another, from 0 to 1.
    fn lerp(self, other: Self, share: f64) -> Self;
    /// Where it is in the plane.
    fn point(self) -> Point2;
}

impl Control for Point2 {
    fn lerp(self, other: Self, share: f64) -> Self {
        Self::lerp(self, other, share)
    }

    fn point(self) -> Point2 {
        self
    }
}

/// The chords of a curve that is off them by at most `tolerance`, as `off_chord` bounds it, without its start. As
/// [`super::Curve::flatten`], with at most `most` points for a line and fewer by the degree for curves: a halving costs its
/// square.
pub(super) fn flatten<P: Control>(
    control: &[P],
    off_chord: fn(&[P]) -> f64,
    tolerance: f64,
    most: usize,
    out: &mut Vec<Point2>,
) -> Result<(), CurveError> {
    let degree = control.len().saturating_sub(1).max(1);
    let full = out.len().saturating_add(most / degree);
    // Pieces still to do, the next one last, each with how often it may still be halved.
    let mut pieces = vec![(control.to_vec(), MOST_HALVINGS)];
    while let Some((piece, halvings)) = pieces.pop() {
        let Some(end) = piece.last().copied() else {
            continue;
        };
        if off_chord(&piece) <= tolerance {
            if out.len() >= full {
                return Err(CurveError::TooManyPoints);
            }
            out.push(end.point());
        } else if halvings == 0 {
            return Err(CurveError::TooManyPoints);
        } else {
            let (first, second) = halve(piece);
            pieces.push((second, halvings - 1));
            pieces.push((first, halvings - 1));
        }
    }
    Ok(())
}

/// De Casteljau at one half: the control points of both halves.
fn halve<P: Control>(mut control: Vec<P>) -> (Vec<P>, Vec<P>) {
    let mut first = Vec::with_capacity(control.len());
    let mut second = Vec::with_capacity(control.len());
    while let (Some(&start), Some(&end)) = (control.first(), control.last()) {
        first.push(start);
        second.push(end);
        for i in 1..control.len() {
            control[i - 1] = control[i - 1].lerp(control[i], 0.5);
        }
        control.pop();
    }
    second.reverse();
    (first, second)
}
