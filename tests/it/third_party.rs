//! A backend from outside of this repository: its options are known, and what it cannot say is refused.

use crate::pipeline::Files;
use vcutc::diagnostics::Code;
use vcutc::driver::{EmitFailure, Outcome, Request, SearchEffort, Typed, compile, emit};
use vcutc_backend_api::backend::{
    Backend, BackendIssue, Emission, EmitError, OptionKind, OptionSpec, Options,
};
use vcutc_backend_api::bundle::{Bundle, Sink};
use vcutc_backend_api::motion::ReachableProgram;
use vcutc_backend_api::readback::Reader;
use vcutc_backend_api::verify::{Capabilities, Capability};

/// Writes how many ops a program has, if it can say what the program needs.
struct Counter(Capabilities);

struct Count(usize);

impl Emission for Count {
    fn write(&self, sink: &mut dyn Sink) -> Result<(), EmitError> {
        sink.file("count.txt")?;
        sink.write(self.0.to_string().as_bytes())?;
        Ok(())
    }
}

impl Backend for Counter {
    fn id(&self) -> &'static str {
        "counter"
    }
    fn summary(&self) -> &'static str {
        "counts ops"
    }
    fn capabilities(&self) -> Capabilities {
        self.0
    }
    fn options(&self) -> &'static [OptionSpec] {
        const OPTIONS: &[OptionSpec] = &[OptionSpec {
            key: "base",
            kind: OptionKind::Integer {
                min: 2,
                max: 36,
                default: 10,
            },
            help: "of numbers",
        }];
        OPTIONS
    }
    fn reader(&self) -> Option<&dyn Reader> {
        None
    }

    fn check<'p>(
        &self,
        program: &'p ReachableProgram,
        _options: &'p Options,
    ) -> Result<Box<dyn Emission + 'p>, Vec<BackendIssue>> {
        Ok(Box::new(Count(program.program().ops.len())))
    }
}

const EVERYTHING: Capabilities = {
    let mut all = Capabilities::NONE;
    let mut at = 0;
    while at < Capability::ALL.len() {
        all = all.with(Capability::ALL[at]);
        at += 1;
    }
    all
};

static ABLE: Counter = Counter(EVERYTHING);
static UNABLE: Counter = Counter(Capabilities::NONE.with(Capability::LinearMove));

fn compiled(option: &str) -> Outcome {
    let job = std::fs::read_to_string(crate::repository::root().join("examples/block_cui.vcut")).unwrap();
    let job = job.replace(
        "ready      = input(7)",
        &format!("ready      = input(7)\n  counter {{ {option} }}"),
    );
    let files = Files::default().with("job.vcut", job);
    let request = Request {
        path: "job.vcut",
        loader: &files,
        overrides: &[],
        machine: None,
        options: Typed::default(),
        effort: SearchEffort::Normal,
        operations: vcutc::registry::OPERATIONS,
        targets: &[&ABLE],
    };
    compile(request, &mut |_| {}).unwrap()
}

fn refusal(outcome: &Outcome, backend: &dyn Backend) -> Vec<Code> {
    // What the block of the machine asks for is refused with the job.
    if !outcome.diagnostics.is_empty() {
        return outcome.diagnostics.iter().map(|d| d.code).collect();
    }
    match emit(outcome, backend, &mut Bundle::default()) {
        Err(EmitFailure::Diagnostics(diagnostics)) => diagnostics.iter().map(|d| d.code).collect(),
        other => panic!("{other:?}"),
    }
}

#[test]
fn its_options_are_those_of_its_block() {
    let outcome = compiled("base = 8");
    assert_eq!(outcome.diagnostics, []);
    let mut bundle = Bundle::default();
    emit(&outcome, &ABLE, &mut bundle).unwrap();
    let ops = outcome
        .compiled
        .as_ref()
        .unwrap()
        .program
        .verified()
        .program()
        .ops
        .len();
    assert_eq!(bundle.get("count.txt"), Some(ops.to_string().as_bytes()));
    assert_eq!(refusal(&compiled("base = 60"), &ABLE), [Code::BadOption]);
    assert_eq!(refusal(&compiled("bass = 8"), &ABLE), [Code::UnknownOption]);
}

#[test]
fn what_it_cannot_say_is_refused() {
    let refused = refusal(&compiled("base = 8"), &UNABLE);
    // Home, turns, the generator's output and its readiness.
    assert_eq!(refused, [Code::Unsupported; 4]);
}
