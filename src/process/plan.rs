//! From a checked job to its plan: every operation plans itself on what those before it left of the stock.

use vcutc_cancellation::{Effort, Wanted};
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_geometry::profile::Profile;
use vcutc_job::operation::{Ground, Laid, Operation, Settled, Unplanned, WorksThere};
use vcutc_job::search::{RouteSet, SearchSpace};
use vcutc_job::{CheckedJob, Part, PlannedJob, PlanningJob};
use vcutc_simulation::surface::Surface;

/// Most cuts that a job may have. A cut takes seconds, so a program of this size runs for weeks.
pub const MOST_CUTS: usize = 4_000_000;

/// Most operations that a job may have.
pub const MOST_OPERATIONS: usize = 1000;

/// Makes every choice. Without errors there is a plan.
#[must_use]
pub fn plan(job: &CheckedJob) -> (Option<PlannedJob>, Vec<Diagnostic>) {
    plan_within(job, SearchSpace::along(RouteSet::Full))
}

/// Makes every choice, with some routes and swings left out.
#[must_use]
pub fn plan_within(job: &CheckedJob, space: SearchSpace) -> (Option<PlannedJob>, Vec<Diagnostic>) {
    match plan_while(job, space, &Wanted::ALWAYS) {
        Ok(plan) => (Some(plan), Vec::new()),
        Err(refusal) => (None, refusal.with_help(&Wanted::ALWAYS, &mut |_| true)),
    }
}

/// As [`plan_within`] while the plan is wanted. What is found afterwards is discarded ([`Wanted::answer`]).
///
/// # Errors
/// Why there is no plan: at once, before anything that helps is looked for.
pub fn plan_while<'j>(
    job: &'j CheckedJob,
    space: SearchSpace,
    wanted: &Wanted,
) -> Result<PlannedJob, Refusal<'j>> {
    if let Some(one) = job.operations.get(MOST_OPERATIONS) {
        return Err(Refusal::Whole(Box::new(too_many(&**one, job.operations.len()))));
    }
    let Some(planning) = PlanningJob::of(job) else {
        return Err(Refusal::Whole(Box::new(without_lines(job))));
    };
    let mut unplanned: Vec<Box<dyn Unplanned + 'j>> = Vec::new();
    let mut ground = first_ground(&planning, space, wanted);
    let mut operations = Vec::new();
    for operation in &job.operations {
        // What takes off what others leave has nothing to go by where one of these has no plan.
        if !unplanned.is_empty() && operation.takes_off().is_some() {
            continue;
        }
        match operation.plan(ground.clone()) {
            Ok(Laid { planned, after }) => {
                ground.cuts_left -= planned.cuts();
                ground.before = after;
                operations.push(planned);
            }
            Err(refused) => unplanned.push(refused),
        }
    }
    if !unplanned.is_empty() {
        return Err(Refusal::Unplanned(unplanned));
    }
    Ok(PlannedJob {
        name: job.name.clone(),
        stock: job.stock,
        profile: Profile::clone(&planning.profile),
        surface: job.part.shared_surface(),
        tolerance: Part::TOLERANCE,
        machine: job.machine.clone(),
        operations,
    })
}

fn too_many(one: &dyn Operation, count: usize) -> Diagnostic {
    Diagnostic::new(
        Code::TooManyCuts,
        format!("this job has {count} operations, a job may have {MOST_OPERATIONS}"),
        one.setup().head_span,
        "the first one too many",
    )
    .help("split the job")
}

fn without_lines(job: &CheckedJob) -> Diagnostic {
    Diagnostic::new(
        Code::Internal,
        "the part has no polyline, although it was checked, which is a fault of the compiler",
        job.profile_span,
        "this part",
    )
    .help("please report the job together with this message")
}

/// The work as the first operation of a job finds it.
fn first_ground<'j>(job: &PlanningJob<'j>, space: SearchSpace, wanted: &Wanted) -> Ground<'j> {
    Ground {
        job: job.clone(),
        before: Surface::untouched(job.stock),
        space,
        cuts_left: MOST_CUTS,
        wanted: wanted.clone(),
    }
}

/// The work as an operation finds it, by its number from 0; none where one before it has no plan.
#[must_use]
pub fn ground_of<'j>(job: &PlanningJob<'j>, operation: usize) -> Option<Ground<'j>> {
    let mut ground = first_ground(job, SearchSpace::along(RouteSet::Full), &Wanted::ALWAYS);
    for before in job.job().operations.iter().take(operation) {
        let Laid { planned, after } = before.plan(ground.clone()).ok()?;
        ground.cuts_left -= planned.cuts();
        ground.before = after;
    }
    Some(ground)
}

/// Why a job has no plan, in two steps: what to report is known at once, and what helps takes plans to find out.
pub enum Refusal<'j> {
    /// The job as a whole cannot be planned.
    Whole(Box<Diagnostic>),
    /// Operations without a plan.
    Unplanned(Vec<Box<dyn Unplanned + 'j>>),
}

impl Refusal<'_> {
    /// What there is to report, before anything is tried.
    #[must_use]
    pub fn at_once(&self) -> Vec<Diagnostic> {
        self.with_help(&Wanted::never(), &mut |_| false)
    }

    /// The same with changes that work, of those that were found while they were wanted.
    #[must_use]
    pub fn with_help(&self, wanted: &Wanted, works: &mut WorksThere<'_>) -> Vec<Diagnostic> {
        match self {
            Self::Whole(diagnostic) => vec![(**diagnostic).clone()],
            Self::Unplanned(all) => {
                let mut effort = Effort::OF_A_REFUSAL;
                let all = all.iter();
                all.flat_map(|one| one.diagnostics(wanted, &mut effort, works))
                    .collect()
            }
        }
    }
}

/// Whether a job of one operation has a plan with nothing wrong that keeps all limits, as far as is seen with so much work.
/// Where it has one, [`plan`] finds one. None where only planning and proving the job says so.
#[must_use]
pub fn is_plannable(job: &CheckedJob, effort: &mut Effort, wanted: &Wanted) -> Option<bool> {
    match &job.operations[..] {
        [only] => {
            let job = PlanningJob::of(job)?;
            let ground = first_ground(&job, SearchSpace::along(RouteSet::Full), wanted);
            only.is_plannable(ground, effort)
        }
        _ => None,
    }
}

/// The job with its operations' limits on time and cuts taken away; none where there are no such limits.
#[must_use]
pub fn without_plan_limits(job: &CheckedJob) -> Option<CheckedJob> {
    let mut free = job.clone();
    let mut is_limited = false;
    for operation in &mut free.operations {
        if let Some(unlimited) = operation.without_plan_limits() {
            *operation = unlimited;
            is_limited = true;
        }
    }
    is_limited.then_some(free)
}

/// The job with the limits that a plan of it chose, as if it had set them; none where it chose none. Planned along other routes,
/// or with narrower swings, it keeps to them.
#[must_use]
pub fn settled(job: &CheckedJob, plan: &PlannedJob) -> Option<CheckedJob> {
    let mut settled = job.clone();
    let mut is_limited = false;
    for (operation, planned) in settled.operations.iter_mut().zip(&plan.operations) {
        match operation.settle(&**planned) {
            Settled::Limited => is_limited = true,
            Settled::AsAsked => {}
        }
    }
    is_limited.then_some(settled)
}
