//! Diagnostics as text for people.
//!
//! The picture of the source with its labels is drawn by ariadne, and this is the only place that knows it; headline,
//! notes and help are written here. Spans are not handed on as they are: ariadne panics at some and draws nothing at
//! others, and it takes a file's lines to end at more characters than the compiler does. So it gets a copy of the text
//! in which every character represents one of the source and can be shown, and spans counted in characters that lie
//! within it.

use super::position::{floor, position};
use super::{Code, Diagnostic, Fix, Label, Severity};
use crate::source::{FileId, SourceMap, Span};
use ariadne::{Cache, CharSet, Color, Config, IndexType, LabelAttach, Report, ReportKind, Source};
use std::cmp::Reverse;
use std::collections::BTreeMap;
use std::fmt::{self, Write as _};
use std::ops::Range;

/// Whether the text is coloured for a terminal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ColorChoice {
    /// With ANSI escape sequences.
    Colored,
    /// Without.
    Plain,
}

/// Lines longer than this many characters are not drawn: the label could not be found in them.
const LONGEST_LINE: usize = 400;

/// All diagnostics as text, an empty line after each.
#[must_use]
pub fn render(diagnostics: &[Diagnostic], sources: &SourceMap, color: ColorChoice) -> String {
    let mut gallery = Gallery {
        sources,
        pictures: BTreeMap::new(),
    };
    let mut text = String::new();
    for diagnostic in diagnostics {
        text.push_str(&headline(diagnostic, color));
        let picture = gallery.draw(diagnostic, color);
        text.push_str(&picture);
        text.push_str(&advice(diagnostic, margin(&picture), color));
        text.push('\n');
    }
    text
}

/// `error[VC0203]: ...`
fn headline(diagnostic: &Diagnostic, color: ColorChoice) -> String {
    let (word, ansi) = match diagnostic.severity() {
        Severity::Error => ("error", "\u{1b}[1;31m"),
        Severity::Warning => ("warning", "\u{1b}[1;33m"),
    };
    let number = diagnostic.code.number();
    let message = one_line(&diagnostic.message);
    match color {
        ColorChoice::Plain => format!("{word}[{number}]: {message}\n"),
        ColorChoice::Colored => {
            format!("{ansi}{word}[{number}]\u{1b}[0m\u{1b}[1m: {message}\u{1b}[0m\n")
        }
    }
}

/// Columns before the bar at the left of a picture.
fn margin(picture: &str) -> usize {
    picture
        .lines()
        .find_map(|line| line.split_once('│'))
        .map_or(NARROWEST_MARGIN, |(before, _)| {
            before.chars().take_while(|&c| c == ' ').count()
        })
}

/// Columns before the bar when line numbers have one digit.
const NARROWEST_MARGIN: usize = 3;

/// Notes, helps and fixes, hung below the bar of the picture.
fn advice(diagnostic: &Diagnostic, margin: usize, color: ColorChoice) -> String {
    let notes = diagnostic.notes.iter().map(|note| ("note", note.clone()));
    let helps = diagnostic.help.iter().map(|help| ("help", help.clone()));
    let fixes = diagnostic.fixes.iter().map(|fix| ("help", fix_in_words(fix)));
    let mut text = String::new();
    // Which name was meant is the answer; the list of all names helps if another one was meant.
    let advice: Vec<(&str, String)> = if matches!(diagnostic.code, Code::UnknownField | Code::UnknownBlock) {
        fixes.chain(helps).chain(notes).collect()
    } else {
        notes.chain(helps).chain(fixes).collect()
    };
    for (word, body) in advice {
        let word = match color {
            ColorChoice::Plain => format!("= {word}:"),
            ColorChoice::Colored => format!("\u{1b}[1;36m= {word}:\u{1b}[0m"),
        };
        let mut lines = body.lines().map(printable);
        let first = lines.next().unwrap_or_default();
        let _ = writeln!(text, "{:margin$}{word} {}", "", first.trim_end());
        for line in lines {
            let _ = writeln!(text, "{:margin$}        {}", "", line.trim_end());
        }
    }
    if text.is_empty() {
        return text;
    }
    format!("{:margin$}│\n{text}", "")
}

/// The title, and what to write if the title does not say it.
fn fix_in_words(fix: &Fix) -> String {
    let mut words = fix.title.clone();
    for edit in &fix.edits {
        let replacement = edit.replacement.trim();
        // What is put in after something else begins with a comma, which titles leave out.
        let named = replacement.trim_start_matches([',', ' ']);
        if !named.is_empty() && !fix.title.contains(named) {
            let _ = write!(words, ": `{replacement}`");
        }
    }
    words
}

fn one_line(text: &str) -> String {
    printable(text).replace('\n', " ")
}

/// The same number of characters, all of which a terminal shows: what could steer it or turn the writing round is
/// replaced. Lines end at `\n` only.
fn printable(text: &str) -> String {
    text.chars()
        .map(|c| match c {
            '\n' | '\t' => c,
            c if c.is_control() => ' ',
            '\u{2028}' | '\u{2029}' | '\u{feff}' => ' ',
            '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}' | '\u{200e}' | '\u{200f}' => '\u{fffd}',
            c => c,
        })
        .collect()
}

/// A source as it can be drawn.
struct Picture {
    name: String,
    source: Source<String>,
}

/// The sources drawn so far.
struct Gallery<'s> {
    sources: &'s SourceMap,
    pictures: BTreeMap<FileId, Picture>,
}

/// A label's place in a picture, in characters. Orders as labels are drawn.
type Place = (FileId, Range<usize>);

impl Gallery<'_> {
    fn draw(&mut self, diagnostic: &Diagnostic, color: ColorChoice) -> String {
        let labels: Vec<(Place, &Label)> = std::iter::once(&diagnostic.primary)
            .chain(&diagnostic.secondary)
            .filter_map(|label| Some((self.place(label.span)?, label)))
            .collect();
        if labels.iter().any(|(place, _)| self.is_too_long(place)) {
            return self.list(diagnostic);
        }
        self.draw_labels(diagnostic, labels, color)
            .unwrap_or_else(|| self.list(diagnostic))
    }

    fn draw_labels(
        &mut self,
        diagnostic: &Diagnostic,
        mut labels: Vec<(Place, &Label)>,
        color: ColorChoice,
    ) -> Option<String> {
        let primary = diagnostic.primary.span;
        let main = self.place(primary)?;
        // ariadne begins a new section whenever a label lies above the one before: so the file of the primary label
        // comes first, and each goes from top to bottom. On one line the rightmost label comes first, so that no
        // line to a remark crosses another.
        labels.sort_by_key(|(place, _)| {
            let (file, range) = place;
            let is_other = *file != primary.file;
            (
                is_other,
                *file,
                self.last_line(place),
                Reverse(range.start),
                range.end,
            )
        });
        let config = Config::new()
            .with_color(color == ColorChoice::Colored)
            .with_char_set(CharSet::Unicode)
            .with_index_type(IndexType::Char)
            .with_label_attach(LabelAttach::Start)
            .with_tab_width(4);
        let mut report =
            Report::build(ReportKind::Custom("", Color::Primary), (main.0, main.1)).with_config(config);
        for (order, ((file, range), label)) in (0..).zip(labels) {
            let paint = match (
                std::ptr::eq(label, &raw const diagnostic.primary),
                diagnostic.severity(),
            ) {
                (false, _) => Color::Blue,
                (true, Severity::Error) => Color::Red,
                (true, Severity::Warning) => Color::Yellow,
            };
            report.add_label(
                ariadne::Label::new((file, range))
                    .with_message(one_line(&label.text))
                    .with_color(paint)
                    .with_order(order),
            );
        }
        let mut bytes = Vec::new();
        report.finish().write(&mut *self, &mut bytes).ok()?;
        let drawn = String::from_utf8(bytes).ok()?;
        // Its first line is a headline and its last closes the frame.
        let mut lines: Vec<&str> = drawn.lines().skip(1).map(str::trim_end).collect();
        lines.pop();
        let is_empty_margin = |line: &&str| line.chars().all(|c| c == ' ' || c == '│');
        while lines.last().is_some_and(is_empty_margin) {
            lines.pop();
        }
        let mut text = lines.join("\n");
        text.push('\n');
        Some(text)
    }

    /// The labels without a picture.
    fn list(&self, diagnostic: &Diagnostic) -> String {
        let mut text = String::new();
        for label in std::iter::once(&diagnostic.primary).chain(&diagnostic.secondary) {
            let Some(file) = self.sources.get(label.span.file) else {
                continue;
            };
            let place = position(&file.text, label.span.start);
            let _ = writeln!(
                text,
                "  --> {}:{}:{}: {}",
                one_line(&file.name),
                place.line,
                place.column,
                one_line(&label.text)
            );
        }
        text
    }

    /// Where a span lies in its picture. An empty one is widened to the character after it.
    fn place(&mut self, span: Span) -> Option<Place> {
        let file = self.sources.get(span.file)?;
        let start = floor(&file.text, span.start);
        let end = floor(&file.text, span.end).max(start);
        let covered = file.text.get(start..end)?;
        // A label that covers a line end would be drawn down to the next line.
        let covered = covered.trim_end_matches(['\n', '\r']);
        let first = file.text.get(..start)?.chars().count();
        let length = covered.chars().count().max(1);
        self.pictures.entry(span.file).or_insert_with(|| Picture {
            name: one_line(&file.name),
            // The blank is for labels at the end of the file.
            source: Source::from(format!("{} ", printable(&file.text))),
        });
        Some((span.file, first..first + length))
    }

    fn last_line(&self, (file, range): &Place) -> usize {
        let picture = self.pictures.get(file);
        picture.map_or(0, |picture| picture.source.get_line_range(range).end)
    }

    fn is_too_long(&self, (file, range): &Place) -> bool {
        self.pictures.get(file).is_some_and(|picture| {
            picture
                .source
                .get_line_range(range)
                .filter_map(|line| picture.source.line(line))
                .any(|line| line.len() > LONGEST_LINE)
        })
    }
}

impl Cache<FileId> for &mut Gallery<'_> {
    type Storage = String;

    fn fetch(&mut self, id: &FileId) -> Result<&Source<String>, impl fmt::Debug> {
        self.pictures
            .get(id)
            .map(|picture| &picture.source)
            .ok_or("no such source")
    }

    fn display<'a>(&self, id: &'a FileId) -> Option<impl fmt::Display + 'a> {
        self.pictures.get(id).map(|picture| picture.name.clone())
    }
}
