//! Changes of an operation that are planned: each is planned, proven, and timed at programmed speeds; the machine is not asked.
//!
//! A plan of few cuts takes a fraction of a second, one of thousands takes many. So what may be planned for one answer is
//! bounded, in cuts; beyond that only the formulas answer.

use super::planned::Moves;
use vcutc_backend_api::ir::OperationId;
use vcutc_backend_api::units::{Duration, Length};
use vcutc_diagnostics::source::SourceMap;
use vcutc_job::{Auto, CheckedJob};
use vcutc_process::plan::plan;
use vcutc_process::verdict;
use vcutc_simulation::report::Report;
use vcutc_simulation::timing::op_times;
use vcutc_vcut::PlannedVcut;
use vcutc_vcut::asked::{Objective, RoughVcut};
use vcutc_vcut::plan::parameters::VcutParameters;

/// The result of a change of the job.
#[derive(Clone, Debug, PartialEq)]
pub enum Came {
    /// A plan with nothing wrong.
    Planned(Box<Plan>),
    /// There is no such plan.
    Nothing,
    /// It was not planned: that would take too long.
    TooLarge,
}

impl Came {
    /// The plan, where there is one.
    #[must_use]
    pub fn plan(&self) -> Option<&Plan> {
        match self {
            Self::Planned(plan) => Some(plan),
            Self::Nothing | Self::TooLarge => None,
        }
    }
}

/// A plan of the changed operation.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// What it is cut with.
    pub parameters: VcutParameters,
    /// The time of its moves at programmed speeds.
    pub time: Duration,
    /// V-cuts.
    pub cuts: usize,
    /// The most that is left on the part when it is done.
    pub leaves: Length,
    /// The longest edge in use.
    pub edge: Length,
}

impl Plan {
    /// What an objective makes small: s, mm or cuts.
    pub(super) const fn value(&self, objective: Objective) -> f64 {
        match objective {
            Objective::Time => self.time.to_s(),
            Objective::Cuts => self.cuts as f64,
            Objective::Scallop => self.leaves.to_mm(),
            Objective::BladeLoad => self.edge.to_mm(),
        }
    }
}

/// Along which routes changes of a job are planned.
#[derive(Clone, Copy)]
pub(super) enum Route {
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

/// An operation of a job, and its plan.
#[derive(Clone, Copy)]
pub(super) struct Subject<'j> {
    pub(super) job: &'j CheckedJob,
    pub(super) operation: OperationId,
    pub(super) plan: &'j PlannedVcut,
    pub(super) route: Route,
}

/// Changes of an operation that are planned.
pub(super) struct Trials<'j> {
    subject: Subject<'j>,
    /// How many cuts may still be planned.
    room: f64,
}

impl<'j> Trials<'j> {
    /// With room for so many cuts together.
    pub(super) const fn new(subject: Subject<'j>, room: f64) -> Self {
        Self { subject, room }
    }

    /// The plan of the job as it is. It was planned before, so there is always room for it.
    pub(super) fn unchanged(&self) -> Came {
        let plan = self.subject.planned(|_| {});
        plan.map_or(Came::Nothing, |plan| Came::Planned(Box::new(plan)))
    }

    /// The plan of a change that is expected to come to so many cuts.
    pub(super) fn came(&mut self, cuts: f64, change: impl FnOnce(&mut RoughVcut)) -> Came {
        if cuts > self.room {
            return Came::TooLarge;
        }
        self.room -= cuts;
        self.subject
            .planned(change)
            .map_or(Came::Nothing, |plan| Came::Planned(Box::new(plan)))
    }
}

impl Subject<'_> {
    /// The operation after those before it, with a change; what comes after it has no part in the answer.
    fn planned(self, change: impl FnOnce(&mut RoughVcut)) -> Option<Plan> {
        let mut job = self.job.clone();
        job.machine = None;
        let index = usize::from(self.operation.0);
        job.operations.truncate(index.saturating_add(1));
        let asked = RoughVcut::of_mut(&mut **job.operations.get_mut(index)?)?;
        // A limit that was chosen counts as if the job had set it.
        asked.limits.scallop = self.plan.asked.limits.scallop;
        self.route.keep(asked, self.plan);
        change(asked);
        let (plan, _) = plan(&job);
        let plan = plan?;
        let proven = verdict::prove(&plan, &SourceMap::default()).ok()?;
        let keeps_limits = verdict::broken_limits(&job, &plan).is_empty();
        let vcut = PlannedVcut::of(plan.operation(self.operation)?)?;
        let moves = Moves {
            ops: &proven.program.program().ops,
            times: &op_times(&proven.program),
        };
        (proven.is_sound() && keeps_limits).then(|| Plan {
            parameters: vcut.parameters.clone(),
            time: moves.time_of(self.operation),
            cuts: vcut.cuts.len(),
            leaves: proven.report.scallop.height,
            edge: edge(&proven.report, self.operation, moves),
        })
    }
}

/// The longest edge that an operation uses.
fn edge(report: &Report, operation: OperationId, moves: Moves<'_>) -> Length {
    let own = report.edges.iter().filter(|used| moves.is_of(used.op, operation));
    own.map(|used| used.length).fold(Length::ZERO, Length::max)
}
