//! The path check: whether the axes follow the blade along a whole motion, proven and not sampled.
//!
//! # What is proven
//!
//! A robot's controller moves the tip on a straight line, `p(s) = p0 + s (p1 - p0)`, or on an arc about a centre,
//! `p(s) = c + cos(s sigma) u + sin(s sigma) v`, and turns the blade about one axis, `R(s) = R0 exp(s phi [a])`, with `s`
//! going from 0 to 1 at a constant rate during the time that the motion takes. A [`Proof`] says of such a [`Course`]:
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
//! ([`vcutc_geometry::number::Along`]): what `f(0)` and `f'(0)` are, and what `f`, `f'` and `f''` range over on the whole span.
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
//! All spans before a refused one are proven, so the breach that is reported is **the first one** of the course. A span is refused for
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
//! singular poses nothing is measured: a proof says that they meet none, and the least clearance asked for is not checked.
//! Five-axis machines are interpolated in another way and have a check of their own, [`five_axis`].
//!
//! # What is assumed
//!
//! - The controller interpolates as said, at a constant rate. It rounds corners and ramps up and down within this line, which
//!   is slower; accelerations are not looked at. Where pieces of a chain go on into each other it may leave them by the
//!   program's blend, which [`mod@joint`] encloses.
//! - The blade's pose at a place is taken from floating point numbers, which are off by about 1e-15 of their size: over a
//!   metre of arm by 1e-12 mm, less than the slack above unless the pose is next to singular, and asking for a clearance
//!   excludes these.
//! - Sine, cosine and arc tangent, of `libm` and of [`vcutc_machine::kinematics::trig`], are right to two units in the last place; four are
//!   allowed for.
//! - The machine is as its model says. Calibration, elasticity and what else is in the cell are for others.

mod abreast;
mod arm;
mod arm_course;
mod arm_way;
mod around;
mod axis_moves;
mod bounds;
mod chain;
mod course;
pub mod five_axis;
mod joint;
mod march;
mod refuted;
mod serial;
#[cfg(test)]
mod tests;
mod through;
mod types;
mod wide;
mod worst;

pub use arm_way::{ArmWay, Part};
pub use axis_moves::{AxesBreach, AxesViolation, Block, Solid, are_axes_refuted, prove_axes};
pub use chain::evenly;
pub use joint::prove_through;
pub use refuted::{Refuted, refuted};
pub use through::Through;
pub use types::{Breach, Clearance, Course, Proof, Singularity, Violation};
pub use worst::{Look, worst};

use super::rig::Rig;
use abreast::Underway;
use arm_course::ArmCourse;
use vcutc_backend_api::motion::Branch;
use vcutc_machine::kinematics::five_axis::FiveAxis;
use vcutc_machine::kinematics::{Joints, Mechanism};

/// Proves that the axes follow a course on a branch, beginning at `start` (which must bring the blade to `course.from`),
/// within the limits and rates of the rig's axes and no nearer to singular poses than `least`.
///
/// # Errors
/// The first place where they do not. An axis is there just beyond its bound; [`worst()`] says how far it would go.
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
    Arm(Box<ArmCourse<'r>>),
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
            Follower::Arm(Box::new(ArmCourse::new(rig, course, branch)?))
        }))
    }

    /// The axes at a place from 0 to 1; those of an arm within half a turn of `near`.
    #[must_use]
    pub fn joints_at(&self, place: f64, near: &Joints) -> Option<Joints> {
        match &self.0 {
            Follower::Arm(arm) => arm.joints_at(place, near),
            Follower::FiveAxis {
                machine,
                rig,
                course,
                ends,
            } => Some(five_axis::joints_between(machine, rig, course, *ends, place)),
        }
    }
}
