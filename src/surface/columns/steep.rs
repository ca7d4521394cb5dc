//! Where a surface is steeper along y than the ways that cover it may be.

use super::{Each, STEEPEST, Strips, nearest_slope, range};
use crate::surface::Surface;
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::units::Angle;

/// Faces that rise by less along y, in mm, are no steps but noise of a mesh.
const LEAST_RISE: f64 = 0.05;

/// Faces nearer than this to a side of the plan, in mm, are its end.
const AT_END: f64 = 0.01;

/// Straight ways are looked for up to this slope, that of 89 degrees.
const NEARLY_UPRIGHT: f64 = 57.29;

/// A place of a surface, and how steep it is along y there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Steep {
    /// Along x and y, in mm.
    pub place: [f64; 2],
    pub angle: Angle,
}

impl Surface {
    /// Where it is steepest of all places that are steeper than ways may be; of straight ways where the nearest line is, in the middle of
    /// the surface.
    #[must_use]
    pub fn steeper_than_ways(&self, each: Each) -> Option<Steep> {
        let all: Vec<Steep> = match each {
            Each::Straight => self.nearest_lines(),
            Each::Curved => self.faces_along_y(),
        };
        let most = Angle::rad(libm::atan(STEEPEST));
        let steep = all.into_iter().filter(|one| one.angle > most);
        steep.reduce(|one, other| if other.angle > one.angle { other } else { one })
    }

    fn nearest_lines(&self) -> Vec<Steep> {
        let [_, depth] = self.size();
        let strips = Strips::of(self);
        let line = |plane: usize| {
            let slope = nearest_slope(&strips.section(plane), NEARLY_UPRIGHT)?;
            Some(Steep {
                place: [strips.place(plane), depth / 2.0],
                angle: Angle::rad(libm::atan(slope.abs())),
            })
        };
        (0..=strips.count).filter_map(line).collect()
    }

    fn faces_along_y(&self) -> Vec<Steep> {
        let [_, depth] = self.size();
        let faces = self.mesh().triangles().iter();
        let faces = faces.map(|&named| self.mesh().face(named));
        let steep = |face: [Point3; 3]| {
            let [low, high] = range(face.iter().map(|corner| corner.y));
            let [from, to] = range(face.iter().map(|corner| corner.z));
            if high < AT_END || low > depth - AT_END || to - from < LEAST_RISE {
                return None;
            }
            let [_, along, up] = normal(face);
            (up >= 0.0).then(|| Steep {
                place: [middle(face, |corner| corner.x), middle(face, |corner| corner.y)],
                angle: Angle::rad(libm::atan2(along.abs(), up)),
            })
        };
        faces.filter_map(steep).collect()
    }
}

/// Across a face, of whatever length.
fn normal([a, b, c]: [Point3; 3]) -> [f64; 3] {
    let [u, v] = [b, c].map(|corner| [corner.x - a.x, corner.y - a.y, corner.z - a.z]);
    [
        u[1] * v[2] - u[2] * v[1],
        u[2] * v[0] - u[0] * v[2],
        u[0] * v[1] - u[1] * v[0],
    ]
}

fn middle(face: [Point3; 3], of: impl Fn(Point3) -> f64) -> f64 {
    face.into_iter().map(of).sum::<f64>() / 3.0
}
