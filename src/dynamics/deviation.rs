//! How far the forces of a blade push its cuts off: the deviation of the motion that forms the part.
//!
//! A force on the blade is a torque about every axis, by which the joint yields as a spring (a control holds the motor in its
//! place): the tool shifts by `J K^-1 J^T w` [Ha 2019, equations 30 and 31, with the sign of a force that acts on the tool]. Only the
//! shift along the normal of the flank forms the part.

pub mod figures;
pub mod verdict;

use crate::arm::Arm;
use crate::chain::{Chain, Column, JOINTS};
use crate::peaks::{Held, Peak, Sought, Whole, peaks};
use crate::push::{Posture, Push, Shift, Sides};
use crate::springs::Springs;
use glam::{DMat3, DVec3};
use std::collections::BTreeMap;
use vcutc_backend_api::ir::{Action, Blade, Op, OpId, OperationId, Program, Registered, Site, ToolId};
use vcutc_backend_api::motion::ReachableProgram;
use vcutc_backend_api::segments::{LinearSegment, Segment};
use vcutc_backend_api::units::{Angle, Force, Length};
use vcutc_geometry::number::Interval;
use vcutc_job::forces::{Forces, Measured, Parts};
use vcutc_machine::Model;
use vcutc_machine::kinematics::Joints;
use vcutc_machine::kinematics::pose::Pose;
use vcutc_motion::parts::Motions;
use vcutc_motion::path::Part;
use vcutc_motion::rigs::Rigs;
use vcutc_simulation::prove::UsedEdge;

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
}

/// What is known of a program for its deviations.
#[derive(Clone, Copy)]
pub struct Known<'p> {
    pub model: &'p Model,
    pub reached: &'p ReachableProgram,
    pub rigs: &'p Rigs<'p>,
    /// How much edge cuts use, in the program's order.
    pub edges: &'p [UsedEdge],
}

/// The cuts of a program by blades whose forces are known, on an arm whose joints yield.
pub struct Deviations<'p> {
    known: Known<'p>,
    motions: Motions<'p>,
    chain: Chain,
    springs: Springs,
    /// The tip of each tool in the hand, in m.
    tips: Vec<[f64; 3]>,
    /// The arm with each tool, where its masses are known.
    arms: Option<Vec<Arm>>,
    cuts: BTreeMap<OpId, Pushed<'p>>,
}

/// How a blade cuts, as far as its forces depend on it.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Condition {
    /// In mm/s.
    #[serde(serialize_with = "figures::hundredths")]
    pub feed: f64,
    /// In deg.
    #[serde(serialize_with = "figures::hundredths")]
    pub rake: f64,
    /// In deg.
    #[serde(serialize_with = "figures::hundredths")]
    pub swing: f64,
}

impl Condition {
    /// How forces were measured.
    #[must_use]
    pub fn of(measured: &Measured) -> Self {
        Self {
            feed: measured.feed.value.to_mm_per_s(),
            rake: measured.rake.value.to_deg(),
            swing: measured.swing.value.to_deg(),
        }
    }

    fn in_cut(posture: &Posture, line: &LinearSegment) -> Self {
        let [shank, normal] = [-posture.blade_in_work.z_axis, posture.blade_in_work.y_axis];
        Self {
            feed: line.length().to_mm() / line.duration().to_s(),
            rake: libm::acos(shank.dot(posture.way).abs().min(1.0)).to_degrees(),
            swing: libm::asin(normal.z.abs().min(1.0)).to_degrees(),
        }
    }

    /// How far it is from another, in what does not matter.
    fn off(self, other: Self) -> f64 {
        let feed = (self.feed / other.feed - 1.0).abs() / SAME_FEED;
        let rake = (self.rake - other.rake).abs() / SAME_ANGLE;
        feed.max(rake).max((self.swing - other.swing).abs() / SAME_ANGLE)
    }
}

/// By which share of itself a feed may differ.
const SAME_FEED: f64 = 0.1;
/// What that may be off by in the program.
const ROUNDING: f64 = 1e-6;
/// By how much angles may differ, in deg.
const SAME_ANGLE: f64 = 5.0;

/// A cut by a blade that is pushed.
#[derive(Clone, Copy, Debug)]
struct Pushed<'p> {
    condition: Condition,
    operation: OperationId,
    tool: ToolId,
    parts: u32,
    cut: OnLine,
    forces: &'p Forces,
    /// What pushes it in the middle of its way, and everywhere where neither way nor blade turns.
    push: Push,
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

/// The largest force on a blade.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LargestForce {
    pub op: OpId,
    pub force: Force,
    pub parts: Parts<Force>,
    pub edge: Length,
}

/// What happens in a place of a cut, with forces and joints as they are stated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InPlace {
    pub edge: Length,
    /// On the blade, in the work, in N.
    pub force: DVec3,
    /// What it takes of the axes, in Nm.
    pub torques: [f64; JOINTS],
    /// Along the normal of the flank, in mm: positive into the waste.
    pub shift: Shift,
}

impl<'p> Deviations<'p> {
    /// Of a program whose blades have these forces, by their names.
    ///
    /// # Errors
    /// Why they are not known.
    pub fn of(known: Known<'p>, forces: &BTreeMap<&'p str, &'p Forces>) -> Result<Self, Unknown> {
        let program = known.reached.program();
        if forces.is_empty() {
            return Err(Unknown::Forces);
        }
        let chain = Chain::of(&known.model.mechanism).ok_or(Unknown::ClosedForm)?;
        let springs = known.model.elasticity.as_ref().ok_or(Unknown::Elasticity)?;
        let tools = program.cell.iter().flat_map(|cell| cell.tools.iter());
        let hands: Vec<Pose> = tools
            .map(|(tool, _)| chain.in_hand(known.rigs.with(tool).flange_in_blade.inverse()))
            .collect();
        let motions = Motions::of(known.reached, known.rigs);
        let mut cuts = BTreeMap::new();
        for segment in program.segments() {
            let Some((operation, line)) = cutting(&segment) else {
                continue;
            };
            let tool = segment.before.tool;
            let blade = program.blade(tool);
            let forces = blade.and_then(|blade| forces.get(blade.name.as_str()));
            let straight = blade.and_then(Blade::straight);
            let (Some(forces), Some(blade), Some(hand)) = (forces, straight, hands.get(usize::from(tool.0)))
            else {
                continue;
            };
            // Where it is not measured, all of the edge may be in the material.
            let edge = used(known.edges, segment.id)
                .map_or(blade.cutting_length, |used| used.min(blade.cutting_length));
            let cut = OnLine {
                line,
                half_apex: blade.half_apex,
                edge,
                blade_in_hand: hand.rotation,
            };
            let posture = cut.posture(program, WHOLE);
            let parts = motions.moving(segment.id).ok_or(Unknown::ClosedForm)?.parts;
            cuts.extend(posture.map(|posture| {
                let pushed = Pushed {
                    condition: Condition::in_cut(&posture, &line),
                    operation,
                    tool,
                    parts,
                    cut,
                    forces,
                    push: Push::new(forces, &posture),
                };
                (segment.id, pushed)
            }));
        }
        Ok(Self {
            arms: arms(known.model, program),
            springs: Springs::from(springs),
            tips: hands.iter().map(|hand| hand.position.to_array()).collect(),
            known,
            motions,
            chain,
            cuts,
        })
    }

    /// How far the cuts of an operation deviate at most; none of one that no forces are known of. `limit` is to be kept.
    #[must_use]
    pub fn extremes(&self, operation: OperationId, limit: Option<Length>) -> Option<Extremes> {
        let sought = Sought {
            least: LEAST,
            limit: limit.map(Length::to_m),
        };
        let cuts: Vec<Whole> = self.wholes(operation).collect();
        let [waste, part] = peaks(&cuts, &[sought; 2], |op, part| {
            let pushed = self.cuts.get(&op)?;
            let push = self.push_on(pushed, part)?;
            let [middle, everywhere] = self.shifts(&push, pushed.tool, op, part)?;
            let held = |bound: fn(Interval, Sides) -> f64| Held {
                middle: bound(middle, push.sides),
                most: bound(everywhere, push.sides),
            };
            Some([held(into_waste), held(into_part)])
        })?;
        if !(waste.most.is_finite() && part.most.is_finite()) {
            return None;
        }
        Some(Extremes {
            into_waste: self.extreme(&waste),
            into_part: self.extreme(&part),
        })
    }

    /// By how much the weight of the arm shifts the flanks of these cuts along their normals: from where to where, in mm. None where
    /// the masses are not known.
    #[must_use]
    pub fn sag(&self) -> Option<Interval> {
        self.arms.as_ref()?;
        let cuts: Vec<Whole> = self.cuts.iter().map(|(op, pushed)| whole(*op, pushed)).collect();
        let sought = Sought {
            least: LEAST,
            limit: None,
        };
        let [high, low] = peaks(&cuts, &[sought; 2], |op, part| {
            let [middle, everywhere] = self.sagging(self.cuts.get(&op)?, op, part)?;
            Some([
                Held {
                    middle: middle.high,
                    most: everywhere.high,
                },
                Held {
                    middle: -middle.low,
                    most: -everywhere.low,
                },
            ])
        })?;
        (high.most.is_finite() && low.most.is_finite()).then_some(Interval {
            low: -low.most * 1000.0,
            high: high.most * 1000.0,
        })
    }

    /// The cut with the largest force.
    #[must_use]
    pub fn largest_force(&self) -> Option<LargestForce> {
        let each = self.cuts.iter().map(|(op, pushed)| {
            let parts = pushed.push.largest();
            (*op, pushed.cut.edge, parts, pushed.push.largest_size())
        });
        let (op, edge, parts, force) = each.reduce(|best, next| if next.3 > best.3 { next } else { best })?;
        Some(LargestForce {
            op,
            force: Force::n(force),
            parts: Parts {
                drag: Force::n(parts.drag),
                axial: Force::n(parts.axial),
                side: Force::n(parts.side),
            },
            edge,
        })
    }

    /// Of each blade the cut that differs most from how its forces were measured, where that matters.
    fn elsewhere(&self, forces: &BTreeMap<&str, &Forces>) -> Vec<(String, OpId, Condition)> {
        let program = self.known.reached.program();
        let mut farthest: BTreeMap<&str, (f64, OpId, Condition)> = BTreeMap::new();
        for (op, pushed) in &self.cuts {
            let Some((name, forces)) = program
                .blade(pushed.tool)
                .and_then(|blade| forces.get_key_value(blade.name.as_str()))
            else {
                continue;
            };
            let off = pushed.condition.off(Condition::of(&forces.measured));
            let farther = farthest.get(name).is_none_or(|(most, ..)| off > *most);
            if off > 1.0 + ROUNDING && farther {
                farthest.insert(name, (off, *op, pushed.condition));
            }
        }
        farthest
            .into_iter()
            .map(|(name, (_, op, condition))| (name.to_owned(), op, condition))
            .collect()
    }

    /// What happens where so much of an op is done and the axes have these values; none where it does not cut.
    #[must_use]
    pub fn in_place(&self, op: OpId, done: f64, joints: &Joints) -> Option<InPlace> {
        let pushed = self.cuts.get(&op)?;
        let columns = self.columns_at(pushed.tool, joints);
        let here = Part {
            middle: done,
            half: 0.0,
        };
        let push = self.push_on(pushed, here)?;
        let shares = push.shares(&columns, &self.springs);
        let blade_in_work = self.known.rigs.with(pushed.tool).blade_in_work(joints);
        let hand_in_work = blade_in_work.rotation * pushed.cut.blade_in_hand.transpose();
        Some(InPlace {
            edge: pushed.cut.edge,
            force: hand_in_work * push.stated(),
            torques: push.stated_torques(&columns).map(|torque| -torque),
            shift: Shift {
                tip: 1000.0 * shares.iter().map(|share| share.tip).sum::<f64>(),
                end: 1000.0 * shares.iter().map(|share| share.end).sum::<f64>(),
            },
        })
    }

    fn wholes(&self, operation: OperationId) -> impl Iterator<Item = Whole> {
        let of_it = self
            .cuts
            .iter()
            .filter(move |(_, pushed)| pushed.operation == operation);
        of_it.map(|(op, pushed)| whole(*op, pushed))
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
        let pushed = self.cuts.get(&op)?;
        let axes = self.motions.moving(op)?.axes_on(part)?;
        let columns = self.columns_at(pushed.tool, &axes.map(|axis| axis.middle().middle()));
        let shares = self.push_on(pushed, part)?.shares(&columns, &self.springs);
        Some(Springs::softest(shares.map(|share| share.tip)))
    }

    fn columns_at(&self, tool: ToolId, joints: &Joints) -> [Column<f64>; JOINTS] {
        self.chain.columns(&self.chain.turns(joints), self.tip(tool))
    }

    /// What pushes the blade on a part of a cut.
    fn push_on(&self, pushed: &Pushed<'_>, part: Part) -> Option<Push> {
        if pushed.cut.turns() == Angle::ZERO {
            return Some(pushed.push);
        }
        let posture = pushed.cut.posture(self.known.reached.program(), part)?;
        Some(Push::new(pushed.forces, &posture))
    }

    fn tip(&self, tool: ToolId) -> [f64; 3] {
        self.tips.get(usize::from(tool.0)).copied().unwrap_or_default()
    }

    /// All shifts of the edge of a cut: in the middle of a part, and everywhere on it.
    fn shifts(&self, push: &Push, tool: ToolId, op: OpId, part: Part) -> Option<[Interval; 2]> {
        let axes = self.motions.moving(op)?.axes_on(part)?;
        let turns = self.chain.turns_along(axes);
        let columns = self.chain.columns(&turns, self.tip(tool));
        Some(push.shifts(&columns, &self.springs))
    }

    /// By how much the weight of the arm shifts the edge along the normal.
    fn sagging(&self, pushed: &Pushed<'_>, op: OpId, part: Part) -> Option<[Interval; 2]> {
        let arm = self.arms.as_ref()?.get(usize::from(pushed.tool.0))?;
        let turns = self.chain.turns_along(self.motions.moving(op)?.axes_on(part)?);
        let columns = self.chain.columns(&turns, self.tip(pushed.tool));
        // What the motors hold up pulls the links down.
        let weights = arm.weight_after(&turns).map(|weight| -weight);
        let push = self.push_on(pushed, part)?;
        Some(push.shifts_by(&weights, &columns, &self.springs))
    }
}

/// The whole of a motion.
const WHOLE: Part = Part {
    middle: 0.5,
    half: 0.5,
};

/// A cut along a line or an arc.
#[derive(Clone, Copy, Debug)]
struct OnLine {
    line: LinearSegment,
    half_apex: Angle,
    /// How much edge is in the material at most.
    edge: Length,
    blade_in_hand: DMat3,
}

impl OnLine {
    /// How far the blade and the way of its tip turn.
    fn turns(&self) -> Angle {
        let sweep = self.line.arc().map_or(Angle::ZERO, |arc| arc.sweep());
        self.line.turn + sweep
    }

    /// How the blade is held in the middle of a part; none where its tip stands still.
    fn posture(&self, program: &Program, part: Part) -> Option<Posture> {
        let frame = |done: f64| self.line.frame_at(program, done).map(Pose::from);
        let [before, after] =
            [part.middle - NEAR, part.middle + NEAR].map(|done| frame(done.clamp(0.0, 1.0)));
        Some(Posture {
            blade_in_work: frame(part.middle)?.rotation,
            blade_in_hand: self.blade_in_hand,
            way: (after?.position - before?.position).try_normalize()?,
            turns: self.turns() * part.half,
            half_apex: self.half_apex,
            edge: self.edge,
        })
    }
}

/// How far from a place its neighbours are that say which way the tip goes, in parts of the motion.
const NEAR: f64 = 1e-4;

fn whole(op: OpId, pushed: &Pushed<'_>) -> Whole {
    Whole {
        op,
        parts: pushed.parts,
    }
}

fn into_waste(shifts: Interval, sides: Sides) -> f64 {
    match sides {
        Sides::Known => shifts.high,
        Sides::Either => shifts.magnitude(),
    }
}

fn into_part(shifts: Interval, sides: Sides) -> f64 {
    match sides {
        Sides::Known => -shifts.low,
        Sides::Either => shifts.magnitude(),
    }
}

/// The operation and the way of an op that cuts with an edge.
fn cutting(segment: &Segment<'_>) -> Option<(OperationId, LinearSegment)> {
    let Op { action, site, .. } = segment.op;
    let (Action::Cut { .. } | Action::Follow { .. }, Site::Cut { operation, .. }) = (action, site) else {
        return None;
    };
    Some((*operation, segment.line()?))
}

/// How much edge an op uses, where that is measured.
fn used(edges: &[UsedEdge], op: OpId) -> Option<Length> {
    let place = edges.binary_search_by_key(&op, |used| used.op).ok()?;
    Some(edges.get(place)?.length)
}

/// The arm with each tool; none where masses or loads are not known.
fn arms(model: &Model, program: &Program) -> Option<Vec<Arm>> {
    let tools = program.cell.as_ref()?.tools.iter();
    tools
        .map(|(_, tool)| match tool.load? {
            Registered::Value(load) => Arm::of(model, Some(load)),
            Registered::Number(_) => None,
        })
        .collect()
}
