//! How long the best parameters take to find, and how long two local optimisers take for the paper's problem.
//!
//! `cargo run --release --bin optimum` prints the rows of the tables in `docs/benchmarks.md`.

use std::hint::black_box;
use std::time::Instant;
use vcutc::vcut::asked::{Formulas, Lattice, Objective};
use vcutc::vcut::plan::optimum::published::table_1;
use vcutc::vcut::plan::optimum::{Problem, solve};
use vcutc_benches::optimum::{LATTICES, STARTS, cobyla, conflict, is_least, slsqp, within_600_s};

/// How closely the peers are asked to come to the least time.
const ACCURACIES: [f64; 3] = [1e-4, 1e-6, 1e-12];

fn main() {
    let paper = table_1(Formulas::Paper, Lattice::Orthogonal);
    let ours = timed(|| drop(black_box(solve(black_box(&paper)))));
    println!("the paper's problem: {ours:.1} us, proven, without a start");
    for accuracy in ACCURACIES {
        for (name, peer) in [
            ("cobyla", cobyla as fn([f64; 3], f64) -> Vec<f64>),
            ("slsqp", slsqp),
        ] {
            let found = STARTS
                .iter()
                .filter(|start| is_least(&peer(**start, accuracy)))
                .count();
            let all = timed(|| {
                for start in STARTS {
                    black_box(peer(black_box(start), accuracy));
                }
            });
            let each = all / 5.0;
            println!(
                "{name} to {accuracy:e}: {each:.1} us, {:.2} times ours, the optimum from {found} of 5 starts",
                each / ours
            );
        }
    }
    let mut sum = 0.0;
    for formulas in [Formulas::Paper, Formulas::Exact] {
        for lattice in LATTICES {
            sum += row("least time", formulas, lattice, &table_1(formulas, lattice));
        }
    }
    println!("least time, both formulas, all lattices: {sum:.0} us");
    for objective in [Objective::Cuts, Objective::Scallop, Objective::BladeLoad] {
        for lattice in LATTICES {
            let problem = within_600_s(objective, Formulas::Exact, lattice);
            row(
                &format!("{objective:?} within 600 s"),
                Formulas::Exact,
                lattice,
                &problem,
            );
        }
    }
    for formulas in [Formulas::Paper, Formulas::Exact] {
        row("conflict", formulas, Lattice::Orthogonal, &conflict(formulas));
    }
}

/// Prints what a problem takes, in us.
fn row(what: &str, formulas: Formulas, lattice: Lattice, problem: &Problem) -> f64 {
    let us = timed(|| drop(black_box(solve(black_box(problem)))));
    println!("{what}, {formulas:?}, {lattice:?}: {us:.0} us");
    us
}

/// The least of 25 rounds of at least 2 ms each, in us: what other work on the machine adds is left out.
fn timed(mut work: impl FnMut()) -> f64 {
    let round = |_| {
        let (start, mut times) = (Instant::now(), 0_u32);
        while start.elapsed().as_secs_f64() < 2e-3 {
            work();
            times += 1;
        }
        1e6 * start.elapsed().as_secs_f64() / f64::from(times)
    };
    (0..25).map(round).fold(f64::INFINITY, f64::min)
}
