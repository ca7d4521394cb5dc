//! Axis moves at once: each goes straight from its value to the next, all at the same time (PTP, MoveJ).
//!
//! Limits that hold at both ends hold between. What the axes carry does not move along lines, though: its points are computed
//! [`Along`] spans of the move, and a span is proven when each solid is on the outer side of one of the stock's faces.
//! What is between points is then out there too, since a half space that has the points has their convex hull. A cylinder reaches
//! beyond the centres of its ends by its radius times the sine of the angle between its axis and the normal of the face.

use super::bounds::limits;
use super::chain::{Chain, Point, evenly, moved};
use super::march::{Tried, march};
use crate::rig::Rig;
use glam::DVec3;
use vcutc_geometry::number::{Along, Interval};
use vcutc_machine::kinematics::Joints;
use vcutc_machine::kinematics::pose::Pose;

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

/// A convex part of what the axes carry, in the blade frame T, in mm.
#[derive(Clone, Debug, PartialEq)]
pub enum Solid {
    /// All that lies between some points; at least one.
    Hull(Vec<DVec3>),
    /// A round one, by the centres of its ends, which are apart, and its radius.
    Cylinder { ends: [DVec3; 2], radius: f64 },
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
    /// One of the solids is in the stock, as samples of it show.
    Stock {
        /// Which one, from 0.
        solid: usize,
        /// Its lowest point, in W, in mm.
        lowest: DVec3,
    },
    /// One of the solids cannot be shown to be outside of the stock: no face has all of it on its outer side.
    Unproven {
        /// Which one, from 0.
        solid: usize,
        /// Its lowest point, in W, in mm.
        lowest: DVec3,
    },
}

/// Proves that an axis move keeps within their limits and keeps some solids outside of the stock, which they may touch.
///
/// # Errors
/// The first place where it does not, or where that cannot be proven. A solid is only seen to be outside where all of it is
/// beyond the same face.
pub fn prove_axes(
    rig: &Rig<'_>,
    from: &Joints,
    to: &Joints,
    solids: &[Solid],
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
        let place = |point: DVec3| {
            let in_flange = blade_in_flange.rotation * point + blade_in_flange.position;
            moved(&root_in_work, chain.point_in_root(&joints, in_flange))
        };
        match solids.iter().position(|solid| !solid.is_outside(stock, place)) {
            None => Tried::Proven(f64::INFINITY),
            Some(inside) => Tried::Refused(inside),
        }
    })
    .map(|_| ())
    .map_err(|(at, number)| {
        let (solid, blade) = (&solids[number], blade_at(rig, from, to, at));
        let lowest = solid.lowest(&blade);
        let what = if solid.is_seen_in(stock, &blade) {
            AxesViolation::Stock {
                solid: number,
                lowest,
            }
        } else {
            AxesViolation::Unproven {
                solid: number,
                lowest,
            }
        };
        AxesBreach { at, what }
    })
}

/// Parts of a move at whose ends samples are taken.
const PARTS: u32 = 16;

/// Parts of a solid at whose ends samples are taken, in each direction.
const SAMPLES: u32 = 32;

/// How far inside the stock a sample has to be to count, in mm: far more than rounding.
const SURELY: f64 = 1e-3;

/// Whether samples show what [`prove_axes`] would find out about the stock, sooner. Where they do, it does not prove the move; where
/// they do not, nothing is said.
#[must_use]
pub fn are_axes_refuted(rig: &Rig<'_>, from: &Joints, to: &Joints, solids: &[Solid], stock: &Block) -> bool {
    let inner = Block {
        low: stock.low + DVec3::splat(SURELY),
        high: stock.high - DVec3::splat(SURELY),
    };
    let places = (1..PARTS).map(|part| f64::from(part) / f64::from(PARTS));
    places.into_iter().any(|at| {
        let blade = blade_at(rig, from, to, at);
        let place = |point: DVec3| in_work(&blade, point).to_array().map(Along::constant);
        solids.iter().any(|solid| !solid.is_outside(&inner, place))
    })
}

impl Solid {
    /// Whether all of it is beyond one face of a block, with its points at these places.
    fn is_outside(&self, block: &Block, place: impl Fn(DVec3) -> Point) -> bool {
        match self {
            Self::Hull(points) => {
                let points = points.iter().map(|&point| place(point).map(Along::value));
                Sides::of(points, block).any()
            }
            Self::Cylinder { ends, radius } => {
                let length = ends[0].distance(ends[1]);
                let [one, other] = ends.map(place);
                let aside: [f64; 3] = core::array::from_fn(|i| {
                    let along = least_magnitude((other[i] - one[i]).value()) / length;
                    radius * (1.0 - along * along).max(0.0).sqrt()
                });
                let rims = [one, other].map(|centre| {
                    core::array::from_fn(|i| {
                        let value = centre[i].value();
                        Interval {
                            low: value.low - aside[i],
                            high: value.high + aside[i],
                        }
                    })
                });
                Sides::of(rims.into_iter(), block).any()
            }
        }
    }

    /// Whether samples of it are in a block where the blade is held like this.
    fn is_seen_in(&self, block: &Block, blade_in_work: &Pose) -> bool {
        let shares = || (0..=SAMPLES).map(|sample| f64::from(sample) / f64::from(SAMPLES));
        let between = |one: DVec3, other: DVec3| {
            shares().any(|share| {
                let place = in_work(blade_in_work, one.lerp(other, share));
                place.cmpgt(block.low).all() && place.cmplt(block.high).all()
            })
        };
        match self {
            Self::Hull(points) => {
                let mut pairs = points.iter().enumerate().flat_map(|(number, one)| {
                    points.iter().skip(number + 1).map(move |other| (*one, *other))
                });
                pairs.any(|(one, other)| between(one, other))
            }
            Self::Cylinder { ends, radius } => {
                let (aside, across) = (ends[1] - ends[0]).normalize_or_zero().any_orthonormal_pair();
                let spokes = shares().map(|share| {
                    let (sine, cosine) = libm::sincos(share * core::f64::consts::TAU);
                    (aside * cosine + across * sine) * *radius
                });
                spokes.into_iter().any(|spoke| {
                    between(ends[0] + spoke, ends[1] + spoke)
                        || ends.iter().any(|&end| between(end, end + spoke))
                })
            }
        }
    }

    /// Its lowest point where the blade is held like this, in W.
    fn lowest(&self, blade_in_work: &Pose) -> DVec3 {
        let points = match self {
            Self::Hull(points) => points.clone(),
            Self::Cylinder { ends, radius } => {
                let up = blade_in_work.rotation.transpose() * DVec3::Z;
                let across = up.reject_from((ends[1] - ends[0]).normalize_or_zero());
                let down = -across.normalize_or_zero() * *radius;
                ends.map(|end| end + down).to_vec()
            }
        };
        let places = points.into_iter().map(|point| in_work(blade_in_work, point));
        // None is without points.
        places.min_by(|a, b| a.z.total_cmp(&b.z)).unwrap_or_default()
    }
}

/// The least of the magnitudes of all numbers of an interval.
fn least_magnitude(interval: Interval) -> f64 {
    interval.low.max(-interval.high).max(0.0)
}

/// Beyond which faces of a block all points are.
struct Sides {
    below: [bool; 3],
    above: [bool; 3],
}

impl Sides {
    fn of(points: impl Iterator<Item = [Interval; 3]>, block: &Block) -> Self {
        let mut sides = Self {
            below: [true; 3],
            above: [true; 3],
        };
        for point in points {
            for (i, coordinate) in point.into_iter().enumerate() {
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

/// The blade frame at a place of the move.
fn blade_at(rig: &Rig<'_>, from: &Joints, to: &Joints, at: f64) -> Pose {
    let joints = core::array::from_fn(|i| from[i] + (to[i] - from[i]) * at);
    rig.blade_in_work(&joints)
}

fn in_work(blade_in_work: &Pose, point: DVec3) -> DVec3 {
    blade_in_work.rotation * point + blade_in_work.position
}
