//! Regions: what a pocket clears.

use crate::boxes::{Dense, Extent, Tree};
use crate::curve::Curve;
use crate::piece::Piece;
use crate::place::Place;

mod nest;
mod simple;

/// Most edges of a region.
const MOST_EDGES: usize = 200_000;

/// Ends that lie no farther apart, in mm, are one; loops that lap each other by no more touch.
pub const NEAR: f64 = 1e-6;

/// Coordinates go no farther, in mm.
const FARTHEST: f64 = 1e6;

/// Whether core stands beyond a piece of a boundary.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// It does: no tool may cut beyond.
    Wall,
    /// It does not: passes run out there.
    Open,
}

/// A piece of a boundary; the region lies to its left.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Edge {
    /// Its way.
    pub piece: Piece,
    /// What is beyond.
    pub side: Side,
}

/// A closed chain of edges, each beginning where the one before it ends.
pub type Loop = Vec<Edge>;

/// An area bounded by simple loops that neither cross nor overlap: outlines counter-clockwise, islands in them clockwise.
#[derive(Clone, Debug, PartialEq)]
pub struct Region {
    loops: Vec<Loop>,
}

/// An edge among the loops that were given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EdgeName {
    /// Which loop, counted from 0.
    pub ring: usize,
    /// Which edge of it, counted from 0.
    pub edge: usize,
}

/// Why loops bound no region.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RegionFault {
    /// There are no loops, or none has an area.
    Empty,
    /// There are more edges than the most.
    TooMany {
        /// How many there are.
        edges: usize,
        /// How many there may be.
        most: usize,
    },
    /// A coordinate or an angle is out of bounds: places within 1e6 mm, arcs below a whole turn between places that differ.
    Unsound(EdgeName),
    /// A loop does not close: an edge begins where the one before it does not end.
    Open {
        /// The edge before.
        edge: EdgeName,
        /// Where it ends.
        end: Place,
        /// Where the next begins.
        beginning: Place,
    },
    /// A loop goes back and forth and encloses nothing.
    Flat {
        /// The loop.
        ring: usize,
    },
    /// Two edges cross.
    Crosses {
        /// One of them.
        one: EdgeName,
        /// The other.
        other: EdgeName,
        /// Where.
        at: Place,
    },
    /// Two edges lie on each other for a while.
    Overlaps {
        /// One of them.
        one: EdgeName,
        /// The other.
        other: EdgeName,
        /// A place of both.
        at: Place,
    },
    /// Edges lie too close beside each other to be looked at one by one.
    Dense,
}

impl From<Dense> for RegionFault {
    fn from(_: Dense) -> Self {
        Self::Dense
    }
}

impl Region {
    /// The region that loops bound by even-odd: loops in loops are islands, loops in islands outlines again, however they are
    /// orientated. Loops that are given twice count once.
    ///
    /// Ends closer than [`NEAR`] are joined, and edges shorter than that left out. Loops may touch in places.
    ///
    /// # Errors
    /// The loops are not closed, not simple, cross or overlap, or are more than is looked at.
    pub fn new(loops: Vec<Loop>) -> Result<Self, RegionFault> {
        let edges = loops.iter().map(Vec::len).sum();
        if edges > MOST_EDGES {
            let most = MOST_EDGES;
            return Err(RegionFault::TooMany { edges, most });
        }
        let mut rings = Vec::with_capacity(loops.len());
        for (number, edges) in loops.into_iter().enumerate() {
            rings.extend(closed(number, edges)?);
        }
        let rings = nest::without_repeats(rings);
        if rings.is_empty() {
            return Err(RegionFault::Empty);
        }
        let drawn = Drawn::of(&rings);
        simple::prove(&rings, &drawn)?;
        let loops = nest::orientated(rings, &drawn)?;
        Ok(Self { loops })
    }

    /// The loops, outlines and islands.
    #[must_use]
    pub fn loops(&self) -> &[Loop] {
        &self.loops
    }

    /// All edges.
    pub fn edges(&self) -> impl Iterator<Item = &Edge> {
        self.loops.iter().flatten()
    }

    /// Its area, in mm2.
    #[must_use]
    pub fn area(&self) -> f64 {
        self.edges().map(|edge| edge.piece.twice_area()).sum::<f64>() / 2.0
    }

    /// The box around it.
    #[must_use]
    pub fn bounds(&self) -> Extent {
        let boxes = self.edges().map(|edge| Curve::of(edge.piece).extent());
        let nowhere = Extent::of(Place::new(0.0, 0.0), Place::new(0.0, 0.0));
        boxes.reduce(Extent::with).unwrap_or(nowhere)
    }

    /// Whether a place lies in it. Of places on its boundary either may be said.
    ///
    /// Looks at all edges: for many places ask [`Inside`].
    #[must_use]
    pub fn contains(&self, place: Place) -> bool {
        let crossed = self.edges().filter(|edge| toggles(&edge.piece, place));
        crossed.count() % 2 == 1
    }
}

/// A region, ready to be asked what lies in it.
#[derive(Clone, Debug)]
pub struct Inside {
    pieces: Vec<Piece>,
    tree: Tree,
}

impl Inside {
    /// Prepares a region.
    #[must_use]
    pub fn of(region: &Region) -> Self {
        Self::of_pieces(region.edges().map(|edge| edge.piece).collect())
    }

    /// Prepares what closed chains bound.
    pub(crate) fn of_pieces(pieces: Vec<Piece>) -> Self {
        let extents: Vec<Extent> = pieces.iter().map(|&piece| Curve::of(piece).extent()).collect();
        let tree = Tree::of(&extents);
        Self { pieces, tree }
    }

    /// Whether a place lies in the region. Of places on its boundary either may be said.
    #[must_use]
    pub fn contains(&self, place: Place) -> bool {
        let mut is_inside = false;
        self.tree.along_ray(place, &mut |number| {
            let piece = self.pieces.get(number as usize);
            is_inside ^= piece.is_some_and(|piece| toggles(piece, place));
        });
        is_inside
    }
}

/// Whether a ray from a place towards greater x crosses a piece an odd number of times.
///
/// An arc is its chord, crossed or not, and the segment between both: within it one crossing more or less.
pub(crate) fn toggles(piece: &Piece, place: Place) -> bool {
    let (from, to) = (piece.from, piece.to);
    let side = to.minus(from).cross(place.minus(from));
    let crosses_height = (from.y <= place.y) != (to.y <= place.y);
    let crosses_chord = crosses_height && (side > 0.0) == (to.y > from.y);
    if piece.is_line() {
        return crosses_chord;
    }
    // As with heights, a place on a level chord counts as one just above it: the segment on one side of it holds it.
    let is_on_level = side == 0.0 && from.y == to.y;
    let side = if is_on_level { to.x - from.x } else { side };
    let is_under = if piece.sweep > 0.0 {
        side <= 0.0
    } else {
        side > 0.0
    };
    let is_in_segment = is_under && Curve::of(*piece).left_of(place) * piece.sweep > 0.0;
    crosses_chord != is_in_segment
}

/// A loop that is closed, and what its edges were called.
#[derive(Clone, Debug)]
struct Ring {
    edges: Loop,
    names: Vec<EdgeName>,
}

/// Edges of all rings, prepared.
struct Drawn {
    curves: Vec<Curve>,
    /// Ring and edge of each.
    owners: Vec<(usize, usize)>,
    tree: Tree,
}

impl Drawn {
    fn of(rings: &[Ring]) -> Self {
        let mut curves = Vec::new();
        let mut owners = Vec::new();
        for (number, ring) in rings.iter().enumerate() {
            for (place, edge) in ring.edges.iter().enumerate() {
                curves.push(Curve::of(edge.piece));
                owners.push((number, place));
            }
        }
        let extents: Vec<Extent> = curves.iter().map(Curve::extent).collect();
        let tree = Tree::of(&extents);
        Self { curves, owners, tree }
    }
}

/// Joins the ends of a loop and leaves out what has no length; none where nothing is left.
fn closed(ring: usize, edges: Loop) -> Result<Option<Ring>, RegionFault> {
    let mut kept = Ring {
        edges: Vec::with_capacity(edges.len()),
        names: Vec::with_capacity(edges.len()),
    };
    let last = edges.len().wrapping_sub(1);
    let begins: Vec<Place> = edges.iter().map(|edge| edge.piece.from).collect();
    let mut beginning: Option<Place> = None;
    for (number, edge) in edges.into_iter().enumerate() {
        let name = EdgeName { ring, edge: number };
        let mut piece = edge.piece;
        check(piece).ok_or(RegionFault::Unsound(name))?;
        // The end is where the next begins.
        let next = if number == last { 0 } else { number + 1 };
        let next = begins.get(next).copied().unwrap_or(piece.to);
        if piece.to.distance(next) > NEAR || !next.length().is_finite() {
            return Err(RegionFault::Open {
                edge: name,
                end: piece.to,
                beginning: next,
            });
        }
        piece.from = beginning.unwrap_or(piece.from);
        piece.to = next;
        if piece.from.distance(next) <= NEAR {
            if piece.sweep.abs() > core::f64::consts::PI {
                return Err(RegionFault::Unsound(name));
            }
            beginning = Some(piece.from);
            continue;
        }
        beginning = None;
        kept.edges.push(Edge {
            piece,
            side: edge.side,
        });
        kept.names.push(name);
    }
    // What was left out at the end moves the end of what stays.
    if let Some(first) = kept.edges.first().map(|edge| edge.piece.from)
        && let Some(end) = kept.edges.last_mut()
    {
        end.piece.to = first;
    }
    Ok((!kept.edges.is_empty()).then_some(kept))
}

/// Whether a piece has coordinates and an angle that are looked at.
fn check(piece: Piece) -> Option<()> {
    let within = |place: Place| place.x.abs() <= FARTHEST && place.y.abs() <= FARTHEST;
    let is_sound = within(piece.from) && within(piece.to) && piece.sweep.abs() < core::f64::consts::TAU;
    is_sound.then_some(())
}

#[cfg(test)]
mod tests;
