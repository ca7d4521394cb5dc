//! What a compiler that runs again and again keeps of its runs before.
//!
//! Between two runs of a job little changes: a comment, a speed, an option of the target. What takes nearly all the time are
//! two pure functions, the choice of what the job leaves open and the proof that the machine follows. Their answers are kept
//! with all that they were asked, but for the places in the text: a plan is for the same cuts wherever its job is written.
//!
//! A stale answer cannot be used. Questions are compared by value; only what is left out of them on purpose could mislead,
//! and that is little: of a job the places and the options of targets, which the planner does not read and which the plan is
//! given again, and of a program the places that its operations come from. A motion that was kept is also
//! compared with its program once more before the two are given out ([`again`]).
//!
//! How much is kept is bounded by a number of cuts and ops in all. A memory without room keeps nothing, and costs nothing.

mod shelf;
#[cfg(test)]
mod tests;

use shelf::Shelf;
use std::sync::Arc;
use vcutc_backend_api::ir::Program;
use vcutc_backend_api::verify::VerifiedProgram;
use vcutc_cancellation::Wanted;
use vcutc_job::CheckedJob;
use vcutc_job::PlannedJob;
use vcutc_job::search::SearchSpace;
use vcutc_job::sema::kept_surfaces::Surfaces;
use vcutc_machine::Model;
use vcutc_motion::solve::{
    Changes, Found, LEAST_CLEARANCE, Reached, Unreachable, Unreached, again, solve_while,
};
use vcutc_motion::trouble::Trouble;
use vcutc_process::plan::{self, Refusal};

/// Most cuts and ops of all that is kept: some 100 MB.
const ROOM: usize = 400_000;

/// What a choice was asked.
#[derive(Debug, PartialEq)]
struct Open {
    /// Without its places and targets.
    job: CheckedJob,
    space: SearchSpace,
}

/// What a machine was asked.
#[derive(Debug, PartialEq)]
struct Put {
    /// Without its places.
    program: Program,
    model: Arc<Model>,
    changes: Changes,
}

/// What is kept. Without room at first.
#[derive(Debug)]
pub struct Memory {
    plans: Shelf<Open, PlannedJob>,
    motions: Shelf<Put, Result<Found, Trouble>>,
    /// None without room.
    surfaces: Option<Surfaces>,
}

impl Memory {
    /// A memory that keeps nothing, for a single compilation.
    #[must_use]
    pub const fn none() -> Self {
        Self::with_room(0, None)
    }

    /// A memory for repeated compilations.
    #[must_use]
    pub fn of_some_runs() -> Self {
        Self::with_room(ROOM, Some(Surfaces::default()))
    }

    /// The surfaces of files that were read before, for checks of a job; none without room.
    #[must_use]
    pub const fn surfaces(&self) -> Option<&Surfaces> {
        self.surfaces.as_ref()
    }

    const fn with_room(room: usize, surfaces: Option<Surfaces>) -> Self {
        Self {
            surfaces,
            plans: Shelf::with_room(room),
            motions: Shelf::with_room(room),
        }
    }

    /// As [`plan::plan_while`]. What was cut short is not kept.
    ///
    /// # Errors
    /// As for [`plan::plan_while`].
    pub(crate) fn choose<'j>(
        &mut self,
        job: &'j CheckedJob,
        space: SearchSpace,
        wanted: &Wanted,
    ) -> Result<PlannedJob, Refusal<'j>> {
        if !self.plans.takes(0) {
            return plan::plan_while(job, space, wanted);
        }
        let mut without_places = job.without_places();
        if let Some(machine) = &mut without_places.machine {
            machine.targets.clear();
        }
        let open = Open {
            job: without_places,
            space,
        };
        if let Some(plan) = self.plans.find(&open) {
            return Ok(of(job, plan.clone()));
        }
        // Refusals know their places, and are few: they are found again.
        let plan = plan::plan_while(job, space, wanted)?;
        if !wanted.is_needless() && is_of(job, &plan) {
            self.plans.keep(open, plan.clone(), size(&plan));
        }
        Ok(plan)
    }

    /// As [`solve_while`], nowhere nearer to singular poses than everywhere in the compiler. What was cut short is not kept.
    ///
    /// # Errors
    /// As for [`solve_while`].
    pub(crate) fn reach(
        &mut self,
        program: VerifiedProgram,
        model: &Arc<Model>,
        changes: Changes,
        wanted: &Wanted,
    ) -> Result<Reached, Unreached> {
        let size = program.program().ops.len();
        if !self.motions.takes(size) {
            return solve_while(program, model, &LEAST_CLEARANCE, changes, wanted);
        }
        let put = Put {
            program: without_places(program.program()),
            model: Arc::clone(model),
            changes,
        };
        match self.motions.find(&put) {
            Some(Ok(found)) => return again(program, model, found.clone()),
            Some(Err(trouble)) => {
                let trouble = *trouble;
                return Err(Unreached::Unreachable(Box::new(Unreachable { program, trouble })));
            }
            None => {}
        }
        let reached = solve_while(program, model, &LEAST_CLEARANCE, changes, wanted);
        if wanted.is_needless() {
            return reached;
        }
        match &reached {
            Ok(reached) => self.motions.keep(put, Ok(reached.found()), size),
            Err(Unreached::Unreachable(unreachable)) => {
                self.motions.keep(put, Err(unreachable.trouble), size);
            }
            // A fault of the compiler: it is not to be covered up.
            Err(Unreached::Rules(_) | Unreached::Motion(_)) => {}
        }
        reached
    }
}

/// A plan for a job with the places and the targets of this one.
fn of(job: &CheckedJob, mut plan: PlannedJob) -> PlannedJob {
    plan.machine.clone_from(&job.machine);
    for (planned, operation) in plan.operations.iter_mut().zip(&job.operations) {
        planned.set_asked(&**operation);
    }
    plan
}

/// Whether a plan repeats what its job asks, word for word, so that [`of`] may replace it.
fn is_of(job: &CheckedJob, plan: &PlannedJob) -> bool {
    let operations = plan.operations.iter().zip(&job.operations);
    plan.machine == job.machine
        && plan.operations.len() == job.operations.len()
        && operations
            .into_iter()
            .all(|(planned, operation)| planned.asked() == &**operation)
}

/// How much room a plan takes, in cuts.
fn size(plan: &PlannedJob) -> usize {
    let operations = plan.operations.iter();
    operations
        .map(|planned| 1 + planned.cuts() + planned.bound().part.points().len())
        .sum()
}

fn without_places(program: &Program) -> Program {
    let mut program = program.clone();
    for operation in &mut program.operations {
        operation.source.file.clear();
        (operation.source.start, operation.source.end) = (0, 0);
    }
    program
}
