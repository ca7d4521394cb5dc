//! Files of triangles, STL, OBJ and PLY, of heights on a grid, and of B-spline surfaces, STEP.
//!
//! All readers take the bytes of a file and never guess silently. What cannot be read is a [`DataError`] that says where
//! and why; what was read but passed over is counted in [`Remarks`]. None of these files but STEP carries a unit: numbers are
//! given as they stand.
//!
//! Readers take time in proportion to the file (sorting included, up to a logarithm), and memory of about four times its
//! length at most: counts in a file never make room before its data is seen to be there.

mod gather;
mod heights;
mod obj;
mod ply;
mod step;
mod stl;
mod words;

pub use heights::heights;
pub use obj::obj;
pub use ply::ply;
pub use step::{Advice, ReadStep, Step, StepError};
pub use stl::stl;
pub use vcutc_geometry::import::DataError;

use crate::mesh::Mesh;
use core::ops::Range;
use std::collections::BTreeMap;
use vcutc_geometry::import::shortened;

/// What a file of triangles holds.
#[derive(Clone, Debug, PartialEq)]
pub struct ReadMesh {
    /// Its triangles, in the file's own unit, in the order of the file.
    pub mesh: Mesh,
    /// What is worth reporting about it.
    pub remarks: Remarks,
}

/// What a reader passed over, and what is odd about what it took.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Remarks {
    /// Triangles without area; they were left out.
    pub degenerate: usize,
    /// Triangles with the same three corners as an earlier one; they were left out.
    pub doubled: usize,
    /// Polygons of four corners or more that are not plane; they were taken as fans of triangles.
    pub bent: usize,
    /// How far a corner of these lies from the plane of its polygon at most, in the unit of the file.
    pub most_bent: f64,
    /// What was not taken, by its name in the file, and how often: lines of an OBJ file, elements of a PLY file.
    pub passed_over: BTreeMap<String, usize>,
}

impl Remarks {
    /// Kinds of things passed over that are listed by name; what comes after them is counted together.
    const MOST_KINDS: usize = 32;

    fn pass_over(&mut self, name: &str, times: usize) {
        const OTHERS: &str = "others";
        if times == 0 {
            return;
        }
        let name = shortened(name);
        let known = self.passed_over.contains_key(&name) || self.passed_over.len() < Self::MOST_KINDS;
        *self
            .passed_over
            .entry(if known { name } else { OTHERS.to_owned() })
            .or_default() += times;
    }
}

fn fault(range: Range<usize>, message: impl Into<String>) -> DataError {
    let offset = |place: usize| u32::try_from(place).unwrap_or(u32::MAX);
    DataError {
        start: offset(range.start),
        end: offset(range.end),
        message: message.into(),
    }
}

#[cfg(test)]
mod tests;
