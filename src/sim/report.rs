//! The figures of a proven program: what people want to see before they run it.

use super::prove::{Replay, merge_heights};
use super::timing::Timing;
use crate::geom::curve::Point2;
use crate::geom::profile::Profile;
use vcutc_backend_api::ir::{OperationId, Stock};
use vcutc_backend_api::units::{Area, Length};

/// Figures of a program.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// Cuts of each layer, operation by operation.
    pub layers: Vec<(OperationId, usize)>,
    /// Times.
    pub timing: Timing,
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
pub fn report(replay: Replay, stock: Stock, part: &Profile, timing: Timing) -> Report {
    let corners: Vec<Point2> = replay.surface.corners().collect();
    let machined = area_under(&corners);
    let theoretical = part.area_below(0.0, stock.width.to_mm());
    let whole = stock.width.to_mm() * stock.height.to_mm();
    let residual = Area::mm2(machined) - theoretical;
    Report {
        layers: replay.layers,
        timing,
        removed: Area::mm2(whole - machined),
        residual,
        scallop: highest(&corners, part),
        mean_scallop: Length::mm(residual.to_mm2() / part.arc_length().to_mm()),
        longest_edge: replay.longest_edge,
        correlation: correlation(&resample(&corners), &resample(part.points())),
    }
}

fn area_under(corners: &[Point2]) -> f64 {
    let strip = |(a, b): (&Point2, &Point2)| (b.x - a.x) * (a.z + b.z) / 2.0;
    corners.iter().zip(corners.iter().skip(1)).map(strip).sum()
}

/// The surface's point farthest from the part: over a corner of the surface, or where the surface is flat over a hollow,
/// over a corner of the part.
fn highest(corners: &[Point2], part: &Profile) -> Scallop {
    let mut highest = Scallop {
        height: Length::ZERO,
        peak: Point2 { x: 0.0, z: 0.0 },
    };
    let mut look = |x: f64, surface: f64, part_height: f64| {
        // The distance is at most the height above the part, so low points need no search.
        if surface - part_height > highest.height.to_mm() {
            let peak = Point2 { x, z: surface };
            let height = Length::mm(part.nearest_distance(peak));
            if height > highest.height {
                highest = Scallop { height, peak };
            }
        }
    };
    merge_heights(corners, part.points(), &mut look);
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
