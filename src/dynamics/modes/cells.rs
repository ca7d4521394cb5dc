//! Cells of the core that meet a mode of the arm.
//!
//! An edge goes through the walls of cells one after the other, and each pushes it: `v / cell` times a second at a speed `v`.

use super::meeting::{Across, Met, met};
use super::samples::Sample;
use crate::cuts::cutting;
use glam::DVec3;
use std::collections::BTreeMap;
use vcutc_backend_api::ir::{Action, Blade, OperationId, Program};
use vcutc_backend_api::segments::Segment;
use vcutc_backend_api::units::{Length, Speed};

/// What is found of an operation that cuts with an edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cells {
    pub operation: OperationId,
    /// How fast it cuts.
    pub speed: Speed,
    /// How often its edge goes through a wall, in Hz.
    pub rate: f64,
    /// The mode that it meets, if it meets any; other speeds in mm/s.
    pub met: Option<Met>,
}

/// What cuts with an edge, as far as it has been looked at, operation by operation.
#[derive(Default)]
pub(super) struct Edges(BTreeMap<OperationId, (Speed, Vec<Across>)>);

impl Edges {
    /// Takes the modes at a sample of a cut. What cuts with no edge is left out.
    pub(super) fn take(&mut self, sample: &Sample<'_>) {
        let Sample { known, segment, .. } = sample;
        let program = known.reached.program();
        let is_straight = |blade: &Blade| blade.straight().is_some();
        let (Some((operation, ..)), Some(speed), true) = (
            cutting(segment),
            speed(program, segment),
            program.blade(segment.before.tool).is_some_and(is_straight),
        ) else {
            return;
        };
        let (_, across) = self.0.entry(operation).or_insert((speed, Vec::new()));
        across.extend(sample.counting(DVec3::Y));
    }

    /// Whether cells of this size meet the modes.
    pub(super) fn cells(self, size: Length) -> Vec<Cells> {
        let each = self.0.into_iter().map(|(operation, (speed, across))| {
            let (value, per) = (speed.to_mm_per_s(), size.to_mm());
            Cells {
                operation,
                speed,
                rate: value / per,
                met: met(value, per, &across),
            }
        });
        each.collect()
    }
}

/// How fast a cut is.
fn speed(program: &Program, segment: &Segment<'_>) -> Option<Speed> {
    match segment.op.action {
        Action::Cut { feed, .. } | Action::Follow { feed, .. } => program.feed(feed),
        _ => None,
    }
}
