//! Diagnostics as JSON, one object a line, for editors and scripts. The form is documented in `docs/diagnostics.md`.

use super::position::position;
use super::{Diagnostic, Edit, Fix, Label, Severity};
use crate::source::SourceMap;
use serde::Serialize;

/// Version of the form. It changes when a field changes its meaning or goes away, not when one is added.
pub const SCHEMA: u32 = 1;

#[derive(Serialize)]
struct DiagnosticJson<'a> {
    schema: u32,
    code: &'static str,
    severity: &'static str,
    message: &'a str,
    labels: Vec<LabelJson<'a>>,
    notes: &'a [String],
    help: &'a [String],
    fixes: Vec<FixJson<'a>>,
}

#[derive(Serialize)]
struct LabelJson<'a> {
    file: &'a str,
    start: u32,
    end: u32,
    line: usize,
    column: usize,
    end_line: usize,
    end_column: usize,
    text: &'a str,
    primary: bool,
}

/// A change of the source.
#[derive(Serialize)]
pub struct FixJson<'a> {
    title: &'a str,
    edits: Vec<EditJson<'a>>,
}

#[derive(Serialize)]
struct EditJson<'a> {
    file: &'a str,
    start: u32,
    end: u32,
    replacement: &'a str,
}

/// All diagnostics as JSON, a line each.
#[must_use]
pub fn json_lines(diagnostics: &[Diagnostic], sources: &SourceMap) -> String {
    let mut lines = String::new();
    for diagnostic in diagnostics {
        // Writing to memory what holds neither maps nor floats cannot fail.
        lines.push_str(&serde_json::to_string(&in_json(diagnostic, sources)).unwrap_or_default());
        lines.push('\n');
    }
    lines
}

fn in_json<'a>(diagnostic: &'a Diagnostic, sources: &'a SourceMap) -> DiagnosticJson<'a> {
    let primary = std::iter::once((&diagnostic.primary, true));
    let secondary = diagnostic.secondary.iter().map(|label| (label, false));
    DiagnosticJson {
        schema: SCHEMA,
        code: diagnostic.code.number(),
        severity: match diagnostic.severity() {
            Severity::Error => "error",
            Severity::Warning => "warning",
        },
        message: &diagnostic.message,
        labels: primary
            .chain(secondary)
            .map(|(label, primary)| label_in_json(label, primary, sources))
            .collect(),
        notes: &diagnostic.notes,
        help: &diagnostic.help,
        fixes: diagnostic
            .fixes
            .iter()
            .map(|fix| fix_in_json(fix, sources))
            .collect(),
    }
}

fn label_in_json<'a>(label: &'a Label, primary: bool, sources: &'a SourceMap) -> LabelJson<'a> {
    let text = sources.get(label.span.file).map_or("", |file| &file.text);
    let start = position(text, label.span.start);
    let end = position(text, label.span.end);
    LabelJson {
        file: sources.name(label.span.file),
        start: label.span.start,
        end: label.span.end,
        line: start.line,
        column: start.column,
        end_line: end.line,
        end_column: end.column,
        text: &label.text,
        primary,
    }
}

/// A change of the source, as it is part of a diagnostic.
#[must_use]
pub fn fix_in_json<'a>(fix: &'a Fix, sources: &'a SourceMap) -> FixJson<'a> {
    let edit = |edit: &'a Edit| EditJson {
        file: sources.name(edit.span.file),
        start: edit.span.start,
        end: edit.span.end,
        replacement: &edit.replacement,
    };
    FixJson {
        title: &fix.title,
        edits: fix.edits.iter().map(edit).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Code;
    use crate::source::Span;

    #[test]
    fn a_line_holds_all_there_is_to_know() {
        let mut sources = SourceMap::default();
        let file = sources.add("a.vcut", "µ = 3\nb");
        let three = Span {
            file,
            start: 5,
            end: 6,
        };
        let diagnostic = Diagnostic::new(Code::WrongDimension, "no unit", three, "here")
            .and(three.after(), "there")
            .note("n")
            .help("h")
            .fix("use mm", three.after(), " mm");
        let lines = json_lines(&[diagnostic.clone(), diagnostic], &sources);
        assert_eq!(lines.lines().count(), 2);
        let read: serde_json::Value = serde_json::from_str(lines.lines().next().unwrap()).unwrap();
        let expected = serde_json::json!({
            "schema": 1, "code": "VC0203", "severity": "error", "message": "no unit",
            "labels": [
                { "file": "a.vcut", "start": 5, "end": 6, "line": 1, "column": 5, "end_line": 1,
                  "end_column": 6, "text": "here", "primary": true },
                { "file": "a.vcut", "start": 6, "end": 6, "line": 1, "column": 6, "end_line": 1,
                  "end_column": 6, "text": "there", "primary": false },
            ],
            "notes": ["n"], "help": ["h"],
            "fixes": [{ "title": "use mm", "edits":
                [{ "file": "a.vcut", "start": 6, "end": 6, "replacement": " mm" }] }],
        });
        assert_eq!(read, expected);
    }
}
