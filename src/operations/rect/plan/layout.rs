//! Where the strips of each layer lie, whatever the order in which they come out, by residual strategy
//! (`docs/process.md`, "Tips at the part and residual strategies", of strips instead of tips):
//!
//! - *discard*: a column is cut in every layer that lies wholly above the part there;
//! - *lift*: in the layer in which the part begins, a last strip of the column ends on it;
//! - *shift*: each layer is cut wherever the part lies below it, every such stretch in equal strips, the outermost slits on the
//!   part.

use super::StripOrigin;
use super::blades::{Extent, TOUCH};
use super::ground::{Ground, Stretch};
use super::terrain::Terrain;
use core::cell::OnceCell;

/// A strip that is not in order yet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Piece {
    /// Counted from 1 at the top.
    pub(crate) layer: u32,
    pub(crate) extent: Extent,
    /// How high it stands before its layer is cut.
    pub(crate) top: f64,
    pub(crate) origin: StripOrigin,
}

impl Piece {
    /// Whether it lies above another one, wholly or in part.
    pub(crate) fn is_over(&self, other: &Self) -> bool {
        let overlap = self.extent.right.min(other.extent.right) - self.extent.left.max(other.extent.left);
        self.layer < other.layer && overlap > TOUCH
    }
}

/// The strips of all layers.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Layout {
    /// Heights of the layers, from the top.
    pub(crate) levels: Vec<f64>,
    /// Layer by layer, each from left to right.
    pub(crate) pieces: Vec<Piece>,
}

impl Layout {
    pub(crate) fn discard(ground: &Ground<'_>) -> Self {
        Self::of_columns(ground, |column| column.whole_layers())
    }

    pub(crate) fn lift(ground: &Ground<'_>) -> Self {
        Self::of_columns(ground, |column| column.lifted())
    }

    pub(crate) fn shift(ground: &Ground<'_>) -> Self {
        let levels = ground.levels();
        let mut pieces = Vec::new();
        let mut top = ground.top;
        for (layer, &level) in (1..).zip(&levels) {
            let strips = ground.open_at(level).into_iter();
            pieces.extend(
                strips
                    .flat_map(|stretch| ground.spread(stretch))
                    .map(|strip| Piece {
                        layer,
                        extent: extent(strip, level),
                        top,
                        origin: StripOrigin::Layer,
                    }),
            );
            top = ground.stands(level);
        }
        Self::of(ground, levels, pieces)
    }

    /// Without the strips that have nothing to take, because operations before have taken it.
    fn of(ground: &Ground<'_>, levels: Vec<f64>, mut pieces: Vec<Piece>) -> Self {
        let before = ground.before();
        pieces.retain(|piece| !ground.is_gone(piece.extent, &before));
        Self { levels, pieces }
    }

    /// With the pieces of every column chosen on their own.
    pub(crate) fn of_columns(
        ground: &Ground<'_>,
        mut cut: impl FnMut(&Column<'_, '_>) -> Vec<Piece>,
    ) -> Self {
        let levels = ground.levels();
        let open = OnceCell::new();
        let columns = ground.columns().into_iter();
        let mut pieces: Vec<Piece> = columns
            .flat_map(|over| cut(&Column::new(ground, (&levels, &open), over)))
            .collect();
        pieces.sort_by(|a, b| {
            let place = |piece: &Piece| (piece.layer, piece.extent.left);
            let ((layer, left), (other, beside)) = (place(a), place(b));
            layer.cmp(&other).then(left.total_cmp(&beside))
        });
        Self::of(ground, levels, pieces)
    }

    /// Without the strips of which operations before have left almost nothing, if there are any. What stands
    /// of such a strip comes out with the one below it.
    pub(crate) fn without_scraps(&self, ground: &Ground<'_>) -> Option<Self> {
        let mut standing = ground.before();
        if standing.is_level() {
            return None;
        }
        let mut pieces = Vec::with_capacity(self.pieces.len());
        for &piece in &self.pieces {
            let Extent { left, right, floor } = piece.extent;
            if ground.is_scrap(piece.extent, &standing) {
                continue;
            }
            let stands = standing.highest(left, right);
            pieces.push(Piece {
                top: stands.map_or(piece.top, |height| height.max(piece.top)),
                ..piece
            });
            standing.lower(left, right, ground.stands(floor));
        }
        (pieces.len() < self.pieces.len()).then(|| Self {
            levels: self.levels.clone(),
            pieces,
        })
    }

    /// How many layers have strips; the lower ones may have none.
    pub(crate) fn layers(&self) -> u32 {
        self.pieces.iter().map(|piece| piece.layer).max().unwrap_or(0)
    }

    /// What they leave when all of them are out.
    pub(crate) fn after(&self, ground: &Ground<'_>) -> Terrain {
        let mut terrain = ground.before();
        for Piece { extent, .. } in &self.pieces {
            terrain.lower(extent.left, extent.right, ground.stands(extent.floor));
        }
        terrain
    }

    /// The strip that is the widest, in mm.
    pub(crate) fn widest(&self) -> f64 {
        let widths = self
            .pieces
            .iter()
            .map(|piece| piece.extent.right - piece.extent.left);
        widths.fold(0.0, f64::max)
    }

    /// The layer that is the thickest, or the strip that is thicker than any layer, in mm.
    pub(crate) fn thickest(&self, ground: &Ground<'_>) -> f64 {
        let above = core::iter::once(&ground.top).chain(&self.levels);
        let heights = above.zip(&self.levels).map(|(above, level)| above - level);
        let layer = heights.fold(0.0, f64::max);
        let strips = self.pieces.iter();
        let heights = strips.map(|piece| piece.top - ground.stands(piece.extent.floor));
        heights
            .filter(|&height| height > layer + TOUCH)
            .fold(layer, f64::max)
    }
}

/// A column of strips.
pub(crate) struct Column<'c, 'w> {
    pub(crate) ground: &'c Ground<'w>,
    levels: &'c [f64],
    /// Of each layer where strips may lie, once a column has asked for it: to find it takes a walk along the part.
    open: &'c OnceCell<Vec<Vec<Stretch>>>,
    over: Stretch,
    /// The lowest that a strip over all of it may end.
    floor: f64,
    /// How many layers lie wholly above that.
    whole: usize,
}

impl<'c, 'w> Column<'c, 'w> {
    fn new(
        ground: &'c Ground<'w>,
        (levels, open): (&'c [f64], &'c OnceCell<Vec<Vec<Stretch>>>),
        over: Stretch,
    ) -> Self {
        let floor = ground.floor(over);
        let whole = levels.partition_point(|&level| level >= floor - TOUCH);
        Self {
            ground,
            levels,
            open,
            over,
            floor,
            whole,
        }
    }

    /// How many layers lie wholly above the part.
    pub(crate) const fn whole(&self) -> usize {
        self.whole
    }

    /// What stands after so many whole layers.
    fn standing(&self, layers: usize) -> f64 {
        let above = layers.checked_sub(1).and_then(|last| self.levels.get(last));
        above.map_or(self.ground.top, |&level| self.ground.stands(level))
    }

    /// So many whole layers.
    pub(crate) fn layers(&self, count: usize) -> Vec<Piece> {
        let counted = (1..).zip(self.levels).take(count).enumerate();
        counted
            .map(|(above, (layer, &level))| Piece {
                layer,
                extent: extent(self.over, level),
                top: self.standing(above),
                origin: StripOrigin::Layer,
            })
            .collect()
    }

    pub(crate) fn whole_layers(&self) -> Vec<Piece> {
        self.layers(self.whole)
    }

    /// The whole layers, and a last strip on the part where that is worth it.
    pub(crate) fn lifted(&self) -> Vec<Piece> {
        let mut pieces = self.whole_layers();
        let top = self.standing(self.whole);
        let gain = top - self.ground.stands(self.floor);
        let layer = (1..).zip(self.levels).nth(self.whole);
        if let Some((layer, _)) = layer.filter(|_| self.ground.is_worth(gain)) {
            pieces.push(Piece {
                layer,
                extent: extent(self.over, self.floor),
                top,
                origin: StripOrigin::Lifted,
            });
        }
        pieces
    }

    /// The whole layers, and so many more up to the part.
    pub(crate) fn shifted(&self, more: usize) -> Vec<Piece> {
        let mut pieces = self.whole_layers();
        let open = self.open.get_or_init(|| {
            let levels = self.levels.iter();
            levels.map(|&level| self.ground.open_at(level)).collect()
        });
        let layers = (1..).zip(self.levels).zip(open).enumerate();
        for (above, ((layer, &level), open)) in layers.skip(self.whole).take(more) {
            let within = open.iter().map(|stretch| Stretch {
                left: stretch.left.max(self.over.left),
                right: stretch.right.min(self.over.right),
            });
            let least = TOUCH.max(self.ground.least_width());
            pieces.extend(
                within
                    .filter(|strip| strip.right - strip.left > least)
                    .map(|strip| Piece {
                        layer,
                        extent: extent(strip, level),
                        top: self.standing(above),
                        origin: StripOrigin::Shifted,
                    }),
            );
        }
        pieces
    }

    /// How many layers there are below the whole ones.
    pub(crate) const fn below(&self) -> usize {
        self.levels.len() - self.whole
    }

    /// The most that stays on the part over the column.
    pub(crate) fn left_by(&self, pieces: &[Piece]) -> f64 {
        let mut terrain = self.ground.before_over(self.over);
        for Piece { extent, .. } in pieces {
            terrain.lower(extent.left, extent.right, self.ground.stands(extent.floor));
        }
        self.ground
            .left_by(&terrain.corners(self.over.left, self.over.right))
    }
}

const fn extent(over: Stretch, floor: f64) -> Extent {
    Extent {
        left: over.left,
        right: over.right,
        floor,
    }
}
