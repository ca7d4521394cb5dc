//! Heights of a surface as functions of x: its shadow along y, and its sections.
//!
//! The shadow `P(x) = max over y of p(x, y)` is the upper envelope of all edges seen along y: a triangle's highest point
//! over an x lies on its border. Straight cuts along y that keep clear of the shadow keep clear of the part. Minkowski sums
//! commute with the projection, so an allowance may be laid on the shadow.
//!
//! Gaps no wider than the surface's `weld` are closed: in x by a straight line; where a section runs along a gap, by the
//! highest that lies within `weld` to either side.

use crate::envelope::{Envelope, Holes};
use crate::surface::{Cell, Surface, clipped, cut};
use core::fmt;
use vcutc_geometry::curve::Point2;
use vcutc_geometry::profile::Profile;

/// Where a surface has no height.
#[derive(Clone, Debug, PartialEq)]
pub struct Uncovered {
    /// Ranges of x, in mm, from left to right.
    pub ranges: Holes,
}

impl fmt::Display for Uncovered {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.ranges.first() {
            Some([from, to]) => write!(f, "the surface has no height from x = {from} mm to {to} mm"),
            None => write!(f, "the surface has no height"),
        }
    }
}

impl core::error::Error for Uncovered {}

impl Surface {
    /// The greatest height over each x, over the whole depth of the plan. Exact up to rounding, and nowhere below the
    /// triangles; where it steps, places in x are right within 1e-8 mm. The same for the same triangles in any order.
    ///
    /// # Errors
    /// If over some x there is nothing at any y.
    pub fn shadow(&self) -> Result<Profile, Uncovered> {
        let corners = self.mesh().corners();
        let at = |index: u32| {
            corners
                .get(index as usize)
                .map_or(Point2::new(0.0, 0.0), |p| Point2::new(p.x, p.z))
        };
        // Corners are in the order of x, so edges sorted by their corners are too.
        let mut edges: Vec<u64> = self
            .mesh()
            .triangles()
            .iter()
            .flat_map(|&[a, b, c]| [[a, b], [b, c], [a, c]])
            .map(|[a, b]| u64::from(a.min(b)) << 32 | u64::from(a.max(b)))
            .collect();
        edges.sort_unstable();
        edges.dedup();
        let segments = edges
            .iter()
            .map(|&edge| [at((edge >> 32) as u32), at(edge as u32)]);
        self.covering(&Envelope::of(segments))
    }

    /// The height of the surface over each x at one y in mm (the nearest on the plan). Exact up to rounding, and nowhere
    /// below the triangles; where it steps, places in x are right within 1e-8 mm.
    ///
    /// # Errors
    /// If there is nothing over some range of x wider than the surface's `weld`.
    pub fn section(&self, y: f64) -> Result<Profile, Uncovered> {
        let [width, depth] = self.size();
        let y = nearest(y, depth);
        let mut segments = Vec::new();
        for number in self.row(y, y) {
            cut(self.triangle(number), y, &mut segments);
        }
        let envelope = Envelope::of(segments.into_iter());
        let weld = self.accuracy().weld.to_mm();
        if envelope.holes(0.0, width, weld).is_empty() {
            return self.covering(&envelope);
        }
        let beside = self.slab([0.0, y - weld], [width, y + weld]);
        self.covering(&envelope.with(&beside))
    }

    /// The height of the surface over a place in mm (the nearest on the plan). Exact up to rounding.
    ///
    /// None where no triangle lies within the surface's `weld`; within it, the highest counts.
    #[must_use]
    pub fn height(&self, x: f64, y: f64) -> Option<f64> {
        let [width, depth] = self.size();
        let (x, y) = (nearest(x, width), nearest(y, depth));
        let mut segments = Vec::new();
        for &number in self.bins().triangles(self.bins().at(x, y)) {
            cut(self.triangle(number), y, &mut segments);
        }
        let weld = self.accuracy().weld.to_mm();
        Envelope::of(segments.into_iter()).highest(x, x).or_else(|| {
            self.slab([x - weld, y - weld], [x + weld, y + weld])
                .highest(x - weld, x + weld)
        })
    }

    /// The shadow of what lies over a rectangle.
    fn slab(&self, low: [f64; 2], high: [f64; 2]) -> Envelope {
        let mut segments = Vec::new();
        for number in self.row(low[1], high[1]) {
            let polygon = clipped(&self.triangle(number), low, high);
            let flat = |point: &vcutc_backend_api::geometry::Point3| Point2::new(point.x, point.z);
            if let [first, .., last] = polygon.as_slice() {
                segments.extend(polygon.windows(2).map(|pair| [flat(&pair[0]), flat(&pair[1])]));
                segments.push([flat(first), flat(last)]);
            }
        }
        Envelope::of(segments.into_iter())
    }

    /// The triangles that may lie between two y, each once, in their order.
    fn row(&self, from: f64, to: f64) -> Vec<u32> {
        let bins = self.bins();
        let (first, last) = (bins.at(0.0, from).row, bins.at(0.0, to).row);
        let mut numbers: Vec<u32> = (first..=last)
            .flat_map(|row| (0..bins.columns()).map(move |column| Cell { column, row }))
            .flat_map(|cell| bins.triangles(cell))
            .copied()
            .collect();
        numbers.sort_unstable();
        numbers.dedup();
        numbers
    }

    /// The profile of an envelope that has a height everywhere.
    fn covering(&self, envelope: &Envelope) -> Result<Profile, Uncovered> {
        let [width, _] = self.size();
        let ranges = envelope.holes(0.0, width, self.accuracy().weld.to_mm());
        if ranges.is_empty()
            && let Some(profile) = envelope.profile(0.0, width)
        {
            return Ok(profile);
        }
        Err(Uncovered { ranges })
    }
}

/// The number from 0 to `most` that is nearest; 0 for what is not a number.
fn nearest(value: f64, most: f64) -> f64 {
    // `max` gives the other one of NaN.
    value.max(0.0).min(most)
}

#[cfg(test)]
mod tests;
