//! What the Vs of a fan leave over a part of a plane: the least of many planes.
//!
//! A V is a plane on either side of its tip, and so is the top of the stock. Over a polygon, one V after the other takes off the places
//! where it is lower than what was there; what remains are polygons with a plane each, and over a triangle of the part the height
//! between is linear. That is exact up to rounding.

use super::{Heights, above};
use crate::region::{SLACK, width};
use crate::visible::Plane;
use vcutc_geometry::fan::Ruling;

/// The Vs of a fan in a stock.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Ruled {
    pub(super) vees: Vec<Ruling>,
    /// Of the stock, in mm.
    pub(super) depth: f64,
    /// Its height, in mm.
    pub(super) top: f64,
}

/// A plane over the plan: its height at the origin, and its rise over x and over y.
type Over = [f64; 3];

const fn at([start, over_x, over_y]: Over, [x, y]: [f64; 2]) -> f64 {
    start + over_x * x + over_y * y
}

impl Ruled {
    /// Its height over a place.
    pub(super) fn height(&self, place: [f64; 2]) -> f64 {
        let heights = self.vees.iter().map(|vee| vee.height(place, self.depth));
        heights.fold(self.top, f64::min)
    }

    /// What of a region lies under each plane of it, with its heights above a plane.
    pub(crate) fn above(&self, region: &[[f64; 2]], plane: Plane) -> Vec<Heights> {
        let mut pieces: Vec<(Vec<[f64; 2]>, Over)> = vec![(region.to_vec(), [self.top, 0.0, 0.0])];
        for (side, lower) in self.planes(region) {
            let before = core::mem::take(&mut pieces);
            for (piece, higher) in before {
                take_off(&piece, higher, (side, lower), &mut pieces);
            }
        }
        let over = |(piece, top): (Vec<[f64; 2]>, Over)| {
            piece
                .into_iter()
                .map(|place| (place, at(top, place) - plane.at(place)))
                .collect()
        };
        pieces.into_iter().map(over).filter(super::has_area).collect()
    }

    /// The planes that may count over a region, each with the side of its tip on which it holds: x, and 1 to the right of it.
    fn planes(&self, region: &[[f64; 2]]) -> impl Iterator<Item = ([f64; 2], Over)> + '_ {
        let over = |vee: &Ruling, start: f64, more: fn(f64, f64) -> f64| {
            let heights = region.iter().map(|&place| vee.height(place, self.depth));
            heights.fold(start, more)
        };
        let xs = || region.iter().map(|place| place[0]);
        let (from, to) = (
            xs().fold(f64::INFINITY, f64::min),
            xs().fold(f64::NEG_INFINITY, f64::max),
        );
        // No lower than that is any place but one next to a tip, which is below its corners.
        let least = |vee: &Ruling| {
            let aside = vee.flank * (vee.x.clamp(from, to) - vee.x).abs();
            let ends = region.iter().map(|&[_, y]| vee.height([vee.x, y], self.depth));
            ends.fold(f64::INFINITY, f64::min) + aside
        };
        let most = self.vees.iter().map(|vee| over(vee, f64::NEG_INFINITY, f64::max));
        let enough = most.fold(self.top, f64::min);
        let counting: Vec<Ruling> = self
            .vees
            .iter()
            .filter(|vee| least(vee) < enough)
            .copied()
            .collect();
        let depth = self.depth;
        counting.into_iter().flat_map(move |vee| {
            [-1.0, 1.0].map(|side: f64| {
                let along = (vee.ends[1] - vee.ends[0]) / depth;
                let rise = side * vee.flank;
                ([vee.x, side], [vee.ends[0] - rise * vee.x, rise, along])
            })
        })
    }
}

/// Divides a piece by whether a plane that holds on a side of a tip is lower than its own.
fn take_off(
    piece: &[[f64; 2]],
    higher: Over,
    ([tip, side], lower): ([f64; 2], Over),
    out: &mut Vec<(Vec<[f64; 2]>, Over)>,
) {
    let places = |corners: Heights| corners.into_iter().map(|(place, _)| place).collect::<Vec<_>>();
    let cut = |piece: &[[f64; 2]], height: &dyn Fn([f64; 2]) -> f64| {
        let corners: Heights = piece.iter().map(|&place| (place, height(place))).collect();
        places(above(&corners))
    };
    let beside = |place: [f64; 2]| side * (place[0] - tip);
    let gain = |place: [f64; 2]| at(higher, place) - at(lower, place);
    let is_outside = |height: &dyn Fn([f64; 2]) -> f64| piece.iter().all(|&place| height(place) <= 0.0);
    if is_outside(&beside) || is_outside(&gain) {
        out.push((piece.to_vec(), higher));
        return;
    }
    let near = cut(piece, &beside);
    let parts = [
        (cut(piece, &|place| -beside(place)), higher),
        (cut(&near, &|place| -gain(place)), higher),
        (cut(&near, &gain), lower),
    ];
    // What only touches a border belongs to what lies beside it.
    out.extend(
        parts
            .into_iter()
            .filter(|(part, _)| part.len() >= 3 && width(part) > SLACK),
    );
}

#[cfg(test)]
mod tests;
