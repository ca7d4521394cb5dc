//! Normals of the upper side of a surface, smooth across the edges of its triangles.
//!
//! A corner has the mean of the normals of its triangles, each by the angle that it takes up there (Thürmer and Wüthrich: Computing
//! vertex normals from polygonal facets, 1998), all turned upwards. Within a triangle they are interpolated; where the
//! part has an edge, that of the triangle counts in place of the corner's. They only say how a disc is to stand; where it comes to
//! rest, the triangles say.

use crate::mesh::difference;
use crate::surface::Surface;
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::vector::{cross, dot};

/// Normals that differ by more, as the cosine of the angle, are those of an edge that the part has: 4 degrees.
const SHARP: f64 = 0.9976;

/// Triangles whose area is below this part of that of their sides have no normal.
const SLIVER: f64 = 1e-9;

/// The normals at the corners of a surface.
#[derive(Clone, Debug)]
pub struct Normals<'s> {
    surface: &'s Surface,
    corners: Vec<[f64; 3]>,
}

/// The angle at a corner between what leads to two others.
fn angle(u: [f64; 3], v: [f64; 3]) -> f64 {
    let across = cross(u, v);
    libm::atan2(dot(across, across).sqrt(), dot(u, v))
}

/// The normal of a triangle, of length 1. None of a sliver.
fn upwards([a, b, c]: [Point3; 3]) -> Option<[f64; 3]> {
    let (u, v) = (difference(b, a), difference(c, a));
    let normal = cross(u, v);
    let size = dot(normal, normal).sqrt();
    let scale = if normal[2] < 0.0 { -size } else { size };
    let is_sliver = size <= SLIVER * (dot(u, u) * dot(v, v)).sqrt();
    (!is_sliver).then(|| normal.map(|part| part / scale))
}

impl<'s> Normals<'s> {
    /// Looks once at all triangles.
    #[must_use]
    pub fn new(surface: &'s Surface) -> Self {
        let mesh = surface.mesh();
        let mut corners = vec![[0.0; 3]; mesh.corners().len()];
        for (named, face) in mesh.triangles().iter().zip(mesh.faces()) {
            let [a, b, c] = face;
            let (u, v, w) = (difference(b, a), difference(c, a), difference(c, b));
            let Some(normal) = upwards(face) else { continue };
            let back = |vector: [f64; 3]| vector.map(|part| -part);
            let angles = [angle(u, v), angle(back(u), w), angle(back(v), back(w))];
            for (index, angle) in named.iter().zip(angles) {
                if let Some(sum) = corners.get_mut(*index as usize) {
                    for (part, own) in sum.iter_mut().zip(normal) {
                        *part += angle * own;
                    }
                }
            }
        }
        Self { surface, corners }
    }

    /// The surface.
    #[must_use]
    pub const fn surface(&self) -> &'s Surface {
        self.surface
    }

    /// The normal over a place of the plan, in mm, of any length above 0 and upwards. None where no triangle lies, or only ones
    /// that stand upright.
    #[must_use]
    pub fn at(&self, [x, y]: [f64; 2]) -> Option<[f64; 3]> {
        let mut highest: Option<(f64, [f64; 3])> = None;
        let bins = self.surface.bins();
        for &number in bins.triangles(bins.at(x, y)) {
            let Some(shares) = shares(self.surface.triangle(number), [x, y]) else {
                continue;
            };
            let face = self.surface.triangle(number);
            let height: f64 = face
                .iter()
                .zip(shares)
                .map(|(corner, share)| corner.z * share)
                .sum();
            if highest.is_none_or(|(before, _)| height > before) {
                highest = Some((height, self.mixed(number, shares)?));
            }
        }
        highest.map(|(_, normal)| normal).filter(|normal| normal[2] > 0.0)
    }

    fn mixed(&self, number: u32, shares: [f64; 3]) -> Option<[f64; 3]> {
        let named = self.surface.mesh().triangles().get(number as usize)?;
        let own = upwards(self.surface.triangle(number))?;
        let mut sum = [0.0; 3];
        for (index, share) in named.iter().zip(shares) {
            let corner = *self.corners.get(*index as usize)?;
            let along = dot(corner, own) / dot(corner, corner).sqrt();
            let normal = if along >= SHARP { corner } else { own };
            let length = dot(normal, normal).sqrt();
            for (part, more) in sum.iter_mut().zip(normal) {
                *part += share * more / length;
            }
        }
        Some(sum)
    }
}

/// How much each corner of a triangle counts at a place in it, seen from above.
fn shares(face: [Point3; 3], [x, y]: [f64; 2]) -> Option<[f64; 3]> {
    let [a, b, c] = face.map(|p| [p.x - x, p.y - y]);
    let part = |a: [f64; 2], b: [f64; 2]| a[0] * b[1] - a[1] * b[0];
    let parts = [part(b, c), part(c, a), part(a, b)];
    let sum: f64 = parts.iter().sum();
    let shares = parts.map(|part| part / sum);
    // Places on an edge belong to both of its triangles. Comparisons with NaN are false.
    shares.iter().all(|&share| share >= -1e-12).then_some(shares)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testkit::{FIXED, sampled, surface_over};

    #[test]
    fn normals_are_near_those_of_the_smooth_surface() {
        let height = |x: f64, y: f64| 5.0 * libm::sin(x / 20.0) + y * y / 200.0;
        let surface = surface_over(&sampled(100.0, 60.0, [50, 30], &height), FIXED, 100.0, 60.0);
        let normals = Normals::new(&surface);
        for i in 1..20 {
            for j in 1..12 {
                let (x, y) = (4.9 * f64::from(i), 4.9 * f64::from(j));
                let normal = normals.at([x, y]).unwrap();
                let slope = [libm::cos(x / 20.0) / 4.0, y / 100.0];
                for axis in [0, 1] {
                    let found = -normal[axis] / normal[2];
                    assert!((found - slope[axis]).abs() < 0.012, "{x} {y} {found} {slope:?}");
                }
            }
        }
        assert_eq!(normals.at([-1.0, 5.0]), None);
        assert_eq!(normals.at([f64::NAN, 5.0]), None);
    }

    #[test]
    fn edges_of_the_part_stay_sharp() {
        let surface = surface_over(
            &sampled(100.0, 60.0, [10, 6], &|x, _| (x - 50.0).max(0.0) / 5.0),
            FIXED,
            100.0,
            60.0,
        );
        let normals = Normals::new(&surface);
        for (x, slope) in [(49.9, 0.0), (50.1, 0.2)] {
            let normal = normals.at([x, 31.0]).unwrap();
            assert!((normal[0] / normal[2] + slope).abs() < 1e-12);
        }
    }

    #[test]
    fn the_highest_sheet_counts() {
        let mesh = crate::testkit::rectangles([[0.0, 60.0, 1.0], [10.0, 30.0, 5.0]]);
        let surface = surface_over(&mesh, FIXED, 100.0, 60.0);
        let normal = Normals::new(&surface).at([50.0, 20.0]).unwrap();
        assert!(normal[0].abs() < 1e-12 && normal[2] > 0.5);
    }
}
