//! Surfaces for tests.

use crate::mesh::Mesh;
use crate::surface::{Accuracy, Placement, Plan, Surface};
use proptest::prelude::*;
use vcutc_backend_api::geometry::{Frame, Orientation, Point3, Zyx};
use vcutc_backend_api::units::{Angle, Length};

/// The frame of the workpiece itself.
pub(crate) const FIXED: [f64; 4] = [0.0; 4];

/// A placement that moves by x, y, z in mm and turns about z by an angle in degrees.
pub(crate) fn placement([x, y, z, turn]: [f64; 4]) -> Placement {
    let angles = Zyx {
        a: Angle::deg(turn),
        b: Angle::ZERO,
        c: Angle::ZERO,
    };
    Placement {
        frame: Frame {
            origin: Point3::new(x, y, z),
            orientation: Orientation::from_zyx(angles),
        },
        unit: Length::mm(1.0),
    }
}

/// Small moves and turns.
pub(crate) fn placed() -> impl Strategy<Value = [f64; 4]> {
    prop_oneof![
        Just(FIXED),
        (-9.0..9.0, -9.0..9.0, -9.0..9.0, -5.0..5.0).prop_map(|(x, y, z, turn)| [x, y, z, turn]),
    ]
}

pub(crate) fn surface_over(mesh: &Mesh, frame: [f64; 4], width: f64, depth: f64) -> Surface {
    let plan = Plan {
        width: Length::mm(width),
        depth: Length::mm(depth),
    };
    let accuracy = Accuracy {
        tolerance: Length::mm(0.01),
        weld: Length::mm(0.01),
    };
    Surface::new(mesh, &placement(frame), plan, accuracy).unwrap()
}

/// A height field over `0..width`, `0..depth`, in so many cells along x and y.
pub(crate) fn sampled(width: f64, depth: f64, cells: [u32; 2], height: &dyn Fn(f64, f64) -> f64) -> Mesh {
    let [across, along] = cells;
    let mut corners = Vec::new();
    for j in 0..=along {
        for i in 0..=across {
            let (x, y) = (
                width * f64::from(i) / f64::from(across),
                depth * f64::from(j) / f64::from(along),
            );
            corners.push(Point3::new(x, y, height(x, y)));
        }
    }
    let mut triangles = Vec::new();
    for j in 0..along {
        for i in 0..across {
            let a = j * (across + 1) + i;
            let [b, c, d] = [a + 1, a + across + 1, a + across + 2];
            triangles.extend([[a, b, d], [a, d, c]]);
        }
    }
    Mesh::new(corners, triangles).unwrap()
}

/// A mesh with a needle of 0.01 mm on it, up to a point.
pub(crate) fn with_needle(mesh: &Mesh, foot: [f64; 3], point: [f64; 3]) -> Mesh {
    let [x, y, z] = foot;
    let mut corners = mesh.corners().to_vec();
    let first = corners.len() as u32;
    let feet = [[x - 0.005, y, z], [x + 0.005, y, z], [x, y + 0.005, z]];
    corners.extend(feet.into_iter().chain([point]).map(Point3::from));
    let mut triangles = mesh.triangles().to_vec();
    triangles.extend([[0, 1, 3], [1, 2, 3], [2, 0, 3]].map(|t: [u32; 3]| t.map(|i| i + first)));
    Mesh::new(corners, triangles).unwrap()
}

/// Rectangles across 100 mm, each of two triangles: from and to where along y, and how high.
pub(crate) fn rectangles(all: impl IntoIterator<Item = [f64; 3]>) -> Mesh {
    let (mut corners, mut triangles) = (Vec::new(), Vec::new());
    for [from, to, z] in all {
        let first = corners.len() as u32;
        corners.extend([[0.0, from, z], [100.0, from, z], [100.0, to, z], [0.0, to, z]].map(Point3::from));
        triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
    }
    Mesh::new(corners, triangles).unwrap()
}

/// A wavy sheet that reaches well beyond the plan of this size.
pub(crate) fn wavy(width: f64, depth: f64) -> Mesh {
    let wave = |x: f64, y: f64| 5.0 * libm::sin(x / 11.0) + 4.0 * libm::cos(y / 7.0 + x / 30.0);
    let mesh = sampled(width + 80.0, depth + 80.0, [23, 17], &wave);
    let corners = mesh
        .corners()
        .iter()
        .map(|p| Point3::new(p.x - 40.0, p.y - 40.0, p.z))
        .collect();
    Mesh::new(corners, mesh.triangles().to_vec()).unwrap()
}

/// Triangles that lie about at random.
#[derive(Clone, Debug)]
pub(crate) struct Sheets(Vec<[[f64; 3]; 3]>);

impl Sheets {
    /// These triangles together with a mesh.
    pub(crate) fn over(&self, mesh: Mesh) -> Mesh {
        let mut corners = mesh.corners().to_vec();
        let mut triangles = mesh.triangles().to_vec();
        for face in &self.0 {
            let first = corners.len() as u32;
            corners.extend(face.map(Point3::from));
            triangles.push([first, first + 1, first + 2]);
        }
        Mesh::new(corners, triangles).unwrap()
    }
}

pub(crate) fn sheets() -> impl Strategy<Value = Sheets> {
    let corner = (-20.0..120.0, -20.0..80.0, -10.0..20.0).prop_map(|(x, y, z)| [x, y, z]);
    prop::collection::vec(prop::array::uniform3(corner), 0..12).prop_map(Sheets)
}

/// The distance of a point from a segment.
pub(crate) fn segment_distance(point: Point3, [a, b]: [Point3; 2]) -> f64 {
    let [along, to] = [[b, a], [point, a]].map(|[p, q]| [p.x - q.x, p.y - q.y, p.z - q.z]);
    let dot = |p: [f64; 3], q: [f64; 3]| p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
    let share = (dot(along, to) / dot(along, along).max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
    let at = |i: usize| to[i] - share * along[i];
    libm::hypot(libm::hypot(at(0), at(1)), at(2))
}
