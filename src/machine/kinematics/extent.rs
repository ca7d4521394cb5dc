//! How far apart the places can be to which a machine brings its blade.

use super::Mechanism;
use super::serial::SerialArm;
use glam::DVec3;
use vcutc_backend_api::ir::{Axis, AxisKind};

impl Mechanism {
    /// A length, in mm, that no two places of a point fixed to the flange exceed, seen from the work. None of a machine that turns
    /// the work.
    ///
    /// What a rotary axis carries keeps its distance from every point of that axis. So the way along one point of each axis to the point of
    /// the flange is a chain whose links keep their lengths, and its end stays in a ball about its beginning.
    #[must_use]
    pub fn most_apart(&self, axes: &[Axis], point_in_flange: DVec3) -> Option<f64> {
        let of_arm = |arm: &SerialArm| {
            let joints = arm.axes().iter().map(|axis| axis.point);
            let flange = arm.flange_at_zero();
            let end = flange.rotation * point_in_flange + flange.position;
            2.0 * length(joints.chain([end]))
        };
        match self {
            Self::OrthoParallel(arm) => Some(of_arm(&SerialArm::from(arm))),
            Self::Mounted(arm) => Some(of_arm(&SerialArm::from(arm))),
            Self::Serial(arm) => Some(of_arm(arm)),
            Self::FiveAxis(machine) => {
                if machine.table().next().is_some() {
                    return None;
                }
                let nose = machine.nose_at_zero();
                let end = nose.rotation * point_in_flange + nose.position;
                let head = machine.head().map(|(rotary, _)| rotary.centre);
                let linear = axes.iter().filter(|axis| axis.kind == AxisKind::Linear);
                let ranges = linear.map(|axis| (axis.max - axis.min) * (axis.max - axis.min));
                Some(ranges.sum::<f64>().sqrt() + 2.0 * length(head.chain([end])))
            }
        }
    }
}

/// The length of a chain of points.
fn length(points: impl Iterator<Item = DVec3>) -> f64 {
    let mut before: Option<DVec3> = None;
    let mut length = 0.0;
    for point in points {
        length += before.map_or(0.0, |before| before.distance(point));
        before = Some(point);
    }
    length
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalogue;
    use crate::kinematics::Joints;
    use proptest::prelude::*;

    proptest! {
        /// Random axis values of every machine of the catalogue, through its forward kinematics.
        #[test]
        fn no_two_places_are_farther_apart(
            shares in prop::collection::vec(prop::array::uniform6(0.0..1.0_f64), 2..40),
            tool in prop::array::uniform3(-300.0..300.0_f64),
        ) {
            let tool = DVec3::from_array(tool);
            for name in catalogue::names() {
                let model = catalogue::find(name).unwrap();
                let Some(most) = model.mechanism.most_apart(&model.axes, tool) else { continue };
                let places: Vec<DVec3> = shares.iter().map(|share| {
                    let mut joints: Joints = [0.0; 6];
                    for ((joint, axis), share) in joints.iter_mut().zip(&model.axes).zip(share) {
                        *joint = axis.min + (axis.max - axis.min) * share;
                    }
                    let flange = model.mechanism.flange_in_root(&joints);
                    flange.rotation * tool + flange.position
                }).collect();
                for pair in places.windows(2) {
                    prop_assert!(pair[0].distance(pair[1]) <= most + 1e-6, "{name}");
                }
            }
        }
    }

    #[test]
    fn the_bound_is_of_the_size_of_the_machine() {
        // Its flange comes 3.1 m from axis 1 by its data sheet.
        let model = catalogue::find("kuka/kr210_r3100_ultra").unwrap();
        let most = model.mechanism.most_apart(&model.axes, DVec3::ZERO).unwrap();
        assert!((2.0 * 3100.0..2.0 * 4500.0).contains(&most), "{most}");
    }
}
