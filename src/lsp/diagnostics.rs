//! Diagnostics and their fixes as the protocol has them.

use super::text::{Encoding, Text};
use super::uri::uri_of;
use lsp_types::{
    DiagnosticRelatedInformation, DiagnosticSeverity, Location, NumberOrString, Range, TextEdit,
};
use serde_json::{Map, Value, json};
use std::collections::BTreeMap;
use vcutc_diagnostics::source::SourceMap;
use vcutc_diagnostics::{Diagnostic, Fix, Label, Severity};
use vcutc_driver::hints::Hint;

/// The texts of a source map with their lines, each worked out once.
pub(super) struct Lines<'a> {
    sources: &'a SourceMap,
    encoding: Encoding,
    texts: BTreeMap<vcutc_diagnostics::source::FileId, Text>,
}

impl<'a> Lines<'a> {
    /// Of these texts, with positions in these units.
    pub(super) const fn of(sources: &'a SourceMap, encoding: Encoding) -> Self {
        Self {
            sources,
            encoding,
            texts: BTreeMap::new(),
        }
    }

    /// The range of a span.
    pub(super) fn range(&mut self, span: vcutc_diagnostics::source::Span) -> Range {
        let (sources, encoding) = (self.sources, self.encoding);
        let text = self.texts.entry(span.file).or_insert_with(|| {
            let text = sources.get(span.file).map_or("", |file| file.text.as_str());
            Text::new(text, encoding)
        });
        text.range(span.bytes())
    }

    /// The place of a span, if its file has a URI.
    pub(super) fn location(&mut self, span: vcutc_diagnostics::source::Span) -> Option<Location> {
        let uri = uri_of(self.sources.name(span.file))?;
        let range = self.range(span);
        Some(Location { uri, range })
    }
}

/// A diagnostic, with the path of the file that it is shown in. That is a file of the language: a flaw of a drawing, or of any
/// other file that a job names, is shown where the job names it, with its own place beside.
pub(super) fn in_protocol(
    diagnostic: &Diagnostic,
    is_of_language: impl Fn(&str) -> bool,
    lines: &mut Lines<'_>,
) -> (String, lsp_types::Diagnostic) {
    let primary = &diagnostic.primary;
    let readable = |label: &&Label| is_of_language(lines.sources.name(label.span.file));
    let shown = Some(primary)
        .filter(readable)
        .or_else(|| diagnostic.secondary.iter().find(readable))
        .unwrap_or(primary);
    let others = core::iter::once(primary).chain(&diagnostic.secondary);
    let others: Vec<&Label> = others.filter(|label| label.span != shown.span).collect();
    let path = lines.sources.name(shown.span.file).to_owned();
    let related: Vec<DiagnosticRelatedInformation> = others
        .into_iter()
        .filter_map(|label| related(label, lines))
        .collect();
    let reported = lsp_types::Diagnostic {
        range: lines.range(shown.span),
        severity: Some(match diagnostic.severity() {
            Severity::Error => DiagnosticSeverity::ERROR,
            Severity::Warning => DiagnosticSeverity::WARNING,
        }),
        code: Some(NumberOrString::String(diagnostic.code.number().to_owned())),
        source: Some("vcutc".to_owned()),
        message: message(diagnostic, shown, lines),
        related_information: (!related.is_empty()).then_some(related),
        ..lsp_types::Diagnostic::default()
    };
    (path, reported)
}

/// A hint at the first place that it changes, with the path of its file; none where nothing is to be changed in a file.
pub(super) fn hint_in_protocol(
    hint: &Hint,
    lines: &mut Lines<'_>,
) -> Option<(String, lsp_types::Diagnostic)> {
    let place = hint.fix.edits.first()?.span;
    let reported = lsp_types::Diagnostic {
        range: lines.range(place),
        severity: Some(DiagnosticSeverity::INFORMATION),
        source: Some("vcutc".to_owned()),
        message: format!("the machine makes this job slower: {}", hint.fix.title),
        ..lsp_types::Diagnostic::default()
    };
    Some((lines.sources.name(place.file).to_owned(), reported))
}

fn related(label: &Label, lines: &mut Lines<'_>) -> Option<DiagnosticRelatedInformation> {
    Some(DiagnosticRelatedInformation {
        location: lines.location(label.span)?,
        message: label.text.clone(),
    })
}

/// All that a terminal would show as text: headline, label, notes and helps, and the place if another one is shown. Fixes are
/// offered by themselves.
fn message(diagnostic: &Diagnostic, shown: &Label, lines: &mut Lines<'_>) -> String {
    let primary = &diagnostic.primary;
    let mut text = diagnostic.message.clone();
    let mut add = |lead: &str, line: &str| {
        if !line.is_empty() {
            text += &format!("\n{lead}{line}");
        }
    };
    if primary.span == shown.span {
        add("", &primary.text);
    } else {
        let start = lines.range(primary.span).start;
        let file = lines.sources.name(primary.span.file);
        let place = format!("{file}:{}:{}: ", start.line + 1, start.character + 1);
        add(&place, &primary.text);
    }
    for note in &diagnostic.notes {
        add("note: ", note);
    }
    let fixes = diagnostic.fixes.iter().map(|fix| &fix.title);
    for help in diagnostic.help.iter().chain(fixes) {
        add("help: ", help);
    }
    text
}

/// The edits of a fix, as those of a workspace; none if a file of it has no URI.
pub(super) fn edits_of(fix: &Fix, lines: &mut Lines<'_>) -> Option<Value> {
    let mut changes: BTreeMap<String, Vec<TextEdit>> = BTreeMap::new();
    for edit in &fix.edits {
        let location = lines.location(edit.span)?;
        changes
            .entry(location.uri.as_str().to_owned())
            .or_default()
            .push(TextEdit {
                range: location.range,
                new_text: edit.replacement.clone(),
            });
    }
    Some(workspace_edit(changes))
}

/// Edits by URI.
pub(super) fn workspace_edit(changes: BTreeMap<String, Vec<TextEdit>>) -> Value {
    let changes: Map<String, Value> = changes
        .into_iter()
        .map(|(uri, edits)| (uri, json!(edits)))
        .collect();
    json!({ "changes": changes })
}
