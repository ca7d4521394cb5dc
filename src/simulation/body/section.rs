//! The section of the stock at a moment, and how near cylinders come to it.
//!
//! Cuts only lower the section, so its heights of a while ago are bounds from above. They are kept column by column: most
//! bodies pass far above what stands below them, and nothing else has to be looked at then.

use super::backbone::Backbone;
use super::shadow::Shadow;
use super::slant::Slant;
use super::stage::{Axis, Cylinder};
use crate::course::Way;
use crate::surface::Surface;
use vcutc_backend_api::ir::Stock;
use vcutc_geometry::curve::Point2;

/// The nearest place of a body on a way, and how it comes there.
#[derive(Clone, Copy)]
pub(super) struct Near {
    pub(super) stage: usize,
    pub(super) at: Point2,
    /// Along z; negative within the section.
    pub(super) gap: f64,
    pub(super) axis: Axis,
    pub(super) way: Way,
    pub(super) slant: Slant,
}

/// The section as it is at a moment.
pub(super) struct Section<'s> {
    pub(super) stock: Stock,
    pub(super) surface: &'s mut Surface,
    pub(super) ceiling: &'s Ceiling,
    /// Along which the section stands, where it does not stand level.
    pub(super) backbone: Option<Backbone<'s>>,
}

impl Section<'_> {
    /// Where one of some cylinders, as the blade is held, comes nearest above the section on a way, if that is nearer than so
    /// much. None where all of them pass beside it.
    pub(super) fn nearest(&mut self, stages: &[Cylinder], axis: Axis, way: Way, within: f64) -> Option<Near> {
        let mut nearest: Option<Near> = None;
        let highest = self.highest();
        let slant = match &self.backbone {
            None => Slant::default(),
            Some(backbone) => {
                let low = stages
                    .iter()
                    .map(|stage| stage.below(highest + within.min(0.0), way.lowest(), axis.rise()));
                backbone.slant(&low.collect::<Vec<_>>(), axis, way)
            }
        };
        for (stage, cylinder) in stages.iter().enumerate() {
            let within = nearest.map_or(within, |near| near.gap);
            let low = cylinder.below(highest + within, way.lowest(), axis.rise());
            let Some(shadow) = low.shadow(axis, way, self.stock, slant) else {
                continue;
            };
            if let Some((at, gap)) = self.gap(&shadow, within).filter(|&(_, gap)| gap < within) {
                nearest = Some(Near {
                    stage,
                    at,
                    gap,
                    axis,
                    way,
                    slant,
                });
            }
        }
        nearest
    }

    /// How high the work is at most.
    pub(super) fn highest(&self) -> f64 {
        self.ceiling.highest() + self.backbone.map_or(0.0, |backbone| backbone.highest())
    }

    /// How far a shadow stays above the section, unless it plainly is farther than so much.
    fn gap(&mut self, shadow: &Shadow, within: f64) -> Option<(Point2, f64)> {
        let (left, right) = shadow.span();
        if shadow.lowest().z - self.ceiling.between(left, right)? >= within {
            return None;
        }
        let piece: Vec<Point2> = self.surface.stretch(left, right).collect();
        shadow.nearest_above(&piece)
    }
}

/// How many columns there are.
const COLUMNS: usize = 128;

/// After so many motions the columns are made again.
const LASTS: u32 = 64;

/// Bounds on the section's height from above.
pub(super) struct Ceiling {
    /// From left to right, all equally wide.
    columns: Vec<f64>,
    width: f64,
    /// Of all of them.
    highest: f64,
    /// For how many motions they are good.
    left: u32,
}

impl Ceiling {
    /// Of an uncut stock.
    pub(super) fn of(stock: Stock) -> Self {
        let highest = stock.height.to_mm();
        Self {
            columns: vec![highest; COLUMNS],
            width: stock.width.to_mm() / COLUMNS as f64,
            highest,
            left: LASTS,
        }
    }

    /// How high the section is at most.
    pub(super) const fn highest(&self) -> f64 {
        self.highest
    }

    /// Counts a motion.
    pub(super) fn grow_older(&mut self, surface: &Surface) {
        self.left -= 1;
        if self.left == 0 {
            self.renew(surface);
            self.left = LASTS;
        }
    }

    fn renew(&mut self, surface: &Surface) {
        self.columns.fill(f64::NEG_INFINITY);
        let mut before: Option<Point2> = None;
        for corner in surface.corners() {
            let from = before.unwrap_or(corner);
            let higher = from.z.max(corner.z);
            for column in self.over(from.x, corner.x).unwrap_or_default() {
                *column = column.max(higher);
            }
            before = Some(corner);
        }
        self.highest = self.columns.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    }

    /// The columns that lie over a stretch of x; none where it lies beside the stock.
    fn over(&mut self, from: f64, to: f64) -> Option<&mut [f64]> {
        let range = self.range(from, to)?;
        self.columns.get_mut(range)
    }

    /// How high the section is between two x at most; none beside the stock.
    fn between(&self, from: f64, to: f64) -> Option<f64> {
        let columns = self.columns.get(self.range(from, to)?)?;
        columns.iter().copied().reduce(f64::max)
    }

    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a place within the stock, in columns; saturates"
    )]
    fn range(&self, from: f64, to: f64) -> Option<core::ops::RangeInclusive<usize>> {
        let last = COLUMNS - 1;
        if to < 0.0 || from > self.width * COLUMNS as f64 {
            return None;
        }
        let column = |x: f64| ((x / self.width).max(0.0) as usize).min(last);
        Some(column(from)..=column(to))
    }
}
