//! Where the tips of each layer lie, before anybody asks whether they can be cut.
//!
//! Layers lie `h` apart from the stock's top down. Orthogonal layers share one row of columns; interlaced layers alternate
//! between that row and one shifted by half a step. Both rows are centred, so that no strip wider than half a step is
//! left at either side and edge cuts need no more reach than others. Free layers choose their own tips: each stretch in
//! which the V clears the part gets a tip on the part at each of its ends and evenly spaced ones between [Cui fig. 4].

use super::parameters::VcutParameters;
use crate::asked::Lattice;
use vcutc_backend_api::ir::Stock;
use vcutc_geometry::curve::Point2;
use vcutc_geometry::grid;
use vcutc_geometry::profile::Profile;

/// A place across the stock where tips may lie in several layers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Column {
    pub x: f64,
    /// The lowest height of a tip there that keeps the blade out of the part.
    pub floor: f64,
}

/// The tips of one layer.
#[derive(Clone, Debug, PartialEq)]
pub enum Row<'l> {
    /// Columns, some of which may lie within the part at this height.
    Columns {
        /// Which row of columns it is.
        parity: Parity,
        /// The columns from left to right.
        columns: &'l [Column],
    },
    /// Tips that all clear the part.
    Free(Vec<Point2>),
}

/// Interlaced lattices have two rows of columns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Parity {
    /// Layers 1, 3, 5 ...
    Odd,
    /// Layers 2, 4, 6 ... of an interlaced lattice.
    Even,
}

/// All layers of one operation.
#[derive(Debug)]
pub struct Layout<'c> {
    clearance: &'c Profile,
    drop: f64,
    width: f64,
    top: f64,
    layer: f64,
    step: f64,
    layers: u32,
    rows: Rows,
}

#[derive(Debug)]
enum Rows {
    Same(Vec<Column>),
    Alternating { odd: Vec<Column>, even: Vec<Column> },
    Free,
}

impl<'c> Layout<'c> {
    /// Lays tips out over a stock. The clearance is that of the part with its allowance for the operation's flanks.
    #[must_use]
    pub fn new(stock: Stock, lattice: Lattice, parameters: &VcutParameters, clearance: &'c Profile) -> Self {
        let mut layout = Self {
            clearance,
            drop: parameters.drop.to_mm(),
            width: stock.width.to_mm(),
            top: stock.height.to_mm(),
            layer: parameters.layer.to_mm(),
            step: parameters.step.to_mm(),
            layers: 0,
            rows: Rows::Free,
        };
        let depth = layout.top - (clearance.lowest().z + layout.drop);
        // Down to the first layer that lies wholly below the floor: its tips may still be raised onto it. Interlaced columns
        // are visited every other layer only, so they get one more.
        let extra = if lattice == Lattice::Interlaced { 1.0 } else { 0.0 };
        let layers = if depth > 0.0 {
            (depth / layout.layer).ceil() + extra
        } else {
            0.0
        };
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "positive; saturates"
        )]
        {
            layout.layers = layers as u32;
        }
        if layout.most_tips() <= super::MOST_CUTS {
            layout.rows = layout.lay_out(lattice);
        }
        layout
    }

    /// How low a V may go, but for the drop.
    #[must_use]
    pub const fn clearance(&self) -> &Profile {
        self.clearance
    }

    /// How many layers there are.
    #[must_use]
    pub const fn layers(&self) -> u32 {
        self.layers
    }

    /// How many corners of the clearance are looked at to lay out one layer.
    #[must_use]
    pub fn corners_per_layer(&self) -> usize {
        match self.rows {
            Rows::Same(_) | Rows::Alternating { .. } => 0,
            Rows::Free => self.clearance.points().len(),
        }
    }

    /// As many tips as all layers together have, but for the few more of free layers in several stretches.
    #[must_use]
    pub fn most_tips(&self) -> usize {
        let a_layer = (self.width / self.step).ceil() + 1.0;
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "positive; saturates"
        )]
        let most = (a_layer * f64::from(self.layers)) as usize;
        most
    }

    /// Height of a layer's tips, counted from 1.
    #[must_use]
    pub fn height(&self, layer: u32) -> f64 {
        grid::nearest(self.top - f64::from(layer) * self.layer)
    }

    /// Spacing of tips within a layer.
    #[must_use]
    pub const fn step(&self) -> f64 {
        self.step
    }

    /// The tips of a layer.
    #[must_use]
    pub fn row(&self, layer: u32) -> Row<'_> {
        match &self.rows {
            Rows::Same(columns) => Row::Columns {
                parity: Parity::Odd,
                columns,
            },
            Rows::Alternating { odd, .. } if layer % 2 == 1 => Row::Columns {
                parity: Parity::Odd,
                columns: odd,
            },
            Rows::Alternating { even, .. } => Row::Columns {
                parity: Parity::Even,
                columns: even,
            },
            Rows::Free => Row::Free(self.free_tips(self.height(layer))),
        }
    }

    /// The lowest tip at x that keeps the blade out of the part, on the grid.
    #[must_use]
    pub fn floor(&self, x: f64) -> f64 {
        grid::up(self.clearance.height(x) + self.drop)
    }

    /// The x nearest to a column where a tip at height z keeps the blade out of the part.
    #[must_use]
    pub fn nearest_clear(&self, x: f64, z: f64) -> Option<f64> {
        self.clearance.nearest_clear(x, z - self.drop)
    }

    fn lay_out(&self, lattice: Lattice) -> Rows {
        let column = |x: f64| {
            let x = grid::nearest(x);
            Column {
                x,
                floor: self.floor(x),
            }
        };
        let count = (self.width / self.step).ceil().max(1.0);
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "positive, bounded by MOST_CUTS"
        )]
        let points = count as u32;
        // On the grid, so that a step on the grid keeps all tips exactly a step apart.
        let first = grid::down((self.width - (count - 1.0) * self.step) / 2.0);
        let row = || {
            (0..points)
                .map(|i| column(first + f64::from(i) * self.step))
                .collect()
        };
        match lattice {
            Lattice::Orthogonal => Rows::Same(row()),
            Lattice::Interlaced => {
                let odd = row();
                let even = (0..=points)
                    .map(|i| first + (f64::from(i) - 0.5) * self.step)
                    .filter(|x| (0.0..=self.width).contains(x))
                    .map(column)
                    .collect();
                Rows::Alternating { odd, even }
            }
            Lattice::Free | Lattice::Fitted => Rows::Free,
        }
    }

    fn free_tips(&self, z: f64) -> Vec<Point2> {
        let mut tips = Vec::new();
        for (from, to) in self.clearance.level_set(z - self.drop) {
            let at_part = [from > grid::SPACING, to < self.width - grid::SPACING];
            for x in spread(from, to, at_part, self.step) {
                let x = grid::nearest(x);
                // Rounding x may have brought the tip a hair into the part.
                tips.push(Point2 {
                    x,
                    z: z.max(self.floor(x)),
                });
            }
        }
        tips
    }
}

/// Evenly spaced tips over a stretch, at most a step apart: on its ends where those lie on the part, half a spacing away
/// from them where they lie on the stock's sides.
fn spread(from: f64, to: f64, on_part: [bool; 2], step: f64) -> impl Iterator<Item = f64> {
    let length = to - from;
    let halves = on_part.iter().filter(|&&on| !on).count() as f64 / 2.0;
    // n tips span n - 1 spacings and half a spacing at each side of the stock.
    let mut count = (length / step + 1.0 - halves).ceil().max(1.0);
    if count > 1.0 && length < step / 4.0 {
        count = 1.0;
    }
    let spacing = if count - 1.0 + halves > 0.0 {
        length / (count - 1.0 + halves)
    } else {
        0.0
    };
    let first = match (on_part[0], count > 1.0 || halves > 0.0) {
        (true, true) => from,
        (true, false) => from + length / 2.0,
        (false, _) => from + spacing / 2.0,
    };
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "positive, bounded by MOST_CUTS"
    )]
    let count = count as u32;
    (0..count).map(move |i| first + f64::from(i) * spacing)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn spreads_evenly_within_the_stretch(from in 0.0..50.0_f64, length in 0.001..80.0_f64, left: bool, right: bool, step in 0.5..20.0_f64) {
            let to = from + length;
            let tips: Vec<_> = spread(from, to, [left, right], step).collect();
            prop_assert!(!tips.is_empty());
            prop_assert!(tips.windows(2).all(|pair| pair[1] - pair[0] <= step * (1.0 + 1e-9) && pair[1] > pair[0]));
            prop_assert!(tips.iter().all(|x| (from - 1e-9..=to + 1e-9).contains(x)));
            if tips.len() > 1 {
                let ends = [tips[0] - from, to - tips[tips.len() - 1]];
                for (gap, on_part) in ends.into_iter().zip([left, right]) {
                    let allowed = if on_part { 1e-6 } else { step / 2.0 * (1.0 + 1e-9) };
                    prop_assert!(gap <= allowed);
                }
            }
        }
    }
}
