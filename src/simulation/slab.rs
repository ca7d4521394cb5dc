//! Vs whose tips run straight, each at a slope of its own: where their flanks come out, at every y at once.
//!
//! Between both ends of the stock all tips are linear in y: a slab. A flank of a new tip `i` that rises by `c` meets the far flank of
//! an older one `j`, which lies `u` beside it, at the height `(z_j - z_i + c u) / 2` over its own tip, if it passes above it:
//! `z_i + c u >= z_j`. Both are linear in y. So an older tip that is passed above at both ends is so at every y, and the
//! greater of its two heights at the ends bounds the reach. The top of the stock and its sides bound it likewise, and the least
//! bound holds (derived here).
//!
//! All flanks rise by the same slope, so what is left is `min over j of z_j + c |x - x_j|`: nowhere steeper than a flank. A flank that
//! has come out meets nothing beyond, and a tip of which another one lies nowhere above counts for nothing.

use super::surface::Side;
use std::collections::BTreeMap;
use vcutc_geometry::fan::Ruling;

/// The stock around the Vs, in mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Walls {
    /// Its width.
    pub width: f64,
    /// Its height.
    pub height: f64,
}

/// The Vs that are out, by where their tips run.
#[derive(Clone, Debug, Default)]
pub struct Columns(BTreeMap<u64, Vec<Ruling>>);

impl Columns {
    /// Takes a V out.
    pub fn release(&mut self, vee: Ruling) {
        let column = self.0.entry(key(vee.x)).or_default();
        if column.iter().any(|known| known.covers(&vee)) {
            return;
        }
        column.retain(|known| !vee.covers(known));
        column.push(vee);
    }

    /// How high above its tip a flank comes out at most, at any y.
    #[must_use]
    pub fn reach(&self, tip: Ruling, side: Side, stock: Walls) -> f64 {
        let beside = match side {
            Side::Left => tip.x,
            Side::Right => stock.width - tip.x,
        };
        let [front, back] = tip.ends;
        let bound = (stock.height - front.min(back)).min(tip.flank * beside.max(0.0));
        if self.0.values().flatten().any(|older| older.covers(&tip)) {
            return 0.0;
        }
        let own = key(tip.x);
        let columns = match side {
            Side::Left => self.0.range(..=own),
            Side::Right => self.0.range(own..),
        };
        let older = columns.flat_map(|(_, column)| column);
        let bounds = older.filter_map(|older| beyond(tip, *older));
        bounds.fold(bound, f64::min).max(0.0)
    }

    /// The Vs that make up what is left, from left to right.
    #[must_use]
    pub fn into_rulings(self) -> Vec<Ruling> {
        let all: Vec<Ruling> = self.0.into_values().flatten().collect();
        let is_covered = |vee: &Ruling| all.iter().any(|other| other != vee && other.covers(vee));
        all.iter().filter(|vee| !is_covered(vee)).copied().collect()
    }
}

/// How high above its tip a flank comes out at most beside an older tip; none where it does not pass above that at both ends.
fn beyond(tip: Ruling, older: Ruling) -> Option<f64> {
    let aside = tip.flank * (older.x - tip.x).abs();
    let [front, back] = [0, 1].map(|end| older.ends[end] - tip.ends[end]);
    (aside >= front && aside >= back).then(|| (front.max(back) + aside) / 2.0)
}

/// A number in the order of x.
fn key(x: f64) -> u64 {
    let bits = (x + 0.0).to_bits();
    let sign = 1 << 63;
    if bits & sign == 0 { bits | sign } else { !bits }
}

#[cfg(test)]
mod tests;
