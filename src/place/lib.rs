//! `vcutc place`: the base frame that leaves the machine the most room, from a job's text.
//!
//! The job is planned and proven as for a compilation, because the cuts do not depend on where the work
//! stands. Then [`mod@search`] looks for places by the critical poses, as far as the axes follow the critical
//! motions there ([`vcutc_motion::critical`]), and the best of them are put to the whole proof, one by one,
//! until one passes. The job itself is not changed: what people get is the frame to paste.

mod bounds;
mod map;
pub mod report;
mod room;
pub mod search;
pub mod spot;
#[cfg(test)]
mod tests;

pub use bounds::{AROUND, Asked, BadBounds, TURN_AROUND};
pub use map::Map;
pub use room::Room;

use crate::search::{Bounds, Criteria, Placed, search};
use crate::spot::Spot;
use vcutc_backend_api::ir::PlacedFrame;
use vcutc_cancellation::Wanted;
use vcutc_diagnostics::source::SourceMap;
use vcutc_diagnostics::{Code, Diagnostic, has_errors};
use vcutc_driver::{self as driver, Request, Stage, internal, rules_broken};
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
    /// Margins over x and y.
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
/// Most places that are put to the whole proof.
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
            let placement = placed(&ready, asked, bounds);
            match asked.farther(&ready.machine, &placement) {
                Some(all_around) => Ok(placed(&ready, asked, all_around)),
                None => Ok(placement),
            }
        }
    }
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

fn placed(ready: &Ready, asked: &Asked<'_>, mut bounds: Bounds) -> Placement {
    let Ready {
        job,
        machine,
        plan,
        proven,
    } = ready;
    let base = machine.base.value;
    let poses = TaughtPoses::of(&proven.program);
    let rig = Rig::of(machine);
    let motions = CriticalMotions::of(proven.program.program());
    let judge = |spread| Judge::new(&rig, poses.outermost(spread));
    let (rough, fine) = (judge(SPREAD.0), judge(SPREAD.1));
    let now = Standing {
        base,
        room: tried(plan, machine, base),
    };
    let criteria = Criteria {
        rough: &rough,
        fine: &fine,
        admits: &|spot: Spot| motions.are_followed(&rig.with_work(spot.work_in_root(&base.frame))),
    };
    let best_within = |bounds: &Bounds| {
        let mut refused = Vec::new();
        let best = search(&criteria, &base.frame, bounds)
            .into_iter()
            .filter(|place| place.score.reached().is_some())
            .take(MOST_PROOFS)
            .find_map(|place| prove(plan, machine, place, &mut refused));
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
                .is_none_or(|found| found.room.margin < best.room.margin)
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
        map: Map::draw(&fine, &base.frame, &bounds, shown),
        now,
        best,
        refused,
    }
}

/// Puts a place to the whole proof.
fn prove(plan: &PlannedJob, machine: &Machine, place: Placed, refused: &mut Vec<String>) -> Option<Best> {
    let now = machine.base.value;
    let base = PlacedFrame {
        frame: wording::rounded(&place.spot.frame(&now.frame)),
        ..now
    };
    match tried(plan, machine, base) {
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
fn tried(plan: &PlannedJob, machine: &Machine, base: PlacedFrame) -> Result<Room, String> {
    let mut moved = machine.clone();
    moved.base.value = base;
    carried_out(plan, &moved, &Wanted::ALWAYS)
        .map(|reached| Room::of(&reached))
        .map_err(|unreached| room::why_not(&unreached, &machine.model))
}
