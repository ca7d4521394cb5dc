//! A speed that a target cannot write: values of the job's speeds with which it can, each compiled before it is offered.
//!
//! A target says of the first motion of a kind what its speed is and what it takes, in one unit, so their quotient is the factor by
//! which the job's speed is off there; another motion may need twice that.

use super::Objection;
use vcutc_backend_api::backend::BackendIssue;
use vcutc_backend_api::ir::{Action, Program};
use vcutc_diagnostics::Diagnostic;
use vcutc_diagnostics::number::show;
use vcutc_diagnostics::source::Span;
use vcutc_job::CheckedJob;
use vcutc_job::operation::WorksThere;
use vcutc_job::setup::SpeedField;

/// How far beyond the factor of the first motion is looked.
const FARTHER: [f64; 3] = [1.0, 2.0, 4.0];

/// Speeds of a motion that a target does not take, and by which factor they are off.
pub(super) struct Off {
    /// By what the speed would have to be multiplied.
    factor: f64,
    speeds: Vec<Stated>,
}

/// A speed as the job states it.
struct Stated {
    field: &'static str,
    /// In its unit.
    value: f64,
    unit: &'static str,
    span: Span,
}

impl Off {
    /// None where an objection is not to a speed.
    pub(super) fn of(job: &CheckedJob, program: &Program, issue: &BackendIssue) -> Option<Self> {
        let BackendIssue::OutOfRange {
            op: Some(op),
            what: "tip speed" | "reorientation rate",
            range: Some(range),
            ..
        } = issue
        else {
            return None;
        };
        let op = program.op(*op)?;
        let setup = job.operations.get(usize::from(op.site.operation()?.0))?.setup();
        // Where the blade turns on its way, either of the two holds it back.
        let rate = op.action.rate().map(|_| SpeedField::Reorient);
        let feed = op.action.feed().map(|_| match op.action {
            Action::Cut { .. } => SpeedField::Cut,
            _ => SpeedField::Travel,
        });
        let stated = |field: SpeedField| {
            Some(Stated {
                field: field.name(),
                value: field.value(setup),
                unit: field.unit(),
                span: field.span(setup)?,
            })
        };
        Some(Self {
            factor: range.factor()?,
            speeds: rate.into_iter().chain(feed).filter_map(stated).collect(),
        })
    }
}

/// A speed that people like to write, on the far side of `value` as seen from `from`.
fn rounded(value: f64, from: f64) -> f64 {
    let scale = if value >= 10.0 { 1.0 } else { 1000.0 };
    let scaled = value * scale;
    let whole = if value > from {
        (scaled - 1e-9).ceil()
    } else {
        (scaled + 1e-9).floor()
    };
    whole / scale
}

/// An objection with the first speed that the target takes and the machine follows.
pub(crate) fn with_help(objection: &Objection, works: &mut WorksThere<'_>) -> Diagnostic {
    let diagnostic = objection.diagnostic.clone();
    let Some(off) = &objection.off else {
        return diagnostic;
    };
    let candidates = off.speeds.iter().flat_map(|stated| {
        FARTHER.map(|farther| {
            let factor = if off.factor > 1.0 {
                off.factor * farther
            } else {
                off.factor / farther
            };
            (stated, rounded(stated.value * factor, stated.value))
        })
    });
    for (stated, value) in candidates.filter(|(_, value)| *value > 0.0) {
        let text = format!("{} {}", show(value), stated.unit);
        if works(&[(stated.span, text.clone())]) {
            let mut diagnostic = diagnostic;
            diagnostic.help.clear();
            return diagnostic.fix(format!("use `{} = {text}`", stated.field), stated.span, text);
        }
    }
    diagnostic
}

#[cfg(test)]
mod tests {
    use super::*;
    use vcutc_backend_api::backend::Exceeded;

    #[test]
    fn a_factor_leads_into_the_range() {
        let of = |value: f64| {
            let (least, most) = (0.05, 99_999.0);
            Exceeded { value, least, most }.factor()
        };
        assert_eq!(of(0.025), Some(2.0));
        assert_eq!(of(199_998.0), Some(0.5));
        assert_eq!(of(0.0), None);
    }

    #[test]
    fn speeds_are_rounded_away_from_what_does_not_work() {
        assert_eq!(rounded(82.816, 40.0), 83.0);
        assert_eq!(rounded(82.816, 100.0), 82.0);
        assert_eq!(rounded(0.12345, 1.0), 0.123);
        assert_eq!(rounded(83.0, 40.0), 83.0, "a round number stays");
    }
}
