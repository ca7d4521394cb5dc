//! Joints of chains on five-axis machines.
//!
//! In the zone of a joint ([`crate::path::joint`]) each rotary axis is between the values that it has on the parts of both pieces
//! there, and no faster than on these. X, Y and Z are the difference of two points that are carried by one axis after the other. Let
//! axis `i` be away from its value at the joint by at most `c_i`, and the point that it carries off its place by `d_i`, of
//! which the tip is off by `2 b` at first. With its distance `r_i` from the axis at the joint, it is then off by
//! `d_i + c_i (r_i + d_i)` at most.
//!
//! The rates of X, Y and Z are linear in the velocity of the tip and in the rates of the rotary axes. At the joint they are
//! those of both pieces. Away from it directions are turned by at most `c = sum c_i`, that of the tip by the arc's bend in the
//! zone, too, and points are off by `d`. With `f` the greatest speed of the tip and `w_i` that of each rotary axis, rates
//! exceed those at the joint by no more than `f (c + k b) + sum w_i (d + c (r_i + d_i))` for each of both points.

use super::{Carried, Run};
use crate::path::around::Around;
use crate::path::through::{Through, zone};
use crate::path::types::{Course, Proof};
use crate::rig::Rig;
use glam::DVec3;
use vcutc_backend_api::motion::Branch;
use vcutc_geometry::number::Interval;
use vcutc_machine::kinematics::Joints;
use vcutc_machine::kinematics::five_axis::FiveAxis;

/// A piece at a joint.
struct Piece {
    /// How far each rotary axis goes in the zone, with its sign away from the joint.
    away: Joints,
    /// How fast each rotary axis is, in rad/s.
    rates: Joints,
    /// Speed of the tip, in mm/s.
    speed: f64,
    /// How much its direction turns in the zone, in rad.
    bends: f64,
    /// X, Y and Z a second at the joint: of the tip's way alone, and of the rotary axes alone.
    parts: [DVec3; 2],
}

/// What the axes do around a joint.
pub(in crate::path) fn reached(
    machine: &FiveAxis,
    rig: &Rig<'_>,
    through: &Through<'_>,
    branch: Branch,
    proof: &Proof,
) -> Option<Around> {
    let Through { before, after, blend } = through;
    let joint = proof.end;
    let far = machine.on_branch(&rig.flange_in_root(&after.to), branch, &joint)?;
    let pieces = [
        piece(machine, rig, before, [&proof.start, &joint], 1.0, *blend),
        piece(machine, rig, after, [&joint, &far], 0.0, *blend),
    ];
    let span = |axis: usize| {
        let [one, other] = pieces.each_ref().map(|piece| piece.away[axis]);
        Interval::exactly(0.0)
            .hull(Interval::exactly(one))
            .hull(Interval::exactly(other))
    };
    let most = |of: fn(&Piece) -> f64| pieces.iter().map(of).fold(0.0, f64::max);
    // Points at rest on what carries them, moved by the axes as far as they go.
    let to: Joints = core::array::from_fn(|axis| {
        let turns = if axis < 3 { 0.0 } else { span(axis).magnitude() };
        joint[axis] + turns
    });
    let still = Course {
        from: after.from,
        to: after.from,
        arc: None,
        duration: 1.0,
    };
    let turned: f64 = (3..to.len()).map(|axis| span(axis).magnitude()).sum();
    let fastest: Joints = core::array::from_fn(|axis| joint[axis] + most_rate(&pieces, axis));
    let moving = Run::new(machine, rig, &still, &joint, &fastest);
    let Run { by_work, by_head, .. } = Run::new(machine, rig, &still, &joint, &to);
    let (work, head) = (by_work.around(2.0 * blend), by_head.around(0.0));
    let away = work.away + head.away;
    let turns = work.slower(turned, &moving.by_work) + head.slower(turned, &moving.by_head);
    let beyond = most(|piece| piece.speed) * (turned + most(|piece| piece.bends)) + turns;
    let linear = |axis: usize| {
        let part = |kind: usize| {
            let of = pieces.iter().map(|piece| piece.parts[kind][axis].abs());
            of.fold(0.0, f64::max)
        };
        part(0) + part(1) + beyond
    };
    let around = Around {
        value: core::array::from_fn(|axis| {
            let here = Interval::exactly(joint[axis]);
            here + if axis < 3 {
                Interval::around(0.0, away)
            } else {
                span(axis)
            }
        }),
        rate: core::array::from_fn(|axis| {
            let most = if axis < 3 {
                linear(axis)
            } else {
                most_rate(&pieces, axis)
            };
            Interval::around(0.0, most)
        }),
    };
    Some(around)
}

fn most_rate(pieces: &[Piece; 2], axis: usize) -> f64 {
    pieces
        .iter()
        .map(|piece| piece.rates[axis].abs())
        .fold(0.0, f64::max)
}

/// `place` is that of the joint on the course, at its end or its beginning.
fn piece(
    machine: &FiveAxis,
    rig: &Rig<'_>,
    course: &Course,
    [start, end]: [&Joints; 2],
    place: f64,
    blend: f64,
) -> Piece {
    let length = course.arc.map_or_else(
        || course.from.position.distance(course.to.position),
        |arc| arc.length().to_mm(),
    );
    let share = zone(blend, length);
    let backwards = if place > 0.5 { -1.0 } else { 1.0 };
    let change: Joints = core::array::from_fn(|axis| if axis < 3 { 0.0 } else { end[axis] - start[axis] });
    let all = Run::new(machine, rig, course, start, end).at(place);
    let turned = core::array::from_fn(|axis| start[axis] + change[axis] * place);
    // The way of the tip alone, with the rotary axes where they are at the joint.
    let moved = Run::new(machine, rig, course, &turned, &turned).at(place);
    let [all, moved] = [all, moved].map(|look| DVec3::from_array(look.velocity) / course.duration);
    Piece {
        away: change.map(|change| change * share * backwards),
        rates: change.map(|change| change / course.duration),
        speed: length / course.duration,
        bends: course.arc.map_or(0.0, |arc| arc.sweep().to_rad() * share),
        parts: [moved, all - moved],
    }
}

/// What becomes of a carried point when what carries it turns a little.
struct Strayed {
    /// How far it is from where it was, at most.
    away: f64,
    /// How far it is from each rotary axis, at most, from the inside out.
    distances: Vec<f64>,
}

impl Strayed {
    /// By how much its rate may differ from that where it was, with directions turned by so much and axes at most as fast as in
    /// another run.
    fn slower(&self, turned: f64, moving: &Carried) -> f64 {
        let rates = moving.by.iter().zip(&self.distances);
        rates
            .map(|((.., rate), distance)| rate.abs() * (self.away + turned * distance))
            .sum()
    }
}

impl Carried {
    /// Where it gets to when each axis turns by no more than its change either way, and the point itself is off by so much.
    fn around(&self, off: f64) -> Strayed {
        let (mut point, mut away) = (self.way.at(0.0).at, off);
        let mut distances = Vec::with_capacity(self.by.len());
        for (rotary, value, change) in &self.by {
            let distance = rotary.about.vector().cross(point - rotary.centre).length() + away;
            away += change.abs() * distance;
            distances.push(distance);
            let turned = rotary.turned(*value);
            point = turned.rotation * point + turned.position;
        }
        Strayed { away, distances }
    }
}
