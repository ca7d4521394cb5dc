//! The poses that a program teaches, and the few of them that show whether the machine reaches them all.

use crate::moves::paths;
use glam::DVec3;
use std::collections::BTreeMap;
use vcutc_backend_api::geometry::{Frame, Point3};
use vcutc_backend_api::ir::OrientationId;
use vcutc_backend_api::segments::Path;
use vcutc_backend_api::state::TipPose;
use vcutc_backend_api::verify::VerifiedProgram;
use vcutc_machine::kinematics::pose::Pose;

/// The tips of a program by how the blade is held there, each list in the order of the program.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TaughtPoses {
    groups: Vec<Group>,
}

#[derive(Clone, Debug, PartialEq)]
struct Group {
    held: Pose,
    tips: Vec<DVec3>,
}

impl TaughtPoses {
    /// The poses at the ends of a program's moves. A pose that comes again and again is kept once in a row.
    #[must_use]
    pub fn of(program: &VerifiedProgram) -> Self {
        let mut groups: BTreeMap<OrientationId, Group> = BTreeMap::new();
        let paths = paths(program.program());
        for TipPose { tip, orientation } in paths.iter().filter_map(Path::target) {
            let group = groups.entry(orientation).or_insert_with(|| Group {
                held: Pose::from(Frame {
                    origin: Point3::new(0.0, 0.0, 0.0),
                    orientation: program.orientation(orientation),
                }),
                tips: Vec::new(),
            });
            let tip = DVec3::new(tip.x, tip.y, tip.z);
            if group.tips.last() != Some(&tip) {
                group.tips.push(tip);
            }
        }
        Self {
            groups: groups.into_values().collect(),
        }
    }

    /// All poses of the blade in the work.
    pub fn all(&self) -> impl Iterator<Item = Pose> {
        self.groups
            .iter()
            .flat_map(|group| group.tips.iter().map(|&tip| group.pose(tip)))
    }

    /// The critical poses: for every orientation the tips farthest out in 26 directions (to the corners, edges and
    /// faces of their box), and `spread` others evenly through the program; at most [`MOST_CRITICAL`] together.
    #[must_use]
    pub fn outermost(&self, spread: usize) -> Vec<Pose> {
        let poses: Vec<Pose> = self
            .groups
            .iter()
            .flat_map(|group| group.outermost(spread).into_iter().map(|tip| group.pose(tip)))
            .collect();
        let step = poses.len().div_ceil(MOST_CRITICAL).max(1);
        poses.into_iter().step_by(step).collect()
    }
}

/// Most poses that a base is judged by in a search.
pub const MOST_CRITICAL: usize = 400;

impl Group {
    fn pose(&self, tip: DVec3) -> Pose {
        Pose {
            rotation: self.held.rotation,
            position: tip,
        }
    }

    fn outermost(&self, spread: usize) -> Vec<DVec3> {
        let step = (self.tips.len() / (spread + 1)).max(1);
        let spread = (step..self.tips.len()).step_by(step).take(spread);
        let mut chosen: Vec<usize> = outermost(&self.tips).into_iter().chain(spread).collect();
        chosen.sort_unstable();
        chosen.dedup();
        let mut tips: Vec<DVec3> = Vec::with_capacity(chosen.len());
        for tip in chosen.into_iter().filter_map(|index| self.tips.get(index)) {
            if !tips.contains(tip) {
                tips.push(*tip);
            }
        }
        tips
    }
}

/// The places of the points farthest out in 26 directions, the first of equals each.
pub(super) fn outermost(points: &[DVec3]) -> Vec<usize> {
    let farthest = |direction: DVec3| {
        let mut best: Option<(usize, f64)> = None;
        for (index, point) in points.iter().enumerate() {
            let out = point.dot(direction);
            if best.is_none_or(|(_, farthest)| out > farthest) {
                best = Some((index, out));
            }
        }
        best.map(|(index, _)| index)
    };
    let mut chosen: Vec<usize> = directions().filter_map(farthest).collect();
    chosen.sort_unstable();
    chosen.dedup();
    chosen
}

/// To the faces, edges and corners of a cube.
fn directions() -> impl Iterator<Item = DVec3> {
    const SIGNS: [f64; 3] = [-1.0, 0.0, 1.0];
    SIGNS.into_iter().flat_map(|x| {
        SIGNS
            .into_iter()
            .flat_map(move |y| SIGNS.into_iter().map(move |z| DVec3::new(x, y, z)))
            .filter(|direction| *direction != DVec3::ZERO)
    })
}
