//! How a blade turns about the vertical: along its slits, and in the air between them.

use crate::posture::Feed;
use core::f64::consts::{FRAC_PI_2, PI, TAU};

/// Turns in the air go on by at most this much at once, in rad: half a revolution could go either way, and a
/// blade may lean as well.
const LARGEST_TURN: f64 = 2.0 * PI / 3.0;

/// How far the middle of a slit's turning may be from where the blade cuts along y, in rad, beyond the right angle that some way to hold the
/// blade always keeps to: a judgement. More winds up the cable; with less a blade is turned over where a wall goes on.
const IN_HAND: f64 = PI / 4.5;

/// Turns that differ by less are alike, in rad.
const ALIKE: f64 = 1e-6;

/// How a slit is cut.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Turned {
    /// Whether the front or the back of the blade leads: both cut.
    pub(super) feed: Feed,
    /// How the blade is turned at each point, in rad from where it cuts along y.
    pub(super) yaws: Vec<f64>,
    /// Turns through which it goes there from the slit before.
    pub(super) before: Vec<f64>,
}

/// How a blade is turned, in rad from where it cuts along y, counted on without a break. Operations find and leave it at 0.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Yaw {
    at: f64,
}

impl Yaw {
    /// Turns of a slit with these headings, in rad, of which none is half a turn or more from the one before.
    ///
    /// Either edge may be in front. Of the ways to hold the blade the nearest one is taken that does not wind it up.
    pub(super) fn along(&mut self, headings: &[f64]) -> Turned {
        let mut yaws: Vec<f64> = Vec::with_capacity(headings.len());
        let mut before: Option<f64> = None;
        for &heading in headings {
            let yaw = match (yaws.last(), before) {
                (Some(yaw), Some(before)) => yaw + wrapped(heading - before),
                _ => heading - FRAC_PI_2,
            };
            yaws.push(yaw);
            before = Some(heading);
        }
        let first = yaws.first().copied().unwrap_or(0.0);
        let last = yaws.last().copied().unwrap_or(0.0);
        let middle = f64::midpoint(first, last);
        let centre = libm::round(middle / PI);
        let shifts = (-4..=4).map(|k| f64::from(k) - centre);
        // Beyond what is allowed what winds up the least; within it what turns the least; then what is nearest to the middle.
        let cost = |shift: f64| {
            let off = (middle + shift * PI).abs();
            let wound = if off <= FRAC_PI_2 + IN_HAND { 0.0 } else { off };
            let turn = (first + shift * PI - self.at).abs();
            [wound, libm::round(turn / ALIKE), libm::round(off / ALIKE)]
        };
        let best = shifts.min_by(|&one, &other| {
            let pairs = cost(one).into_iter().zip(cost(other));
            let orders = pairs.map(|(one, other)| one.total_cmp(&other));
            orders.fold(core::cmp::Ordering::Equal, core::cmp::Ordering::then)
        });
        let shift = best.unwrap_or(0.0);
        let yaws: Vec<f64> = yaws.iter().map(|yaw| yaw + shift * PI).collect();
        let is_odd = libm::fmod(shift.abs(), 2.0) > 0.5;
        let begin = first + shift * PI;
        let before = between(self.at, begin);
        self.at = yaws.last().copied().unwrap_or(self.at);
        Turned {
            feed: if is_odd { Feed::Backward } else { Feed::Forward },
            yaws,
            before,
        }
    }
}

impl Yaw {
    /// Turns that bring the blade back to where operations find it.
    pub(super) fn back(self) -> Vec<f64> {
        if self.at.abs() < ALIKE {
            return Vec::new();
        }
        let mut turns = between(self.at, 0.0);
        turns.push(0.0);
        turns
    }
}

/// Turns between two, so that no step is too large.
fn between(from: f64, to: f64) -> Vec<f64> {
    // A blade is turned by a few times around at most.
    let steps = libm::ceil((to - from).abs() / LARGEST_TURN).max(1.0) as u32;
    (1..steps)
        .map(|step| from + (to - from) * (f64::from(step) / f64::from(steps)))
        .collect()
}

/// An angle between minus half a turn and half a turn.
fn wrapped(angle: f64) -> f64 {
    angle - TAU * libm::round(angle / TAU)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn turned(slits: &[&[f64]]) -> Vec<Turned> {
        let mut yaw = Yaw::default();
        slits
            .iter()
            .map(|headings| {
                let headings: Vec<f64> = headings.iter().map(|deg| deg.to_radians()).collect();
                yaw.along(&headings)
            })
            .collect()
    }

    /// Around a rectangle the blade turns to and fro by a right angle.
    #[test]
    fn around_a_rectangle() {
        let turned = turned(&[&[0.0], &[90.0], &[180.0], &[-90.0]]);
        let mut last = turned[0].yaws[0];
        for side in &turned[1..] {
            assert!((side.yaws[0] - last).abs() < FRAC_PI_2 + 1e-9, "{turned:?}");
            assert!(side.yaws[0].abs() < FRAC_PI_2 + 1e-9 && side.before.is_empty());
            last = side.yaws[0];
        }
    }

    /// After a whole turn the blade is turned back in the air, by steps of which none could go either way.
    #[test]
    fn circles_do_not_wind_up() {
        let circle: Vec<f64> = (0..=4).map(|k| 90.0 * f64::from(k)).collect();
        let turned = turned(&[&circle, &circle, &circle]);
        for slit in &turned {
            assert!(slit.yaws.iter().all(|yaw| yaw.abs() <= 1.5 * PI), "{slit:?}");
        }
        assert!(turned[1].before.len() >= 2, "{turned:?}");
    }
}
