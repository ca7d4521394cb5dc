//! Where a motion of one axis lies in the range of that axis, and by which turns it can be moved on.

use core::f64::consts::TAU;
use vcutc_backend_api::ir::{Axis, AxisKind};
use vcutc_machine::kinematics::Joints;

/// An axis' distance to the nearer limit over half of its range.
#[must_use]
pub fn axis_margin(axis: &Axis, low: f64, high: f64) -> f64 {
    let half = (axis.max - axis.min) / 2.0;
    let left = (low - axis.min).min(axis.max - high);
    if half > 0.0 {
        left / half
    } else if left >= 0.0 {
        // An axis that cannot move at all takes nothing away where it need not.
        1.0
    } else {
        -1.0
    }
}

/// By how much an axis may be beyond its limit, in rad or mm: rounding.
pub(super) const AT_LIMIT: f64 = 1e-9;

/// The turns by which a rotary axis that sweeps from `low` to `high` can be moved on so that it stays in its range, in rad,
/// from the lowest; for a linear axis 0 or nothing.
pub(super) fn turns(axis: &Axis, low: f64, high: f64) -> Vec<f64> {
    let fits = |by: f64| low + by >= axis.min - AT_LIMIT && high + by <= axis.max + AT_LIMIT;
    match axis.kind {
        AxisKind::Linear => [0.0].into_iter().filter(|&by| fits(by)).collect(),
        AxisKind::Rotary => {
            let first = ((axis.min - AT_LIMIT - low) / TAU).ceil();
            (0..MOST_TURNS)
                .map(|turn| (first + f64::from(turn)) * TAU)
                .take_while(|&by| fits(by))
                .collect()
        }
    }
}

/// The turns by which a sweep is moved to lie most in the middle of an axis' range, in rad; none for a linear axis.
pub(super) fn turn_to_middle(axis: &Axis, low: f64, high: f64) -> f64 {
    match axis.kind {
        AxisKind::Rotary => {
            ((f64::midpoint(axis.min, axis.max) - f64::midpoint(low, high)) / TAU).round() * TAU
        }
        AxisKind::Linear => 0.0,
    }
}

/// Most turns of one axis that are told apart; catalogues have none with more than five.
const MOST_TURNS: u32 = 16;

/// The margin at axis values, each axis on its best turn: the one nearest to the middle of its range.
pub(super) fn best_margin(axes: &[Axis], joints: &Joints) -> f64 {
    let margins = axes.iter().zip(joints).map(|(axis, &value)| {
        let by = turn_to_middle(axis, value, value);
        axis_margin(axis, value + by, value + by)
    });
    margins.fold(f64::INFINITY, f64::min)
}
