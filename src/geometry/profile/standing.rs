//! How high a machined contour stands above a profile.

use super::{Point2, Profile, height_between};

impl Profile {
    /// How high a contour from left to right stands straight above this profile, over its span: a polyline with x across and the height
    /// as z, in mm. Where the contour steps, so does this. Between corners both are straight, and so is the
    /// difference.
    #[must_use]
    pub fn standing(&self, contour: &[Point2]) -> Vec<Point2> {
        let (from, to) = self.span();
        let mut standing = Vec::with_capacity(contour.len() + self.points().len());
        let mut own = self.points().iter().copied().peekable();
        for pair in contour.windows(2) {
            let [left, right] = pair else { continue };
            let mut push = |x: f64| {
                let z = height_between(*left, *right, x) - self.height(x);
                standing.push(Point2::new(x, z));
            };
            let (begin, end) = (left.x.max(from), right.x.min(to));
            if begin > end || (begin == end && left.x < right.x) {
                continue;
            }
            if left.x == right.x {
                // A wall: its lower and its upper end.
                let height = self.height(begin);
                standing.extend([left, right].map(|corner| Point2::new(begin, corner.z - height)));
                continue;
            }
            push(begin);
            while let Some(corner) = own.next_if(|corner| corner.x < end) {
                if corner.x > begin {
                    push(corner.x);
                }
            }
            push(end);
        }
        standing.dedup();
        standing
    }
}
