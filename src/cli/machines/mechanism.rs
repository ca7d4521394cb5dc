//! How a machine's axes carry its flange, for people and for programs.

use super::{DEGREES, row};
use serde_json::{Value, json};
use vcutc_backend_api::geometry::Frame;
use vcutc_diagnostics::number::rounded;
use vcutc_machine::kinematics::Mechanism;
use vcutc_machine::kinematics::five_axis::{Arrangement, Direction, FiveAxis, Rotary, SpindleSense};
use vcutc_machine::kinematics::mounted::Mounted;
use vcutc_machine::kinematics::opw::{Coupling, Opw};
use vcutc_machine::kinematics::pose::Pose;
use vcutc_machine::kinematics::serial::SerialArm;

/// A few indented lines.
pub(super) fn text(mechanism: &Mechanism) -> String {
    match mechanism {
        Mechanism::OrthoParallel(arm) => arm_text(arm),
        Mechanism::Mounted(mounted) => mounted_text(mounted),
        Mechanism::Serial(arm) => serial_text(arm),
        Mechanism::FiveAxis(machine) => five_axis_text(machine),
    }
}

/// An object whose `form` says what the other keys are.
pub(super) fn in_json(mechanism: &Mechanism) -> Value {
    match mechanism {
        Mechanism::OrthoParallel(arm) => arm_in_json(arm),
        Mechanism::Mounted(mounted) => mounted_in_json(mounted),
        Mechanism::Serial(arm) => serial_in_json(arm),
        Mechanism::FiveAxis(machine) => five_axis_in_json(machine),
    }
}

fn degrees(angles: &[f64; 6]) -> [f64; 6] {
    angles.map(|angle| DEGREES.of(angle))
}

fn arm_text(arm: &Opw) -> String {
    let Opw {
        a1,
        a2,
        b,
        c1,
        c2,
        c3,
        c4,
        offsets,
        signs,
        coupling,
    } = arm;
    let third = match coupling {
        Coupling::Serial => "the angle at the elbow",
        Coupling::Parallelogram => "the inclination of the forearm; the angle at the elbow is J3 - J2",
    };
    format!(
        "  ortho-parallel arm with spherical wrist (Brandstötter, Angerer, Hofbaur 2014)\n    \
         lengths in mm   a1 {a1}  a2 {a2}  b {b}  c1 {c1}  c2 {c2}  c3 {c3}  c4 {c4}\n    \
         zero offsets    {} deg\n    \
         senses          {}\n    \
         axis 3 counts   {third}\n",
        row(&degrees(offsets)),
        row(signs)
    )
}

fn arm_in_json(arm: &Opw) -> Value {
    json!({
        "form": "ortho_parallel",
        "a1_mm": arm.a1,
        "a2_mm": arm.a2,
        "b_mm": arm.b,
        "c1_mm": arm.c1,
        "c2_mm": arm.c2,
        "c3_mm": arm.c3,
        "c4_mm": arm.c4,
        "joint_offsets_deg": degrees(&arm.offsets),
        "joint_signs": arm.signs,
        "j2_j3_parallelogram": arm.coupling == Coupling::Parallelogram,
    })
}

fn mounted_text(mounted: &Mounted) -> String {
    arm_text(&mounted.arm)
        + &format!(
            "    foot in root    {}\n    flange in hand  {}\n",
            pose_text(&mounted.foot_in_root),
            pose_text(&mounted.flange_in_hand)
        )
}

fn mounted_in_json(mounted: &Mounted) -> Value {
    let mut object = arm_in_json(&mounted.arm);
    object["foot_in_root"] = pose_in_json(&mounted.foot_in_root);
    object["flange_in_hand"] = pose_in_json(&mounted.flange_in_hand);
    object
}

fn serial_text(arm: &SerialArm) -> String {
    let mut text = String::from("  serial arm, its axes with all joints at zero, from the foot outwards\n");
    for axis in arm.axes() {
        text += &format!(
            "    through {} mm about {}\n",
            row(&all_rounded(axis.point.to_array())),
            row(&all_rounded(axis.direction.to_array()))
        );
    }
    text + &format!("    flange at zero  {}\n", pose_text(arm.flange_at_zero()))
}

fn serial_in_json(arm: &SerialArm) -> Value {
    let axes = arm.axes().map(|axis| {
        json!({
            "point_mm": axis.point.to_array(),
            "direction": axis.direction.to_array(),
        })
    });
    json!({
        "form": "serial",
        "axes": axes,
        "flange_at_zero": pose_in_json(arm.flange_at_zero()),
    })
}

fn pose_text(pose: &Pose) -> String {
    let [w, x, y, z] = Frame::from(*pose).orientation.quaternion();
    let (position, quaternion) = (all_rounded(pose.position.to_array()), all_rounded([w, x, y, z]));
    format!("{} mm, quaternion {}", row(&position), row(&quaternion))
}

/// To nine decimals, more than descriptions have: what lies beyond is rounding of their right angles.
fn all_rounded<const N: usize>(numbers: [f64; N]) -> [f64; N] {
    numbers.map(|number| rounded(number, 1e9))
}

fn pose_in_json(pose: &Pose) -> Value {
    json!({
        "position_mm": pose.position.to_array(),
        "quaternion_wxyz": Frame::from(*pose).orientation.quaternion(),
    })
}

/// The rotary axes in the order of the machine's axes, each with what it turns.
fn rotary_axes(machine: &FiveAxis) -> [(&'static str, Rotary); 2] {
    match machine.arrangement() {
        Arrangement::HeadHead([outer, inner]) => [("head", outer), ("head", inner)],
        Arrangement::HeadTable { head, table } => [("head", head), ("table", table)],
        Arrangement::TableTable([outer, inner]) => [("table", outer), ("table", inner)],
    }
}

const fn direction_word(direction: Direction) -> &'static str {
    match direction {
        Direction::PlusX => "+X",
        Direction::MinusX => "-X",
        Direction::PlusY => "+Y",
        Direction::MinusY => "-Y",
        Direction::PlusZ => "+Z",
        Direction::MinusZ => "-Z",
    }
}

const fn spindle_word(sense: SpindleSense) -> &'static str {
    match sense {
        SpindleSense::PlusZ => "+Z",
        SpindleSense::MinusZ => "-Z",
    }
}

fn five_axis_text(machine: &FiveAxis) -> String {
    let mut text = String::from("  five-axis machine, rotary axes in the order of the list above\n");
    for (carried, axis) in rotary_axes(machine) {
        text += &format!(
            "    turns the {carried} about {} through {} mm\n",
            direction_word(axis.about),
            row(&axis.centre.to_array())
        );
    }
    text + &match machine.spindle() {
        Some(sense) => format!("    orientable spindle about {}\n", spindle_word(sense)),
        None => "    no orientable spindle: the plane of the blade follows from its direction\n".to_owned(),
    }
}

fn five_axis_in_json(machine: &FiveAxis) -> Value {
    let rotary: Vec<Value> = rotary_axes(machine)
        .iter()
        .map(|(carried, axis)| {
            json!({
                "turns": carried,
                "about": direction_word(axis.about),
                "centre_mm": axis.centre.to_array(),
            })
        })
        .collect();
    json!({
        "form": "five_axis",
        "rotary": rotary,
        "spindle": machine.spindle().map(spindle_word),
    })
}
