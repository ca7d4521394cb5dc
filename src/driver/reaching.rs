//! How the job's machine carries out its program, and what that asks of the program: turns of a five-axis machine at the rate that
//! the job allows its blade, and cuts that run out as far as those turns need.

use super::{Finished, Run, Stage};
use std::sync::Arc;
use vcutc_backend_api::ir::Program;
use vcutc_backend_api::verify::{VerifiedProgram, verify};
use vcutc_job::CheckedJob;
use vcutc_job::PlannedJob;
use vcutc_machine::Model;
use vcutc_motion::ceiling;
use vcutc_motion::path::Violation;
use vcutc_motion::reorient::slowed;
use vcutc_motion::solve::{Changes, Reached, Unreachable, Unreached};

/// A program that the job's machine carries out.
pub(super) struct CarriedOut {
    pub(super) program: Finished,
    /// None where the machine follows all turns at the rate that the job states.
    pub(super) slowed: Option<Box<Slowed>>,
}

/// What turns of the blade were made slower for.
pub(super) struct Slowed {
    /// What keeps the machine from turns at the rate that the job states.
    pub(super) unreachable: Unreachable,
    /// The program with these.
    pub(super) stated: Program,
}

/// Finds how the job's machine carries out its program; a job without a machine has nothing to find.
pub(super) fn reach(
    job: &CheckedJob,
    program: VerifiedProgram,
    changes: Changes,
    run: &mut Run<'_>,
    progress: &mut dyn FnMut(Stage),
) -> Result<CarriedOut, Unreached> {
    let Some(machine) = &job.machine else {
        return Ok(CarriedOut {
            program: Finished::WithoutMachine(Box::new(program)),
            slowed: None,
        });
    };
    progress(Stage::Reaching);
    let model = &machine.model;
    let (mut reached, refused) = match run.memory.reach(program.clone(), model, changes, run.wanted) {
        Err(Unreached::Unreachable(why)) => match with_slower_turns(&program, &why, model, changes, run) {
            Ok(reached) => (reached, Some(why)),
            Err(other) => return Err(Unreached::Unreachable(other.unwrap_or(why))),
        },
        reached => (reached?, None),
    };
    let along_its_way = slowed(program.program(), reached.program.motion(), &model.mechanism);
    if let Some(along_its_way) = &along_its_way {
        let slower = match &refused {
            Some(_) => ceiling::slower_of(along_its_way, reached.program.program()),
            None => None,
        };
        let slower = verify(slower.unwrap_or_else(|| along_its_way.clone())).map_err(Unreached::Rules)?;
        reached = run.memory.reach(slower, model, changes, run.wanted)?;
    }
    let slowed = refused.map(|unreachable| {
        Box::new(Slowed {
            unreachable: *unreachable,
            stated: along_its_way.unwrap_or_else(|| program.program().clone()),
        })
    });
    if let Some(Slowed { unreachable, stated }) = slowed.as_deref() {
        reached.report.slower = ceiling::too_slow(unreachable)
            .and_then(|too_slow| ceiling::figures(stated, reached.program.program(), too_slow));
    }
    Ok(CarriedOut {
        program: Finished::Reached(Box::new(reached)),
        slowed,
    })
}

/// How the program is carried out with its turns as fast as the axes follow, where these are too slow for the rate that the job states.
///
/// # Errors
/// What keeps the machine from it however slowly the blade turns, where that is something else.
fn with_slower_turns(
    program: &VerifiedProgram,
    why: &Unreachable,
    model: &Arc<Model>,
    changes: Changes,
    run: &mut Run<'_>,
) -> Result<Reached, Option<Box<Unreachable>>> {
    ceiling::too_slow(why).ok_or(None)?;
    let slowest = ceiling::at_their_slowest(program.program()).ok_or(None)?;
    let slowest = verify(slowest).map_err(|_| None)?;
    let slowest = match run.memory.reach(slowest, model, changes, run.wanted) {
        Ok(reached) => reached,
        Err(Unreached::Unreachable(why)) => return Err(Some(why).filter(|why| !is_of_rates(why))),
        Err(Unreached::Rules(_) | Unreached::Motion(_)) => return Err(None),
    };
    let followed = ceiling::as_fast_as_followed(program.program(), &slowest, model).ok_or(None)?;
    let followed = verify(followed).map_err(|_| None)?;
    run.memory
        .reach(followed, model, changes, run.wanted)
        .map_err(|_| None)
}

/// Whether an axis is too slow.
fn is_of_rates(unreachable: &Unreachable) -> bool {
    let failing = unreachable.trouble.hardest();
    failing.is_some_and(|failing| matches!(failing.worst.what, Violation::Rate { .. }))
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
