//! Changes of an operation, each tried before it is offered: planned and proven again, and within reach of the machine.

use vcutc_backend_api::units::Angle;
use vcutc_diagnostics::Diagnostic;
use vcutc_diagnostics::number::show;
use vcutc_job::operation::{Operation, Trials, Variant, Variation, WorksThere};
use vcutc_job::{Auto, PlannedOperation};

/// By how many degrees the swing is made smaller, one after the other.
const SMALLER: [f64; 9] = [2.0, 5.0, 10.0, 15.0, 20.0, 25.0, 30.0, 35.0, 40.0];

/// How often the gap between a swing that works and one that does not is halved.
const HALVINGS: usize = 3;

/// By how many degrees the rake is made steeper, one after the other.
const STEEPER: [f64; 4] = [5.0, 10.0, 15.0, 20.0];

/// Offers the widest swing below the planned one that works, of those that are tried.
#[must_use]
pub fn with_smaller_swing(
    diagnostic: Diagnostic,
    planned: &dyn PlannedOperation,
    trials: &mut dyn Trials,
    works_there: &mut WorksThere<'_>,
) -> Diagnostic {
    let mut tried = |swing: f64| {
        planned.asked().at_swing(Angle::deg(swing)).filter(|variant| {
            trials.proves(&|operation| operation.assign(&*variant.operation))
                && (variant.edits.is_empty() || works_there(&variant.edits))
        })
    };
    match widest_swing(planned.swing().to_deg().ceil(), &mut tried) {
        Some(variant) if variant.edits.is_empty() => diagnostic.help(variant.advice),
        Some(variant) => diagnostic.fix_all(variant.advice, &variant.edits),
        None => diagnostic,
    }
}

pub(super) fn with_narrower_flanks(
    diagnostic: Diagnostic,
    planned: &dyn PlannedOperation,
    trials: &mut dyn Trials,
    works_there: &mut WorksThere<'_>,
) -> Diagnostic {
    let variants = planned.asked().variants(planned, Variation::NarrowerFlanks);
    let works = variants.into_iter().find(|variant| {
        !variant.edits.is_empty()
            && trials.proves(&|operation| operation.assign(&*variant.operation))
            && works_there(&variant.edits)
    });
    match works {
        Some(variant) => diagnostic.fix_all(variant.advice, &variant.edits),
        None => diagnostic,
    }
}

/// The widest swing below this one that works, of those that are tried: in whole degrees.
fn widest_swing(now: f64, tried: &mut dyn FnMut(f64) -> Option<Variant>) -> Option<Variant> {
    let mut fails = now;
    let swings = SMALLER.map(|less| now - less).into_iter();
    let (mut works, mut widest) = swings.take_while(|&swing| swing > 0.0).find_map(|swing| {
        let found = tried(swing);
        if found.is_none() {
            fails = swing;
        }
        found.map(|variant| (swing, variant))
    })?;
    for _ in 0..HALVINGS {
        let between = f64::midpoint(works, fails).floor();
        if between <= works {
            break;
        }
        match tried(between) {
            Some(wider) => (works, widest) = (between, wider),
            None => fails = between,
        }
    }
    Some(widest)
}

/// Offers the extension that the compiler chooses, where the job gives one and the chosen one works.
pub(super) fn with_chosen_extension(
    diagnostic: Diagnostic,
    asked: &dyn Operation,
    trials: &mut dyn Trials,
    works_there: &mut WorksThere<'_>,
) -> Diagnostic {
    let given = asked.setup().extension();
    let (Auto::Given(_), Some(span)) = (given.value, given.span) else {
        return diagnostic;
    };
    let open = |operation: &mut dyn Operation| {
        if let Some(extension) = &mut operation.setup_mut().extension {
            extension.value = Auto::Auto;
        }
    };
    let works = trials.proves(&open) && works_there(&[(span, "auto".to_owned())]);
    if works {
        diagnostic.fix("let the compiler choose the `extension`: `auto`", span, "auto")
    } else {
        diagnostic
    }
}

pub(super) fn with_steeper_rake(
    diagnostic: Diagnostic,
    asked: &dyn Operation,
    trials: &mut dyn Trials,
    works_there: &mut WorksThere<'_>,
) -> Diagnostic {
    let rake = asked.setup().rake;
    let Some(span) = rake.span else {
        return diagnostic;
    };
    let rakes = STEEPER.map(|more| Angle::deg(rake.value.to_deg().round() + more));
    let text = |rake: Angle| format!("{} deg", show(rake.to_deg()));
    let works = rakes
        .into_iter()
        .filter(|steeper| steeper.to_deg() <= 90.0)
        .find(|&steeper| {
            trials.proves(&|operation| operation.setup_mut().rake.value = steeper)
                && works_there(&[(span, text(steeper))])
        });
    match works {
        Some(rake) => diagnostic.fix(format!("use a `rake` of {}", text(rake)), span, text(rake)),
        None => diagnostic,
    }
}
