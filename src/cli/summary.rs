//! The result of one job, as people and programs see it.

use super::output::Placed;
use serde::Serialize;
use std::time::Duration;
use vcutc_backend_api::words::counted;
use vcutc_diagnostics::{Diagnostic, Severity};
use vcutc_driver::checks::{CheckFigure, Checks};
use vcutc_driver::dynamics::Dynamics;
use vcutc_driver::numbers::Numbers;
use vcutc_driver::summary::chosen::OperationFigures;
use vcutc_driver::summary::times::{self, TimeFigures};
use vcutc_driver::summary::verdict;
use vcutc_dynamics::deviation::figures::DeviationFigures;
use vcutc_dynamics::figures::TorqueFigures;
use vcutc_dynamics::modes::figures::ModeFigures;
use vcutc_motion::figures::ReachFigures;
use vcutc_motion::summary as reach_summary;

/// Most written files that are listed one by one.
const MOST_FILES_LISTED: usize = 8;

/// The result of one job.
#[derive(Default)]
pub(super) struct Summary<'a> {
    /// The job's path as given.
    pub(super) job: &'a str,
    /// What was reported.
    pub(super) diagnostics: &'a [Diagnostic],
    /// What was planned, a line each.
    pub(super) lines: &'a [String],
    /// The figures of the program.
    pub(super) numbers: Option<&'a Numbers>,
    pub(super) times: Option<&'a TimeFigures>,
    /// What is asked of the machine.
    pub(super) reach: Option<&'a ReachFigures>,
    /// What is asked of its drives, and how far forces push it off.
    pub(super) dynamics: Option<&'a Dynamics>,
    /// Which checks were made of the program, and which were not.
    pub(super) checks: Option<Checks>,
    pub(super) parameters: &'a [OperationFigures],
    /// Files of its program, as people see them.
    pub(super) placed: &'a [Placed],
    /// What else there is to say of files, or of there being none.
    pub(super) remark: Option<&'a str>,
    /// Stages with the time each took.
    pub(super) timings: &'a [(&'static str, Duration)],
}

/// A file that took the place of the program of another job.
#[derive(Serialize)]
struct Replaced<'a> {
    file: &'a str,
    job: &'a str,
}

#[derive(Serialize)]
pub(super) struct SummaryBody<'a> {
    job: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    failure: Option<&'a str>,
    errors: usize,
    warnings: usize,
    lines: Vec<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    verdict: Option<VerdictBody>,
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    operations: &'a [OperationFigures],
    #[serde(skip_serializing_if = "Option::is_none")]
    numbers: Option<&'a Numbers>,
    times: Option<&'a TimeFigures>,
    #[serde(skip_serializing_if = "Option::is_none")]
    reach: Option<&'a ReachFigures>,
    #[serde(skip_serializing_if = "Option::is_none")]
    torques: Option<&'a TorqueFigures>,
    #[serde(skip_serializing_if = "Option::is_none")]
    deviation: Option<&'a DeviationFigures>,
    #[serde(skip_serializing_if = "Option::is_none")]
    modes: Option<&'a ModeFigures>,
    files: Vec<&'a str>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    unchanged: Vec<&'a str>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    replaced: Vec<Replaced<'a>>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    stages: Vec<StageBody>,
}

/// What is proven, and what is not checked.
#[derive(Serialize)]
struct VerdictBody {
    standing: &'static str,
    proven: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    not_checked: Option<String>,
    checks: Vec<CheckFigure>,
}

impl VerdictBody {
    fn of(checks: &Checks) -> Self {
        Self {
            standing: checks.standing().name(),
            proven: checks.proven(),
            not_checked: checks.not_checked(),
            checks: checks.figures(),
        }
    }
}

#[derive(Serialize)]
struct StageBody {
    stage: &'static str,
    milliseconds: f64,
}

impl Summary<'_> {
    /// The same for programs; `with_stages` adds how long each took.
    pub(super) fn body<'s>(&'s self, failure: Option<&'s str>, with_stages: bool) -> SummaryBody<'s> {
        let (errors, warnings) = count(self.diagnostics);
        SummaryBody {
            job: self.job,
            failure,
            errors,
            warnings,
            lines: self.all_lines(),
            verdict: self.checks.as_ref().map(VerdictBody::of),
            operations: self.parameters,
            numbers: self.numbers,
            times: self.times,
            reach: self.reach,
            torques: self.dynamics.and_then(|dynamics| dynamics.torques.as_ref()),
            deviation: self.dynamics.and_then(|dynamics| dynamics.deviation.as_ref()),
            modes: self.dynamics.and_then(|dynamics| dynamics.modes.as_ref()),
            files: self.placed.iter().map(Placed::path).collect(),
            unchanged: unchanged(self.placed),
            replaced: replaced(self.placed),
            stages: if with_stages { self.stages() } else { Vec::new() },
        }
    }

    /// What people get to see of it; `in_detail` with the figures of machine and time.
    pub(super) fn text(&self, in_detail: bool) -> String {
        let (errors, warnings) = count(self.diagnostics);
        let mut text: String = self.all_lines().iter().map(|line| format!("{line}\n")).collect();
        if in_detail {
            let mut table = self.reach.map(reach_summary::table).unwrap_or_default();
            table.extend(self.times.map(times::table).unwrap_or_default());
            text.extend(table.iter().map(|line| format!("{line}\n")));
            for (stage, time) in self.timings {
                text += &format!("{stage:<10} {:>9.1} ms\n", milliseconds(*time));
            }
        }
        text += &placed(self.placed);
        let remark = self.remark.map_or(String::new(), |remark| format!("; {remark}"));
        text += &format!("{}: {}{remark}\n", self.job, tally(errors, warnings));
        text
    }

    fn stages(&self) -> Vec<StageBody> {
        self.timings
            .iter()
            .map(|&(stage, time)| StageBody {
                stage,
                milliseconds: milliseconds(time),
            })
            .collect()
    }

    /// What was planned, and the verdict below it. Of several programs neither is printed.
    fn all_lines(&self) -> Vec<String> {
        let checks = self.checks.as_ref().filter(|_| !self.lines.is_empty());
        let verdict = checks.map(verdict).unwrap_or_default();
        self.lines.iter().cloned().chain(verdict).collect()
    }
}

fn milliseconds(time: Duration) -> f64 {
    time.as_secs_f64() * 1e3
}

fn count(diagnostics: &[Diagnostic]) -> (usize, usize) {
    let errors = diagnostics
        .iter()
        .filter(|d| d.severity() == Severity::Error)
        .count();
    (errors, diagnostics.len() - errors)
}

/// Files that took the place of another job's program.
fn replaced(placed: &[Placed]) -> Vec<Replaced<'_>> {
    let replaced = placed.iter().filter_map(|file| {
        let (file, job) = (file.path(), file.replaced()?);
        Some(Replaced { file, job })
    });
    replaced.collect()
}

fn unchanged(placed: &[Placed]) -> Vec<&str> {
    let is_unchanged = |file: &&Placed| matches!(file, Placed::Unchanged(_));
    placed.iter().filter(is_unchanged).map(Placed::path).collect()
}

/// What was written, then what was left alone.
fn placed(files: &[Placed]) -> String {
    let written = files.iter().filter(|file| file.is_new());
    let written: Vec<&str> = written.map(Placed::path).collect();
    let over = files
        .iter()
        .filter_map(|file| Some((file.path(), file.replaced()?)));
    let over: String = over
        .map(|(path, job)| {
            format!("note: {path} was the program of another job, `{job}`, which this one has replaced\n")
        })
        .collect();
    listed("wrote", &written) + &listed("unchanged:", &unchanged(files)) + &over
}

/// A line for each file; a program of many parts gets one line.
fn listed(what: &str, files: &[&str]) -> String {
    match files {
        [first, .., last] if files.len() > MOST_FILES_LISTED => {
            format!("{what} {} files, {first} to {last}\n", files.len())
        }
        few => few.iter().map(|file| format!("{what} {file}\n")).collect(),
    }
}

/// `2 errors and 1 warning`, `no errors`.
fn tally(errors: usize, warnings: usize) -> String {
    let plural = |n: usize, word: &str| match n {
        0 => format!("no {word}s"),
        _ => counted(n, word),
    };
    match warnings {
        0 => plural(errors, "error"),
        _ => format!("{} and {}", plural(errors, "error"), plural(warnings, "warning")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn many_files_are_reported_in_one_line() {
        let files: Vec<_> = (1..=20)
            .map(|n| Placed::Written(format!("p{n:03}.src")))
            .collect();
        assert_eq!(placed(&files), "wrote 20 files, p001.src to p020.src\n");
        let two = [files[0].clone(), Placed::Unchanged("p002.src".to_owned())];
        assert_eq!(placed(&two), "wrote p001.src\nunchanged: p002.src\n");
    }

    #[test]
    fn tallies_read_as_sentences() {
        assert_eq!(tally(0, 0), "no errors");
        assert_eq!(tally(1, 0), "1 error");
        assert_eq!(tally(0, 1), "no errors and 1 warning");
        assert_eq!(tally(2, 3), "2 errors and 3 warnings");
    }
}
