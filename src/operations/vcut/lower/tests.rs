//! Programs of all orders, directions and edges: what every one of them must do, read from its ops.

use crate::plan::{PlannedVcut, Way};
use crate::samples::{given, operation, paper_job, planned};
use std::collections::BTreeMap;
use vcutc_backend_api::geometry::{Orientation, Point3};
use vcutc_backend_api::ir::{Action, Edges, Flank, Op, Program, Site};
use vcutc_backend_api::units::{Angle, Length};
use vcutc_backend_api::verify::verify;
use vcutc_diagnostics::source::SourceMap;
use vcutc_geometry::curve::Point2;
use vcutc_job::{Auto, CheckedJob, Direction, Order};
use vcutc_process::lower::lower;
use vcutc_process::plan::plan as plan_job;

/// Two hollows with a hill between them that the leaning blade does not pass beside.
fn job(order: Order, direction: Direction, edges: Edges) -> CheckedJob {
    let corners = [
        (0.0, 10.0),
        (15.0, 10.0),
        (38.0, 45.0),
        (47.0, 45.0),
        (70.0, 10.0),
        (85.0, 10.0),
    ];
    let mut job = paper_job(corners.map(|(x, z)| Point2 { x, z }).to_vec());
    let asked = operation(&mut job);
    asked.order.value = Auto::Given(order);
    asked.setup.direction = Some(given(direction));
    asked.blade.edges = edges;
    asked.blade.cutting_length.value = Length::mm(20.0);
    asked.swing.value = Auto::Given(Angle::deg(30.0));
    job
}

/// Every combination with its plan and its program, which must keep the rules of the IR.
fn programs() -> Vec<(Order, Direction, Edges, PlannedVcut, Program)> {
    let mut programs = Vec::new();
    for order in [Order::Point, Order::Layer] {
        for direction in [Direction::Alternate, Direction::Forward, Direction::Backward] {
            for edges in [Edges::Single, Edges::Double] {
                let plan = plan_job(&job(order, direction, edges)).0.unwrap();
                let program = lower(&plan, &SourceMap::default());
                verify(program.clone()).unwrap();
                let vcut = planned(&plan);
                programs.push((order, direction, edges, vcut.clone(), program));
            }
        }
    }
    programs
}

/// Where the tip is and how the blade is held, once that is known.
type Pose = Option<(Point3, Orientation)>;

/// The ops with the poses before and after each.
fn poses(program: &Program) -> Vec<(Op, Pose, Pose)> {
    let held = |id: vcutc_backend_api::ir::OrientationId| program.orientations[id.0 as usize];
    let mut at: Pose = None;
    let step = |op: &Op| {
        let before = at;
        at = match (op.action, before) {
            (Action::Travel { to, orientation, .. } | Action::AxisTravel { to, orientation }, _) => {
                Some((to, held(orientation)))
            }
            (
                Action::Approach { to, .. } | Action::Retract { to, .. } | Action::Cut { to, .. },
                Some((_, held)),
            ) => Some((to, held)),
            (Action::Turn { to, .. }, Some((tip, _))) => Some((tip, held(to))),
            (_, at) => at,
        };
        (*op, before, at)
    };
    program.ops.iter().map(step).collect()
}

#[test]
fn every_v_is_cut_on_both_sides_once_and_where_planned() {
    for (order, .., vcut, program) in programs() {
        let mut planned = BTreeMap::new();
        for layer in vcut.cuts.chunk_by(|a, b| a.layer == b.layer) {
            for (number, cut) in (1_u32..).zip(layer) {
                planned.insert((cut.layer, number), cut.tip);
            }
        }
        let mut done = Vec::new();
        for (op, before, _) in poses(&program) {
            if let (Action::Cut { flank, to, .. }, Site::Cut { layer, cut, .. }) = (op.action, op.site) {
                let (start, tip) = (before.unwrap().0, planned[&(layer.get(), cut.get())]);
                assert_eq!([start.x, start.z, to.x, to.z], [tip.x, tip.z, tip.x, tip.z]);
                done.push((layer.get(), cut.get(), flank));
            }
        }
        assert_eq!(done.len(), 2 * planned.len());
        for &(layer, cut) in planned.keys() {
            for flank in [Flank::Left, Flank::Right] {
                assert_eq!(
                    done.iter().filter(|&&pass| pass == (layer, cut, flank)).count(),
                    1
                );
            }
        }
        for layer in done.chunk_by(|a, b| a.0 == b.0) {
            let rights_so_far = layer.iter().skip_while(|pass| pass.2 == Flank::Left);
            let is_in_order = match order {
                Order::Point => layer
                    .chunks(2)
                    .all(|pair| pair[0].1 == pair[1].1 && pair[0].2 == Flank::Left),
                Order::Layer => rights_so_far.clone().all(|pass| pass.2 == Flank::Right),
            };
            assert!(is_in_order, "{layer:?}");
        }
    }
}

#[test]
fn cuts_run_the_way_that_is_asked_for_with_a_leading_edge() {
    for (_, direction, edges, _, program) in programs() {
        for (op, before, after) in poses(&program) {
            if !matches!(op.action, Action::Cut { .. }) {
                continue;
            }
            let ((from, held), (to, _)) = (before.unwrap(), after.unwrap());
            let forward = to.y > from.y;
            assert!(match direction {
                Direction::Alternate => true,
                Direction::Forward => forward,
                Direction::Backward => !forward,
            });
            // x_t is the side of the edge of a single-edged blade; a dagger keeps it towards +y.
            let leading = held.matrix()[1][0];
            match edges {
                Edges::Single => assert!(leading * (to.y - from.y) > 0.0),
                Edges::Double => assert!(leading > 0.0),
            }
        }
    }
}

#[test]
fn from_home_the_blade_comes_by_a_move_of_all_axes_and_then_never_again() {
    for (.., program) in programs() {
        let by_axes: Vec<usize> = (0..program.ops.len())
            .filter(|&place| matches!(program.ops[place].action, Action::AxisTravel { .. }))
            .collect();
        let first = program
            .ops
            .iter()
            .position(|op| !matches!(op.action, Action::Home))
            .unwrap();
        assert_eq!(by_axes, [first]);
    }
}

#[test]
fn no_turn_comes_near_half_a_revolution() {
    for (.., program) in programs() {
        for (_, before, after) in poses(&program) {
            if let (Some((_, from)), Some((_, to))) = (before, after) {
                assert!(from.angle_to(to) <= Angle::deg(150.0));
            }
        }
    }
}

#[test]
fn hills_are_passed_over_and_nothing_else_is() {
    for (order, direction, _, vcut, program) in programs() {
        let over = |layer: &&[crate::plan::PlannedCut]| {
            layer.iter().skip(1).filter(|cut| cut.way == Way::Over).count()
        };
        let layers: Vec<_> = vcut.cuts.chunk_by(|a, b| a.layer == b.layer).collect();
        let hills: usize = layers.iter().map(over).sum();
        assert!(hills > 0);
        let retracts = program
            .ops
            .iter()
            .filter(|op| matches!(op.action, Action::Retract { .. }))
            .count();
        let expected = match (direction, order) {
            // Once at the end of each layer; a hill once, or there and back.
            (Direction::Alternate, Order::Point) => layers.len() + hills,
            (Direction::Alternate, Order::Layer) => layers.len() + 2 * hills,
            // After every pass.
            (Direction::Forward | Direction::Backward, Order::Point | Order::Layer) => 2 * vcut.cuts.len(),
        };
        assert_eq!(retracts, expected, "{order:?} {direction:?}");
    }
}
