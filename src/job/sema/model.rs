//! The model that the head of a machine's block names: one of the catalogue, or one described by a file.

use super::described;
use super::files::Relative;
use super::heads::{Head, MACHINES};
use super::names::did_you_mean;
use super::report::{Checked, Reports};
use super::session::{Described, Session};
use std::sync::Arc;
use vcutc_backend_api::ir::MachineKind;
use vcutc_diagnostics::source::{Spanned, join_path};
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_machine::{self as machine, FileKind, Origin, catalogue, limit_places};

/// The model, which is of the kind that the head says.
pub(crate) fn resolve(head: &Head<'_>, session: &mut Session<'_>) -> Checked<Described> {
    let model = match Origin::of(head.model.node) {
        Origin::Catalogue => from_catalogue(head.model, session)?,
        Origin::File(kind) => from_file(kind, head.model, session)?,
    };
    let kind = model.model.kind();
    if kind == head.kind.node {
        return Ok(model);
    }
    Err(session.reports.push(wrong_kind(head, kind)))
}

/// The machine of that name. Each is read once, however many cells have one.
fn from_catalogue(model: Spanned<&str>, session: &mut Session<'_>) -> Checked<Described> {
    if let Some(known) = session.machines.get(model.node) {
        return known.clone();
    }
    match catalogue::find(model.node) {
        Some(machine) => {
            let described = Described {
                model: Arc::new(machine),
                limits: Vec::new(),
            };
            session
                .machines
                .insert(model.node.to_owned(), Ok(described.clone()));
            Ok(described)
        }
        // Not kept: it is reported at every place that names it.
        None => {
            let diagnostic = unknown(model, &session.reports);
            Err(session.reports.push(diagnostic))
        }
    }
}

fn unknown(model: Spanned<&str>, reports: &Reports) -> Diagnostic {
    let diagnostic = Diagnostic::new(
        Code::UnknownMachine,
        format!("there is no machine `{}` in the catalogue", model.node),
        model.span,
        "not in the catalogue",
    );
    // Comparing with all names takes time, and so many messages are not read.
    let names: Vec<String> = if reports.are_many() {
        Vec::new()
    } else {
        catalogue::near(model.node)
            .iter()
            .map(|name| format!("\"{name}\""))
            .collect()
    };
    let near: Vec<&str> = names.iter().map(String::as_str).collect();
    did_you_mean(diagnostic, model.span, &near)
        .help("`vcutc machines` lists them; describe your own machine in a file such as `\"arm.toml\"`")
}

/// The machine that a file describes. The path is relative to the file with the machine's block.
fn from_file(kind: FileKind, model: Spanned<&str>, session: &mut Session<'_>) -> Checked<Described> {
    let path = join_path(session.sources.name(model.span.file), model.node);
    if let Some(known) = session.machines.get(&path) {
        return known.clone();
    }
    let machine = described::read(&path, Relative::ToItsFile, model.span, session, |file, text| {
        let model = machine::read(model.node, kind, file, text)?;
        Ok(Described {
            limits: limit_places(kind, file, text, &model.axes),
            model: Arc::new(model),
        })
    });
    session.machines.insert(path, machine.clone());
    machine
}

fn wrong_kind(head: &Head<'_>, is: MachineKind) -> Diagnostic {
    let name = head.model.node;
    let (what, other) = match is {
        MachineKind::Robot => ("a robot", "a five-axis machine"),
        MachineKind::FiveAxis => ("a five-axis machine", "a robot"),
    };
    let diagnostic = Diagnostic::new(
        Code::WrongKind,
        format!("`{name}` is {what}, not {other}"),
        head.kind.span,
        format!("says that it is {other}"),
    )
    .and(head.model.span, format!("this is {what}"));
    match MACHINES.iter().find(|(_, kind)| *kind == is) {
        Some((word, _)) => diagnostic.fix(format!("write `{word}`"), head.kind.span, *word),
        None => diagnostic,
    }
}
