//! What the axes of an arm do on parts of the motions of its program: enclosed, for bounds that hold everywhere.

use super::moves::{numbered, paths};
use super::path::{ArmWay, Course, Part, evenly};
use super::rigs::Rigs;
use vcutc_backend_api::ir::OpId;
use vcutc_backend_api::motion::ReachableProgram;
use vcutc_backend_api::segments::{LinearSegment, Path};
use vcutc_geometry::number::Along;
use vcutc_machine::kinematics::Joints;

/// A part of a course is at most this long at first, in mm, and blade, way and axes turn by at most [`FIRST_TURN`] on it.
const FIRST_WAY: f64 = 250.0;
/// In rad: 15 deg.
const FIRST_TURN: f64 = core::f64::consts::PI / 12.0;
/// Most parts of a motion at first.
const MOST_PARTS: f64 = 4096.0;

/// The motions of a program, each on its own.
#[derive(Debug)]
pub struct Motions<'p> {
    reached: &'p ReachableProgram,
    rigs: &'p Rigs<'p>,
    paths: Vec<Path>,
}

/// A motion that the arm makes.
pub struct Moving<'p> {
    how: How<'p>,
    /// Into how many parts it is divided at first.
    pub parts: u32,
    /// How long it takes in s; see [`even_time`].
    pub lasts: Option<f64>,
}

enum How<'p> {
    /// The tip follows a line or an arc.
    Course(ArmWay<'p>),
    /// Each axis goes straight from one value to another.
    Axes { from: Joints, to: Joints },
}

impl<'p> Motions<'p> {
    #[must_use]
    pub fn of(reached: &'p ReachableProgram, rigs: &'p Rigs<'p>) -> Self {
        Self {
            reached,
            rigs,
            paths: paths(reached.program()),
        }
    }

    /// The ops that move.
    pub fn ops(&self) -> impl Iterator<Item = OpId> {
        let moving = numbered(&self.paths).filter(|(_, path)| **path != Path::Still);
        moving
            .map(|(op, _)| op)
            .filter(|op| self.reached.axes_after(*op).is_some())
    }

    /// The axes at the end of an op.
    #[must_use]
    pub fn end(&self, op: OpId) -> Option<Joints> {
        Some(self.reached.axes_after(op)?.0)
    }

    /// The motion of an op; none of an op that moves nothing, and of lines and arcs of an arm without a closed form.
    #[must_use]
    pub fn moving(&self, op: OpId) -> Option<Moving<'p>> {
        match self.paths.get(op.0 as usize)? {
            Path::Still => None,
            path @ Path::Linear(line) => self.along(op, line, even_time(path)),
            Path::Home | Path::Change | Path::Axes(_) => self.of_axes(op),
        }
    }

    fn along(&self, op: OpId, line: &LinearSegment, lasts: Option<f64>) -> Option<Moving<'p>> {
        let course = Course::of(self.reached.program(), line)?;
        let branch = self.reached.branch_after(op)?;
        let way = ArmWay::new(self.rigs.during(op), &course, branch)?;
        let turn = line.arc().map_or(0.0, |arc| arc.sweep().to_rad());
        let turn = turn.max(line.turn.to_rad()) / FIRST_TURN;
        Some(Moving {
            how: How::Course(way),
            parts: count(turn.max(line.length().to_mm() / FIRST_WAY)),
            lasts,
        })
    }

    fn of_axes(&self, op: OpId) -> Option<Moving<'p>> {
        let to = self.end(op)?;
        // Of the first motion of a machine without a home only its end is known.
        let from = self.reached.axes_before(op).map_or(to, |before| before.0);
        let turns = from.iter().zip(to).map(|(from, to)| (to - from).abs());
        Some(Moving {
            how: How::Axes { from, to },
            parts: count(turns.fold(0.0, f64::max) / FIRST_TURN),
            lasts: None,
        })
    }
}

/// How long a motion takes in s whose rate is constant; none where that depends on the control: it slows down where an arc bends, and
/// moves of all axes go by a course of its own.
#[must_use]
pub fn even_time(path: &Path) -> Option<f64> {
    let line = path.line().filter(|line| line.via.is_none())?;
    Some(line.duration().to_s()).filter(|time| *time > 0.0)
}

fn count(parts: f64) -> u32 {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "between one and a few thousand"
    )]
    let count = parts.clamp(1.0, MOST_PARTS).ceil() as u32;
    count
}

impl Moving<'_> {
    /// The controller's axes on a part, each up to whole turns, by a parameter that goes from -1 to 1 on the part. None where the part
    /// is too long to say.
    #[must_use]
    pub fn axes_on(&self, part: Part) -> Option<[Along; 6]> {
        match &self.how {
            How::Course(way) => way.axes_on(part),
            How::Axes { from, to } => Some(evenly(from, to, part.middle, part.half)),
        }
    }
}
