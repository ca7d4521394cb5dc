//! The best parameters: the problem of [Cui 14] by the compiler's solver, and by two local ones from five starts.
//!
//! The peers get the problem as the paper prints it, in layer, step and swing, with the bounds on reach, scallop and overlap as
//! constraints. They answer from where they start; whether that is the best there is they do not say.

use vcutc::vcut::asked::{Formulas, Lattice, Objective};
use vcutc::vcut::plan::optimum::Problem;
use vcutc::vcut::plan::optimum::published::table_1;
use vcutc_backend_api::units::Duration;

/// All lattices.
pub const LATTICES: [Lattice; 3] = [Lattice::Orthogonal, Lattice::Interlaced, Lattice::Free];

/// Where the peers start: layer and step in mm, swing in rad.
pub const STARTS: [[f64; 3]; 5] = [
    [3.0, 6.0, 0.785],
    [2.0, 2.0, 0.5],
    [4.0, 3.0, 0.3],
    [1.0, 1.0, 0.8],
    [5.0, 4.0, 0.6],
];

/// Ranges of layer, step and swing for the peers.
const SIDES: [(f64, f64); 3] = [(0.1, 50.0), (0.1, 85.0), (0.02, 0.872_664_625_997_164_8)];

/// The least time of the paper's problem, in s (`docs/process.md`, "The optimum").
pub const LEAST: f64 = 307.599_215;

/// Table 1 with another objective, within 600 s.
#[must_use]
pub fn within_600_s(objective: Objective, formulas: Formulas, lattice: Lattice) -> Problem {
    Problem {
        objective,
        time: Some(Duration::s(600.0)),
        ..table_1(formulas, lattice)
    }
}

/// Table 1 within 200 s, which nothing keeps.
#[must_use]
pub fn conflict(formulas: Formulas) -> Problem {
    Problem {
        time: Some(Duration::s(200.0)),
        ..table_1(formulas, Lattice::Orthogonal)
    }
}

/// The lead of the edge, rake less half apex.
fn lead() -> f64 {
    (60.0_f64 - 7.13).to_radians()
}

/// The time of [Cui 8-11], in s.
fn time(x: &[f64]) -> f64 {
    let (layer, step, swing) = (x[0], x[1], x[2]);
    let points = 85.0 / step + 0.5;
    let layers = (3137.0 / (85.0 * layer) - 0.5).max(1.0);
    let turn = 2.0 * (swing.cos() * 60.0_f64.to_radians().sin()).acos() / 90.0_f64.to_radians();
    let extension = edge(x) * lead().cos();
    let cut = (2.0 * 50.0 + 4.0 * extension) / 200.0 + turn + turn.max(step / 200.0);
    let change = (2.0 * 10.0 + 2.0 * 3137.0 / 85.0 + 85.0 - layer - step / 2.0) / 200.0;
    layers * (points * cut + change)
}

/// The edge in use [Cui 4], in mm.
fn edge(x: &[f64]) -> f64 {
    1.5 * x[0] / (x[2].cos() * lead().sin())
}

fn reach(x: &[f64]) -> f64 {
    10.0 - edge(x)
}

/// [Cui 12].
fn scallop(x: &[f64]) -> f64 {
    10.0 - (x[1] / 2.0).hypot(x[0] + x[1] / (2.0 * x[2].tan()))
}

fn no_gap(x: &[f64]) -> f64 {
    2.0 * x[0] * x[2].tan() - x[1]
}

/// Whether a peer's answer is the least time within its bounds but for a millionth.
#[must_use]
pub fn is_least(x: &[f64]) -> bool {
    let kept = [reach(x), scallop(x), no_gap(x)].iter().all(|&room| room > -1e-5);
    kept && time(x) < LEAST * (1.0 + 1e-6)
}

/// The cobyla package, at that accuracy of the time.
#[must_use]
pub fn cobyla(start: [f64; 3], accuracy: f64) -> Vec<f64> {
    let constraints: [&dyn cobyla::Func<()>; 3] = [
        &|x: &[f64], _: &mut ()| reach(x),
        &|x: &[f64], _: &mut ()| scallop(x),
        &|x: &[f64], _: &mut ()| no_gap(x),
    ];
    let stop = cobyla::StopTols {
        ftol_rel: accuracy,
        ..cobyla::StopTols::default()
    };
    let objective = |x: &[f64], _: &mut ()| time(x);
    let begin = cobyla::RhoBeg::All(0.3);
    match cobyla::minimize(
        objective,
        &start,
        &SIDES,
        &constraints,
        (),
        5000,
        begin,
        Some(stop),
    ) {
        Ok((_, x, _)) | Err((_, x, _)) => x,
    }
}

/// Slopes by finite differences, as a solver takes them that has no derivatives.
fn slopes(function: fn(&[f64]) -> f64, x: &[f64], gradient: &mut [f64]) {
    let here = function(x);
    let mut moved = [x[0], x[1], x[2]];
    for i in 0..3 {
        let step = 1e-7 * x[i].abs().max(1e-3);
        moved[i] = x[i] + step;
        gradient[i] = (function(&moved) - here) / step;
        moved[i] = x[i];
    }
}

/// The slsqp package, at that accuracy of the time.
#[must_use]
pub fn slsqp(start: [f64; 3], accuracy: f64) -> Vec<f64> {
    let sloped = |function: fn(&[f64]) -> f64, sign: f64| {
        move |x: &[f64], gradient: Option<&mut [f64]>, _: &mut ()| {
            if let Some(gradient) = gradient {
                slopes(function, x, gradient);
                gradient.iter_mut().for_each(|slope| *slope *= sign);
            }
            sign * function(x)
        }
    };
    // It wants them not positive.
    let (one, two, three) = (sloped(reach, -1.0), sloped(scallop, -1.0), sloped(no_gap, -1.0));
    let constraints: [&dyn slsqp::Func<()>; 3] = [&one, &two, &three];
    let stop = slsqp::StopTols {
        ftol_rel: accuracy,
        ..slsqp::StopTols::default()
    };
    match slsqp::minimize(
        sloped(time, 1.0),
        &start,
        &SIDES,
        &constraints,
        (),
        500,
        Some(stop),
    ) {
        Ok((_, x, _)) | Err((_, x, _)) => x,
    }
}
