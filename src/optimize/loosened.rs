//! What wider limits save: each limit and each given value of the job loosened by a tenth, and the job planned with it.

use super::bounds::{self, shorter_edge, written};
use super::trials::{Came, Plan, Trials};
use vcutc_backend_api::units::{Angle, Length};
use vcutc_diagnostics::source::SourceMap;
use vcutc_geometry::grid;
use vcutc_job::{Auto, Bounds};
use vcutc_vcut::asked::RoughVcut;
use vcutc_vcut::plan::optimum::{Bound, End};
use vcutc_vcut::plan::parameters::said;

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
    for bound in Bound::ALL {
        let Some((value, wider)) = stated(asked, bound).and_then(|value| Some((value, wider(bound, value)?)))
        else {
            continue;
        };
        match trials.came(now.cuts as f64, |asked| put(asked, bound, wider)) {
            Came::Nothing => {}
            Came::TooLarge => limits.not_planned.push(words(asked, bound, value)),
            Came::Planned(plan) => {
                let before = now.value(asked.objective.value);
                let gain = before - plan.value(asked.objective.value);
                let share = gain / before;
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

/// As it is written in the job: `swing <= 50 deg`, `layer = 4 mm`, or in its blade.
fn words(asked: &RoughVcut, bound: Bound, value: f64) -> String {
    let (name, value) = (bounds::name(bound), bounds::value(bound, value));
    match (bound, name.split_once(' ')) {
        (Bound::Edge, _) if shorter_edge(asked).is_none() => format!("cutting_length = {value}"),
        (_, Some((field, _))) if said::is_given(asked, bound) => format!("{field} = {value}"),
        (_, Some(_) | None) => format!("{name} {value}"),
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
            Some(shorter_edge(asked).map_or(blade, |limit| limit.value).to_mm())
        }
        Bound::Time => limits.time.map(|limit| limit.value.to_s()),
        Bound::Cuts => limits.cuts.map(|limit| limit.value),
    }
}

fn of_range<T: Copy>(value: Auto<T>, limits: Bounds<T>, bound: Bound) -> Option<T> {
    match (value, bound.end()) {
        (Auto::Given(value), End::Least | End::Most) => Some(value),
        (Auto::Auto, End::Least) => limits.least.map(|limit| limit.value),
        (Auto::Auto, End::Most) => limits.most.map(|limit| limit.value),
    }
}

/// A value wider by a tenth, to three decimals.
fn wider(bound: Bound, value: f64) -> Option<f64> {
    let factor = match bound.end() {
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

/// A longer edge than limits leave is that of a longer blade.
fn put(asked: &mut RoughVcut, bound: Bound, value: f64) {
    match bound {
        Bound::Edge if shorter_edge(asked).is_none() => {
            asked.blade.cutting_length.value = Length::mm(value);
        }
        Bound::SwingLeast | Bound::SwingMost => {
            said::set(asked, bound, Angle::rad(value).to_deg());
        }
        Bound::LayerLeast
        | Bound::LayerMost
        | Bound::StepLeast
        | Bound::StepMost
        | Bound::OverlapLeast
        | Bound::OverlapMost
        | Bound::Scallop
        | Bound::Edge
        | Bound::Time
        | Bound::Cuts => {
            said::set(asked, bound, value);
        }
    }
}
