//! An arm as bodies on a chain of joints, and the torques that move it.
//!
//! Torques are found by recursion along the chain and back (Newton-Euler [Luh 1980]), instead of from the matrices of [Ha 2019],
//! equations 19 to 27, which give the same. Each body is seen from the frame of its joint
//! ([`crate::chain`]), so all of its numbers are constants.
//!
//! Signs: a torque is what the drive has to give, so it is positive where it turns the axis the way in which the controller counts.

pub use crate::chain::JOINTS;
use crate::chain::{Chain, Hinge};
use crate::turn::Turn;
use crate::vector::{Number, Vector, along, cross, cross_plain, dot_plain, sum, symmetric};
use glam::{DMat3, DVec3};
use vcutc_backend_api::ir::Load;
use vcutc_geometry::number::Along;
use vcutc_machine::Model;
use vcutc_machine::body::Body;
use vcutc_machine::kinematics::{Joints, Mechanism};

/// The acceleration of free fall, in m/s2: the standard value (ISO 80000-3).
const GRAVITY: f64 = 9.806_65;

/// An arm with masses, at the controller's axes.
#[derive(Clone, Debug, PartialEq)]
pub struct Arm {
    /// Of a parallelogram, crank and rod are left out.
    chain: Chain,
    links: [Link; JOINTS],
    /// The acceleration that stands for its weight: up, in the root.
    rise: Vector<f64>,
}

/// What a joint carries.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Link {
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
        let chain = Chain::of(mechanism)?;
        let carried = load.map(|load| {
            let flange = chain.flange_at_zero;
            Body::from(load).moved(&flange)
        });
        let links = core::array::from_fn(|place| {
            let load = carried.iter().filter(|_| place + 1 == JOINTS);
            Link::new(chain.origins[place], bodies.get(place).into_iter().chain(load))
        });
        Some(Self {
            chain,
            links,
            rise: rise.to_array(),
        })
    }

    /// The same arm where nothing weighs.
    #[must_use]
    pub fn weightless(&self) -> Self {
        Self {
            rise: [0.0; 3],
            ..self.clone()
        }
    }

    /// By how much each joint has turned at these axis values, in rad.
    #[must_use]
    pub fn turns(&self, joints: &Joints) -> [Turn<f64>; JOINTS] {
        self.chain.turns(joints)
    }

    /// The same along a part of a motion.
    #[must_use]
    pub fn turns_along(&self, axes: [Along; JOINTS]) -> [Turn<Along>; JOINTS] {
        self.chain.turns_along(axes)
    }

    /// What hangs on each axis: its torques at rest, in Nm.
    #[must_use]
    pub fn weight(&self, joints: &Joints) -> [f64; JOINTS] {
        self.weight_after(&self.turns(joints))
    }

    /// The same, where its joints have turned so.
    ///
    /// What hangs on a joint is the moment about its axis of the mass that it carries, at the centre of that. So a mass times its centre
    /// goes back along the chain, and the way up goes along it: three numbers each, where torques of motion take six and nine.
    #[must_use]
    #[inline]
    pub fn weight_after<N: Number>(&self, turns: &[Turn<N>; JOINTS]) -> [N; JOINTS] {
        let hinges = &self.chain.hinges;
        let mut rise: Option<Vector<N>> = None;
        let rises: [Vector<N>; JOINTS] = core::array::from_fn(|place| {
            let (axis, turn) = (hinges[place].axis, turns[place]);
            let here = match rise {
                Some(before) => turn.back(axis, before),
                None => turn.back_plain(axis, self.rise),
            };
            rise = Some(here);
            here
        });
        let last = JOINTS - 1;
        let (mut mass, mut carried) = (0.0, self.links[last].moment.map(N::plain));
        let mut weights = [N::zero(); JOINTS];
        for place in (0..JOINTS).rev() {
            if place < last {
                let (hinge, turn) = (&hinges[place + 1], turns[place + 1]);
                let beyond = if place + 1 == last {
                    turn.out_plain(hinge.axis, self.links[last].moment)
                } else {
                    turn.out(hinge.axis, carried)
                };
                let own = self.links[place].moment;
                carried =
                    core::array::from_fn(|part| beyond[part].plus(own[part] + mass * hinge.offset[part]));
            }
            mass += self.links[place].mass;
            weights[place] = hinges[place].axis.moment_of(rises[place], carried);
        }
        self.chain.at_axes(weights)
    }

    /// What the drives have to give at the controller's axes, in Nm.
    #[must_use]
    #[inline]
    pub fn torques<N: Number>(&self, state: &State<N>) -> [N; JOINTS] {
        let rates = self.chain.of_joints(state.rates);
        let accelerations = self.chain.of_joints(state.accelerations);
        let needs = self.needs(&state.turns, rates, accelerations);
        self.carried(&state.turns, needs)
    }

    /// The torques where each body alone needs this.
    #[inline]
    fn carried<N: Number>(&self, turns: &[Turn<N>; JOINTS], mut needs: [Wrench<N>; JOINTS]) -> [N; JOINTS] {
        let hinges = &self.chain.hinges;
        // From the flange to the root each body carries all that come after it.
        for place in (1..JOINTS).rev() {
            let carried = needs[place].turned(turns[place], &hinges[place]);
            needs[place - 1].add(&carried);
        }
        self.chain.at_axes(core::array::from_fn(|place| {
            dot_plain(needs[place].moment, hinges[place].axis.direction)
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
            let (hinge, turn) = (&self.chain.hinges[place], turns[place]);
            let base = match &motion {
                Some(before) => before.turned(turn, hinge),
                // A root that rises pulls on its bodies as gravity does.
                None => Motion {
                    spin: [N::zero(); 3],
                    spinning: [N::zero(); 3],
                    rise: turn.back_plain(hinge.axis, self.rise),
                },
            };
            let own = base.with(hinge.axis.direction, rates[place], accelerations[place]);
            let needs = own.needs(&self.links[place]);
            motion = Some(own);
            needs
        })
    }
}

impl Link {
    /// Bodies that a joint with this origin carries.
    fn new<'b>(origin: DVec3, bodies: impl Iterator<Item = &'b Body>) -> Self {
        let (mut mass, mut moment, mut inertia) = (0.0, DVec3::ZERO, DMat3::ZERO);
        for body in bodies {
            mass += body.mass;
            moment += body.moment(origin);
            inertia += body.inertia_about(origin);
        }
        let [x, y, z] = [inertia.x_axis, inertia.y_axis, inertia.z_axis];
        Self {
            mass,
            moment: moment.to_array(),
            inertia: [x.x, y.y, z.z, x.y, x.z, y.z],
        }
    }

    /// What it needs to rise so.
    #[inline]
    fn hanging<N: Number>(&self, rise: Vector<N>) -> Wrench<N> {
        Wrench {
            force: rise.map(|part| part * self.mass),
            moment: cross_plain(rise, self.moment).map(|part| -part),
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
    fn turned(&self, turn: Turn<N>, hinge: &Hinge) -> Self {
        let Self { spin, spinning, rise } = *self;
        let round = cross(spin, cross_plain(spin, hinge.offset));
        let rise = sum(rise, sum(cross_plain(spinning, hinge.offset), round));
        Self {
            spin: turn.back(hinge.axis, spin),
            spinning: turn.back(hinge.axis, spinning),
            rise: turn.back(hinge.axis, rise),
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
        let turning = symmetric(link.inertia, spinning);
        let gyration = cross(spin, symmetric(link.inertia, spin));
        let hanging = link.hanging(rise);
        Wrench {
            force: sum(hanging.force, sum(cross_plain(spinning, link.moment), round)),
            moment: sum(sum(turning, gyration), hanging.moment),
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
    fn turned(&self, turn: Turn<N>, hinge: &Hinge) -> Self {
        let force = turn.out(hinge.axis, self.force);
        let moment = turn.out(hinge.axis, self.moment);
        Self {
            force,
            moment: sum(moment, cross_plain(force, hinge.offset).map(|part| -part)),
        }
    }

    #[inline]
    fn add(&mut self, other: &Self) {
        self.force = sum(self.force, other.force);
        self.moment = sum(self.moment, other.moment);
    }
}

#[cfg(test)]
pub(crate) mod tests;
