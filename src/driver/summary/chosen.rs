//! What was chosen and what was given, as numbers: the parameters of every operation for other programs.

use serde::Serialize;
use vcutc_backend_api::units::{Angle, Length};
use vcutc_job::{Auto, RoughVcut, Sourced};
use vcutc_process::plan::{PlannedJob, PlannedOperation, PlannedVcut};

/// The parameters of one operation.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct OperationFigures {
    /// The operation, from 0.
    pub operation: usize,
    /// Its parameters, in the order of the language reference.
    pub parameters: Vec<ParameterFigure>,
}

/// A parameter as it is in the program.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ParameterFigure {
    /// The field of the language.
    pub name: &'static str,
    pub value: Value,
    /// Its unit; none for shares and words.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unit: Option<&'static str>,
    /// Who decided.
    pub origin: Origin,
}

/// A value of a parameter.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Value {
    /// A number, rounded to what the planner tells apart: a micrometre, a thousandth of a degree.
    Number(f64),
    /// A word of the language.
    Word(&'static str),
}

/// Who decided a parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Origin {
    /// It is written in the job.
    Given,
    /// The compiler chose it.
    Auto,
    /// It is not written, and the language has a default.
    Default,
}

/// The parameters of all operations.
#[must_use]
pub fn figures(plan: &PlannedJob) -> Vec<OperationFigures> {
    plan.operations
        .iter()
        .enumerate()
        .map(
            |(operation, PlannedOperation::RoughVcut(vcut))| OperationFigures {
                operation,
                parameters: parameters(vcut),
            },
        )
        .collect()
}

fn parameters(vcut: &PlannedVcut) -> Vec<ParameterFigure> {
    let (asked, found) = (&vcut.asked, &vcut.parameters);
    let mut all = of_the_lattice(vcut);
    all.extend([
        open("swing", &asked.swing, degrees(found.swing)),
        fixed("rake", &asked.rake, degrees(asked.rake.value)),
        open("extension", &asked.extension, millimetres(found.extension)),
        open("standoff", &asked.standoff, millimetres(found.standoff)),
        fixed("allowance", &asked.allowance, millimetres(asked.allowance.value)),
        open("order", &asked.order, word(vcut.order.word())),
        fixed("direction", &asked.direction, word(asked.direction.value.word())),
        fixed("clearance", &asked.clearance, millimetres(asked.clearance.value)),
        fixed("run_out", &asked.run_out, millimetres(asked.run_out.value)),
    ]);
    all.extend(speeds(asked));
    all
}

/// What says nothing where tips are given.
fn of_the_lattice(vcut: &PlannedVcut) -> Vec<ParameterFigure> {
    let (asked, found) = (&vcut.asked, &vcut.parameters);
    if asked.tips.is_some() {
        return Vec::new();
    }
    vec![
        open("lattice", &asked.lattice, word(found.lattice.word())),
        open("layer", &asked.layer, millimetres(found.layer)),
        open("step", &asked.step, millimetres(found.step)),
        open("overlap", &asked.overlap, number(overlap(vcut), None)),
        open("residual", &asked.residual, word(vcut.strategy.word())),
        open("sequence", &asked.sequence, word(vcut.sequence.word())),
    ]
}

/// The share by which neighbouring cuts overlap, `s = 2 (1 - eps) h tan(alpha)` [Cui 6, 7]: a given step decides it.
fn overlap(vcut: &PlannedVcut) -> f64 {
    let found = &vcut.parameters;
    match vcut.asked.step.value {
        Auto::Auto => found.overlap,
        Auto::Given(step) => 1.0 - step.to_mm() * found.flanks.slope / (2.0 * found.layer.to_mm()),
    }
}

fn speeds(asked: &RoughVcut) -> [ParameterFigure; 3] {
    let rate = asked.reorient_rate.value.to_deg_per_s();
    let speed = |value: f64| number(value, Some("mm/s"));
    [
        fixed("cut", &asked.cut_feed, speed(asked.cut_feed.value.to_mm_per_s())),
        fixed(
            "travel",
            &asked.travel_feed,
            speed(asked.travel_feed.value.to_mm_per_s()),
        ),
        fixed("reorient", &asked.reorient_rate, number(rate, Some("deg/s"))),
    ]
}

/// A value with its unit.
type Measured = (Value, Option<&'static str>);

fn millimetres(length: Length) -> Measured {
    number(length.to_mm(), Some("mm"))
}

fn degrees(angle: Angle) -> Measured {
    number(angle.to_deg(), Some("deg"))
}

fn number(value: f64, unit: Option<&'static str>) -> Measured {
    // Adding nothing takes the sign from a zero.
    (Value::Number((value * 1e3).round() / 1e3 + 0.0), unit)
}

const fn word(word: &'static str) -> Measured {
    (Value::Word(word), None)
}

const fn open<T>(name: &'static str, asked: &Sourced<Auto<T>>, (value, unit): Measured) -> ParameterFigure {
    let origin = match &asked.value {
        Auto::Given(_) => Origin::Given,
        Auto::Auto => Origin::Auto,
    };
    ParameterFigure {
        name,
        value,
        unit,
        origin,
    }
}

const fn fixed<T>(name: &'static str, asked: &Sourced<T>, (value, unit): Measured) -> ParameterFigure {
    let origin = match asked.span {
        Some(_) => Origin::Given,
        None => Origin::Default,
    };
    ParameterFigure {
        name,
        value,
        unit,
        origin,
    }
}
