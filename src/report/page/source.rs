//! The texts that the job was made from, line by line, so that parameters can point into them.

use super::{Section, Subject};
use crate::html::Html;
use vcutc_diagnostics::position::position;
use vcutc_diagnostics::source::{FileId, SourceMap, Span};

/// Most lines of a text that are shown.
const MOST_LINES: usize = 5000;

/// Most characters of a line that are shown.
const LONGEST_LINE: usize = 400;

/// The texts that are shown: the job's own first, then all others that the compiler read for it.
pub(super) struct Listing<'a> {
    sources: &'a SourceMap,
    shown: Vec<FileId>,
}

/// A place in a text as people and links see it.
pub(super) struct Place {
    pub(super) link: Option<String>,
    /// `rib.vcut:14:15`.
    pub(super) words: String,
    /// The line, without the space around it.
    pub(super) line: String,
}

impl Place {
    /// What it is called, with its link.
    pub(super) fn linked(&self) -> Html {
        let words = &self.words;
        match &self.link {
            Some(link) => html!(in "<a href=\"#{link}\">{words}</a>", link = link, words = words),
            None => html!(in "{words}", words = words),
        }
    }
}

impl<'a> Listing<'a> {
    /// The texts of a job.
    pub(super) fn of(subject: Subject<'a>) -> Self {
        let root = subject.material.job.name_span.file;
        let others = subject.sources.iter().map(|(file, _)| file);
        let shown = core::iter::once(root)
            .chain(others.filter(|&file| file != root))
            .collect();
        Self {
            sources: subject.sources,
            shown,
        }
    }

    pub(super) fn place(&self, span: Span) -> Place {
        let text = self.sources.get(span.file).map_or("", |file| file.text.as_str());
        let place = position(text, span.start);
        let is_shown = place.line <= MOST_LINES;
        let number = self.shown.iter().position(|&file| file == span.file);
        let name = self.sources.name(span.file);
        let base = name.rsplit('/').next().unwrap_or(name);
        Place {
            link: number
                .filter(|_| is_shown)
                .map(|number| anchor(number, place.line)),
            words: format!("{base}:{}:{}", place.line, place.column),
            line: short(text.lines().nth(place.line - 1).unwrap_or_default().trim()),
        }
    }

    pub(super) fn section(&self) -> Section {
        let files = self.shown.iter().enumerate();
        Section {
            id: "job",
            title: "Sources",
            body: files
                .filter_map(|(number, &file)| {
                    let file = self.sources.get(file)?;
                    Some(text(number, &file.name, &file.text))
                })
                .collect(),
        }
    }
}

/// The name of a line within the page.
fn anchor(file: usize, line: usize) -> String {
    format!("text-{file}-{line}")
}

/// A text with a number at each line; the job's own is open.
fn text(number: usize, name: &str, text: &str) -> Html {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let lines = text.lines().take(MOST_LINES).enumerate().map(|(index, line)| {
        html!(
            in "<li id=\"{id}\"><code>{line}</code></li>\n",
            id = anchor(number, index + 1),
            line = short(line)
        )
    });
    let is_cut = text.lines().nth(MOST_LINES).is_some();
    html!(
        "listing.html",
        open = (number == 0).then_some(" open"),
        name = name,
        lines = lines.collect::<Html>(),
        more = is_cut.then(|| html!(in "<p>The first {most} lines are shown.</p>\n", most = MOST_LINES)),
    )
}

/// A line, cut off where it becomes too long to read.
fn short(line: &str) -> String {
    match line.char_indices().nth(LONGEST_LINE) {
        Some((end, _)) => format!("{} ...", line.get(..end).unwrap_or_default()),
        None => line.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_numbered_as_places_count_them() {
        let shown = text(0, "a<b>.vcut", "\u{feff}one\ntwo & <three>\n").into_text();
        assert!(
            shown.contains("<li id=\"text-0-2\"><code>two &amp; &lt;three&gt;</code></li>"),
            "{shown}"
        );
        assert!(shown.contains("a&lt;b&gt;.vcut"), "{shown}");
    }

    #[test]
    fn long_lines_are_cut_between_characters() {
        let line = "é".repeat(LONGEST_LINE + 1);
        assert_eq!(short(&line), format!("{} ...", "é".repeat(LONGEST_LINE)));
        assert_eq!(short("é"), "é");
    }
}
