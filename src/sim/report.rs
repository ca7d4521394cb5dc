//! The figures of a proven program: what people want to see before they run it.

use super::prove::{Replay, merge_heights};
use super::timing::{LayerTime, Times, Timing};
use crate::geom::curve::Point2;
use crate::geom::profile::Profile;
use vcutc_backend_api::ir::{OperationId, Stock};
use vcutc_backend_api::units::{Area, Length};

/// Figures of a program.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// Cuts of each layer, operation by operation.
    pub layers: Vec<(OperationId, usize)>,
    /// Times by what they are spent on.
    pub timing: Timing,
    /// The same for each layer.
    pub layer_times: Vec<LayerTime>,
    /// Area of the stock's cross-section that is cut away.
    pub removed: Area,
    /// Area that stays on the part.
    pub residual: Area,
    /// The highest material on the part, along its normal, and where it stands.
    pub scallop: Scallop,
    /// Mean height of material on the part: residual area over the profile's length.
    pub mean_scallop: Length,
    /// The longest edge that any cut uses.
    pub longest_edge: Length,
    /// Largest normalised cross-correlation of machined and theoretical contour, each resampled at 1000 points [Cui 15].
    pub correlation: f64,
}

/// Material left standing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scallop {
    /// Height along the part's normal.
    pub height: Length,
    /// Its peak.
    pub peak: Point2,
}

impl Report {
    /// Number of V-cuts.
    #[must_use]
    pub fn cuts(&self) -> usize {
        self.layers.iter().map(|(_, cuts)| cuts).sum()
    }
}

/// Gathers the figures of a replay.
#[must_use]
pub fn report(replay: Replay, stock: Stock, part: &Profile, times: Times) -> Report {
    let corners: Vec<Point2> = replay.surface.corners().collect();
    let machined = area_under(&corners);
    let theoretical = part.area_below(0.0, stock.width.to_mm());
    let whole = stock.width.to_mm() * stock.height.to_mm();
    let residual = Area::mm2(machined) - theoretical;
    Report {
        layers: replay.layers,
        timing: times.all,
        layer_times: times.layers,
        removed: Area::mm2(whole - machined),
        residual,
        scallop: highest(&corners, part),
        mean_scallop: Length::mm(residual.to_mm2() / part.arc_length().to_mm()),
        longest_edge: replay.longest_edge,
        correlation: correlation(&resample(&corners), &resample(part.points())),
    }
}

/// Area of the cross-section under a surface, in mm2.
pub(crate) fn area_under(corners: &[Point2]) -> f64 {
    let strip = |(a, b): (&Point2, &Point2)| (b.x - a.x) * (a.z + b.z) / 2.0;
    corners.iter().zip(corners.iter().skip(1)).map(strip).sum()
}

/// Scallops are found to within this, in mm.
const SCALLOP_TOLERANCE: f64 = 1e-3;

/// The surface's point farthest from the part.
///
/// Corners of the surface come first. Between two of them the distance may still be larger, over the middle of a hollow;
/// but it never changes faster than the place, so on a stretch of length `l` between points `a` and `b` away from the part
/// it is at most `(a + b + l) / 2`. Stretches where that is no more than what is known are left out, others are halved.
#[must_use]
pub fn highest(corners: &[Point2], part: &Profile) -> Scallop {
    let mut highest = Scallop {
        height: Length::ZERO,
        peak: Point2 { x: 0.0, z: 0.0 },
    };
    let distances: Vec<f64> = corners
        .iter()
        .map(|&corner| part.nearest_distance(corner))
        .collect();
    for (&peak, &distance) in corners.iter().zip(&distances) {
        if distance > highest.height.to_mm() {
            highest = Scallop {
                height: Length::mm(distance),
                peak,
            };
        }
    }
    let ends = || corners.iter().copied().zip(distances.iter().copied());
    let mut stretches: Vec<_> = ends().zip(ends().skip(1)).collect();
    while let Some(((a, at_a), (b, at_b))) = stretches.pop() {
        let most = (at_a + at_b + a.distance(b)) / 2.0;
        if most <= highest.height.to_mm() + SCALLOP_TOLERANCE {
            continue;
        }
        let middle = a.lerp(b, 0.5);
        let distance = part.nearest_distance(middle);
        if distance > highest.height.to_mm() {
            highest = Scallop {
                height: Length::mm(distance),
                peak: middle,
            };
        }
        stretches.push(((a, at_a), (middle, distance)));
        stretches.push(((middle, distance), (b, at_b)));
    }
    highest
}

/// Points that contours are compared by [Cui IV.B].
const SAMPLES: u32 = 1000;

fn resample(points: &[Point2]) -> Vec<f64> {
    let (Some(first), Some(last)) = (points.first(), points.last()) else {
        return Vec::new();
    };
    let step = (last.x - first.x) / f64::from(SAMPLES - 1);
    let grid: Vec<Point2> = (0..SAMPLES)
        .map(|i| Point2 {
            x: first.x + f64::from(i) * step,
            z: 0.0,
        })
        .collect();
    let mut heights = Vec::with_capacity(grid.len());
    let mut next = 0;
    merge_heights(points, &grid, &mut |x, z, _| {
        if grid.get(next).is_some_and(|wanted| wanted.x <= x) {
            heights.push(z);
            next += 1;
        }
    });
    heights
}

/// The largest value of the normalised cross-correlation over all lags [Cui 15]; 1 means alike up to scale.
fn correlation(a: &[f64], b: &[f64]) -> f64 {
    let product = |x: &[f64], y: &[f64]| -> f64 { x.iter().zip(y).map(|(x, y)| x * y).sum() };
    let scale = (product(a, a) * product(b, b)).sqrt();
    if scale <= 0.0 {
        return 1.0;
    }
    let lags = 0..a.len().max(b.len());
    let at = |lag: usize| {
        let later_a = product(a.get(lag..).unwrap_or_default(), b);
        later_a.max(product(a, b.get(lag..).unwrap_or_default()))
    };
    lags.map(at).fold(0.0, f64::max) / scale
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn polyline(heights: &[f64]) -> Vec<Point2> {
        (0_u32..)
            .zip(heights)
            .map(|(i, &z)| Point2 {
                x: f64::from(i) * 10.0,
                z,
            })
            .collect()
    }

    /// Distance of a point from a polyline, from every piece.
    fn distance(point: Point2, line: &[Point2]) -> f64 {
        let to_piece = |pair: &[Point2]| {
            let (a, b) = (pair[0], pair[1]);
            let (dx, dz) = (b.x - a.x, b.z - a.z);
            let t = (((point.x - a.x) * dx + (point.z - a.z) * dz) / (dx * dx + dz * dz)).clamp(0.0, 1.0);
            libm::hypot(point.x - a.x - t * dx, point.z - a.z - t * dz)
        };
        line.windows(2).map(to_piece).fold(f64::INFINITY, f64::min)
    }

    proptest! {
        #[test]
        fn the_highest_point_is_found_between_corners_too(
            part in prop::collection::vec(0.0..40.0_f64, 6),
            above in prop::collection::vec(0.0..30.0_f64, 6),
        ) {
            let surface: Vec<f64> = part.iter().zip(&above).map(|(part, above)| part + above).collect();
            let (surface, part) = (polyline(&surface), polyline(&part));
            let found = highest(&surface, &Profile::new(part.clone()).unwrap()).height.to_mm();
            // Every hundredth of each stretch.
            let places = surface.windows(2).flat_map(|pair| (0..=100_u32).map(|i| pair[0].lerp(pair[1], f64::from(i) / 100.0)));
            let sampled = places.map(|place| distance(place, &part)).fold(0.0, f64::max);
            prop_assert!(found >= sampled - SCALLOP_TOLERANCE && found <= sampled + 0.5, "{found} {sampled}");
        }
    }
}
