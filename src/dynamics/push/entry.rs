//! How far an edge may be off while it comes into the material and the arm swings.
//!
//! On its springs an arm moves as `M x'' + D x' + K x = Q`, at the controller's axes, where `Q` are the torques of the force. Take
//! `sqrt(x K x)` as the distance of two places of the arm. A force that sets in at once moves the place where the arm would rest by
//! `K^-1 Q`; from then on the energy about the new place only falls, so the arm stays within `sqrt(Q K^-1 Q)` of it, whatever its masses
//! and its damping are. A flank is off by `n x`, so it stays within `sqrt(n K^-1 n) sqrt(Q K^-1 Q)` of where it would rest (Cauchy and
//! Schwarz).
//!
//! An edge that comes in bit by bit, in any order, is a sum of such forces. Each bit swings about its own place, so together
//! they swing by no more than the sum of their distances. An edge that leaves an arm at rest is the same in reverse: what each bit did
//! comes to nothing, and swings about that by no more than its distance.

use super::{Amount, By, Force, Push, corners};
use crate::chain::{Column, JOINTS};
use crate::springs::Springs;
use core::array;
use vcutc_geometry::number::{Along, Interval};

impl Push {
    /// All shifts of any place of the edge along the normal while it comes in from rest, in the middle of a part of a cut and everywhere
    /// on it, in m. `by` is what shifts the ends of the edge. The forces and the springs may be anything within their spread, as long as
    /// they stay as they are.
    pub(super) fn entering(
        &self,
        by: [[By; 2]; 2],
        columns: &[Column<Along>; JOINTS],
        springs: &Springs,
    ) -> [Interval; 2] {
        // Tip and edge may come in one after the other.
        let rests = |by: By| by.tip.hull(by.edge).hull(by.tip + by.edge);
        let [tip, end] = by.map(|views| views.map(rests));
        let swings = [
            self.swing(columns, springs, Along::middle, 0.0),
            self.swing(columns, springs, Along::value, self.turns),
        ];
        array::from_fn(|view| {
            let rests = Interval::ZERO.hull(tip[view]).hull(end[view]);
            rests + Interval::around(0.0, swings[view])
        })
    }

    /// How far it swings about where it would rest, either way, where `view` looks and directions may be off by so much.
    fn swing(
        &self,
        columns: &[Column<Along>; JOINTS],
        springs: &Springs,
        view: fn(Along) -> Interval,
        turns: f64,
    ) -> f64 {
        let off = columns.map(|column| turns * column.largest(self.edge));
        let distance = |torques: [f64; JOINTS]| {
            let each = torques.into_iter().zip(springs.each());
            let squares = each.map(|(torque, spring)| spring.any().high * torque * torque);
            libm::sqrt(squares.sum())
        };
        let ends = self
            .forces()
            .map(|force| self.torques_at_ends(columns, force.direction))
            .map(|ends| ends.map(|torques| torques.map(view)));
        let pushed = |amount: fn(&Force) -> Amount, end: usize| {
            let amounts = self.forces().map(|force| amount(force).any());
            let size: f64 = amounts.iter().map(|amount| amount.magnitude()).sum();
            // A distance is convex: it is largest where all parts of a force are at an end.
            let distances = corners(amounts).map(|parts| {
                distance(array::from_fn(|axis| {
                    let each = parts.into_iter().zip(&ends);
                    let torque = each.fold(Interval::ZERO, |sum, (part, ends)| sum + ends[end][axis] * part);
                    torque.magnitude() + size * off[axis]
                }))
            });
            distances.fold(0.0, f64::max)
        };
        // Along the edge the distance for each bit of it is convex, so its mean is at most that of the ends.
        let edge = 0.5 * (pushed(|force| force.edge, 0) + pushed(|force| force.edge, 1));
        let tip = pushed(|force| force.tip, 0);
        let normals = self
            .normals(columns)
            .map(|normal| distance(array::from_fn(|axis| view(normal[axis]).magnitude() + off[axis])));
        normals[0].max(normals[1]) * (edge + tip)
    }
}
