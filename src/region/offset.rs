//! Offsets of the walls of a region to its inside: the boundary of what lies at least so far from every wall.
//!
//! A level is computed from the shape, never from another level, so errors do not grow. Walls are moved inwards, re-entrant corners
//! become arcs about them, all of these are split where they cross, and slices nearer to some wall are left out. Between two
//! crossings a slice is nearer, or not, as a whole: nearness changes where another wall is as far away, and there its moved
//! wall, or the arc about its end, crosses. What stays is stitched.
//!
//! Open sides are not walls. Walls are led on beyond them, and what lies within a reach of an open side
//! belongs to the region; there ways begin and end.

use crate::boxes::{Dense, Extent, Tree};
use crate::curve::Curve;
use crate::distance::Walls;
use crate::piece::Piece;
use crate::place::Place;
use crate::region::{Inside, Region};

mod chain;
mod raw;
mod split;
mod stitch;

/// Distances that differ by less, in mm, are alike.
const ALIKE: f64 = 1e-8;

/// Ends closer than this, in mm, are one.
const JOIN: f64 = 1e-7;

/// How often a level is computed again a little farther in, where rounding left it in pieces, and by how much, in mm.
const RETRIES: u32 = 4;
const NUDGE: f64 = 7e-8;

/// What a piece of a level keeps its distance from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Origin {
    /// This one of the edges of the region.
    Edge(usize),
    /// The re-entrant corner where this edge begins.
    Corner(usize),
    /// No wall: beyond an open side, where ways end.
    Gate,
}

/// What a way of a level is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A closed boundary, with what is farther from the walls to its left.
    Loop,
    /// A boundary that begins and ends beyond open sides.
    Run,
    /// The middle of a corridor as wide as two distances: walls on both sides. It may be closed.
    Tie,
}

/// A boundary at one distance from the walls, without a stop.
#[derive(Clone, Debug, PartialEq)]
pub struct Way {
    /// What it is.
    pub kind: Kind,
    /// Its lines and arcs, each beginning where the one before it ends.
    pub pieces: Vec<Piece>,
    /// What each piece keeps its distance from.
    pub origins: Vec<Origin>,
}

impl Way {
    /// Its length, in mm.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.pieces.iter().map(|piece| piece.length()).sum()
    }

    /// Whether it ends where it begins.
    #[must_use]
    pub fn is_closed(&self) -> bool {
        let ends = self.pieces.first().zip(self.pieces.last());
        ends.is_some_and(|(first, last)| first.from == last.to)
    }
}

/// Why there is no level.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum OffsetFault {
    /// All sides are open: no place is nearer to a wall than another.
    NoWalls,
    /// A distance that is not above 0, or not finite.
    Distance,
    /// Moved walls lie too close beside each other to be looked at one by one.
    Dense,
    /// Rounding broke a boundary: no way on was found from a place.
    Broken(Place),
}

impl From<Dense> for OffsetFault {
    fn from(_: Dense) -> Self {
        Self::Dense
    }
}

/// The boundary of what lies at least a distance, in mm, from all walls of a region; beyond open sides it runs on for `reach` mm.
///
/// # Errors
/// See [`OffsetFault`].
pub fn level(region: &Region, reach: f64, distance: f64) -> Result<Vec<Way>, OffsetFault> {
    Offsets::of(region, reach).level(distance)
}

/// A region, ready for its levels.
#[derive(Clone, Debug)]
pub struct Offsets {
    links: Vec<chain::Link>,
    walls: Walls,
    open: Option<chain::Opening>,
    /// What lies in a region without open sides, once a level of it was found in pieces.
    inside: Option<Inside>,
    scratch: Scratch,
}

/// Memory of one level that the next uses again.
#[derive(Clone, Debug, Default)]
struct Scratch {
    raws: Vec<raw::Raw>,
    extents: Vec<Extent>,
    tree: Tree,
    split: split::Splits,
    slices: Vec<split::Slice>,
}

impl Offsets {
    /// Prepares a region; ways run on beyond its open sides for `reach` mm.
    #[must_use]
    pub fn of(region: &Region, reach: f64) -> Self {
        let links = chain::links(region, reach);
        let walls = links.iter().map(|link| (link.edge, link.curve.piece));
        Self {
            walls: Walls::of_pieces(walls),
            open: chain::Opening::of(region, reach),
            inside: None,
            links,
            scratch: Scratch::default(),
        }
    }

    /// The walls, led on beyond open sides.
    #[must_use]
    pub fn walls(&self) -> &Walls {
        &self.walls
    }

    /// The boundary of what lies at least a distance, in mm, from all walls. Corridors just as wide as two distances are kept
    /// as ways of their own.
    ///
    /// # Errors
    /// See [`OffsetFault`].
    pub fn level(&mut self, distance: f64) -> Result<Vec<Way>, OffsetFault> {
        if self.links.is_empty() {
            return Err(OffsetFault::NoWalls);
        }
        self.retry(distance, Ends::Free)
    }

    /// The same with runs closed beyond the open sides, so that all ways but ties are loops.
    ///
    /// # Errors
    /// See [`OffsetFault`].
    pub fn closed_level(&mut self, distance: f64) -> Result<Vec<Way>, OffsetFault> {
        self.retry(distance, Ends::Closed)
    }

    fn retry(&mut self, distance: f64, ends: Ends) -> Result<Vec<Way>, OffsetFault> {
        if !(distance > JOIN && distance.is_finite()) {
            return Err(OffsetFault::Distance);
        }
        let mut ways = self.level_once(distance, ends);
        if matches!(ways, Err(OffsetFault::Broken(_))) && self.look_inside() {
            ways = self.level_once(distance, ends);
        }
        for retry in 1..=RETRIES {
            if !matches!(ways, Err(OffsetFault::Broken(_))) {
                break;
            }
            ways = self.level_once(distance + f64::from(retry) * NUDGE, ends);
        }
        ways
    }

    /// From now on looks whether arcs about corners lie in the region; says whether that is new.
    ///
    /// An island with a corner in a corner of the outline has an arc about it that runs on outside of the region: no wall is nearer
    /// there than that corner. No other arc does, so that the question is not asked before.
    fn look_inside(&mut self) -> bool {
        if self.open.is_some() || self.inside.is_some() {
            return false;
        }
        let pieces = self.links.iter().map(|link| link.curve.piece);
        self.inside = Some(Inside::of_pieces(pieces.collect()));
        true
    }

    fn level_once(&mut self, distance: f64, ends: Ends) -> Result<Vec<Way>, OffsetFault> {
        let scratch = &mut self.scratch;
        raw::moved(&self.links, distance, &mut scratch.raws);
        let open = self.open.as_ref();
        let gates = match ends {
            Ends::Free => open,
            Ends::Closed => {
                raw::gates(open, &mut scratch.raws);
                None
            }
        };
        scratch.extents.clear();
        scratch
            .extents
            .extend(scratch.raws.iter().map(|raw| raw.extent()));
        split::crossings(scratch, gates)?;
        scratch.split.join()?;
        let mut filter = Filter {
            walls: &self.walls,
            open,
            inside: self.inside.as_ref(),
            distance,
            last: None,
        };
        split::slices(scratch, &mut |origin, place| filter.keeps(origin, place));
        stitch::ways(scratch, &mut |curve, place| filter.is_alone(curve, place))
    }
}

/// What becomes of ways beyond open sides.
#[derive(Clone, Copy)]
enum Ends {
    /// They end.
    Free,
    /// They go on to the next.
    Closed,
}

/// What belongs to a level.
struct Filter<'a> {
    walls: &'a Walls,
    open: Option<&'a chain::Opening>,
    inside: Option<&'a Inside>,
    distance: f64,
    /// The wall that was last found to be nearer: often the next slice's too.
    last: Option<Curve>,
}

impl Filter<'_> {
    /// Whether no wall is nearer to a place, and the place is of the region or shortly beyond an open side.
    fn keeps(&mut self, origin: Origin, place: Place) -> bool {
        if self.open.is_some_and(|open| !open.holds(origin, place)) {
            return false;
        }
        let limit = self.distance - ALIKE;
        if self.last.is_some_and(|wall| wall.distance(place) < limit) {
            return false;
        }
        if let Some(wall) = self.walls.nearer_than(place, limit) {
            self.last = self.walls.curve(wall).copied();
            return false;
        }
        if matches!(origin, Origin::Corner(_)) && self.inside.is_some_and(|inside| !inside.contains(place)) {
            return false;
        }
        // Gates reach behind walls that are led on beyond their open side, where a level is nearer to these than the gate is wide.
        origin != Origin::Gate || self.is_before_its_wall(place)
    }

    /// Whether the nearest wall has a place on the side of the region.
    fn is_before_its_wall(&self, place: Place) -> bool {
        let mut nearest: Option<(f64, Curve)> = None;
        self.walls.around(place, f64::INFINITY, &mut |wall| {
            if let Some(wall) = self.walls.curve(wall) {
                let distance = wall.distance(place);
                if nearest.is_none_or(|(known, _)| distance < known) {
                    nearest = Some((distance, *wall));
                }
            }
        });
        nearest.is_none_or(|(_, wall)| wall.left_of(place) >= 0.0)
    }

    /// Whether one wall only is as near to a place as the level: what rounding leaves over has two.
    fn is_alone(&self, curve: &Curve, place: Place) -> bool {
        let mut feet: Option<Place> = None;
        let mut is_alone = true;
        let limit = self.distance + 2.0 * ALIKE;
        self.walls.around(place, limit, &mut |wall| {
            if let Some(wall) = self.walls.curve(wall) {
                let foot = wall.nearest(place);
                if foot.distance <= limit {
                    let first = *feet.get_or_insert(foot.at);
                    is_alone &= first.distance(foot.at) <= ALIKE / 10.0;
                }
            }
        });
        is_alone && curve.piece.from.distance(curve.piece.to) > JOIN
    }
}

impl chain::Opening {
    /// Whether a place of a moved wall lies in the region or shortly beyond an open side, and one of a gate no nearer to a side.
    fn holds(&self, origin: Origin, place: Place) -> bool {
        let is_inside = self.inside.contains(place);
        if origin == Origin::Gate {
            return !is_inside && self.sides.nearer_than(place, self.reach - JOIN).is_none();
        }
        is_inside || self.sides.distance(place) <= self.reach + JOIN
    }
}

#[cfg(test)]
mod peers;
#[cfg(test)]
mod tests;
