//! How the work pushes a blade.
//!
//! All directions are seen from the hand. They stay the same along a straight cut; on others they are those in the middle of a part of
//! it, and what they are off by there is bounded.

mod entry;
mod loaded;
mod round;

use crate::chain::{Column, JOINTS};
use crate::springs::Springs;
use crate::vector::{Number, Vector};
use glam::{DMat3, DVec3};
use vcutc_backend_api::units::{Angle, Length};
use vcutc_geometry::number::{Along, Interval};
use vcutc_job::forces::{EdgeForces, EdgeParts};
use vcutc_machine::body::MILLIMETRES;

/// A plane that rises less than this across the work is upright: it has no upper side.
const UPRIGHT: f64 = 1e-6;

/// The blade in a cut: how it is held, and which way its tip goes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Posture {
    /// The blade frame T in the work.
    pub(crate) blade_in_work: DMat3,
    /// T in the hand.
    pub(crate) blade_in_hand: DMat3,
    /// Which way its tip goes in the work, of length 1.
    pub(crate) way: DVec3,
    /// How far that way and the blade are turned away from this at most.
    pub(crate) turns: Angle,
}

impl Posture {
    /// Which share of its way the tip goes across the tool axis.
    pub(crate) fn across(&self) -> f64 {
        self.blade_in_work.z_axis.cross(self.way).length()
    }
}

/// What pushes an edge that is in the material up to a length of it. The teeth of a crusher are taken as such an edge along its axis, and
/// the rim of a disc as one of no length about its centre.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Push {
    /// The length, in m.
    edge: f64,
    /// From the tip along the edge.
    along_edge: Vector<f64>,
    /// The normal of the blade's plane, into the waste.
    pub(crate) normal: Vector<f64>,
    pub(crate) sides: Sides,
    spread_along: SpreadAlong,
    /// Against the way, of teeth along it.
    drag: Force,
    axial: Force,
    side: Force,
    /// How far the way of the tip may be off its direction, in rad.
    turns: f64,
    moment: Moment,
}

/// What turns a blade about its tip on top of the forces along its edge, in Nm.
#[derive(Clone, Copy, Debug)]
struct Moment {
    /// The largest one, about any axis.
    most: f64,
    /// As the forces were measured, seen from the hand; none where it is not known at which places of a rim they act.
    stated: Option<Vector<f64>>,
}

impl Moment {
    /// All forces act on the edge.
    const NONE: Self = Self {
        most: 0.0,
        stated: Some([0.0; 3]),
    };
}

/// How a force is spread along the edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum SpreadAlong {
    /// All parts alike, wherever some of the edge is in the material.
    Evenly,
    /// Each part in its own way, and in both directions at a time.
    Anyhow,
}

/// On which sides of the blade's plane the part may be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Sides {
    /// Against the normal.
    Known,
    /// On either: the plane is upright.
    Either,
}

/// A part of a force, in N: of all the edge, and at the tip.
#[derive(Clone, Copy, Debug)]
struct Force {
    direction: Vector<f64>,
    edge: Amount,
    tip: Amount,
}

/// So much, and so much more or less.
#[derive(Clone, Copy, Debug)]
struct Amount {
    /// As it was measured.
    stated: f64,
    centre: f64,
    off: f64,
}

impl Force {
    fn any(&self) -> Interval {
        self.edge.any() + self.tip.any()
    }

    fn most(&self) -> f64 {
        self.any().magnitude()
    }
}

impl Amount {
    fn of(force: f64, spread: f64) -> Self {
        Self {
            stated: force,
            centre: force,
            off: force * spread,
        }
    }

    /// The same in either direction.
    fn either_way(self) -> Self {
        Self {
            stated: 0.0,
            centre: 0.0,
            off: self.any().magnitude(),
        }
    }

    fn any(self) -> Interval {
        Interval::around(self.centre, self.off)
    }
}

/// A displacement along the normal of an edge, in m: positive into the waste.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shift {
    /// At the tip.
    pub tip: f64,
    /// At the end of the edge that is in the material.
    pub end: f64,
}

impl Push {
    /// The push on a blade whose edge has these forces, with up to a length of it in the material.
    pub(crate) fn on_edge(forces: &EdgeForces, half_apex: Angle, length: Length, held: &Posture) -> Self {
        let work_in_blade = held.blade_in_work.transpose();
        let way = work_in_blade * held.way;
        let up = work_in_blade.z_axis;
        let into_waste = if up.y < 0.0 { -DVec3::Y } else { DVec3::Y };
        let sides = if up.y.abs() > held.turns.sin() + UPRIGHT {
            Sides::Known
        } else {
            Sides::Either
        };
        let leading = if way.x < 0.0 { -DVec3::X } else { DVec3::X };
        let (sine, cosine) = libm::sincos(half_apex.to_rad());
        let in_hand = |direction: DVec3| (held.blade_in_hand * direction).to_array();
        let EdgeParts { drag, axial, side } = forces.edge;
        let spread = forces.statement.spread.value;
        let force = |direction: DVec3, along: f64, tip: f64| Force {
            direction: in_hand(direction),
            edge: Amount::of(along * length.to_mm(), spread),
            tip: Amount::of(tip, spread),
        };
        let mut side = force(into_waste, side.to_n_per_mm(), forces.tip.side.to_n());
        if sides == Sides::Either {
            (side.edge, side.tip) = (side.edge.either_way(), side.tip.either_way());
        }
        Self {
            edge: length.to_mm() / MILLIMETRES,
            along_edge: in_hand(leading * sine - DVec3::Z * cosine),
            normal: in_hand(into_waste),
            sides,
            spread_along: SpreadAlong::Evenly,
            drag: force(-way, drag.to_n_per_mm(), forces.tip.drag.to_n()),
            axial: force(-DVec3::Z, axial.to_n_per_mm(), forces.tip.axial.to_n()),
            side,
            turns: held.turns.to_rad(),
            moment: Moment::NONE,
        }
    }

    const fn forces(&self) -> [&Force; 3] {
        [&self.drag, &self.axial, &self.side]
    }

    /// The force as it was measured, of the whole edge and the tip, seen from the hand, in N.
    pub(crate) fn stated(&self) -> DVec3 {
        let part =
            |force: &Force| DVec3::from_array(force.direction) * (force.edge.stated + force.tip.stated);
        self.forces().into_iter().map(part).sum()
    }

    /// The moment about the tip of the force as it was measured, seen from the hand, in Nm; none where it is not known at which places
    /// of a rim it acts.
    pub(crate) fn stated_moment(&self) -> Option<DVec3> {
        let on_edge = |force: &Force| DVec3::from_array(force.direction) * force.edge.stated;
        let edge: DVec3 = self.forces().into_iter().map(on_edge).sum();
        let middle = DVec3::from_array(self.along_edge) * (0.5 * self.edge);
        Some(middle.cross(edge) + DVec3::from_array(self.moment.stated?))
    }

    /// The largest moment about the tip that it may have, in Nm.
    pub(crate) fn largest_moment(&self) -> f64 {
        // Of a force that is the same all along an edge half of its length is the lever; else all of it may be at the end.
        let lever = match self.spread_along {
            SpreadAlong::Evenly => 0.5 * self.edge,
            SpreadAlong::Anyhow => self.edge,
        };
        let arm = DVec3::from_array(self.along_edge) * lever;
        let on_edge = |parts: [f64; 3]| {
            let each = parts.into_iter().zip(self.forces());
            let each = each.map(|(part, force)| DVec3::from_array(force.direction) * part);
            arm.cross(each.sum()).length()
        };
        let moments = corners(self.forces().map(|force| force.edge.any())).map(on_edge);
        // Where the directions of the forces are off, so is the moment.
        let off = self.turns * lever * self.largest_size();
        moments.fold(0.0, f64::max) + off + self.moment.most
    }

    /// The largest parts that it may have, in N: drag, axial and side.
    pub(crate) fn largest(&self) -> EdgeParts<f64> {
        let [drag, axial, side] = self.forces().map(Force::most);
        EdgeParts { drag, axial, side }
    }

    /// The largest size that it may have, in N.
    pub(crate) fn largest_size(&self) -> f64 {
        // A size is convex: it is largest where all parts are at an end.
        let sizes = corners(self.forces().map(Force::any)).map(|parts| {
            let each = parts.into_iter().zip(self.forces());
            let each = each.map(|(part, force)| DVec3::from_array(force.direction) * part);
            each.sum::<DVec3>().length()
        });
        sizes.fold(0.0, f64::max)
    }

    /// What a force pushes each axis with, in Nm for each N of it, where it acts so far up the edge.
    fn torques<N: Number>(
        &self,
        columns: &[Column<N>; JOINTS],
        direction: Vector<f64>,
        up: f64,
    ) -> [N; JOINTS] {
        let arm = DVec3::from_array(self.along_edge) * up;
        let moment = arm.cross(DVec3::from_array(direction)).to_array();
        columns.map(|column| column.of(direction, moment))
    }

    /// The same at the tip, and at the end of the edge.
    fn torques_at_ends<N: Number>(
        &self,
        columns: &[Column<N>; JOINTS],
        direction: Vector<f64>,
    ) -> [[N; JOINTS]; 2] {
        let arm = DVec3::from_array(self.along_edge) * self.edge;
        let moment = arm.cross(DVec3::from_array(direction)).to_array();
        let tip = columns.map(|column| column.of_force(direction));
        let end = core::array::from_fn(|axis| tip[axis] + columns[axis].of_moment(moment));
        [tip, end]
    }

    /// How each axis moves the tip and the end of the edge along the normal, in m/rad.
    pub(crate) fn normals<N: Number>(&self, columns: &[Column<N>; JOINTS]) -> [[N; JOINTS]; 2] {
        self.torques_at_ends(columns, self.normal)
    }

    /// What the force as it was measured pushes each axis with, in Nm.
    pub(crate) fn stated_torques(&self, columns: &[Column<f64>; JOINTS]) -> [f64; JOINTS] {
        let mut all = [0.0; JOINTS];
        for force in self.forces() {
            let tip = self.torques(columns, force.direction, 0.0);
            let edge = self.torques(columns, force.direction, 0.5 * self.edge);
            for (axis, torque) in all.iter_mut().enumerate() {
                *torque += force.tip.stated * tip[axis] + force.edge.stated * edge[axis];
            }
        }
        if let Some(moment) = self.moment.stated {
            for (torque, column) in all.iter_mut().zip(columns) {
                *torque += column.of_moment(moment);
            }
        }
        all
    }

    /// What the force as it was measured shifts the edge by, by each axis.
    pub(crate) fn shares(&self, columns: &[Column<f64>; JOINTS], springs: &Springs) -> [Shift; JOINTS] {
        let [tips, ends] = self.normals(columns);
        let torques = self.stated_torques(columns);
        core::array::from_fn(|axis| {
            let turned = springs.each()[axis].stated * torques[axis];
            Shift {
                tip: tips[axis] * turned,
                end: ends[axis] * turned,
            }
        })
    }

    /// All shifts of any place of the edge while no more than its length is in the material, in the middle of a part of a cut and
    /// everywhere on it. The forces and the springs may be anything within their spread.
    ///
    /// Whatever stretches of the edge are in the material, what pushes them amounts to one force somewhere on the edge, of at most
    /// the whole. The place `s` up the edge then shifts by `tip(s) + t edge(s, m)`, with a share `t` from 0 to 1 and the place `m` of that force,
    /// where `edge` is linear in `s` and in `m`: its extremes are at the ends of the edge.
    pub(crate) fn shifts(&self, columns: &[Column<Along>; JOINTS], springs: &Springs) -> [Interval; 2] {
        at_rest(self.shifts_at_ends(columns, springs))
    }

    /// As [`Push::shifts`], and while the edge comes in from rest ([`Push::entering`]).
    pub(crate) fn shifts_and_entering(
        &self,
        columns: &[Column<Along>; JOINTS],
        springs: &Springs,
    ) -> [[Interval; 2]; 2] {
        let by = self.shifts_at_ends(columns, springs);
        [at_rest(by), self.entering(by, columns, springs)]
    }

    /// As [`Push::loaded`], and while the edge comes in from rest ([`Push::entering`]).
    pub(crate) fn loaded_and_entering(
        &self,
        columns: &[Column<Along>; JOINTS],
        springs: &Springs,
    ) -> [[Interval; 2]; 2] {
        let by = self.shifts_at_ends(columns, springs);
        [self.loaded(columns, springs), self.entering(by, columns, springs)]
    }

    /// What the tip and the edge shift each end of the edge by.
    fn shifts_at_ends(&self, columns: &[Column<Along>; JOINTS], springs: &Springs) -> [[By; 2]; 2] {
        let pushes = self
            .forces()
            .map(|force| self.torques_at_ends(columns, force.direction));
        self.normals(columns).map(|normal| {
            let [tip, end] = [0, 1].map(|end| {
                let each = pushes.each_ref().map(|torques| &torques[end]);
                each.map(|torques| Yielded::of(&normal, torques, springs))
            });
            let shift = |amount: fn(&Force) -> Amount, yielded: &[Yielded; 3]| {
                let amounts = self.forces().map(amount);
                let turned = self.turned(columns, &normal, &amounts, springs);
                shift(&amounts, yielded, turned)
            };
            let by_tip = shift(|force| force.tip, &tip);
            let [near, far] = [&tip, &end].map(|yielded| shift(|force| force.edge, yielded));
            let edge = match self.spread_along {
                SpreadAlong::Evenly => core::array::from_fn(|view| near[view].hull(far[view])),
                SpreadAlong::Anyhow => {
                    let amounts = self.forces().map(|force| force.edge);
                    let turned = self.turned(columns, &normal, &amounts, springs);
                    let by_parts = core::array::from_fn(|view| by_parts(&amounts, &tip, &end, view));
                    let [middle, everywhere]: [Interval; 2] = by_parts;
                    [middle, everywhere + turned]
                }
            };
            let by_moment = self.shifts_by_moment(columns, &normal, springs);
            core::array::from_fn(|view| By {
                tip: by_tip[view],
                edge: edge[view] + by_moment[view],
            })
        })
    }

    /// What pushes the axes, in Nm, while no more of the edge than its length is in the material: where each of `views` looks on a part
    /// of a cut. As in [`Push::shifts`], the forces may be anything within their spread, at any stretch of the edge.
    pub(crate) fn on_axes<const V: usize>(
        &self,
        columns: &[Column<Along>; JOINTS],
        views: [fn(Along) -> Interval; V],
    ) -> [[Interval; JOINTS]; V] {
        let ends = self
            .forces()
            .map(|force| self.torques_at_ends(columns, force.direction));
        views.map(|view| {
            let sum = |amount: fn(&Force) -> Amount, end: usize, axis: usize| {
                let each = self.forces().into_iter().zip(&ends);
                let pushed = each.map(|(force, ends)| amount(force).any() * view(ends[end][axis]));
                pushed.fold(Interval::ZERO, |sum, next| sum + next)
            };
            core::array::from_fn(|axis| {
                let tip = sum(|force| force.tip, 0, axis);
                let edge = match self.spread_along {
                    SpreadAlong::Evenly => {
                        let [near, far] = [0, 1].map(|end| sum(|force| force.edge, end, axis));
                        near.hull(far)
                    }
                    SpreadAlong::Anyhow => {
                        let each = self.forces().into_iter().zip(&ends);
                        let pushed = each.map(|(force, ends)| {
                            let [near, far] = [0, 1].map(|end: usize| view(ends[end][axis]));
                            along_edge(force.edge.any(), near.hull(far))
                        });
                        pushed.fold(Interval::ZERO, |sum, next| sum + next)
                    }
                };
                let edge = edge + Interval::around(0.0, self.moment.most * columns[axis].turning(view));
                // In the air nothing pushes.
                Interval::ZERO.hull(tip).hull(edge).hull(tip + edge)
            })
        })
    }

    /// By how much more the axes may be pushed where the directions of the forces are off, in Nm.
    pub(crate) fn turned_on_axes(&self, columns: &[Column<Along>; JOINTS]) -> [Interval; JOINTS] {
        let largest: f64 = self.forces().into_iter().map(Force::most).sum();
        columns.map(|column| Interval::around(0.0, largest * self.turns * column.largest(self.edge)))
    }

    /// By how much torques at the axes shift the edge along the normal, at either end, in the middle of a part and everywhere on it.
    pub(crate) fn shifts_by(
        &self,
        torques: &[Along; JOINTS],
        columns: &[Column<Along>; JOINTS],
        springs: &Springs,
    ) -> [Interval; 2] {
        let ends = self.normals(columns).map(|normal| {
            let yielded = Yielded::of(&normal, torques, springs);
            let [middle, everywhere] = views(yielded.stated);
            [middle + yielded.off[0], everywhere + yielded.off[1]]
        });
        core::array::from_fn(|view| {
            let both = ends[0][view].hull(ends[1][view]);
            match self.sides {
                Sides::Known => both,
                Sides::Either => both.either_way(),
            }
        })
    }

    /// By how much the moment shifts a place along the normal, which the axes move so: in the middle of a part, and everywhere on it.
    fn shifts_by_moment(
        &self,
        columns: &[Column<Along>; JOINTS],
        normal: &[Along; JOINTS],
        springs: &Springs,
    ) -> [Interval; 2] {
        if self.moment.most == 0.0 {
            return [Interval::ZERO; 2];
        }
        let shifts = |view: fn(Along) -> Interval, turns: f64| {
            let each = columns.iter().zip(normal).zip(springs.each());
            let yields = each.map(|((column, normal), spring)| {
                // The normal may be off by a turn, and then moves with all of the place.
                let off = turns * column.largest(self.edge);
                let most = view(*normal).magnitude() + off;
                spring.any().magnitude() * most * column.turning(view)
            });
            Interval::around(0.0, self.moment.most * yields.sum::<f64>())
        };
        [shifts(Along::middle, 0.0), shifts(Along::value, self.turns)]
    }

    /// What the forces may add where their directions are off.
    fn turned(
        &self,
        columns: &[Column<Along>; JOINTS],
        normal: &[Along; JOINTS],
        amounts: &[Amount; 3],
        springs: &Springs,
    ) -> Interval {
        if self.turns == 0.0 {
            return Interval::ZERO;
        }
        let force: f64 = amounts.iter().map(|amount| amount.any().magnitude()).sum();
        let each = columns.iter().zip(normal).zip(springs.each());
        let yields = each.map(|((column, normal), spring)| {
            // A force of 1 N anywhere on the edge pushes the axis with no more than this, and no direction is off by more than the turn.
            let most = column.largest(self.edge);
            let normal = normal.value().magnitude();
            spring.any().magnitude() * most * (normal + self.turns * most)
        });
        // The normal is off as the forces are.
        Interval::around(0.0, 2.0 * force * self.turns * yields.sum::<f64>())
    }
}

/// All shifts of an edge whose ends shift so, view by view.
fn at_rest(by: [[By; 2]; 2]) -> [Interval; 2] {
    let [tip, end] = by.map(|views| views.map(|by| by.tip.hull(by.tip + by.edge)));
    // In the air nothing pushes.
    core::array::from_fn(|view| tip[view].hull(end[view]).hull(Interval::ZERO))
}

/// What shifts a place along the normal, in m.
#[derive(Clone, Copy)]
struct By {
    /// The force at the tip.
    tip: Interval,
    /// That of the whole edge, as if it acted anywhere on it.
    edge: Interval,
}

/// What parts come to when each is at one of its ends.
fn corners(parts: [Interval; 3]) -> impl Iterator<Item = [f64; 3]> {
    (0..8_u32).map(move |corner| {
        core::array::from_fn(|place| {
            if corner >> place & 1 == 0 {
                parts[place].low
            } else {
                parts[place].high
            }
        })
    })
}

/// What forces shift a place by that yields so for each N of them, and what they add where their directions are off: in the middle of
/// a part, and everywhere on it.
fn shift(amounts: &[Amount; 3], yielded: &[Yielded; 3], turned: Interval) -> [Interval; 2] {
    let mut stated = Along::constant(0.0);
    let mut off = [Interval::ZERO, turned];
    for (amount, yielded) in amounts.iter().zip(yielded) {
        stated = stated + yielded.stated * amount.centre;
        let (any, radius) = (amount.any(), Interval::around(0.0, amount.off));
        let each = yielded.off.into_iter().zip(views(yielded.stated));
        for (off, (softer, yields)) in off.iter_mut().zip(each) {
            *off = *off + any * softer + radius * yields;
        }
    }
    let [middle, everywhere] = views(stated);
    [middle + off[0], everywhere + off[1]]
}

/// What a part of a force does whose bits lie anywhere along an edge: of all bits that push one way and of all that push the other, together
/// no more than its ends, each bit with a lever within these.
fn along_edge(any: Interval, lever: Interval) -> Interval {
    let way = |amount: f64| Interval::ZERO.hull(lever.scaled(amount));
    way(any.high.max(0.0)) + way(any.low.min(0.0))
}

/// What parts of a force shift a place by whose bits lie anywhere between the tip and the end of the edge, which yield so.
fn by_parts(amounts: &[Amount; 3], tip: &[Yielded; 3], end: &[Yielded; 3], view: usize) -> Interval {
    let each = amounts.iter().zip(tip.iter().zip(end));
    let shifted = each.map(|(amount, (tip, end))| {
        let yields = |yielded: &Yielded| views(yielded.stated)[view] + yielded.off[view];
        along_edge(amount.any(), yields(tip).hull(yields(end)))
    });
    shifted.fold(Interval::ZERO, |sum, next| sum + next)
}

/// By how much torques at the axes shift a place along the normal.
struct Yielded {
    /// With the springs as they are stated.
    stated: Along,
    /// By how much it may differ from that: in the middle of a part, and everywhere on it.
    off: [Interval; 2],
}

impl Yielded {
    fn of(normal: &[Along; JOINTS], torques: &[Along; JOINTS], springs: &Springs) -> Self {
        let mut all = Self {
            stated: Along::constant(0.0),
            off: [Interval::ZERO; 2],
        };
        for ((spring, normal), torque) in springs.each().iter().zip(normal).zip(torques) {
            let each = *normal * *torque;
            all.stated = all.stated + each * spring.stated;
            for (off, each) in all.off.iter_mut().zip(views(each)) {
                *off = *off + spring.off * each;
            }
        }
        all
    }
}

/// In the middle of a part, and everywhere on it.
fn views(along: Along) -> [Interval; 2] {
    [along.middle(), along.value()]
}

#[cfg(test)]
pub(crate) mod tests;
