//! From a chain of points around or along an airfoil to its two sides.

use super::{NOISE, Vertex};
use crate::point::Point2;

/// A step in x of at least this share of the chord, against the steps before and after it, starts a new side.
const JUMP: f64 = 0.8;

/// Share of the chord that a side must cover.
const COVERED: f64 = 0.5;

/// The two sides of an airfoil, and the x from which to which it reaches.
pub(super) struct Pair {
    pub(super) upper: Outline,
    pub(super) lower: Outline,
    pub(super) start: f64,
    pub(super) end: f64,
}

impl Pair {
    /// The point farthest to the front.
    pub(super) fn leading(&self) -> Option<Vertex> {
        let first = |outline: &Outline| outline.points.first().copied();
        let both = [first(&self.upper), first(&self.lower)];
        both.into_iter()
            .flatten()
            .min_by(|one, other| one.at.x.total_cmp(&other.at.x))
    }
}

/// A side, and what lies under it.
pub(super) struct Outline {
    /// With strictly increasing x.
    pub(super) points: Vec<Vertex>,
    /// Points that are left out because the side passes over them.
    pub(super) inside: Vec<Inside>,
}

/// A point inside of the outline.
pub(super) struct Inside {
    pub(super) row: usize,
    /// How deep it lies, in the unit of the file.
    pub(super) deep: f64,
}

/// The upper and the lower side as functions of x, or what is wrong in the user's words.
pub(super) fn sides(points: &[Vertex]) -> Result<Pair, String> {
    if points.len() < 4 {
        return Err(format!(
            "an airfoil takes two points or more for each side, {} found here",
            match points.len() {
                0 => "no point is".to_owned(),
                1 => "1 point is".to_owned(),
                n => format!("{n} points are"),
            }
        ));
    }
    let (start, end) = reach(points);
    let (first, second) = split(points, start, end);
    let (upper, lower) = if mean_height(&first) >= mean_height(&second) {
        (first, second)
    } else {
        (second, first)
    };
    let chord = end - start;
    let upper = checked(&upper, outer(&upper), chord, "upper")?;
    let lower = upside_down(lower);
    let mut lower = checked(&lower, outer(&lower), chord, "lower")?;
    lower.points = upside_down(lower.points);
    Ok(Pair {
        upper,
        lower,
        start,
        end,
    })
}

fn upside_down(side: Vec<Vertex>) -> Vec<Vertex> {
    let turned = |vertex: Vertex| Vertex {
        at: Point2::new(vertex.at.x, -vertex.at.z),
        ..vertex
    };
    side.into_iter().map(turned).collect()
}

/// Lowest and highest x.
pub(super) fn reach(points: &[Vertex]) -> (f64, f64) {
    points
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), vertex| {
            (low.min(vertex.at.x), high.max(vertex.at.x))
        })
}

/// The two sides, each from the leading edge to the trailing edge.
fn split(points: &[Vertex], start: f64, end: f64) -> (Vec<Vertex>, Vec<Vertex>) {
    let (first, second) = if let Some(restart) = restart(points, JUMP * (end - start)) {
        (&points[..restart], &points[restart..])
    } else {
        // All around: the sides meet at the far end from where the chain starts. Points that are equally far belong
        // to both sides; of those each keeps the outermost.
        let starts_behind = points.first().is_some_and(|p| p.at.x > (start + end) / 2.0);
        let at_turn = |p: &Vertex| {
            if starts_behind {
                p.at.x <= start
            } else {
                p.at.x >= end
            }
        };
        let first_turn = points.iter().position(at_turn).unwrap_or(0);
        let last_turn = points.iter().rposition(at_turn).unwrap_or(0);
        (&points[..=last_turn], &points[first_turn..])
    };
    (forward(first), forward(second))
}

/// Where a chain jumps back across the chord to start a new side.
fn restart(points: &[Vertex], jump: f64) -> Option<usize> {
    points
        .windows(4)
        .position(|p| {
            let step = |from: usize| p[from + 1].at.x - p[from].at.x;
            let (before, step, after) = (step(0), step(1), step(2));
            step.abs() >= jump && before * step <= 0.0 && after * step <= 0.0
        })
        .map(|window| window + 2)
}

fn forward(side: &[Vertex]) -> Vec<Vertex> {
    let mut side = side.to_vec();
    if let (Some(first), Some(last)) = (side.first(), side.last())
        && first.at.x > last.at.x
    {
        side.reverse();
    }
    side
}

/// The mean height of a chain over x; of a chain without extent the height of its start.
fn mean_height(side: &[Vertex]) -> f64 {
    let area: f64 = side
        .windows(2)
        .map(|p| (p[1].at.x - p[0].at.x) * (p[0].at.z + p[1].at.z) / 2.0)
        .sum();
    match (side.first(), side.last()) {
        (Some(first), Some(last)) if last.at.x > first.at.x => area / (last.at.x - first.at.x),
        (Some(first), _) => first.at.z,
        (None, _) => 0.0,
    }
}

/// A chain that runs right, but for a few steps back, as a function of x: the higher way where there are several.
fn outer(side: &[Vertex]) -> Outline {
    let mut out: Vec<Vertex> = Vec::with_capacity(side.len());
    let mut left: Vec<Vertex> = Vec::new();
    for &vertex in side {
        if is_below(&out, vertex.at) {
            left.push(vertex);
            continue;
        }
        while let Some(last) = out.pop_if(|last| last.at.x >= vertex.at.x) {
            left.push(last);
        }
        out.push(vertex);
    }
    let inside = left.iter().filter_map(|vertex| inside(&out, *vertex)).collect();
    Outline { points: out, inside }
}

/// A point that was left out, if it lies inside of the outline, and not on it or on the straight wall at one of its ends.
fn inside(chain: &[Vertex], vertex: Vertex) -> Option<Inside> {
    let (first, last) = (chain.first()?.at, chain.last()?.at);
    let noise = NOISE * (last.x - first.x);
    if vertex.at.x <= first.x + noise || vertex.at.x >= last.x - noise {
        return None;
    }
    let deep = height(chain, vertex.at.x)? - vertex.at.z;
    (deep > noise).then_some(Inside {
        row: vertex.row,
        deep,
    })
}

/// The height of a chain with increasing x; none beside it.
pub(super) fn height(chain: &[Vertex], x: f64) -> Option<f64> {
    let right = chain.partition_point(|vertex| vertex.at.x < x);
    let next = chain.get(right)?.at;
    if next.x <= x {
        return Some(next.z);
    }
    let before = chain.get(right.checked_sub(1)?)?.at;
    Some(before.lerp(next, (x - before.x) / (next.x - before.x)).z)
}

/// Whether a chain with increasing x passes over a point, or through it.
fn is_below(chain: &[Vertex], point: Point2) -> bool {
    height(chain, point.x).is_some_and(|over| over >= point.z)
}

/// A side, if it is one: most of its points are used and it covers most of the chord.
fn checked(raw: &[Vertex], side: Outline, chord: f64, name: &str) -> Result<Outline, String> {
    let (start, end) = reach(&side.points);
    if side.points.len() < 2 || end - start < COVERED * chord {
        return Err(format!(
            "these points have no {name} side: they must run from the trailing edge around the leading edge and \
             back, or along each side from the leading edge"
        ));
    }
    if side.points.len() * 2 < raw.len() {
        return Err(format!(
            "x runs back and forth along the {name} side; the points must follow each other around the airfoil"
        ));
    }
    Ok(side)
}
