//! Lines and arcs with what their questions need: one form for both, without a centre.
//!
//! With m the middle of a piece, n its left normal there and k its curvature (positive to the left, 0 of a line), the whole line or
//! circle is `2 n.(p - m) - k |p - m|^2 = 0`. The distance of a place to the left of it follows without cancelling, however large
//! the radius: `R - |p - c| = (2 n.(p - m) - k |p - m|^2) / (1 + |n - k (p - m)|)`.

use crate::boxes::Extent;
use crate::piece::Piece;
use crate::place::Place;
use core::f64::consts::{FRAC_PI_2, PI, TAU};

/// Circles that lap, or miss each other, by less than half of this times a radius touch: rounding decides which.
const TOUCH: f64 = 4e-15;

/// A piece, ready to be asked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Curve {
    /// The piece itself.
    pub piece: Piece,
    /// The direction in which it begins.
    pub ahead: Place,
    /// The direction in which it ends.
    pub arrival: Place,
    /// Its middle.
    pub middle: Place,
    /// The left normal in its middle.
    pub normal: Place,
    /// Its curvature, in 1/mm, positive to the left.
    pub bend: f64,
}

/// A place of a piece, and how far away it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Foot {
    /// The distance, in mm.
    pub distance: f64,
    /// The place.
    pub at: Place,
}

impl Curve {
    /// Prepares a piece.
    #[must_use]
    pub fn of(piece: Piece) -> Self {
        let way = piece.to.minus(piece.from);
        let chord = way.dot(way).sqrt();
        let along = way.times(1.0 / chord);
        let half = piece.from.plus(way.times(0.5));
        if piece.is_line() {
            return Self {
                piece,
                ahead: along,
                arrival: along,
                middle: half,
                normal: along.left(),
                bend: 0.0,
            };
        }
        let (sin, cos) = libm::sincos(piece.sweep / 2.0);
        // The sagitta is half the chord times tan(sweep / 4), to the right of the chord.
        let sagitta = chord / 2.0 * sin / (1.0 + cos);
        Self {
            piece,
            ahead: Place::new(along.x * cos + along.y * sin, along.y * cos - along.x * sin),
            arrival: Place::new(along.x * cos - along.y * sin, along.y * cos + along.x * sin),
            middle: half.minus(along.left().times(sagitta)),
            normal: along.left(),
            bend: 2.0 * sin / chord,
        }
    }

    /// How far to the left of the whole line or circle a place is, in mm, negative to the right.
    #[must_use]
    pub fn left_of(&self, place: Place) -> f64 {
        let to = place.minus(self.middle);
        let normal = self.normal.minus(to.times(self.bend));
        (2.0 * self.normal.dot(to) - self.bend * to.dot(to)) / (1.0 + normal.dot(normal).sqrt())
    }

    /// The place of the whole line or circle that is nearest to another; the same place for the centre of a circle.
    #[must_use]
    pub fn foot(&self, place: Place) -> Place {
        let to = place.minus(self.middle);
        let normal = self.normal.minus(to.times(self.bend));
        let size = normal.dot(normal).sqrt();
        let left = (2.0 * self.normal.dot(to) - self.bend * to.dot(to)) / (1.0 + size);
        if size > 0.0 {
            place.minus(normal.times(left / size))
        } else {
            place
        }
    }

    /// Whether the foot of a place on the whole line or circle belongs to the piece, give or take some mm.
    ///
    /// A place lies before the normal at an end where it is in front of it. Both must hold of turns up to half a circle, either
    /// of longer ones.
    #[must_use]
    pub fn is_beside(&self, place: Place, slack: f64) -> bool {
        let after = place.minus(self.piece.from).dot(self.ahead) >= -slack;
        let before = place.minus(self.piece.to).dot(self.arrival) <= slack;
        if self.piece.sweep.abs() <= PI {
            after && before
        } else {
            after || before
        }
    }

    /// The nearest place of the piece.
    #[must_use]
    pub fn nearest(&self, place: Place) -> Foot {
        if self.is_beside(place, 0.0) {
            let to = place.minus(self.middle);
            let normal = self.normal.minus(to.times(self.bend));
            let size = normal.dot(normal).sqrt();
            // In the centre of an arc all its places are alike.
            if size > 0.0 {
                let left = (2.0 * self.normal.dot(to) - self.bend * to.dot(to)) / (1.0 + size);
                return Foot {
                    distance: left.abs(),
                    at: place.minus(normal.times(left / size)),
                };
            }
        }
        let (from, to) = (place.minus(self.piece.from), place.minus(self.piece.to));
        let (first, last) = (from.dot(from), to.dot(to));
        if first <= last {
            Foot {
                distance: first.sqrt(),
                at: self.piece.from,
            }
        } else {
            Foot {
                distance: last.sqrt(),
                at: self.piece.to,
            }
        }
    }

    /// The distance of a place, in mm.
    #[must_use]
    pub fn distance(&self, place: Place) -> f64 {
        if self.is_beside(place, 0.0) {
            return self.left_of(place).abs();
        }
        let (from, to) = (place.minus(self.piece.from), place.minus(self.piece.to));
        from.dot(from).min(to.dot(to)).sqrt()
    }

    /// How far an arc has turned, in rad, or a line has gone, in mm, from its beginning to one of its places.
    #[must_use]
    pub fn progress(&self, place: Place) -> f64 {
        let way = place.minus(self.piece.from);
        if self.piece.is_line() {
            return way.dot(self.ahead);
        }
        // A chord makes half the angle of its arc with the tangent.
        let half = libm::atan2(self.ahead.cross(way), self.ahead.dot(way));
        let turned = 2.0 * half;
        // The far side of long arcs: angles with the sign of the sweep.
        if turned * self.piece.sweep < 0.0 && turned.abs() > PI - self.piece.sweep.abs() / 2.0 {
            turned + 2.0 * PI * self.piece.sweep.signum()
        } else {
            turned
        }
    }

    /// The direction of the piece at one of its places.
    #[must_use]
    pub fn direction(&self, place: Place) -> Place {
        let normal = self.normal.minus(place.minus(self.middle).times(self.bend));
        let size = normal.dot(normal).sqrt();
        Place::new(normal.y, -normal.x).times(1.0 / size)
    }

    /// The part of it between two of its places.
    #[must_use]
    pub fn part(&self, from: Place, to: Place) -> Piece {
        if self.piece.is_line() {
            return Piece::line(from, to);
        }
        let chord = to.minus(from);
        let ahead = self.direction(from);
        let half = libm::atan2(ahead.cross(chord), ahead.dot(chord));
        let sense = self.piece.sweep.signum();
        if half * sense > 0.0 {
            Piece::arc(from, to, 2.0 * half)
        } else if half.abs() > FRAC_PI_2 {
            // More than half a circle.
            Piece::arc(from, to, 2.0 * half + TAU * sense)
        } else {
            Piece::line(from, to)
        }
    }

    /// The curve moved to the left; none of an arc that shrinks to less than a radius, in mm.
    #[must_use]
    pub fn moved(&self, distance: f64, least: f64) -> Option<Self> {
        let shrunk = 1.0 - self.bend * distance;
        if shrunk <= least * self.bend.abs() {
            return None;
        }
        let piece = Piece {
            from: self.piece.from.plus(self.ahead.left().times(distance)),
            to: self.piece.to.plus(self.arrival.left().times(distance)),
            sweep: self.piece.sweep,
        };
        Some(Self {
            piece,
            middle: self.middle.plus(self.normal.times(distance)),
            bend: self.bend / shrunk,
            ..*self
        })
    }

    /// The place where it goes in a direction or against it, if it does: for arcs up to half a circle there is one at most of each.
    #[must_use]
    pub fn where_it_goes(&self, direction: Place) -> Option<Place> {
        let along = Place::new(self.normal.y, -self.normal.x);
        let turned = libm::atan2(along.cross(direction), along.dot(direction));
        let is_within = !self.piece.is_line() && turned.abs() <= self.piece.sweep.abs() / 2.0;
        is_within.then(|| self.piece.at(0.5 + turned / self.piece.sweep))
    }

    /// The box around it.
    #[must_use]
    pub fn extent(&self) -> Extent {
        let ends = Extent::of(self.piece.from, self.piece.to);
        if self.piece.is_line() {
            return ends;
        }
        // The extremes along the axes, where the arc passes them.
        let axes = [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)];
        axes.iter().fold(ends, |extent, &(x, y)| {
            let most = self.where_it_goes(Place::new(x, y));
            most.map_or(extent, |most| extent.with(Extent::of(most, most)))
        })
    }
}

/// Where two whole lines or circles cross: at most twice. None of those that coincide.
#[must_use]
pub fn crossings(one: &Curve, other: &Curve) -> [Option<Place>; 2] {
    let (flat, round) = if one.bend.abs() <= other.bend.abs() {
        (one, other)
    } else {
        (other, one)
    };
    // From the middle of the rounder one: `2 b.x - k x^2 + c = 0` for the flatter, `2 n.x - k' x^2 = 0` for the rounder.
    let away = round.middle.minus(flat.middle);
    let slope = flat.normal.minus(away.times(flat.bend));
    let height = 2.0 * flat.normal.dot(away) - flat.bend * away.dot(away);
    let ratio = if round.bend == 0.0 {
        0.0
    } else {
        flat.bend / round.bend
    };
    // Both crossings lie on a line `2 g.x + c = 0`.
    let across = slope.minus(round.normal.times(ratio));
    let size = across.dot(across);
    if size < 1e-24 {
        return [None, None];
    }
    let foot = across.times(-height / (2.0 * size));
    let along = across.left().times(1.0 / size.sqrt());
    // k' s^2 - 2 (n.l) s - (2 n.f - k' f^2) = 0.
    let half = round.normal.dot(along);
    let rest = round.bend * foot.dot(foot) - 2.0 * round.normal.dot(foot);
    let root = half * half - round.bend * rest;
    let place = |s: f64| {
        s.is_finite()
            .then(|| round.middle.plus(foot).plus(along.times(s)))
    };
    if round.bend != 0.0 && root.abs() <= TOUCH {
        return [place(half / round.bend), None];
    }
    if root < 0.0 {
        return [None, None];
    }
    let sum = half + root.sqrt().copysign(half);
    [place(rest / sum), place(sum / round.bend)]
}

/// Where two whole lines or circles cross that are known to cross in a place: the other one, if there is one.
#[must_use]
pub fn other_crossing(
    one: &Curve,
    other: &Curve,
    common: Place,
    directions: (Place, Place),
) -> Option<Place> {
    let (first, second) = directions;
    let across = first
        .left()
        .times(other.bend)
        .minus(second.left().times(one.bend));
    let size = across.dot(across);
    (size > 1e-24).then(|| common.plus(across.left().times(2.0 * first.cross(second) / size)))
}

#[cfg(test)]
mod tests;
