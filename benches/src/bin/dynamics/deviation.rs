//! Bounds of the deviation of whole jobs, beside the proof that the same cuts are within reach: on one thread, in turn, least time of
//! a few rounds.

use std::time::{Duration, Instant};
use vcutc::driver::dynamics::forces;
use vcutc::dynamics::deviation::Known;
use vcutc::dynamics::deviation::figures::{Asked, DeviationFigures};
use vcutc::job::CheckedJob;
use vcutc::motion::rigs::Rigs;
use vcutc::motion::solve::{Changes, LEAST_CLEARANCE, Reached, solve};
use vcutc::simulation::prove::UsedEdge;
use vcutc_backend_api::verify::VerifiedProgram;
use vcutc_benches::jobs::{self, Block};
use vcutc_benches::stages;

/// Numbers of cuts, about.
const SIZES: [u32; 3] = [100, 1_000, 10_000];
const ROUNDS: usize = 5;

/// Prints the rows of the table.
pub(crate) fn table() {
    println!("| cuts | reach, ms | deviation, ms | share |");
    println!("| --- | --- | --- | --- |");
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .expect("a thread can be had");
    for size in SIZES {
        pool.install(|| row(size));
    }
}

fn row(size: u32) {
    let (sources, job) = stages::check(&jobs::block(size, Block::OfForces));
    let plan = stages::plan(&job);
    let program = stages::lower(&plan, &sources);
    let edges = stages::contour(&plan, &program).edges;
    let mut least = [Duration::MAX; 2];
    for _ in 0..ROUNDS {
        let (reach, reached) = timed(|| reached(&job, program.clone()));
        let (deviation, figures) = timed(|| deviations(&job, &reached, &edges));
        assert!(figures.operations.len() == 1, "the deviation is known");
        least = [least[0].min(reach), least[1].min(deviation)];
    }
    let [reach, deviation] = least.map(|time| time.as_secs_f64() * 1e3);
    let (cuts, share) = (stages::cuts(&plan), 100.0 * deviation / reach);
    println!("| {cuts} | {reach:.1} | {deviation:.1} | {share:.1} % |");
}

fn timed<T>(work: impl FnOnce() -> T) -> (Duration, T) {
    let begun = Instant::now();
    let made = work();
    (begun.elapsed(), made)
}

fn reached(job: &CheckedJob, program: VerifiedProgram) -> Reached {
    let machine = job.machine.as_ref().expect("the job has a machine");
    let reached = solve(program, &machine.model, &LEAST_CLEARANCE, Changes::InTheAir);
    reached.expect("the job is within reach")
}

fn deviations(job: &CheckedJob, reached: &Reached, edges: &[UsedEdge]) -> DeviationFigures {
    let machine = job.machine.as_ref().expect("the job has a machine");
    let program = reached.program.program();
    let cell = program.cell.as_ref().expect("the program has a cell");
    let rigs = Rigs::of(&machine.model, cell, program);
    let known = Known {
        model: &machine.model,
        reached: &reached.program,
        rigs: &rigs,
        edges,
    };
    let asked = Asked {
        forces: &forces(job),
        limits: &[None],
        gravity: None,
    };
    DeviationFigures::of(known, asked).expect("the deviation is known")
}
