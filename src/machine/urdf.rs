//! Robots described by URDF, the Unified Robot Description Format of ROS.
//!
//! A URDF is a tree of links joined by joints. Of it the chain from the robot's root to its flange is read, which must have
//! six turning joints; fixed joints in between are folded into them. Of other branches the masses are read that hang on it;
//! all else (shapes, transmissions, a second arm) is left alone.
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
mod inertial;
mod masses;
#[cfg(test)]
mod tests;
mod tree;

use super::LimitPlaces;
use super::Model;
use super::path_limits::PathLimits;
use super::payload::Payload;
use crate::kinematics::pose::Pose;
use crate::kinematics::serial::SerialArm;
use crate::kinematics::{Mechanism, recognise};
use elements::{Kind, MovingJoint, Read};
use masses::Carried;
use tree::Tree;
use vcutc_backend_api::ir::{Axis, AxisKind, MOST_AXES, Maker};
use vcutc_diagnostics::source::{FileId, Span};

/// Most faults of one file that are reported.
const MOST_FAULTS: usize = 20;

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
/// What is wrong with the description, in the order of the text; at most 20 faults.
pub fn parse(name: &str, file: FileId, text: &str, flange: Flange<'_>) -> Read<Model> {
    read(name, file, text, flange).map_err(|mut faults| {
        faults.sort_by_key(|fault| fault.primary.span);
        faults.truncate(MOST_FAULTS);
        faults
    })
}

fn read(name: &str, file: FileId, text: &str, flange: Flange<'_>) -> Read<Model> {
    let document = elements::document(file, text)?;
    let tree = Tree::of(file, &document)?;
    let flange = tree.flange(flange)?;
    let root_in_tree = tree.controllers_root();
    let chain = Chain::along(&tree.chain(flange))?;
    let joints: [MovingJoint; MOST_AXES] = chain
        .joints
        .try_into()
        .map_err(|joints: Vec<MovingJoint>| vec![tree.wrong_number(flange, &joints)])?;
    let tree_in_root = root_in_tree.inverse();
    let masses = masses::masses(&tree, &chain.carried, flange, &tree_in_root)?;
    let torques = masses::torques(&joints);
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
        payload: Payload::default(),
        masses,
        torques,
        elasticity: None,
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
pub(super) fn limit_places(file: FileId, text: &str, axes: &[Axis]) -> Vec<LimitPlaces> {
    let Ok(document) = elements::document(file, text) else {
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
        let span = |bytes| Span::of_bytes(file, bytes);
        LimitPlaces {
            range: value("lower")
                .zip(value("upper"))
                .map(|(lower, upper)| span(lower.start.min(upper.start)..lower.end.max(upper.end))),
            rate: value("velocity").map(span),
        }
    };
    axes.iter().map(places).collect()
}

/// A chain of joints, all at zero, from the root of the tree outwards.
struct Chain<'t> {
    joints: Vec<MovingJoint>,
    /// What each of them carries.
    carried: Vec<Carried<'t>>,
    end_in_tree: Pose,
}

impl<'t> Chain<'t> {
    fn along(path: &[&elements::Joint<'t>]) -> Read<Self> {
        let mut faults = Vec::new();
        let (mut joints, mut carried) = (Vec::new(), Vec::new());
        let mut end_in_tree = Pose::IDENTITY;
        for joint in path {
            match joint.origin() {
                Ok(origin) => end_in_tree = end_in_tree * origin,
                Err(found) => faults.extend(found),
            }
            match joint.kind {
                Kind::Fixed => {}
                Kind::Revolute | Kind::Continuous => match joint.moving(&end_in_tree) {
                    Ok(moving) => {
                        joints.push(moving);
                        carried.push(Carried {
                            link: joint.child.node,
                            link_in_tree: end_in_tree,
                        });
                    }
                    Err(found) => faults.extend(found),
                },
                Kind::Prismatic | Kind::Planar | Kind::Floating => faults.push(joint.does_not_turn()),
            }
        }
        if faults.is_empty() {
            Ok(Self {
                joints,
                carried,
                end_in_tree,
            })
        } else {
            Err(faults)
        }
    }
}
