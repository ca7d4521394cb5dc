//! Where the axes of an arm are on any part of a course that it follows, enclosed with their derivatives.

use super::arm::posture_on;
use super::arm_course::{ArmCourse, Solver};
use super::course::Span;
use super::types::Course;
use crate::rig::Rig;
use vcutc_backend_api::motion::Branch;
use vcutc_geometry::number::Along;

/// A part of a motion, from 0 to 1: all places within `half` of `middle`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Part {
    pub middle: f64,
    pub half: f64,
}

impl Part {
    /// One of so many parts of equal length, counted from 0.
    #[must_use]
    pub fn one_of(count: u32, number: u32) -> Self {
        let half = 0.5 / f64::from(count);
        Self {
            middle: f64::from(2 * number + 1) * half,
            half,
        }
    }

    /// Its two halves.
    #[must_use]
    pub fn halves(self) -> [Self; 2] {
        let half = 0.5 * self.half;
        [-half, half].map(|off| Self {
            middle: self.middle + off,
            half,
        })
    }
}

/// An arm with a closed form, on a branch, that carries the blade along a course.
pub struct ArmWay<'m>(ArmCourse<'m>);

impl<'m> ArmWay<'m> {
    /// None for machines without a closed form, and for a course or a branch that they do not have.
    #[must_use]
    pub fn new(rig: &Rig<'m>, course: &Course, branch: Branch) -> Option<Self> {
        let course = ArmCourse::new(rig, course, branch)?;
        match course.solver {
            Solver::ClosedForm(..) => Some(Self(course)),
            Solver::Numeric(_) => None,
        }
    }

    /// The controller's axes on a part of the course, each up to whole turns, by a parameter that goes from -1 to 1 on the part. None
    /// where a part is too long to say.
    #[must_use]
    pub fn axes_on(&self, part: Part) -> Option<[Along; 6]> {
        let Solver::ClosedForm(arm, branch) = self.0.solver else {
            return None;
        };
        let span = Span {
            middle: part.middle,
            half: part.half,
        };
        posture_on(arm, branch, &self.0.flight, span)
    }
}
