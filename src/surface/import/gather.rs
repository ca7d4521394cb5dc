//! Corners and polygons as a file gives them, on the way to a mesh.

use super::{DataError, ReadMesh, Remarks, fault};
use crate::mesh::{MOST_TRIANGLES, Mesh, difference, is_degenerate, remove_doubled};
use core::ops::Range;
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::vector::{cross, dot};

/// A polygon counts as plane when its corners lie within this share of its size of one plane: files print six digits.
const PLANE_SHARE: f64 = 1e-5;

/// Corners of a polygon that are tried as the centre of its fan.
const MOST_CENTRES: usize = 16;

#[derive(Debug, Default)]
pub(super) struct Gather {
    pub(super) corners: Vec<Point3>,
    pub(super) triangles: Vec<[u32; 3]>,
    pub(super) remarks: Remarks,
}

impl Gather {
    /// Adds a polygon by the indices of its corners, which exist. `range` is where the file has it.
    pub(super) fn polygon(&mut self, named: &mut Vec<u32>, range: Range<usize>) -> Result<(), DataError> {
        if self.triangles.len().saturating_add(named.len()) > MOST_TRIANGLES {
            return Err(fault(
                range,
                format!("there are more than {MOST_TRIANGLES} triangles up to here"),
            ));
        }
        match named.as_slice() {
            [] | [_] | [_, _] => Err(fault(range, "a face takes three corners or more")),
            &[a, b, c] => {
                self.triangle([a, b, c]);
                Ok(())
            }
            _ => self.fan(named, range),
        }
    }

    pub(super) fn triangle(&mut self, named: [u32; 3]) {
        if is_degenerate(named.map(|index| self.corner(index))) {
            self.remarks.degenerate += 1;
        } else {
            self.triangles.push(named);
        }
    }

    /// A polygon of four corners or more as the triangles that a corner of it forms with all others. They must all turn the
    /// same way about the polygon's normal, or else they would reach beyond it.
    fn fan(&mut self, named: &mut Vec<u32>, range: Range<usize>) -> Result<(), DataError> {
        // A corner that repeats at once adds nothing.
        named.dedup();
        while named.len() > 1 && named.first() == named.last() {
            named.pop();
        }
        if named.len() <= 3 {
            match *named.as_slice() {
                [a, b, c] => self.triangle([a, b, c]),
                _ => self.remarks.degenerate += 1,
            }
            return Ok(());
        }
        let mut sorted = named.clone();
        sorted.sort_unstable();
        if sorted.windows(2).any(|pair| pair[0] == pair[1]) {
            return Err(fault(range, "this face passes one of its corners twice"));
        }
        let points: Vec<Point3> = named.iter().map(|&index| self.corner(index)).collect();
        let normal = newell(&points);
        let length = dot(normal, normal).sqrt();
        if length.partial_cmp(&0.0) != Some(core::cmp::Ordering::Greater) {
            self.remarks.degenerate += 1;
            return Ok(());
        }
        self.judge_plane(&points, normal.map(|part| part / length));
        let count = named.len();
        let centre = (0..count.min(MOST_CENTRES)).find(|&centre| turns_one_way(&points, centre, normal));
        let Some(centre) = centre else {
            return Err(fault(
                range,
                "this face has concave corners; export triangles instead of polygons",
            ));
        };
        named.rotate_left(centre);
        if let [first, rest @ ..] = named.as_slice() {
            for pair in rest.windows(2) {
                self.triangle([*first, pair[0], pair[1]]);
            }
        }
        Ok(())
    }

    fn judge_plane(&mut self, points: &[Point3], normal: [f64; 3]) {
        let Some(&first) = points.first() else { return };
        let heights = points.iter().map(|&point| dot(difference(point, first), normal));
        let (low, high) = heights.fold((0.0_f64, 0.0_f64), |(low, high), h| (low.min(h), high.max(h)));
        let size = points
            .iter()
            .map(|&point| first.distance(point).to_mm())
            .fold(0.0, f64::max);
        // Half the spread: the plane may lie in the middle.
        let bent = (high - low) / 2.0;
        if bent > PLANE_SHARE * size {
            self.remarks.bent += 1;
            self.remarks.most_bent = self.remarks.most_bent.max(bent);
        }
    }

    fn corner(&self, index: u32) -> Point3 {
        self.corners
            .get(index as usize)
            .copied()
            .unwrap_or(Point3::new(0.0, 0.0, 0.0))
    }

    /// The mesh, of a file of so many bytes.
    pub(super) fn finish(mut self, bytes: usize) -> Result<ReadMesh, DataError> {
        self.remarks.doubled += remove_doubled(&mut self.triangles);
        if self.triangles.is_empty() {
            return Err(fault(0..bytes, "this file has no triangle with an area"));
        }
        let mesh =
            Mesh::new(self.corners, self.triangles).map_err(|error| fault(0..bytes, error.to_string()))?;
        Ok(ReadMesh {
            mesh,
            remarks: self.remarks,
        })
    }
}

/// Twice the area of a polygon along each axis (Newell's method: right for polygons that are not quite plane).
fn newell(points: &[Point3]) -> [f64; 3] {
    let Some(&first) = points.first() else {
        return [0.0; 3];
    };
    points
        .windows(2)
        .map(|pair| cross(difference(pair[0], first), difference(pair[1], first)))
        .fold([0.0; 3], |sum, part| core::array::from_fn(|i| sum[i] + part[i]))
}

/// Whether all triangles of the fan about a corner turn the same way as the polygon.
fn turns_one_way(points: &[Point3], centre: usize, normal: [f64; 3]) -> bool {
    let count = points.len();
    let Some(&apex) = points.get(centre) else {
        return false;
    };
    let at = |place: usize| points.get((centre + place) % count).copied().unwrap_or(apex);
    // Corners in a line give areas that rounding may turn either way.
    let slack = 1e-12 * dot(normal, normal);
    (1..count - 1).all(|place| {
        let turned = cross(difference(at(place), apex), difference(at(place + 1), apex));
        dot(turned, normal) >= -slack
    })
}
