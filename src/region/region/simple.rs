//! That loops neither cross nor overlap, themselves or each other. They may touch in places.
//!
//! Edges that follow each other have a known crossing, their joint; only another one is a fault. Other edges that cross between
//! their ends do so in earnest unless they lap by less than [`NEAR`]. Where an end lies on another edge, the ways through that place
//! decide: they cross where the branches of one part those of the other.

use super::{Drawn, EdgeName, NEAR, RegionFault, Ring};
use crate::curve::{Curve, crossings, other_crossing};
use crate::place::Place;

/// How far from a place the branches through it are compared, in mm, at most.
const PROBE: f64 = 1e-2;

pub(super) fn prove(rings: &[Ring], drawn: &Drawn) -> Result<(), RegionFault> {
    let prover = Prover { rings, drawn };
    let fault = drawn
        .tree
        .first_pair(NEAR, &mut |one, other| prover.fault(one as usize, other as usize))?;
    fault.map_or(Ok(()), Err)
}

struct Prover<'a> {
    rings: &'a [Ring],
    drawn: &'a Drawn,
}

/// An edge, prepared, with the loop it belongs to and its place there.
#[derive(Clone, Copy)]
struct Part<'a> {
    curve: &'a Curve,
    ring: &'a Ring,
    place: usize,
}

impl Part<'_> {
    fn name(&self) -> EdgeName {
        let none = EdgeName { ring: 0, edge: 0 };
        self.ring.names.get(self.place).copied().unwrap_or(none)
    }

    /// The curve some edges farther on in its loop.
    fn neighbour(&self, steps: usize) -> Curve {
        let count = self.ring.edges.len().max(1);
        let edge = self.ring.edges.get((self.place + steps) % count);
        edge.map_or(*self.curve, |edge| Curve::of(edge.piece))
    }

    /// Where the loop is shortly before and after one of the edge's places.
    fn branches(&self, at: Place, reach: f64) -> [Place; 2] {
        let before = |curve: &Curve| along(curve, at, -reach);
        let after = |curve: &Curve| along(curve, at, reach);
        let piece = self.curve.piece;
        if at.distance(piece.from) <= NEAR {
            let previous = self.neighbour(self.ring.edges.len().saturating_sub(1));
            [
                along(&previous, piece.from, -reach),
                along(self.curve, piece.from, reach),
            ]
        } else if at.distance(piece.to) <= NEAR {
            let next = self.neighbour(1);
            [along(self.curve, piece.to, -reach), along(&next, piece.to, reach)]
        } else {
            [before(self.curve), after(self.curve)]
        }
    }

    /// How far the loop runs from a place on without an end between, to either side, the lesser.
    fn room(&self, at: Place) -> f64 {
        let piece = self.curve.piece;
        let length = |curve: &Curve| curve.piece.length();
        if at.distance(piece.from) <= NEAR {
            let previous = self.neighbour(self.ring.edges.len().saturating_sub(1));
            length(&previous).min(length(self.curve))
        } else if at.distance(piece.to) <= NEAR {
            length(&self.neighbour(1)).min(length(self.curve))
        } else {
            at.distance(piece.from).min(at.distance(piece.to))
        }
    }
}

/// The place of a curve so many mm after one of its places, or before it.
fn along(curve: &Curve, at: Place, way: f64) -> Place {
    let length = curve.piece.length();
    let progress = curve.progress(at);
    let share = if curve.piece.is_line() {
        progress / length
    } else {
        progress / curve.piece.sweep
    };
    curve.piece.at((share + way / length).clamp(0.0, 1.0))
}

impl Prover<'_> {
    fn part(&self, number: usize) -> Option<Part<'_>> {
        let curve = self.drawn.curves.get(number)?;
        let &(ring, place) = self.drawn.owners.get(number)?;
        let ring = self.rings.get(ring)?;
        Some(Part { curve, ring, place })
    }

    fn fault(&self, one: usize, other: usize) -> Option<RegionFault> {
        let same_ring = self.drawn.owners.get(one)?.0 == self.drawn.owners.get(other)?.0;
        let (one, other) = (self.part(one)?, self.part(other)?);
        let count = one.ring.edges.len();
        let follows = |a: usize, b: usize| same_ring && (a + 1) % count == b;
        let crosses = |at| RegionFault::Crosses {
            one: one.name(),
            other: other.name(),
            at,
        };
        if let Some(at) = overlap(one.curve, other.curve) {
            return Some(RegionFault::Overlaps {
                one: one.name(),
                other: other.name(),
                at,
            });
        }
        let is_next = follows(one.place, other.place);
        let is_previous = follows(other.place, one.place);
        if is_next || is_previous {
            let (first, second) = if is_next { (one, other) } else { (other, one) };
            return self.joint_fault(first.curve, second.curve).map(crosses);
        }
        let common = crossings(one.curve, other.curve);
        let is_on_both = |at: &Place| one.curve.is_beside(*at, NEAR) && other.curve.is_beside(*at, NEAR);
        let mut places = common.into_iter().flatten().filter(is_on_both);
        if let Some(at) = places.find(|&at| self.crosses_at(one, other, at, common)) {
            return Some(crosses(at));
        }
        let ends = [(one, other), (other, one)];
        let mut ends = ends.iter().flat_map(|(part, whole)| {
            [part.curve.piece.from, part.curve.piece.to].map(|end| (end, whole.curve.distance(end)))
        });
        let at = ends.find(|&(end, distance)| distance <= NEAR && cross_through(one, other, end));
        at.map(|(at, _)| crosses(at))
    }

    /// Where an edge crosses the next one, apart from their joints.
    fn joint_fault(&self, first: &Curve, second: &Curve) -> Option<Place> {
        let joint = first.piece.to;
        let at = other_crossing(first, second, joint, (first.arrival, second.ahead))?;
        let is_joint = at.distance(joint) <= NEAR
            || at.distance(second.piece.to) <= NEAR && second.piece.to.distance(first.piece.from) <= NEAR;
        let is_on_both = first.is_beside(at, -NEAR) && second.is_beside(at, -NEAR);
        (!is_joint && is_on_both).then_some(at)
    }

    /// Whether two edges that do not follow each other cross where their circles do.
    fn crosses_at(&self, one: Part<'_>, other: Part<'_>, at: Place, common: [Option<Place>; 2]) -> bool {
        let ends = [
            one.curve.piece.from,
            one.curve.piece.to,
            other.curve.piece.from,
            other.curve.piece.to,
        ];
        if let Some(&end) = ends.iter().find(|end| end.distance(at) <= NEAR) {
            return cross_through(one, other, end);
        }
        let (first, second) = (one.curve.direction(at), other.curve.direction(at));
        let [Some(begin), Some(end)] = common else {
            // Once is a touch, but of two lines.
            return first.cross(second).abs() > NEAR;
        };
        // Circles that cross twice at the angle a lap by about `w a / 4`.
        let width = begin.distance(end);
        width * first.cross(second).abs() / 4.0 > NEAR
    }
}

/// Whether two loops cross in a place that both go through.
fn cross_through(one: Part<'_>, other: Part<'_>, at: Place) -> bool {
    let reach = one.room(at).min(other.room(at)).min(2.0 * PROBE) / 2.0;
    let [a, b] = one.branches(at, reach);
    let [c, d] = other.branches(at, reach);
    if [a, b].iter().any(|p| p.distance(c).min(p.distance(d)) <= NEAR) {
        return false;
    }
    let angle = |place: Place| libm::atan2(place.y - at.y, place.x - at.x);
    let base = angle(a);
    let from_base = |place: Place| {
        let turn = angle(place) - base;
        if turn < 0.0 {
            turn + core::f64::consts::TAU
        } else {
            turn
        }
    };
    let end = from_base(b);
    (from_base(c) < end) != (from_base(d) < end)
}

/// A place in the middle of a stretch on which two curves lie on each other.
fn overlap(one: &Curve, other: &Curve) -> Option<Place> {
    let mut common = [(one, other), (other, one)]
        .into_iter()
        .flat_map(|(part, whole)| {
            [part.piece.from, part.piece.to]
                .into_iter()
                .filter(move |&end| whole.distance(end) <= NEAR)
        });
    let first = common.next()?;
    common
        .filter(|last| last.distance(first) > 4.0 * NEAR)
        .find_map(|last| {
            let share = |place: Place| {
                let whole = if one.piece.is_line() {
                    one.piece.length()
                } else {
                    one.piece.sweep
                };
                (one.progress(place) / whole).clamp(0.0, 1.0)
            };
            let middle = one.piece.at(f64::midpoint(share(first), share(last)));
            (other.distance(middle) <= NEAR).then_some(middle)
        })
}
