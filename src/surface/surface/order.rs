//! Triangles clipped to the plan and brought into one order.

use super::clip::{clipped, order};
use crate::mesh::{Mesh, is_degenerate, packed, unpacked};
use vcutc_backend_api::geometry::Point3;

/// The triangles of a mesh over the plan: corners that are used, each once and in the order of their coordinates;
/// triangles that have an area, each once, from their least corner on, in the order of their corners.
pub(super) fn clipped_in_order(mesh: Mesh, width: f64, depth: f64) -> Mesh {
    let (low, high) = ([0.0, 0.0], [width, depth]);
    // Both zeros are one place.
    let mut corners: Vec<Point3> = mesh
        .corners()
        .iter()
        .map(|p| Point3::new(onto(p.x, width) + 0.0, onto(p.y, depth) + 0.0, p.z + 0.0))
        .collect();
    let mut triangles: Vec<[u32; 3]> = Vec::with_capacity(mesh.triangles().len());
    for &named in mesh.triangles() {
        let face = named.map(|index| corners.get(index as usize).copied().unwrap_or(ORIGIN));
        match side(face, width, depth) {
            Side::Inside => triangles.push(named),
            Side::Outside => {}
            Side::Across => {
                let mut polygon = clipped(&face, low, high);
                polygon.dedup();
                from_least(&mut polygon);
                let first = corners.len() as u32;
                let fan =
                    (1..polygon.len().saturating_sub(1) as u32).map(|i| [first, first + i, first + i + 1]);
                triangles.extend(fan);
                if polygon.len() >= 3 {
                    corners.extend(polygon);
                }
            }
        }
    }
    drop(mesh);
    sorted(&corners, triangles)
}

const ORIGIN: Point3 = Point3::new(0.0, 0.0, 0.0);

/// Corners as near as this to a side of the plan, in mm, are put on it: turning a part rounds, and would leave slivers there.
const ON_SIDE: f64 = 1e-9;

fn onto(coordinate: f64, size: f64) -> f64 {
    if coordinate.abs() <= ON_SIDE {
        0.0
    } else if (coordinate - size).abs() <= ON_SIDE {
        size
    } else {
        coordinate
    }
}

enum Side {
    Inside,
    Outside,
    Across,
}

fn side(face: [Point3; 3], width: f64, depth: f64) -> Side {
    if face
        .iter()
        .all(|p| (0.0..=width).contains(&p.x) && (0.0..=depth).contains(&p.y))
    {
        return Side::Inside;
    }
    let beyond = face.iter().all(|p| p.x < 0.0)
        || face.iter().all(|p| p.x > width)
        || face.iter().all(|p| p.y < 0.0)
        || face.iter().all(|p| p.y > depth);
    if beyond { Side::Outside } else { Side::Across }
}

fn from_least(polygon: &mut [Point3]) {
    let least = (0..polygon.len()).min_by(|&a, &b| order(polygon[a], polygon[b]));
    polygon.rotate_left(least.unwrap_or(0));
}

/// Corners and triangles in order, without what is not used, doubled or without area.
fn sorted(corners: &[Point3], mut triangles: Vec<[u32; 3]>) -> Mesh {
    let mut is_used = vec![false; corners.len()];
    for index in triangles.iter().flatten() {
        if let Some(used) = is_used.get_mut(*index as usize) {
            *used = true;
        }
    }
    let mut places: Vec<u32> = (0..corners.len() as u32)
        .filter(|&index| is_used.get(index as usize) == Some(&true))
        .collect();
    let at = |index: u32| corners.get(index as usize).copied().unwrap_or(ORIGIN);
    places.sort_unstable_by(|&a, &b| order(at(a), at(b)));
    let mut numbers = vec![0_u32; corners.len()];
    let mut kept: Vec<Point3> = Vec::with_capacity(places.len());
    for place in places {
        let corner = at(place);
        if kept.last() != Some(&corner) {
            kept.push(corner);
        }
        if let Some(number) = numbers.get_mut(place as usize) {
            *number = kept.len() as u32 - 1;
        }
    }
    for named in &mut triangles {
        for index in named.iter_mut() {
            *index = numbers.get(*index as usize).copied().unwrap_or(0);
        }
        let least = (0..3).min_by_key(|&i| named[i]).unwrap_or(0);
        named.rotate_left(least);
    }
    let keys: Option<Vec<u64>> = triangles.iter().map(|named| packed(*named)).collect();
    if let Some(mut keys) = keys {
        keys.sort_unstable();
        triangles.clear();
        triangles.extend(keys.into_iter().map(unpacked));
    } else {
        triangles.sort_unstable();
    }
    triangles.dedup();
    triangles.retain(|named| {
        !is_degenerate(named.map(|index| kept.get(index as usize).copied().unwrap_or(ORIGIN)))
    });
    // Clipping leaves all coordinates in range.
    Mesh::new(kept, triangles).unwrap_or_else(|_| Mesh::empty())
}
