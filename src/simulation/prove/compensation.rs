//! How far tips are offset from what they are to cut, against what forces do to the blade.

use super::flank::FlankGeometry;
use super::{Cut, Player};
use core::num::NonZeroU32;
use std::collections::BTreeMap;
use vcutc_geometry::curve::Point2;

/// How far the tips of an operation are offset, V by V.
///
/// A V of the program runs with its tip at the planned place and this offset. Under the forces that the offset was made for, the blade
/// yields back by it, and cuts what was planned.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Compensation {
    offsets: BTreeMap<VNumber, Point2>,
}

/// Which V of an operation: its layer, and its cut in that.
pub type VNumber = (NonZeroU32, NonZeroU32);

impl Compensation {
    /// Of offsets across the cuts, in mm. Vs that are not among them keep their places.
    #[must_use]
    pub const fn new(offsets: BTreeMap<VNumber, Point2>) -> Self {
        Self { offsets }
    }

    /// The offset of a V, in mm.
    #[must_use]
    pub fn offset(&self, vee: VNumber) -> Point2 {
        self.offsets
            .get(&vee)
            .copied()
            .unwrap_or(Point2 { x: 0.0, z: 0.0 })
    }

    /// The V that is offset farthest, and how far, in mm; the first among equals. None where no V is.
    #[must_use]
    pub fn largest(&self) -> Option<(VNumber, f64)> {
        let sizes = self.offsets.iter();
        let sizes = sizes.map(|(vee, offset)| (*vee, libm::hypot(offset.x, offset.z)));
        let largest = sizes.reduce(|best, next| if next.1 > best.1 { next } else { best });
        largest.filter(|(_, size)| *size > 0.0)
    }
}

impl Cut {
    /// The same with its tip where the blade is under the forces that it is compensated for.
    fn moved_back(mut self, compensation: &Compensation) -> Self {
        let offset = compensation.offset((self.layer, self.cut));
        self.tip.x -= offset.x;
        self.tip.z -= offset.z;
        self
    }
}

impl Player<'_> {
    /// A cut where it is to be replayed.
    pub(super) fn under_load(&self, cut: Cut) -> Cut {
        let bound = self.bounds.get(usize::from(cut.operation.0));
        match bound.and_then(|bound| bound.compensation) {
            Some(compensation) => cut.moved_back(compensation),
            None => cut,
        }
    }

    /// How high a flank is whose tip is offset, at most, in mm: under load it lies where it was planned, but begins lower.
    pub(super) fn edge_under_load(&mut self, cut: &Cut, geometry: FlankGeometry, lower: f64) -> f64 {
        let surface = self.section.surface();
        let run = surface.flank_from(cut.tip, cut.side(), geometry.slope);
        run.map_or(0.0, |run| run.reach + lower)
    }
}
