//! The problem that the paper publishes with its optimum [Cui 2020, Table 1], to compare a solver with.

use super::problem::{Extension, Problem, Range, Work};
use crate::asked::{Formulas, Lattice, Objective};
use vcutc_backend_api::units::{Angle, AngularSpeed, Area, Length, Speed};

/// The block of Table 1, its blade and its speeds, within its limits, on one lattice: least time, how far cuts run out
/// following from the edge in use [Cui 5].
#[must_use]
pub fn table_1(formulas: Formulas, lattice: Lattice) -> Problem {
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
