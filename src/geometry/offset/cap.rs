//! The offset of one segment.

use super::Point2;
use core::f64::consts::FRAC_PI_2;

/// Everything within a radius of a segment, seen from above: a quarter disc or less around the left end, the segment
/// shifted along its normal, a quarter disc or less around the right end.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cap {
    left: Point2,
    right: Point2,
    radius: f64,
    /// Unit normal of the segment that points up.
    normal: Point2,
}

impl Cap {
    /// The cap over a segment whose ends differ in x, left end first.
    pub(super) fn over([left, right]: [Point2; 2], radius: f64) -> Self {
        let length = left.distance(right);
        Self {
            left,
            right,
            radius,
            normal: Point2::new((left.z - right.z) / length, (right.x - left.x) / length),
        }
    }

    /// Right of this x the cap is at least as high as that of the segment before, which it shares a corner with.
    pub(super) fn fully_raised_from(&self) -> f64 {
        self.left.x + self.radius
    }

    /// The height at x; minus infinity where the cap does not reach.
    pub(super) fn height(&self, x: f64) -> f64 {
        let (start, end) = (self.shifted(self.left), self.shifted(self.right));
        if x <= start.x {
            disc_height(self.left, self.radius, x)
        } else if x >= end.x {
            disc_height(self.right, self.radius, x)
        } else {
            // Clamped because the share of a steep segment is rounded roughly.
            let z = start.lerp(end, (x - start.x) / (end.x - start.x)).z;
            z.clamp(start.z.min(end.z), start.z.max(end.z))
        }
    }

    /// The point of the cap at x. Where rounding puts x a trifle beside the cap, it is the rim.
    pub(super) fn at(&self, x: f64) -> Point2 {
        let rim = if x < self.left.x {
            self.left.z
        } else if x > self.right.x {
            self.right.z
        } else {
            self.left.z.min(self.right.z)
        };
        Point2::new(x, self.height(x).max(rim))
    }

    /// Gives the corners of a polyline over the cap from one x to another, without the end: nowhere below the cap and
    /// at most `tolerance` above it along the normal. Where the segment passes into a disc there is no corner: the
    /// tangent polygon around the disc starts on the segment's own line.
    pub(super) fn outline(&self, from: f64, to: f64, tolerance: f64, corner: &mut dyn FnMut(Point2)) {
        let (start, end) = (self.shifted(self.left), self.shifted(self.right));
        corner(self.at(from));
        if from < start.x {
            self.around(self.left, from, to.min(start.x), tolerance, corner);
        }
        if to > end.x {
            self.around(self.right, from.max(end.x), to, tolerance, corner);
        }
    }

    /// Gives the inner corners of a tangent polygon over the disc around an end. It touches the disc at both ends of
    /// the range and in between at equal angles. With `w` the angle between touches its corners are at the distance
    /// `radius / cos(w/2)`, of which the tolerance allows `radius + tolerance`.
    fn around(&self, center: Point2, from: f64, to: f64, tolerance: f64, corner: &mut dyn FnMut(Point2)) {
        // From the vertical, positive to the right.
        let angle = |x: f64| libm::asin(((x - center.x) / self.radius).clamp(-1.0, 1.0));
        let (first, last) = (angle(from), angle(to));
        let spare = tolerance * (2.0 * self.radius + tolerance);
        let widest = (2.0 * libm::atan(spare.sqrt() / self.radius)).min(FRAC_PI_2);
        let pieces = libm::ceil((last - first) / widest).max(1.0);
        let half = (last - first) / pieces / 2.0;
        let reach = self.radius / libm::cos(half);
        // The cast saturates, and the count is bounded: the tolerance is no less than a fixed share of the span.
        for piece in 0..pieces as usize {
            let (sin, cos) = libm::sincos(first + half * (2 * piece + 1) as f64);
            corner(Point2::new(center.x + reach * sin, center.z + reach * cos));
        }
    }

    fn shifted(&self, point: Point2) -> Point2 {
        Point2::new(
            point.x + self.radius * self.normal.x,
            point.z + self.radius * self.normal.z,
        )
    }
}

/// The height of a disc's upper half at x; minus infinity beside it.
fn disc_height(center: Point2, radius: f64, x: f64) -> f64 {
    let aside = x - center.x;
    // As a product, which keeps its digits near the rim.
    let squared = (radius - aside) * (radius + aside);
    if squared < 0.0 {
        f64::NEG_INFINITY
    } else {
        center.z + squared.sqrt()
    }
}
