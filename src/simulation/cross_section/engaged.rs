//! How much of the edge of a disc is in the material.

use super::CrossSection;
use crate::rim::Rim;
use vcutc_backend_api::units::Length;
use vcutc_geometry::curve::Point2;

impl CrossSection {
    /// How much of the edge of a disc of this radius, which shows as this rim, is in the material at most on a pass along y: all that
    /// lies below the surface as it is before the pass.
    ///
    /// The half of the edge that shows as the lower half of the ellipse leads; the other half follows through what that has cut. What an
    /// earlier rim has cut below material that stands counts as solid, and floors are chords above their rims: never too little.
    pub fn engaged(&mut self, rim: &Rim, radius: Length) -> Length {
        let [left, right] = rim.cover();
        let (left, right) = (left.max(0.0), right.min(self.surface.width()));
        if left >= right {
            return Length::ZERO;
        }
        let mut before: Option<Point2> = None;
        let mut turned = 0.0;
        for corner in self.surface.stretch(left, right) {
            let above = before.and_then(|from| rim.above(from, corner, 0.0));
            turned += above.map_or(0.0, |above| rim.turned([above.from, above.to]).to_rad());
            before = Some(corner);
        }
        radius * turned
    }
}
