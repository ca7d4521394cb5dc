//! What motions ask of a machine, and how much it has left: the [`Demand`] and its margin.
//!
//! The **margin** is one number for the whole of a program. It is the smallest of these shares, each 1 where nothing is
//! asked and 0 at the bound:
//!
//! - for each axis, its distance to the nearer limit over half of its range (1 in the middle of the range);
//! - for each kind of singular pose, the distance from it over [`FULL`], at most 1.
//!
//! Rates are no part of it: they are kept or not, and a job that keeps them gains nothing from being slower.

use super::axis_range::axis_margin;
use super::path::{Clearance, Proof};
use core::f64::consts::FRAC_PI_2;
use vcutc_backend_api::ir::{Axis, MOST_AXES, OpId};
use vcutc_machine::kinematics::Joints;

/// Distances from singular poses that count as all one could wish for: a hand bent square, an elbow bent square, the wrist a
/// metre away from axis 1.
pub const FULL: Clearance = Clearance {
    wrist: FRAC_PI_2,
    elbow: FRAC_PI_2,
    shoulder: 1000.0,
};

/// A largest or smallest value, and the op that has it first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extreme {
    pub value: f64,
    pub op: OpId,
}

impl Extreme {
    const fn smaller(self, other: Self) -> Self {
        if other.value < self.value { other } else { self }
    }

    const fn larger(self, other: Self) -> Self {
        if other.value > self.value { other } else { self }
    }
}

/// What a stretch of a program asks of a machine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Demand {
    /// The lowest value of each axis.
    pub low: [Extreme; MOST_AXES],
    /// The highest value of each axis.
    pub high: [Extreme; MOST_AXES],
    /// The highest rate of each axis.
    pub rate: [Extreme; MOST_AXES],
    /// The least distances from singular poses: wrist (rad), elbow (rad), shoulder (mm).
    pub clearance: [Extreme; 3],
    /// How many times the inverse kinematics was solved.
    pub solves: u64,
}

impl Demand {
    /// Of standing still.
    #[must_use]
    pub fn standing(op: OpId, joints: &Joints) -> Self {
        let at = joints.map(|value| Extreme { value, op });
        let none = |value| Extreme { value, op };
        Self {
            low: at,
            high: at,
            rate: [none(0.0); MOST_AXES],
            clearance: [none(f64::INFINITY); 3],
            solves: 0,
        }
    }

    /// Of a motion.
    #[must_use]
    pub fn of(op: OpId, proof: &Proof) -> Self {
        let of = |values: Joints| values.map(|value| Extreme { value, op });
        let Clearance {
            wrist,
            elbow,
            shoulder,
        } = proof.clearance;
        Self {
            low: of(proof.low),
            high: of(proof.high),
            rate: of(proof.rate),
            clearance: [wrist, elbow, shoulder].map(|value| Extreme { value, op }),
            solves: u64::from(proof.solves),
        }
    }

    /// Of this and what follows it.
    #[must_use]
    pub fn and(&self, next: &Self) -> Self {
        let each =
            |a: &[Extreme; MOST_AXES], b: &[Extreme; MOST_AXES], of: fn(Extreme, Extreme) -> Extreme| {
                core::array::from_fn(|axis| of(a[axis], b[axis]))
            };
        Self {
            low: each(&self.low, &next.low, Extreme::smaller),
            high: each(&self.high, &next.high, Extreme::larger),
            rate: each(&self.rate, &next.rate, Extreme::larger),
            clearance: core::array::from_fn(|kind| self.clearance[kind].smaller(next.clearance[kind])),
            solves: self.solves + next.solves,
        }
    }

    /// The same with the axes moved on by these angles.
    #[must_use]
    pub fn turned(&self, by: &Joints) -> Self {
        let turned = |extremes: &[Extreme; MOST_AXES]| {
            core::array::from_fn(|axis| Extreme {
                value: extremes[axis].value + by[axis],
                ..extremes[axis]
            })
        };
        Self {
            low: turned(&self.low),
            high: turned(&self.high),
            ..*self
        }
    }

    /// The margin: what the machine has left, as a share; below 0 where an axis leaves its range.
    #[must_use]
    pub fn margin(&self, axes: &[Axis]) -> f64 {
        let axes = axes
            .iter()
            .enumerate()
            .take(MOST_AXES)
            .map(|(index, axis)| axis_margin(axis, self.low[index].value, self.high[index].value));
        axes.chain(self.singular_shares()).fold(1.0, f64::min)
    }

    /// The distances from singular poses as shares of [`FULL`].
    #[must_use]
    pub fn singular_shares(&self) -> [f64; 3] {
        let full = [FULL.wrist, FULL.elbow, FULL.shoulder];
        core::array::from_fn(|kind| (self.clearance[kind].value / full[kind]).min(1.0))
    }
}
