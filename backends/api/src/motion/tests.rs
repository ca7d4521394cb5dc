//! Each promise of a motion broken once.

use super::{Branch, Motion, MotionFault, MotionRule, ReachableProgram, Stretch, Wrist};
use crate::geometry::Frame;
use crate::ir::{Action, AxisValues, Changer, OpId, Program, ToolId};
use crate::testkit::{Crossing, Recipe, blade_in_work, reachable, two_blades};
use crate::verify::{VerifiedProgram, verify};

fn program() -> VerifiedProgram {
    let recipe = Recipe {
        operations: 2,
        crossing: Crossing::ByAxes,
        ..Recipe::default()
    };
    verify(recipe.program()).unwrap()
}

/// What a motion that was changed is blamed for.
fn blamed(change: impl FnOnce(&Program, &mut Motion)) -> Vec<(Option<u32>, MotionRule)> {
    let program = program();
    let mut motion = reachable(program.clone()).unwrap().motion().clone();
    change(program.program(), &mut motion);
    let faults = ReachableProgram::assemble(program, motion, &|_, axes| blade_in_work(axes)).err();
    let blame = |fault: MotionFault| (fault.op.map(|op| op.0), fault.what);
    faults.unwrap_or_default().into_iter().map(blame).collect()
}

fn place(program: &Program, wanted: fn(&Action) -> bool) -> u32 {
    let place = program.ops.iter().rposition(|op| wanted(&op.action)).unwrap();
    u32::try_from(place).unwrap()
}

fn is_axis_travel(action: &Action) -> bool {
    matches!(action, Action::AxisTravel { .. })
}

fn is_cut(action: &Action) -> bool {
    matches!(action, Action::Cut { .. })
}

#[test]
fn a_motion_that_keeps_its_promises() {
    assert_eq!(blamed(|_, _| {}), []);
}

#[test]
fn a_program_without_a_machine() {
    let mut plain = program().program().clone();
    plain.cell = None;
    plain.ops.clear();
    let motion = Motion {
        ends: Vec::new(),
        stretches: Vec::new(),
        waypoints: Vec::new(),
    };
    let faults = ReachableProgram::assemble(verify(plain).unwrap(), motion, &|_, axes| blade_in_work(axes))
        .unwrap_err();
    let fault = MotionFault {
        op: None,
        what: MotionRule::Machine,
    };
    assert_eq!(faults, [fault]);
}

#[test]
fn an_op_without_axis_values() {
    let complete = [(None, MotionRule::Complete)];
    assert_eq!(blamed(|_, motion| motion.ends.truncate(7)), complete);
    assert_eq!(
        blamed(|_, motion| motion.ends.push(AxisValues([0.0; 6]))),
        complete
    );
}

#[test]
fn axis_values_that_are_not_numbers() {
    for value in [f64::NAN, f64::INFINITY] {
        let blamed = blamed(|_, motion| motion.ends[5].0[2] = value);
        assert_eq!(blamed, [(Some(5), MotionRule::Complete)]);
    }
}

#[test]
fn values_of_axes_that_the_machine_has_not() {
    let mut smaller = program().program().clone();
    let cell = smaller.cell.as_mut().unwrap();
    cell.axes.truncate(5);
    let home = cell.home.unwrap();
    smaller.ops.truncate(1);
    let assembled = |values: AxisValues| {
        let mut smaller = smaller.clone();
        smaller.cell.as_mut().unwrap().home = Some(values);
        let motion = Motion {
            ends: vec![values],
            stretches: Vec::new(),
            waypoints: Vec::new(),
        };
        ReachableProgram::assemble(verify(smaller).unwrap(), motion, &|_, axes| blade_in_work(axes)).is_ok()
    };
    let [a, b, c, d, e, _] = home.0;
    assert!(assembled(AxisValues([a, b, c, d, e, 0.0])));
    assert!(!assembled(AxisValues([a, b, c, d, e, 0.1])));
}

#[test]
fn an_axis_beyond_its_limit() {
    let mut program = program().program().clone();
    let home = program.cell.as_ref().unwrap().home.unwrap();
    let axis = &mut program.cell.as_mut().unwrap().axes[1];
    // Home stands right on the limit, and rounding does not count.
    axis.min = home.0[1] + 1e-12;
    axis.max = 10.0;
    let verified = verify(program.clone()).unwrap();
    assert!(reachable(verified).is_ok());
    program.cell.as_mut().unwrap().axes[1].min = home.0[1] + 1e-6;
    let faults = reachable(verify(program.clone()).unwrap()).unwrap_err();
    let last = u32::try_from(program.ops.len()).unwrap() - 1;
    let expected = [0, last].map(|op| MotionFault {
        op: Some(OpId(op)),
        what: MotionRule::Limits,
    });
    assert_eq!(faults, expected);
}

#[test]
fn axes_that_hold_the_blade_elsewhere() {
    let mut cut = 0;
    for (axis, wrong, right) in [(0, 2e-12, 0.5e-12), (4, 2e-7, 0.5e-7), (5, 2e-7, 0.5e-7)] {
        let mut shifted = |by: f64| {
            blamed(|program, motion| {
                cut = place(program, is_cut);
                motion.ends[cut as usize].0[axis] += by;
            })
        };
        assert_eq!(shifted(right), [], "axis {axis}");
        let blamed = shifted(wrong);
        assert_eq!(blamed, [(Some(cut), MotionRule::Pose)], "axis {axis}");
    }
}

#[test]
fn a_home_that_is_not_home() {
    let blamed = blamed(|_, motion| motion.ends[0].0[3] += 1e-6);
    assert_eq!(blamed, [(Some(0), MotionRule::Pose)]);
}

#[test]
fn axes_that_move_while_a_signal_is_switched() {
    let mut on = 0;
    let blamed = blamed(|program, motion| {
        on = place(program, |action| matches!(action, Action::AwaitReady));
        // Where it would be right: the same pose on another turn of axis 4.
        motion.ends[on as usize].0[3] += core::f64::consts::TAU;
    });
    // It is not where it was, and the move after it is: only one op moves the axes without being one that may.
    assert_eq!(blamed, [(Some(on), MotionRule::Still)]);
}

#[test]
fn branches_that_are_not_known() {
    let stretches = |change: fn(&mut Vec<Stretch>)| blamed(|_, motion| change(&mut motion.stretches));
    let fault = |op| [(Some(op), MotionRule::Stretches)];
    assert_eq!(stretches(Vec::clear), fault(1));
    assert_eq!(stretches(|stretches| stretches[0].from = OpId(2)), fault(2));
    assert_eq!(stretches(|stretches| stretches[0].from = OpId(0)), fault(0));
}

#[test]
fn branches_that_change_where_they_may_not() {
    let fault = |op| [(Some(op), MotionRule::Stretches)];
    let second = place(program().program(), is_axis_travel);
    let moved = |by: i32| {
        blamed(|_, motion| {
            let from = &mut motion.stretches[1].from;
            *from = OpId(from.0.saturating_add_signed(by));
        })
    };
    assert_eq!(moved(0), []);
    for by in [-1, 1] {
        assert_eq!(moved(by), fault(second.saturating_add_signed(by)));
    }
    assert_eq!(moved(i32::MAX), fault(second.saturating_add_signed(i32::MAX)));
    let out_of_order = blamed(|_, motion| {
        let again = motion.stretches[1];
        motion.stretches.push(again);
    });
    assert_eq!(out_of_order, fault(second));
}

#[test]
fn what_an_op_ends_with_can_be_asked_for() {
    let program = reachable(program()).unwrap();
    let wrist = |op| match program.branch_after(OpId(op))? {
        Branch::Arm { wrist, .. } => Some(wrist),
        Branch::Numbered(_) => None,
    };
    let second = place(program.program(), is_axis_travel);
    assert_eq!(wrist(0), None);
    assert_eq!(wrist(1), Some(Wrist::Positive));
    assert_eq!(wrist(second - 1), Some(Wrist::Positive));
    assert_eq!(wrist(second), Some(Wrist::Negative));
    assert_eq!(wrist(u32::MAX), Some(Wrist::Negative));
    assert_eq!(
        program.axes_after(OpId(0)),
        program.program().cell.as_ref().unwrap().home
    );
    assert_eq!(program.axes_after(OpId(u32::MAX)), None);
}

/// The blade of the pretend machine is where its axes say, whatever they are.
#[test]
fn the_pretend_machine_has_no_blind_spot() {
    let Frame { origin, .. } = blade_in_work(&AxisValues([1e-3, -2e-3, 3e-3, 0.0, 0.0, 0.0]));
    let near = |a: f64, b: f64| (a - b).abs() < 1e-9;
    assert!(near(origin.x, 1000.0) && near(origin.y, -2000.0) && near(origin.z, 3000.0));
}

#[test]
fn the_machine_is_given_with_the_blade_at_hand() {
    let recipe = Recipe {
        operations: 2,
        ..Recipe::default()
    };
    let verified = verify(two_blades(recipe.program(), Changer::Hand)).unwrap();
    let motion = reachable(verified.clone()).unwrap().motion().clone();
    let is_change = |action: Action| matches!(action, Action::ToolChange { .. });
    let change = verified.program().ops.iter().position(|op| is_change(op.action));
    let change = OpId(u32::try_from(change.unwrap()).unwrap());
    let seen = std::cell::RefCell::new(Vec::new());
    let assembled = ReachableProgram::assemble(verified, motion, &|tool, axes| {
        seen.borrow_mut().push(tool);
        blade_in_work(axes)
    });
    let assembled = assembled.unwrap();
    let posed = |after: bool| {
        let segments = assembled.program().segments();
        let of_part = segments.filter(|segment| (segment.id > change) == after);
        of_part.filter(|segment| segment.target().is_some()).count()
    };
    let seen = seen.into_inner();
    let second = seen.iter().filter(|tool| **tool == ToolId(1)).count();
    assert_eq!((seen.len() - second, second), (posed(false), posed(true)));
}
