//! Work that is too large for its machine wherever it is placed, seen before anything is planned.
//!
//! A size in the wrong unit makes a stock of many metres, and plans of a million cuts that no machine reaches. Every cut runs from
//! one side of the stock to the other, and the deepest place of the part is cut from the stock's top down: the tip comes to
//! within the length of an edge of all these places, or they stay as they are.

use vcutc_diagnostics::number::show;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_geometry::curve::Point2;
use vcutc_job::{CheckedJob, Part};
use vcutc_machine::kinematics::pose::Pose;

/// Why the job's machine cannot cut work of that size. None says nothing.
#[must_use]
pub fn too_large(job: &CheckedJob) -> Option<Diagnostic> {
    let machine = job.machine.as_ref()?;
    let model = &machine.model;
    let tip = Pose::from(machine.tools.first().frame.value.frame).position;
    let tip_apart = model.mechanism.most_apart(&model.axes, tip)?;
    let blades = job.operations.iter().flat_map(|operation| operation.blades());
    let edges = blades.map(|blade| blade.reach().to_mm());
    let edge = edges.fold(0.0, f64::max);
    let apart = apart(job, edge)?;
    // An edge at either end, with as much again for what may stay.
    (apart > tip_apart + 4.0 * edge).then(|| {
        Diagnostic::new(
            Code::OutOfReach,
            format!(
                "the work is too large for `{}`, wherever it is placed: cuts are {} mm apart, but the tip only reaches places up to {} mm apart",
                model.name,
                show(apart.round()),
                show(tip_apart.round())
            ),
            job.stock_span,
            "of this size",
        )
        .and(machine.model_span, "on this machine")
        .help("check the unit of every size, or cut the work in several parts")
    })
}

/// How far apart places are that have to be cut, in mm.
fn apart(job: &CheckedJob, edge: f64) -> Option<f64> {
    let (depth, top) = (job.stock.depth.to_mm(), job.stock.height.to_mm());
    let profile = job.part.tessellated(Part::TOLERANCE)?;
    let height = top - profile.lowest().z;
    let cut = |point: &&Point2| top - point.z > edge.min(0.5 * height);
    let xs = || profile.points().iter().filter(cut).map(|point| point.x);
    let width = xs().fold(f64::NEG_INFINITY, f64::max) - xs().fold(f64::INFINITY, f64::min);
    Some(libm::hypot(depth, height.max(width.max(0.0))))
}
