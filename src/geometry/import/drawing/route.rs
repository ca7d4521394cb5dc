//! Strokes as flattened lines, and the routes along them that joined ends make.

use super::chain::OutlineError;
use super::join::{End, JoinError, SAME, join};
use super::repeats::without_repeats;
use super::shape::{Shape, ShapeError};
use super::{Affine, Stroke};
use crate::curve::{COINCIDENT, Curve, MOST_POINTS};
use crate::point::Point2;
use vcutc_backend_api::units::Length;

/// A flattened stroke.
pub(super) struct Line {
    pub(super) stroke: usize,
    pub(super) points: Vec<Point2>,
}

impl Line {
    fn ends(&self) -> Option<[Point2; 2]> {
        Some([*self.points.first()?, *self.points.last()?])
    }

    pub(super) fn is_closed(&self) -> bool {
        self.points.len() > 2 && self.ends().is_some_and(|[from, to]| from.distance(to) <= SAME)
    }

    /// Whether it is longer than so much.
    fn is_longer_than(&self, length: f64) -> bool {
        let mut so_far = 0.0;
        self.points.windows(2).any(|pair| {
            so_far += pair[0].distance(pair[1]);
            so_far > length
        })
    }
}

/// Lines from end to end.
pub(super) struct Route {
    /// The ends at which lines are entered, in turn: twice the place of the line, and one more where it is entered at its last
    /// point.
    pub(super) entries: Vec<usize>,
    /// Whether the last line leads to the first.
    pub(super) is_closed: bool,
}

/// What strokes come to once their ends are joined.
pub(super) struct Joined {
    /// Strokes, flattened, without those that count once.
    pub(super) lines: Vec<Line>,
    /// Each line is on one of them. They come in the order in which their first strokes are drawn.
    pub(super) routes: Vec<Route>,
    /// Strokes that lie on others from end to end.
    pub(super) repeated: Vec<usize>,
}

impl Joined {
    /// Flattens strokes within `flat` and joins ends that are no farther apart than `tolerance`.
    pub(super) fn of(
        strokes: &[Stroke],
        map: Affine,
        flat: Length,
        tolerance: Length,
    ) -> Result<Self, OutlineError> {
        let tolerance = tolerance.to_mm().max(SAME);
        let lines = flatten(strokes, map, flat)?;
        let (lines, repeated) = without_repeats(lines);
        let open: Vec<usize> = (0..lines.len())
            .filter(|&line| !lines[line].is_closed())
            .collect();
        let ends: Vec<End> = open
            .iter()
            .enumerate()
            .flat_map(|(line, &drawn)| {
                let ends = lines[drawn].ends().into_iter().flatten();
                ends.map(move |at| End { line, at })
            })
            .collect();
        let may_close = |line: usize| lines[open[line]].is_longer_than(10.0 * tolerance);
        let drawn = |line: usize| lines[open[line]].stroke;
        let partners = join(&ends, tolerance, &may_close).map_err(|error| in_strokes(error, &drawn))?;
        let mut routes = walk(&open, &partners);
        let closed = (0..lines.len()).filter(|&line| lines[line].is_closed());
        routes.extend(closed.map(|line| Route {
            entries: vec![2 * line],
            is_closed: true,
        }));
        routes.sort_by_key(|route| route.entries.first().map(|entry| lines[entry / 2].stroke));
        Ok(Self {
            lines,
            routes,
            repeated,
        })
    }
}

/// The routes along joined lines: first those with loose ends, then the rings.
fn walk(open: &[usize], partners: &[Option<usize>]) -> Vec<Route> {
    let mut is_done = vec![false; open.len()];
    let loose = (0..partners.len()).filter(|&end| partners[end].is_none());
    let starts: Vec<usize> = loose.chain((0..open.len()).map(|line| 2 * line)).collect();
    let mut routes = Vec::new();
    for start in starts {
        let mut route = Route {
            entries: Vec::new(),
            is_closed: false,
        };
        let mut end = start;
        while !is_done[end / 2] {
            is_done[end / 2] = true;
            route.entries.push(2 * open[end / 2] + end % 2);
            match partners[end ^ 1] {
                Some(next) if next == start => route.is_closed = true,
                Some(next) => end = next,
                None => {}
            }
        }
        if !route.entries.is_empty() {
            routes.push(route);
        }
    }
    routes
}

/// Strokes as lines; those without extent are left out.
pub(super) fn flatten(strokes: &[Stroke], map: Affine, flat: Length) -> Result<Vec<Line>, OutlineError> {
    let mut lines = Vec::new();
    let mut left = MOST_POINTS;
    for (stroke, drawn) in strokes.iter().enumerate() {
        let mut points: Vec<Point2> = Vec::new();
        for shape in &drawn.shapes {
            let curve = curve_of(&shape.clone().mapped(map), stroke)?;
            if points.is_empty() {
                points.push(curve.start());
            }
            curve
                .flatten(flat, &mut points)
                .map_err(|error| OutlineError::Curve { stroke, error })?;
        }
        left = left
            .checked_sub(points.len())
            .ok_or(OutlineError::TooManyPoints)?;
        points.dedup_by(|next, last| last.distance(*next) < COINCIDENT);
        if points.len() > 1 {
            lines.push(Line { stroke, points });
        }
    }
    Ok(lines)
}

/// A shape of a stroke as a curve.
pub(super) fn curve_of(shape: &Shape, stroke: usize) -> Result<Curve, OutlineError> {
    shape.curve().map_err(|error| match error {
        ShapeError::Curve(error) => OutlineError::Curve { stroke, error },
        ShapeError::Nurbs(error) => OutlineError::Nurbs { stroke, error },
    })
}

fn in_strokes(error: JoinError, stroke: &dyn Fn(usize) -> usize) -> OutlineError {
    match error {
        JoinError::Branch { at, lines } => OutlineError::Branch {
            at,
            strokes: lines.into_iter().map(stroke).collect(),
        },
        JoinError::Crowded { at } => OutlineError::Crowded { at },
    }
}
