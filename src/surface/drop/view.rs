//! Coordinates in which a leaning plate is level and round.

use crate::disc::Axis;
use vcutc_backend_api::geometry::Point3;

/// `(p / cos tau, q, z + tan(tau) p)` with p along the heading of an axis and q to the left of it, from a place of the plan.
#[derive(Clone, Copy, Debug)]
pub(super) struct View {
    pub(super) origin: [f64; 2],
    pub(super) heading: [f64; 2],
    pub(super) sine: f64,
    pub(super) cosine: f64,
}

/// A point in a view.
pub(super) type Seen = [f64; 3];

impl View {
    /// Seen from a place of the plan.
    pub(super) fn new(origin: [f64; 2], axis: Axis) -> Self {
        let [x, y, cosine] = axis.to_array();
        let sine = (x * x + y * y).sqrt();
        let heading = if sine > 0.0 {
            [x / sine, y / sine]
        } else {
            [1.0, 0.0]
        };
        Self {
            origin,
            heading,
            sine,
            cosine,
        }
    }

    pub(super) fn see(&self, point: Point3) -> Seen {
        let [x, y] = [point.x - self.origin[0], point.y - self.origin[1]];
        let [along, across] = self.heading;
        let p = (x * along + y * across) / self.cosine;
        [p, y * along - x * across, point.z + self.sine * p]
    }

    /// The point that is seen so.
    pub(super) fn point(&self, [p, q, z]: Seen) -> Point3 {
        let [along, across] = self.heading;
        let flat = p * self.cosine;
        Point3::new(
            self.origin[0] + flat * along - q * across,
            self.origin[1] + flat * across + q * along,
            z - self.sine * p,
        )
    }

    /// The least and the greatest distance of a rectangle along the heading, in plan, and across it. The rectangle is given
    /// by its middle and half its size.
    pub(super) fn ranges(&self, middle: [f64; 2], half: [f64; 2]) -> ([f64; 2], [f64; 2]) {
        let [x, y] = [middle[0] - self.origin[0], middle[1] - self.origin[1]];
        let [along, across] = self.heading;
        let (p, q) = (x * along + y * across, y * along - x * across);
        let [a, b] = [along.abs(), across.abs()];
        let (u, v) = (half[0] * a + half[1] * b, half[1] * a + half[0] * b);
        ([p - u, p + u], [q - v, q + v])
    }

    /// Half the size in plan, along x and y, of a round plate.
    pub(super) fn half_size(&self, radius: f64) -> [f64; 2] {
        // The part of the axis along a direction is what its plate lacks there.
        self.heading.map(|part| {
            let lean = part * self.sine;
            radius * (1.0 - lean * lean).max(0.0).sqrt()
        })
    }
}

/// The point at a share of the way.
pub(super) fn between(a: Seen, b: Seen, share: f64) -> Seen {
    core::array::from_fn(|i| a[i] + (b[i] - a[i]) * share)
}
