//! `--emit joints`: where the axes are all along the program, as CSV.
//!
//! A row for the end of every op that moves, and rows between, at most 5 mm of the tip's way or 2 deg of turning apart.
//! Columns: `op`, its place in the program (as in `--emit ir`); `operation`, `layer` and `cut` that it serves, counted from 1,
//! empty where it serves none; `motion`, its kind; `done`, how much of it is done, from 0 to 1; then each axis under its
//! name and unit, as the controller counts it. The axes at the program's start are those of home.

use std::io::{self, Write};
use vcutc_backend_api::ir::{Axis, AxisKind, Op, Site};
use vcutc_diagnostics::number::rounded;
use vcutc_job::CheckedJob;
use vcutc_motion::rigs::Rigs;
use vcutc_motion::solve::Reached;
use vcutc_motion::trajectory::{Sample, Spacing, trajectory};

/// The columns that say where a row is.
pub(super) const HEADING: &str = "op,operation,layer,cut,motion,done";

/// Writes the rows, one after the other.
pub(super) fn write(job: &CheckedJob, reached: &Reached, out: &mut dyn Write) -> io::Result<()> {
    let program = reached.program.program();
    let (Some(machine), Some(cell)) = (&job.machine, &program.cell) else {
        return Ok(());
    };
    write!(out, "{HEADING}")?;
    for axis in &cell.axes {
        write!(out, ",{}_{}", axis.name, unit(axis))?;
    }
    writeln!(out)?;
    let rigs = Rigs::of(&machine.model, cell, program);
    trajectory(&reached.program, &rigs, &Spacing::CLOSE, |sample| {
        match program.ops.get(sample.op.0 as usize) {
            Some(op) => row(op, &sample, &cell.axes, out),
            None => Ok(()),
        }
    })
}

/// The columns that say where a row is.
pub(super) fn place(op: &Op, sample: &Sample, out: &mut dyn Write) -> io::Result<()> {
    write!(out, "{},", sample.op.0)?;
    match op.site {
        Site::Program => write!(out, ",,")?,
        Site::Operation(operation) => write!(out, "{},,", u32::from(operation.0) + 1)?,
        Site::Layer { operation, layer } => write!(out, "{},{layer},", u32::from(operation.0) + 1)?,
        Site::Cut {
            operation,
            layer,
            cut,
        } => write!(out, "{},{layer},{cut}", u32::from(operation.0) + 1)?,
    }
    write!(out, ",{},{:.6}", op.action.kind().name(), sample.done)
}

fn row(op: &Op, sample: &Sample, axes: &[Axis], out: &mut dyn Write) -> io::Result<()> {
    place(op, sample, out)?;
    for (axis, value) in axes.iter().zip(sample.joints) {
        let shown = match axis.kind {
            AxisKind::Rotary => value.to_degrees(),
            AxisKind::Linear => value,
        };
        write!(out, ",{:.4}", rounded(shown, 1e4))?;
    }
    writeln!(out)
}

const fn unit(axis: &Axis) -> &'static str {
    match axis.kind {
        AxisKind::Rotary => "deg",
        AxisKind::Linear => "mm",
    }
}
