//! What compensated cuts do where nothing pushes the blade.
//!
//! Tips that are set off against forces cut what was planned while these push. Where the edge comes into the material, where cells are
//! missing and in the air, less pushes or nothing, and the blade goes where the program says. There it may use up the allowance, but
//! must stay out of the part.

use super::bounds;
use vcutc_backend_api::units::Length;
use vcutc_backend_api::verify::VerifiedProgram;
use vcutc_job::PlannedJob;
use vcutc_simulation::prove::{self, Bound, CutFault, Finding};

/// The cut of a compensated operation that goes deepest into the part while nothing pushes the blade, and how deep. None where none
/// goes into it.
#[must_use]
pub fn entry(plan: &PlannedJob, program: &VerifiedProgram) -> Option<(Finding, Length)> {
    let planned = bounds(plan);
    if planned.iter().all(|bound| bound.compensation.is_none()) {
        return None;
    }
    let written: Vec<Bound<'_>> = planned
        .iter()
        .map(|bound| match bound.compensation {
            Some(_) => Bound {
                part: &plan.profile,
                compensation: None,
                ..*bound
            },
            None => *bound,
        })
        .collect();
    let found = prove::replay(program, &written).findings.overcut?;
    let operation = usize::from(found.operation.0);
    planned.get(operation)?.compensation?;
    match found.fault {
        CutFault::Overcut { depth, .. } => Some((found, depth)),
        _ => None,
    }
}
