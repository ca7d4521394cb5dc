//! What the formulas promise, as plans: the job with one change, planned, proven and timed at programmed speeds.
//!
//! A plan of few cuts takes a fraction of a second, one of thousands takes many. So what may be planned for one answer is
//! bounded, in cuts by the formulas; what is beyond that is marked as the formulas' alone.

use vcutc_backend_api::ir::OperationId;
use vcutc_backend_api::units::{Duration, Length};
use vcutc_diagnostics::source::SourceMap;
use vcutc_job::CheckedJob;
use vcutc_process::plan::plan;
use vcutc_process::verdict;
use vcutc_vcut::plan::parameters::VcutParameters;
use vcutc_vcut::{PlannedVcut, RoughVcut};

/// What came of a change of the job.
#[derive(Clone, Debug, PartialEq)]
pub enum Came {
    /// A plan with nothing wrong.
    Planned(Box<Plan>),
    /// There is no such plan.
    Nothing,
    /// It was not planned: only the formulas speak of it.
    FormulaOnly,
}

/// A plan of the changed job.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// What it is cut with.
    pub parameters: VcutParameters,
    /// The time at programmed speeds.
    pub time: Duration,
    /// V-cuts.
    pub cuts: usize,
    /// The most that it leaves on the part.
    pub leaves: Length,
}

/// How many cuts may still be planned, by the formulas.
pub(super) struct Room {
    cuts: f64,
}

impl Room {
    /// For all points of one operation together.
    pub(super) const OF_AN_OPERATION: Self = Self { cuts: 3_000.0 };

    fn takes(&mut self, cuts: f64) -> bool {
        let fits = cuts <= self.cuts;
        if fits {
            self.cuts -= cuts;
        }
        fits
    }
}

/// The plan of a job of one operation with a change; the machine is not asked.
pub(super) fn came(
    job: &CheckedJob,
    room: &mut Room,
    cuts: f64,
    change: impl FnOnce(&mut RoughVcut),
) -> Came {
    let mut changed = job.clone();
    changed.machine = None;
    let [operation] = &mut changed.operations[..] else {
        return Came::FormulaOnly;
    };
    let Some(asked) = RoughVcut::of_mut(&mut **operation) else {
        return Came::FormulaOnly;
    };
    if !room.takes(cuts) {
        return Came::FormulaOnly;
    }
    change(asked);
    let limit = asked.limits.scallop.map(|limit| limit.value);
    planned(&changed)
        .filter(|plan| limit.is_none_or(|limit| plan.leaves <= limit + Length::mm(1e-3)))
        .map_or(Came::Nothing, |plan| Came::Planned(Box::new(plan)))
}

fn planned(job: &CheckedJob) -> Option<Plan> {
    let (plan, _) = plan(job);
    let plan = plan?;
    let proven = verdict::prove(&plan, &SourceMap::default()).ok()?;
    let vcut = PlannedVcut::of(plan.operation(OperationId(0))?)?;
    proven.is_sound().then(|| Plan {
        parameters: vcut.parameters.clone(),
        time: proven.report.times.all.total(),
        cuts: vcut.cuts.len(),
        leaves: proven.report.scallop.height,
    })
}
