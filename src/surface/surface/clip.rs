//! Convex polygons in space, clipped by planes `x = c` and `y = c`.
//!
//! Where an edge meets a plane is computed from its lesser end on, so that the two triangles of an edge get the same point.

use core::cmp::Ordering;
use vcutc_backend_api::geometry::Point3;

type Corners = Vec<Point3>;

/// The coordinate that a plane fixes.
#[derive(Clone, Copy, Debug)]
enum Axis {
    X,
    Y,
}

impl Axis {
    const fn of(self, point: Point3) -> f64 {
        match self {
            Self::X => point.x,
            Self::Y => point.y,
        }
    }
}

/// The side of a plane that is kept.
#[derive(Clone, Copy, Debug)]
enum Keep {
    From,
    UpTo,
}

/// The part of a polygon over the rectangle between two corners, the lesser one first.
pub(crate) fn clipped(polygon: &[Point3], low: [f64; 2], high: [f64; 2]) -> Corners {
    let mut polygon = half(polygon, Axis::X, low[0], Keep::From);
    for (axis, at, keep) in [
        (Axis::X, high[0], Keep::UpTo),
        (Axis::Y, low[1], Keep::From),
        (Axis::Y, high[1], Keep::UpTo),
    ] {
        polygon = half(&polygon, axis, at, keep);
    }
    polygon
}

fn half(polygon: &[Point3], axis: Axis, at: f64, keep: Keep) -> Corners {
    let inside = |point: Point3| match keep {
        Keep::From => axis.of(point) >= at,
        Keep::UpTo => axis.of(point) <= at,
    };
    let mut out = Vec::with_capacity(polygon.len() + 1);
    let Some(mut last) = polygon.last().copied() else {
        return out;
    };
    for &point in polygon {
        if inside(point) != inside(last) {
            out.push(crossing(last, point, axis, at));
        }
        if inside(point) {
            out.push(point);
        }
        last = point;
    }
    out
}

/// Where an edge meets a plane that its ends lie on either side of.
fn crossing(a: Point3, b: Point3, axis: Axis, at: f64) -> Point3 {
    let (a, b) = if order(a, b).is_le() { (a, b) } else { (b, a) };
    let share = ((at - axis.of(a)) / (axis.of(b) - axis.of(a))).clamp(0.0, 1.0);
    let between = |from: f64, to: f64| (from + (to - from) * share).clamp(from.min(to), from.max(to));
    let mut point = Point3::new(between(a.x, b.x), between(a.y, b.y), between(a.z, b.z));
    match axis {
        Axis::X => point.x = at,
        Axis::Y => point.y = at,
    }
    point
}

/// The order of points by x, then y, then z.
pub(super) fn order(a: Point3, b: Point3) -> Ordering {
    a.x.total_cmp(&b.x)
        .then(a.y.total_cmp(&b.y))
        .then(a.z.total_cmp(&b.z))
}
