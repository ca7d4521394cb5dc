//! What the ops of a program move, as values that can be proven in any order.

use vcutc_backend_api::ir::{Action, OpId, Program};
use vcutc_backend_api::segments::{LimitedBy, Path, Segment};
use vcutc_job::setup::SpeedField;
use vcutc_machine::kinematics::pose::Pose;

/// What each op of a program moves. A line that takes no time leads nowhere, and moves nothing.
#[must_use]
pub fn paths(program: &Program) -> Vec<Path> {
    program.segments().map(|segment| path(&segment)).collect()
}

/// What one op moves.
#[must_use]
pub fn path_of(program: &Program, op: OpId) -> Option<Path> {
    Some(path(&program.segment(op)?))
}

fn path(segment: &Segment<'_>) -> Path {
    match segment.path() {
        Path::Linear(line) if line.limited_by().is_none() => Path::Still,
        path => path,
    }
}

/// Paths with the numbers of their ops.
pub fn numbered(paths: &[Path]) -> impl Iterator<Item = (OpId, &Path)> {
    (0..).map(OpId).zip(paths)
}

/// The field that says how fast an op goes.
#[must_use]
pub fn pacing(program: &Program, op: OpId) -> Option<SpeedField> {
    let segment = program.segment(op)?;
    Some(match (segment.line()?.limited_by()?, segment.op.action) {
        (LimitedBy::Rate(_), _) => SpeedField::Reorient,
        (LimitedBy::Feed(_), Action::Cut { .. }) => SpeedField::Cut,
        (LimitedBy::Feed(_), _) => SpeedField::Travel,
    })
}

/// The blade frame T in W at a height (mm) above the first pose of a program.
#[must_use]
pub fn above_first_pose(program: &Program, height: f64) -> Option<Pose> {
    let first = program.segments().find_map(|segment| segment.target())?;
    let mut blade = program.frame(first)?;
    blade.origin.z += height;
    Some(Pose::from(blade))
}
