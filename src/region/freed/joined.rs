//! Squares that several slits cover together, where one of them ends beside another.
//!
//! A square that lies in no slit as a whole is quartered, and each quarter may lie in another slit. So two slits that meet at an angle part
//! the ground there as they do in the core, and nothing counts as parted that no blade has passed.

use super::Slits;
use crate::boxes::{Extent, Tree};
use crate::curve::Curve;
use crate::place::Place;
use core::f64::consts::FRAC_1_SQRT_2;

/// How often a square is quartered.
const QUARTERINGS: u32 = 4;

/// All pieces of slits, ready to be asked what they cover.
pub(super) struct Cover {
    curves: Vec<Curve>,
    tree: Tree,
    half: f64,
}

impl Cover {
    pub(super) fn of(slits: Slits<'_>) -> Self {
        let curves: Vec<Curve> = slits
            .ways
            .iter()
            .flatten()
            .map(|&piece| Curve::of(piece))
            .collect();
        let extents: Vec<Extent> = curves
            .iter()
            .map(|curve| curve.extent().grown(slits.half))
            .collect();
        Self {
            tree: Tree::of(&extents),
            curves,
            half: slits.half,
        }
    }

    /// Whether slits cover all of a square together.
    pub(super) fn covers(&self, middle: Place, side: f64) -> bool {
        let mut near: Vec<&Curve> = Vec::new();
        let square = Extent::of(middle, middle).grown(side / 2.0);
        self.tree.meeting(square, &mut |number| {
            near.extend(self.curves.get(number as usize));
        });
        self.quartered(&near, (middle, side), QUARTERINGS)
    }

    fn quartered(&self, near: &[&Curve], (middle, side): (Place, f64), left: u32) -> bool {
        let reach = side * FRAC_1_SQRT_2;
        let is_within = |curve: &&Curve| {
            curve.is_beside(middle, -reach) && curve.left_of(middle).abs() <= self.half - reach
        };
        if near.iter().any(is_within) {
            return true;
        }
        let by = side / 4.0;
        let quarters = [[by, by], [-by, by], [-by, -by], [by, -by]];
        left > 0
            && quarters.iter().all(|&[x, y]| {
                let quarter = (middle.plus(Place::new(x, y)), side / 2.0);
                self.quartered(near, quarter, left - 1)
            })
    }
}
