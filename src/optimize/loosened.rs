//! What wider limits save: each limit and each given value of the job loosened by a tenth, and the job planned with it.

use super::bounds::{self, written};
use super::trials::{Came, Plan, Trials};
use vcutc_backend_api::units::{Angle, Duration, Length};
use vcutc_diagnostics::source::SourceMap;
use vcutc_geometry::grid;
use vcutc_job::{Auto, Bounds, Sourced};
use vcutc_vcut::asked::{Objective, RoughVcut};
use vcutc_vcut::plan::optimum::Bound;

/// A limit or a given value that is wider, with a better plan.
#[derive(Clone, Debug, PartialEq)]
pub struct Loosened {
    pub bound: Bound,
    /// The bound in words: `scallop <= 10 mm`.
    pub words: String,
    /// Where the job says so: `rib.vcut:17:14`; none where nothing in the job does.
    pub place: Option<String>,
    /// Its value loosened, with unit.
    pub loosened: String,
    /// What the job comes to then.
    pub plan: Plan,
    /// By how much the objective falls, in its unit: s, mm or cuts.
    pub gain: f64,
    /// By which share the objective falls.
    pub share: f64,
}

/// What wider limits and values save.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct WiderLimits {
    /// Those that save something, the most first.
    pub found: Vec<Loosened>,
    /// Those that were not planned, because there were too many cuts.
    pub not_planned: Vec<String>,
}

/// Savings below this share are within what a search may miss.
const LEAST_SHARE: f64 = 0.002;

/// Bounds that a job can loosen.
const BOUNDS: [Bound; 12] = [
    Bound::SwingLeast,
    Bound::SwingMost,
    Bound::LayerLeast,
    Bound::LayerMost,
    Bound::StepLeast,
    Bound::StepMost,
    Bound::OverlapLeast,
    Bound::OverlapMost,
    Bound::Scallop,
    Bound::Edge,
    Bound::Time,
    Bound::Cuts,
];

/// The widest swing that is tried.
const WIDEST_SWING: Angle = Angle::deg(80.0);

/// What loosening each bound by a tenth saves.
pub(super) fn loosened(
    asked: &RoughVcut,
    now: &Plan,
    trials: &mut Trials<'_>,
    sources: &SourceMap,
) -> WiderLimits {
    let mut limits = WiderLimits::default();
    for bound in BOUNDS {
        let Some((value, wider)) = stated(asked, bound).and_then(|value| Some((value, wider(bound, value)?)))
        else {
            continue;
        };
        match trials.came(now.cuts as f64, |asked| put(asked, bound, wider)) {
            Came::Nothing => {}
            Came::TooLarge => limits.not_planned.push(words(asked, bound, value)),
            Came::Planned(plan) => {
                let gain = merit(asked.objective.value, now) - merit(asked.objective.value, &plan);
                let share = gain / merit(asked.objective.value, now);
                if share > LEAST_SHARE {
                    limits.found.push(Loosened {
                        bound,
                        words: words(asked, bound, value),
                        place: written(bound, asked).map(|span| bounds::place(sources, span)),
                        loosened: bounds::value(bound, wider),
                        share,
                        gain,
                        plan: *plan,
                    });
                }
            }
        }
    }
    limits
        .found
        .sort_by(|a, b| b.share.total_cmp(&a.share).then(a.bound.cmp(&b.bound)));
    // A given value is both ends of its range.
    limits.not_planned.dedup();
    limits
}

/// As it is written in the job: `swing <= 50 deg`, `layer = 4 mm`.
fn words(asked: &RoughVcut, bound: Bound, value: f64) -> String {
    let given = match bound {
        Bound::SwingLeast | Bound::SwingMost => is_given(asked.swing.value).then_some("swing"),
        Bound::LayerLeast | Bound::LayerMost => is_given(asked.layer.value).then_some("layer"),
        Bound::StepLeast | Bound::StepMost => is_given(asked.step.value).then_some("step"),
        Bound::OverlapLeast | Bound::OverlapMost => is_given(asked.overlap.value).then_some("overlap"),
        Bound::Edge => shorter_edge(asked).is_none().then_some("cutting_length"),
        Bound::Scallop | Bound::Time | Bound::Cuts => None,
    };
    let value = bounds::value(bound, value);
    match given {
        Some(field) => format!("{field} = {value}"),
        None => format!("{} {value}", bounds::name(bound)),
    }
}

const fn is_given<T: Copy>(value: Auto<T>) -> bool {
    match value {
        Auto::Auto => false,
        Auto::Given(_) => true,
    }
}

/// The limit on the edge, where it asks for less than the blade has.
fn shorter_edge(asked: &RoughVcut) -> Option<Length> {
    let limit = asked.limits.edge?.value;
    (limit < asked.blade.cutting_length.value).then_some(limit)
}

/// What an objective makes small: s, mm or cuts.
const fn merit(objective: Objective, plan: &Plan) -> f64 {
    match objective {
        Objective::Time => plan.time.to_s(),
        Objective::Cuts => plan.cuts as f64,
        Objective::Scallop => plan.leaves.to_mm(),
        Objective::BladeLoad => plan.edge.to_mm(),
    }
}

/// Which end of a range.
#[derive(Clone, Copy)]
enum End {
    Least,
    Most,
}

const fn end(bound: Bound) -> End {
    match bound {
        Bound::SwingLeast | Bound::LayerLeast | Bound::StepLeast | Bound::OverlapLeast => End::Least,
        Bound::SwingMost
        | Bound::LayerMost
        | Bound::StepMost
        | Bound::OverlapMost
        | Bound::Scallop
        | Bound::Edge
        | Bound::Time
        | Bound::Cuts => End::Most,
    }
}

/// What the job says: a limit or a given value, in rad, mm, s or 1.
fn stated(asked: &RoughVcut, bound: Bound) -> Option<f64> {
    let limits = &asked.limits;
    let length = Length::to_mm;
    match bound {
        Bound::SwingLeast | Bound::SwingMost => {
            of_range(asked.swing.value, limits.swing, bound).map(Angle::to_rad)
        }
        Bound::LayerLeast | Bound::LayerMost => of_range(asked.layer.value, limits.layer, bound).map(length),
        Bound::StepLeast | Bound::StepMost => of_range(asked.step.value, limits.step, bound).map(length),
        Bound::OverlapLeast | Bound::OverlapMost => match asked.overlap.value {
            Auto::Given(overlap) if overlap > 0.0 => Some(overlap),
            Auto::Given(_) | Auto::Auto => None,
        },
        Bound::Scallop => limits.scallop.map(|limit| limit.value.to_mm()),
        Bound::Edge => {
            let blade = asked.blade.cutting_length.value;
            Some(shorter_edge(asked).unwrap_or(blade).to_mm())
        }
        Bound::Time => limits.time.map(|limit| limit.value.to_s()),
        Bound::Cuts => limits.cuts.map(|limit| limit.value),
    }
}

fn of_range<T: Copy>(value: Auto<T>, limits: Bounds<T>, bound: Bound) -> Option<T> {
    match (value, end(bound)) {
        (Auto::Given(value), End::Least | End::Most) => Some(value),
        (Auto::Auto, End::Least) => limits.least.map(|limit| limit.value),
        (Auto::Auto, End::Most) => limits.most.map(|limit| limit.value),
    }
}

/// A value wider by a tenth, to three decimals.
fn wider(bound: Bound, value: f64) -> Option<f64> {
    let factor = match end(bound) {
        End::Least => 0.9,
        End::Most => 1.1,
    };
    match bound {
        Bound::SwingLeast | Bound::SwingMost => {
            let wider = Angle::deg(grid::nearest(Angle::rad(value).to_deg() * factor));
            (wider <= WIDEST_SWING).then(|| wider.to_rad())
        }
        Bound::Cuts => Some((value * factor).ceil()),
        Bound::LayerLeast
        | Bound::LayerMost
        | Bound::StepLeast
        | Bound::StepMost
        | Bound::OverlapLeast
        | Bound::OverlapMost
        | Bound::Scallop
        | Bound::Edge
        | Bound::Time => Some(grid::nearest(value * factor)),
    }
}

fn put(asked: &mut RoughVcut, bound: Bound, value: f64) {
    match bound {
        Bound::SwingLeast | Bound::SwingMost => {
            put_in_range(
                &mut asked.swing,
                &mut asked.limits.swing,
                bound,
                Angle::rad(value),
            );
        }
        Bound::LayerLeast | Bound::LayerMost => {
            put_in_range(
                &mut asked.layer,
                &mut asked.limits.layer,
                bound,
                Length::mm(value),
            );
        }
        Bound::StepLeast | Bound::StepMost => {
            put_in_range(&mut asked.step, &mut asked.limits.step, bound, Length::mm(value));
        }
        Bound::OverlapLeast | Bound::OverlapMost => asked.overlap.value = Auto::Given(value),
        Bound::Scallop => set(&mut asked.limits.scallop, Length::mm(value)),
        Bound::Edge => put_edge(asked, Length::mm(value)),
        Bound::Time => set(&mut asked.limits.time, Duration::s(value)),
        Bound::Cuts => set(&mut asked.limits.cuts, value),
    }
}

fn put_in_range<T: Copy>(given: &mut Sourced<Auto<T>>, limits: &mut Bounds<T>, bound: Bound, value: T) {
    match (given.value, end(bound)) {
        (Auto::Given(_), End::Least | End::Most) => given.value = Auto::Given(value),
        (Auto::Auto, End::Least) => set(&mut limits.least, value),
        (Auto::Auto, End::Most) => set(&mut limits.most, value),
    }
}

/// The limit, where it asks for less than the blade has; else a longer blade.
fn put_edge(asked: &mut RoughVcut, value: Length) {
    match shorter_edge(asked) {
        Some(_) => set(&mut asked.limits.edge, value),
        None => asked.blade.cutting_length.value = value,
    }
}

fn set<T>(limit: &mut Option<Sourced<T>>, value: T) {
    if let Some(limit) = limit {
        limit.value = value;
    }
}
