//! Inverse kinematics of ortho-parallel arms beside those of the crate rs-opw-kinematics, on random poses. Shared with the
//! benchmarks.
#![allow(unreachable_pub, reason = "the library of the benchmarks takes it in")]

use core::f64::consts::TAU;
use rs_opw_kinematics::kinematic_traits::{J2, J3, Kinematics};
use rs_opw_kinematics::kinematics_impl::OPWKinematics;
use rs_opw_kinematics::parallelogram::Parallelogram;
use rs_opw_kinematics::parameters::opw_kinematics::Parameters;
use rs_opw_kinematics::pose::Pose as PeerPose;
use std::sync::Arc;
use vcutc_machine::catalogue;
use vcutc_machine::kinematics::opw::{Coupling, Opw};
use vcutc_machine::kinematics::pose::Pose;
use vcutc_machine::kinematics::{Joints, Mechanism};

/// SplitMix64 (Steele, Lea, Flood 2014).
pub struct Random(pub u64);

impl Random {
    /// A number from 0 to 1.
    pub fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((mixed ^ (mixed >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// A robot of the catalogue, with its ranges in rad.
pub struct Robot {
    pub name: &'static str,
    pub arm: Opw,
    pub ranges: Vec<(f64, f64)>,
}

impl Robot {
    /// All that are ortho-parallel.
    pub fn all() -> Vec<Self> {
        let robot = |name| {
            let model = catalogue::find(name)?;
            let ranges = model.axes.iter().map(|axis| (axis.min, axis.max)).collect();
            let Mechanism::OrthoParallel(arm) = model.mechanism else {
                return None;
            };
            Some(Self { name, arm, ranges })
        };
        catalogue::names().filter_map(robot).collect()
    }

    /// Random joints within the ranges.
    pub fn joints(&self, random: &mut Random) -> Joints {
        let mut joints = [0.0; 6];
        for (joint, (min, max)) in joints.iter_mut().zip(&self.ranges) {
            *joint = min + (max - min) * random.next();
        }
        joints
    }

    /// The sines whose zeros are singular poses: of the hand, of the elbow, and of the wrist centre's bearing from axis 1.
    fn sines(&self, joints: &Joints) -> [f64; 3] {
        let Opw { a2, c3, c4, .. } = self.arm;
        let elbow = match self.arm.coupling {
            Coupling::Serial => joints[2],
            Coupling::Parallelogram => joints[2] - joints[1],
        };
        let psi = self.arm.signs[2] * elbow - self.arm.offsets[2] + a2.atan2(c3);
        let flange = self.arm.forward(joints);
        let centre = flange.position - flange.rotation.z_axis * c4;
        [joints[4].sin(), psi.sin(), centre.x.hypot(centre.y) / self.arm.c2]
    }
}

/// The same arm by the other crate, which counts in metres.
pub fn peer(arm: &Opw) -> Arc<dyn Kinematics> {
    let metres = 1e-3;
    let serial = Arc::new(OPWKinematics::new(Parameters {
        a1: arm.a1 * metres,
        a2: arm.a2 * metres,
        b: arm.b * metres,
        c1: arm.c1 * metres,
        c2: arm.c2 * metres,
        c3: arm.c3 * metres,
        c4: arm.c4 * metres,
        offsets: arm.offsets,
        sign_corrections: arm.signs.map(|sign| sign as i8),
        dof: 6,
    }));
    match arm.coupling {
        Coupling::Serial => serial,
        Coupling::Parallelogram => Arc::new(Parallelogram {
            robot: serial,
            scaling: 1.0,
            driven: J2,
            coupled: J3,
        }),
    }
}

/// A pose as the other crate has it: rotations as quaternions, lengths in metres, vectors of an older glam.
pub fn peer_pose(pose: &Pose) -> PeerPose {
    let columns = pose.rotation.to_cols_array();
    let rotation = glam_032::DQuat::from_mat3(&glam_032::DMat3::from_cols_array(&columns)).normalize();
    let place = glam_032::DVec3::from_array((pose.position * 1e-3).to_array());
    PeerPose::from_parts(place, rotation)
}

/// What a comparison found.
#[derive(Debug, Default)]
pub struct Tally {
    /// Answers that were compared.
    pub answers: usize,
    /// The farthest that one of ours is from its pose, in mm.
    pub apart: f64,
    /// The same of rotations, as Frobenius norm.
    pub turned: f64,
}

/// Compares answers on random poses within the ranges of a robot: ours are exact, the joints that made the pose are among
/// them, and away from singular poses, where the other crate's answers are good to 1e-8 rad, both find the same.
pub fn compare(robot: &Robot, count: usize, random: &mut Random) -> Tally {
    let peer = peer(&robot.arm);
    let mut tally = Tally::default();
    for _ in 0..count {
        let joints = robot.joints(random);
        let pose = robot.arm.forward(&joints);
        let ours: Vec<Joints> = robot.arm.inverse(&pose).iter().map(|one| one.joints).collect();
        for answer in &ours {
            let (apart, turned) = robot.arm.forward(answer).apart(&pose);
            tally.apart = tally.apart.max(apart);
            tally.turned = tally.turned.max(turned);
        }
        let what = || format!("{} at {joints:?}", robot.name);
        if robot.sines(&joints).iter().any(|sine| sine.abs() < 1e-3) {
            continue;
        }
        tally.answers += ours.len();
        assert!(contains(&ours, &joints, 1e-9), "{} is not found", what());
        let is_regular = |answer: &&Joints| robot.sines(answer).iter().all(|sine| sine.abs() >= 1e-3);
        let theirs: Vec<Joints> = peer.inverse(&peer_pose(&pose));
        for answer in ours.iter().filter(is_regular) {
            assert!(
                contains(&theirs, answer, 1e-5),
                "{}: only ours {answer:?}",
                what()
            );
        }
        for answer in theirs.iter().filter(is_regular) {
            assert!(
                contains(&ours, answer, 1e-5),
                "{}: only theirs {answer:?}",
                what()
            );
        }
    }
    tally
}

/// Whether joints are among others, whole turns aside.
fn contains(all: &[Joints], wanted: &Joints, within: f64) -> bool {
    all.iter().any(|one| {
        one.iter().zip(wanted).all(|(one, wanted)| {
            let apart = one - wanted;
            (apart - TAU * (apart / TAU).round()).abs() < within
        })
    })
}

/// A number made of the bits of all answers to some poses of each robot (FNV-1a). It must be the same however the sources
/// are compiled, and for whatever processor.
pub fn fingerprint() -> u64 {
    let mut random = Random(3);
    let mut sum = 0xcbf2_9ce4_8422_2325_u64;
    for robot in Robot::all() {
        for _ in 0..100 {
            let pose = robot.arm.forward(&robot.joints(&mut random));
            for number in robot.arm.inverse(&pose).iter().flat_map(|one| one.joints) {
                for byte in number.to_bits().to_le_bytes() {
                    sum = (sum ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
                }
            }
        }
    }
    sum
}

/// What [`fingerprint`] gives.
pub const FINGERPRINT: u64 = 472_011_291_753_193_900;
