//! The highest and the lowest place of the upper side.

use crate::coverage::Tangled;
use crate::surface::Surface;
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::units::Length;

impl Surface {
    /// Its highest corner.
    #[must_use]
    pub fn highest(&self) -> Option<Point3> {
        let corners = self.mesh().corners().iter().copied();
        corners.max_by(|a, b| a.z.total_cmp(&b.z))
    }

    /// The lowest place of the upper side if it lies below a height; what lies under other triangles does not count.
    ///
    /// # Errors
    /// If triangles lie over each other in such numbers that this takes too long.
    pub fn lowest_below(&self, height: Length) -> Result<Option<Point3>, Tangled> {
        let mut least = height.to_mm();
        let mut found = None;
        let mut looks = 0;
        let mut parts = Vec::new();
        for cell in self.bins().all() {
            let numbers = self.bins().triangles(cell).iter();
            let reaches_below = |&number: &u32| self.triangle(number).iter().any(|corner| corner.z < least);
            if !numbers.into_iter().any(reaches_below) {
                continue;
            }
            self.visible(cell, &mut looks, &mut parts)?;
            for part in &parts {
                for &[x, y] in &part.region {
                    let z = part.plane.at([x, y]);
                    if z < least {
                        least = z;
                        found = Some(Point3::new(x, y, z));
                    }
                }
            }
        }
        Ok(found)
    }
}

#[cfg(test)]
mod tests {
    use crate::mesh::Mesh;
    use crate::surface::{Accuracy, Plan, Surface};
    use vcutc_backend_api::geometry::Point3;
    use vcutc_backend_api::units::Length;

    fn surface(faces: &[[[f64; 3]; 3]]) -> Surface {
        let corners = faces
            .iter()
            .flatten()
            .map(|&corner| Point3::from(corner))
            .collect();
        let triangles = (0..faces.len() as u32).map(|face| [3 * face, 3 * face + 1, 3 * face + 2]);
        let plan = Plan {
            width: Length::mm(10.0),
            depth: Length::mm(10.0),
        };
        let accuracy = Accuracy {
            tolerance: Length::ZERO,
            weld: Length::mm(0.01),
        };
        let surface = Surface::of(corners, triangles.collect(), plan, accuracy).unwrap();
        assert_eq!(Mesh::triangles(surface.mesh()).len(), faces.len());
        surface
    }

    const FLOOR: [[[f64; 3]; 3]; 2] = [
        [[0.0, 0.0, -5.0], [10.0, 0.0, -5.0], [10.0, 10.0, -5.0]],
        [[0.0, 0.0, -5.0], [10.0, 10.0, -5.0], [0.0, 10.0, -5.0]],
    ];

    #[test]
    fn a_floor_counts_where_it_is_seen() {
        let roof = |low: f64| {
            [
                [[0.0, 0.0, 2.0], [10.0, 0.0, 2.0], [10.0, 10.0, low]],
                [[0.0, 0.0, 2.0], [10.0, 10.0, low], [0.0, 10.0, 3.0]],
            ]
        };
        let both = |low: f64| surface(&[roof(low), FLOOR].concat());
        assert_eq!(both(4.0).lowest_below(Length::ZERO), Ok(None));
        assert_eq!(both(4.0).highest().map(|place| place.z), Some(4.0));
        // The roof goes through the floor at one corner.
        let lowest = both(-6.0).lowest_below(Length::ZERO).unwrap().unwrap();
        assert!((lowest.z + 5.0).abs() < 1e-9, "{lowest:?}");
        let alone = surface(&roof(-6.0)).lowest_below(Length::ZERO).unwrap().unwrap();
        assert!(
            (alone.z + 6.0).abs() < 1e-9 && (alone.x - 10.0).abs() < 1e-6,
            "{alone:?}"
        );
        assert_eq!(surface(&roof(-6.0)).lowest_below(Length::mm(-7.0)), Ok(None));
    }
}
