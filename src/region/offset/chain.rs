//! Walls one after the other, led on beyond open sides, and where ways end there.
//!
//! At the end of a wall before an open side the wall goes on: straight, where the side leaves it by a right angle or less, so that
//! ways run out as they come; square to the side otherwise, so that ways turn about the end of the wall and leave. It goes on past
//! all of the region, or up to the back of another wall: so no boundary of a level ends where it ends.

use super::{Inside, Region, Walls};
use crate::curve::{Curve, crossings};
use crate::piece::Piece;
use crate::place::Place;
use crate::region::{Edge, NEAR, Side};

/// Up to so many walls times open sides are looked at to end walls that are led on at others. Beyond, they are led on all the way:
/// that is as safe, but clears less where they pass through another part of the region.
const MOST_LOOKED_AT: usize = 100_000_000;

/// A wall, and how it goes on.
#[derive(Clone, Copy, Debug)]
pub(super) struct Link {
    pub(super) curve: Curve,
    /// Which of the edges of the region it is, or leads on.
    pub(super) edge: usize,
    /// Which link follows; none at the end of what is led on.
    pub(super) next: Option<usize>,
}

/// The open sides of a region.
#[derive(Clone, Debug)]
pub(super) struct Opening {
    pub(super) inside: Inside,
    pub(super) sides: Walls,
    /// How far ways run on beyond them, in mm.
    pub(super) reach: f64,
    /// Where they end.
    pub(super) gates: Vec<Curve>,
}

/// All walls of a region.
pub(super) fn links(region: &Region, reach: f64) -> Vec<Link> {
    let is_wall = |edge: &&Edge| edge.side == Side::Wall;
    let walls: Vec<Curve> = region
        .edges()
        .filter(is_wall)
        .map(|edge| Curve::of(edge.piece))
        .collect();
    let open = region.edges().count() - walls.len();
    let bounds = region.bounds();
    let leader = Leader {
        walls: if walls.len().saturating_mul(open) > MOST_LOOKED_AT {
            &[]
        } else {
            &walls
        },
        most: 2.0 * (bounds.low.distance(bounds.high) + reach),
    };
    let mut links = Vec::new();
    let mut first = 0;
    for edges in region.loops() {
        leader.of_loop(edges, first, &mut links);
        first += edges.len();
    }
    links
}

/// Leads walls on.
struct Leader<'a> {
    /// Where they may end.
    walls: &'a [Curve],
    /// How far they go at most, in mm.
    most: f64,
}

impl Leader<'_> {
    /// The end of a wall that is led on from a place.
    fn end(&self, from: Place, out: Place) -> Place {
        let line = Curve::of(Piece::line(from, from.plus(out.times(self.most))));
        let hits = self.walls.iter().flat_map(|wall| {
            let places = crossings(&line, wall).into_iter().flatten();
            places.filter(|&place| wall.is_beside(place, NEAR) && line.is_beside(place, 0.0))
        });
        let ways = hits
            .map(|place| from.distance(place))
            .filter(|&way| way > 2.0 * NEAR);
        from.plus(out.times(ways.fold(self.most, f64::min)))
    }

    fn of_loop(&self, edges: &[Edge], first: usize, links: &mut Vec<Link>) {
        let base = links.len();
        let Some(open) = edges.iter().position(|edge| edge.side == Side::Open) else {
            links.extend(edges.iter().enumerate().map(|(number, edge)| Link {
                curve: Curve::of(edge.piece),
                edge: first + number,
                next: Some(base + (number + 1) % edges.len()),
            }));
            return;
        };
        // From the open side on, all the way round to it.
        let turn = (0..=edges.len()).map(|step| (open + step) % edges.len());
        let turn = turn.filter_map(|number| Some((number, edges.get(number)?)));
        let mut previous: Option<(usize, &Edge, Curve)> = None;
        for (number, edge) in turn {
            let curve = Curve::of(edge.piece);
            if let Some((before, last, side)) = previous {
                links.extend(match (last.side, edge.side) {
                    (Side::Open, Side::Wall) => {
                        let out = led_on(side.arrival.times(-1.0), curve.ahead.times(-1.0), Turn::Left);
                        let piece = Piece::line(self.end(edge.piece.from, out), edge.piece.from);
                        Some(link(Curve::of(piece), first + number, Some(links.len() + 1)))
                    }
                    (Side::Wall, Side::Open) => {
                        let out = led_on(curve.ahead, side.arrival, Turn::Right);
                        let piece = Piece::line(last.piece.to, self.end(last.piece.to, out));
                        Some(link(Curve::of(piece), first + before, None))
                    }
                    _ => None,
                });
            }
            if edge.side == Side::Wall {
                links.push(link(curve, first + number, Some(links.len() + 1)));
            }
            previous = Some((number, edge, curve));
        }
    }
}

fn link(curve: Curve, edge: usize, next: Option<usize>) -> Link {
    Link { curve, edge, next }
}

/// To which side outwards is of the direction away from a wall along an open side.
#[derive(Clone, Copy)]
enum Turn {
    Left,
    Right,
}

/// The direction in which a wall that goes along `wall` is led on at an open side that leaves it along `side`.
fn led_on(side: Place, wall: Place, outwards: Turn) -> Place {
    if wall.dot(side) <= 0.0 {
        return wall;
    }
    let outwards = match outwards {
        Turn::Left => side.left(),
        Turn::Right => side.left().times(-1.0),
    };
    // Never back along the wall itself.
    if wall.dot(outwards) < -core::f64::consts::FRAC_1_SQRT_2 {
        let sum = outwards.plus(side);
        return sum.times(1.0 / sum.length());
    }
    outwards
}

impl Opening {
    pub(super) fn of(region: &Region, reach: f64) -> Option<Self> {
        let edges = region.edges().enumerate();
        let open = edges.filter(|(_, edge)| edge.side == Side::Open);
        let sides: Vec<(usize, Piece)> = open.map(|(number, edge)| (number, edge.piece)).collect();
        if sides.is_empty() {
            return None;
        }
        let gates = sides
            .iter()
            .flat_map(|&(_, piece)| gates(&Curve::of(piece), reach));
        Some(Self {
            inside: Inside::of(region),
            gates: gates.collect(),
            sides: Walls::of_pieces(sides),
            reach,
        })
    }
}

/// What lies a reach beyond an open side: the side moved outwards, and arcs about its ends.
fn gates(side: &Curve, reach: f64) -> Vec<Curve> {
    use core::f64::consts::PI;
    let piece = side.piece;
    let (from, to) = (side.ahead.left().times(-reach), side.arrival.left().times(-reach));
    let mut gates = vec![
        Piece::arc(piece.from.minus(from), piece.from.plus(from), PI),
        Piece::arc(piece.to.plus(to), piece.to.minus(to), PI),
    ];
    if piece.is_line() || 1.0 + side.bend * reach > 0.0 {
        gates.push(Piece::arc(piece.from.plus(from), piece.to.plus(to), piece.sweep));
    }
    gates
        .into_iter()
        .filter(|gate| gate.is_sound())
        .map(Curve::of)
        .collect()
}
