//! What a proof found wrong, in the user's words, and which change would mend it.
//!
//! A suggestion is only made after the job has been planned and proven again with it: what the help line offers works.

mod attempts;
mod chips;
mod given;
mod scallop;
mod stays;

pub use stays::{Compile, much_stays};

use crate::choice::{Effort, Latitude, WorksThere};
use crate::lower;
use crate::plan::parameters::show;
use crate::plan::{self, PlannedJob, PlannedOperation, PlannedVcut};
use crate::sim::prove::{self, Bound, CutFault, Finding, Findings, Release, Replay};
use crate::sim::report::{Report, report};
use crate::sim::surface::Surface;
use crate::sim::timing::timing;
use attempts::{Attempts, Case};
use chips::Remedy;
use vcutc_backend_api::ir::OperationId;
use vcutc_backend_api::units::Length;
use vcutc_backend_api::verify::{Fault, VerifiedProgram, verify};
use vcutc_cancellation::Wanted;
use vcutc_diagnostics::source::{SourceMap, Span};
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_geometry::curve::Point2;
use vcutc_job::{CheckedJob, RoughVcut};

/// A program with its proof, good or bad.
#[derive(Debug)]
pub struct Proven {
    /// The program.
    pub program: VerifiedProgram,
    /// What is wrong with its cuts.
    pub findings: Findings,
    /// Its figures.
    pub report: Report,
}

/// Writes a plan down as a program and proves it.
///
/// # Errors
/// When the program breaks a rule of the IR, which is a fault of the compiler.
pub fn prove(plan: &PlannedJob, sources: &SourceMap) -> Result<Proven, Vec<Fault>> {
    let program = verify(lower::lower(plan, sources))?;
    let replay = replay(plan, &program);
    let findings = replay.findings.clone();
    let timing = timing(&program);
    let report = report(replay, plan.stock, &plan.profile, timing);
    Ok(Proven {
        program,
        findings,
        report,
    })
}

/// Replays the cuts of a program, each operation held against what the plan keeps it out of.
#[must_use]
pub fn replay(plan: &PlannedJob, program: &VerifiedProgram) -> Replay {
    prove::replay(program, &bounds(plan))
}

/// As [`replay`], and shows the surface before each V is released from it.
#[must_use]
pub fn watched(
    plan: &PlannedJob,
    program: &VerifiedProgram,
    watch: &mut dyn FnMut(&mut Surface, Release),
) -> Replay {
    prove::watched(program, &bounds(plan), watch)
}

/// What each operation must stay out of.
#[must_use]
pub fn bounds(plan: &PlannedJob) -> Vec<Bound<'_>> {
    let operations = plan.operations.iter();
    operations
        .map(|operation| match operation {
            PlannedOperation::RoughVcut(vcut) => Bound {
                part: &vcut.bound,
                drop: vcut.parameters.drop,
                edge: vcut.asked.limits.edge.map(|limit| limit.value),
            },
        })
        .collect()
}

/// Puts everything that is wrong with a proven program into words.
#[must_use]
pub fn diagnose(job: &CheckedJob, plan: &PlannedJob, proven: &Proven) -> Vec<Diagnostic> {
    diagnose_while(job, plan, proven, &Wanted::ALWAYS, &mut |_| true)
}

/// As [`diagnose`] while that is wanted: no more changes are tried afterwards, which may then be missing ([`Wanted::answer`]).
/// Of the values that prove, one is offered with which those who come after planning agree.
#[must_use]
pub fn diagnose_while(
    job: &CheckedJob,
    plan: &PlannedJob,
    proven: &Proven,
    wanted: &Wanted,
    works_there: &mut WorksThere<'_>,
) -> Vec<Diagnostic> {
    let case = Case { job, wanted };
    let mut effort = Effort::OF_A_REFUSAL;
    let mut diagnostics: Vec<Diagnostic> = proven
        .findings
        .iter()
        .filter_map(|(count, finding)| {
            let PlannedOperation::RoughVcut(vcut) = plan.operations.get(usize::from(finding.operation.0))?;
            Some(match finding.fault {
                CutFault::NotFreed { needed, available } => {
                    let chips = Chips {
                        finding,
                        count,
                        needed,
                        available,
                    };
                    not_freed(
                        &mut Attempts::new(case, finding.operation, &mut effort),
                        vcut,
                        chips,
                        works_there,
                    )
                }
                CutFault::Blocked { at } => blocked(&vcut.asked, finding, at),
                CutFault::Overcut { at, depth } => overcut(&vcut.asked, finding, at, depth),
            })
        })
        .collect();
    if diagnostics.is_empty() {
        diagnostics.extend(scallop::over_limit(case, plan, &proven.report, &mut effort));
    }
    diagnostics.extend(plan.operations.iter().filter_map(|operation| {
        let PlannedOperation::RoughVcut(vcut) = operation;
        plan::given::idle(vcut.course.as_ref()?, vcut.asked.tips.as_ref()?)
    }));
    diagnostics
}

fn blocked(asked: &RoughVcut, finding: Finding, at: Point2) -> Diagnostic {
    Diagnostic::new(
        Code::BladeBlocked,
        format!(
            "above {}, uncut material is in the way of the blade",
            place(&finding)
        ),
        asked.swing.span.unwrap_or(asked.head_span),
        format!("the blade meets material at {}", point(at.x, at.z)),
    )
    .note("an operation before this one left walls steeper than this operation's flanks")
    .help("give both operations the same `swing`, or let this one come first")
}

fn overcut(asked: &RoughVcut, finding: Finding, at: Point2, depth: Length) -> Diagnostic {
    Diagnostic::new(
        Code::Overcut,
        format!(
            "{} enters the part by {} mm",
            place(&finding),
            show(depth.to_mm())
        ),
        asked.head_span,
        format!("deepest at {}", point(at.x, at.z)),
    )
    .note("the planner keeps every cut out of the part, so this is a fault of the compiler: please report it")
}

/// `layer 7, cut 12 (x 43.2 mm, z 18.6 mm)`.
fn place(finding: &Finding) -> String {
    format!(
        "layer {}, cut {} ({})",
        finding.layer,
        finding.cut,
        point(finding.tip.x, finding.tip.z)
    )
}

fn point(x: f64, z: f64) -> String {
    format!("x {} mm, z {} mm", show(x), show(z))
}

/// Chips that are not cut free: the one that needs the longest edge, and how many there are.
#[derive(Clone, Copy)]
struct Chips {
    finding: Finding,
    count: usize,
    needed: Length,
    available: Length,
}

fn not_freed(
    attempts: &mut Attempts<'_>,
    vcut: &PlannedVcut,
    chips: Chips,
    works_there: &mut WorksThere<'_>,
) -> Diagnostic {
    let Chips {
        finding,
        count,
        needed,
        available,
    } = chips;
    let asked = &vcut.asked;
    if let Some(tips) = &asked.tips {
        return given::not_freed(
            attempts.case(),
            (asked, tips),
            finding,
            count,
            [needed, available],
        );
    }
    let edge = UsableEdge::of(asked, available);
    // Rounded up: 10.003 mm is not 10 mm.
    let needed = show((needed.to_mm() * 1000.0).ceil() / 1000.0);
    let layer = show(vcut.parameters.layer.to_mm());
    let remedy = chips::remedy(attempts, vcut, works_there);
    let (span, label) = match (&remedy, asked.step.span, asked.layer.span) {
        (Some(Remedy::Step(_) | Remedy::OpenStep), Some(span), _) => (
            span,
            format!("with this step, the blade cannot cut layers of {layer} mm free"),
        ),
        (_, _, Some(span)) => (
            span,
            format!("layers of {layer} mm are deeper than this blade can cut free"),
        ),
        (_, Some(span), None) => (
            span,
            format!("with this step, layers of {layer} mm are deeper than this blade can cut free"),
        ),
        (_, None, None) => (
            asked.head_span,
            format!("with layers of {layer} mm this chip is not cut free"),
        ),
    };
    let (has, than) = (&edge.has, edge.than);
    let headline = format!("{} needs {needed} mm of edge, {has}", place(&finding));
    let mut diagnostic =
        Diagnostic::new(Code::ChipNotFreed, headline, span, label).and(edge.span, edge.label.clone());
    match count {
        0 | 1 => {}
        2 => diagnostic = diagnostic.note(format!("one more cut needs more edge than {than}")),
        _ => {
            let others = count - 1;
            diagnostic = diagnostic.note(format!("{others} more cuts need more edge than {than}"));
        }
    }
    match remedy {
        Some(Remedy::Step(step)) => {
            let value = format!("{} mm", show(step.to_mm()));
            let advice = format!("use a `step` of {value} with these layers");
            match asked.step.span {
                Some(span) => diagnostic.fix(advice, span, value),
                None => diagnostic.help(advice),
            }
        }
        Some(Remedy::OpenStep) => match asked.step.span {
            Some(span) => diagnostic.fix("let the compiler choose the step: `auto`", span, "auto"),
            None => diagnostic.help("leave the `step` `auto`"),
        },
        Some(Remedy::Layer(layer)) => {
            let value = chips::written(layer);
            let advice = format!("use a `layer` of {value}");
            match asked.layer.span {
                Some(span) => diagnostic.fix(advice, span, value),
                None => diagnostic.help(advice),
            }
        }
        Some(Remedy::ResidualMixed) => {
            let diagnostic = diagnostic.note(
                "cuts dropped, raised or moved to clear the part left more material than the lattice assumes",
            );
            match asked.residual.span {
                Some(span) => diagnostic.fix(
                    "let the compiler fix such cuts: `residual = mixed`",
                    span,
                    "mixed",
                ),
                None => diagnostic.help("add `residual = mixed`, which fixes such cuts"),
            }
        }
        Some(Remedy::Opened(offer)) => diagnostic.fix_all(offer.title, &offer.edits),
        None => diagnostic.help("use a longer blade, a smaller `swing` or a smaller `step`"),
    }
}

/// What the edge of a cut is held against: the blade's, or the limit on it.
struct UsableEdge {
    span: Span,
    /// In a sentence: `the blade has 10 mm`.
    has: String,
    /// After `more edge than`.
    than: &'static str,
    label: String,
}

impl UsableEdge {
    fn of(asked: &RoughVcut, available: Length) -> Self {
        let (blade, length) = (&asked.blade, show(available.to_mm()));
        match asked.limits.edge {
            Some(limit) if limit.value < blade.cutting_length.value => Self {
                span: limit.span.unwrap_or(asked.head_span),
                has: format!("the limit is {length} mm"),
                than: "the limit allows",
                label: "the limit".to_owned(),
            },
            Some(_) | None => Self {
                span: blade.cutting_length.span.unwrap_or(blade.span),
                has: format!("the blade has {length} mm"),
                than: "the blade has",
                label: format!("{length} mm of edge"),
            },
        }
    }
}

/// The plan and proof of a job that has nothing wrong with its cuts, along the route that any machine follows best, as the
/// compiler takes it when the machine follows no other. None for who no longer wants it.
#[must_use]
pub fn sound(job: &CheckedJob, wanted: &Wanted) -> Option<(PlannedJob, Proven)> {
    attempts::planned_and_proven(Case { job, wanted }, Latitude::RowsByPoint)
        .filter(|(plan, proven)| scallop_excess(plan, &proven.report).is_none())
}

/// The operation with the tightest scallop limit, if the machined contour is above it.
pub fn scallop_excess<'p>(
    plan: &'p PlannedJob,
    report: &Report,
) -> Option<(OperationId, &'p RoughVcut, Length)> {
    let limits = (0..).zip(&plan.operations).filter_map(|(index, operation)| {
        let PlannedOperation::RoughVcut(vcut) = operation;
        let limit = vcut.asked.limits.scallop?;
        Some((OperationId(index), &vcut.asked, limit.value))
    });
    let tightest = limits.min_by(|(.., a), (.., b)| a.total_cmp(b))?;
    // The search for the highest point works in floating point; a micrometre over the limit is no excess.
    (report.scallop.height > tightest.2 + Length::mm(1e-3)).then_some(tightest)
}
