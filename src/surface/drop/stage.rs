//! Cylinders about the axis of a disc.
//!
//! From below one sees the lower end of a cylinder and, if it leans, half of its side. Seen from above the middle of the lower
//! end, the side is half of a circle that moves along the heading and rises: over `(p, q)` it stands `(p - w)/sin(tau)` above
//! the plate, with `w = sqrt(r^2 - q^2)`, and `(p - w)/tan(tau)` along the axis. What a facet asks for there is a concave function
//! of `(p, q)` and linear along p, so that it is greatest on a side of the triangle or at an end of the cylinder. Along a side of
//! a triangle it is greatest at an end, or at the one place where its derivative is 0. The ends of the cylinder are plates. The upper
//! one is part of the body, so what it asks for is right too.

use super::Body;
use super::ceiling::Roofed;
use super::plate::{Plate, top};
use super::view::{Seen, View, between};
use crate::disc::{Axis, Stage};
use vcutc_backend_api::geometry::Point3;

/// Of an axis that leans by less, as a sine, the side counts as upright: it lies within this part of its length of that.
const UPRIGHT: f64 = 1e-7;

/// A cylinder in its place.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cylinder {
    lower: Plate,
    upper: Plate,
    /// From above the middle of the lower end.
    view: View,
    radius: f64,
    /// Along the axis.
    length: f64,
    /// How far the middle of the lower end lies above the centre of the disc, along z.
    above: f64,
}

impl Cylinder {
    /// A stage of a disc with its centre over a place of the plan.
    pub(super) fn new(stage: Stage, place: [f64; 2], axis: Axis) -> Self {
        let (from, length) = (stage.from.to_mm(), stage.to.to_mm() - stage.from.to_mm());
        let [x, y, rise] = axis.to_array();
        let view = View::new([place[0] + from * x, place[1] + from * y], axis);
        Self::on(view, stage.radius.to_mm(), length, from * rise)
    }

    fn on(view: View, radius: f64, length: f64, above: f64) -> Self {
        let flat = length * view.sine;
        let origin = [0, 1].map(|axis| view.origin[axis] + flat * view.heading[axis]);
        Self {
            lower: Plate::on(view, radius, above),
            upper: Plate::on(View { origin, ..view }, radius, above + length * view.cosine),
            view,
            radius,
            length,
            above,
        }
    }

    /// Without what stands higher than the surface once the centre stands at a height or above it.
    pub(super) fn below(self, highest: f64, height: f64) -> Self {
        let lowest = height + self.above - self.radius * self.view.sine;
        // Without a height this is infinite.
        let enough = ((highest - lowest) / self.view.cosine).max(0.0);
        Self::on(self.view, self.radius, self.length.min(enough), self.above)
    }

    /// The height of the centre at which the side touches a point that is seen so; none if no part of the side is over it.
    fn side(&self, [p, q, z]: Seen) -> Option<f64> {
        let w = self.radius * self.radius - q * q;
        if w < 0.0 {
            return None;
        }
        let risen = (p - w.sqrt()) / self.view.sine;
        let is_there = (0.0..=self.length).contains(&(risen * self.view.cosine));
        is_there.then_some(z - risen - self.above)
    }

    /// Where on a side of a triangle, without its ends, what it asks for is greatest.
    fn greatest(&self, from: Seen, to: Seen) -> Option<Seen> {
        let sine = self.view.sine;
        let across = to[1] - from[1];
        // Of `slope q + w/sin(tau)` over q.
        let slope = sine * (to[2] - from[2] - (to[0] - from[0]) / sine) / across;
        let q = self.radius * slope / (slope * slope + 1.0).sqrt();
        let share = (q - from[1]) / across;
        // False for NaN, which a side along the heading gives.
        (0.0..=1.0).contains(&share).then(|| between(from, to, share))
    }
}

impl Body for Cylinder {
    fn bounds(&self) -> [f64; 4] {
        let [a, b] = [self.lower.bounds(), self.upper.bounds()];
        [a[0].min(b[0]), a[1].min(b[1]), a[2].max(b[2]), a[3].max(b[3])]
    }

    fn most(&self, bin: Roofed) -> Option<f64> {
        let View { sine, cosine, .. } = self.view;
        let ([near, far], [right, left]) = self.view.ranges(bin.middle, bin.half);
        if right > self.radius || left < -self.radius {
            return None;
        }
        let crest = self.radius * cosine;
        let lifted = if far <= crest || sine < UPRIGHT {
            far.min(crest) * sine / cosine
        } else if near <= crest {
            self.radius * sine
        } else {
            // The side rises from the lowest place of the rim.
            self.radius * sine - (near - crest) * cosine / sine
        };
        Some(bin.top() + lifted - self.above)
    }

    fn clear(&self, face: [Point3; 3], above: f64) -> Option<(f64, Point3)> {
        let mut best: Option<(f64, Point3)> = None;
        let mut offer = |found: (f64, Point3)| {
            if found.0 > best.map_or(above, |(before, _)| before) {
                best = Some(found);
            }
        };
        let seen = face.map(|corner| self.view.see(corner));
        if let Some(point) = top(seen, self.radius, above + self.above) {
            offer((point[2] - self.above, self.view.point(point)));
        }
        if self.view.sine < UPRIGHT {
            return best;
        }
        if let Some(found) = self.upper.clear(face, above) {
            offer(found);
        }
        let [a, b, c] = seen;
        for (from, to) in [(a, b), (b, c), (c, a)] {
            for point in [Some(from), self.greatest(from, to)].into_iter().flatten() {
                if let Some(height) = self.side(point) {
                    offer((height, self.view.point(point)));
                }
            }
        }
        best
    }
}
