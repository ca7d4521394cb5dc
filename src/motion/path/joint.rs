//! Joints of chains: what the axes do where the controller leaves the end of a piece for the beginning of the next.
//!
//! Through a joint the controller does not stop. It rounds the corner that rates or directions have there, and a program says by
//! how much at most: its blend `b`. What is proven holds for every way through the joint that keeps to this, with the *zone* as
//! the parts of both pieces whose way to the joint is no longer than `b`:
//!
//! - the tip is no farther than `b` from the zone, and so no farther than `2 b` from the joint;
//! - the posture of the blade is between those of the pieces in the zone: from that at the joint a turn leads to it whose vector
//!   is between none, the turn back to where the zone begins, and the turn on to where it ends;
//! - the tip and the blade, or the rotary axes that turn it, are no faster than on the pieces in the zone: their velocities
//!   are between nothing and those on both pieces.
//!
//! **Arms.** All these poses make a box of axis values in which the Jacobian is regular ([`super::around`]): no singular pose is
//! met, and the arm stays on its branch. This holds for arms with a closed form, too. How near they come to singular poses
//! follows from how much their axes, and their wrist centre, move in that box.
//!
//! **Five-axis machines** have formulas of their own ([`super::five_axis::joint`]).
//!
//! The bounds hold for all directions at once, so they are wider than what the poses need, by a factor of two or three. For a
//! blend of a tenth of a millimetre this is some thousandths of a degree. An arm so close to a singular pose that the box cannot
//! be found is refused for that.

use super::arm_course::{ArmCourse, Solver};
use super::around::{Around, Poses, around};
use super::bounds::Bounds;
use super::five_axis;
use super::march::about;
use super::through::{Through, zone};
use super::types::{Breach, Clearance, Proof, Singularity, Violation};
use crate::rig::Rig;
use vcutc_backend_api::ir::MOST_AXES;
use vcutc_backend_api::motion::Branch;
use vcutc_machine::kinematics::Mechanism;
use vcutc_machine::kinematics::opw::{Coupling, Opw};
use vcutc_machine::kinematics::serial::SerialArm;

/// The proof of the first of two courses, with what the axes do where it continues into the other.
///
/// # Errors
/// What would break around the joint, which is reported at the end of the course.
pub fn prove_through(
    rig: &Rig<'_>,
    through: &Through<'_>,
    branch: Branch,
    proof: &Proof,
    least: &Clearance,
) -> Result<Proof, Breach> {
    let found = match rig.mechanism {
        Mechanism::FiveAxis(machine) => five_axis::joint::reached(machine, rig, through, branch, proof)
            .map(|around| (around, Clearance::UNLIMITED))
            .ok_or(Violation::OutOfReach),
        Mechanism::OrthoParallel(_) | Mechanism::Mounted(_) | Mechanism::Serial(_) => {
            of_arm(rig, through, branch, proof, least)
        }
    };
    // Rates a second.
    let bounds = Bounds {
        axes: rig.axes,
        least: *least,
        duration: 1.0,
    };
    let breach = |what: Violation| Breach {
        at: 1.0,
        what: what.finite(),
    };
    let (around, clearance) = found.map_err(breach)?;
    bounds.keep_clear(&clearance).map_err(breach)?;
    bounds.hold_values(&around.value).map_err(breach)?;
    bounds.hold_rates(&around.rate).map_err(breach)?;
    let used = |axis: usize| axis < rig.axes.len();
    let mut wider = *proof;
    for axis in (0..MOST_AXES).filter(|axis| used(*axis)) {
        wider.low[axis] = wider.low[axis].min(around.value[axis].low);
        wider.high[axis] = wider.high[axis].max(around.value[axis].high);
        wider.rate[axis] = wider.rate[axis].max(around.rate[axis].magnitude());
    }
    wider.clearance = wider.clearance.least(&clearance);
    wider.solves = wider.solves.saturating_add(1);
    Ok(wider)
}

fn of_arm(
    rig: &Rig<'_>,
    through: &Through<'_>,
    branch: Branch,
    proof: &Proof,
    least: &Clearance,
) -> Result<(Around, Clearance), Violation> {
    let [before, after] = [through.before, through.after].map(|course| ArmCourse::new(rig, course, branch));
    let (Some(before), Some(after)) = (before, after) else {
        return Err(Violation::OutOfReach);
    };
    let [first, second] = [&before.flight, &after.flight].map(|flight| zone(through.blend, flight.length()));
    let turned = [before.flight.spin() * -first, after.flight.spin() * second];
    let turn = turned[0].length().max(turned[1].length());
    let away = 2.0 * through.blend;
    let [ending, beginning] = [
        (&before.flight, 1.0, through.before.duration),
        (&after.flight, 0.0, through.after.duration),
    ]
    .map(|(flight, place, duration)| (flight.velocity_at(place) / duration, flight.spin() / duration));
    let bends = [
        (&before.flight, first, &ending),
        (&after.flight, second, &beginning),
    ]
    .map(|(flight, share, (velocity, _))| flight.bends() * share * velocity.length());
    let poses = Poses {
        away,
        turned,
        velocities: [ending.0, beginning.0],
        bends: bends[0].max(bends[1]),
        spins: [ending.1, beginning.1],
    };
    let tip = before.flight.tip_in_flange();
    match before.solver {
        Solver::ClosedForm(arm, _) => {
            let at_joint = before.stretch(about(1.0), &proof.end)?.clearance;
            let around = around(&SerialArm::from(arm), tip, &proof.end, &poses)
                .ok_or(Violation::Singular(nearest(&at_joint, least)))?;
            let lever = tip.length() + arm.c4.abs();
            let clearance = lessened(arm, &at_joint, &around, away + turn * lever);
            Ok((around, clearance))
        }
        Solver::Numeric(arm) => {
            let around = around(arm, tip, &proof.end, &poses).ok_or(Violation::OutOfReach)?;
            Ok((around, Clearance::UNLIMITED))
        }
    }
}

/// The singular pose that is nearest, measured by how near it may be.
fn nearest(found: &Clearance, least: &Clearance) -> Singularity {
    let shares = [
        (found.wrist / least.wrist, Singularity::Wrist(found.wrist)),
        (found.elbow / least.elbow, Singularity::Elbow(found.elbow)),
        (
            found.shoulder / least.shoulder,
            Singularity::Shoulder(found.shoulder),
        ),
    ];
    let [first, rest @ ..] = shares;
    let nearer =
        |one: (f64, Singularity), other: (f64, Singularity)| if other.0 < one.0 { other } else { one };
    rest.into_iter().fold(first, nearer).1
}

/// What is left of the distances from singular poses when axes move within boxes, and the wrist centre by so much (mm).
fn lessened(arm: &Opw, at_joint: &Clearance, around: &Around, centre: f64) -> Clearance {
    let half = |axis: usize| around.value[axis].width() / 2.0;
    // By whichever coupling: the angle of the elbow follows axis 3, or what axis 3 is ahead of axis 2.
    let elbow = match arm.coupling {
        Coupling::Serial => half(2),
        Coupling::Parallelogram => half(1) + half(2),
    };
    Clearance {
        wrist: at_joint.wrist - half(4),
        elbow: at_joint.elbow - elbow,
        shoulder: at_joint.shoulder - centre,
    }
}
