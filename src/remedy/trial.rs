//! Trials: by a few motions, and through the whole pipeline.

use crate::farther_out;
use vcutc_backend_api::ir::Program;
use vcutc_backend_api::verify::verify;
use vcutc_cancellation::Wanted;
use vcutc_diagnostics::source::SourceMap;
use vcutc_job::PlannedJob;
use vcutc_job::{CheckedJob, Machine};
use vcutc_motion::ceiling::at_their_slowest;
use vcutc_motion::critical::motions::{CriticalMotions, as_followed};
use vcutc_motion::rig::Rig;
use vcutc_motion::solve::{Changes, LEAST_CLEARANCE, Reached, Unreached, solve_while};
use vcutc_process::lower;
use vcutc_process::verdict;

/// Most extensions that are tried in turn for one change, as turns of a five-axis machine need them.
const MOST_EXTENSIONS: usize = 3;

/// Whether the machine of a plan follows its critical motions, with the slowest turns that are allowed. What cannot be asked is
/// promising.
#[must_use]
pub fn looks_promising(plan: &PlannedJob) -> bool {
    let program = verify(lower::lower(plan, &SourceMap::default()));
    match (&plan.machine, program) {
        (Some(machine), Ok(program)) => {
            let program = program.program();
            let slowest = at_their_slowest(program);
            follows(machine, slowest.as_ref().unwrap_or(program))
        }
        (None, _) | (_, Err(_)) => true,
    }
}

/// What a machine makes of a program, as far as its critical motions show.
pub(crate) fn on_machine(machine: &Machine, program: &Program) -> Option<Program> {
    if program.blades.len() > 1 {
        return Some(program.clone());
    }
    as_followed(&Rig::of(machine), program)
}

/// For a program with several blades, which this look does not distinguish, only the proof answers.
fn follows(machine: &Machine, program: &Program) -> bool {
    program.blades.len() > 1 || CriticalMotions::of(program).are_each_followed(&Rig::of(machine))
}

/// A changed job through the whole pipeline; nothing where it does not come out at its end.
pub(crate) fn planned_again(mut job: CheckedJob, wanted: &Wanted) -> Option<Reached> {
    for _ in 0..MOST_EXTENSIONS {
        let (plan, proven) = verdict::sound(&job, wanted)?;
        let machine = job.machine.as_ref()?;
        if !follows(machine, proven.program.program()) {
            return None;
        }
        let (model, changes) = (&machine.model, Changes::Never);
        match solve_while(proven.program, model, &LEAST_CLEARANCE, changes, wanted) {
            Ok(reached) => return Some(reached),
            Err(why) => job = farther_out(&job, &plan, &why)?,
        }
    }
    None
}

/// A plan on a machine that may have changed. The cuts do not depend on the machine, so they stay proven.
///
/// # Errors
/// Why the machine cannot carry it out.
pub fn carried_out(plan: &PlannedJob, machine: &Machine, wanted: &Wanted) -> Result<Reached, Unreached> {
    let mut changed = plan.clone();
    changed.machine = Some(machine.clone());
    let program = verify(lower::lower(&changed, &SourceMap::default())).map_err(Unreached::Rules)?;
    let (model, changes) = (&machine.model, Changes::Never);
    solve_while(program, model, &LEAST_CLEARANCE, changes, wanted)
}
