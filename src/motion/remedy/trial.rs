//! Trials: a changed job through the whole pipeline.

use super::{Case, farther_out};
use crate::axis_range::axis_margin;
use crate::demand::Demand;
use crate::describe::{site_words, value_words};
use crate::path::Violation;
use crate::place::motions::TellingMotions;
use crate::rig::Rig;
use crate::solve::{Changes, LEAST_CLEARANCE, ReachReport, Reached, Unreached, solve_while};
use crate::trouble::{Failing, Trouble};
use vcutc_backend_api::ir::{OpId, PlacedFrame, Program, Site};
use vcutc_backend_api::verify::verify;
use vcutc_cancellation::Wanted;
use vcutc_diagnostics::source::SourceMap;
use vcutc_job::PlannedJob;
use vcutc_job::{CheckedJob, Machine};
use vcutc_machine::Model;
use vcutc_process::lower;
use vcutc_process::verdict;

/// Most extensions that are tried in turn for one change, as turns of a five-axis machine need them.
const MOST_EXTENSIONS: usize = 3;

/// What room a program leaves its machine.
#[derive(Clone, Debug, PartialEq)]
pub struct Room {
    /// The smallest margin, from 0 to 1.
    pub margin: f64,
    /// What it is the margin of, and where: `A5 at layer 3, cut 14`.
    pub least: String,
}

/// A changed job through the whole pipeline; nothing where it does not come out at its end.
pub(super) fn whole(case: &Case<'_>, change: impl FnOnce(&mut CheckedJob)) -> Option<Reached> {
    let mut changed = case.job.clone();
    change(&mut changed);
    for _ in 0..MOST_EXTENSIONS {
        let (plan, why) = match carried_out(case, &changed)? {
            Ok(reached) => return Some(reached),
            Err(refused) => *refused,
        };
        changed = farther_out(&changed, &plan, &why)?;
    }
    None
}

/// A job through the whole pipeline. None where it is not sound, or a few of its motions say that it is not followed.
fn carried_out(case: &Case<'_>, job: &CheckedJob) -> Option<Result<Reached, Box<(PlannedJob, Unreached)>>> {
    let (plan, proven) = verdict::sound(job, case.wanted)?;
    let machine = job.machine.as_ref()?;
    // A program that fails as a whole is dear to refute, for every branch is proven from end to end. A few motions usually
    // say as much.
    let rig = Rig::new(&machine.model, machine.tool.value.frame, machine.base.value.frame);
    if !TellingMotions::of(proven.program.program()).are_each_followed(&rig) {
        return None;
    }
    let (model, changes) = (&machine.model, Changes::Never);
    let reached = solve_while(proven.program, model, &LEAST_CLEARANCE, changes, case.wanted);
    Some(reached.map_err(|why| Box::new((plan, why))))
}

/// The plan on its machine with the base elsewhere.
///
/// # Errors
/// Why the machine cannot carry it out there. A plan without a machine is carried out by none.
pub fn with_base(
    plan: &PlannedJob,
    base: PlacedFrame,
    wanted: &Wanted,
) -> Option<Result<Reached, Unreached>> {
    with_machine(plan, |machine| machine.base.value = base, wanted)
}

/// The plan on its machine with a change of the machine. The cuts do not depend on the machine, so they stay proven.
pub fn with_machine(
    plan: &PlannedJob,
    change: impl FnOnce(&mut Machine),
    wanted: &Wanted,
) -> Option<Result<Reached, Unreached>> {
    let mut changed = plan.clone();
    let machine = changed.machine.as_mut()?;
    change(machine);
    let model = machine.model.clone();
    let program = match verify(lower::lower(&changed, &SourceMap::default())) {
        Ok(program) => program,
        Err(faults) => return Some(Err(Unreached::Rules(faults))),
    };
    let changes = Changes::Never;
    Some(solve_while(program, &model, &LEAST_CLEARANCE, changes, wanted))
}

/// What room a program leaves.
#[must_use]
pub fn room(reached: &Reached, model: &Model) -> Room {
    let ReachReport { demand, margin, .. } = &reached.report;
    Room {
        margin: *margin,
        least: least(demand, model, reached.program.program()),
    }
}

/// What has the smallest margin, and where.
fn least(demand: &Demand, model: &Model, program: &Program) -> String {
    let axes = model.axes.iter().enumerate().map(|(index, axis)| {
        let (low, high) = (demand.low[index], demand.high[index]);
        let nearer = if low.value - axis.min < axis.max - high.value {
            low
        } else {
            high
        };
        let value = value_words(axis, nearer.value);
        let words = format!("{} at {value}", axis.name);
        (axis_margin(axis, low.value, high.value), words, nearer.op)
    });
    let singular = demand
        .singular_shares()
        .into_iter()
        .zip(demand.clearance)
        .zip(["the stretched wrist", "the stretched elbow", "axis 1"])
        .map(|((share, nearest), kind)| (share, format!("distance from {kind}"), nearest.op));
    axes.chain(singular)
        .min_by(|(a, ..), (b, ..)| a.total_cmp(b))
        .map_or(String::new(), |(_, words, op)| {
            format!("{words}, {}", place(program, op))
        })
}

/// `layer 7, cut 12`, or what else an op belongs to.
fn place(program: &Program, op: OpId) -> String {
    let site = program.ops.get(op.0 as usize).map_or(Site::Program, |op| op.site);
    site_words(site)
}

/// Why a program is not carried out, in a few words.
#[must_use]
pub fn words(unreached: &Unreached, model: &Model) -> String {
    match unreached {
        Unreached::Unreachable(unreachable) => {
            trouble(&unreachable.trouble, model, unreachable.program.program())
        }
        Unreached::Rules(_) | Unreached::Motion(_) => "the compiler fails on it".to_owned(),
    }
}

fn trouble(trouble: &Trouble, model: &Model, program: &Program) -> String {
    match trouble {
        Trouble::Motion { failing, .. } => failure(failing, model, program),
        Trouble::NoCommonBranch { failing, .. } => {
            format!(
                "no configuration works for all cuts: {}",
                failure(failing, model, program)
            )
        }
        Trouble::Way { op, .. } => format!("the way {} leads through the stock", place(program, *op)),
        Trouble::Sweep(sweep) => format!("the blade sweeps through the work, {}", place(program, sweep.op)),
        Trouble::Nowhere => "the machine reaches nothing of it".to_owned(),
    }
}

fn failure(failing: &Failing, model: &Model, program: &Program) -> String {
    let axis = |index: usize| model.axes.get(index).map_or("an axis", |axis| axis.name.as_str());
    let what = match failing.worst.what {
        Violation::OutOfReach => "the blade is out of reach".to_owned(),
        Violation::Limit { axis: index, .. } => format!("{} leaves its range", axis(index)),
        Violation::Rate { axis: index, .. } => format!("{} is too slow", axis(index)),
        Violation::Singular(_) => "the arm comes too close to a singularity".to_owned(),
    };
    format!("{what}, {}", place(program, failing.op))
}
