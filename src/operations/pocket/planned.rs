//! The plan of a pocket as the stages after planning see it.

use crate::asked::Axis;
use crate::decided::Planned;
use crate::from_above::from_above;
use crate::{lower, proof, verdict, words};
use std::sync::Arc;
use vcutc_backend_api::builder::ProgramBuilder;
use vcutc_backend_api::ir::{OperationId, Program, SourceRef};
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::Diagnostic;
use vcutc_job::description::{ParameterFigure, ParameterTable};
use vcutc_job::operation::judged::{FromAbove, Judged};
use vcutc_job::operation::{Operation, Trials, WorksThere};
use vcutc_job::planned::{Estimate, PlannedWay};
use vcutc_job::{PlannedOperation, SoundField, Sources};
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
        self.plan.runs.len() * self.plan.floors.len()
    }

    fn ways(&self) -> Vec<PlannedWay> {
        let plan = &self.plan;
        let tops = core::iter::once(plan.top).chain(plan.floors.iter().copied());
        let layers = (1_u32..).zip(plan.floors.iter().zip(tops));
        layers
            .flat_map(|(layer, (&floor, top))| {
                let runs = (1_u32..).zip(&plan.runs);
                runs.map(move |(number, run)| run.planned([layer, number], [floor, top]))
            })
            .collect()
    }

    fn extension(&self) -> Length {
        self.asked.crusher.radius.value + self.asked.setup.run_out.value
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

    fn sound_field(&self) -> Option<SoundField> {
        let field = self.plan.field?;
        Some(SoundField {
            region: Arc::clone(&self.asked.region.region),
            step: self.plan.step,
            lift: field.lift,
            sources: match self.asked.axis.value {
                Axis::Exact => Sources::OnAxis,
                Axis::Simplified => Sources::Simplified,
            },
            radius: self.asked.crusher.radius.value,
        })
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

    fn explain(
        &self,
        finding: Finding,
        _: usize,
        trials: &mut dyn Trials,
        _: &mut WorksThere<'_>,
    ) -> Diagnostic {
        verdict::explained(&self.asked, finding, trials)
    }

    fn warnings(&self) -> Vec<Diagnostic> {
        let hole = verdict::of_the_hole(self);
        verdict::of_field(self).into_iter().chain(hole).collect()
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
