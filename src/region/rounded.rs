//! All places within a distance of a piece: where its outline crosses lines and circles, and which parts of those lie in it.
//!
//! The outline consists of the lines or circles beside the piece, to the left and to the right, and of the circles about its ends.
//! Between two crossings with all of these, a line or circle lies in it wholly or not at all.

use crate::curve::{Curve, crossings};
use crate::piece::Piece;
use crate::place::Place;

/// Lines and circles of an outline, each crossed twice at most.
const MOST_CROSSINGS: usize = 8;

/// A whole line or circle is straight where offset to its centre, to this share of the radius.
const TO_THE_CENTRE: f64 = 1e-12;

/// Circles farther from a line or circle than their radius and this, in mm, do not meet it: rounding is far less.
const SURELY: f64 = 1e-6;

/// A few numbers, without memory of their own.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Few {
    numbers: [f64; MOST_CROSSINGS + 2],
    count: usize,
}

impl Few {
    pub(crate) const fn new() -> Self {
        Self {
            numbers: [0.0; MOST_CROSSINGS + 2],
            count: 0,
        }
    }

    pub(crate) fn push(&mut self, number: f64) {
        if let Some(slot) = self.numbers.get_mut(self.count) {
            *slot = number;
            self.count += 1;
        }
    }

    pub(crate) fn sorted(&mut self) -> &[f64] {
        let numbers = self.numbers.get_mut(..self.count).unwrap_or_default();
        numbers.sort_unstable_by(f64::total_cmp);
        numbers
    }
}

/// The circle about a centre, as a whole one: it is not a piece.
pub(crate) fn circle(centre: Place, radius: f64) -> Curve {
    let at = centre.plus(Place::new(radius, 0.0));
    Curve {
        piece: Piece::line(at, at),
        ahead: Place::new(0.0, 1.0),
        arrival: Place::new(0.0, 1.0),
        middle: at,
        normal: Place::new(-1.0, 0.0),
        bend: 1.0 / radius,
    }
}

/// The whole line or circle so many mm to the left of a piece; none in the centre of an arc.
fn beside(curve: &Curve, by: f64) -> Option<Curve> {
    let shrunk = 1.0 - curve.bend * by;
    (shrunk.abs() > TO_THE_CENTRE).then(|| Curve {
        middle: curve.middle.plus(curve.normal.times(by)),
        bend: curve.bend / shrunk,
        ..*curve
    })
}

/// Calls with all places where a whole line or circle crosses the outline of what lies within `reach` of a piece. Some more places
/// of it may come along.
pub(crate) fn outline_crossings(curve: &Curve, reach: f64, other: &Curve, call: &mut impl FnMut(Place)) {
    let mut meet = |part: &Curve| crossings(part, other).into_iter().flatten().for_each(&mut *call);
    if reach > 0.0 {
        for end in [curve.piece.from, curve.piece.to] {
            if other.left_of(end).abs() <= reach + SURELY {
                meet(&circle(end, reach));
            }
        }
        for by in [reach, -reach] {
            if let Some(part) = beside(curve, by) {
                meet(&part);
            }
        }
    } else {
        meet(curve);
    }
}

/// Calls with the parts of a piece, as shares of its way, that lie within `reach` of another.
pub(crate) fn parts_within(piece: &Curve, other: &Curve, reach: f64, call: &mut impl FnMut(f64, f64)) {
    let mut shares = Few::new();
    shares.push(0.0);
    shares.push(1.0);
    outline_crossings(other, reach, piece, &mut |place| {
        let share = share(piece, place);
        if share > 0.0 && share < 1.0 {
            shares.push(share);
        }
    });
    for pair in shares.sorted().windows(2) {
        if let &[from, to] = pair
            && to > from
            && other.distance(piece.piece.at(f64::midpoint(from, to))) < reach
        {
            call(from, to);
        }
    }
}

/// Calls with the parts of a piece, as shares of its way, that lie within a circle.
pub(crate) fn parts_in_circle(piece: &Curve, centre: Place, radius: f64, call: &mut impl FnMut(f64, f64)) {
    let mut shares = Few::new();
    shares.push(0.0);
    shares.push(1.0);
    for place in crossings(piece, &circle(centre, radius)).into_iter().flatten() {
        shares.push(share(piece, place).clamp(0.0, 1.0));
    }
    for pair in shares.sorted().windows(2) {
        if let &[from, to] = pair
            && to > from
            && piece.piece.at(f64::midpoint(from, to)).distance(centre) < radius
        {
            call(from, to);
        }
    }
}

/// The share of its way at which a piece passes a place on its line or circle; outside of 0 to 1 beyond its ends.
pub(crate) fn share(curve: &Curve, place: Place) -> f64 {
    let progress = curve.progress(place);
    if curve.piece.is_line() {
        progress / curve.piece.length()
    } else {
        progress / curve.piece.sweep
    }
}

/// The part of a piece between two shares of its way.
pub(crate) fn part(piece: Piece, from: f64, to: f64) -> Piece {
    Piece {
        from: if from <= 0.0 { piece.from } else { piece.at(from) },
        to: if to >= 1.0 { piece.to } else { piece.at(to) },
        sweep: piece.sweep * (to - from),
    }
}
