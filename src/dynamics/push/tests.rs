//! Pushes on the blade of a KR 210 whose stiffness was identified three times, against numbers that were computed with another
//! program; and against the same arm with its springs wound up.

use super::*;
use crate::chain::Chain;
use crate::springs::Spring;
use glam::DMat3;
use nalgebra::{SMatrix, SVector};
use proptest::prelude::*;
use vcutc_backend_api::motion::{Branch, Elbow, Shoulder, Wrist};
use vcutc_backend_api::units::{EdgeForce, Speed};
use vcutc_diagnostics::source::{SourceMap, Span};
use vcutc_job::Sourced;
use vcutc_job::forces::{MeasuredEdge, Statement};
use vcutc_machine::kinematics::opw::Opw;
use vcutc_machine::kinematics::pose::Pose;
use vcutc_machine::kinematics::samples::kr210;
use vcutc_machine::kinematics::{Joints, Mechanism};

/// The stiffnesses of one KR 210, as they were identified three times.
const IDENTIFIED: [[f64; 6]; 3] = [
    [2.2072e6, 3.3767e6, 2.7757e6, 2.3502e6, 2.1575e6, 0.4671e6],
    [2.1998e6, 3.3789e6, 2.7761e6, 1.5055e6, 1.7028e6, 0.4646e6],
    [1.8940e6, 3.3873e6, 2.8198e6, 3.3644e6, 1.6148e6, 0.4986e6],
];

/// The flange is where the wrist is; the tool's tip lies this far before it, in mm.
const TOOL: f64 = 525.0;

fn arm() -> Opw {
    Opw {
        c2: 1150.0,
        c3: 1200.0,
        c4: 0.0,
        ..kr210()
    }
}

fn stated<T>(value: T) -> Sourced<T> {
    Sourced { value, span: None }
}

fn nowhere() -> Span {
    let mut sources = SourceMap::default();
    Span::of_bytes(sources.add("forces", ""), 0..0)
}

fn forces(spread: f64) -> EdgeForces {
    EdgeForces {
        statement: Statement {
            span: nowhere(),
            spread: stated(spread),
            source: "made up".to_owned(),
        },
        edge: EdgeParts {
            drag: EdgeForce::n_per_mm(1.0),
            axial: EdgeForce::n_per_mm(0.3),
            side: EdgeForce::n_per_mm(0.2),
        },
        tip: EdgeParts::default(),
        failed: None,
        measured: MeasuredEdge {
            feed: stated(Speed::mm_per_s(200.0)),
            rake: stated(Angle::deg(60.0)),
            swing: stated(Angle::deg(34.155)),
        },
    }
}

/// A flank of a V: -1 for the left one, 1 for the right one, seen along +y.
fn flank(side: f64, swing: Angle, rake: Angle) -> DMat3 {
    let shank = DVec3::new(
        side * swing.sin() * rake.sin(),
        rake.cos(),
        swing.cos() * rake.sin(),
    );
    let normal = DVec3::new(-side * swing.cos(), 0.0, swing.sin());
    DMat3::from_cols(normal.cross(-shank), normal, -shank)
}

/// The arm in the left and the right flank of the V of [Cui 2020], table 1, and the stiffness of its joints.
pub(crate) fn joints_in_a_v() -> (Opw, [Joints; 2]) {
    (
        arm(),
        [-1.0, 1.0].map(|side| case(side, Elbow::Forward, 0.0).joints),
    )
}

/// How the axes move the tip along the normal of the flank in these two.
pub(crate) fn along_normals_in_a_v() -> [[f64; JOINTS]; 2] {
    [-1.0, 1.0].map(|side| {
        let case = case(side, Elbow::Forward, 0.0);
        case.push.normals(&case.columns)[0]
    })
}

pub(crate) const STIFFNESS: [f64; 6] = IDENTIFIED[0];

struct Case {
    chain: Chain,
    joints: Joints,
    columns: [Column<f64>; JOINTS],
    push: Push,
    /// The hand in the work.
    rotation: DMat3,
}

/// The V of [Cui 2020], table 1, cut towards +y.
fn case(side: f64, elbow: Elbow, spread: f64) -> Case {
    let blade_in_work = flank(side, Angle::deg(34.155), Angle::deg(60.0));
    let tip = DVec3::new(1800.0 + 42.5, -25.0 + 25.0, 700.0 + 20.0);
    let tool = Pose {
        rotation: DMat3::IDENTITY,
        position: DVec3::new(0.0, 0.0, TOOL),
    };
    let flange = Pose {
        rotation: blade_in_work,
        position: tip,
    } * tool.inverse();
    let branch = Branch::Arm {
        shoulder: Shoulder::Front,
        elbow,
        wrist: Wrist::Positive,
    };
    let joints = arm().on_branch(&flange, branch, &[0.0; 6]).unwrap();
    of_posture(joints, blade_in_work, tool, &forces(spread), DVec3::Y)
}

fn of_posture(joints: Joints, blade_in_work: DMat3, tool: Pose, forces: &EdgeForces, way: DVec3) -> Case {
    let chain = Chain::of(&Mechanism::OrthoParallel(arm())).unwrap();
    let hand = chain.in_hand(tool);
    let posture = Posture {
        blade_in_work,
        blade_in_hand: hand.rotation,
        way,
        turns: Angle::ZERO,
    };
    Case {
        columns: chain.columns(&chain.turns(&joints), hand.position.to_array()),
        push: Push::on_edge(forces, Angle::deg(7.13), Length::mm(10.0), &posture),
        rotation: blade_in_work * hand.rotation.transpose(),
        chain,
        joints,
    }
}

fn exact(stiffness: [f64; 6]) -> Springs {
    Springs::of(stiffness.map(|stiffness| Spring {
        stated: 1.0 / stiffness,
        off: Interval::ZERO,
    }))
}

/// Any of the springs that were identified, axis by axis.
fn identified() -> Springs {
    let [first, ..] = IDENTIFIED;
    Springs::of(core::array::from_fn(|axis| {
        let all = IDENTIFIED.map(|stiffness| 1.0 / stiffness[axis]);
        let stated = 1.0 / first[axis];
        Spring {
            stated,
            off: Interval {
                low: all.into_iter().fold(f64::MAX, f64::min) - stated,
                high: all.into_iter().fold(f64::MIN, f64::max) - stated,
            },
        }
    }))
}

#[track_caller]
fn assert_near(found: f64, wanted: f64, within: f64) {
    assert!((found - wanted).abs() <= within, "{found} for {wanted}");
}

#[test]
fn a_blade_that_is_pushed_moves_by_as_much_as_published() {
    let Case {
        columns,
        push,
        rotation,
        ..
    } = case(-1.0, Elbow::Forward, 0.3);
    let force = rotation * push.stated();
    for (found, wanted) in force.to_array().into_iter().zip([0.1964, -8.5, 3.2728]) {
        assert_near(found, wanted, 1e-4);
    }
    // That program counts some axes the other way round.
    let torques = push.stated_torques(&columns);
    let wanted = [-15.6428, -4.8559, -2.6110, 2.2793, 3.2184, -0.0012];
    for (axis, wanted) in wanted.into_iter().enumerate() {
        assert_near(torques[axis].abs(), f64::abs(wanted), 1e-3);
    }
    let springs = exact(IDENTIFIED[0]);
    let tip = |case: &Case| {
        let shares = case.push.shares(&case.columns, &springs);
        1e6 * shares.iter().map(|share| share.tip).sum::<f64>()
    };
    assert_near(tip(&case(-1.0, Elbow::Forward, 0.3)), 2.451, 1e-3);
    assert_near(tip(&case(1.0, Elbow::Forward, 0.3)), 1.361, 1e-3);
}

#[test]
fn forces_and_springs_within_their_spread_move_it_within_what_is_published() {
    let tip = |side: f64| {
        let Case {
            chain, joints, push, ..
        } = case(side, Elbow::Forward, 0.3);
        let turns = chain.turns_along(joints.map(Along::constant));
        let hand = chain.in_hand(Pose {
            rotation: DMat3::IDENTITY,
            position: DVec3::new(0.0, 0.0, TOOL),
        });
        let columns = chain.columns(&turns, hand.position.to_array());
        let normals = push.normals(&columns);
        let springs = identified();
        let [tip, end] = normals.map(|normal| {
            let yielded = push.forces().map(|force| {
                let torques = push.torques(&columns, force.direction, 0.5 * push.edge);
                Yielded::of(&normal, &torques, &springs)
            });
            shift(&push.forces().map(|force| force.edge), &yielded, Interval::ZERO)[1]
        });
        (1e6 * tip.hull(end).low, 1e6 * tip.hull(end).high)
    };
    // The published bounds are of boxes of forces, which hold more than forces whose parts are each within their spread.
    for (side, [low, high]) in [(-1.0, [0.563, 4.280]), (1.0, [0.754, 2.076])] {
        let (found_low, found_high) = tip(side);
        assert!(low <= found_low && found_high <= high, "{found_low} {found_high}");
        assert_near(found_low, low, 0.2);
        assert_near(found_high, high, 0.2);
    }
}

/// The shift along the normal for 1 N in the worst direction, in um.
fn worst(case: &Case, stiffness: [f64; 6]) -> f64 {
    let [tips, _] = case.push.normals(&case.columns);
    let axes = [DVec3::X, DVec3::Y, DVec3::Z].map(|direction| {
        let torques = case.push.torques(&case.columns, direction.to_array(), 0.0);
        let each = (0..JOINTS).map(|axis| tips[axis] * torques[axis] / stiffness[axis]);
        each.sum::<f64>()
    });
    1e6 * DVec3::from_array(axes).length()
}

#[test]
fn the_worst_direction_of_a_force_is_that_published() {
    let forward = case(-1.0, Elbow::Forward, 0.3);
    assert_near(worst(&forward, IDENTIFIED[0]), 1.2251, 1e-4);
    let softer = [0.9339e6, 4.1293e6, 1.9075e6, 0.2332e6, 0.4044e6, 0.0796e6];
    // Published for another set of angles of the same arm.
    assert!(worst(&forward, softer) > worst(&forward, IDENTIFIED[0]));
}

proptest! {
    /// With its springs wound up by the torques, the arm carries the tip as far along the normal as its shares say, but for
    /// terms of the second order.
    #[test]
    fn shares_are_those_of_an_arm_whose_springs_are_wound_up(
        joints in prop::array::uniform6(-1.0..1.0_f64),
        size in 0.1..2.0_f64,
        way in 0.0..6.3_f64,
    ) {
        let joints: Joints = core::array::from_fn(|axis| joints[axis] + [0.0, -1.4, 1.6, 0.3, 0.9, 0.0][axis]);
        let tool = Pose { rotation: DMat3::from_rotation_y(0.7), position: DVec3::new(40.0, -25.0, 300.0) };
        let blade_in_work = arm().forward(&joints).rotation * tool.rotation;
        let way = blade_in_work * DVec3::new(libm::cos(way), 0.0, libm::sin(way));
        let mut forces = forces(0.0);
        forces.edge.drag = EdgeForce::n_per_mm(size);
        let Case { columns, push, rotation, .. } = of_posture(joints, blade_in_work, tool, &forces, way);
        let springs = exact(IDENTIFIED[0]);
        let torques = push.stated_torques(&columns);
        let wound: Joints = core::array::from_fn(|axis| joints[axis] + torques[axis] / IDENTIFIED[0][axis]);
        let tip_of = |joints: &Joints, up: f64| {
            let blade = arm().forward(joints) * tool;
            let edge = blade.rotation * (blade_in_work.transpose() * rotation * DVec3::from_array(push.along_edge));
            blade.position / MILLIMETRES + edge * up
        };
        let normal = rotation * DVec3::from_array(push.normal);
        let shares = push.shares(&columns, &springs);
        for (up, found) in [
            (0.0, shares.iter().map(|share| share.tip).sum::<f64>()),
            (0.01, shares.iter().map(|share| share.end).sum::<f64>()),
        ] {
            let moved = tip_of(&wound, up) - tip_of(&joints, up);
            prop_assert!((moved.dot(normal) - found).abs() < 1e-9, "{} {found}", moved.dot(normal));
        }
    }

    /// Whatever stretch of the edge is in the material, and whatever forces and springs are within their spread, every place of
    /// the edge shifts by no more than the bounds.
    #[test]
    fn shifts_hold_samples(
        parts in prop::array::uniform3(-1.0..1.0_f64),
        soft in prop::array::uniform6(-1.0..1.0_f64),
        from in 0.0..1.0_f64,
        to in 0.0..1.0_f64,
        up in 0.0..1.0_f64,
        place in -1.0..1.0_f64,
        (side, swing) in (prop::sample::select(vec![-1.0, 1.0]), 0.0..60.0_f64),
        tip in 0.0..5.0_f64,
    ) {
        let spread = 0.3;
        let joints: Joints = [0.1, -1.3, 1.5, 0.4, 0.8, 0.2];
        let slopes: Joints = [0.05, 0.03, -0.04, 0.06, 0.02, -0.05];
        let tool = Pose { rotation: DMat3::IDENTITY, position: DVec3::new(0.0, 0.0, TOOL) };
        let blade_in_work = flank(side, Angle::deg(swing), Angle::deg(60.0));
        let mut all = forces(spread);
        all.tip.drag = vcutc_backend_api::units::Force::n(tip);
        let Case { chain, push, .. } = of_posture(joints, blade_in_work, tool, &all, DVec3::Y);
        let hand = chain.in_hand(tool);
        let springs = Springs::from(&vcutc_machine::elasticity::Elasticity {
            stiffness: IDENTIFIED[0],
            spread: [0.2; 6],
            backing: vcutc_machine::masses::Backing::Example,
            sources: Vec::new(),
        });
        let along = core::array::from_fn(|axis| Along::line(joints[axis], slopes[axis]));
        let columns = chain.columns(&chain.turns_along(along), hand.position.to_array());
        let [_, bound] = push.shifts(&columns, &springs);

        let here: Joints = core::array::from_fn(|axis| joints[axis] + slopes[axis] * place);
        let columns = chain.columns(&chain.turns(&here), hand.position.to_array());
        let (from, to) = (from.min(to), from.max(to));
        let up = up * push.edge;
        let normal = push.torques(&columns, push.normal, up);
        let mut shift = 0.0;
        for (force, part) in push.forces().into_iter().zip(parts) {
            let amount = |amount: Amount| amount.centre + amount.off * part;
            let tip = push.torques(&columns, force.direction, 0.0);
            let edge = push.torques(&columns, force.direction, 0.5 * (from + to) * push.edge);
            for axis in 0..JOINTS {
                let stiffness = IDENTIFIED[0][axis] * (1.0 + 0.2 * soft[axis]);
                let torque = amount(force.tip) * tip[axis] + (to - from) * amount(force.edge) * edge[axis];
                shift += normal[axis] * torque / stiffness;
            }
        }
        prop_assert!(bound.low <= shift && shift <= bound.high, "{shift} {bound:?}");
    }
}

/// An arm in coordinates where all springs are 1, seen by how far two places of an edge are off.
struct Swinging {
    inverse_masses: SMatrix<f64, JOINTS, JOINTS>,
    damping: SMatrix<f64, JOINTS, JOINTS>,
    normals: [SVector<f64, JOINTS>; 2],
}

/// What a bit of an edge pushes with, and in which step that begins or ends.
type Bit = (usize, SVector<f64, JOINTS>);

/// The bits of an edge begin to push an arm at rest, or cease to.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Bits {
    ComeIn,
    GoOut,
}

impl Swinging {
    /// From where to where the edge gets, by Runge and Kutta.
    fn range(&self, bits: &[Bit], how: Bits) -> [f64; 2] {
        const STEP: f64 = 0.02;
        let push = |step: usize| -> SVector<f64, JOINTS> {
            let pushes = |when: usize| (when <= step) == (how == Bits::ComeIn);
            let some = bits.iter().filter(|(when, _)| pushes(*when));
            some.map(|(_, push)| *push).sum()
        };
        let mut place: SVector<f64, JOINTS> = match how {
            Bits::ComeIn => SVector::zeros(),
            Bits::GoOut => bits.iter().map(|(_, push)| *push).sum(),
        };
        let mut rate = SVector::zeros();
        let mut range = [0.0_f64; 2];
        for step in 0..2000 {
            let push = push(step);
            let slope = |place: SVector<f64, JOINTS>, rate: SVector<f64, JOINTS>| {
                (rate, self.inverse_masses * (push - place - self.damping * rate))
            };
            let a = slope(place, rate);
            let b = slope(place + a.0 * (STEP / 2.0), rate + a.1 * (STEP / 2.0));
            let c = slope(place + b.0 * (STEP / 2.0), rate + b.1 * (STEP / 2.0));
            let d = slope(place + c.0 * STEP, rate + c.1 * STEP);
            place += (a.0 + (b.0 + c.0) * 2.0 + d.0) * (STEP / 6.0);
            rate += (a.1 + (b.1 + c.1) * 2.0 + d.1) * (STEP / 6.0);
            for normal in &self.normals {
                let off = normal.dot(&place);
                range = [range[0].min(off), range[1].max(off)];
            }
        }
        range
    }
}

fn scaled(torques: [f64; JOINTS], springs: [f64; JOINTS]) -> SVector<f64, JOINTS> {
    SVector::from_fn(|axis, _| torques[axis] / libm::sqrt(springs[axis]))
}

/// `A A^T` of some entries: symmetric and without negative eigenvalues.
fn square(entries: &[f64]) -> SMatrix<f64, JOINTS, JOINTS> {
    let matrix = SMatrix::<f64, JOINTS, JOINTS>::from_column_slice(entries);
    matrix * matrix.transpose()
}

#[test]
fn an_arm_whose_modes_are_alike_swings_as_far_as_the_bound() {
    let springs = IDENTIFIED[0];
    let mut all = forces(0.0);
    all.edge = EdgeParts {
        drag: EdgeForce::n_per_mm(0.0),
        axial: EdgeForce::n_per_mm(0.0),
        side: EdgeForce::n_per_mm(0.0),
    };
    all.tip.side = vcutc_backend_api::units::Force::n(10.0);
    let joints = case(1.0, Elbow::Forward, 0.0).joints;
    let tool = Pose {
        rotation: DMat3::IDENTITY,
        position: DVec3::new(0.0, 0.0, TOOL),
    };
    let blade_in_work = flank(1.0, Angle::deg(34.155), Angle::deg(60.0));
    let Case {
        chain, columns, push, ..
    } = of_posture(joints, blade_in_work, tool, &all, DVec3::Y);
    let torques = push.torques(&columns, push.side.direction, 0.0);
    let swinging = Swinging {
        inverse_masses: SMatrix::identity(),
        damping: SMatrix::zeros(),
        normals: push.normals(&columns).map(|normal| scaled(normal, springs)),
    };
    let [_, found] = swinging.range(&[(0, scaled(torques, springs) * 10.0)], Bits::ComeIn);
    let along = chain.turns_along(joints.map(Along::constant));
    let columns = chain.columns(&along, chain.in_hand(tool).position.to_array());
    let [[_, at_rest], [_, bound]] = push.shifts_and_entering(&columns, &exact(springs));
    assert!(
        0.99 * bound.high < found && found <= bound.high * (1.0 + 1e-6),
        "{found} {bound:?}"
    );
    assert!(found > 1.98 * at_rest.high, "{found} {at_rest:?}");
}

proptest! {
    /// Whatever its masses and its damping are, and in whatever order the edge comes in from rest or leaves it from rest: no place of it
    /// is off by more than the bounds.
    #[test]
    fn an_arm_that_swings_stays_within_the_bounds(
        masses in prop::collection::vec(-0.5..0.5_f64, 36),
        damping in prop::collection::vec(-0.3..0.3_f64, 36),
        parts in prop::array::uniform3(-1.0..=1.0_f64),
        soft in prop::array::uniform6(-1.0..=1.0_f64),
        whens in prop::collection::vec(0..1000_usize, 8),
        (tip, tip_when) in (-8.0..8.0_f64, 0..1000_usize),
        (side, swing) in (prop::sample::select(vec![-1.0, 1.0]), 0.0..60.0_f64),
        how in prop::sample::select(vec![Bits::ComeIn, Bits::GoOut]),
        at_once in any::<bool>(),
    ) {
        let joints: Joints = [0.1, -1.3, 1.5, 0.4, 0.8, 0.2];
        let tool = Pose { rotation: DMat3::IDENTITY, position: DVec3::new(0.0, 0.0, TOOL) };
        let blade_in_work = flank(side, Angle::deg(swing), Angle::deg(60.0));
        let mut all = forces(0.3);
        // The tip may push the other way than the edge.
        all.tip.drag = vcutc_backend_api::units::Force::n(tip);
        let Case { chain, columns, push, .. } = of_posture(joints, blade_in_work, tool, &all, DVec3::Y);
        let springs = Springs::from(&vcutc_machine::elasticity::Elasticity {
            stiffness: IDENTIFIED[0],
            spread: [0.2; 6],
            backing: vcutc_machine::masses::Backing::Example,
            sources: Vec::new(),
        });
        let along = chain.turns_along(joints.map(Along::constant));
        let enclosed = chain.columns(&along, chain.in_hand(tool).position.to_array());
        let [_, [_, bound]] = push.shifts_and_entering(&enclosed, &springs);

        let stiffness = core::array::from_fn(|axis| IDENTIFIED[0][axis] * (1.0 + 0.2 * soft[axis]));
        let total = |amount: fn(&Force) -> Amount, up: f64| {
            let each = push.forces().into_iter().zip(parts);
            let each = each.map(|(force, part)| {
                let amount = amount(force);
                scaled(push.torques(&columns, force.direction, up), stiffness) * (amount.centre + amount.off * part)
            });
            each.sum::<SVector<f64, JOINTS>>()
        };
        let count = 8.0;
        let mut bits: Vec<Bit> = (0..8_u8).zip(&whens).map(|(place, when)| {
            let up = (f64::from(place) + 0.5) / count * push.edge;
            (if at_once { 0 } else { *when }, total(|force| force.edge, up) / count)
        }).collect();
        bits.push((if at_once { 0 } else { tip_when }, total(|force| force.tip, 0.0)));
        let swinging = Swinging {
            inverse_masses: (square(&masses) + SMatrix::identity() * 0.05).try_inverse().unwrap(),
            damping: square(&damping),
            normals: push.normals(&columns).map(|normal| scaled(normal, stiffness)),
        };
        let [low, high] = swinging.range(&bits, how);
        let within = 1e-6 * bound.magnitude();
        prop_assert!(bound.low - within <= low && high <= bound.high + within, "{low} {high} {bound:?}");
    }
}
