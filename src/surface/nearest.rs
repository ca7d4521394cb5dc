//! The distance of a point from a surface.

use crate::mesh::difference;
use crate::surface::{Cell, Surface};
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::vector::dot;

impl Surface {
    /// The distance of a point in mm from the nearest triangle, in mm.
    ///
    /// `looks` counts the triangles that were looked at. Bins are looked at in rings about the point's own, until a ring is
    /// farther away in plan than the nearest triangle so far.
    #[must_use]
    pub(crate) fn distance(&self, point: Point3, looks: &mut usize) -> f64 {
        let bins = self.bins();
        let centre = bins.at(point.x, point.y);
        let mut least = f64::INFINITY;
        for ring in 0..bins.columns().max(bins.rows()) {
            let mut is_near = false;
            for cell in around(centre, ring) {
                if cell.column >= bins.columns() || cell.row >= bins.rows() {
                    continue;
                }
                let [low, high] = bins.bounds(cell);
                let dx = (low[0] - point.x).max(point.x - high[0]).max(0.0);
                let dy = (low[1] - point.y).max(point.y - high[1]).max(0.0);
                let flat = dx * dx + dy * dy;
                is_near |= flat < least;
                let [bottom, top] = bins.heights(cell);
                let dz = (bottom - point.z).max(point.z - top).max(0.0);
                if flat + dz * dz < least {
                    *looks += bins.triangles(cell).len();
                    for &number in bins.triangles(cell) {
                        let offset = difference(point, closest(self.triangle(number), point));
                        least = least.min(dot(offset, offset));
                    }
                }
            }
            if !is_near && least < f64::INFINITY {
                break;
            }
        }
        least.sqrt()
    }
}

/// The bins of a ring; those beyond the plan have numbers that no bin has.
fn around(centre: Cell, ring: usize) -> impl Iterator<Item = Cell> {
    let step = move |from: usize, by: usize| from.wrapping_add(by).wrapping_sub(ring);
    let side = 2 * ring;
    (0..=side).flat_map(move |i| {
        let is_end = i == 0 || i == side;
        // Whole rows at both ends, two bins of each row between them.
        let stride = if is_end || ring == 0 { 1 } else { side };
        (0..=side).step_by(stride).map(move |j| Cell {
            row: step(centre.row, i),
            column: step(centre.column, j),
        })
    })
}

/// The point of a triangle nearest to another one (Ericson: Real-Time Collision Detection, 2005, section 5.1.5).
fn closest([a, b, c]: [Point3; 3], p: Point3) -> Point3 {
    let (ab, ac, ap) = (difference(b, a), difference(c, a), difference(p, a));
    let along = |from: Point3, way: [f64; 3], share: f64| {
        Point3::new(
            from.x + way[0] * share,
            from.y + way[1] * share,
            from.z + way[2] * share,
        )
    };
    let (d1, d2) = (dot(ab, ap), dot(ac, ap));
    if d1 <= 0.0 && d2 <= 0.0 {
        return a;
    }
    let bp = difference(p, b);
    let (d3, d4) = (dot(ab, bp), dot(ac, bp));
    if d3 >= 0.0 && d4 <= d3 {
        return b;
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return along(a, ab, d1 / (d1 - d3));
    }
    let cp = difference(p, c);
    let (d5, d6) = (dot(ab, cp), dot(ac, cp));
    if d6 >= 0.0 && d5 <= d6 {
        return c;
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return along(a, ac, d2 / (d2 - d6));
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0 {
        return along(b, difference(c, b), (d4 - d3) / ((d4 - d3) + (d5 - d6)));
    }
    let whole = va + vb + vc;
    along(along(a, ab, vb / whole), ac, vc / whole)
}
