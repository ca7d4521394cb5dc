//! Where modes are looked at along the cuts of a program.

use super::Mode;
use crate::arms::Arms;
use crate::chain::JOINTS;
use crate::cuts::{Known, cutting};
use crate::springs::Springs;
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

/// Takes the modes at the samples of all cuts, in order, with the cut and the values of the axes. None where masses or stiffness are not
/// known, where a joint moves no mass, and where the masses are not bodies.
pub(super) fn along_cuts(
    known: Known<'_>,
    arms: &Arms,
    mut take: impl FnMut(&Segment<'_>, &Joints, [Mode; JOINTS]),
) -> Option<()> {
    let springs = Springs::from(known.model.elasticity.as_ref()?);
    if known.model.masses.as_ref()?.kind == Kind::Lumped {
        return None;
    }
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
            take(&segment, &joints, arm.modes(&joints, &springs)?);
        }
    }
    Some(())
}
