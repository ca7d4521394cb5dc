//! `vcutc optimize`: what the open parameters of a job come out as, what else there would be, and what it would cost.
//!
//! The job is compiled as ever, so that what is told of the chosen parameters was planned, proven and timed. Beside it the
//! problem of each operation ([`vcutc_vcut::plan::optimum`]) is solved again: on every lattice, by the paper's formulas and by the
//! exact ones, with each binding bound relaxed, and for a row of limits of the scallop. Those answers are the model's alone.

mod bounds;
mod came;
pub mod json;
mod others;
mod rect;
pub mod report;
mod table;
mod trade_off;

pub use bounds::Relaxed;
pub use came::{Came, Plan};
pub use others::OtherOperation;
pub use rect::RectOptimum;
pub use trade_off::TradeOff;

use came::{Room, came};
use vcutc_backend_api::ir::{OperationId, Site};
use vcutc_backend_api::units::{Duration, Length};
use vcutc_diagnostics::Diagnostic;
use vcutc_diagnostics::source::SourceMap;
use vcutc_driver::ways::Comparison;
use vcutc_driver::{self as driver, Compiled, Outcome, Request, RequestError, Stage};
use vcutc_job::{Auto, CheckedJob, PlannedJob, PlanningJob, Sourced};
use vcutc_picture::pareto::{self, Curve, Pareto};
use vcutc_vcut::PlannedVcut;
use vcutc_vcut::asked::{Formulas, Lattice, Objective, RoughVcut};
use vcutc_vcut::plan::optimum::{self, Optimum, Problem};
use vcutc_vcut::plan::parameters::{self, VcutParameters};

/// What came of a job's open parameters.
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

/// What came of one operation's open parameters.
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
    pub planned: Planned,
    /// Bounds that bind, and what relaxing them would buy.
    pub binding: Vec<Relaxed>,
    /// Least times for a row of limits of the scallop.
    pub trade_off: TradeOff,
    /// The fastest other lattice or model, where by the formulas it is much faster than the marked line.
    pub faster: Option<Faster>,
}

/// Another lattice on which the formulas promise a much shorter time.
#[derive(Clone, Debug, PartialEq)]
pub struct Faster {
    pub lattice: Lattice,
    /// The time by the formulas.
    pub time: Duration,
    /// By which share it is shorter: planned than the job as planned, or else by the formulas than that of the marked line.
    pub share: f64,
    /// What it comes to when it is planned.
    pub came: Came,
}

/// From which share on another lattice is worth a line.
const MUCH_FASTER: f64 = 0.1;

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

/// How the parameters that an operation is cut with were found.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum FoundBy {
    /// By the formulas: they are those of the chosen row, on the grid.
    Formulas,
    /// As the best of plans that were simulated, and what these came up against.
    Simulation { reasons: Vec<&'static str> },
}

/// What the plan of an operation comes to.
#[derive(Clone, Debug, PartialEq)]
pub struct Planned {
    /// What it is cut with, on the grid: the formulas' choice, or what simulation found better.
    pub parameters: VcutParameters,
    pub found: FoundBy,
    /// Time of its moves.
    pub time: Duration,
    /// Time by the model, of the parameters on the grid.
    pub model: Duration,
    /// V-cuts.
    pub cuts: usize,
    /// Layers with cuts.
    pub layers: usize,
}

impl Planned {
    /// How far the model is above the planned time, as a share of that; none when nothing takes time.
    #[must_use]
    pub fn model_above(&self) -> Option<f64> {
        let planned = self.time.to_s();
        (planned > 0.0).then(|| self.model.to_s() / planned - 1.0)
    }
}

/// Why nothing was optimised.
#[derive(Debug)]
pub enum Refusal {
    /// The job file cannot be read.
    Unreadable(String),
    /// The job has errors.
    Diagnostics(Vec<Diagnostic>, SourceMap),
}

/// Optimises a job, with so many limits of the scallop in the trade-off.
///
/// # Errors
/// When the job does not compile.
pub fn optimise(
    request: Request<'_>,
    points: u32,
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
    let operations = operations(&job, &plan, &compiled, &sources, points);
    let given = given(&job, &sources);
    let others = others::of(&plan, &compiled, &sources);
    let rects = rect::of(&job, &comparisons, &operations, points, &sources);
    Ok(Optimisation {
        given,
        others,
        rects,
        comparisons,
        job: job.name,
        operations,
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
    points: u32,
) -> Vec<OperationOptimum> {
    let pairs = (0..).zip(job.operations.iter().zip(&plan.operations));
    let mut operations = Vec::new();
    for (index, (asked, planned_operation)) in pairs {
        let (Some(asked), Some(vcut)) = (RoughVcut::of(&**asked), PlannedVcut::of(&**planned_operation))
        else {
            continue;
        };
        operations.extend(operation(
            job,
            asked,
            vcut,
            sources,
            planned(vcut, compiled, OperationId(index)),
            Scale {
                index,
                points,
                route: match compiled.not_followed {
                    Some(_) => Route::OfThePlan,
                    None => Route::Open,
                },
            },
        ));
    }
    operations
}

/// Which operation, how many limits its trade-off has, and along which routes they are planned.
#[derive(Clone, Copy)]
struct Scale {
    index: u16,
    points: u32,
    route: Route,
}

/// Along which routes changes of a job are planned.
#[derive(Clone, Copy)]
enum Route {
    /// Those that the job leaves open.
    Open,
    /// That of the job's plan and swings no wider: the machine did not follow what the job makes of itself.
    OfThePlan,
}

impl Route {
    fn keep(self, asked: &mut RoughVcut, plan: &PlannedVcut) {
        match self {
            Self::Open => {}
            Self::OfThePlan => {
                asked.sequence.value = Auto::Given(plan.sequence);
                asked.order.value = Auto::Given(plan.order);
                asked.limits.swing.most = plan.asked.limits.swing.most;
            }
        }
    }
}

fn operation(
    job: &CheckedJob,
    asked: &RoughVcut,
    vcut: &PlannedVcut,
    sources: &SourceMap,
    planned: Planned,
    Scale { index, points, route }: Scale,
) -> Option<OperationOptimum> {
    if asked.tips.is_some() {
        return None;
    }
    // A limit that was chosen counts as if the job had set it.
    let mut asked = asked.clone();
    asked.limits.scallop = vcut.asked.limits.scallop;
    let asked = &asked;
    let problem = parameters::problem(&PlanningJob::of(job)?, asked)?;
    let chosen = vcut.parameters.lattice;
    let formulas = asked.formulas.value;
    let of_formulas = with_formulas(chosen, &problem);
    let rows = rows(&problem, of_formulas);
    let best = rows.iter().find_map(|row| match row.role {
        Role::Chosen => row.best.as_ref().ok(),
        Role::Other => None,
    });
    let binding = best.map_or_else(Vec::new, |best| bounds::relaxed(&problem, best, asked, sources));
    let mut trials = Trials {
        job,
        plan: vcut,
        route,
        room: Room::OF_AN_OPERATION,
    };
    Some(OperationOptimum {
        number: index.saturating_add(1),
        place: bounds::place(sources, asked.setup.head_span),
        objective: asked.objective.value,
        formulas,
        lattice_given: match asked.lattice.value {
            Auto::Auto => None,
            Auto::Given(_) => Some(bounds::place(
                sources,
                asked.lattice.span.unwrap_or(asked.setup.head_span),
            )),
        },
        faster: faster(asked, &rows, (chosen, planned.time), &mut trials),
        planned,
        binding,
        trade_off: TradeOff::of(&problem, of_formulas, points, |point| {
            trials.came(point.cuts, |asked| under(asked, point))
        }),
        rows,
    })
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

/// Changes of a job that are planned.
struct Trials<'j> {
    job: &'j CheckedJob,
    /// The operation as it is planned.
    plan: &'j PlannedVcut,
    route: Route,
    room: Room,
}

impl Trials<'_> {
    fn came(&mut self, cuts: f64, change: impl FnOnce(&mut RoughVcut)) -> Came {
        came(self.job, &mut self.room, cuts, |asked| {
            self.route.keep(asked, self.plan);
            change(asked);
        })
    }
}

/// Puts an operation under the limit of a point.
fn under(asked: &mut RoughVcut, point: &Optimum) {
    asked.limits.scallop = Some(Sourced {
        value: point.scallop,
        span: None,
    });
}

/// The fastest other lattice by the job's formulas, if it is much faster. What is planned decides where it is planned.
fn faster(
    asked: &RoughVcut,
    rows: &[Row],
    (chosen, planned): (Lattice, Duration),
    trials: &mut Trials<'_>,
) -> Option<Faster> {
    let formulas = asked.formulas.value;
    let of = |row: &Row| {
        row.best
            .as_ref()
            .ok()
            .filter(|_| row.formulas == formulas)
            .cloned()
    };
    let marked = rows.iter().filter(|row| row.role == Role::Chosen).find_map(of)?;
    let others = rows.iter().filter(|row| row.role == Role::Other);
    let best = others
        .filter_map(of)
        .min_by(|one, other| one.time.total_cmp(&other.time))?;
    let share = 1.0 - best.time / marked.time;
    let is_told = share > MUCH_FASTER && asked.objective.value == Objective::Time && best.lattice != chosen;
    if !is_told {
        return None;
    }
    let came = trials.came(best.cuts, |asked| {
        asked.lattice.value = Auto::Given(best.lattice);
    });
    let share = match &came {
        Came::Planned(plan) => 1.0 - plan.time / planned,
        Came::FormulaOnly => share,
        Came::Nothing => return None,
    };
    (share > MUCH_FASTER).then_some(Faster {
        lattice: best.lattice,
        time: best.time,
        share,
        came,
    })
}

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

/// What an operation's plan comes to, from the times of its ops.
fn planned(vcut: &PlannedVcut, compiled: &Compiled, operation: OperationId) -> Planned {
    let ops = &compiled.program.verified().program().ops;
    let own = ops
        .iter()
        .zip(&compiled.op_times)
        .filter(|(op, _)| match op.site {
            Site::Program => false,
            Site::Operation(of) | Site::Layer { operation: of, .. } | Site::Cut { operation: of, .. } => {
                of == operation
            }
        });
    let layers = compiled.report.layers.iter();
    Planned {
        parameters: vcut.parameters.clone(),
        found: if vcut.is_found_by_simulation() {
            FoundBy::Simulation {
                reasons: vcut.parameters.reasons(&vcut.asked),
            }
        } else {
            FoundBy::Formulas
        },
        time: own.map(|(_, &time)| time).sum(),
        model: vcut.estimate,
        cuts: vcut.cuts.len(),
        layers: layers.filter(|(of, _)| *of == operation).count(),
    }
}

impl Optimisation {
    /// The Pareto picture of an operation as SVG.
    #[must_use]
    pub fn svg(&self, operation: &OperationOptimum) -> String {
        let title = format!("{}: time against scallop, by the formulas", self.job);
        let subtitle = format!(
            "operation {}, {} formulas, {}",
            operation.number,
            operation.formulas.word(),
            report::objective(operation.objective)
        );
        let trade_off = &operation.trade_off;
        let places = |optimum: &Optimum| [optimum.scallop.to_mm(), optimum.time.to_s()];
        let curves: Vec<Curve<'_>> = trade_off
            .curves
            .iter()
            .map(|curve| Curve {
                name: curve.lattice.word(),
                points: curve.points.iter().map(places).collect(),
            })
            .collect();
        let chosen = operation.chosen().map_or([0.0, 0.0], places);
        pareto::draw(&Pareto {
            title: &title,
            subtitle: &subtitle,
            curves: &curves,
            chosen,
            planned: Some([self.scallop.to_mm(), operation.planned.time.to_s()]),
            limit: trade_off.limit.map(Length::to_mm),
        })
    }
}

impl OperationOptimum {
    /// The best parameters by the job's formulas on the lattice it is cut with.
    #[must_use]
    pub fn chosen(&self) -> Option<&Optimum> {
        self.rows.iter().find_map(|row| match row.role {
            Role::Chosen => row.best.as_ref().ok(),
            Role::Other => None,
        })
    }
}
