//! What `fk` and `ik` have found out, for people and for programs.

use super::{AT_LIMIT, margin};
use crate::cli::machines::{SCHEMA, axis_unit};
use serde_json::{Map, Value, json};
use vcutc_backend_api::confdata::confdata;
use vcutc_backend_api::geometry::Frame;
use vcutc_backend_api::ir::{Axis, AxisKind, AxisValues, Maker};
use vcutc_backend_api::motion::Branch;
use vcutc_backend_api::status::kuka_status;
use vcutc_diagnostics::number;
use vcutc_machine::Model;
use vcutc_machine::kinematics::configuration::{Border, borders, branch_words, kuka_turn};
use vcutc_machine::kinematics::{Joints, Mechanism};

/// Where axis values bring a machine.
pub(super) struct Reached<'m> {
    pub(super) model: &'m Model,
    /// What the pose is of and in.
    pub(super) pose_of: &'m str,
    pub(super) pose: Frame,
    pub(super) joints: Joints,
    /// How the machine stands, where that is known.
    pub(super) branch: Option<Branch>,
}

/// What brings a machine to a pose.
pub(super) struct Found<'m> {
    pub(super) model: &'m Model,
    /// What the pose is of and in.
    pub(super) pose_of: &'m str,
    pub(super) pose: Frame,
    pub(super) solutions: Vec<(Branch, Joints)>,
    /// By how much (rad) a five-axis machine leaves the blade plane turned.
    pub(super) blade_turned: Option<f64>,
}

/// Which ways to a pose are listed.
#[derive(Clone, Copy)]
pub(super) enum Shown {
    /// Those within the limits of all axes.
    WithinLimits,
    All,
}

impl Reached<'_> {
    pub(super) fn text(&self) -> String {
        let mut text = format!("{}: {}\n{}", self.model.name, self.pose_of, pose_text(&self.pose));
        if let Some(branch) = self.branch {
            let lines = stance(self.model, branch, &self.joints);
            let turns = turns(self.model, branch, &self.joints);
            text.extend(lines.into_iter().chain(turns).map(|line| format!("  {line}\n")));
        }
        for beyond in beyond_limits(self.model, &self.joints) {
            text += &format!("  outside of its limits: {beyond}\n");
        }
        text
    }

    pub(super) fn in_json(&self) -> Value {
        let mut value = json!({
            "kind": "fk",
            "schema": SCHEMA,
            "machine": self.model.name,
            "pose_of": self.pose_of,
            "pose": pose_in_json(&self.pose),
        });
        if let Some(object) = value.as_object_mut() {
            object.extend(set_in_json(self.model, self.branch, &self.joints));
        }
        value
    }
}

impl Found<'_> {
    pub(super) fn text(&self, shown: Shown) -> String {
        let is_within = |joints: &Joints| beyond_limits(self.model, joints).is_empty();
        let within = self
            .solutions
            .iter()
            .filter(|(_, joints)| is_within(joints))
            .count();
        let listed: Vec<_> = match shown {
            Shown::All => self.solutions.iter().collect(),
            Shown::WithinLimits => self
                .solutions
                .iter()
                .filter(|(_, joints)| is_within(joints))
                .collect(),
        };
        let mut text = format!("{}: {}\n{}", self.model.name, self.pose_of, pose_text(&self.pose));
        text += &match self.solutions.len() {
            0 => self.no_way(),
            1 => format!("\n1 set of axis values, {within} within the limits\n"),
            all => format!("\n{all} sets of axis values, {within} within the limits\n"),
        };
        if !listed.is_empty() {
            text += &heading(&self.model.axes);
        }
        let mut before = None;
        let left_out = self.solutions.len() - listed.len();
        for (branch, joints) in listed {
            if before != Some(*branch) {
                text += &format!("  {}\n", stance(self.model, *branch, joints).join("; "));
                before = Some(*branch);
            }
            text += &row(&self.model.axes, joints);
            let turns =
                turns(self.model, *branch, joints).map_or_else(String::new, |turns| format!("{turns}; "));
            text += &format!("   {turns}{}\n", limits_text(self.model, joints));
        }
        if left_out > 0 {
            text += &format!("{left_out} outside of the limits left out: --verbose lists them\n");
        }
        text
    }

    fn no_way(&self) -> String {
        let Some(turned) = self.blade_turned else {
            return "\nout of reach: no axis values bring it there\n".to_owned();
        };
        format!(
            "\nout of reach: the rotary axes point the blade there, but leave its plane turned by {} deg about it;\n\
             an orientable spindle would turn it (docs/machines_five_axis.md)\n",
            fixed(turned.abs().to_degrees(), 4)
        )
    }

    pub(super) fn in_json(&self) -> Value {
        let solutions: Vec<Value> = self
            .solutions
            .iter()
            .map(|(branch, joints)| Value::Object(set_in_json(self.model, Some(*branch), joints)))
            .collect();
        json!({
            "kind": "ik",
            "schema": SCHEMA,
            "machine": self.model.name,
            "pose_of": self.pose_of,
            "pose": pose_in_json(&self.pose),
            "blade_plane_turned_deg": self.blade_turned.map(f64::to_degrees),
            "solutions": solutions,
        })
    }
}

fn pose_text(pose: &Frame) -> String {
    let angles = pose.orientation.to_zyx();
    let [a, b, c] = [angles.a, angles.b, angles.c].map(|angle| fixed(angle.to_deg(), 4));
    let [x, y, z] = [pose.origin.x, pose.origin.y, pose.origin.z].map(|length| fixed(length, 4));
    let [w, i, j, k] = pose.orientation.quaternion().map(|part| fixed(part, 8));
    format!(
        "  x {x} mm, y {y} mm, z {z} mm\n  a {a} deg, b {b} deg, c {c} deg\n  quaternion {w}, {i}, {j}, {k}\n"
    )
}

fn pose_in_json(pose: &Frame) -> Value {
    let angles = pose.orientation.to_zyx();
    let place = [pose.origin.x, pose.origin.y, pose.origin.z].map(clean);
    let angles = [angles.a, angles.b, angles.c].map(|angle| clean(angle.to_deg()));
    json!({ "xyz_mm": place, "abc_deg": angles, "quat_wxyz": pose.orientation.quaternion() })
}

/// The names of the axes over their columns.
fn heading(axes: &[Axis]) -> String {
    let names: String = axes.iter().map(|axis| format!("{:>11}", axis.name)).collect();
    format!("{names}\n")
}

fn row(axes: &[Axis], joints: &Joints) -> String {
    let values: String = axes
        .iter()
        .zip(joints)
        .map(|(axis, value)| format!("{:>11}", fixed(axis_unit(axis).of(*value), 4)))
        .collect();
    values
}

/// How the machine stands: in words, and in the terms of its controller as far as turns do not matter.
fn stance(model: &Model, branch: Branch, joints: &Joints) -> Vec<String> {
    let mut words = vec![branch_words(branch)];
    if let Mechanism::OrthoParallel(arm) = &model.mechanism {
        let status = match model.maker {
            Maker::Kuka => kuka_status(branch),
            Maker::Abb | Maker::Other => None,
        };
        words.extend(status.map(|status| format!("S {status} ('B{status:03b}')")));
        words.extend(borders(arm, joints).map(|border| format!("on a boundary: {}", border_words(border))));
    }
    words
}

/// What distinguishes the turns of a way to stand, in the terms of the controller.
fn turns(model: &Model, branch: Branch, joints: &Joints) -> Option<String> {
    let Mechanism::OrthoParallel(_) = &model.mechanism else {
        return None;
    };
    match model.maker {
        Maker::Kuka => {
            let turn = kuka_turn(joints);
            Some(format!("T {turn} ('B{turn:06b}')"))
        }
        Maker::Abb => confdata(branch, &AxisValues(*joints))
            .map(|[cf1, cf4, cf6, cfx]| format!("confdata [{cf1},{cf4},{cf6},{cfx}]")),
        Maker::Other => None,
    }
}

const fn border_words(border: Border) -> &'static str {
    match border {
        Border::Shoulder => "the wrist is over axis 1",
        Border::Elbow => "the arm is stretched or folded",
        Border::Wrist => "axis 5 is at 0, so that of axes 4 and 6 only the sum counts",
    }
}

/// The axes that are beyond a limit, and by how much.
fn beyond_limits(model: &Model, joints: &Joints) -> Vec<String> {
    let pairs = model.axes.iter().zip(joints);
    pairs
        .map(|(axis, value)| (axis, margin(axis, *value)))
        .filter(|(_, margin)| *margin < -AT_LIMIT)
        .map(|(axis, margin)| format!("{} by {}", axis.name, with_unit(axis, -margin)))
        .collect()
}

/// What is outside of its limits, or how far the axis that is nearest to one is away from it.
fn limits_text(model: &Model, joints: &Joints) -> String {
    let beyond = beyond_limits(model, joints);
    if !beyond.is_empty() {
        return format!("outside of its limits: {}", beyond.join(", "));
    }
    // Axes are compared by the part of their range that is left.
    let part = |axis: &Axis, value: f64| margin(axis, value) / (axis.max - axis.min);
    let nearest = model
        .axes
        .iter()
        .zip(joints)
        .min_by(|a, b| part(a.0, *a.1).total_cmp(&part(b.0, *b.1)));
    nearest.map_or_else(String::new, |(axis, value)| {
        let margin = margin(axis, *value).max(0.0);
        format!(
            "nearest to a limit: {}, {} away",
            axis.name,
            with_unit(axis, margin)
        )
    })
}

/// A set of axis values: the values, how the machine stands, how far each axis is within its limits.
fn set_in_json(model: &Model, branch: Option<Branch>, joints: &Joints) -> Map<String, Value> {
    let numbers = |of: &dyn Fn(&Axis, f64) -> f64| -> Vec<f64> {
        let pairs = model.axes.iter().zip(joints);
        pairs
            .map(|(axis, value)| axis_unit(axis).of(of(axis, *value)))
            .collect()
    };
    let mut set = Map::new();
    let mut put = |key: &str, value: Value| set.insert(key.to_owned(), value);
    put("joints", json!(numbers(&|_, value| value)));
    put("margins", json!(numbers(&margin)));
    put("within_limits", json!(beyond_limits(model, joints).is_empty()));
    let (Some(branch), Mechanism::OrthoParallel(arm)) = (branch, &model.mechanism) else {
        return set;
    };
    put("stands", json!(branch_words(branch)));
    let on_borders: Vec<&str> = borders(arm, joints).map(border_words).collect();
    put("on_boundaries", json!(on_borders));
    match model.maker {
        Maker::Kuka => {
            put("status", json!(kuka_status(branch)));
            put("turn", json!(kuka_turn(joints)));
        }
        Maker::Abb => {
            put("confdata", json!(confdata(branch, &AxisValues(*joints))));
        }
        Maker::Other => {}
    }
    set
}

fn with_unit(axis: &Axis, value: f64) -> String {
    let unit = match axis.kind {
        AxisKind::Rotary => "deg",
        AxisKind::Linear => "mm",
    };
    format!("{} {unit}", fixed(axis_unit(axis).of(value), 4))
}

/// A number free of what computing has left in its last digits.
fn clean(value: f64) -> f64 {
    number::rounded(value, 1e9)
}

/// A number with up to so many decimals. What rounds to zero has no sign.
fn fixed(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" {
        "0".to_owned()
    } else {
        text.to_owned()
    }
}
