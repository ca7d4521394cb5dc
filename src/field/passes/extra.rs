//! Extra passes through ground that others leave.
//!
//! A place that is deeper than a level by no more than the tool's radius is cut from that level: it lies straight towards the nearest
//! wall. So stretches of true offsets, from the least depth of uncut ground on and some radius apart, clear all of it, and they
//! keep from walls what that ground does.

use vcutc_region::coverage::Spot;
use vcutc_region::curve::Curve;
use vcutc_region::distance::Walls;
use vcutc_region::offset::{OffsetFault, Offsets, Way};
use vcutc_region::pass::Pass;
use vcutc_region::pattern::Tool;
use vcutc_region::piece::Piece;
use vcutc_region::place::Place;

/// Distance of the places that stand for uncut ground, and of extra passes, in radii: a pass cuts the places up to the next, and
/// the ground half a diagonal around them.
const FINE: f64 = 0.2;
const APART: f64 = 0.8;

/// How far passes reach beyond the ground, and gaps that they go on over, in radii.
const BEYOND: f64 = 0.2;
const GAP: f64 = 1.0;

/// Spots that are cleared in one round at most, and places in one of them.
const MOST_SPOTS: usize = 1000;
const MOST_PLACES: usize = 100_000;

/// Stretches of offsets that clear uncut ground.
pub(super) fn through(
    spots: &[Spot],
    offsets: &mut Offsets,
    tool: &Tool,
    step: f64,
) -> Result<Vec<Pass>, OffsetFault> {
    let mut passes = Vec::new();
    for spot in spots.iter().take(MOST_SPOTS) {
        let mut places = deep(spot, offsets.walls(), FINE * tool.radius);
        places.sort_by(|one, other| one.0.total_cmp(&other.0));
        let mut rest = places.as_slice();
        while let Some(&(least, _)) = rest.first() {
            let depth = least.max(tool.wall_distance());
            let count = rest.partition_point(|&(d, _)| d <= depth + APART * tool.radius);
            let (here, deeper) = rest.split_at(count.max(1));
            let ways = offsets.level(depth)?;
            // Level 0 is the pass next to the walls.
            let level = libm::round((depth - tool.wall_distance()) / step).max(1.0);
            let stretches = stretches(&ways, here, tool.radius).into_iter();
            // The cast saturates.
            passes.extend(stretches.map(|pieces| Pass {
                level: level as u32,
                pieces,
            }));
            rest = deeper;
        }
    }
    Ok(passes)
}

/// Places that stand for uncut ground, each with its depth, in mm.
fn deep(spot: &Spot, walls: &Walls, fine: f64) -> Vec<(f64, Place)> {
    let mut places = Vec::new();
    for square in &spot.squares {
        let count = libm::ceil(square.side / fine).clamp(1.0, 1e3) as u32;
        let pitch = square.side / f64::from(count);
        for (column, row) in (0..count).flat_map(|column| (0..count).map(move |row| (column, row))) {
            let aside = Place::new(f64::from(column) + 0.5, f64::from(row) + 0.5).times(pitch);
            let place = square.low.plus(aside);
            if places.len() < MOST_PLACES {
                places.push((walls.distance(place), place));
            }
        }
    }
    places
}

/// The stretches of a level that are nearest to some places.
fn stretches(ways: &[Way], places: &[(f64, Place)], radius: f64) -> Vec<Vec<Piece>> {
    let mut roads: Vec<Road> = ways.iter().map(Road::of).collect();
    let numbered = ways.iter().enumerate().flat_map(|(number, way)| {
        way.pieces
            .iter()
            .enumerate()
            .map(move |(at, piece)| ((number, at), *piece))
    });
    let (names, pieces): (Vec<(usize, usize)>, Vec<Piece>) = numbered.unzip();
    let nearest = Walls::of_pieces(pieces.into_iter().enumerate());
    for (_, place) in places {
        let Some(found) = nearest.nearest(*place) else {
            continue;
        };
        if let Some(&(way, piece)) = names.get(found.edge)
            && let Some(road) = roads.get_mut(way)
        {
            road.mark(piece, found.at);
        }
    }
    roads.iter_mut().flat_map(|road| road.stretches(radius)).collect()
}

/// A way with marks on it.
struct Road<'a> {
    way: &'a Way,
    /// Where its pieces begin, in mm from its beginning, and where it ends.
    begins: Vec<f64>,
    marks: Vec<f64>,
}

impl<'a> Road<'a> {
    fn of(way: &'a Way) -> Self {
        let mut begins = vec![0.0];
        let mut length = 0.0;
        for piece in &way.pieces {
            length += piece.length();
            begins.push(length);
        }
        Self {
            way,
            begins,
            marks: Vec::new(),
        }
    }

    fn length(&self) -> f64 {
        self.begins.last().copied().unwrap_or(0.0)
    }

    /// Marks a place on a piece.
    fn mark(&mut self, number: usize, place: Place) {
        if let Some((&begin, &piece)) = self.begins.get(number).zip(self.way.pieces.get(number)) {
            let progress = Curve::of(piece).progress(place).abs();
            let way = piece.radius().map_or(progress, |radius| radius * progress);
            self.marks.push(begin + way);
        }
    }

    /// The stretches around marks.
    fn stretches(&mut self, radius: f64) -> Vec<Vec<Piece>> {
        let (beyond, gap) = (BEYOND * radius, (2.0 * BEYOND + GAP) * radius);
        let length = self.length();
        self.marks.sort_unstable_by(f64::total_cmp);
        let (Some(&first), Some(&last)) = (self.marks.first(), self.marks.last()) else {
            return Vec::new();
        };
        let mut marks = self.marks.clone();
        if self.way.is_closed() {
            // Round to the widest gap, from the mark after it.
            let gaps = marks
                .iter()
                .zip(marks.iter().skip(1))
                .map(|(one, next)| next - one);
            let widest = gaps.enumerate().max_by(|one, other| one.1.total_cmp(&other.1));
            let around = first + length - last;
            let (after, widest) = widest
                .filter(|&(_, widest)| widest > around)
                .map_or((0, around), |(before, widest)| (before + 1, widest));
            if widest <= gap {
                return vec![self.way.pieces.clone()];
            }
            marks.rotate_left(after);
            let wrapped = marks.len() - after;
            for mark in marks.iter_mut().skip(wrapped) {
                *mark += length;
            }
        }
        let mut found = Vec::new();
        for together in marks.chunk_by(|one, next| next - one <= gap) {
            if let (Some(from), Some(to)) = (together.first(), together.last()) {
                found.push(self.between(from - beyond, to + beyond));
            }
        }
        found.retain(|pieces| !pieces.is_empty());
        found
    }

    /// The pieces between two distances from the beginning; of a closed way on over its end, and back over its beginning.
    fn between(&self, from: f64, to: f64) -> Vec<Piece> {
        let length = self.length();
        let rounds: &[f64] = if self.way.is_closed() {
            &[-1.0, 0.0, 1.0]
        } else {
            &[0.0]
        };
        let mut pieces: Vec<Piece> = Vec::new();
        for round in rounds {
            for (&piece, begin) in self.way.pieces.iter().zip(&self.begins) {
                let (begin, size) = (begin + round * length, piece.length());
                let share = |at: f64| ((at - begin) / size).clamp(0.0, 1.0);
                let (low, high) = (share(from), share(to));
                let mut part = piece.part(low, high);
                if let Some(last) = pieces.last() {
                    part.from = last.to;
                }
                if high > low && part.is_sound() {
                    pieces.push(part);
                }
            }
        }
        pieces
    }
}
