//! Boxes that are not cut, as spots that hang together.

use super::boxes::{Ground, Leaf, Left};
use super::clip::{half_diagonal, middle};
use super::{Spot, Square};
use crate::distance::Walls;
use crate::place::Place;
use crate::region::Side;
use core::cmp::Ordering;
use std::collections::{BTreeMap, BinaryHeap};

/// How closely the radius of a circle is bounded: in mm below 1 mm, as a share above.
const CLOSE: f64 = 1e-3;

/// Most boxes that the search for one width looks at.
const MOST_TRIES: usize = 20_000;

/// Joins boxes that touch.
pub(super) fn spots(ground: &Ground, left: &Left) -> Vec<Spot> {
    let groups = groups(&left.leaves);
    let ruler = Ruler::of(ground);
    let mut spots: Vec<Spot> = groups.iter().map(|leaves| ruler.spot(leaves)).collect();
    let place = |spot: &Spot| {
        spot.squares
            .first()
            .map_or((0.0, 0.0), |square| (square.low.x, square.low.y))
    };
    spots.sort_by(|a, b| {
        let (x, y) = (place(a), place(b));
        b.area
            .total_cmp(&a.area)
            .then(x.0.total_cmp(&y.0))
            .then(x.1.total_cmp(&y.1))
    });
    spots
}

/// The boxes, group by group.
fn groups(leaves: &[Leaf]) -> Vec<Vec<Leaf>> {
    let mut parents: Vec<usize> = (0..leaves.len()).collect();
    join(leaves, &mut parents, |leaf| (leaf.column, leaf.row));
    join(leaves, &mut parents, |leaf| (leaf.row, leaf.column));
    let mut groups: BTreeMap<usize, Vec<Leaf>> = BTreeMap::new();
    for (number, leaf) in leaves.iter().enumerate() {
        let group = root(&mut parents, number);
        groups.entry(group).or_default().push(*leaf);
    }
    groups.into_values().collect()
}

/// Joins boxes with those that begin where they end, along one of the axes: the first coordinate that is taken from a box.
///
/// Boxes that begin at one line do not lap, so they end in the order in which they begin along it.
fn join(leaves: &[Leaf], parents: &mut [usize], begin: impl Fn(&Leaf) -> (u32, u32)) {
    let boxes = leaves.iter().enumerate();
    let mut sorted: Vec<(u32, u32, u32, usize)> = boxes
        .map(|(number, leaf)| {
            let (across, along) = begin(leaf);
            (across, along, along.saturating_add(leaf.size), number)
        })
        .collect();
    sorted.sort_unstable();
    for (number, leaf) in leaves.iter().enumerate() {
        let (across, along) = begin(leaf);
        let (end, last) = (across.saturating_add(leaf.size), along.saturating_add(leaf.size));
        let first = sorted.partition_point(|&(line, _, until, _)| (line, until) < (end, along));
        let beside = sorted.get(first..).unwrap_or_default().iter();
        for &(.., other) in beside.take_while(|&&(line, from, ..)| line == end && from <= last) {
            let (one, other) = (root(parents, number), root(parents, other));
            if let Some(parent) = parents.get_mut(one.max(other)) {
                *parent = one.min(other);
            }
        }
    }
}

/// The first box of a group, with shorter ways to it for the next time.
fn root(parents: &mut [usize], number: usize) -> usize {
    let mut at = number;
    while let Some(&parent) = parents.get(at).filter(|&&parent| parent != at) {
        let above = parents.get(parent).copied().unwrap_or(parent);
        if let Some(slot) = parents.get_mut(at) {
            *slot = above;
        }
        at = above;
    }
    at
}

/// A box that may hold the middle of a circle of so large a radius.
struct Candidate {
    bound: f64,
    square: Square,
}

impl Candidate {
    const fn key(&self) -> [f64; 3] {
        [self.bound, self.square.low.x, self.square.low.y]
    }
}

impl Ord for Candidate {
    fn cmp(&self, other: &Self) -> Ordering {
        let pairs = self.key().into_iter().zip(other.key());
        let orders = pairs.map(|(one, other)| one.total_cmp(&other));
        orders.fold(Ordering::Equal, Ordering::then)
    }
}

impl PartialOrd for Candidate {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Candidate {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Candidate {}

/// How large a circle about a place is uncut.
struct Ruler {
    passes: Walls,
    walls: Walls,
    open: Walls,
    radius: f64,
    /// How far from walls the edge of what is reachable lies at least.
    strip: f64,
}

impl Ruler {
    fn of(ground: &Ground) -> Self {
        let sides = |wanted: Side| {
            let edges = ground.edges.iter().filter(move |(_, side)| *side == wanted);
            Walls::of_pieces(edges.map(|(curve, _)| (0, curve.piece)))
        };
        Self {
            passes: Walls::of_pieces(ground.passes.iter().map(|curve| (0, curve.piece))),
            walls: sides(Side::Wall),
            open: sides(Side::Open),
            radius: ground.tool.radius,
            strip: ground.tool.keep - ground.tool.radius,
        }
    }

    /// Radius of the largest circle about a place without a place that is cut, or beyond the region: changes no faster than the
    /// place does.
    fn room(&self, place: Place) -> f64 {
        let uncut = self.passes.distance(place) - self.radius;
        uncut
            .min(self.walls.distance(place) - self.strip)
            .min(self.open.distance(place))
    }

    fn spot(&self, leaves: &[Leaf]) -> Spot {
        let squares: Vec<Square> = leaves.iter().map(|leaf| leaf.square).collect();
        let area = leaves.iter().fold(0.0, |sum, leaf| sum + leaf.area);
        let (mut best, mut at) = (f64::NEG_INFINITY, Place::new(0.0, 0.0));
        let mut open = BinaryHeap::new();
        for &square in &squares {
            let room = self.room(middle(square));
            if room > best {
                (best, at) = (room, middle(square));
            }
            let bound = room + half_diagonal(square);
            open.push(Candidate { bound, square });
        }
        // Branch and bound, the most promising box first.
        let mut most = best;
        let mut tries = MOST_TRIES;
        while let Some(Candidate { bound, square }) = open.pop() {
            if bound <= best + CLOSE * best.max(1.0) || tries < 4 {
                most = most.max(bound);
                break;
            }
            tries -= 4;
            let side = square.side / 2.0;
            for (right, up) in [(0.0, 0.0), (side, 0.0), (0.0, side), (side, side)] {
                let low = square.low.plus(Place::new(right, up));
                let square = Square { low, side };
                let room = self.room(middle(square));
                if room > best {
                    (best, at) = (room, middle(square));
                }
                let bound = room + half_diagonal(square);
                open.push(Candidate { bound, square });
            }
        }
        let most = most.max(0.0);
        Spot {
            area,
            width: 2.0 * most,
            at,
            squares,
        }
    }
}
