//! An arm as a chain of bodies, and the torques that move it.
//!
//! Torques are found by recursion along the chain and back (Newton-Euler [Luh 1980]), instead of from the matrices of [Ha 2019],
//! equations 19 to 27, which give the same. Each body has a frame whose origin lies on the axis of its joint, and whose axes are those of
//! the root when all joints are at zero: so all of its numbers are constants, and a joint is a turn about a constant axis.
//!
//! Signs: a torque is what the drive has to give, so it is positive where it turns the axis the way in which the controller counts.

use crate::body::{Body, MILLIMETRES};
use crate::vector::{Number, Turn, Vector, along, cross, cross_plain, dot_plain, sum, symmetric};
use glam::{DMat3, DVec3};
use vcutc_backend_api::ir::Load;
use vcutc_machine::Model;
use vcutc_machine::kinematics::linkage::Linkage;
use vcutc_machine::kinematics::opw::Coupling;
use vcutc_machine::kinematics::{Joints, Mechanism};

/// How many joints an arm has.
pub const JOINTS: usize = 6;

/// The acceleration of free fall, in m/s2: the standard value (ISO 80000-3).
const GRAVITY: f64 = 9.806_65;

/// An arm with masses, at the controller's axes.
#[derive(Clone, Debug, PartialEq)]
pub struct Arm {
    links: [Link; JOINTS],
    /// The acceleration that stands for its weight: up, in the root.
    rise: Vector<f64>,
    /// What the third axis counts. The masses of a parallelogram's crank and rod are left out.
    coupling: Coupling,
}

/// A body and the joint that carries it.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Link {
    axis: Vector<f64>,
    /// From the origin before it, in m.
    offset: Vector<f64>,
    mass: f64,
    /// Mass times centre, in kg m.
    moment: Vector<f64>,
    /// About the origin, in kg m2: xx, yy, zz, xy, xz, yz.
    inertia: [f64; 6],
}

/// Where an arm is and how it moves, at the controller's axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct State<N> {
    /// How far each joint has turned; see [`Arm::turns`].
    pub turns: [Turn<N>; JOINTS],
    /// In rad/s.
    pub rates: [N; JOINTS],
    /// In rad/s2.
    pub accelerations: [N; JOINTS],
}

impl Arm {
    /// The arm of a model, with what its flange carries. It stands upright: its weight pulls against z of its root.
    ///
    /// None where the masses of its links are not known, and for machines that are not arms.
    #[must_use]
    pub fn of(model: &Model, load: Option<Load>) -> Option<Self> {
        let links = model.masses.as_ref()?.carried()?;
        Self::new(&model.mechanism, links.map(Body::from), load, DVec3::Z * GRAVITY)
    }

    /// An arm whose bodies, from joint 1 on, are where they are with all joints at zero, in the root. `rise` is the acceleration that
    /// stands for their weight: up, in m/s2.
    ///
    /// None for a machine that is not an arm.
    #[must_use]
    pub fn new(
        mechanism: &Mechanism,
        bodies: [Body; JOINTS],
        load: Option<Load>,
        rise: DVec3,
    ) -> Option<Self> {
        let linkage = match mechanism {
            Mechanism::OrthoParallel(_) | Mechanism::Mounted(_) | Mechanism::Serial(_) => {
                Linkage::from(mechanism)
            }
            Mechanism::FiveAxis(_) => return None,
        };
        let carried = load.map(|load| {
            let flange = linkage.flange_at_zero;
            let centre = DVec3::from_array(load.centre.to_array());
            Body::point(
                load.mass.to_kg(),
                (flange.rotation * centre + flange.position) / MILLIMETRES,
            )
        });
        let joints: [_; JOINTS] = linkage.tool.as_slice().try_into().ok()?;
        let coupling = mechanism
            .ortho_parallel()
            .map_or(Coupling::Serial, |arm| arm.coupling);
        let mut before = DVec3::ZERO;
        let mut place = 0;
        let links = joints.map(|joint| {
            let origin = joint.line.point / MILLIMETRES;
            let own = bodies.get(place).into_iter();
            let load = carried.iter().filter(|_| place + 1 == JOINTS);
            let link = Link::new(joint.line.direction, [before, origin], own.chain(load));
            before = origin;
            place += 1;
            link
        });
        Some(Self {
            links,
            rise: rise.to_array(),
            coupling,
        })
    }

    /// By how much each joint has turned at these axis values, in rad.
    #[must_use]
    pub fn turns(&self, joints: &Joints) -> [Turn<f64>; JOINTS] {
        self.of_joints(*joints).map(Turn::by)
    }

    /// What hangs on each axis: its torques at rest, in Nm.
    #[must_use]
    pub fn weight(&self, joints: &Joints) -> [f64; JOINTS] {
        self.weight_after(self.turns(joints))
    }

    /// The same, where its joints have turned so.
    #[must_use]
    pub fn weight_after(&self, turns: [Turn<f64>; JOINTS]) -> [f64; JOINTS] {
        self.torques(&State {
            turns,
            rates: [0.0; JOINTS],
            accelerations: [0.0; JOINTS],
        })
    }

    /// What the drives have to give at the controller's axes, in Nm.
    #[must_use]
    #[inline]
    pub fn torques<N: Number>(&self, state: &State<N>) -> [N; JOINTS] {
        let rates = self.of_joints(state.rates);
        let accelerations = self.of_joints(state.accelerations);
        let mut needs = self.needs(&state.turns, rates, accelerations);
        // From the flange to the root each body carries all that come after it.
        for place in (1..JOINTS).rev() {
            let (link, turn) = (&self.links[place], state.turns[place]);
            let carried = needs[place].turned(turn, link);
            needs[place - 1].add(&carried);
        }
        self.at_axes(core::array::from_fn(|place| {
            dot_plain(needs[place].moment, self.links[place].axis)
        }))
    }

    /// What each body alone needs to move so.
    #[inline]
    fn needs<N: Number>(
        &self,
        turns: &[Turn<N>; JOINTS],
        rates: [N; JOINTS],
        accelerations: [N; JOINTS],
    ) -> [Wrench<N>; JOINTS] {
        let mut motion: Option<Motion<N>> = None;
        core::array::from_fn(|place| {
            let (link, turn) = (&self.links[place], turns[place]);
            let base = match &motion {
                Some(before) => before.turned(turn, link),
                // A root that rises pulls on its bodies as gravity does.
                None => Motion {
                    spin: [N::ZERO; 3],
                    spinning: [N::ZERO; 3],
                    rise: turn.back_plain(link.axis, self.rise),
                },
            };
            let own = base.with(link.axis, rates[place], accelerations[place]);
            let needs = own.needs(link);
            motion = Some(own);
            needs
        })
    }

    fn of_joints<N: Number>(&self, axes: [N; JOINTS]) -> [N; JOINTS] {
        match self.coupling {
            Coupling::Serial => axes,
            Coupling::Parallelogram => {
                let [a, b, c, d, e, f] = axes;
                [a, b, c - b, d, e, f]
            }
        }
    }

    /// Torques of joints as those of axes, by virtual work.
    fn at_axes<N: Number>(&self, joints: [N; JOINTS]) -> [N; JOINTS] {
        match self.coupling {
            Coupling::Serial => joints,
            Coupling::Parallelogram => {
                let [a, b, c, d, e, f] = joints;
                [a, b - c, c, d, e, f]
            }
        }
    }
}

impl Link {
    /// Bodies that a joint carries. The origins are that of the joint before, and its own.
    fn new<'b>(
        direction: DVec3,
        [before, origin]: [DVec3; 2],
        bodies: impl Iterator<Item = &'b Body>,
    ) -> Self {
        let (mut mass, mut moment, mut inertia) = (0.0, DVec3::ZERO, DMat3::ZERO);
        for body in bodies {
            mass += body.mass;
            moment += body.moment(origin);
            inertia += body.inertia_about(origin);
        }
        let [x, y, z] = [inertia.x_axis, inertia.y_axis, inertia.z_axis];
        Self {
            axis: direction.to_array(),
            offset: (origin - before).to_array(),
            mass,
            moment: moment.to_array(),
            inertia: [x.x, y.y, z.z, x.y, x.z, y.z],
        }
    }
}

/// How the frame of a body moves, seen from itself.
#[derive(Clone, Copy)]
struct Motion<N> {
    /// In rad/s.
    spin: Vector<N>,
    /// How that changes, in rad/s2.
    spinning: Vector<N>,
    /// The acceleration of the origin, with gravity, in m/s2.
    rise: Vector<N>,
}

impl<N: Number> Motion<N> {
    /// Of the frame at the next joint, as if that joint stood still.
    #[inline]
    fn turned(&self, turn: Turn<N>, link: &Link) -> Self {
        let Self { spin, spinning, rise } = *self;
        let round = cross(spin, cross_plain(spin, link.offset));
        let rise = sum(rise, sum(cross_plain(spinning, link.offset), round));
        Self {
            spin: turn.back(link.axis, spin),
            spinning: turn.back(link.axis, spinning),
            rise: turn.back(link.axis, rise),
        }
    }

    /// With the motion of the joint itself.
    #[inline]
    fn with(self, axis: Vector<f64>, rate: N, acceleration: N) -> Self {
        let own = along(axis, rate);
        Self {
            spin: sum(self.spin, own),
            spinning: sum(
                sum(self.spinning, along(axis, acceleration)),
                cross(self.spin, own),
            ),
            rise: self.rise,
        }
    }

    /// What a body needs to move so.
    #[inline]
    fn needs(&self, link: &Link) -> Wrench<N> {
        let Self { spin, spinning, rise } = *self;
        let round = cross(spin, cross_plain(spin, link.moment));
        let force = sum(
            rise.map(|part| part * link.mass),
            sum(cross_plain(spinning, link.moment), round),
        );
        let turning = symmetric(link.inertia, spinning);
        let gyration = cross(spin, symmetric(link.inertia, spin));
        let hanging = cross_plain(rise, link.moment).map(|part| -part);
        Wrench {
            force,
            moment: sum(sum(turning, gyration), hanging),
        }
    }
}

/// A force, in N, and a moment about the origin of a frame, in Nm, seen from that frame.
#[derive(Clone, Copy)]
struct Wrench<N> {
    force: Vector<N>,
    moment: Vector<N>,
}

impl<N: Number> Wrench<N> {
    /// The same about the origin before a joint, seen from the frame there.
    #[inline]
    fn turned(&self, turn: Turn<N>, link: &Link) -> Self {
        let force = turn.out(link.axis, self.force);
        let moment = turn.out(link.axis, self.moment);
        Self {
            force,
            moment: sum(moment, cross_plain(force, link.offset).map(|part| -part)),
        }
    }

    #[inline]
    fn add(&mut self, other: &Self) {
        self.force = sum(self.force, other.force);
        self.moment = sum(self.moment, other.moment);
    }
}

#[cfg(test)]
mod tests;
