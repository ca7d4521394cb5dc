//! Tips offset against the forces of the blade (`compensate = forces`).
//!
//! A program is planned, proven and carried out first. What its flanks yield then decides the offsets of its tips, and the program that
//! comes of that is the one that is written. It is proven twice: with its flanks where they are under load, which is where they were
//! planned, and as it is written, where it must stay out of the part whatever of the forces pushes it.

use super::dynamics;
use super::reaching::CarriedOut;
use super::refusal::{NotCarriedOut, NotTaken, Refused};
use super::routes::{Ended, Made, along_its_routes};
use super::{Run, Stage, compiled, internal, reaching, rules_broken};
use std::collections::BTreeMap;
use vcutc_backend_api::ir::OperationId;
use vcutc_backend_api::units::Length;
use vcutc_cancellation::Wanted;
use vcutc_diagnostics::number::show;
use vcutc_diagnostics::source::{SourceMap, Span};
use vcutc_diagnostics::{Code, Diagnostic, has_errors};
use vcutc_dynamics::deviation::figures::millimetres;
use vcutc_dynamics::deviation::verdict::{Needs, not_known, without_machine};
use vcutc_job::{CheckedJob, PlannedJob};
use vcutc_motion::solve::Changes;
use vcutc_process::verdict::{self, Proven, unloaded};
use vcutc_simulation::prove::{CutFault, Finding};

/// How far the flanks of compensated operations may be pushed into the part at most.
type Yields = BTreeMap<OperationId, Length>;

/// The result of a checked job, where it is not known yet, with its tips offset where it asks for that.
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

/// Offsets the tips of a compiled job, where it asks for that.
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
    let (plan, yields) = match with_offsets(&made, job, &asked) {
        Ok(offset) => offset,
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
    let refusal = needs_more_edge(job, &plan, &proven).or_else(|| enters_part(job, &plan, &proven, &yields));
    if let Some(why) = refusal {
        return refused(plan, made.warnings, why);
    }
    // The plan was proven before, so only errors are new.
    let diagnostics = verdict::diagnose_while(job, &plan, &proven, &Wanted::never(), &mut |_| false);
    if has_errors(&diagnostics) {
        return Ended::Refused(Refused::Unsound(Box::new(plan), Box::new(proven)));
    }
    match reaching::reach(job, proven.program, Changes::InTheAir, run, progress) {
        Ok(CarriedOut { program, .. }) => {
            let not_followed = made.compiled.not_followed;
            let mut compiled = compiled(job, program, &plan, proven.report, sources);
            compiled.not_followed = not_followed;
            Ended::Compiled(Made {
                plan: Box::new(plan),
                warnings: made.warnings,
                compiled: Box::new(compiled),
                slowed: None,
            })
        }
        Err(_) if run.wanted.is_needless() => Ended::Cancelled,
        Err(unreached) => Ended::Refused(Refused::Unreached(Box::new(NotCarriedOut {
            plan,
            warnings: made.warnings,
            unreached,
            cut_short: None,
        }))),
    }
}

fn refused<'j>(plan: PlannedJob, warnings: Vec<Diagnostic>, why: Diagnostic) -> Ended<'j> {
    Ended::Refused(Refused::ByTarget(Box::new(NotTaken {
        plan,
        warnings,
        objections: vec![why.into()],
    })))
}

/// The plan with the tips of these operations offset.
///
/// # Errors
/// Why they cannot be.
fn with_offsets(
    made: &Made,
    job: &CheckedJob,
    asked: &[(OperationId, Span)],
) -> Result<(PlannedJob, Yields), Box<Diagnostic>> {
    let carried = job.machine.as_ref().zip(made.compiled.program.reached());
    let (mut plan, mut yields) = ((*made.plan).clone(), Yields::new());
    for &(operation, span) in asked {
        let needs = Needs::compensation(span);
        let (machine, reached) = carried.ok_or_else(|| without_machine(needs))?;
        let report = &made.compiled.report;
        let found = dynamics::offset(job, machine, reached, report, operation);
        let offset = found.map_err(|why| not_known(why, needs, machine))?;
        if let Some(planned) = plan.operations.get_mut(usize::from(operation.0))
            && let Some(compensated) = planned.compensated(offset.by)
        {
            *planned = compensated;
            yields.insert(operation, offset.into_part);
        }
    }
    Ok((plan, yields))
}

/// A cut that needs more of the edge because its tip is offset.
fn needs_more_edge(job: &CheckedJob, plan: &PlannedJob, proven: &Proven) -> Option<Diagnostic> {
    let (_, finding) = proven.findings.not_freed?;
    let CutFault::NotFreed { needed, available } = finding.fault else {
        return None;
    };
    let what = format!(
        "{}, with its tip offset, may need {} mm of edge, and {} mm may be used",
        verdict::words::place(&finding),
        show((needed.to_mm() * 1000.0).ceil() / 1000.0),
        show(available.to_mm()),
    );
    Some(offset_too_far(job, plan, &finding, what)?.help("use a longer blade, or smaller layers"))
}

/// A cut that is offset into the part.
fn enters_part(job: &CheckedJob, plan: &PlannedJob, proven: &Proven, yields: &Yields) -> Option<Diagnostic> {
    let (finding, depth) = unloaded::entry(plan, &proven.program, yields)?;
    let operation = job.operations.get(usize::from(finding.operation.0))?;
    let what = format!(
        "{} would enter the part by up to {} where less pushes the blade",
        verdict::words::place(&finding),
        millimetres(depth.to_mm())
    );
    let diagnostic = offset_too_far(job, plan, &finding, what)?;
    Some(match operation.keeping_more(depth) {
        Some(more) if !more.edits.is_empty() => diagnostic.fix_all(more.advice, &more.edits),
        Some(_) => diagnostic.help("use a larger `allowance`, or smaller layers"),
        None => diagnostic.help("raise this tip, or use a shorter tool"),
    })
}

/// What is wrong with a cut whose tip is offset.
fn offset_too_far(
    job: &CheckedJob,
    plan: &PlannedJob,
    finding: &Finding,
    what: String,
) -> Option<Diagnostic> {
    let place = job
        .operations
        .get(usize::from(finding.operation.0))?
        .compensates()?;
    let by = plan.operation(finding.operation)?.bound().compensation?;
    let offset = by.offset((finding.layer, finding.cut));
    let size = millimetres(libm::hypot(offset.x, offset.z));
    let label = format!("offsets its tip by {size} against the forces");
    Some(Diagnostic::new(Code::NotCompensated, what, place, label))
}
