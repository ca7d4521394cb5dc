//! The figures of a proven program: what people want to see before they run it.

use super::body::Passage;
use super::contour::{Sampled, Scallop, farthest};
use super::prove::{Cleared, Compensation, Replay, Slit, Tracked, UsedEdge};
use super::timing::Times;
use vcutc_backend_api::ir::{OperationId, Stock};
use vcutc_backend_api::units::{Area, Length};
use vcutc_geometry::columns::Column;
use vcutc_geometry::curve::Point2;
use vcutc_geometry::profile::{Contour, Profile};

/// Figures of a program.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// Cuts of each layer, operation by operation.
    pub layers: Vec<(OperationId, usize)>,
    /// Where the time goes.
    pub times: Times,
    /// The machined contour's corners, from left to right; two at one x are a wall.
    pub contour: Vec<Point2>,
    /// The columns whose Vs make up the machined surface; none where cuts follow none. The contour then is what they leave at most at any
    /// y, seen from the lower ends of their ways.
    pub columns: Vec<Column>,
    /// Area of the stock's cross-section that is cut away.
    pub removed: Area,
    /// Area that stays on the part.
    pub residual: Area,
    /// The point of the machined contour that is farthest from the nearest point of the part.
    pub scallop: Scallop,
    /// Mean height of material on the part: residual area over the profile's length.
    pub mean_scallop: Length,
    /// The longest edge that any cut uses.
    pub longest_edge: Length,
    /// How much edge or rim cuts use, in the program's order, as far as it is measured cut by cut.
    pub edges: Vec<UsedEdge>,
    /// How far the tips of its operations are offset, operation by operation; none of those that are not compensated.
    pub compensations: Vec<Option<Compensation>>,
    /// Largest normalised cross-correlation of machined and theoretical contour, each resampled at 1000 points [Cui 15].
    pub correlation: f64,
    /// The point of the part farthest from the machined contour. Over a hollow that no cut reaches it is farther away than
    /// any point of the machined contour is from the part.
    pub deepest: Scallop,
    /// Where a blade's body comes nearest above the work in a cut, where one is stated and looked at.
    pub body: Option<Passage>,
    /// What tracks on a surface do, operation by operation. The other figures are of what the cuts before them leave.
    pub tracked: Vec<Tracked>,
    /// What passes over regions do, operation by operation.
    pub cleared: Vec<Cleared>,
    /// What slits along walls do.
    pub slit: Vec<Slit>,
}

impl Report {
    /// Number of V-cuts.
    #[must_use]
    pub fn cuts(&self) -> usize {
        self.layers.iter().map(|(_, cuts)| cuts).sum()
    }

    /// The largest deviation of the contours: the largest distance from a point of one to the other [Cui IV.B], exactly and not
    /// at 1000 points.
    #[must_use]
    pub fn largest_deviation(&self) -> Length {
        self.scallop.height.max(self.deepest.height)
    }

    /// Where the part is farther from the machined contour than that is anywhere from the part: where no cut reaches it.
    #[must_use]
    pub fn hollow(&self) -> Option<Scallop> {
        // Less than what a hundredth of a millimetre shows does not count.
        (self.deepest.height.to_mm() >= self.scallop.height.to_mm() + 0.005).then_some(self.deepest)
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
    let scallop = farthest(&corners, part);
    let deepest = farthest(part.points(), &Contour::new(&corners));
    Report {
        layers: replay.layers,
        columns: replay.columns,
        times,
        removed: Area::mm2(whole - machined),
        residual,
        scallop,
        mean_scallop: Length::mm(residual.to_mm2() / part.arc_length().to_mm()),
        longest_edge: replay.longest_edge,
        edges: replay.edges,
        compensations: replay.compensations,
        correlation: Sampled::of(&corners, part.points()).correlation(),
        deepest,
        body: None,
        tracked: replay.tracked,
        cleared: replay.cleared,
        slit: replay.slit,
        contour: corners,
    }
}

/// Area of the cross-section under a surface, in mm2.
pub fn area_under(corners: &[Point2]) -> f64 {
    let strip = |(a, b): (&Point2, &Point2)| (b.x - a.x) * (a.z + b.z) / 2.0;
    corners.iter().zip(corners.iter().skip(1)).map(strip).sum()
}
