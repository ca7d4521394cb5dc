//! What stands in the way of a blade above its cut.

use super::findings::is_more_blocked;
use super::{Cut, CutFault, FlankGeometry, Player, note};
use vcutc_backend_api::units::Length;
use vcutc_geometry::curve::Point2;

impl Player<'_> {
    /// Keeps the cut with most material above its flank, given the first corner that stands in the way, if one does.
    #[inline]
    pub(super) fn note_blocked(
        &mut self,
        first: Option<Point2>,
        tip: Point2,
        geometry: FlankGeometry,
        cut: &Cut,
    ) {
        if let Some(first) = first {
            self.note_highest(first, tip, geometry, cut);
        }
    }

    #[cold]
    fn note_highest(&mut self, first: Point2, tip: Point2, geometry: FlankGeometry, cut: &Cut) {
        let stands = |corner: &Point2| corner.z - tip.z - (corner.x - tip.x).abs() * geometry.slope;
        let surface = self.section.surface();
        // Nothing is as high as the flank beyond that.
        let reach = (surface.top() - tip.z) / geometry.slope;
        let (left, right) = if first.x < tip.x {
            (tip.x - reach, first.x)
        } else {
            (first.x, tip.x + reach)
        };
        let highest = |one: Point2, other: Point2| if stands(&other) > stands(&one) { other } else { one };
        let at = surface.stretch(left, right).fold(first, highest);
        let by = Length::mm(stands(&at));
        let finding = cut.finding(self.program, CutFault::Blocked { at, by });
        note(&mut self.findings.blocked, finding, is_more_blocked);
    }
}
