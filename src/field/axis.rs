//! The medial axis of a region: the centres of all circles in it that touch walls twice or more.

use crate::source::Segment;
use crate::touch::{Circle, Touched, circle};
use crate::wall::{Boundary, Shape, TooManyEdges, turn};
use vcutc_region::place::Place;
use vcutc_region::region::Region;

mod graph;

/// How an axis is brought into straight pieces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Detail {
    /// Branch points and ends, joined by one straight piece, or two where the axis is curved (Yang et al., section 2).
    Simplified,
    /// The axis itself, in pieces as short as the tolerance asks.
    True,
}

/// The reasons for which a region has no axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AxisError {
    /// The region has more edges than are taken.
    Edges(TooManyEdges),
    /// The tolerance is not a number above 0.
    Tolerance,
    /// The axis has more pieces or changes than this.
    TooManyPieces {
        /// The most.
        most: usize,
    },
}

/// The medial axis of a region, in straight pieces.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// The pieces.
    pub segments: Vec<Segment>,
    /// The end of a piece that is farthest from all walls, and its distance in mm; none without pieces.
    pub largest_circle: Option<(Place, f64)>,
}

/// Places that circles are grown from, all in all, at most.
const MOST_CIRCLES: usize = 1_000_000;

/// Pieces at most.
const MOST_PIECES: usize = 20_000;

/// Places on every wall and corner at the least, and at the most.
const LEAST_SAMPLES: usize = 32;
const MOST_SAMPLES: usize = 256;

/// Distance of places on a wall, in tolerances.
const SPACING: f64 = 25.0;

/// Shares of a wall nearer than this are the same place.
const SAME_SHARE: f64 = 1e-13;

/// Pieces shorter than this, in mm, are points.
const POINT: f64 = 1e-5;

/// Halvings of a piece at most.
const MOST_HALVINGS: u32 = 12;

/// The axis of a region. In pieces of [`Detail::True`] neither the axis nor the distance to the walls
/// is off its straight piece by more than the tolerance, in mm.
///
/// # Errors
/// Where the tolerance is unsound, or the work is more than is done.
pub fn axis(region: &Region, detail: Detail, tolerance: f64) -> Result<Axis, AxisError> {
    if !(tolerance > 0.0 && tolerance.is_finite()) {
        return Err(AxisError::Tolerance);
    }
    let boundary = Boundary::new(region).map_err(AxisError::Edges)?;
    let branches = branches(&boundary, tolerance)?;
    let segments: Vec<Segment> = match detail {
        Detail::True => branches
            .iter()
            .flat_map(|branch| branch.windows(2).filter_map(segment))
            .collect(),
        Detail::Simplified => graph::simplified(&branches, tolerance),
    };
    let ends = branches.iter().flatten();
    let largest = ends.max_by(|one, other| one.radius.total_cmp(&other.radius));
    Ok(Axis {
        segments,
        largest_circle: largest.map(|circle| (circle.centre, circle.radius)),
    })
}

fn segment(ends: &[Circle]) -> Option<Segment> {
    let [from, to] = ends else { return None };
    Some(Segment {
        from: from.centre,
        to: to.centre,
        from_radius: from.radius,
        to_radius: to.radius,
    })
}

/// A part of the axis between the same two walls or corners: its circles from end to end.
type Branch = Vec<Circle>;

/// A circle and the share of the wall at which it touches.
#[derive(Clone, Copy)]
struct Sample {
    t: f64,
    circle: Circle,
}

/// Neighbouring circles that touch the same wall.
type Run = Vec<Sample>;

/// A wall or corner from which circles grow.
struct View<'a> {
    boundary: &'a Boundary,
    own: usize,
    /// Circles that may still be grown.
    left: usize,
}

impl View<'_> {
    fn sample(&self, t: f64) -> Option<Sample> {
        let Self { boundary, own, .. } = *self;
        let (place, normal) = match boundary.walls.get(own) {
            Some(wall) => wall.at(t),
            None => {
                let corner = boundary.corners.get(own - boundary.walls.len())?;
                (corner.place, turn(corner.normal, t * corner.sweep))
            }
        };
        let circle = circle(boundary, own, place, normal)?;
        Some(Sample { t, circle })
    }

    /// How many places to begin with; none for corners that look into the region in one direction or none.
    fn count(&self, tolerance: f64) -> Option<usize> {
        let wanted = match self.boundary.walls.get(self.own) {
            Some(wall) => libm::ceil(wall.length() / (SPACING * tolerance)) as usize,
            None => {
                let corner = self.boundary.corners.get(self.own - self.boundary.walls.len())?;
                (corner.sweep != 0.0).then_some(LEAST_SAMPLES)?
            }
        };
        Some(wanted.clamp(LEAST_SAMPLES, MOST_SAMPLES))
    }

    /// The runs of circles that touch the same wall, from places evenly apart and from these.
    fn runs(&mut self, tolerance: f64, further: &[f64]) -> Result<Vec<Run>, AxisError> {
        let mut runs: Vec<Run> = Vec::new();
        let Some(count) = self.count(tolerance) else {
            return Ok(runs);
        };
        let even = (0..=count).map(|index| index as f64 / count as f64);
        let mut shares: Vec<f64> = even.chain(further.iter().copied()).collect();
        shares.sort_by(f64::total_cmp);
        let mut last: Option<Sample> = None;
        for t in shares {
            self.pay()?;
            let Some(sample) = self.sample(t) else {
                last = None;
                continue;
            };
            match last {
                Some(last) => self.go_on(last, sample, &mut runs)?,
                None => runs.push(vec![sample]),
            }
            last = Some(sample);
        }
        Ok(runs)
    }

    /// Continues the last run to a sample, by new runs where what is touched changes in between.
    fn go_on(&mut self, from: Sample, to: Sample, runs: &mut Vec<Run>) -> Result<(), AxisError> {
        let mut open = vec![to];
        let mut at = from;
        while let Some(&next) = open.last() {
            let is_same = at.circle.touched == next.circle.touched;
            if is_same || next.t - at.t < SAME_SHARE {
                match runs.last_mut() {
                    Some(run) if is_same => run.push(next),
                    _ => runs.push(vec![next]),
                }
                at = next;
                open.pop();
                continue;
            }
            self.pay()?;
            match self.sample(f64::midpoint(at.t, next.t)) {
                Some(middle) => open.push(middle),
                None => {
                    runs.push(vec![next]);
                    at = next;
                    open.pop();
                }
            }
        }
        Ok(())
    }

    /// The circles of a run, as many as the tolerance asks.
    fn refine(&mut self, run: &[Sample], tolerance: f64) -> Result<Branch, AxisError> {
        let (Some(&first), Some(&last)) = (run.first(), run.last()) else {
            return Ok(Branch::new());
        };
        let mut branch = vec![first.circle];
        let mut open = vec![(last, 0)];
        let mut at = first;
        while let Some((next, depth)) = open.pop() {
            self.pay()?;
            let middle = self.sample(f64::midpoint(at.t, next.t));
            let middle = middle.filter(|middle| {
                // A long run may swing back to its chord in the middle: the first halvings are not asked for.
                let is_bent = off_chord(&at.circle, &middle.circle, &next.circle) > tolerance;
                middle.circle.touched == first.circle.touched
                    && depth < MOST_HALVINGS
                    && (is_bent || (depth < 2 && may_bend(self.boundary, self.own, first.circle.touched)))
            });
            if let Some(middle) = middle {
                open.push((next, depth + 1));
                open.push((middle, depth + 1));
            } else {
                branch.push(next.circle);
                at = next;
            }
        }
        Ok(branch)
    }

    fn pay(&mut self) -> Result<(), AxisError> {
        let left = self.left.checked_sub(1);
        self.left = left.ok_or(AxisError::TooManyPieces { most: MOST_CIRCLES })?;
        Ok(())
    }
}

/// The parts of the axis, each once: from the wall or corner with the lower number.
fn branches(boundary: &Boundary, tolerance: f64) -> Result<Vec<Branch>, AxisError> {
    let owners = 0..boundary.walls.len() + boundary.corners.len();
    let mut left = MOST_CIRCLES;
    // Between places evenly apart a wall may be touched that none of them sees. It sees them.
    let mut further: Vec<Vec<f64>> = owners.clone().map(|_| Vec::new()).collect();
    for own in owners.clone() {
        let mut view = View { boundary, own, left };
        for run in view.runs(tolerance, &[])? {
            let seen = seen(boundary, &run).and_then(|(other, share)| Some((further.get_mut(other)?, share)));
            if let Some((further, share)) = seen {
                further.push(share);
            }
        }
        left = view.left;
    }
    let mut branches = Vec::new();
    let mut pieces = 0;
    for (own, further) in owners.zip(&further) {
        let mut view = View { boundary, own, left };
        for run in view.runs(tolerance, further)? {
            let touched = run.first().map(|sample| sample.circle.touched);
            if !matches!(touched, Some(Touched::Wall(other)) if own < other) {
                continue;
            }
            let branch = view.refine(&run, tolerance)?;
            let segments = branch.windows(2).filter_map(segment);
            if segments.map(|piece| piece.length()).sum::<f64>() > POINT {
                pieces += branch.len();
                branches.push(branch);
            }
        }
        left = view.left;
        if pieces > MOST_PIECES {
            return Err(AxisError::TooManyPieces { most: MOST_PIECES });
        }
    }
    Ok(branches)
}

/// The wall or corner that a run touches, and the share of it at which the middle of the run does.
fn seen(boundary: &Boundary, run: &[Sample]) -> Option<(usize, f64)> {
    let (first, last) = (run.first()?, run.last()?);
    let Touched::Wall(other) = first.circle.touched else {
        return None;
    };
    let middle = run.get(run.len() / 2).unwrap_or(first);
    let centre = if run.len() > 2 {
        middle.circle.centre
    } else {
        first.circle.centre.lerp(last.circle.centre, 0.5)
    };
    let share = match boundary.walls.get(other) {
        Some(wall) => wall.share(centre),
        None => boundary.corners.get(other - boundary.walls.len())?.share(centre),
    };
    (0.0..=1.0).contains(&share).then_some((other, share))
}

/// How far a circle between two others is off what is straight between them, in place or in radius.
fn off_chord(from: &Circle, middle: &Circle, to: &Circle) -> f64 {
    let way = to.centre.minus(from.centre);
    let length = way.length();
    if length < POINT {
        return middle.centre.distance(from.centre);
    }
    let gone = middle.centre.minus(from.centre);
    let share = (way.dot(gone) / (length * length)).clamp(0.0, 1.0);
    let radius = from.radius + (to.radius - from.radius) * share;
    let off = middle.centre.distance(from.centre.lerp(to.centre, share));
    off.max((middle.radius - radius).abs())
}

/// Whether the axis between two walls may be curved: not that of two lines, or of two corners.
fn may_bend(boundary: &Boundary, own: usize, touched: Touched) -> bool {
    let Touched::Wall(other) = touched else {
        return false;
    };
    let is_line = |number| matches!(boundary.walls.get(number), Some(Shape::Line { .. }));
    !(is_line(own) && is_line(other))
}

#[cfg(test)]
mod tests;
