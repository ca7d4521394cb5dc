//! Teeth that meet a mode of the arm.
//!
//! The teeth of a crusher push it one after the other: as often as it turns, times their number.

use super::meeting::{Across, Met, counting, met};
use super::samples::along_cuts;
use crate::arms::Arms;
use crate::blade::PushedBlade;
use crate::chain::Chain;
use crate::cuts::{Known, cutting};
use core::f64::consts::TAU;
use glam::DVec3;
use std::collections::BTreeMap;
use vcutc_backend_api::ir::OperationId;
use vcutc_job::{BladeRef, Crusher};

/// What is found of an operation that cuts with teeth.
#[derive(Clone, Debug, PartialEq)]
pub struct Teeth {
    pub operation: OperationId,
    /// The name of its blade.
    pub blade: String,
    /// How fast that turns, in rev/min.
    pub spin: f64,
    /// How often a tooth comes, in Hz.
    pub rate: f64,
    /// The mode that they meet, if they meet any; other spins in rev/min.
    pub met: Option<Met>,
}

/// Whether the teeth of these blades meet modes, operation by operation. None where modes are not known; an operation without a crusher that
/// states its teeth has none.
#[must_use]
pub fn teeth(known: Known<'_>, arms: &Arms, blades: &BTreeMap<&str, PushedBlade<'_>>) -> Option<Vec<Teeth>> {
    let chain = Chain::of(&known.model.mechanism)?;
    let program = known.reached.program();
    let mut found: BTreeMap<OperationId, (&Crusher, f64, Vec<Across>)> = BTreeMap::new();
    along_cuts(known, arms, |segment, joints, modes| {
        let tool = segment.before.tool;
        let blade = program
            .blade(tool)
            .and_then(|blade| blades.get(blade.name.as_str()));
        let blade = blade.map(|blade| blade.blade);
        let (Some((operation, ..)), Some(BladeRef::Crusher(crusher))) = (cutting(segment), blade) else {
            return;
        };
        let Some(forces) = &crusher.forces else { return };
        let hand = chain.in_hand(known.rigs.with(tool).flange_in_blade.inverse());
        let columns = chain.columns(&chain.turns(joints), hand.position.to_array());
        let count = f64::from(forces.count.get());
        let (_, _, across) = found.entry(operation).or_insert((crusher, count, Vec::new()));
        // Walls may be on any side of an upright tool.
        for normal in [DVec3::X, DVec3::Y] {
            let normal = (hand.rotation * normal).to_array();
            let along_normal = columns.map(|column| column.of_force(normal));
            across.extend(counting(segment.id, &modes, along_normal));
        }
    })?;
    let each = found.into_iter().map(|(operation, (crusher, count, across))| {
        let spin = crusher.spin.value.to_rad_per_s() / TAU * 60.0;
        let per = 60.0 / count;
        Teeth {
            operation,
            blade: crusher.name.clone(),
            spin,
            rate: spin / per,
            met: met(spin, per, &across),
        }
    });
    Some(each.collect())
}
