//! Offsets of tips against what forces do to the blade.
//!
//! Both flanks of a V share one tip, and each is formed by its displacement along its own normal. Two normals span the plane across the
//! cuts, so one offset of the tip takes out what both yield: of a flank that yields by `e` along its normal `n`, it is `-e` along that.
//! What a flank yields changes along the cut and with the forces; the middle of all that is taken out, and the rest stays. Along a flank
//! nothing is taken out: there its tip stays where the offset puts it, mostly lower than planned.

use super::{Deviations, LEAST, Shifts, Unknown};
use crate::cuts::{Cut, Face};
use crate::peaks::{Held, Sought, Whole, peaks};
use rayon::prelude::*;
use std::collections::BTreeMap;
use vcutc_backend_api::ir::{OpId, OperationId};
use vcutc_backend_api::units::Length;
use vcutc_geometry::curve::Point2;
use vcutc_geometry::grid;
use vcutc_simulation::prove::{Compensation, VNumber};

/// How close the ends of what a flank yields are looked for, in m: what tips are rounded by.
const CLOSE: f64 = 0.5e-6;

/// What two flanks take for different directions: the sine of the angle between their normals.
const APART: f64 = 1e-9;

/// A flank that yields by so much along its normal.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Yields {
    /// Across the cuts.
    normal: Point2,
    /// In mm: positive into the waste.
    by: f64,
}

/// The offsets of the tips of an operation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Offsets {
    /// The largest.
    pub most: Length,
    /// A flank of that V.
    pub op: OpId,
    /// How far a flank lies deeper than planned, at most, whatever stretches of the edge are in the material.
    pub deeper: Length,
}

impl Deviations<'_> {
    /// Offsets of the tips of an operation, on the grid of tips, that take out what its flanks yield by. The program must be the one
    /// whose tips are where they were planned.
    ///
    /// # Errors
    /// Why that is not known.
    pub fn compensation(&self, operation: OperationId) -> Result<Compensation, Unknown> {
        let wholes: Vec<Whole> = self.cuts.wholes_of(operation).collect();
        if wholes.is_empty() {
            return Err(Unknown::Forces);
        }
        let yields: Option<Vec<(VNumber, Yields)>> = wholes
            .into_par_iter()
            .map(|whole| {
                let cut = self.cuts.get(whole.op)?;
                Some((cut.vee, self.yields(cut, whole)?))
            })
            .collect();
        let mut vees: BTreeMap<VNumber, Vec<Yields>> = BTreeMap::new();
        for (vee, yields) in yields.ok_or(Unknown::ClosedForm)? {
            vees.entry(vee).or_default().push(yields);
        }
        let offsets = vees.into_iter().map(|(vee, flanks)| (vee, offset(&flanks)));
        Ok(Compensation::new(offsets.collect()))
    }

    /// The middle of what a flank yields by, over its cut and all forces and stiffnesses.
    fn yields(&self, cut: &Cut<'_>, whole: Whole) -> Option<Yields> {
        let normal = self.cuts.normal_in_work(cut)?;
        let by = match self.cuts.face(cut)? {
            // It yields as far to either side.
            Face::Upright => 0.0,
            Face::Left | Face::Right => {
                let ways = self.of_cut(whole, CLOSE, |push, columns, springs| {
                    [push.loaded(columns, springs)]
                })?;
                500.0 * (ways.into_waste - ways.into_part)
            }
        };
        Some(Yields {
            normal: Point2 {
                x: normal.x,
                z: normal.z,
            },
            by,
        })
    }

    /// How far the tips of an operation are offset; none of one that is not compensated, or where it is not known how deep its flanks lie.
    #[must_use]
    pub fn offsets(&self, operation: OperationId) -> Option<Offsets> {
        let compensation = self.cuts.known().compensation(operation)?;
        let sizes = self.cuts.wholes_of(operation).filter_map(|whole| {
            let offset = compensation.offset(self.cuts.get(whole.op)?.vee);
            Some((whole.op, libm::hypot(offset.x, offset.z)))
        });
        let (op, most) = sizes.reduce(|best, next| if next.1 > best.1 { next } else { best })?;
        Some(Offsets {
            most: Length::mm(most),
            op,
            deeper: self.into_part_with_any_edge(operation)?,
        })
    }

    /// How far a flank of an operation lies into the part at most, whatever stretches of the edge are in the material, and where none are.
    #[must_use]
    pub fn into_part_with_any_edge(&self, operation: OperationId) -> Option<Length> {
        let sought = Sought {
            least: LEAST,
            limit: None,
        };
        let cuts: Vec<Whole> = self.cuts.wholes_of(operation).collect();
        let [part] = peaks(&cuts, &[sought], |op, part| {
            let shifts: Shifts<1> = |push, columns, springs| [push.shifts(columns, springs)];
            let [[middle, everywhere]] = self.shifts(op, part, shifts)?;
            Some([Held {
                met: middle.into_part,
                most: everywhere.into_part,
            }])
        })?;
        part.most.is_finite().then(|| Length::m(part.most.max(0.0)))
    }
}

/// The offset of a tip with these flanks, in mm.
fn offset(flanks: &[Yields]) -> Point2 {
    let exact = match flanks {
        [one] => {
            let size = libm::hypot(one.normal.x, one.normal.z);
            Point2 {
                x: -one.by * one.normal.x / size,
                z: -one.by * one.normal.z / size,
            }
        }
        [one, other, ..] => {
            let (a, b) = (one.normal, other.normal);
            let sine = a.x * b.z - a.z * b.x;
            if sine.abs() < APART {
                return Point2 { x: 0.0, z: 0.0 };
            }
            Point2 {
                x: (other.by * a.z - one.by * b.z) / sine,
                z: (one.by * b.x - other.by * a.x) / sine,
            }
        }
        [] => return Point2 { x: 0.0, z: 0.0 },
    };
    Point2 {
        x: grid::nearest(exact.x) + 0.0,
        z: grid::nearest(exact.z) + 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn flank(swing: f64, side: f64, by: f64) -> Yields {
        let (sine, cosine) = libm::sincos(swing.to_radians());
        Yields {
            normal: Point2 {
                x: side * cosine,
                z: sine,
            },
            by,
        }
    }

    #[test]
    fn both_flanks_of_the_case_get_their_offset() {
        // What the flanks of K1 and K2 yield, a thousand times as much, so that the grid does not show: 2.451 and 1.361 mm.
        let o = offset(&[flank(34.155, 1.0, 2.451), flank(34.155, -1.0, 1.361)]);
        let (sine, cosine) = libm::sincos(34.155_f64.to_radians());
        let by_hand = [-(2.451 - 1.361) / (2.0 * cosine), -(2.451 + 1.361) / (2.0 * sine)];
        assert!(
            (o.x - by_hand[0]).abs() <= 5e-4 && (o.z - by_hand[1]).abs() <= 5e-4,
            "{o:?}"
        );
    }

    #[test]
    fn flanks_of_unlike_swings_lie_where_they_were_planned() {
        for (left, right, one, other) in [
            (10.0, 50.0, 0.7, -0.2),
            (0.0, 30.0, 0.0, 0.4),
            (45.0, 5.0, -0.3, 0.1),
        ] {
            let flanks = [flank(left, 1.0, one), flank(right, -1.0, other)];
            let o = offset(&flanks);
            for flank in flanks {
                let stays = flank.normal.x * o.x + flank.normal.z * o.z + flank.by;
                // Each coordinate is rounded by half a grid at most.
                assert!(stays.abs() <= 0.71e-3, "{left} {right}: {stays}");
            }
        }
    }

    #[test]
    fn a_single_flank_is_offset_along_its_normal() {
        let one = flank(30.0, -1.0, 0.5);
        let o = offset(&[one]);
        assert!((o.x - 0.433).abs() < 1e-9 && (o.z + 0.25).abs() < 1e-9, "{o:?}");
    }

    #[test]
    fn upright_flanks_keep_their_place() {
        assert_eq!(
            offset(&[flank(0.0, 1.0, 0.0), flank(0.0, -1.0, 0.0)]),
            Point2 { x: 0.0, z: 0.0 }
        );
    }
}
