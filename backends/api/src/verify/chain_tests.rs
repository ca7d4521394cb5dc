//! Each rule of chains broken once, in a program that is right otherwise.

use super::{Rule, verify};
use crate::geometry::Point3;
use crate::ir::{Action, Edges, Joint, OpId, Program, Switch};
use crate::testkit::{Recipe, chained};
use crate::units::{Angle, Length};
use proptest::prelude::*;

fn sample() -> Program {
    chained(Recipe::default().program(), Angle::deg(60.0), Length::mm(0.1))
}

/// The ops of the chain.
fn pieces(program: &Program) -> Vec<usize> {
    let ops = program.ops.iter().enumerate();
    ops.filter(|(_, op)| matches!(op.action, Action::Follow { .. }))
        .map(|(place, _)| place)
        .collect()
}

/// The rules that a program breaks at a piece of its chain, or right after it.
fn broken(program: Program, piece: usize) -> Vec<Rule> {
    let at = [piece, piece + 1].map(|op| Some(OpId(u32::try_from(op).unwrap())));
    let faults = verify(program).err().unwrap_or_default();
    faults
        .into_iter()
        .filter(|fault| at.contains(&fault.op))
        .map(|fault| fault.rule)
        .collect()
}

#[test]
fn a_chain_has_no_faults() {
    assert_eq!(pieces(&sample()).len(), 4);
    let verified = verify(sample()).unwrap();
    assert!(verified.needs().has(super::Capability::Chain));
}

#[test]
fn a_chain_ends_in_a_stop() {
    let mut program = sample();
    let last = *pieces(&program).last().unwrap();
    if let Action::Follow { joint, .. } = &mut program.ops[last].action {
        *joint = Joint::Through;
    }
    assert_eq!(broken(program, last), [Rule::ChainJoint]);
}

#[test]
fn nothing_comes_between_pieces() {
    let mut program = sample();
    let second = pieces(&program)[1];
    let off = program
        .ops
        .iter()
        .find(|op| matches!(op.action, Action::Ultrasonic { state: Switch::On }));
    let off = *off.unwrap();
    program.ops.insert(second, off);
    assert!(broken(program, second).contains(&Rule::ChainJoint));
}

#[test]
fn a_chain_goes_on_in_its_direction() {
    let mut program = sample();
    let second = pieces(&program)[1];
    if let Action::Follow { via: Some(via), .. } = program.ops[second].action {
        program.vias[via.0.get() as usize - 1].x += 2.0;
    }
    let rules = broken(program, second);
    assert!(rules.contains(&Rule::ChainJoint), "{rules:?}");
    assert!(rules.contains(&Rule::ChainPosture), "{rules:?}");
}

#[test]
fn points_on_a_line_make_no_arc() {
    let program = sample();
    let second = pieces(&program)[1];
    let segment = program.segments().nth(second).unwrap();
    let (from, to) = (segment.start().unwrap().tip, segment.end().unwrap().tip);
    let halfway = Point3::new(
        f64::midpoint(from.x, to.x),
        f64::midpoint(from.y, to.y),
        f64::midpoint(from.z, to.z),
    );
    for via in [halfway, from, to] {
        let mut program = program.clone();
        program.vias[0] = via;
        assert_eq!(broken(program, second), [Rule::Arc]);
    }
}

#[test]
fn a_blade_that_does_not_turn_with_its_way_is_held_wrongly() {
    let mut program = sample();
    let [first, second, ..] = pieces(&program)[..] else {
        panic!("no chain")
    };
    let along = program.ops[first].action.orientation().unwrap();
    if let Action::Follow { orientation, .. } = &mut program.ops[second].action {
        *orientation = along;
    }
    assert!(broken(program, second).contains(&Rule::ChainPosture));
}

/// An edge may stand square to its way, as where a slit ends at a corner; one that leans back would push the core, not cut it.
#[test]
fn the_leading_edge_leans_forward_or_stands() {
    let half_apex = Recipe::default().program().blades[0]
        .straight_mut()
        .unwrap()
        .half_apex;
    for (rake, stands) in [
        (half_apex + Angle::deg(90.0), true),
        (half_apex + Angle::deg(91.0), false),
    ] {
        let program = chained(Recipe::default().program(), rake, Length::mm(0.1));
        let second = pieces(&program)[1];
        let faults = broken(program, second);
        assert_eq!(
            !faults.contains(&Rule::ChainPosture),
            stands,
            "{rake:?}: {faults:?}"
        );
    }
}

/// The sample with its chain begun by a piece that goes this far along y and z, with an upright blade.
fn entered(edges: Edges, [along, down]: [f64; 2]) -> (Program, usize) {
    let recipe = Recipe {
        edges,
        ..Recipe::default()
    };
    let mut program = chained(recipe.program(), Angle::deg(90.0), Length::mm(0.1));
    let first = pieces(&program)[0];
    let mut down_to = program.ops[first];
    if let Action::Follow { to, joint, .. } = &mut down_to.action {
        to.y -= 20.0;
        to.z -= down;
        *joint = Joint::Stop;
    }
    if let Some(begin) = down_to.action.tip() {
        for op in &mut program.ops[..first] {
            if let Action::Approach { to, .. } | Action::Travel { to, .. } = &mut op.action
                && to.x == begin.x
            {
                to.y = begin.y - along;
                to.z = to.z.max(begin.z + down);
            }
        }
        program.ops[first - 1].action = Action::Approach {
            to: Point3 {
                y: begin.y - along,
                z: begin.z + down,
                ..begin
            },
            feed: crate::ir::FeedId(1),
        };
    }
    program.ops.insert(first, down_to);
    (program, first)
}

#[test]
fn a_blade_goes_in_and_out_within_its_outline() {
    let half_apex = Recipe::default().program().blades[0]
        .straight_mut()
        .unwrap()
        .half_apex;
    let beside = 10.0 * half_apex.tan();
    for (edges, way, is_good) in [
        (Edges::Double, [0.0, 10.0], true),
        (Edges::Double, [0.0, -10.0], true),
        (Edges::Double, [0.99 * beside, 10.0], true),
        (Edges::Double, [-0.99 * beside, 10.0], true),
        (Edges::Double, [-1.2 * beside, 10.0], false),
        (Edges::Single, [beside, 10.0], true),
        (Edges::Single, [0.0, 10.0], false),
        (Edges::Single, [0.0, -10.0], true),
    ] {
        let (program, first) = entered(edges, way);
        let at = Some(OpId(u32::try_from(first).unwrap()));
        let faults = verify(program).err().unwrap_or_default();
        let faults: Vec<Rule> = faults
            .into_iter()
            .filter(|fault| fault.op == at)
            .map(|fault| fault.rule)
            .collect();
        assert_eq!(
            !faults.contains(&Rule::ChainPosture),
            is_good,
            "{edges:?} {way:?}: {faults:?}"
        );
    }
}

#[test]
fn a_chain_cuts_with_a_running_blade() {
    let mut program = sample();
    let first = pieces(&program)[0];
    program.ops.retain(|op| !matches!(op.action, Action::AwaitReady));
    let first = first - 1;
    assert!(broken(program, first).contains(&Rule::ReadyNotAwaited));
}

#[test]
fn an_arc_of_an_air_cut_stays_above() {
    let mut program = sample();
    let top = program.stock.height.to_mm();
    let second = pieces(&program)[1];
    program.purpose = crate::ir::Purpose::AirCut {
        lift: Length::mm(0.0),
    };
    // Its ends are above, and it sags between them.
    for op in &mut program.ops {
        if let Action::Follow { to, .. } | Action::Approach { to, .. } = &mut op.action {
            to.z = top + 10.0;
        }
    }
    for via in &mut program.vias {
        via.z = top + 10.0;
    }
    assert!(!broken(program.clone(), second).contains(&Rule::AirCut));
    program.vias[0].z = top - 10.0;
    assert!(broken(program, second).contains(&Rule::AirCut));
}

proptest! {
    /// The bound of the slip against samples of it.
    #[test]
    fn what_is_let_pass_slips_by_no_more_than_it_may(
        yaw in -0.002..0.002_f64,
        end in -0.002..0.002_f64,
        rake in 50.0..90.0_f64,
    ) {
        use crate::geometry::Orientation;
        let mut program = chained(Recipe::default().program(), Angle::deg(rake), Length::ZERO);
        let second = pieces(&program)[1];
        let turned = |orientation: Orientation, by: f64| {
            let [w, x, y, z] = orientation.quaternion();
            let (s, c) = libm::sincos(by / 2.0);
            Orientation::from_quaternion(c * w - s * z, c * x - s * y, c * y + s * x, c * z + s * w).unwrap()
        };
        let segment = program.segments().nth(second).unwrap();
        let ids = [segment.start().unwrap(), segment.end().unwrap()].map(|pose| pose.orientation.0 as usize);
        for (id, by) in ids.into_iter().zip([yaw, end]) {
            program.orientations[id] = turned(program.orientations[id], by);
        }
        let passes = !broken(program.clone(), second - 1).contains(&Rule::ChainPosture)
            && !broken(program.clone(), second).contains(&Rule::ChainPosture);
        let line = program.segments().nth(second).unwrap().line().unwrap();
        let arc = line.arc().unwrap();
        let slip = (0..=200).map(|place| {
            let done = f64::from(place) / 200.0;
            let held = line.frame_at(&program, done).unwrap().orientation.matrix();
            let way = arc.direction(arc.sweep().to_rad() * done);
            libm::asin((0..3).map(|row| held[row][1] * way[row]).sum::<f64>()).abs()
        }).fold(0.0, f64::max);
        if passes {
            prop_assert!(slip <= super::LARGEST_SLIP.to_rad() * (1.0 + 1e-9), "{slip}");
        }
        if slip > super::LARGEST_SLIP.to_rad() {
            prop_assert!(!passes);
        }
        // Where both ends are right to a third of it, it is let pass.
        if yaw.abs().max(end.abs()) < 0.3 * super::LARGEST_SLIP.to_rad() {
            prop_assert!(passes);
        }
    }
}
