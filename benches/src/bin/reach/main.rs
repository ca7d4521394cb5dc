//! How long it takes to prove a whole job of 1 m cuts reachable, and how that grows with the number of cuts and shrinks with
//! the number of threads.
//!
//! `cargo run --release --bin reach` prints the rows of a table in `docs/benchmarks.md`.

use std::time::Instant;
use vcutc::job::CheckedJob;
use vcutc::motion::solve::{Changes, LEAST_CLEARANCE, solve};
use vcutc_backend_api::verify::VerifiedProgram;
use vcutc_benches::stages;

/// Numbers of cuts, about.
const SIZES: [u32; 3] = [1_000, 10_000, 100_000];

fn main() {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let counts: &[usize] = if cores > 1 { &[1, 2] } else { &[1] };
    for size in SIZES {
        let (sources, job) = stages::check(&text(size));
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

/// A block of 500 x 1000 x 140 mm before a large robot, cut in layers and steps that give about so many cuts.
fn text(cuts: u32) -> String {
    // The width by steps of nine tenths of a layer, the height to remove by layers.
    let layer = (500.0 * 120.0 / 0.9 / f64::from(cuts)).sqrt();
    format!(
        r#"job "bench_reach_{cuts}"

stock {{ size = (500 mm, 1000 mm, 140 mm) }}

profile {{
  start (0 mm, 20 mm)
  line to (500 mm, 20 mm)
}}

blade dagger {{
  cutting_length = 30 mm
  half_apex      = 7.13 deg
  thickness      = 1 mm
  edges          = double
}}

rough vcut {{
  blade     = dagger
  lattice   = orthogonal
  rake      = 80 deg
  swing     = 25 deg
  layer     = {layer:.3} mm
  step      = {step:.3} mm
  residual  = mixed
  order     = point
  sequence  = rows
  feed      {{ cut = 200 mm/s, travel = 300 mm/s, reorient = 60 deg/s }}
  clearance = 20 mm
}}

machine cell = robot "kuka/kr210_r3100_ultra" {{
  tool       = frame(x = 0 mm, y = 0 mm, z = 310 mm, a = 0 deg, b = 0 deg, c = 0 deg)
  base       = frame(x = 1500 mm, y = -500 mm, z = 900 mm, a = 0 deg, b = 0 deg, c = 0 deg)
  home       = joints(0 deg, -90 deg, 90 deg, 0 deg, 45 deg, 0 deg)
  ultrasonic = output(12)
}}
"#,
        step = 0.9 * layer,
    )
}
