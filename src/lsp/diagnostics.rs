//! Diagnostics and their fixes as the protocol has them.

use super::text::Text;
use super::uri::uri_of;
use crate::diag::{Diagnostic, Fix, Label, Severity};
use crate::source::SourceMap;
use lsp_types::{
    DiagnosticRelatedInformation, DiagnosticSeverity, Location, NumberOrString, Range, TextEdit,
};
use serde_json::{Map, Value, json};
use std::collections::BTreeMap;

/// The texts of a source map with their lines, each worked out once.
pub(super) struct Lines<'a> {
    sources: &'a SourceMap,
    texts: BTreeMap<crate::source::FileId, Text>,
}

impl<'a> Lines<'a> {
    /// Of these texts.
    pub(super) const fn of(sources: &'a SourceMap) -> Self {
        Self {
            sources,
            texts: BTreeMap::new(),
        }
    }

    /// The range of a span.
    pub(super) fn range(&mut self, span: crate::source::Span) -> Range {
        let sources = self.sources;
        let text = self.texts.entry(span.file).or_insert_with(|| {
            let text = sources.get(span.file).map_or("", |file| file.text.as_str());
            Text::new(text)
        });
        text.range(span.bytes())
    }

    /// The place of a span, if its file has a URI.
    pub(super) fn location(&mut self, span: crate::source::Span) -> Option<Location> {
        let uri = uri_of(self.sources.name(span.file))?;
        let range = self.range(span);
        Some(Location { uri, range })
    }
}

/// A diagnostic, with the path of the file that it is about.
pub(super) fn in_protocol(diagnostic: &Diagnostic, lines: &mut Lines<'_>) -> (String, lsp_types::Diagnostic) {
    let path = lines.sources.name(diagnostic.primary.span.file).to_owned();
    let related: Vec<DiagnosticRelatedInformation> = diagnostic
        .secondary
        .iter()
        .filter_map(|label| related(label, lines))
        .collect();
    let told = lsp_types::Diagnostic {
        range: lines.range(diagnostic.primary.span),
        severity: Some(match diagnostic.severity() {
            Severity::Error => DiagnosticSeverity::ERROR,
            Severity::Warning => DiagnosticSeverity::WARNING,
        }),
        code: Some(NumberOrString::String(diagnostic.code.number().to_owned())),
        source: Some("vcutc".to_owned()),
        message: message(diagnostic),
        related_information: (!related.is_empty()).then_some(related),
        ..lsp_types::Diagnostic::default()
    };
    (path, told)
}

fn related(label: &Label, lines: &mut Lines<'_>) -> Option<DiagnosticRelatedInformation> {
    Some(DiagnosticRelatedInformation {
        location: lines.location(label.span)?,
        message: label.text.clone(),
    })
}

/// All that a terminal would show as text: headline, label, notes and helps. Fixes are offered by themselves.
fn message(diagnostic: &Diagnostic) -> String {
    let mut text = diagnostic.message.clone();
    if !diagnostic.primary.text.is_empty() {
        text += &format!("\n{}", diagnostic.primary.text);
    }
    for note in &diagnostic.notes {
        text += &format!("\nnote: {note}");
    }
    let fixes = diagnostic.fixes.iter().map(|fix| &fix.title);
    for help in diagnostic.help.iter().chain(fixes) {
        text += &format!("\nhelp: {help}");
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
