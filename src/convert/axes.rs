//! Which way things lie in a milling program: its axes in those of a job, where cuts run along y and z points up.

/// An axis of the program's base.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    X,
    Y,
    Z,
}

impl Axis {
    pub const ALL: [Self; 3] = [Self::X, Self::Y, Self::Z];

    #[must_use]
    pub const fn letter(self) -> char {
        match self {
            Self::X => 'x',
            Self::Y => 'y',
            Self::Z => 'z',
        }
    }

    const fn place(self) -> usize {
        match self {
            Self::X => 0,
            Self::Y => 1,
            Self::Z => 2,
        }
    }

    /// The one after it: x, y, z, x ...
    const fn next(self) -> Self {
        match self {
            Self::X => Self::Y,
            Self::Y => Self::Z,
            Self::Z => Self::X,
        }
    }
}

/// A sense along an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sense {
    Positive,
    /// Against it.
    Negative,
}

impl Sense {
    const fn factor(self) -> f64 {
        match self {
            Self::Positive => 1.0,
            Self::Negative => -1.0,
        }
    }
}

/// A direction along an axis of the program's base.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Direction {
    /// Along which axis.
    pub axis: Axis,
    /// Which way.
    pub sense: Sense,
}

impl Direction {
    #[must_use]
    pub const fn along(axis: Axis) -> Self {
        Self {
            axis,
            sense: Sense::Positive,
        }
    }

    /// How far a point lies that way.
    #[must_use]
    pub fn of(self, [x, y, z]: [f64; 3]) -> f64 {
        let value = match self.axis {
            Axis::X => x,
            Axis::Y => y,
            Axis::Z => z,
        };
        value * self.sense.factor()
    }

    /// As people write it: `y`, `-x`.
    #[must_use]
    pub fn words(self) -> String {
        match self.sense {
            Sense::Positive => self.axis.letter().to_string(),
            Sense::Negative => format!("-{}", self.axis.letter()),
        }
    }

    /// This one turned by a quarter about another, as x cross y is z. Not for parallel ones.
    #[must_use]
    pub fn cross(self, other: Self) -> Self {
        let [x, y, z] = Axis::ALL;
        let rest = [x, y, z]
            .into_iter()
            .find(|&axis| axis != self.axis && axis != other.axis)
            .unwrap_or(z);
        let turns = self.axis.next().place() == other.axis.place();
        let is_positive = (self.sense == other.sense) == turns;
        Self {
            axis: rest,
            sense: if is_positive {
                Sense::Positive
            } else {
                Sense::Negative
            },
        }
    }
}

/// The axes of a job, by directions in the program's base; right-handed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Axes {
    /// x: across the cuts.
    pub across: Direction,
    /// y: along them.
    pub along: Direction,
    /// z.
    pub up: Direction,
}

impl Axes {
    /// With the cuts along one axis, and one direction up.
    #[must_use]
    pub fn new(along: Axis, up: Direction) -> Self {
        let along = Direction::along(along);
        Self {
            across: along.cross(up),
            along,
            up,
        }
    }

    /// A point of the program in the axes of a job, from the program's origin.
    #[must_use]
    pub fn point(self, to: [f64; 3]) -> [f64; 3] {
        [self.across.of(to), self.along.of(to), self.up.of(to)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const UP: Direction = Direction::along(Axis::Z);

    #[test]
    fn cuts_along_y_are_as_in_a_job() {
        let axes = Axes::new(Axis::Y, UP);
        assert_eq!(axes.point([1.0, 2.0, 3.0]), [1.0, 2.0, 3.0]);
    }

    #[test]
    fn axes_stay_right_handed() {
        for up in Axis::ALL {
            for sense in [Sense::Positive, Sense::Negative] {
                for along in Axis::ALL.into_iter().filter(|&axis| axis != up) {
                    let axes = Axes::new(along, Direction { axis: up, sense });
                    let rows = [axes.across, axes.along, axes.up];
                    let unit = |axis: usize| {
                        let mut point = [0.0; 3];
                        point[axis] = 1.0;
                        rows.map(|row| row.of(point))
                    };
                    let [a, b, c] = [unit(0), unit(1), unit(2)];
                    let determinant = a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
                        + a[2] * (b[0] * c[1] - b[1] * c[0]);
                    assert!((determinant - 1.0).abs() < 1e-12, "{axes:?}");
                }
            }
        }
    }
}
