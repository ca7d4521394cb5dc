//! How far an edge is off while all of the edge that its cut uses is in the material.

use super::{Amount, Force, Push, Yielded, shift};
use crate::chain::{Column, JOINTS};
use crate::springs::Springs;
use core::array;
use vcutc_geometry::number::{Along, Interval};

impl Push {
    /// All shifts of any place of the edge along the normal while its whole length is in the material, in the middle of a part of a cut
    /// and everywhere on it, in m. The forces and the springs may be anything within their spread.
    pub(crate) fn loaded(&self, columns: &[Column<Along>; JOINTS], springs: &Springs) -> [Interval; 2] {
        let pushes = self.forces().map(|force| {
            // A uniform force along the edge amounts to one in its middle.
            [0.0, 0.5 * self.edge].map(|up| self.torques(columns, force.direction, up))
        });
        let ends = self.normals(columns).map(|normal| {
            let shifted = |amount: fn(&Force) -> Amount, place: usize| {
                let yielded = pushes
                    .each_ref()
                    .map(|torques| Yielded::of(&normal, &torques[place], springs));
                let amounts = self.forces().map(amount);
                let turned = self.turned(columns, &normal, &amounts, springs);
                shift(&amounts, &yielded, turned)
            };
            let [tip, edge] = [shifted(|force| force.tip, 0), shifted(|force| force.edge, 1)];
            array::from_fn(|view| tip[view] + edge[view])
        });
        // In between it is in between.
        array::from_fn(|view: usize| {
            let [tip, end]: [[Interval; 2]; 2] = ends;
            tip[view].hull(end[view])
        })
    }
}
