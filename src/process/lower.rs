//! From the plan to the program: postures, approaches, retracts, turns, switching.
//!
//! One file a question: `builder` collects ops and their tables, `postures` knows the few ways in which an operation holds
//! its blade, `vcut` writes down the moves of V-cutting. Adding a kind of operation adds a file beside `vcut` and an arm here.

mod builder;
mod postures;
#[cfg(test)]
mod tests;
mod vcut;

use crate::plan::{PlannedJob, PlannedOperation, PlannedVcut};
use builder::Builder;
use vcutc_backend_api::ir::{Action, Cell, Program, Site, SourceRef, Stock};
use vcutc_diagnostics::source::{SourceMap, Span};
use vcutc_job::{CheckedJob, Machine};

/// Writes the plan down as a program.
#[must_use]
pub fn lower(plan: &PlannedJob, sources: &SourceMap) -> Program {
    let operations = plan.operations.iter().map(|PlannedOperation::RoughVcut(vcut)| {
        let source = source_ref(sources, vcut.asked.head_span);
        (vcut, source)
    });
    written(&plan.name, plan.stock, plan.machine.as_ref(), operations)
}

/// Writes one operation of a job down as a program of its own, which knows no place in the job's text.
#[must_use]
pub fn alone(job: &CheckedJob, vcut: &PlannedVcut) -> Program {
    let nowhere = SourceRef {
        file: String::new(),
        start: 0,
        end: 0,
    };
    written(&job.name, job.stock, job.machine.as_ref(), [(vcut, nowhere)])
}

fn written<'p>(
    name: &str,
    stock: Stock,
    machine: Option<&Machine>,
    operations: impl IntoIterator<Item = (&'p PlannedVcut, SourceRef)>,
) -> Program {
    let mut builder = Builder::new(name, stock, machine.map(cell));
    builder.op(Site::Program, Action::Home);
    for (vcut, source) in operations {
        vcut::lower(vcut, source, &mut builder);
    }
    builder.op(Site::Program, Action::Home);
    builder.finish()
}

fn cell(machine: &Machine) -> Cell {
    Cell {
        name: machine.name.clone(),
        kind: machine.model.kind(),
        maker: machine.model.maker,
        model: machine.model.name.clone(),
        axes: machine.model.axes.to_vec(),
        tool: machine.tool.value,
        base: machine.base.value,
        load: machine.load.map(|load| load.value),
        home: machine.home.map(|home| home.value),
        ultrasonic: machine.ultrasonic.map(|output| output.value),
        ready: machine.ready.value,
    }
}

fn source_ref(sources: &SourceMap, span: Span) -> SourceRef {
    SourceRef {
        file: sources.name(span.file).to_owned(),
        start: span.start,
        end: span.end,
    }
}
