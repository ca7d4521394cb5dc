//! From the plan to the program: each operation writes its motions down, from home to home.

use vcutc_backend_api::builder::ProgramBuilder;
use vcutc_backend_api::ir::{Action, Cell, Program, Site, SourceRef, Stock};
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::source::{SourceMap, Span};
use vcutc_job::{BladeRef, CheckedJob, Machine, PlannedJob, PlannedOperation};

/// How far the tip may leave the way where one piece of a chain goes on into the next, so that the machine need not stop at each.
pub const BLEND: Length = Length::mm(0.005);

/// How far passes over regions keep from walls beyond what they must, so that rounding to the grid of programs takes nothing of it.
/// What a tool reaches only nearer to the walls than that counts as out of its reach.
pub const ROUNDING_ROOM: Length = Length::mm(0.002);

/// Writes the plan down as a program.
#[must_use]
pub fn lower(plan: &PlannedJob, sources: &SourceMap) -> Program {
    let operations = plan.operations.iter().map(|planned| {
        let source = source_ref(sources, planned.asked().setup().head_span);
        (&**planned, source)
    });
    written(&plan.name, plan.stock, plan.machine.as_ref(), operations)
}

/// Writes one operation of a job down as a program of its own, which knows no place in the job's text.
#[must_use]
pub fn alone(job: &CheckedJob, planned: &dyn PlannedOperation) -> Program {
    let nowhere = SourceRef {
        file: String::new(),
        start: 0,
        end: 0,
    };
    written(&job.name, job.stock, job.machine.as_ref(), [(planned, nowhere)])
}

fn written<'p>(
    name: &str,
    stock: Stock,
    machine: Option<&Machine>,
    operations: impl IntoIterator<Item = (&'p dyn PlannedOperation, SourceRef)>,
) -> Program {
    let operations: Vec<(&dyn PlannedOperation, SourceRef)> = operations.into_iter().collect();
    let blades = blades(&operations);
    let cell = machine.map(|machine| cell(machine, &blades));
    let mut builder = ProgramBuilder::new(name, stock, cell);
    builder.op(Site::Program, Action::Home);
    for (planned, source) in operations {
        planned.lower(source, &mut builder);
    }
    builder.op(Site::Program, Action::Home);
    builder.finish()
}

/// The blades, each once, in the order in which they are first used.
fn blades<'p>(operations: &[(&'p dyn PlannedOperation, SourceRef)]) -> Vec<BladeRef<'p>> {
    let mut used: Vec<BladeRef<'_>> = Vec::new();
    for blade in operations
        .iter()
        .flat_map(|(planned, _)| planned.asked().blades())
    {
        if used.iter().all(|known| known.name() != blade.name()) {
            used.push(blade);
        }
    }
    used
}

fn cell(machine: &Machine, blades: &[BladeRef<'_>]) -> Cell {
    let spins = blades.iter().any(|blade| blade.spin().is_some());
    Cell {
        name: machine.name.clone(),
        kind: machine.model.kind(),
        maker: machine.model.maker,
        model: machine.model.name.clone(),
        axes: machine.model.axes.to_vec(),
        tools: machine.tools.in_program(blades.iter().map(|blade| blade.name())),
        base: machine.base.value,
        home: machine.home.map(|home| home.value),
        change: machine.change.map(|held| held.change),
        ultrasonic: machine.ultrasonic.map(|output| output.value),
        spindle: machine.spindle().filter(|_| spins),
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
