//! Which machine the job runs on.
//!
//! A shop's library may define several. `cell { machine = NAME }` chooses; without it a machine in the job's own file
//! is meant, or the only one there is.

use super::eval::Scope;
use super::fields::{BlockSpec, Fields, Inner, value};
use super::gather::{MachineBlock, Placed, Standing};
use super::names::Thing;
use super::read::looks_like;
use super::report::Checked;
use super::session::Session;
use crate::diag::{Code, Diagnostic};
use crate::job::Machine;
use crate::source::Span;
use crate::syntax::ast::Expr;

const SPEC: BlockSpec = BlockSpec {
    title: "`cell`",
    fields: &[value("machine", "gantry")],
    inner: Inner::Refused,
};

/// Where to point, and where to write, when the choice is missing.
#[derive(Clone, Copy)]
pub(crate) struct Anchor {
    /// Where to point.
    pub(crate) place: Span,
    /// The end of the root file.
    pub(crate) end: Span,
}

/// The machine of the job. `checked` holds the machines' contents in the order of `blocks`.
pub(crate) fn choose(
    cell: Option<Placed<'_>>,
    blocks: &[MachineBlock<'_>],
    checked: &[Checked<Machine>],
    anchor: Anchor,
    scope: Scope<'_>,
    session: &mut Session<'_>,
) -> Checked<Option<Machine>> {
    let index = match cell {
        Some(cell) => named(cell, scope, session)?,
        None => match only(blocks) {
            Some(index) => index,
            None if blocks.is_empty() => return Ok(None),
            None => return Err(session.reports.push(ambiguous(blocks, anchor))),
        },
    };
    checked.get(index).cloned().transpose()
}

/// The machine that needs no naming: the only one of the root file, or the only one at all.
fn only(blocks: &[MachineBlock<'_>]) -> Option<usize> {
    let mut own = blocks
        .iter()
        .enumerate()
        .filter(|(_, block)| matches!(block.standing, Standing::Root));
    match (own.next(), own.next(), blocks) {
        (Some((index, _)), None, _) => Some(index),
        (None, None, [_]) => Some(0),
        _ => None,
    }
}

/// The machine that the block names.
fn named(cell: Placed<'_>, scope: Scope<'_>, session: &mut Session<'_>) -> Checked<usize> {
    let fields = Fields::sort(&SPEC, cell.place, &cell.block.entries, session);
    let expr = fields.required_value("machine", &mut session.reports)?;
    let is_machine = |thing| matches!(thing, Thing::Machine(_));
    let Expr::Name(name) = &expr.node else {
        let diagnostic = Diagnostic::new(
            Code::WrongKind,
            format!(
                "`machine` takes the name of a machine, not {}",
                looks_like(&expr.node)
            ),
            expr.span,
            "the name of a machine is wanted here",
        );
        return Err(session.reports.push(diagnostic));
    };
    match scope.names.get(name).map(|definition| definition.thing) {
        Some(Thing::Machine(index)) => Ok(index),
        Some(Thing::Let(_) | Thing::Blade(_)) | None => {
            Err(scope
                .names
                .not_a("machine", name, expr.span, is_machine, &mut session.reports))
        }
    }
}

/// Most machines that are shown.
const MOST_SHOWN: usize = 4;

fn ambiguous(blocks: &[MachineBlock<'_>], anchor: Anchor) -> Diagnostic {
    let mut diagnostic = Diagnostic::new(
        Code::MissingBlock,
        format!("the job does not say which of {} machines to use", blocks.len()),
        anchor.place,
        "needs a `cell` block",
    );
    for block in blocks.iter().take(MOST_SHOWN) {
        let name = block.head.name.node;
        let choice = format!("cell {{ machine = {name} }}");
        diagnostic = diagnostic
            .and(block.head.name.span, format!("`{name}` is one"))
            .fix(
                format!("choose it with `{choice}`"),
                anchor.end,
                format!("\n{choice}\n"),
            );
    }
    diagnostic
}
