//! Robots described by URDF, the Unified Robot Description Format of ROS.
//!
//! A URDF is a tree of links joined by joints. Of it the chain from the robot's root to its flange is read, which must have
//! six turning joints; fixed joints in between are folded into them. All else (shapes, masses, transmissions, a second arm
//! that hangs on another branch) is left alone.
//!
//! **Ends.** The flange is the link `tool0`, else the link `flange`, as ROS-Industrial names them (REP 199), else the one
//! leaf of the tree that moves. The root is the link `base` where it is fixed to the root of the tree, because that is the
//! frame which the robot's controller counts from; else it is the root of the tree.
//!
//! **Numbers.** URDF counts in m and rad; here they become mm. Origins are `xyz` and `rpy`, roll, pitch and yaw about fixed
//! axes: `Rz(yaw) Ry(pitch) Rx(roll)`. A `continuous` joint has no end; its cables have, so it gets a turn either way.
//!
//! An arm that is ortho-parallel with a spherical wrist gets its closed form ([`recognise`]), others are solved by
//! [`crate::kinematics::newton`].

mod elements;
#[cfg(test)]
mod tests;
mod tree;

use super::LimitPlaces;
use super::Model;
use super::path_limits::PathLimits;
use crate::kinematics::pose::Pose;
use crate::kinematics::serial::{JointAxis, SerialArm};
use crate::kinematics::{Mechanism, recognise};
use elements::{Kind, MovingJoint};
use glam::DVec3;
use tree::Tree;
use vcutc_backend_api::ir::{Axis, AxisKind, MOST_AXES, Maker};
use vcutc_diagnostics::document::flaw::Flaw;

/// Most flaws that are told of one file.
const MOST_FLAWS: usize = 20;

/// Which link of a URDF the flange is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Flange<'a> {
    /// `tool0`, else `flange`, else the only leaf that moves.
    ByConvention,
    /// The link of this name.
    Link(&'a str),
}

/// Reads a robot of six turning joints. `name` is what the job calls it.
///
/// # Errors
/// What is wrong with the description, in the order of the text; at most 20 flaws.
pub fn parse(name: &str, text: &str, flange: Flange<'_>) -> Result<Model, Vec<Flaw>> {
    read(name, text, flange).map_err(|mut flaws| {
        flaws.sort_by_key(|flaw| (flaw.span.start, flaw.span.end));
        flaws.truncate(MOST_FLAWS);
        flaws
    })
}

fn read(name: &str, text: &str, flange: Flange<'_>) -> Result<Model, Vec<Flaw>> {
    let document = elements::document(text).map_err(|flaw| vec![flaw])?;
    let tree = Tree::of(&document)?;
    let flange = tree.flange(flange).map_err(|flaw| vec![flaw])?;
    let root_in_tree = tree.controllers_root();
    let chain = Chain::along(&tree.chain(flange))?;
    let joints: [MovingJoint; MOST_AXES] = chain
        .joints
        .try_into()
        .map_err(|joints: Vec<MovingJoint>| vec![tree.wrong_number(flange, &joints)])?;
    let tree_in_root = root_in_tree.inverse();
    let axes = joints.each_ref().map(|joint| joint.axis.moved(&tree_in_root));
    let Some(arm) = SerialArm::new(axes, tree_in_root * chain.end_in_tree) else {
        return Err(vec![tree.too_far(flange)]);
    };
    Ok(Model {
        name: name.to_owned(),
        maker: Maker::Other,
        axes: joints.iter().map(axis).collect(),
        mechanism: recognise::closed_form(&arm).unwrap_or(Mechanism::Serial(arm)),
        path: PathLimits::UNKNOWN,
    })
}

fn axis(joint: &MovingJoint) -> Axis {
    Axis {
        name: joint.name.clone(),
        kind: AxisKind::Rotary,
        min: joint.limits.range.0,
        max: joint.limits.range.1,
        rate: joint.limits.rate,
        acceleration: None,
        jerk: None,
    }
}

/// Where a URDF states the limits of its axes; nowhere in one that cannot be read.
pub(super) fn limit_places(text: &str, axes: &[Axis]) -> Vec<LimitPlaces> {
    let Ok(document) = elements::document(text) else {
        return Vec::new();
    };
    let limit_of = |axis: &Axis| {
        let is_it = |node: &roxmltree::Node<'_, '_>| {
            node.has_tag_name("joint") && node.attribute("name") == Some(&axis.name)
        };
        let joint = document.descendants().find(is_it)?;
        joint.children().find(|child| child.has_tag_name("limit"))
    };
    let places = |axis: &Axis| {
        let limit = limit_of(axis);
        let value = |name: &str| Some(limit?.attribute_node(name)?.range_value());
        LimitPlaces {
            range: value("lower")
                .zip(value("upper"))
                .map(|(lower, upper)| lower.start.min(upper.start)..lower.end.max(upper.end)),
            rate: value("velocity"),
        }
    };
    axes.iter().map(places).collect()
}

/// A chain of joints, all at zero, from the root of the tree outwards.
struct Chain {
    joints: Vec<MovingJoint>,
    end_in_tree: Pose,
}

impl Chain {
    fn along(path: &[&elements::Joint<'_>]) -> Result<Self, Vec<Flaw>> {
        let mut flaws = Vec::new();
        let mut joints = Vec::new();
        let mut end_in_tree = Pose::IDENTITY;
        for joint in path {
            match joint.origin() {
                Ok(origin) => end_in_tree = end_in_tree * origin,
                Err(found) => flaws.extend(found),
            }
            match joint.kind {
                Kind::Fixed => {}
                Kind::Revolute | Kind::Continuous => match joint.moving(&end_in_tree) {
                    Ok(moving) => joints.push(moving),
                    Err(found) => flaws.extend(found),
                },
                Kind::Prismatic | Kind::Planar | Kind::Floating => flaws.push(joint.does_not_turn()),
            }
        }
        if flaws.is_empty() {
            Ok(Self { joints, end_in_tree })
        } else {
            Err(flaws)
        }
    }
}

/// A joint's axis in the tree, from the pose of the joint and the direction in it.
fn axis_in_tree(joint_in_tree: &Pose, direction: DVec3) -> JointAxis {
    JointAxis {
        point: joint_in_tree.position,
        direction: joint_in_tree.rotation * direction,
    }
}
