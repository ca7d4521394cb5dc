//! Vs whose tips run straight between knots that all of them share: where their flanks come out, at every y at once.
//!
//! Between two knots, in a slab, all tips are linear in y. A flank of a new tip `i` that rises by `c` meets the far flank of
//! an older one `j`, which lies `u` beside it, at the height `(z_j - z_i + c u) / 2` over its own tip, if it passes above it:
//! `z_i + c u >= z_j`. Both are linear in y. So an older tip that is passed above at both ends of a slab is so at every y in it, and the
//! greater of its two heights at the ends bounds the reach there. The top of the stock and its sides bound it likewise, and the least
//! bound holds (derived here). The reach of a flank is the greatest that it has in any slab.
//!
//! All flanks rise by the same slope, so what is left is `min over j of z_j + c |x - x_j|`: nowhere steeper than a flank. A flank that
//! has come out meets nothing beyond, and a tip of which another one lies nowhere above counts for nothing.

use super::surface::Side;
use std::collections::BTreeMap;
use vcutc_geometry::columns::Column;

/// The stock around the Vs, in mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Walls {
    /// Its width.
    pub width: f64,
    /// Its height.
    pub height: f64,
}

/// The Vs that are out, by where their tips run. All of them have the same knots.
#[derive(Clone, Debug)]
pub struct Slabs {
    vees: BTreeMap<u64, Vec<Column>>,
    /// Below any tip.
    lowest: f64,
}

impl Default for Slabs {
    fn default() -> Self {
        Self {
            vees: BTreeMap::new(),
            lowest: f64::INFINITY,
        }
    }
}

impl Slabs {
    /// Takes a V out.
    pub fn release(&mut self, vee: Column) {
        self.lowest = self.lowest.min(vee.lowest());
        let column = self.vees.entry(key(vee.x)).or_default();
        if column.iter().any(|known| known.covers(&vee)) {
            return;
        }
        column.retain(|known| !vee.covers(known));
        column.push(vee);
    }

    /// How high above its tip a flank comes out at most, at any y.
    #[must_use]
    pub fn reach(&self, tip: &Column, side: Side, stock: Walls) -> f64 {
        let beside = match side {
            Side::Left => tip.x,
            Side::Right => stock.width - tip.x,
        };
        let beside = tip.flank * beside.max(0.0);
        let slabs = tip.tips.windows(2);
        let mut bounds: Vec<f64> = slabs
            .map(|ends| (stock.height - ends[0].min(ends[1])).min(beside).max(0.0))
            .collect();
        let own = key(tip.x);
        let (left, right) = (self.vees.range(..=own).rev(), self.vees.range(own..));
        match side {
            Side::Left => {
                self.pass(left, tip, &mut bounds);
                self.cover(right, tip, &mut bounds);
            }
            Side::Right => {
                self.pass(right, tip, &mut bounds);
                self.cover(left, tip, &mut bounds);
            }
        }
        bounds.into_iter().fold(0.0, f64::max)
    }

    /// Lowers what bounds a flank in each slab by the older tips on its side, which come the nearest first.
    fn pass<'v>(
        &self,
        older: impl Iterator<Item = (&'v u64, &'v Vec<Column>)>,
        tip: &Column,
        bounds: &mut [f64],
    ) {
        let highest = tip.highest();
        let mut most = bounds.iter().copied().fold(0.0, f64::max);
        for older in older.flat_map(|(_, column)| column) {
            let aside = tip.flank * (older.x - tip.x).abs();
            // No tip farther away bounds a flank by less.
            if (self.lowest - highest + aside) / 2.0 >= most {
                return;
            }
            let ends = tip.tips.windows(2).zip(older.tips.windows(2));
            for (bound, (own, older)) in bounds.iter_mut().zip(ends) {
                let [front, back] = [older[0] - own[0], older[1] - own[1]];
                if aside >= front && aside >= back {
                    *bound = bound.min((front.max(back) + aside) / 2.0).max(0.0);
                }
            }
            most = bounds.iter().copied().fold(0.0, f64::max);
        }
    }

    /// Takes out the slabs in which an older V lies nowhere above that of a tip.
    fn cover<'v>(
        &self,
        older: impl Iterator<Item = (&'v u64, &'v Vec<Column>)>,
        tip: &Column,
        bounds: &mut [f64],
    ) {
        let highest = tip.highest();
        for older in older.flat_map(|(_, column)| column) {
            let aside = tip.flank * (older.x - tip.x).abs();
            if self.lowest + aside > highest {
                return;
            }
            let ends = tip.tips.windows(2).zip(older.tips.windows(2));
            for (bound, (own, older)) in bounds.iter_mut().zip(ends) {
                if older[0] + aside <= own[0] && older[1] + aside <= own[1] {
                    *bound = 0.0;
                }
            }
        }
    }

    /// The Vs that make up what is left, from left to right.
    #[must_use]
    pub fn into_columns(self) -> Vec<Column> {
        let all: Vec<Column> = self.vees.into_values().flatten().collect();
        let is_covered = |vee: &Column| all.iter().any(|other| other != vee && other.covers(vee));
        all.iter().filter(|vee| !is_covered(vee)).cloned().collect()
    }
}

/// A number in the order of x.
fn key(x: f64) -> u64 {
    let bits = (x + 0.0).to_bits();
    let sign = 1 << 63;
    if bits & sign == 0 { bits | sign } else { !bits }
}

#[cfg(test)]
mod tests;
