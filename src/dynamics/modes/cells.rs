//! Cells of the core that meet a mode of the arm.
//!
//! An edge goes through the walls of cells one after the other, and each pushes it: `v / cell` times a second at a speed `v`.

use super::meeting::{Across, Met, counting, met};
use super::samples::along_cuts;
use crate::arms::Arms;
use crate::chain::Chain;
use crate::cuts::{Known, cutting};
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
        let (_, across) = found.entry(operation).or_insert((speed, Vec::new()));
        across.extend(counting(segment.id, &modes, along_normal));
    })?;
    let each = found.into_iter().map(|(operation, (speed, across))| {
        let (value, per) = (speed.to_mm_per_s(), size.to_mm());
        Cells {
            operation,
            speed,
            rate: value / per,
            met: met(value, per, &across),
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
