//! Programs read back: what a backend wrote, and files that people may have changed since.
//!
//! * [`Written`] is a program as its backend wrote it. It is read again at once and followed op by op; what comes out
//!   differently is never handed on.
//! * [`Reference::verify`] compares the files of a program with the one that its job compiles to now. Both
//!   are read by the same reader and their statements aligned; every difference that is not one of layout or
//!   comments is reported at its place in the files, with the place in the job that asks for something else.
//!
//! Nothing here knows a dialect: a reader reports statements, and texts are compared by their normalized
//! text. A difference in the normalized text is always reported, also where a number differs by less than its
//! rounding.

mod absent;
mod checks;
mod closing;
mod comparison;
mod differences;
mod edits;
mod listing;
mod meaning;
mod rebuild;
mod split;
mod steps;
mod wording;
mod written;

pub use written::{RoundTripError, Written};

use absent::{absent, not_given};
use checks::{Checker, left_out};
use closing::{OtherSpeed, other_speeds};
use comparison::Comparison;
use differences::differences;
use edits::edits;
use listing::Listing;
use rebuild::rebuild;
use steps::Step;
use vcutc_backend_api::ir::{Cell, OpId};
use vcutc_backend_api::motion::ReachableProgram;
use vcutc_backend_api::readback::{Comparator, Place, ProgramFile, Reader, Sources};
use vcutc_backend_api::words::counted;
use vcutc_diagnostics::Diagnostic;
use vcutc_diagnostics::source::{FileId, SourceMap};
use vcutc_job::CheckedJob;
use vcutc_job::PlannedJob;
use vcutc_motion::rigs::Rigs;
use vcutc_motion::solve::Reached;

/// A job's program as it is written now, and what can read it.
#[derive(Clone, Copy)]
pub struct Fresh<'a> {
    pub job: &'a CheckedJob,
    pub plan: &'a PlannedJob,
    pub program: &'a ReachableProgram,
    /// The machine.
    pub cell: &'a Cell,
    pub written: &'a Written,
    /// Where each op stands in it.
    pub places: &'a [Place],
    /// What reads the dialect.
    pub reader: &'a dyn Reader,
}

impl<'a> Fresh<'a> {
    /// Of a job that got as far as a program that could be read back.
    #[must_use]
    pub fn of(
        job: Option<&'a CheckedJob>,
        plan: Option<&'a PlannedJob>,
        reached: Option<&'a Reached>,
        written: &'a Written,
        reader: &'a dyn Reader,
    ) -> Option<Self> {
        let program = &reached?.program;
        Some(Self {
            job: job?,
            plan: plan?,
            program,
            cell: program.program().cell.as_ref()?,
            written,
            places: written.places.as_deref()?,
            reader,
        })
    }
}

/// The result of comparing a program with its job.
#[derive(Debug, Default)]
pub struct Verdict {
    /// What differs and what is wrong, in the order of the program.
    pub diagnostics: Vec<Diagnostic>,
    /// The result for people, a line each.
    pub lines: Vec<String>,
}

/// Programs may have so many times the statements of a fresh one, and [`STATEMENTS_MORE`] more, before the rest is only
/// counted.
const STATEMENTS_TIMES: usize = 4;
const STATEMENTS_MORE: usize = 100_000;

/// A fresh program, read and ready to be compared with others.
pub struct Reference<'a> {
    fresh: Fresh<'a>,
    listing: Listing<'a>,
    /// For every statement the op that it says.
    owners: Vec<Option<OpId>>,
}

impl<'a> Reference<'a> {
    /// Reads the fresh program.
    #[must_use]
    pub fn new(fresh: Fresh<'a>) -> Self {
        let listing = read(fresh, &fresh.written.files, usize::MAX);
        let owners = listing.owners(fresh.places, fresh.program.program());
        Self {
            fresh,
            listing,
            owners,
        }
    }

    /// Compares the files of a program with the fresh one. `shown` are the names of the files as people see
    /// them; the files are added to `sources`, so that diagnostics can point into them.
    #[must_use]
    pub fn verify(&self, given: &[ProgramFile], shown: &[String], sources: &mut SourceMap) -> Verdict {
        let (mut ids, mut ordered) = (Vec::new(), Vec::new());
        for index in in_order(&self.fresh.written.files, given) {
            let Some(file) = given.get(index) else { continue };
            ids.push(sources.add(shown.get(index).unwrap_or(&file.name), file.text.clone()));
            ordered.push(file.clone());
        }
        let given = ordered.as_slice();
        let missing = absent(self.fresh.written, given);
        if let Some(diagnostic) = not_given(&missing, &ids) {
            return Verdict {
                diagnostics: vec![diagnostic],
                lines: vec!["not compared: files are missing".to_owned()],
            };
        }
        let is = self.read(given);
        let comparison = self.comparison(&is, &ids);
        let edits = edits(&comparison);
        let found = differences(&comparison, &edits);
        let count = found.count();
        let mut lines = self.lines(&is, count, given);
        let mut diagnostics = found.diagnostics;
        if count > 0 {
            match self.checked(&comparison, &edits.steps) {
                Checked::Sound(others) => {
                    lines.extend(closing::lines(self.fresh.program.program().purpose, &others));
                }
                Checked::Wrong(wrong) => diagnostics.extend(wrong),
                Checked::NotMade => {}
            }
        }
        Verdict { diagnostics, lines }
    }

    /// How many differences [`Self::verify`] reports, without the checks of what they do.
    #[must_use]
    pub fn differences(&self, given: &[ProgramFile]) -> usize {
        let is = self.read(given);
        let comparison = self.comparison(&is, &[]);
        differences(&comparison, &edits(&comparison)).count()
    }

    fn read<'f>(&self, files: &'f [ProgramFile]) -> Listing<'f>
    where
        'a: 'f,
    {
        let most = self.listing.statements.len() * STATEMENTS_TIMES + STATEMENTS_MORE;
        read(self.fresh, files, most)
    }

    fn comparison<'s>(&'s self, given: &'s Listing<'s>, sources: &'s [FileId]) -> Comparison<'s> {
        let Fresh {
            job,
            program,
            written,
            reader,
            ..
        } = self.fresh;
        let resolution = reader.resolution(&written.options);
        Comparison {
            job,
            comparator: Comparator::new(program, reader, resolution),
            resolution,
            fresh: &self.listing,
            owners: &self.owners,
            given,
            sources,
        }
    }

    fn lines(&self, is: &Listing<'_>, differences: usize, given: &[ProgramFile]) -> Vec<String> {
        let read = format!(
            "{} statements read; the compiler writes {}",
            is.statements.len() + is.beyond,
            self.listing.statements.len()
        );
        let result = match differences {
            0 if is_byte_for_byte(&self.fresh.written.files, given) => {
                "the same program, byte for byte".to_owned()
            }
            0 => "the same program; layout or comments differ".to_owned(),
            count => counted(count, "difference"),
        };
        vec![read, result]
    }

    /// What was found of what a program that differs would do.
    fn checked(&self, comparison: &Comparison<'_>, steps: &[Step]) -> Checked {
        let Some(machine) = &self.fresh.job.machine else {
            return Checked::NotMade;
        };
        let program = self.fresh.program.program();
        let rigs = Rigs::of(&machine.model, self.fresh.cell, program);
        let rebuilt = match rebuild(comparison, steps, &rigs) {
            Ok(rebuilt) => rebuilt,
            Err(obstacle) => return Checked::Wrong(vec![left_out(comparison, obstacle)]),
        };
        let others = other_speeds(&rebuilt, self.fresh.program.program(), comparison.resolution);
        let checker = Checker {
            comparison,
            plan: self.fresh.plan,
            model: &machine.model,
            reader: self.fresh.reader,
        };
        let wrong = checker.findings(rebuilt);
        if wrong.is_empty() {
            Checked::Sound(others)
        } else {
            Checked::Wrong(wrong)
        }
    }
}

/// What was found of what a program that differs would do.
enum Checked {
    /// Nothing is wrong; these of its speeds are not the job's.
    Sound(Vec<OtherSpeed>),
    /// What is wrong, or why nothing was proven.
    Wrong(Vec<Diagnostic>),
    /// There is no machine to prove it on.
    NotMade,
}

/// The given files in the order in which the compiler writes those of their names, and the others after them:
/// the order in which files are named says nothing about the program.
fn in_order(written: &[ProgramFile], given: &[ProgramFile]) -> Vec<usize> {
    let place = |index: &usize| {
        let name = given.get(*index).map_or("", |file| file.name.as_str());
        let same = |file: &ProgramFile| file.name.eq_ignore_ascii_case(name);
        written.iter().position(same).unwrap_or(written.len())
    };
    let mut order: Vec<usize> = (0..given.len()).collect();
    order.sort_by_key(place);
    order
}

fn read<'f>(fresh: Fresh<'f>, files: &'f [ProgramFile], most: usize) -> Listing<'f> {
    let sources = Sources {
        files,
        cell: fresh.cell,
        options: &fresh.written.options,
    };
    Listing::read(fresh.reader, sources, most)
}

fn is_byte_for_byte(fresh: &[ProgramFile], given: &[ProgramFile]) -> bool {
    let is_there = |file: &ProgramFile| given.iter().any(|given| given.text == file.text);
    fresh.len() == given.len() && fresh.iter().all(is_there)
}
