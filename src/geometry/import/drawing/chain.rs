//! From strokes to one chain: scaled to the workpiece, flattened, joined end to end.
//!
//! Every stroke is flattened within the tolerance of curves ([`crate::curve`]) after scaling, so that the bound
//! holds in the workpiece. Where two ends are joined over a gap both go to its middle: there the chain is off the drawing
//! by at most the gap.

use super::fault::{Chain, Gap, OutlineError};
use super::join::SAME;
use super::lines::Line;
use super::route::{Joined, Route};
use super::{Affine, Stroke};
use crate::curve::COINCIDENT;
use crate::point::Point2;
use vcutc_backend_api::units::Length;

/// A chain that is everything drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct Outline {
    /// Its corners in the workpiece; of a closed one the last is the first.
    pub points: Vec<Point2>,
    /// For each point the stroke that leads to it, as a place in the list of strokes.
    pub owners: Vec<usize>,
    /// Whether it ends where it begins.
    pub is_closed: bool,
    /// The widest gap over which ends were joined; none when all ends coincide.
    pub widest: Option<Gap>,
    /// Strokes that lie on others from end to end, and count once.
    pub repeated: Vec<usize>,
}

/// The one chain that strokes form, after a map from the drawing to the workpiece. Curves are flattened within `flat`, and
/// ends joined that are no farther apart than `tolerance`.
///
/// # Errors
/// See [`OutlineError`].
pub fn outline(
    strokes: &[Stroke],
    map: Affine,
    flat: Length,
    tolerance: Length,
) -> Result<Outline, OutlineError> {
    let joined = Joined::of(strokes, map, flat, tolerance)?;
    let mut chains: Vec<Walked> = joined
        .routes
        .iter()
        .map(|route| Walked::along(route, &joined.lines))
        .collect();
    match chains.len() {
        0 => Err(OutlineError::Nothing),
        1 => Ok(chains.swap_remove(0).finish(joined.repeated)),
        _ => Err(several(&chains)),
    }
}

/// A chain while it grows.
#[derive(Default)]
pub(super) struct Walked {
    points: Vec<Point2>,
    owners: Vec<usize>,
    strokes: usize,
    is_closed: bool,
    widest: Option<Gap>,
}

impl Walked {
    /// The chain of a route along lines.
    pub(super) fn along(route: &Route, lines: &[Line]) -> Self {
        let mut chain = Self::default();
        for &entry in &route.entries {
            chain.add(&lines[entry / 2], entry);
        }
        if route.is_closed {
            chain.close();
        }
        chain
    }

    /// Adds a line from one of its ends (even: its first point) to the other.
    fn add(&mut self, line: &Line, end: usize) {
        let mut next = line.points.clone();
        if end % 2 == 1 {
            next.reverse();
        }
        self.strokes += 1;
        let mut leading = 0;
        if let (Some(&last), Some(&first)) = (self.points.last(), next.first()) {
            let size = last.distance(first);
            self.note(last, first, line.stroke);
            let middle = last.lerp(first, 0.5);
            // What is nearer to the middle than the ends would lead back.
            let near = |point: &Point2| point.distance(middle) <= size;
            let owner = self.owners.last().copied().unwrap_or(line.stroke);
            while self.points.len() > 1 && self.points.last().is_some_and(near) {
                self.points.pop();
            }
            self.owners.truncate(self.points.len());
            self.push(middle, owner);
            let inner = next.len() - 1;
            leading = 1 + next[1..inner].iter().take_while(|point| near(point)).count();
        }
        for &point in &next[leading..] {
            self.push(point, line.stroke);
        }
    }

    /// Joins the last point to the first.
    fn close(&mut self) {
        self.is_closed = true;
        let (Some(&last), Some(&first)) = (self.points.last(), self.points.first()) else {
            return;
        };
        self.note(last, first, self.owners.first().copied().unwrap_or(0));
        let middle = last.lerp(first, 0.5);
        // As between two lines: what is nearer to the middle than the ends would lead back.
        let size = last.distance(first);
        let end = self.points.len().saturating_sub(1);
        let inner = self.points.get(1..end).unwrap_or_default();
        let near = |point: &&Point2| point.distance(middle) <= size;
        let leading = inner.iter().take_while(near).count();
        let ending = inner.iter().skip(leading).rev().take_while(near).count();
        self.points.drain(end - ending..end);
        self.points.drain(1..=leading);
        self.owners.drain(end - ending..end);
        self.owners.drain(1..=leading);
        if let Some(place) = self.points.first_mut() {
            *place = middle;
        }
        if let Some(place) = self.points.last_mut() {
            *place = middle;
        }
    }

    /// Remembers the widest gap.
    fn note(&mut self, from: Point2, to: Point2, stroke: usize) {
        let gap = Gap {
            from,
            to,
            strokes: [self.owners.last().copied().unwrap_or(stroke), stroke],
        };
        let widest = self.widest.map_or(SAME, |widest| widest.size().to_mm());
        if gap.size().to_mm() > widest {
            self.widest = Some(gap);
        }
    }

    fn push(&mut self, point: Point2, owner: usize) {
        self.points.push(point);
        self.owners.push(owner);
    }

    /// Drops corners that are where the one before is; the last one stays where it is.
    fn drop_coinciding(&mut self) {
        let drawn = core::mem::take(&mut self.points);
        let owners = core::mem::take(&mut self.owners);
        let count = drawn.len();
        for (place, (point, owner)) in drawn.into_iter().zip(owners).enumerate() {
            match self.points.last_mut() {
                Some(last) if last.distance(point) >= COINCIDENT => self.push(point, owner),
                Some(last) if place + 1 == count && place > 1 => *last = point,
                Some(_) => {}
                None => self.push(point, owner),
            }
        }
    }

    fn finish(mut self, repeated: Vec<usize>) -> Outline {
        self.drop_coinciding();
        let leads_left = match (self.points.first(), self.points.last()) {
            (Some(first), Some(last)) => last.x < first.x,
            _ => false,
        };
        if leads_left {
            reverse(&mut self.points, &mut self.owners);
        }
        Outline {
            points: self.points,
            owners: self.owners,
            is_closed: self.is_closed,
            widest: self.widest,
            repeated,
        }
    }
}

/// Turns a chain round. An owner leads to its point, so it goes to the point on the other end of its line.
pub(super) fn reverse(points: &mut [Point2], owners: &mut [usize]) {
    points.reverse();
    owners.reverse();
    owners.rotate_right(1);
    if let [first, second, ..] = owners {
        *first = *second;
    }
}

fn several(chains: &[Walked]) -> OutlineError {
    OutlineError::Several {
        chains: listed(chains),
        nearest: nearest(chains),
    }
}

/// Chains by their ends.
pub(super) fn listed(chains: &[Walked]) -> Vec<Chain> {
    let ends = chains.iter().filter_map(|chain| {
        Some(Chain {
            from: *chain.points.first()?,
            to: *chain.points.last()?,
            is_closed: chain.is_closed,
            first: *chain.owners.first()?,
            last: *chain.owners.last()?,
            strokes: chain.strokes,
        })
    });
    ends.collect()
}

/// Most chains among which the nearest ends are looked for; more of them are not an outline that was left
/// open.
const MOST_COMPARED: usize = 200;

/// The two nearest ends of different open chains.
pub(super) fn nearest(chains: &[Walked]) -> Option<Gap> {
    let open = chains.iter().filter(|chain| !chain.is_closed).take(MOST_COMPARED);
    let ends: Vec<[(Point2, usize); 2]> = open
        .filter_map(|chain| {
            let first = (*chain.points.first()?, *chain.owners.first()?);
            Some([first, (*chain.points.last()?, *chain.owners.last()?)])
        })
        .collect();
    let mut best: Option<Gap> = None;
    for (place, one) in ends.iter().enumerate() {
        for other in ends.iter().skip(place + 1) {
            for (from, to) in one.iter().flat_map(|a| other.iter().map(move |b| (a, b))) {
                let gap = Gap {
                    from: from.0,
                    to: to.0,
                    strokes: [from.1, to.1],
                };
                if best.is_none_or(|best| gap.size() < best.size()) {
                    best = Some(gap);
                }
            }
        }
    }
    best
}
