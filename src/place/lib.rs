//! `vcutc place`: the base frame that leaves the machine the most room, or with which its cuts deviate least, from a job's text.
//!
//! The job is planned and proven as for a compilation: its cuts do not depend on where the work stands. Then [`mod@search`] looks for
//! places by the critical poses, as far as the axes follow the critical motions there ([`vcutc_motion::critical`]), and by a few places
//! of the cuts, where their deviation counts. The whole program is proven in the best of these places, one by one, until one passes. The
//! job itself is not changed: people get the frame to paste.

mod bounds;
mod map;
pub mod report;
mod room;
pub mod score;
pub mod search;
pub mod spot;
#[cfg(test)]
mod tests;

pub use bounds::{AROUND, Asked, BadBounds, TURN_AROUND};
pub use map::Map;
pub use room::{Deviation, Room};
pub use score::Objective;

use crate::score::Scorer;
use crate::search::{Bounds, Criteria, Placed, search};
use crate::spot::Spot;
use vcutc_backend_api::ir::PlacedFrame;
use vcutc_cancellation::Wanted;
use vcutc_diagnostics::source::SourceMap;
use vcutc_diagnostics::{Code, Diagnostic, has_errors};
use vcutc_driver::{self as driver, Request, Stage, internal, rules_broken};
use vcutc_dynamics::deviation::Unknown;
use vcutc_dynamics::deviation::moved_base::MovedBase;
use vcutc_dynamics::deviation::verdict::{Needs, compensated_elsewhere, not_known};
use vcutc_job::PlannedJob;
use vcutc_job::search::{RouteSet, SearchSpace};
use vcutc_job::sema;
use vcutc_job::{CheckedJob, Machine};
use vcutc_motion::critical::margin::Judge;
use vcutc_motion::critical::motions::CriticalMotions;
use vcutc_motion::critical::poses::TaughtPoses;
use vcutc_motion::rig::Rig;
use vcutc_process::plan::plan_within;
use vcutc_process::verdict;
use vcutc_remedy::trial::carried_out;
use vcutc_remedy::wording;

/// Where the work stands best.
#[derive(Clone, Debug)]
pub struct Placement {
    /// The job's name.
    pub job: String,
    /// The machine's name in the job.
    pub machine: String,
    /// Its model.
    pub model: String,
    /// Where the base might have stood.
    pub bounds: Bounds,
    pub now: Standing,
    /// The best place that was proven.
    pub best: Option<Best>,
    /// Why better places by the taught poses did not pass, the first of them first.
    pub refused: Vec<String>,
    /// Margins or deviations over x and y.
    pub map: Map,
}

impl Placement {
    /// The map as SVG.
    #[must_use]
    pub fn svg(&self) -> String {
        let title = format!("{}: places for the base of {}", self.job, self.machine);
        let best = self.best.as_ref().map(|best| best.spot);
        self.map.svg(&title, &self.now.base.frame, best)
    }
}

/// A base and what the machine makes of it.
#[derive(Clone, Debug)]
pub struct Standing {
    pub base: PlacedFrame,
    /// What room the whole program leaves there; why it is not carried out otherwise.
    pub room: Result<Room, String>,
}

/// A place that was proven.
#[derive(Clone, Debug)]
pub struct Best {
    pub spot: Spot,
    /// The frame to paste.
    pub base: PlacedFrame,
    /// What room the whole program leaves there.
    pub room: Room,
}

/// Why nothing is placed.
#[derive(Debug)]
pub enum Refusal {
    /// The job file cannot be read.
    Unreadable(String),
    /// The job has errors, or no machine.
    Diagnostics(Vec<Diagnostic>, SourceMap),
    /// The bounds cannot be understood.
    BadBounds(BadBounds),
}

/// Poses beside the outermost ones, for each orientation, that the grid and the climbs are judged by.
const SPREAD: (usize, usize) = (4, 40);
/// In how many places the whole program is proven at most.
const MOST_PROOFS: usize = 8;
/// How often bounds that the user did not set are widened.
const MOST_WIDENINGS: usize = 3;

/// Places the work of a job.
///
/// # Errors
/// When there is nothing to place.
pub fn place(
    request: Request<'_>,
    asked: &Asked<'_>,
    progress: &mut dyn FnMut(Stage),
) -> Result<Placement, Refusal> {
    let mut sources = SourceMap::default();
    match prepare(request, &mut sources, progress) {
        Err(Failed::Unreadable(reason)) => Err(Refusal::Unreadable(reason)),
        Err(Failed::Diagnostics(diagnostics)) => Err(Refusal::Diagnostics(diagnostics, sources)),
        Ok(ready) => {
            let base = ready.machine.base.value.frame;
            let bounds = asked.bounds(&base).map_err(Refusal::BadBounds)?;
            progress(Stage::Placing);
            match asked.objective {
                Objective::Margin => Ok(by_margin(&ready, asked, bounds)),
                Objective::Deviation => by_deviation(&ready, asked, bounds)
                    .map_err(|why| Refusal::Diagnostics(vec![*why], sources)),
            }
        }
    }
}

/// The place with the largest margin; where nothing is reached and no bounds are given, all around the machine.
fn by_margin(ready: &Ready, asked: &Asked<'_>, bounds: Bounds) -> Placement {
    let placement = placed(ready, asked, bounds, None);
    match asked.farther(&ready.machine, &placement) {
        Some(all_around) => placed(ready, asked, all_around, None),
        None => placement,
    }
}

/// The place with the smallest deviation. The cuts are the same everywhere, but the arm has to get to them once before it is known what
/// pushes it: now, or in the place with the largest margin.
fn by_deviation(ready: &Ready, asked: &Asked<'_>, bounds: Bounds) -> Result<Placement, Box<Diagnostic>> {
    let Ready {
        job,
        machine,
        plan,
        proven,
    } = ready;
    let needs = Needs::placement(job.name_span);
    if proven.report.compensations.iter().any(Option::is_some) {
        return Err(Box::new(compensated_elsewhere(needs)));
    }
    // Without these it is not known anywhere.
    if driver::dynamics::pushed_blades(job).is_empty() {
        return Err(Box::new(not_known(Unknown::Forces, needs, machine)));
    }
    if machine.model.elasticity.is_none() {
        return Err(Box::new(not_known(Unknown::Elasticity, needs, machine)));
    }
    let by_margin = by_margin(ready, asked, bounds);
    let (base, bounds) = match (&by_margin.now.room, &by_margin.best) {
        (Ok(_), _) => (by_margin.now.base, bounds),
        (Err(_), Some(best)) => (best.base, by_margin.bounds),
        (Err(_), None) => return Ok(by_margin),
    };
    let Ok(reached) = carried_out(plan, &moved(machine, base), &Wanted::ALWAYS) else {
        return Ok(by_margin);
    };
    let found = driver::dynamics::deviating(job, machine, &reached, &proven.report, |deviations| {
        placed(ready, asked, bounds, Some(&MovedBase::of(deviations)))
    });
    found.map_err(|why| Box::new(not_known(why, needs, machine)))
}

/// A job whose cuts are proven.
struct Ready {
    job: CheckedJob,
    machine: Machine,
    plan: PlannedJob,
    proven: verdict::Proven,
}

enum Failed {
    Unreadable(String),
    Diagnostics(Vec<Diagnostic>),
}

fn prepare(
    request: Request<'_>,
    sources: &mut SourceMap,
    progress: &mut dyn FnMut(Stage),
) -> Result<Ready, Failed> {
    progress(Stage::Reading);
    let mut diagnostics = Vec::new();
    let (_, job) = sema::check(
        request.path,
        request.loader,
        sema::Choices {
            overrides: request.overrides,
            machine: request.machine,
            options: request.options,
            effort: request.effort,
            operations: request.operations,
            surfaces: None,
        },
        sources,
        &mut diagnostics,
    )
    .map_err(|error| Failed::Unreadable(error.to_string()))?;
    let Some(job) = job.filter(|_| !has_errors(&diagnostics)) else {
        return Err(Failed::Diagnostics(diagnostics));
    };
    let job = driver::decided(job, &Wanted::ALWAYS);
    let Some(machine) = job.machine.clone() else {
        return Err(Failed::Diagnostics(vec![without_machine(&job)]));
    };
    progress(Stage::Planning);
    let plan = match driver::compile_checked(&job, &Wanted::ALWAYS) {
        // What room there is now is then what `check` says.
        Some((plan, _)) => plan,
        None => {
            // Where the machine follows these routes, the job compiles, whatever faster ones there are.
            let (plan, found) = plan_within(&job, SearchSpace::along(RouteSet::RowsByPoint));
            diagnostics.extend(found);
            let Some(plan) = plan.filter(|_| !has_errors(&diagnostics)) else {
                return Err(Failed::Diagnostics(diagnostics));
            };
            plan
        }
    };
    progress(Stage::Proving);
    match verdict::prove(&plan, sources) {
        Ok(proven) => {
            diagnostics.extend(verdict::diagnose(&job, &plan, &proven));
            if has_errors(&diagnostics) {
                return Err(Failed::Diagnostics(diagnostics));
            }
            Ok(Ready {
                job,
                machine,
                plan,
                proven,
            })
        }
        Err(faults) => Err(Failed::Diagnostics(vec![internal(&job, &rules_broken(&faults))])),
    }
}

fn without_machine(job: &CheckedJob) -> Diagnostic {
    Diagnostic::new(
        Code::MissingMachine,
        "a base is placed on a machine, and this job has none",
        job.name_span,
        "this job",
    )
    .help(
        "add a block `machine cell = robot \"kuka/kr210_r3100_ultra\" { ... }`, or `use` a file that has one",
    )
}

/// The best place within bounds: by the deviation, where it is known, else by the margin.
fn placed(
    ready: &Ready,
    asked: &Asked<'_>,
    mut bounds: Bounds,
    deviations: Option<&MovedBase<'_, '_>>,
) -> Placement {
    let Ready {
        job, machine, proven, ..
    } = ready;
    let base = machine.base.value;
    let poses = TaughtPoses::of(&proven.program);
    let rig = Rig::of(machine);
    let motions = CriticalMotions::of(proven.program.program());
    let judge = |spread| Judge::new(&rig, poses.outermost(spread));
    let (rough, fine) = (judge(SPREAD.0), judge(SPREAD.1));
    let scorer = |judge| Scorer {
        judge,
        moved: deviations,
    };
    let objective = scorer(&fine).objective();
    let now = Standing {
        base,
        room: tried(ready, objective, base),
    };
    let criteria = Criteria {
        rough: scorer(&rough),
        fine: scorer(&fine),
        admits: &|spot: Spot| motions.are_followed(&rig.with_work(spot.work_in_root(&base.frame))),
    };
    let best_within = |bounds: &Bounds| {
        let mut refused = Vec::new();
        let best = search(&criteria, &base.frame, bounds)
            .into_iter()
            .filter(|place| place.score.reached().is_some())
            .take(MOST_PROOFS)
            .find_map(|place| prove(ready, objective, place, &mut refused));
        (best, refused)
    };
    let (mut best, mut refused) = best_within(&bounds);
    for _ in 0..MOST_WIDENINGS {
        let Some(wider) = best.as_ref().and_then(|best| asked.widened(&bounds, best.spot)) else {
            break;
        };
        let (found, why) = best_within(&wider);
        // Places lie on a coarser grid in wider bounds: the best one may be missed there.
        let is_worse = |best: &Best| {
            found
                .as_ref()
                .is_none_or(|found| best.room.is_better_than(&found.room))
        };
        if best.as_ref().is_some_and(is_worse) {
            break;
        }
        (bounds, best, refused) = (wider, found, why);
    }
    let shown = best.as_ref().map_or(Spot::near(&base.frame), |best| best.spot);
    Placement {
        job: job.name.clone(),
        machine: machine.name.clone(),
        model: machine.model.name.clone(),
        bounds,
        map: Map::draw(&criteria.fine, &base.frame, &bounds, shown),
        now,
        best,
        refused,
    }
}

/// Proves the whole program in a place.
fn prove(ready: &Ready, objective: Objective, place: Placed, refused: &mut Vec<String>) -> Option<Best> {
    let now = ready.machine.base.value;
    let base = PlacedFrame {
        frame: wording::rounded(&place.spot.frame(&now.frame)),
        ..now
    };
    match tried(ready, objective, base).and_then(|room| room.with_enough(objective)) {
        Ok(room) => Some(Best {
            spot: place.spot,
            base,
            room,
        }),
        Err(reason) => {
            refused.push(format!("{}: {reason}", report::spot(place.spot)));
            None
        }
    }
}

/// What room the whole program leaves with the base there; in words, why it is not carried out.
fn tried(ready: &Ready, objective: Objective, base: PlacedFrame) -> Result<Room, String> {
    let Ready {
        job, machine, plan, ..
    } = ready;
    let moved = moved(machine, base);
    let room = carried_out(plan, &moved, &Wanted::ALWAYS)
        .map(|reached| Room::of(&reached))
        .map_err(|unreached| room::why_not(&unreached, &machine.model))?;
    match objective {
        Objective::Margin => Ok(room),
        Objective::Deviation => deviating(job, moved),
    }
}

/// What room the job leaves on a machine that may have moved, and how far its cuts are pushed off there. It is compiled, because where
/// it was out of reach before, the machine may now carry out a better plan.
fn deviating(job: &CheckedJob, moved: Machine) -> Result<Room, String> {
    let mut there = job.clone();
    there.machine = Some(moved.clone());
    let compiled = driver::compile_checked(&there, &Wanted::ALWAYS).map(|(_, compiled)| compiled);
    let reached = compiled
        .as_ref()
        .and_then(|compiled| Some((compiled.program.reached()?, &compiled.report)));
    let (reached, report) = reached.ok_or("the job does not compile there")?;
    let deviation = driver::dynamics::deviation(&there, &moved, reached, report).ok();
    let deviation = deviation.as_ref().and_then(Deviation::of);
    Ok(Room {
        deviation: Some(deviation.ok_or("the deviation is not known there")?),
        ..Room::of(reached)
    })
}

/// The machine with the base there.
fn moved(machine: &Machine, base: PlacedFrame) -> Machine {
    let mut moved = machine.clone();
    moved.base.value = base;
    moved
}
