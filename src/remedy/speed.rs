//! The highest speeds that the axes follow.
//!
//! With the rates of the axes left out, the machine's own report says how fast each axis would have to move, and at which op
//! most. Rates grow in proportion to the speed that paces an op (`docs/process.md`, "Robot moves": the course is the same,
//! only the time is not), so that one division gives the speed at which that op is just followed. Other ops may be paced by
//! other speeds: this continues until no axis is too slow, and then the job is tried with its rates.

use crate::case::Case;
use crate::change::{Change, Speeds};
use crate::trial;
use std::sync::Arc;
use vcutc_backend_api::ir::{AxisKind, OpId, Program};
use vcutc_job::setup::SpeedField as Field;
use vcutc_job::{CheckedJob, Setup};
use vcutc_machine::Model;
use vcutc_motion::demand::Demand;
use vcutc_motion::moves::pacing;
use vcutc_motion::path::Violation;
use vcutc_motion::solve::Reached;

/// What a lower speed costs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Loss {
    /// Some time.
    Bearable,
    /// A speed falls below a quarter of what was asked for.
    Severe,
}

/// Most speeds that are lowered, one after the other.
const MOST_STEPS: u32 = 6;
/// Below this share of what was asked for a loss is severe.
const SEVERE: f64 = 0.25;

/// Lower speeds with which the job compiles, and what they cost.
pub(crate) fn lowered(case: &mut Case<'_>) -> Option<(Change, Loss)> {
    // One speed is compiled soonest. Without a place in a file there is nothing to compile.
    let one = of_a_linear_axis(case).map(|speeds| (Change::speeds(case.job, &speeds), speeds));
    let one = one.filter(|(change, _)| !change.edits.is_empty());
    let confirmed = |case: &mut Case<'_>, (change, speeds): (Change, Speeds)| {
        Some((case.confirmed(change)?, loss(case.job, &speeds)))
    };
    one.and_then(|one| confirmed(case, one)).or_else(|| {
        let highest = highest(case)?;
        confirmed(case, highest)
    })
}

/// The highest speed at which the motion that lacks most is followed, where a linear axis paces it: others need as much of it, but
/// for turns. What a rotary axis needs differs from motion to motion.
fn of_a_linear_axis(case: &Case<'_>) -> Option<Speeds> {
    let failing = case.unreachable.trouble.hardest()?;
    let share = match failing.worst.what {
        Violation::Rate { axis, rate } => {
            let axes = &case.machine.model.axes;
            let axis = axes.get(axis).filter(|axis| axis.kind == AxisKind::Linear)?;
            rate / axis.rate?
        }
        Violation::OutOfReach | Violation::Limit { .. } | Violation::Singular(_) => return None,
    };
    let pace = Pace::of(case.job, case.unreachable.program.program(), failing.op)?;
    Some(Speeds::from([(pace.place, lower(pace.asked() / share)?)]))
}

/// The highest speeds with which the job is carried out.
fn highest(case: &mut Case<'_>) -> Option<(Change, Speeds)> {
    if !case.may_plan_again() {
        return None;
    }
    let mut patient = case.job.clone();
    if let Some(machine) = &mut patient.machine {
        machine.model = without_rates(&machine.model);
    }
    let mut speeds = Speeds::new();
    for _ in 0..MOST_STEPS {
        let reached = tried(case, &Change::speeds(&patient, &speeds))?;
        let Some((op, share)) = slowest(&reached.report.demand, &case.machine.model) else {
            break;
        };
        let pace = Pace::of(case.job, reached.program.program(), op)?;
        let now = speeds.get(&pace.place).copied().unwrap_or(pace.asked());
        speeds.insert(pace.place, lower(now / share)?);
    }
    if speeds.is_empty() {
        return None;
    }
    let change = Change::speeds(case.job, &speeds);
    tried(case, &change)?;
    Some((change, speeds))
}

fn tried(case: &mut Case<'_>, change: &Change) -> Option<Reached> {
    if !case.may_try() {
        return None;
    }
    trial::planned_again(change.job.clone(), &case.budget.wanted)
}

/// What says how fast an op goes.
struct Pace<'j> {
    /// The operation and its field.
    place: (usize, Field),
    setup: &'j Setup,
}

impl<'j> Pace<'j> {
    fn of(job: &'j CheckedJob, program: &Program, op: OpId) -> Option<Self> {
        let field = pacing(program, op)?;
        let operation = usize::from(program.op(op)?.site.operation()?.0);
        let setup = job.operations.get(operation)?.setup();
        Some(Self {
            place: (operation, field),
            setup,
        })
    }

    /// What the job asks for.
    fn asked(&self) -> f64 {
        self.place.1.value(self.setup)
    }
}

/// The same machine with axes of any rate.
fn without_rates(model: &Model) -> Arc<Model> {
    let mut patient = model.clone();
    for axis in &mut patient.axes {
        axis.rate = None;
    }
    Arc::new(patient)
}

/// The op at which an axis is slowest for what is asked of it, and how many times too slow; nothing if none is too slow.
fn slowest(demand: &Demand, model: &Model) -> Option<(OpId, f64)> {
    let axes = model.axes.iter().zip(&demand.rate);
    let shares = axes.filter_map(|(axis, fastest)| Some((fastest.op, fastest.value / axis.rate?)));
    shares
        .filter(|(_, share)| *share > 1.0)
        .max_by(|(_, a), (_, b)| a.total_cmp(b))
}

/// A value below another that people like to write: whole numbers from ten on, else tenths.
pub(crate) fn lower(value: f64) -> Option<f64> {
    let scale = if value >= 10.0 { 1.0 } else { 10.0 };
    let rounded = (value * scale * (1.0 - 1e-6)).floor() / scale;
    (rounded > 0.0).then_some(rounded)
}

fn loss(job: &CheckedJob, speeds: &Speeds) -> Loss {
    let is_severe = speeds.iter().any(|(&(operation, field), &speed)| {
        let asked = job
            .operations
            .get(operation)
            .map(|asked| field.value(asked.setup()));
        asked.is_some_and(|asked| speed < SEVERE * asked)
    });
    if is_severe { Loss::Severe } else { Loss::Bearable }
}
