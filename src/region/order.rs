//! The order in which passes are cut: from the deepest places outwards.
//!
//! Passes of a level bound what lies deeper than it; each connected part of that is a node of a tree, and the parts of the next
//! level within it are its children. A part without children is a basin. A part is cut after its children, deepest first: then every
//! pass but the first of a basin has cleared ground beside it, and the tool steps over to it from the pass before, straight
//! outwards, without leaving the ground.

use crate::curve::Curve;
use crate::distance::Walls;
use crate::pass::Pass;
use crate::piece::Piece;
use crate::place::Place;
use crate::region::toggles;

/// Most comparisons of passes of one level with those of the next.
const MOST_COMPARED: usize = 50_000_000;

/// A pass in the order of cutting.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// Which of the passes that were given.
    pub pass: usize,
    /// The pass itself; a closed one begins where the link arrives.
    pub way: Pass,
    /// Which basin it belongs to, counted from 0 in the order in which they are begun. Where basins merge the number is that of the
    /// one that was cut last.
    pub basin: usize,
    /// The straight way from the end of the step before, at depth; none where the tool must lift.
    pub link: Option<Piece>,
}

/// What bounds links.
#[derive(Clone, Copy, Debug)]
pub struct Links<'a> {
    /// The walls that they keep away from.
    pub walls: &'a Walls,
    /// How far, in mm.
    pub distance: f64,
    /// How long they are at most, in mm.
    pub longest: f64,
}

/// There are more passes than can be compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TooMany;

/// Puts passes in the order in which they are cut: inside out, the deepest basin first.
///
/// # Errors
/// Too many passes.
pub fn inside_out(passes: &[Pass], links: Links<'_>) -> Result<Vec<Step>, TooMany> {
    let parts = parts(passes)?;
    let order = order(&parts);
    let mut steps: Vec<Step> = Vec::with_capacity(passes.len());
    let mut basins = 0;
    for part in order.into_iter().filter_map(|part| parts.get(part)) {
        if part.children.is_empty() {
            basins += 1;
        }
        let mut left = part.passes.clone();
        while !left.is_empty() {
            let at = steps
                .last()
                .and_then(|step| step.way.pieces.last())
                .map(|piece| piece.to);
            let next = next(passes, &left, at);
            let number = left.remove(next.min(left.len() - 1));
            let Some(pass) = passes.get(number) else { continue };
            // What begins a basin is entered from above.
            let is_first = part.children.is_empty() && left.len() + 1 == part.passes.len();
            let at = at.filter(|_| !is_first);
            let way = begun_near(pass, at);
            let link = at
                .zip(way.pieces.first())
                .and_then(|(at, first)| links.link(at, first.from));
            steps.push(Step {
                pass: number,
                way,
                basin: basins.max(1) - 1,
                link,
            });
        }
    }
    Ok(steps)
}

impl Links<'_> {
    fn link(&self, from: Place, to: Place) -> Option<Piece> {
        let length = from.distance(to);
        let piece = Piece::line(from, to);
        if length > self.longest {
            return None;
        }
        if length == 0.0 {
            return Some(piece);
        }
        let nearest = self.walls.nearest_to(piece);
        let is_free = nearest.is_none_or(|(_, nearest)| nearest.distance >= self.distance - 1e-6);
        is_free.then_some(piece)
    }
}

/// A connected part of what lies deeper than a level.
#[derive(Debug)]
struct Part {
    passes: Vec<usize>,
    children: Vec<usize>,
    /// Whether it lies in another part.
    is_inner: bool,
    /// The deepest level within it.
    depth: u32,
}

/// The outline of a part: a closed pass, or open ones with the gaps between their ends.
struct Outline {
    passes: Vec<usize>,
    pieces: Vec<Piece>,
}

impl Outline {
    fn encloses(&self, place: Place) -> bool {
        self.pieces.iter().filter(|piece| toggles(piece, place)).count() % 2 == 1
    }

    fn twice_area(&self) -> f64 {
        self.pieces.iter().map(|piece| piece.twice_area()).sum()
    }
}

/// The parts of all levels, and which lies in which.
fn parts(passes: &[Pass]) -> Result<Vec<Part>, TooMany> {
    let last = passes.iter().map(|pass| pass.level).max();
    let mut by_level: Vec<Vec<usize>> = vec![Vec::new(); last.map_or(0, |last| last as usize + 1)];
    for (number, pass) in passes.iter().enumerate() {
        if let Some(level) = by_level.get_mut(pass.level as usize) {
            level.push(number);
        }
    }
    let mut parts: Vec<Part> = Vec::new();
    let mut above: Vec<(usize, Outline)> = Vec::new();
    let mut left = MOST_COMPARED;
    for (level, numbers) in (0..).zip(by_level) {
        let work = numbers.len().saturating_mul(numbers.len() + above.len());
        left = left.checked_sub(work).ok_or(TooMany)?;
        let (outer, inner): (Vec<Outline>, Vec<Outline>) = outlines(passes, &numbers)
            .into_iter()
            .partition(|outline| outline.twice_area() >= 0.0);
        let mut here = Vec::new();
        for outline in outer {
            let number = parts.len();
            let parent = probe(&outline).and_then(|place| around(&above, place));
            if let Some(parent) = parent.and_then(|parent| parts.get_mut(parent)) {
                parent.children.push(number);
            }
            let passes = outline.passes.clone();
            let is_inner = parent.is_some();
            parts.push(Part {
                passes,
                children: Vec::new(),
                is_inner,
                depth: level,
            });
            here.push((number, outline));
        }
        // Passes round islands belong to the part around them.
        for outline in inner {
            let around = probe(&outline).and_then(|place| around(&here, place));
            if let Some(part) = around.and_then(|part| parts.get_mut(part)) {
                part.passes.extend(outline.passes);
            } else {
                let passes = outline.passes;
                parts.push(Part {
                    passes,
                    children: Vec::new(),
                    is_inner: false,
                    depth: level,
                });
            }
        }
        above = here;
    }
    for number in (0..parts.len()).rev() {
        let children = parts
            .get(number)
            .map(|part| part.children.clone())
            .unwrap_or_default();
        let depth = children
            .iter()
            .filter_map(|&child| parts.get(child))
            .map(|part| part.depth)
            .max();
        if let Some((part, depth)) = parts.get_mut(number).zip(depth) {
            part.depth = depth;
        }
    }
    Ok(parts)
}

/// The part that a place lies in: the innermost, as a part may lie in an island of another.
fn around(parts: &[(usize, Outline)], place: Place) -> Option<usize> {
    let around = parts.iter().filter(|(_, outline)| outline.encloses(place));
    let least = around.min_by(|a, b| a.1.twice_area().total_cmp(&b.1.twice_area()));
    least.map(|(part, _)| *part)
}

/// A place of an outline, off its corners.
fn probe(outline: &Outline) -> Option<Place> {
    let longest = outline
        .pieces
        .iter()
        .max_by(|a, b| a.length().total_cmp(&b.length()));
    longest.map(|piece| piece.at(0.5))
}

/// Closed passes as they are, and open ones from each end on to the nearest beginning.
fn outlines(passes: &[Pass], numbers: &[usize]) -> Vec<Outline> {
    let numbered = numbers
        .iter()
        .filter_map(|&number| Some((number, passes.get(number)?)));
    let (closed, open): (Vec<_>, Vec<_>) = numbered.partition(|(_, pass)| pass.is_closed());
    let mut outlines: Vec<Outline> = closed
        .into_iter()
        .map(|(number, pass)| Outline {
            passes: vec![number],
            pieces: pass.pieces.clone(),
        })
        .collect();
    let mut left = open;
    while let Some((number, pass)) = left.pop() {
        let mut outline = Outline {
            passes: vec![number],
            pieces: pass.pieces.clone(),
        };
        let begin = pass.pieces.first().map(|piece| piece.from);
        while let Some((begin, end)) = begin.zip(outline.pieces.last().map(|piece| piece.to)) {
            let away = |pass: &Pass| {
                pass.pieces
                    .first()
                    .map_or(f64::INFINITY, |piece| piece.from.distance(end))
            };
            let nearest = (0..left.len()).min_by(|&a, &b| {
                let away = |at: usize| left.get(at).map_or(f64::INFINITY, |(_, pass)| away(pass));
                away(a).total_cmp(&away(b))
            });
            let nearest = nearest.filter(|&at| {
                left.get(at)
                    .is_some_and(|(_, pass)| away(pass) < begin.distance(end))
            });
            let Some(at) = nearest else {
                outline.pieces.push(Piece::line(end, begin));
                break;
            };
            let (number, pass) = left.remove(at);
            outline.passes.push(number);
            outline
                .pieces
                .extend(pass.pieces.first().map(|first| Piece::line(end, first.from)));
            outline.pieces.extend(&pass.pieces);
        }
        outlines.push(outline);
    }
    outlines
}

/// Parts so that children come before what they lie in, the deepest first.
fn order(parts: &[Part]) -> Vec<usize> {
    let deepest_first = |numbers: &mut Vec<usize>| {
        numbers.sort_by_key(|&number| {
            (
                parts.get(number).map(|part| core::cmp::Reverse(part.depth)),
                number,
            )
        });
    };
    let mut roots: Vec<usize> = (0..parts.len())
        .filter(|&part| parts.get(part).is_some_and(|part| !part.is_inner))
        .collect();
    deepest_first(&mut roots);
    // Backwards: what is cut last first, its children after it, the deepest last.
    let mut open = roots;
    let mut order = Vec::with_capacity(parts.len());
    while let Some(number) = open.pop() {
        order.push(number);
        let mut children = parts
            .get(number)
            .map(|part| part.children.clone())
            .unwrap_or_default();
        deepest_first(&mut children);
        open.extend(children);
    }
    order.reverse();
    order
}

/// Which of some passes is nearest to a place.
fn next(passes: &[Pass], left: &[usize], at: Option<Place>) -> usize {
    let Some(at) = at else { return 0 };
    let away = |number: usize| {
        passes
            .get(number)
            .map_or(f64::INFINITY, |pass| nearest(pass, at).2)
    };
    let ways = left.iter().map(|&number| away(number)).enumerate();
    ways.min_by(|a, b| a.1.total_cmp(&b.1)).map_or(0, |(at, _)| at)
}

/// The nearest place of a pass where it may begin: its piece, the place and how far away it is.
fn nearest(pass: &Pass, at: Place) -> (usize, Place, f64) {
    let mut best = (0, at, f64::INFINITY);
    if pass.is_closed() {
        for (number, &piece) in pass.pieces.iter().enumerate() {
            let foot = Curve::of(piece).nearest(at);
            if foot.distance < best.2 {
                best = (number, foot.at, foot.distance);
            }
        }
    } else if let (Some(first), Some(last)) = (pass.pieces.first(), pass.pieces.last()) {
        let (begin, end) = (first.from.distance(at), last.to.distance(at));
        best = (0, first.from, begin.min(end));
    }
    best
}

/// The pass from the place nearest to another on; open ones from the nearer end. Without a place a closed one begins in the middle of
/// its longest piece.
#[must_use]
pub fn begun_near(pass: &Pass, at: Option<Place>) -> Pass {
    let mut pass = pass.clone();
    if !pass.is_closed() {
        let ends = pass.pieces.first().zip(pass.pieces.last());
        let is_far = at
            .zip(ends)
            .is_some_and(|(at, (first, last))| last.to.distance(at) < first.from.distance(at));
        if is_far {
            pass.pieces.reverse();
            for piece in &mut pass.pieces {
                *piece = piece.reversed();
            }
        }
        return pass;
    }
    // Without a place: in the middle of its longest piece, where what lies outside of it begins beside it.
    let longest = pass
        .pieces
        .iter()
        .enumerate()
        .max_by(|a, b| a.1.length().total_cmp(&b.1.length()));
    let (number, place) = match at {
        Some(at) => {
            let (number, place, _) = nearest(&pass, at);
            (number, place)
        }
        None => longest.map_or((0, Place::new(0.0, 0.0)), |(number, piece)| {
            (number, piece.at(0.5))
        }),
    };
    pass.pieces.rotate_left(number);
    let Some(&first) = pass.pieces.first() else {
        return pass;
    };
    let curve = Curve::of(first);
    // At an end already: nothing to cut in two.
    if place.distance(first.from) > MERGED && place.distance(first.to) > MERGED {
        if let Some(piece) = pass.pieces.first_mut() {
            *piece = curve.part(place, first.to);
        }
        pass.pieces.push(curve.part(first.from, place));
    } else if place.distance(first.to) <= MERGED {
        pass.pieces.rotate_left(1);
    }
    pass
}

/// Places closer than this, in mm, are one.
const MERGED: f64 = 1e-6;

#[cfg(test)]
mod tests;
