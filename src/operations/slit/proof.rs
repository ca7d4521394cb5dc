//! The proof of slits along the walls of a region, and how they look from above.

use crate::asked::SlitWalls;
use vcutc_backend_api::ir::{OperationId, Program, ToolId};
use vcutc_job::operation::judged::{FromAbove, Judged};
use vcutc_process::slits::proof::{Held, OfBlade, judge as judge_slits, ways};
use vcutc_process::slits::stated::stated;
use vcutc_region::region::Side;
use vcutc_simulation::prove::Replay;

/// Judges the slits of a program, in what its other cuts leave: adds what is wrong, and what they do.
pub(crate) fn judge(asked: &SlitWalls, judged: Judged<'_>, replay: &mut Replay) {
    let (program, operation) = (judged.program, judged.operation);
    let Some(tool) = tool_of(program, operation) else {
        return;
    };
    let held = Held {
        region: &asked.region.region,
        floor: asked.floor.value,
        allowance: asked.allowance.value,
        residual: asked.residual.value,
    };
    let of = OfBlade {
        program,
        operation,
        tool,
    };
    let slit = judge_slits(held, of, &mut replay.findings, &mut replay.surface);
    replay.slit.extend(slit);
}

/// The blade of an operation that has one.
fn tool_of(program: &Program, operation: OperationId) -> Option<ToolId> {
    program.operation(operation)?.tools.first().copied()
}

/// The slits of a program from above; none of one that has none.
pub(crate) fn from_above(asked: &SlitWalls, operation: OperationId, program: &Program) -> Option<FromAbove> {
    let tool = tool_of(program, operation)?;
    let blade = program.blade(tool)?.straight()?;
    let moves = stated(program, (operation, tool), blade, program.stock.height.to_mm());
    let walls = asked.region.region.edges();
    let walls = walls.filter(|edge| edge.side == Side::Wall);
    Some(FromAbove {
        walls: walls.map(|edge| edge.piece).collect(),
        slits: ways(moves.iter()),
        ..FromAbove::default()
    })
}
