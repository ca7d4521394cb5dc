//! How long runs take: it weighs patterns and ways down against each other.

use super::{Entry, Leg, Run, path};
use crate::asked::ClearPocket;
use vcutc_backend_api::units::{Duration, Length, Speed};

/// With how much a machine is taken to brake and start again at corners, in mm/s2: it weighs patterns, and enters nothing else.
const ACCELERATION: f64 = 2000.0;

/// The speeds of a job, and how thick its layers are.
#[derive(Clone, Copy, Debug)]
pub(super) struct Clock {
    cut: Speed,
    slow: Speed,
    /// The steepest way down, in rad.
    ramp: f64,
    /// The thickness of a layer, in mm.
    deep: f64,
    /// Up, across and down again: twice the clearance at the speed of travel.
    lift: Duration,
}

impl Clock {
    pub(super) fn of(asked: &ClearPocket, deep: f64) -> Self {
        Self {
            cut: asked.setup.cut_feed.value,
            slow: asked.plunge_feed.value,
            ramp: asked.crusher.ramp.value.to_rad(),
            deep,
            lift: asked.setup.clearance.value * 2.0 / asked.setup.travel_feed.value,
        }
    }

    /// The runs of a layer: their ways, their ways down, and the stops at their corners.
    pub(super) fn of_runs(&self, runs: &[Run]) -> Duration {
        let of = |run: &Run| {
            let stops = stop(self.cut) * (1 + corners(&run.legs)) as f64;
            self.of_legs(&run.legs) + self.down(run.entry) + stops + self.lift
        };
        runs.iter().map(of).sum()
    }

    /// Ways at the floor.
    pub(super) fn of_legs(&self, legs: &[Leg]) -> Duration {
        let feed = |leg: &Leg| if leg.kind.is_slow() { self.slow } else { self.cut };
        legs.iter()
            .map(|leg| Length::mm(leg.piece.length()) / feed(leg))
            .sum()
    }

    /// The way down, with the stops at its ends and corners: the tool gets there no faster than it goes down.
    pub(super) fn down(&self, entry: Entry) -> Duration {
        let (way, stops) = match entry {
            Entry::Ramp { line } => {
                let ways = f64::from(path::ways_down(line, self.deep, self.ramp));
                let sloping = libm::hypot(line.length() * ways, self.deep);
                (sloping + 2.0 * line.length(), ways + 2.0)
            }
            Entry::Helix { helix } => {
                let sides = f64::from(helix.sides_down(self.deep, self.ramp)) + f64::from(helix.corners);
                (sides * helix.side(), sides)
            }
            Entry::Hole { .. } | Entry::Return { .. } | Entry::Open { .. } => (0.0, 0.0),
        };
        Length::mm(way) / self.slow + stop(self.slow) * stops
    }
}

/// How much longer a way takes with a stop from this speed: braking and starting take twice the time of the same way at speed.
fn stop(from: Speed) -> Duration {
    Duration::s(from.to_mm_per_s() / ACCELERATION)
}

/// How many corners a run has at which it comes to a stop.
fn corners(legs: &[Leg]) -> usize {
    let pairs = legs.iter().zip(legs.iter().skip(1));
    pairs
        .filter(|(before, after)| {
            let (out, on) = (before.piece.direction(1.0), after.piece.direction(0.0));
            libm::atan2(out.cross(on), out.dot(on)).abs() > vcutc_backend_api::verify::LARGEST_KINK.to_rad()
        })
        .count()
}
