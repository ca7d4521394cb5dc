//! Teeth that meet a mode of the arm.
//!
//! The teeth of a crusher push it one after the other: as often as it turns, times their number.

use super::meeting::{Across, Met, met};
use super::samples::Sample;
use crate::blade::PushedBlade;
use crate::cuts::cutting;
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

/// What cuts with teeth, as far as it has been looked at, operation by operation.
#[derive(Default)]
pub(super) struct Crushers<'b>(BTreeMap<OperationId, (&'b Crusher, f64, Vec<Across>)>);

impl<'b> Crushers<'b> {
    /// Takes the modes at a sample of a cut by one of these blades. What cuts without a crusher that states its teeth is left out.
    pub(super) fn take(&mut self, sample: &Sample<'_>, blades: &BTreeMap<&str, PushedBlade<'b>>) {
        let Sample { known, segment, .. } = sample;
        let blade = known.reached.program().blade(segment.before.tool);
        let blade = blade.and_then(|blade| blades.get(blade.name.as_str()));
        let blade = blade.map(|blade| blade.blade);
        let (Some((operation, ..)), Some(BladeRef::Crusher(crusher))) = (cutting(segment), blade) else {
            return;
        };
        let Some(forces) = &crusher.forces else { return };
        let count = f64::from(forces.count.get());
        let (_, _, across) = self.0.entry(operation).or_insert((crusher, count, Vec::new()));
        // Walls may be on any side of an upright tool.
        for normal in [DVec3::X, DVec3::Y] {
            across.extend(sample.counting(normal));
        }
    }

    /// Whether their teeth meet the modes.
    pub(super) fn teeth(self) -> Vec<Teeth> {
        let each = self.0.into_iter().map(|(operation, (crusher, count, across))| {
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
        each.collect()
    }
}
