//! Sides of loops that lines mark as open.
//!
//! A line marks the straight sides that lie on it from end to end, within the tolerance over which ends are joined. Together they
//! must cover it.

use super::arcs::Bow;
use super::lines::curve_of;
use super::loops::Loops;
use super::{Affine, OutlineError, Shape, Stroke};
use crate::point::Point2;
use vcutc_backend_api::units::Length;

/// Most pairs of a line and a side that are compared.
const MOST_PAIRS: usize = 100_000_000;

/// A side of a loop: the place of the loop, and of the piece in it.
pub type SideName = (usize, usize);

/// Why lines mark no sides.
#[derive(Clone, Debug, PartialEq)]
pub enum OpenError {
    /// A stroke is not a curve, or nothing is drawn.
    Strokes(OutlineError),
    /// A stroke is curved; open sides are straight.
    Curved {
        /// The stroke.
        stroke: usize,
    },
    /// A line lies on no side, or lies beyond the ends of those on which it lies.
    Uncovered {
        /// The stroke of the line.
        stroke: usize,
        /// The line in the workpiece.
        line: [Point2; 2],
        /// A side that it lies on in part, if there is one: it is longer than the line.
        side: Option<SideName>,
    },
    /// More lines and sides than are compared.
    TooMany,
}

/// The sides that strokes mark, in order. `map` leads from their drawing to the workpiece.
///
/// # Errors
/// See [`OpenError`].
pub fn open_sides(
    loops: &Loops,
    strokes: &[Stroke],
    map: Affine,
    tolerance: Length,
) -> Result<Vec<SideName>, OpenError> {
    let sides: Vec<(SideName, Bow)> = straight_sides(loops);
    let tolerance = tolerance.to_mm();
    let mut left = MOST_PAIRS;
    let mut marked = Vec::new();
    let mut lines = 0;
    for (stroke, drawn) in strokes.iter().enumerate() {
        for line in lines_of(drawn, stroke, map)? {
            lines += 1;
            left = left.checked_sub(sides.len()).ok_or(OpenError::TooMany)?;
            marked.extend(covered(line, stroke, &sides, tolerance)?);
        }
    }
    if lines == 0 {
        return Err(OpenError::Strokes(OutlineError::Nothing));
    }
    marked.sort_unstable();
    marked.dedup();
    Ok(marked)
}

fn straight_sides(loops: &Loops) -> Vec<(SideName, Bow)> {
    let rings = loops.rings.iter().enumerate();
    let sides = rings.flat_map(|(ring, pieces)| {
        let named = move |(place, piece): (usize, &super::LoopPiece)| ((ring, place), piece.way);
        pieces.iter().enumerate().map(named)
    });
    sides.filter(|(_, way)| way.is_line()).collect()
}

/// The lines of a stroke, without those that have no extent.
fn lines_of(drawn: &Stroke, stroke: usize, map: Affine) -> Result<Vec<[Point2; 2]>, OpenError> {
    let mut lines = Vec::new();
    for shape in &drawn.shapes {
        let shape = shape.clone().mapped(map);
        curve_of(&shape, stroke).map_err(OpenError::Strokes)?;
        let Shape::Polyline(points) = shape else {
            return Err(OpenError::Curved { stroke });
        };
        lines.extend(points.windows(2).map(|ends| [ends[0], ends[1]]));
    }
    lines.retain(|[from, to]| from.distance(*to) >= super::join::SAME);
    Ok(lines)
}

/// The sides on a line, which must cover it.
fn covered(
    line: [Point2; 2],
    stroke: usize,
    sides: &[(SideName, Bow)],
    tolerance: f64,
) -> Result<Vec<SideName>, OpenError> {
    let mut found: Vec<(f64, f64, SideName)> = Vec::new();
    let mut longer = None;
    for (name, side) in sides {
        match lies(*side, line, tolerance) {
            Lies::On(from, to) => found.push((from, to, *name)),
            Lies::Partly => longer = longer.or(Some(*name)),
            Lies::Apart => {}
        }
    }
    found.sort_by(|one, other| one.0.total_cmp(&other.0).then(one.2.cmp(&other.2)));
    let mut reached = 0.0_f64;
    let mut is_whole = true;
    for (from, to, _) in &found {
        is_whole &= *from <= reached + tolerance;
        reached = reached.max(*to);
    }
    let length = line[0].distance(line[1]);
    if found.is_empty() || !is_whole || reached < length - tolerance {
        return Err(OpenError::Uncovered {
            stroke,
            line,
            side: longer,
        });
    }
    Ok(found.into_iter().map(|(_, _, name)| name).collect())
}

/// How a side lies to a line.
enum Lies {
    /// On it with both ends: from here to there along the line.
    On(f64, f64),
    /// Along it, but beyond its ends.
    Partly,
    Apart,
}

fn lies(side: Bow, [from, to]: [Point2; 2], tolerance: f64) -> Lies {
    let length = from.distance(to);
    let way = to.minus(from);
    let along = [side.from, side.to].map(|end| end.minus(from).dot(way) / length);
    let aside = [side.from, side.to].map(|end| end.minus(from).cross(way).abs() / length);
    let (low, high) = (along[0].min(along[1]), along[0].max(along[1]));
    let common = high.min(length) - low.max(0.0);
    // Sides that are no longer than the tolerance lie across a line as well as along it.
    let is_along = high - low > 0.5 * side.from.distance(side.to);
    if !is_along || aside.iter().any(|off| *off > tolerance) || common <= 0.0 {
        Lies::Apart
    } else if low >= -tolerance && high <= length + tolerance {
        Lies::On(low, high)
    } else if common > tolerance {
        Lies::Partly
    } else {
        Lies::Apart
    }
}

#[cfg(test)]
mod tests;
