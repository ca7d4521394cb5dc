//! Runs: the stretches of a program within which the axes move on without a break.
//!
//! A run begins where all axes move at once, for there the machine may come to stand in another way; or, if the caller asks
//! for it, wherever they might.

use super::legs::{Detour, Leg, Stroke, Taught, numbered};
use core::ops::Range;
use vcutc_backend_api::ir::OpId;

/// A stretch of a program, beginning with the op that leads to it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Station {
    pub(super) kind: StationKind,
    /// Its ops, as places in the program; the first leads to it.
    pub(super) ops: Range<usize>,
}

/// Kinds of station.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum StationKind {
    /// The machine is at home.
    Home,
    /// A run that is reached by an axis move.
    Run(Taught),
    /// A run that is reached along a course, which an axis move could take the place of.
    Joined(Stroke),
}

/// Where a program is taken apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Split {
    /// Where all axes move at once.
    AtAxisMoves,
    /// Also where they might.
    AtDetours,
}

impl Station {
    /// The op that leads to it.
    pub(super) fn entry(&self) -> OpId {
        OpId(u32::try_from(self.ops.start).unwrap_or(u32::MAX))
    }

    /// The pose with which a run begins.
    pub(super) const fn begins(&self) -> Option<Taught> {
        match self.kind {
            StationKind::Home => None,
            StationKind::Run(taught) => Some(taught),
            StationKind::Joined(stroke) => Some(stroke.to),
        }
    }
}

/// Takes a program apart. Ops before the first station belong to none: they move nothing.
pub(super) fn split(legs: &[Leg], split: Split) -> Vec<Station> {
    let mut stations: Vec<Station> = Vec::new();
    for (op, leg) in numbered(legs) {
        let kind = match (leg, split) {
            (Leg::Home, _) => Some(StationKind::Home),
            (&Leg::ByAxes(taught), _) => Some(StationKind::Run(taught)),
            (Leg::Along(stroke), Split::AtDetours) if stroke.detour == Detour::Allowed => {
                Some(StationKind::Joined(*stroke))
            }
            (Leg::Along(_), Split::AtAxisMoves | Split::AtDetours) | (Leg::Still, _) => None,
        };
        let index = op.0 as usize;
        match (kind, stations.last_mut()) {
            (Some(kind), _) => stations.push(Station {
                kind,
                ops: index..index + 1,
            }),
            (None, Some(station)) => station.ops.end = index + 1,
            (None, None) => {}
        }
    }
    stations
}
