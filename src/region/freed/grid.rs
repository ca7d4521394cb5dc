//! Squares of a grid, each with a few marks.

use crate::boxes::Extent;
use crate::place::Place;
use core::ops::BitOrAssign;

/// Most squares.
const MOST: usize = 16_000_000;

/// Marks of a square.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Flags(u8);

impl Flags {
    pub(super) const GROUND: Self = Self(1);
    /// A wall goes through it.
    pub(super) const WALL: Self = Self(2);
    pub(super) const BESIDE_WALL: Self = Self(4);
    pub(super) const SLIT: Self = Self(8);
    pub(super) const UNDERCUT: Self = Self(16);
    pub(super) const STANDS: Self = Self(32);
    /// It stood before it was looked at again.
    pub(super) const STOOD: Self = Self(64);

    pub(super) const fn has(self, other: Self) -> bool {
        self.0 & other.0 != 0
    }

    const fn without(self, other: Self) -> Self {
        Self(self.0 & !other.0)
    }
}

impl BitOrAssign for Flags {
    fn bitor_assign(&mut self, other: Self) {
        self.0 |= other.0;
    }
}

#[derive(Clone, Debug)]
pub(super) struct Grid {
    low: Place,
    side: f64,
    columns: usize,
    rows: usize,
    squares: Vec<Flags>,
}

impl Grid {
    /// Squares over a box; none where they are too many.
    pub(super) fn over(extent: Extent, side: f64) -> Option<Self> {
        let size = extent.high.minus(extent.low);
        // The casts saturate; what is too large is refused.
        let [columns, rows] = [size.x, size.y].map(|long| libm::ceil(long / side).max(1.0) as usize);
        let count = columns.checked_mul(rows).filter(|count| *count <= MOST)?;
        Some(Self {
            low: extent.low,
            side,
            columns,
            rows,
            squares: vec![Flags::default(); count],
        })
    }

    pub(super) const fn side(&self) -> f64 {
        self.side
    }

    fn middle(&self, square: usize) -> Place {
        let (column, row) = (square % self.columns, square / self.columns);
        let at = |number: usize| (number as f64 + 0.5) * self.side;
        self.low.plus(Place::new(at(column), at(row)))
    }

    /// Shows all squares with their middles.
    pub(super) fn all(&mut self, mut see: impl FnMut(&mut Flags, Place)) {
        for square in 0..self.squares.len() {
            let at = self.middle(square);
            if let Some(flags) = self.squares.get_mut(square) {
                see(flags, at);
            }
        }
    }

    /// Shows the squares whose middles lie in a box that is so much larger.
    pub(super) fn around(&mut self, extent: Extent, reach: f64, mut see: impl FnMut(&mut Flags, Place)) {
        let extent = extent.grown(reach);
        let range = |low: f64, high: f64, origin: f64, count: usize| {
            // The casts saturate at both ends of the grid.
            let number = |at: f64| libm::floor((at - origin) / self.side) as usize;
            number(low)..number(high).saturating_add(1).min(count)
        };
        let columns = range(extent.low.x, extent.high.x, self.low.x, self.columns);
        let rows = range(extent.low.y, extent.high.y, self.low.y, self.rows);
        for row in rows {
            for column in columns.clone() {
                let square = row * self.columns + column;
                let at = self.middle(square);
                if let Some(flags) = self.squares.get_mut(square) {
                    see(flags, at);
                }
            }
        }
    }

    /// Takes a mark from all squares, other than those that are chosen, and returns these; squares that had it were marked.
    pub(super) fn keep(&mut self, mark: Flags, is_chosen: impl Fn(Flags) -> bool) -> Vec<usize> {
        let mut kept = Vec::new();
        for (square, flags) in self.squares.iter_mut().enumerate() {
            let is_kept = is_chosen(*flags);
            let had = flags.has(mark);
            *flags = flags.without(Flags::STOOD);
            if had {
                *flags |= Flags::STOOD;
            }
            if is_kept {
                kept.push(square);
            } else {
                *flags = flags.without(mark);
            }
        }
        kept
    }

    /// Marks what hangs together with some squares by sides.
    pub(super) fn flood(&mut self, seeds: Vec<usize>, mark: Flags, is_open: impl Fn(Flags) -> bool) {
        let mut open = seeds;
        while let Some(square) = open.pop() {
            for next in self.beside(square).into_iter().flatten() {
                if let Some(flags) = self.squares.get_mut(next)
                    && !flags.has(mark)
                    && is_open(*flags)
                {
                    *flags |= mark;
                    open.push(next);
                }
            }
        }
    }

    /// The squares that share a side with one.
    fn beside(&self, square: usize) -> [Option<usize>; 4] {
        let (column, row) = (square % self.columns, square / self.columns);
        [
            (column > 0).then(|| square - 1),
            (column + 1 < self.columns).then_some(square + 1),
            (row > 0).then(|| square - self.columns),
            (row + 1 < self.rows).then_some(square + self.columns),
        ]
    }

    /// Squares that are chosen and hang together: how many, and the middle of one of them.
    pub(super) fn pieces(&self, is_chosen: impl Fn(Flags) -> bool) -> Vec<(usize, Place)> {
        let mut is_left: Vec<bool> = self.squares.iter().map(|flags| is_chosen(*flags)).collect();
        let mut pieces = Vec::new();
        for first in 0..is_left.len() {
            let mut open = Vec::new();
            let mut take = |square: usize, open: &mut Vec<usize>| {
                if let Some(left) = is_left.get_mut(square)
                    && *left
                {
                    *left = false;
                    open.push(square);
                }
            };
            take(first, &mut open);
            let mut count = 0;
            while let Some(square) = open.pop() {
                count += 1;
                for next in self.beside(square).into_iter().flatten() {
                    take(next, &mut open);
                }
            }
            if count > 0 {
                pieces.push((count, self.middle(first)));
            }
        }
        pieces
    }
}
