//! Surfaces of patches: tensor products of Bezier curves and of B-splines, with weights or without.
//!
//! A B-spline surface is a grid of Bezier patches, whose control points are the values of its blossom, in one direction after
//! the other (Ramshaw, Blossoming: a connect-the-dots approach to splines, 1987). Differences of control points bound the
//! derivatives of a patch, because these are Bezier patches themselves, within the hull of their own control points. A
//! patch cut into `m` by `n` cells of two triangles each is off by
//! `(Muu/m^2 + 2 Muv/(m n) + Mvv/n^2)/8` at most, in space, with bounds `M` of its second derivatives (Filip, Magedson and
//! Markot: Surface algorithms using bounds on derivatives, 1986, theorem 1). Of rational patches `S = N/w` these follow from
//! `S_u = (N_u - w_u S)/w` and the like, with the control points moved so that `|S|` is small.
//!
//! A sum over patches as in some papers means their union, each over its own parameters.

mod blossom;
mod bound;
mod curve;
mod derivatives;

pub use curve::{Curve, MOST_POINTS, border, polyline};

use crate::mesh::{MOST_TRIANGLES, Mesh, is_in_range};
use bound::divisions;
use core::fmt;
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::units::Length;

/// The highest degree.
pub const MOST_DEGREE: usize = 24;

/// The most control points.
pub const MOST_CONTROL: usize = 1_000_000;

/// The most control points of all Bezier patches that a surface is divided into.
const MOST_BEZIER: usize = 8_000_000;

/// Largest ratio of two weights. Beyond it a surface bends at single points only.
const WIDEST_WEIGHTS: f64 = 1e6;

/// A tensor product surface. Control points are in rows: the index of `v` runs fastest.
#[derive(Clone, Debug, PartialEq)]
pub struct Nurbs {
    /// Degrees in u and v; 3 and 3 is bicubic.
    pub degrees: [usize; 2],
    /// Knots in u and v that do not decrease, in each direction as many as control points and one more than the degree.
    pub knots: [Vec<f64>; 2],
    /// Control points, in the unit of the file or in mm.
    pub control: Vec<Point3>,
    /// A weight above 0 for each control point, or none at all.
    pub weights: Vec<f64>,
}

/// A Bezier patch. Control points are in rows: the index of `v` runs fastest.
#[derive(Clone, Debug, PartialEq)]
pub struct Bezier {
    /// Degrees in u and v; 3 and 3 is bicubic.
    pub degrees: [usize; 2],
    /// Control points, one more in each direction than the degree.
    pub control: Vec<Point3>,
}

/// Why control points do not make a surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PatchError {
    /// A degree is 0 or above [`MOST_DEGREE`].
    Degree,
    /// Another number of control points than degrees and knots ask for, or more than [`MOST_CONTROL`].
    ControlCount,
    /// A knot is not a number or smaller than the one before, or repeats so often that the surface falls apart.
    Knots,
    /// All knots that count are equal, or there is no patch.
    NoExtent,
    /// The patches have more control points in all than are worked with: many patches of a high degree.
    TooMany,
    /// A control point is out of range.
    OutOfRange {
        /// The control point, from 0.
        index: usize,
    },
    /// Another number of weights than control points; or a weight that is not above 0, or a million times another one.
    Weights,
    /// The tolerance is not above 0, or asks for more triangles than a mesh may have.
    Tolerance,
}

impl fmt::Display for PatchError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Degree => write!(f, "degrees of surfaces go from 1 to {MOST_DEGREE}"),
            Self::ControlCount => write!(f, "the number of control points does not fit degrees and knots"),
            Self::Knots => write!(f, "the knots do not ascend, or repeat too often"),
            Self::TooMany => write!(f, "there are too many patches of this degree"),
            Self::NoExtent => write!(f, "the surface has no extent"),
            Self::OutOfRange { index } => write!(f, "control point {index} is out of range"),
            Self::Weights => write!(f, "the weights are not above 0, or differ too much"),
            Self::Tolerance => write!(f, "the tolerance asks for more triangles than a surface may have"),
        }
    }
}

impl core::error::Error for PatchError {}

/// A control point times its weight, and the weight.
type Weighted = [f64; 4];

/// A Bezier patch in homogeneous coordinates.
#[derive(Clone, Debug)]
struct Piece {
    degrees: [usize; 2],
    control: Vec<Weighted>,
}

/// The mesh of a B-spline surface, with or without weights. The surface lies within the tolerance of it, in space.
///
/// # Errors
/// See [`PatchError`].
pub fn nurbs(surface: &Nurbs, tolerance: Length) -> Result<Mesh, PatchError> {
    let counts = check(surface)?;
    let tolerance = positive(tolerance)?;
    let weighted = weighted(&surface.control, &surface.weights);
    let (pieces, across) = blossom::pieces(surface, counts, &weighted);
    tessellated(&pieces, across, tolerance)
}

/// The mesh of Bezier patches, each over its own parameters. Each patch lies within the tolerance of its triangles, in
/// space. All are divided alike, so that patches that share a border stay joined.
///
/// # Errors
/// See [`PatchError`].
pub fn patches(patches: &[Bezier], tolerance: Length) -> Result<Mesh, PatchError> {
    let tolerance = positive(tolerance)?;
    let mut pieces = Vec::with_capacity(patches.len());
    let mut before = 0;
    for patch in patches {
        check_degrees(patch.degrees)?;
        let [p, q] = patch.degrees;
        if patch.control.len() != (p + 1) * (q + 1) {
            return Err(PatchError::ControlCount);
        }
        check_control(&patch.control, before)?;
        before += patch.control.len();
        pieces.push(Piece {
            degrees: patch.degrees,
            control: patch.control.iter().map(|p| [p.x, p.y, p.z, 1.0]).collect(),
        });
    }
    let mut divided = [1.0_f64; 2];
    for piece in &pieces {
        let [u, v] = divisions(piece, tolerance);
        divided = [divided[0].max(u), divided[1].max(v)];
    }
    let meshes = pieces
        .iter()
        .map(|piece| grid_of(core::slice::from_ref(piece), 1, &[divided[0]], &[divided[1]]));
    union(meshes)
}

/// The share of the tolerance that each of several surfaces gets: along a border that two of them share, both together
/// stay within it.
const SHARED: f64 = 0.4;

/// The mesh of several B-spline surfaces, each within the tolerance of its triangles, in space. Where two share a border,
/// what gapes between their triangles is narrower than the tolerance.
///
/// # Errors
/// See [`PatchError`]. [`nurbs`] says which surface is wrong.
pub fn several(surfaces: &[Nurbs], tolerance: Length) -> Result<Mesh, PatchError> {
    match surfaces {
        [only] => nurbs(only, tolerance),
        all => union(
            all.iter()
                .map(|surface| nurbs(surface, Length::mm(SHARED * tolerance.to_mm()))),
        ),
    }
}

/// All triangles of several meshes.
fn union(meshes: impl Iterator<Item = Result<Mesh, PatchError>>) -> Result<Mesh, PatchError> {
    let (mut corners, mut triangles) = (Vec::new(), Vec::new());
    for mesh in meshes {
        let mesh = mesh?;
        let first = corners.len();
        if triangles.len() + mesh.triangles().len() > MOST_TRIANGLES {
            return Err(PatchError::Tolerance);
        }
        corners.extend_from_slice(mesh.corners());
        triangles.extend(
            mesh.triangles()
                .iter()
                .map(|t| t.map(|index| index + first as u32)),
        );
    }
    if triangles.is_empty() {
        return Err(PatchError::NoExtent);
    }
    Mesh::new(corners, triangles).map_err(|_| PatchError::Tolerance)
}

fn positive(tolerance: Length) -> Result<f64, PatchError> {
    let tolerance = tolerance.to_mm();
    if tolerance > 0.0 {
        Ok(tolerance)
    } else {
        Err(PatchError::Tolerance)
    }
}

/// Control points times their weights, which are 1 where there are none.
fn weighted(control: &[Point3], weights: &[f64]) -> Vec<Weighted> {
    let weighted = |(index, p): (usize, &Point3)| {
        let weight = weights.get(index).copied().unwrap_or(1.0);
        [p.x * weight, p.y * weight, p.z * weight, weight]
    };
    control.iter().enumerate().map(weighted).collect()
}

fn check_degrees(degrees: [usize; 2]) -> Result<(), PatchError> {
    degrees.into_iter().try_for_each(check_degree)
}

fn check_degree(degree: usize) -> Result<(), PatchError> {
    if (1..=MOST_DEGREE).contains(&degree) {
        Ok(())
    } else {
        Err(PatchError::Degree)
    }
}

/// Looks at control points, of which so many came before in other patches.
fn check_control(control: &[Point3], before: usize) -> Result<(), PatchError> {
    if before + control.len() > MOST_CONTROL {
        return Err(PatchError::ControlCount);
    }
    match control.iter().position(|&point| !is_in_range(point)) {
        Some(index) => Err(PatchError::OutOfRange {
            index: before + index,
        }),
        None => Ok(()),
    }
}

/// The numbers of control points in u and v of a B-spline surface that exists.
fn check(surface: &Nurbs) -> Result<[usize; 2], PatchError> {
    check_degrees(surface.degrees)?;
    check_control(&surface.control, 0)?;
    let mut counts = [0; 2];
    for ((count, knots), degree) in counts.iter_mut().zip(&surface.knots).zip(surface.degrees) {
        *count = check_knots(degree, knots)?;
    }
    if counts[0].checked_mul(counts[1]) != Some(surface.control.len()) {
        return Err(PatchError::ControlCount);
    }
    check_weights(&surface.weights, surface.control.len())?;
    let of_pieces = |axis: usize| {
        let degree = surface.degrees[axis];
        blossom::spans(&surface.knots[axis], degree, counts[axis]).len() * (degree + 1)
    };
    match of_pieces(0).checked_mul(of_pieces(1)) {
        Some(all) if all <= MOST_BEZIER => Ok(counts),
        Some(_) | None => Err(PatchError::TooMany),
    }
}

/// The number of control points that knots ask for.
fn check_knots(degree: usize, knots: &[f64]) -> Result<usize, PatchError> {
    let count = knots
        .len()
        .checked_sub(degree + 1)
        .ok_or(PatchError::ControlCount)?;
    if count <= degree {
        return Err(PatchError::ControlCount);
    }
    // Refuses what is not a number too.
    let ascends =
        knots.windows(2).all(|pair| pair[0] <= pair[1]) && knots.iter().all(|knot| knot.is_finite());
    let inner = knots.get(1..knots.len() - 1).unwrap_or_default();
    let falls_apart = inner
        .windows(degree + 1)
        .any(|window| window.first() == window.last());
    if !ascends || falls_apart {
        return Err(PatchError::Knots);
    }
    let spans = knots.get(degree..=count).unwrap_or_default();
    if spans.first() == spans.last() {
        return Err(PatchError::NoExtent);
    }
    Ok(count)
}

/// Looks at the weights of so many control points.
fn check_weights(weights: &[f64], count: usize) -> Result<(), PatchError> {
    let largest = weights.iter().copied().fold(0.0, f64::max);
    let is_good = |weight: &f64| *weight > 0.0 && weight.is_finite() && largest / weight <= WIDEST_WEIGHTS;
    if !weights.is_empty() && (weights.len() != count || !weights.iter().all(is_good)) {
        return Err(PatchError::Weights);
    }
    Ok(())
}

/// The mesh of a grid of pieces, so many of them in v, each row and column divided as often as its most curved piece asks.
fn tessellated(pieces: &[Piece], across: usize, tolerance: f64) -> Result<Mesh, PatchError> {
    let mut along_u = vec![1.0_f64; pieces.len() / across.max(1)];
    let mut along_v = vec![1.0_f64; across];
    for (row, u) in pieces.chunks(across.max(1)).zip(&mut along_u) {
        for (piece, v) in row.iter().zip(&mut along_v) {
            let [m, n] = divisions(piece, tolerance);
            *u = u.max(m);
            *v = v.max(n);
        }
    }
    grid_of(pieces, across, &along_u, &along_v)
}

/// The mesh of a grid of pieces with the given divisions of its rows and columns.
fn grid_of(pieces: &[Piece], across: usize, along_u: &[f64], along_v: &[f64]) -> Result<Mesh, PatchError> {
    let total = |parts: &[f64]| parts.iter().sum::<f64>() + 1.0;
    // Also refuses what is not a number.
    let cells = total(along_u) * total(along_v);
    if cells.partial_cmp(&(MOST_TRIANGLES as f64 / 2.0)) != Some(core::cmp::Ordering::Less) {
        return Err(PatchError::Tolerance);
    }
    let us = parameters(along_u);
    let vs = parameters(along_v);
    let mut corners = Vec::with_capacity(us.len() * vs.len());
    for &(row, u) in &us {
        for &(column, v) in &vs {
            let piece = pieces.get(row * across + column).ok_or(PatchError::NoExtent)?;
            corners.push(piece.at(u, v));
        }
    }
    crate::grid::rows(corners, vs.len()).ok_or(PatchError::Tolerance)
}

/// Which piece, and where in it; the end of a piece is the start of the next one.
fn parameters(divisions: &[f64]) -> Vec<(usize, f64)> {
    let mut all = Vec::new();
    for (place, &parts) in divisions.iter().enumerate() {
        all.extend((0..parts as u32).map(|part| (place, f64::from(part) / parts)));
    }
    all.push((divisions.len().saturating_sub(1), 1.0));
    all
}

impl Piece {
    /// The point at parameters from 0 to 1, by de Casteljau's construction.
    fn at(&self, u: f64, v: f64) -> Point3 {
        let columns = self.degrees[1] + 1;
        let mut column: Vec<Weighted> = self
            .control
            .chunks(columns)
            .map(|row| casteljau(row.to_vec(), v))
            .collect();
        let [x, y, z, w] = casteljau(core::mem::take(&mut column), u);
        Point3::new(x / w, y / w, z / w)
    }
}

fn casteljau(mut points: Vec<Weighted>, share: f64) -> Weighted {
    for end in (1..points.len()).rev() {
        for i in 0..end {
            points[i] = lerp(points[i], points[i + 1], share);
        }
    }
    points.first().copied().unwrap_or([0.0, 0.0, 0.0, 1.0])
}

/// The point a share of the way; at shares of 0 and 1 exactly the ends.
fn lerp(a: Weighted, b: Weighted, share: f64) -> Weighted {
    core::array::from_fn(|i| a[i] * (1.0 - share) + b[i] * share)
}

#[cfg(test)]
mod tests;
