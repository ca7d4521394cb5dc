//! The plan of a pocket to be freed as the stages after planning see it.

use crate::decided::Planned;
use crate::from_above::from_above;
use crate::{lower, proof, verdict, words};
use vcutc_backend_api::builder::ProgramBuilder;
use vcutc_backend_api::ir::{OperationId, Program, SourceRef};
use vcutc_backend_api::units::{Angle, Area, Length};
use vcutc_diagnostics::Diagnostic;
use vcutc_geometry::curve::Point2;
use vcutc_geometry::profile::Profile;
use vcutc_job::PlannedOperation;
use vcutc_job::description::{ParameterFigure, ParameterTable};
use vcutc_job::operation::judged::{FromAbove, Judged};
use vcutc_job::operation::{Operation, Trials, WorksThere};
use vcutc_job::planned::{Estimate, PlannedTip, PlannedWay};
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
        self.plan.cuts()
    }

    /// No section shows its cuts.
    fn tips(&self) -> Vec<PlannedTip> {
        Vec::new()
    }

    fn ways(&self) -> Vec<PlannedWay> {
        self.plan.ways()
    }

    fn swing(&self) -> Angle {
        Angle::ZERO
    }

    fn extension(&self) -> Length {
        self.asked.disc.radius.value + self.asked.setup.run_out.value
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
        from_above(&self.asked, operation, program)
    }

    fn estimate(&self) -> Estimate {
        Estimate {
            time: self.plan.time,
            cuts: self.cuts() as f64,
        }
    }

    fn lower(&self, source: SourceRef, builder: &mut ProgramBuilder) {
        lower::lower(self, source, builder);
    }

    fn explain(&self, finding: Finding, _: usize, _: &mut dyn Trials, _: &mut WorksThere<'_>) -> Diagnostic {
        verdict::explained(&self.asked, finding)
    }

    /// Nothing that a section shows.
    fn to_remove(&self, _: &Profile, _: &[Point2]) -> Area {
        Area::mm2(0.0)
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

    fn chosen(&self, field: &str) -> Option<(String, String)> {
        words::chosen(self, field)
    }

    fn layout(&self) -> [String; 2] {
        words::layout(self)
    }
}
