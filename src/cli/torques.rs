//! `--emit dynamics`: the torques of the axes all along the program, as CSV.
//!
//! Rows are those of `--emit joints`. Columns: `op`, `operation`, `layer`, `cut`, `motion` and `done` as there; then of each axis
//! its weight, what it needs to move, and both together in Nm, as the controller counts; and the share of its limit, empty where
//! none is known.

use super::joints::{HEADING, place};
use std::io::{self, Write};
use vcutc_backend_api::ir::Op;
use vcutc_dynamics::drives::{Drives, Torques};
use vcutc_job::CheckedJob;
use vcutc_machine::Model;
use vcutc_motion::solve::Reached;
use vcutc_motion::trajectory::{Sample, Spacing};

/// Writes the rows of a machine whose torques are known, one after the other.
pub(super) fn write(job: &CheckedJob, reached: &Reached, out: &mut dyn Write) -> io::Result<()> {
    let program = reached.program.program();
    let (Some(machine), Some(cell)) = (&job.machine, &program.cell) else {
        return Ok(());
    };
    let model = &machine.model;
    let Ok(drives) = Drives::of(model, cell, program) else {
        return Ok(());
    };
    write!(out, "{HEADING}")?;
    for axis in &model.axes {
        let name = &axis.name;
        write!(
            out,
            ",{name}_weight_nm,{name}_motion_nm,{name}_nm,{name}_of_limit"
        )?;
    }
    writeln!(out)?;
    drives.along(&reached.program, &Spacing::CLOSE, |sample, torques| match program
        .ops
        .get(sample.op.0 as usize)
    {
        Some(op) => row(op, sample, torques, model, out),
        None => Ok(()),
    })
}

fn row(op: &Op, sample: &Sample, torques: &Torques, model: &Model, out: &mut dyn Write) -> io::Result<()> {
    place(op, sample, out)?;
    let parts = torques.weight.iter().zip(&torques.motion);
    for (axis, (weight, motion)) in parts.enumerate().take(model.axes.len()) {
        let all = torques.of(axis);
        // Adding zero turns a negative zero into zero.
        let [weight, motion, sum] = [*weight, *motion, all].map(|torque| (torque * 1e3).round() / 1e3 + 0.0);
        write!(out, ",{weight:.3},{motion:.3},{sum:.3},")?;
        let limit = model
            .torques
            .as_ref()
            .and_then(|torques| torques.limits.get(axis));
        if let Some(limit) = limit {
            write!(out, "{:.4}", all.abs() / limit)?;
        }
    }
    writeln!(out)
}
