//! What sets a folder apart from the program of a job: as a diff for people, as objects for programs, as annotations.

use super::snapshot::Differences;
use serde::Serialize;
use vcutc_backend_api::words::counted;
use vcutc_diagnostics::Severity;
use vcutc_diagnostics::github::Annotation;
use vcutc_diagnostics::render::ColorChoice;
use vcutc_diff::text::{Hunk, LineKind, TextChange};
use vcutc_diff::{Change, FileChange};

/// Most stale files that are named one by one.
const MOST_STALE: usize = 8;

impl Differences {
    /// How the folder compares, as half a sentence.
    pub(super) fn in_words(&self) -> String {
        let files = |count: usize| counted(count, "file");
        let is_stale = |change: &&FileChange| matches!(change.change, Change::Stale);
        let stale = self.changes.iter().filter(is_stale).count();
        let differ = self.changes.len() - stale;
        let of_the_program = self.same + differ;
        let written = match differ {
            0 => format!("the program in the folder is up to date ({})", files(self.same)),
            1 if of_the_program == 1 => {
                "the file in the folder differs; run again without --check to write it".to_owned()
            }
            1 => format!(
                "1 of {} in the folder differs; run again without --check to write it",
                files(of_the_program)
            ),
            count => format!(
                "{count} of {} in the folder differ; run again without --check to write them",
                files(of_the_program)
            ),
        };
        match stale {
            0 => written,
            count => format!("{written}; {} of an earlier version to remove", files(count)),
        }
    }
}

/// A unified diff of every file, with a line before it that says what happened.
pub(super) fn text(job: &str, found: &Differences, color: ColorChoice) -> String {
    let painter = Painter { color };
    let mut text: String = found
        .changes
        .iter()
        .filter_map(|file| one(job, file, painter))
        .collect();
    text += &stale(found);
    text
}

fn one(job: &str, file: &FileChange, painter: Painter) -> Option<String> {
    let name = &file.name;
    match &file.change {
        Change::Missing => Some(format!("{name} is missing; {job} gives a file of this name\n")),
        Change::LineEnds {
            earlier_crlf,
            fresh_crlf,
        } => Some(line_ends(name, *earlier_crlf, *fresh_crlf)),
        Change::Text(change) => Some(diff(job, name, change, painter)),
        Change::Stale => None,
    }
}

/// Tools that change line ends are configured, not blamed on the job.
fn line_ends(name: &str, earlier: usize, fresh: usize) -> String {
    let (is, wanted) = match (earlier, fresh) {
        (0, 1..) => ("LF", "CR LF"),
        (1.., 0) => ("CR LF", "LF"),
        (_, _) => {
            return format!("{name} differs in line ends only (or in the break after the last line)\n");
        }
    };
    format!(
        "{name} differs in line ends only: {is} instead of {wanted}\n  \
         help: keep git from changing them with a line such as `{} -text` in .gitattributes\n",
        pattern(name)
    )
}

/// `*.src` for a file of that extension.
fn pattern(name: &str) -> String {
    match name.rsplit_once('.') {
        Some((_, extension)) if !extension.contains(['/', '\\']) => format!("*.{extension}"),
        Some(_) | None => name.to_owned(),
    }
}

fn stale(found: &Differences) -> String {
    let names: Vec<&str> = found
        .changes
        .iter()
        .filter(|file| file.change == Change::Stale)
        .map(|file| file.name.as_str())
        .collect();
    let mut text: String = names
        .iter()
        .take(MOST_STALE)
        .map(|name| {
            format!(
                "{name} is left from an earlier version; the program no longer has this part, so remove it\n"
            )
        })
        .collect();
    if names.len() > MOST_STALE {
        text += &format!("and {} more files are left over\n", names.len() - MOST_STALE);
    }
    text
}

fn diff(job: &str, name: &str, change: &TextChange, painter: Painter) -> String {
    let mut text = painter.line(HEADING, &format!("--- {name}"));
    text += &painter.line(HEADING, &format!("+++ {name} as {job} gives it"));
    for hunk in &change.hunks {
        text += &hunk_text(hunk, painter);
    }
    if change.left_out > 0 {
        text += &format!(
            "... and {} more changed lines ({} in all)\n",
            change.left_out,
            change.removed + change.added
        );
    }
    if change.line_ends_differ {
        text += "line ends differ too\n";
    }
    text
}

fn hunk_text(hunk: &Hunk, painter: Painter) -> String {
    let mut text = painter.line(PLACE, &heading(hunk));
    for line in &hunk.lines {
        let marked = format!("{}{}", line.kind.mark(), line.text);
        text += &match line.kind {
            LineKind::Same => marked + "\n",
            LineKind::Removed => painter.line(REMOVED, &marked),
            LineKind::Added => painter.line(ADDED, &marked),
        };
    }
    text
}

/// `@@ -10,7 +10,8 @@ the left flank of layer 1, cut 2`.
fn heading(hunk: &Hunk) -> String {
    // An empty stretch is named by the line before it, as GNU diff does.
    let stretch = |lines: &core::ops::Range<usize>| match lines.len() {
        0 => format!("{},0", lines.start),
        1 => format!("{}", lines.start + 1),
        length => format!("{},{length}", lines.start + 1),
    };
    let about = hunk
        .about
        .as_ref()
        .map_or(String::new(), |about| format!(" {about}"));
    format!(
        "@@ -{} +{} @@{about}",
        stretch(&hunk.earlier),
        stretch(&hunk.fresh)
    )
}

const HEADING: &str = "1";
const PLACE: &str = "36";
const REMOVED: &str = "31";
const ADDED: &str = "32";

#[derive(Clone, Copy)]
struct Painter {
    color: ColorChoice,
}

impl Painter {
    /// A line in a colour, by its number in ECMA-48.
    fn line(self, color: &str, text: &str) -> String {
        match self.color {
            ColorChoice::Plain => format!("{text}\n"),
            ColorChoice::Colored => format!("\u{1b}[{color}m{text}\u{1b}[0m\n"),
        }
    }
}

/// A file as programs get to know of it.
#[derive(Serialize)]
pub(super) struct DifferenceBody<'a> {
    job: &'a str,
    file: &'a str,
    change: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    text: Option<TextBody<'a>>,
}

#[derive(Serialize)]
struct TextBody<'a> {
    removed: usize,
    added: usize,
    left_out: usize,
    line_ends_differ: bool,
    hunks: Vec<HunkBody<'a>>,
}

#[derive(Serialize)]
struct HunkBody<'a> {
    earlier_line: usize,
    earlier_lines: usize,
    fresh_line: usize,
    fresh_lines: usize,
    about: Option<&'a str>,
    lines: Vec<String>,
}

/// An object for every file that is not as it should be.
pub(super) fn bodies<'a>(job: &'a str, found: &'a Differences) -> impl Iterator<Item = DifferenceBody<'a>> {
    found.changes.iter().map(move |file| DifferenceBody {
        job,
        file: &file.name,
        change: word(&file.change),
        text: match &file.change {
            Change::Text(change) => Some(text_body(change)),
            Change::LineEnds { .. } | Change::Missing | Change::Stale => None,
        },
    })
}

const fn word(change: &Change) -> &'static str {
    match change {
        Change::Text(_) => "text",
        Change::LineEnds { .. } => "line_ends",
        Change::Missing => "missing",
        Change::Stale => "stale",
    }
}

fn text_body(change: &TextChange) -> TextBody<'_> {
    TextBody {
        removed: change.removed,
        added: change.added,
        left_out: change.left_out,
        line_ends_differ: change.line_ends_differ,
        hunks: change
            .hunks
            .iter()
            .map(|place| HunkBody {
                earlier_line: place.earlier.start + 1,
                earlier_lines: place.earlier.len(),
                fresh_line: place.fresh.start + 1,
                fresh_lines: place.fresh.len(),
                about: place.about.as_deref(),
                lines: place
                    .lines
                    .iter()
                    .map(|line| format!("{}{}", line.kind.mark(), line.text))
                    .collect(),
            })
            .collect(),
    }
}

/// An annotation for every file that is not as it should be, at its first line that differs.
pub(super) fn annotations(job: &str, found: &Differences) -> String {
    found
        .changes
        .iter()
        .map(|file| {
            let (place, message) = match &file.change {
                Change::Text(change) => (
                    change.hunks.first().map(|hunk| (first_line(hunk), 1)),
                    format!(
                        "{} lines differ from what {job} gives",
                        change.removed + change.added
                    ),
                ),
                Change::LineEnds { .. } => (None, format!("line ends differ from what {job} gives")),
                Change::Missing => (None, format!("{job} gives this file, and it is missing")),
                Change::Stale => (None, format!("{job} no longer gives this file")),
            };
            Annotation {
                severity: Severity::Error,
                file: &file.name,
                place,
                title: "not up to date",
                message: &message,
            }
            .command()
        })
        .collect()
}

/// The first line of the earlier file that a hunk changes, counted from 1.
fn first_line(hunk: &Hunk) -> usize {
    let before = hunk
        .lines
        .iter()
        .take_while(|line| line.kind == LineKind::Same)
        .count();
    hunk.earlier.start + before + 1
}
