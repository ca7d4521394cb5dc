//! `--set name=value` and `--option key=value`: a `let` of the job, or an option of its target, given on the command line.
//!
//! Each becomes a text of its own in the source map, so that a diagnostic can point into it as into any file.

use super::report::Reports;
use super::session::Session;
use std::collections::{BTreeMap, BTreeSet};
use vcutc_diagnostics::source::{FileId, Span, Spanned};
use vcutc_diagnostics::{Code, Diagnostic, Fix};
use vcutc_syntax as syntax;
use vcutc_syntax::ast::Expr;

/// A value from the command line.
pub(crate) struct Override {
    /// The name it sets.
    pub(crate) name: Spanned<String>,
    pub(crate) value: Spanned<Expr>,
}

/// The values from the command line.
#[derive(Default)]
pub(crate) struct Overrides {
    /// The `let`s by name.
    pub(crate) by_name: BTreeMap<String, Override>,
    /// The options of the target in the order given, each key once.
    pub(crate) options: Vec<Override>,
    /// Their texts in the source map.
    texts: BTreeSet<FileId>,
}

impl Overrides {
    /// Turns fixes that would change a `--set` or `--option` into help.
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

/// A switch that takes a name and a value.
struct Switch {
    word: &'static str,
    takes: &'static str,
    form: &'static str,
    example: &'static str,
    malformed: Code,
    twice: Code,
}

const SET: Switch = Switch {
    word: "--set",
    takes: "a name and a value",
    form: "name=value",
    example: "width=90mm",
    malformed: Code::BadOverride,
    twice: Code::BadOverride,
};

const OPTION: Switch = Switch {
    word: "--option",
    takes: "a key and a value",
    form: "key=value",
    example: "lines_per_part=0",
    malformed: Code::BadOption,
    twice: Code::FieldTwice,
};

/// Reads all `--set`s and `--option`s.
pub(crate) fn read(sets: &[String], options: &[String], session: &mut Session<'_>) -> Overrides {
    let mut overrides = Overrides::default();
    for read in read_switch(&SET, sets, &mut overrides.texts, session) {
        overrides.by_name.insert(read.name.node.clone(), read);
    }
    overrides.options = read_switch(&OPTION, options, &mut overrides.texts, session);
    overrides
}

/// What was given with one switch, each name once.
fn read_switch(
    switch: &Switch,
    given: &[String],
    texts: &mut BTreeSet<FileId>,
    session: &mut Session<'_>,
) -> Vec<Override> {
    let mut all = Vec::new();
    let mut first: BTreeMap<String, Span> = BTreeMap::new();
    for text in given {
        let word = switch.word;
        let id = session.sources.add(format!("{word} {text}"), text.clone());
        texts.insert(id);
        let Some(read) = parse(switch, id, text, &mut session.reports) else {
            continue;
        };
        if let Some(first) = first.get(&read.name.node) {
            let diagnostic = Diagnostic::new(
                switch.twice,
                format!("`{}` is set twice on the command line", read.name.node),
                read.name.span,
                "set again here",
            )
            .and(*first, "first set here")
            .help(format!("delete one of the two `{word}`s"));
            session.reports.push(diagnostic);
            continue;
        }
        first.insert(read.name.node.clone(), read.name.span);
        all.push(read);
    }
    all
}

fn parse(switch: &Switch, id: FileId, text: &str, reports: &mut Reports) -> Option<Override> {
    let span = |start: usize, end: usize| Span::of_bytes(id, start..end);
    let (name, value) = match text.split_once('=') {
        Some((name, value)) if is_name(name.trim()) && !value.trim().is_empty() => (name, value),
        _ => {
            reports.push(malformed(switch, id, text));
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

/// What is wrong with a text that is not a name and a value.
fn malformed(switch: &Switch, id: FileId, text: &str) -> Diagnostic {
    let whole = Span::of_bytes(id, 0..text.len());
    let headline = format!("`{}` takes {}", switch.word, switch.takes);
    let example = format!("write it like `{} {}`", switch.word, switch.example);
    let Some((name, value)) = text.split_once('=') else {
        let label = format!("there is no `=`; the form is `{}`", switch.form);
        return Diagnostic::new(switch.malformed, headline, whole, label).help(example);
    };
    let of_name = Span::of_bytes(id, 0..name.len().max(1).min(text.len()));
    let (name, value) = (name.trim(), value.trim());
    if is_name(name) {
        let label = format!("nothing follows the `=`; the form is `{}`", switch.form);
        return Diagnostic::new(switch.malformed, headline, whole, label).help(example);
    }
    let field = name
        .rsplit_once('.')
        .map(|(_, field)| field)
        .filter(|field| is_name(field));
    match (field, switch.malformed) {
        (Some(field), Code::BadOverride) => Diagnostic::new(
            switch.malformed,
            "`--set` sets a `let` of the job, not a field of a block",
            of_name,
            "a field of a block",
        )
        .help(format!(
            "give the field a name in the job, `let {field} = {value}` and `{field} = {field}`, then use `--set {field}={value}`"
        )),
        (Some(_) | None, _) => Diagnostic::new(
            switch.malformed,
            headline,
            of_name,
            format!("`{name}` is not a name: letters, digits and `_`, a letter first"),
        )
        .help(example),
    }
}

/// Whether a text can be the name of a `let`, or the key of an option.
fn is_name(text: &str) -> bool {
    let mut letters = text.chars();
    letters
        .next()
        .is_some_and(|first| first.is_ascii_alphabetic() || first == '_')
        && letters.all(|letter| letter.is_ascii_alphanumeric() || letter == '_')
}
