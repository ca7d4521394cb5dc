//! Planes of arcs, and the way round in them.

/// A plane of two axes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Plane {
    /// X and Y, `G17`.
    Xy,
    /// Z and X, `G18`.
    Zx,
    /// Y and Z, `G19`.
    Yz,
}

/// The way round, seen from the positive end of the axis square to the plane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Sense {
    Clockwise,
    Counterclockwise,
}

impl Plane {
    /// All of them.
    pub(crate) const ALL: [Self; 3] = [Self::Xy, Self::Zx, Self::Yz];

    /// The word that chooses it.
    pub(crate) const fn word(self) -> &'static str {
        match self {
            Self::Xy => "G17",
            Self::Zx => "G18",
            Self::Yz => "G19",
        }
    }

    /// The axis square to it among X, Y and Z, from 0.
    pub(crate) const fn normal(self) -> usize {
        match self {
            Self::Xy => 2,
            Self::Zx => 1,
            Self::Yz => 0,
        }
    }

    /// Values of X, Y and Z without that of the axis square to it.
    pub(crate) fn within(self, mut values: [f64; 3]) -> [f64; 3] {
        if let Some(out) = values.get_mut(self.normal()) {
            *out = 0.0;
        }
        values
    }
}

impl Sense {
    /// The direction of the axis about which an arc goes, by the rule of the right hand.
    pub(crate) fn axis(self, plane: Plane) -> [f64; 3] {
        let along = match self {
            Self::Clockwise => -1.0,
            Self::Counterclockwise => 1.0,
        };
        core::array::from_fn(|place| if place == plane.normal() { along } else { 0.0 })
    }
}
