//! Time against scallop: the least time for each of a row of limits.

use super::LATTICES;
use super::came::Came;
use vcutc_backend_api::units::Length;
use vcutc_vcut::asked::Lattice;
use vcutc_vcut::plan::optimum::{self, Optimum, Problem};

/// What limits of the scallop cost.
#[derive(Clone, Debug, PartialEq)]
pub struct TradeOff {
    /// The job's own limit.
    pub limit: Option<Length>,
    /// The fastest parameters that the job allows for a row of scallops, by growing scallop.
    pub points: Vec<Optimum>,
    /// What came of planning the job under each of these limits, in the same order.
    pub planned: Vec<Came>,
    /// The same for each lattice on its own; the chosen one comes first, and lattices that cannot keep the other bounds are
    /// left out.
    pub curves: Vec<LatticeCurve>,
}

/// The fastest parameters of one lattice.
#[derive(Clone, Debug, PartialEq)]
pub struct LatticeCurve {
    pub lattice: Lattice,
    /// The parameters, by growing scallop; at least one.
    pub points: Vec<Optimum>,
}

impl TradeOff {
    /// Solves the problem for so many limits, and plans the job under each of them as far as there is room, the coarsest first.
    pub(super) fn of(
        problem: &Problem,
        chosen: Lattice,
        points: u32,
        mut plan: impl FnMut(&Optimum) -> Came,
    ) -> Self {
        let mut lattices = LATTICES;
        lattices.sort_by_key(|&lattice| lattice != chosen);
        let curve = |lattice: Lattice| {
            let alone = Problem {
                lattices: vec![lattice],
                ..problem.clone()
            };
            let points = optimum::trade_off(&alone, points);
            (!points.is_empty()).then_some(LatticeCurve { lattice, points })
        };
        let of_all = optimum::trade_off(problem, points);
        let mut planned: Vec<Came> = of_all.iter().rev().map(&mut plan).collect();
        planned.reverse();
        Self {
            limit: problem.scallop,
            points: of_all,
            planned,
            curves: lattices.into_iter().filter_map(curve).collect(),
        }
    }
}
