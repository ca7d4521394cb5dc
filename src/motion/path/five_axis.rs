//! The path check of five-axis machines.
//!
//! A controller with tool-centre-point control (TCPM, G43.4, TRAORI) moves the tip on a straight line or an arc in the work while
//! **the rotary axes go each at a constant rate to their values at the end**. It does so unless the program asks it to interpolate the
//! orientation vector (ORIVECT), and it is what is proven here. Between two taught poses the blade is therefore not turned
//! about one fixed axis as a robot turns it. For cuts, approaches and retracts that makes no difference, since they keep
//! their orientation; travels and turns happen outside of the work.
//!
//! Rotary axes need little proof: linear in the part `s` of the course that is done, they are within their ranges when both
//! ends are. What has to be found is how far and how fast the linear axes move meanwhile. With the mount `M` turned by the
//! axes of the table and the nose `C` by those of the head,
//!
//! `xyz(s) = M(s) tip_in_root(s) - C(s) tip_in_nose`,
//!
//! two points that are carried by rotary axes at constant rates.
//!
//! **Proof.** Let a point `p` have at most the distance `r` from the centre of a rotary axis, and its first, second and third
//! derivatives at most the lengths `d1`, `d2`, `d3`. Carried by the axis at the rate `w` it is at `c + R(s)(p - c)` with
//! `|R'| = w`, `|R''| = w^2`, `|R'''| = w^3` (as operators), so by Leibniz its derivatives have at most the lengths
//!
//! - `d1 + w r`,
//! - `d2 + 2 w d1 + w^2 r`,
//! - `d3 + 3 w d2 + 3 w^2 d1 + w^3 r`.
//!
//! Starting with the tip on its line (`d1` its length, `d2 = d3 = 0`), or on an arc of the radius `R` that goes round by `a`
//! (`d1 = a R`, `d2 = a^2 R`, `d3 = a^3 R`), and going through the axes from the inside out gives
//! bounds `b2` and `b3` of second and third derivatives of all linear axes, on the whole course. Between two places that
//! are `w` apart a function keeps within `b2 w^2 / 8` of the straight line through its values there, and its derivative
//! within `b3 w^2 / 8` of the line through the derivatives (the error of linear interpolation). The course is divided until
//! what these bounds allow either lies within the limits, or a value that was computed lies outside of them. A violation
//! between two places that were looked at is thus never missed; a motion that keeps less than about [`FINEST`] from a limit
//! may be refused, when its bounds do not become fine enough.

pub(super) mod joint;

use super::types::{Breach, Clearance, Course, Proof, Violation};
use crate::rig::Rig;
use glam::DVec3;
use vcutc_backend_api::arc::CircularArc;
use vcutc_backend_api::ir::Axis;
use vcutc_backend_api::motion::Branch;
use vcutc_machine::kinematics::Joints;
use vcutc_machine::kinematics::five_axis::{FiveAxis, Rotary};
use vcutc_machine::kinematics::pose::Pose;

/// By how much an axis may be beyond its limit, in rad or mm (or a second): rounding.
const AT_LIMIT: f64 = 1e-9;
/// How far the blade may be from the start of a course, in mm and as Frobenius norm, with the axes at their start.
const SAME: (f64, f64) = (1e-6, 1e-7);
/// How much farther than computed values (mm) what is proven may reach, at places where limits do not ask for more.
const TIGHT: f64 = 1e-3;
/// The same for rates, in mm a second.
const TIGHT_RATE: f64 = 1e-2;
/// Parts of a course are not divided when their bounds are as near to computed values as this, in mm or mm a second.
const FINEST: f64 = 1e-7;
/// Most places of a course that are looked at.
const MOST_LOOKS: u32 = 1 << 16;

/// Proves that the axes follow a course on a branch, beginning at `start` (which must bring the blade to `course.from`),
/// within the limits and rates of the rig's axes. `machine` is the rig's mechanism.
///
/// # Errors
/// The first place found where they do not.
pub fn prove(
    machine: &FiveAxis,
    rig: &Rig<'_>,
    course: &Course,
    branch: Branch,
    start: &Joints,
) -> Result<Proof, Breach> {
    let out_of_reach = |at| Breach {
        at,
        what: Violation::OutOfReach,
    };
    let (apart, turned) = rig.blade_in_work(start).apart(&course.from);
    let begins_there = apart <= SAME.0 && turned <= SAME.1;
    let takes_time = course.duration > 0.0 && course.duration.is_finite();
    if !(begins_there && takes_time && follows_its_arc(course)) {
        return Err(out_of_reach(0.0));
    }
    let end = machine
        .on_branch(&rig.flange_in_root(&course.to), branch, start)
        .ok_or(out_of_reach(1.0))?;
    let mut search = Search::new(rig.axes, course.duration, start, &end);
    search.rotary_axes(start, &end)?;
    let run = Run::new(machine, rig, course, start, &end);
    search.linear_axes(&run)?;
    Ok(Proof {
        start: *start,
        end,
        low: search.low,
        high: search.high,
        rate: search.rate,
        // Rotary axes move evenly whatever the blade points along: no course has a singular pose.
        clearance: Clearance::UNLIMITED,
        solves: search.looks + 1,
    })
}

/// Whether the arc of a course, where it has one, begins and ends where the course does.
fn follows_its_arc(course: &Course) -> bool {
    course.arc.is_none_or(|arc| {
        let ends = [(arc.at(0.0), &course.from), (arc.end(), &course.to)];
        ends.into_iter()
            .all(|(point, blade)| DVec3::from_array(point).distance(blade.position) <= SAME.0)
    })
}

/// The axes at a place of a course, from 0 to 1, that leads from the axes at its start to those at its end. `machine` is the
/// rig's mechanism.
#[must_use]
pub fn joints_between(
    machine: &FiveAxis,
    rig: &Rig<'_>,
    course: &Course,
    [start, end]: [&Joints; 2],
    place: f64,
) -> Joints {
    let [x, y, z] = Run::new(machine, rig, course, start, end).at(place).xyz;
    let mut joints = core::array::from_fn(|axis| start[axis] + (end[axis] - start[axis]) * place);
    [joints[0], joints[1], joints[2]] = [x, y, z];
    joints
}

/// A point at a moment of the course, and how it moves (mm a course).
#[derive(Clone, Copy, Debug)]
struct Moving {
    at: DVec3,
    velocity: DVec3,
}

/// How far from a point of reference something gets (mm) and how long its derivatives become (mm a course, its square, its
/// cube).
#[derive(Clone, Copy, Debug, Default)]
struct Bounds {
    first: f64,
    second: f64,
    third: f64,
}

/// How a point moves on what carries it, with all axes at zero.
#[derive(Clone, Copy, Debug)]
enum Way {
    /// From a point on, evenly.
    Line { from: DVec3, by: DVec3 },
    /// Round a centre, evenly.
    Arc(CircularArc),
}

impl Way {
    fn at(&self, s: f64) -> Moving {
        match self {
            Self::Line { from, by } => Moving {
                at: *from + *by * s,
                velocity: *by,
            },
            Self::Arc(arc) => {
                let sweep = arc.sweep().to_rad();
                Moving {
                    at: DVec3::from_array(arc.at(s * sweep)),
                    velocity: DVec3::from_array(arc.direction(s * sweep)) * arc.length().to_mm(),
                }
            }
        }
    }

    /// A ball around it, as centre and radius, and its bounds.
    fn bounds(&self) -> (DVec3, f64, Bounds) {
        match self {
            Self::Line { from, by } => {
                let first = by.length();
                let bounds = Bounds {
                    first,
                    ..Bounds::default()
                };
                (*from, first, bounds)
            }
            Self::Arc(arc) => {
                let (radius, sweep) = (arc.radius().to_mm(), arc.sweep().to_rad());
                let bounds = Bounds {
                    first: radius * sweep,
                    second: radius * sweep * sweep,
                    third: radius * sweep * sweep * sweep,
                };
                (DVec3::from_array(arc.centre()), radius, bounds)
            }
        }
    }
}

/// A point that rotary axes at constant rates carry.
#[derive(Clone, Debug)]
struct Carried {
    way: Way,
    /// What carries it, from the inside out: axis, value at the start, change during the course.
    by: Vec<(Rotary, f64, f64)>,
}

impl Carried {
    fn at(&self, s: f64) -> Moving {
        self.by
            .iter()
            .fold(self.way.at(s), |point, &(rotary, value, change)| {
                let turned = rotary.turned(value + s * change);
                let at = turned.rotation * point.at + turned.position;
                let about = rotary.about.vector() * change;
                Moving {
                    at,
                    velocity: turned.rotation * point.velocity + about.cross(at - rotary.centre),
                }
            })
    }

    fn bounds(&self) -> Bounds {
        // The ball around the way, seen from where the axis before lies.
        let (mut seen_from, mut reach, mut bounds) = self.way.bounds();
        for &(rotary, _, change) in &self.by {
            reach += seen_from.distance(rotary.centre);
            seen_from = rotary.centre;
            let w = change.abs();
            let Bounds { first, second, third } = bounds;
            bounds = Bounds {
                first: first + w * reach,
                second: second + 2.0 * w * first + w * w * reach,
                third: third + 3.0 * w * second + 3.0 * w * w * first + w * w * w * reach,
            };
        }
        bounds
    }
}

/// X, Y and Z during a course: the tip as the work carries it, less the tip as the head does.
#[derive(Clone, Debug)]
struct Run {
    by_work: Carried,
    by_head: Carried,
    second: f64,
    third: f64,
}

impl Run {
    fn new(machine: &FiveAxis, rig: &Rig<'_>, course: &Course, start: &Joints, end: &Joints) -> Self {
        let moving = |(rotary, place): (Rotary, usize)| (rotary, start[place], end[place] - start[place]);
        let mount = machine.mount_at_zero();
        let work_at_zero = mount * rig.work_in_root;
        let [from, to] = [course.from, course.to].map(|blade| (work_at_zero * blade).position);
        let way = course.arc.map_or(Way::Line { from, by: to - from }, |arc| {
            Way::Arc(seen(&arc, &work_at_zero))
        });
        let by_work = Carried {
            way,
            by: machine.table().rev().map(moving).collect(),
        };
        let tip_in_nose = rig.flange_in_blade.inverse();
        let by_head = Carried {
            way: Way::Line {
                from: (machine.nose_at_zero() * tip_in_nose).position,
                by: DVec3::ZERO,
            },
            by: machine.head().rev().map(moving).collect(),
        };
        let (work, head) = (by_work.bounds(), by_head.bounds());
        Self {
            by_work,
            by_head,
            second: work.second + head.second,
            third: work.third + head.third,
        }
    }

    fn at(&self, s: f64) -> Look {
        let (work, head) = (self.by_work.at(s), self.by_head.at(s));
        Look {
            s,
            xyz: (work.at - head.at).to_array(),
            velocity: (work.velocity - head.velocity).to_array(),
        }
    }
}

/// An arc as seen from where a frame stands.
fn seen(arc: &CircularArc, frame: &Pose) -> CircularArc {
    let direction = |vector: [f64; 3]| frame.rotation * DVec3::from_array(vector);
    arc.seen(
        |vector| direction(vector).to_array(),
        |point| (direction(point) + frame.position).to_array(),
    )
}

/// The linear axes at a place of the course: mm, and mm a course.
#[derive(Clone, Copy, Debug)]
struct Look {
    s: f64,
    xyz: [f64; 3],
    velocity: [f64; 3],
}

/// What has been found out about the axes.
#[derive(Clone, Debug)]
struct Search<'m> {
    axes: &'m [Axis],
    duration: f64,
    low: Joints,
    high: Joints,
    rate: Joints,
    looks: u32,
}

impl<'m> Search<'m> {
    fn new(axes: &'m [Axis], duration: f64, start: &Joints, end: &Joints) -> Self {
        let low = core::array::from_fn(|axis| start[axis].min(end[axis]));
        let high = core::array::from_fn(|axis| start[axis].max(end[axis]));
        Self {
            axes,
            duration,
            low,
            high,
            rate: Joints::default(),
            looks: 0,
        }
    }

    /// Rotary axes go evenly from end to end.
    fn rotary_axes(&mut self, start: &Joints, end: &Joints) -> Result<(), Breach> {
        for axis in 3..start.len() {
            self.within_limits(axis, start[axis], 0.0)?;
            self.within_limits(axis, end[axis], 1.0)?;
            self.rate[axis] = (end[axis] - start[axis]).abs() / self.duration;
            self.within_rate(axis, self.rate[axis], 0.0)?;
        }
        Ok(())
    }

    fn within_limits(&self, axis: usize, value: f64, at: f64) -> Result<(), Breach> {
        let kept = self
            .axes
            .get(axis)
            .is_none_or(|limits| (limits.min - AT_LIMIT..=limits.max + AT_LIMIT).contains(&value));
        let what = Violation::Limit { axis, value };
        if kept { Ok(()) } else { Err(Breach { at, what }) }
    }

    fn within_rate(&self, axis: usize, rate: f64, at: f64) -> Result<(), Breach> {
        let most = self.axes.get(axis).and_then(|limits| limits.rate);
        let what = Violation::Rate { axis, rate };
        match most {
            Some(most) if rate > most + AT_LIMIT => Err(Breach { at, what }),
            Some(_) | None => Ok(()),
        }
    }

    /// Looks at the course from its start on, dividing what is too coarse to tell.
    fn linear_axes(&mut self, run: &Run) -> Result<(), Breach> {
        let mut left = self.look(run, 0.0)?;
        let mut rest = vec![self.look(run, 1.0)?];
        while let Some(right) = rest.last().copied() {
            let part = Part::new(run, left, right);
            let fine = part.beyond_values <= FINEST && part.beyond_rates / self.duration <= FINEST;
            if fine || self.looks >= MOST_LOOKS {
                self.settle(&part)?;
            } else if self.is_settled(&part) {
                self.take(&part);
            } else {
                rest.push(self.look(run, f64::midpoint(left.s, right.s))?);
                continue;
            }
            left = right;
            rest.pop();
        }
        Ok(())
    }

    /// A place of the course. What is computed there has to be within the limits.
    fn look(&mut self, run: &Run, s: f64) -> Result<Look, Breach> {
        self.looks += 1;
        let look = run.at(s);
        for axis in 0..3 {
            let (value, rate) = (look.xyz[axis], look.velocity[axis].abs() / self.duration);
            self.within_limits(axis, value, s)?;
            self.within_rate(axis, rate, s)?;
            self.low[axis] = self.low[axis].min(value);
            self.high[axis] = self.high[axis].max(value);
            self.rate[axis] = self.rate[axis].max(rate);
        }
        Ok(look)
    }

    /// Whether all that a part may do is within the limits, and not much beyond what has been found elsewhere.
    fn is_settled(&self, part: &Part) -> bool {
        (0..3).all(|axis| {
            let (low, high) = part.values(axis);
            let rate = part.rate(axis) / self.duration;
            self.within_limits(axis, low, 0.0).is_ok()
                && self.within_limits(axis, high, 0.0).is_ok()
                && self.within_rate(axis, rate, 0.0).is_ok()
                && low >= self.low[axis] - TIGHT
                && high <= self.high[axis] + TIGHT
                && rate <= self.rate[axis] + TIGHT_RATE
        })
    }

    /// Takes a part that will not be divided, if its bounds are within the limits.
    fn settle(&mut self, part: &Part) -> Result<(), Breach> {
        for axis in 0..3 {
            let (low, high) = part.values(axis);
            self.within_limits(axis, low, part.left.s)?;
            self.within_limits(axis, high, part.left.s)?;
            self.within_rate(axis, part.rate(axis) / self.duration, part.left.s)?;
        }
        self.take(part);
        Ok(())
    }

    fn take(&mut self, part: &Part) {
        for axis in 0..3 {
            let (low, high) = part.values(axis);
            self.low[axis] = self.low[axis].min(low);
            self.high[axis] = self.high[axis].max(high);
            self.rate[axis] = self.rate[axis].max(part.rate(axis) / self.duration);
        }
    }
}

/// A part of the course between two places, and how far values and rates in it may go beyond those at its ends.
#[derive(Clone, Copy, Debug)]
struct Part {
    left: Look,
    right: Look,
    beyond_values: f64,
    beyond_rates: f64,
}

impl Part {
    fn new(run: &Run, left: Look, right: Look) -> Self {
        let square = (right.s - left.s) * (right.s - left.s);
        Self {
            left,
            right,
            beyond_values: run.second * square / 8.0,
            beyond_rates: run.third * square / 8.0,
        }
    }

    fn values(&self, axis: usize) -> (f64, f64) {
        let (a, b) = (self.left.xyz[axis], self.right.xyz[axis]);
        (a.min(b) - self.beyond_values, a.max(b) + self.beyond_values)
    }

    fn rate(&self, axis: usize) -> f64 {
        let (a, b) = (self.left.velocity[axis].abs(), self.right.velocity[axis].abs());
        a.max(b) + self.beyond_rates
    }
}

#[cfg(test)]
mod tests;
