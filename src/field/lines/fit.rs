//! Arcs through the points of a line.
//!
//! Two arcs that are tangent to each other lead from point to point in the direction of the line at both. They
//! replace as many points as they can.

use super::{Point, Zeros};
use crate::biarc::{Biarc, Knot};
use vcutc_region::piece::Piece;
use vcutc_region::place::Place;

/// How far arcs may be off the line, in mm.
pub(crate) const OFF: f64 = 2e-3;

/// Arcs that turn further, in rad, are halved unseen: one place in the middle does not prove them.
const TIGHT: f64 = 0.4;

/// Half of the way between points, in mm, that is not halved any more.
const SHORT: f64 = 0.01;

/// How far aside tips of cusps reach, in pitches.
const ASIDE: f64 = 2.0;

/// Points that one pair of arcs replaces at most.
const LONGEST: usize = 16;

/// Halvings between two points at most.
const MOST_HALVINGS: u32 = 12;

/// Lines and arcs along the points of a line on a grid of a pitch, in mm.
pub(super) fn pieces(points: &[Point], zeros: &Zeros, pitch: f64) -> Vec<Piece> {
    let ahead = Ahead::of(points);
    let mut pieces = Vec::new();
    let mut rest = points;
    while rest.len() > 1 {
        let mut count = LONGEST.min(rest.len() - 1);
        while count > 1 && !is_along(rest, count, ahead) {
            count = count.div_ceil(2);
        }
        if let (Some(from), Some(to)) = (rest.first(), rest.get(count)) {
            if count > 1 {
                pieces.extend(arcs(&pair(from, to, ahead)));
            } else {
                between([*from, *to], ahead, (zeros, pitch), &mut pieces);
            }
        }
        rest = rest.get(count..).unwrap_or_default();
    }
    pieces
}

/// Whether one pair of arcs follows the line up to the point with this number.
fn is_along(points: &[Point], count: usize, ahead: Ahead) -> bool {
    let Some(span) = points.get(..=count) else {
        return false;
    };
    let [from, between @ .., to] = span else {
        return false;
    };
    let pair = pair(from, to, ahead);
    !pair.turns_further(TIGHT) && between.iter().all(|point| is_at(&pair, point, ahead))
}

/// From a point to its neighbour on a grid of a pitch: by halves, with points on the line in between, until the arcs follow it.
fn between([from, to]: [Point; 2], ahead: Ahead, (zeros, pitch): (&Zeros, f64), pieces: &mut Vec<Piece>) {
    // Both lie on edges of one cell; what is found far off is another line.
    let is_here = |point: &Point| {
        let off = |end: &Point| point.place.distance(end.place);
        off(&from) <= ASIDE * pitch && off(&to) <= ASIDE * pitch
    };
    let mut open = vec![(to, 0)];
    let mut at = from;
    while let Some((next, depth)) = open.pop() {
        let pair = pair(&at, &next, ahead);
        let reach = at.place.distance(next.place) / 2.0;
        let middle = zeros
            .near(pair.joint, reach)
            .or_else(|| zeros.across(at.place, next.place));
        let middle = middle.filter(|middle| depth < MOST_HALVINGS && reach > SHORT && is_here(middle));
        match middle {
            Some(middle) if pair.turns_further(TIGHT) || !is_at(&pair, &middle, ahead) => {
                open.push((next, depth + 1));
                open.push((middle, depth + 1));
            }
            _ => {
                pieces.extend(arcs(&pair));
                at = next;
            }
        }
    }
}

/// Whether arcs pass a point of the line, in the line's direction.
fn is_at(pair: &Biarc, point: &Point, ahead: Ahead) -> bool {
    let [first, second] = pair.arcs();
    let is_first = first.direction(1.0).dot(point.place.minus(pair.joint)) < 0.0;
    let arc = if is_first { first } else { second };
    // Between two places that it meets, a line that crosses it at an angle at one of
    // them swings away by 4/27 of the angle times the way.
    let way = point.place.distance(pair.from).min(point.place.distance(pair.to));
    let turned = direction_at(arc, point.place).cross(ahead.along(point)).abs();
    // Not a number is not at it either.
    off(arc, point.place) <= OFF && turned * way * 4.0 / 27.0 <= OFF
}

/// Two arcs between points of a line.
fn pair(from: &Point, to: &Point, ahead: Ahead) -> Biarc {
    let knot = |point: &Point| Knot {
        place: point.place,
        along: ahead.along(point),
    };
    Biarc::new(knot(from), knot(to))
}

/// The arcs of a pair; a line where there are none, or where they would swing far aside, as at the tips of
/// cusps.
fn arcs(pair: &Biarc) -> impl Iterator<Item = Piece> {
    let arcs = pair
        .sound()
        .map_or([Some(Piece::line(pair.from, pair.to)), None], |arcs| {
            arcs.map(Some)
        });
    arcs.into_iter().flatten()
}

/// On which side of a line the field is positive, all along it.
#[derive(Clone, Copy)]
enum Ahead {
    PositiveRight,
    PositiveLeft,
}

impl Ahead {
    /// By most of the way: at the tips of cusps points follow each other in any direction.
    fn of(points: &[Point]) -> Self {
        let ways = points.windows(2).filter_map(|ends| match ends {
            [from, to] => Some(from.gradient.left().dot(to.place.minus(from.place)) / from.gradient.length()),
            _ => None,
        });
        if ways.sum::<f64>() > 0.0 {
            Self::PositiveRight
        } else {
            Self::PositiveLeft
        }
    }

    /// The direction of the line at a point.
    fn along(self, point: &Point) -> Place {
        let line = point.gradient.left().times(1.0 / point.gradient.length());
        match self {
            Self::PositiveRight => line,
            Self::PositiveLeft => line.times(-1.0),
        }
    }
}

/// Distance of a place from the line or circle of a piece.
fn off(piece: Piece, place: Place) -> f64 {
    match piece.centre().zip(piece.radius()) {
        Some((centre, radius)) => (place.distance(centre) - radius).abs(),
        None => piece.direction(0.0).cross(place.minus(piece.from)).abs(),
    }
}

/// The direction in which the line or circle of a piece passes a place on it.
fn direction_at(piece: Piece, place: Place) -> Place {
    let Some((centre, radius)) = piece.centre().zip(piece.radius()) else {
        return piece.direction(0.0);
    };
    let out = place.minus(centre).times(1.0 / radius.copysign(piece.sweep));
    out.left()
}
