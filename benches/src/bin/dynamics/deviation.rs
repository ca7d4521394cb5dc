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
    let (sources, job) = stages::check(&text(size));
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

/// A block of 500 x 600 x 140 mm before an arm whose stiffness is known, cut in layers and steps that give about so many cuts.
fn text(cuts: u32) -> String {
    // The width by steps of nine tenths of a layer, the height to remove by layers.
    let layer = (500.0 * 120.0 / 0.9 / f64::from(cuts)).sqrt();
    format!(
        r#"job "bench_dynamics_{cuts}"

stock {{ size = (500 mm, 600 mm, 140 mm) }}

profile {{
  start (0 mm, 20 mm)
  line to (500 mm, 20 mm)
}}

blade dagger {{
  cutting_length = 60 mm
  half_apex      = 7.13 deg
  thickness      = 1 mm
  edges          = double
  forces {{
    drag = 1.1 N/mm, axial = 0.4 N/mm, side = 0.3 N/mm, spread = 20 %
    measured {{ feed = 200 mm/s, rake = 80 deg, swing = 25 deg }}
    source = "made up for this benchmark"
  }}
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

machine cell = robot "kuka/kr210_r2700_prime" {{
  tool       = frame(x = 0 mm, y = 0 mm, z = 310 mm, a = 0 deg, b = 0 deg, c = 0 deg)
  base       = frame(x = 1300 mm, y = -300 mm, z = 900 mm, a = 0 deg, b = 0 deg, c = 0 deg)
  home       = joints(0 deg, -90 deg, 90 deg, 0 deg, 45 deg, 0 deg)
  load       = load(mass = 14.5 kg, x = 0 mm, y = 0 mm, z = 140 mm)
  ultrasonic = output(12)
}}
"#,
        step = 0.9 * layer,
    )
}
