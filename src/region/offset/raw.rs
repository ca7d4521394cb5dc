//! Walls moved inwards, and arcs about re-entrant corners, before anything is cut off.

use super::chain::{Link, Opening};
use super::{JOIN, Origin};
use crate::boxes::Extent;
use crate::curve::Curve;
use crate::piece::Piece;
use crate::place::Place;

/// A wall moved inwards, or an arc about a corner.
#[derive(Clone, Copy, Debug)]
pub(super) struct Raw {
    pub(super) curve: Curve,
    pub(super) origin: Origin,
    /// The link at whose end it ends, and which goes smoothly on there.
    pub(super) next: Option<usize>,
    /// The link that it belongs to, or whose beginning it turns about.
    pub(super) link: Option<usize>,
}

impl Raw {
    /// A box around it: no place of an arc is farther from its middle than its ends.
    pub(super) fn extent(&self) -> Extent {
        let piece = self.curve.piece;
        if piece.is_line() {
            return Extent::of(piece.from, piece.to);
        }
        let middle = self.curve.middle;
        let (one, other) = (piece.from.minus(middle), piece.to.minus(middle));
        let reach = one.dot(one).max(other.dot(other)).sqrt();
        Extent::of(middle, middle).grown(reach)
    }
}

/// What bounds a level beyond open sides.
pub(super) fn gates(opening: Option<&Opening>, raws: &mut Vec<Raw>) {
    let gates = opening.map_or(&[][..], |opening| &opening.gates);
    raws.extend(gates.iter().map(|&curve| Raw {
        curve,
        origin: Origin::Gate,
        next: None,
        link: None,
    }));
}

/// All walls moved by a distance, with the arcs between.
pub(super) fn moved(links: &[Link], distance: f64, raws: &mut Vec<Raw>) {
    raws.clear();
    for (number, link) in links.iter().enumerate() {
        let next = link.next.and_then(|next| Some((next, links.get(next)?)));
        let corner = next.and_then(|(_, next)| about_corner(&link.curve, &next.curve, distance));
        let joined = next.filter(|(_, next)| corner.is_some() || is_smooth(&link.curve, &next.curve));
        if let Some(curve) = link.curve.moved(distance, JOIN) {
            raws.push(Raw {
                curve,
                origin: Origin::Edge(link.edge),
                next: joined.map(|(next, _)| next),
                link: Some(number),
            });
        }
        if let Some((curve, (next, after))) = corner.zip(next) {
            raws.push(Raw {
                curve,
                origin: Origin::Corner(after.edge),
                next: Some(next),
                link: Some(next),
            });
        }
    }
}

/// The arc about a re-entrant corner.
fn about_corner(one: &Curve, next: &Curve, distance: f64) -> Option<Curve> {
    let (cross, dot) = (one.arrival.cross(next.ahead), one.arrival.dot(next.ahead));
    if cross > 0.0 || dot > 0.0 && -cross * distance <= JOIN / 4.0 {
        return None;
    }
    // A way straight back: re-entrant where the next wall lies to the right of the one before.
    if dot < 0.0 && cross > -JOIN && one.left_of(next.middle) > 0.0 {
        return None;
    }
    let corner = one.piece.to;
    let (first, last) = (one.arrival.left(), next.ahead.left());
    let sum = first.plus(last);
    let size = sum.length();
    let normal = if size > JOIN {
        sum.times(1.0 / size)
    } else {
        one.arrival
    };
    let piece = Piece {
        from: corner.plus(first.times(distance)),
        to: corner.plus(last.times(distance)),
        sweep: -libm::atan2(cross.abs(), dot),
    };
    Some(Curve {
        piece,
        ahead: one.arrival,
        arrival: next.ahead,
        middle: corner.plus(normal.times(distance)),
        normal,
        bend: -1.0 / distance,
    })
}

fn is_smooth(one: &Curve, next: &Curve) -> bool {
    let across: Place = one.arrival.minus(next.ahead);
    across.dot(across) < 1e-18
}
