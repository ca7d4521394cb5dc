//! The proof of a plan's program, and what it found wrong in the user's words.
//!
//! A suggestion is only made after the job has been planned and proven again with it: what the help line offers works.

mod attempts;
mod bodies;
mod changes;
pub mod unloaded;

use crate::lower;
use crate::plan::plan_while;
use crate::tracks::proof::judged;
use crate::{clearing, slitting};
use attempts::Attempts;
pub use bodies::headline as body_in_work;
pub use changes::with_smaller_swing;
use vcutc_backend_api::ir::OperationId;
use vcutc_backend_api::units::{Duration, Length};
use vcutc_backend_api::verify::{Fault, VerifiedProgram, verify};
use vcutc_cancellation::{Effort, Wanted};
use vcutc_diagnostics::number::show;
use vcutc_diagnostics::source::{SourceMap, Span};
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_geometry::curve::Point2;
use vcutc_job::operation::{Operation, WorksThere};
use vcutc_job::planned::Balance;
use vcutc_job::search::{RouteSet, SearchSpace};
use vcutc_job::{CheckedJob, PlannedJob, PlannedOperation, Sourced};
use vcutc_simulation::body::{self, Bodies};
use vcutc_simulation::disc::{Hold, PassFault, Stretch};
use vcutc_simulation::prove::{self, Bound, ClearingFault, CutFault, Finding, Findings, Replay, SlitFault};
use vcutc_simulation::report::{Report, report};
use vcutc_simulation::timing::{timing, total};

/// A program with its proof, good or bad.
#[derive(Debug)]
pub struct Proven {
    /// The program.
    pub program: VerifiedProgram,
    /// What is wrong with its cuts.
    pub findings: Findings,
    /// How the bodies of its blades pass the work.
    pub bodies: Bodies,
    /// Its figures.
    pub report: Report,
}

impl Proven {
    /// Whether nothing is wrong.
    #[must_use]
    pub fn is_sound(&self) -> bool {
        self.findings == Findings::default() && self.bodies.contact.is_none()
    }
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
    let mut report = report(replay, plan.stock, &plan.profile, timing);
    let bodies = bodies(plan, &program);
    report.body = bodies.nearest;
    Ok(Proven {
        program,
        findings,
        bodies,
        report,
    })
}

/// How the bodies of a program's blades pass the work.
#[must_use]
pub fn bodies(plan: &PlannedJob, program: &VerifiedProgram) -> Bodies {
    body::bodies(program, &bounds(plan))
}

/// Replays the cuts of a program, each operation compared with what the plan keeps it out of.
#[must_use]
pub fn replay(plan: &PlannedJob, program: &VerifiedProgram) -> Replay {
    let bounds = bounds(plan);
    let mut replay = prove::replay(program, &bounds);
    if let Some(part) = &plan.surface {
        let (before, program) = (&replay.surface, program.program());
        replay.tracked = judged(part.surface(), before, program, &bounds, &mut replay.findings);
    }
    let (surface, findings) = (&mut replay.surface, &mut replay.findings);
    replay.cleared = clearing::judged(plan, surface, program.program(), findings);
    replay.slit = slitting::judged(plan, surface, program.program(), findings);
    replay
}

/// What each operation must stay out of.
#[must_use]
pub fn bounds(plan: &PlannedJob) -> Vec<Bound<'_>> {
    plan.operations.iter().map(|planned| planned.bound()).collect()
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
    let mut effort = Effort::OF_A_REFUSAL;
    let mut diagnostics: Vec<Diagnostic> = Vec::new();
    for (count, finding) in proven.findings.iter() {
        let Some(planned) = plan.operation(finding.operation) else {
            continue;
        };
        let mut trials = Attempts::new(job, wanted, finding.operation, &mut effort);
        diagnostics.push(planned.explain(finding, count, &mut trials, works_there));
    }
    if let Some(found) = proven.bodies.contact {
        let (_, contact) = found;
        let mut trials = Attempts::new(job, wanted, contact.passage.operation, &mut effort);
        diagnostics.extend(bodies::explained(plan, proven, found, &mut trials, works_there));
    }
    if diagnostics.is_empty()
        && let Some((operation, limit)) = scallop_excess(plan, &proven.report)
        && let Some(planned) = plan.operation(operation)
    {
        let found = over_limit(job, planned, limit, &proven.report);
        let mut trials = Attempts::new(job, wanted, operation, &mut effort);
        diagnostics.push(planned.help_with_scallop(found, &proven.report, &mut trials));
    }
    diagnostics.extend(plan.operations.iter().flat_map(|planned| planned.warnings()));
    diagnostics
}

/// More stays on the part than a limit on scallop allows.
fn over_limit(
    job: &CheckedJob,
    planned: &dyn PlannedOperation,
    limit: Sourced<Length>,
    report: &Report,
) -> Diagnostic {
    let (height, peak) = (show(report.scallop.height.to_mm()), report.scallop.peak);
    let headline = format!(
        "{height} mm of material remain on the part at x {} mm, the limit is {} mm",
        show(peak.x),
        show(limit.value.to_mm())
    );
    let span = limit.span.unwrap_or(planned.asked().setup().head_span);
    Diagnostic::new(Code::ScallopOverLimit, headline, span, "the limit").and(
        job.profile_span,
        format!(
            "the part lies {height} mm below the highest material, {}",
            point(peak)
        ),
    )
}

/// What is wrong with a cut, in words that fit any operation.
#[must_use]
pub fn explained(asked: &dyn Operation, finding: Finding) -> Diagnostic {
    let span = asked.setup().head_span;
    match finding.fault {
        CutFault::NotFreed { needed, .. } if !needed.is_finite() => Diagnostic::new(
            Code::ChipNotFreed,
            format!(
                "{} has one flank, and its tip lies in the material",
                place(&finding)
            ),
            span,
            "a cut of this operation",
        )
        .help("cut the other flank too, or begin at a wall or a side of the stock"),
        CutFault::NotFreed { needed, available } => Diagnostic::new(
            Code::ChipNotFreed,
            format!(
                "{} needs {} mm of edge, the blade has {} mm",
                place(&finding),
                show(needed.to_mm()),
                show(available.to_mm())
            ),
            span,
            "a cut of this operation",
        )
        .help("use a longer blade, or cut less deep"),
        CutFault::Blocked { at, by } => blocked(span, finding, at, by),
        CutFault::Overcut { at, depth } => overcut(asked, finding, at, depth),
        CutFault::Strays { y, by } => Diagnostic::new(
            Code::Internal,
            format!(
                "{} leaves its spine by {} mm, which is a fault of the compiler",
                place(&finding),
                show(by.to_mm())
            ),
            span,
            format!("at y {} mm", show(y.to_mm())),
        )
        .help("please report the job together with this message"),
        CutFault::Clearing(fault) => {
            let message = format!("at {}, {}", place(&finding), clearing_words(fault));
            let code = match fault {
                ClearingFault::Uncut { .. } => Code::PocketUncut,
                ClearingFault::Thick { .. } => Code::LayerTooThick,
                ClearingFault::Body { .. } => Code::BodyInWork,
                ClearingFault::Wall { .. } | ClearingFault::Floor { .. } => Code::Overcut,
                ClearingFault::Leans | ClearingFault::Engaged { .. } | ClearingFault::Undecided => {
                    Code::Internal
                }
            };
            Diagnostic::new(code, message, span, "a pass of this operation")
        }
        CutFault::Slit(fault) => {
            let message = format!("at {}, {}", place(&finding), slit_words(fault));
            let code = match fault {
                SlitFault::Wall { .. } | SlitFault::Floor { .. } => Code::Overcut,
                SlitFault::Edge { .. } => Code::LayerTooThick,
                SlitFault::Body { .. } => Code::BodyInWork,
                SlitFault::Stays { .. } => Code::WallLeft,
                SlitFault::Strays | SlitFault::Undecided => Code::Internal,
            };
            Diagnostic::new(code, message, span, "a slit of this operation")
        }
        CutFault::Stays { at, height, limit } => {
            let (what, label) = stays_words(at, height, limit);
            let place = place(&finding);
            Diagnostic::new(
                Code::ScallopOverLimit,
                format!("beside {place}, {what}"),
                span,
                label,
            )
        }
        CutFault::Strip(fault) => {
            let (what, label) = strip_words(fault);
            let message = format!("at {}, {what}", place(&finding));
            let code = match fault {
                PassFault::Body { .. } => Code::BodyInWork,
                PassFault::EntersPart { .. } => Code::Overcut,
                _ => Code::ChipNotFreed,
            };
            Diagnostic::new(code, message, span, label)
        }
    }
}

/// What is wrong with a slit along a wall, after "at layer 1, cut 2 (x 12 mm, y 40 mm, z 16 mm), ".
#[must_use]
pub fn slit_words(fault: SlitFault) -> String {
    let mm = |length: Length| show((length.to_mm() * 1e6).ceil() / 1e6);
    match fault {
        SlitFault::Wall { by } => format!("the blade enters a wall by {} mm", mm(by)),
        SlitFault::Floor { by } => format!("the blade goes below the floor by {} mm", mm(by)),
        SlitFault::Strays => "the blade goes neither along a wall nor straight down".to_owned(),
        SlitFault::Edge { needed, available } => {
            format!(
                "the blade needs {} mm of edge and has {} mm",
                mm(needed),
                mm(available)
            )
        }
        SlitFault::Body { above, by } => format!(
            "the body of the blade, from {} mm above its tip, is below the top of the stock by {} mm",
            mm(above),
            mm(by)
        ),
        SlitFault::Stays { by, limit } if by.is_finite() => format!(
            "{} mm stay at the foot of the wall, the limit is {} mm",
            show((by.to_mm() * 1e3).ceil() / 1e3),
            show(limit.to_mm())
        ),
        SlitFault::Stays { .. } => "no slit reaches the floor".to_owned(),
        SlitFault::Undecided => "the walls are too many to say what stays at their foot".to_owned(),
    }
}

/// What is wrong with a pass over a region, after "at layer 2, cut 1 (x 12 mm, y 40 mm, z 16 mm), ".
#[must_use]
pub fn clearing_words(fault: ClearingFault) -> String {
    let mm = |length: Length| show((length.to_mm() * 1e6).ceil() / 1e6);
    match fault {
        ClearingFault::Wall { by } => format!("the tool enters a wall by {} mm", mm(by)),
        ClearingFault::Floor { by } => format!("the tool goes below the floor by {} mm", mm(by)),
        ClearingFault::Leans => "the tool does not stand upright".to_owned(),
        ClearingFault::Thick { layer, limit } => format!(
            "a layer is {} mm thick, and the tool cuts {} mm",
            mm(layer),
            mm(limit)
        ),
        ClearingFault::Body { above, by } => format!(
            "the body of the tool, from {} mm above its edge, meets a wall by {} mm",
            mm(above),
            mm(by)
        ),
        ClearingFault::Uncut {
            area, widest, limit, ..
        } => format!(
            "{} mm2 stay uncut in places up to {} mm wide, the limit is {} mm2",
            show((area.to_mm2() * 10.0).ceil() / 10.0),
            show((widest.to_mm() * 100.0).ceil() / 100.0),
            show(limit.to_mm2())
        ),
        ClearingFault::Engaged { angle, limit } => format!(
            "{} deg of the tool's rim are in the material, the limit is {} deg",
            show((angle.to_deg() * 10.0).ceil() / 10.0),
            show(limit.to_deg())
        ),
        ClearingFault::Undecided => {
            "the passes are too many or too entangled to say what they clear".to_owned()
        }
    }
}

/// What is wrong with a pass of a disc, after "at layer 2, cut 3, ", and a label for the operation.
#[must_use]
pub fn strip_words(fault: PassFault) -> (String, String) {
    let mm = |length: Length| show(length.to_mm());
    let over = |stretch: Stretch| format!("x {} mm to {} mm", show(stretch.from), show(stretch.to));
    match fault {
        PassFault::Attached { stretch, hold } => (
            format!("the strip from {} stays attached", over(stretch)),
            match hold {
                Hold::SlitShort { x, above } => {
                    format!(
                        "its slit ends {} mm above the floor at x {} mm",
                        mm(above),
                        show(x)
                    )
                }
                Hold::RimShort { x, by } => {
                    format!(
                        "the rim of the disc ends {} mm before its slit at x {} mm",
                        mm(by),
                        show(x)
                    )
                }
                Hold::Buried { missing } => format!(
                    "the rim of the disc ends {} mm below the surface beside it",
                    mm(missing)
                ),
                Hold::Closed => "no side of it is open".to_owned(),
            },
        ),
        PassFault::Meets(stretch) => (
            "the disc meets more than its strip".to_owned(),
            format!(
                "material up to {} mm above it from {}",
                mm(stretch.height),
                over(stretch)
            ),
        ),
        PassFault::EntersPart { at, depth } => (
            format!("the disc enters the part by {} mm", mm(depth)),
            format!("deepest at {}", point(at)),
        ),
        PassFault::Body { at, depth, .. } => (
            format!("the body of the disc meets the stock by {} mm", mm(depth)),
            format!("deepest at {}", point(at)),
        ),
        PassFault::TooThick { stretch, limit } => (
            format!(
                "the strip is {} mm thick, the disc takes {} mm",
                mm(stretch.height),
                mm(limit)
            ),
            format!("from {}", over(stretch)),
        ),
        PassFault::OverBody { stretch, limit } => (
            format!(
                "a strip of {} mm runs over the body of the disc, which has room for {} mm",
                mm(stretch.height),
                mm(limit)
            ),
            format!("from {}", over(stretch)),
        ),
        PassFault::TooWide {
            stretch,
            width,
            limit,
        } => (
            format!(
                "the strip is {} mm wide, the disc takes {} mm",
                mm(width),
                mm(limit)
            ),
            format!("from {}", over(stretch)),
        ),
    }
}

/// What stays beside a track, after "beside layer 1, track 3, ", and a label.
#[must_use]
pub fn stays_words(at: Point2, height: Length, limit: Length) -> (String, String) {
    let rounded = Length::mm((height.to_mm() * 1e4).ceil() / 1e4);
    (
        format!(
            "{} mm of material stay on the part, the limit is {} mm",
            show(rounded.to_mm()),
            show(limit.to_mm())
        ),
        format!("the most at {}", point(at)),
    )
}

/// A cut whose flank uncut material stands above; the label is at a span.
#[must_use]
pub fn blocked(span: Span, finding: Finding, at: Point2, by: Length) -> Diagnostic {
    Diagnostic::new(
        Code::BladeBlocked,
        format!(
            "above {}, {} mm of uncut material is in the way of the blade",
            place(&finding),
            show(by.to_mm())
        ),
        span,
        format!("the blade meets it at {}", point(at)),
    )
}

/// A cut that enters the part.
#[must_use]
pub fn overcut(asked: &dyn Operation, finding: Finding, at: Point2, depth: Length) -> Diagnostic {
    Diagnostic::new(
        Code::Overcut,
        format!(
            "{} enters the part by {} mm",
            place(&finding),
            show(depth.to_mm())
        ),
        asked.setup().head_span,
        format!("deepest at {}", point(at)),
    )
    .note("the planner keeps every cut out of the part, so this is a fault of the compiler: please report it")
}

/// `layer 7, cut 12 (x 43.2 mm, z 18.6 mm)`.
#[must_use]
pub fn place(finding: &Finding) -> String {
    let (layer, kind, cut) = (finding.layer, finding.kind.noun(), finding.cut);
    let tip = finding.tip;
    match finding.y {
        None => format!("layer {layer}, {kind} {cut} ({})", point(tip)),
        Some(y) => format!(
            "layer {layer}, {kind} {cut} (x {} mm, y {} mm, z {} mm)",
            show(tip.x),
            show(y),
            show(tip.z)
        ),
    }
}

/// `x 43.2 mm, z 18.6 mm`.
#[must_use]
pub fn point(point: Point2) -> String {
    format!("x {} mm, z {} mm", show(point.x), show(point.z))
}

/// Compiles a changed job, as far as its machine; none where it has errors.
pub type Compile<'c> = dyn Fn(&CheckedJob) -> Option<(PlannedJob, Report)> + 'c;

/// The warning that much of what is to be cut away stays, if it does. What it offers was compiled.
#[must_use]
pub fn much_stays(
    job: &CheckedJob,
    plan: &PlannedJob,
    report: &Report,
    compile: &Compile<'_>,
) -> Option<Diagnostic> {
    let balance = Balance::of(plan, report)?;
    let planned = plan.operation(balance.operation)?;
    planned.explain_what_stays(balance, &|change| {
        compile(&attempts::changed(job, balance.operation, change)?)
    })
}

/// The limits on time and cuts that a plan breaks, which was made without them, with what the plan keeps.
#[must_use]
pub fn broken_limits(job: &CheckedJob, plan: &PlannedJob) -> Vec<Diagnostic> {
    limits_broken_by(job, plan, |_| Duration::ZERO)
}

/// The same of a plan whose operations take so much longer than by themselves.
#[must_use]
pub fn limits_broken_by(
    job: &CheckedJob,
    plan: &PlannedJob,
    longer: impl Fn(OperationId) -> Duration,
) -> Vec<Diagnostic> {
    let operations = job.operations.iter().zip(&plan.operations);
    (0..)
        .map(OperationId)
        .zip(operations)
        .filter_map(|(operation, (asked, planned))| {
            planned.broken_limits(&**asked, time_alone(job, &**planned)? + longer(operation))
        })
        .collect()
}

/// How long an operation takes by itself; none where the compiler is at fault, which the proof of the whole then shows.
fn time_alone(job: &CheckedJob, planned: &dyn PlannedOperation) -> Option<Duration> {
    let program = verify(lower::alone(job, planned)).ok()?;
    Some(total(&program))
}

/// The plan and proof of a job that has nothing wrong with its cuts, along the route that any machine follows best, as the
/// compiler takes it when the machine follows no other. None for who no longer wants it.
#[must_use]
pub fn sound(job: &CheckedJob, wanted: &Wanted) -> Option<(PlannedJob, Proven)> {
    planned_and_proven(job, wanted, RouteSet::RowsByPoint)
        .filter(|(plan, proven)| scallop_excess(plan, &proven.report).is_none())
}

/// The plan and proof of a job in which nothing is wrong. None for who no longer wants it.
fn planned_and_proven(job: &CheckedJob, wanted: &Wanted, routes: RouteSet) -> Option<(PlannedJob, Proven)> {
    let plan = || plan_while(job, SearchSpace::along(routes), wanted);
    let plan = wanted.answer(plan).ok()?.ok()?;
    let proven = prove(&plan, &SourceMap::default()).ok()?;
    proven.is_sound().then_some((plan, proven))
}

/// The operation with the tightest scallop limit, if the machined contour is above it.
#[must_use]
pub fn scallop_excess(plan: &PlannedJob, report: &Report) -> Option<(OperationId, Sourced<Length>)> {
    let tightest = plan.scallop_limit()?;
    // The search for the highest point works in floating point; a micrometre over the limit is no excess.
    (report.scallop.height > tightest.1.value + Length::mm(1e-3)).then_some(tightest)
}
