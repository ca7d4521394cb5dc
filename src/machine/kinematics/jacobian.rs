//! How fast a body moves for how fast the axes move: the geometric Jacobian.
//!
//! A column is what one axis does alone at one unit of rate (1 rad/s, or 1 mm/s of a linear axis): the velocity of a
//! point of the body and the angular velocity of the body, both along the axes of the **root**. With `J` the matrix of these
//! columns, `twist = J rates`; the reverse, `rates = J^-1 twist`, is [Ha 2019] equation 16. It has
//! no answer where the columns lose their independence: in singular poses.

use super::Joints;
use super::five_axis::FiveAxis;
use super::joint_axis::JointAxis;
use super::pose::Pose;
use glam::{DMat3, DVec3};
use nalgebra::{SMatrix, SVector};
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

/// Smallest over largest diagonal entry of the triangle below which a Jacobian counts as singular: rates found there would
/// have lost half of their digits.
const SINGULAR: f64 = 1e-9;

/// How much of a twist may be missing that axes which do not exist would have to give: rounding.
const MISSED: f64 = 1e-9;

/// Most sweeps of the singular value decomposition. It takes about ten.
const MOST_SWEEPS: usize = 200;

impl Twist {
    /// At rest.
    pub const ZERO: Self = Self {
        linear: DVec3::ZERO,
        angular: DVec3::ZERO,
    };

    /// What turning about a line at 1 rad/s does to a body and to a point of it.
    pub(super) fn about(axis: &JointAxis, point: DVec3) -> Self {
        Self {
            linear: axis.direction.cross(point - axis.point),
            angular: axis.direction,
        }
    }

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
    /// None in singular poses, and where a machine with fewer than six axes cannot move that way.
    #[must_use]
    pub fn rates(&self, twist: &Twist) -> Option<Joints> {
        let square = self.square(METRE);
        let wanted = twist.column(METRE);
        if !square.iter().chain(wanted.iter()).all(|entry| entry.is_finite()) {
            return None;
        }
        // By orthogonal triangles, the columns of axes that do not exist last: what is left of the twist below the
        // triangle of the others cannot be given.
        let axes = self.axes();
        let qr = square.col_piv_qr();
        let triangle = qr.r();
        let last = axes.checked_sub(1)?;
        let (largest, least) = (triangle[(0, 0)].abs(), triangle[(last, last)].abs());
        let mut rates = qr.q().transpose() * wanted;
        let missed = rates.rows(axes, MOST_AXES - axes).norm();
        if !(least > SINGULAR * largest && missed <= MISSED * wanted.norm()) {
            return None;
        }
        rates.rows_mut(axes, MOST_AXES - axes).fill(0.0);
        let solved = triangle
            .view((0, 0), (axes, axes))
            .solve_upper_triangular_mut(&mut rates.rows_mut(0, axes));
        qr.p().inv_permute_rows(&mut rates);
        let given = solved && rates.iter().all(|rate| rate.is_finite());
        given.then(|| rates.into())
    }

    /// The inverse of the matrix: for each axis by how much it moves for a mm a second of the point along x, y and z, and for
    /// a rad a second about x, y and z.
    ///
    /// None where rounding leaves no inverse, as for machines with fewer than six axes.
    #[must_use]
    pub fn inverse(&self) -> Option<[[f64; MOST_AXES]; MOST_AXES]> {
        let inverse = self.square(1.0).try_inverse()?;
        let finite = inverse.iter().all(|entry| entry.is_finite());
        finite.then(|| core::array::from_fn(|i| core::array::from_fn(|k| inverse[(i, k)])))
    }

    /// How far from singular the pose is: the smallest singular value over the largest, of the axes that exist, with lengths
    /// in metres. 0 in a singular pose, at most 1; 0 as well for a Jacobian with numbers that are not finite.
    #[must_use]
    pub fn conditioning(&self) -> f64 {
        let ratio = || {
            let values = singular_values(&self.square(METRE))?;
            // In falling order, so those of the axes that exist come first.
            let least = values.get(self.axes().checked_sub(1)?)?;
            let ratio = least / values.max();
            ratio.is_finite().then_some(ratio)
        };
        ratio().unwrap_or(0.0)
    }

    /// The matrix, lengths in units of `length` mm.
    pub(super) fn square(&self, length: f64) -> Square {
        Square::from_columns(&self.columns.map(|column| column.column(length)))
    }

    /// How many axes exist.
    fn axes(&self) -> usize {
        self.columns
            .iter()
            .filter(|column| **column != Twist::ZERO)
            .count()
    }
}

/// Whether every singular matrix is farther than this from a matrix: whether all its singular values are larger, that is,
/// whether `M^T M - distance^2` is positive definite. That is far quicker to find out than the values.
pub(super) fn keeps_from_singular(square: &Square, distance: f64) -> bool {
    let rest = square.transpose() * square - Square::identity() * (distance * distance);
    rest.cholesky().is_some()
}

/// In falling order.
fn singular_values(square: &Square) -> Option<Column> {
    if !square.iter().all(|entry| entry.is_finite()) {
        return None;
    }
    let svd = square.try_svd(false, false, f64::EPSILON, MOST_SWEEPS)?;
    Some(svd.singular_values)
}

impl FiveAxis {
    /// What each axis does to the spindle nose and to a point fixed to it, `point_in_nose` in mm, seen from the mount. A
    /// table moves the work, and so all that is seen from it, the other way.
    #[must_use]
    pub fn jacobian(&self, joints: &Joints, point_in_nose: DVec3) -> Jacobian {
        let mut lines: [Option<JointAxis>; MOST_AXES] = [None; MOST_AXES];
        let mut here_in_mount = self.mount_at_zero().inverse();
        for (rotary, place) in self.table().rev() {
            let line = JointAxis {
                point: rotary.centre,
                direction: -rotary.about.vector(),
            };
            lines[place] = Some(line.moved(&here_in_mount));
            here_in_mount = here_in_mount * rotary.turned(joints[place]).inverse();
        }
        let frame_in_mount = here_in_mount.rotation;
        let [x, y, z, ..] = *joints;
        here_in_mount = here_in_mount
            * Pose {
                rotation: DMat3::IDENTITY,
                position: DVec3::new(x, y, z),
            };
        for (rotary, place) in self.head() {
            let line = JointAxis {
                point: rotary.centre,
                direction: rotary.about.vector(),
            };
            lines[place] = Some(line.moved(&here_in_mount));
            here_in_mount = here_in_mount * rotary.turned(joints[place]);
        }
        let nose_in_mount = here_in_mount * self.nose_at_zero();
        let point = nose_in_mount.rotation * point_in_nose + nose_in_mount.position;
        let mut columns = lines.map(|line| line.map_or(Twist::ZERO, |line| Twist::about(&line, point)));
        for (column, direction) in columns.iter_mut().zip([DVec3::X, DVec3::Y, DVec3::Z]) {
            column.linear = frame_in_mount * direction;
        }
        Jacobian { columns }
    }
}

#[cfg(test)]
mod tests;
