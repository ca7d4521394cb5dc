//! Planes above the triangles of each bin, so that bins that cannot matter are seen from far.
//!
//! The plane of a bin rises like its triangles do on average. No part of a triangle within the bin is above it; what
//! triangles do beyond the bin does not count.

use crate::mesh::difference;
use crate::surface::{Cell, Surface};
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::vector::{cross, dot};

/// What is added to each plane for the rounding of heights, in mm.
const ROUNDING: f64 = 1e-9;

/// A plane above a bin.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ceiling {
    /// Its height over the middle of the bin; none over a bin without triangles.
    height: Option<f64>,
    slope: [f64; 2],
}

/// A bin with the plane above it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Roofed {
    pub(crate) middle: [f64; 2],
    /// Half its size.
    pub(crate) half: [f64; 2],
    /// The height of the plane over the middle.
    pub(crate) height: f64,
    pub(crate) slope: [f64; 2],
}

impl Roofed {
    /// The greatest height of the plane over the bin.
    pub(super) const fn top(&self) -> f64 {
        self.height + self.half[0] * self.slope[0].abs() + self.half[1] * self.slope[1].abs()
    }
}

/// The planes above all bins of a surface, row by row.
#[derive(Clone, Debug)]
pub(super) struct Ceilings {
    columns: usize,
    all: Vec<Ceiling>,
    size: [f64; 2],
}

impl Ceilings {
    pub(super) fn new(surface: &Surface) -> Self {
        let bins = surface.bins();
        let [low, high] = bins.bounds(Cell { column: 0, row: 0 });
        Self {
            columns: bins.columns(),
            all: bins.all().map(|cell| above(surface, cell)).collect(),
            size: [high[0] - low[0], high[1] - low[1]],
        }
    }

    /// A bin with the plane above it; none without triangles.
    pub(super) fn over(&self, cell: Cell) -> Option<Roofed> {
        let Ceiling { height, slope } = *self.all.get(cell.row * self.columns + cell.column)?;
        let half = self.size.map(|size| size / 2.0);
        let middle = [
            cell.column as f64 * self.size[0] + half[0],
            cell.row as f64 * self.size[1] + half[1],
        ];
        Some(Roofed {
            middle,
            half,
            height: height?,
            slope,
        })
    }
}

/// What a triangle does within a bin.
struct Piece {
    /// The middle of the box that it lies in there, from the middle of the bin, and half the box's size.
    middle: [f64; 2],
    half: [f64; 2],
    /// Its greatest height.
    top: f64,
    /// The height of its plane over the middle of the bin, and its slope; none if it is too steep or too
    /// narrow to determine.
    plane: Option<(f64, [f64; 2])>,
}

fn piece(face: [Point3; 3], bounds: [[f64; 2]; 2], centre: [f64; 2]) -> Piece {
    let range = |part: fn(Point3) -> f64, axis: usize| {
        let [a, b, c] = face.map(part);
        let from = a.min(b).min(c).clamp(bounds[0][axis], bounds[1][axis]);
        let to = a.max(b).max(c).clamp(bounds[0][axis], bounds[1][axis]);
        [(from + to) / 2.0 - centre[axis], (to - from) / 2.0]
    };
    let [x, y] = [range(|p| p.x, 0), range(|p| p.y, 1)];
    let [a, b, c] = face;
    let (u, v) = (difference(b, a), difference(c, a));
    let normal = cross(u, v);
    let extent = (dot(u, u) * dot(v, v)).sqrt();
    let plane = (normal[2].abs() > 1e-3 * extent).then(|| {
        let slope = [-normal[0] / normal[2], -normal[1] / normal[2]];
        let rounding = 1e-12 * (1.0 + slope[0].abs() + slope[1].abs()) * (extent.sqrt() + 1.0);
        let height = a.z + slope[0] * (centre[0] - a.x) + slope[1] * (centre[1] - a.y);
        (height + rounding, slope)
    });
    Piece {
        middle: [x[0], y[0]],
        half: [x[1], y[1]],
        top: a.z.max(b.z).max(c.z),
        plane,
    }
}

/// The plane above a bin.
fn above(surface: &Surface, cell: Cell) -> Ceiling {
    let bounds = surface.bins().bounds(cell);
    let centre = [0, 1].map(|axis| (bounds[0][axis] + bounds[1][axis]) / 2.0);
    let pieces = || {
        let numbers = surface.bins().triangles(cell).iter();
        numbers.map(|&number| piece(surface.triangle(number), bounds, centre))
    };
    // Triangles that only touch the bin have no weight.
    let mut sum = [0.0; 3];
    for Piece { half, plane, .. } in pieces() {
        if let Some((_, slope)) = plane {
            let weight = half[0] * half[1];
            sum = [
                sum[0] + weight * slope[0],
                sum[1] + weight * slope[1],
                sum[2] + weight,
            ];
        }
    }
    let slope = if sum[2] > 0.0 {
        [sum[0] / sum[2], sum[1] / sum[2]]
    } else {
        [0.0; 2]
    };
    // The greatest height above the slope of something linear within the box of a piece.
    let over = |piece: &Piece, height: f64, rise: [f64; 2]| {
        let part = |axis: usize| {
            let more = rise[axis] - slope[axis];
            piece.middle[axis] * more + piece.half[axis] * more.abs()
        };
        height + part(0) + part(1)
    };
    let height = pieces()
        .map(|piece| {
            let level = over(&piece, piece.top, [0.0; 2]);
            let plane = piece.plane.map(|(height, rise)| over(&piece, height, rise));
            plane.map_or(level, |plane| plane.min(level)) + ROUNDING
        })
        .reduce(f64::max);
    Ceiling { height, slope }
}
