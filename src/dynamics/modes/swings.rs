//! How an arm swings over the cuts of a program, and what of the cutting meets that, found together: modes take most of the work.

use super::cells::{Cells, Edges};
use super::figures::{ModeFigures, Ranges};
use super::samples::along_cuts;
use super::teeth::{Crushers, Teeth};
use crate::arms::Arms;
use crate::blade::PushedBlade;
use crate::cuts::Known;
use std::collections::BTreeMap;
use vcutc_backend_api::units::Length;

/// How an arm swings by itself over the cuts of a program.
#[derive(Clone, Debug, PartialEq)]
pub struct Swings {
    /// None where nothing is cut.
    pub figures: Option<ModeFigures>,
    /// Of the operations that cut with an edge, where the size of the cells is known.
    pub cells: Option<Vec<Cells>>,
    /// Of the operations that cut with a crusher that states its teeth.
    pub teeth: Vec<Teeth>,
}

impl Swings {
    /// Of an arm that cuts with these blades through cells of this size. None where masses or stiffness are not known, where a joint moves
    /// no mass, and where the masses are not bodies.
    #[must_use]
    pub fn of(
        known: Known<'_>,
        arms: &Arms,
        blades: &BTreeMap<&str, PushedBlade<'_>>,
        cell_size: Option<Length>,
    ) -> Option<Self> {
        let (mut ranges, mut edges, mut crushers) =
            (Ranges::default(), Edges::default(), Crushers::default());
        along_cuts(known, arms, |sample| {
            ranges.take(&sample.modes);
            if cell_size.is_some() {
                edges.take(sample);
            }
            crushers.take(sample, blades);
        })?;
        Some(Self {
            figures: ranges.figures(known.model),
            cells: cell_size.map(|size| edges.cells(size)),
            teeth: crushers.teeth(),
        })
    }
}
