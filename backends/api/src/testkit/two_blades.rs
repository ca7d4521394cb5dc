//! Programs that change the blade.

use crate::geometry::{Orientation, Point3};
use crate::ir::{
    Action, AxisValues, Blade, Cell, Change, Changer, Inertia, Load, MachineKind, Op, OperationId,
    PlacedFrame, Program, Registered, Site, Tool, ToolId,
};
use crate::units::{Duration, Length, Mass};

/// The same program with another blade from the second operation on; without a second operation, with a change at its end. The
/// second operation then begins with a move of all axes.
#[must_use]
pub fn two_blades(mut program: Program, by: Changer) -> Program {
    let second = ToolId(1);
    program.blades = program.blades.first().into_iter().cloned().collect();
    program.blades.extend(program.blades.first().map(shorter));
    if let Some(cell) = &mut program.cell {
        hold_two(cell, by);
    }
    for operation in program.operations.iter_mut().skip(1) {
        operation.tools = vec![second];
    }
    let is_of_second = |op: &Op| op.site.operation().is_some_and(|id| id >= OperationId(1));
    let op = |action| Op {
        site: Site::Program,
        action,
    };
    let change = [Action::ChangePlace, Action::ToolChange { tool: second }].map(op);
    match program.ops.iter().position(is_of_second) {
        Some(place) => {
            let later = program.ops.iter_mut().skip(place);
            later.take(2).for_each(by_axes);
            program.ops.splice(place..place, change);
        }
        None => program.ops.extend(change.into_iter().chain([op(Action::Home)])),
    }
    program
}

/// The first way of an operation, after a wait perhaps, as a move of all axes.
fn by_axes(op: &mut Op) {
    if let Action::Travel { to, orientation, .. } = op.action {
        op.action = Action::AxisTravel { to, orientation };
    }
}

fn shorter(blade: &Blade) -> Blade {
    let mut shorter = blade.clone();
    "short".clone_into(&mut shorter.name);
    if let Some(straight) = shorter.straight_mut() {
        straight.cutting_length -= Length::mm(1.0);
    }
    shorter
}

/// Gives a cell a second tool, and a way to change to it.
pub(super) fn hold_two(cell: &mut Cell, by: Changer) {
    let mut first = *cell.tools.first();
    first.place = Some(1);
    // A control of G-code knows the length of a tool alone.
    let aside = match cell.kind {
        MachineKind::Robot => (1.0, 2.0),
        MachineKind::FiveAxis => (0.0, 0.0),
    };
    cell.tools = crate::ir::Tools::one(first).and(Tool {
        frame: PlacedFrame {
            frame: crate::geometry::Frame {
                origin: Point3::new(aside.0, aside.1, 250.0),
                orientation: Orientation::IDENTITY,
            },
            number: first.frame.number.map(|number| number + 1),
        },
        load: Some(Registered::Value(Load {
            mass: Mass::kg(2.5),
            centre: Point3::new(0.0, 0.0, 80.0),
            inertia: Some(Inertia {
                x: 0.012,
                y: 0.0115,
                z: 0.004,
            }),
        })),
        place: Some(2),
    });
    let mut at = [0.1, -1.0, 1.5, 0.2, 1.0, 0.3];
    at.iter_mut()
        .skip(cell.axes.len())
        .for_each(|beyond| *beyond = 0.0);
    cell.change = Some(Change {
        at: AxisValues(at),
        time: Duration::s(10.0),
        by,
    });
}
