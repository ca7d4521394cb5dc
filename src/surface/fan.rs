//! A cover of a surface by straight lines along y, one over each x, for cuts that each have a slope of their own.
//!
//! On planes x = const, evenly spaced, the line is the one whose strip of lines parallel to it, as wide as the section is high over
//! it, is the narrowest: the straight line that comes nearest to the section (Chebyshev). Slopes are smoothed a little, and lines put on
//! the section with what comes out. Between two such planes slopes and
//! heights go on evenly, so that the cover is bilinear there, and it is raised by what any triangle stands above it. Over an edge of
//! a triangle that is `E(t) = E0 + (E1 - E0) t + dm dy t (1 - t)`, by how slope and place change along the edge; in the inside a
//! bilinear function has no extreme (derived here).

use crate::coverage::Tangled;
use crate::residual::{Machined, Volume};
use crate::surface::{Surface, clipped};
use vcutc_backend_api::geometry::Point3;
use vcutc_geometry::curve::Point2;
use vcutc_geometry::fan::Fan;
use vcutc_geometry::profile::Profile;

/// A fan that covers a surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Fanned {
    /// The fan.
    pub fan: Fan,
    /// How high material stays above the surface at most over the planes that were looked at, in mm, where cuts are infinitely close.
    pub leaves: f64,
}

/// Planes are about so far apart, in mm.
const APART: f64 = 2.0;

/// How many of them there are at least and at most.
const PLANES: [f64; 2] = [8.0, 400.0];

/// How often the range of slopes is narrowed by a third.
const NARROWINGS: usize = 60;

/// Slopes are smoothed over so many planes to either side.
const AROUND: usize = 4;

/// Slopes are rounded to that, so that rounding tilts no level line.
const SLOPES: f64 = 1e-6;

/// Corners this near to a plane in mm lie on it.
const ON_PLANE: f64 = 1e-9;

impl Surface {
    /// The cover of straight lines that leaves the least; none where the surface has a gap over one of the planes.
    #[must_use]
    pub fn fan(&self) -> Option<Fanned> {
        let [_, depth] = self.size();
        let strips = Strips::of(self);
        let sections: Vec<Vec<[f64; 2]>> = (0..=strips.count).map(|plane| strips.section(plane)).collect();
        let slopes: Option<Vec<f64>> = sections.iter().map(|section| nearest_slope(section)).collect();
        let mut leaves = 0.0_f64;
        let mut lines = Vec::with_capacity(sections.len());
        for (plane, (section, slope)) in sections.iter().zip(smoothed(&slopes?)).enumerate() {
            let [least, most] = range(section, slope);
            leaves = leaves.max(most - least);
            lines.push(Line {
                x: strips.place(plane),
                start: most,
                slope,
            });
        }
        let above = strips.above(&lines);
        let tolerance = self.accuracy().tolerance.to_mm();
        let end = |y: f64| {
            let heights = lines.iter().zip(&above);
            let points = heights.map(|(line, above)| {
                Point2::new(line.x, (line.start + line.slope * y + above + tolerance).max(0.0))
            });
            Profile::new(points.collect()).ok()
        };
        let slopes = lines.iter().map(|line| Point2::new(line.x, line.slope));
        let fan = Fan::new([end(0.0)?, end(depth)?], slopes.collect(), self.plan().depth).ok()?;
        Some(Fanned { fan, leaves })
    }
}

impl Surface {
    /// What lies between the straight lines of a fan that covers it and the surface. Its gaps count as going down to the lines.
    ///
    /// # Errors
    /// If triangles lie over each other in such numbers that this takes too long.
    pub fn below_fan(&self, fan: &Fan) -> Result<Volume, Tangled> {
        let [front, back] = fan.ends();
        let [width, depth] = self.size();
        // Over each x the lines are linear in y.
        let covered = [front, back].map(|end| end.area_below(0.0, width).to_mm2());
        let covered = f64::midpoint(covered[0], covered[1]) * depth;
        let high = front.highest().z.max(back.highest().z);
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

/// A line of the cover on a plane x = const.
#[derive(Clone, Copy, Debug)]
struct Line {
    x: f64,
    /// Its height at y = 0.
    start: f64,
    slope: f64,
}

/// Triangles cut at the planes, strip by strip.
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
            let xs = face.map(|corner| corner.x);
            let [low, high] = [
                xs.into_iter().fold(f64::INFINITY, f64::min),
                xs.into_iter().fold(f64::NEG_INFINITY, f64::max),
            ];
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

    /// By how much to raise the lines so that they cover the surface between the planes too.
    fn above(&self, lines: &[Line]) -> Vec<f64> {
        let mut above = vec![0.0_f64; lines.len()];
        for (number, (pieces, pair)) in self.strips.iter().zip(lines.windows(2)).enumerate() {
            let edges = pieces.iter().flat_map(|piece| {
                let next = piece.iter().cycle().skip(1);
                piece.iter().zip(next)
            });
            let most = edges.map(|(&from, &to)| highest_above([pair[0], pair[1]], from, to));
            let most = most.fold(0.0, f64::max);
            for line in [number, number + 1] {
                if let Some(above) = above.get_mut(line) {
                    *above = above.max(most);
                }
            }
        }
        above
    }
}

/// How high an edge stands above the cover between two lines at most.
fn highest_above([left, right]: [Line; 2], from: Point3, to: Point3) -> f64 {
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

/// The least and the greatest height of a section with a slope taken off.
fn range(section: &[[f64; 2]], slope: f64) -> [f64; 2] {
    section
        .iter()
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], [y, z]| {
            let height = z - slope * y;
            [least.min(height), most.max(height)]
        })
}

/// Slopes, each drawn to the mean of those around it, as many on either side: what changes evenly stays. Tips side by side that rise
/// differently need more edge, so that slopes of their own for narrow places of a part do not pay.
fn smoothed(slopes: &[f64]) -> Vec<f64> {
    let mean = |place: usize| {
        let around = AROUND.min(place).min(slopes.len() - 1 - place);
        let near = slopes.get(place - around..=place + around).unwrap_or_default();
        let mean = near.iter().sum::<f64>() / near.len() as f64;
        (mean / SLOPES).round() * SLOPES
    };
    (0..slopes.len()).map(mean).collect()
}

/// The slope of the straight line nearest to a section: how wide its strip is, is convex in the slope.
fn nearest_slope(section: &[[f64; 2]]) -> Option<f64> {
    section.first()?;
    let wide = |slope: f64| {
        let [least, most] = range(section, slope);
        most - least
    };
    let (mut low, mut high) = (-Fan::STEEPEST, Fan::STEEPEST);
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
