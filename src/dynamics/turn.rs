//! How joints turn what they carry.

use crate::vector::{Number, Vector, along, cross, cross_plain, dot_plain, scaled, sum};
use glam::DVec3;
use vcutc_geometry::number::Along;

/// A constant line about which a joint turns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Axis {
    /// Of length 1.
    pub(crate) direction: Vector<f64>,
    lies: Lies,
}

/// How an axis lies in its frame. Those of most arms lie along one of its axes, about which a turn takes a third of the work.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Lies {
    AlongX(Sense),
    AlongY(Sense),
    AlongZ(Sense),
    Askew,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Sense {
    With,
    Against,
}

/// By how much a right angle may be rounded.
const ROUNDING: f64 = 1e-15;

impl Axis {
    /// About a direction of length 1.
    pub(crate) fn new(direction: DVec3) -> Self {
        let lies = [
            (DVec3::X, Lies::AlongX(Sense::With)),
            (-DVec3::X, Lies::AlongX(Sense::Against)),
            (DVec3::Y, Lies::AlongY(Sense::With)),
            (-DVec3::Y, Lies::AlongY(Sense::Against)),
            (DVec3::Z, Lies::AlongZ(Sense::With)),
            (-DVec3::Z, Lies::AlongZ(Sense::Against)),
        ];
        let found = lies
            .into_iter()
            .find(|(own, _)| own.distance(direction) < ROUNDING);
        let (direction, lies) = found.unwrap_or((direction, Lies::Askew));
        Self {
            direction: direction.to_array(),
            lies,
        }
    }

    /// The moment about the axis, through the origin, of a force at a place.
    #[inline(always)]
    pub(crate) fn moment_of<N: Number>(self, force: Vector<N>, place: Vector<N>) -> N {
        let [[x, y, z], [fx, fy, fz]] = [place, force];
        let (sense, moment) = match self.lies {
            Lies::AlongX(sense) => (sense, y * fz - z * fy),
            Lies::AlongY(sense) => (sense, z * fx - x * fz),
            Lies::AlongZ(sense) => (sense, x * fy - y * fx),
            Lies::Askew => (Sense::With, dot_plain(cross(place, force), self.direction)),
        };
        match sense {
            Sense::With => moment,
            Sense::Against => -moment,
        }
    }
}

/// How far a joint has turned.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turn<N> {
    pub sine: N,
    pub cosine: N,
}

impl Turn<f64> {
    /// By an angle, in rad.
    #[must_use]
    pub fn by(angle: f64) -> Self {
        let (sine, cosine) = libm::sincos(angle);
        Self { sine, cosine }
    }
}

impl Turn<Along> {
    /// By an angle along a part of a motion.
    #[must_use]
    pub fn along(angle: Along) -> Self {
        let (sine, cosine) = angle.sin_cos();
        Self { sine, cosine }
    }
}

impl<N: Number> Turn<N> {
    /// A vector after the turn.
    #[inline(always)]
    pub(crate) fn out(self, axis: Axis, a: Vector<N>) -> Vector<N> {
        self.reversed().back(axis, a)
    }

    /// A plain vector after the turn.
    #[inline(always)]
    pub(crate) fn out_plain(self, axis: Axis, a: Vector<f64>) -> Vector<N> {
        self.reversed().back_plain(axis, a)
    }

    fn reversed(self) -> Self {
        Self {
            sine: -self.sine,
            cosine: self.cosine,
        }
    }

    /// A vector before the turn.
    #[inline(always)]
    pub(crate) fn back(self, axis: Axis, a: Vector<N>) -> Vector<N> {
        let [x, y, z] = a;
        match axis.lies {
            Lies::AlongX(sense) => {
                let [y, z] = self.in_plane(sense, [y, z]);
                [x, y, z]
            }
            Lies::AlongY(sense) => {
                let [z, x] = self.in_plane(sense, [z, x]);
                [x, y, z]
            }
            Lies::AlongZ(sense) => {
                let [x, y] = self.in_plane(sense, [x, y]);
                [x, y, z]
            }
            // Rodrigues. With the axis second, the cross product is the other way round.
            Lies::Askew => {
                let square = cross_plain(a, axis.direction);
                let twice = cross_plain(square, axis.direction);
                sum(a, sum(scaled(twice, self.versine()), scaled(square, self.sine)))
            }
        }
    }

    /// A plain vector before the turn.
    #[inline(always)]
    pub(crate) fn back_plain(self, axis: Axis, a: Vector<f64>) -> Vector<N> {
        let [x, y, z] = a;
        match axis.lies {
            Lies::AlongX(sense) => {
                let [y, z] = self.in_plane(sense, [y, z]);
                [N::plain(x), y, z]
            }
            Lies::AlongY(sense) => {
                let [z, x] = self.in_plane(sense, [z, x]);
                [x, N::plain(y), z]
            }
            Lies::AlongZ(sense) => {
                let [x, y] = self.in_plane(sense, [x, y]);
                [x, y, N::plain(z)]
            }
            Lies::Askew => {
                let square = cross_plain(a, axis.direction);
                let twice = cross_plain(square, axis.direction);
                let turned = sum(along(twice, self.versine()), along(square, self.sine));
                core::array::from_fn(|part| turned[part].plus(a[part]))
            }
        }
    }

    /// A vector across the axis before the turn, its parts in the order of the frame.
    #[inline(always)]
    fn in_plane<T: Copy>(self, sense: Sense, [first, second]: [T; 2]) -> [N; 2]
    where
        N: core::ops::Mul<T, Output = N>,
    {
        let [one, other] = [self.sine * first, self.sine * second];
        let [first, second] = [self.cosine * first, self.cosine * second];
        match sense {
            Sense::With => [first + other, second - one],
            Sense::Against => [first - other, second + one],
        }
    }

    fn versine(self) -> N {
        (-self.cosine).plus(1.0)
    }
}

#[cfg(test)]
mod tests;
