//! Surfaces ruled straight between profiles, which is what wings are.
//!
//! Profiles stand at planes `y = c`. Between two neighbours, places with the same share of the way across both are joined
//! by straight lines: on a tapered wing these are the lines of equal share of the chord. Over each step across, the
//! surface is bilinear; two triangles in its place are off by a quarter of its twist `|P00 - P10 - P01 + P11|` at most, and
//! dividing the lines into `m` equal parts divides the twist by `m`.

use crate::grid::rows;
use crate::mesh::{MOST_TRIANGLES, Mesh, difference};
use core::fmt;
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::units::Length;
use vcutc_geometry::profile::Profile;

/// Shares nearer to each other than this are one.
const SAME_SHARE: f64 = 1e-12;

/// Why there is no loft.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LoftError {
    /// Fewer than two profiles.
    TooFew,
    /// A profile does not lie beyond the one before along y, or its y is out of range.
    NotAscending {
        /// The profile, from 0.
        index: usize,
    },
    /// The tolerance is not above 0, or asks for more triangles than a mesh may have.
    Tolerance,
}

impl fmt::Display for LoftError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooFew => write!(f, "a loft takes two profiles or more"),
            Self::NotAscending { index } => write!(f, "profile {index} does not lie beyond the one before"),
            Self::Tolerance => write!(f, "the tolerance asks for more triangles than a surface may have"),
        }
    }
}

impl core::error::Error for LoftError {}

/// The mesh of the surface that is ruled straight between profiles at increasing y. The surface lies within the
/// tolerance of it, in space; on the profiles both are equal.
///
/// # Errors
/// See [`LoftError`].
pub fn loft(profiles: &[(Length, &Profile)], tolerance: Length) -> Result<Mesh, LoftError> {
    if profiles.len() < 2 {
        return Err(LoftError::TooFew);
    }
    let rises = |pair: &[(Length, &Profile)]| pair[1].0.to_mm() - pair[0].0.to_mm() >= 1e-6;
    if let Some(index) = profiles.windows(2).position(|pair| !rises(pair)) {
        return Err(LoftError::NotAscending { index: index + 1 });
    }
    let tolerance = tolerance.to_mm();
    if tolerance.partial_cmp(&0.0) != Some(core::cmp::Ordering::Greater) {
        return Err(LoftError::Tolerance);
    }
    let shares = shares(profiles);
    let lines: Vec<Vec<Point3>> = profiles
        .iter()
        .map(|(y, profile)| at(&shares, y.to_mm(), profile))
        .collect();
    let mut corners: Vec<Point3> = Vec::new();
    for pair in lines.windows(2) {
        let [from, to] = pair else { continue };
        let parts = (twist(from, to) / (4.0 * tolerance)).ceil().max(1.0);
        let room = MOST_TRIANGLES.saturating_sub(corners.len()) / shares.len().max(1);
        if parts > room as f64 {
            return Err(LoftError::Tolerance);
        }
        let parts = parts as u32;
        for part in 0..parts {
            let share = f64::from(part) / f64::from(parts);
            corners.extend(from.iter().zip(to).map(|(a, b)| between(*a, *b, share)));
        }
    }
    corners.extend(lines.last().into_iter().flatten());
    rows(corners, shares.len()).ok_or(LoftError::Tolerance)
}

/// The shares of the way across at which any profile has a corner.
fn shares(profiles: &[(Length, &Profile)]) -> Vec<f64> {
    let mut shares: Vec<f64> = profiles
        .iter()
        .flat_map(|(_, profile)| {
            let (start, end) = profile.span();
            profile
                .points()
                .iter()
                .map(move |point| (point.x - start) / (end - start))
        })
        .collect();
    shares.sort_unstable_by(f64::total_cmp);
    shares.dedup_by(|next, kept| *next - *kept < SAME_SHARE);
    // The last is the end, exactly.
    if let Some(last) = shares.last_mut() {
        *last = 1.0;
    }
    shares
}

fn at(shares: &[f64], y: f64, profile: &Profile) -> Vec<Point3> {
    let (start, end) = profile.span();
    shares
        .iter()
        .map(|share| {
            let x = if *share == 1.0 {
                end
            } else {
                start + (end - start) * share
            };
            Point3::new(x, y, profile.height(x))
        })
        .collect()
}

/// The greatest twist of all steps across.
fn twist(from: &[Point3], to: &[Point3]) -> f64 {
    let steps = from.windows(2).zip(to.windows(2));
    steps
        .map(|(a, b)| {
            let [u, v] = [difference(a[0], a[1]), difference(b[0], b[1])];
            libm::hypot(libm::hypot(u[0] - v[0], u[1] - v[1]), u[2] - v[2])
        })
        .fold(0.0, f64::max)
}

fn between(a: Point3, b: Point3, share: f64) -> Point3 {
    Point3::new(
        a.x + (b.x - a.x) * share,
        a.y + (b.y - a.y) * share,
        a.z + (b.z - a.z) * share,
    )
}

#[cfg(test)]
mod tests;
