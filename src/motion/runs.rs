//! Runs: the stretches of a program within which the axes move on without a break.
//!
//! A run begins where all axes move at once, for there the machine may come to stand in another way; or, if the caller asks
//! for it, wherever they might.

use super::moves::numbered;
use core::ops::Range;
use vcutc_backend_api::ir::{Action, OpId, Program};
use vcutc_backend_api::segments::{LinearSegment, Path};
use vcutc_backend_api::state::TipPose;
use vcutc_machine::kinematics::Joints;

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
    Home(Joints),
    /// It is where its blade is changed.
    Change(Joints),
    /// A run that is reached by an axis move.
    Run(TipPose),
    /// A run that is reached along a course, which an axis move could take the place of.
    Joined(LinearSegment),
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

    /// Where the axes are, if its place is given by their values.
    pub(super) const fn stands(&self) -> Option<Joints> {
        match self.kind {
            StationKind::Home(joints) | StationKind::Change(joints) => Some(joints),
            StationKind::Run(_) | StationKind::Joined(_) => None,
        }
    }

    /// The pose with which a run begins.
    pub(super) const fn begins(&self) -> Option<TipPose> {
        match self.kind {
            StationKind::Home(_) | StationKind::Change(_) => None,
            StationKind::Run(taught) => Some(taught),
            StationKind::Joined(line) => Some(line.to),
        }
    }
}

/// Takes a program apart. Ops before the first station belong to none: they move nothing.
pub(super) fn split(program: &Program, paths: &[Path], split: Split) -> Vec<Station> {
    let mut stations: Vec<Station> = Vec::new();
    let cell = program.cell.as_ref();
    let home = cell.and_then(|cell| cell.home).map(|home| home.0);
    let change = cell.and_then(|cell| cell.change).map(|change| change.at.0);
    for (op, path) in numbered(paths) {
        let kind = match (path, split) {
            (Path::Home, _) => home.map(StationKind::Home),
            (Path::Change, _) => change.map(StationKind::Change),
            (&Path::Axes(taught), _) => Some(StationKind::Run(taught)),
            (Path::Linear(line), Split::AtDetours) if may_move_axes(program, op, line) => {
                Some(StationKind::Joined(*line))
            }
            (Path::Linear(_), Split::AtAxisMoves | Split::AtDetours) | (Path::Still, _) => None,
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

/// How far the tip may lie below the stock's top and count as above it, in mm (as in the program's verifier).
const SAME: f64 = 1e-6;

/// Whether a move of all axes may take a line's place: it goes through the air, and both of its ends lie above the stock.
fn may_move_axes(program: &Program, op: OpId, line: &LinearSegment) -> bool {
    let action = program.op(op).map(|op| op.action);
    let top = program.stock.height.to_mm();
    matches!(action, Some(Action::Travel { .. })) && line.from.tip.z.min(line.to.tip.z) >= top - SAME
}
