//! Bounds where a job says them: as a given value, or as a limit.

use crate::asked::RoughVcut;
use crate::plan::optimum::Bound;
use vcutc_backend_api::units::{Angle, Duration, Length};
use vcutc_diagnostics::source::Span;
use vcutc_job::{Auto, Sourced};

/// Writes a number, in the unit that people use, where the job says a bound; where that stands. None where the job does
/// not say it.
pub fn set(asked: &mut RoughVcut, bound: Bound, number: f64) -> Option<Span> {
    fn given<T>(value: &mut Sourced<Auto<T>>, limit: Option<&mut Sourced<T>>, number: T) -> Option<Span> {
        match (&mut value.value, limit) {
            (Auto::Given(given), _) => {
                *given = number;
                value.span
            }
            (Auto::Auto, Some(limit)) => written(Some(limit), number),
            (Auto::Auto, None) => None,
        }
    }
    fn written<T>(limit: Option<&mut Sourced<T>>, number: T) -> Option<Span> {
        let limit = limit?;
        limit.value = number;
        limit.span
    }
    let limits = &mut asked.limits;
    match bound {
        Bound::SwingLeast => given(&mut asked.swing, limits.swing.least.as_mut(), Angle::deg(number)),
        Bound::SwingMost => given(&mut asked.swing, limits.swing.most.as_mut(), Angle::deg(number)),
        Bound::LayerLeast => given(&mut asked.layer, limits.layer.least.as_mut(), Length::mm(number)),
        Bound::LayerMost => given(&mut asked.layer, limits.layer.most.as_mut(), Length::mm(number)),
        Bound::StepLeast => given(&mut asked.step, limits.step.least.as_mut(), Length::mm(number)),
        Bound::StepMost => given(&mut asked.step, limits.step.most.as_mut(), Length::mm(number)),
        Bound::OverlapLeast | Bound::OverlapMost => given(&mut asked.overlap, None, number),
        Bound::Scallop => written(limits.scallop.as_mut(), Length::mm(number)),
        Bound::Edge => written(limits.edge.as_mut(), Length::mm(number)),
        Bound::Time => written(limits.time.as_mut(), Duration::s(number)),
        Bound::Cuts => written(limits.cuts.as_mut(), number),
    }
}

/// Whether a bound is that of a given value.
#[must_use]
pub const fn is_given(asked: &RoughVcut, bound: Bound) -> bool {
    match bound {
        Bound::SwingLeast | Bound::SwingMost => matches!(asked.swing.value, Auto::Given(_)),
        Bound::LayerLeast | Bound::LayerMost => matches!(asked.layer.value, Auto::Given(_)),
        Bound::StepLeast | Bound::StepMost => matches!(asked.step.value, Auto::Given(_)),
        Bound::OverlapLeast | Bound::OverlapMost => matches!(asked.overlap.value, Auto::Given(_)),
        Bound::Scallop | Bound::Edge | Bound::Time | Bound::Cuts => false,
    }
}
