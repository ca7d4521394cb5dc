//! Slopes of the upper side of a surface in each bin, and where it is not continuous.
//!
//! The upper side is continuous but for edges that have no triangle on one of their sides, seen from above: borders, cracks,
//! folds of closed bodies. Of triangles that are steep, upright or slivers the slope says little; they count as places at which
//! the surface jumps, with all that lies on them. What lies below other triangles does not count where that shows:
//! in bins in which a place has two triangles or more over it, or which such an edge meets.

use crate::coverage::Tangled;
use crate::mesh::difference;
use crate::surface::{Cell, Surface};
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::vector::{cross, dot};

/// Triangles steeper than this, as height for length, count as jumps.
const STEEP: f64 = 3.0;

/// A triangle whose area is below this part of that of its sides, seen from above, is a sliver.
const SLIVER: f64 = 1e-4;

/// A range of slopes along x and along y.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Box2 {
    low: [f64; 2],
    high: [f64; 2],
}

impl Box2 {
    pub(super) const LEVEL: Self = Self {
        low: [0.0; 2],
        high: [0.0; 2],
    };

    const fn of(slope: [f64; 2]) -> Self {
        Self {
            low: slope,
            high: slope,
        }
    }

    fn and(self, other: Self) -> Self {
        Self {
            low: [0, 1].map(|axis| self.low[axis].min(other.low[axis])),
            high: [0, 1].map(|axis| self.high[axis].max(other.high[axis])),
        }
    }

    pub(super) fn both(a: Option<Self>, b: Option<Self>) -> Option<Self> {
        match (a, b) {
            (Some(a), Some(b)) => Some(a.and(b)),
            (a, b) => a.or(b),
        }
    }

    /// How far slopes differ.
    pub(super) fn spread(self) -> [f64; 2] {
        [0, 1].map(|axis| self.high[axis] - self.low[axis])
    }

    /// The steepest slope.
    pub(super) fn steepest(self) -> f64 {
        let [x, y] = [0, 1].map(|axis| self.high[axis].abs().max(self.low[axis].abs()));
        (x * x + y * y).sqrt()
    }
}

/// Lists of numbers, one for each bin.
#[derive(Clone, Debug, Default)]
struct Lists {
    starts: Vec<u32>,
    entries: Vec<u32>,
}

impl Lists {
    /// From pairs of a bin's place and a number.
    fn new(mut pairs: Vec<(u32, u32)>, bins: usize) -> Self {
        pairs.sort_unstable();
        pairs.dedup();
        let mut starts = vec![0_u32; bins + 1];
        for &(bin, _) in &pairs {
            if let Some(count) = starts.get_mut(bin as usize + 1) {
                *count += 1;
            }
        }
        for place in 1..starts.len() {
            starts[place] += starts[place - 1];
        }
        Self {
            starts,
            entries: pairs.into_iter().map(|(_, number)| number).collect(),
        }
    }

    fn of(&self, bin: usize) -> &[u32] {
        match (self.starts.get(bin), self.starts.get(bin + 1)) {
            (Some(&from), Some(&to)) => self.entries.get(from as usize..to as usize).unwrap_or_default(),
            _ => &[],
        }
    }
}

/// The slopes of a surface, bin by bin.
#[derive(Clone, Debug)]
pub(super) struct Slopes {
    columns: usize,
    boxes: Vec<Option<Box2>>,
    /// Of all bins.
    all: Box2,
    edges: Vec<[Point3; 2]>,
    borders: Lists,
    steep: Lists,
}

/// How a triangle counts.
enum Kind {
    /// With its slope.
    Plain([f64; 2]),
    Steep,
}

fn kind(face: [Point3; 3]) -> Kind {
    let [a, b, c] = face;
    let (u, v) = (difference(b, a), difference(c, a));
    let normal = cross(u, v);
    let sides = (dot(u, u) * dot(v, v)).sqrt();
    let flat = (normal[0] * normal[0] + normal[1] * normal[1]).sqrt();
    // Comparisons with NaN are false.
    if normal[2].abs() > SLIVER * sides && flat <= STEEP * normal[2].abs() {
        Kind::Plain([-normal[0] / normal[2], -normal[1] / normal[2]])
    } else {
        Kind::Steep
    }
}

impl Slopes {
    pub(super) fn new(surface: &Surface) -> Result<Self, Tangled> {
        let bins = surface.bins();
        let count = bins.columns() * bins.rows();
        let place = |cell: Cell| (cell.row * bins.columns() + cell.column) as u32;
        let edges = borders(surface);
        let mut pairs = Vec::new();
        for (number, edge) in (0..).zip(&edges) {
            pairs.extend(bins.cells(around(edge)).map(|cell| (place(cell), number)));
        }
        let borders = Lists::new(pairs, count);
        let mut pairs = Vec::new();
        for (number, face) in (0..).zip(surface.mesh().faces()) {
            if let Kind::Steep = kind(face) {
                pairs.extend(bins.cells(around(&face)).map(|cell| (place(cell), number)));
            }
        }
        let steep = Lists::new(pairs, count);
        let (mut boxes, mut looks, mut parts) = (Vec::with_capacity(count), 0, Vec::new());
        for cell in bins.all() {
            let at = place(cell) as usize;
            if borders.of(at).is_empty() && steep.of(at).is_empty() && is_single(surface, cell) {
                boxes.push(all_slopes(surface, cell));
                continue;
            }
            surface.visible(cell, &mut looks, &mut parts)?;
            let slopes = parts.iter().map(|part| part.plane.slope());
            let plain = slopes.filter(|[x, y]| x * x + y * y <= STEEP * STEEP);
            boxes.push(plain.map(Box2::of).reduce(Box2::and));
        }
        Ok(Self {
            columns: bins.columns(),
            all: boxes
                .iter()
                .copied()
                .flatten()
                .reduce(Box2::and)
                .unwrap_or(Box2::LEVEL),
            boxes,
            edges,
            borders,
            steep,
        })
    }

    const fn place(&self, cell: Cell) -> usize {
        cell.row * self.columns + cell.column
    }

    /// The slopes in all bins.
    pub(super) const fn all(&self) -> Box2 {
        self.all
    }

    /// Whether the surface may jump in a bin.
    pub(super) fn jumps(&self, cell: Cell) -> bool {
        !(self.borders(cell).is_empty() && self.steep(cell).is_empty())
    }

    /// The slopes in a bin; none without a triangle that is not steep.
    pub(super) fn of(&self, cell: Cell) -> Option<Box2> {
        self.boxes.get(self.place(cell)).copied().flatten()
    }

    /// The edges at which the surface jumps that may meet a bin.
    pub(super) fn borders(&self, cell: Cell) -> &[u32] {
        self.borders.of(self.place(cell))
    }

    /// The ends of such an edge.
    pub(super) fn edge(&self, number: u32) -> [Point3; 2] {
        let nowhere = [Point3::new(0.0, 0.0, 0.0); 2];
        self.edges.get(number as usize).copied().unwrap_or(nowhere)
    }

    /// The steep triangles that may meet a bin.
    pub(super) fn steep(&self, cell: Cell) -> &[u32] {
        self.steep.of(self.place(cell))
    }
}

/// The box in plan around points: least x and y, greatest x and y.
fn around(points: &[Point3]) -> [f64; 4] {
    let none = [f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY];
    points.iter().fold(none, |[a, b, c, d], p| {
        [a.min(p.x), b.min(p.y), c.max(p.x), d.max(p.y)]
    })
}

/// Edges that lack a triangle on one of their sides, seen from above.
fn borders(surface: &Surface) -> Vec<[Point3; 2]> {
    let corners = surface.mesh().corners();
    let at = |index: u32| {
        corners
            .get(index as usize)
            .copied()
            .unwrap_or(Point3::new(0.0, 0.0, 0.0))
    };
    // Both corners, the lesser first (there are fewer than 2^31), and the side of the triangle in the last bit.
    let mut keys: Vec<u64> = Vec::with_capacity(3 * surface.mesh().triangles().len());
    for (named, face) in surface.mesh().triangles().iter().zip(surface.mesh().faces()) {
        let [a, b, c] = face.map(|p| [p.x, p.y]);
        let turns = crate::region::twice_area([a, b, c]);
        let [i, j, k] = *named;
        for [from, to] in [[i, j], [j, k], [k, i]] {
            let side = u64::from((turns > 0.0) == (from < to));
            keys.push(u64::from(from.min(to)) << 33 | u64::from(from.max(to)) << 1 | side);
        }
    }
    keys.sort_unstable();
    let groups = keys.chunk_by(|a, b| a >> 1 == b >> 1);
    groups
        .filter(|same| same.first() == same.last())
        .filter_map(|same| same.first())
        .map(|key| [at((key >> 33) as u32), at((key >> 1) as u32)])
        .collect()
}

/// Whether at most one triangle lies over a place of a bin, off the lines on which edges often lie.
fn is_single(surface: &Surface, cell: Cell) -> bool {
    let [low, high] = surface.bins().bounds(cell);
    let at = |axis: usize, share: f64| low[axis] + (high[axis] - low[axis]) * share;
    let place = [at(0, 0.381_966), at(1, 0.456_789)];
    let covers = |&&number: &&u32| {
        let [a, b, c] = surface.triangle(number).map(|p| [p.x, p.y]);
        let sides = [[a, b], [b, c], [c, a]].map(|[a, b]| crate::region::twice_area([a, b, place]));
        sides.iter().all(|&side| side >= 0.0) || sides.iter().all(|&side| side <= 0.0)
    };
    surface.bins().triangles(cell).iter().filter(covers).count() <= 1
}

/// The slopes of all triangles whose box has an area in common with a bin.
fn all_slopes(surface: &Surface, cell: Cell) -> Option<Box2> {
    let [low, high] = surface.bins().bounds(cell);
    let numbers = surface.bins().triangles(cell).iter();
    let slopes = numbers.filter_map(|&number| {
        let face = surface.triangle(number);
        let [a, b, c, d] = around(&face);
        let is_within = a < high[0] && c > low[0] && b < high[1] && d > low[1];
        match kind(face) {
            Kind::Plain(slope) if is_within => Some(Box2::of(slope)),
            Kind::Plain(_) | Kind::Steep => None,
        }
    });
    slopes.reduce(Box2::and)
}
