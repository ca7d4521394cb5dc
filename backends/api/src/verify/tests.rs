//! Each rule about axes and moves of all axes broken once, in a program that is right otherwise.

use super::{Fault, Rule, verify};
use crate::ir::{
    Action, AxisValues, BodyStage, FeedId, Flank, OpId, OrientationId, Program, Purpose, RateId, Shape,
    Switch,
};
use crate::testkit::{Crossing, Passes, Recipe};
use crate::units::{Angle, Length};

/// Two operations with a move of all axes between them.
fn program() -> Program {
    Recipe {
        operations: 2,
        crossing: Crossing::ByAxes,
        ..Recipe::default()
    }
    .program()
}

fn faults(program: Program) -> Vec<Fault> {
    verify(program).err().unwrap_or_default()
}

fn rules(program: Program) -> Vec<Rule> {
    faults(program).into_iter().map(|fault| fault.rule).collect()
}

/// Places of the moves of all axes.
fn axis_travels(program: &Program) -> Vec<usize> {
    let ops = program.ops.iter().enumerate();
    ops.filter(|(_, op)| matches!(op.action, Action::AxisTravel { .. }))
        .map(|(place, _)| place)
        .collect()
}

fn straight(action: Action) -> Action {
    let Action::AxisTravel { to, orientation } = action else {
        panic!("{action:?}")
    };
    Action::Travel {
        to,
        orientation,
        feed: FeedId(0),
        rate: RateId(0),
    }
}

#[test]
fn the_program_is_right() {
    let program = program();
    assert_eq!(axis_travels(&program)[0], 1);
    assert_eq!(axis_travels(&program).len(), 2);
    assert_eq!(faults(program), []);
}

#[test]
fn a_straight_move_from_home_or_from_nowhere() {
    let mut from_home = program();
    from_home.ops[1].action = straight(from_home.ops[1].action);
    let fault = Fault {
        op: Some(OpId(1)),
        rule: Rule::KnownStart,
    };
    assert_eq!(faults(from_home.clone()), [fault]);
    // A machine without a home, and none at all.
    from_home.ops.retain(|op| op.action != Action::Home);
    from_home.cell.as_mut().unwrap().home = None;
    assert_eq!(rules(from_home.clone()), [Rule::KnownStart]);
    from_home.cell = None;
    from_home
        .ops
        .retain(|op| !matches!(op.action, Action::Ultrasonic { .. } | Action::AwaitReady));
    assert_eq!(rules(from_home), [Rule::KnownStart]);
}

#[test]
fn a_move_of_all_axes_that_does_not_begin_at_home() {
    let mut program = program();
    program.ops.remove(0);
    assert_eq!(rules(program.clone()), [Rule::KnownStart]);
    program.cell.as_mut().unwrap().home = None;
    program.ops.pop();
    assert_eq!(faults(program), []);
}

#[test]
fn a_move_of_all_axes_from_or_to_beside_the_stock() {
    let mut program = program();
    let top = program.stock.height.to_mm();
    for place in axis_travels(&program) {
        let kept = program.ops[place].action;
        let Action::AxisTravel { mut to, orientation } = kept else {
            panic!("{kept:?}")
        };
        for (z, expected) in [(top, vec![]), (top - 0.01, vec![Rule::AirMoveThroughStock])] {
            to.z = z;
            program.ops[place].action = Action::AxisTravel { to, orientation };
            assert_eq!(rules(program.clone()), expected, "op {place} to {z}");
        }
        program.ops[place].action = kept;
    }
    // Without the retract before the second one.
    let second = axis_travels(&program)[1];
    let retract = program.ops[..second]
        .iter()
        .rposition(|op| matches!(op.action, Action::Retract { .. }));
    program.ops.remove(retract.unwrap());
    assert_eq!(rules(program), [Rule::AirMoveThroughStock]);
}

#[test]
fn a_move_of_all_axes_to_nowhere() {
    let mut program = program();
    let Action::AxisTravel { mut to, .. } = program.ops[1].action else {
        panic!("no move of all axes");
    };
    let orientation = OrientationId(99);
    program.ops[1].action = Action::AxisTravel { to, orientation };
    assert!(rules(program.clone()).contains(&Rule::TableReference));
    to.x = f64::NAN;
    program.ops[1].action = Action::AxisTravel { to, orientation };
    assert!(rules(program).contains(&Rule::Number));
}

#[test]
fn axes_that_no_machine_has() {
    type Change = fn(&mut Program);
    let changes: [Change; 10] = [
        |program| program.cell.as_mut().unwrap().axes.clear(),
        |program| {
            let axes = &mut program.cell.as_mut().unwrap().axes;
            axes.push(axes[0].clone());
        },
        |program| axis(program).min = f64::NAN,
        |program| axis(program).max = f64::INFINITY,
        |program| axis(program).min = axis(program).max + 1e-9,
        |program| axis(program).rate = Some(0.0),
        |program| axis(program).rate = Some(f64::INFINITY),
        |program| axis(program).rate = Some(-1.0),
        |program| axis(program).acceleration = Some(0.0),
        |program| axis(program).acceleration = Some(f64::NAN),
    ];
    for (case, change) in changes.into_iter().enumerate() {
        let mut program = program();
        change(&mut program);
        assert_eq!(rules(program), [Rule::Axes], "case {case}");
    }
}

#[test]
fn axes_that_a_machine_may_have() {
    let mut program = program();
    axis(&mut program).min = axis(&mut program).max;
    axis(&mut program).rate = None;
    program.cell.as_mut().unwrap().axes.truncate(1);
    assert_eq!(faults(program), []);
}

#[test]
fn a_home_that_is_no_number() {
    let mut program = program();
    program.cell.as_mut().unwrap().home = Some(AxisValues([f64::NAN; 6]));
    assert_eq!(rules(program), [Rule::Number]);
}

/// Stages of a body are round and rise, and there is at least one; a body without any stays in no text.
#[test]
fn bodies_that_no_blade_has() {
    let of = |stages: &[(f64, f64)]| {
        let stages = stages.iter().map(|&(from, radius)| BodyStage {
            from: Length::mm(from),
            radius: Length::mm(radius),
        });
        let mut program = program();
        program.blades[0].body = Some(stages.collect());
        program
    };
    for wrong in [
        &[][..],
        &[(40.0, 0.0)],
        &[(0.0, 8.0)],
        &[(f64::NAN, 8.0)],
        &[(40.0, 8.0), (40.0, 9.0)],
        &[(40.0, 8.0), (30.0, 9.0)],
    ] {
        assert_eq!(rules(of(wrong)), [Rule::Number], "{wrong:?}");
    }
    assert_eq!(faults(of(&[(40.0, 8.0), (90.0, 30.0)])), []);
    let written = serde_json::to_string(&program()).unwrap();
    assert!(!written.contains("body"));
    assert_eq!(serde_json::from_str::<Program>(&written).unwrap(), program());
}

fn axis(program: &mut Program) -> &mut crate::ir::Axis {
    &mut program.cell.as_mut().unwrap().axes[0]
}

/// The program as an air cut, by hand: 500 mm up, the generator off.
fn air_cut() -> Program {
    let mut program = program();
    program.purpose = Purpose::AirCut {
        lift: Length::mm(500.0),
    };
    for op in &mut program.ops {
        match &mut op.action {
            Action::Travel { to, .. }
            | Action::AxisTravel { to, .. }
            | Action::Approach { to, .. }
            | Action::Retract { to, .. }
            | Action::Cut { to, .. } => to.z += 500.0,
            Action::Ultrasonic { state } => *state = Switch::Off,
            _ => {}
        }
    }
    program.ops.retain(|op| op.action != Action::AwaitReady);
    program
}

/// Every flank on a way of its own.
fn one_by_one(swing: f64) -> Program {
    Recipe {
        passes: Passes::Layer,
        swing: Angle::deg(swing),
        ..Recipe::default()
    }
    .program()
}

/// Places of the cuts of one flank.
fn cuts_of(program: &Program, wanted: Flank) -> Vec<usize> {
    let ops = program.ops.iter().enumerate();
    ops.filter(|(_, op)| matches!(op.action, Action::Cut { flank, .. } if flank == wanted))
        .map(|(place, _)| place)
        .collect()
}

#[test]
fn a_flank_of_swing_0_leans_to_no_side() {
    let upright = one_by_one(0.0);
    assert_eq!(faults(upright.clone()), []);
    assert_eq!(faults(one_by_one(1e-3)), []);
    // A lean to the other side is still wrong.
    let mut swapped = one_by_one(1e-3);
    swapped.orientations.swap(0, 2);
    assert!(rules(swapped).iter().all(|&rule| rule == Rule::CutPosture));
    let mut towards = upright;
    for op in &mut towards.ops {
        // Held for the way back.
        if let Action::Travel { orientation, .. } = &mut op.action {
            *orientation = OrientationId(1);
        }
    }
    assert!(rules(towards).contains(&Rule::CutPosture));
}

#[test]
fn a_cut_of_one_flank_is_known_as_such_and_none_has_a_flank_twice() {
    let whole = one_by_one(34.16);
    let lefts = cuts_of(&whole, Flank::Left);
    let verified = verify(whole.clone()).unwrap();
    assert!(verified.ops().all(|(id, _)| !verified.is_single(id)));
    // Without the right flank of the first cut: approach, cut and retract.
    let right = cuts_of(&whole, Flank::Right)[0];
    let mut single = whole.clone();
    single.ops.drain(right - 1..=right + 1);
    let verified = verify(single).unwrap();
    let singles: Vec<usize> = verified
        .ops()
        .filter(|&(id, _)| verified.is_single(id))
        .map(|(id, _)| id.0.try_into().unwrap())
        .collect();
    assert_eq!(singles, [lefts[0]]);
    // Its left flank twice.
    let mut twice = whole;
    let again = twice.ops[lefts[0] - 2..=lefts[0] + 1].to_vec();
    twice.ops.splice(lefts[0] + 2..lefts[0] + 2, again);
    assert_eq!(rules(twice), [Rule::CutFlanks]);
}

#[test]
fn an_air_cut_cuts_without_vibration() {
    assert_eq!(faults(air_cut()), []);
    let mut working = air_cut();
    working.purpose = Purpose::Work;
    assert!(rules(working).contains(&Rule::SilentCut));
}

#[test]
fn an_air_cut_does_not_start_the_generator() {
    let mut program = air_cut();
    let switch = program
        .ops
        .iter()
        .position(|op| matches!(op.action, Action::Ultrasonic { .. }));
    program.ops[switch.unwrap()].action = Action::Ultrasonic { state: Switch::On };
    assert!(rules(program).contains(&Rule::AirCut));
}

#[test]
fn an_air_cut_stays_above_the_stock_by_half_the_blade() {
    let top = program().stock.height.to_mm();
    let thickness = program().blades[0].straight().unwrap().thickness.to_mm().max(1.0);
    for (gap, is_clear) in [
        (thickness / 2.0 + 0.01, true),
        (thickness / 2.0 - 0.01, false),
        (-5.0, false),
    ] {
        let mut program = air_cut();
        for blade in &mut program.blades {
            if let Shape::Straight(straight) = &mut blade.shape {
                straight.thickness = Length::mm(thickness);
            }
        }
        let cut = program
            .ops
            .iter()
            .position(|op| matches!(op.action, Action::Retract { .. }));
        if let Action::Retract { to, .. } = &mut program.ops[cut.unwrap()].action {
            to.z = top + gap;
        }
        assert_eq!(!rules(program).contains(&Rule::AirCut), is_clear, "{gap}");
    }
}
