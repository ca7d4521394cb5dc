//! `--set name=value`: a `let` of the job, given on the command line.
//!
//! Each becomes a text of its own in the source map, so that a diagnostic can point into it as into any file.

use super::report::Reports;
use super::session::Session;
use crate::diag::{Code, Diagnostic, Fix};
use crate::source::{FileId, Span, Spanned};
use crate::syntax;
use crate::syntax::ast::Expr;
use std::collections::{BTreeMap, BTreeSet};

/// A value from the command line.
pub(crate) struct Override {
    /// The name it sets.
    pub(crate) name: Spanned<String>,
    /// What to.
    pub(crate) value: Spanned<Expr>,
}

/// The values from the command line.
#[derive(Default)]
pub(crate) struct Overrides {
    /// By name.
    pub(crate) by_name: BTreeMap<String, Override>,
    /// Their texts in the source map.
    texts: BTreeSet<FileId>,
}

impl Overrides {
    /// Turns fixes that would change a `--set` into help.
    pub(crate) fn keep_fixes_to_files(&self, diagnostic: &mut Diagnostic) {
        keep_fixes_to_files(diagnostic, |file| self.texts.contains(&file));
    }
}

/// Turns fixes that would change the command line, which nothing can do but the user, into help.
pub(crate) fn keep_fixes_to_files(diagnostic: &mut Diagnostic, is_typed: impl Fn(FileId) -> bool) {
    let (typed, fixes): (Vec<Fix>, _) = core::mem::take(&mut diagnostic.fixes)
        .into_iter()
        .partition(|fix| fix.edits.iter().any(|edit| is_typed(edit.span.file)));
    diagnostic.fixes = fixes;
    diagnostic.help.extend(typed.into_iter().map(|fix| fix.title));
}

/// Reads all `--set`s.
pub(crate) fn read(given: &[String], session: &mut Session<'_>) -> Overrides {
    let mut overrides = Overrides::default();
    for text in given {
        let id = session.sources.add(format!("--set {text}"), text.clone());
        overrides.texts.insert(id);
        let Some(read) = parse(id, text, &mut session.reports) else {
            continue;
        };
        if let Some(first) = overrides.by_name.get(&read.name.node) {
            let diagnostic = Diagnostic::new(
                Code::BadOverride,
                format!("`{}` is set twice on the command line", read.name.node),
                read.name.span,
                "set here again",
            )
            .and(first.name.span, "set here first")
            .help("leave one of the two `--set`s out");
            session.reports.push(diagnostic);
            continue;
        }
        overrides.by_name.insert(read.name.node.clone(), read);
    }
    overrides
}

fn parse(id: FileId, text: &str, reports: &mut Reports) -> Option<Override> {
    let span = |start: usize, end: usize| Span {
        file: id,
        start: u32::try_from(start).unwrap_or(u32::MAX),
        end: u32::try_from(end).unwrap_or(u32::MAX),
    };
    let (name, value) = match text.split_once('=') {
        Some((name, value)) if is_name(name.trim()) && !value.trim().is_empty() => (name, value),
        _ => {
            let diagnostic = Diagnostic::new(
                Code::BadOverride,
                "`--set` takes a name and a value",
                span(0, text.len()),
                "not of the form `name=value`",
            )
            .help("write it like `--set width=90mm`");
            reports.push(diagnostic);
            return None;
        }
    };
    let mut found = Vec::new();
    let offset = name.len() + 1;
    let parsed = syntax::parse_expression(id, value, u32::try_from(offset).ok()?, &mut found);
    let fault = reports.append(found);
    match (parsed, fault) {
        (Some(value), None) => {
            let start = name.len() - name.trim_start().len();
            let name = name.trim();
            Some(Override {
                name: Spanned::new(name.to_owned(), span(start, start + name.len())),
                value,
            })
        }
        (None | Some(_), _) => None,
    }
}

/// Whether a text can be the name of a `let`.
fn is_name(text: &str) -> bool {
    let mut letters = text.chars();
    letters
        .next()
        .is_some_and(|first| first.is_ascii_alphabetic() || first == '_')
        && letters.all(|letter| letter.is_ascii_alphanumeric() || letter == '_')
}
