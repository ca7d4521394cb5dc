//! Surfaces from formulas `z = f(x, y)`, sampled so that the tolerance is proven.
//!
//! The formula is evaluated over boxes, as an enclosure of its values, its slopes and its curvatures
//! ([`vcutc_geometry::number::OnPlane`]). A box of size `h` by `k`, split into two triangles through its corners, is off by
//! the least of
//!
//! * `(h^2 |fxx| + 2 h k |fxy| + k^2 |fyy|)/8` (Filip, Magedson and Markot: Surface algorithms using bounds on derivatives,
//!   1986, theorem 1),
//! * `(h w(fx) + k w(fy))/2` with the widths of the slopes' enclosures: the slopes of a triangle are means of the formula's
//!   along its legs, so the difference to it changes no faster than by these widths, and is 0 at the corners; this holds at
//!   kinks,
//! * the width of the enclosure of the values, between which the triangles lie too.
//!
//! Boxes are halved until that is within the tolerance, along the side that counts most. Halved boxes meet whole ones at the
//! middle of a side: in plan nothing stays open there, and in height both are within the tolerance.

use crate::grid::split;
use crate::mesh::Mesh;
use crate::surface::Plan;
use core::fmt;
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::units::Length;
use vcutc_geometry::curve::LARGEST_COORDINATE;
use vcutc_geometry::number::{Interval, OnPlane};

/// Boxes that are looked at, at most.
const MOST_BOXES: usize = 4_000_000;

/// Boxes narrower than this in mm, or this share of their coordinates, are not halved any more.
const NARROWEST: f64 = 1e-7;
const NARROWEST_SHARE: f64 = 1e-13;

/// Why a formula does not make a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FormulaError {
    /// The plan is empty or out of range.
    BadPlan,
    /// The formula has no value here, or one that is out of range.
    NoValue {
        /// Where, in mm.
        x: f64,
        /// Where, in mm.
        y: f64,
    },
    /// However near two places are, their heights differ by more than the tolerance, or may do so for all that is known.
    Jump {
        /// Where, in mm.
        x: f64,
        /// Where, in mm.
        y: f64,
    },
    /// The tolerance is not above 0 or asks for too many triangles.
    TooFine,
}

impl fmt::Display for FormulaError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::BadPlan => write!(f, "the plan is empty or out of range"),
            Self::NoValue { x, y } => write!(f, "the formula has no value at x = {x} mm, y = {y} mm"),
            Self::Jump { x, y } => write!(f, "the formula steps at x = {x} mm, y = {y} mm"),
            Self::TooFine => write!(f, "the tolerance asks for too many triangles"),
        }
    }
}

impl core::error::Error for FormulaError {}

/// A formula: what `x` and `y` over a box make of it, in mm; none where it has no value at some place of the box. What it
/// gives must enclose values, slopes and curvatures at all places of the box; of what is not known,
/// [`Interval::UNKNOWN`] is right.
pub type Formula<'a> = dyn Fn(OnPlane<Interval>, OnPlane<Interval>) -> Option<OnPlane<Interval>> + 'a;

/// The mesh of a formula over the plan. The formula's surface lies within the tolerance of it, measured along z.
///
/// # Errors
/// See [`FormulaError`].
pub fn formula(f: &Formula<'_>, plan: Plan, tolerance: Length) -> Result<Mesh, FormulaError> {
    let (width, depth) = (plan.width.to_mm(), plan.depth.to_mm());
    let proper = |size: f64| size > 0.0 && size <= LARGEST_COORDINATE;
    if !(proper(width) && proper(depth)) {
        return Err(FormulaError::BadPlan);
    }
    let tolerance = tolerance.to_mm();
    if tolerance.partial_cmp(&0.0) != Some(core::cmp::Ordering::Greater) {
        return Err(FormulaError::TooFine);
    }
    let mut corners = Vec::new();
    let mut triangles = Vec::new();
    // Boxes still to do, the next one last.
    let mut boxes = vec![Region {
        low: [0.0, 0.0],
        high: [width, depth],
    }];
    let mut looked_at = 0;
    while let Some(region) = boxes.pop() {
        looked_at += 1;
        if looked_at > MOST_BOXES {
            return Err(FormulaError::TooFine);
        }
        match region.judge(f, tolerance)? {
            Verdict::Flat(heights) => {
                let first = corners.len() as u32;
                corners.extend(
                    region
                        .places()
                        .iter()
                        .zip(heights)
                        .map(|(p, z)| Point3::new(p[0], p[1], z)),
                );
                triangles.extend(split([first, first + 1, first + 2, first + 3], heights));
            }
            Verdict::Halve(axis) => {
                let middle = region.low[axis] + (region.high[axis] - region.low[axis]) / 2.0;
                let (mut first, mut second) = (region, region);
                first.high[axis] = middle;
                second.low[axis] = middle;
                boxes.extend([second, first]);
            }
        }
    }
    Mesh::new(corners, triangles).map_err(|_| FormulaError::TooFine)
}

/// A box of the plan.
#[derive(Clone, Copy, Debug)]
struct Region {
    low: [f64; 2],
    high: [f64; 2],
}

enum Verdict {
    /// Two triangles do; the heights of its corners.
    Flat([f64; 4]),
    /// Halve it along x (0) or y (1).
    Halve(usize),
}

impl Region {
    const fn places(self) -> [[f64; 2]; 4] {
        let Self { low, high } = self;
        [low, [high[0], low[1]], [low[0], high[1]], high]
    }

    fn judge(self, f: &Formula<'_>, tolerance: f64) -> Result<Verdict, FormulaError> {
        let [h, k] = [self.high[0] - self.low[0], self.high[1] - self.low[1]];
        let range = |axis: usize| Interval {
            low: self.low[axis],
            high: self.high[axis],
        };
        let least = |axis: usize| NARROWEST.max(self.low[axis].abs() * NARROWEST_SHARE);
        let enclosure = f(OnPlane::coordinate(0, range(0)), OnPlane::coordinate(1, range(1)));
        if let Some(enclosure) = enclosure {
            let [xx, xy, yy] = enclosure.curve.map(Interval::magnitude);
            let [x, y] = enclosure.by.map(Interval::width);
            let bounds = [
                (h * h * xx + 2.0 * h * k * xy + k * k * yy) / 8.0,
                (h * x + k * y) / 2.0,
                enclosure.value.width(),
            ];
            // `min` passes over NaN.
            let off = bounds.into_iter().fold(f64::INFINITY, f64::min);
            if off <= tolerance {
                let mut heights = [0.0; 4];
                let mut rounding: f64 = 0.0;
                for (height, place) in heights.iter_mut().zip(self.places()) {
                    let value = value(f, place)?;
                    *height = value.middle();
                    rounding = rounding.max(value.width());
                }
                // A little for the rounding of the bounds themselves.
                if off * (1.0 + 1e-12) + rounding <= tolerance {
                    return Ok(Verdict::Flat(heights));
                }
            }
            let curved = h * h * xx + k * k * yy;
            // Where curvatures are known they say along which side halving helps; else slopes, else the longer side.
            let along_x = if curved.is_finite() && curved > 0.0 && curved < 1e30 {
                h * h * xx >= k * k * yy
            } else if (h * x + k * y).is_finite() && h * x + k * y < 1e30 {
                h * x >= k * y
            } else {
                h >= k
            };
            let preferred = usize::from(!along_x);
            let sizes = [h, k];
            // No box gets long and thin without end: the other side's share may stay unknown.
            let preferred = if sizes[preferred] * 64.0 < sizes[1 - preferred] {
                1 - preferred
            } else {
                preferred
            };
            if sizes[preferred] > least(preferred) {
                return Ok(Verdict::Halve(preferred));
            }
        } else if h.max(k) > least(0).max(least(1)) {
            return Ok(Verdict::Halve(usize::from(h < k)));
        }
        let [x, y] = [self.low[0] + h / 2.0, self.low[1] + k / 2.0];
        for place in self.places() {
            value(f, place)?;
        }
        match enclosure {
            Some(_) => Err(FormulaError::Jump { x, y }),
            None => Err(FormulaError::NoValue { x, y }),
        }
    }
}

/// The value of a formula at a place.
fn value(f: &Formula<'_>, [x, y]: [f64; 2]) -> Result<Interval, FormulaError> {
    let at = |axis: usize, value: f64| OnPlane::coordinate(axis, Interval::exactly(value));
    f(at(0, x), at(1, y))
        .map(|result| result.value)
        .filter(|value| value.within(-LARGEST_COORDINATE, LARGEST_COORDINATE))
        .ok_or(FormulaError::NoValue { x, y })
}

#[cfg(test)]
mod tests;
