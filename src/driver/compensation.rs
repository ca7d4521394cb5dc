//! Tips set off against the forces of the blade (`compensate = forces`).
//!
//! A program is planned, proven and carried out first. What its flanks yield then sets their tips off, and the program that comes of
//! that is the one that is written. It is proven twice: as it cuts under load, which is what was planned, and as it is written, which is
//! how the blade goes where nothing pushes it.

use super::dynamics;
use super::refusal::{NotCarriedOut, NotTaken, Refused};
use super::routes::{Ended, Made, along_its_routes};
use super::{Run, Stage, compiled, internal, reaching, rules_broken};
use vcutc_backend_api::ir::OperationId;
use vcutc_cancellation::Wanted;
use vcutc_diagnostics::source::{SourceMap, Span};
use vcutc_diagnostics::{Code, Diagnostic, has_errors};
use vcutc_dynamics::deviation::figures::millimetres;
use vcutc_dynamics::deviation::verdict::{Needs, not_known, without_machine};
use vcutc_job::{CheckedJob, PlannedJob};
use vcutc_motion::solve::Changes;
use vcutc_process::verdict::{self, Proven, unloaded};

/// What came of a checked job, where it is not known yet, with its tips set off where it asks for that.
pub(super) fn ended<'j>(
    known: Option<Made>,
    job: &'j CheckedJob,
    sources: &SourceMap,
    run: &mut Run<'_>,
    progress: &mut dyn FnMut(Stage),
) -> Ended<'j> {
    let ended = match known {
        Some(made) => Ended::Compiled(made),
        None => along_its_routes(job, sources, run, progress),
    };
    match ended {
        Ended::Compiled(made) => compensated(made, job, sources, run, progress),
        ended @ (Ended::Refused(_) | Ended::Cancelled) => ended,
    }
}

/// Sets the tips of a compiled job off, where it asks for that.
fn compensated<'j>(
    made: Made,
    job: &'j CheckedJob,
    sources: &SourceMap,
    run: &mut Run<'_>,
    progress: &mut dyn FnMut(Stage),
) -> Ended<'j> {
    let operations = (0..).map(OperationId).zip(&job.operations);
    let asked: Vec<(OperationId, Span)> = operations
        .filter_map(|(id, operation)| Some((id, operation.compensates()?)))
        .collect();
    if asked.is_empty() {
        return Ended::Compiled(made);
    }
    let plan = match set_off(&made, job, &asked) {
        Ok(plan) => plan,
        Err(why) => return refused(*made.plan, made.warnings, *why),
    };
    progress(Stage::Proving);
    let proven = match verdict::prove(&plan, sources) {
        Ok(proven) => proven,
        Err(faults) => {
            let fault = internal(job, &rules_broken(&faults));
            return Ended::Refused(Refused::Broken(Box::new(plan), Box::new(fault)));
        }
    };
    let warnings = verdict::diagnose_while(job, &plan, &proven, &Wanted::never(), &mut |_| false);
    if has_errors(&warnings) {
        return Ended::Refused(Refused::Unsound(Box::new(plan), Box::new(proven)));
    }
    if let Some(why) = enters_part(job, &plan, &proven) {
        return refused(plan, warnings, why);
    }
    match reaching::reach(job, proven.program, Changes::InTheAir, run, progress) {
        Ok(program) => {
            let not_followed = made.compiled.not_followed;
            let mut compiled = compiled(job, program, &plan, proven.report, sources);
            compiled.not_followed = not_followed;
            Ended::Compiled(Made {
                plan: Box::new(plan),
                warnings: made.warnings,
                compiled: Box::new(compiled),
            })
        }
        Err(_) if run.wanted.is_needless() => Ended::Cancelled,
        Err(unreached) => Ended::Refused(Refused::Unreached(Box::new(NotCarriedOut {
            plan,
            told: warnings,
            unreached,
            cut_short: None,
        }))),
    }
}

fn refused<'j>(plan: PlannedJob, told: Vec<Diagnostic>, why: Diagnostic) -> Ended<'j> {
    Ended::Refused(Refused::ByTarget(Box::new(NotTaken {
        plan,
        told,
        objections: vec![why.into()],
    })))
}

/// The plan with the tips of these operations set off.
///
/// # Errors
/// Why they cannot be.
fn set_off(
    made: &Made,
    job: &CheckedJob,
    asked: &[(OperationId, Span)],
) -> Result<PlannedJob, Box<Diagnostic>> {
    let carried = job.machine.as_ref().zip(made.compiled.program.reached());
    let mut plan = (*made.plan).clone();
    for &(operation, span) in asked {
        let needs = Needs::compensation(span);
        let (machine, reached) = carried.ok_or_else(|| without_machine(needs))?;
        let report = &made.compiled.report;
        let found = dynamics::compensation(job, machine, reached, report, operation);
        let by = found.map_err(|why| not_known(why, needs, machine))?;
        if let Some(planned) = plan.operations.get_mut(usize::from(operation.0))
            && let Some(compensated) = planned.compensated(by)
        {
            *planned = compensated;
        }
    }
    Ok(plan)
}

/// A cut that is set off into the part.
fn enters_part(job: &CheckedJob, plan: &PlannedJob, proven: &Proven) -> Option<Diagnostic> {
    let (finding, depth) = unloaded::entry(plan, &proven.program)?;
    let operation = job.operations.get(usize::from(finding.operation.0))?;
    let place = operation.compensates()?;
    let by = plan.operation(finding.operation)?.bound().compensation?;
    let offset = by.offset((finding.layer, finding.cut));
    let set_off = libm::hypot(offset.x, offset.z);
    let diagnostic = Diagnostic::new(
        Code::NotCompensated,
        format!(
            "{} would enter the part by {} where nothing pushes the blade",
            verdict::place(&finding),
            millimetres(depth.to_mm())
        ),
        place,
        format!("sets its tip off by {} against the forces", millimetres(set_off)),
    );
    let diagnostic = diagnostic.help("use a larger `allowance`, or smaller layers");
    Some(match operation.keeping_more(depth) {
        Some(more) if !more.edits.is_empty() => diagnostic.fix_all(more.advice, &more.edits),
        Some(_) | None => diagnostic,
    })
}
