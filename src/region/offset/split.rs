//! Moved walls, split where they cross, and the slices that belong to a level.

use super::chain::Opening;
use super::raw::Raw;
use super::{ALIKE, JOIN, OffsetFault, Origin, Scratch};
use crate::boxes::Dense;
use crate::curve::{self, Curve};
use crate::place::Place;

/// Crossings count as far beyond the ends of a piece, in mm.
const SLACK: f64 = 1e-9;

/// Where a line is sampled: a share of its way.
const OFF_THE_MIDDLE: f64 = 0.41;

/// Up to so many curves are compared each with each.
const FEW: usize = 48;

/// Most places that are compared to join ends: so many for each, and some more.
const MOST_PER_PLACE: usize = 200;
const MOST_AT_LEAST: usize = 1_000_000;

/// Where curves are split.
#[derive(Clone, Debug, Default)]
pub(super) struct Splits {
    /// Curve, how far along it, and the place.
    cuts: Vec<(u32, u64, u32)>,
    /// All places; the first two of each curve are its ends.
    pub(super) places: Vec<Place>,
    /// The place that stands for each, after joining.
    pub(super) stands: Vec<u32>,
    /// Places where ways may end.
    pub(super) gates: Vec<u32>,
    /// Places by their first coordinate.
    order: Vec<(u64, u32)>,
}

/// A part of a curve between two places.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slice {
    pub(super) curve: u32,
    pub(super) from: u32,
    pub(super) to: u32,
}

/// Finds where curves cross each other, and the gates of open sides.
pub(super) fn crossings(scratch: &mut Scratch, open: Option<&Opening>) -> Result<(), Dense> {
    let Scratch {
        raws,
        extents,
        tree,
        split,
        ..
    } = scratch;
    split.begin(raws);
    if raws.len() <= FEW {
        for (j, (second, extent)) in raws.iter().zip(extents.iter()).enumerate() {
            for (i, (first, other)) in raws.iter().zip(extents.iter()).enumerate().take(j) {
                if extent.grown(JOIN).meets(*other) {
                    split.cross(i as u32, first, j as u32, second);
                }
            }
        }
    } else {
        tree.rebuild(extents);
        tree.first_pair(JOIN, &mut |i, j| {
            let (first, second) = (raws.get(i as usize)?, raws.get(j as usize)?);
            split.cross(i, first, j, second);
            None::<()>
        })?;
    }
    let gates = open.map_or(&[][..], |open| &open.gates);
    for (number, raw) in (0..).zip(raws.iter()) {
        for gate in gates {
            split.cross_gate(number, raw, gate);
        }
    }
    Ok(())
}

impl Splits {
    fn begin(&mut self, raws: &[Raw]) {
        self.cuts.clear();
        self.places.clear();
        self.gates.clear();
        for (number, raw) in (0..).zip(raws) {
            let piece = raw.curve.piece;
            self.cuts.push((number, 0, 2 * number));
            self.cuts.push((number, u64::MAX, 2 * number + 1));
            self.places.extend([piece.from, piece.to]);
        }
    }

    fn cross(&mut self, i: u32, first: &Raw, j: u32, second: &Raw) {
        let (one, other) = (&first.curve, &second.curve);
        // Curves that go smoothly on in each other have nothing else in common, but for the two halves of a circle.
        if goes_on(first, second) || goes_on(second, first) {
            return;
        }
        for at in curve::crossings(one, other).into_iter().flatten() {
            if one.is_beside(at, SLACK) && other.is_beside(at, SLACK) {
                let place = self.places.len() as u32;
                self.places.push(at);
                self.cuts.push((i, rank(order(one, at)), place));
                self.cuts.push((j, rank(order(other, at)), place));
            }
        }
        self.ends_on(i, one, j, other);
        self.ends_on(j, other, i, one);
    }

    /// Splits a curve where another one ends on it.
    fn ends_on(&mut self, part: u32, curve: &Curve, whole: u32, other: &Curve) {
        for (place, end) in [(2 * part, curve.piece.from), (2 * part + 1, curve.piece.to)] {
            if other.is_beside(end, 0.0) && other.left_of(end).abs() <= JOIN / 2.0 {
                self.cuts.push((whole, rank(order(other, end)), place));
            }
        }
    }

    fn cross_gate(&mut self, number: u32, raw: &Raw, gate: &Curve) {
        for at in curve::crossings(&raw.curve, gate).into_iter().flatten() {
            if raw.curve.is_beside(at, SLACK) && gate.is_beside(at, JOIN) {
                let place = self.places.len() as u32;
                self.places.push(at);
                self.gates.push(place);
                self.cuts.push((number, rank(order(&raw.curve, at)), place));
            }
        }
    }

    /// Lets places that are one stand for each other, and puts the splits of each curve in order.
    pub(super) fn join(&mut self) -> Result<(), OffsetFault> {
        let Self {
            cuts,
            places,
            stands,
            order,
            ..
        } = self;
        cuts.sort_unstable();
        stands.clear();
        stands.extend(0..places.len() as u32);
        order.clear();
        order.extend(
            (0..)
                .zip(places.iter())
                .map(|(number, place)| (rank(place.x), number)),
        );
        order.sort_unstable();
        let at = |number: u32| places.get(number as usize).copied();
        let mut left = places.len() * MOST_PER_PLACE + MOST_AT_LEAST;
        for (rank, &(_, one)) in order.iter().enumerate() {
            let later = order.get(rank + 1..).unwrap_or(&[]);
            for &(_, other) in later {
                let Some((a, b)) = at(one).zip(at(other)).filter(|(a, b)| b.x - a.x <= JOIN) else {
                    break;
                };
                left = left.checked_sub(1).ok_or(OffsetFault::Dense)?;
                if (a.y - b.y).abs() <= JOIN {
                    unite(stands, one, other);
                }
            }
        }
        for number in 0..stands.len() as u32 {
            let root = root(stands, number);
            if let Some(stand) = stands.get_mut(number as usize) {
                *stand = root;
            }
        }
        Ok(())
    }
}

fn root(stands: &mut [u32], mut number: u32) -> u32 {
    while let Some(&up) = stands.get(number as usize)
        && up != number
    {
        let above = stands.get(up as usize).copied().unwrap_or(up);
        if let Some(stand) = stands.get_mut(number as usize) {
            *stand = above;
        }
        number = above;
    }
    number
}

fn unite(stands: &mut [u32], one: u32, other: u32) {
    let (one, other) = (root(stands, one), root(stands, other));
    if let Some(stand) = stands.get_mut(one.max(other) as usize) {
        *stand = one.min(other);
    }
}

/// Whether one curve goes smoothly on in the other.
fn goes_on(one: &Raw, other: &Raw) -> bool {
    one.next.is_some() && one.next == other.link && {
        let gap = one.curve.piece.to.minus(other.curve.piece.from);
        gap.dot(gap) <= ALIKE * ALIKE
    }
}

/// A whole number that grows with a number.
fn rank(number: f64) -> u64 {
    let bits = number.to_bits();
    if bits >> 63 == 0 { bits | 1 << 63 } else { !bits }
}

/// A number that grows along a curve: the angle an arc has turned by since its middle, measured on a square instead of a circle. It
/// is that of the nearest place, so that places a little beside the curve are not taken for others.
fn order(curve: &Curve, place: Place) -> f64 {
    let way = place.minus(curve.middle);
    if curve.bend == 0.0 {
        return curve.ahead.dot(way);
    }
    let normal = curve.normal.minus(way.times(curve.bend));
    let (along, across) = (curve.normal.dot(normal), curve.normal.cross(normal));
    let across = across * curve.bend.signum();
    let share = across / (along.abs() + across.abs());
    if along >= 0.0 {
        share
    } else {
        2.0_f64.copysign(across) - share
    }
}

/// Cuts the curves where they are split, and keeps the slices within which `keeps` holds.
pub(super) fn slices(scratch: &mut Scratch, keeps: &mut dyn FnMut(Origin, Place) -> bool) {
    let Scratch {
        raws, split, slices, ..
    } = scratch;
    slices.clear();
    for pair in split.cuts.windows(2) {
        let [(curve, _, from), (next, _, to)] = *pair else {
            continue;
        };
        if curve != next {
            continue;
        }
        let stand = |place: u32| split.stands.get(place as usize).copied().unwrap_or(place);
        let slice = Slice {
            curve,
            from: stand(from),
            to: stand(to),
        };
        let Some(raw) = raws.get(curve as usize) else {
            continue;
        };
        let is_round = raw.curve.piece.sweep.abs() > core::f64::consts::PI;
        if slice.from == slice.to && !(is_round && from % 2 == 0 && to == from + 1) {
            continue;
        }
        let ends = split.places.get(from as usize).zip(split.places.get(to as usize));
        if let Some((&from, &to)) = ends
            && keeps(raw.origin, sample(&raw.curve, from, to))
        {
            slices.push(slice);
        }
    }
}

/// A place within a part of a curve, off its middle: where loops touch, symmetry may put the middle just beside the touch, as
/// far from it as the level though beyond the wall.
fn sample(curve: &Curve, from: Place, to: Place) -> Place {
    let place = if curve.bend == 0.0 {
        from.lerp(to, OFF_THE_MIDDLE)
    } else {
        middle(curve, from, middle(curve, from, to))
    };
    // Ends may lie a little beside the curve; what is asked is where it is.
    curve.foot(place)
}

/// The middle of a part of a curve.
pub(super) fn middle(curve: &Curve, from: Place, to: Place) -> Place {
    let half = from.lerp(to, 0.5);
    if curve.bend == 0.0 {
        return half;
    }
    // The sagitta is half the chord times tan(angle / 4).
    let chord = to.minus(from);
    let size = chord.dot(chord).sqrt();
    let sine = curve.bend * size / 2.0;
    let cosine = curve.direction(from).dot(chord) / size;
    let sagitta = if 1.0 + cosine > ALIKE {
        sine / (1.0 + cosine)
    } else {
        // Nearly all of a circle.
        (1.0 - cosine) / sine
    };
    half.minus(chord.left().times(sagitta / 2.0))
}
