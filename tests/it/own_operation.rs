//! What tests with an operation of their own share: a job is compiled by a compiler that knows it, and its program is compared.

use crate::pipeline::Files;
use crate::repository::root;
use vcutc::diagnostics::has_errors;
use vcutc::driver::{self, Outcome, Request, SearchEffort, Typed};
use vcutc::job::sema::kind::Operations;
use vcutc::readback::{Fresh, Reference, Written};
use vcutc::registry;
use vcutc_backend_api::backend::Backend;
use vcutc_backend_api::builder::ProgramBuilder;
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::ir::{Action, FeedId, OrientationId, RateId, Site, Switch};

/// The result of a job in the folder of the examples, with one of its machines.
pub(crate) fn compiled(operations: Operations, text: String, machine: &str) -> Outcome {
    let files = Files::of(root().join("examples")).with("own.vcut", text);
    let request = Request {
        path: "own.vcut",
        loader: &files,
        overrides: &[],
        machine: Some(machine),
        options: Typed::default(),
        effort: SearchEffort::Normal,
        operations,
        targets: &registry::backends(),
    };
    driver::compile(request, &mut |_| {}).unwrap()
}

/// What a target writes of a compiled job.
pub(crate) struct Emitted<'o> {
    outcome: &'o Outcome,
    backend: &'static dyn Backend,
    program: Written,
}

impl<'o> Emitted<'o> {
    pub(crate) fn of(outcome: &'o Outcome, target: &str) -> Self {
        let backend = registry::backend(target).unwrap();
        let program = driver::write(outcome, backend).unwrap().unwrap();
        Self {
            outcome,
            backend,
            program,
        }
    }

    pub(crate) fn text(&self) -> String {
        let files = self.program.files.iter();
        files.map(|file| file.text.as_str()).collect()
    }

    /// Whether its files are still the job's program with this text replaced where it first stands in each.
    pub(crate) fn is_kept_by(&self, from: &str, to: &str) -> bool {
        let mut files = self.program.files.clone();
        for file in &mut files {
            file.text = file.text.replacen(from, to, 1);
        }
        let outcome = self.outcome;
        let reached = outcome.compiled.as_ref().unwrap().program.reached();
        let reader = self.backend.reader().unwrap();
        let (job, plan) = (outcome.job.as_ref(), outcome.plan.as_ref());
        let fresh = Fresh::of(job, plan, reached, &self.program, reader).unwrap();
        let verdict = Reference::new(fresh).verify(&files, &[], &mut outcome.sources.clone());
        !has_errors(&verdict.diagnostics)
    }
}

/// From home, or from wherever the operation before ended, to where an operation begins; then what drives its blade starts.
pub(crate) fn start(
    builder: &mut ProgramBuilder,
    way: Site,
    (to, orientation): (Point3, OrientationId),
    (feed, rate): (FeedId, RateId),
) {
    let start = match builder.knows_tip() {
        true => Action::Travel {
            to,
            orientation,
            feed,
            rate,
        },
        false => Action::AxisTravel { to, orientation },
    };
    builder.op(way, start);
    let state = Switch::On;
    builder.op(way, Action::Spin { state });
    builder.op(way, Action::Ultrasonic { state });
    builder.op(way, Action::AwaitReady);
}
