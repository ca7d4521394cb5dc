//! Lines and arcs of the plan.

use crate::place::Place;
use core::f64::consts::TAU;

/// A line or an arc from one place to another.
///
/// An arc is its ends and the angle it turns through, below a whole turn. The centre does not enter, so nearly straight
/// arcs keep their precision.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Piece {
    /// Where it begins.
    pub from: Place,
    /// Where it ends.
    pub to: Place,
    /// How far it turns, in rad, positive to the left; 0 for a line. Its magnitude is below 2 pi.
    pub sweep: f64,
}

impl Piece {
    /// The line between two places.
    #[must_use]
    pub const fn line(from: Place, to: Place) -> Self {
        Self { from, to, sweep: 0.0 }
    }

    /// The arc that turns through `sweep`, in rad, positive to the left.
    #[must_use]
    pub const fn arc(from: Place, to: Place, sweep: f64) -> Self {
        Self { from, to, sweep }
    }

    /// Whether it is a line.
    #[must_use]
    pub fn is_line(self) -> bool {
        self.sweep == 0.0
    }

    /// The same piece from its end to its beginning.
    #[must_use]
    pub fn reversed(self) -> Self {
        Self {
            from: self.to,
            to: self.from,
            sweep: -self.sweep,
        }
    }

    /// The radius of an arc; none of a line.
    #[must_use]
    pub fn radius(self) -> Option<f64> {
        (!self.is_line()).then(|| self.chord() / (2.0 * libm::sin(self.sweep.abs() / 2.0)))
    }

    /// The centre of an arc; none of a line.
    #[must_use]
    pub fn centre(self) -> Option<Place> {
        if self.is_line() {
            return None;
        }
        // Height of the centre over the chord, positive to the left.
        let (sin, cos) = libm::sincos(self.sweep / 2.0);
        let half = self.to.minus(self.from).times(0.5);
        Some(self.from.plus(half).plus(half.left().times(cos / sin)))
    }

    /// Its length.
    #[must_use]
    pub fn length(self) -> f64 {
        self.radius()
            .map_or_else(|| self.chord(), |radius| radius * self.sweep.abs())
    }

    /// The place a share `t` of the way along it.
    #[must_use]
    pub fn at(self, t: f64) -> Place {
        if self.is_line() {
            return self.from.lerp(self.to, t);
        }
        // The way gone is the chord turned by half of what is still to turn, and shortened (inscribed angles).
        let turned = self.sweep * t;
        let scale = libm::sin(turned / 2.0) / libm::sin(self.sweep / 2.0);
        let (sin, cos) = libm::sincos((turned - self.sweep) / 2.0);
        let chord = self.to.minus(self.from).times(scale);
        let way = Place::new(chord.x * cos - chord.y * sin, chord.x * sin + chord.y * cos);
        self.from.plus(way)
    }

    /// What of it lies between two shares of the way, the first one below the second.
    #[must_use]
    pub fn part(self, from: f64, to: f64) -> Self {
        let end = |share: f64| match share {
            0.0 => self.from,
            1.0 => self.to,
            share => self.at(share),
        };
        Self {
            from: end(from),
            to: end(to),
            sweep: self.sweep * (to - from),
        }
    }

    /// The direction in which it goes after a share `t` of the way: a vector of length 1.
    #[must_use]
    pub fn direction(self, t: f64) -> Place {
        let chord = self.to.minus(self.from).times(1.0 / self.chord());
        let (sin, cos) = libm::sincos(self.sweep * (t - 0.5));
        Place::new(chord.x * cos - chord.y * sin, chord.x * sin + chord.y * cos)
    }

    /// Twice the area between it and the origin, positive counter-clockwise.
    #[must_use]
    pub fn twice_area(self) -> f64 {
        let segment = self.radius().map_or(0.0, |radius| {
            radius * radius * (self.sweep - libm::sin(self.sweep))
        });
        self.from.cross(self.to) + segment
    }

    /// Whether its angle is one that a piece can have and its ends lie apart.
    #[must_use]
    pub fn is_sound(self) -> bool {
        self.sweep.abs() < TAU && self.chord() > 0.0
    }

    fn chord(self) -> f64 {
        self.from.distance(self.to)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::f64::consts::{FRAC_PI_2, PI};

    #[test]
    fn a_quarter_of_a_circle() {
        let piece = Piece::arc(Place::new(2.0, 0.0), Place::new(0.0, 2.0), FRAC_PI_2);
        assert!((piece.radius().unwrap_or(0.0) - 2.0).abs() < 1e-12);
        assert!(piece.centre().is_some_and(|centre| centre.length() < 1e-12));
        assert!((piece.length() - PI).abs() < 1e-12);
        assert!((piece.at(0.5).x - 2.0_f64.sqrt()).abs() < 1e-12);
        assert!(piece.direction(0.0).distance(Place::new(0.0, 1.0)) < 1e-12);
        assert!(piece.direction(1.0).distance(Place::new(-1.0, 0.0)) < 1e-12);
        assert!((piece.twice_area() - TAU).abs() < 1e-12);
    }
}
