//! What a proof found wrong with slits and strips, and that much stays, in the user's words.

use crate::asked::RoughRect;
use crate::decided::Planned;
use core::any::Any;
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::number::show;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_job::operation::Operation;
use vcutc_job::planned::{Balance, Compile};
use vcutc_process::verdict::words::{explained, place};
use vcutc_simulation::prove::{CutFault, Finding};

/// A slit that is still there when all strips are out.
fn idle(asked: &dyn Operation, finding: &Finding) -> Diagnostic {
    Diagnostic::new(
        Code::ChipNotFreed,
        format!("{} goes on below what its strips leave", place(finding)),
        asked.setup().head_span,
        "a slit of this operation",
    )
    .help("let the rim run farther beyond its slits, such as `beyond = 0.5 mm`")
}

/// Explains a slit or a strip; so many have the same fault. Plans are made so that none has: what a proof finds is between the plan
/// and the program.
pub(crate) fn explain(planned: &Planned, finding: Finding, count: usize) -> Diagnostic {
    let asked: &dyn Operation = &planned.asked;
    let diagnostic = match finding.fault {
        CutFault::NotFreed { needed, .. } if !needed.is_finite() => idle(asked, &finding),
        CutFault::NotFreed { .. }
        | CutFault::Blocked { .. }
        | CutFault::Overcut { .. }
        | CutFault::Strays { .. }
        | CutFault::Stays { .. }
        | CutFault::Clearing(_)
        | CutFault::Slit(_)
        | CutFault::Strip(_) => explained(asked, finding),
    };
    diagnostic.and_more(count, "the same holds for", ["slit or strip", "slits and strips"])
}

/// A share of the material to cut away that is much, where a body keeps it from being cut.
const MUCH: f64 = 0.1;

/// By how many mm the body of the straight blade is raised to see the effect.
const RAISED: [f64; 4] = [5.0, 10.0, 20.0, 40.0];

/// A change is offered if it leaves no more than this share of what stays now.
const WORTH: f64 = 0.8;

/// Warns where much stays because the body of the straight blade has no room beside slits. What it says of other bodies was planned.
pub(crate) fn much_stays(
    planned: &Planned,
    balance: Balance<'_>,
    compile: &Compile<'_>,
) -> Option<Diagnostic> {
    let asked = &planned.asked;
    let left_out = crate::words::left_out(asked, planned.plan.room.left_out())?;
    let (body, share) = (asked.blade.body.as_ref()?, balance.share());
    if share <= MUCH {
        return None;
    }
    let diagnostic = Diagnostic::new(
        Code::MuchStays,
        format!(
            "{:.0} % of the material to cut away stays: {:.0} of {:.0} mm2",
            share * 100.0,
            balance.stays().to_mm2(),
            balance.whole.to_mm2()
        ),
        body.span,
        "this body meets what stands beside slits",
    )
    .and(asked.setup.head_span, "strips of this operation")
    .note(left_out);
    let better = RAISED.iter().find_map(|&by| {
        let (plan, report) = compile(&|operation| raise(operation, Length::mm(by)))?;
        let then = Balance::of(&plan, &report)?.share();
        (then < WORTH * share).then_some((by, then))
    });
    Some(match better {
        Some((by, then)) => diagnostic.help(format!(
            "use a longer blade: with a body that begins {} mm higher, {:.0} % stay",
            show(by),
            then * 100.0
        )),
        None => diagnostic.help("use a longer blade, or one with a thinner shank"),
    })
}

/// Moves the body of the straight blade up its axis.
fn raise(operation: &mut dyn Operation, by: Length) {
    let operation: &mut dyn Any = operation;
    let stages = operation
        .downcast_mut::<RoughRect>()
        .and_then(|asked| asked.blade.body.as_mut())
        .map(|body| &mut body.stages);
    for stage in stages.into_iter().flatten() {
        stage.from.value += by;
    }
}
