//! Surfaces of many triangles: files of a waved sheet over a stock, and what is asked of it.

use core::fmt::Write as _;
use vcutc::surface::import::{ReadMesh, stl};

use vcutc::surface::residual::Machined;
use vcutc::surface::surface::{Accuracy, Placement, Plan, Surface};
use vcutc_backend_api::geometry::{Frame, Orientation, Point3};
use vcutc_backend_api::units::Length;

/// Width and depth of the stock, in mm.
pub(crate) const PLAN: [f64; 2] = [1500.0, 3000.0];

/// The corners of about so many triangles, three by three.
#[must_use]
pub fn triangles(count: u32) -> Vec<[[f32; 3]; 3]> {
    let cells = (f64::from(count) / 2.0).sqrt() as u32;
    let corner = |i: u32, j: u32| {
        let [x, y] = [(i, PLAN[0]), (j, PLAN[1])].map(|(k, size)| size * f64::from(k) / f64::from(cells));
        let z = 100.0 + 30.0 * (x / 200.0).sin() + 20.0 * (y / 300.0).cos();
        [x, y, z].map(|value| value as f32)
    };
    let cell = |(i, j): (u32, u32)| {
        let [a, b, c, d] = [
            corner(i, j),
            corner(i + 1, j),
            corner(i + 1, j + 1),
            corner(i, j + 1),
        ];
        [[a, b, c], [a, c, d]]
    };
    let places = (0..cells).flat_map(|j| (0..cells).map(move |i| (i, j)));
    places.flat_map(cell).collect()
}

/// A binary STL of them.
#[must_use]
pub fn binary(triangles: &[[[f32; 3]; 3]]) -> Vec<u8> {
    let mut bytes = vec![b' '; 80];
    bytes.extend((triangles.len() as u32).to_le_bytes());
    for triangle in triangles {
        bytes.extend([0_u8; 12]);
        bytes.extend(triangle.iter().flatten().flat_map(|value| value.to_le_bytes()));
        bytes.extend([0_u8; 2]);
    }
    bytes
}

/// A text STL of them.
#[must_use]
pub fn ascii(triangles: &[[[f32; 3]; 3]]) -> Vec<u8> {
    let mut text = "solid sheet\n".to_owned();
    for triangle in triangles {
        text.push_str("facet normal 0 0 1\nouter loop\n");
        for [x, y, z] in triangle {
            writeln!(text, "vertex {x} {y} {z}").expect("strings take everything");
        }
        text.push_str("endloop\nendfacet\n");
    }
    text.push_str("endsolid sheet\n");
    text.into_bytes()
}

/// Bytes to triangles.
#[must_use]
pub fn read(bytes: &[u8]) -> ReadMesh {
    stl(bytes).expect("the file is right")
}

/// Triangles over the stock, with all that is checked of them.
#[must_use]
pub fn placed(read: &ReadMesh) -> Surface {
    let placement = Placement {
        frame: Frame {
            origin: Point3::new(0.0, 0.0, 0.0),
            orientation: Orientation::IDENTITY,
        },
        unit: Length::mm(1.0),
    };
    let [width, depth] = PLAN.map(Length::mm);
    let accuracy = Accuracy {
        tolerance: Length::ZERO,
        weld: Length::mm(0.01),
    };
    let surface = Surface::new(&read.mesh, &placement, Plan { width, depth }, accuracy);
    let surface = surface.expect("it lies over the stock");
    let coverage = surface.coverage().expect("it is a sheet");
    assert!(coverage.gaps.is_empty(), "{:?}", coverage.gaps);
    surface
}

/// Points of sections, a row of them along y.
#[must_use]
pub fn sections(surface: &Surface, count: u32) -> usize {
    let at = |k: u32| PLAN[1] * (f64::from(k) + 0.5) / f64::from(count);
    let sections = (0..count).map(|k| surface.section(at(k)).expect("it has no gaps"));
    sections.map(|section| section.points().len()).sum()
}

/// What a saw-tooth of this many teeth over its shadow leaves, in litres.
#[must_use]
pub fn standing(surface: &Surface, teeth: u32) -> f64 {
    let shadow = surface.shadow().expect("it has no gaps");
    let points = (0..=2 * teeth).map(|k| {
        let x = PLAN[0] * f64::from(k) / f64::from(2 * teeth);
        let above = if k % 2 == 0 { 5.0 } else { 1.0 };
        vcutc::geometry::curve::Point2::new(x, shadow.height(x) + above)
    });
    let machined = Machined::new(points.collect()).expect("from left to right");
    let standing = surface.standing(&machined).expect("it is a sheet");
    standing.expect("it has an area").volume.to_litres()
}
