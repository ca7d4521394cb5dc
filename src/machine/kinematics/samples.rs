//! Arms for tests, by published numbers.
#![allow(clippy::expect_used, reason = "tests fail by panics")]

use super::Joints;
use super::joint_axis::JointAxis;
use super::mounted::Mounted;
use super::opw::{Coupling, Opw};
use super::pose::Pose;
use super::serial::SerialArm;
use core::f64::consts::FRAC_PI_2;
use glam::{DMat3, DVec3, EulerRot};
use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};

/// KUKA KR 210 R3100 ultra.
pub fn kr210() -> Opw {
    Opw {
        a1: 350.0,
        a2: 41.0,
        b: 0.0,
        c1: 675.0,
        c2: 1350.0,
        c3: 1400.0,
        c4: 240.0,
        offsets: [0.0, -FRAC_PI_2, 0.0, 0.0, 0.0, 0.0],
        signs: [-1.0, 1.0, 1.0, -1.0, 1.0, -1.0],
        coupling: Coupling::Serial,
    }
}

/// ABB IRB 2400-16, whose third axis is driven through a parallelogram.
pub fn irb2400() -> Opw {
    Opw {
        a1: 100.0,
        a2: -135.0,
        b: 0.0,
        c1: 615.0,
        c2: 705.0,
        c3: 755.0,
        c4: 85.0,
        offsets: [0.0, 0.0, -FRAC_PI_2, 0.0, 0.0, 0.0],
        signs: [1.0; 6],
        coupling: Coupling::Parallelogram,
    }
}

/// The KUKA hung up at a slant, with a flange that is turned as well.
pub fn mounted() -> Mounted {
    Mounted {
        foot_in_root: Pose {
            rotation: DMat3::from_euler(EulerRot::ZYX, 0.3, -1.2, 2.0),
            position: DVec3::new(120.0, -40.0, 900.0),
        },
        arm: kr210(),
        flange_in_hand: Pose {
            rotation: DMat3::from_euler(EulerRot::ZYX, -0.4, 0.9, 1.0),
            position: DVec3::new(3.0, -5.0, 17.0),
        },
    }
}

/// Denavit-Hartenberg lengths and twists `(a, d, alpha)` of the Universal Robots UR10e, mm and rad, as its maker publishes
/// them: `Rz(theta) Tz(d) Tx(a) Rx(alpha)`. Its last three axes do not meet in a point.
const UR10E: [(f64, f64, f64); 6] = [
    (0.0, 180.7, FRAC_PI_2),
    (-612.7, 0.0, 0.0),
    (-571.55, 0.0, 0.0),
    (0.0, 174.15, FRAC_PI_2),
    (0.0, 119.85, -FRAC_PI_2),
    (0.0, 116.55, 0.0),
];

/// Frames 0 to 6 of the UR10e along its chain.
pub fn ur10e_frames(joints: &Joints) -> Vec<Isometry3<f64>> {
    let mut frames = vec![Isometry3::identity()];
    for ((a, d, alpha), theta) in UR10E.iter().zip(joints) {
        let turned = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), *theta);
        let twisted = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), *alpha);
        let step = turned * Translation3::new(*a, 0.0, *d) * twisted;
        frames.push(frames[frames.len() - 1] * step);
    }
    frames
}

/// The UR10e.
pub fn ur10e() -> SerialArm {
    let frames = ur10e_frames(&[0.0; 6]);
    let axes = core::array::from_fn(|i| {
        let frame = pose(&frames[i]);
        JointAxis {
            point: frame.position,
            direction: frame.rotation.z_axis,
        }
    });
    SerialArm::new(axes, pose(&frames[6])).expect("a good arm")
}

/// A pose by the names of this crate.
pub fn pose(isometry: &Isometry3<f64>) -> Pose {
    let columns = isometry.rotation.to_rotation_matrix();
    let column = |i: usize| DVec3::from_slice(columns.matrix().column(i).as_slice());
    Pose {
        rotation: DMat3::from_cols(column(0), column(1), column(2)),
        position: DVec3::from_slice(isometry.translation.vector.as_slice()),
    }
}
