//! `--emit`: the forms a job has between its text and the program.
//!
//! Only the intermediate program, with its motion, is an exchange format with a version. The tree is for people who work on the compiler;
//! the plan is a table for people who want to look at the cuts, in a spreadsheet or a plot.

use super::args::InnerForm;
use super::dynamics;
use super::files::stem;
use super::joints;
use std::io::{self, BufWriter, Write};
use vcutc_backend_api::bundle::{Sink, SinkError};
use vcutc_backend_api::exchange::Exchange;
use vcutc_backend_api::units::Angle;
use vcutc_driver::{Compiled, Outcome};
use vcutc_job::planned::{CutShape, PlannedStrip, PlannedTip, PlannedWay};
use vcutc_job::{BladeRef, CheckedJob, PlannedJob, PlannedOperation};
use vcutc_surface::deviation;

/// Writes a form of the job as one file. Returns whether the job got far enough to have it.
///
/// Everything is streamed: a plan of a million cuts is hundreds of megabytes of text.
pub(super) fn write(
    form: InnerForm,
    outcome: &Outcome,
    job: &str,
    sink: &mut dyn Sink,
) -> Result<Progressed, SinkError> {
    let name = file_name(form, job);
    match form {
        InnerForm::Ast => match &outcome.ast {
            Some(ast) => file(sink, &name, |out| writeln!(out, "{ast:#?}")),
            None => Ok(Progressed::NotSoFar),
        },
        InnerForm::Plan => match &outcome.plan {
            Some(plan) => file(sink, &name, |out| write_plan(plan, out)),
            None => Ok(Progressed::NotSoFar),
        },
        InnerForm::Ir => match &outcome.compiled {
            Some(compiled) => {
                let motion = compiled.program.reached().map(|reached| reached.program.motion());
                let form = Exchange::of(compiled.program.verified().program(), motion);
                file(sink, &name, |out| write_json(&form, out))
            }
            None => Ok(Progressed::NotSoFar),
        },
        InnerForm::Joints => match (&outcome.job, &outcome.compiled) {
            (Some(job), Some(compiled)) => match compiled.program.reached() {
                Some(reached) => file(sink, &name, |out| joints::write(job, reached, out)),
                None => Ok(Progressed::WithoutMachine),
            },
            (Some(_) | None, _) => Ok(Progressed::NotSoFar),
        },
        InnerForm::Dynamics => match (&outcome.job, &outcome.compiled) {
            (Some(job), Some(compiled)) => match (compiled.program.reached(), &compiled.dynamics.torques) {
                (Some(reached), Some(_)) => file(sink, &name, |out| {
                    dynamics::write(job, reached, &compiled.report, out)
                }),
                (Some(_), None) => Ok(Progressed::WithoutMasses),
                (None, _) => Ok(Progressed::WithoutMachine),
            },
            (Some(_) | None, _) => Ok(Progressed::NotSoFar),
        },
        InnerForm::Deviation => match (&outcome.job, &outcome.compiled) {
            (Some(job), Some(compiled)) => match deviation_of(job, compiled) {
                Some(bytes) => file(sink, &name, |out| out.write_all(&bytes)),
                None => Ok(Progressed::WithoutSurface),
            },
            (Some(_) | None, _) => Ok(Progressed::NotSoFar),
        },
    }
}

fn deviation_of(job: &CheckedJob, compiled: &Compiled) -> Option<Vec<u8>> {
    let surface = job.part.surface()?;
    let machined = job
        .part
        .left_by(&compiled.report.contour, &compiled.report.columns, job.stock)?;
    Some(deviation::ply(surface, &machined))
}

/// Whether a job got as far as a form.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Progressed {
    /// The form is written.
    Written,
    /// Errors kept the job from getting there.
    NotSoFar,
    /// The job has no machine, and the form is about one.
    WithoutMachine,
    /// The torques of the job's machine are not known, and the form is about them.
    WithoutMasses,
    /// The part is a profile, and the form is about surfaces.
    WithoutSurface,
}

/// `jobs/rib.vcut` as a tree is `rib.ast.txt`.
fn file_name(form: InnerForm, job: &str) -> String {
    let stem = stem(job);
    let ending = match form {
        InnerForm::Ast => "ast.txt",
        InnerForm::Plan => "plan.csv",
        InnerForm::Ir => "ir.json",
        InnerForm::Joints => "joints.csv",
        InnerForm::Dynamics => "dynamics.csv",
        InnerForm::Deviation => "deviation.ply",
    };
    format!("{stem}.{ending}")
}

fn file(
    sink: &mut dyn Sink,
    name: &str,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<Progressed, SinkError> {
    sink.file(name)?;
    let mut out = BufWriter::new(SinkWriter(sink));
    write(&mut out)
        .and_then(|()| out.flush())
        .map_err(|error| SinkError(error.to_string()))?;
    Ok(Progressed::Written)
}

fn write_json(value: &impl serde::Serialize, out: &mut dyn Write) -> io::Result<()> {
    serde_json::to_writer_pretty(&mut *out, value)?;
    writeln!(out)
}

/// A row for each cut. Operations, layers and cuts are counted from 1. A field that says nothing about a cut is empty.
fn write_plan(plan: &PlannedJob, out: &mut dyn Write) -> io::Result<()> {
    writeln!(
        out,
        "operation,layer,cut,kind,blade,x_mm,z_mm,swing_deg,lead_deg,left_mm,right_mm,bottom_mm,top_mm,origin,\
         y_mm,length_mm,entry"
    )?;
    for (number, operation) in (1_u32..).zip(&plan.operations) {
        write_operation(number, &**operation, out)?;
    }
    Ok(())
}

fn write_operation(number: u32, planned: &dyn PlannedOperation, out: &mut dyn Write) -> io::Result<()> {
    for layer in planned.tips().chunk_by(|a, b| a.layer == b.layer) {
        for (cut, tip) in (1_u32..).zip(layer) {
            let blade = planned.blade_of(tip.shape).map_or("", BladeRef::name);
            let (layer, x, z) = (tip.layer, tip.tip.x, tip.tip.z);
            let shape = columns_of(tip, planned.swing());
            let origin = tip.origin.word();
            writeln!(
                out,
                "{number},{layer},{cut},{},{blade},{x:.3},{z:.3},{},{},{},{origin},,,",
                shape.kind, shape.swing, shape.lead, shape.bounds
            )?;
        }
    }
    for way in planned.ways() {
        write_way(number, planned, way, out)?;
    }
    Ok(())
}

/// A row for a way over a region of the plan.
fn write_way(
    number: u32,
    planned: &dyn PlannedOperation,
    way: PlannedWay,
    out: &mut dyn Write,
) -> io::Result<()> {
    let blades = planned.asked().blades();
    let blade = blades.get(way.blade).map_or("", |blade| blade.name());
    let ([x, y], [bottom, top]) = (way.from, way.heights);
    writeln!(
        out,
        "{number},{},{},{},{blade},{x:.3},{bottom:.3},,,,,{bottom:.3},{top:.3},,{y:.3},{:.3},{}",
        way.layer,
        way.number,
        way.kind.word(),
        way.length,
        way.entry.word()
    )
}

/// What a row says about the shape of its cut.
struct Columns {
    kind: &'static str,
    /// Of a V with narrowed flanks the swings of both, the left one first; of a track how far it is rolled.
    swing: String,
    lead: String,
    /// Left, right, bottom and top of what is cut free; of a track the place where it stands on the part.
    bounds: String,
}

fn columns_of(tip: &PlannedTip, swing: Angle) -> Columns {
    let kind = tip.shape.kind().noun();
    let straight = |swing, bounds| Columns {
        kind,
        swing,
        lead: String::new(),
        bounds,
    };
    let swing = || format!("{:.3}", swing.to_deg());
    match tip.shape {
        CutShape::Plain => straight(swing(), ",,,".to_owned()),
        CutShape::Narrowed { left, right } => straight(
            format!("{:.4}/{:.4}", left.to_deg(), right.to_deg()),
            ",,,".to_owned(),
        ),
        CutShape::Slit { top } => straight(swing(), format!(",,{:.3},{top:.3}", tip.tip.z)),
        CutShape::Strip(PlannedStrip { low, high, lead, .. }) => Columns {
            kind,
            swing: swing(),
            lead: format!("{:.3}", lead.to_deg()),
            bounds: format!("{:.3},{:.3},{:.3},{:.3}", low.x, high.x, low.z, high.z),
        },
        CutShape::Track { contact, lead, roll } => Columns {
            kind,
            swing: format!("{:.3}", roll.to_deg()),
            lead: format!("{:.3}", lead.to_deg()),
            bounds: format!("{0:.3},{0:.3},{1:.3},{1:.3}", contact.x, contact.z),
        },
    }
}

/// A sink as a writer.
struct SinkWriter<'s>(&'s mut dyn Sink);

impl Write for SinkWriter<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0
            .write(bytes)
            .map_err(|error| io::Error::other(error.to_string()))?;
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use vcutc_backend_api::bundle::Bundle;

    #[test]
    fn files_are_named_after_the_job() {
        assert_eq!(file_name(InnerForm::Ir, "jobs/rib.vcut"), "rib.ir.json");
        assert_eq!(file_name(InnerForm::Ast, "rib"), "rib.ast.txt");
        assert_eq!(file_name(InnerForm::Plan, "<stdin>"), "stdin.plan.csv");
    }

    #[test]
    fn a_value_streams_into_the_file_whole() {
        let mut bundle = Bundle::default();
        let value: Vec<u32> = (0..10_000).collect();
        file(&mut bundle, "a.json", |out| write_json(&value, out)).unwrap();
        let bytes = bundle.get("a.json").unwrap();
        assert_eq!(serde_json::from_slice::<Vec<u32>>(bytes).unwrap(), value);
    }
}
