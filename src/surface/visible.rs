//! The upper side of a surface, bin by bin: which part of each triangle no other one lies over.
//!
//! Within a bin, what another triangle covers of a triangle from above is convex: the other one's sides, and the line in
//! which both planes meet. These parts are taken off one after the other. The line is computed alike from both, so that what
//! one loses the other one keeps.

use crate::coverage::Tangled;
use crate::mesh::difference;
use crate::region::{Half, Region, SLACK, middle, rectangle, sides, subtract, width, within};
use crate::surface::{Cell, Surface};
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::units::Length;
use vcutc_backend_api::vector::cross;

/// Polygons that are looked at before a surface counts as too tangled.
const MOST_LOOKS: usize = 100_000_000;

/// Narrower strips, in mm, are rounding: neighbours that touch, and bins that a triangle only touches.
const THINNEST: f64 = 4.0 * SLACK;

/// A height over a place, relative to a place of reference: `z + gx dx + gy dy`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Plane {
    origin: [f64; 2],
    height: f64,
    slope: [f64; 2],
    /// The heights that the triangle reaches.
    range: [f64; 2],
}

impl Plane {
    fn of(face: [Point3; 3], origin: [f64; 2]) -> Self {
        let [a, b, c] = face;
        let normal = cross(difference(b, a), difference(c, a));
        let slope = [-normal[0] / normal[2], -normal[1] / normal[2]];
        let height = a.z + slope[0] * (origin[0] - a.x) + slope[1] * (origin[1] - a.y);
        Self {
            origin,
            height,
            slope,
            range: [a.z.min(b.z).min(c.z), a.z.max(b.z).max(c.z)],
        }
    }

    /// The height over a place of the triangle.
    pub(crate) fn at(self, [x, y]: [f64; 2]) -> f64 {
        let height =
            self.height + self.slope[0] * (x - self.origin[0]) + self.slope[1] * (y - self.origin[1]);
        height.clamp(self.range[0], self.range[1])
    }

    /// How it rises along x and along y.
    pub(crate) const fn slope(self) -> [f64; 2] {
        self.slope
    }

    /// Where it is higher than another one over the same place of reference.
    fn above(self, other: Self) -> Above {
        let slope = [self.slope[0] - other.slope[0], self.slope[1] - other.slope[1]];
        let height = self.height - other.height;
        let steepness = (slope[0] * slope[0] + slope[1] * slope[1]).sqrt();
        if steepness < 1e-12 {
            return if height > 0.0 {
                Above::Everywhere
            } else if height < 0.0 {
                Above::Nowhere
            } else {
                Above::Same
            };
        }
        let normal = [-slope[0] / steepness, -slope[1] / steepness];
        let at_origin = normal[0] * self.origin[0] + normal[1] * self.origin[1];
        Above::Within(Half::new(normal, at_origin + height / steepness))
    }
}

/// Where one plane is above another.
enum Above {
    Everywhere,
    Nowhere,
    Same,
    Within(Half),
}

/// A part of a triangle that no other one lies over.
#[derive(Clone, Debug)]
pub(crate) struct Part {
    pub(crate) region: Region,
    pub(crate) plane: Plane,
    /// Whether something was taken off.
    pub(crate) is_cut: bool,
}

impl Surface {
    /// The parts of the upper side in a bin.
    ///
    /// # Errors
    /// If there is too much work: `looks` counts it.
    pub(crate) fn visible(&self, cell: Cell, looks: &mut usize, out: &mut Vec<Part>) -> Result<(), Tangled> {
        out.clear();
        let bin = rectangle(self.bins().bounds(cell));
        let centre = middle(&bin);
        let mut faces: Vec<(Region, [Half; 3], Plane)> = self
            .bins()
            .triangles(cell)
            .iter()
            .filter_map(|&number| {
                let face = self.triangle(number);
                let sides = sides(face)?;
                let region = sides
                    .iter()
                    .fold(bin.clone(), |region, &side| within(&region, side));
                (width(&region) > THINNEST).then(|| (region, sides, Plane::of(face, centre)))
            })
            .collect();
        // Those that reach highest first: they hide most. Stable, so that equal ones keep their order.
        faces.sort_by(|(_, _, a), (_, _, b)| b.range[1].total_cmp(&a.range[1]));
        for (place, (region, _, plane)) in faces.iter().enumerate() {
            let mut left = vec![region.clone()];
            let mut is_cut = false;
            for (other, (_, sides, higher)) in faces.iter().enumerate() {
                if left.is_empty() || higher.range[1] < plane.range[0] {
                    break;
                }
                *looks += left.len();
                if *looks > MOST_LOOKS {
                    return Err(Tangled {
                        place: centre.map(Length::mm),
                    });
                }
                if other == place {
                    continue;
                }
                let [a, b, c] = *sides;
                let before = (left.len(), left.first().map(Vec::len));
                match higher.above(*plane) {
                    Above::Nowhere => {}
                    // Of two in the same plane the earlier one counts.
                    Above::Same if other > place => {}
                    Above::Everywhere | Above::Same => subtract(&mut left, &[a, b, c]),
                    Above::Within(half) => subtract(&mut left, &[a, b, c, half]),
                }
                is_cut |= before != (left.len(), left.first().map(Vec::len));
            }
            left.retain(|region| width(region) > THINNEST);
            out.extend(left.into_iter().map(|region| Part {
                region,
                plane: *plane,
                is_cut,
            }));
        }
        Ok(())
    }
}
