//! What the axes of an arm do on parts of the motions of its program: enclosed, for bounds that hold everywhere.

use super::moves::paths;
use super::path::{ArmWay, Course, Part};
use super::rigs::Rigs;
use vcutc_backend_api::ir::OpId;
use vcutc_backend_api::motion::ReachableProgram;
use vcutc_backend_api::segments::{LinearSegment, Path};
use vcutc_geometry::number::Along;
use vcutc_machine::kinematics::Joints;

/// A part of a course is at most this long at first, in mm, and the blade, or an axis that moves by itself, turns by at most
/// [`FIRST_TURN`] on it.
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

/// What an op moves.
pub struct Moving<'p> {
    axes: Axes<'p>,
    /// Into how many parts it is divided at first.
    pub parts: u32,
}

enum Axes<'p> {
    Carrying(ArmWay<'p>),
    /// The axes move by themselves, from the first values to the second.
    Themselves(Joints, Joints),
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

    /// What an op moves; none of an op that moves nothing, whose start is not known, or whose arm has no closed form.
    #[must_use]
    pub fn moving(&self, op: OpId) -> Option<Moving<'p>> {
        match self.paths.get(op.0 as usize)? {
            Path::Still => None,
            Path::Home | Path::Change | Path::Axes(_) => {
                let start = self.reached.axes_before(op)?.0;
                let end = self.reached.axes_after(op)?.0;
                let pairs = start.iter().zip(&end);
                let turn = pairs.fold(0.0, |most, (from, to)| f64::max(most, (to - from).abs()));
                Some(Moving {
                    axes: Axes::Themselves(start, end),
                    parts: count(turn / FIRST_TURN),
                })
            }
            Path::Linear(line) => self.carrying(op, line),
        }
    }

    fn carrying(&self, op: OpId, line: &LinearSegment) -> Option<Moving<'p>> {
        let course = Course::of(self.reached.program(), line)?;
        let branch = self.reached.branch_after(op)?;
        let way = ArmWay::new(self.rigs.during(op), &course, branch)?;
        let turn = line.arc().map_or(0.0, |arc| arc.sweep().to_rad());
        let turn = turn.max(line.turn.to_rad()) / FIRST_TURN;
        Some(Moving {
            axes: Axes::Carrying(way),
            parts: count(turn.max(line.length().to_mm() / FIRST_WAY)),
        })
    }
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
        match &self.axes {
            Axes::Carrying(way) => way.axes_on(part),
            Axes::Themselves(from, to) => Some(core::array::from_fn(|axis| {
                let way = to[axis] - from[axis];
                Along::line(from[axis] + way * part.middle, way * part.half)
            })),
        }
    }
}
