//! How fast a block goes: what F means, and its value.
//!
//! The proof that the axes can follow assumed how long every motion takes ([`LinearSegment::duration`]), and the blocks say exactly
//! that. Where the tip moves, F is the way of the tip divided by this time, in mm/min; a turn about the still tip has no such
//! way and gets inverse time, or the rate of the rotary axes where the dialect has no inverse time.
//!
//! A move of all axes takes as long as the slowest axis needs at the part of its rate that the job allows (`home_speed`).

use crate::axes::{Word, printed};
use crate::controller::AxisPace;
use crate::job::Job;
use crate::options::Settings;
use crate::statement::FeedMode;
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::ir::{AxisKind, AxisValues, Cell};
use vcutc_backend_api::segments::LinearSegment;
use vcutc_backend_api::units::{Angle, Duration};

/// What F means and says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Pace {
    /// Its meaning.
    pub(crate) mode: FeedMode,
    /// Its value, in mm/min, 1/min or deg/min.
    pub(crate) feed: f64,
}

const SECONDS_A_MINUTE: f64 = 60.0;

/// Two points that a control cannot distinguish: they are nearer than the last decimal in each direction.
fn is_same_place(settings: &Settings<'_>, a: Point3, b: Point3) -> bool {
    let unit = settings.common.lengths.unit();
    [(a.x, b.x), (a.y, b.y), (a.z, b.z)]
        .into_iter()
        .all(|(a, b)| (a - b).abs() < unit)
}

/// The pace of a straight motion between two axis values. None when the program is not one that can be carried out.
pub(crate) fn of_line(
    job: &Job<'_>,
    line: &LinearSegment,
    from: &AxisValues,
    to: &AxisValues,
) -> Option<Pace> {
    let Job { settings, words, .. } = *job;
    let seconds = line.duration().to_s();
    let is_still = line.turn > Angle::ZERO && is_same_place(settings, line.from.tip, line.to.tip);
    let per_minute = |way: f64| way / seconds * SECONDS_A_MINUTE;
    let pace = if is_still {
        let mode = settings.facts().still_tip;
        let feed = match mode {
            FeedMode::InverseTime => per_minute(1.0),
            FeedMode::Rotary => per_minute(way(words, from, to, Counted::Rotary)),
            FeedMode::Tip => per_minute(line.length().to_mm()),
        };
        Pace { mode, feed }
    } else {
        let feed = match line.feed {
            Some(feed) if line.duration() == Duration::ZERO => feed.to_mm_per_s() * SECONDS_A_MINUTE,
            Some(_) | None => per_minute(line.length().to_mm()),
        };
        let mode = FeedMode::Tip;
        Pace { mode, feed }
    };
    pace.feed.is_finite().then_some(pace)
}

/// The pace of a move of all axes, none where it is rapid. From an unknown place the way is not known, so it is taken as long
/// as the axes are.
pub(crate) fn of_axes(job: &Job<'_>, from: Option<&AxisValues>, to: &AxisValues) -> Option<Pace> {
    let (settings, cell) = (job.settings, job.source.cell);
    match settings.facts().axis_pace {
        AxisPace::Rapid => None,
        AxisPace::InverseTime => {
            let seconds = axis_time(settings, cell, from, to);
            let mode = FeedMode::InverseTime;
            // A move that leads nowhere takes no time at any F.
            let seconds = if seconds > 0.0 { seconds } else { 1.0 };
            let feed = SECONDS_A_MINUTE / seconds;
            Some(Pace { mode, feed })
        }
        AxisPace::Path => {
            let mode = FeedMode::Tip;
            let known = from.map(|from| {
                (
                    way(job.words, from, to, Counted::All),
                    axis_time(settings, cell, Some(from), to),
                )
            });
            let feed = match known {
                Some((way, seconds)) if seconds > 0.0 => way / seconds * SECONDS_A_MINUTE,
                Some(_) | None => slowest(settings, cell) * SECONDS_A_MINUTE,
            };
            Some(Pace { mode, feed })
        }
    }
}

/// How long a move of all axes takes when none of them goes faster than the job allows, in s.
fn axis_time(settings: &Settings<'_>, cell: &Cell, from: Option<&AxisValues>, to: &AxisValues) -> f64 {
    let axes = cell.axes.iter().enumerate();
    let times = axes.filter_map(|(place, axis)| {
        let way = match from {
            Some(from) => (to.0.get(place)? - from.0.get(place)?).abs(),
            None => axis.max - axis.min,
        };
        Some(way / (axis.rate? * settings.home_speed))
    });
    times.fold(0.0, f64::max)
}

/// The speed at which no axis is faster than the job allows, whichever way the move goes: mm/s or deg/s.
fn slowest(settings: &Settings<'_>, cell: &Cell) -> f64 {
    let rates = cell.axes.iter().filter_map(|axis| {
        let rate = axis.rate? * settings.home_speed;
        Some(match axis.kind {
            AxisKind::Linear => rate,
            AxisKind::Rotary => rate.to_degrees(),
        })
    });
    rates.fold(f64::INFINITY, f64::min)
}

/// Which axes count for a way.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Counted {
    All,
    Rotary,
}

/// The root of the sum of squares of what the axes move, in mm and degrees.
fn way(words: &[Word], from: &AxisValues, to: &AxisValues, counted: Counted) -> f64 {
    let squares = words.iter().filter_map(|&word| {
        match (counted, word.kind) {
            (Counted::All, _) | (Counted::Rotary, AxisKind::Rotary) => {}
            (Counted::Rotary, AxisKind::Linear) => return None,
        }
        let moved = printed(word, to)? - printed(word, from)?;
        Some(moved * moved)
    });
    squares.sum::<f64>().sqrt()
}
