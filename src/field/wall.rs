//! Walls and their corners, prepared for circles that touch them.

use core::f64::consts::{FRAC_PI_2, TAU};
use vcutc_region::boxes::{Extent, Tree};
use vcutc_region::curve::Curve;
use vcutc_region::piece::Piece;
use vcutc_region::place::Place;
use vcutc_region::region::{Edge, Region, Side};

/// Edges that are taken at most.
const MOST_EDGES: usize = 1000;

/// Corners that turn less than this, in rad, are smooth.
const SMOOTH: f64 = 1e-9;

/// The region has more edges than are taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TooManyEdges {
    /// The most.
    pub most: usize,
}

/// Which way an arc bends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Bend {
    /// Its centre is on the side of the region.
    Hollow,
    /// Its centre is on the side of the wall.
    Bulging,
}

/// An edge of a boundary, its numbers at hand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Shape {
    Line {
        from: Place,
        along: Place,
        length: f64,
    },
    Arc {
        centre: Place,
        radius: f64,
        bend: Bend,
        /// From the centre through the middle of the arc.
        middle: Place,
        /// Half of the angle that it turns through.
        half: f64,
    },
}

/// A place where edges meet, and the directions into the region that are squarely off it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Corner {
    pub(crate) place: Place,
    /// The first of those directions, and how far the last one is turned from it, in rad.
    pub(crate) normal: Place,
    pub(crate) sweep: f64,
    /// The numbers of the walls that meet there.
    pub(crate) walls: [Option<usize>; 2],
}

/// An edge and the number of its wall, if it is one.
type Numbered<'a> = (&'a Edge, Option<usize>);

/// The boundary of a region.
#[derive(Clone, Debug)]
pub(crate) struct Boundary {
    pub(crate) walls: Vec<Shape>,
    pub(crate) corners: Vec<Corner>,
    pub(crate) open: Vec<Shape>,
    /// Walls, then corners.
    pub(crate) tree: Tree,
}

impl Boundary {
    pub(crate) fn new(region: &Region) -> Result<Self, TooManyEdges> {
        if region.edges().count() > MOST_EDGES {
            return Err(TooManyEdges { most: MOST_EDGES });
        }
        let shapes = |side: Side| {
            let edges = region.edges().filter(move |edge| edge.side == side);
            edges.map(|edge| Shape::new(edge.piece)).collect()
        };
        let mut corners = Vec::new();
        let mut count = 0;
        for edges in region.loops() {
            let mut number = |edge| {
                let is_wall = edge_is_wall(edge);
                count += usize::from(is_wall);
                (edge, is_wall.then(|| count - 1))
            };
            let edges: Vec<Numbered> = edges.iter().map(&mut number).collect();
            let ahead = edges.iter().cycle().skip(1);
            corners.extend(edges.iter().zip(ahead).filter_map(corner));
        }
        let walls = region.edges().filter(|edge| edge_is_wall(edge));
        let mut extents: Vec<Extent> = walls.map(|edge| Curve::of(edge.piece).extent()).collect();
        extents.extend(
            corners
                .iter()
                .map(|corner| Extent::of(corner.place, corner.place)),
        );
        Ok(Self {
            tree: Tree::of(&extents),
            walls: shapes(Side::Wall),
            corners,
            open: shapes(Side::Open),
        })
    }
}

fn edge_is_wall(edge: &Edge) -> bool {
    edge.side == Side::Wall
}

/// The place between two edges, as a corner of the walls; none between open ones.
fn corner((&(edge, wall), &(next, next_wall)): (&Numbered, &Numbered)) -> Option<Corner> {
    let (before, after) = (edge.piece.direction(1.0), next.piece.direction(0.0));
    let turn = libm::atan2(before.cross(after), before.dot(after));
    let place = edge.piece.to;
    let (normal, sweep) = match (edge.side, next.side) {
        (Side::Wall, Side::Wall) => (before.left(), turn.min(0.0)),
        // On to the open edge.
        (Side::Wall, Side::Open) => (before.left(), (turn - FRAC_PI_2).min(0.0)),
        (Side::Open, Side::Wall) => (after.left(), (FRAC_PI_2 - turn).max(0.0)),
        (Side::Open, Side::Open) => return None,
    };
    let sweep = if sweep.abs() < SMOOTH { 0.0 } else { sweep };
    Some(Corner {
        place,
        normal,
        sweep,
        walls: [wall, next_wall],
    })
}

impl Shape {
    fn new(piece: Piece) -> Self {
        let (from, to) = (piece.from, piece.to);
        let Some((centre, radius)) = piece.centre().zip(piece.radius()) else {
            let length = from.distance(to);
            let along = to.minus(from).times(1.0 / length);
            return Self::Line { from, along, length };
        };
        let middle = piece.at(0.5).minus(centre);
        Self::Arc {
            centre,
            radius,
            bend: if piece.sweep > 0.0 {
                Bend::Hollow
            } else {
                Bend::Bulging
            },
            middle: middle.times(1.0 / middle.length()),
            half: piece.sweep.abs() / 2.0,
        }
    }

    pub(crate) fn length(&self) -> f64 {
        match *self {
            Self::Line { length, .. } => length,
            Self::Arc { radius, half, .. } => 2.0 * half * radius,
        }
    }

    /// The share of the way at which a place lies squarely off it.
    pub(crate) fn share(&self, place: Place) -> f64 {
        match *self {
            Self::Line { from, along, length } => along.dot(place.minus(from)) / length,
            Self::Arc {
                centre,
                bend,
                middle,
                half,
                ..
            } => {
                let turned = angle(middle, place.minus(centre));
                let turned = match bend {
                    Bend::Hollow => turned,
                    Bend::Bulging => -turned,
                };
                (turned / half + 1.0) / 2.0
            }
        }
    }

    /// The place a share `t` of the way along it, and the direction into the region there.
    pub(crate) fn at(&self, t: f64) -> (Place, Place) {
        match *self {
            Self::Line { from, along, length } => (from.plus(along.times(t * length)), along.left()),
            Self::Arc {
                centre,
                radius,
                bend,
                middle,
                half,
            } => {
                let turned = half * (2.0 * t - 1.0);
                match bend {
                    Bend::Hollow => {
                        let out = turn(middle, turned);
                        (centre.plus(out.times(radius)), out.times(-1.0))
                    }
                    Bend::Bulging => {
                        let out = turn(middle, -turned);
                        (centre.plus(out.times(radius)), out)
                    }
                }
            }
        }
    }
}

impl Corner {
    /// The share of its sweep at which the direction to a place is; not a number without a sweep.
    pub(crate) fn share(&self, place: Place) -> f64 {
        angle(self.normal, place.minus(self.place)) / self.sweep
    }
}

/// A vector turned to the left.
pub(crate) fn turn(vector: Place, angle: f64) -> Place {
    let (sin, cos) = libm::sincos(angle);
    Place::new(vector.x * cos - vector.y * sin, vector.x * sin + vector.y * cos)
}

/// How far a direction is turned from another one, in rad, of any sign, at most half a turn.
pub(crate) fn angle(from: Place, to: Place) -> f64 {
    let angle = libm::atan2(from.cross(to), from.dot(to));
    if angle.is_finite() { angle } else { TAU }
}
