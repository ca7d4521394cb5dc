//! The plan of V-shaped roughing as the stages after planning see it.

use crate::asked::{RoughVcut, Sequence};
use crate::plan::avoid::Swings;
use crate::plan::removable::Removable;
use crate::plan::{Compensated, PlannedVcut};
use crate::{choice, lower, summary, tables, verdict};
use core::any::Any;
use vcutc_backend_api::builder::ProgramBuilder;
use vcutc_backend_api::ir::{SourceRef, Stock};
use vcutc_backend_api::units::{Angle, Area, Duration, Length};
use vcutc_diagnostics::Diagnostic;
use vcutc_diagnostics::number::show;
use vcutc_geometry::curve::Point2;
use vcutc_geometry::profile::Profile;
use vcutc_job::description::{ParameterFigure, ParameterTable};
use vcutc_job::operation::{Operation, Trials, WorksThere};
use vcutc_job::planned::{Balance, Compile, CutShape, Estimate, PlannedTip};
use vcutc_job::search::RouteSet;
use vcutc_job::{Auto, Order, PlannedOperation};
use vcutc_simulation::prove::{Bound, ColumnsBound, Compensation, Finding, Made};
use vcutc_simulation::report::Report;
use vcutc_simulation::surface::Surface;

impl PlannedVcut {
    /// A plan that is one of V-shaped roughing.
    #[must_use]
    pub fn of(planned: &dyn PlannedOperation) -> Option<&Self> {
        let planned: &dyn Any = planned;
        planned.downcast_ref()
    }
}

impl PlannedVcut {
    /// What pictures and lists show of a V with such flanks.
    fn shape(&self, swings: Swings) -> CutShape {
        let Swings { left, right } = swings;
        if swings == Swings::even(self.parameters.swing) {
            CutShape::Plain
        } else {
            CutShape::Narrowed { left, right }
        }
    }
}

impl PlannedVcut {
    /// The columns that its cuts keep to, if they do.
    fn columns_bound(&self) -> Option<ColumnsBound<'_>> {
        Some(ColumnsBound {
            columns: self.columns()?,
            allowance: self.asked.allowance.value,
            made: Made::AsChains,
        })
    }

    /// How much lower a flank begins and lies at most, at any x, when tips are offset by this.
    fn lower_by(&self, by: &Compensation) -> Length {
        let vees = lower::numbers(&self.cuts).into_iter().zip(&self.cuts);
        let each = vees.flat_map(|(vee, cut)| {
            let Point2 { x, z } = by.offset(vee);
            [cut.swings.left, cut.swings.right].map(|swing| {
                let tangent = libm::tan(swing.to_rad());
                // A flank gets lower by its slope as it moves to the side. Upright ones do not.
                let by_slope = if tangent > 0.0 { x.abs() / tangent } else { 0.0 };
                by_slope - z
            })
        });
        Length::mm(each.fold(0.0, f64::max))
    }
}

impl PlannedOperation for PlannedVcut {
    fn asked(&self) -> &dyn Operation {
        &self.asked
    }

    fn asked_mut(&mut self) -> &mut dyn Operation {
        &mut self.asked
    }

    fn cuts(&self) -> usize {
        self.cuts.len()
    }

    fn tips(&self) -> Vec<PlannedTip> {
        let cuts = self.cuts.iter();
        cuts.map(|cut| PlannedTip {
            layer: cut.layer,
            tip: cut.tip,
            origin: cut.origin,
            shape: self.shape(cut.swings),
        })
        .collect()
    }

    fn swing(&self) -> Angle {
        self.parameters.swing
    }

    fn order(&self) -> Order {
        self.order
    }

    fn extension(&self) -> Length {
        self.parameters.extension
    }

    fn bound(&self) -> Bound<'_> {
        Bound {
            drop: self.parameters.drop - self.parameters.below,
            aside: self.parameters.standoff,
            spine: self.spine(),
            columns: self.columns_bound(),
            edge: self.asked.limits.edge.map(|limit| limit.value),
            compensation: self.compensation.as_ref().map(|compensated| &compensated.by),
            lower: self
                .compensation
                .as_ref()
                .map_or(Length::ZERO, |compensated| compensated.lower),
            ..Bound::of(&self.bound)
        }
    }

    fn estimate(&self) -> Estimate {
        Estimate {
            time: self.estimate,
            cuts: self.estimated_cuts,
        }
    }

    fn is_within(&self, routes: RouteSet) -> bool {
        choice::is_within(self, routes)
    }

    fn in_rows(&self, order: Option<Order>, swing: Option<Angle>, stock: Stock) -> Box<dyn PlannedOperation> {
        let mut vcut = self.clone();
        if let (Auto::Auto, Some(swing)) = (vcut.asked.swing.value, swing)
            && swing < vcut.parameters.swing
        {
            vcut.parameters.swing = swing;
            for cut in &mut vcut.cuts {
                cut.swings = cut.swings.within(swing);
            }
        }
        let order = vcut.asked.order.value.or(order.unwrap_or(vcut.order));
        Box::new(vcut.along(order, Sequence::Rows, &Surface::untouched(stock), stock))
    }

    fn compensated(&self, by: Compensation) -> Option<Box<dyn PlannedOperation>> {
        // Along a spine tips keep their places.
        if self.asked.along.is_some() {
            return None;
        }
        let lower = self.lower_by(&by);
        Some(Box::new(Self {
            compensation: Some(Compensated { by, lower }),
            ..self.clone()
        }))
    }

    fn lower(&self, source: SourceRef, builder: &mut ProgramBuilder) {
        lower::lower(self, source, builder);
    }

    fn explain(
        &self,
        finding: Finding,
        count: usize,
        trials: &mut dyn Trials,
        works: &mut WorksThere<'_>,
    ) -> Diagnostic {
        verdict::explain(self, finding, count, trials, works)
    }

    fn help_with_scallop(
        &self,
        over_limit: Diagnostic,
        report: &Report,
        trials: &mut dyn Trials,
    ) -> Diagnostic {
        verdict::helped(over_limit, self, report, trials)
    }

    fn warnings(&self) -> Vec<Diagnostic> {
        verdict::idle_tips(self).into_iter().collect()
    }

    fn to_remove(&self, profile: &Profile, top: &[Point2]) -> Area {
        Removable::new(profile, &self.asked).under(top)
    }

    fn explain_what_stays(&self, balance: Balance<'_>, compile: &Compile<'_>) -> Option<Diagnostic> {
        verdict::much_stays(self, balance, compile)
    }

    fn broken_limits(&self, asked: &dyn Operation, time: Duration) -> Option<Diagnostic> {
        choice::broken_limits(self, RoughVcut::of(asked)?, time)
    }

    fn parameters(&self) -> Vec<ParameterFigure> {
        summary::parameters(self)
    }

    fn tables(&self) -> Vec<ParameterTable> {
        tables::tables(self)
    }

    fn summary(&self, report: &Report) -> Vec<(&'static str, String)> {
        summary::summary(self, report)
    }

    fn chosen(&self, field: &str) -> Option<(String, String)> {
        summary::chosen(self, field)
    }

    fn layout(&self) -> [String; 2] {
        let found = &self.parameters;
        let name = match self.asked.tips {
            Some(_) => "given tips",
            None => found.lattice.word(),
        };
        let measures = format!(
            "swing {} deg, layer {} mm, step {} mm",
            show(found.swing.to_deg()),
            show(found.layer.to_mm()),
            show(found.step.to_mm())
        );
        [name.to_owned(), measures]
    }
}
