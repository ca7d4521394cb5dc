//! The model that the head of a machine's block names: one of the catalogue, or one described by a file.

use super::files::{not_loaded, text_of};
use super::heads::MACHINES;
use super::machine::Head;
use super::names::did_you_mean;
use super::report::{Checked, Reports};
use super::session::Session;
use crate::diag::{Code, Diagnostic};
use crate::machine::{self, FileKind, Model, Origin, catalogue};
use crate::source::{Span, Spanned, join_path};
use std::sync::Arc;
use vcutc_backend_api::ir::MachineKind;

/// The model, which is of the kind that the head says.
pub(crate) fn resolve(head: &Head<'_>, session: &mut Session<'_>) -> Checked<Arc<Model>> {
    let model = match Origin::of(head.model.node) {
        Origin::Catalogue => from_catalogue(head.model, session)?,
        Origin::File(kind) => from_file(kind, head.model, session)?,
    };
    if model.kind() == head.kind.node {
        return Ok(model);
    }
    Err(session.reports.push(wrong_kind(head, model.kind())))
}

/// The machine of that name. Each is read once, however many cells have one.
fn from_catalogue(model: Spanned<&str>, session: &mut Session<'_>) -> Checked<Arc<Model>> {
    if let Some(known) = session.machines.get(model.node) {
        return known.clone();
    }
    match catalogue::find(model.node) {
        Some(machine) => {
            let machine = Arc::new(machine);
            session
                .machines
                .insert(model.node.to_owned(), Ok(Arc::clone(&machine)));
            Ok(machine)
        }
        // Not kept: every place that names it is to be told.
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
    // Comparing with all names takes time, and nobody reads on.
    let names: Vec<String> = if reports.are_many() {
        Vec::new()
    } else {
        catalogue::near(model.node)
            .iter()
            .map(|name| format!("\"{name}\""))
            .collect()
    };
    let near: Vec<&str> = names.iter().map(String::as_str).collect();
    did_you_mean(diagnostic, model.span, &near).help(
        "`vcutc machines` lists them; a machine of your own is described in a file such as `\"arm.toml\"`",
    )
}

/// The machine that a file describes. The path is relative to the file in which the machine's block stands.
fn from_file(kind: FileKind, model: Spanned<&str>, session: &mut Session<'_>) -> Checked<Arc<Model>> {
    let path = join_path(session.sources.name(model.span.file), model.node);
    if let Some(known) = session.machines.get(&path) {
        return known.clone();
    }
    let machine = read_file(kind, &path, model, session);
    session.machines.insert(path, machine.clone());
    machine
}

fn read_file(
    kind: FileKind,
    path: &str,
    model: Spanned<&str>,
    session: &mut Session<'_>,
) -> Checked<Arc<Model>> {
    let bytes = session
        .loader
        .load(path)
        .map_err(|error| session.reports.push(not_loaded(&model.span, path, &error)))?;
    let (file, fault) = text_of(session, path, bytes, Some(model.span));
    if let Some(reported) = fault {
        return Err(reported);
    }
    let text = session.sources.get(file).map_or("", |file| file.text.as_str());
    match machine::read(model.node, kind, text) {
        Ok(machine) => Ok(Arc::new(machine)),
        Err(flaws) => {
            let told =
                |flaw: &machine::flaw::Flaw| flaw.diagnostic(file).and(model.span, "the file is named here");
            let found: Vec<Diagnostic> = flaws.iter().map(told).collect();
            match session.reports.append(found) {
                Some(reported) => Err(reported),
                None => Err(session.reports.push(unexplained(path, model.span))),
            }
        }
    }
}

/// A reader that refuses a file without saying why.
fn unexplained(path: &str, named_at: Span) -> Diagnostic {
    Diagnostic::new(
        Code::Internal,
        format!("`{path}` is refused without a reason"),
        named_at,
        "the file is named here",
    )
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
