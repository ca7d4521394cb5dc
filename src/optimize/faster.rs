//! Changes that save time without a wider limit.

use super::trade_off::TradeOff;
use super::trials::{Plan, Trials};
use super::{LATTICES, bounds};
use vcutc_job::Auto;
use vcutc_vcut::asked::{Formulas, Lattice, Objective, RoughVcut};
use vcutc_vcut::plan::optimum::Bound;

/// A change of the job with which it is cut faster.
#[derive(Clone, Debug, PartialEq)]
pub struct Faster {
    /// As it is written in the job: `lattice = interlaced`, `limits { scallop <= 8.5 mm }`.
    pub change: String,
    pub plan: Plan,
    /// By which share it is shorter than the job, both at programmed speeds.
    pub share: f64,
}

/// From which share on a change is worth a line.
const WORTH_A_LINE: f64 = 0.005;

/// The fastest plan on another lattice, where the job gives one, or has the paper's formulas, which choose none.
pub(super) fn on_other_lattices(asked: &RoughVcut, now: &Plan, trials: &mut Trials<'_>) -> Option<Faster> {
    let lattices: &[Auto<Lattice>] = match (asked.lattice.value, asked.formulas.value) {
        (Auto::Auto, Formulas::Exact) => &[],
        (Auto::Given(_), Formulas::Exact) => &[Auto::Auto],
        (Auto::Auto | Auto::Given(_), Formulas::Paper) => &LATTICES.map(Auto::Given),
    };
    let plans = lattices.iter().filter_map(|&lattice| {
        let came = trials.came(now.cuts as f64, |asked| asked.lattice.value = lattice);
        came.plan().cloned()
    });
    let best = plans.min_by(|one, other| one.time.total_cmp(&other.time))?;
    let lattice = best.parameters.lattice;
    let is_other = lattice != now.parameters.lattice;
    // A limit that was chosen for this lattice might be another one on that.
    let limit = asked.limits.scallop.filter(|_| asked.limits.chosen.is_some());
    let limit = limit.map_or(String::new(), |limit| {
        let value = bounds::value(Bound::Scallop, limit.value.to_mm());
        format!(" and limits {{ scallop <= {value} }}")
    });
    let change = format!("lattice = {}{limit}", lattice.word());
    faster(asked, now, &best, change).filter(|_| is_other)
}

/// A plan within a tighter limit that the search for the job missed.
pub(super) fn within_a_tighter_limit(asked: &RoughVcut, trade_off: &TradeOff) -> Option<Faster> {
    let (point, plan) = trade_off.faster_within()?;
    let against = trade_off.against;
    let change = format!(
        "limits {{ {} <= {} }}",
        against.word(),
        against.shown(point.limit)
    );
    faster(asked, trade_off.now.plan()?, plan, change)
}

fn faster(asked: &RoughVcut, now: &Plan, plan: &Plan, change: String) -> Option<Faster> {
    let share = 1.0 - plan.time / now.time;
    let is_worth_it = share > WORTH_A_LINE && asked.objective.value == Objective::Time;
    is_worth_it.then(|| Faster {
        change,
        plan: plan.clone(),
        share,
    })
}
