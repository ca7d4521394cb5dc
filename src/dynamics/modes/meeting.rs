//! Modes of the arm that a steady rate of pushes meets.
//!
//! An arm that swings by itself at about the rate at which it is pushed swings up. How far depends on its damping and on how hard each push
//! is, which are not known; so what is found is only that the two rates meet, and for modes that move the blade along the normal of what it
//! forms.

use super::Mode;
use crate::chain::JOINTS;
use vcutc_backend_api::ir::OpId;

/// Rates meet that are apart by no more than this share of the mode's: at 3 % of damping a push then moves the arm no more than 2.8 times
/// as far as a steady one of its size.
const APART: f64 = 0.2;

/// The least share of how far the blade yields along a normal for which a mode counts.
const LEAST_SHARE: f64 = 0.1;

/// A mode that a rate meets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Met {
    /// Of all that it meets, the one that moves the blade farthest along the normal is found here.
    pub op: OpId,
    /// In Hz.
    pub frequency: f64,
    /// Its share of how far the blade yields along the normal.
    pub share: f64,
    /// The nearest lower value, in whole units of what decides the rate, that meets no mode on any cut of the operation, if there is one.
    pub lower: Option<f64>,
    /// The nearest higher one.
    pub higher: f64,
}

/// A mode at a sample, as far as it moves the blade along a normal.
#[derive(Clone, Copy)]
pub(super) struct Across {
    op: OpId,
    frequency: f64,
    share: f64,
}

/// The modes at a sample that count along a normal, along which the axes move the blade so.
pub(super) fn counting(
    op: OpId,
    modes: &[Mode; JOINTS],
    along_normal: [f64; JOINTS],
) -> impl Iterator<Item = Across> {
    let all = modes.iter().zip(shares(modes, along_normal));
    let counting = all.filter(|(_, share)| *share >= LEAST_SHARE);
    counting.map(move |(mode, share)| Across {
        op,
        frequency: mode.frequency,
        share,
    })
}

/// The share of each mode of how far the blade yields to a steady push along a normal, along which the axes move it so.
pub(super) fn shares(modes: &[Mode; JOINTS], along_normal: [f64; JOINTS]) -> [f64; JOINTS] {
    let squares = modes.map(|mode| {
        let swings = mode.swings.iter().zip(along_normal);
        let moved: f64 = swings.map(|(swing, along)| swing * along).sum();
        moved * moved
    });
    let whole: f64 = squares.iter().sum();
    squares.map(|square| square / whole)
}

/// The mode that pushes meet which moves the blade most; the first among equals. They come at a rate of 1 Hz for each `per` of what decides it,
/// which has this value.
pub(super) fn met(value: f64, per: f64, across: &[Across]) -> Option<Met> {
    let all = across.iter().filter(|mode| mode.meets(value / per));
    let most = all.reduce(|best, next| if next.share > best.share { next } else { best })?;
    Some(Met {
        op: most.op,
        frequency: most.frequency,
        share: most.share,
        lower: lower(value, per, across),
        higher: higher(value, per, across),
    })
}

impl Across {
    fn meets(&self, rate: f64) -> bool {
        (rate - self.frequency).abs() < APART * self.frequency
    }
}

/// The nearest higher whole value that meets no mode.
fn higher(value: f64, per: f64, across: &[Across]) -> f64 {
    let mut value = value;
    loop {
        let met = across.iter().filter(|mode| mode.meets(value / per));
        let ends = met.map(|mode| (1.0 + APART) * mode.frequency * per);
        match ends.reduce(f64::max) {
            Some(end) => value = end.ceil().max(value.floor() + 1.0),
            None => return value,
        }
    }
}

/// The nearest lower one, if there is one.
fn lower(value: f64, per: f64, across: &[Across]) -> Option<f64> {
    let mut value = value;
    while value > 0.0 {
        let met = across.iter().filter(|mode| mode.meets(value / per));
        let ends = met.map(|mode| (1.0 - APART) * mode.frequency * per);
        match ends.reduce(f64::min) {
            Some(end) => value = end.floor().min(value.ceil() - 1.0),
            None => return Some(value),
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    const fn mode(frequency: f64, share: f64) -> Across {
        Across {
            op: OpId(0),
            frequency,
            share,
        }
    }

    #[test]
    fn the_mode_that_moves_the_blade_most_is_met() {
        let across = [mode(22.0, 0.2), mode(25.4, 0.6), mode(40.0, 0.9)];
        // 80 mm/s through cells of 3.2 mm.
        let met = met(80.0, 3.2, &across).unwrap();
        assert!((met.frequency, met.share) == (25.4, 0.6));
        // 22 and 25.4 Hz are met from 17.6 to 30.48 Hz, which is 97.5 mm/s; 40 Hz only from 102.4 mm/s on.
        assert_eq!(met.lower, Some(56.0));
        assert_eq!(met.higher, 98.0);
    }

    /// Against a search through all whole speeds.
    #[test]
    fn speeds_that_are_offered_are_the_nearest_clear_ones() {
        let all = [10.0, 14.0, 20.0, 29.0, 80.0].map(|frequency| mode(frequency, 0.5));
        for across in [&all[..], &all[1..], &all[..4], &all[..1]] {
            let is_clear = |speed: f64| !across.iter().any(|mode| mode.meets(speed / 3.2));
            for speed in (1..400_u32).map(f64::from).filter(|speed| !is_clear(*speed)) {
                let up = (1..2000_u32)
                    .map(|by| speed + f64::from(by))
                    .find(|speed| is_clear(*speed));
                let down = (1..2000_u32)
                    .map(|by| speed - f64::from(by))
                    .find(|speed| *speed <= 0.0 || is_clear(*speed))
                    .filter(|speed| *speed > 0.0);
                assert_eq!(Some(higher(speed, 3.2, across)), up, "{speed}");
                assert_eq!(lower(speed, 3.2, across), down, "{speed}");
            }
        }
    }

    #[test]
    fn rates_that_are_apart_meet_nothing() {
        let across = [mode(25.4, 0.9)];
        assert_eq!(met(200.0, 3.2, &across), None);
        assert_eq!(met(30.5 * 3.2, 3.2, &across), None);
        assert!(met(30.4 * 3.2, 3.2, &across).is_some());
    }
}
