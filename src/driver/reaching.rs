//! How the job's machine carries out its program, and what that asks of the program: turns of a five-axis machine at the rate that
//! the job allows its blade, and cuts that run out as far as those turns need.

use super::{Finished, Run, Stage};
use vcutc_backend_api::ir::MachineKind;
use vcutc_backend_api::verify::{VerifiedProgram, verify};
use vcutc_job::CheckedJob;
use vcutc_job::PlannedJob;
use vcutc_motion::reorient::slowed;
use vcutc_motion::solve::{Changes, Unreached};

/// Finds how the job's machine carries out its program; a job without a machine has nothing to find.
pub(super) fn reach(
    job: &CheckedJob,
    program: VerifiedProgram,
    changes: Changes,
    run: &mut Run<'_>,
    progress: &mut dyn FnMut(Stage),
) -> Result<Finished, Unreached> {
    let Some(machine) = &job.machine else {
        return Ok(Finished::WithoutMachine(Box::new(program)));
    };
    progress(Stage::Reaching);
    let asked = match machine.model.kind() {
        MachineKind::FiveAxis => Some(program.clone()),
        MachineKind::Robot => None,
    };
    let mut reached = run.memory.reach(program, &machine.model, changes, run.wanted)?;
    let motion = reached.program.motion();
    let slowed = asked.and_then(|asked| slowed(asked.program(), motion, &machine.model.mechanism));
    if let Some(slowed) = slowed {
        let slowed = verify(slowed).map_err(Unreached::Rules)?;
        reached = run.memory.reach(slowed, &machine.model, changes, run.wanted)?;
    }
    Ok(Finished::Reached(Box::new(reached)))
}

/// A plan whose extensions are still the compiler's choice where the job leaves them open, though the turns have decided them.
pub(super) fn as_asked(mut plan: PlannedJob, job: &CheckedJob) -> PlannedJob {
    for (planned, operation) in plan.operations.iter_mut().zip(&job.operations) {
        let (setup, asked) = (planned.asked_mut().setup_mut(), operation.setup());
        setup.extension = asked.extension;
        setup.run_out = asked.run_out;
    }
    plan
}
