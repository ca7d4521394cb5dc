//! Points on the way of motions in which the wrist turns far, for controllers that need them.
//!
//! The axes are followed along the course in steps that are halved until none of the wrist's axes turns by more than
//! [`CLOSE`] in one, so that which turn of an axis is meant is never in doubt, near singular poses either. Of these places
//! [`wrist::spaced`] chooses.

use super::path::{Course, joints_on};
use super::rig::Rig;
use super::rigs::Rigs;
use vcutc_backend_api::ir::{AxisValues, Maker, OpId, Program};
use vcutc_backend_api::motion::{Branch, Motion, Waypoint};
use vcutc_backend_api::segments::{LinearSegment, Path};
use vcutc_backend_api::units::Angle;
use vcutc_backend_api::wrist;
use vcutc_machine::kinematics::Joints;

/// By how much an axis of the wrist turns at most from one step to the next.
const CLOSE: Angle = Angle::deg(5.0);
/// The longest step, as a part of the course.
const LONGEST: f64 = 1.0 / 64.0;
/// The shortest one. A course on which this is not short enough passes a singular pose, and was not proven.
const SHORTEST: f64 = 1.0 / 1_048_576.0;

/// The waypoints of a program's motion: for ABB's robots, whose controllers refuse to turn a wrist far in one move; none for
/// others.
pub(super) fn waypoints(program: &Program, rigs: &Rigs<'_>, motion: &Motion) -> Vec<Waypoint> {
    let maker = program.cell.as_ref().map(|cell| cell.maker);
    match maker {
        Some(Maker::Abb) => {}
        Some(Maker::Kuka | Maker::Other) | None => return Vec::new(),
    }
    let mut found = Vec::new();
    let mut branches = motion.stretches.iter().peekable();
    let mut branch = None;
    let mut before: Option<AxisValues> = None;
    for (segment, end) in program.segments().zip(&motion.ends) {
        let op = segment.id;
        while let Some(stretch) = branches.next_if(|stretch| stretch.from <= op) {
            branch = Some(stretch.branch);
        }
        if let (Path::Linear(line), Some(start), Some(branch)) = (segment.path(), before, branch)
            && wrist::turn(&start, end) > wrist::FAR
        {
            found.extend(on_the_way(
                program,
                rigs.during(op),
                (op, &line),
                branch,
                [&start.0, &end.0],
            ));
        }
        before = Some(*end);
    }
    found
}

/// The waypoints of one line.
fn on_the_way(
    program: &Program,
    rig: &Rig<'_>,
    (op, line): (OpId, &LinearSegment),
    branch: Branch,
    ends: [&Joints; 2],
) -> Vec<Waypoint> {
    let Some(course) = Course::of(program, line) else {
        return Vec::new();
    };
    let [start, end] = ends.map(|joints| AxisValues(*joints));
    let chosen = wrist::spaced(start, &steps(rig, &course, branch, ends), end);
    chosen
        .into_iter()
        .filter_map(|(done, axes)| {
            let frame = line.frame_at(program, done)?;
            Some(Waypoint {
                op,
                done,
                frame,
                axes,
            })
        })
        .collect()
}

/// The axes at places of a course that lie close together, its ends left out; up to where they cannot be followed.
fn steps(rig: &Rig<'_>, course: &Course, branch: Branch, ends: [&Joints; 2]) -> Vec<(f64, AxisValues)> {
    let mut found = Vec::new();
    let mut at = (0.0, AxisValues(*ends[0]));
    let mut step = LONGEST;
    while at.0 + step < 1.0 && step >= SHORTEST {
        let place = at.0 + step;
        let there = joints_on(rig, course, branch, ends, place, &at.1.0).map(AxisValues);
        match there.filter(|there| wrist::turn(&at.1, there) <= CLOSE) {
            Some(there) => {
                at = (place, there);
                found.push(at);
                step = (2.0 * step).min(LONGEST);
            }
            None => step /= 2.0,
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::path::prove;
    use crate::solve::LEAST_CLEARANCE;
    use proptest::prelude::*;
    use vcutc_backend_api::geometry::{Frame, Orientation, Point3};
    use vcutc_backend_api::motion::{Elbow, Shoulder, Wrist};
    use vcutc_machine::catalogue;
    use vcutc_machine::kinematics::pose::Pose;

    const TOOL: Frame = Frame {
        origin: Point3 {
            x: 0.0,
            y: 0.0,
            z: 310.0,
        },
        orientation: Orientation::IDENTITY,
    };
    const BASE: Frame = Frame {
        origin: Point3 {
            x: 0.0,
            y: 0.0,
            z: 0.0,
        },
        orientation: Orientation::IDENTITY,
    };

    proptest! {
        /// Random turns about the tip and moves of an ABB robot whose proof is at hand: every waypoint is on the course by an
        /// interpolation of its own, and the axes of the wrist turn little from one to the next.
        #[test]
        fn waypoints_lie_on_the_course_and_close_enough(
            first in [-40.0..40.0_f64, -20.0..40.0, -30.0..30.0, -90.0..90.0, 15.0..100.0, -90.0..90.0],
            turns in [-8.0..8.0_f64, -5.0..5.0, -5.0..5.0, -170.0..170.0, -60.0..60.0, -170.0..170.0],
        ) {
            let mut model = catalogue::find("abb/irb6700_155_285").unwrap();
            for axis in &mut model.axes {
                (axis.min, axis.max, axis.rate) = (-100.0, 100.0, None);
            }
            let rig = Rig::new(&model, TOOL, BASE);
            let branch = Branch::Arm {
                shoulder: Shoulder::Front,
                elbow: Elbow::Forward,
                wrist: Wrist::Positive,
            };
            let start: Joints = first.map(f64::to_radians);
            let wanted: Joints = core::array::from_fn(|axis| start[axis] + turns[axis].to_radians());
            let course = Course { arc: None,
                from: rig.blade_in_work(&start),
                to: rig.blade_in_work(&wanted),
                duration: 1.0,
            };
            let Ok(proof) = prove(&rig, &course, branch, &start, &LEAST_CLEARANCE) else {
                return Ok(());
            };
            let samples = steps(&rig, &course, branch, [&start, &proof.end]);
            let (begin, end) = (AxisValues(start), AxisValues(proof.end));
            let chosen = wrist::spaced(begin, &samples, end);
            prop_assert_eq!(chosen.is_empty(), wrist::turn(&begin, &end) <= wrist::FAR);
            let [from, to] = [course.from, course.to].map(Frame::from);
            let mut last = begin;
            for (done, axes) in &chosen {
                prop_assert!(wrist::turn(&last, axes) <= wrist::FAR);
                last = *axes;
                let is: Pose = rig.blade_in_work(&axes.0);
                let is = Frame::from(is);
                let between = |from: f64, to: f64| from + (to - from) * done;
                let should = Point3::new(
                    between(from.origin.x, to.origin.x),
                    between(from.origin.y, to.origin.y),
                    between(from.origin.z, to.origin.z),
                );
                prop_assert!(is.origin.distance(should).to_mm() < 1e-6);
                let held = from.orientation.towards(to.orientation, *done);
                prop_assert!(is.orientation.angle_to(held).to_rad() < 1e-7);
            }
            prop_assert!(wrist::turn(&last, &end) <= wrist::FAR);
        }
    }
}
