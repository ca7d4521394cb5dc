//! Status and turn, from the kinematics of an arm through the branch and the program to the text, against their definition.
//!
//! Every KUKA arm of the catalogue is put into random postures; each way of reaching the same pose makes a program of a single
//! axis move, whose `S` and `T` are read back and computed again from nothing but the axes.

use crate::krl_text::expected::turn;
use crate::krl_text::reader::{self, Event};
use crate::krl_text::status;
use crate::pipeline::krl;
use proptest::prelude::*;
use std::collections::BTreeSet;
use std::f64::consts::TAU;
use vcutc::machine::kinematics::{Mechanism, Solution};
use vcutc::machine::{Model, catalogue};
use vcutc::motion::rig::Rig;
use vcutc_backend_api::backend::Options;
use vcutc_backend_api::bundle::Bundle;
use vcutc_backend_api::geometry::{Frame, Orientation, Point3, Zyx};
use vcutc_backend_api::ir::{
    Action, AxisValues, Cell, IR_VERSION, Maker, Op, OpId, OrientationId, PlacedFrame, Program, Purpose,
    Ready, Site, Stock, Tool, Tools,
};
use vcutc_backend_api::motion::{Motion, ReachableProgram, Stretch};
use vcutc_backend_api::units::{Angle, Duration, Length};
use vcutc_backend_api::verify::verify;

/// All arms that the target drives.
fn arms() -> Vec<Model> {
    let models: Vec<Model> = catalogue::names().filter_map(catalogue::find).collect();
    let is_arm =
        |model: &Model| matches!(model.mechanism, Mechanism::OrthoParallel(_)) && model.maker == Maker::Kuka;
    models.into_iter().filter(is_arm).collect()
}

/// A blade askew on the flange.
fn tool() -> Frame {
    Frame {
        origin: Point3::new(20.0, -30.0, 310.0),
        orientation: Orientation::from_zyx(Zyx {
            a: Angle::deg(40.0),
            b: Angle::deg(-20.0),
            c: Angle::deg(100.0),
        }),
    }
}

/// Work so far below the arm that every pose is above it.
fn base() -> Frame {
    Frame {
        origin: Point3::new(0.0, 0.0, -20_000.0),
        orientation: Orientation::IDENTITY,
    }
}

fn cell(model: &Model) -> Cell {
    let mut home = [0.0; 6];
    for (place, axis) in home.iter_mut().zip(&model.axes) {
        *place = f64::midpoint(axis.min, axis.max);
    }
    let placed = |frame| PlacedFrame { frame, number: None };
    Cell {
        name: "cell".to_owned(),
        kind: model.kind(),
        maker: model.maker,
        model: model.name.clone(),
        axes: model.axes.clone(),
        tools: Tools::one(Tool {
            frame: placed(tool()),
            load: None,
            place: None,
        }),
        base: placed(base()),
        home: Some(AxisValues(home)),
        change: None,
        ultrasonic: Some(1),
        spindle: None,
        ready: Ready::After(Duration::s(1.0)),
    }
}

/// From home to where the axes are in a solution, and back.
fn program(model: &Model, solution: &Solution) -> ReachableProgram {
    let rig = Rig::new(model, tool(), base());
    let blade_in_work = |axes: &AxisValues| Frame::from(rig.blade_in_work(&axes.0));
    let axes = AxisValues(solution.joints);
    let Frame { origin, orientation } = blade_in_work(&axes);
    let cell = cell(model);
    let home = cell.home.unwrap();
    let travel = Action::AxisTravel {
        to: origin,
        orientation: OrientationId(0),
    };
    let ops = [Action::Home, travel, Action::Home].map(|action| Op {
        site: Site::Program,
        action,
    });
    let side = Length::mm(10.0);
    let program = Program {
        version: IR_VERSION,
        name: "posture".to_owned(),
        purpose: Purpose::Work,
        head: None,
        stock: Stock {
            width: side,
            depth: side,
            height: side,
        },
        cell: Some(cell),
        blades: Vec::new(),
        operations: Vec::new(),
        orientations: vec![orientation],
        feeds: Vec::new(),
        rates: Vec::new(),
        vias: Vec::new(),
        blend: Length::ZERO,
        ops: ops.to_vec(),
    };
    let motion = Motion {
        ends: vec![home, axes, home],
        stretches: vec![Stretch {
            from: OpId(1),
            branch: solution.branch,
        }],
        waypoints: Vec::new(),
    };
    ReachableProgram::assemble(verify(program).unwrap(), motion, &|_, axes| blade_in_work(axes)).unwrap()
}

/// `S` and `T` as the program's text has them.
fn written(program: &ReachableProgram) -> (u32, u32) {
    let options = Options::defaults(krl().options());
    let mut bundle = Bundle::default();
    let emission = krl()
        .check(program, &options)
        .map_err(|issues| format!("{issues:?}"));
    emission.unwrap().write(&mut bundle).unwrap();
    let events = reader::run(&bundle, "posture").unwrap();
    let point = events.into_iter().find_map(|event| match event {
        Event::Point { status, turn, .. } => Some((status, turn)),
        _ => None,
    });
    point.unwrap()
}

/// All ways of reaching the pose of these axes, with every turn of every axis within its limits.
fn ways(model: &Model, axes: &[f64; 6]) -> Vec<Solution> {
    let pose = model.mechanism.flange_in_root(axes);
    let mut ways: Vec<Solution> = model.mechanism.all(&pose).iter().copied().collect();
    for (place, axis) in model.axes.iter().enumerate() {
        let turned = |way: Solution| {
            [-TAU, 0.0, TAU].map(|turn| {
                let mut way = way;
                way.joints[place] += turn;
                way
            })
        };
        ways = ways.into_iter().flat_map(turned).collect();
        ways.retain(|way| (axis.min..=axis.max).contains(&way.joints[place]));
    }
    ways
}

/// Axes at these shares of their ranges.
fn posture(model: &Model, shares: &[f64; 6]) -> [f64; 6] {
    let mut axes = [0.0; 6];
    for ((place, axis), share) in axes.iter_mut().zip(&model.axes).zip(shares) {
        *place = axis.min + share * (axis.max - axis.min);
    }
    axes
}

fn definition(model: &Model, axes: &[f64; 6]) -> (u32, u32) {
    #[allow(
        irrefutable_let_patterns,
        reason = "the arms of this test have no other mechanism"
    )]
    let Mechanism::OrthoParallel(arm) = &model.mechanism else {
        panic!("{}", model.name)
    };
    (status(arm, &AxisValues(*axes)), turn(&AxisValues(*axes)))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn every_way_of_every_arm_is_said_by_its_status_and_turn(shares in [(); 6].map(|()| 0.001..0.999_f64)) {
        for model in arms() {
            let axes = posture(&model, &shares);
            let ways = ways(&model, &axes);
            let mut definitions = BTreeSet::new();
            for way in &ways {
                let text = written(&program(&model, way));
                prop_assert_eq!(text, definition(&model, &way.joints), "{} {:?}", model.name, way);
                definitions.insert(text);
            }
            // No two ways are described alike, and the one that the pose was made from is among them.
            prop_assert_eq!(definitions.len(), ways.len(), "{}", model.name);
            prop_assert!(definitions.contains(&definition(&model, &axes)), "{}", model.name);
        }
    }
}

#[test]
fn the_arms_are_many_and_stand_in_all_eight_ways() {
    let arms = arms();
    assert!(arms.len() >= 15, "{}", arms.len());
    let mut seen = BTreeSet::new();
    for model in &arms {
        for way in ways(model, &posture(model, &[0.6, 0.35, 0.75, 0.3, 0.8, 0.4])) {
            seen.insert(definition(model, &way.joints).0);
        }
    }
    assert_eq!(seen, (0..8).collect());
}
