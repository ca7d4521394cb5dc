//! How long it takes to prove a whole job of 1 m cuts reachable, and how that grows with the number of cuts and shrinks with
//! the number of threads.
//!
//! `cargo run --release --bin reach` prints the rows of a table in `docs/benchmarks.md`.

use std::time::Instant;
use vcutc::job::CheckedJob;
use vcutc::motion::solve::{Changes, LEAST_CLEARANCE, solve};
use vcutc_backend_api::verify::VerifiedProgram;
use vcutc_benches::jobs::{self, Block};
use vcutc_benches::stages;

/// Numbers of cuts, about.
const SIZES: [u32; 3] = [1_000, 10_000, 100_000];

fn main() {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let counts: &[usize] = if cores > 1 { &[1, 2] } else { &[1] };
    for size in SIZES {
        let (sources, job) = stages::check(&jobs::block(size, Block::OfReach));
        let plan = stages::plan(&job);
        let program = stages::lower(&plan, &sources);
        let cuts = stages::cuts(&plan);
        for &threads in counts {
            let seconds = timed(&job, &program, threads);
            println!(
                "{cuts} cuts of 1 m, {} ops, {threads} threads: {seconds:.2} s, {:.0} us a cut",
                program.program().ops.len(),
                1e6 * seconds / cuts as f64,
            );
        }
    }
}

/// How long the stage takes with so many threads, in s.
fn timed(job: &CheckedJob, program: &VerifiedProgram, threads: usize) -> f64 {
    let machine = job.machine.as_ref().expect("the job has a machine");
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .expect("threads can be had");
    let program = program.clone();
    let begun = Instant::now();
    let reached = pool.install(|| solve(program, &machine.model, &LEAST_CLEARANCE, Changes::InTheAir));
    let seconds = begun.elapsed().as_secs_f64();
    assert!(reached.is_ok(), "the job is within reach");
    seconds
}
