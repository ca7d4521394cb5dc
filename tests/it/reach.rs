//! Whole jobs on their machines: the best way to stand against trying all, the same result on any number of threads, and a
//! program that changes its branch.

use crate::pipeline::{Files, compile, emit, rendered};
use crate::repository::root;
use vcutc::diagnostics::source::SourceMap;
use vcutc::driver::Outcome;
use vcutc::job::CheckedJob;
use vcutc::machine::kinematics::Joints;
use vcutc::motion::demand::Demand;
use vcutc::motion::moves::{above_first_pose, paths};
use vcutc::motion::path::{Course, prove};
use vcutc::motion::rig::Rig;
use vcutc::motion::rigs::Rigs;
use vcutc::motion::solve::{Changes, LEAST_CLEARANCE, Reached, solve};
use vcutc::process::lower::lower;
use vcutc::process::plan::plan;
use vcutc_backend_api::ir::{Action, OpId, Program};
use vcutc_backend_api::motion::Branch;
use vcutc_backend_api::segments::Path;
use vcutc_backend_api::verify::{VerifiedProgram, verify};

const JOB: &str = "job.vcut";

/// A few cuts beside the arm, of which the placeholders decide the rest.
const SMALL: &str = r#"job "small"
stock { size = (30 mm, 20 mm, 20 mm) }
profile { start (0 mm, 10 mm) line to (30 mm, 10 mm) }
blade dagger { cutting_length = 12 mm half_apex = 7.13 deg thickness = 0 mm edges = double }
rough vcut {
  blade = dagger
  rake = 60 deg
  lattice = orthogonal
  swing = 35 deg
  overlap = 0 %
  residual = mixed
  order = point
  sequence = rows
  direction = DIRECTION
  feed { cut = 100 mm/s, travel = 100 mm/s, reorient = 20 deg/s }
  clearance = 10 mm
}
machine cell = robot "MODEL" {
  tool = frame(x = 0 mm, y = 0 mm, z = 310 mm, a = 0 deg, b = 0 deg, c = 0 deg)
  base = BASE
  home = HOME
}
"#;

fn small(direction: &str, model: &str, base: &str, home: &str) -> Files {
    let text = SMALL
        .replace("DIRECTION", direction)
        .replace("MODEL", model)
        .replace("BASE", base)
        .replace("HOME", home);
    Files::default().with(JOB, text)
}

fn kuka(direction: &str, base: &str) -> Files {
    let home = "joints(0 deg, -90 deg, 90 deg, 0 deg, 45 deg, 0 deg)";
    small(direction, "kuka/kr210_r3100_ultra", base, home)
}

fn abb(direction: &str, base: &str) -> Files {
    let home = "joints(0 deg, 0 deg, 0 deg, 0 deg, 45 deg, 0 deg)";
    small(direction, "abb/irb6700_155_285", base, home)
}

/// The program of a job as it is before reach looks at it.
fn program(job: &CheckedJob) -> VerifiedProgram {
    let plan = plan(job).0.unwrap();
    verify(lower(&plan, &SourceMap::default())).unwrap()
}

fn solved(outcome: &Outcome) -> &Reached {
    let messages = rendered(&outcome.diagnostics, outcome);
    let compiled = outcome.compiled.as_ref().unwrap_or_else(|| panic!("{messages}"));
    compiled.program.reached().unwrap()
}

/// Every branch and every turn of every axis, proven from one end of the program to the other with the limits as they are.
/// The best margin of all that come through.
fn best_of_all(program: &Program, rig: &Rig<'_>) -> Option<f64> {
    let paths = paths(program);
    let pose = above_first_pose(program, 0.0)?;
    let mut best: Option<f64> = None;
    for solution in rig.mechanism.all(&rig.flange_in_root(&pose)).iter() {
        for start in all_turns(&solution.joints) {
            if let Some(margin) = carried(program, &paths, rig, solution.branch, start) {
                best = Some(best.map_or(margin, |best| best.max(margin)));
            }
        }
    }
    best
}

fn all_turns(joints: &Joints) -> Vec<Joints> {
    (0..6).fold(vec![*joints], |all, axis| {
        all.iter()
            .flat_map(|joints| {
                [-1.0, 0.0, 1.0].map(|turn| {
                    let mut turned = *joints;
                    turned[axis] += turn * core::f64::consts::TAU;
                    turned
                })
            })
            .collect()
    })
}

fn carried(program: &Program, paths: &[Path], rig: &Rig<'_>, branch: Branch, start: Joints) -> Option<f64> {
    let inside = rig
        .axes
        .iter()
        .zip(start)
        .all(|(axis, value)| (axis.min..=axis.max).contains(&value));
    if !inside {
        return None;
    }
    let mut at = start;
    let mut demand = Demand::standing(OpId(0), &start);
    for line in paths.iter().filter_map(Path::line) {
        let course = Course::of(program, line).unwrap();
        let proof = prove(rig, &course, branch, &at, &LEAST_CLEARANCE).ok()?;
        demand = demand.and(&Demand::of(OpId(0), &proof));
        at = proof.end;
    }
    Some(demand.margin(rig.axes))
}

#[test]
fn no_branch_and_no_turn_is_better() {
    let high = "frame(x = 1700 mm, y = -600 mm, z = 1500 mm, a = 90 deg, b = 0 deg, c = 0 deg)";
    let beside = "frame(x = 1700 mm, y = -600 mm, z = 850 mm, a = 90 deg, b = 0 deg, c = 0 deg)";
    let behind = "frame(x = -1500 mm, y = 300 mm, z = 900 mm, a = 30 deg, b = 0 deg, c = 0 deg)";
    let jobs = [
        kuka("alternate", high),
        kuka("alternate", beside),
        kuka("alternate", behind),
        abb("alternate", beside),
        abb("alternate", behind),
    ];
    let mut carried = 0;
    for files in jobs {
        let outcome = compile(JOB, &files);
        let job = outcome.job.as_ref().unwrap();
        let machine = job.machine.as_ref().unwrap();
        let program = program(job);
        let cell = program.program().cell.clone().unwrap();
        let rigs = Rigs::of(&machine.model, &cell, program.program());
        let best = best_of_all(program.program(), rigs.first());
        let found = outcome.compiled.as_ref().map(|_| solved(&outcome).report.margin);
        match (found, best) {
            (Some(found), Some(best)) => {
                // Proofs that begin a turn apart round differently.
                assert!((found - best).abs() < 1e-6, "{found} {best}");
                carried += 1;
            }
            (found, best) => assert_eq!(found, best),
        }
    }
    assert!(carried >= 3, "{carried}");
}

#[test]
fn threads_change_nothing() {
    let beside = "frame(x = 1700 mm, y = -600 mm, z = 850 mm, a = 90 deg, b = 0 deg, c = 0 deg)";
    let outcome = compile(JOB, &kuka("forward", beside));
    let job = outcome.job.as_ref().unwrap();
    let model = &job.machine.as_ref().unwrap().model;
    let solve_on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| solve(program(job), model, &LEAST_CLEARANCE, Changes::InTheAir))
            .unwrap()
    };
    let alone = solve_on(1);
    for threads in [2, 7] {
        let together = solve_on(threads);
        assert_eq!(together.program, alone.program);
        assert_eq!(together.report, alone.report);
    }
}

/// The job of VC0514, fixed by coming up between the cuts and by cutting all left flanks first.
fn wide_work() -> Files {
    let folder = root().join("tests/process/err");
    let text = std::fs::read_to_string(folder.join("VC0514_wide_work.vcut")).unwrap();
    let body: Vec<&str> = text.lines().filter(|line| !line.starts_with("//")).collect();
    let mended = body
        .join("\n")
        .replace("direction = alternate", "direction = forward\n  order = layer");
    Files::of(folder).with(JOB, mended)
}

#[test]
fn the_branch_changes_in_the_air_where_it_has_to() {
    let outcome = compile(JOB, &wide_work());
    let reached = solved(&outcome);
    let program = reached.program.program();
    let changes: Vec<_> = reached
        .report
        .stretches
        .iter()
        .skip(1)
        .map(|stretch| program.ops[stretch.from.0 as usize].action)
        .collect();
    assert!(!changes.is_empty());
    assert!(
        changes
            .iter()
            .all(|action| matches!(action, Action::AxisTravel { .. }))
    );
    // No branch carries the program from end to end.
    let job = outcome.job.as_ref().unwrap();
    let machine = job.machine.as_ref().unwrap();
    let cell = program.cell.clone().unwrap();
    let straight = self::program(job);
    let rigs = Rigs::of(&machine.model, &cell, straight.program());
    assert_eq!(best_of_all(straight.program(), rigs.first()), None);
    assert!(emit(&outcome).is_ok());
}

#[test]
fn sampled_axes_join_and_stay_within_what_is_reported() {
    let outcome = compile(JOB, &wide_work());
    let reached = solved(&outcome);
    let job = outcome.job.as_ref().unwrap();
    let program = reached.program.program();
    let cell = program.cell.clone().unwrap();
    let rigs = Rigs::of(&job.machine.as_ref().unwrap().model, &cell, program);
    let mut last: Option<Joints> = None;
    let taken = vcutc::motion::trajectory::trajectory(
        &reached.program,
        &rigs,
        &vcutc::motion::trajectory::Spacing::CLOSE,
        |sample| {
            for (index, axis) in cell.axes.iter().enumerate() {
                let value = sample.joints[index];
                if value < axis.min - 1e-9 || value > axis.max + 1e-9 {
                    return Err(format!("{}: {value}", axis.name));
                }
                // Nowhere do 5 mm or 2 deg of the blade take an axis of this arm farther.
                if last.is_some_and(|last| (value - last[index]).abs() > 0.15) {
                    return Err(format!("{} jumps to {value}", axis.name));
                }
            }
            last = Some(sample.joints);
            Ok(())
        },
    );
    assert_eq!(taken, Ok(()));
}
