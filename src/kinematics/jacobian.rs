//! How fast a body moves for how fast the axes move: the geometric Jacobian.
//!
//! A column tells what one axis does alone at one unit of rate (1 rad/s, or 1 mm/s of a linear axis): the velocity of a
//! point of the body and the angular velocity of the body, both along the axes of the **root**. With `J` the matrix of these
//! columns, `twist = J rates`; the reverse, `rates = J^-1 twist`, is equation 16 of Ha 2019 (`docs/references.md`). It has
//! no answer where the columns lose their independence: in singular poses.

use super::Joints;
use glam::DVec3;
use nalgebra::{SMatrix, SVD, SVector};
use vcutc_backend_api::ir::MOST_AXES;

/// The velocity of a body: of one of its points, and of its turning. Along the axes of the root.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Twist {
    /// Velocity of the point, in mm/s.
    pub linear: DVec3,
    /// Angular velocity, in rad/s.
    pub angular: DVec3,
}

/// The twists that the axes give, one at a time, at one unit of rate. An axis that does not exist gives none: zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jacobian {
    /// A column for each axis.
    pub columns: [Twist; MOST_AXES],
}

/// The square matrix of a Jacobian: three rows of linear velocity, in a chosen unit of length, above three of angular.
pub(super) type Square = SMatrix<f64, MOST_AXES, MOST_AXES>;

/// A twist, an error or a step as a column.
pub(super) type Column = SVector<f64, MOST_AXES>;

/// Lengths are compared with angles as if an arm were of this size, in mm: that makes a number out of how near to singular
/// a Jacobian is.
const METRE: f64 = 1000.0;

/// Smallest over largest singular value below which a Jacobian counts as singular: there the rates that come out have lost
/// half of their digits.
const SINGULAR: f64 = 1e-9;

/// Most sweeps of the singular value decomposition. It takes about ten.
const MOST_SWEEPS: usize = 200;

impl Twist {
    /// At rest.
    pub const ZERO: Self = Self {
        linear: DVec3::ZERO,
        angular: DVec3::ZERO,
    };

    /// The six numbers, lengths in units of `length` mm.
    pub(super) fn column(&self, length: f64) -> Column {
        let (v, w) = (self.linear / length, self.angular);
        Column::new(v.x, v.y, v.z, w.x, w.y, w.z)
    }
}

impl Jacobian {
    /// The twist at these rates, in rad/s and mm/s.
    #[must_use]
    pub fn twist(&self, rates: &Joints) -> Twist {
        let mut sum = Twist::ZERO;
        for (column, rate) in self.columns.iter().zip(rates) {
            sum.linear += column.linear * *rate;
            sum.angular += column.angular * *rate;
        }
        sum
    }

    /// The rates, in rad/s and mm/s, that give a twist. Axes that do not exist rest.
    ///
    /// None where the pose is singular (see [`Jacobian::conditioning`]), and where a machine with fewer than six axes cannot
    /// move that way.
    #[must_use]
    pub fn rates(&self, twist: &Twist) -> Option<Joints> {
        let (svd, conditioning) = self.decomposed()?;
        if conditioning <= SINGULAR {
            return None;
        }
        let wanted = twist.column(METRE);
        // Zero columns, of axes that do not exist, have singular values of zero and are left out by the threshold.
        let threshold = svd.singular_values.max() * SINGULAR;
        let rates = svd.solve(&wanted, threshold).ok()?;
        let missed = (self.square(METRE) * rates - wanted).norm();
        let given = missed <= 1e-6 * wanted.norm() && rates.iter().all(|rate| rate.is_finite());
        given.then(|| rates.into())
    }

    /// How far from singular the pose is: the smallest singular value over the largest, of the axes that exist, with lengths
    /// in metres. 0 in a singular pose, at most 1; 0 as well for a Jacobian with numbers that are not finite.
    #[must_use]
    pub fn conditioning(&self) -> f64 {
        self.decomposed().map_or(0.0, |(_, conditioning)| conditioning)
    }

    /// The matrix, lengths in units of `length` mm.
    pub(super) fn square(&self, length: f64) -> Square {
        Square::from_columns(&self.columns.map(|column| column.column(length)))
    }

    fn decomposed(&self) -> Option<(SVD<f64, nalgebra::U6, nalgebra::U6>, f64)> {
        let square = self.square(METRE);
        if !square.iter().all(|entry| entry.is_finite()) {
            return None;
        }
        let axes = self
            .columns
            .iter()
            .filter(|column| **column != Twist::ZERO)
            .count();
        // Singular values come in falling order, so those of the axes that exist come first.
        let svd = square.try_svd(true, true, f64::EPSILON, MOST_SWEEPS)?;
        let largest = svd.singular_values.max();
        let smallest = *svd.singular_values.get(axes.checked_sub(1)?)?;
        (largest > 0.0).then(|| (svd, smallest / largest))
    }
}

/// The distance of a matrix from the nearest singular one.
pub(super) fn least_singular_value(square: &Square) -> Option<f64> {
    let svd = square.try_svd(false, false, f64::EPSILON, MOST_SWEEPS)?;
    Some(svd.singular_values.min())
}
