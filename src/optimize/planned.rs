//! What the job's own plan comes to.

use vcutc_backend_api::ir::{Op, OpId, OperationId};
use vcutc_backend_api::units::Duration;
use vcutc_driver::Compiled;
use vcutc_vcut::PlannedVcut;
use vcutc_vcut::plan::parameters::VcutParameters;

/// How the parameters that an operation is cut with were found.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum FoundBy {
    /// By the formulas: they are those of the chosen row, on the grid.
    Formulas,
    /// As the best of plans that were simulated, and what these came up against.
    Simulation { reasons: Vec<&'static str> },
}

/// What the plan of an operation comes to, as its machine carries it out.
#[derive(Clone, Debug, PartialEq)]
pub struct Planned {
    /// What it is cut with, on the grid: the formulas' choice, or what simulation found better.
    pub parameters: VcutParameters,
    pub found: FoundBy,
    /// Time of its moves.
    pub time: Duration,
    /// Time by the model, of the parameters on the grid.
    pub model: Duration,
    /// V-cuts.
    pub cuts: usize,
    /// Layers with cuts.
    pub layers: usize,
}

impl Planned {
    pub(super) fn of(vcut: &PlannedVcut, compiled: &Compiled, operation: OperationId) -> Self {
        let moves = Moves {
            ops: &compiled.program.verified().program().ops,
            times: &compiled.op_times,
        };
        let layers = compiled.report.layers.iter();
        Self {
            parameters: vcut.parameters.clone(),
            found: if vcut.is_found_by_simulation() {
                FoundBy::Simulation {
                    reasons: vcut.parameters.reasons(&vcut.asked),
                }
            } else {
                FoundBy::Formulas
            },
            time: moves.time_of(operation),
            model: vcut.estimate,
            cuts: vcut.cuts.len(),
            layers: layers.filter(|(of, _)| *of == operation).count(),
        }
    }

    /// How far the model is above the planned time, as a share of that; none when nothing takes time.
    #[must_use]
    pub fn model_above(&self) -> Option<f64> {
        let planned = self.time.to_s();
        (planned > 0.0).then(|| self.model.to_s() / planned - 1.0)
    }
}

/// The ops of a program with their times.
#[derive(Clone, Copy)]
pub(super) struct Moves<'p> {
    pub(super) ops: &'p [Op],
    pub(super) times: &'p [Duration],
}

impl Moves<'_> {
    /// How long the moves of an operation take.
    pub(super) fn time_of(self, operation: OperationId) -> Duration {
        let timed = self.ops.iter().zip(self.times);
        let own = timed.filter(|(op, _)| op.site.operation() == Some(operation));
        own.map(|(_, &time)| time).sum()
    }

    /// Whether an op is one of an operation.
    pub(super) fn is_of(self, op: OpId, operation: OperationId) -> bool {
        usize::try_from(op.0)
            .ok()
            .and_then(|index| self.ops.get(index))
            .is_some_and(|op| op.site.operation() == Some(operation))
    }
}
