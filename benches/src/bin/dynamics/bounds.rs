//! Bounds of torques and of the deviation of whole jobs, beside the proof that the same motions are within reach: on one thread, in turn,
//! least time of a few rounds.

use std::time::{Duration, Instant};
use vcutc::driver::dynamics::pushed_blades;
use vcutc::dynamics::arms::Arms;
use vcutc::dynamics::cuts::{Cuts, Known};
use vcutc::dynamics::deviation::figures::{Asked, DeviationFigures};
use vcutc::dynamics::figures::{LookedAt, Pushing, TorqueFigures};
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

/// A job that is within reach.
struct Job {
    checked: CheckedJob,
    program: VerifiedProgram,
    edges: Vec<UsedEdge>,
    cuts: usize,
}

impl Job {
    fn of(size: u32, block: Block) -> Self {
        let (sources, checked) = stages::check(&jobs::block(size, block));
        let plan = stages::plan(&checked);
        let program = stages::lower(&plan, &sources);
        Self {
            edges: stages::contour(&plan, &program).edges,
            cuts: stages::cuts(&plan),
            checked,
            program,
        }
    }

    fn reached(&self) -> Reached {
        let machine = self.checked.machine.as_ref().expect("the job has a machine");
        let program = self.program.clone();
        let reached = solve(program, &machine.model, &LEAST_CLEARANCE, Changes::InTheAir);
        reached.expect("the job is within reach")
    }

    fn torques(&self, reached: &Reached) {
        self.known(reached, |known, arms| {
            let figures = TorqueFigures::of(known, arms.expect("masses are known"), Pushing::NotKnown, None);
            let figures = figures.expect("the torques are known");
            assert_ne!(figures.looked_at, LookedAt::Places);
        });
    }

    fn deviation(&self, reached: &Reached) {
        let asked = Asked {
            blades: &pushed_blades(&self.checked),
            limits: &[None],
            gravity: None,
        };
        self.known(reached, |known, arms| {
            let cuts = Cuts::of(known, asked.blades).expect("the arm has a closed form");
            let figures = DeviationFigures::of(&cuts, arms, asked).expect("the deviation is known");
            assert!(figures.operations.len() == 1, "the deviation is known");
        });
    }

    fn known(&self, reached: &Reached, work: impl FnOnce(Known<'_>, Option<&Arms>)) {
        let model = &self
            .checked
            .machine
            .as_ref()
            .expect("the job has a machine")
            .model;
        let program = reached.program.program();
        let cell = program.cell.as_ref().expect("the program has a cell");
        let rigs = Rigs::of(model, cell, program);
        let known = Known {
            model,
            reached: &reached.program,
            rigs: &rigs,
            edges: &self.edges,
            compensations: &[],
        };
        work(known, Arms::of(model, cell).ok().as_ref());
    }
}

/// Prints the rows of the table of torques.
pub(crate) fn torques() {
    table("torques", Block::OfWeight, Job::torques);
}

/// Prints the rows of the table of deviations.
pub(crate) fn deviation() {
    table("deviation", Block::OfForces, Job::deviation);
}

fn table(what: &str, block: Block, bounds: fn(&Job, &Reached)) {
    println!("| cuts | reach, ms | {what}, ms | share |");
    println!("| --- | --- | --- | --- |");
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .expect("a thread can be had");
    for size in SIZES {
        pool.install(|| row(&Job::of(size, block), bounds));
    }
}

fn row(job: &Job, bounds: fn(&Job, &Reached)) {
    let mut least = [Duration::MAX; 2];
    for _ in 0..ROUNDS {
        let (reach, reached) = timed(|| job.reached());
        let (bound, ()) = timed(|| bounds(job, &reached));
        least = [least[0].min(reach), least[1].min(bound)];
    }
    let [reach, bound] = least.map(|time| time.as_secs_f64() * 1e3);
    let (cuts, share) = (job.cuts, 100.0 * bound / reach);
    println!("| {cuts} | {reach:.1} | {bound:.1} | {share:.1} % |");
}

fn timed<T>(work: impl FnOnce() -> T) -> (Duration, T) {
    let begun = Instant::now();
    let made = work();
    (begun.elapsed(), made)
}
