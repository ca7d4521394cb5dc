//! URDF of real robots' dimensions, against chains of nalgebra and published numbers.

mod faults;
mod masses;

use super::{FileId, Flange, parse};
use crate::kinematics::recognise::FIT;
use crate::kinematics::samples::{pose, ur10e};
use crate::kinematics::{Joints, Mechanism};
use crate::{Model, catalogue};
use core::f64::consts::{FRAC_PI_2, PI, TAU};
use nalgebra::{Isometry3, Translation3, UnitQuaternion, UnitVector3, Vector3};
use proptest::prelude::*;
use std::fmt::Write;

/// A joint: name, kind, parent, child, `xyz` in m, `rpy`, axis.
type Row = (
    &'static str,
    &'static str,
    &'static str,
    &'static str,
    [f64; 3],
    [f64; 3],
    [f64; 3],
);

const NONE: [f64; 3] = [0.0; 3];
const QUARTER: f64 = FRAC_PI_2;

/// KUKA KR 210 R3100 ultra, its dimensions in the form of the ROS-Industrial packages.
const KR210: &[Row] = &[
    (
        "joint_a1",
        "revolute",
        "base_link",
        "link_1",
        [0.0, 0.0, 0.675],
        NONE,
        [0.0, 0.0, -1.0],
    ),
    (
        "joint_a2",
        "revolute",
        "link_1",
        "link_2",
        [0.35, 0.0, 0.0],
        NONE,
        [0.0, 1.0, 0.0],
    ),
    (
        "joint_a3",
        "revolute",
        "link_2",
        "link_3",
        [1.35, 0.0, 0.0],
        NONE,
        [0.0, 1.0, 0.0],
    ),
    (
        "joint_a4",
        "revolute",
        "link_3",
        "link_4",
        [0.0, 0.0, -0.041],
        NONE,
        [-1.0, 0.0, 0.0],
    ),
    (
        "joint_a5",
        "revolute",
        "link_4",
        "link_5",
        [1.4, 0.0, 0.0],
        NONE,
        [0.0, 1.0, 0.0],
    ),
    (
        "joint_a6",
        "revolute",
        "link_5",
        "link_6",
        [0.24, 0.0, 0.0],
        NONE,
        [-1.0, 0.0, 0.0],
    ),
    ("base_link-base", "fixed", "base_link", "base", NONE, NONE, NONE),
    (
        "joint_a6-tool0",
        "fixed",
        "link_6",
        "tool0",
        NONE,
        [0.0, QUARTER, 0.0],
        NONE,
    ),
];

/// ABB IRB 6640-185/2.80 likewise, its foot 1.2 m up a pedestal of the cell and its flange as `flange` (x outwards).
const IRB6640: &[Row] = &[
    (
        "pedestal",
        "fixed",
        "world",
        "base_link",
        [0.3, -0.2, 1.2],
        [0.0, 0.0, 0.4],
        NONE,
    ),
    (
        "joint_1",
        "revolute",
        "base_link",
        "link_1",
        [0.0, 0.0, 0.78],
        NONE,
        [0.0, 0.0, 1.0],
    ),
    (
        "joint_2",
        "revolute",
        "link_1",
        "link_2",
        [0.32, 0.0, 0.0],
        NONE,
        [0.0, 1.0, 0.0],
    ),
    (
        "joint_3",
        "revolute",
        "link_2",
        "link_3",
        [0.0, 0.0, 1.28],
        NONE,
        [0.0, 1.0, 0.0],
    ),
    (
        "joint_4",
        "revolute",
        "link_3",
        "link_4",
        [0.0, 0.0, 0.2],
        NONE,
        [1.0, 0.0, 0.0],
    ),
    (
        "joint_5",
        "revolute",
        "link_4",
        "link_5",
        [1.1425, 0.0, 0.0],
        NONE,
        [0.0, 1.0, 0.0],
    ),
    (
        "joint_6",
        "revolute",
        "link_5",
        "link_6",
        [0.2, 0.0, 0.0],
        NONE,
        [1.0, 0.0, 0.0],
    ),
    ("joint_6-flange", "fixed", "link_6", "flange", NONE, NONE, NONE),
];

/// Universal Robots UR10e, in the form of `ur_description`: its wrist is not spherical.
const UR10E: &[Row] = &[
    (
        "base_link-base",
        "fixed",
        "base_link",
        "base",
        NONE,
        [0.0, 0.0, PI],
        NONE,
    ),
    (
        "base_link-base_link_inertia",
        "fixed",
        "base_link",
        "base_link_inertia",
        NONE,
        [0.0, 0.0, PI],
        NONE,
    ),
    (
        "shoulder_pan_joint",
        "revolute",
        "base_link_inertia",
        "shoulder_link",
        [0.0, 0.0, 0.1807],
        NONE,
        [0.0, 0.0, 1.0],
    ),
    (
        "shoulder_lift_joint",
        "revolute",
        "shoulder_link",
        "upper_arm_link",
        NONE,
        [QUARTER, 0.0, 0.0],
        [0.0, 0.0, 1.0],
    ),
    (
        "elbow_joint",
        "revolute",
        "upper_arm_link",
        "forearm_link",
        [-0.6127, 0.0, 0.0],
        NONE,
        [0.0, 0.0, 1.0],
    ),
    (
        "wrist_1_joint",
        "revolute",
        "forearm_link",
        "wrist_1_link",
        [-0.57155, 0.0, 0.17415],
        NONE,
        [0.0, 0.0, 1.0],
    ),
    (
        "wrist_2_joint",
        "revolute",
        "wrist_1_link",
        "wrist_2_link",
        [0.0, -0.11985, 0.0],
        [QUARTER, 0.0, 0.0],
        [0.0, 0.0, 1.0],
    ),
    (
        "wrist_3_joint",
        "continuous",
        "wrist_2_link",
        "wrist_3_link",
        [0.0, 0.11655, 0.0],
        [QUARTER, PI, PI],
        [0.0, 0.0, 1.0],
    ),
    (
        "wrist_3-flange",
        "fixed",
        "wrist_3_link",
        "flange",
        NONE,
        [0.0, -QUARTER, -QUARTER],
        NONE,
    ),
    (
        "flange-tool0",
        "fixed",
        "flange",
        "tool0",
        NONE,
        [QUARTER, 0.0, QUARTER],
        NONE,
    ),
];

/// The text of a URDF, with what else real ones have.
fn text(rows: &[Row]) -> String {
    let mut text =
        String::from("<?xml version=\"1.0\" ?>\n<!-- written for tests -->\n<robot name=\"arm\">\n");
    let mut links = vec![];
    for (_, _, parent, child, ..) in rows {
        for link in [parent, child] {
            if !links.contains(link) {
                links.push(*link);
            }
        }
    }
    for link in links {
        let mesh = "<visual><geometry><mesh filename=\"package://arm/mesh.stl\"/></geometry></visual>";
        writeln!(text, "  <link name=\"{link}\">{mesh}</link>").expect("a string takes it");
    }
    for (name, kind, parent, child, xyz, rpy, axis) in rows {
        let triple = |[x, y, z]: &[f64; 3]| format!("{x} {y} {z}");
        let [xyz, rpy, axis] = [xyz, rpy, axis].map(triple);
        let moving = match *kind {
            "revolute" => format!(
                "\n    <axis xyz=\"{axis}\"/>\n    <limit effort=\"0\" lower=\"-3.0\" upper=\"3.1\" velocity=\"2.0\"/>"
            ),
            "continuous" => format!("\n    <axis xyz=\"{axis}\"/>"),
            _ => String::new(),
        };
        writeln!(
            text,
            "  <joint name=\"{name}\" type=\"{kind}\">\n    <origin xyz=\"{xyz}\" rpy=\"{rpy}\"/>\n    \
             <parent link=\"{parent}\"/>\n    <child link=\"{child}\"/>{moving}\n  </joint>"
        )
        .expect("a string takes it");
    }
    text + "  <transmission name=\"drive\"><type>any</type></transmission>\n</robot>\n"
}

/// The last link in the first of the rows, mm: the chain as URDF defines it.
fn chain(rows: &[Row], joints: &Joints) -> Isometry3<f64> {
    let mut end = Isometry3::identity();
    let mut turns = joints.iter();
    for (_, kind, _, _, [x, y, z], [roll, pitch, yaw], axis) in rows {
        let rotation = UnitQuaternion::from_euler_angles(*roll, *pitch, *yaw);
        end *= Translation3::new(x * 1000.0, y * 1000.0, z * 1000.0) * rotation;
        if *kind != "fixed" {
            let axis = UnitVector3::new_normalize(Vector3::from(*axis));
            end *= UnitQuaternion::from_axis_angle(&axis, *turns.next().expect("six joints"));
        }
    }
    end
}

fn model(rows: &[Row]) -> Model {
    parse("shop/arm.urdf", FileId::ALONE, &text(rows), Flange::ByConvention).expect("a good URDF")
}

/// The rows without those that lead off the way to the flange.
fn way(rows: &[Row]) -> Vec<Row> {
    rows.iter().filter(|row| row.3 != "base").copied().collect()
}

proptest! {
    #[test]
    fn poses_are_those_of_the_chain(joints in prop::array::uniform6(-3.1..3.1)) {
        for rows in [KR210, IRB6640] {
            let (apart, turned) = model(rows).mechanism.flange_in_root(&joints).apart(&pose(&chain(&way(rows), &joints)));
            prop_assert!(apart < 1e-8 && turned < 1e-11, "{apart} mm, {turned}");
        }
        // The controller of this one counts from a frame that is turned half round.
        let half_turn = Isometry3::rotation(Vector3::new(0.0, 0.0, PI));
        let wanted = half_turn * chain(&way(UR10E), &joints);
        let (apart, turned) = model(UR10E).mechanism.flange_in_root(&joints).apart(&pose(&wanted));
        prop_assert!(apart < 1e-8 && turned < 1e-11, "{apart} mm, {turned}");
    }

    /// What its maker publishes are Denavit-Hartenberg numbers, another way to write the same arm.
    #[test]
    fn the_ur10e_stands_as_its_maker_says(joints in prop::array::uniform6(-3.1..3.1)) {
        let (apart, turned) = model(UR10E).mechanism.flange_in_root(&joints).apart(&ur10e().forward(&joints));
        prop_assert!(apart < 1e-8 && turned < 1e-11, "{apart} mm, {turned}");
    }
}

#[test]
fn a_kuka_is_the_one_of_the_catalogue() {
    let Mechanism::OrthoParallel(found) = model(KR210).mechanism else {
        panic!("it needs no mounting");
    };
    let catalogued = catalogue::find("kuka/kr210_r3100_ultra").expect("it is there");
    let Mechanism::OrthoParallel(wanted) = catalogued.mechanism else {
        panic!("it is ortho-parallel");
    };
    let lengths = |arm: &crate::kinematics::opw::Opw| [arm.a1, arm.a2, arm.b, arm.c1, arm.c2, arm.c3, arm.c4];
    for (found, wanted) in lengths(&found).iter().zip(lengths(&wanted)) {
        assert!((found - wanted).abs() < 1e-9, "{found} for {wanted}");
    }
    for (found, wanted) in found.offsets.iter().zip(wanted.offsets) {
        assert!((found - wanted).abs() < 1e-12, "{found} for {wanted}");
    }
    assert_eq!(found.signs, wanted.signs);
}

#[test]
fn an_arm_on_a_pedestal_keeps_its_closed_form() {
    let Mechanism::Mounted(found) = model(IRB6640).mechanism else {
        panic!("it stands on a pedestal");
    };
    assert!((found.arm.c2 - 1280.0).abs() < 1e-9 && (found.arm.c3 - 1142.5).abs() < 1e-9);
    assert!((found.arm.a2 + 200.0).abs() < 1e-9 && (found.arm.c4 - 200.0).abs() < 1e-9);
}

#[test]
fn names_limits_and_rates_are_kept() {
    let model = model(UR10E);
    assert_eq!(model.name, "shop/arm.urdf");
    assert!(matches!(model.mechanism, Mechanism::Serial(_)));
    let [first, .., last] = model.axes.as_slice() else {
        panic!("six axes");
    };
    assert_eq!(
        (first.name.as_str(), first.min, first.max, first.rate),
        ("shoulder_pan_joint", -3.0, 3.1, Some(2.0))
    );
    // A joint without end gets a turn either way.
    assert_eq!(
        (last.name.as_str(), last.min, last.max, last.rate),
        ("wrist_3_joint", -TAU, TAU, None)
    );
}

#[test]
fn rounded_right_angles_still_give_the_closed_form() {
    let rounded = text(KR210).replace("1.5707963267948966", "1.5708");
    let model = parse("arm", FileId::ALONE, &rounded, Flange::ByConvention).expect("a good URDF");
    let joints = [0.4, -1.2, 1.4, -0.6, 1.1, 0.3];
    let (apart, _) = model
        .mechanism
        .flange_in_root(&joints)
        .apart(&pose(&chain(&way(KR210), &joints)));
    assert!(model.mechanism.ortho_parallel().is_some() && apart <= FIT.0);
}

#[test]
fn the_flange_can_be_named() {
    let all_to = |link| parse("arm", FileId::ALONE, &text(UR10E), Flange::Link(link)).expect("a good URDF");
    let joints = [0.4, -1.2, 1.4, -0.6, 1.1, 0.3];
    let [flange, tool0] = ["flange", "tool0"].map(|link| all_to(link).mechanism.flange_in_root(&joints));
    assert!(flange.position.distance(tool0.position) < 1e-9);
    assert!(flange.apart(&tool0).1 > 1.0);
    let unknown =
        parse("arm", FileId::ALONE, &text(UR10E), Flange::Link("tool1")).expect_err("there is none");
    assert_eq!(unknown[0].message, "the file has no link `tool1`");
}
