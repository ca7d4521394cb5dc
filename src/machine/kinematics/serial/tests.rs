//! Serial arms against chains of nalgebra and the closed form.

use super::SerialArm;
use crate::kinematics::Joints;
use crate::kinematics::samples::{irb2400, kr210, mounted, pose, ur10e, ur10e_frames};
use glam::DVec3;
use proptest::prelude::*;

fn joints() -> impl Strategy<Value = Joints> {
    prop::array::uniform6(-3.1..3.1)
}

proptest! {
    #[test]
    fn a_chain_of_denavit_hartenberg_frames_gives_the_same_pose(joints in joints()) {
        let (apart, turned) = ur10e().forward(&joints).apart(&pose(&ur10e_frames(&joints)[6]));
        prop_assert!(apart < 1e-9 && turned < 1e-12, "{apart} mm, {turned}");
    }

    #[test]
    fn closed_form_arms_stand_the_same_as_screws(joints in joints()) {
        let pairs = [
            (SerialArm::from(&kr210()), kr210().forward(&joints)),
            (SerialArm::from(&irb2400()), irb2400().forward(&joints)),
            (SerialArm::from(&mounted()), mounted().forward(&joints)),
        ];
        for (arm, flange_in_root) in pairs {
            let (apart, turned) = arm.forward(&joints).apart(&flange_in_root);
            prop_assert!(apart < 1e-9 && turned < 1e-12, "{apart} mm, {turned}");
        }
    }
}

#[test]
fn an_axis_has_to_point_somewhere() {
    let mut axes = *ur10e().axes();
    let flange = *ur10e().flange_at_zero();
    axes[3].direction = DVec3::ZERO;
    assert_eq!(SerialArm::new(axes, flange), None);
    axes[3].direction = DVec3::new(0.0, f64::INFINITY, 0.0);
    assert_eq!(SerialArm::new(axes, flange), None);
}
