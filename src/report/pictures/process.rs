//! Which process is the faster one at which depth of the work.

use crate::Material;
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::number::show;
use vcutc_driver::ways::{Came, ComparedWay, Comparison};
use vcutc_picture::{Prefix, processes};
use vcutc_process::comparison::{Faster, PlanTime};

/// Feeds of the disc, to that of the straight blade, of figures 10 to 12 of [Yu 2019].
const RATIOS: [f64; 3] = [0.3, 0.6, 1.0];

/// How many times as deep as the stock the picture goes at most.
const FARTHEST: f64 = 10.0;

/// The times of both ways to do the first operation that leaves a choice (`picture::processes`); none where none does, or only one
/// way compiles.
#[must_use]
pub fn process(material: &Material<'_>, ids: Prefix) -> Option<String> {
    let (taken, other) = material.comparisons.iter().find_map(both)?;
    let depth = taken.1.depth;
    let crossing = match other.1.is_faster_than(&taken.1) {
        Faster::Beyond(at) | Faster::Below(at) if at.to_mm() <= FARTHEST * depth.to_mm() => Some(at),
        Faster::Beyond(_) | Faster::Below(_) | Faster::Everywhere | Faster::Nowhere => None,
    };
    let deepest = Length::mm(2.0 * crossing.unwrap_or(depth).max(depth).to_mm());
    let way = |(name, planned): &(&'static str, PlanTime)| processes::Way {
        name,
        ends: ends(planned, deepest, 1.0),
        others: others(planned, deepest),
    };
    let ways = [&taken, &other].map(way);
    Some(processes::draw(&processes::Processes {
        heading: processes::Heading {
            ids,
            title: &format!("{}: processes", material.plan.name),
            subtitle: &format!(
                "{} was taken, at a depth of {} mm; programmed speeds",
                taken.0,
                show(depth.to_mm())
            ),
        },
        ways,
        depth: depth.to_mm(),
        deepest: deepest.to_mm(),
        crossing: crossing.map(|at| [at.to_mm(), taken.1.at(at, 1.0).to_s()]),
    }))
}

type Named = (&'static str, PlanTime);

/// Both ways, if both compile.
fn both(comparison: &Comparison) -> Option<(Named, Named)> {
    let planned = |way: &ComparedWay| match &way.came {
        Came::Compiled(figures) => Some((way.word, figures.planned)),
        Came::Refused(_) => None,
    };
    match comparison.ways.as_slice() {
        [taken, other] => Some((planned(taken)?, planned(other)?)),
        _ => None,
    }
}

fn ends(planned: &PlanTime, deepest: Length, feed: f64) -> [f64; 2] {
    [Length::ZERO, deepest].map(|depth| planned.at(depth, feed).to_s())
}

/// The times with other feeds of the disc.
fn others(planned: &PlanTime, deepest: Length) -> Vec<(String, [f64; 2])> {
    let (Some(still), Some(spinning)) = (planned.still_feed, planned.spinning_feed) else {
        return Vec::new();
    };
    let ratio = |&ratio: &f64| {
        let feed = still.to_mm_per_s() * ratio / spinning.to_mm_per_s();
        let metres = show((still.to_mm_per_s() * ratio * 6.0).round() / 100.0);
        let name = format!("disc at {metres} m/min, {ratio} x the feed of the straight blade");
        (name, ends(planned, deepest, feed))
    };
    RATIOS.iter().map(ratio).collect()
}
