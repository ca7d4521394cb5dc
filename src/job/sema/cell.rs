//! Which machine the job runs on.
//!
//! A shop's library may define several. `--machine NAME` chooses, or else `cell { machine = NAME }`; without them a
//! machine in the job's own file is meant, or the only one there is.

use super::eval::Scope;
use super::fields::{BlockSpec, Fields, Inner, Takes, value};
use super::gather::{MachineBlock, Placed, Standing};
use super::names::{Definition, Thing, did_you_mean};
use super::read::looks_like;
use super::report::Checked;
use super::session::Session;
use crate::Machine;
use vcutc_diagnostics::source::{Span, Spanned};
use vcutc_diagnostics::suggest::nearest;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_syntax::ast::Expr;

pub(crate) const SPEC: BlockSpec = BlockSpec {
    title: "`cell`",
    fields: &[value("machine", "gantry").required().takes(Takes::Machine)],
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

/// What is said about the choice.
#[derive(Clone, Copy)]
pub(crate) struct Said<'a> {
    /// By `--machine`. It counts more than the block.
    pub(crate) on_the_command_line: Option<&'a Spanned<String>>,
    /// By a `cell` block.
    pub(crate) in_the_job: Option<Placed<'a>>,
}

/// The name after `--machine`, as a text of its own that diagnostics can point into.
pub(crate) fn wanted(name: Option<&str>, session: &mut Session<'_>) -> Option<Spanned<String>> {
    let name = name?;
    let file = session.sources.add(format!("--machine {name}"), name.to_owned());
    let span = Span {
        file,
        start: 0,
        end: u32::try_from(name.len()).unwrap_or(u32::MAX),
    };
    Some(Spanned::new(name.to_owned(), span))
}

/// The machine of the job. `checked` holds the machines' contents in the order of `blocks`.
///
/// A `cell` block is read even where the command line says otherwise: a job is right or wrong whatever it is run with.
pub(crate) fn choose(
    said: Said<'_>,
    blocks: &[MachineBlock<'_>],
    checked: &[Checked<Machine>],
    anchor: Anchor,
    scope: Scope<'_>,
    session: &mut Session<'_>,
) -> Checked<Option<Machine>> {
    let in_the_job = said
        .in_the_job
        .map(|cell| named(cell, scope, session))
        .transpose();
    let index = match said.on_the_command_line {
        Some(wanted) => Some(typed(wanted, blocks, scope, session)?),
        None => in_the_job?,
    };
    let index = match index {
        Some(index) => index,
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
            "expected the name of a machine here",
        );
        return Err(session.reports.push(diagnostic));
    };
    match scope.names.get(name).map(|definition| definition.thing) {
        Some(Thing::Machine(index)) => Ok(index),
        Some(Thing::Let(_) | Thing::Blade(_) | Thing::Region(_)) | None => {
            Err(scope
                .names
                .not_a("machine", name, expr.span, is_machine, &mut session.reports))
        }
    }
}

/// The machine that the command line names.
fn typed(
    wanted: &Spanned<String>,
    blocks: &[MachineBlock<'_>],
    scope: Scope<'_>,
    session: &mut Session<'_>,
) -> Checked<usize> {
    match (scope.names.get(&wanted.node), scope.names.incomplete) {
        (
            Some(Definition {
                thing: Thing::Machine(index),
                ..
            }),
            _,
        ) => Ok(index),
        // It may be in text that could not be read.
        (None, Some(reported)) => Err(reported),
        (other, _) => Err(session.reports.push(no_machine(wanted, other, blocks))),
    }
}

/// Says that the command line names no machine, and which ones there are.
fn no_machine(
    wanted: &Spanned<String>,
    other: Option<Definition>,
    blocks: &[MachineBlock<'_>],
) -> Diagnostic {
    let (name, span) = (&wanted.node, wanted.span);
    let diagnostic = match other {
        Some(other) => Diagnostic::new(
            Code::WrongKind,
            format!("`{name}` is {}, not a machine", other.thing.words()),
            span,
            "expected a machine here",
        )
        .and(other.span, "defined here"),
        None => {
            let names = blocks.iter().map(|block| block.head.name.node);
            let diagnostic = Diagnostic::new(
                Code::UnknownName,
                format!("there is no machine named `{name}`"),
                span,
                "not defined in the job or in any file that it uses",
            );
            did_you_mean(diagnostic, span, &nearest(name, names))
        }
    };
    if blocks.is_empty() {
        return diagnostic.help("define it, or `use` the file that does");
    }
    let shown = blocks.iter().take(MOST_SHOWN);
    shown.fold(diagnostic, |diagnostic, block| {
        diagnostic.and(block.head.name.span, is_one(block))
    })
}

fn is_one(block: &MachineBlock<'_>) -> String {
    format!("`{}` is one", block.head.name.node)
}

/// Most machines that are shown.
const MOST_SHOWN: usize = 4;

fn ambiguous(blocks: &[MachineBlock<'_>], anchor: Anchor) -> Diagnostic {
    let mut diagnostic = Diagnostic::new(
        Code::MissingBlock,
        format!("the job does not say which of {} machines to use", blocks.len()),
        anchor.place,
        "needs a `cell` block",
    )
    .help("`--machine NAME` chooses one for a single run");
    for block in blocks.iter().take(MOST_SHOWN) {
        let name = block.head.name.node;
        let choice = format!("cell {{ machine = {name} }}");
        diagnostic = diagnostic.and(block.head.name.span, is_one(block)).fix(
            format!("choose it with `{choice}`"),
            anchor.end,
            format!("\n{choice}\n"),
        );
    }
    diagnostic
}
