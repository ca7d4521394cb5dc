//! The routes along flattened strokes that joined ends make.

use super::fault::OutlineError;
use super::join::{End, JoinError, SAME, join};
use super::lines::{Line, flatten};
use super::repeats::without_repeats;
use super::{Affine, Stroke};
use vcutc_backend_api::units::Length;

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

fn in_strokes(error: JoinError, stroke: &dyn Fn(usize) -> usize) -> OutlineError {
    match error {
        JoinError::Branch { at, lines } => OutlineError::Branch {
            at,
            strokes: lines.into_iter().map(stroke).collect(),
        },
        JoinError::Crowded { at } => OutlineError::Crowded { at },
    }
}
