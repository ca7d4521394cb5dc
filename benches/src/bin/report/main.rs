//! How long large robot jobs take to be checked, and to be reported on as one page, and how large that page is.
//!
//! `cargo run --release --bin report` prints the rows of a table in `docs/benchmarks.md`.

use std::time::Instant;
use vcutc::report::page::{Further, page};
use vcutc_benches::{jobs, stages};

/// Numbers of cuts, about.
const SIZES: [u32; 2] = [1_000, 10_000];

fn main() {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let counts: &[usize] = if cores > 1 { &[1, 2] } else { &[1] };
    for size in SIZES {
        for machine in [jobs::Machine::Robot, jobs::Machine::None] {
            for &threads in counts {
                row(&jobs::spoiler(size, machine), machine, threads);
            }
        }
    }
}

/// Measures a job with so many threads.
fn row(text: &str, machine: jobs::Machine, threads: usize) {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .expect("threads can be had");
    pool.install(|| {
        let begun = Instant::now();
        let outcome = stages::compile(text);
        let checked = begun.elapsed().as_secs_f64();
        let page = page(&outcome, Further::NOTHING).expect("the job is right");
        let reported = begun.elapsed().as_secs_f64();
        let cuts = outcome.plan.as_ref().map_or(0, stages::cuts);
        println!(
            "{cuts} cuts, {machine:?}, {threads} threads: check {checked:.2} s, report {reported:.2} s, {:.1} MB",
            page.len() as f64 / 1e6
        );
    });
}
