//! The cuts of a program by blades whose forces are known: what pushes the blade, and how the axes move it.

use crate::blade::{Engaged, EngagedPart, Forms, MilledForces, PushedBlade};
use crate::chain::{Chain, Column, JOINTS};
use crate::condition::Condition;
use crate::peaks::Whole;
use crate::push::{Posture, Push, Sides};
use glam::{DMat3, DVec3};
use std::collections::BTreeMap;
use vcutc_backend_api::geometry::Frame;
use vcutc_backend_api::ir::{Action, Op, OpId, OperationId, Program, Site, ToolId};
use vcutc_backend_api::motion::ReachableProgram;
use vcutc_backend_api::segments::{LinearSegment, Segment};
use vcutc_backend_api::units::{Angle, Force, Length};
use vcutc_geometry::number::{Along, Interval};
use vcutc_job::forces::EdgeParts;
use vcutc_machine::Model;
use vcutc_machine::body::MILLIMETRES;
use vcutc_machine::kinematics::Joints;
use vcutc_machine::kinematics::pose::Pose;
use vcutc_motion::parts::{Motions, Moving};
use vcutc_motion::path::Part;
use vcutc_motion::rigs::Rigs;
use vcutc_simulation::prove::{Compensation, UsedEdge, VNumber};

/// A program and what carries it out.
#[derive(Clone, Copy)]
pub struct Known<'p> {
    pub model: &'p Model,
    pub reached: &'p ReachableProgram,
    pub rigs: &'p Rigs<'p>,
    /// How much of their edges, of their rims, or of the height of their teeth, blades use in cuts, in the program's order.
    pub edges: &'p [UsedEdge],
    /// How far the tips of its operations are offset, operation by operation; none of those that are not compensated.
    pub compensations: &'p [Option<Compensation>],
}

impl<'p> Known<'p> {
    /// How far the tips of an operation are offset; none of one that is not compensated.
    pub(crate) fn compensation(&self, operation: OperationId) -> Option<&'p Compensation> {
        self.compensations.get(usize::from(operation.0))?.as_ref()
    }
}

/// The cuts of a program by blades whose forces are known.
pub struct Cuts<'p> {
    known: Known<'p>,
    chain: Chain,
    /// The tip of each tool in the hand, in m.
    tips: Vec<[f64; 3]>,
    cuts: BTreeMap<OpId, Cut<'p>>,
    others: Others,
}

/// Whether a program has cuts by blades whose forces are not known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Others {
    Some,
    None,
}

/// A cut by a blade whose forces are known.
pub(crate) struct Cut<'p> {
    condition: Condition,
    pub(crate) operation: OperationId,
    /// Of its operation.
    pub(crate) vee: VNumber,
    pub(crate) tool: ToolId,
    moving: Moving<'p>,
    line: OnLine,
    blade: Engaged<'p>,
    /// What pushes it in the middle of its way, and everywhere where neither way nor blade turns.
    push: Push,
}

impl Cut<'_> {
    /// The blade frame in the work where so much of it is done.
    pub(crate) fn frame_at(&self, program: &Program, done: f64) -> Option<Frame> {
        self.line.line.frame_at(program, done)
    }

    /// What it forms of the part.
    pub(crate) const fn forms(&self) -> Forms {
        self.blade.forms()
    }

    /// The controller's axes on a part of it.
    pub(crate) fn axes_on(&self, part: Part) -> Option<[Along; JOINTS]> {
        self.moving.axes_on(part)
    }
}

/// The side of its V that a cut makes, seen looking along +y.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Face {
    /// Its flank rises towards -x.
    Left,
    /// Its flank rises towards +x.
    Right,
    /// None: the blade is upright.
    Upright,
}

/// The largest force on a blade.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LargestForce {
    pub op: OpId,
    pub force: Force,
    pub parts: EdgeParts<Force>,
    /// How much of the blade is in the material, and what of it.
    pub engaged: Length,
    pub part: EngagedPart,
    /// The largest moment about the tip on any blade, in Nm.
    pub moment: f64,
}

/// What happens in a place of a cut, with forces as they are stated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InPlace {
    /// How much of the blade is in the material at most, and what of it.
    pub engaged: Length,
    pub part: EngagedPart,
    /// On the blade, in the work, in N.
    pub force: DVec3,
    /// The moment about its tip, in the work, in Nm; none where it is not known at which places of a rim the force acts.
    pub moment: Option<DVec3>,
    /// What it takes of the axes, in Nm.
    pub torques: [f64; JOINTS],
}

impl<'p> Cuts<'p> {
    /// Of a program with these blades that state their forces, by their names. None of a machine that is not an arm with a closed form.
    #[must_use]
    pub fn of(known: Known<'p>, blades: &BTreeMap<&'p str, PushedBlade<'p>>) -> Option<Self> {
        let program = known.reached.program();
        let chain = Chain::of(&known.model.mechanism)?;
        let tools = program.cell.iter().flat_map(|cell| cell.tools.iter());
        let hands: Vec<Pose> = tools
            .map(|(tool, _)| chain.in_hand(known.rigs.with(tool).flange_in_blade.inverse()))
            .collect();
        let motions = Motions::of(known.reached, known.rigs);
        let (mut cuts, mut others) = (BTreeMap::new(), Others::None);
        let mut milled = MilledForces::default();
        for segment in program.segments() {
            let Some((operation, vee, line)) = cutting(&segment) else {
                continue;
            };
            if line.limited_by().is_none() {
                continue; // Leads nowhere.
            }
            let tool = segment.before.tool;
            let blade = program.blade(tool);
            let blade = blade.and_then(|blade| blades.get(blade.name.as_str()));
            let (Some(blade), Some(hand)) = (blade, hands.get(usize::from(tool.0))) else {
                others = Others::Some;
                continue;
            };
            let on_line = OnLine {
                line,
                blade_in_hand: hand.rotation,
            };
            let moving = motions.moving(segment.id)?;
            let pushed = on_line.posture(program, WHOLE).and_then(|held| {
                let used = used(known.edges, segment.id);
                let blade = milled.blade(*blade, &line, &held, used)?;
                Some((blade, blade.push(&held)?, blade.condition(&held, &line)))
            });
            let Some((blade, push, condition)) = pushed else {
                others = Others::Some;
                continue;
            };
            let cut = Cut {
                condition,
                operation,
                vee,
                tool,
                moving,
                line: on_line,
                blade,
                push,
            };
            cuts.insert(segment.id, cut);
        }
        Some(Self {
            tips: hands.iter().map(|hand| hand.position.to_array()).collect(),
            known,
            chain,
            cuts,
            others,
        })
    }

    pub(crate) const fn known(&self) -> &Known<'p> {
        &self.known
    }

    pub(crate) const fn others(&self) -> Others {
        self.others
    }

    /// A cut; none where an op does not cut, or with a blade of unknown forces.
    pub(crate) fn get(&self, op: OpId) -> Option<&Cut<'p>> {
        self.cuts.get(&op)
    }

    /// Those whose deviation is computed.
    pub(crate) fn wholes(&self) -> impl Iterator<Item = Whole> {
        let deviating = self.cuts.iter().filter(|(_, cut)| cut.forms().has_deviation());
        deviating.map(|(op, cut)| Whole {
            op: *op,
            parts: cut.moving.parts,
        })
    }

    /// Those of an operation whose deviation is computed.
    pub(crate) fn wholes_of(&self, operation: OperationId) -> impl Iterator<Item = Whole> {
        self.wholes()
            .filter(move |whole| self.get(whole.op).is_some_and(|cut| cut.operation == operation))
    }

    /// The cut with the largest force.
    #[must_use]
    pub fn largest_force(&self) -> Option<LargestForce> {
        let each = self.cuts.iter().map(|(op, cut)| {
            let parts = cut.push.largest();
            (*op, cut, parts, cut.push.largest_size())
        });
        let (op, cut, parts, force) = each.reduce(|best, next| if next.3 > best.3 { next } else { best })?;
        Some(LargestForce {
            op,
            force: Force::n(force),
            parts: EdgeParts {
                drag: Force::n(parts.drag),
                axial: Force::n(parts.axial),
                side: Force::n(parts.side),
            },
            engaged: cut.blade.length,
            part: cut.blade.part(),
            moment: self
                .cuts
                .values()
                .map(|cut| cut.push.largest_moment())
                .fold(0.0, f64::max),
        })
    }

    /// Of each blade the cut that differs most from how its forces were measured, where that matters.
    pub(crate) fn elsewhere(&self) -> Vec<(String, OpId, Condition)> {
        let program = self.known.reached.program();
        let mut farthest: BTreeMap<&str, (f64, OpId, Condition)> = BTreeMap::new();
        for (op, cut) in &self.cuts {
            let measured = cut.blade.measured();
            if cut.blade.length == Length::ZERO {
                continue; // Through the air.
            }
            let (Some(blade), Some(off)) = (program.blade(cut.tool), cut.condition.off(measured)) else {
                continue;
            };
            let name = blade.name.as_str();
            if farthest.get(name).is_none_or(|(most, ..)| off > *most) {
                farthest.insert(name, (off, *op, cut.condition));
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
        let cut = self.get(op)?;
        let push = self.push_at(cut, done)?;
        let blade_in_work = self.known.rigs.with(cut.tool).blade_in_work(joints);
        let hand_in_work = blade_in_work.rotation * cut.line.blade_in_hand.transpose();
        let torques = push.stated_torques(&self.columns_at(cut.tool, joints));
        Some(InPlace {
            engaged: cut.blade.length,
            part: cut.blade.part(),
            force: hand_in_work * push.stated(),
            moment: push.stated_moment().map(|moment| hand_in_work * moment),
            torques: torques.map(|torque| -torque),
        })
    }

    /// How far the tip of a cut is offset along the normal of its flank, anywhere on it, in m; none of one that is not compensated.
    pub(crate) fn offset_along_normal(&self, cut: &Cut<'_>) -> Option<Interval> {
        let offset = self.known.compensation(cut.operation)?.offset(cut.vee);
        let offset = DVec3::new(offset.x, 0.0, offset.z) / MILLIMETRES;
        let along = self.normal_in_work(cut)?.dot(offset);
        Some(Interval::around(
            along,
            offset.length() * cut.line.turns().to_rad(),
        ))
    }

    /// The normal of the flank of a cut into the waste, in the work and in the middle of its way; none where its tip stands still.
    pub(crate) fn normal_in_work(&self, cut: &Cut<'_>) -> Option<DVec3> {
        let posture = cut.line.posture(self.known.reached.program(), WHOLE)?;
        let in_blade = posture.blade_in_hand.transpose() * DVec3::from_array(cut.push.normal);
        Some(posture.blade_in_work * in_blade)
    }

    /// The side of its V that a cut makes; none where its tip stands still.
    pub(crate) fn face(&self, cut: &Cut<'_>) -> Option<Face> {
        if cut.push.sides == Sides::Either {
            return Some(Face::Upright);
        }
        let into_waste = self.normal_in_work(cut)?;
        Some(if into_waste.x > 0.0 {
            Face::Left
        } else {
            Face::Right
        })
    }

    /// How the axes move the tip of a tool.
    pub(crate) fn columns_at(&self, tool: ToolId, joints: &Joints) -> [Column<f64>; JOINTS] {
        self.chain.columns(&self.chain.turns(joints), self.tip(tool))
    }

    /// The same along a part of a motion.
    pub(crate) fn columns_on(&self, tool: ToolId, axes: [Along; JOINTS]) -> [Column<Along>; JOINTS] {
        self.chain.columns(&self.chain.turns_along(axes), self.tip(tool))
    }

    /// What pushes the blade where so much of a cut is done.
    pub(crate) fn push_at(&self, cut: &Cut<'_>, done: f64) -> Option<Push> {
        let here = Part {
            middle: done,
            half: 0.0,
        };
        self.push_on(cut, here)
    }

    /// What pushes the blade on a part of a cut.
    pub(crate) fn push_on(&self, cut: &Cut<'_>, part: Part) -> Option<Push> {
        if cut.line.turns() == Angle::ZERO {
            return Some(cut.push);
        }
        let posture = cut.line.posture(self.known.reached.program(), part)?;
        cut.blade.push(&posture)
    }

    fn tip(&self, tool: ToolId) -> [f64; 3] {
        self.tips.get(usize::from(tool.0)).copied().unwrap_or_default()
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
        })
    }
}

/// How far from a place its neighbours are that say which way the tip goes, in parts of the motion.
const NEAR: f64 = 1e-4;

/// The operation, the V and the way of an op that cuts with an edge.
pub(crate) fn cutting(segment: &Segment<'_>) -> Option<(OperationId, VNumber, LinearSegment)> {
    let Op { action, site, .. } = segment.op;
    let (
        Action::Cut { .. } | Action::Follow { .. },
        Site::Cut {
            operation,
            layer,
            cut,
        },
    ) = (action, site)
    else {
        return None;
    };
    Some((*operation, (*layer, *cut), segment.line()?))
}

/// How much of its blade an op uses, where that is measured.
fn used(edges: &[UsedEdge], op: OpId) -> Option<Length> {
    let place = edges.binary_search_by_key(&op, |used| used.op).ok()?;
    Some(edges.get(place)?.length)
}
