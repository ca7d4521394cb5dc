//! Cuts as their section across has them: a V, or a single flank of one.

use super::TOUCH;
use super::stack::Ray;
use vcutc_geometry::curve::Point2;

/// What a cut makes: a V, or a single flank of one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vee {
    /// Where the flanks meet.
    pub tip: Point2,
    /// Rise of the left flank over x, if there is one: `cot(swing)`; positive, and infinite for a wall.
    pub left: Option<f64>,
    /// The same of the right one.
    pub right: Option<f64>,
}

/// A side of a V.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Towards -x.
    Left,
    /// Towards +x.
    Right,
}

impl Side {
    /// The other one.
    #[must_use]
    pub const fn opposite(self) -> Self {
        match self {
            Self::Left => Self::Right,
            Self::Right => Self::Left,
        }
    }
}

impl Vee {
    /// A V with both flanks at one swing.
    #[must_use]
    pub const fn even(tip: Point2, slope: f64) -> Self {
        Self {
            tip,
            left: Some(slope),
            right: Some(slope),
        }
    }

    /// A cut of one flank.
    #[must_use]
    pub const fn one(tip: Point2, side: Side, slope: f64) -> Self {
        let none = Self {
            tip,
            left: None,
            right: None,
        };
        none.with(side, slope)
    }

    /// With a flank on that side.
    #[must_use]
    pub const fn with(self, side: Side, slope: f64) -> Self {
        let slope = Some(slope);
        match side {
            Side::Left => Self { left: slope, ..self },
            Side::Right => Self { right: slope, ..self },
        }
    }

    /// With a wall where a flank is missing: above a flank is then between both.
    #[must_use]
    pub fn walled(self) -> Self {
        let wall = Some(f64::INFINITY);
        Self {
            left: self.left.or(wall),
            right: self.right.or(wall),
            ..self
        }
    }

    /// Whether both flanks are walls, with nothing between them.
    #[must_use]
    pub fn is_slit(self) -> bool {
        let is_wall = |slope: Option<f64>| slope.is_some_and(f64::is_infinite);
        is_wall(self.left) && is_wall(self.right)
    }

    /// Whether one of the flanks is missing.
    #[must_use]
    pub const fn is_single(self) -> bool {
        self.left.is_none() || self.right.is_none()
    }

    /// Height of the V over x; infinite where no flank is.
    #[must_use]
    pub fn height(self, x: f64) -> f64 {
        let side = if x < self.tip.x { Side::Left } else { Side::Right };
        if (x - self.tip.x).abs() <= TOUCH && self.is_steep() {
            return self.tip.z;
        }
        self.ray(side).map_or(f64::INFINITY, |ray| ray.height(x))
    }

    /// Whether a flank is a wall or missing, so that the V stands at its tip over no width on that side.
    fn is_steep(self) -> bool {
        let steep = |slope: Option<f64>| slope.is_none_or(f64::is_infinite);
        steep(self.left) || steep(self.right)
    }

    pub(super) const fn ray(self, side: Side) -> Option<Ray> {
        let slope = match side {
            Side::Left => self.left,
            Side::Right => self.right,
        };
        match slope {
            Some(slope) => Some(Ray { tip: self.tip, slope }),
            None => None,
        }
    }
}
