//! How far each cut deviates, proven on all of it: for pictures.

use super::figures::{DeviationFigures, GravityFigure, OperationDeviation};
use super::{Deviations, Shifts, Ways};
use crate::cuts::Face;
use crate::peaks::Whole;
use rayon::prelude::*;
use vcutc_backend_api::ir::{OpId, OperationId};
use vcutc_motion::path::Part;

/// By which share of the most that its operation deviates a cut may be stated too wide, where [`FINER`] suffices for that.
const CLOSE: f64 = 0.01;

/// In how many times the parts that the reach needs a cut is looked at, one after the other.
const FINER: [u32; 4] = [1, 2, 4, 8];

/// How far a cut deviates, in mm: nowhere on it more.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CutDeviation {
    pub op: OpId,
    pub face: Face,
    pub into_waste: f64,
    pub into_part: f64,
}

impl DeviationFigures {
    /// Cut by cut, in the program's order: those of the operations that these figures have. What counts of the sag of the arm is among
    /// it, as it is in the figures. None where that of a cut is not known.
    #[must_use]
    pub fn each(&self, deviations: &Deviations<'_>) -> Option<Vec<CutDeviation>> {
        let sag = self.gravity.map_or(0.0, GravityFigure::either_way);
        let wholes = self.operations.iter().flat_map(|of| {
            let wholes = deviations.cuts.wholes_of(OperationId(of.operation));
            wholes.map(move |whole| (of, whole))
        });
        let wholes: Vec<(&OperationDeviation, Whole)> = wholes.collect();
        let each: Option<Vec<CutDeviation>> = wholes
            .into_par_iter()
            .map(|(of, whole)| {
                let [waste, part] = [of.into_waste.most, of.into_part.most];
                let close = CLOSE * 1e-3 * (waste.max(part) - sag);
                let cut = deviations.cuts.get(whole.op)?;
                let ways = deviations.of_cut(whole, close, deviations.counted(cut.operation))?;
                // What is proven of all cuts of the operation holds for this one, too.
                let held = |way: f64, most: f64| (1000.0 * way + sag).min(most);
                Some(CutDeviation {
                    op: whole.op,
                    face: deviations.cuts.face(cut)?,
                    into_waste: held(ways.into_waste, waste),
                    into_part: held(ways.into_part, part),
                })
            })
            .collect();
        let mut each = each?;
        each.sort_by_key(|cut| cut.op);
        Some(each)
    }
}

impl Deviations<'_> {
    /// The shifts of an operation that count as its deviation.
    fn counted(&self, operation: OperationId) -> Shifts<1> {
        match self.cuts.known().compensation(operation) {
            Some(_) => |push, columns, springs| [push.loaded(columns, springs)],
            None => |push, columns, springs| [push.shifts(columns, springs)],
        }
    }

    /// Without what is not a number: it would pass every comparison.
    fn known_shifts(&self, op: OpId, part: Part, shifts: Shifts<1>) -> Option<[Ways; 2]> {
        let [shifts] = self.shifts(op, part, shifts)?;
        shifts.into_iter().all(Ways::is_finite).then_some(shifts)
    }

    /// How far a cut is off, in m: in ever shorter parts, until that is stated no more than `close` too wide.
    pub(super) fn of_cut(&self, whole: Whole, close: f64, shifts: Shifts<1>) -> Option<Ways> {
        let mut found = None;
        for finer in FINER {
            let count = whole.parts.saturating_mul(finer);
            let parts = (0..count).map(|number| Part::one_of(count, number));
            let looked: Option<Vec<[Ways; 2]>> = parts
                .map(|part| self.known_shifts(whole.op, part, shifts))
                .collect();
            found = looked.and_then(|looked| looked.into_iter().reduce(wider));
            if let Some([middle, everywhere]) = found
                && everywhere.exceeds(middle) <= close
            {
                break;
            }
        }
        found.map(|[_, everywhere]| everywhere)
    }
}

/// The wider ones, view by view.
fn wider(one: [Ways; 2], other: [Ways; 2]) -> [Ways; 2] {
    core::array::from_fn(|view| Ways {
        into_waste: one[view].into_waste.max(other[view].into_waste),
        into_part: one[view].into_part.max(other[view].into_part),
    })
}

impl Ways {
    /// By how much it is wider than another one, at most.
    fn exceeds(self, other: Self) -> f64 {
        (self.into_waste - other.into_waste).max(self.into_part - other.into_part)
    }

    const fn is_finite(self) -> bool {
        self.into_waste.is_finite() && self.into_part.is_finite()
    }
}
