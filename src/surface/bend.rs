//! Curvatures of the upper side of a part, at the middle of each cell of a map.
//!
//! A formula gives them by its derivatives ([`Exact`]). Triangles are flat and have none. There a paraboloid with slopes is fitted by
//! least squares to what lies within reach of a place (Cazals and Pouget: Estimating differential quantities using polynomial fitting of
//! osculating jets, 2005: the error of its curvature is of the order of the reach):
//!
//! * The corners of triangles on the upper side, since they lie on the surface that the triangles stand for. Those on the sides of the
//!   stock count less, because clipping may have put them there.
//! * The heights of the triangles at a few places, which are off by their tolerance. They count so little that corners decide; but
//!   in long triangles they say what corners do not. Where there are hardly any corners, all count alike.
//!
//! So these are estimates, not bounds. What is smaller than the reach is smoothed, and where the part has an edge or a step within
//! it, no paraboloid fits and the value is missing. The scatter about the fit says how far off a curvature may be: two standard errors.

mod crowd;
mod fit;

use crate::class::{Class, FLAT};
use crate::curvature::Curvature;
use crate::map::{Cells, Map};
use crate::residual::Over;
use crate::surface::Surface;
use core::fmt;
use crowd::Crowd;
use fit::{Fit, Point};
use std::sync::Arc;
use vcutc_backend_api::units::Length;

/// The curvature of a part by its derivatives, at a place of the plan in mm. None where it has an edge.
#[derive(Clone)]
pub struct Exact(Arc<dyn Fn([f64; 2]) -> Option<Curvature> + Send + Sync>);

impl Exact {
    /// By a function of the place.
    #[must_use]
    pub fn new(curvature: impl Fn([f64; 2]) -> Option<Curvature> + Send + Sync + 'static) -> Self {
        Self(Arc::new(curvature))
    }

    /// At a place of the plan, in mm.
    #[must_use]
    pub fn at(&self, place: [f64; 2]) -> Option<Curvature> {
        (self.0)(place)
    }
}

impl fmt::Debug for Exact {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Exact")
    }
}

/// How the part bends at a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bend {
    /// The greatest and the least normal curvature, in 1/mm, positive where the part is hollow.
    pub principal: [f64; 2],
    /// How far off each may be by the scatter of the corners, in 1/mm; 0 where it is exact.
    pub doubt: [f64; 2],
}

impl Bend {
    /// The greatest curvature in 1/mm; 0 where it is too small to be known from that.
    #[must_use]
    pub fn greatest(&self) -> f64 {
        let ([greatest, _], [doubt, _]) = (self.principal, self.doubt);
        if greatest.abs() > FLAT.max(doubt) {
            greatest
        } else {
            0.0
        }
    }

    /// What the part looks like there.
    #[must_use]
    pub fn class(&self) -> Class {
        Class::of(self.principal, self.doubt)
    }
}

/// How far from a place what is fitted lies, at least, in mm, and no less than a cell: a disc bridges what is smaller.
const REACH: f64 = 5.0;

/// How far it lies at most, in mm.
const FARTHEST: f64 = 100.0;

/// How far heights of triangles are looked at where there are hardly any corners, in mm.
const WITHOUT_CORNERS: f64 = 20.0;

/// By how much the reach grows until there are enough corners.
const GROWTH: f64 = 1.5;

/// Corners that decide alone: half as many again as a paraboloid with slopes has coefficients, and three rows of three on a grid.
const FEWEST: usize = 9;

/// Heights of triangles that are looked at along x and along y.
const LOOKS: u32 = 5;

/// How much a corner on a side of the stock and a height of a triangle count beside a corner.
const ON_A_SIDE: f64 = 0.1;
const BETWEEN_CORNERS: f64 = 1e-6;

/// Scatter about the fit, as a share of the reach, beyond which the part has an edge there: one of about 30 degrees in the middle.
const EDGE: f64 = 0.02;

impl Surface {
    /// How it bends at the middle of each cell, row by row from the least y, each from the least x: exactly, or as its triangles suggest.
    #[must_use]
    pub fn bends(&self, cells: Cells, exact: Option<&Exact>) -> Vec<Option<Bend>> {
        let middles = middles(cells, self.size());
        match exact {
            Some(exact) => middles
                .map(|place| {
                    let principal = exact.at(place)?.principal();
                    let doubt = [0.0; 2];
                    Some(Bend { principal, doubt })
                })
                .collect(),
            None => {
                let estimate = Estimate::new(self, cells);
                middles.map(|place| estimate.at(place)).collect()
            }
        }
    }
}

/// The middles of cells, in mm.
fn middles(cells: Cells, size: [f64; 2]) -> impl Iterator<Item = [f64; 2]> {
    let counts = [cells.columns, cells.rows].map(|count| count.max(1));
    let middle =
        move |axis: usize, number: u32| size[axis] * (f64::from(number) + 0.5) / f64::from(counts[axis]);
    (0..counts[1]).flat_map(move |row| (0..counts[0]).map(move |column| [middle(0, column), middle(1, row)]))
}

impl Map<f64> {
    /// Of numbers at the middles of cells over a plan of a size in mm. None without any.
    #[must_use]
    pub fn of_middles(values: Vec<Option<f64>>, cells: Cells, size: [f64; 2]) -> Option<Self> {
        let known = || {
            let with_places = values.iter().zip(middles(cells, size));
            with_places.filter_map(|(value, place)| {
                value.map(|height| Over {
                    height,
                    place: place.map(Length::mm),
                })
            })
        };
        let higher = |one: Over<f64>, other: Over<f64>| if other.height > one.height { other } else { one };
        let lower = |one: Over<f64>, other: Over<f64>| if other.height < one.height { other } else { one };
        let (highest, lowest) = (known().reduce(higher)?, known().reduce(lower)?);
        let mean = known().map(|over| over.height).sum::<f64>() / known().count() as f64;
        Some(Self {
            highest,
            lowest,
            mean,
            cells: values,
        })
    }
}

/// A surface of triangles, ready for fits.
struct Estimate<'s> {
    surface: &'s Surface,
    corners: Crowd,
    /// The least reach, in mm.
    reach: f64,
}

impl<'s> Estimate<'s> {
    fn new(surface: &'s Surface, cells: Cells) -> Self {
        let size = surface.size();
        let cell = (size[0] / f64::from(cells.columns.max(1))).max(size[1] / f64::from(cells.rows.max(1)));
        let reach = REACH.max(cell);
        Self {
            surface,
            corners: Crowd::new(surface, reach),
            reach,
        }
    }

    fn at(&self, place: [f64; 2]) -> Option<Bend> {
        let mut reach = self.reach;
        while reach <= FARTHEST.max(self.reach) {
            let window = self.window(place, reach);
            let corners = self.corners.within(window);
            if corners.len() >= FEWEST && are_spread(&corners, window) {
                let mut points: Vec<Point> = corners.into_iter().map(|at| self.corner(at)).collect();
                points.extend(self.heights(window, BETWEEN_CORNERS));
                return fitted(place, reach, &points);
            }
            reach *= GROWTH;
        }
        let reach = WITHOUT_CORNERS.max(self.reach);
        let window = self.window(place, reach);
        let mut points: Vec<Point> = self.heights(window, 1.0).collect();
        let corners = self.corners.within(window).into_iter();
        points.extend(corners.map(|at| Point { at, weight: 1.0 }));
        fitted(place, reach, &points)
    }

    /// The square around a place, moved onto the plan: its least and its greatest corner.
    fn window(&self, place: [f64; 2], reach: f64) -> [[f64; 2]; 2] {
        let size = self.surface.size();
        let low = [0, 1].map(|axis| (place[axis] - reach).min(size[axis] - 2.0 * reach).max(0.0));
        [low, [0, 1].map(|axis| (low[axis] + 2.0 * reach).min(size[axis]))]
    }

    fn corner(&self, at: [f64; 3]) -> Point {
        let size = self.surface.size();
        let is_inside = [0, 1].iter().all(|&axis| at[axis] > 0.0 && at[axis] < size[axis]);
        let weight = if is_inside { 1.0 } else { ON_A_SIDE };
        Point { at, weight }
    }

    /// Heights of the triangles over a window, evenly spread.
    fn heights(&self, [low, high]: [[f64; 2]; 2], weight: f64) -> impl Iterator<Item = Point> {
        let along = move |axis: usize, number: u32| {
            low[axis] + (high[axis] - low[axis]) * (f64::from(number) + 0.5) / f64::from(LOOKS)
        };
        let places =
            (0..LOOKS).flat_map(move |row| (0..LOOKS).map(move |column| [along(0, column), along(1, row)]));
        places.filter_map(move |[x, y]| {
            let at = [x, y, self.surface.height(x, y)?];
            Some(Point { at, weight })
        })
    }
}

/// Whether corners lie in each third of a window along x and along y: those on two lines do not say how it bends across them.
fn are_spread(corners: &[[f64; 3]], [low, high]: [[f64; 2]; 2]) -> bool {
    [0, 1].into_iter().all(|axis| {
        let third = (high[axis] - low[axis]) / 3.0;
        (0..3_u32).all(|number| {
            let from = low[axis] + third * f64::from(number);
            let is_in = |at: &[f64; 3]| from <= at[axis] && at[axis] <= from + third;
            corners.iter().any(is_in)
        })
    })
}

/// How a part bends at a place that has these points around it.
fn fitted(place: [f64; 2], reach: f64, points: &[Point]) -> Option<Bend> {
    let fit = Fit::of(place, reach, points)?;
    if fit.scatter() > EDGE * reach {
        return None;
    }
    let second = fit.second();
    let principal = Curvature::of_height(fit.slope(), second)?.principal();
    // In plan, the directions of both: what the slope changes about them does not matter to a doubt.
    let turn = libm::atan2(2.0 * second[1], second[0] - second[2]) / 2.0;
    let (sine, cosine) = libm::sincos(turn);
    Some(Bend {
        principal,
        doubt: [[cosine, sine], [-sine, cosine]].map(|direction| 2.0 * fit.error(direction)),
    })
}

#[cfg(test)]
mod tests;
