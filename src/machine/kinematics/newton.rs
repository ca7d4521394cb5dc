//! Inverse kinematics by damped Newton-Raphson, for arms without a closed form.
//!
//! The equations `f(q, p) = 0` of [Ha 2019], 8 to 11, say that the flange is where it should be. They are six: the
//! error is the twist that would carry the flange there in one unit of time, its linear part in units of the arm's
//! [size](SerialArm::size), its angular part a rotation vector, so that 1 rad counts as much as the arm's size in mm.
//! A step `d` solves `(J^T J + damping) d = J^T error` (Levenberg 1944, Marquardt 1963). Far away damping keeps steps short;
//! near a solution it fades and the steps become Newton's, which double the number of right digits. Only steps that make
//! the error smaller are taken.
//!
//! What is promised: every answer has been put through forward kinematics and brings the flange within 1e-6 mm and 1e-9
//! (Frobenius norm) of where it should be; work is bounded; the same question has the same answer everywhere. What is not:
//! that all solutions are found. [`search`] finds those that its starts lead to; [`follow`] goes there in small steps, and
//! where it has no answer the branch may still have one that only a detour would reach.

use super::jacobian::{Column, Square, Twist, keeps_from_singular};
use super::pose::Pose;
use super::serial::SerialArm;
use super::trig;
use super::{Joints, MOST_BRANCHES, Solution, Solutions};
use core::f64::consts::{PI, TAU};
use glam::{DMat3, DQuat, DVec3};
use vcutc_backend_api::ir::MOST_AXES;
use vcutc_backend_api::motion::Branch;

/// Most iterations from one start. From a near start it takes three or four, from a random one about fifteen.
const MOST_ITERATIONS: u32 = 60;
/// Damping at the start; the entries of the scaled `J^T J` are about 1.
const FIRST_DAMPING: f64 = 1e-3;
/// Least damping: it keeps the equations solvable in singular poses.
const LEAST_DAMPING: f64 = 1e-14;
/// With so much damping a step is lost in rounding: no step makes the error smaller any more.
const MOST_DAMPING: f64 = 1e8;
/// Most that a joint turns in one step, in rad.
const LONGEST_STEP: f64 = 1.0;
/// A scaled error that is rounding and nothing else.
const ROUNDING: f64 = 1e-14;
/// A scaled error that is small enough if the next step does not make it smaller.
const SMALL: f64 = 1e-11;
/// How far the flange may be from where an answer should bring it, in mm and as Frobenius norm.
const RESIDUAL: (f64, f64) = (1e-6, 1e-9);

/// The joints that bring the flange there, found from a start near to them. Angles count on from those of the start.
///
/// None if the steps do not get there.
#[must_use]
pub fn refine(arm: &SerialArm, flange_in_root: &Pose, start: &Joints) -> Option<Joints> {
    let mut joints = *start;
    let mut state = State::at(arm, flange_in_root, &joints)?;
    let mut damping = FIRST_DAMPING;
    for _ in 0..MOST_ITERATIONS {
        if state.error.norm() <= ROUNDING || damping > MOST_DAMPING {
            break;
        }
        let candidate = stepped(&joints, &state.step(damping)?);
        let next = State::at(arm, flange_in_root, &candidate)?;
        if next.error.norm() < state.error.norm() {
            (joints, state) = (candidate, next);
            damping = (damping * 0.1).max(LEAST_DAMPING);
        } else if state.error.norm() <= SMALL {
            break;
        } else {
            damping *= 10.0;
        }
    }
    let (apart, turned) = arm.forward(&joints).apart(flange_in_root);
    (apart <= RESIDUAL.0 && turned <= RESIDUAL.1).then_some(joints)
}

/// An arm on its way to a pose.
struct State {
    /// Lengths in units of the arm's size.
    jacobian: Square,
    error: Column,
}

impl State {
    /// None if a number is not finite.
    fn at(arm: &SerialArm, target: &Pose, joints: &Joints) -> Option<Self> {
        let (flange_in_root, jacobian) = arm.flange_and_jacobian(joints, DVec3::ZERO);
        let error = twist_between(&flange_in_root, target).column(arm.size());
        let finite = error.iter().all(|entry| entry.is_finite());
        finite.then(|| Self {
            jacobian: jacobian.square(arm.size()),
            error,
        })
    }

    fn step(&self, damping: f64) -> Option<Column> {
        let transposed = self.jacobian.transpose();
        let normal = transposed * self.jacobian + Square::identity() * damping;
        let step = normal.cholesky()?.solve(&(transposed * self.error));
        let longest = step.amax();
        let scale = if longest > LONGEST_STEP {
            LONGEST_STEP / longest
        } else {
            1.0
        };
        longest.is_finite().then(|| step * scale)
    }
}

fn stepped(joints: &Joints, step: &Column) -> Joints {
    let mut next = *joints;
    for (joint, step) in next.iter_mut().zip(step.iter()) {
        *joint += step;
    }
    next
}

/// The twist that carries one pose to another in one unit of time, its point on a straight line.
fn twist_between(from: &Pose, to: &Pose) -> Twist {
    Twist {
        linear: to.position - from.position,
        angular: rotation_vector(&(to.rotation * from.rotation.transpose())),
    }
}

/// Axis times angle, the angle from 0 to half a turn. By way of the quaternion, which is precise for small angles as well as
/// near half turns.
fn rotation_vector(rotation: &DMat3) -> DVec3 {
    let q = DQuat::from_mat3(rotation);
    let (sine, cosine) = if q.w < 0.0 {
        (-q.xyz(), -q.w)
    } else {
        (q.xyz(), q.w)
    };
    let length = sine.length();
    if length < 1e-12 {
        sine * 2.0
    } else {
        sine * (2.0 * libm::atan2(length, cosine) / length)
    }
}

/// Most strides on the way to a pose.
const MOST_STRIDES: u32 = 2000;
/// Shortest stride, as a part of the whole way.
const SHORTEST_STRIDE: f64 = 1.0 / 16_384.0;
/// Most that a joint may turn in one stride, in rad.
const MOST_TURN: f64 = 0.35;
/// How much of the distance to the nearest singular matrix the Jacobian may change by in one stride. The rest is for what
/// the joints' way bends between.
const SAFE_CHANGE: f64 = 0.5;

/// The joints that bring the flange there on the branch of `start`: the flange is led from where it is at `start`, on a
/// straight line and turning about one axis, in strides that cannot lead past a singular pose. The angles are then brought
/// within half a turn of the start's.
///
/// Branches meet in singular poses only. The smallest singular value of a matrix is its distance from the nearest singular
/// one (Eckart and Young 1936), and a stride is so short that the Jacobian changes by at most half of it.
///
/// None if the way leads out of reach or so near to a singular pose that the strides become too short, and if `start` is
/// such a pose.
#[must_use]
pub fn follow(arm: &SerialArm, flange_in_root: &Pose, start: &Joints) -> Option<Joints> {
    let from = arm.forward(start);
    let way = twist_between(&from, flange_in_root);
    let mut joints = *start;
    let (mut done, mut stride) = (0.0, 1.0);
    for _ in 0..MOST_STRIDES {
        let aim: f64 = done + stride;
        let arrives = aim >= 1.0;
        let pose = if arrives {
            *flange_in_root
        } else {
            on_the_way(&from, &way, aim)
        };
        match refine(arm, &pose, &joints).filter(|next| is_safe_stride(arm, &joints, next)) {
            Some(next) if arrives => return Some(within_half_a_turn(&next, start)),
            Some(next) => {
                joints = next;
                done = aim;
                stride *= 2.0;
            }
            None => stride *= 0.5,
        }
        if stride < SHORTEST_STRIDE {
            return None;
        }
    }
    None
}

fn is_safe_stride(arm: &SerialArm, joints: &Joints, next: &Joints) -> bool {
    let scaled = |joints| arm.jacobian(joints, DVec3::ZERO).square(arm.size());
    let before = scaled(joints);
    let changed = (scaled(next) - before).norm();
    most_turn(next, joints) <= MOST_TURN && keeps_from_singular(&before, changed / SAFE_CHANGE)
}

fn on_the_way(from: &Pose, way: &Twist, part: f64) -> Pose {
    let turn = DMat3::from_quat(DQuat::from_scaled_axis(way.angular * part));
    Pose {
        rotation: turn * from.rotation,
        position: from.position + way.linear * part,
    }
}

fn most_turn(a: &Joints, b: &Joints) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// Angles of revolute joints, each within half a turn of another.
#[must_use]
pub fn within_half_a_turn(joints: &Joints, of: &Joints) -> Joints {
    core::array::from_fn(|i| trig::nearest(joints[i], of[i]))
}

/// Most starts of a search.
const MOST_STARTS: u32 = 400;
/// A search ends when so many starts in a row found nothing new.
const FRUITLESS_STARTS: u32 = 100;
/// Angles that differ by less, in rad, are those of the same solution.
const SAME: f64 = 1e-5;
/// Solutions whose Jacobian is nearer to singular than this are left out: there branches meet, or a whole curve of solutions
/// passes, of which none is better than the others.
const SINGULAR: f64 = 1e-7;

/// Ways to bring the flange there, found from many starts spread evenly over all angles and always the same. Ways in singular
/// poses are left out. They are numbered in the order of their angles, joint 1 first; the numbers distinguish the solutions of one
/// pose apart and mean nothing for another pose.
#[must_use]
pub fn search(arm: &SerialArm, flange_in_root: &Pose) -> Solutions {
    let mut found: Vec<Joints> = Vec::new();
    let mut fruitless = 0;
    for start in 0..MOST_STARTS {
        if fruitless >= FRUITLESS_STARTS || found.len() >= MOST_BRANCHES {
            break;
        }
        fruitless += 1;
        let Some(joints) = refine(arm, flange_in_root, &spread(start)) else {
            continue;
        };
        let joints = within_half_a_turn(&joints, &[0.0; MOST_AXES]);
        let known = found.iter().any(|other| same(other, &joints));
        if !known && arm.jacobian(&joints, DVec3::ZERO).conditioning() > SINGULAR {
            found.push(joints);
            fruitless = 0;
        }
    }
    numbered(found)
}

fn numbered(mut found: Vec<Joints>) -> Solutions {
    // By steps that are far coarser than rounding, so that solutions which share an angle are distinguished by the next one.
    found.sort_by_key(|joints| joints.map(|angle| (angle / SAME).round() as i64));
    let mut solutions = Solutions::NONE;
    for (number, joints) in (0..).zip(found) {
        let branch = Branch::Numbered(number);
        solutions.push(Solution { branch, joints });
    }
    solutions
}

fn same(a: &Joints, b: &Joints) -> bool {
    most_turn(&within_half_a_turn(a, b), b) < SAME
}

/// Start number `n` in the six-dimensional cube of all angles: the additive recurrence whose steps are powers of the root of
/// `x^7 = x + 1`, which fills it evenly (Roberts, The unreasonable effectiveness of quasirandom sequences, 2018).
pub(super) fn spread(n: u32) -> Joints {
    const ROOT: f64 = 1.112_775_684_278_705_5;
    let mut share = 1.0;
    core::array::from_fn(|_| {
        share /= ROOT;
        let turns = 0.5 + share * f64::from(n);
        TAU * (turns - turns.floor()) - PI
    })
}

#[cfg(test)]
mod tests;
