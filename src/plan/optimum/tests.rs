//! Checks against published numbers, against search on a grid, and against another author's optimiser.

use super::{Extension, Optimum, Problem, Range, Work, solve};
use crate::job::{Formulas, Lattice, Objective};
use vcutc_backend_api::units::{Angle, AngularSpeed, Area, Length, Speed};

/// Table 1 of the paper.
pub(super) fn table_1(formulas: Formulas, lattice: Lattice) -> Problem {
    Problem {
        objective: Objective::Time,
        formulas,
        lattices: vec![lattice],
        work: Work {
            width: Length::mm(85.0),
            depth: Length::mm(50.0),
            area: Area::mm2(3137.0),
            clearance: Length::mm(10.0),
            cutting_length: Length::mm(10.0),
            half_apex: Angle::deg(7.13),
            rake: Angle::deg(60.0),
            allowance: Length::ZERO,
            standoff: Length::ZERO,
            extension: Extension::EdgeInUse,
            cut_feed: Speed::mm_per_s(200.0),
            travel_feed: Speed::mm_per_s(200.0),
            reorient_rate: AngularSpeed::deg_per_s(90.0),
        },
        swing: Range {
            least: Angle::deg(1.0),
            most: Angle::deg(50.0),
        },
        layer: Range {
            least: Length::mm(0.01),
            most: Length::mm(50.0),
        },
        step: Range {
            least: Length::mm(0.01),
            most: Length::mm(85.0),
        },
        overlap: Range {
            least: 0.0,
            most: 0.95,
        },
        scallop: Some(Length::mm(10.0)),
        edge: None,
        time: None,
        cuts: None,
    }
}

fn solved(formulas: Formulas, lattice: Lattice) -> Optimum {
    solve(&table_1(formulas, lattice)).unwrap()
}

fn assert_near(optimum: &Optimum, [swing, layer, step, time]: [f64; 4]) {
    let found = [
        optimum.swing.to_deg(),
        optimum.layer.to_mm(),
        optimum.step.to_mm(),
        optimum.time.to_s(),
    ];
    for (found, expected) in found.into_iter().zip([swing, layer, step, time]) {
        assert!((found / expected - 1.0).abs() < 1e-5, "{optimum:?}");
    }
}

#[test]
fn the_papers_optimum() {
    // Table 1: h 4.40, s 5.97, alpha 34.16, T 40.3 % below 515.3 s, delta 9.29.
    let optimum = solved(Formulas::Paper, Lattice::Orthogonal);
    assert_near(&optimum, [34.1550, 4.39838, 5.96818, 307.59922]);
    assert!((optimum.scallop.to_mm() - 9.29).abs() < 0.005, "{optimum:?}");
}

#[test]
fn the_exact_optima_of_the_papers_job() {
    let orthogonal = solved(Formulas::Exact, Lattice::Orthogonal);
    assert_near(&orthogonal, [35.57091, 6.484948, 4.637788, 261.491687]);
    assert!((orthogonal.overlap - 0.5).abs() < 1e-12, "{orthogonal:?}");
    let interlaced = solved(Formulas::Exact, Lattice::Interlaced);
    assert_near(&interlaced, [50.0, 5.0, 11.917536, 169.342765]);
}
