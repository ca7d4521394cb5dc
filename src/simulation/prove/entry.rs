//! How deep what cuts leave lies in the part.

use vcutc_geometry::curve::Point2;
use vcutc_geometry::profile::Profile;

/// A part cut off at the stock's top: where the allowance would stand above it there is nothing to keep.
#[must_use]
pub fn below_top(part: &Profile, top: f64) -> Vec<Point2> {
    let points = part.points();
    let mut clipped = Vec::with_capacity(points.len());
    let mut before: Option<Point2> = None;
    for &point in points {
        if let Some(from) = before
            && (from.z - top) * (point.z - top) < 0.0
        {
            let share = (top - from.z) / (point.z - from.z);
            clipped.push(Point2 {
                x: from.x + (point.x - from.x) * share,
                z: top,
            });
        }
        clipped.push(Point2 {
            z: point.z.min(top),
            ..point
        });
        before = Some(point);
    }
    clipped
}

/// Where a surface comes lowest relative to a part, and by how much it stays above it there (negative: within).
/// Both are straight between their corners, so the lowest point lies over a corner of one of them.
pub(super) fn deepest_entry(corners: &[Point2], part: &[Point2]) -> (Point2, f64) {
    let mut deepest = (Point2 { x: 0.0, z: 0.0 }, f64::INFINITY);
    let mut look = |x: f64, surface: f64, part: f64| {
        if surface - part < deepest.1 {
            deepest = (Point2 { x, z: surface }, surface - part);
        }
    };
    merge_heights(corners, part, &mut look);
    deepest
}

/// Visits every x at which one of two polylines over the same span has a corner, with both heights there. A wall, two corners
/// at one x, is visited at both of its heights, the one left of it first.
pub(crate) fn merge_heights(a: &[Point2], b: &[Point2], visit: &mut impl FnMut(f64, f64, f64)) {
    let (mut i, mut j) = (0, 0);
    while let (Some(&p), Some(&q)) = (a.get(i), b.get(j)) {
        let x = p.x.min(q.x);
        visit(x, height_before(a, i, x), height_before(b, j, x));
        i += usize::from(p.x <= x);
        j += usize::from(q.x <= x);
    }
}

/// Height at x, which lies between corner `next - 1` and corner `next`.
fn height_before(corners: &[Point2], next: usize, x: f64) -> f64 {
    let Some(&to) = corners.get(next) else {
        return corners.last().map_or(0.0, |last| last.z);
    };
    match next.checked_sub(1).and_then(|before| corners.get(before)) {
        Some(&from) if to.x > from.x => from.z + (to.z - from.z) * ((x - from.x) / (to.x - from.x)),
        Some(_) | None => to.z,
    }
}
