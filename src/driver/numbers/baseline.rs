//! Figures of an earlier version of programs, kept in a repository as a file of JSON with a line for each program, and
//! what has become worse since.

use super::{Figure, Numbers};
use serde::{Deserialize, Serialize};
use serde_json::error::Category;
use vcutc_diagnostics::source::{FileId, Span};
use vcutc_diagnostics::{Code, Diagnostic};

/// Largest file that is read, in bytes: the most programs of one run, at some hundred bytes each, fit in.
pub const LARGEST: usize = 1 << 23;

/// Which program figures belong to: the same job can be written for several targets and into several folders.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct Name {
    /// The job's path as the list of programs has it.
    pub job: String,
    pub target: String,
    /// The folder that the program goes to, as the list has it.
    pub output: String,
}

/// The figures of one program.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// Of which program.
    #[serde(flatten)]
    pub name: Name,
    pub numbers: Numbers,
}

/// Reads a file of figures.
///
/// # Errors
/// The first thing that is wrong with it, at its place.
pub fn read(file: FileId, text: &str) -> Result<Vec<Record>, Box<Diagnostic>> {
    let fault = |at: usize, message: String, label: &str| {
        Diagnostic::new(Code::BadBaseline, message, Span::of_bytes(file, at..at), label)
    };
    if text.len() > LARGEST {
        let (size, most) = (text.len() / 1000, LARGEST / 1000);
        let message = format!("the file has {size} kB, at most {most} kB are read");
        return Err(Box::new(fault(0, message, "too large")));
    }
    // Some editors on Windows begin files with a mark of their byte order.
    let json = text.strip_prefix('\u{feff}').unwrap_or(text);
    serde_json::from_str(json).map_err(|error| {
        let place = text.len() - json.len() + place(json, error.line(), error.column());
        let reason = match error.classify() {
            Category::Data => "a figure or a name is missing, below zero, or of another kind",
            Category::Eof => "the text ends too early",
            Category::Syntax | Category::Io => "the text is not JSON",
        };
        let message = format!("these are not the figures of programs: {reason}");
        Box::new(
            fault(place, message, "cannot be read from here on")
                .help("restore the committed file, or delete it and let `vcutc build --accept` create it"),
        )
    })
}

/// The byte of a line and a column, both from 1.
fn place(text: &str, line: usize, column: usize) -> usize {
    let before: usize = text
        .split_inclusive('\n')
        .take(line.saturating_sub(1))
        .map(str::len)
        .sum();
    let mut place = (before + column.saturating_sub(1)).min(text.len());
    while !text.is_char_boundary(place) {
        place -= 1;
    }
    place
}

/// The text of a file of figures: a line for each program, sorted, so that a change of one is a change of one line.
#[must_use]
pub fn write(mut records: Vec<Record>) -> String {
    records.sort_by(|a, b| a.name.cmp(&b.name));
    let lines: Vec<String> = records
        .iter()
        // Writing numbers and texts to memory cannot fail.
        .map(|record| serde_json::to_string(record).unwrap_or_default())
        .collect();
    if lines.is_empty() {
        return "[]\n".to_owned();
    }
    format!("[\n{}\n]\n", lines.join(",\n"))
}

/// A figure that has become worse by more than it may.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Worse {
    pub figure: Figure,
    pub was: f64,
    pub is: f64,
}

impl Worse {
    /// By how many percent; none from nothing.
    #[must_use]
    pub fn percent(&self) -> Option<f64> {
        (self.was > 0.0).then(|| (self.is / self.was - 1.0) * 100.0)
    }
}

/// Whether a figure has become worse by more than so many percent.
#[must_use]
pub fn worse(figure: Figure, percent: f64, was: &Numbers, is: &Numbers) -> Option<Worse> {
    let (was, is) = (figure.of(was), figure.of(is));
    (is > was * (1.0 + percent / 100.0)).then_some(Worse { figure, was, is })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn numbers(time_s: f64) -> Numbers {
        Numbers {
            cuts: 112,
            layers: 8,
            time_s,
            estimate_s: 307.599,
            scallop_mm: 9.289,
            mean_scallop_mm: 3.1,
            longest_edge_mm: 10.0,
            removed_mm2: 2799.25,
            residual_mm2: 337.75,
            correlation: 0.998_765,
        }
    }

    fn record(job: &str) -> Record {
        Record {
            name: Name {
                job: job.to_owned(),
                target: "krl".to_owned(),
                output: "programs".to_owned(),
            },
            numbers: numbers(300.0),
        }
    }

    #[test]
    fn what_is_written_is_read_and_a_line_each() {
        let text = write(vec![record("b.vcut"), record("a\"\u{e9}.vcut")]);
        assert_eq!(text.lines().count(), 4);
        assert_eq!(
            read(FileId::ALONE, &text).unwrap(),
            [record("a\"\u{e9}.vcut"), record("b.vcut")]
        );
        assert_eq!(read(FileId::ALONE, &write(Vec::new())).unwrap(), []);
    }

    #[test]
    fn faults_are_reported_at_their_places() {
        let text = write(vec![record("a.vcut"), record("b.vcut")]);
        for (old, new) in [("\"cuts\":112", "\"cuts\":-1"), ("]\n", "\n"), ("time_s", "t")] {
            let broken = text.replacen(old, new, 1);
            let fault = read(FileId::ALONE, &broken).unwrap_err();
            assert!(
                broken.is_char_boundary(fault.primary.span.start as usize),
                "{fault:?}"
            );
            assert!(
                fault
                    .message
                    .starts_with("these are not the figures of programs: "),
                "{fault:?}"
            );
        }
        assert_eq!(place("ab\nc\u{e9}d", 2, 3), 4);
        assert_eq!(place("", 9, 9), 0);
    }

    #[test]
    fn a_mark_of_the_byte_order_is_passed_over() {
        let text = write(vec![record("a.vcut")]);
        assert_eq!(
            read(FileId::ALONE, &format!("\u{feff}{text}")).unwrap(),
            [record("a.vcut")]
        );
        assert_eq!(
            read(FileId::ALONE, "\u{feff}x").unwrap_err().primary.span.start,
            3
        );
    }

    #[test]
    fn worse_is_more_than_the_tolerance_and_no_less() {
        let held = |percent, is| worse(Figure::Time, percent, &numbers(100.0), &numbers(is));
        assert_eq!(held(2.0, 102.0), None);
        let found = held(2.0, 102.001).unwrap();
        assert!((found.percent().unwrap() - 2.001).abs() < 1e-9);
        assert_eq!(held(0.0, 100.0), None);
        assert!(held(0.0, 100.001).is_some());
        assert_eq!(held(0.0, 1.0), None);
        // From nothing, everything is worse.
        let from_nothing = worse(Figure::Time, 50.0, &numbers(0.0), &numbers(0.001)).unwrap();
        assert_eq!(from_nothing.percent(), None);
    }
}
