//! How far cuts would deviate with the work in another place: by a few places of them, quickly.
//!
//! Forces and edges do not depend on where the work stands, the arm's posture does. So what is known of the cuts where a program is
//! carried out also answers for another base, once the arm is led to the same places of the cuts there. Between places nothing is
//! proven: a search goes by it, and proves what it finds.

use super::Deviations;
use vcutc_backend_api::ir::{OpId, ToolId};
use vcutc_backend_api::motion::Branch;
use vcutc_backend_api::units::Length;
use vcutc_machine::kinematics::pose::Pose;

/// A place of a cut.
#[derive(Clone, Copy, Debug)]
struct Place {
    op: OpId,
    done: f64,
    tool: ToolId,
    blade_in_work: Pose,
}

/// Places of the cuts of a program, on an arm whose joints yield.
pub struct MovedBase<'d, 'c> {
    deviations: &'d Deviations<'c>,
    places: Vec<Place>,
}

/// Most cuts that are looked at.
const MOST_CUTS: usize = 40;

/// Where on a cut.
const DONE: [f64; 3] = [0.0, 0.5, 1.0];

impl<'d, 'c> MovedBase<'d, 'c> {
    /// Evenly through the program, and the cut with the largest force.
    #[must_use]
    pub fn of(deviations: &'d Deviations<'c>) -> Self {
        let cuts = deviations.cuts;
        let program = cuts.known().reached.program();
        let ops: Vec<OpId> = cuts.wholes().map(|whole| whole.op).collect();
        let step = ops.len().div_ceil(MOST_CUTS).max(1);
        let hardest = cuts.largest_force().map(|largest| largest.op);
        let chosen = ops.iter().step_by(step).copied().chain(hardest);
        let places = chosen.flat_map(|op| DONE.map(|done| (op, done)));
        let places = places.filter_map(|(op, done)| {
            let cut = cuts.get(op)?;
            Some(Place {
                op,
                done,
                tool: cut.tool,
                blade_in_work: Pose::from(cut.frame_at(program, done)?),
            })
        });
        Self {
            deviations,
            places: places.collect(),
        }
    }

    /// The most that an edge is off either way in these places, with the work there and the arm on this branch, with forces and joints
    /// anywhere within what is stated. None where the arm does not reach one of them.
    #[must_use]
    pub fn most(&self, work_in_root: &Pose, branch: Branch) -> Option<Length> {
        let known = self.deviations.cuts.known();
        let mut most = Length::ZERO;
        for place in &self.places {
            let rig = known.rigs.with(place.tool).with_work(*work_in_root);
            let ways = rig.mechanism.all(&rig.flange_in_root(&place.blade_in_work));
            let way = ways.iter().find(|way| way.branch == branch)?;
            most = most.max(self.deviations.most_in_place(place.op, place.done, &way.joints)?);
        }
        Some(most)
    }
}
