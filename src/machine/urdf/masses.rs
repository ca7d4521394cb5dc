//! What the axes of an arm carry: the masses of the links between them, and of all that is fixed to those.
//!
//! Beyond the flange nothing counts, because jobs state what the flange carries. Nothing is assumed either: where no link between
//! two axes has an `<inertial>`, or one hangs on a joint that moves by itself, the masses of the arm are not known.

use super::elements::{Kind, MovingJoint, Read, all};
use super::tree::Tree;
use crate::body::{Body, MILLIMETRES};
use crate::kinematics::pose::Pose;
use crate::masses::{self, Backing, Link, Masses, Torques};
use glam::{DMat3, DVec3};
use std::collections::BTreeSet;
use vcutc_backend_api::ir::MOST_AXES;

/// A link that an axis carries.
#[derive(Clone, Copy, Debug)]
pub(super) struct Carried<'t> {
    pub(super) link: &'t str,
    /// With all axes at zero.
    pub(super) link_in_tree: Pose,
}

/// The masses of an arm, in the controller's root; none where they are not known.
pub(super) fn masses(
    tree: &Tree<'_>,
    carried: &[Carried<'_>],
    flange: &str,
    tree_in_root: &Pose,
) -> Read<Option<Masses>> {
    // Weight pulls against z of the root, and that of a tree against its own z (REP 103).
    let leans = tree_in_root.rotation.z_axis.distance(DVec3::Z) > UPRIGHT;
    let search = Search {
        tree,
        way: tree.chain(flange).iter().map(|joint| joint.child.node).collect(),
        flange,
        massive: tree.with_mass(),
    };
    let bodies = all(carried.iter().map(|carried| {
        let bodies = search.fixed_to(*carried)?;
        Ok(bodies.map(|bodies| Body::joined(&bodies).moved(tree_in_root)))
    }))?;
    let links = (1..).zip(bodies).map(|(axis, body)| Some(link(axis, &body?)));
    let links: Option<Vec<Link>> = links.collect();
    Ok(links.filter(|_| !leans).map(|links| Masses {
        kind: kind(&links),
        backing: Backing::Published,
        covered: Vec::new(),
        note: None,
        sources: Vec::new(),
        total_mass: None,
        links,
    }))
}

/// By how much the root may lean: rounding of right angles.
const UPRIGHT: f64 = 1e-4;

/// A search for the masses that hang on an arm.
struct Search<'s, 't> {
    tree: &'s Tree<'t>,
    /// The links on the way to the flange.
    way: BTreeSet<&'t str>,
    flange: &'s str,
    /// The links that have a mass, or carry one.
    massive: BTreeSet<&'t str>,
}

impl<'t> Search<'_, 't> {
    /// All bodies that move with a link on the way to the flange, seen from the tree; none where they are not known.
    fn fixed_to(&self, carried: Carried<'t>) -> Read<Option<Vec<Body>>> {
        let (mut bodies, mut faults) = (Vec::new(), Vec::new());
        // Something light that is fixed to a link does not stand for the link.
        let (mut has_own, mut has_others) = (false, false);
        let mut open = vec![carried];
        while let Some(Carried { link, link_in_tree }) = open.pop() {
            match self.tree.body(link) {
                Ok(Some(body)) => {
                    has_own |= self.way.contains(link);
                    bodies.push(body.moved(&link_in_tree));
                }
                Ok(None) => {}
                Err(found) => faults.extend(found),
            }
            let joints = self.tree.joints_on(link).filter(|_| link != self.flange);
            for joint in joints {
                let next = joint.child.node;
                let is_on_way = self.way.contains(next);
                match joint.kind {
                    Kind::Fixed if is_on_way || self.massive.contains(next) => match joint.origin() {
                        Ok(origin) => open.push(Carried {
                            link: next,
                            link_in_tree: link_in_tree * origin,
                        }),
                        Err(found) => faults.extend(found),
                    },
                    Kind::Fixed => {}
                    _ => has_others |= !is_on_way && self.massive.contains(next),
                }
            }
        }
        if !faults.is_empty() {
            return Err(faults);
        }
        Ok((has_own && !has_others).then_some(bodies))
    }
}

fn link(axis: usize, body: &Body) -> Link {
    Link {
        name: masses::link_name(axis),
        mass: body.mass,
        centre_mm: body.centre * MILLIMETRES,
        inertia: body.inertia,
    }
}

/// Some descriptions have numbers that give the torques of the axes, but belong to no bodies.
fn kind(links: &[Link]) -> masses::Kind {
    let is_body = |link: &Link| {
        let has_mass = link.mass > 0.0 || link.inertia == DMat3::ZERO;
        has_mass && Body::from(link).is_possible()
    };
    if links.iter().all(is_body) {
        masses::Kind::Bodies
    } else {
        masses::Kind::Lumped
    }
}

/// What the drives give; none where one does not say.
pub(super) fn torques(joints: &[MovingJoint; MOST_AXES]) -> Option<Torques> {
    let [a, b, c, d, e, f] = joints.each_ref().map(|joint| joint.limits.torque);
    Some(Torques {
        limits: [a?, b?, c?, d?, e?, f?],
        backing: Backing::Published,
        sources: Vec::new(),
    })
}
