//! How the tool gets down to where a run begins.

use super::clock::Clock;
use super::room::Room;
use super::{Entry, Kind, Leg, Run, helix, hole};
use crate::asked::WayIn;
use crate::refused::Why;
use core::f64::consts::TAU;
use vcutc_job::{Auto, Hole};
use vcutc_region::pass::Pass;
use vcutc_region::piece::Piece;
use vcutc_region::place::Place;

/// How long the line is at least along which the tool goes down to and fro, in radii: a crusher does not cut at its centre, and along
/// so much of a line its rim passes everywhere.
const LONG_ENOUGH: f64 = 2.0;

/// How wide a circle is that leaves nothing under the tool either, in radii, but for rounding.
const WIDE_ENOUGH: f64 = 0.999;

/// How long that line is at most, in radii: longer ways down take no less time.
const LONGEST: f64 = 12.0;

/// In how many directions a line is looked for where the run does not begin with one.
const DIRECTIONS: u32 = 32;

/// The shortest line along which the tool goes down, in mm: points are rounded.
const SHORTEST: f64 = 0.5;

/// How runs may begin.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ways {
    pub(super) clock: Clock,
    pub(super) entry: Auto<WayIn>,
    pub(super) hole: Option<Hole>,
}

/// A run along a pass, with its way down.
///
/// # Errors
/// There is no room for a way down.
pub(super) fn enter(pass: &Pass, kind: Kind, ways: Ways, room: Room<'_>) -> Result<Run, Why> {
    let legs: Vec<Leg> = pass
        .pieces
        .iter()
        .map(|piece| Leg { piece: *piece, kind })
        .collect();
    let first = legs.first().map_or(Place::new(0.0, 0.0), |leg| leg.piece.from);
    if let Some(from) = beside(first, room) {
        let link = (from != first).then_some(Piece::line(from, first));
        return Ok(begun(Entry::Open { from }, link, legs));
    }
    if let Some(run) = ways.hole.and_then(|hole| hole::enter(pass, kind, hole, room)) {
        return Ok(run);
    }
    let at = [first.x, first.y];
    let ramp = |shortest: f64| {
        let line = along(&legs, room.radius).unwrap_or_else(|| aside(&legs, room));
        (line.length() >= shortest).then_some((Entry::Ramp { line }, None))
    };
    let round = || helix::near(first, room).map(|(helix, link)| (Entry::Helix { helix }, link));
    let is_wide = |way: &(Entry, Option<Piece>)| match way.0 {
        Entry::Helix { helix } => helix.radius() >= room.radius * WIDE_ENOUGH,
        Entry::Ramp { .. } | Entry::Hole { .. } | Entry::Return { .. } | Entry::Open { .. } => true,
    };
    let time = |way: &(Entry, Option<Piece>)| {
        let link = way.1.map(to_begin);
        ways.clock.down(way.0) + ways.clock.of_legs(link.as_slice())
    };
    let (entry, link) = match ways.entry {
        // Along a line that is shorter than the tool is wide, and round a circle that is narrower, ground under the tool is left that its
        // rim does not pass, along the line more than round the circle.
        Auto::Auto => [ramp(LONG_ENOUGH * room.radius), round().filter(is_wide)]
            .into_iter()
            .flatten()
            .reduce(|one, other| if time(&other) < time(&one) { other } else { one })
            .or_else(round)
            .or_else(|| ramp(SHORTEST))
            .ok_or(Why::NoWayDown { at })?,
        Auto::Given(WayIn::Ramp) => ramp(SHORTEST).ok_or(Why::NoWayDown { at })?,
        Auto::Given(WayIn::Helix) => round().ok_or(Why::NoHelix { at })?,
        Auto::Given(WayIn::Open) => return Err(Why::NotOpen { at }),
    };
    Ok(begun(entry, link, legs))
}

/// A run that begins with a way to its first leg, if there is one.
fn begun(entry: Entry, link: Option<Piece>, legs: Vec<Leg>) -> Run {
    Run {
        entry,
        legs: link.map(to_begin).into_iter().chain(legs).collect(),
    }
}

/// A way from where the tool is down to where a pass begins.
const fn to_begin(piece: Piece) -> Leg {
    Leg {
        piece,
        kind: Kind::Link,
    }
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
            if let Some(line) = line.filter(|line| room.is_free(*line))
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
