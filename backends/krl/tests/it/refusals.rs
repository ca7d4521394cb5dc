//! What cannot be said is refused, never written wrong.

use crate::support::{issues, numbered, options, reachable};
use vcutc_backend_api::backend::{Backend, BackendIssue, MachineMismatch, OptionValue};
use vcutc_backend_api::geometry::{Frame, Orientation, Point3};
use vcutc_backend_api::ir::{
    Action, AxisKind, Cell, Load, Maker, OpId, PlacedFrame, Program, RateId, Ready, Registered,
};
use vcutc_backend_api::motion::{Branch, ReachableProgram};
use vcutc_backend_api::testkit::{CellRecipe, Recipe, blade_in_work};
use vcutc_backend_api::units::{AngularSpeed, Duration, Length, Mass, Speed};
use vcutc_backend_krl::Krl;

fn with_cell(change: impl FnOnce(&mut CellRecipe)) -> Program {
    let mut recipe = Recipe::default();
    change(&mut recipe.cell);
    recipe.program()
}

/// What is out of range, and at which op.
fn out_of_range(program: Program) -> Vec<(&'static str, Option<OpId>, String, String)> {
    issues(program, &[])
        .into_iter()
        .map(|issue| match issue {
            BackendIssue::OutOfRange {
                op,
                what,
                value,
                allowed,
                ..
            } => (what, op, value, allowed),
            other => panic!("{other:?}"),
        })
        .collect()
}

fn refused(program: Program) -> Vec<&'static str> {
    out_of_range(program).into_iter().map(|(what, ..)| what).collect()
}

/// What of a machine is refused.
fn mismatch(program: &ReachableProgram) -> Option<MachineMismatch> {
    let options = options(&[]);
    let Err(issues) = Krl.check(program, &options) else {
        return None;
    };
    match issues.as_slice() {
        [BackendIssue::WrongMachine { mismatch, .. }] => Some(*mismatch),
        other => panic!("{other:?}"),
    }
}

#[test]
fn machines_that_krl_does_not_drive() {
    type Change = fn(&mut Cell);
    let five_axis = Recipe {
        cell: CellRecipe::five_axis(),
        ..Recipe::default()
    };
    let found = mismatch(&reachable(five_axis.program()));
    assert_eq!(found, Some(MachineMismatch::Kind));
    let cases: [(Change, Option<MachineMismatch>); 5] = [
        (|_| {}, None),
        (|cell| cell.maker = Maker::Abb, Some(MachineMismatch::Maker)),
        (|cell| cell.maker = Maker::Other, Some(MachineMismatch::Maker)),
        (
            |cell| cell.axes[0].kind = AxisKind::Linear,
            Some(MachineMismatch::Arm),
        ),
        // It is reported once, and nothing else: the machine is another one anyway.
        (
            |cell| {
                cell.maker = Maker::Abb;
                cell.ultrasonic = Some(u32::MAX);
            },
            Some(MachineMismatch::Maker),
        ),
    ];
    for (case, (change, expected)) in cases.into_iter().enumerate() {
        let mut program = Recipe::default().program();
        change(program.cell.as_mut().unwrap());
        assert_eq!(mismatch(&reachable(program)), expected, "case {case}");
    }
}

#[test]
fn an_arm_with_too_few_axes() {
    let mut program = Recipe {
        layers: 0,
        ..Recipe::default()
    }
    .program();
    let cell = program.cell.as_mut().unwrap();
    cell.axes.truncate(5);
    cell.home.as_mut().unwrap().0[5] = 0.0;
    assert_eq!(mismatch(&reachable(program)), Some(MachineMismatch::Arm));
}

#[test]
fn an_arm_whose_branches_have_no_status() {
    let program = reachable(Recipe::default().program());
    let mut motion = program.motion().clone();
    for stretch in &mut motion.stretches {
        stretch.branch = Branch::Numbered(0);
    }
    let program =
        ReachableProgram::assemble(program.verified().clone(), motion, &|_, axes| blade_in_work(axes))
            .unwrap();
    assert_eq!(mismatch(&program), Some(MachineMismatch::Arm));
}

/// A turn of the axes that `T` cannot distinguish from another, at a move of all axes and where a part
/// begins.
#[test]
fn axes_beyond_a_whole_turn() {
    let angles = |shift: fn(&Action) -> bool, lines: u32| {
        let program = reachable(Recipe::default().program());
        let mut motion = program.motion().clone();
        let ops = program.program().ops.iter();
        // From the first such op on, so that signals leave the axes where they are.
        let from = ops.clone().position(|op| shift(&op.action)).unwrap();
        let home = ops.clone().rposition(|op| op.action == Action::Home).unwrap();
        for axes in &mut motion.ends[from..home] {
            axes.0[3] += 2.0 * core::f64::consts::TAU;
        }
        let mut limits = program.program().clone();
        limits.cell.as_mut().unwrap().axes[3].max = 20.0;
        let verified = vcutc_backend_api::verify::verify(limits).unwrap();
        let program = ReachableProgram::assemble(verified, motion, &|_, axes| blade_in_work(axes)).unwrap();
        let options = options(&[("lines_per_part", OptionValue::Integer(lines))]);
        let issues = Krl.check(&program, &options).err().unwrap_or_default();
        issues
            .iter()
            .map(|issue| match issue {
                BackendIssue::OutOfRange { what, .. } => *what,
                other => panic!("{other:?}"),
            })
            .collect::<Vec<_>>()
    };
    assert_eq!(
        angles(|action| matches!(action, Action::AxisTravel { .. }), 0),
        ["axis angle"]
    );
    // The axes get there while the tip moves on lines, which say nothing of turns.
    assert_eq!(angles(|action| matches!(action, Action::Cut { .. }), 0), [""; 0]);
    assert_eq!(
        angles(|action| matches!(action, Action::Cut { .. }), 1),
        ["axis angle"]
    );
}

#[test]
fn a_machine_without_home() {
    let mut program = Recipe::default().program();
    program.ops.retain(|op| op.action != Action::Home);
    program.cell.as_mut().unwrap().home = None;
    let issues = issues(program, &[]);
    assert!(
        matches!(
            issues.as_slice(),
            [BackendIssue::MissingMachineField { field: "home", .. }]
        ),
        "{issues:?}"
    );
}

#[test]
fn a_machine_without_a_generator() {
    let program = Recipe {
        cell: CellRecipe {
            ultrasonic: None,
            ..CellRecipe::default()
        },
        ..Recipe::default()
    }
    .program();
    let issues = issues(program, &[]);
    assert!(
        matches!(
            issues.as_slice(),
            [BackendIssue::MissingMachineField {
                field: "ultrasonic",
                ..
            }]
        ),
        "{issues:?}"
    );
}

#[test]
fn numbers_of_tools_bases_loads_and_signals() {
    type Set = fn(&mut CellRecipe, u32);
    let cases: [(Set, &str, u32); 5] = [
        (|cell, n| cell.tool = numbered(n), "tool number", 16),
        (|cell, n| cell.base = numbered(n), "base number", 32),
        (
            |cell, n| cell.load = Some(Registered::Number(n)),
            "load number",
            16,
        ),
        (|cell, n| cell.ultrasonic = Some(n), "output number", 4096),
        (|cell, n| cell.ready = Ready::Input(n), "input number", 4096),
    ];
    for (set, what, highest) in cases {
        for good in [1, highest] {
            assert_eq!(
                refused(with_cell(|cell| set(cell, good))),
                [""; 0],
                "{what} {good}"
            );
        }
        for bad in [highest + 1, u32::MAX] {
            assert_eq!(refused(with_cell(|cell| set(cell, bad))), [what], "{what} {bad}");
        }
    }
}

#[test]
fn inputs_that_never_change() {
    for input in [1025, 1026] {
        assert_eq!(
            refused(with_cell(|cell| cell.ready = Ready::Input(input))),
            ["input number"]
        );
    }
}

#[test]
fn speeds_beyond_the_machine_data() {
    let with_speeds = |cut: f64, rate: f64| {
        Recipe {
            cut_feed: Speed::m_per_s(cut),
            rate: AngularSpeed::deg_per_s(rate),
            ..Recipe::default()
        }
        .program()
    };
    assert_eq!(refused(with_speeds(3.0, 400.0)), [""; 0]);
    assert_eq!(refused(with_speeds(3.000_001, 400.0)), ["tip speed"]);
    assert_eq!(refused(with_speeds(1e-7, 400.0)), ["tip speed"]);
    assert_eq!(refused(with_speeds(3.0, 400.001)), ["reorientation rate"]);
    assert_eq!(refused(with_speeds(3.0, 1e-9)), ["reorientation rate"]);
}

#[test]
fn a_rate_that_only_a_turn_has_and_a_wait_that_never_ends() {
    let mut program = Recipe {
        dwell: Some(Duration::s(1.0)),
        ..Recipe::default()
    }
    .program();
    program.rates.push(AngularSpeed::deg_per_s(500.0));
    for op in &mut program.ops {
        match &mut op.action {
            Action::Turn { rate, .. } => *rate = RateId(1),
            Action::Dwell { time } => *time = Duration::s(1e9),
            _ => {}
        }
    }
    assert_eq!(refused(program), ["waiting time", "reorientation rate"]);
}

#[test]
fn a_speed_is_reported_with_its_first_op_and_unit() {
    let program = Recipe {
        cut_feed: Speed::m_per_s(5.0),
        ..Recipe::default()
    }
    .program();
    let first_cut = program
        .ops
        .iter()
        .position(|op| matches!(op.action, Action::Cut { .. }))
        .unwrap();
    let place = Some(OpId(u32::try_from(first_cut).unwrap()));
    let expected = (
        "tip speed",
        place,
        "5.0 m/s".to_owned(),
        "0.000001 to 3.0 m/s".to_owned(),
    );
    assert_eq!(out_of_range(program), [expected]);
}

#[test]
fn coordinates_out_of_the_world() {
    let mut recipe = Recipe {
        clearance: Length::mm(99_945.0),
        ..Recipe::default()
    };
    assert_eq!(refused(recipe.program()), ["Y"]);
    recipe.clearance = Length::mm(1e6);
    assert_eq!(refused(recipe.program()), ["Y", "Z"]);
}

#[test]
fn frames_and_loads_that_no_robot_has() {
    let far = PlacedFrame {
        frame: Frame {
            origin: Point3::new(0.0, -1e5, 0.0),
            orientation: Orientation::IDENTITY,
        },
        number: None,
    };
    let heavy = Load {
        mass: Mass::kg(5000.0),
        centre: Point3::new(1e9, 0.0, 0.0),
        inertia: None,
    };
    assert_eq!(refused(with_cell(|cell| cell.tool = far)), ["tool Y"]);
    assert_eq!(refused(with_cell(|cell| cell.base = far)), ["base Y"]);
    assert_eq!(
        refused(with_cell(|cell| cell.load = Some(Registered::Value(heavy)))),
        ["load mass", "load X"]
    );
    assert_eq!(
        refused(with_cell(|cell| cell.home.0[2] = f64::to_radians(361.0))),
        ["home angle"]
    );
}

#[test]
fn times_too_long() {
    for time in [1e6, 1e9] {
        let program = with_cell(|cell| cell.ready = Ready::After(Duration::s(time)));
        assert_eq!(refused(program), ["time until ready"], "{time}");
    }
}

#[test]
fn more_parts_than_names() {
    let program = Recipe {
        layers: 100,
        cuts: 100,
        layer: Length::mm(0.1),
        step: Length::mm(0.1),
        ..Recipe::default()
    }
    .program();
    let issues = issues(program, &[("lines_per_part", OptionValue::Integer(1))]);
    assert!(
        matches!(
            issues.as_slice(),
            [BackendIssue::OptionConflict {
                key: "lines_per_part",
                ..
            }]
        ),
        "{issues:?}"
    );
}

#[test]
fn everything_at_once() {
    let program = Recipe {
        cut_feed: Speed::m_per_s(5.0),
        cell: CellRecipe {
            tool: numbered(17),
            base: numbered(33),
            ..CellRecipe::default()
        },
        ..Recipe::default()
    }
    .program();
    assert_eq!(refused(program), ["tool number", "base number", "tip speed"]);
}
