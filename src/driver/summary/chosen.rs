//! What was chosen and what was given, as numbers: the parameters of every operation for other programs.

use serde::Serialize;
use vcutc_job::PlannedJob;
use vcutc_job::description::ParameterFigure;

/// The parameters of one operation.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct OperationFigures {
    /// The operation, from 0.
    pub operation: usize,
    /// Its parameters, in the order of the language reference.
    pub parameters: Vec<ParameterFigure>,
}

/// The parameters of all operations.
#[must_use]
pub fn figures(plan: &PlannedJob) -> Vec<OperationFigures> {
    let operations = plan.operations.iter().enumerate();
    operations
        .map(|(operation, planned)| OperationFigures {
            operation,
            parameters: planned.parameters(),
        })
        .collect()
}
