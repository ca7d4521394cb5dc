//! Discs as bodies of revolution, and the axes that they turn about.
//!
//! The face of a disc is flat and ends at its edge, of radius R. Above it, along the axis, stand cylinders: what is thick of
//! the disc itself, its hub, its holder. A bevel above the edge needs none as long as the axis leans from the vertical by
//! less than 90 degrees less the angle of the bevel: until then it is hidden from below by the face.

use core::fmt;
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::units::{Angle, Length};
use vcutc_backend_api::vector::dot;

/// The largest radius, and the largest height of a stage, in mm.
const LARGEST: f64 = 1e4;

/// The most stages.
const MOST_STAGES: usize = 64;

/// The least height of the tip of an axis of length 1: it leans by 89.4 degrees at most.
const LEAST_RISE: f64 = 0.01;

/// The direction of a disc's axis, from the edge to the spindle: of length 1, with a part along +z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axis([f64; 3]);

impl Axis {
    /// Straight up.
    pub const UP: Self = Self([0.0, 0.0, 1.0]);

    /// The axis along a vector of any length. None of a vector without length, and of one that leans from the vertical by
    /// more than 89.4 degrees.
    #[must_use]
    pub fn new(along: [f64; 3]) -> Option<Self> {
        let length = dot(along, along).sqrt();
        // Comparisons with NaN are false.
        let is_up = length > 0.0 && length.is_finite() && along[2] / length >= LEAST_RISE;
        is_up.then(|| Self(along.map(|part| part / length)))
    }

    /// The vector, of length 1.
    #[must_use]
    pub const fn to_array(self) -> [f64; 3] {
        self.0
    }

    /// How far it leans from the vertical.
    #[must_use]
    pub fn lean(self) -> Angle {
        let [x, y, z] = self.0;
        Angle::rad(libm::atan2((x * x + y * y).sqrt(), z))
    }

    /// The angle between two axes.
    #[must_use]
    pub fn angle_to(self, other: Self) -> Angle {
        let [a, b] = [self.0, other.0];
        let apart: [f64; 3] = core::array::from_fn(|i| a[i] - b[i]);
        let along: [f64; 3] = core::array::from_fn(|i| a[i] + b[i]);
        Angle::rad(2.0 * libm::atan2(dot(apart, apart).sqrt(), dot(along, along).sqrt()))
    }
}

/// A disc in space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// The centre of its face.
    pub centre: Point3,
    /// Its axis.
    pub axis: Axis,
}

/// A cylinder about the axis of a disc.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stage {
    /// Its radius.
    pub radius: Length,
    /// Where it begins, above the face.
    pub from: Length,
    /// Where it ends, above the face.
    pub to: Length,
}

/// A disc with what stands on it.
#[derive(Clone, Debug, PartialEq)]
pub struct Disc {
    radius: Length,
    stages: Vec<Stage>,
}

/// Why there is no such disc.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DiscError {
    /// The radius is not above 0, or above 10 m.
    Radius,
    /// The radius of a stage is not above 0 or above 10 m, or it does not end above its beginning, or begins below the face.
    Stage {
        /// The stage, from 0.
        index: usize,
    },
    /// There are more than 64 stages.
    TooMany,
}

impl fmt::Display for DiscError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Radius => write!(f, "the radius of the disc is not above 0 mm, or too large"),
            Self::Stage { index } => write!(
                f,
                "stage {index} of the disc's body has no extent, or is too large"
            ),
            Self::TooMany => write!(f, "the disc has more than {MOST_STAGES} stages"),
        }
    }
}

impl core::error::Error for DiscError {}

impl Disc {
    /// A disc by the radius of its edge and the stages on it, in any order.
    ///
    /// # Errors
    /// See [`DiscError`].
    pub fn new(radius: Length, stages: Vec<Stage>) -> Result<Self, DiscError> {
        let is_length = |length: Length| length.to_mm() > 0.0 && length.to_mm() <= LARGEST;
        if !is_length(radius) {
            return Err(DiscError::Radius);
        }
        if stages.len() > MOST_STAGES {
            return Err(DiscError::TooMany);
        }
        let is_good = |stage: &Stage| {
            is_length(stage.radius)
                && is_length(stage.to)
                && stage.from.to_mm() >= 0.0
                && stage.from.to_mm() < stage.to.to_mm()
        };
        match stages.iter().position(|stage| !is_good(stage)) {
            Some(index) => Err(DiscError::Stage { index }),
            None => Ok(Self { radius, stages }),
        }
    }

    /// The radius of the edge.
    #[must_use]
    pub const fn radius(&self) -> Length {
        self.radius
    }

    /// The stages.
    #[must_use]
    pub fn stages(&self) -> &[Stage] {
        &self.stages
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_point_up() {
        assert_eq!(Axis::new([0.0, 0.0, 3.0]), Some(Axis::UP));
        for bad in [
            [0.0; 3],
            [1.0, 0.0, 0.0],
            [0.0, 0.0, -1.0],
            [f64::NAN, 0.0, 1.0],
            [f64::INFINITY, 0.0, 1.0],
        ] {
            assert_eq!(Axis::new(bad), None, "{bad:?}");
        }
        let leaning = Axis::new([0.3, -0.4, 0.5]).unwrap();
        assert!((leaning.lean().to_deg() - 45.0).abs() < 1e-12);
        assert!((leaning.angle_to(Axis::UP).to_deg() - 45.0).abs() < 1e-12);
    }

    #[test]
    fn discs_without_extent_are_refused() {
        let mm = Length::mm;
        let stage = |radius, from, to| Stage {
            radius: mm(radius),
            from: mm(from),
            to: mm(to),
        };
        assert_eq!(Disc::new(mm(0.0), vec![]), Err(DiscError::Radius));
        assert_eq!(Disc::new(mm(f64::NAN), vec![]), Err(DiscError::Radius));
        for bad in [
            stage(0.0, 0.0, 1.0),
            stage(1.0, 2.0, 2.0),
            stage(1.0, -1.0, 2.0),
            stage(f64::NAN, 0.0, 1.0),
        ] {
            let stages = vec![stage(8.0, 1.0, 30.0), bad];
            assert_eq!(Disc::new(mm(25.0), stages), Err(DiscError::Stage { index: 1 }));
        }
        assert_eq!(
            Disc::new(mm(25.0), vec![stage(8.0, 1.0, 30.0); 65]),
            Err(DiscError::TooMany)
        );
    }
}
