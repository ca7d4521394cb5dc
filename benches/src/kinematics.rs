//! Inverse kinematics of random poses of a KUKA KR 210 R3100 ultra: ours one by one and in batches, those of
//! rs-opw-kinematics, and those of ik-geo (with the feature `ik-geo`).
//!
//! Poses are those of joints drawn evenly from the axes' ranges; all ways get the same ones, in the form that they take.
//! Nothing is timed here. Each function solves all poses and returns how many answers it saw.

use crate::peer::{Random, Robot, peer, peer_pose};
use rs_opw_kinematics::kinematic_traits::Kinematics;
use rs_opw_kinematics::pose::Pose as PeerPose;
use std::hint::black_box;
use std::sync::Arc;
use vcutc::machine::kinematics::Joints;
use vcutc::machine::kinematics::batch::{Answers, BranchAnswers, Poses};
use vcutc::machine::kinematics::opw::{BRANCHES, Opw};
use vcutc::machine::kinematics::pose::Pose;
use vcutc_backend_api::motion::Branch;

/// Poses in a batch: their answers fit the cache of a core.
const BATCH: usize = 256;

/// The same poses for everybody.
pub struct Task {
    arm: Opw,
    /// What the poses were made of, and the branch that is on.
    joints: Vec<(Joints, Branch)>,
    poses: Vec<Pose>,
    batches: Vec<Poses>,
    peer: Arc<dyn Kinematics>,
    peer_poses: Vec<PeerPose>,
}

impl Task {
    /// So many random poses.
    #[must_use]
    pub fn new(count: usize) -> Self {
        let robot = Robot::all()
            .into_iter()
            .find(|robot| robot.name == "kuka/kr210_r3100_ultra")
            .expect("the catalogue has it");
        let mut random = Random(1);
        let joints: Vec<_> = (0..count)
            .map(|_| {
                let joints = robot.joints(&mut random);
                (joints, branch(&robot.arm, &joints))
            })
            .collect();
        let poses: Vec<Pose> = joints
            .iter()
            .map(|(joints, _)| robot.arm.forward(joints))
            .collect();
        let batches = poses.chunks(BATCH).map(|poses| {
            let mut batch = Poses::default();
            poses.iter().for_each(|pose| batch.push(pose));
            batch
        });
        Self {
            arm: robot.arm,
            batches: batches.collect(),
            peer: peer(&robot.arm),
            peer_poses: poses.iter().map(peer_pose).collect(),
            joints,
            poses,
        }
    }

    /// How many poses.
    #[must_use]
    pub fn count(&self) -> usize {
        self.poses.len()
    }

    /// All solutions of each pose, one pose after the other.
    #[must_use]
    pub fn all(&self) -> usize {
        let answers = |pose| black_box(self.arm.inverse(pose)).iter().len();
        self.poses.iter().map(answers).sum()
    }

    /// All solutions of each pose, in batches.
    #[must_use]
    pub fn batches(&self, answers: &mut Answers) -> usize {
        for batch in &self.batches {
            self.arm.inverse_many(batch, answers);
            black_box(&answers);
        }
        self.poses.len()
    }

    /// One branch of each pose, in batches.
    #[must_use]
    pub fn branch_batches(&self, answers: &mut BranchAnswers) -> usize {
        for batch in &self.batches {
            self.arm.on_branch_many(batch, BRANCHES[0], answers);
            black_box(&answers);
        }
        self.poses.len()
    }

    /// Each pose on the branch that is known, near the joints that are known.
    #[must_use]
    pub fn on_branch(&self) -> usize {
        let poses = self.poses.iter().zip(&self.joints);
        poses
            .filter(|(pose, (near, branch))| black_box(self.arm.on_branch(pose, *branch, near)).is_some())
            .count()
    }

    /// The flange for joints.
    #[must_use]
    pub fn forward(&self) -> usize {
        for (joints, _) in &self.joints {
            black_box(self.arm.forward(joints));
        }
        self.joints.len()
    }

    /// All solutions by rs-opw-kinematics.
    #[must_use]
    pub fn peer_all(&self) -> usize {
        let answers = |pose| black_box(self.peer.inverse(pose)).len();
        self.peer_poses.iter().map(answers).sum()
    }

    /// All solutions by rs-opw-kinematics, the nearest to known joints first.
    #[must_use]
    pub fn peer_continuing(&self) -> usize {
        let poses = self.peer_poses.iter().zip(&self.joints);
        poses
            .map(|(pose, (near, _))| black_box(self.peer.inverse_continuing(pose, near)).len())
            .sum()
    }

    /// The farthest that an answer is from its pose, in m, by our forward kinematics: of ours, and of rs-opw-kinematics.
    #[must_use]
    pub fn worst(&self) -> [f64; 2] {
        let apart = |joints: &Joints, pose: &Pose| self.arm.forward(joints).apart(pose).0 * 1e-3;
        let mut worst = [0.0_f64; 2];
        for (pose, peer_pose) in self.poses.iter().zip(&self.peer_poses) {
            for answer in self.arm.inverse(pose).iter() {
                worst[0] = worst[0].max(apart(&answer.joints, pose));
            }
            for answer in self.peer.inverse(peer_pose) {
                worst[1] = worst[1].max(apart(&answer, pose));
            }
        }
        worst
    }
}

/// The branch that joints are on.
fn branch(arm: &Opw, joints: &Joints) -> Branch {
    let apart = |other: &Joints| -> f64 {
        let turned = joints.iter().zip(other).map(|(one, other)| {
            let apart = one - other;
            (apart - std::f64::consts::TAU * (apart / std::f64::consts::TAU).round()).abs()
        });
        turned.sum()
    };
    let solutions = arm.inverse(&arm.forward(joints));
    let nearest = solutions
        .iter()
        .min_by(|one, other| apart(&one.joints).total_cmp(&apart(&other.joints)));
    nearest.expect("a pose of the arm has an answer").branch
}

/// ik-geo.
#[cfg(feature = "ik-geo")]
pub mod geo {
    use super::Task;
    use ik_geo::robot::{IKSolver, Robot, spherical_two_parallel};
    use nalgebra_032::{Matrix3, Matrix3x6, Vector3};
    use std::hint::black_box;

    /// A pose as ik-geo has it.
    type GeoPose = (Matrix3<f64>, Vector3<f64>);

    /// The same task for ik-geo: the model angles of the same arm, in m.
    pub struct GeoTask {
        robot: Robot,
        poses: Vec<GeoPose>,
    }

    impl GeoTask {
        /// The poses of a task.
        #[must_use]
        pub fn new(task: &Task) -> Self {
            let (y, z) = (Vector3::y(), Vector3::z());
            let arm = &task.arm;
            let metres = |x: f64, y: f64, z: f64| Vector3::new(x, y, z) * 1e-3;
            let links = [
                metres(0.0, 0.0, arm.c1),
                metres(arm.a1, arm.b, 0.0),
                metres(0.0, 0.0, arm.c2),
                metres(arm.a2, 0.0, arm.c3),
                Vector3::zeros(),
                Vector3::zeros(),
                metres(0.0, 0.0, arm.c4),
            ];
            let poses = task.poses.iter().map(|pose| {
                let rotation = Matrix3::from_column_slice(&pose.rotation.to_cols_array());
                let place = metres(pose.position.x, pose.position.y, pose.position.z);
                (rotation, place)
            });
            Self {
                robot: spherical_two_parallel(
                    Matrix3x6::from_columns(&[z, y, y, z, y, z]),
                    nalgebra_032::Matrix3xX::from_columns(&links)
                        .fixed_columns::<7>(0)
                        .into(),
                ),
                poses: poses.collect(),
            }
        }

        /// All solutions, not checked.
        #[must_use]
        pub fn all(&self) -> usize {
            let answers = |(rotation, place): &GeoPose| black_box(self.robot.ik(*rotation, *place)).len();
            self.poses.iter().map(answers).sum()
        }

        /// The farthest that an answer is from its pose, in m; answers that ik-geo itself calls approximate are left out.
        #[must_use]
        pub fn worst(&self) -> f64 {
            let mut worst = 0.0_f64;
            for (rotation, place) in &self.poses {
                for (joints, is_approximate) in self.robot.ik(*rotation, *place) {
                    if !is_approximate {
                        let (_, there) = self.robot.fk(&joints.into());
                        worst = worst.max((there - place).norm());
                    }
                }
            }
            worst
        }
    }
}
