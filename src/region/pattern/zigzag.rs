//! Rows, joined along the walls.
//!
//! Rows cross the loops of the level next to the walls. Along a loop crossings follow each other; between two that follow each
//! other the loop lies between two rows. Where these are a row and the next one, the loop joins their ends.

use super::{MOST_PASSES, MOST_PIECES, PatternFault, Tool};
use crate::curve::{Curve, crossings};
use crate::offset::{Kind, OffsetFault, Offsets, Way};
use crate::pass::Pass;
use crate::piece::Piece;
use crate::place::Place;

/// Rows shorter than this, in mm, are left out.
const LEAST: f64 = 1e-6;

/// The pass next to the walls, and the rows.
pub(super) fn passes(
    offsets: &mut Offsets,
    tool: &Tool,
    step: f64,
    angle: f64,
) -> Result<Vec<Pass>, PatternFault> {
    let distance = tool.wall_distance();
    let wall = match offsets.level(distance) {
        Err(OffsetFault::NoWalls) => Vec::new(),
        ways => ways?,
    };
    let loops = offsets.closed_level(distance)?;
    let mut passes: Vec<Pass> = wall
        .into_iter()
        .map(|way| Pass {
            level: 0,
            pieces: way.pieces,
        })
        .collect();
    let loops = loops.into_iter().filter(|way| way.kind != Kind::Tie);
    passes.extend(Rows::of(loops.collect(), step, angle)?.joined());
    Ok(passes)
}

/// A place where a row crosses a loop.
#[derive(Clone, Copy)]
struct Crossing {
    row: usize,
    /// Loop and piece.
    ring: usize,
    piece: usize,
    place: Place,
    /// How far along the row.
    along: f64,
}

struct Rows {
    loops: Vec<Way>,
    /// Along the loops, loop by loop.
    crossings: Vec<Crossing>,
    /// The crossing before and after along the loop.
    neighbours: Vec<[usize; 2]>,
    /// The other end of the part of a row within the region.
    partners: Vec<usize>,
    /// Crossings by rows, in their order along them.
    order: Vec<usize>,
}

impl Rows {
    fn of(loops: Vec<Way>, step: f64, angle: f64) -> Result<Self, PatternFault> {
        let (sin, cos) = libm::sincos(angle);
        let along = Place::new(cos, sin);
        let mut rows = Self {
            loops,
            crossings: Vec::new(),
            neighbours: Vec::new(),
            partners: Vec::new(),
            order: Vec::new(),
        };
        let (low, high) = rows.height(along);
        let count = libm::ceil((high - low) / step);
        if count > MOST_PASSES as f64 {
            return Err(PatternFault::TooMany);
        }
        // The lowest and the highest are the pass next to the walls.
        let rise = (high - low) / count;
        rows.cross(along, low, rise, count as usize)?;
        rows.pair();
        Ok(rows)
    }

    /// How far the loops reach across rows.
    fn height(&self, along: Place) -> (f64, f64) {
        let across = along.left();
        let pieces = self.loops.iter().flat_map(|way| &way.pieces);
        let heights = pieces.flat_map(|&piece| {
            let curve = Curve::of(piece);
            let extremes = [along, along.times(-1.0)].map(|along| curve.where_it_goes(along));
            let places = extremes.into_iter().flatten().chain([piece.from]);
            places.map(|place| across.dot(place)).collect::<Vec<f64>>()
        });
        heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), at| {
            (low.min(at), high.max(at))
        })
    }

    /// Finds all crossings of rows 1 to `count - 1` with the loops.
    fn cross(&mut self, along: Place, low: f64, rise: f64, count: usize) -> Result<(), PatternFault> {
        let across = along.left();
        let height = |row: usize| low + rise * row as f64;
        for (ring, way) in self.loops.iter().enumerate() {
            let first = self.crossings.len();
            for (number, &piece) in way.pieces.iter().enumerate() {
                for part in monotone(piece, along) {
                    let (from, to) = (across.dot(part.from), across.dot(part.to));
                    let (least, most) = (from.min(to), from.max(to));
                    // Rows above the lower end, and not above the upper one.
                    let begin = (libm::floor((least - low) / rise).max(0.0) as usize).max(1);
                    let rows = (begin..count).take_while(|&row| height(row) <= most);
                    let mut rows: Vec<usize> = rows.filter(|&row| height(row) > least).collect();
                    if from > to {
                        rows.reverse();
                    }
                    for row in rows {
                        let place = meeting(&part, across.times(height(row)), along);
                        self.crossings.push(Crossing {
                            row,
                            ring,
                            piece: number,
                            place,
                            along: along.dot(place),
                        });
                    }
                    if self.crossings.len() > MOST_PIECES {
                        return Err(PatternFault::TooMany);
                    }
                }
            }
            let last = self.crossings.len();
            let turn = last - first;
            self.neighbours.extend((first..last).map(|at| {
                let step = |by: usize| first + (at - first + by) % turn.max(1);
                [step(turn - 1), step(1)]
            }));
        }
        Ok(())
    }

    /// Pairs the crossings of each row, in their order along it.
    fn pair(&mut self) {
        let mut order: Vec<usize> = (0..self.crossings.len()).collect();
        let key = |number: usize| {
            self.crossings
                .get(number)
                .map(|crossing| (crossing.row, crossing.along))
        };
        order.sort_by(|&a, &b| match (key(a), key(b)) {
            (Some(a), Some(b)) => a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)),
            _ => core::cmp::Ordering::Equal,
        });
        self.partners = vec![0; order.len()];
        for pair in order.chunks_exact(2) {
            if let &[a, b] = pair {
                for (one, other) in [(a, b), (b, a)] {
                    if let Some(partner) = self.partners.get_mut(one) {
                        *partner = other;
                    }
                }
            }
        }
        self.order = order;
    }

    /// All rows, those that follow each other joined.
    fn joined(&self) -> Vec<Pass> {
        let mut is_used = vec![false; self.crossings.len()];
        let mut passes = Vec::new();
        for &first in &self.order {
            if is_used.get(first) != Some(&false) {
                continue;
            }
            let mut pieces = Vec::new();
            let mut begin = Some(first);
            while let Some(from) = begin {
                let Some(&to) = self.partners.get(from) else {
                    break;
                };
                for end in [from, to] {
                    if let Some(is_used) = is_used.get_mut(end) {
                        *is_used = true;
                    }
                }
                let ends = self.crossings.get(from).zip(self.crossings.get(to));
                if let Some((from, to)) = ends.filter(|(from, to)| from.place.distance(to.place) > LEAST) {
                    pieces.push(Piece::line(from.place, to.place));
                }
                begin = self.onwards(to, &is_used, &mut pieces);
            }
            if !pieces.is_empty() {
                passes.push(Pass { level: 1, pieces });
            }
        }
        passes
    }

    /// Goes along the loop from an end of a row to one of the next row, if that is free.
    fn onwards(&self, from: usize, is_used: &[bool], pieces: &mut Vec<Piece>) -> Option<usize> {
        let end = self.crossings.get(from)?;
        let [before, after] = *self.neighbours.get(from)?;
        let is_next = |to: usize| {
            let next = self.crossings.get(to);
            next.is_some_and(|next| next.row == end.row + 1) && is_used.get(to) == Some(&false)
        };
        if is_next(after) {
            let way = self.between(from, after)?;
            add(pieces, way);
            Some(after)
        } else if is_next(before) {
            let mut way = self.between(before, from)?;
            way.reverse();
            for piece in &mut way {
                *piece = piece.reversed();
            }
            add(pieces, way);
            Some(before)
        } else {
            None
        }
    }

    /// The part of a loop between two crossings.
    fn between(&self, from: usize, to: usize) -> Option<Vec<Piece>> {
        let (from, to) = (self.crossings.get(from)?, self.crossings.get(to)?);
        let pieces = &self.loops.get(from.ring)?.pieces;
        let first = Curve::of(*pieces.get(from.piece)?);
        // Within one piece, or once round and back into it.
        if from.piece == to.piece && first.progress(from.place).abs() <= first.progress(to.place).abs() {
            return Some(vec![first.part(from.place, to.place)]);
        }
        let mut way = vec![first.part(from.place, first.piece.to)];
        let mut number = (from.piece + 1) % pieces.len();
        while number != to.piece {
            way.push(*pieces.get(number)?);
            number = (number + 1) % pieces.len();
        }
        let last = Curve::of(*pieces.get(to.piece)?);
        way.push(last.part(last.piece.from, to.place));
        Some(way)
    }
}

/// Adds pieces, those without length left out.
fn add(pieces: &mut Vec<Piece>, way: Vec<Piece>) {
    for mut piece in way {
        if let Some(last) = pieces.last() {
            piece.from = last.to;
        }
        if piece.from.distance(piece.to) > LEAST {
            pieces.push(piece);
        } else if let Some(last) = pieces.last_mut() {
            last.to = piece.to;
        }
    }
}

/// The parts of a piece between the places where it goes along rows.
fn monotone(piece: Piece, along: Place) -> Vec<Piece> {
    let curve = Curve::of(piece);
    let turns = [along, along.times(-1.0)].into_iter();
    let mut turns: Vec<Place> = turns.filter_map(|along| curve.where_it_goes(along)).collect();
    turns.sort_by(|a, b| curve.progress(*a).abs().total_cmp(&curve.progress(*b).abs()));
    let mut parts = Vec::new();
    let mut from = piece.from;
    for to in turns.into_iter().chain([piece.to]) {
        if from.distance(to) > 0.0 {
            parts.push(curve.part(from, to));
        }
        from = to;
    }
    parts
}

/// Where a piece that crosses a row does.
fn meeting(part: &Piece, on_row: Place, along: Place) -> Place {
    let (from, to) = (part.from, part.to);
    let across = along.left();
    let share = across.dot(on_row.minus(from)) / across.dot(to.minus(from));
    let on_chord = from.lerp(to, share.clamp(0.0, 1.0));
    if part.is_line() {
        return on_chord;
    }
    let (curve, row) = (
        Curve::of(*part),
        Curve::of(Piece::line(on_row, on_row.plus(along))),
    );
    let places = crossings(&curve, &row).into_iter().flatten();
    let away = |place: &Place| curve.distance(*place);
    // Rows that touch miss by rounding.
    places
        .min_by(|a, b| away(a).total_cmp(&away(b)))
        .filter(|place| away(place) < LEAST)
        .unwrap_or(on_chord)
}
