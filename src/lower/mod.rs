//! From the plan to the program: postures, approaches, retracts, turns, switching.
//!
//! One file a question: `builder` collects ops and their tables, `vcut` writes
//! down the moves of V-cutting. Adding a kind of operation adds a file beside `vcut` and an arm here.

mod builder;
#[cfg(test)]
mod tests;
mod vcut;

use crate::plan::{PlannedJob, PlannedOperation};
use crate::source::{SourceMap, Span};
use builder::Builder;
use vcutc_backend_api::ir::{Action, Cell, Program, Site, SourceRef};

/// Writes the plan down as a program.
#[must_use]
pub fn lower(plan: &PlannedJob, sources: &SourceMap) -> Program {
    let mut builder = Builder::new(&plan.name, plan.stock, cell(plan));
    builder.op(Site::Program, Action::Home);
    for operation in &plan.operations {
        match operation {
            PlannedOperation::RoughVcut(vcut) => {
                vcut::lower(vcut, source_ref(sources, vcut.asked.head_span), &mut builder);
            }
        }
    }
    builder.op(Site::Program, Action::Home);
    builder.finish()
}

fn cell(plan: &PlannedJob) -> Option<Cell> {
    let machine = plan.machine.as_ref()?;
    Some(Cell {
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
    })
}

fn source_ref(sources: &SourceMap, span: Span) -> SourceRef {
    SourceRef {
        file: sources.name(span.file).to_owned(),
        start: span.start,
        end: span.end,
    }
}
