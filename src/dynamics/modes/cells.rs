//! Cells of the core that meet a mode of the arm.
//!
//! An edge goes through the walls of cells one after the other, and each pushes it: `v / cell` times a second at a speed `v`. An
//! arm that swings by itself at about that rate swings up. How far depends on its damping and on how hard each wall pushes, which are not
//! known; so what is found is only that the two rates meet, and for modes that move the blade across its flank.

use super::Mode;
use super::samples::along_cuts;
use crate::arms::Arms;
use crate::chain::{Chain, JOINTS};
use crate::cuts::{Known, cutting};
use glam::DVec3;
use std::collections::BTreeMap;
use vcutc_backend_api::ir::{Action, Blade, OpId, OperationId, Program};
use vcutc_backend_api::segments::Segment;
use vcutc_backend_api::units::{Length, Speed};

/// Rates meet that are apart by no more than this share of the mode's: at 3 % of damping a wall then pushes the arm no more than 2.8 times
/// as far as a steady push of its size.
const APART: f64 = 0.2;

/// The least share of how far the blade yields across its flank for which a mode counts.
const LEAST_SHARE: f64 = 0.1;

/// What is found of an operation that cuts with an edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cells {
    pub operation: OperationId,
    /// How fast it cuts.
    pub speed: Speed,
    /// How often its edge goes through a wall, in Hz.
    pub rate: f64,
    /// The mode that it meets, if it meets any.
    pub met: Option<Met>,
}

/// A mode that cells meet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Met {
    /// Of all that they meet, the one that moves the blade farthest across its flank is found here.
    pub op: OpId,
    /// In Hz.
    pub frequency: f64,
    /// Its share of how far the blade yields across its flank.
    pub share: f64,
    /// The nearest slower speed in whole mm/s that meets no mode on any cut of the operation, if there is one.
    pub slower: Option<Speed>,
    /// The nearest faster one.
    pub faster: Speed,
}

/// A mode at a sample, as far as it moves the blade across its flank.
#[derive(Clone, Copy)]
struct Across {
    op: OpId,
    frequency: f64,
    share: f64,
}

/// Whether cells of this size meet modes, operation by operation. None where modes are not known; what cuts with no edge has none.
#[must_use]
pub fn cells(known: Known<'_>, arms: &Arms, size: Length) -> Option<Vec<Cells>> {
    let chain = Chain::of(&known.model.mechanism)?;
    let program = known.reached.program();
    let mut found: BTreeMap<OperationId, (Speed, Vec<Across>)> = BTreeMap::new();
    along_cuts(known, arms, |segment, joints, modes| {
        let tool = segment.before.tool;
        let is_straight = |blade: &Blade| blade.straight().is_some();
        let (Some((operation, ..)), Some(speed), true) = (
            cutting(segment),
            speed(program, segment),
            program.blade(tool).is_some_and(is_straight),
        ) else {
            return;
        };
        let hand = chain.in_hand(known.rigs.with(tool).flange_in_blade.inverse());
        let normal = (hand.rotation * DVec3::Y).to_array();
        let columns = chain.columns(&chain.turns(joints), hand.position.to_array());
        let along_normal = columns.map(|column| column.of_force(normal));
        let all = modes.iter().zip(shares(&modes, along_normal));
        let counting = all.filter(|(_, share)| *share >= LEAST_SHARE);
        let (_, across) = found.entry(operation).or_insert((speed, Vec::new()));
        across.extend(counting.map(|(mode, share)| Across {
            op: segment.id,
            frequency: mode.frequency,
            share,
        }));
    })?;
    let each = found.into_iter().map(|(operation, (speed, across))| {
        let rate = speed.to_mm_per_s() / size.to_mm();
        Cells {
            operation,
            speed,
            rate,
            met: met(rate, &across, size),
        }
    });
    Some(each.collect())
}

/// How fast a cut is.
fn speed(program: &Program, segment: &Segment<'_>) -> Option<Speed> {
    match segment.op.action {
        Action::Cut { feed, .. } | Action::Follow { feed, .. } => program.feed(feed),
        _ => None,
    }
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

/// The mode that a rate meets which moves the blade most; the first among equals.
fn met(rate: f64, across: &[Across], size: Length) -> Option<Met> {
    let all = across.iter().filter(|mode| mode.meets(rate));
    let most = all.reduce(|best, next| if next.share > best.share { next } else { best })?;
    let speed = rate * size.to_mm();
    Some(Met {
        op: most.op,
        frequency: most.frequency,
        share: most.share,
        slower: slower(speed, across, size),
        faster: faster(speed, across, size),
    })
}

impl Across {
    fn meets(&self, rate: f64) -> bool {
        (rate - self.frequency).abs() < APART * self.frequency
    }
}

/// The nearest faster speed in whole mm/s that meets no mode.
fn faster(speed: f64, across: &[Across], size: Length) -> Speed {
    let mut speed = speed;
    loop {
        let met = across.iter().filter(|mode| mode.meets(speed / size.to_mm()));
        let ends = met.map(|mode| (1.0 + APART) * mode.frequency * size.to_mm());
        match ends.reduce(f64::max) {
            Some(end) => speed = end.ceil().max(speed.floor() + 1.0),
            None => return Speed::mm_per_s(speed),
        }
    }
}

/// The nearest slower one, if there is one.
fn slower(speed: f64, across: &[Across], size: Length) -> Option<Speed> {
    let mut speed = speed;
    while speed > 0.0 {
        let met = across.iter().filter(|mode| mode.meets(speed / size.to_mm()));
        let ends = met.map(|mode| (1.0 - APART) * mode.frequency * size.to_mm());
        match ends.reduce(f64::min) {
            Some(end) => speed = end.floor().min(speed.ceil() - 1.0),
            None => return Some(Speed::mm_per_s(speed)),
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
        let met = met(25.0, &across, Length::mm(3.2)).unwrap();
        assert!((met.frequency, met.share) == (25.4, 0.6));
        // 22 and 25.4 Hz are met from 17.6 to 30.48 Hz, which is 97.5 mm/s; 40 Hz only from 102.4 mm/s on.
        assert_eq!(met.slower, Some(Speed::mm_per_s(56.0)));
        assert_eq!(met.faster, Speed::mm_per_s(98.0));
    }

    /// Against a search through all whole speeds.
    #[test]
    fn speeds_that_are_offered_are_the_nearest_clear_ones() {
        let size = Length::mm(3.2);
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
                assert_eq!(
                    Some(faster(speed, across, size)),
                    up.map(Speed::mm_per_s),
                    "{speed}"
                );
                assert_eq!(slower(speed, across, size), down.map(Speed::mm_per_s), "{speed}");
            }
        }
    }

    #[test]
    fn rates_that_are_apart_meet_nothing() {
        let across = [mode(25.4, 0.9)];
        assert_eq!(met(62.5, &across, Length::mm(3.2)), None);
        assert_eq!(met(30.5, &across, Length::mm(3.2)), None);
        assert!(met(30.4, &across, Length::mm(3.2)).is_some());
    }
}
