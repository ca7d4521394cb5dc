//! What people and programs get to see.
//!
//! Standard output carries what was asked for (pages, lists, programs); everything else goes to standard error, as text
//! or as JSON lines. A reader that goes away (`| head`) is not an error.

use super::Exit;
use super::args::{Color, DisplayArgs, MessageFormat};
use super::differences;
use super::os_words::os_words;
use super::output::{Placed, ignore_broken_pipe};
use super::patience::HelpBudget;
use super::progress::Following;
use super::snapshot::Differences;
use super::summary::Summary;
use super::warnings::Warnings;
use anstream::AutoStream;
use serde::Serialize;
use std::io::{self, IsTerminal, Write};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;
use vcutc_diagnostics::source::SourceMap;
use vcutc_diagnostics::{Diagnostic, github, json, render};
use vcutc_driver::hints::Hint;

/// Version of the JSON objects this module writes.
const SCHEMA: u32 = 1;

/// The way to the user.
pub(super) struct Console {
    format: MessageFormat,
    color: render::ColorChoice,
    detail: Detail,
    warnings: Warnings,
    /// Whether the reader of standard error has gone away.
    is_unheard: AtomicBool,
    help_budget: HelpBudget,
}

/// How much is printed in addition to diagnostics.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Detail {
    DiagnosticsOnly,
    /// The summary, and progress.
    Summary,
    /// Every axis of the machine, every layer's time, and how long each stage of the run took, too.
    Everything,
}

/// Why nothing could be judged: wrong usage, or a file that could not be read or written.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub(super) struct Failure {
    message: String,
    help: Vec<String>,
}

impl Failure {
    /// A failure in one sentence without full stop.
    pub(super) fn new(message: impl Into<String>) -> Self {
        Self {
            message: message.into(),
            help: Vec::new(),
        }
    }

    /// What failed.
    pub(super) fn message(&self) -> &str {
        &self.message
    }

    pub(super) fn help(mut self, help: impl Into<String>) -> Self {
        self.help.push(help.into());
        self
    }
}

/// A JSON line: the kind and version first, then the rest.
#[derive(Serialize)]
struct Line<T> {
    kind: &'static str,
    schema: u32,
    #[serde(flatten)]
    body: T,
}

#[derive(Serialize)]
struct HintBody<'a> {
    /// How long the changed job takes.
    seconds: f64,
    /// The share of the time that is saved.
    saved: f64,
    #[serde(flatten)]
    fix: json::FixJson<'a>,
}

impl Console {
    pub(super) fn new(display: &DisplayArgs, warnings: Warnings) -> Self {
        Self {
            format: display.message_format,
            color: choose_color(display.color),
            detail: match (display.quiet, display.verbose) {
                (true, _) => Detail::DiagnosticsOnly,
                (false, false) => Detail::Summary,
                (false, true) => Detail::Everything,
            },
            warnings,
            help_budget: match (display.help_budget, display.message_format) {
                (Some(budget), _) => budget,
                // Programs compare what they read.
                (None, MessageFormat::Json) => HelpBudget::Unlimited,
                (None, MessageFormat::Human | MessageFormat::Github) => {
                    HelpBudget::Of(Duration::from_secs(1))
                }
            },
            is_unheard: AtomicBool::new(false),
        }
    }

    /// What is made of warnings.
    pub(super) const fn warnings(&self) -> &Warnings {
        &self.warnings
    }

    /// How long help with a refused job is looked for.
    pub(super) const fn help_budget(&self) -> HelpBudget {
        self.help_budget
    }

    /// How a long run says what it does: a passing line on a terminal, elsewhere lines that stay, where `--verbose` asks for them.
    pub(super) fn shows_progress(&self) -> Following {
        let is_terminal = io::stderr().is_terminal();
        match (self.format, self.detail) {
            (MessageFormat::Json, _) | (_, Detail::DiagnosticsOnly) => Following::Silent,
            (MessageFormat::Human | MessageFormat::Github, _) if is_terminal => Following::PassingLine,
            (MessageFormat::Human | MessageFormat::Github, Detail::Everything) => Following::Lines,
            (MessageFormat::Human | MessageFormat::Github, Detail::Summary) => Following::Silent,
        }
    }

    /// Whether `--verbose` was given.
    pub(super) fn shows_everything(&self) -> bool {
        self.detail == Detail::Everything
    }

    /// Whether the reader of messages went away, as far as writing has shown it.
    pub(super) fn is_unheard(&self) -> bool {
        self.is_unheard.load(Ordering::SeqCst)
    }

    /// Whether what is asked for goes to a program, as JSON.
    pub(super) fn speaks_json(&self) -> bool {
        self.format == MessageFormat::Json
    }

    /// Prints a text that was asked for to standard output.
    pub(super) fn document(&self, text: &str) -> Exit {
        let mut stdout = io::stdout().lock();
        let written = stdout.write_all(text.as_bytes()).and_then(|()| stdout.flush());
        match ignore_broken_pipe(written) {
            Ok(()) => Exit::Success,
            Err(error) => self.failure(&Failure::new(format!(
                "cannot write to standard output: {}",
                os_words(&error)
            ))),
        }
    }

    /// Prints what was asked for to standard output, as text or as one JSON object.
    pub(super) fn answer<T: Serialize>(&self, kind: &'static str, text: &str, body: T) -> Exit {
        match self.format {
            MessageFormat::Human | MessageFormat::Github => self.document(text),
            MessageFormat::Json => self.document(&format!("{}\n", line(kind, body))),
        }
    }

    /// Prints diagnostics.
    pub(super) fn diagnostics(&self, diagnostics: &[Diagnostic], sources: &SourceMap) {
        if diagnostics.is_empty() {
            return;
        }
        self.stderr(&match self.format {
            MessageFormat::Human => render::render(diagnostics, sources, self.color),
            MessageFormat::Json => json::json_lines(diagnostics, sources),
            MessageFormat::Github => {
                let text = render::render(diagnostics, sources, self.color);
                text + &github::annotations(diagnostics, sources)
            }
        });
    }

    /// Prints what sets a folder apart from the program of a job.
    pub(super) fn differences(&self, job: &str, found: &Differences) {
        let text = || differences::text(job, found, self.color);
        match self.format {
            MessageFormat::Human => self.stderr(&text()),
            MessageFormat::Github => self.stderr(&(text() + &differences::annotations(job, found))),
            MessageFormat::Json => {
                for body in differences::bodies(job, found) {
                    self.json_line("difference", body);
                }
            }
        }
    }

    /// Prints the result of several programs: a line for people, an object for programs.
    pub(super) fn total<T: Serialize>(&self, text: &str, body: T) {
        self.note("total", text, body);
    }

    /// Prints how a run continues: a line for people, an object for programs.
    pub(super) fn note<T: Serialize>(&self, kind: &'static str, text: &str, body: T) {
        match self.format {
            MessageFormat::Json => self.json_line(kind, body),
            MessageFormat::Human | MessageFormat::Github if self.detail == Detail::DiagnosticsOnly => {}
            MessageFormat::Human | MessageFormat::Github => self.stderr(text),
        }
    }

    /// Clears what a person sees on a terminal; what was printed before can still be scrolled to.
    pub(super) fn clear_screen(&self) {
        let is_for_people = match self.format {
            MessageFormat::Human | MessageFormat::Github => true,
            MessageFormat::Json => false,
        };
        if is_for_people && io::stderr().is_terminal() {
            self.stderr("\u{1b}[2J\u{1b}[H");
        }
    }

    /// Prints what was taken from somewhere because the user did not say it: lines for people, an object each for programs.
    #[cfg(feature = "krl")]
    pub(super) fn inferences<T: Serialize>(&self, text: &str, bodies: &[T]) {
        match self.format {
            MessageFormat::Json => {
                for body in bodies {
                    self.json_line("inference", body);
                }
            }
            MessageFormat::Human | MessageFormat::Github if self.detail == Detail::DiagnosticsOnly => {}
            MessageFormat::Human | MessageFormat::Github => self.stderr(text),
        }
    }

    /// Whether anything but diagnostics is reported.
    pub(super) fn shows_more(&self) -> bool {
        match self.detail {
            Detail::DiagnosticsOnly => false,
            Detail::Summary | Detail::Everything => true,
        }
    }

    /// Prints what would make a job better: a line for people, an object for programs.
    pub(super) fn hint(&self, hint: &Hint, sources: &SourceMap) {
        let body = HintBody {
            seconds: hint.time.to_s(),
            saved: hint.saved,
            fix: json::fix_in_json(&hint.fix, sources),
        };
        self.note("hint", &format!("help: {}\n", hint.fix.title), body);
    }

    /// Prints something about the run itself, for people.
    pub(super) fn remark(&self, words: &str) {
        match self.format {
            MessageFormat::Human | MessageFormat::Github => self.stderr(&format!("note: {words}\n")),
            MessageFormat::Json => {}
        }
    }

    /// Prints why nothing could be judged.
    pub(super) fn failure(&self, failure: &Failure) -> Exit {
        match self.format {
            MessageFormat::Human | MessageFormat::Github => {
                self.stderr(&format!("{} {}\n", self.painted("error:"), failure.message));
                for help in &failure.help {
                    self.stderr(&format!("  help: {help}\n"));
                }
            }
            MessageFormat::Json => self.json_line("failure", failure),
        }
        Exit::CannotRun
    }

    /// Prints why a run that others follow came to nothing. Programs get its summary, too, which says so.
    pub(super) fn fruitless(&self, failure: &Failure, summary: &Summary<'_>) {
        self.failure(failure);
        match self.format {
            MessageFormat::Json => {
                let body = summary.body(Some(&failure.message), self.shows_everything());
                self.json_line("summary", body);
            }
            MessageFormat::Human | MessageFormat::Github => {}
        }
    }

    /// Prints the result of a job.
    pub(super) fn summary(&self, summary: &Summary<'_>) {
        match self.format {
            MessageFormat::Json => self.json_line("summary", summary.body(None, self.shows_everything())),
            MessageFormat::Human | MessageFormat::Github if self.detail == Detail::DiagnosticsOnly => {}
            MessageFormat::Human | MessageFormat::Github => {
                self.stderr(&summary.text(self.shows_everything()));
            }
        }
    }

    /// Prints what was made of a job, where its figures are in the files.
    pub(super) fn made(
        &self,
        job: &str,
        diagnostics: &[Diagnostic],
        placed: &[Placed],
        remark: Option<&str>,
    ) {
        self.summary(&Summary {
            job,
            diagnostics,
            placed,
            remark,
            ..Summary::default()
        });
    }

    fn json_line<T: Serialize>(&self, kind: &'static str, body: T) {
        self.stderr(&format!("{}\n", line(kind, body)));
    }

    fn painted(&self, word: &str) -> String {
        match self.color {
            render::ColorChoice::Plain => word.to_owned(),
            render::ColorChoice::Colored => format!("\u{1b}[1;31m{word}\u{1b}[0m"),
        }
    }

    /// The text holds escape sequences exactly when colours were chosen, so they go through as they are (or become
    /// console calls on an old Windows console).
    fn stderr(&self, text: &str) {
        let mut stderr = AutoStream::always(io::stderr().lock());
        // There is no place to report it when standard error itself is gone.
        if let Err(error) = stderr.write_all(text.as_bytes())
            && error.kind() == io::ErrorKind::BrokenPipe
        {
            self.is_unheard.store(true, Ordering::SeqCst);
        }
    }
}

/// A JSON object in a line.
fn line<T: Serialize>(kind: &'static str, body: T) -> String {
    let line = Line {
        kind,
        schema: SCHEMA,
        body,
    };
    // Strings, counts and finite numbers: nothing in these bodies can fail to serialize.
    serde_json::to_string(&line).unwrap_or_default()
}

fn choose_color(color: Color) -> render::ColorChoice {
    let wanted = match color {
        Color::Always => return render::ColorChoice::Colored,
        Color::Never => return render::ColorChoice::Plain,
        Color::Auto => AutoStream::choice(&io::stderr()),
    };
    match wanted {
        anstream::ColorChoice::Auto | anstream::ColorChoice::Never => render::ColorChoice::Plain,
        anstream::ColorChoice::Always | anstream::ColorChoice::AlwaysAnsi => render::ColorChoice::Colored,
    }
}
