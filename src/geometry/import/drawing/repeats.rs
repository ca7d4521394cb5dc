//! What is drawn more than once.
//!
//! Programs write lines twice: as a LINE and once more within a polyline, one way and the other, once for each of two
//! areas that they bound. A stroke all of whose segments are those of other strokes counts once ([`without_repeats`]).
//! Lines that lie on each other in part cannot be corrected that way: it is not known which of them was
//! meant; they are looked for when strokes form no outline, so that people learn why ([`drawn_over`]).

use super::join::SAME;
use super::lines::{Line, flatten};
use super::pairs::{Extent, first_pair};
use super::{Affine, Shape, Stroke};
use crate::point::Point2;
use core::f64::consts::TAU;
use std::collections::BTreeSet;
use vcutc_backend_api::units::Length;

/// How far centres and radii of arcs on one circle may be apart, in mm: bulges and angles are written with few digits.
const SAME_CIRCLE: f64 = 1e-4;

/// A segment by the micrometres its ends lie in, whichever way it leads.
type Key = [(i64, i64); 2];

fn keys(line: &Line) -> impl Iterator<Item = Key> {
    let cell = |value: f64| libm::round(value * 1000.0) as i64;
    let cells = move |end: Point2| (cell(end.x), cell(end.z));
    line.points.windows(2).map(move |ends| {
        let mut key = [cells(ends[0]), cells(ends[1])];
        key.sort_unstable();
        key
    })
}

/// Lines that do not lie on others from end to end, and the strokes of those that do. Of lines that are the same the
/// first stays, and of lines that lie on longer ones the longer.
pub(super) fn without_repeats(lines: Vec<Line>) -> (Vec<Line>, Vec<usize>) {
    let mut order: Vec<usize> = (0..lines.len()).collect();
    order.sort_by_key(|&line| core::cmp::Reverse(lines[line].points.len()));
    let mut drawn: BTreeSet<Key> = BTreeSet::new();
    let mut is_repeated = vec![false; lines.len()];
    for line in order {
        is_repeated[line] = keys(&lines[line]).all(|key| drawn.contains(&key));
        if !is_repeated[line] {
            drawn.extend(keys(&lines[line]));
        }
    }
    let mut repeated = Vec::new();
    let mut kept = Vec::new();
    for (line, is_repeated) in lines.into_iter().zip(is_repeated) {
        if is_repeated {
            repeated.push(line.stroke);
        } else {
            kept.push(line);
        }
    }
    (kept, repeated)
}

/// A stretch that is drawn twice.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Overlap {
    pub from: Point2,
    pub to: Point2,
    /// The strokes that lie on each other; twice the same where one leads back over itself.
    pub strokes: [usize; 2],
}

/// Two straight lines or two arcs of one circle that lie on each other for more than the tolerance, if there are any.
/// Curves of other kinds are not compared; where too many lie side by side nothing is found.
#[must_use]
pub fn drawn_over(strokes: &[Stroke], map: Affine, flat: Length, tolerance: Length) -> Option<Overlap> {
    let (kept, _) = without_repeats(flatten(strokes, map, flat).ok()?);
    let mut pieces: Vec<(usize, Piece)> = Vec::new();
    for line in &kept {
        for shape in &strokes.get(line.stroke)?.shapes {
            pieces.extend(
                Piece::of(shape.clone().mapped(map))
                    .into_iter()
                    .map(|piece| (line.stroke, piece)),
            );
        }
    }
    let extents: Vec<Extent> = pieces
        .iter()
        .map(|(_, piece)| piece.extent().grown(SAME))
        .collect();
    let least = tolerance.to_mm().max(SAME);
    let found = first_pair(&extents, &mut |one, other| {
        let ((stroke, piece), (with, second)) = (&pieces[one], &pieces[other]);
        let [from, to] = piece.stretch_on(second, least)?;
        Some(Overlap {
            from,
            to,
            strokes: [*stroke, *with],
        })
    });
    found.ok().flatten()
}

/// A straight line, or an arc of a circle.
enum Piece {
    Straight([Point2; 2]),
    Round {
        center: Point2,
        radius: f64,
        /// In rad, to the left from `start`.
        start: f64,
        sweep: f64,
    },
}

impl Piece {
    fn of(shape: Shape) -> Vec<Self> {
        match shape {
            Shape::Polyline(points) => {
                let straight = |ends: &[Point2]| Self::Straight([ends[0], ends[1]]);
                points.windows(2).map(straight).collect()
            }
            Shape::Arc { from, to, sweep } => arc(from, to, sweep).into_iter().collect(),
            Shape::Ellipse { .. } | Shape::Bezier(_) | Shape::Nurbs(_) => Vec::new(),
        }
    }

    fn extent(&self) -> Extent {
        match self {
            Self::Straight([from, to]) => Extent::of(*from, *to),
            Self::Round { center, radius, .. } => Extent::of(*center, *center).grown(*radius),
        }
    }

    /// The ends of what both have in common, if it is longer than `least`.
    fn stretch_on(&self, other: &Self, least: f64) -> Option<[Point2; 2]> {
        match (self, other) {
            (Self::Straight(one), Self::Straight(other)) => straight_stretch(*one, *other, least),
            (
                Self::Round {
                    center,
                    radius,
                    start,
                    sweep,
                },
                Self::Round {
                    center: c,
                    radius: r,
                    start: s,
                    sweep: w,
                },
            ) if center.distance(*c) <= SAME_CIRCLE && (radius - r).abs() <= SAME_CIRCLE => {
                round_stretch([*start, *sweep], [*s, *w], least / radius).map(|[from, to]| {
                    [from, to].map(|angle| {
                        let (sin, cos) = libm::sincos(angle);
                        Point2::new(center.x + radius * cos, center.z + radius * sin)
                    })
                })
            }
            (Self::Straight(_) | Self::Round { .. }, Self::Straight(_) | Self::Round { .. }) => None,
        }
    }
}

fn arc(from: Point2, to: Point2, sweep: f64) -> Option<Piece> {
    let center = super::shape::center_of_arc(from, to, sweep)?;
    let begin = if sweep > 0.0 { from } else { to }.minus(center);
    Some(Piece::Round {
        center,
        radius: center.distance(from),
        start: libm::atan2(begin.z, begin.x),
        sweep: sweep.abs(),
    })
}

fn straight_stretch(one: [Point2; 2], other: [Point2; 2], least: f64) -> Option<[Point2; 2]> {
    // Measured along the longer of the two, whose direction is known better.
    let length = |line: [Point2; 2]| line[0].distance(line[1]);
    let (long, short) = if length(one) >= length(other) {
        (one, other)
    } else {
        (other, one)
    };
    let size = length(long);
    if size <= least {
        return None;
    }
    let way = long[1].minus(long[0]);
    let aside = short.map(|end| way.cross(end.minus(long[0])).abs() / size);
    let along = short.map(|end| way.dot(end.minus(long[0])) / size);
    let (low, high) = (along[0].min(along[1]).max(0.0), along[0].max(along[1]).min(size));
    let is_on_it = aside.iter().all(|aside| *aside <= SAME) && high - low > least;
    is_on_it.then(|| [low, high].map(|at| long[0].lerp(long[1], at / size)))
}

/// The first stretch that two arcs of one circle share, each by its start and sweep, if it is longer than `least` rad.
fn round_stretch(one: [f64; 2], other: [f64; 2], least: f64) -> Option<[f64; 2]> {
    let ahead = (other[0] - one[0]).rem_euclid(TAU);
    // The second arc begins ahead of the first, and perhaps a turn before.
    [ahead, ahead - TAU].into_iter().find_map(|begin| {
        let (low, high) = (begin.max(0.0), (begin + other[1]).min(one[1]));
        (high - low > least).then(|| [one[0] + low, one[0] + high])
    })
}

#[cfg(test)]
mod tests;
