//! `--emit dynamics`: the torques of the axes and the forces of the blade all along the program, as CSV.
//!
//! Rows are those of `--emit joints`. Columns: `op`, `operation`, `layer`, `cut`, `motion` and `done` as there; then of each axis
//! its weight, what it needs to move, and both together in Nm, as the controller counts; and the share of its limit, empty where
//! none is known. Where the forces of a blade are known, there follow how much edge is in the material at most, the force on the blade in
//! the work, and what each axis needs against it; where the stiffness of the arm is known, too, how far the flank is off along its normal
//! at the tip and at the end of that edge, positive into the waste. All of that is by the numbers as they are stated, and empty where
//! nothing is cut.

use super::joints::{HEADING, place};
use std::io::{self, Write};
use vcutc_backend_api::ir::Op;
use vcutc_diagnostics::number::rounded;
use vcutc_driver::dynamics::forces;
use vcutc_dynamics::arms::Arms;
use vcutc_dynamics::cuts::{Cuts, Known};
use vcutc_dynamics::deviation::Deviations;
use vcutc_dynamics::drives::{Drives, Torques};
use vcutc_job::CheckedJob;
use vcutc_machine::Model;
use vcutc_motion::rigs::Rigs;
use vcutc_motion::solve::Reached;
use vcutc_motion::trajectory::{Sample, Spacing};
use vcutc_simulation::prove::UsedEdge;

/// Writes the rows of a machine whose torques are known, one after the other.
pub(super) fn write(
    job: &CheckedJob,
    reached: &Reached,
    edges: &[UsedEdge],
    out: &mut dyn Write,
) -> io::Result<()> {
    let program = reached.program.program();
    let (Some(machine), Some(cell)) = (&job.machine, &program.cell) else {
        return Ok(());
    };
    let model = &machine.model;
    let Ok(arms) = Arms::of(model, cell) else {
        return Ok(());
    };
    let rigs = Rigs::of(model, cell, program);
    let known = Known {
        model,
        reached: &reached.program,
        rigs: &rigs,
        edges,
    };
    let forces = forces(job);
    let cuts = (!forces.is_empty()).then(|| Cuts::of(known, &forces)).flatten();
    let pushed = cuts.as_ref().map(|cuts| Pushed {
        cuts,
        deviations: Deviations::of(cuts, Some(&arms)),
    });
    write!(out, "{HEADING}")?;
    torque_heading(model, out)?;
    if let Some(pushed) = &pushed {
        pushed.heading(model, out)?;
    }
    writeln!(out)?;
    let drives = Drives::of(&rigs, &arms, program);
    drives.along(&reached.program, &Spacing::CLOSE, |sample, torques| {
        let Some(op) = program.ops.get(sample.op.0 as usize) else {
            return Ok(());
        };
        row(op, sample, torques, model, out)?;
        if let Some(pushed) = &pushed {
            pushed.row(sample, model, out)?;
        }
        writeln!(out)
    })
}

fn torque_heading(model: &Model, out: &mut dyn Write) -> io::Result<()> {
    for axis in &model.axes {
        let name = &axis.name;
        write!(
            out,
            ",{name}_weight_nm,{name}_motion_nm,{name}_nm,{name}_of_limit"
        )?;
    }
    Ok(())
}

/// The cuts whose forces are known, and how far these push them off, where that is known, too.
struct Pushed<'c> {
    cuts: &'c Cuts<'c>,
    deviations: Option<Deviations<'c>>,
}

impl Pushed<'_> {
    fn heading(&self, model: &Model, out: &mut dyn Write) -> io::Result<()> {
        write!(out, ",edge_mm,force_x_n,force_y_n,force_z_n")?;
        for axis in &model.axes {
            write!(out, ",{}_cutting_nm", axis.name)?;
        }
        if self.deviations.is_some() {
            write!(out, ",deviation_tip_mm,deviation_end_mm")?;
        }
        Ok(())
    }

    /// What pushes the blade in a place, and how far.
    fn row(&self, sample: &Sample, model: &Model, out: &mut dyn Write) -> io::Result<()> {
        let Sample { op, done, joints } = sample;
        let Some(there) = self.cuts.in_place(*op, *done, joints) else {
            let shifts = if self.deviations.is_some() { 2 } else { 0 };
            return write!(out, "{}", ",".repeat(4 + model.axes.len() + shifts));
        };
        write!(out, ",{:.3}", there.edge.to_mm())?;
        for part in there.force.to_array().into_iter().chain(there.torques) {
            write!(out, ",{:.3}", rounded(part, 1e3))?;
        }
        let Some(deviations) = &self.deviations else {
            return Ok(());
        };
        let shift = deviations.in_place(*op, *done, joints);
        for shift in shift.iter().flat_map(|shift| [shift.tip, shift.end]) {
            write!(out, ",{:.5}", rounded(shift, 1e5))?;
        }
        Ok(())
    }
}

fn row(op: &Op, sample: &Sample, torques: &Torques, model: &Model, out: &mut dyn Write) -> io::Result<()> {
    place(op, sample, out)?;
    let parts = torques.weight.iter().zip(&torques.motion);
    for (axis, (weight, motion)) in parts.enumerate().take(model.axes.len()) {
        let all = torques.of(axis);
        let [weight, motion, sum] = [*weight, *motion, all].map(|torque| rounded(torque, 1e3));
        write!(out, ",{weight:.3},{motion:.3},{sum:.3},")?;
        let limit = model
            .torques
            .as_ref()
            .and_then(|torques| torques.limits.get(axis));
        if let Some(limit) = limit {
            write!(out, "{:.4}", all.abs() / limit)?;
        }
    }
    Ok(())
}
