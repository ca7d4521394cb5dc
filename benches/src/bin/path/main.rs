//! How long the proof of a cut takes: time and solves for each of 10,000 straight cuts of 1 m, beside sampling them.
//!
//! `cargo run --release --bin path` prints a few lines for `docs/benchmarks.md`.

use glam::{DMat3, DVec3};
use std::f64::consts::FRAC_PI_2;
use std::hint::black_box;
use std::time::Instant;
use vcutc::machine::kinematics::Joints;
use vcutc::machine::kinematics::pose::Pose;
use vcutc::machine::{Model, catalogue};
use vcutc::motion::path::{Clearance, Course, Proof, prove};
use vcutc::motion::rig::Rig;
use vcutc_backend_api::geometry::Frame;
use vcutc_backend_api::motion::Branch;

/// Cuts a side of the grid.
const SIDE: u32 = 50;
const LEAST: Clearance = Clearance {
    wrist: 0.05,
    elbow: 0.05,
    shoulder: 20.0,
};

/// A cut, the branch, and the axes at its start.
struct Cut {
    course: Course,
    branch: Branch,
    start: Joints,
}

fn main() {
    for name in ["kuka/kr210_r3100_ultra", "abb/irb6700_200_260"] {
        let model = catalogue::find(name).expect("it is in the catalogue");
        let rig = rig(&model);
        let cuts = cuts(&rig);
        let begun = Instant::now();
        let proofs: Vec<Proof> = cuts
            .iter()
            .filter_map(|cut| prove(&rig, &cut.course, cut.branch, &cut.start, &LEAST).ok())
            .collect();
        let seconds = begun.elapsed().as_secs_f64();
        let solves: u32 = proofs.iter().map(|proof| proof.solves).sum();
        let most = proofs.iter().map(|proof| proof.solves).max().unwrap_or_default();
        println!(
            "{name}: {} cuts of 1 m, {} proven; {:.1} us and {:.1} solves a proven cut, at most {most}; {:.2} s in all",
            cuts.len(),
            proofs.len(),
            1e6 * seconds / cuts.len() as f64,
            f64::from(solves) / proofs.len() as f64,
            seconds
        );
        let begun = Instant::now();
        let few = &cuts[..cuts.len() / 20];
        few.iter().for_each(|cut| sample(&rig, cut));
        println!(
            "{name}: {:.1} us a cut to solve it every millimetre, which proves nothing between",
            1e6 * begun.elapsed().as_secs_f64() / few.len() as f64
        );
    }
}

/// A blade 300 mm before the flange, and work before the robot.
fn rig(model: &Model) -> Rig<'_> {
    let at = |x, y, z| {
        Frame::from(Pose {
            rotation: DMat3::IDENTITY,
            position: DVec3::new(x, y, z),
        })
    };
    Rig::new(model, at(0.0, 0.0, 300.0), at(1300.0, -500.0, 500.0))
}

/// Both flanks of V-cuts on a grid of tips, each on the first branch of its start that can be proven.
fn cuts(rig: &Rig<'_>) -> Vec<Cut> {
    let mut cuts = Vec::new();
    for place in 0..SIDE * SIDE * 4 {
        let (column, row) = (place / 4 % SIDE, place / 4 / SIDE);
        let (swing, sense) = [(0.5, 1.0), (-0.5, 1.0), (0.5, -1.0), (-0.5, -1.0)][place as usize % 4];
        let straight = DMat3::from_cols(DVec3::Y, DVec3::X, -DVec3::Z);
        let rake = DMat3::from_rotation_x(-sense * (FRAC_PI_2 - 1.1));
        let rotation = DMat3::from_rotation_y(swing) * rake * straight;
        let at = |y: f64| Pose {
            rotation,
            position: DVec3::new(10.0 * f64::from(column), y, 6.0 * f64::from(row)),
        };
        let course = Course {
            arc: None,
            from: at(500.0 - 500.0 * sense),
            to: at(500.0 + 500.0 * sense),
            duration: 1000.0 / 300.0,
        };
        let solutions = rig.mechanism.all(&rig.flange_in_root(&course.from));
        let mut ways = solutions.iter().map(|solution| Cut {
            course,
            branch: solution.branch,
            start: solution.joints,
        });
        let first = ways.next();
        let proven = first
            .into_iter()
            .chain(ways)
            .find(|cut| prove(rig, &cut.course, cut.branch, &cut.start, &LEAST).is_ok());
        cuts.extend(proven);
    }
    cuts
}

fn sample(rig: &Rig<'_>, cut: &Cut) {
    let mut near = cut.start;
    for k in 0..=1000 {
        let blade = Pose {
            rotation: cut.course.from.rotation,
            position: cut
                .course
                .from
                .position
                .lerp(cut.course.to.position, f64::from(k) / 1000.0),
        };
        if let Some(joints) = rig
            .mechanism
            .on_branch(&rig.flange_in_root(&blade), cut.branch, &near)
        {
            near = black_box(joints);
        }
    }
}
