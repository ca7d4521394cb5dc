//! Round plates: the face of a disc, and both ends of a cylinder on it.

use super::Body;
use super::ceiling::Roofed;
use super::view::{Seen, View, between};
use crate::disc::Axis;
use vcutc_backend_api::geometry::Point3;

/// A plate square to an axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plate {
    view: View,
    radius: f64,
    /// How far its middle lies above the centre of the disc, along z.
    above: f64,
}

impl Plate {
    /// The face of a disc with its centre over a place of the plan.
    pub(super) fn face(radius: f64, place: [f64; 2], axis: Axis) -> Self {
        Self::on(View::new(place, axis), radius, 0.0)
    }

    /// A plate with its middle over the origin of a view.
    pub(super) const fn on(view: View, radius: f64, above: f64) -> Self {
        Self { view, radius, above }
    }
}

impl Body for Plate {
    fn bounds(&self) -> [f64; 4] {
        let [x, y] = self.view.origin;
        let [a, b] = self.view.half_size(self.radius);
        [x - a, y - b, x + a, y + b]
    }

    fn most(&self, bin: Roofed) -> Option<f64> {
        let (origin, heading) = (self.view.origin, self.view.heading);
        let [dx, dy] = [bin.middle[0] - origin[0], bin.middle[1] - origin[1]];
        // No place of the bin is nearer to the middle of the plate than that.
        let (near_x, near_y) = (
            (dx.abs() - bin.half[0]).max(0.0),
            (dy.abs() - bin.half[1]).max(0.0),
        );
        if near_x * near_x + near_y * near_y > self.radius * self.radius {
            return None;
        }
        let tangent = self.view.sine / self.view.cosine;
        let rise: [f64; 2] = core::array::from_fn(|axis| bin.slope[axis] + tangent * heading[axis]);
        let middle = bin.height + tangent * (dx * heading[0] + dy * heading[1]);
        let within_bin = middle + bin.half[0] * rise[0].abs() + bin.half[1] * rise[1].abs();
        // The same plane over all of the plate, for bins that are larger.
        let steepness = (rise[0] * rise[0] + rise[1] * rise[1]).sqrt();
        let within_plate = bin.height - bin.slope[0] * dx - bin.slope[1] * dy + self.radius * steepness;
        Some(within_bin.min(within_plate) - self.above)
    }

    fn clear(&self, face: [Point3; 3], above: f64) -> Option<(f64, Point3)> {
        let seen = face.map(|corner| self.view.see(corner));
        let highest = top(seen, self.radius, above + self.above)?;
        Some((highest[2] - self.above, self.view.point(highest)))
    }
}

/// The highest point of a triangle over the circle about the origin, if it lies above a height.
pub(super) fn top(seen: [Seen; 3], radius: f64, above: f64) -> Option<Seen> {
    // Most triangles go here.
    if seen.iter().all(|corner| corner[2] <= above) {
        return None;
    }
    for axis in [0, 1] {
        if seen.iter().all(|corner| corner[axis] > radius) || seen.iter().all(|corner| corner[axis] < -radius)
        {
            return None;
        }
    }
    let mut best: Option<Seen> = None;
    let mut offer = |point: Seen| {
        if point[2] > best.map_or(above, |before| before[2]) {
            best = Some(point);
        }
    };
    let mut is_within = true;
    for corner in seen {
        let is_in = corner[0] * corner[0] + corner[1] * corner[1] <= radius * radius;
        is_within &= is_in;
        if is_in {
            offer(corner);
        }
    }
    if is_within {
        return best;
    }
    let [a, b, c] = seen;
    for (from, to) in [(a, b), (b, c), (a, c)] {
        for share in crossings(from, to, radius).into_iter().flatten() {
            offer(between(from, to, share));
        }
    }
    if let Some(point) = touching(seen, radius) {
        offer(point);
    }
    best
}

/// Where a side meets a circle about the origin, as shares of its length.
fn crossings(from: Seen, to: Seen, radius: f64) -> [Option<f64>; 2] {
    let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
    let squared = dx * dx + dy * dy;
    if squared == 0.0 {
        return [None; 2];
    }
    // The distance of its line from the middle, which stays precise for long sides.
    let twice_area = from[0] * dy - from[1] * dx;
    let half = radius * radius - twice_area * twice_area / squared;
    if half < 0.0 {
        return [None; 2];
    }
    let middle = -(from[0] * dx + from[1] * dy) / squared;
    let half = (half / squared).sqrt();
    [middle - half, middle + half].map(|share| (0.0..=1.0).contains(&share).then_some(share))
}

/// Where the rim touches the facet: at the rim's point in the direction in which the facet rises, if that is on it.
fn touching([a, b, c]: [Seen; 3], radius: f64) -> Option<Seen> {
    let (ux, uy, uz) = (b[0] - a[0], b[1] - a[1], b[2] - a[2]);
    let (vx, vy, vz) = (c[0] - a[0], c[1] - a[1], c[2] - a[2]);
    let area = ux * vy - uy * vx;
    if area == 0.0 {
        return None;
    }
    let (gx, gy) = ((uz * vy - uy * vz) / area, (ux * vz - uz * vx) / area);
    let steepness = (gx * gx + gy * gy).sqrt();
    // All of the rim touches a level facet.
    let [x, y] = if steepness > 0.0 {
        [radius * gx / steepness, radius * gy / steepness]
    } else {
        [radius, 0.0]
    };
    let (px, py) = (x - a[0], y - a[1]);
    let (s, t) = ((px * vy - py * vx) / area, (ux * py - uy * px) / area);
    // Comparisons with NaN are false.
    (s >= 0.0 && t >= 0.0 && s + t <= 1.0).then(|| [x, y, a[2] + s * uz + t * vz])
}
