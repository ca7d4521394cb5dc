//! What machining leaves above each corner of a part's triangles, as a file of triangles that other programs colour.
//!
//! The file is PLY, binary, with the lowest byte first. Each vertex has its place in mm and its `quality`: MeshLab colours by that
//! property, CloudCompare takes it as a scalar field.

use crate::residual::Machined;
use crate::surface::Surface;
use core::fmt::Write as _;
use vcutc_backend_api::geometry::Point3;

/// How far below the part's upper side a corner may lie to belong to it, in mm: rounding of where triangles are clipped.
const BELOW: f64 = 1e-6;

/// The part's upper side as PLY, with the height along z, in mm, that a machined profile leaves above each vertex. Triangles that face
/// down or stand upright, and those of which the part itself hides a corner from above, are left out.
#[must_use]
pub fn ply(surface: &Surface, machined: &Machined) -> Vec<u8> {
    let mesh = surface.mesh();
    let is_seen: Vec<bool> = mesh
        .corners()
        .iter()
        .map(|corner| {
            let height = surface.height(corner.x, corner.y);
            height.is_some_and(|height| height <= corner.z + BELOW)
        })
        .collect();
    let seen = |corner: u32| is_seen.get(corner as usize).copied().unwrap_or_default();
    let faces: Vec<[u32; 3]> = mesh
        .triangles()
        .iter()
        .filter(|corners| {
            corners.iter().all(|&corner| seen(corner)) && area_in_plan(mesh.face(**corners)) > 0.0
        })
        .copied()
        .collect();
    let (numbers, kept) = numbered(&faces, mesh.corners().len());
    let mut head = String::new();
    // Writing to a string cannot fail.
    let _ = write!(
        head,
        "ply\nformat binary_little_endian 1.0\ncomment quality: height that cuts leave above the part along z, in mm\n\
         element vertex {}\nproperty float x\nproperty float y\nproperty float z\nproperty float quality\n\
         element face {}\nproperty list uchar int vertex_indices\nend_header\n",
        kept.len(),
        faces.len()
    );
    let mut bytes = head.into_bytes();
    for &corner in &kept {
        if let Some(&Point3 { x, y, z }) = mesh.corners().get(corner as usize) {
            let left = machined.height_over(x, y) - z;
            for value in [x, y, z, left] {
                bytes.extend((value as f32).to_le_bytes());
            }
        }
    }
    for face in &faces {
        bytes.push(3);
        for corner in face {
            let number = numbers.get(*corner as usize).copied().unwrap_or_default();
            bytes.extend(number.to_le_bytes());
        }
    }
    bytes
}

/// Twice the area of a triangle seen from above; positive where it faces up.
fn area_in_plan([a, b, c]: [Point3; 3]) -> f64 {
    (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y)
}

/// New numbers for the corners that faces name, in the order of the old ones, and the old numbers in that order.
fn numbered(faces: &[[u32; 3]], corners: usize) -> (Vec<u32>, Vec<u32>) {
    let mut is_named = vec![false; corners];
    for &corner in faces.iter().flatten() {
        if let Some(named) = is_named.get_mut(corner as usize) {
            *named = true;
        }
    }
    let kept: Vec<u32> = (0_u32..)
        .zip(&is_named)
        .filter_map(|(corner, named)| named.then_some(corner))
        .collect();
    let mut numbers = vec![0; corners];
    for (number, &corner) in (0_u32..).zip(&kept) {
        if let Some(place) = numbers.get_mut(corner as usize) {
            *place = number;
        }
    }
    (numbers, kept)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::import;
    use crate::mesh::Mesh;
    use crate::surface::{Accuracy, Placement, Plan};
    use vcutc_backend_api::geometry::{Frame, Orientation};
    use vcutc_backend_api::units::Length;
    use vcutc_geometry::curve::Point2;

    /// A closed wedge over 20 x 10 mm, from 5 mm to 15 mm high, wound outwards.
    fn wedge() -> Surface {
        let corners = [
            (0.0, 0.0, 0.0),
            (20.0, 0.0, 0.0),
            (20.0, 10.0, 0.0),
            (0.0, 10.0, 0.0),
            (0.0, 0.0, 5.0),
            (20.0, 0.0, 15.0),
            (20.0, 10.0, 15.0),
            (0.0, 10.0, 5.0),
        ];
        let corners = corners.map(|(x, y, z)| Point3::new(x, y, z)).to_vec();
        let faces = vec![
            [0, 2, 1],
            [0, 3, 2],
            [4, 5, 6],
            [4, 6, 7],
            [0, 1, 5],
            [0, 5, 4],
            [2, 3, 7],
            [2, 7, 6],
        ];
        let mesh = Mesh::new(corners, faces).unwrap();
        let placement = Placement {
            frame: Frame {
                origin: Point3::new(0.0, 0.0, 0.0),
                orientation: Orientation::IDENTITY,
            },
            unit: Length::mm(1.0),
        };
        let plan = Plan {
            width: Length::mm(20.0),
            depth: Length::mm(10.0),
        };
        let accuracy = Accuracy {
            tolerance: Length::ZERO,
            weld: Length::mm(0.01),
        };
        Surface::new(&mesh, &placement, plan, accuracy).unwrap()
    }

    /// The values of the vertices, read without the writer's own code.
    fn vertices(bytes: &[u8]) -> Vec<[f32; 4]> {
        let end = b"end_header\n";
        let start = bytes.windows(end.len()).position(|window| window == end).unwrap() + end.len();
        let head = core::str::from_utf8(&bytes[..start]).unwrap();
        let count = head
            .split("element vertex ")
            .nth(1)
            .unwrap()
            .lines()
            .next()
            .unwrap();
        let count: usize = count.parse().unwrap();
        let all = bytes[start..start + count * 16].chunks_exact(4);
        let values: Vec<f32> = all
            .map(|value| f32::from_le_bytes(value.try_into().unwrap()))
            .collect();
        values
            .chunks_exact(4)
            .map(|vertex| vertex.try_into().unwrap())
            .collect()
    }

    /// Under a step from 16 mm to 20 mm at x 10: the sloped side alone, with the height above each of its corners.
    #[test]
    fn each_vertex_says_what_is_left_above_it() {
        let corners = [(0.0, 16.0), (10.0, 16.0), (10.0, 20.0), (20.0, 20.0)];
        let machined = Machined::new(corners.map(|(x, z)| Point2::new(x, z)).to_vec()).unwrap();
        let bytes = ply(&wedge(), &machined);
        let vertices = vertices(&bytes);
        assert_eq!(vertices.len(), 4);
        for [x, _, z, left] in vertices {
            assert_eq!(z, 5.0 + x / 2.0);
            let top = if x < 10.0 { 16.0 } else { 20.0 };
            assert_eq!(left, top - z);
        }
        // The room's own reader takes the file.
        let read = import::ply(&bytes).unwrap().mesh;
        assert_eq!(read.triangles().len(), 2);
    }

    #[test]
    fn a_wall_counts_with_its_upper_end() {
        let corners = [(0.0, 16.0), (10.0, 16.0), (10.0, 20.0), (20.0, 20.0)];
        let machined = Machined::new(corners.map(|(x, z)| Point2::new(x, z)).to_vec()).unwrap();
        for (x, height) in [
            (-1.0, 16.0),
            (0.0, 16.0),
            (9.999, 16.0),
            (10.0, 20.0),
            (20.0, 20.0),
            (21.0, 20.0),
        ] {
            assert_eq!(machined.height(x), height, "{x}");
        }
    }
}
