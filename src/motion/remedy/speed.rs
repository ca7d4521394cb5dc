//! The highest speeds that the axes follow.
//!
//! With the rates of the axes left out, the machine's own report says how fast each axis would have to move, and at which op
//! most. Rates grow in proportion to the speed that paces an op (`docs/process.md`, "Robot moves": the course is the same,
//! only the time is not), so that one division gives the speed at which that op is just followed. Other ops may be paced by
//! other speeds: this goes on until no axis is too slow, and then the job is tried with its rates.

use super::{Case, Remedy, trial};
use crate::demand::Demand;
use crate::legs::{Leg, Pace, legs};
use crate::path::Violation;
use crate::trouble::Trouble;
use std::collections::BTreeMap;
use std::sync::Arc;
use vcutc_backend_api::ir::{Action, AxisKind, MOST_AXES, OpId, Program};
use vcutc_backend_api::units::{Angle, AngularSpeed, Speed};
use vcutc_diagnostics::source::Span;
use vcutc_job::{Operation, RoughVcut};
use vcutc_machine::Model;
use vcutc_process::plan::parameters::show;

/// What a lower speed costs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Loss {
    /// Some time.
    Bearable,
    /// A speed falls below a quarter of what was asked for.
    Severe,
}

/// A speed of an operation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Field {
    Cut,
    /// Of ways beside and above the work.
    Travel,
    /// Of turns of the blade.
    Reorient,
}

impl Field {
    /// What an operation asks for, in mm/s or deg/s.
    #[must_use]
    pub fn value(self, asked: &RoughVcut) -> f64 {
        match self {
            Self::Cut => asked.cut_feed.value.to_mm_per_s(),
            Self::Travel => asked.travel_feed.value.to_mm_per_s(),
            Self::Reorient => asked.reorient_rate.value.to_rad_per_s().to_degrees(),
        }
    }

    /// Asks for another speed, in mm/s or deg/s.
    pub fn set(self, asked: &mut RoughVcut, speed: f64) {
        match self {
            Self::Cut => asked.cut_feed.value = Speed::mm_per_s(speed),
            Self::Travel => asked.travel_feed.value = Speed::mm_per_s(speed),
            Self::Reorient => {
                asked.reorient_rate.value = AngularSpeed::rad_per_s(Angle::deg(speed).to_rad());
            }
        }
    }

    /// What it is called, its unit, and where it is written.
    #[must_use]
    pub const fn written(self, asked: &RoughVcut) -> (&'static str, &'static str, Option<Span>) {
        match self {
            Self::Cut => ("cut", "mm/s", asked.cut_feed.span),
            Self::Travel => ("travel", "mm/s", asked.travel_feed.span),
            Self::Reorient => ("reorient", "deg/s", asked.reorient_rate.span),
        }
    }
}

/// Speeds by operation and field, in mm/s and deg/s.
type Speeds = BTreeMap<(u16, Field), f64>;

/// Most speeds that are lowered, one after the other.
const MOST_STEPS: u32 = 6;
/// Below this share of what was asked for a loss is severe.
const SEVERE: f64 = 0.25;

/// The highest speed at which the motion that lacks most is followed, where a linear axis paces it: others need as much of it, but
/// for turns. What a rotary axis needs differs from motion to motion.
pub(super) fn of_a_linear_axis(case: &Case<'_>) -> Option<(Remedy, Loss)> {
    let failing = match &case.unreachable.trouble {
        Trouble::Motion { failing, hardest, .. } => hardest.as_ref().unwrap_or(failing),
        Trouble::NoCommonBranch { .. } | Trouble::Way { .. } | Trouble::Sweep(_) | Trouble::Nowhere => {
            return None;
        }
    };
    let share = match failing.worst.what {
        Violation::Rate { axis, rate } => {
            let axes = &case.machine.model.axes;
            let axis = axes.get(axis).filter(|axis| axis.kind == AxisKind::Linear)?;
            rate / axis.rate?
        }
        Violation::OutOfReach | Violation::Limit { .. } | Violation::Singular(_) => return None,
    };
    let program = case.unreachable.program.program();
    let field = pacing(program, failing.op)?;
    let operation = program.ops.get(failing.op.0 as usize)?.site.operation()?;
    let asked = asked(&case.job.operations, operation.0)?;
    let speed = lower(field.value(asked) / share)?;
    let speeds = Speeds::from([((operation.0, field), speed)]);
    remedy(&case.job.operations, &speeds)
}

/// The highest speeds with which the job compiles.
pub(super) fn lowered(case: &mut Case<'_>) -> Option<(Remedy, Loss)> {
    if !case.may_plan_again() {
        return None;
    }
    let patient = without_rates(&case.machine.model);
    let mut speeds = Speeds::new();
    for _ in 0..MOST_STEPS {
        if !case.may_try() {
            return None;
        }
        let model = patient.clone();
        let reached = trial::whole(case, |job| {
            set(&mut job.operations, &speeds);
            if let Some(machine) = &mut job.machine {
                machine.model = model;
            }
        })?;
        let program = reached.program.program();
        let Some((op, share)) = slowest(&reached.report.demand, &case.machine.model) else {
            break;
        };
        let field = pacing(program, op)?;
        let operation = program.ops.get(op.0 as usize)?.site.operation()?;
        let asked = asked(&case.job.operations, operation.0)?;
        let now = speeds
            .get(&(operation.0, field))
            .copied()
            .unwrap_or(field.value(asked));
        speeds.insert((operation.0, field), lower(now / share)?);
    }
    if speeds.is_empty() || !case.may_try() {
        return None;
    }
    trial::whole(case, |job| set(&mut job.operations, &speeds))?;
    remedy(&case.job.operations, &speeds)
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
    let shares = model
        .axes
        .iter()
        .take(MOST_AXES)
        .enumerate()
        .filter_map(|(index, axis)| {
            let fastest = demand.rate.get(index)?;
            Some((fastest.op, fastest.value / axis.rate?))
        });
    shares
        .filter(|(_, share)| *share > 1.0)
        .max_by(|(_, a), (_, b)| a.total_cmp(b))
}

/// The field that says how fast an op goes.
#[must_use]
pub fn pacing(program: &Program, op: OpId) -> Option<Field> {
    let index = op.0 as usize;
    let legs = legs(program);
    let Leg::Along(stroke) = legs.get(index)? else {
        return None;
    };
    Some(match (stroke.pace, program.ops.get(index)?.action) {
        (Pace::Rate(_), _) => Field::Reorient,
        (Pace::Feed(_), Action::Cut { .. }) => Field::Cut,
        (Pace::Feed(_), _) => Field::Travel,
    })
}

fn asked(operations: &[Operation], operation: u16) -> Option<&RoughVcut> {
    operations
        .get(usize::from(operation))
        .map(|Operation::RoughVcut(asked)| asked)
}

/// A value below another that people like to write: whole numbers from ten on, else tenths.
#[must_use]
pub fn lower(value: f64) -> Option<f64> {
    let scale = if value >= 10.0 { 1.0 } else { 10.0 };
    let rounded = (value * scale * (1.0 - 1e-6)).floor() / scale;
    (rounded > 0.0).then_some(rounded)
}

fn set(operations: &mut [Operation], speeds: &Speeds) {
    for (&(operation, field), &speed) in speeds {
        let Some(Operation::RoughVcut(asked)) = operations.get_mut(usize::from(operation)) else {
            continue;
        };
        field.set(asked, speed);
    }
}

fn remedy(operations: &[Operation], speeds: &Speeds) -> Option<(Remedy, Loss)> {
    let mut words = Vec::new();
    let mut edits = Vec::new();
    let mut loss = Loss::Bearable;
    for (&(operation, field), &speed) in speeds {
        let asked = asked(operations, operation)?;
        if speed < SEVERE * field.value(asked) {
            loss = Loss::Severe;
        }
        let (name, unit, span) = field.written(asked);
        let text = format!("{} {unit}", show(speed));
        let word = format!("`{name} = {text}`");
        // Two operations may ask for the same.
        if !words.contains(&word) {
            words.push(word);
        }
        edits.extend(span.map(|span| (span, text)));
    }
    let advice = format!("use {}, which the axes follow", words.join(" with "));
    let remedy = if edits.len() == speeds.len() {
        Remedy { advice, edits }
    } else {
        Remedy::advice(advice)
    };
    Some((remedy, loss))
}
