//! The compiler's stages, one function each, in the order of the driver.
//!
//! The jobs here are right, so whatever goes wrong is a fault of the compiler or of the benchmark: it ends the run. None
//! of them is inlined, so that profilers show them by their names.

use vcutc::diagnostics::source::{LoadError, Loader, SourceMap};
use vcutc::driver::{self, Outcome, Request, SearchEffort, Typed};
use vcutc::job::CheckedJob;
use vcutc::job::PlannedJob;
use vcutc::job::sema;
use vcutc::process::{lower, plan};
use vcutc::simulation::prove::{self, Bound, Findings, Replay};
use vcutc::simulation::timing::Times;
use vcutc::syntax::{self, ast::Ast};
use vcutc_backend_api::backend::{Backend, Emission, OptionValue, Options};
use vcutc_backend_api::bundle::{Sink, SinkError};
use vcutc_backend_api::motion::ReachableProgram;
use vcutc_backend_api::readback::{self, Comparator, ProgramFile, Sources, Statement};
use vcutc_backend_api::testkit;
use vcutc_backend_api::verify::{VerifiedProgram, verify};
use vcutc_backend_krl::Krl;

/// Name of the one file there is.
const PATH: &str = "bench.vcut";

/// A loader with one text.
struct OneText<'t>(&'t str);

impl Loader for OneText<'_> {
    fn load(&self, path: &str) -> Result<Vec<u8>, LoadError> {
        if path == PATH {
            Ok(self.0.as_bytes().to_vec())
        } else {
            Err(LoadError::NotFound)
        }
    }
}

/// Takes everything and keeps nothing.
#[derive(Debug, Default)]
pub struct Discard {
    /// Bytes taken, so that the work is not optimised away.
    pub bytes: usize,
}

impl Sink for Discard {
    fn file(&mut self, _name: &str) -> Result<(), SinkError> {
        Ok(())
    }

    fn write(&mut self, bytes: &[u8]) -> Result<(), SinkError> {
        self.bytes += std::hint::black_box(bytes).len();
        Ok(())
    }
}

/// Text to tree.
#[must_use]
#[inline(never)]
pub fn parse(text: &str) -> Ast {
    let mut sources = SourceMap::default();
    let file = sources.add(PATH, text);
    let mut diagnostics = Vec::new();
    let ast = syntax::parse(file, text, &mut diagnostics);
    assert!(diagnostics.is_empty(), "{diagnostics:?}");
    ast
}

/// Text to meaning; reads the text again, as the driver does.
#[must_use]
#[inline(never)]
pub fn check(text: &str) -> (SourceMap, CheckedJob) {
    let mut sources = SourceMap::default();
    let mut diagnostics = Vec::new();
    let checked = sema::check(
        PATH,
        &OneText(text),
        sema::Choices {
            operations: vcutc::registry::OPERATIONS,
            ..sema::Choices::default()
        },
        &mut sources,
        &mut diagnostics,
    );
    let (_, job) = checked.expect("the text is there");
    assert!(diagnostics.is_empty(), "{diagnostics:?}");
    (sources, job.expect("the job is right"))
}

/// A whole job, as `vcutc check` does it.
#[must_use]
pub fn compile(text: &str) -> Outcome {
    compile_from(PATH, &OneText(text))
}

/// Files of the system.
struct Disk;

impl Loader for Disk {
    fn load(&self, path: &str) -> Result<Vec<u8>, LoadError> {
        std::fs::read(path).map_err(|_| LoadError::NotFound)
    }
}

/// The same of a job in a file, with the files that it names.
#[must_use]
pub fn compile_file(path: &str) -> Outcome {
    compile_from(path, &Disk)
}

fn compile_from(path: &str, loader: &dyn Loader) -> Outcome {
    let request = Request {
        path,
        loader,
        overrides: &[],
        machine: None,
        options: Typed::default(),
        effort: SearchEffort::Normal,
        operations: vcutc::registry::OPERATIONS,
        targets: &[],
    };
    let outcome = driver::compile(request, &mut |_| {}).expect("the text is there");
    assert!(outcome.diagnostics.is_empty(), "{:?}", outcome.diagnostics);
    outcome
}

/// Meaning to plan.
#[must_use]
#[inline(never)]
pub fn plan(job: &CheckedJob) -> PlannedJob {
    let (plan, diagnostics) = plan::plan(job);
    assert!(diagnostics.is_empty(), "{diagnostics:?}");
    plan.expect("the job can be planned")
}

/// Number of V-cuts in a plan.
#[must_use]
pub fn cuts(plan: &PlannedJob) -> usize {
    plan.cuts()
}

/// Plan to verified program.
#[must_use]
#[inline(never)]
pub fn lower(plan: &PlannedJob, sources: &SourceMap) -> VerifiedProgram {
    verify(lower::lower(plan, sources)).expect("the program keeps the rules")
}

/// Program to machined contour, with the proof.
#[must_use]
#[inline(never)]
pub fn contour(plan: &PlannedJob, program: &VerifiedProgram) -> Replay {
    let bounds: Vec<Bound<'_>> = plan
        .operations
        .iter()
        .map(|planned| Bound {
            edge: None,
            ..planned.bound()
        })
        .collect();
    let replay = prove::replay(program, &bounds);
    assert_eq!(replay.findings, Findings::default());
    replay
}

/// Machined contour to figures; gives the removed area in mm2.
#[must_use]
#[inline(never)]
pub fn report(plan: &PlannedJob, program: &VerifiedProgram, replay: Replay) -> f64 {
    vcutc::simulation::report::report(replay, plan.stock, &plan.profile, times(program))
        .removed
        .to_mm2()
}

/// The times of a program.
#[must_use]
pub fn times(program: &VerifiedProgram) -> Times {
    vcutc::simulation::timing::timing(program)
}

/// Machined contour to how far it and the part's deviate from each other, in mm; the other figures come with it.
#[must_use]
#[inline(never)]
pub fn deviation(plan: &PlannedJob, replay: Replay, times: Times) -> f64 {
    vcutc::simulation::report::report(replay, plan.stock, &plan.profile, times)
        .largest_deviation()
        .to_mm()
}

/// Options of the KRL backend: all in one file, so that what is measured is writing, not how a file system makes and
/// removes hundreds of small files.
#[must_use]
pub fn options() -> Options {
    let mut options = Options::defaults(Krl.options());
    let lines_per_part = Krl.options().iter().find(|option| option.key == "lines_per_part");
    let never = OptionValue::Integer(0);
    options
        .set(lines_per_part.expect("KRL has the option"), never)
        .expect("0 never splits");
    options
}

/// The program with the motion of a pretend machine in place of its own, so that writing is measured alone.
#[must_use]
pub fn reachable(program: &VerifiedProgram) -> ReachableProgram {
    let mut program = program.program().clone();
    if let Some(cell) = &mut program.cell {
        cell.axes = testkit::axes();
    }
    let program = verify(program).expect("other axes break no rule");
    testkit::reachable(program).expect("the pretend machine carries out everything")
}

/// Program to lines, as far as that can go wrong.
#[must_use]
pub fn prepare<'p>(program: &'p ReachableProgram, options: &'p Options) -> Box<dyn Emission + 'p> {
    Krl.check(program, options).expect("KRL can say it")
}

/// Text to statements; gives how many.
#[must_use]
#[inline(never)]
pub fn read(program: &ReachableProgram, options: &Options, files: &[ProgramFile]) -> usize {
    let mut count = 0;
    read_back(program, options, files, &mut |statement| {
        std::hint::black_box(&statement);
        count += 1;
    });
    count
}

/// Text to statements, each of them compared with the program.
#[inline(never)]
pub fn retrace(program: &ReachableProgram, options: &Options, files: &[ProgramFile]) {
    let reader = Krl.reader().expect("KRL is read");
    let comparator = Comparator::new(program, reader, reader.resolution(options));
    let mut replay = readback::Replay::new(comparator, reader.frames());
    read_back(program, options, files, &mut |statement| replay.take(&statement));
    replay.finish().expect("the program is what was written");
}

fn read_back(
    program: &ReachableProgram,
    options: &Options,
    files: &[ProgramFile],
    visit: &mut dyn FnMut(Statement),
) {
    let cell = program.program().cell.as_ref().expect("the job has a machine");
    let reader = Krl.reader().expect("KRL is read");
    reader.read(Sources { files, cell, options }, visit);
}

/// Program to text.
#[inline(never)]
pub fn emit(program: &ReachableProgram, options: &Options, sink: &mut dyn Sink) {
    prepare(program, options)
        .write(sink)
        .expect("the sink takes everything");
}
