//! Proofs under way, those of arms side by side.
//!
//! A closed form takes the same steps for every course. So several courses march abreast, each with spans of its own, and the
//! spans that they try at a time are computed as the lanes of one vector. Who is proven takes his place to the next course that
//! waits. What comes of a course does not depend on who marches beside it.

use super::arm::{Carrying, LANES};
use super::arm_course::{ArmCourse, Solver};
use super::bounds::{Bounds, Progress, Stretch};
use super::course::Shape;
use super::march::{Effort, March};
use super::types::{Breach, Clearance, Course, Proof, Violation};
use crate::rig::Rig;
use vcutc_backend_api::motion::Branch;
use vcutc_geometry::number::Interval;
use vcutc_machine::kinematics::Joints;

/// A course whose proof is under way.
pub(super) struct Underway<'r> {
    way: ArmCourse<'r>,
    progress: Progress<'r>,
    march: March,
    /// How good the bounds of the span at hand have to be.
    effort: Effort,
}

impl<'r> Underway<'r> {
    /// At the beginning of a course.
    ///
    /// # Errors
    /// Where the axes cannot begin so.
    pub(super) fn begin(
        rig: &Rig<'r>,
        course: &Course,
        branch: Branch,
        start: &Joints,
        least: &Clearance,
    ) -> Result<Self, Breach> {
        let begins_with = |what| Breach { at: 0.0, what };
        let way = ArmCourse::new(rig, course, branch).ok_or(begins_with(Violation::OutOfReach))?;
        let start = &way.begun(start).ok_or(begins_with(Violation::OutOfReach))?;
        let bounds = Bounds {
            axes: rig.axes,
            least: *least,
            duration: course.duration,
        };
        bounds
            .hold_values(&start.map(Interval::exactly))
            .map_err(begins_with)?;
        Ok(Self {
            way,
            progress: Progress::new(bounds, start),
            march: March::new(),
            effort: Effort::Tight,
        })
    }

    /// Continues after what was found of the span at hand; returns the result of the course once that is known.
    fn goes_on(&mut self, found: Result<Stretch, Violation>) -> Option<Result<Proof, Breach>> {
        let tried = self.progress.add(found, self.effort);
        if let Err((at, why)) = self.march.became(tried) {
            let what = why.finite();
            return Some(Err(Breach { at, what }));
        }
        self.march.is_over().then(|| Ok(self.proof()))
    }

    fn proof(&self) -> Proof {
        let enclosed = self.progress.end();
        // The enclosure of the end gives the turns; this is the end to the last digit.
        let end = self.way.joints_at(1.0, &enclosed).unwrap_or(enclosed);
        self.progress.done(end, self.march.tries() + 2)
    }

    /// The whole proof, span by span.
    fn alone(mut self) -> Result<Proof, Breach> {
        loop {
            let (span, effort) = self.march.next();
            self.effort = effort;
            let found = self.way.stretch(span, &self.progress.end());
            if let Some(proof) = self.goes_on(found) {
                return proof;
            }
        }
    }
}

/// What comes of all courses, in their order.
pub(super) fn finish(courses: Vec<Result<Underway<'_>, Breach>>) -> Vec<Result<Proof, Breach>> {
    let mut proofs = Vec::with_capacity(courses.len());
    let (mut straight, mut turning, mut round) = (Vec::new(), Vec::new(), Vec::new());
    for (index, course) in courses.into_iter().enumerate() {
        proofs.push(match course {
            Err(breach) => Err(breach),
            Ok(underway) => match (underway.way.solver, underway.way.flight.shape()) {
                (Solver::Numeric(_), _) => underway.alone(),
                (Solver::ClosedForm(..), shape) => {
                    let waiting = match shape {
                        Shape::Straight => &mut straight,
                        Shape::Turning => &mut turning,
                        Shape::Arc => &mut round,
                    };
                    waiting.push((index, underway));
                    // Known below.
                    Err(Breach {
                        at: 0.0,
                        what: Violation::OutOfReach,
                    })
                }
            },
        });
    }
    for waiting in [straight, turning, round] {
        for (index, proof) in abreast(waiting) {
            if let Some(place) = proofs.get_mut(index) {
                *place = proof;
            }
        }
    }
    proofs
}

/// Proves courses of one arm on one branch, all of one shape, in the order in which they come to their ends.
fn abreast(waiting: Vec<(usize, Underway<'_>)>) -> Vec<(usize, Result<Proof, Breach>)> {
    let Some(Solver::ClosedForm(arm, branch)) = waiting.first().map(|(_, first)| first.way.solver) else {
        return Vec::new();
    };
    let shape = waiting
        .first()
        .map_or(Shape::Straight, |(_, first)| first.way.flight.shape());
    let mut carrying = Carrying::new(arm, branch, shape);
    let mut proven = Vec::with_capacity(waiting.len());
    let mut waiting = waiting.into_iter();
    let mut lanes: [Option<(usize, Underway<'_>)>; LANES] = [const { None }; LANES];
    loop {
        let mut busy = 0;
        for (lane, place) in lanes.iter_mut().enumerate() {
            if place.is_none() {
                *place = waiting.next();
                if let Some((_, underway)) = place {
                    carrying.take(lane, &underway.way.flight);
                }
            }
            if let Some((_, underway)) = place {
                let (span, effort) = underway.march.next();
                underway.effort = effort;
                carrying.set(lane, span);
                busy += 1;
            }
        }
        if busy == 0 {
            return proven;
        }
        carrying.sweep();
        for (lane, place) in lanes.iter_mut().enumerate() {
            let done = place
                .as_mut()
                .and_then(|(index, underway)| Some((*index, underway.goes_on(carrying.stretch(lane))?)));
            if let Some(done) = done {
                proven.push(done);
                *place = None;
            }
        }
    }
}
