//! How far the forces of a blade push its cuts off: the deviation of the motion that forms the part.
//!
//! A force on the blade is a torque about every axis, by which the joint yields as a spring (a control holds the motor in its
//! place): the tool shifts by `J K^-1 J^T w` [Ha 2019, equations 30 and 31, with the sign of a force that acts on the tool]. Only the
//! shift along the normal of the flank forms the part.

pub mod compensation;
pub mod each;
pub mod figures;
pub mod moved_base;
pub mod verdict;

use crate::arms::Arms;
use crate::blade::Forms;
use crate::chain::{Column, JOINTS};
use crate::cuts::{Cut, Cuts};
use crate::peaks::{Held, Peak, Sought, Whole, peaks};
use crate::push::{Push, Shift, Sides};
use crate::springs::Springs;
use vcutc_backend_api::ir::{OpId, OperationId};
use vcutc_backend_api::units::Length;
use vcutc_geometry::number::{Along, Interval};
use vcutc_machine::kinematics::Joints;
use vcutc_motion::path::Part;

/// Deviations below this do not matter, in m: a tenth of a micrometre, less than programs print.
const LEAST: f64 = 1e-7;

/// Why deviations are not known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unknown {
    /// A blade of the job does not state its forces.
    Forces,
    /// The machine's description does not say how its joints yield.
    Elasticity,
    /// The weight of the arm counts, and its masses or the load on its flange are not known.
    Weight,
    /// The machine is not an arm with a closed form.
    ClosedForm,
    /// A disc forms the part, and the deviation of that is not computed.
    Disc,
}

/// Ways in which an edge shifts in the middle of a part of a cut, and everywhere on it.
type Shifts<const N: usize> = fn(&Push, &[Column<Along>; JOINTS], &Springs) -> [[Interval; 2]; N];

/// The cuts of a program by blades whose forces are known, on an arm whose joints yield.
pub struct Deviations<'c> {
    cuts: &'c Cuts<'c>,
    springs: Springs,
    /// The arm with each tool, where its masses are known.
    arms: Option<&'c Arms>,
}

/// The most that cuts deviate one way, and where.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extreme {
    pub most: Length,
    pub op: OpId,
    /// The axis that yields most there, and its share.
    pub softest: (usize, f64),
}

/// How far cuts deviate at most.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extremes {
    /// Into the waste: material stays.
    pub into_waste: Extreme,
    /// Into the part.
    pub into_part: Extreme,
}

/// How far the cuts of an operation are off at most.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Once the arm has come to rest against the force.
    pub at_rest: Extremes,
    /// While the edge comes into the material from rest and the arm swings, wherever on a cut that is; whatever its masses and its damping
    /// are. None where that is not known.
    pub at_entry: Option<Extremes>,
}

impl<'c> Deviations<'c> {
    /// Of these cuts, by an arm that weighs so, where that is known. None where the machine's description does not say how its joints
    /// yield.
    #[must_use]
    pub fn of(cuts: &'c Cuts<'c>, arms: Option<&'c Arms>) -> Option<Self> {
        let springs = Springs::from(cuts.known().model.elasticity.as_ref()?);
        Some(Self { cuts, springs, arms })
    }

    /// Whether the deviation of any cut is computed.
    #[must_use]
    pub fn have_cuts(&self) -> bool {
        self.cuts.wholes().next().is_some()
    }

    /// How far the cuts of an operation are off at most; none of one that no forces are known of. `limit` is to be kept.
    ///
    /// Of a compensated operation the bounds at rest are meant under load: while all of the edge that a cut uses is in the material.
    #[must_use]
    pub fn bounds(&self, operation: OperationId, limit: Option<Length>) -> Option<Bounds> {
        let cuts: Vec<Whole> = self.cuts.wholes_of(operation).collect();
        let at_rest = Sought {
            least: LEAST,
            limit: limit.map(Length::to_m),
        };
        if self.are_milled(&cuts) {
            return self.bounds_of_walls(&cuts, at_rest);
        }
        let at_entry = Sought {
            limit: None,
            ..at_rest
        };
        let shifts = match self.cuts.known().compensation(operation) {
            Some(_) => Push::loaded_and_entering,
            None => Push::shifts_and_entering,
        };
        let sought = [at_rest, at_rest, at_entry, at_entry];
        let [waste, part, entry_waste, entry_part] = peaks(&cuts, &sought, |op, part| {
            let [[waste, part], [entry_waste, entry_part]] = self.shifts(op, part, shifts)?.map(held);
            Some([waste, part, entry_waste, entry_part])
        })?;
        Some(Bounds {
            at_rest: self.extremes([waste, part])?,
            at_entry: self.extremes([entry_waste, entry_part]),
        })
    }

    /// The same of walls beside teeth. Their force changes with every tooth, so no arm comes to rest against it: how far it swings
    /// depends on its damping, and nothing is stated of it.
    fn bounds_of_walls(&self, cuts: &[Whole], sought: Sought) -> Option<Bounds> {
        let most = peaks(cuts, &[sought; 2], |op, part| {
            let [shifts] = self.shifts(op, part, |push, columns, springs| [push.shifts(columns, springs)])?;
            Some(held(shifts))
        })?;
        Some(Bounds {
            at_rest: self.extremes(most)?,
            at_entry: None,
        })
    }

    /// Whether teeth make some of these cuts.
    fn are_milled(&self, cuts: &[Whole]) -> bool {
        let forms = |whole: &Whole| self.cuts.get(whole.op).map(Cut::forms);
        cuts.iter().any(|whole| forms(whole) == Some(Forms::Wall))
    }

    /// None where they are not known.
    fn extremes(&self, [waste, part]: [Peak; 2]) -> Option<Extremes> {
        (waste.most.is_finite() && part.most.is_finite()).then(|| Extremes {
            into_waste: self.extreme(&waste),
            into_part: self.extreme(&part),
        })
    }

    /// By how much the weight of the arm shifts the flanks of these cuts along their normals: from where to where, in mm. None where
    /// the masses are not known.
    #[must_use]
    pub fn sag(&self) -> Option<Interval> {
        let arms = self.arms?;
        let cuts: Vec<Whole> = self.cuts.wholes().collect();
        let sought = Sought {
            least: LEAST,
            limit: None,
        };
        let [high, low] = peaks(&cuts, &[sought; 2], |op, part| {
            let [middle, everywhere] = self.sagging(arms, op, part)?;
            Some([
                Held {
                    met: middle.high,
                    most: everywhere.high,
                },
                Held {
                    met: -middle.low,
                    most: -everywhere.low,
                },
            ])
        })?;
        (high.most.is_finite() && low.most.is_finite()).then_some(Interval {
            low: -low.most * 1000.0,
            high: high.most * 1000.0,
        })
    }

    /// How far an edge is off along the normal of its flank where so much of an op is done and the axes have these values, in mm, with
    /// forces and joints as they are stated: positive into the waste. None where it does not cut, and under a disc.
    #[must_use]
    pub fn in_place(&self, op: OpId, done: f64, joints: &Joints) -> Option<Shift> {
        let cut = self.cuts.get(op).filter(|cut| cut.forms().has_deviation())?;
        let push = self.cuts.push_at(cut, done)?;
        let shares = push.shares(&self.cuts.columns_at(cut.tool, joints), &self.springs);
        let offset = self.cuts.offset_along_normal(cut).map_or(0.0, Interval::middle);
        Some(Shift {
            tip: 1000.0 * (shares.iter().map(|share| share.tip).sum::<f64>() + offset),
            end: 1000.0 * (shares.iter().map(|share| share.end).sum::<f64>() + offset),
        })
    }

    /// How far an edge is off at most either way in that place, with forces and joints anywhere within what is stated.
    fn most_in_place(&self, op: OpId, done: f64, joints: &Joints) -> Option<Length> {
        let cut = self.cuts.get(op)?;
        let push = self.cuts.push_at(cut, done)?;
        let columns = self.cuts.columns_on(cut.tool, joints.map(Along::constant));
        let [here, _] = push.shifts(&columns, &self.springs);
        let offset = self.cuts.offset_along_normal(cut).unwrap_or(Interval::ZERO);
        let Ways {
            into_waste,
            into_part,
        } = Ways::of(here + offset, push.sides);
        Some(Length::m(into_waste.max(into_part)))
    }

    /// How far the edge of a cut is off in the middle of a part, and everywhere on it. None where it is too long to say.
    fn shifts<const N: usize>(&self, op: OpId, part: Part, shifts: Shifts<N>) -> Option<[[Ways; 2]; N]> {
        let cut = self.cuts.get(op)?;
        let push = self.cuts.push_on(cut, part)?;
        let columns = self.cuts.columns_on(cut.tool, cut.axes_on(part)?);
        let found = shifts(&push, &columns, &self.springs);
        let offset = self.cuts.offset_along_normal(cut).unwrap_or(Interval::ZERO);
        Some(found.map(|views| views.map(|shifts| Ways::of(shifts + offset, push.sides))))
    }

    fn extreme(&self, peak: &Peak) -> Extreme {
        Extreme {
            most: Length::m(peak.most.max(0.0)),
            op: peak.op,
            softest: self.softest(peak.op, peak.part).unwrap_or((0, 0.0)),
        }
    }

    /// The axis that yields most in the middle of a part, and its share.
    fn softest(&self, op: OpId, part: Part) -> Option<(usize, f64)> {
        let cut = self.cuts.get(op)?;
        let axes = cut.axes_on(part)?.map(|axis| axis.middle().middle());
        let columns = self.cuts.columns_at(cut.tool, &axes);
        let shares = self.cuts.push_on(cut, part)?.shares(&columns, &self.springs);
        Some(Springs::softest(shares.map(|share| share.tip)))
    }

    /// By how much the weight of the arm shifts the edge of a cut along the normal: in the middle of a part, and everywhere on it.
    fn sagging(&self, arms: &Arms, op: OpId, part: Part) -> Option<[Interval; 2]> {
        let cut = self.cuts.get(op)?;
        let (arm, axes) = (arms.with(cut.tool)?, cut.axes_on(part)?);
        // What the motors hold up pulls the links down.
        let weights = arm.weight_after(&arm.turns_along(axes)).map(|weight| -weight);
        let push = self.cuts.push_on(cut, part)?;
        let columns = self.cuts.columns_on(cut.tool, axes);
        Some(push.shifts_by(&weights, &columns, &self.springs))
    }
}

/// The most either way, in the middle of a part and everywhere on it.
fn held([middle, everywhere]: [Ways; 2]) -> [Held; 2] {
    let ways: [fn(Ways) -> f64; 2] = [|ways| ways.into_waste, |ways| ways.into_part];
    ways.map(|bound| Held {
        met: bound(middle),
        most: bound(everywhere),
    })
}

/// How far an edge is off either way, in m.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Ways {
    into_waste: f64,
    into_part: f64,
}

impl Ways {
    fn of(shifts: Interval, sides: Sides) -> Self {
        match sides {
            Sides::Known => Self {
                into_waste: shifts.high,
                into_part: -shifts.low,
            },
            Sides::Either => Self {
                into_waste: shifts.magnitude(),
                into_part: shifts.magnitude(),
            },
        }
    }
}
