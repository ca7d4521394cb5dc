//! The path check: whether the axes follow the blade along a whole motion, proven and not sampled.
//!
//! # What is proven
//!
//! A robot's controller moves the tip on a straight line, `p(s) = p0 + s (p1 - p0)`, and turns the blade about one axis,
//! `R(s) = R0 exp(s phi [a])`, with `s` going from 0 to 1 at a constant rate during the time that the motion takes. A
//! [`Proof`] says of such a [`Course`]:
//!
//! > There is **one continuous motion of the axes** that begins with the given values, carries the blade along the whole
//! > course, stays on its branch, and keeps at every moment within the ranges and rates of the axes, and as far from
//! > singular poses as was asked. No axis goes beyond `low` and `high`, none is faster than `rate`.
//!
//! It holds for all of the uncountably many places of the course, not for samples of it: a limit that is passed for a
//! thousandth of a millimetre is found.
//!
//! # Why it holds
//!
//! The course is cut into spans. On a span, with a parameter `t` from -1 to 1, the closed-form inverse kinematics of the arm
//! (Brandstötter, Angerer, Hofbaur 2014) is computed once, with *functions of `t`* in the place of numbers. Each step of the
//! formulas, a sum, a product, a root, an arc, takes functions and returns one; of each function `f` five intervals are kept
//! ([`along`]): what `f(0)` and `f'(0)` are, and what `f`, `f'` and `f''` range over on the whole span.
//!
//! 1. *The intervals are right.* Sums and products follow Leibniz' rule, roots and arcs the chain rule, for instance for the
//!    arc `q` of a point `(x, y)` at the distance `r` from the origin, in which all angles of an arm end:
//!
//!    `q' = (x y' - y x') / r^2`, `q'' = (x y'' - y x'' - q' (r^2)') / r^2`.
//!
//!    Put intervals in and the result has all that numbers from them can give (Moore, Interval Analysis, 1966). Each
//!    operation moves its bounds outward by more than its rounding.
//! 2. *They are tight.* By Taylor's theorem `f(t)` is in `f(0) + t f'(0) + t^2/2 f''` and `f'(t)` in `f'(0) + t f''`, with
//!    the range of `f''`. So a range exceeds the true one by a term of the second order in the span's length, and halving
//!    a span divides the excess by four.
//! 3. *The motion is continuous and keeps to its branch.* A root is taken only where its radicand, an arc only where its
//!    radius is positive on the whole span. The radicands are `x^2 + y^2 - b^2` of the wrist centre (zero when it is over
//!    axis 1), `1 - cos^2 psi` of the elbow (zero when the arm is stretched), and `sin^2 q5` (zero when the hand is). So on
//!    a span that is not refused the closed form of *one* branch is a smooth function of `t`, and the arm meets no singular
//!    pose. On neighbouring spans both functions solve the same pose on the same branch where they meet: they agree there
//!    up to whole turns, which the enclosures, narrower than half a turn, tell apart.
//! 4. *Bounds are kept.* A span is proven when the ranges of values and rates lie within the limits and the distances from
//!    singular poses are at least those asked for. Any other span is halved ([`mod@march`]).
//!
//! All spans before a refused one are proven, so the breach told is **the first one** of the course. A span is refused for
//! good at `2^-24` of the course, of a metre 0.06 um. There an enclosure exceeds the truth by less than 1e-12 rad in all but
//! singular poses, so a motion that keeps its bounds is refused only where it grazes one that closely. The other way round
//! limits count as kept when they are exceeded by 1e-9 rad (1e-9 mm, and rates by 1e-9 of themselves), which no controller
//! resolves: a home position that is itself a limit must not fail by rounding.
//!
//! Spans are also made shorter, down to 1/256 of the course, until their bounds are near the truth, since people read margins
//! from them: near its limit an axis' range is within 0.1 deg and its rate within a hundredth of the highest; far from it the
//! range may be worse by a fiftieth of the room that is left, and the rate by a tenth. A cut of 1 m takes about 17 spans,
//! where sampling every millimetre would solve a thousand poses and prove nothing about the places between.
//!
//! Arms without a closed form are proven by way of their Jacobian; [`mod@serial`] has the theorem. Of their distance from
//! singular poses nothing is measured: a proof says that they meet none, and the least clearance asked for is not checked. Five-axis machines are
//! interpolated in another way and have a check of their own, [`five_axis`].
//!
//! # What is assumed
//!
//! - The controller interpolates as said, at a constant rate. It rounds corners and ramps up and down within this line, which
//!   is slower; accelerations are not looked at.
//! - The blade's pose at a place is taken from floating point numbers, which are off by about 1e-15 of their size: over a
//!   metre of arm by 1e-12 mm, less than the slack above unless the pose is next to singular, and asking for a clearance
//!   excludes these.
//! - Sine, cosine and arc tangent, of `libm` and of [`vcutc_machine::kinematics::trig`], are right to two units in the last place; four are
//!   allowed for.
//! - The machine is as its model says. Calibration, elasticity and what else is in the cell are for others.

mod abreast;
mod along;
mod arm;
mod axes;
mod bounds;
mod chain;
mod course;
pub mod five_axis;
mod interval;
mod march;
mod number;
mod refuted;
mod serial;
#[cfg(test)]
mod tests;
mod worst;

pub use axes::{AxesBreach, AxesViolation, Block, are_axes_refuted, prove_axes};
pub use refuted::{Refuted, refuted};
pub use worst::{Look, worst};

use super::rig::Rig;
use abreast::Underway;
use arm::{ArmBranch, Carrying};
use bounds::Stretch;
use course::{Flight, Span};
use vcutc_backend_api::motion::Branch;
use vcutc_machine::kinematics::five_axis::FiveAxis;
use vcutc_machine::kinematics::opw::Opw;
use vcutc_machine::kinematics::pose::Pose;
use vcutc_machine::kinematics::serial::SerialArm;
use vcutc_machine::kinematics::{Joints, Mechanism, newton};

/// A motion as controllers interpolate it: the tip on a straight line, the orientation on one rotation axis (of a robot) or
/// the rotary axes each at a constant rate (of a five-axis machine), both at a constant rate and finishing together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Course {
    /// Blade frame T in W at the start.
    pub from: Pose,
    /// Blade frame T in W at the end.
    pub to: Pose,
    /// How long it takes, in s; positive.
    pub duration: f64,
}

/// What holds all along a course that the axes follow on one branch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Proof {
    /// The axes at the start.
    pub start: Joints,
    /// The axes at the end.
    pub end: Joints,
    /// No axis goes below this.
    pub low: Joints,
    /// No axis goes above this.
    pub high: Joints,
    /// No axis moves faster than this either way, in rad or mm a second.
    pub rate: Joints,
    /// How far the arm keeps from its singular poses.
    pub clearance: Clearance,
    /// How many times the inverse kinematics was solved.
    pub solves: u32,
}

/// How far an arm is from its singular poses. A machine without such a pose is infinitely far from it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clearance {
    /// Of the hand from being stretched: the angle of axis 5, in rad.
    pub wrist: f64,
    /// Of the elbow from being stretched or folded: the least angle between upper arm and the line to the wrist, in rad.
    pub elbow: f64,
    /// Of the wrist centre from axis 1, in mm.
    pub shoulder: f64,
}

/// Why the axes do not follow a course.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Breach {
    /// Where on the course, from 0 to 1.
    pub at: f64,
    /// What breaks there.
    pub what: Violation,
}

/// What breaks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Violation {
    /// No axis values bring the blade there on this branch.
    OutOfReach,
    /// An axis would have to leave its range.
    Limit {
        /// The axis, from 0.
        axis: usize,
        /// Where it would have to be.
        value: f64,
    },
    /// An axis would have to move too fast.
    Rate {
        /// The axis, from 0.
        axis: usize,
        /// How fast it would have to move.
        rate: f64,
    },
    /// The arm comes too close to a singularity.
    Singular(Singularity),
}

/// Kinds of singular pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Singularity {
    /// Axes 4 and 6 in line; the angle of axis 5 in rad.
    Wrist(f64),
    /// Arm stretched or folded; the angle left in rad.
    Elbow(f64),
    /// Wrist centre over axis 1; the distance in mm.
    Shoulder(f64),
}

/// Proves that the axes follow a course on a branch, beginning at `start` (which must bring the blade to `course.from`),
/// within the limits and rates of the rig's axes and no nearer to singular poses than `least`.
///
/// # Errors
/// The first place where they do not. An axis is there just beyond its bound; [`worst()`] tells how far it would go.
pub fn prove(
    rig: &Rig<'_>,
    course: &Course,
    branch: Branch,
    start: &Joints,
    least: &Clearance,
) -> Result<Proof, Breach> {
    let asked = [(*course, *start)];
    let nowhere = Err(Breach {
        at: 0.0,
        what: Violation::OutOfReach,
    });
    prove_all(rig, &asked, branch, least).pop().unwrap_or(nowhere)
}

/// The same for several courses, each with the axes at its start, on one branch; sooner than one by one.
#[must_use]
pub fn prove_all(
    rig: &Rig<'_>,
    courses: &[(Course, Joints)],
    branch: Branch,
    least: &Clearance,
) -> Vec<Result<Proof, Breach>> {
    // Its controller interpolates in another way.
    if let Mechanism::FiveAxis(machine) = rig.mechanism {
        let one = |(course, start): &(Course, Joints)| five_axis::prove(machine, rig, course, branch, start);
        return courses.iter().map(one).collect();
    }
    let begun = courses
        .iter()
        .map(|(course, start)| Underway::begin(rig, course, branch, start, least));
    abreast::finish(begun.collect())
}

/// The axes on a branch at a place, from 0 to 1, of a course that leads from the axes at its start to those at its end; those
/// of an arm within half a turn of `near`.
#[must_use]
pub fn joints_on(
    rig: &Rig<'_>,
    course: &Course,
    branch: Branch,
    ends: [&Joints; 2],
    place: f64,
    near: &Joints,
) -> Option<Joints> {
    Followed::new(rig, course, branch, ends)?.joints_at(place, near)
}

/// A course that the axes follow on a branch: the same as [`joints_on`] for many places.
pub struct Followed<'r>(Follower<'r>);

enum Follower<'r> {
    Arm(Way<'r>),
    FiveAxis {
        machine: &'r FiveAxis,
        rig: &'r Rig<'r>,
        course: &'r Course,
        ends: [&'r Joints; 2],
    },
}

impl<'r> Followed<'r> {
    /// None for a branch that the machine does not have, and for a course that cannot be.
    #[must_use]
    pub fn new(rig: &'r Rig<'r>, course: &'r Course, branch: Branch, ends: [&'r Joints; 2]) -> Option<Self> {
        Some(Self(if let Mechanism::FiveAxis(machine) = rig.mechanism {
            Follower::FiveAxis {
                machine,
                rig,
                course,
                ends,
            }
        } else {
            Follower::Arm(Way::new(rig, course, branch)?)
        }))
    }

    /// The axes at a place from 0 to 1; those of an arm within half a turn of `near`.
    #[must_use]
    pub fn joints_at(&self, place: f64, near: &Joints) -> Option<Joints> {
        match &self.0 {
            Follower::Arm(way) => way.joints_at(place, near),
            Follower::FiveAxis {
                machine,
                rig,
                course,
                ends,
            } => Some(five_axis::joints_between(machine, rig, course, *ends, place)),
        }
    }
}

/// A machine on a branch that carries the blade along a course.
struct Way<'m> {
    flight: Flight,
    machine: Machine<'m>,
}

/// How the axes are found, and how spans are proven.
#[derive(Clone, Copy)]
enum Machine<'m> {
    /// By a closed form.
    Arm(&'m Opw, ArmBranch),
    /// By iteration and the Jacobian.
    Serial(&'m SerialArm),
}

impl<'m> Way<'m> {
    /// `None` for a course without a duration, beyond all machines, or a branch that the machine does not have.
    fn new(rig: &Rig<'m>, course: &Course, branch: Branch) -> Option<Self> {
        let lasts = course.duration > 0.0 && course.duration.is_finite();
        let mut rig = rig.clone();
        let machine = match (rig.mechanism, branch) {
            (
                Mechanism::OrthoParallel(arm),
                Branch::Arm {
                    shoulder,
                    elbow,
                    wrist,
                },
            ) => Machine::Arm(
                arm,
                ArmBranch {
                    shoulder,
                    elbow,
                    wrist,
                },
            ),
            (
                Mechanism::Mounted(mounted),
                Branch::Arm {
                    shoulder,
                    elbow,
                    wrist,
                },
            ) => {
                // Seen from the arm's own foot and for its own flange it is any other arm.
                rig.work_in_root = mounted.foot_in_root.inverse() * rig.work_in_root;
                rig.flange_in_blade = rig.flange_in_blade * mounted.flange_in_hand.inverse();
                Machine::Arm(
                    &mounted.arm,
                    ArmBranch {
                        shoulder,
                        elbow,
                        wrist,
                    },
                )
            }
            (Mechanism::Serial(arm), Branch::Numbered(_)) => Machine::Serial(arm),
            (Mechanism::OrthoParallel(_) | Mechanism::Mounted(_), Branch::Numbered(_))
            | (Mechanism::Serial(_), Branch::Arm { .. })
            | (Mechanism::FiveAxis(_), _) => return None,
        };
        let flight = Flight::new(&rig, course).filter(|_| lasts)?;
        Some(Self { flight, machine })
    }

    /// The axes at a place of the course.
    fn joints_at(&self, place: f64, near: &Joints) -> Option<Joints> {
        let flange = self.flight.flange_at(place);
        match self.machine {
            Machine::Arm(arm, branch) => arm.on_branch(&flange, branch.into(), near),
            Machine::Serial(arm) => newton::follow(arm, &flange, near),
        }
    }

    /// The start to go on from. Where kinematics finds no axis values, or others than the given ones, there is none.
    fn begun(&self, start: &Joints) -> Option<Joints> {
        let begun = self.joints_at(0.0, start).filter(|begun| is_same(begun, start))?;
        match self.machine {
            Machine::Arm(..) => Some(*start),
            // Its spans are proven from what the axes are before.
            Machine::Serial(arm) => serial::verified(arm, &self.flight, 0.0, &begun),
        }
    }

    /// What the axes do on a span that they enter at `begin`, proven.
    fn stretch(&self, span: Span, begin: &Joints) -> Result<Stretch, Violation> {
        match self.machine {
            Machine::Arm(arm, branch) => {
                let mut carrying = Carrying::new(arm, branch, self.flight.turning());
                carrying.take(0, &self.flight);
                carrying.set(0, span);
                carrying.sweep();
                carrying.stretch(0)
            }
            Machine::Serial(arm) => serial::stretch(arm, &self.flight, span, begin),
        }
    }
}

/// How far apart given and computed axis values at the start may be, in rad or mm.
const SAME_START: f64 = 1e-5;

fn is_same(one: &Joints, other: &Joints) -> bool {
    one.iter()
        .zip(other)
        .all(|(one, other)| (one - other).abs() <= SAME_START)
}
