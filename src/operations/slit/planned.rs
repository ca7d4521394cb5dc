//! The plan of slits along walls as the stages after planning see it.

use crate::decided::Planned;
use crate::{lower, proof, verdict, words};
use vcutc_backend_api::builder::ProgramBuilder;
use vcutc_backend_api::ir::{OperationId, Program, SourceRef};
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::Diagnostic;
use vcutc_job::PlannedOperation;
use vcutc_job::description::{ParameterFigure, ParameterTable};
use vcutc_job::operation::judged::{FromAbove, Judged};
use vcutc_job::operation::{Operation, Trials, WorksThere};
use vcutc_job::planned::{Estimate, PlannedWay};
use vcutc_process::slits::ways::ways;
use vcutc_simulation::prove::{Bound, Finding, Passes, Replay};
use vcutc_simulation::report::Report;

impl PlannedOperation for Planned {
    fn asked(&self) -> &dyn Operation {
        &self.asked
    }

    fn asked_mut(&mut self) -> &mut dyn Operation {
        &mut self.asked
    }

    fn cuts(&self) -> usize {
        self.plan.slits.len()
    }

    fn ways(&self) -> Vec<PlannedWay> {
        let plan = &self.plan;
        ways(&plan.slits, 1, [self.asked.floor.value.to_mm(), plan.top])
    }

    fn extension(&self) -> Length {
        self.asked.blade.cutting_length.value + self.asked.setup.run_out.value
    }

    fn bound(&self) -> Bound<'_> {
        Bound {
            passes: Some(Passes::Region),
            ..Bound::of(&self.part)
        }
    }

    fn judge(&self, judged: Judged<'_>, replay: &mut Replay) {
        proof::judge(&self.asked, judged, replay);
    }

    fn seen_from_above(&self, operation: OperationId, program: &Program) -> Option<FromAbove> {
        proof::from_above(&self.asked, operation, program)
    }

    fn estimate(&self) -> Estimate {
        Estimate {
            time: self.plan.time(&self.asked),
            cuts: self.cuts() as f64,
        }
    }

    fn lower(&self, source: SourceRef, builder: &mut ProgramBuilder) {
        lower::lower(self, source, builder);
    }

    fn explain(&self, finding: Finding, _: usize, _: &mut dyn Trials, _: &mut WorksThere<'_>) -> Diagnostic {
        verdict::explained(&self.asked, &self.plan, finding)
    }

    fn parameters(&self) -> Vec<ParameterFigure> {
        words::parameters(self)
    }

    fn tables(&self) -> Vec<ParameterTable> {
        words::tables(self)
    }

    fn summary(&self, _: &Report) -> Vec<(&'static str, String)> {
        words::summary(self)
    }

    fn layout(&self) -> [String; 2] {
        words::layout(self)
    }
}
