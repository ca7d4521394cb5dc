//! How the tool gets down to where a run begins.

use super::room::Room;
use super::{Entry, Kind, Leg, Run};
use crate::refused::Why;
use core::f64::consts::TAU;
use vcutc_region::piece::Piece;
use vcutc_region::place::Place;

/// How long the line is at least along which the tool goes down to and fro, in radii: a crusher does not cut at its centre, and along
/// so much of a line its rim passes everywhere.
const LONG_ENOUGH: f64 = 2.0;

/// How long that line is at most, in radii: longer ways down take no less time.
const LONGEST: f64 = 12.0;

/// In how many directions a line is looked for where the run does not begin with one.
const DIRECTIONS: u32 = 32;

/// The shortest line along which the tool goes down, in mm: points are rounded.
const SHORTEST: f64 = 0.5;

/// A run with its way down. `legs` are at least one.
///
/// # Errors
/// There is no room for a way down.
pub(super) fn enter(mut legs: Vec<Leg>, room: Room<'_>) -> Result<Run, Why> {
    let first = legs.first().map_or(Place::new(0.0, 0.0), |leg| leg.piece.from);
    if let Some(from) = beside(first, room) {
        if from != first {
            let piece = Piece::line(from, first);
            legs.insert(
                0,
                Leg {
                    piece,
                    kind: Kind::Link,
                },
            );
        }
        return Ok(Run {
            entry: Entry::Open { from },
            legs,
        });
    }
    let line = along(&legs, room.radius).unwrap_or_else(|| aside(&legs, room));
    if line.length() < SHORTEST {
        let at = [first.x, first.y];
        return Err(Why::NoWayDown { at });
    }
    Ok(Run {
        entry: Entry::Ramp { line },
        legs,
    })
}

/// Straight out from a place beside the stock to where the tool is clear of it; none from a place over the stock.
fn beside(first: Place, room: Room<'_>) -> Option<Place> {
    let [width, depth] = room.stock;
    let out = room.radius + room.run_out;
    // How far beyond each side the place lies, and the place that is clear of it.
    let sides = [
        (-first.x, Place::new(first.x.min(-out), first.y)),
        (first.x - width, Place::new(first.x.max(width + out), first.y)),
        (-first.y, Place::new(first.x, first.y.min(-out))),
        (first.y - depth, Place::new(first.x, first.y.max(depth + out))),
    ];
    let beyond = sides.into_iter().filter(|(by, _)| *by >= 0.0);
    let farthest = beyond.max_by(|one, other| one.0.total_cmp(&other.0));
    farthest.map(|(_, clear)| clear)
}

/// The line that the run begins with, if it is long enough.
fn along(legs: &[Leg], radius: f64) -> Option<Piece> {
    let first = legs.first()?.piece;
    let long = first.length();
    let is_good = first.is_line() && long >= LONG_ENOUGH * radius;
    is_good.then(|| first.part(0.0, (LONGEST * radius / long).min(1.0)))
}

/// The longest line from where the run begins that keeps from walls: in one of many directions, or to a place on its first piece, as
/// between walls that are bent alike no other line may be free.
fn aside(legs: &[Leg], room: Room<'_>) -> Piece {
    let radius = room.radius;
    let first = legs.first().map(|leg| leg.piece);
    let piece = first.unwrap_or(Piece::line(Place::new(0.0, 0.0), Place::new(0.0, 0.0)));
    let from = piece.from;
    let mut best = Piece::line(from, piece.to);
    let mut long = 0.0;
    let mut look = |to: &dyn Fn(f64) -> Option<Place>| {
        let mut reach = LONGEST * radius;
        while reach > long && reach > 0.01 * radius {
            let line = to(reach).map(|to| Piece::line(from, to));
            if let Some(line) = line.filter(|line| is_free(*line, room))
                && line.length() > long
            {
                long = line.length();
                best = line;
            }
            reach *= 0.8;
        }
    };
    for direction in 0..DIRECTIONS {
        let (sin, cos) = libm::sincos(TAU * f64::from(direction) / f64::from(DIRECTIONS));
        look(&|reach| Some(from.plus(Place::new(cos, sin).times(reach))));
    }
    let way = piece.length();
    look(&|reach| (reach <= way).then(|| piece.at(reach / way)));
    best
}

fn is_free(line: Piece, room: Room<'_>) -> bool {
    let nearest = room.walls.nearest_to(line);
    nearest.is_none_or(|(_, near)| near.distance >= room.keep)
}
