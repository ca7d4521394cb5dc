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

/// Boxes of a size that are followed to the roughest place: large boxes may look rough for want of knowledge only.
const MOST_FOLLOWED: usize = 16;

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
    let whole = Region::whole(plan)?;
    let tolerance = tolerance.to_mm();
    if tolerance.partial_cmp(&0.0) != Some(core::cmp::Ordering::Greater) {
        return Err(FormulaError::TooFine);
    }
    // A step or a pole shows on the way to the roughest place, long before the boxes of the whole plan are used up.
    whole.roughest(f, tolerance)?;
    let mut corners = Vec::new();
    let mut triangles = Vec::new();
    // Boxes still to do, the next one last.
    let mut boxes = vec![whole];
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
                let [first, second] = region.halves(axis);
                boxes.extend([second, first]);
            }
        }
    }
    Mesh::new(corners, triangles).map_err(|_| FormulaError::TooFine)
}

/// The place of the plan where a formula asks for the smallest boxes, in mm: the middle of the box that is found by following
/// the roughest halves.
#[must_use]
pub fn roughest(f: &Formula<'_>, plan: Plan, tolerance: Length) -> Option<[f64; 2]> {
    let region = Region::whole(plan).ok()?.roughest(f, tolerance.to_mm());
    region.ok().map(Region::middle)
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
    fn whole(plan: Plan) -> Result<Self, FormulaError> {
        let high = [plan.width.to_mm(), plan.depth.to_mm()];
        match high.iter().all(|&size| size > 0.0 && size <= LARGEST_COORDINATE) {
            true => Ok(Self { low: [0.0; 2], high }),
            false => Err(FormulaError::BadPlan),
        }
    }

    fn middle(self) -> [f64; 2] {
        [0, 1].map(|axis| self.low[axis] + (self.high[axis] - self.low[axis]) / 2.0)
    }

    fn halves(self, axis: usize) -> [Self; 2] {
        let middle = self.middle()[axis];
        let (mut first, mut second) = (self, self);
        first.high[axis] = middle;
        second.low[axis] = middle;
        [first, second]
    }

    /// The last box to be halved when only the roughest halves are followed. Only boxes of the whole division are judged, so
    /// what is an error here is one there.
    fn roughest(self, f: &Formula<'_>, tolerance: f64) -> Result<Self, FormulaError> {
        let mut last = self;
        let mut followed = vec![self];
        loop {
            let mut halves = Vec::new();
            for region in followed {
                if let Verdict::Halve(axis) = region.judge(f, tolerance)? {
                    let off = |half: Self| half.enclosed(f).map_or(f64::INFINITY, |value| half.off(value));
                    halves.extend(region.halves(axis).map(|half| (off(half), half)));
                }
            }
            // Stable: of equal ones the first come first.
            halves.sort_by(|a, b| b.0.total_cmp(&a.0));
            match halves.first() {
                Some(&(_, roughest)) => last = roughest,
                None => return Ok(last),
            }
            followed = halves.iter().take(MOST_FOLLOWED).map(|&(_, half)| half).collect();
        }
    }

    fn enclosed(self, f: &Formula<'_>) -> Option<OnPlane<Interval>> {
        let range = |axis: usize| Interval {
            low: self.low[axis],
            high: self.high[axis],
        };
        f(OnPlane::coordinate(0, range(0)), OnPlane::coordinate(1, range(1)))
    }

    /// How far the formula may be off two triangles at most.
    fn off(self, enclosure: OnPlane<Interval>) -> f64 {
        let [h, k] = [0, 1].map(|axis| self.high[axis] - self.low[axis]);
        let [xx, xy, yy] = enclosure.curve.map(Interval::magnitude);
        let [x, y] = enclosure.by.map(Interval::width);
        let bounds = [
            (h * h * xx + 2.0 * h * k * xy + k * k * yy) / 8.0,
            (h * x + k * y) / 2.0,
            enclosure.value.width(),
        ];
        // `min` passes over NaN.
        bounds.into_iter().fold(f64::INFINITY, f64::min)
    }

    const fn places(self) -> [[f64; 2]; 4] {
        let Self { low, high } = self;
        [low, [high[0], low[1]], [low[0], high[1]], high]
    }

    fn judge(self, f: &Formula<'_>, tolerance: f64) -> Result<Verdict, FormulaError> {
        let [h, k] = [self.high[0] - self.low[0], self.high[1] - self.low[1]];
        let least = |axis: usize| NARROWEST.max(self.low[axis].abs() * NARROWEST_SHARE);
        let enclosure = self.enclosed(f);
        if let Some(enclosure) = enclosure {
            let off = self.off(enclosure);
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
            let [xx, _, yy] = enclosure.curve.map(Interval::magnitude);
            let [x, y] = enclosure.by.map(Interval::width);
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
        let [x, y] = self.middle();
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
