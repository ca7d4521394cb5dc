//! `--emit dynamics`: the torques of the axes and the forces of the blade all along the program, as CSV.
//!
//! Rows are those of `--emit joints`. Columns: `op`, `operation`, `layer`, `cut`, `motion` and `done` as there; then of each axis
//! its weight, what it needs to move, and both together in Nm, as the controller counts; and the share of its limit, empty where
//! none is known. Where the forces of a blade are known, there follow what of it is in the material (`edge`, `rim` or `teeth`) and how much
//! at most, the force on the blade and its moment about the tip, both in the work, and what each axis needs against them; where the
//! stiffness of the arm is known, too, how far the flank is off along its normal at the tip and at the end of what is in the material,
//! positive into the waste. All of that is by the numbers as they are stated, and empty where nothing is cut. The moment is empty of a
//! disc as well: at which places of its rim the force acts is not known.

use super::joints::{HEADING, place};
use std::io::{self, Write};
use vcutc_backend_api::ir::Op;
use vcutc_diagnostics::number::rounded;
use vcutc_driver::dynamics::in_places;
use vcutc_dynamics::places::{Place, Places};
use vcutc_job::CheckedJob;
use vcutc_machine::Model;
use vcutc_motion::solve::Reached;
use vcutc_motion::trajectory::Spacing;
use vcutc_simulation::report::Report;

/// Writes the rows of a machine whose torques are known, one after the other.
pub(super) fn write(
    job: &CheckedJob,
    reached: &Reached,
    report: &Report,
    out: &mut dyn Write,
) -> io::Result<()> {
    in_places(job, reached, report, |places| table(places, out)).unwrap_or(Ok(()))
}

fn table(places: &Places<'_>, out: &mut dyn Write) -> io::Result<()> {
    let known = places.known();
    let (model, program) = (known.model, known.reached.program());
    write!(out, "{HEADING}")?;
    heading(places, out)?;
    writeln!(out)?;
    places.along(&Spacing::CLOSE, |there| {
        let Some(op) = program.ops.get(there.sample.op.0 as usize) else {
            return Ok(());
        };
        row(op, there, model, out)?;
        if places.have_forces() {
            pushed(there, places, out)?;
        }
        writeln!(out)
    })
}

fn heading(places: &Places<'_>, out: &mut dyn Write) -> io::Result<()> {
    let axes = &places.known().model.axes;
    for axis in axes {
        let name = &axis.name;
        write!(
            out,
            ",{name}_weight_nm,{name}_motion_nm,{name}_nm,{name}_of_limit"
        )?;
    }
    if places.have_forces() {
        let axes_of = |name, unit| {
            ["x", "y", "z"]
                .map(|axis| format!(",{name}_{axis}_{unit}"))
                .concat()
        };
        let (force, moment) = (axes_of("force", "n"), axes_of("moment", "nm"));
        write!(out, ",engaged,engaged_mm{force}{moment}")?;
        for axis in axes {
            write!(out, ",{}_cutting_nm", axis.name)?;
        }
    }
    if places.have_shifts() {
        write!(out, ",deviation_tip_mm,deviation_end_mm")?;
    }
    Ok(())
}

/// What pushes the blade in a place, and how far.
fn pushed(there: &Place, places: &Places<'_>, out: &mut dyn Write) -> io::Result<()> {
    let Some(pushed) = there.pushed else {
        let shifts = if places.have_shifts() { 2 } else { 0 };
        let axes = places.known().model.axes.len();
        return write!(out, "{}", ",".repeat(8 + axes + shifts));
    };
    write!(out, ",{},{:.3}", pushed.part.word(), pushed.engaged.to_mm())?;
    for part in pushed.force.to_array() {
        write!(out, ",{:.3}", rounded(part, 1e3))?;
    }
    match pushed.moment {
        Some(moment) => {
            for part in moment.to_array() {
                write!(out, ",{:.4}", rounded(part, 1e4))?;
            }
        }
        None => write!(out, ",,,")?,
    }
    for torque in pushed.torques {
        write!(out, ",{:.3}", rounded(torque, 1e3))?;
    }
    for shift in there.shift.iter().flat_map(|shift| [shift.tip, shift.end]) {
        write!(out, ",{:.5}", rounded(shift, 1e5))?;
    }
    Ok(())
}

/// The torques in a place, without those against the forces of the blade.
fn row(op: &Op, there: &Place, model: &Model, out: &mut dyn Write) -> io::Result<()> {
    place(op, &there.sample, out)?;
    let parts = there.torques.weight.iter().zip(&there.torques.motion);
    for (axis, (weight, motion)) in parts.enumerate().take(model.axes.len()) {
        let both = weight + motion;
        let [weight, motion, sum] = [*weight, *motion, both].map(|torque| rounded(torque, 1e3));
        write!(out, ",{weight:.3},{motion:.3},{sum:.3},")?;
        let limit = model
            .torques
            .as_ref()
            .and_then(|torques| torques.limits.get(axis));
        if let Some(limit) = limit {
            write!(out, "{:.4}", both.abs() / limit)?;
        }
    }
    Ok(())
}
