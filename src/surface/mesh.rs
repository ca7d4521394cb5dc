//! Meshes of triangles.
//!
//! A [`Mesh`] is a list of corners and a list of triangles that name their corners. It is checked when it is made, so that
//! its owner may compute with it: all coordinates are numbers in range, and all corners that triangles name
//! exist. A mesh promises nothing else: it may have borders, cracks, sheets above each other, and triangles
//! without area.

use core::fmt;
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::vector::cross;
use vcutc_geometry::curve::LARGEST_COORDINATE;

/// The most triangles that a mesh may have, and the most corners.
pub const MOST_TRIANGLES: usize = 20_000_000;

/// A surface of triangles.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    corners: Vec<Point3>,
    triangles: Vec<[u32; 3]>,
}

/// Why corners and triangles are not a mesh. Indices count from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MeshError {
    /// A coordinate is not a number, or beyond [`LARGEST_COORDINATE`].
    OutOfRange {
        /// The corner.
        corner: usize,
    },
    /// A triangle names a corner that does not exist.
    NoSuchCorner {
        /// The triangle.
        triangle: usize,
    },
    /// More than [`MOST_TRIANGLES`] triangles, or three times as many corners.
    TooLarge,
}

impl fmt::Display for MeshError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::OutOfRange { corner } => write!(f, "corner {corner} is out of range"),
            Self::NoSuchCorner { triangle } => {
                write!(f, "triangle {triangle} names a corner that does not exist")
            }
            Self::TooLarge => write!(f, "there are more than {MOST_TRIANGLES} triangles"),
        }
    }
}

impl core::error::Error for MeshError {}

impl Mesh {
    /// A mesh of corners, in any unit, and of triangles by the indices of their corners.
    ///
    /// # Errors
    /// See [`MeshError`].
    pub fn new(corners: Vec<Point3>, triangles: Vec<[u32; 3]>) -> Result<Self, MeshError> {
        if triangles.len() > MOST_TRIANGLES || corners.len() > 3 * MOST_TRIANGLES {
            return Err(MeshError::TooLarge);
        }
        if let Some(corner) = corners.iter().position(|&corner| !is_in_range(corner)) {
            return Err(MeshError::OutOfRange { corner });
        }
        let exists = |&index: &u32| (index as usize) < corners.len();
        if let Some(triangle) = triangles.iter().position(|named| !named.iter().all(exists)) {
            return Err(MeshError::NoSuchCorner { triangle });
        }
        Ok(Self { corners, triangles })
    }

    /// A mesh of nothing.
    pub(crate) const fn empty() -> Self {
        Self {
            corners: Vec::new(),
            triangles: Vec::new(),
        }
    }

    /// The corners.
    #[must_use]
    pub fn corners(&self) -> &[Point3] {
        &self.corners
    }

    /// The triangles, by the indices of their corners.
    #[must_use]
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// The triangles, each by its corners.
    pub fn faces(&self) -> impl ExactSizeIterator<Item = [Point3; 3]> + '_ {
        self.triangles.iter().map(|named| self.face(*named))
    }

    /// The least and the greatest coordinates of all corners; none of a mesh without corners.
    #[must_use]
    pub fn extent(&self) -> Option<[Point3; 2]> {
        let first = *self.corners.first()?;
        Some(self.corners.iter().fold([first; 2], |[low, high], p| {
            [
                Point3::new(low.x.min(p.x), low.y.min(p.y), low.z.min(p.z)),
                Point3::new(high.x.max(p.x), high.y.max(p.y), high.z.max(p.z)),
            ]
        }))
    }

    /// The corners of a triangle of this mesh.
    pub(crate) fn face(&self, named: [u32; 3]) -> [Point3; 3] {
        // Looked at in `new`.
        named.map(|index| {
            self.corners
                .get(index as usize)
                .copied()
                .unwrap_or(Point3::new(0.0, 0.0, 0.0))
        })
    }
}

/// Whether all coordinates are numbers within [`LARGEST_COORDINATE`].
pub(crate) fn is_in_range(point: Point3) -> bool {
    // Comparisons with NaN are false.
    point
        .to_array()
        .iter()
        .all(|value| value.abs() <= LARGEST_COORDINATE)
}

/// Whether three corners span no area at all, as far as doubles show.
pub(crate) fn is_degenerate([a, b, c]: [Point3; 3]) -> bool {
    let (u, v) = (difference(b, a), difference(c, a));
    cross(u, v).iter().all(|&part| part == 0.0)
}

/// What leads from the second point to the first.
pub(crate) fn difference(a: Point3, b: Point3) -> [f64; 3] {
    [a.x - b.x, a.y - b.y, a.z - b.z]
}

/// Bits of a corner's number in a short key.
const SHORT: u32 = 21;

/// A triangle as one number that sorts as its three do, if its corners' numbers are small enough.
pub(crate) fn packed([a, b, c]: [u32; 3]) -> Option<u64> {
    let [a, b, c] = [a, b, c].map(u64::from);
    (a | b | c < 1 << SHORT).then_some(a << (2 * SHORT) | b << SHORT | c)
}

/// The triangle of such a number.
pub(crate) const fn unpacked(key: u64) -> [u32; 3] {
    let mask = (1 << SHORT) - 1;
    [
        (key >> (2 * SHORT) & mask) as u32,
        (key >> SHORT & mask) as u32,
        (key & mask) as u32,
    ]
}

/// Removes the triangles whose three corners, in whatever order, another one before has too. Says how many there were.
pub(crate) fn remove_doubled(triangles: &mut Vec<[u32; 3]>) -> usize {
    // Most meshes have none, which short keys show faster.
    let keys: Option<Vec<u64>> = triangles
        .iter()
        .map(|named| {
            let mut named = *named;
            named.sort_unstable();
            packed(named)
        })
        .collect();
    if let Some(mut keys) = keys {
        keys.sort_unstable();
        if keys.windows(2).all(|pair| pair[0] != pair[1]) {
            return 0;
        }
    }
    let mut keys: Vec<([u32; 3], u32)> = (0..)
        .zip(triangles.iter())
        .map(|(place, named)| {
            let mut named = *named;
            named.sort_unstable();
            (named, place)
        })
        .collect();
    keys.sort_unstable();
    let mut doubled: Vec<u32> = keys
        .windows(2)
        .filter(|pair| pair[0].0 == pair[1].0)
        .map(|pair| pair[1].1)
        .collect();
    doubled.sort_unstable();
    let mut next = doubled.iter().copied().peekable();
    let mut place = 0;
    triangles.retain(|_| {
        let is_doubled = next.next_if_eq(&place).is_some();
        place += 1;
        !is_doubled
    });
    doubled.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn corners() -> Vec<Point3> {
        vec![
            Point3::new(0.0, 0.0, 1.0),
            Point3::new(2.0, 0.0, -1.0),
            Point3::new(0.0, 3.0, 0.0),
        ]
    }

    #[test]
    fn what_is_not_a_mesh_is_refused() {
        assert_eq!(
            Mesh::new(corners(), vec![[0, 1, 2], [0, 1, 3]]),
            Err(MeshError::NoSuchCorner { triangle: 1 })
        );
        for bad in [f64::NAN, f64::INFINITY, 2e9] {
            let mut corners = corners();
            corners[1].y = bad;
            assert_eq!(
                Mesh::new(corners, vec![[0, 1, 2]]),
                Err(MeshError::OutOfRange { corner: 1 })
            );
        }
    }

    #[test]
    fn extent_is_the_box_around_all_corners() {
        let mesh = Mesh::new(corners(), vec![]).unwrap();
        assert_eq!(
            mesh.extent(),
            Some([Point3::new(0.0, 0.0, -1.0), Point3::new(2.0, 3.0, 1.0)])
        );
        assert_eq!(Mesh::new(vec![], vec![]).unwrap().extent(), None);
    }

    #[test]
    fn short_keys_sort_as_triangles_do() {
        let most = (1 << SHORT) - 1;
        let triangles = [
            [0, 1, 2],
            [0, 2, 1],
            [1, 0, most],
            [1, most, 0],
            [most, 0, 0],
            [most; 3],
        ];
        let keys: Vec<u64> = triangles.iter().map(|t| packed(*t).unwrap()).collect();
        assert!(keys.is_sorted());
        assert!(
            keys.iter()
                .zip(triangles)
                .all(|(key, triangle)| unpacked(*key) == triangle)
        );
        assert_eq!(packed([0, most + 1, 0]), None);
    }

    #[test]
    fn doubled_triangles_go_and_the_first_stays() {
        let mut triangles = vec![[0, 1, 2], [3, 4, 5], [2, 1, 0], [3, 4, 6], [1, 2, 0]];
        assert_eq!(remove_doubled(&mut triangles), 2);
        assert_eq!(triangles, [[0, 1, 2], [3, 4, 5], [3, 4, 6]]);
        assert_eq!(remove_doubled(&mut triangles), 0);
        // Numbers too large for short keys.
        let large = 1 << 22;
        let mut triangles = vec![[0, 1, large], [3, 4, 5], [large, 0, 1]];
        assert_eq!(remove_doubled(&mut triangles), 1);
        assert_eq!(triangles, [[0, 1, large], [3, 4, 5]]);
    }
}
