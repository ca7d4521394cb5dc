//! The room beside the stock that the turns of a five-axis machine need.

use vcutc_backend_api::units::Length;
use vcutc_geometry::grid;
use vcutc_job::{CheckedJob, PlannedJob};
use vcutc_motion::solve::Unreached;
use vcutc_motion::sweep::Cure;
use vcutc_motion::trouble::Trouble;

/// The job with the room that the turns of its machine need, and `run_out` as well. None where something else
/// is in the way, or the job states that room itself.
#[must_use]
pub fn farther_out(job: &CheckedJob, plan: &PlannedJob, why: &Unreached) -> Option<CheckedJob> {
    let unreachable = why.unreachable()?;
    let sweep = match &unreachable.trouble {
        Trouble::Sweep(sweep) => sweep,
        Trouble::Motion { .. }
        | Trouble::NoCommonBranch { .. }
        | Trouble::Way { .. }
        | Trouble::Stray(_)
        | Trouble::Nowhere => return None,
    };
    let by = match sweep.cure {
        Cure::FartherOut(by) => by,
        Cure::HigherUp(_) | Cure::Unknown => return None,
    };
    let program = unreachable.program.program();
    let operation = program.op(sweep.op)?.site.operation()?;
    let place = usize::from(operation.0);
    let planned = plan.operation(operation)?;
    let mut roomier = job.clone();
    let setup = roomier.operations.get_mut(place)?.setup_mut();
    if !setup.leaves_turning_room() {
        return None;
    }
    let needed = setup.turning_room(planned.extension()) + by + setup.run_out.value;
    setup.set_turning_room(Length::mm(grid::up(needed.to_mm())));
    Some(roomier)
}
