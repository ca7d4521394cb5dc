//! Surfaces from heights on a grid, as measuring machines give them.
//!
//! Each cell is split along the diagonal whose middle is higher: of the two ways to read four heights as triangles the
//! mesh is nowhere below either.

use crate::mesh::{MOST_TRIANGLES, Mesh, is_in_range};
use core::fmt;
use vcutc_backend_api::geometry::Point3;

/// Why points are not heights on a grid. Indices count the points from 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum GridError {
    /// A coordinate is not a number, or out of range.
    OutOfRange {
        /// The point.
        index: usize,
    },
    /// A grid takes two columns and two rows.
    TooFew,
    /// More cells than a mesh may have triangles for.
    TooMany,
    /// Two points at one place.
    Doubled {
        /// The later one.
        index: usize,
    },
    /// No point where a column and a row meet.
    Missing {
        /// The column.
        x: f64,
        /// The row.
        y: f64,
    },
}

impl fmt::Display for GridError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::OutOfRange { index } => write!(f, "point {index} is out of range"),
            Self::TooFew => write!(f, "a grid takes two columns and two rows or more"),
            Self::TooMany => write!(f, "the grid has more cells than a surface may have"),
            Self::Doubled { index } => write!(f, "point {index} lies where another one does"),
            Self::Missing { x, y } => write!(f, "the grid has no height at x = {x}, y = {y}"),
        }
    }
}

impl core::error::Error for GridError {}

/// The mesh of points on a full grid, in any order: all x are among a few, all y among a few, and each x comes with
/// each y once.
///
/// # Errors
/// See [`GridError`].
pub fn grid(points: &[Point3]) -> Result<Mesh, GridError> {
    if let Some(index) = points.iter().position(|&point| !is_in_range(point)) {
        return Err(GridError::OutOfRange { index });
    }
    let xs = coordinates(points.iter().map(|p| p.x));
    let ys = coordinates(points.iter().map(|p| p.y));
    if xs.len() < 2 || ys.len() < 2 {
        return Err(GridError::TooFew);
    }
    // By rows, then columns; of points at one place the earlier first.
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_by(|&a, &b| {
        let (a, b) = (points[a], points[b]);
        (a.y + 0.0)
            .total_cmp(&(b.y + 0.0))
            .then((a.x + 0.0).total_cmp(&(b.x + 0.0)))
    });
    let same =
        |pair: &&[usize]| points[pair[0]].x == points[pair[1]].x && points[pair[0]].y == points[pair[1]].y;
    if let Some(pair) = order.windows(2).find(same) {
        return Err(GridError::Doubled { index: pair[1] });
    }
    // Points are distinct, so the first place of the full grid that is missing shows within their number.
    let places = ys.iter().flat_map(|&y| xs.iter().map(move |&x| (x, y)));
    let mut found = order.iter().map(|&index| points[index]);
    for (x, y) in places {
        if found.next().is_none_or(|point| point.x != x || point.y != y) {
            return Err(GridError::Missing { x, y });
        }
    }
    let corners: Vec<Point3> = order.iter().map(|&index| points[index]).collect();
    rows(corners, xs.len()).ok_or(GridError::TooMany)
}

/// Different numbers, in order.
fn coordinates(all: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut all: Vec<f64> = all.map(|value| value + 0.0).collect();
    all.sort_unstable_by(f64::total_cmp);
    all.dedup();
    all
}

/// A mesh of corners in rows of so many. Cells are split along the diagonal whose middle is higher. None if it were too large.
pub(crate) fn rows(corners: Vec<Point3>, columns: usize) -> Option<Mesh> {
    let count = corners.len().checked_div(columns)?;
    let cells = columns.saturating_sub(1).checked_mul(count.saturating_sub(1))?;
    if cells > MOST_TRIANGLES / 2 {
        return None;
    }
    let mut triangles = Vec::with_capacity(2 * cells);
    for (row, next) in corners
        .chunks(columns)
        .zip(corners.chunks(columns).skip(1))
        .enumerate()
        .map(|(row, pair)| (row * columns, pair))
    {
        for (column, (low, high)) in next.0.windows(2).zip(next.1.windows(2)).enumerate() {
            let a = (row + column) as u32;
            let c = a + columns as u32;
            triangles.extend(split(
                [a, a + 1, c, c + 1],
                [low[0].z, low[1].z, high[0].z, high[1].z],
            ));
        }
    }
    Mesh::new(corners, triangles).ok()
}

/// The triangles of a cell, given by its corners `(0, 0), (1, 0), (0, 1), (1, 1)` and their heights.
pub(crate) fn split([a, b, c, d]: [u32; 4], heights: [f64; 4]) -> [[u32; 3]; 2] {
    if heights[0] + heights[3] >= heights[1] + heights[2] {
        [[a, b, d], [a, d, c]]
    } else {
        [[a, b, c], [b, d, c]]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testkit::{FIXED, surface_over};
    use proptest::prelude::*;

    fn points() -> impl Strategy<Value = Vec<Point3>> {
        (2..7usize, 2..7usize).prop_flat_map(|(columns, rows)| {
            let count = columns * rows;
            prop::collection::vec(0.0..9.0f64, count)
                .prop_shuffle()
                .prop_flat_map(move |heights| {
                    let points: Vec<Point3> = heights
                        .iter()
                        .enumerate()
                        .map(|(k, &z)| {
                            Point3::new(10.0 * (k % columns) as f64, 7.5 * (k / columns) as f64, z)
                        })
                        .collect();
                    Just(points).prop_shuffle()
                })
        })
    }

    proptest! {
        #[test]
        fn heights_are_kept_and_between_them_nothing_is_below_either_diagonal(
            points in points(), u in 0.0..1.0f64, v in 0.0..1.0f64,
        ) {
            let mesh = grid(&points).unwrap();
            let [_, high] = mesh.extent().unwrap();
            let surface = surface_over(&mesh, FIXED, high.x, high.y);
            for point in &points {
                prop_assert!((surface.height(point.x, point.y).unwrap() - point.z).abs() < 1e-12);
            }
            let at = |x: f64, y: f64| points.iter().find(|p| p.x == x && p.y == y).unwrap().z;
            let (i, j) = ((u * high.x / 10.0).floor() * 10.0, (v * high.y / 7.5).floor() * 7.5);
            let [a, b, c, d] = [at(i, j), at(i + 10.0, j), at(i, j + 7.5), at(i + 10.0, j + 7.5)];
            let (s, t) = ((u * high.x - i) / 10.0, (v * high.y - j) / 7.5);
            let along_ad = if s >= t { a + s * (b - a) + t * (d - b) } else { a + t * (c - a) + s * (d - c) };
            let along_bc = if s + t <= 1.0 { a + s * (b - a) + t * (c - a) } else { d + (1.0 - s) * (c - d) + (1.0 - t) * (b - d) };
            let height = surface.height(u * high.x, v * high.y).unwrap();
            prop_assert!((height - along_ad.max(along_bc)).abs() < 1e-9, "{height} {along_ad} {along_bc}");
        }

        #[test]
        fn what_is_missing_or_doubled_is_found(points in points(), place: prop::sample::Index) {
            let place = place.index(points.len());
            let mut fewer = points.clone();
            let gone = fewer.remove(place);
            match grid(&fewer) {
                Err(GridError::Missing { x, y }) => prop_assert_eq!((x, y), (gone.x, gone.y)),
                // The only one of its column or row, were there two points in it.
                other => prop_assert!(other.is_err(), "{other:?}"),
            }
            let mut more = points.clone();
            more.push(gone);
            prop_assert_eq!(grid(&more), Err(GridError::Doubled { index: points.len() }));
        }
    }
}
