//! How fast a motion of all axes may go: the job's `home_speed`.
//!
//! The proof of reach says nothing about these motions but where they end, so their speed is compared with the rates of the
//! axes, as far as the text says where the axes come from. After motions of the tip it says so of rotary axes
//! only.

use super::context::Context;
use crate::controller::AxisPace;
use vcutc_backend_api::ir::{Axis, AxisKind, MOST_AXES};

/// Positions of axes in mm and degrees, where they are known.
pub(super) type Positions = [Option<f64>; MOST_AXES];

const SECONDS_A_MINUTE: f64 = 60.0;

/// What printing may add to a speed.
const SLACK: f64 = 1.001;

/// Whether F makes an axis faster than the job allows.
pub(super) fn is_too_fast(
    context: Context<'_>,
    pace: AxisPace,
    feed: f64,
    from: &Positions,
    to: &Positions,
) -> bool {
    let fine = context.settings.fine().half_unit();
    let feed = (feed - fine).max(0.0);
    let seconds = match pace {
        AxisPace::Rapid => return false,
        AxisPace::InverseTime => SECONDS_A_MINUTE / feed,
        AxisPace::Path => match path(context, from, to) {
            Some(way) => way / feed * SECONDS_A_MINUTE,
            // No axis is faster than all of them together.
            None if is_unknown(from) => return feed > slowest(context) * SECONDS_A_MINUTE * SLACK,
            None => return false,
        },
    };
    least_seconds(context, from, to) > seconds * SLACK
}

fn is_unknown(from: &Positions) -> bool {
    from.iter().all(Option::is_none)
}

/// How long the axes need whose way is known; from an unknown place, how long the longest way of any takes.
fn least_seconds(context: Context<'_>, from: &Positions, to: &Positions) -> f64 {
    let is_at_start = is_unknown(from);
    let axes = context.cell.axes.iter().zip(from.iter().zip(to));
    let times = axes.filter_map(|(axis, (from, to))| {
        let way = match (from, to) {
            // Both are printed, so the way may be shorter than it looks.
            (Some(from), Some(to)) => ((to - from).abs() - 2.0 * grain(context, axis)).max(0.0),
            (None, _) if is_at_start => printed(axis, axis.max - axis.min),
            (_, _) => return None,
        };
        Some(way / rate(context, axis)?)
    });
    times.fold(0.0, f64::max)
}

/// The root of the sum of squares of all ways, mm and degrees counted alike.
fn path(context: Context<'_>, from: &Positions, to: &Positions) -> Option<f64> {
    let axes = context.cell.axes.iter().zip(from.iter().zip(to));
    let squares = axes.map(|(_, (from, to))| {
        let way = (*to)? - (*from)?;
        Some(way * way)
    });
    Some(squares.sum::<Option<f64>>()?.sqrt())
}

/// The lowest speed that the job allows an axis, in mm/s or deg/s.
fn slowest(context: Context<'_>) -> f64 {
    let rates = context.cell.axes.iter().filter_map(|axis| rate(context, axis));
    rates.fold(f64::INFINITY, f64::min)
}

/// The speed that the job allows an axis, in mm/s or deg/s, where its rate is known.
fn rate(context: Context<'_>, axis: &Axis) -> Option<f64> {
    Some(printed(axis, axis.rate? * context.settings.home_speed))
}

/// A value of an axis in mm or degrees.
fn printed(axis: &Axis, value: f64) -> f64 {
    match axis.kind {
        AxisKind::Linear => value,
        AxisKind::Rotary => value.to_degrees(),
    }
}

fn grain(context: Context<'_>, axis: &Axis) -> f64 {
    let format = match axis.kind {
        AxisKind::Linear => context.settings.common.lengths,
        AxisKind::Rotary => context.settings.angles,
    };
    format.half_unit()
}
