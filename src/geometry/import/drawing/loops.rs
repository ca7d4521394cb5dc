//! From strokes to closed loops of lines and arcs.
//!
//! Polylines and arcs are taken as they are. Other curves become arcs that stay within [`ROUND`] of them ([`super::arcs`]). Where
//! two ends are joined over a gap both go to its middle, as in [`super::outline()`], and an arc keeps the angle that it turns
//! through.

use super::arcs::{Bow, fit};
use super::chain::{Walked, listed, nearest};
use super::fault::{Chain, Gap, OutlineError};
use super::join::SAME;
use super::lines::curve_of;
use super::route::{Joined, Route};
use super::shape::Shape;
use super::{Affine, Stroke};
use crate::curve::{COINCIDENT, MOST_POINTS};
use crate::point::Point2;
use vcutc_backend_api::units::Length;

/// How far arcs are from the curves that they stand for, at most.
pub const ROUND: Length = Length::mm(1e-3);

/// How far the polylines are from curves that arcs are fitted to, in mm: a part of [`ROUND`].
const FINE: f64 = 1e-4;

/// A piece of a loop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoopPiece {
    /// Its way in the workpiece.
    pub way: Bow,
    /// The stroke that drew it, as a place in the list of strokes.
    pub stroke: usize,
}

/// A closed chain of pieces, each beginning where the one before ends and the first where the last does.
pub type Ring = Vec<LoopPiece>;

/// All that is drawn, as loops.
#[derive(Clone, Debug, PartialEq)]
pub struct Loops {
    /// The loops, in the order in which their first strokes are drawn; each goes the way in which its first stroke does.
    pub rings: Vec<Ring>,
    /// The widest gap over which ends were joined; none when all ends coincide.
    pub widest: Option<Gap>,
    /// Strokes that lie on others from end to end, and count once.
    pub repeated: Vec<usize>,
}

/// Why strokes do not form loops.
#[derive(Clone, Debug, PartialEq)]
pub enum LoopsError {
    /// The strokes do not chain: nothing is drawn, a shape is not a curve, or ends cannot be paired.
    Strokes(OutlineError),
    /// Some chains do not close.
    Open {
        /// How many loops there are.
        loops: usize,
        /// The chains that are not loops.
        chains: Vec<Chain>,
        /// The two loose ends that are nearest each other: of one chain or of two.
        nearest: Option<Gap>,
    },
}

impl From<OutlineError> for LoopsError {
    fn from(error: OutlineError) -> Self {
        Self::Strokes(error)
    }
}

/// The loops that strokes form, after a map from the drawing to the workpiece. Ends are joined that are no farther apart than
/// `joined`. What the loops do to each other is not looked at.
///
/// # Errors
/// See [`LoopsError`].
pub fn loops(strokes: &[Stroke], map: Affine, joined: Length) -> Result<Loops, LoopsError> {
    let found = Joined::of(strokes, map, ROUND, joined)?;
    let open = found.routes.iter().filter(|route| !route.is_closed);
    let open: Vec<Walked> = open.map(|route| Walked::along(route, &found.lines)).collect();
    if !open.is_empty() {
        let chains = listed(&open);
        return Err(LoopsError::Open {
            loops: found.routes.len() - open.len(),
            nearest: nearest_ends(&chains, &open),
            chains,
        });
    }
    if found.routes.is_empty() {
        return Err(OutlineError::Nothing.into());
    }
    let mut left = MOST_POINTS;
    let mut widest = None;
    let mut rings = Vec::with_capacity(found.routes.len());
    for route in &found.routes {
        rings.push(ring(route, &found, (strokes, map), &mut left, &mut widest)?);
    }
    Ok(Loops {
        rings,
        widest,
        repeated: found.repeated,
    })
}

/// The nearest two loose ends of all.
fn nearest_ends(chains: &[Chain], walked: &[Walked]) -> Option<Gap> {
    let own = chains.iter().map(|chain| Gap {
        from: chain.to,
        to: chain.from,
        strokes: [chain.last, chain.first],
    });
    let all = own.chain(nearest(walked));
    all.min_by(|one, other| one.size().to_mm().total_cmp(&other.size().to_mm()))
}

/// The pieces of a closed route.
fn ring(
    route: &Route,
    found: &Joined,
    (strokes, map): (&[Stroke], Affine),
    left: &mut usize,
    widest: &mut Option<Gap>,
) -> Result<Ring, OutlineError> {
    let mut parts: Vec<Ring> = Vec::with_capacity(route.entries.len());
    for &entry in &route.entries {
        let stroke = found.lines[entry / 2].stroke;
        let mut part = pieces(&strokes[stroke], stroke, map, left)?;
        if entry % 2 == 1 {
            part.reverse();
            for piece in &mut part {
                piece.way = piece.way.reversed();
            }
        }
        parts.push(part);
    }
    let count = parts.len();
    for place in 0..count {
        if let Some(gap) = meet(&mut parts, place, (place + 1) % count) {
            let so_far = widest.map_or(SAME, |widest| widest.size().to_mm());
            if gap.size().to_mm() > so_far {
                *widest = Some(gap);
            }
        }
    }
    Ok(parts.into_iter().flatten().collect())
}

/// Moves the end of one part and the beginning of the next to the middle between both, and gives the gap between them.
fn meet(parts: &mut [Ring], one: usize, next: usize) -> Option<Gap> {
    let (end, beginning) = (*parts[one].last()?, *parts[next].first()?);
    let gap = Gap {
        from: end.way.to,
        to: beginning.way.from,
        strokes: [end.stroke, beginning.stroke],
    };
    let middle = gap.from.lerp(gap.to, 0.5);
    let size = gap.size().to_mm();
    // What is nearer to the middle than the ends would lead back.
    let is_near = |point: Point2| point.distance(middle) <= size;
    let part = &mut parts[one];
    while part.len() > 1 && part.last().is_some_and(|piece| is_near(piece.way.from)) {
        part.pop();
    }
    part.last_mut()?.way.to = middle;
    let part = &mut parts[next];
    let leading = part.iter().take_while(|piece| is_near(piece.way.to)).count();
    part.drain(..leading.min(part.len() - 1));
    part.first_mut()?.way.from = middle;
    Some(gap)
}

/// A stroke as lines and arcs, without those that have no extent.
fn pieces(drawn: &Stroke, stroke: usize, map: Affine, left: &mut usize) -> Result<Ring, OutlineError> {
    let mut ways: Vec<Bow> = Vec::new();
    for shape in &drawn.shapes {
        let shape = shape.clone().mapped(map);
        let begin = ways.len();
        match &shape {
            Shape::Polyline(points) => {
                ways.extend(points.windows(2).map(|ends| Bow::line(ends[0], ends[1])));
            }
            Shape::Arc { from, to, sweep } => ways.extend(Bow::of_arc(*from, *to, *sweep)),
            Shape::Ellipse { .. } | Shape::Bezier(_) | Shape::Nurbs(_) => {
                ways.extend(fitted(&shape, stroke, *left)?);
            }
        }
        // Shapes of a stroke meet but for rounding.
        if let Some(end) = begin
            .checked_sub(1)
            .and_then(|last| ways.get(last))
            .map(|way| way.to)
            && let Some(first) = ways.get_mut(begin)
        {
            first.from = end;
        }
        *left = left
            .checked_sub(ways.len() - begin)
            .ok_or(OutlineError::TooManyPoints)?;
    }
    ways.retain(|way| way.from.distance(way.to) >= COINCIDENT);
    close_up(&mut ways);
    Ok(ways.into_iter().map(|way| LoopPiece { way, stroke }).collect())
}

/// Puts ends on each other again between which something was left out.
fn close_up(ways: &mut [Bow]) {
    for place in 1..ways.len() {
        ways[place].from = ways[place - 1].to;
    }
}

/// A curve as arcs.
fn fitted(shape: &Shape, stroke: usize, most: usize) -> Result<Vec<Bow>, OutlineError> {
    let curve = curve_of(shape, stroke)?;
    let mut points = vec![curve.start()];
    curve
        .flatten(Length::mm(FINE), &mut points)
        .map_err(|error| OutlineError::Curve { stroke, error })?;
    points.dedup_by(|next, last| last.distance(*next) < COINCIDENT);
    if points.len() > most {
        return Err(OutlineError::TooManyPoints);
    }
    Ok(if points.len() < 2 {
        Vec::new()
    } else {
        fit(&points, ROUND.to_mm() - FINE - SAME, FINE)
    })
}

#[cfg(test)]
mod tests;
