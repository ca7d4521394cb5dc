//! What the axes of an arm do on parts of the motions of its program: enclosed, for bounds that hold everywhere.

use super::moves::paths;
use super::path::{ArmWay, Course, Part};
use super::rigs::Rigs;
use vcutc_backend_api::ir::OpId;
use vcutc_backend_api::motion::ReachableProgram;
use vcutc_backend_api::segments::Path;
use vcutc_geometry::number::Along;

/// A part of a course is at most this long at first, in mm, and blade and way turn by at most [`FIRST_TURN`] on it.
const FIRST_WAY: f64 = 250.0;
/// In rad: 15 deg.
const FIRST_TURN: f64 = core::f64::consts::PI / 12.0;
/// Most parts of a motion at first.
const MOST_PARTS: f64 = 4096.0;

/// The lines and arcs of a program, each on its own.
#[derive(Debug)]
pub struct Motions<'p> {
    reached: &'p ReachableProgram,
    rigs: &'p Rigs<'p>,
    paths: Vec<Path>,
}

/// A line or an arc that the arm follows.
pub struct Moving<'p> {
    way: ArmWay<'p>,
    /// Into how many parts it is divided at first.
    pub parts: u32,
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

    /// The line or the arc of an op; none of an op that has none, or whose arm has no closed form.
    #[must_use]
    pub fn moving(&self, op: OpId) -> Option<Moving<'p>> {
        let line = self.paths.get(op.0 as usize)?.line()?;
        let course = Course::of(self.reached.program(), line)?;
        let branch = self.reached.branch_after(op)?;
        let way = ArmWay::new(self.rigs.during(op), &course, branch)?;
        let turn = line.arc().map_or(0.0, |arc| arc.sweep().to_rad());
        let turn = turn.max(line.turn.to_rad()) / FIRST_TURN;
        Some(Moving {
            way,
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
        self.way.axes_on(part)
    }
}
