//! Programs read back: what a backend wrote, and files that people may have changed since.
//!
//! * [`Written`] is a program as its backend wrote it. It is read again at once and followed op by op; what comes out
//!   differently is never handed on.
//! * [`verify`] holds the files of a program against the one that its job compiles to now. Both are read by the same reader
//!   and their statements aligned; every difference that is not one of layout or comments is told at its place in the
//!   files, with the place in the job that asks for something else.
//!
//! Nothing here knows a dialect: a reader tells statements, and texts are compared by their essence. A difference in the
//! essence is always told, also where a number differs by less than its rounding.

mod checks;
mod differences;
mod rebuild;
mod steps;
mod told;
mod wording;
mod written;

pub use written::{Astray, Written};

use crate::diag::Diagnostic;
use crate::job::CheckedJob;
use crate::plan::PlannedJob;
use crate::reach::solve::{Reached, rig};
use crate::source::SourceMap;
use checks::{Bench, left_out};
use differences::{Scene, differences};
use rebuild::rebuild;
use steps::steps;
use told::Told;
use vcutc_backend_api::ir::Cell;
use vcutc_backend_api::motion::ReachableProgram;
use vcutc_backend_api::readback::{Judge, Place, ProgramFile, Reader, Sources};

/// A job's program as it is written now, and who can read it.
#[derive(Clone, Copy)]
pub struct Fresh<'a> {
    /// The job.
    pub job: &'a CheckedJob,
    /// Its plan.
    pub plan: &'a PlannedJob,
    /// Its program.
    pub program: &'a ReachableProgram,
    /// The machine.
    pub cell: &'a Cell,
    /// What was written.
    pub written: &'a Written,
    /// Where each op stands in it.
    pub places: &'a [Place],
    /// Who reads the dialect.
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

/// What came of holding a program against its job.
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

/// Holds the files of a program against the one that its job compiles to. `shown` are the names of the files as people
/// see them; the files are added to `sources`, so that diagnostics can point into them.
#[must_use]
pub fn verify(fresh: Fresh<'_>, given: &[ProgramFile], shown: &[String], sources: &mut SourceMap) -> Verdict {
    let ids: Vec<_> = given
        .iter()
        .enumerate()
        .map(|(index, file)| sources.add(shown.get(index).unwrap_or(&file.name), file.text.clone()))
        .collect();
    let options = &fresh.written.options;
    let read = |files, most| {
        let sources = Sources {
            files,
            cell: fresh.cell,
            options,
        };
        Told::read(fresh.reader, sources, most)
    };
    let should = read(&fresh.written.files, usize::MAX);
    let most = should.statements.len() * STATEMENTS_TIMES + STATEMENTS_MORE;
    let is = read(given, most);
    let owners = should.owners(fresh.places, fresh.program.program());
    let steps = steps(&should, &is);
    let scene = Scene {
        job: fresh.job,
        judge: Judge::new(fresh.program, fresh.reader, fresh.reader.grain(options)),
        grain: fresh.reader.grain(options),
        fresh: &should,
        owners: &owners,
        given: &is,
        sources: &ids,
    };
    let found = differences(&scene, &steps);
    let mut lines = vec![format!(
        "{} statements read, {} as compiled",
        is.statements.len() + is.beyond,
        should.statements.len()
    )];
    lines.push(match found.count() {
        0 if is_byte_for_byte(&fresh.written.files, given) => "the same program, byte for byte".to_owned(),
        0 => "the same program; layout or comments differ".to_owned(),
        1 => "1 difference".to_owned(),
        count => format!("{count} differences"),
    });
    let count = found.count();
    let mut diagnostics = found.diagnostics;
    if let (Some(machine), 1..) = (&fresh.job.machine, count) {
        let bench = Bench {
            scene: &scene,
            plan: fresh.plan,
            model: &machine.model,
            reader: fresh.reader,
        };
        let rig = rig(&machine.model, fresh.cell);
        match rebuild(&scene, &steps, &rig) {
            Ok(rebuilt) => {
                let found = bench.findings(rebuilt);
                if found.is_empty() {
                    lines.push(
                        "as it is, the program cuts every chip free, stays out of the part, and is within reach"
                            .to_owned(),
                    );
                }
                diagnostics.extend(found);
            }
            Err(obstacle) => diagnostics.push(left_out(&scene, obstacle)),
        }
    }
    Verdict { diagnostics, lines }
}

fn is_byte_for_byte(fresh: &[ProgramFile], given: &[ProgramFile]) -> bool {
    let is_there = |file: &ProgramFile| given.iter().any(|given| given.text == file.text);
    fresh.len() == given.len() && fresh.iter().all(is_there)
}
