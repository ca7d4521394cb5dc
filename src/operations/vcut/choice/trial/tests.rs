//! The search ends.

use super::*;
use crate::samples::{operation, paper_job};
use vcutc_geometry::curve::Point2;
use vcutc_job::operation::Ground;
use vcutc_job::{PlanningJob, Sourced};
use vcutc_process::plan::ground_of;

/// Plans of the formulas' choice and laxer limits, of the spread and its turns, of the changes, and of layers close to the best one.
const MOST: usize = 48 + 72 + 72 + 48 + 10;

#[test]
fn the_search_is_bounded() {
    let heights: [fn(f64) -> f64; 3] = [
        |x| 20.0 + 3.0 * libm::sin(x / 9.0),
        |x| (30.0 - 8.0 * (x - 40.0)).clamp(10.0, 30.0),
        |x| if x < 42.0 { 10.0 } else { 40.0 },
    ];
    for height in heights {
        for scallop in [0.02, 0.4, 3.0, 20.0] {
            let corners = (0..=85).map(f64::from).map(|x| Point2 { x, z: height(x) });
            let mut job = paper_job(corners.collect());
            let asked = operation(&mut job);
            asked.swing.value = Auto::Auto;
            asked.layer.value = Auto::Auto;
            asked.step.value = Auto::Auto;
            asked.limits.scallop = Some(Sourced {
                value: Length::mm(scallop),
                span: None,
            });
            let asked = operation(&mut job).clone();
            let job = PlanningJob::of(&job).unwrap();
            let ground = Ground {
                cuts_left: 1_000_000,
                ..ground_of(&job, 0).unwrap()
            };
            let bench = Bench::new(&asked, ground);
            for lattice in [Lattice::Orthogonal, Lattice::Interlaced, Lattice::Free] {
                let by_bound = parameters::resolve_on(&job, &asked, vec![lattice]).ok();
                let lattices = [lattice];
                let mut trials = Trials::new(&bench, &asked, &lattices);
                trials.search(by_bound.as_ref());
                assert!(trials.tried.len() <= MOST, "{}", trials.tried.len());
            }
        }
    }
}
