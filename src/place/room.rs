//! What room a program leaves its machine, or why it is not carried out, in a few words.

use crate::score::{LEAST_MARGIN, Objective};
use vcutc_backend_api::ir::{OpId, Program, Site};
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::number::show;
use vcutc_dynamics::deviation::figures::DeviationFigures;
use vcutc_machine::Model;
use vcutc_motion::describe::site_words;
use vcutc_motion::figures::{AxisFigure, figures};
use vcutc_motion::path::Violation;
use vcutc_motion::solve::{Reached, Unreached};
use vcutc_motion::trouble::{Failing, Trouble};

/// What room a program leaves its machine.
#[derive(Clone, Debug, PartialEq)]
pub struct Room {
    /// The smallest margin, from 0 to 1.
    pub margin: f64,
    /// What it is the margin of, and where: `A5 at -34.25 deg, layer 3, cut 14`.
    pub least: String,
    /// How far the forces of its blades push the cuts off, where the place is chosen for that.
    pub deviation: Option<Deviation>,
}

/// How far the forces of the blades push the cuts of a program off: proven, nowhere more.
#[derive(Clone, Debug, PartialEq)]
pub struct Deviation {
    pub most: Length,
    /// Where: `layer 3, cut 14, right flank`.
    pub at: String,
    /// The axis that yields most there.
    pub axis: String,
}

impl Room {
    pub(super) fn of(reached: &Reached) -> Self {
        let figures = figures(reached);
        let least = &figures.least;
        let what = match figures.axes.iter().find(|axis| axis.name == least.of) {
            Some(axis) => format!("{} at {:.2} {}", axis.name, outermost(axis), axis.unit),
            None => match least.of.as_str() {
                "shoulder" => "distance from axis 1".to_owned(),
                kind => format!("distance from the stretched {kind}"),
            },
        };
        Self {
            margin: figures.margin,
            least: format!("{what}, {}", least.at.words),
            deviation: None,
        }
    }

    /// The same where the margin is enough for a place that is chosen by that.
    pub(super) fn with_enough(self, objective: Objective) -> Result<Self, String> {
        match objective {
            Objective::Deviation if !self.has_enough() => {
                Err(format!("the margin is {}", percent(self.margin)))
            }
            Objective::Margin | Objective::Deviation => Ok(self),
        }
    }

    /// Whether a place with this margin may be chosen for its deviation.
    pub(super) fn has_enough(&self) -> bool {
        self.margin >= LEAST_MARGIN
    }

    /// Whether it is better than another one.
    pub(super) fn is_better_than(&self, other: &Self) -> bool {
        match (&self.deviation, &other.deviation) {
            (Some(one), Some(than)) => match (self.has_enough(), other.has_enough()) {
                (true, true) => one.most < than.most,
                (has_enough, _) => has_enough || self.margin > other.margin,
            },
            (Some(_) | None, _) => self.margin > other.margin,
        }
    }
}

impl Deviation {
    /// The largest of all operations, into the waste or into the part.
    pub(super) fn of(figures: &DeviationFigures) -> Option<Self> {
        let ways = figures
            .operations
            .iter()
            .flat_map(|of| [&of.into_waste, &of.into_part]);
        let worst = ways.max_by(|one, other| one.most.total_cmp(&other.most))?;
        Some(Self {
            most: Length::mm(worst.most),
            at: worst.at.words.clone(),
            axis: worst.axis.clone(),
        })
    }
}

/// The value of an axis that is nearest to a limit.
fn outermost(axis: &AxisFigure) -> f64 {
    if axis.low - axis.min < axis.max - axis.high {
        axis.low
    } else {
        axis.high
    }
}

/// A margin, rounded down to a tenth of a percent.
pub(super) fn percent(margin: f64) -> String {
    format!("{} %", show((margin * 1000.0).floor() / 10.0))
}

/// Why a program is not carried out.
pub(super) fn why_not(unreached: &Unreached, model: &Model) -> String {
    let Some(unreachable) = unreached.unreachable() else {
        return "the compiler fails on it".to_owned();
    };
    let program = unreachable.program.program();
    match &unreachable.trouble {
        Trouble::Motion { failing, .. } => failure(failing, model, program),
        Trouble::NoCommonBranch { failing, .. } => {
            let failure = failure(failing, model, program);
            format!("no configuration works for all cuts: {failure}")
        }
        Trouble::Way { op, .. } => format!("the way {} leads through the stock", place(program, *op)),
        Trouble::Sweep(sweep) => format!("the blade sweeps through the work, {}", place(program, sweep.op)),
        Trouble::Stray(stray) => format!(
            "the rotary axes hold the blade otherwise than planned, {}",
            place(program, stray.op)
        ),
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

/// `layer 7, cut 12`, or what else an op belongs to.
fn place(program: &Program, op: OpId) -> String {
    site_words(program, program.op(op).map_or(Site::Program, |op| op.site))
}
