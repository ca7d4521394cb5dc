//! Diagnostics as annotations of GitHub Actions: workflow commands such as `::error file=a.vcut,line=3::...`, which its runner
//! takes from the log and shows beside the lines of a change.
//!
//! Source: GitHub Docs, "Workflow commands for GitHub Actions", section "Setting an error message". What belongs to the syntax is
//! written as `%` and two hexadecimal digits; in properties that goes for `:` and `,`, too.

use super::position::position;
use super::{Diagnostic, Severity};
use crate::source::SourceMap;

/// A line with an annotation.
#[derive(Clone, Copy, Debug)]
pub struct Annotation<'a> {
    /// How bad it is.
    pub severity: Severity,
    /// The file, as GitHub knows it: relative to the root of the repository.
    pub file: &'a str,
    /// The line and the column, counted from 1; whole files have none.
    pub place: Option<(usize, usize)>,
    /// A few words.
    pub title: &'a str,
    /// All there is to say; can have several lines.
    pub message: &'a str,
}

impl Annotation<'_> {
    /// The workflow command, with its line end.
    #[must_use]
    pub fn command(&self) -> String {
        let level = match self.severity {
            Severity::Error => "error",
            Severity::Warning => "warning",
        };
        let place = self.place.map_or(String::new(), |(line, column)| {
            format!(",line={line},col={column}")
        });
        format!(
            "::{level} file={}{place},title={}::{}\n",
            property(self.file),
            property(self.title),
            data(self.message)
        )
    }
}

/// All diagnostics, a command each. Texts that are not files (such as a `--set`) are named in the message.
#[must_use]
pub fn annotations(diagnostics: &[Diagnostic], sources: &SourceMap) -> String {
    diagnostics
        .iter()
        .map(|diagnostic| annotation(diagnostic, sources))
        .collect()
}

fn annotation(diagnostic: &Diagnostic, sources: &SourceMap) -> String {
    let span = diagnostic.primary.span;
    let text = sources.get(span.file).map_or("", |file| &file.text);
    let place = position(text, span.start);
    let mut message = format!("{}\n{}", diagnostic.message, diagnostic.primary.text);
    for note in &diagnostic.notes {
        message += &format!("\nnote: {note}");
    }
    for help in &diagnostic.help {
        message += &format!("\nhelp: {help}");
    }
    for fix in &diagnostic.fixes {
        message += &format!("\nhelp: {}", fix.title);
    }
    Annotation {
        severity: diagnostic.severity(),
        file: sources.name(span.file),
        place: Some((place.line, place.column)),
        title: diagnostic.code.number(),
        message: &message,
    }
    .command()
}

fn data(text: &str) -> String {
    text.replace('%', "%25").replace('\r', "%0D").replace('\n', "%0A")
}

fn property(text: &str) -> String {
    data(text).replace(':', "%3A").replace(',', "%2C")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Code;
    use crate::source::Span;

    #[test]
    fn what_belongs_to_the_syntax_is_written_in_digits() {
        let mut sources = SourceMap::default();
        let file = sources.add("a,b.vcut", "x\ny = 3");
        let three = Span {
            file,
            start: 6,
            end: 7,
        };
        let diagnostic = Diagnostic::new(Code::WrongDimension, "100% wrong", three, "here").help("add: mm");
        assert_eq!(
            annotations(&[diagnostic], &sources),
            "::error file=a%2Cb.vcut,line=2,col=5,title=VC0203::100%25 wrong%0Ahere%0Ahelp: add: mm\n"
        );
    }
}
