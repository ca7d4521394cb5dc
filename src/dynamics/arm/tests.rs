//! Torques against Pinocchio, against published cases, and against the equations of Lagrange by differences.

use super::*;
use core::f64::consts::FRAC_PI_2;
use proptest::prelude::*;
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::ir::Inertia;
use vcutc_backend_api::units::Mass;
use vcutc_diagnostics::source::FileId;
use vcutc_geometry::number::Interval;
use vcutc_machine::body::MILLIMETRES;
use vcutc_machine::catalogue;
use vcutc_machine::kinematics::joint_axis::JointAxis;
use vcutc_machine::kinematics::mounted::Mounted;
use vcutc_machine::kinematics::opw::{Coupling, Opw};
use vcutc_machine::kinematics::pose::Pose;
use vcutc_machine::kinematics::samples::irb2400;
use vcutc_machine::kinematics::serial::SerialArm;
use vcutc_machine::sheet;

/// As the cases have it.
const RISE: DVec3 = DVec3::new(0.0, 0.0, 9.81);

fn named(name: &str, load: Option<Load>) -> Arm {
    let model = catalogue::find(name).unwrap();
    let links = model.masses.as_ref().unwrap().carried().unwrap();
    let bodies = links.map(Body::from);
    Arm::new(&model.mechanism, bodies, load, RISE).unwrap()
}

pub(crate) fn torques(arm: &Arm, joints: [f64; 6], rates: [f64; 6], accelerations: [f64; 6]) -> [f64; 6] {
    arm.torques(&State {
        turns: arm.turns(&joints),
        rates,
        accelerations,
    })
}

#[track_caller]
fn assert_near(found: [f64; 6], wanted: [f64; 6], within: f64) {
    let apart = found.iter().zip(wanted).map(|(a, b)| (a - b).abs());
    let apart = apart.fold(0.0, f64::max);
    assert!(apart <= within, "{apart}: {found:?} for {wanted:?}");
}

#[derive(serde::Deserialize)]
struct Fixtures {
    gravity: f64,
    arms: Vec<FixtureArm>,
}

#[derive(serde::Deserialize)]
struct FixtureArm {
    name: String,
    serial: Vec<Fixture>,
    /// The same arm, were its third axis to count from the root.
    coupled: Vec<Fixture>,
}

#[derive(serde::Deserialize)]
struct Fixture {
    joints: [f64; 6],
    rates: [f64; 6],
    accelerations: [f64; 6],
    /// Mass in kg, and centre seen from the flange in mm.
    load: [f64; 4],
    torques: [f64; 6],
}

/// The sheets of the examples, by their places in the repository.
const SHOP: [(&str, &str); 3] = [
    (
        "examples/shop/gantry.toml",
        include_str!("../../../examples/shop/gantry.toml"),
    ),
    (
        "examples/shop/knife_gantry.toml",
        include_str!("../../../examples/shop/knife_gantry.toml"),
    ),
    (
        "examples/shop/kr210.toml",
        include_str!("../../../examples/shop/kr210.toml"),
    ),
];

/// Those of them that have masses.
fn of_the_examples() -> impl Iterator<Item = Model> {
    let all = SHOP.iter().map(|(place, text)| {
        let sheet = sheet::parse(FileId::ALONE, text).unwrap();
        sheet.machine(*place)
    });
    all.filter(|model| model.masses.is_some())
}

#[test]
fn every_sheet_with_masses_has_the_torques_of_pinocchio() {
    let text = include_str!("../../../tests/data/dynamics/torques.json");
    let Fixtures { gravity, arms } = serde_json::from_str(text).unwrap();
    assert_eq!(gravity, RISE.z);
    let of_the_catalogue = catalogue::names().filter_map(catalogue::find);
    let models: Vec<Model> = of_the_catalogue
        .filter(|model| model.masses.is_some())
        .chain(of_the_examples())
        .collect();
    assert_eq!(models.len(), arms.len());
    for (arm, model) in arms.iter().zip(&models) {
        assert_eq!(model.name, arm.name);
        let opw = *model.mechanism.ortho_parallel().unwrap();
        let bodies = model.masses.as_ref().unwrap().carried().unwrap().map(Body::from);
        for (coupling, states) in [
            (Coupling::Serial, &arm.serial),
            (Coupling::Parallelogram, &arm.coupled),
        ] {
            assert!(states.len() >= 8);
            let mechanism = Mechanism::OrthoParallel(Opw { coupling, ..opw });
            for state in states {
                let [mass, x, y, z] = state.load;
                let load = Load {
                    mass: Mass::kg(mass),
                    centre: Point3::new(x, y, z),
                    inertia: None,
                };
                let loaded = Arm::new(&mechanism, bodies, Some(load), RISE).unwrap();
                let found = torques(&loaded, state.joints, state.rates, state.accelerations);
                let size = state
                    .torques
                    .iter()
                    .fold(0.0_f64, |size, torque| size.max(torque.abs()));
                assert_near(found, state.torques, 1e-12 * size.max(1.0));
            }
        }
    }
}

/// The arm of [Ha 2019], table 3, with bodies whose masses are made up: the paper has none.
pub(crate) fn parts_of_the_paper() -> (Mechanism, [Body; JOINTS]) {
    // a, d in m and the twist of each joint, and its body: mass, centre and principal inertias in the frame of Denavit and Hartenberg.
    let rows = [
        (
            [0.3, 0.5145],
            -FRAC_PI_2,
            420.0,
            [-0.15, 0.15, 0.0],
            [20.0, 25.0, 20.0],
        ),
        ([0.7, 0.0], 0.0, 300.0, [-0.35, 0.0, -0.08], [5.0, 25.0, 25.0]),
        (
            [0.28, 0.0],
            -FRAC_PI_2,
            330.0,
            [-0.08, 0.02, 0.25],
            [30.0, 30.0, 8.0],
        ),
        (
            [0.0, 1.06024],
            FRAC_PI_2,
            40.0,
            [0.0, -0.25, 0.0],
            [1.5, 0.6, 1.5],
        ),
        ([0.0, 0.0], -FRAC_PI_2, 40.0, [0.0, 0.0, 0.06], [0.4, 0.4, 0.3]),
        ([0.0, 0.377], 0.0, 60.0, [0.0, 0.0, -0.15], [2.0, 2.0, 1.0]),
    ];
    let mut frame = Pose::IDENTITY;
    let placed = rows.map(|([a, d], twist, mass, centre, principal)| {
        let line = JointAxis {
            point: frame.position,
            direction: frame.rotation.z_axis,
        };
        frame = frame
            * Pose {
                rotation: DMat3::from_rotation_x(twist),
                position: DVec3::new(a, 0.0, d) * MILLIMETRES,
            };
        let body = Body {
            mass,
            centre: frame.position / MILLIMETRES + frame.rotation * DVec3::from_array(centre),
            inertia: frame.rotation
                * DMat3::from_diagonal(DVec3::from_array(principal))
                * frame.rotation.transpose(),
        };
        (line, body)
    });
    let arm = SerialArm::new(placed.map(|(line, _)| line), frame).unwrap();
    (Mechanism::Serial(arm), placed.map(|(_, body)| body))
}

fn of_the_paper() -> Arm {
    let (mechanism, bodies) = parts_of_the_paper();
    Arm::new(&mechanism, bodies, None, RISE).unwrap()
}

#[test]
fn a_fast_arm_of_the_paper_needs_the_torques_of_its_equations() {
    let joints = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6];
    let (rates, accelerations) = (joints.map(|q| 2.0 * q), joints.map(|q| 3.0 * q));
    let arm = of_the_paper();
    let found = torques(&arm, joints, rates, accelerations);
    let wanted = [
        105.734706,
        -3522.216098,
        651.179940,
        -15.445945,
        165.204261,
        3.586064,
    ];
    assert_near(found, wanted, 1e-6);
    let still = torques(&arm, joints, [0.0; 6], accelerations);
    let round: [f64; 6] = core::array::from_fn(|axis| found[axis] - still[axis]);
    let wanted = [-87.695194, -200.053322, -10.217871, -1.515014, 8.389912, 0.620453];
    assert_near(round, wanted, 1e-6);
}

#[test]
fn on_the_path_of_the_paper_torques_are_weight() {
    let degrees = |angles: [f64; 6]| angles.map(f64::to_radians);
    let middle = degrees([-2.0399, -97.2454, 55.7688, -182.7218, 48.5554, 181.8023]);
    let rates = degrees([-1.594806, 0.401185, -0.362349, -8.491348, 0.239121, 5.619002]);
    let accelerations = degrees([0.031536, 0.311124, -0.283128, 0.105794, 0.651044, -0.101900]);
    let found = torques(&of_the_paper(), middle, rates, accelerations);
    // The angles are known to half of 0.0001 deg, and 2000 kg m a rad hang on axis 2.
    let wanted = [0.1602, -1827.7086, -2365.9492, 3.7031, 157.0810, 0.0];
    assert_near(found, wanted, 0.01);
}

#[test]
fn known_arms_need_known_torques() {
    let degrees = |angles: [f64; 6]| angles.map(f64::to_radians);
    let joints = degrees([25.0, -70.0, 65.0, 40.0, -35.0, 110.0]);
    let rates = degrees([10.0, 20.0, 30.0, 40.0, 50.0, 60.0]);
    let accelerations = degrees([100.0, 200.0, 300.0, 400.0, 500.0, 600.0]);
    for (name, wanted) in [
        (
            "kuka/kr240_r2900_2",
            [1124.8685, 1816.3811, 464.2007, 17.1507, 40.7887, 0.6805],
        ),
        (
            "kuka/kr210_r2700_2",
            [866.3282, 1028.4133, 287.3146, 9.7830, 21.0773, 0.2048],
        ),
        (
            "kuka/kr210_r3100_ultra",
            [1408.4497, 1632.6157, 562.6207, 5.7214, 0.0, 0.0],
        ),
        (
            "kuka/kr10_r1100_2",
            [8.1490, -24.4422, -15.4881, -0.3245, 0.0528, 0.0042],
        ),
    ] {
        let found = torques(&named(name, None), joints, rates, accelerations);
        assert_near(found, wanted, 6e-5);
    }
}

#[test]
fn the_inertia_of_a_load_resists_the_axes_that_turn_it() {
    let load = |inertia| {
        let load = Load {
            mass: Mass::kg(14.5),
            centre: Point3::new(10.0, 20.0, 140.0),
            inertia,
        };
        named("kuka/kr210_r3100_ultra", Some(load))
    };
    let (x, y, z) = (0.3, 0.2, 0.1);
    let (point, body) = (load(None), load(Some(Inertia { x, y, z })));
    // Axis 5 is along y of the flange, and along x after a quarter turn of axis 6.
    for (axis, turned, moment) in [(5, 0.0, z), (4, 0.0, y), (4, FRAC_PI_2, x)] {
        let mut accelerations = [0.0; JOINTS];
        accelerations[axis] = 2.0;
        let state = |arm: &Arm| State {
            turns: arm.turns(&[0.3, -1.2, 1.1, 0.4, 0.5, turned]),
            rates: [0.0; JOINTS],
            accelerations,
        };
        let more = body.torques(&state(&body))[axis] - point.torques(&state(&point))[axis];
        assert!((more - 2.0 * moment).abs() < 1e-9, "{axis}: {more}");
    }
}

#[test]
fn a_load_hangs_on_the_axes_that_carry_it() {
    let load = Load {
        mass: Mass::kg(14.5),
        centre: Point3::new(0.0, 0.0, 140.0),
        inertia: None,
    };
    let arm = named("kuka/kr210_r3100_ultra", Some(load));
    let level = [0.0, -90.0, 90.0, 0.0, 0.0, 0.0].map(f64::to_radians);
    let weight = arm.weight(&level);
    // The upper arm stands upright, so axes 2 and 3 carry the same. The hand is level, and carries nothing but the load.
    assert!((weight[1] - weight[2]).abs() < 1e-9, "{weight:?}");
    let load = 14.5 * RISE.z;
    assert!((weight[4] + load * (0.24 + 0.14)).abs() < 1e-9, "{weight:?}");
    let alone = named("kuka/kr210_r3100_ultra", None).weight(&level);
    assert!(
        (weight[1] - alone[1] + load * (1.4 + 0.24 + 0.14)).abs() < 1e-9,
        "{weight:?}"
    );
    // With the hand bent, as at home.
    let home = [0.0, -90.0, 90.0, 0.0, 45.0, 0.0].map(f64::to_radians);
    let weight = arm.weight(&home);
    assert!(
        (weight[1] + 1786.0742).abs() < 6e-5 && (weight[2] + 1786.0742).abs() < 6e-5,
        "{weight:?}"
    );
}

#[test]
fn the_elbow_of_a_parallelogram_is_carried_by_the_third_drive() {
    let bodies =
        [0, 1, 2, 3, 4, 5].map(|place| Body::point(10.0 * f64::from(6 - place), DVec3::new(0.5, 0.0, 1.0)));
    let coupled = irb2400();
    let serial = Opw {
        coupling: Coupling::Serial,
        ..coupled
    };
    let [coupled, serial] =
        [coupled, serial].map(|arm| Arm::new(&Mechanism::OrthoParallel(arm), bodies, None, RISE).unwrap());
    let axes = [0.3, 0.4, -0.2, 0.5, 0.6, 0.7];
    let joints = [0.3, 0.4, -0.6, 0.5, 0.6, 0.7];
    let (axes, joints) = (coupled.weight(&axes), serial.weight(&joints));
    let wanted = [
        joints[0],
        joints[1] - joints[2],
        joints[2],
        joints[3],
        joints[4],
        joints[5],
    ];
    assert_near(axes, wanted, 1e-9);
}

/// The energy of the arm of the paper along a course, by its torques: Gauss-Legendre quadrature of their power in 20 stretches.
#[test]
fn work_becomes_energy() {
    let arm = of_the_paper();
    let course = |t: f64, order: u32| -> [f64; 6] {
        core::array::from_fn(|axis| {
            let axis = f64::from(u32::try_from(axis).unwrap());
            let rate = (axis + 1.0) / 3.0;
            let phase = rate * t + axis + FRAC_PI_2 * f64::from(order);
            0.5 * rate.powi(i32::try_from(order).unwrap()) * libm::sin(phase)
        })
    };
    let power = |t: f64| {
        let [joints, rates, accelerations] = [0, 1, 2].map(|order| course(t, order));
        let torques = torques(&arm, joints, rates, accelerations);
        torques
            .iter()
            .zip(rates)
            .map(|(torque, rate)| torque * rate)
            .sum::<f64>()
    };
    let nodes = [
        (0.0, 8.0 / 9.0),
        (0.6_f64.sqrt(), 5.0 / 9.0),
        (-0.6_f64.sqrt(), 5.0 / 9.0),
    ];
    let stretches = 400;
    let half = 1.0 / f64::from(stretches);
    let work: f64 = (0..stretches)
        .flat_map(|stretch| {
            let middle = half * f64::from(2 * stretch + 1);
            nodes.map(|(node, weight)| half * weight * power(middle + half * node))
        })
        .sum();
    assert!((work - 311.486333).abs() < 1e-6, "{work}");
}

pub(crate) fn states() -> impl Strategy<Value = [[f64; 6]; 3]> {
    let six = |most: f64| prop::array::uniform6(-most..most);
    (six(3.0), six(4.0), six(20.0)).prop_map(|(joints, rates, accelerations)| [joints, rates, accelerations])
}

/// Random bodies of links.
pub(crate) fn bodies() -> impl Strategy<Value = [Body; JOINTS]> {
    let three = |most: f64| prop::array::uniform3(-most..most);
    let body = (0.0..300.0, three(2.0), three(3.0), three(2.0)).prop_map(|(mass, centre, turn, sides)| {
        let turn = DMat3::from_euler(glam::EulerRot::ZYX, turn[0], turn[1], turn[2]);
        let [x, y, z] = sides.map(|side| side * side * mass);
        Body {
            mass,
            centre: DVec3::from_array(centre),
            inertia: turn * DMat3::from_diagonal(DVec3::new(y + z, x + z, x + y)) * turn.transpose(),
        }
    });
    prop::collection::vec(body, 6).prop_map(|bodies| bodies.try_into().unwrap())
}

/// An arm of random bodies.
fn arms() -> impl Strategy<Value = Arm> {
    (bodies(), prop::array::uniform3(-1.0..1.0)).prop_map(|(bodies, rise)| {
        let model = catalogue::find("kuka/kr210_r3100_ultra").unwrap();
        Arm::new(&model.mechanism, bodies, None, 9.81 * DVec3::from_array(rise)).unwrap()
    })
}

proptest! {
    /// [Ha 2019], equations 19 to 25: what is left of the torques without weight and acceleration is made of the derivatives of the mass matrix.
    #[test]
    fn torques_are_those_of_lagrange(arm in arms(), [joints, rates, accelerations] in states()) {
        let weight = |joints: [f64; 6]| torques(&arm, joints, [0.0; 6], [0.0; 6]);
        let matrix = |joints: [f64; 6]| -> [[f64; 6]; 6] {
            let still = weight(joints);
            core::array::from_fn(|axis| {
                let unit = core::array::from_fn(|other| if other == axis { 1.0 } else { 0.0 });
                let column = torques(&arm, joints, [0.0; 6], unit);
                core::array::from_fn(|row| column[row] - still[row])
            })
        };
        let masses = matrix(joints);
        let size = masses.iter().flatten().fold(1.0_f64, |size, entry| size.max(entry.abs()));
        for (row, column) in [(0, 1), (1, 2), (2, 5), (0, 4), (3, 5)] {
            prop_assert!((masses[row][column] - masses[column][row]).abs() < 1e-12 * size.max(1.0));
        }
        let energy: f64 = (0..6).flat_map(|a| (0..6).map(move |b| (a, b)))
            .map(|(a, b)| masses[a][b] * rates[a] * rates[b]).sum();
        prop_assert!(energy > -1e-9 * size);
        let step = 1e-4;
        let slopes: Vec<[[f64; 6]; 6]> = (0..6).map(|axis| {
            let at = |by: f64| {
                let mut moved = joints;
                moved[axis] += by;
                matrix(moved)
            };
            let (far, near) = ([at(2.0 * step), at(-2.0 * step)], [at(step), at(-step)]);
            core::array::from_fn(|a| core::array::from_fn(|b| {
                (8.0 * (near[0][a][b] - near[1][a][b]) - (far[0][a][b] - far[1][a][b])) / (12.0 * step)
            }))
        }).collect();
        let still = weight(joints);
        let wanted: [f64; 6] = core::array::from_fn(|j| {
            let mut torque = still[j];
            for k in 0..6 {
                torque += masses[j][k] * accelerations[k];
                for l in 0..6 {
                    let christoffel = (slopes[l][k][j] + slopes[k][l][j] - slopes[j][k][l]) / 2.0;
                    torque += christoffel * rates[k] * rates[l];
                }
            }
            torque
        });
        let found = torques(&arm, joints, rates, accelerations);
        for axis in 0..6 {
            prop_assert!((found[axis] - wanted[axis]).abs() < 1e-7 * size.max(found[axis].abs()), "{found:?} {wanted:?}");
        }
    }

    #[test]
    fn enclosures_hold_what_they_enclose(arm in arms(), [joints, rates, accelerations] in states(), by in -1e-3..1e-3) {
        let around = |value: f64| Interval { low: value - 1e-3, high: value + 1e-3 };
        let turns = joints.map(|joint| {
            let (sine, cosine) = around(joint).sin_cos();
            Turn { sine, cosine }
        });
        let enclosed = arm.torques(&State { turns, rates: rates.map(around), accelerations: accelerations.map(around) });
        let moved = |values: [f64; 6]| values.map(|value| value + by);
        let found = torques(&arm, moved(joints), moved(rates), moved(accelerations));
        for (range, torque) in enclosed.iter().zip(found) {
            prop_assert!(range.low <= torque && torque <= range.high, "{torque} in {range:?}");
        }
    }

    #[test]
    fn a_turned_root_changes_nothing(turn in prop::array::uniform3(-3.0..3.0_f64), [joints, rates, accelerations] in states()) {
        let root = Pose {
            rotation: DMat3::from_euler(glam::EulerRot::ZYX, turn[0], turn[1], turn[2]),
            position: DVec3::new(300.0, -200.0, 1000.0),
        };
        let model = catalogue::find("kuka/kr210_r2700_2").unwrap();
        let bodies = model.masses.as_ref().unwrap().carried().unwrap().map(Body::from);
        let moved = bodies.map(|body| Body {
            mass: body.mass,
            centre: root.position / MILLIMETRES + root.rotation * body.centre,
            inertia: root.rotation * body.inertia * root.rotation.transpose(),
        });
        let arm = model.mechanism.ortho_parallel().unwrap();
        let mounted = Mounted { foot_in_root: root, arm: *arm, flange_in_hand: Pose::IDENTITY };
        let here = Arm::new(&model.mechanism, bodies, None, RISE).unwrap();
        let there = Arm::new(&Mechanism::Mounted(mounted), moved, None, root.rotation * RISE).unwrap();
        assert_near(
            torques(&there, joints, rates, accelerations),
            torques(&here, joints, rates, accelerations),
            1e-8,
        );
    }
}
