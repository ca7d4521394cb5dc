//! Orientations as the text that ends a target.
//!
//! A program has a handful of orientations and perhaps millions of moves, so each is turned into A, B, C and printed
//! once. Equal orientations are then also equal bytes, which makes a move that keeps the orientation visibly keep it.

use vcutc_backend_api::backend::EmitError;
use vcutc_backend_api::geometry::Orientation;
use vcutc_backend_api::ir::OrientationId;
use vcutc_backend_api::number::{FixedDecimal, NotFinite};

/// The texts `,A 0.0000,B 0.0000,C 0.0000` of all orientations of a program.
pub(crate) struct Attitudes {
    bytes: Vec<u8>,
    /// Where each text ends, and the next begins.
    ends: Vec<usize>,
}

impl Attitudes {
    /// Prints all orientations.
    pub(crate) fn new(orientations: &[Orientation], format: FixedDecimal) -> Result<Self, NotFinite> {
        let mut bytes = Vec::new();
        let mut ends = Vec::with_capacity(orientations.len());
        for &orientation in orientations {
            push_angles(&mut bytes, orientation, format)?;
            ends.push(bytes.len());
        }
        Ok(Self { bytes, ends })
    }

    /// The text of an orientation.
    pub(crate) fn text(&self, id: OrientationId) -> Result<&[u8], EmitError> {
        let index = id.0 as usize;
        let start = match index.checked_sub(1) {
            Some(before) => self.ends.get(before).copied(),
            None => Some(0),
        };
        start
            .zip(self.ends.get(index).copied())
            .and_then(|(start, end)| self.bytes.get(start..end))
            .ok_or(EmitError::Internal("an orientation is not in its table"))
    }
}

/// Appends `,A ..,B ..,C ..` in degrees, `R = Rz(A) Ry(B) Rx(C)` [K-SI].
pub(crate) fn push_angles(
    out: &mut Vec<u8>,
    orientation: Orientation,
    format: FixedDecimal,
) -> Result<(), NotFinite> {
    let angles = orientation.to_zyx();
    for (name, angle) in [(b",A ", angles.a), (b",B ", angles.b), (b",C ", angles.c)] {
        out.extend_from_slice(name);
        format.push(out, angle.to_deg())?;
    }
    Ok(())
}
