//! V-shaped roughing as an operation of a job.

use crate::asked::{Avoid, Compensate, Objective, Residual, RoughVcut};
use crate::check::NARROWEST_ALONG;
use crate::plan::{PlannedVcut, parameters};
use crate::{check, choice};
use core::any::Any;
use vcutc_backend_api::units::{Angle, Length};
use vcutc_cancellation::Effort;
use vcutc_diagnostics::Diagnostic;
use vcutc_diagnostics::number::show;
use vcutc_diagnostics::source::Span;
use vcutc_job::follow::{Along, Family, Follow, Guide};
use vcutc_job::operation::less::Leaves;
use vcutc_job::operation::{Aim, Ground, Laid, Operation, Settled, Swing, Unplanned, Variant, Variation};
use vcutc_job::{Auto, BladeRef, Order, PlannedOperation, Setup, Sourced};
use vcutc_process::lower::BLEND;

/// By how many degrees the swing is made smaller, one after the other.
const SMALLER: [f64; 4] = [2.0, 5.0, 10.0, 20.0];

impl RoughVcut {
    /// An operation that is V-shaped roughing.
    #[must_use]
    pub fn of(operation: &dyn Operation) -> Option<&Self> {
        let operation: &dyn Any = operation;
        operation.downcast_ref()
    }

    /// The same, to be changed.
    #[must_use]
    pub fn of_mut(operation: &mut dyn Operation) -> Option<&mut Self> {
        let operation: &mut dyn Any = operation;
        operation.downcast_mut()
    }

    fn in_the_other_order(&self) -> Variant {
        let order = match self.order.value.or(Order::Point) {
            Order::Point => Order::Layer,
            Order::Layer => Order::Point,
        };
        let mut operation = self.clone();
        operation.order.value = Auto::Given(order);
        Variant {
            advice: format!("cut with `order = {}`", order.word()),
            edits: self.setup.stated("order", self.order.span, order.word()),
            operation: Box::new(operation),
        }
    }

    /// In whole degrees.
    fn with_smaller_swings(&self, planned: Angle) -> Vec<Variant> {
        let now = planned.to_deg().ceil();
        let swings = SMALLER.into_iter().map(|less| now - less);
        let swings = swings.filter(|&swing| swing > 0.0);
        swings.map(|swing| self.with_swing(Angle::deg(swing))).collect()
    }

    /// None where they may be narrower already, or tips are given.
    pub(crate) fn with_narrower_flanks(&self) -> Option<Variant> {
        if self.avoid.value == Avoid::Swing || self.tips.is_some() || self.along.is_some() {
            return None;
        }
        let mut operation = self.clone();
        operation.avoid.value = Avoid::Swing;
        Some(Variant {
            advice: "cut with narrower flanks where Vs do not fit: `avoid = swing`".to_owned(),
            edits: self.setup.stated("avoid", self.avoid.span, Avoid::Swing.word()),
            operation: Box::new(operation),
        })
    }

    fn with_swing(&self, swing: Angle) -> Variant {
        let text = format!("{} deg", show(swing.to_deg()));
        let mut operation = self.clone();
        operation.swing.value = Auto::Given(swing);
        Variant {
            advice: format!("use a `swing` of {text}"),
            edits: self.swing.span.map(|span| (span, text)).into_iter().collect(),
            operation: Box::new(operation),
        }
    }
}

impl Operation for RoughVcut {
    fn setup(&self) -> &Setup {
        &self.setup
    }

    fn blades(&self) -> Vec<BladeRef<'_>> {
        vec![BladeRef::Straight(&self.blade)]
    }

    fn setup_mut(&mut self) -> &mut Setup {
        &mut self.setup
    }

    /// Tips keep their places: there are as many of them as cuts.
    fn forget_places(&mut self, place: Span) {
        self.blade.forget_places(place);
        self.lattice.forget_place(place);
        self.swing.forget_place(place);
        self.layer.forget_place(place);
        self.step.forget_place(place);
        self.overlap.forget_place(place);
        self.objective.forget_place(place);
        self.formulas.forget_place(place);
        self.allowance.forget_place(place);
        self.residual.forget_place(place);
        self.redundant.forget_place(place);
        self.avoid.forget_place(place);
        self.order.forget_place(place);
        self.sequence.forget_place(place);
        self.standoff.forget_place(place);
        self.follow.forget_place(place);
        self.compensate.forget_place(place);
        let limits = &mut self.limits;
        limits.swing.forget_places(place);
        limits.layer.forget_places(place);
        limits.step.forget_places(place);
        for limit in [&mut limits.scallop, &mut limits.edge, &mut limits.deviation]
            .into_iter()
            .flatten()
        {
            limit.forget_place(place);
        }
        forget(&mut limits.time, place);
        forget(&mut limits.cuts, place);
    }

    fn scallop_limit(&self) -> Option<Sourced<Length>> {
        self.limits.scallop
    }

    fn deviation_limit(&self) -> Option<Sourced<Length>> {
        self.limits.deviation
    }

    fn compensates(&self) -> Option<Span> {
        match self.compensate.value {
            Compensate::Nothing => None,
            Compensate::Forces => Some(self.compensate.span.unwrap_or(self.setup.head_span)),
        }
    }

    fn compensating(&self) -> Option<Variant> {
        if self.compensate.value == Compensate::Forces || self.family != Family::Straight {
            return None;
        }
        let mut operation = self.clone();
        operation.compensate.value = Compensate::Forces;
        Some(Variant {
            advice: "set the tips off against the forces: `compensate = forces`".to_owned(),
            edits: self
                .setup
                .stated("compensate", self.compensate.span, Compensate::Forces.word()),
            operation: Box::new(operation),
        })
    }

    fn keeping_more(&self, by: Length) -> Option<Variant> {
        // Given tips keep their places.
        if self.tips.is_some() {
            return None;
        }
        let mut operation = self.clone();
        let allowance = &mut operation.allowance;
        // Upward, to hundredths of a mm.
        allowance.value = Length::mm(((allowance.value + by).to_mm() * 100.0).ceil() / 100.0);
        let text = format!("{} mm", show(allowance.value.to_mm()));
        Some(Variant {
            advice: format!("leave more on the part: `allowance = {text}`"),
            edits: self.setup.stated("allowance", self.allowance.span, &text),
            operation: Box::new(operation),
        })
    }

    fn leaving_less(&self, least: Length) -> Vec<Variant> {
        if self.tips.is_some() {
            return Vec::new();
        }
        let leaves = Leaves {
            allowance: |asked: &mut Self| &mut asked.allowance,
            scallop: |asked| &mut asked.limits.scallop,
            residual: |asked| &mut asked.residual,
            lift: Residual::Lift,
        };
        leaves.less(self, least)
    }

    fn follows(&self) -> Option<Sourced<Follow>> {
        Some(self.follow)
    }

    fn following(&self, family: Family) -> Result<Box<dyn Operation>, Box<Diagnostic>> {
        let operation = Self {
            family,
            ..self.clone()
        };
        match check::beside_level(&operation) {
            Some(refused) => Err(Box::new(refused)),
            None => Ok(Box::new(operation)),
        }
    }

    fn following_best(&self) -> Option<Variant> {
        if self.follow.value == Follow::Auto {
            return None;
        }
        let mut operation = self.clone();
        operation.follow.value = Follow::Auto;
        Some(Variant {
            advice: "let the cuts follow the part as suits it best: `follow = auto`".to_owned(),
            edits: self.setup.stated("follow", self.follow.span, Follow::Auto.word()),
            operation: Box::new(operation),
        })
    }

    fn go_along(&mut self, guide: &Guide, others: Option<Length>) {
        let angle = self.setup.rake.value - self.blade.half_apex.value;
        // Wider Vs would lay the shank down where cuts fall.
        let standing = parameters::widest_standing(self.setup.rake.value, guide.steepest());
        let in_columns = guide.columns().map(parameters::widest_in_columns);
        if let Some(widest) = standing.into_iter().chain(in_columns).reduce(Angle::min) {
            let most = &mut self.limits.swing.most;
            if self.swing.value == Auto::Auto && most.is_none_or(|most| most.value > widest) {
                *most = Some(Sourced {
                    value: widest,
                    span: None,
                });
            }
        }
        let least = &mut self.limits.swing.least;
        if self.swing.value == Auto::Auto && least.is_none_or(|least| least.value < NARROWEST_ALONG) {
            *least = Some(Sourced {
                value: NARROWEST_ALONG,
                span: None,
            });
        }
        self.along = Some(Along::new(
            guide,
            self.blade.cutting_length.value,
            angle,
            BLEND,
            others,
        ));
    }

    fn aim(&self) -> Aim {
        match self.objective.value {
            Objective::Time => Aim::Time,
            Objective::Scallop => Aim::Scallop,
            Objective::Cuts => Aim::Cuts,
            Objective::BladeLoad => Aim::Edge,
        }
    }

    fn swing(&self) -> Swing {
        match self.swing.value {
            Auto::Auto => Swing::Open,
            Auto::Given(_) => Swing::Given,
        }
    }

    fn narrowest_swing(&self) -> Option<Angle> {
        self.limits.swing.least.map(|least| least.value)
    }

    fn variants(&self, planned: &dyn PlannedOperation, of: Variation) -> Vec<Variant> {
        match of {
            Variation::Order => vec![self.in_the_other_order()],
            Variation::SmallerSwing => self.with_smaller_swings(planned.swing()),
            Variation::NarrowerFlanks => self.with_narrower_flanks().into_iter().collect(),
        }
    }

    fn at_swing(&self, swing: Angle) -> Option<Variant> {
        Some(self.with_swing(swing))
    }

    fn without_plan_limits(&self) -> Option<Box<dyn Operation>> {
        let free = choice::without_plan_limits(self)?;
        Some(Box::new(free))
    }

    fn settle(&mut self, planned: &dyn PlannedOperation) -> Settled {
        match PlannedVcut::of(planned).map(|vcut| vcut.asked.limits) {
            Some(limits) if limits.chosen.is_some() => {
                self.limits.scallop = limits.scallop;
                self.limits.chosen = limits.chosen;
                Settled::Limited
            }
            Some(_) | None => Settled::AsAsked,
        }
    }

    fn plan<'j>(&'j self, ground: Ground<'j>) -> Result<Laid, Box<dyn Unplanned + 'j>> {
        let (vcut, after) = choice::plan(self, ground)?;
        Ok(Laid {
            planned: Box::new(vcut),
            after,
        })
    }

    fn is_plannable(&self, ground: Ground<'_>, effort: &mut Effort) -> Option<bool> {
        Some(choice::is_plannable(self, ground, effort))
    }
}

fn forget<T>(limit: &mut Option<Sourced<T>>, place: Span) {
    if let Some(limit) = limit {
        limit.forget_place(place);
    }
}
