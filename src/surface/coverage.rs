//! Whether a surface covers the plan, and what is odd about it.
//!
//! A surface need not be watertight: what lies below its upper side does not matter. But each place of the plan must lie under
//! a triangle. Gaps no wider than the surface's `weld` are closed: a place is covered if it lies within half of that of a
//! triangle (upright ones do not count).
//!
//! Seen from above, the number of triangles over a place changes only across edges whose triangles do not lie on both sides in
//! equal number. Bins that no such edge touches are covered everywhere or nowhere. In the others all triangles are taken
//! off the bin one after the other, as convex polygons; what is left is a gap. So the work is that of sorting edges, and
//! little more, for all but tangled surfaces.

use crate::region::{Half, Region, SLACK, area, grown_sides, middle, rectangle, sides, subtract, twice_area};
use crate::surface::{Cell, Surface};
use core::fmt;
use std::collections::BTreeMap;
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::units::{Area, Length};

/// Gaps that are listed.
const MOST_GAPS: usize = 16;

/// Polygons that are looked at before a surface counts as too tangled.
const MOST_LOOKS: usize = 50_000_000;

/// Areas below this share of the plan are rounding.
const ROUNDING: f64 = 1e-9;

/// What lies over the plan.
#[derive(Clone, Debug, PartialEq)]
pub struct Coverage {
    /// Parts of the plan that no triangle lies over, the largest first; the 16 largest.
    pub gaps: Vec<Gap>,
    /// The area of all gaps.
    pub uncovered: Area,
    /// How much area, in plan, faces the same way as the upper side but lies below other triangles. It presumes that
    /// neighbours face the same way ([`Self::turned_edges`] is 0).
    pub undercut: Area,
    /// Edges within the plan that belong to one triangle only.
    pub open_edges: usize,
    /// Edges of three triangles or more.
    pub crowded_edges: usize,
    /// Edges whose two triangles face different ways.
    pub turned_edges: usize,
    /// Triangles that stand upright.
    pub upright: usize,
}

/// A part of the plan that no triangle lies over.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gap {
    /// Its area.
    pub area: Area,
    /// A place in it, along x and y.
    pub place: [Length; 2],
    /// The least x and y that it reaches.
    pub low: [Length; 2],
    /// The greatest x and y.
    pub high: [Length; 2],
}

/// A surface has so many triangles over each other near here that its coverage was not determined.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tangled {
    /// Along x and y.
    pub place: [Length; 2],
}

impl fmt::Display for Tangled {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [x, y] = self.place.map(Length::to_mm);
        write!(
            f,
            "too many triangles lie over each other near x = {x} mm, y = {y} mm"
        )
    }
}

impl core::error::Error for Tangled {}

impl Surface {
    /// Whether each place of the plan lies under a triangle, and what is odd about the triangles.
    ///
    /// # Errors
    /// If triangles lie over each other in such numbers that this takes too long.
    pub fn coverage(&self) -> Result<Coverage, Tangled> {
        let edges = self.edges();
        let mut looks = 0;
        let mut holes: BTreeMap<(usize, usize), Hole> = BTreeMap::new();
        for (cell, is_crossed) in self.bins().all().zip(&edges.crossed) {
            let hole = if *is_crossed {
                self.hole(cell, &mut looks)?
            } else {
                self.hollow(cell)
            };
            if let Some(hole) = hole {
                holes.insert((cell.row, cell.column), hole);
            }
        }
        let uncovered = holes.values().fold(0.0, |sum, hole| sum + hole.area);
        let [width, depth] = self.size();
        let covered = width * depth - uncovered;
        let undercut = edges.facing[0].max(edges.facing[1]) - covered;
        Ok(Coverage {
            gaps: gaps(holes),
            uncovered: Area::mm2(uncovered),
            undercut: Area::mm2(if undercut > ROUNDING * width * depth {
                undercut
            } else {
                0.0
            }),
            open_edges: edges.open,
            crowded_edges: edges.crowded,
            turned_edges: edges.turned,
            upright: edges.upright,
        })
    }

    fn edges(&self) -> Edges {
        let [width, depth] = self.size();
        let corners = self.mesh().corners();
        let at = |index: u64| {
            corners
                .get(index as usize)
                .copied()
                .unwrap_or(Point3::new(0.0, 0.0, 0.0))
        };
        let mut edges = Edges {
            crossed: vec![false; self.bins().columns() * self.bins().rows()],
            ..Edges::default()
        };
        // Two corners in 30 bits each (there are fewer), how the triangle passes them, and which side of them it is on in plan.
        let mut keys: Vec<u64> = Vec::with_capacity(3 * self.mesh().triangles().len());
        for (named, face) in self.mesh().triangles().iter().zip(self.mesh().faces()) {
            let twice = twice_area(face.map(|p| [p.x, p.y]));
            let stands = is_upright(face, twice);
            if stands {
                edges.upright += 1;
            } else {
                edges.facing[usize::from(twice < 0.0)] += twice.abs() / 2.0;
            }
            let [a, b, c] = *named;
            for [from, to] in [[a, b], [b, c], [c, a]] {
                let passes = u64::from(from > to);
                let side = if stands {
                    0
                } else {
                    1 + (passes ^ u64::from(twice < 0.0))
                };
                keys.push(u64::from(from.min(to)) << 33 | u64::from(from.max(to)) << 3 | passes << 2 | side);
            }
        }
        keys.sort_unstable();
        for same in keys.chunk_by(|a, b| a >> 3 == b >> 3) {
            let Some(&key) = same.first() else { continue };
            let [a, b] = [at(key >> 33), at(key >> 3 & 0x3FFF_FFFF)];
            let is_border =
                (a.x == b.x && (a.x == 0.0 || a.x == width)) || (a.y == b.y && (a.y == 0.0 || a.y == depth));
            let passing = same.iter().filter(|key| *key & 4 != 0).count();
            match same.len() {
                1 => edges.open += usize::from(!is_border),
                2 => edges.turned += usize::from(passing != 1),
                _ => edges.crowded += 1,
            }
            let on = |side: u64| same.iter().filter(|key| *key & 3 == side).count();
            if on(1) != on(2) && !is_border {
                let bounds = [a.x.min(b.x), a.y.min(b.y), a.x.max(b.x), a.y.max(b.y)];
                for cell in self.bins().cells(bounds) {
                    if let Some(crossed) = edges
                        .crossed
                        .get_mut(cell.row * self.bins().columns() + cell.column)
                    {
                        *crossed = true;
                    }
                }
            }
        }
        edges
    }

    /// A bin that is covered everywhere or nowhere, if it is not covered.
    fn hollow(&self, cell: Cell) -> Option<Hole> {
        let bin = rectangle(self.bins().bounds(cell));
        let centre = middle(&bin);
        let covers = |half: Half| half.beyond(centre) <= crate::region::SLACK;
        let is_covered =
            self.bins().triangles(cell).iter().any(|&number| {
                sides(self.triangle(number)).is_some_and(|sides| sides.into_iter().all(covers))
            });
        (!is_covered).then(|| Hole::of(&[bin])).flatten()
    }

    /// What no triangle covers of a bin.
    fn hole(&self, cell: Cell, looks: &mut usize) -> Result<Option<Hole>, Tangled> {
        let reach = self.accuracy().weld.to_mm() / 2.0;
        let own = self.bins().triangles(cell);
        if self.left(cell, own, reach, looks)?.is_empty() {
            return Ok(None);
        }
        // Triangles that end just beside the bin reach into it when they are grown.
        let [low, high] = self.bins().bounds(cell);
        let around = [low[0] - reach, low[1] - reach, high[0] + reach, high[1] + reach];
        let cells = self.bins().cells(around);
        let mut near: Vec<u32> = cells
            .flat_map(|cell| self.bins().triangles(cell))
            .copied()
            .collect();
        near.sort_unstable();
        near.dedup();
        if self.left(cell, &near, reach, looks)?.is_empty() {
            return Ok(None);
        }
        // There is a gap wider than the weld: its area is that without anything closed.
        Ok(Hole::of(&self.left(cell, own, 0.0, looks)?))
    }

    /// What is left of a bin without some triangles, each grown by so much.
    fn left(
        &self,
        cell: Cell,
        numbers: &[u32],
        reach: f64,
        looks: &mut usize,
    ) -> Result<Vec<Region>, Tangled> {
        let bin = rectangle(self.bins().bounds(cell));
        let mut order: Vec<(f64, u32)> = numbers
            .iter()
            .map(|&number| {
                (
                    twice_area(self.triangle(number).map(|p| [p.x, p.y])).abs(),
                    number,
                )
            })
            .collect();
        // Large ones first: they leave little to cut the others with.
        order.sort_unstable_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        let mut left = vec![bin];
        for (_, number) in order {
            *looks += left.len();
            if *looks > MOST_LOOKS {
                let place = middle(&rectangle(self.bins().bounds(cell))).map(Length::mm);
                return Err(Tangled { place });
            }
            if let Some(cutter) = grown_sides(self.triangle(number), reach) {
                subtract(&mut left, &cutter);
            }
            if left.is_empty() {
                break;
            }
        }
        Ok(left)
    }
}

/// Whether a triangle of this area in plan, twice, has no width to speak of there, as [`sides`] judges it.
fn is_upright([a, b, c]: [Point3; 3], twice: f64) -> bool {
    let square = |a: Point3, b: Point3| (b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y);
    let longest = square(a, b).max(square(b, c)).max(square(c, a));
    let least = SLACK / 10.0;
    twice * twice <= least * least * longest
}

/// What the edges of a surface say.
#[derive(Debug, Default)]
struct Edges {
    /// For each bin, whether the number of triangles over a place may change within it.
    crossed: Vec<bool>,
    /// The area in plan of triangles that turn one way, and the other way.
    facing: [f64; 2],
    open: usize,
    crowded: usize,
    turned: usize,
    upright: usize,
}

/// What is not covered of a bin.
#[derive(Clone, Copy, Debug)]
struct Hole {
    area: f64,
    /// The area of its largest polygon, and a place in it.
    largest: f64,
    place: [f64; 2],
    low: [f64; 2],
    high: [f64; 2],
}

impl Hole {
    fn of(regions: &[Region]) -> Option<Self> {
        regions
            .iter()
            .filter(|region| region.len() >= 3)
            .map(|region| {
                let end = |start: f64, pick: fn(f64, f64) -> f64| {
                    [0, 1].map(|axis| region.iter().map(|place| place[axis]).fold(start, pick))
                };
                let area = area(region);
                Self {
                    area,
                    largest: area,
                    place: middle(region),
                    low: end(f64::INFINITY, f64::min),
                    high: end(f64::NEG_INFINITY, f64::max),
                }
            })
            .reduce(Self::and)
    }

    fn and(self, other: Self) -> Self {
        let larger = if other.largest > self.largest { other } else { self };
        Self {
            area: self.area + other.area,
            low: [0, 1].map(|axis| self.low[axis].min(other.low[axis])),
            high: [0, 1].map(|axis| self.high[axis].max(other.high[axis])),
            ..larger
        }
    }
}

/// The gaps that holes of bins next to each other form, the largest first.
fn gaps(mut holes: BTreeMap<(usize, usize), Hole>) -> Vec<Gap> {
    let mut found: Vec<Hole> = Vec::new();
    while let Some((start, mut gap)) = holes.pop_first() {
        let mut reached = vec![start];
        while let Some((row, column)) = reached.pop() {
            let beside = [
                (row + 1, column),
                (row, column + 1),
                (row.wrapping_sub(1), column),
                (row, column.wrapping_sub(1)),
            ];
            for next in beside {
                if let Some(hole) = holes.remove(&next) {
                    gap = gap.and(hole);
                    reached.push(next);
                }
            }
        }
        found.push(gap);
    }
    // Stable: of equal ones the first along y comes first.
    found.sort_by(|a, b| b.area.total_cmp(&a.area));
    let listed = found.iter().take(MOST_GAPS);
    listed
        .map(|hole| Gap {
            area: Area::mm2(hole.area),
            place: hole.place.map(Length::mm),
            low: hole.low.map(Length::mm),
            high: hole.high.map(Length::mm),
        })
        .collect()
}

#[cfg(test)]
mod tests;
