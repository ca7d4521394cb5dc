//! A grid of bins over the plan: which triangles may lie over a place.

use crate::mesh::Mesh;

/// Triangles that a bin is meant to hold.
const CROWD: usize = 2;

/// Entries of triangles in bins, for each triangle, at most. Long triangles would fill all bins of a fine grid.
const MOST_ENTRIES: usize = 8;

/// Bins by columns (along x) and rows (along y), each with the triangles whose box touches it.
#[derive(Clone, Debug)]
pub(crate) struct Bins {
    columns: usize,
    rows: usize,
    /// The size of a bin, in mm.
    size: [f64; 2],
    /// Where the entries of a bin start; one more at the end.
    starts: Vec<u32>,
    entries: Vec<u32>,
    /// The least and the greatest height of the triangles of each bin, wherever they reach it.
    heights: Vec<[f64; 2]>,
}

/// A bin by its column and row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Cell {
    pub(crate) column: usize,
    pub(crate) row: usize,
}

impl Bins {
    pub(super) fn new(mesh: &Mesh, width: f64, depth: f64) -> Self {
        let boxes: Vec<[f64; 4]> = mesh
            .faces()
            .map(|face| {
                face.iter().fold(
                    [f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY],
                    |[a, b, c, d], p| [a.min(p.x), b.min(p.y), c.max(p.x), d.max(p.y)],
                )
            })
            .collect();
        let wanted = (boxes.len() / CROWD).max(1) as f64;
        let mut across = ((wanted * width / depth).sqrt().ceil() as usize).clamp(1, boxes.len().max(1));
        let mut along = ((wanted * depth / width).sqrt().ceil() as usize).clamp(1, boxes.len().max(1));
        let mut bins = Self::empty(across, along, width, depth);
        let most = MOST_ENTRIES * boxes.len();
        while across * along > 1 && !bins.takes(&boxes, most) {
            across = across.div_ceil(2);
            along = along.div_ceil(2);
            bins = Self::empty(across, along, width, depth);
        }
        bins.fill(&boxes);
        bins.heights = bins.all().map(|cell| bins.reach(cell, mesh)).collect();
        bins
    }

    fn empty(columns: usize, rows: usize, width: f64, depth: f64) -> Self {
        Self {
            columns,
            rows,
            size: [width / columns as f64, depth / rows as f64],
            starts: Vec::new(),
            entries: Vec::new(),
            heights: Vec::new(),
        }
    }

    fn takes(&self, boxes: &[[f64; 4]], most: usize) -> bool {
        let mut entries = 0_usize;
        boxes.iter().all(|bounds| {
            let [a, b] = self.touched(*bounds);
            entries = entries.saturating_add((b.column - a.column + 1) * (b.row - a.row + 1));
            entries <= most
        })
    }

    fn fill(&mut self, boxes: &[[f64; 4]]) {
        let mut starts = vec![0_u32; self.columns * self.rows + 1];
        for bounds in boxes {
            for cell in self.cells(*bounds) {
                starts[self.place(cell) + 1] += 1;
            }
        }
        for i in 1..starts.len() {
            starts[i] += starts[i - 1];
        }
        let mut next = starts.clone();
        let mut entries = vec![0_u32; starts.last().copied().unwrap_or(0) as usize];
        for (number, bounds) in (0..).zip(boxes) {
            for cell in self.cells(*bounds) {
                let slot = &mut next[self.place(cell)];
                entries[*slot as usize] = number;
                *slot += 1;
            }
        }
        self.starts = starts;
        self.entries = entries;
    }

    const fn place(&self, cell: Cell) -> usize {
        cell.row * self.columns + cell.column
    }

    /// The first and the last bin of those that a box (least x and y, greatest x and y) touches.
    pub(crate) fn touched(&self, [a, b, c, d]: [f64; 4]) -> [Cell; 2] {
        [self.at(a, b), self.at(c, d)]
    }

    /// The bins that a box (least x and y, greatest x and y) touches.
    pub(crate) fn cells(&self, bounds: [f64; 4]) -> impl Iterator<Item = Cell> + use<> {
        let [a, b] = self.touched(bounds);
        (a.row..=b.row).flat_map(move |row| (a.column..=b.column).map(move |column| Cell { column, row }))
    }

    /// The bin of a place, the nearest one beyond the plan. On a line between bins it is the one with greater
    /// coordinates, in which everything that touches the line is too.
    pub(crate) fn at(&self, x: f64, y: f64) -> Cell {
        // Casting is to the nearest number there is.
        Cell {
            column: ((x / self.size[0]) as usize).min(self.columns - 1),
            row: ((y / self.size[1]) as usize).min(self.rows - 1),
        }
    }

    pub(crate) const fn columns(&self) -> usize {
        self.columns
    }

    pub(crate) const fn rows(&self) -> usize {
        self.rows
    }

    /// The least and the greatest height that the triangles of a bin reach.
    fn reach(&self, cell: Cell, mesh: &Mesh) -> [f64; 2] {
        let numbers = self.triangles(cell).iter();
        let faces = numbers.filter_map(|&number| Some(mesh.face(*mesh.triangles().get(number as usize)?)));
        faces
            .flatten()
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], p| {
                [low.min(p.z), high.max(p.z)]
            })
    }

    /// The least and the greatest height that the triangles of a bin reach; the wrong way round without any.
    pub(crate) fn heights(&self, cell: Cell) -> [f64; 2] {
        let none = [f64::INFINITY, f64::NEG_INFINITY];
        self.heights.get(self.place(cell)).copied().unwrap_or(none)
    }

    /// All bins, row by row.
    pub(crate) fn all(&self) -> impl Iterator<Item = Cell> + use<> {
        let columns = self.columns;
        (0..self.rows).flat_map(move |row| (0..columns).map(move |column| Cell { column, row }))
    }

    /// The corners of a bin with the least and the greatest coordinates.
    pub(crate) fn bounds(&self, cell: Cell) -> [[f64; 2]; 2] {
        let corner = |column: usize, row: usize| [column as f64 * self.size[0], row as f64 * self.size[1]];
        [
            corner(cell.column, cell.row),
            corner(cell.column + 1, cell.row + 1),
        ]
    }

    /// The triangles whose box touches a bin, in their order.
    pub(crate) fn triangles(&self, cell: Cell) -> &[u32] {
        let place = self.place(cell);
        match (self.starts.get(place), self.starts.get(place + 1)) {
            (Some(&start), Some(&end)) => self.entries.get(start as usize..end as usize).unwrap_or_default(),
            _ => &[],
        }
    }
}
