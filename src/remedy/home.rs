//! A home above the first cut.

use crate::case::Case;
use crate::change::Change;
use crate::wording;
use vcutc_backend_api::ir::AxisValues;
use vcutc_motion::moves::above_first_pose;
use vcutc_motion::rig::Rig;

/// How far above the first pose of the program the blade is at home, in mm.
const RAISED: [f64; 3] = [100.0, 300.0, 0.0];
/// Most homes that are tried.
const MOST_HOMES: usize = 6;

/// A home from which the blade comes to the work from above, in whole degrees.
pub(crate) fn raised(case: &mut Case<'_>) -> Option<Change> {
    case.machine.home?;
    let (job, program) = (case.job, case.unreachable.program.program());
    let rig = Rig::of(case.machine);
    let is_within = |joints: &[f64]| {
        let mut pairs = rig.axes.iter().zip(joints);
        pairs.all(|(axis, value)| (axis.min..=axis.max).contains(value))
    };
    let homes: Vec<AxisValues> = RAISED
        .into_iter()
        .filter_map(|raised| above_first_pose(program, raised))
        .flat_map(|above| {
            let solutions = rig.mechanism.all(&rig.flange_in_root(&above));
            let joints = solutions.iter().map(|solution| solution.joints);
            joints.filter(|joints| is_within(joints)).collect::<Vec<_>>()
        })
        .map(|joints| wording::rounded_home(rig.axes, &AxisValues(joints)))
        .take(MOST_HOMES)
        .collect();
    case.first(homes.iter().map(|home| Change::home(job, home)))
}
