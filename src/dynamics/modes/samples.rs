//! Where modes are looked at along the cuts of a program.

use super::Mode;
use super::meeting::{Across, counting};
use crate::arms::Arms;
use crate::chain::{Chain, JOINTS};
use crate::cuts::{Known, cutting};
use crate::springs::Springs;
use glam::DVec3;
use vcutc_backend_api::segments::Segment;
use vcutc_machine::kinematics::Joints;
use vcutc_machine::masses::Kind;
use vcutc_motion::parts::Motions;
use vcutc_motion::path::Part;

/// On each cut: at its beginning, in its middle and at its end.
const SAMPLES: [Part; 3] = [at(0.0), at(0.5), at(1.0)];

const fn at(middle: f64) -> Part {
    Part { middle, half: 0.0 }
}

/// A place of a cut, with the modes of the arm there.
pub(super) struct Sample<'s> {
    pub(super) known: Known<'s>,
    pub(super) segment: &'s Segment<'s>,
    pub(super) modes: [Mode; JOINTS],
    chain: &'s Chain,
    joints: Joints,
}

impl Sample<'_> {
    /// The modes that count along a normal, seen from the blade.
    pub(super) fn counting(&self, normal: DVec3) -> impl Iterator<Item = Across> {
        let rig = self.known.rigs.with(self.segment.before.tool);
        let hand = self.chain.in_hand(rig.flange_in_blade.inverse());
        let turns = self.chain.turns(&self.joints);
        let columns = self.chain.columns(&turns, hand.position.to_array());
        let normal = (hand.rotation * normal).to_array();
        let along_normal = columns.map(|column| column.of_force(normal));
        counting(self.segment.id, &self.modes, along_normal)
    }
}

/// Takes the modes at the samples of all cuts, in order. None where masses or stiffness are not known, where a joint moves no mass, and
/// where the masses are not bodies.
pub(super) fn along_cuts(known: Known<'_>, arms: &Arms, mut take: impl FnMut(&Sample<'_>)) -> Option<()> {
    let springs = Springs::from(known.model.elasticity.as_ref()?);
    if known.model.masses.as_ref()?.kind == Kind::Lumped {
        return None;
    }
    let chain = Chain::of(&known.model.mechanism)?;
    let motions = Motions::of(known.reached, known.rigs);
    for segment in known.reached.program().segments() {
        if cutting(&segment).is_none() {
            continue;
        }
        let (Some(moving), Some(arm)) = (motions.moving(segment.id), arms.with(segment.before.tool)) else {
            continue;
        };
        for sample in SAMPLES {
            let joints = moving.axes_on(sample)?.map(|axis| axis.middle().middle());
            take(&Sample {
                known,
                segment: &segment,
                modes: arm.modes(&joints, &springs)?,
                chain: &chain,
                joints,
            });
        }
    }
    Some(())
}
