//! The motion of a program, found at its taught poses: the first branch that reaches all of them within the axes' limits.

use crate::job::Machine;
use crate::kinematics::pose::Pose;
use crate::kinematics::{Joints, MOST_BRANCHES};
use crate::reach::rig::Rig;
use vcutc_backend_api::geometry::{Frame, Point3};
use vcutc_backend_api::ir::{Action, AxisValues, MOST_AXES, OpId, OrientationId};
use vcutc_backend_api::motion::{Branch, Motion, ReachableProgram, Stretch};
use vcutc_backend_api::verify::VerifiedProgram;

/// The program with a motion of the machine, if there is one.
pub(super) fn reachable(machine: &Machine, program: &VerifiedProgram) -> Option<ReachableProgram> {
    let rig = Rig::new(&machine.model, machine.tool.value.frame, machine.base.value.frame);
    let home = machine.home.map_or([0.0; MOST_AXES], |home| home.value.0);
    let start = program.ops().find_map(|(id, op)| match op.action {
        Action::AxisTravel { to, orientation } => Some((id, to, orientation)),
        _ => None,
    });
    let blade_in_work = |values: &AxisValues| Frame::from(rig.blade_in_work(&values.0));
    let assemble = |motion| ReachableProgram::assemble(program.clone(), motion, &blade_in_work).ok();
    let Some((from, to, orientation)) = start else {
        return assemble(Motion {
            ends: vec![AxisValues(home); program.program().ops.len()],
            stretches: Vec::new(),
        });
    };
    let first = blade(program, to, orientation);
    let solutions = rig.mechanism.all(&rig.flange_in_root(&first));
    solutions.iter().take(MOST_BRANCHES).find_map(|solution| {
        let branch = solution.branch;
        let ends = ends(&rig, program, branch, home)?;
        let stretches = vec![Stretch { from, branch }];
        assemble(Motion { ends, stretches })
    })
}

fn ends(rig: &Rig<'_>, program: &VerifiedProgram, branch: Branch, home: Joints) -> Option<Vec<AxisValues>> {
    let mut at: Option<(Point3, OrientationId)> = None;
    let mut joints = home;
    let step = |(_, op): (OpId, &vcutc_backend_api::ir::Op)| {
        let next = match (op.action, at) {
            (Action::Home, _) => {
                joints = home;
                None
            }
            (Action::Travel { to, orientation, .. } | Action::AxisTravel { to, orientation }, _) => {
                Some((to, orientation))
            }
            (
                Action::Approach { to, .. } | Action::Retract { to, .. } | Action::Cut { to, .. },
                Some((_, held)),
            ) => Some((to, held)),
            (Action::Turn { to, .. }, Some((tip, _))) => Some((tip, to)),
            (_, at) => at,
        };
        if let (Some((tip, held)), true) = (next, next != at) {
            let flange_in_root = rig.flange_in_root(&blade(program, tip, held));
            joints = rig.mechanism.on_branch(&flange_in_root, branch, &joints)?;
        }
        at = next;
        Some(AxisValues(joints))
    };
    program.ops().map(step).collect()
}

fn blade(program: &VerifiedProgram, origin: Point3, held: OrientationId) -> Pose {
    let orientation = program.orientation(held);
    Pose::from(Frame { origin, orientation })
}
