//! `vcutc optimize`: what the open parameters of a job come out as, what else there would be, and what it would cost.
//!
//! The job is compiled. Then it is planned again with changes: each limit a tenth wider, other lattices, and a row of limits
//! of what time is traded against. Beside these plans stands what the formulas say of the problem
//! ([`vcutc_vcut::plan::optimum`]): on every lattice, by the paper's formulas and by the exact ones.

mod against;
mod bounds;
mod faster;
pub mod json;
mod loosened;
mod others;
mod planned;
mod rect;
pub mod report;
mod scallop;
mod table;
mod trade_off;
mod trials;
mod values;

pub use against::Against;
pub use bounds::Relaxed;
pub use faster::Faster;
pub use loosened::{Loosened, WiderLimits};
pub use others::OtherOperation;
pub use planned::{FoundBy, Planned};
pub use rect::RectOptimum;
pub use scallop::ScallopTradeOff;
pub use trade_off::{Point, TradeOff};
pub use trials::{Came, Plan};
pub use values::{OtherValue, OtherValues, ValueKind};

use trade_off::Question;
use trials::{Route, Subject, Trials};
use vcutc_backend_api::ir::OperationId;
use vcutc_backend_api::units::{Duration, Length};
use vcutc_diagnostics::Diagnostic;
use vcutc_diagnostics::source::SourceMap;
use vcutc_driver::ways::Comparison;
use vcutc_driver::{self as driver, Compiled, Outcome, Request, RequestError, Stage};
use vcutc_job::{Auto, CheckedJob, PlannedJob, PlanningJob};
use vcutc_picture::pareto::{self, Curve, Pareto};
use vcutc_vcut::PlannedVcut;
use vcutc_vcut::asked::{Formulas, Lattice, Objective, RoughVcut};
use vcutc_vcut::plan::optimum::{self, Optimum, Problem};
use vcutc_vcut::plan::parameters;

/// The plans of a job, and what limits they meet.
#[derive(Debug)]
pub struct Optimisation {
    /// The job's name.
    pub job: String,
    /// Its operations, in order.
    pub operations: Vec<OperationOptimum>,
    /// Operations whose tips the job gives, so that there is nothing to choose.
    pub given: Vec<GivenOperation>,
    /// Operations of other kinds, which these formulas are not about.
    pub others: Vec<OtherOperation>,
    /// Rectangular roughing: what other limits cost, and what better blades would buy.
    pub rects: Vec<RectOptimum>,
    /// How other ways to do its operations compare, where the job leaves that open.
    pub comparisons: Vec<Comparison>,
    /// The time of the whole job.
    pub time: Duration,
    /// The simulated scallop of the whole job.
    pub scallop: Length,
    /// What there was to warn of.
    pub warnings: Vec<Diagnostic>,
    /// The texts that warnings point into.
    pub sources: SourceMap,
}

/// An operation along tips that the job gives.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GivenOperation {
    /// Which operation of the job it is, counted from 1.
    pub number: u16,
    /// Where its tips stand: `rib.vcut:12:3`.
    pub place: String,
    pub tips: usize,
}

/// The plans of one operation, and what limits they meet.
#[derive(Clone, Debug, PartialEq)]
pub struct OperationOptimum {
    /// Which operation of the job it is, counted from 1.
    pub number: u16,
    /// Where it stands: `rib.vcut:12:1`.
    pub place: String,
    pub objective: Objective,
    pub formulas: Formulas,
    /// Where the lattice is given, if it is: the others are shown for comparison only.
    pub lattice_given: Option<String>,
    /// The best parameters on every lattice by both formulas.
    pub rows: Vec<Row>,
    /// Bounds of the chosen row that bind, and what relaxing them would buy by the formulas.
    pub binding: Vec<Relaxed>,
    pub planned: Planned,
    /// What wider limits save, as planned.
    pub wider: WiderLimits,
    /// Changes that are not wider limits and still save time, as planned.
    pub faster: Vec<Faster>,
    /// The limit on the scallop, where it was chosen because the job sets none.
    pub chosen_limit: Option<Length>,
    /// The fastest plans for a row of limits.
    pub trade_off: TradeOff,
}

/// The best parameters on one lattice, by one kind of formulas.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    pub lattice: Lattice,
    pub formulas: Formulas,
    /// Whether these are the job's.
    pub role: Role,
    /// The best parameters, or why there are none, in words.
    pub best: Result<Optimum, String>,
}

/// What a row is to the job.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// What the job's formulas choose; the job is cut with it, but for rounding to the grid, unless simulation found better.
    Chosen,
    /// For comparison.
    Other,
}

/// Why nothing was optimised.
#[derive(Debug)]
pub enum Refusal {
    /// The job file cannot be read.
    Unreadable(String),
    /// The job has errors.
    Diagnostics(Vec<Diagnostic>, SourceMap),
}

/// Which trade-off is made.
#[derive(Clone, Copy, Debug)]
pub struct Wanted {
    pub against: Against,
    /// How many limits are tried.
    pub points: u32,
}

/// Optimises a job.
///
/// # Errors
/// When the job does not compile.
pub fn optimise(
    request: Request<'_>,
    wanted: Wanted,
    progress: &mut dyn FnMut(Stage),
) -> Result<Optimisation, Refusal> {
    let outcome = driver::compile(request, progress)
        .map_err(|RequestError::Unreadable(reason)| Refusal::Unreadable(reason))?;
    let Outcome {
        sources,
        diagnostics,
        job: Some(job),
        plan: Some(plan),
        compiled: Some(compiled),
        comparisons,
        ..
    } = outcome
    else {
        return Err(Refusal::Diagnostics(outcome.diagnostics, outcome.sources));
    };
    progress(Stage::Optimising);
    let operations = operations(&job, &plan, &compiled, &sources, wanted);
    let given = given(&job, &sources);
    let in_the_text = values::Subject {
        request,
        sources: &sources,
        compiled: &compiled,
    };
    let others = others::of(&plan, in_the_text, wanted);
    let rects = rect::of(&job, &comparisons, &operations, wanted.points, &sources);
    Ok(Optimisation {
        given,
        others,
        rects,
        comparisons,
        job: job.name,
        operations,
        time: compiled.report.times.all.total(),
        scallop: compiled.report.scallop.height,
        warnings: diagnostics,
        sources,
    })
}

fn given(job: &CheckedJob, sources: &SourceMap) -> Vec<GivenOperation> {
    let numbered = (1..).zip(&job.operations);
    let given = numbered.filter_map(|(number, operation)| {
        let tips = RoughVcut::of(&**operation)?.tips.as_ref()?;
        Some(GivenOperation {
            number,
            place: bounds::place(sources, tips.span),
            tips: tips.tips.len(),
        })
    });
    given.collect()
}

fn operations(
    job: &CheckedJob,
    plan: &PlannedJob,
    compiled: &Compiled,
    sources: &SourceMap,
    wanted: Wanted,
) -> Vec<OperationOptimum> {
    let route = match compiled.not_followed {
        Some(_) => Route::OfThePlan,
        None => Route::Open,
    };
    let numbered = (0..).map(OperationId).zip(&plan.operations);
    let optimised = numbered.filter_map(|(operation, planned)| {
        let vcut = PlannedVcut::of(&**planned)?;
        let subject = Subject {
            job,
            operation,
            plan: vcut,
            route,
        };
        let planned = Planned::of(vcut, compiled, operation);
        optimum_of(subject, planned, sources, wanted)
    });
    optimised.collect()
}

/// How many cuts all plans with one change may have together.
const CUTS_OF_CHANGES: f64 = 10_000.0;

/// How many cuts a trade-off may have for each of its points.
const CUTS_A_POINT: f64 = 300.0;

fn optimum_of(
    subject: Subject<'_>,
    planned: Planned,
    sources: &SourceMap,
    wanted: Wanted,
) -> Option<OperationOptimum> {
    let Subject {
        job,
        operation,
        plan: vcut,
        ..
    } = subject;
    let mut asked = RoughVcut::of(&**job.operations.get(usize::from(operation.0))?)?.clone();
    if asked.tips.is_some() {
        return None;
    }
    // A limit that was chosen counts as if the job had set it.
    asked.limits.scallop = vcut.asked.limits.scallop;
    asked.limits.chosen = vcut.asked.limits.chosen;
    let asked = &asked;
    let problem = parameters::problem(&PlanningJob::of(job)?, asked)?;
    let of_formulas = with_formulas(vcut.parameters.lattice, &problem);
    let rows = rows(&problem, of_formulas);
    let chosen = rows.iter().find_map(Row::chosen);
    let binding = chosen.map_or_else(Vec::new, |best| bounds::relaxed(&problem, best, asked, sources));

    let mut changes = Trials::new(subject, CUTS_OF_CHANGES);
    let now = changes.unchanged();
    let (wider, mut faster) = match now.plan() {
        Some(now) => (
            loosened::loosened(asked, now, &mut changes, sources),
            Vec::from_iter(faster::on_other_lattices(asked, now, &mut changes)),
        ),
        None => (WiderLimits::default(), Vec::new()),
    };
    let question = Question {
        against: wanted.against,
        points: wanted.points,
        asked,
        problem: &problem,
        lattices: &lattices_first(of_formulas),
    };
    let room = CUTS_A_POINT * f64::from(wanted.points);
    let trade_off = TradeOff::of(&question, &now, &mut Trials::new(subject, room));
    faster.extend(faster::within_a_tighter_limit(asked, &trade_off));
    Some(OperationOptimum {
        number: operation.0.saturating_add(1),
        place: bounds::place(sources, asked.setup.head_span),
        objective: asked.objective.value,
        formulas: asked.formulas.value,
        lattice_given: lattice_given(asked, sources),
        rows,
        binding,
        planned,
        wider,
        faster,
        chosen_limit: asked
            .limits
            .chosen
            .and(asked.limits.scallop)
            .map(|limit| limit.value),
        trade_off,
    })
}

/// Where the lattice is given, if it is.
fn lattice_given(asked: &RoughVcut, sources: &SourceMap) -> Option<String> {
    let span = asked.lattice.span.unwrap_or(asked.setup.head_span);
    match asked.lattice.value {
        Auto::Auto => None,
        Auto::Given(_) => Some(bounds::place(sources, span)),
    }
}

/// All lattices that have formulas, this one first.
fn lattices_first(first: Lattice) -> [Lattice; 3] {
    let mut lattices = LATTICES;
    lattices.sort_by_key(|&lattice| lattice != first);
    lattices
}

/// The lattice itself; of fitted tips, which have no formulas, the best one by these.
fn with_formulas(chosen: Lattice, problem: &Problem) -> Lattice {
    match chosen {
        Lattice::Orthogonal | Lattice::Interlaced | Lattice::Free => chosen,
        Lattice::Fitted => {
            let others = Problem {
                lattices: LATTICES.to_vec(),
                ..problem.clone()
            };
            optimum::solve(&others).map_or(Lattice::Interlaced, |best| best.lattice)
        }
    }
}

/// Lattices that have formulas.
const LATTICES: [Lattice; 3] = [Lattice::Orthogonal, Lattice::Interlaced, Lattice::Free];

/// Every lattice by both formulas, all else as the job has it.
fn rows(problem: &Problem, chosen: Lattice) -> Vec<Row> {
    let best = |formulas, lattice| {
        let alone = Problem {
            formulas,
            lattices: vec![lattice],
            ..problem.clone()
        };
        optimum::solve(&alone).map_err(|infeasible| report::why_not(&alone, &infeasible))
    };
    let kinds = LATTICES
        .into_iter()
        .flat_map(|lattice| [Formulas::Paper, Formulas::Exact].map(|formulas| (lattice, formulas)));
    kinds
        .map(|(lattice, formulas)| Row {
            lattice,
            formulas,
            role: if lattice == chosen && formulas == problem.formulas {
                Role::Chosen
            } else {
                Role::Other
            },
            best: best(formulas, lattice),
        })
        .collect()
}

impl Row {
    /// The best parameters, where they are the job's.
    fn chosen(&self) -> Option<&Optimum> {
        match self.role {
            Role::Chosen => self.best.as_ref().ok(),
            Role::Other => None,
        }
    }
}

impl Optimisation {
    /// The Pareto pictures of operations as SVG, each with the number of its operation, in order.
    #[must_use]
    pub fn pictures(&self) -> Vec<(u16, String)> {
        let of_vcuts = self
            .operations
            .iter()
            .map(|vcut| (vcut.number, self.of_vcut(vcut)));
        let of_others = self.others.iter().filter_map(|other| {
            let trade_off = other.trade_off.as_ref()?;
            Some((other.number, self.of_other(other.number, trade_off)))
        });
        let mut pictures: Vec<(u16, String)> = of_vcuts.chain(of_others).collect();
        pictures.sort_by_key(|(number, _)| *number);
        pictures
    }

    fn of_other(&self, number: u16, trade_off: &ScallopTradeOff) -> String {
        let (limit, now) = trade_off.now;
        pareto::draw(&Pareto {
            title: &format!("{}: time against scallop, as compiled", self.job),
            subtitle: &format!("operation {number}, on the machine of the job"),
            label: Against::Scallop.label(),
            front: &trade_off.front(),
            now: Some([limit.to_mm(), now.to_s()]),
            limit: Some(limit.to_mm()),
            models: &[],
        })
    }

    fn of_vcut(&self, operation: &OperationOptimum) -> String {
        let trade_off = &operation.trade_off;
        let against = trade_off.against;
        let title = format!("{}: time against {}, as planned", self.job, against.word());
        let subtitle = format!("operation {}, at programmed speeds", operation.number);
        let front = trade_off.front();
        let models: Vec<Curve<'_>> = trade_off
            .curves
            .iter()
            .map(|curve| Curve {
                name: curve.lattice.word(),
                points: curve.points.clone(),
            })
            .collect();
        pareto::draw(&Pareto {
            title: &title,
            subtitle: &subtitle,
            label: against.label(),
            front: &front,
            now: trade_off
                .now
                .plan()
                .map(|plan| [against.of(plan), plan.time.to_s()]),
            limit: trade_off.limit,
            models: &models,
        })
    }
}

impl OperationOptimum {
    /// The best parameters by the job's formulas on the lattice it is cut with.
    #[must_use]
    pub fn chosen(&self) -> Option<&Optimum> {
        self.rows.iter().find_map(Row::chosen)
    }
}
