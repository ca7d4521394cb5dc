//! Maps over the plan: the highest place of every cell, of a surface or of what straight cuts leave over it.
//!
//! The cells of a map are other ones than the bins of a surface. What no other triangle covers of one, and of that what lies
//! in a cell and under one segment of the machined profile, has a linear height: the highest place is at a corner. So nothing
//! between samples is missed.
//!
//! Steps often lie on borders of cells, since both are at round numbers. What reaches into a cell by no more than [`TOUCH`]
//! only touches it, and does not colour it.

mod across;
mod bands;

pub use across::Standing;
pub use bands::Band;

use crate::coverage::Tangled;
use crate::region::{Half, Region, sides, width, within};
use crate::residual::{Machined, Over, volume};
use crate::surface::{Cell, Surface, clipped};
use crate::visible::Part;
use vcutc_backend_api::units::Length;

/// What reaches into a cell by this, in mm, only touches it: more than the rounding of a place, and little enough that on a
/// slope of 10 no more than 1e-9 mm of height is missed.
const TOUCH: f64 = 1e-10;

/// Pieces that are looked at before a surface counts as too tangled.
const MOST_PIECES: usize = 100_000_000;

/// How many cells a map has. All are of one size.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cells {
    /// Along x, at least 1.
    pub columns: u32,
    /// Along y, at least 1.
    pub rows: u32,
}

/// Heights over the plan, or other values.
#[derive(Clone, Debug, PartialEq)]
pub struct Map<V = Length> {
    /// The highest place of each cell, row by row from the least y, each from the least x; none of a cell that nothing lies over.
    pub cells: Vec<Option<V>>,
    /// The highest place of all.
    pub highest: Over<V>,
    /// The lowest one.
    pub lowest: Over<V>,
    /// The mean over all that has a value: for heights, over the plan.
    pub mean: V,
}

/// What a map is of.
#[derive(Clone, Copy, Debug)]
enum Of<'a> {
    /// The upper side.
    Surface,
    /// What a machined profile leaves over it.
    Left(&'a Machined),
}

/// The corners of a convex piece in plan, with a linear height over them.
type Piece = Vec<([f64; 2], f64)>;

impl Surface {
    /// Its height. None when it has no area in plan.
    ///
    /// # Errors
    /// If triangles lie over each other in such numbers that this takes too long.
    pub fn heights(&self, cells: Cells) -> Result<Option<Map>, Tangled> {
        self.mapped(Of::Surface, cells)
    }

    /// How high a machined profile, the same at every y, stands above it. As in [`Surface::residual`], what is seen through
    /// cracks does not count. None when it has no area in plan.
    ///
    /// # Errors
    /// If triangles lie over each other in such numbers that this takes too long.
    pub fn left_over(&self, machined: &Machined, cells: Cells) -> Result<Option<Map>, Tangled> {
        self.mapped(Of::Left(machined), cells)
    }

    fn mapped(&self, of: Of<'_>, cells: Cells) -> Result<Option<Map>, Tangled> {
        let grid = Grid::new(cells, self.size());
        let mut tally = Tally::new(&grid);
        let (mut looks, mut parts) = (0, Vec::new());
        let weld = self.accuracy().weld.to_mm();
        for bin in self.bins().all() {
            self.visible(bin, &mut looks, &mut parts)?;
            for part in &parts {
                let is_crack = part.is_cut && width(&part.region) <= weld;
                grid.split(&part.region, |place, region| {
                    tally.pieces += 1;
                    match (of, is_crack) {
                        (Of::Surface, false) => tally.add(place, &lifted(region, part)),
                        (Of::Surface, true) => tally.raise_all(place, &lifted(region, part)),
                        (Of::Left(machined), false) => {
                            for piece in left(machined, region, part) {
                                tally.pieces += 1;
                                tally.add(place, &piece);
                            }
                        }
                        (Of::Left(_), true) => {}
                    }
                });
                tally.is_bearable(part.region.first())?;
            }
            if let Of::Surface = of {
                self.raise_upright(bin, &grid, &mut tally)?;
            }
        }
        Ok(tally.map(Length::mm))
    }

    /// Triangles that stand upright have no area in plan, but their edges count for what is highest.
    fn raise_upright(&self, bin: Cell, grid: &Grid, tally: &mut Tally) -> Result<(), Tangled> {
        for &number in self.bins().triangles(bin) {
            let face = self.triangle(number);
            if sides(face).is_some() {
                continue;
            }
            let places = face.map(|corner| [corner.x, corner.y]);
            for place in grid.touched(&places) {
                tally.pieces += 1;
                let [low, high] = grid.bounds(place);
                for corner in clipped(&face, low, high) {
                    tally.raise(place, [corner.x, corner.y], corner.z);
                }
            }
            tally.is_bearable(places.first())?;
        }
        Ok(())
    }
}

/// What of a part lies over a region.
fn lifted(region: &[[f64; 2]], part: &Part) -> Piece {
    region
        .iter()
        .map(|&place| (place, part.plane.at(place)))
        .collect()
}

/// What a machined profile leaves over a region of a part, segment by segment.
fn left(machined: &Machined, region: &[[f64; 2]], part: &Part) -> Vec<Piece> {
    if let Some(ruled) = machined.vees() {
        return ruled.above(region, part.plane);
    }
    let [from, to] = range(region, 0);
    let segments = machined.between(from, to);
    let inside = segments.filter(move |[a, b]| a.x < to - TOUCH && b.x > from + TOUCH);
    inside
        .flat_map(|segment| machined.above(segment, region, part.plane))
        .collect()
}

/// The least and the greatest coordinate of places along an axis.
fn range(places: &[[f64; 2]], axis: usize) -> [f64; 2] {
    places
        .iter()
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[from, to], place| {
            [from.min(place[axis]), to.max(place[axis])]
        })
}

/// The cells of a map over the plan.
#[derive(Debug)]
struct Grid {
    counts: [usize; 2],
    size: [f64; 2],
}

impl Grid {
    fn new(cells: Cells, size: [f64; 2]) -> Self {
        Self {
            counts: [cells.columns, cells.rows].map(|count| count.max(1) as usize),
            size,
        }
    }

    const fn count(&self) -> usize {
        self.counts[0] * self.counts[1]
    }

    /// Where a border along an axis is.
    fn border(&self, axis: usize, number: usize) -> f64 {
        self.size[axis] * number as f64 / self.counts[axis] as f64
    }

    /// The corners of a cell with the least and the greatest coordinates.
    fn bounds(&self, place: [usize; 2]) -> [[f64; 2]; 2] {
        [0, 1].map(|more| [0, 1].map(|axis| self.border(axis, place[axis] + more)))
    }

    /// The cells that the box around places touches, by column and row.
    fn touched(&self, places: &[[f64; 2]]) -> impl Iterator<Item = [usize; 2]> + use<> {
        let [columns, rows] = [0, 1].map(|axis| {
            // Casting is to the nearest number there is.
            range(places, axis).map(|value| {
                let share = value / self.size[axis] * self.counts[axis] as f64;
                (share as usize).min(self.counts[axis] - 1)
            })
        });
        (rows[0]..=rows[1]).flat_map(move |row| (columns[0]..=columns[1]).map(move |column| [column, row]))
    }

    /// Takes what of a region lies in each cell.
    fn split(&self, region: &Region, mut take: impl FnMut([usize; 2], &[[f64; 2]])) {
        let mut touched = self.touched(region);
        if let (Some(only), None) = (touched.next(), touched.next()) {
            return take(only, region);
        }
        for place in self.touched(region) {
            let [low, high] = self.bounds(place);
            let halves = [
                Half::new([-1.0, 0.0], -low[0]),
                Half::new([1.0, 0.0], high[0]),
                Half::new([0.0, -1.0], -low[1]),
                Half::new([0.0, 1.0], high[1]),
            ];
            let [first, rest @ ..] = halves;
            let inside = rest
                .iter()
                .fold(within(region, first), |region, &half| within(&region, half));
            if width(&inside) > TOUCH {
                take(place, &inside);
            }
        }
    }
}

/// What is known of the cells so far.
struct Tally {
    columns: usize,
    cells: Vec<Option<f64>>,
    highest: Option<(f64, [f64; 2])>,
    lowest: Option<(f64, [f64; 2])>,
    volume: f64,
    area: f64,
    /// Pieces that were looked at.
    pieces: usize,
}

impl Tally {
    fn new(grid: &Grid) -> Self {
        Self {
            columns: grid.counts[0],
            cells: vec![None; grid.count()],
            highest: None,
            lowest: None,
            volume: 0.0,
            area: 0.0,
            pieces: 0,
        }
    }

    fn raise(&mut self, [column, row]: [usize; 2], place: [f64; 2], height: f64) {
        if self.highest.is_none_or(|(most, _)| height > most) {
            self.highest = Some((height, place));
        }
        if let Some(cell) = self.cells.get_mut(row * self.columns + column)
            && cell.is_none_or(|most| height > most)
        {
            *cell = Some(height);
        }
    }

    /// Counts a place for the highest and for the lowest.
    fn note(&mut self, cell: [usize; 2], place: [f64; 2], height: f64) {
        self.raise(cell, place, height);
        if self.lowest.is_none_or(|(least, _)| height < least) {
            self.lowest = Some((height, place));
        }
    }

    fn raise_all(&mut self, cell: [usize; 2], piece: &Piece) {
        for &(place, height) in piece {
            self.raise(cell, place, height);
        }
    }

    fn add(&mut self, cell: [usize; 2], piece: &Piece) {
        for &(place, height) in piece {
            self.note(cell, place, height);
        }
        // The area is the volume of a prism that is 1 mm high.
        let level: Piece = piece.iter().map(|&(place, _)| (place, 1.0)).collect();
        self.volume += volume(piece);
        self.area += volume(&level);
    }

    /// Whether it may go on, near a place.
    fn is_bearable(&self, near: Option<&[f64; 2]>) -> Result<(), Tangled> {
        if self.pieces <= MOST_PIECES {
            return Ok(());
        }
        let place = near.copied().unwrap_or_default().map(Length::mm);
        Err(Tangled { place })
    }

    /// The map, with what a number stands for.
    fn map<V>(self, of: fn(f64) -> V) -> Option<Map<V>> {
        let over = |(height, place): (f64, [f64; 2])| Over {
            height: of(height),
            place: place.map(Length::mm),
        };
        (self.area > 0.0).then_some(())?;
        Some(Map {
            highest: over(self.highest?),
            lowest: over(self.lowest?),
            mean: of(self.volume / self.area),
            cells: self.cells.into_iter().map(|cell| cell.map(of)).collect(),
        })
    }
}

#[cfg(test)]
mod tests;
