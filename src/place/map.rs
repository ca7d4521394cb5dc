//! Margins or deviations over x and y, at one height and one turn of the work.

use crate::score::{Objective, Scorer};
use crate::search::{Bounds, evenly, scored};
use crate::spot::Spot;
use vcutc_backend_api::geometry::Frame;
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::number::show;
use vcutc_picture::heat_map::{HeatMap, Measure, draw};

/// Margins by the taught poses, or deviations by a few places of the cuts, over the bounds of x and y.
#[derive(Clone, Debug, PartialEq)]
pub struct Map {
    /// x of the places, in mm.
    pub xs: Vec<i32>,
    /// y of the places, in mm.
    pub ys: Vec<i32>,
    /// The height and turn at which the map is drawn; x and y say nothing.
    pub at: Spot,
    /// What the values are.
    pub objective: Objective,
    /// Margins from 0 to 1, or deviations in mm, row by row from the least y; none where something is out of reach, and where the margin
    /// is too small for deviations.
    pub values: Vec<Option<f64>>,
}

/// Cells along the longer side.
const CELLS: i32 = 40;

impl Map {
    /// Scores all places of the map.
    #[must_use]
    pub fn draw(by: &Scorer<'_, '_>, base: &Frame, bounds: &Bounds, at: Spot) -> Self {
        let widths = [bounds.most.x - bounds.least.x, bounds.most.y - bounds.least.y];
        let longest = widths.into_iter().max().unwrap_or_default().max(1);
        let cells = |width: i32| (f64::from(CELLS) * f64::from(width) / f64::from(longest)).round() as i32;
        let xs = evenly(bounds.least.x, bounds.most.x, cells(widths[0]));
        let ys = evenly(bounds.least.y, bounds.most.y, cells(widths[1]));
        let spots = ys
            .iter()
            .flat_map(|&y| xs.iter().map(move |&x| Spot { x, y, ..at }))
            .collect();
        let objective = by.objective();
        let scores = scored(by, base, spots).into_iter().map(|placed| placed.score);
        let values = scores.map(|score| match objective {
            Objective::Margin => score.reached(),
            Objective::Deviation => score.deviation.map(Length::to_mm),
        });
        Self {
            xs,
            ys,
            at,
            objective,
            values: values.collect(),
        }
    }

    /// The map as SVG.
    #[must_use]
    pub fn svg(&self, title: &str, now: &Frame, best: Option<Spot>) -> String {
        let (measure, by) = match self.objective {
            Objective::Margin => (Measure::Margin, "the taught poses"),
            Objective::Deviation => (Measure::Deviation, "a few places of the cuts"),
        };
        let subtitle = format!(
            "z {} mm, work turned by {} deg against now; by {by}",
            self.at.z,
            show(self.at.turn().to_deg())
        );
        draw(&HeatMap {
            title,
            subtitle: &subtitle,
            xs: &self.xs,
            ys: &self.ys,
            measure,
            values: &self.values,
            now: [now.origin.x, now.origin.y],
            best: best.map(|spot| [f64::from(spot.x), f64::from(spot.y)]),
        })
    }
}
