//! A cover of a surface by ways along y, one over each x, for cuts that each have a way of their own.
//!
//! On planes x = const, evenly spaced, straight ways have the slope whose strip of lines parallel to it, as wide as the section is high over
//! it, is the narrowest: the straight line that comes nearest to the section (Chebyshev). Curved ways are the section itself, smoothed
//! along y because a blade that follows a sharp bend lies off its tips, with as few knots as keep chords near to it ([`mod@crate::knots`]).
//! Ways are smoothed a little across the planes, and put on the section with what comes out. Between two planes and two knots
//! heights change evenly, so that the cover is bilinear there, and it is raised by what any triangle stands above it. Over an edge of
//! a triangle that is `E(t) = E0 + (E1 - E0) t + dm dy t (1 - t)`, by how slope and place change along the edge; in the inside a
//! bilinear function has no extreme (derived here).

mod steep;

pub use steep::Steep;

use crate::coverage::Tangled;
use crate::knots::{Place, Rule, knots};
use crate::residual::{Machined, Volume};
use crate::spine::{MOST_SMOOTHINGS, OVERHANG, ROWS, smooth};
use crate::surface::{Surface, clipped};
use std::sync::Arc;
use vcutc_backend_api::geometry::Point3;
use vcutc_geometry::columns::{Columns, bends, slab};
use vcutc_geometry::curve::Point2;
use vcutc_geometry::grid;
use vcutc_geometry::profile::Profile;
use vcutc_geometry::spine::Spine;

/// How cuts follow a surface each of which has a way of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Each {
    /// At one slope.
    Straight,
    /// Along a polyline, with knots where all of them have theirs.
    Curved,
}

/// Columns that cover a surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Covered {
    /// The columns.
    pub columns: Arc<Columns>,
    /// How high material stays above the surface at most over the planes that were looked at, in mm, where cuts are infinitely close; with
    /// what a blade that reaches [`OVERHANG`] ahead lies off curved ways.
    pub leaves: f64,
}

/// Planes are about so far apart, in mm.
const APART: f64 = 2.0;

/// How many of them there are at least and at most.
const PLANES: [f64; 2] = [8.0, 400.0];

/// How often the range of slopes is narrowed by a third.
const NARROWINGS: usize = 60;

/// The steepest straight way.
const STEEPEST: f64 = 0.999;

/// Ways are smoothed over so many planes to either side.
const AROUND: usize = 4;

/// Slopes are rounded to that, so that rounding tilts no level line.
const SLOPES: f64 = 1e-6;

/// Corners this near to a plane in mm lie on it.
const ON_PLANE: f64 = 1e-9;

/// How far the chords of curved ways may leave them, in mm.
pub const CHORD: f64 = 0.05;

/// How many slabs columns have at most.
pub const MOST_SLABS: usize = 240;

/// What a blade lies off curved ways is looked at on every so many planes.
const LOOKED_AT: usize = 8;

impl Surface {
    /// The columns that leave the least over it. Of straight ones none where it has a gap over one of the planes, and none where curved
    /// ones are too steep.
    #[must_use]
    pub fn columns(&self, each: Each) -> Option<Covered> {
        let strips = Strips::of(self);
        let shape = match each {
            Each::Straight => Shape::straight(&strips, self)?,
            Each::Curved => Shape::curved(&strips, self)?,
        };
        let above = shape.above(&strips);
        let tolerance = self.accuracy().tolerance.to_mm();
        let cover = |knot: usize| {
            let lines = shape.lines.iter().zip(&above);
            let points = lines.map(|(line, above)| {
                let height = line.start + line.heights.get(knot).copied().unwrap_or_default();
                Point2::new(line.x, (height + above + tolerance).max(0.0))
            });
            Profile::new(points.collect()).ok()
        };
        let covers: Option<Vec<Profile>> = (0..shape.knots.len()).map(cover).collect();
        let ways = shape.lines.iter().map(|line| (line.x, line.heights.clone()));
        let columns = Columns::new(shape.knots.clone(), covers?, ways.collect()).ok()?;
        Some(Covered {
            columns: Arc::new(columns),
            leaves: shape.leaves,
        })
    }

    /// What lies between the cover of columns over it and the surface. Its gaps count as going down to the cover.
    ///
    /// # Errors
    /// If triangles lie over each other in such numbers that this takes too long.
    pub fn below_columns(&self, columns: &Columns) -> Result<Volume, Tangled> {
        let [width, depth] = self.size();
        // Over each x the cover is linear in y between two knots.
        let areas = columns.covers().iter();
        let areas: Vec<f64> = areas.map(|cover| cover.area_below(0.0, width).to_mm2()).collect();
        let slabs = areas.windows(2).zip(columns.knots().windows(2));
        let covered: f64 = slabs
            .map(|(areas, ends)| f64::midpoint(areas[0], areas[1]) * (ends[1] - ends[0]))
            .sum();
        let highest = columns.covers().iter().map(|cover| cover.highest().z);
        let high = highest.fold(f64::NEG_INFINITY, f64::max);
        let level = Machined::new(vec![Point2::new(0.0, high), Point2::new(width, high)]);
        let standing = level
            .ok()
            .map(|level| self.standing(&level))
            .transpose()?
            .flatten();
        let above = standing.map_or(0.0, |standing| standing.volume.to_mm3());
        Ok(Volume::mm3((above - (high * width * depth - covered)).max(0.0)))
    }
}

/// Ways over planes.
struct Shape {
    knots: Vec<f64>,
    lines: Vec<Line>,
    leaves: f64,
}

/// A way on a plane x = const.
struct Line {
    x: f64,
    /// The level that its heights are above, so that it is nowhere below the section.
    start: f64,
    /// At each knot.
    heights: Vec<f64>,
}

/// A straight piece of a way: its height at y = 0, and its slope.
#[derive(Clone, Copy)]
struct Piece {
    x: f64,
    start: f64,
    slope: f64,
}

impl Shape {
    fn straight(strips: &Strips, surface: &Surface) -> Option<Self> {
        let [_, depth] = surface.size();
        let sections: Vec<Vec<[f64; 2]>> = (0..=strips.count).map(|plane| strips.section(plane)).collect();
        let slopes: Option<Vec<f64>> = sections
            .iter()
            .map(|section| Some(nearest_slope(section, Spine::STEEPEST)?.clamp(-STEEPEST, STEEPEST)))
            .collect();
        let slopes = slopes?;
        let mut leaves = 0.0_f64;
        let mut lines = Vec::with_capacity(sections.len());
        for (plane, section) in sections.iter().enumerate() {
            let slope = (smoothed(&slopes, plane) / SLOPES).round() * SLOPES;
            let [least, most] = range(section.iter().map(|[y, z]| z - slope * y));
            leaves = leaves.max(most - least);
            lines.push(Line {
                x: strips.place(plane),
                start: most,
                heights: vec![0.0, slope * depth],
            });
        }
        Some(Self {
            knots: vec![0.0, depth],
            lines,
            leaves,
        })
    }

    /// Curved ways, smoothed along y as far as leaves the least; of those that hardly leave more, the ones with the fewest knots.
    fn curved(strips: &Strips, surface: &Surface) -> Option<Self> {
        let [_, depth] = surface.size();
        let row = |number: usize| depth * number as f64 / (ROWS - 1) as f64;
        let sections: Vec<Vec<f64>> = (0..=strips.count)
            .map(|plane| {
                let heights = (0..ROWS).map(|number| surface.height(strips.place(plane), row(number)));
                // Where there is a gap the bottom of the stock counts.
                heights.map(|height| height.unwrap_or(0.0)).collect()
            })
            .collect();
        let mut curves = turned(&sections);
        for row in &mut curves {
            *row = (0..row.len()).map(|plane| smoothed(row, plane)).collect();
        }
        curves = turned(&curves);
        let rule = Rule {
            turn: |slope| slope,
            off: CHORD,
            most: MOST_SLABS + 1,
        };
        let mut found: Vec<Self> = Vec::new();
        let mut least = f64::INFINITY;
        for smoothing in 0..=MOST_SMOOTHINGS {
            let places = knots(&curves, depth, rule);
            if let Some(shape) = places.and_then(|places| Self::through(&places, strips, &sections, depth)) {
                let is_worse = shape.leaves > least + CHORD;
                least = least.min(shape.leaves);
                let is_straight = shape.knots.len() == 2;
                found.push(shape);
                if is_worse || is_straight {
                    break;
                }
            }
            for _ in 0..1_u32 << smoothing {
                curves.iter_mut().for_each(|curve| smooth(curve));
            }
        }
        found.retain(|shape| shape.leaves <= least + CHORD);
        found.into_iter().min_by_key(|shape| shape.knots.len())
    }

    /// Ways over sections that are given by their heights on [`ROWS`] rows. None where one is too steep or bends too much at a knot, as
    /// one may that turns unevenly.
    fn through(places: &[Place], strips: &Strips, sections: &[Vec<f64>], depth: f64) -> Option<Self> {
        let last = places.len() - 1;
        let knots: Vec<f64> = places
            .iter()
            .enumerate()
            .map(|(number, place)| {
                if number == last {
                    depth
                } else {
                    grid::nearest(place.y)
                }
            })
            .collect();
        let mut leaves = 0.0_f64;
        let mut lines = Vec::with_capacity(sections.len());
        for (plane, section) in sections.iter().enumerate() {
            let heights: Vec<f64> = places
                .iter()
                .filter_map(|place| place.heights.get(plane).copied())
                .collect();
            let mut line = Line {
                x: strips.place(plane),
                start: 0.0,
                heights,
            };
            let rows = section.iter().enumerate().map(|(row, height)| {
                let y = depth * row as f64 / (ROWS - 1) as f64;
                let piece = line.piece(&knots, slab(&knots, y));
                height - piece.start - piece.slope * y
            });
            let [low, high] = range(rows);
            leaves = leaves.max(high - low);
            line.start = high;
            lines.push(line);
        }
        if lines.iter().any(|line| bends(&knots, &line.heights)) {
            return None;
        }
        let width = strips.width;
        let level = Profile::new(vec![Point2::new(0.0, 0.0), Point2::new(width, 0.0)]).ok()?;
        let looked_at = lines.iter().enumerate();
        let looked_at = looked_at.filter(|(plane, _)| plane % LOOKED_AT == 0 || plane + 1 == lines.len());
        let ways = looked_at.map(|(_, line)| (line.x, line.heights.clone()));
        let columns = Columns::new(knots.clone(), vec![level; knots.len()], ways.collect()).ok()?;
        Some(Self {
            leaves: leaves + columns.deviation(OVERHANG).both(),
            knots,
            lines,
        })
    }

    /// By how much to raise the ways so that they cover the surface between planes and knots too.
    fn above(&self, strips: &Strips) -> Vec<f64> {
        let mut above = vec![0.0_f64; self.lines.len()];
        for (number, (polygons, pair)) in strips.strips.iter().zip(self.lines.windows(2)).enumerate() {
            let most = polygons.iter().map(|polygon| self.polygon_above(pair, polygon));
            let most = most.fold(0.0, f64::max);
            for line in [number, number + 1] {
                if let Some(above) = above.get_mut(line) {
                    *above = above.max(most);
                }
            }
        }
        above
    }

    /// How high a polygon between two planes stands above their ways.
    fn polygon_above(&self, lines: &[Line], polygon: &[Point3]) -> f64 {
        let ys = || polygon.iter().map(|corner| corner.y);
        let [low, high] = range(ys());
        let mut most = 0.0_f64;
        for slab in slab(&self.knots, low)..=slab(&self.knots, high) {
            let (Some(&[from, to]), [left, right]) = (self.knots.get(slab..=slab + 1), lines) else {
                continue;
            };
            let within = if from <= low && high <= to {
                polygon.to_vec()
            } else {
                let xs = range(polygon.iter().map(|corner| corner.x));
                clipped(polygon, [xs[0], from], [xs[1], to])
            };
            let pieces = [left, right].map(|line| line.piece(&self.knots, slab));
            let next = within.iter().cycle().skip(1);
            let edges = within.iter().zip(next);
            let each = edges.map(|(&from, &to)| highest_above(pieces, from, to));
            most = each.fold(most, f64::max);
        }
        most
    }
}

impl Line {
    /// What it is in a slab.
    fn piece(&self, knots: &[f64], slab: usize) -> Piece {
        let ends = knots.get(slab..=slab + 1).zip(self.heights.get(slab..=slab + 1));
        let (start, slope) = match ends {
            Some((&[front, back], &[low, high])) => {
                let slope = (high - low) / (back - front);
                (low - slope * front, slope)
            }
            Some(_) | None => (0.0, 0.0),
        };
        Piece {
            x: self.x,
            start: self.start + start,
            slope,
        }
    }
}

/// Triangles cut at planes x = const, evenly spaced, strip by strip.
struct Strips {
    strips: Vec<Vec<Vec<Point3>>>,
    count: usize,
    width: f64,
}

impl Strips {
    fn of(surface: &Surface) -> Self {
        let [width, depth] = surface.size();
        let [least, most] = PLANES;
        // Of a number from 8 to 400.
        let count = (width / APART).ceil().clamp(least, most) as usize;
        let mut strips = Self {
            strips: vec![Vec::new(); count],
            count,
            width,
        };
        for &named in surface.mesh().triangles() {
            let face = surface.mesh().face(named);
            let [low, high] = range(face.iter().map(|corner| corner.x));
            let strip = |x: f64| ((x / width * count as f64) as usize).min(count - 1);
            // Rounding may put a corner on a plane into the strip beside it.
            for number in strip(low).saturating_sub(1)..=(strip(high) + 1).min(count - 1) {
                let [from, to] = [number, number + 1].map(|plane| strips.place(plane));
                let polygon = clipped(&face, [from, 0.0], [to, depth]);
                if let Some(pieces) = strips.strips.get_mut(number)
                    && polygon.len() >= 2
                {
                    pieces.push(polygon);
                }
            }
        }
        strips
    }

    /// Where a plane lies.
    fn place(&self, plane: usize) -> f64 {
        self.width * plane as f64 / self.count as f64
    }

    /// Corners of the surface on a plane: y and height.
    fn section(&self, plane: usize) -> Vec<[f64; 2]> {
        let x = self.place(plane);
        let beside = [plane.checked_sub(1), Some(plane)].into_iter().flatten();
        let pieces = beside
            .filter_map(|strip| self.strips.get(strip))
            .flatten()
            .flatten();
        let on_it = pieces.filter(|corner| (corner.x - x).abs() <= ON_PLANE);
        on_it.map(|corner| [corner.y, corner.z]).collect()
    }
}

/// How high an edge stands above the cover between two ways at most.
fn highest_above([left, right]: [Piece; 2], from: Point3, to: Point3) -> f64 {
    let share = |x: f64| (x - left.x) / (right.x - left.x);
    let slope = |x: f64| left.slope + (right.slope - left.slope) * share(x);
    let above = |corner: Point3| {
        let start = left.start + (right.start - left.start) * share(corner.x);
        corner.z - start - slope(corner.x) * corner.y
    };
    let ends = [above(from), above(to)];
    let bow = (slope(to.x) - slope(from.x)) * (to.y - from.y);
    let turns = 0.5 + (ends[1] - ends[0]) / (2.0 * bow);
    let between = if bow > 0.0 && turns > 0.0 && turns < 1.0 {
        ends[0] + (ends[1] - ends[0]) * turns + bow * turns * (1.0 - turns)
    } else {
        f64::NEG_INFINITY
    };
    ends[0].max(ends[1]).max(between)
}

/// Columns of numbers as rows.
fn turned(columns: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let count = columns.first().map_or(0, Vec::len);
    let row = |number: usize| {
        columns
            .iter()
            .filter_map(|column| column.get(number).copied())
            .collect()
    };
    (0..count).map(row).collect()
}

/// The least and the greatest of some numbers.
fn range(values: impl Iterator<Item = f64>) -> [f64; 2] {
    values.fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], value| {
        [least.min(value), most.max(value)]
    })
}

/// A value drawn to the mean of those around it, as many on either side: what changes evenly stays. Tips side by side that rise
/// differently need more edge, so that ways of their own for narrow places of a part do not pay.
fn smoothed(values: &[f64], place: usize) -> f64 {
    let around = AROUND.min(place).min(values.len() - 1 - place);
    let near = values.get(place - around..=place + around).unwrap_or_default();
    near.iter().sum::<f64>() / near.len() as f64
}

/// The slope of the straight line nearest to a section, of all up to a bound: how wide its strip is, is convex in the slope.
fn nearest_slope(section: &[[f64; 2]], bound: f64) -> Option<f64> {
    section.first()?;
    let wide = |slope: f64| {
        let [least, most] = range(section.iter().map(|[y, z]| z - slope * y));
        most - least
    };
    let (mut low, mut high) = (-bound, bound);
    for _ in 0..NARROWINGS {
        let third = (high - low) / 3.0;
        if wide(low + third) <= wide(high - third) {
            high -= third;
        } else {
            low += third;
        }
    }
    Some(f64::midpoint(low, high))
}

#[cfg(test)]
mod tests;
