//! Triangles cut by planes `y = c`.

use vcutc_backend_api::geometry::Point3;
use vcutc_geometry::curve::Point2;

/// What a plane `y = c` has in common with a triangle of a surface, as segments in x-z: one where it passes through, the
/// sides of a triangle that lies in the plane. A corner that only touches is a segment without length.
///
/// Where an edge meets the plane is computed from its lesser end on (edges of a surface know it by the order of their
/// corners), so that neighbours get the same point.
pub(crate) fn cut(face: [Point3; 3], y: f64, out: &mut Vec<[Point2; 2]>) {
    let [a, b, c] = face;
    if face.iter().all(|p| p.y == y) {
        out.extend([[flat(a), flat(b)], [flat(b), flat(c)], [flat(a), flat(c)]]);
        return;
    }
    let mut met: Option<[Point2; 2]> = None;
    let mut add = |point: Point2| {
        met = Some(match met {
            None => [point; 2],
            Some([low, high]) => [lesser(low, point), greater(high, point)],
        });
    };
    for [from, to] in [[a, b], [b, c], [a, c]] {
        if from.y == y {
            add(flat(from));
        }
        if to.y == y {
            add(flat(to));
        }
        if (from.y < y && y < to.y) || (to.y < y && y < from.y) {
            add(line(from, to, y));
        }
    }
    out.extend(met);
}

/// Where the edge between two points passes a plane `y = c` between them.
fn line(a: Point3, b: Point3, y: f64) -> Point2 {
    let (a, b) = if super::clip::order(a, b).is_le() {
        (a, b)
    } else {
        (b, a)
    };
    let share = ((y - a.y) / (b.y - a.y)).clamp(0.0, 1.0);
    let between = |from: f64, to: f64| (from + (to - from) * share).clamp(from.min(to), from.max(to));
    Point2::new(between(a.x, b.x), between(a.z, b.z))
}

const fn flat(point: Point3) -> Point2 {
    Point2::new(point.x, point.z)
}

fn is_before(a: Point2, b: Point2) -> bool {
    a.x < b.x || (a.x == b.x && a.z < b.z)
}

fn lesser(a: Point2, b: Point2) -> Point2 {
    if is_before(b, a) { b } else { a }
}

fn greater(a: Point2, b: Point2) -> Point2 {
    if is_before(a, b) { b } else { a }
}
