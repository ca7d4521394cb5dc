//! Axis moves at once: each goes straight from its value to the next, all at the same time (PTP, MoveJ).
//!
//! Limits that hold at both ends hold between. The blade's way is not a line, though: its points are computed [`Along`] spans
//! of the move, and a span is proven when one face of the stock has all of them on its outer side.
//! What is between the points is then out there too, since a half space that has the points has their convex hull.

use super::bounds::limits;
use super::chain::{Chain, Point, evenly, moved};
use super::march::{Tried, march};
use crate::rig::Rig;
use glam::DVec3;
use vcutc_geometry::number::{Along, Interval};
use vcutc_machine::kinematics::Joints;

/// By how much a point may be inside of a face, in mm: rounding.
const SLACK: f64 = 1e-6;

/// A box in the workpiece frame W.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Block {
    /// Its least coordinates, in mm.
    pub low: DVec3,
    /// Its greatest coordinates, in mm.
    pub high: DVec3,
}

/// Why an axis move must not be made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AxesBreach {
    /// Where on the move, from 0 to 1.
    pub at: f64,
    /// What breaks there.
    pub what: AxesViolation,
}

/// What breaks in an axis move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AxesViolation {
    /// An axis is outside of its range.
    Limit {
        /// The axis, from 0.
        axis: usize,
        value: f64,
    },
    /// The blade cannot be told to be outside of the stock.
    Stock {
        /// Its lowest point, in W, in mm.
        lowest: DVec3,
    },
}

/// Proves that an axis move keeps within their limits and keeps the blade outside of the stock, which it may touch.
/// `blade` are points in the blade frame T; what is proven to stay out is all that lies between them.
///
/// # Errors
/// The first place where it does not, or where that cannot be proven. A blade is only seen to be outside where all its
/// points are beyond the same face.
pub fn prove_axes(
    rig: &Rig<'_>,
    from: &Joints,
    to: &Joints,
    blade: &[DVec3],
    stock: &Block,
) -> Result<(), AxesBreach> {
    for (at, joints) in [(0.0, from), (1.0, to)] {
        if let Some((axis, value)) = limits(rig.axes, &joints.map(Interval::exactly)) {
            let what = AxesViolation::Limit { axis, value };
            return Err(AxesBreach { at, what });
        }
    }
    let (chain, blade_in_flange) = (Chain::of(rig.mechanism), rig.flange_in_blade.inverse());
    let root_in_work = rig.work_in_root.inverse();
    march(|span, _| {
        let joints = evenly(from, to, span.middle, span.half);
        let points = blade.iter().map(|point| {
            let in_flange = blade_in_flange.rotation * *point + blade_in_flange.position;
            moved(&root_in_work, chain.point_in_root(&joints, in_flange))
        });
        let is_outside = Sides::of(points, stock).any();
        if is_outside {
            Tried::Proven(f64::INFINITY)
        } else {
            Tried::Refused(())
        }
    })
    .map(|_| ())
    .map_err(|(at, ())| AxesBreach {
        at,
        what: AxesViolation::Stock {
            lowest: lowest(rig, from, to, at, blade),
        },
    })
}

/// Parts of a move at whose ends samples are taken.
const PARTS: u32 = 16;

/// How far inside the stock a sample has to be to count, in mm: far more than rounding.
const SURELY: f64 = 1e-3;

/// Whether samples show what [`prove_axes`] would find out about the stock, sooner. Where they do, it does not prove the move; where
/// they do not, nothing is said.
#[must_use]
pub fn are_axes_refuted(rig: &Rig<'_>, from: &Joints, to: &Joints, blade: &[DVec3], stock: &Block) -> bool {
    let inner = Block {
        low: stock.low + DVec3::splat(SURELY),
        high: stock.high - DVec3::splat(SURELY),
    };
    let places = (1..PARTS).map(|part| f64::from(part) / f64::from(PARTS));
    places.into_iter().any(|at| {
        let points = points_at(rig, from, to, at, blade);
        let point = |point: DVec3| point.to_array().map(Along::constant);
        !Sides::of(points.map(point), &inner).any()
    })
}

/// Beyond which faces of a block all points are.
struct Sides {
    below: [bool; 3],
    above: [bool; 3],
}

impl Sides {
    fn of(points: impl Iterator<Item = Point>, block: &Block) -> Self {
        let mut sides = Self {
            below: [true; 3],
            above: [true; 3],
        };
        for point in points {
            for (i, coordinate) in point.map(Along::value).into_iter().enumerate() {
                sides.below[i] &= coordinate.high <= block.low[i] + SLACK;
                sides.above[i] &= coordinate.low >= block.high[i] - SLACK;
            }
        }
        sides
    }

    fn any(&self) -> bool {
        self.below.iter().chain(&self.above).any(|is_beyond| *is_beyond)
    }
}

/// The points of the blade at a place of the move, in W.
fn points_at(
    rig: &Rig<'_>,
    from: &Joints,
    to: &Joints,
    at: f64,
    blade: &[DVec3],
) -> impl Iterator<Item = DVec3> {
    let joints = core::array::from_fn(|i| from[i] + (to[i] - from[i]) * at);
    let blade_in_work = rig.blade_in_work(&joints);
    blade
        .iter()
        .map(move |point| blade_in_work.rotation * *point + blade_in_work.position)
}

fn lowest(rig: &Rig<'_>, from: &Joints, to: &Joints, at: f64, blade: &[DVec3]) -> DVec3 {
    // A blade without points has no lowest one; there is none such.
    points_at(rig, from, to, at, blade)
        .min_by(|a, b| a.z.total_cmp(&b.z))
        .unwrap_or_default()
}
