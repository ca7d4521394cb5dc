//! How the blade passes the part on a piece of a chain, and how much of its edge is in the work.
//!
//! A straight blade is a triangle from the tip up to the end of its edges, as thick as it is; a round one the ring of its edge and
//! that of what lies above it. A piece of a chain is proven span
//! by span ([`crate::course`]): seen along y, what the blade covers on a span lies above the lower edge of the convex hull of
//! its corners at both ends of the chord, each moved as far as it may be off. A span that this edge does not clear is halved.
//!
//! A chain takes nothing out of the section: its slit is as narrow as the blade, and what comes free between slits is known to
//! the operation that makes them alone.

#[cfg(test)]
mod tests;

use crate::course::{Course, Span, Stretch};
use crate::surface::Surface;
use vcutc_backend_api::geometry::Orientation;
use vcutc_backend_api::ir::{Blade, Stock, Straight};
use vcutc_geometry::curve::Point2;

/// An entry of less than this may not be found, and the edge in use is known but for this, in mm.
const RESOLUTION: f64 = 0.01;

/// Spans are halved no more often than this.
const MOST_HALVINGS: u32 = 20;

/// Edges that rise by less than this are taken never to leave the work.
const LEAST_RISE: f64 = 0.05;

/// A blade on a piece of a chain.
pub(super) struct Piece {
    course: Course,
    /// The corners of the blade, seen in T, in mm.
    corners: Vec<[f64; 3]>,
    /// Of a straight blade; of others the edge goes all round.
    straight: Option<Straight>,
    stock: Stock,
}

/// The deepest place in the part, and how deep it is along z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Entry {
    pub(super) at: Point2,
    pub(super) depth: f64,
}

/// The lower edge of what the blade covers on a span, from left to right, and from where to where that reaches along y.
struct Lower {
    edge: Vec<Point2>,
    y: [f64; 2],
}

impl Piece {
    pub(super) fn new(course: Course, blade: &Blade, stock: Stock) -> Self {
        let straight = blade.straight();
        let half = straight.map_or(0.0, |straight| straight.thickness.to_mm() / 2.0);
        let sides: &[f64] = if half > 0.0 { &[1.0, -1.0] } else { &[0.0] };
        let hull = blade.hull();
        let on_side = |side: &f64| {
            let aside = side * half;
            hull.iter().map(move |&[x, y, z]| [x, y + aside, z])
        };
        Self {
            course,
            corners: sides.iter().flat_map(on_side).collect(),
            straight,
            stock,
        }
    }

    /// The deepest entry into the part, but for [`RESOLUTION`].
    pub(super) fn entry(&self, part: &[Point2]) -> Option<Entry> {
        let mut deepest: Option<Entry> = None;
        let mut open = vec![(Span::WHOLE, MOST_HALVINGS)];
        while let Some((span, halvings)) = open.pop() {
            let known = deepest.map_or(super::OVERCUT, |entry| entry.depth);
            let Some(bound) = self.depth(&self.course.stretch(span), part) else {
                continue;
            };
            if bound.depth <= known {
                continue;
            }
            let there = self.depth(&self.course.middle(span), part);
            let found = there.map_or(f64::NEG_INFINITY, |entry| entry.depth);
            if found > known {
                deepest = there;
            }
            if bound.depth - found > RESOLUTION && halvings > 0 {
                open.extend(span.halves().map(|half| (half, halvings - 1)));
            }
        }
        deepest
    }

    /// How deep at most the blade gets into the part on a stretch; none where it is not over the part.
    fn depth(&self, stretch: &Stretch, part: &[Point2]) -> Option<Entry> {
        let lower = self.lower(stretch);
        if !self.is_over_stock(&lower) {
            return None;
        }
        let (at, gap) = lowest_over(&lower.edge, part)?;
        Some(Entry { at, depth: -gap })
    }

    /// How much edge of a straight blade is in the work at most, in mm; infinite where an edge does not rise out of it, and none of
    /// other blades. The section is taken to be as high as it is anywhere over the blade.
    pub(super) fn edge_used(&self, surface: &mut Surface) -> Option<f64> {
        let straight = self.straight?;
        let mut used = 0.0_f64;
        let mut open = vec![(Span::WHOLE, MOST_HALVINGS)];
        while let Some((span, halvings)) = open.pop() {
            let bound = self.edge_on(straight, &self.course.stretch(span), surface);
            if bound <= used {
                continue;
            }
            let there = self.edge_on(straight, &self.course.middle(span), surface);
            if bound - there > RESOLUTION && halvings > 0 {
                used = used.max(there);
                open.extend(span.halves().map(|half| (half, halvings - 1)));
            } else {
                used = bound;
            }
        }
        Some(used)
    }

    fn edge_on(&self, straight: Straight, stretch: &Stretch, surface: &mut Surface) -> f64 {
        let lower = self.lower(stretch);
        let ([Some(first), Some(last)], true) = (
            [lower.edge.first(), lower.edge.last()],
            self.is_over_stock(&lower),
        ) else {
            return 0.0;
        };
        let section = surface.stretch(first.x, last.x).map(|corner| corner.z);
        let top = section.fold(f64::NEG_INFINITY, f64::max);
        let tip = stretch.way.lowest() - stretch.room([0.0; 3])[2];
        if top <= tip {
            return 0.0;
        }
        let rises = straight.edge_ends().map(|edge| {
            let end = seen_in_work(stretch.held, edge);
            (end[2] - stretch.turned_room(end)[2]) / straight.cutting_length.to_mm()
        });
        match rises.into_iter().fold(f64::INFINITY, f64::min) {
            rise if rise > LEAST_RISE => (top - tip) / rise,
            _ => f64::INFINITY,
        }
    }

    /// Whether any of it may be over the stock.
    fn is_over_stock(&self, lower: &Lower) -> bool {
        let [near, far] = lower.y;
        let ends = lower.edge.first().zip(lower.edge.last());
        let beside = ends.is_none_or(|(first, last)| last.x < 0.0 || first.x > self.stock.width.to_mm());
        !beside && far >= 0.0 && near <= self.stock.depth.to_mm()
    }

    fn lower(&self, stretch: &Stretch) -> Lower {
        let mut corners = Vec::with_capacity(4 * self.corners.len());
        let mut reach = [f64::INFINITY, f64::NEG_INFINITY];
        for &corner in &self.corners {
            let corner = seen_in_work(stretch.held, corner);
            let [dx, dy, dz] = stretch.room(corner);
            for tip in [stretch.way.from, stretch.way.to] {
                let [x, y, z] = [tip.x + corner[0], tip.y + corner[1], tip.z + corner[2]];
                let [near, far] = reach;
                reach = [near.min(y - dy), far.max(y + dy)];
                corners.extend([Point2::new(x - dx, z - dz), Point2::new(x + dx, z - dz)]);
            }
        }
        Lower {
            edge: lower_hull(corners),
            y: reach,
        }
    }
}

/// A vector of T as W sees it.
fn seen_in_work(held: Orientation, vector: [f64; 3]) -> [f64; 3] {
    held.matrix()
        .map(|row| row.iter().zip(vector).map(|(part, along)| part * along).sum())
}

/// The lower edge of the convex hull of some points, from left to right.
fn lower_hull(mut points: Vec<Point2>) -> Vec<Point2> {
    points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.z.total_cmp(&b.z)));
    let mut hull: Vec<Point2> = Vec::with_capacity(points.len());
    for point in points {
        while let [.., before, last] = hull.as_slice()
            && (last.x - before.x) * (point.z - before.z) <= (last.z - before.z) * (point.x - before.x)
        {
            hull.pop();
        }
        // Of points at one x the lowest comes first.
        if hull.last().is_none_or(|last| last.x < point.x) {
            hull.push(point);
        }
    }
    hull
}

/// Where one polyline is the least above another, and how far (negative: below); none where it is beside it. Both are straight
/// between their corners.
fn lowest_over(upper: &[Point2], line: &[Point2]) -> Option<(Point2, f64)> {
    let (left, right) = (upper.first()?.x, upper.last()?.x);
    let own = upper
        .iter()
        .filter_map(|&corner| Some((corner, corner.z - height(line, corner.x)?)));
    let begin = line.partition_point(|corner| corner.x < left);
    let over = line.iter().skip(begin).take_while(|corner| corner.x <= right);
    let theirs = over.filter_map(|corner| {
        let z = height(upper, corner.x)?;
        Some((Point2::new(corner.x, z), z - corner.z))
    });
    own.chain(theirs).min_by(|(_, a), (_, b)| a.total_cmp(b))
}

/// Height of a polyline at x; none beside it.
fn height(line: &[Point2], x: f64) -> Option<f64> {
    let next = line.partition_point(|corner| corner.x < x);
    let to = line.get(next)?;
    if to.x == x {
        return Some(to.z);
    }
    let from = line.get(next.checked_sub(1)?)?;
    Some(from.z + (to.z - from.z) * (x - from.x) / (to.x - from.x))
}
