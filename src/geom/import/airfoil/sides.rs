//! From a chain of points around or along an airfoil to its two sides.

use super::Point2;

/// A step in x of at least this share of the chord, against the steps before and after it, starts a new side.
const JUMP: f64 = 0.8;

/// Share of the chord that a side must cover.
const COVERED: f64 = 0.5;

/// The upper and the lower side as functions of x, or what is wrong in the user's words.
pub(super) fn sides(points: &[Point2]) -> Result<(Vec<Point2>, Vec<Point2>), String> {
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
    let upside_down =
        |side: Vec<Point2>| -> Vec<Point2> { side.into_iter().map(|p| Point2::new(p.x, -p.z)).collect() };
    let chord = end - start;
    let upper = checked(&upper, outer(&upper), chord, "upper")?;
    let lower = upside_down(lower);
    let lower = upside_down(checked(&lower, outer(&lower), chord, "lower")?);
    Ok((upper, lower))
}

/// Lowest and highest x.
fn reach(points: &[Point2]) -> (f64, f64) {
    points
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), p| {
            (low.min(p.x), high.max(p.x))
        })
}

/// The two sides, each from the leading edge to the trailing edge.
fn split(points: &[Point2], start: f64, end: f64) -> (Vec<Point2>, Vec<Point2>) {
    let (first, second) = if let Some(restart) = restart(points, JUMP * (end - start)) {
        (&points[..restart], &points[restart..])
    } else {
        // All around: the sides meet at the far end from where the chain starts. Points that are equally far belong
        // to both sides; of those each keeps the outermost.
        let starts_behind = points.first().is_some_and(|p| p.x > (start + end) / 2.0);
        let at_turn = |p: &Point2| if starts_behind { p.x <= start } else { p.x >= end };
        let first_turn = points.iter().position(at_turn).unwrap_or(0);
        let last_turn = points.iter().rposition(at_turn).unwrap_or(0);
        (&points[..=last_turn], &points[first_turn..])
    };
    (forward(first), forward(second))
}

/// Where a chain jumps back across the chord to start a new side.
fn restart(points: &[Point2], jump: f64) -> Option<usize> {
    points
        .windows(4)
        .position(|p| {
            let (before, step, after) = (p[1].x - p[0].x, p[2].x - p[1].x, p[3].x - p[2].x);
            step.abs() >= jump && before * step <= 0.0 && after * step <= 0.0
        })
        .map(|window| window + 2)
}

fn forward(side: &[Point2]) -> Vec<Point2> {
    let mut side = side.to_vec();
    if let (Some(first), Some(last)) = (side.first(), side.last())
        && first.x > last.x
    {
        side.reverse();
    }
    side
}

/// The mean height of a chain over x; of a chain without extent the height of its start.
fn mean_height(side: &[Point2]) -> f64 {
    let area: f64 = side
        .windows(2)
        .map(|p| (p[1].x - p[0].x) * (p[0].z + p[1].z) / 2.0)
        .sum();
    match (side.first(), side.last()) {
        (Some(first), Some(last)) if last.x > first.x => area / (last.x - first.x),
        (Some(first), _) => first.z,
        (None, _) => 0.0,
    }
}

/// A chain that runs right, but for a few steps back, as a function of x: the higher way where there are several.
fn outer(side: &[Point2]) -> Vec<Point2> {
    let mut out: Vec<Point2> = Vec::with_capacity(side.len());
    for &point in side {
        if is_below(&out, point) {
            continue;
        }
        while out.last().is_some_and(|last| last.x >= point.x) {
            out.pop();
        }
        out.push(point);
    }
    out
}

/// Whether a chain with increasing x passes over a point, or through it.
fn is_below(chain: &[Point2], point: Point2) -> bool {
    let right = chain.partition_point(|p| p.x < point.x);
    match (
        right.checked_sub(1).and_then(|left| chain.get(left)),
        chain.get(right),
    ) {
        (_, None) => false,
        // The chain's start: it covers only its own x.
        (None, Some(start)) => start.x <= point.x && start.z >= point.z,
        (Some(left), Some(right)) => {
            let share = (point.x - left.x) / (right.x - left.x);
            left.lerp(*right, share).z >= point.z
        }
    }
}

/// A side, if it is one: most of its points are used and it covers most of the chord.
fn checked(raw: &[Point2], side: Vec<Point2>, chord: f64, name: &str) -> Result<Vec<Point2>, String> {
    let (start, end) = reach(&side);
    if side.len() < 2 || end - start < COVERED * chord {
        return Err(format!(
            "these points have no {name} side: they must run from the trailing edge around the leading edge and \
             back, or along each side from the leading edge"
        ));
    }
    if side.len() * 2 < raw.len() {
        return Err(format!(
            "x runs back and forth along the {name} side; the points must follow each other around the airfoil"
        ));
    }
    Ok(side)
}
