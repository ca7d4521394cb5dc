//! Lines of the summary about the ways to do an operation: which was taken, and from which depth or feed on another is faster.

use super::{row, time};
use crate::ways::{Came, ComparedWay, Comparison, WayFigures};
use vcutc_backend_api::units::{Duration, Length, Speed};
use vcutc_diagnostics::number::show;
use vcutc_process::comparison::Faster;

/// The lines of all comparisons.
#[must_use]
pub(crate) fn lines(comparisons: &[Comparison]) -> Vec<String> {
    comparisons.iter().flat_map(of_one).collect()
}

/// The lines of one.
#[must_use]
pub fn of_one(comparison: &Comparison) -> Vec<String> {
    let ways: Vec<String> = comparison.ways.iter().map(way).collect();
    let mut lines = vec![row("process", &ways.join("; "))];
    if let [taken, other] = comparison.ways.as_slice()
        && let (Came::Compiled(first), Came::Compiled(second)) = (&taken.came, &other.came)
    {
        lines.push(row(
            "break even",
            &even((taken.word, first), (other.word, second)),
        ));
    }
    lines
}

/// `rect: 11 min 10.7 s (66 cuts, 11 changes of blade: 1 min 50.0 s)`, or `rect: no, strips of 16 mm are wider than ...`. Changes
/// whose time is not known are `not counted`.
fn way(way: &ComparedWay) -> String {
    let word = way.word;
    match &way.came {
        Came::Compiled(figures) => {
            let count = figures.planned.changes;
            let number = match count {
                0 => String::new(),
                1 => ", 1 change of blade".to_owned(),
                _ => format!(", {count} changes of blade"),
            };
            let changing = match (count, has_uncounted_changes(figures)) {
                (0, _) => String::new(),
                (_, true) => ", not counted".to_owned(),
                (_, false) => format!(": {}", time(figures.planned.changing)),
            };
            format!(
                "{word}: {} ({} cuts{number}{changing})",
                time(figures.time),
                figures.cuts
            )
        }
        Came::Refused(Some(why)) => format!("{word}: no, {}", why.message),
        Came::Refused(None) => format!("{word}: no"),
    }
}

/// Where another way is as fast as the one that was taken, at programmed speeds.
fn even(taken: (&str, &WayFigures), other: (&str, &WayFigures)) -> String {
    let (word, planned) = (other.0, &other.1.planned);
    let depth = match planned.is_faster_than(&taken.1.planned) {
        Faster::Everywhere => format!("{word} is faster at every depth"),
        Faster::Nowhere => format!("{word} is never faster at these feeds"),
        Faster::Beyond(depth) => format!("{word} is faster from a depth of {} on", millimetres(depth)),
        Faster::Below(depth) => format!("{word} is faster below a depth of {}", millimetres(depth)),
    };
    let feeds = [(other, taken, "from", " on"), (taken, other, "down to", "")];
    let feed = feeds
        .into_iter()
        .find_map(|((word, figures), against, from, on)| {
            let even = figures.planned.even_feed(&against.1.planned)?;
            let (depth, feed) = (millimetres(figures.planned.depth), metres_per_minute(even));
            Some(format!(
                "; at {depth} {word} is faster {from} a disc feed of {feed}{on}"
            ))
        });
    let basis = if has_uncounted_changes(taken.1) || has_uncounted_changes(other.1) {
        "programmed speeds, without the time of changes"
    } else {
        "programmed speeds"
    };
    format!("{depth}{} ({basis})", feed.unwrap_or_default())
}

/// Whether blades are changed in no time: a job without a machine does not say how long that takes.
fn has_uncounted_changes(figures: &WayFigures) -> bool {
    figures.planned.changes > 0 && figures.planned.changing == Duration::ZERO
}

/// To a tenth.
fn millimetres(length: Length) -> String {
    format!("{} mm", show((length.to_mm() * 10.0).round() / 10.0))
}

/// To a hundredth.
fn metres_per_minute(speed: Speed) -> String {
    format!("{} m/min", show((speed.to_mm_per_s() * 6.0).round() / 100.0))
}
