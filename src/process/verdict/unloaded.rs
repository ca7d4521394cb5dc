//! What compensated cuts do where less pushes the blade than they are compensated for.
//!
//! Tips that are offset against forces cut what was planned while all of the edge that a cut uses is in the material. Where the edge comes in
//! and goes out, where cells are missing and in the air, less of it is, and the flank lies deeper: as the program says, and by as much
//! as some stretch of the edge alone may push it into the part. There it may use up the allowance, but must stay out of the part.

use super::bounds;
use std::collections::BTreeMap;
use vcutc_backend_api::ir::OperationId;
use vcutc_backend_api::units::Length;
use vcutc_backend_api::verify::VerifiedProgram;
use vcutc_job::PlannedJob;
use vcutc_simulation::prove::{self, Bound, CutFault, Finding};

/// The cut of a compensated operation that may go deepest into the part, and how deep. None where none goes into it. `yields` is how far
/// the flanks of an operation may be pushed into the part.
#[must_use]
pub fn entry(
    plan: &PlannedJob,
    program: &VerifiedProgram,
    yields: &BTreeMap<OperationId, Length>,
) -> Option<(Finding, Length)> {
    let planned = (0..).map(OperationId).zip(&plan.operations);
    let written: Vec<Bound<'_>> = planned
        .zip(bounds(plan))
        .map(|((operation, planned), bound)| {
            let Some(&by) = yields.get(&operation) else {
                return bound;
            };
            Bound {
                part: &plan.profile,
                compensation: None,
                drop: bound.drop + by * (1.0 / planned.swing().sin()),
                aside: bound.aside + by,
                ..bound
            }
        })
        .collect();
    let found = prove::replay(program, &written).findings.overcut?;
    match found.fault {
        CutFault::Overcut { depth, .. } if yields.contains_key(&found.operation) => Some((found, depth)),
        _ => None,
    }
}
