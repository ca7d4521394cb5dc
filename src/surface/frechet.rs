//! Whether two polylines stay near each other when both are walked from start to end.
//!
//! Their Fréchet distance is the least leash between two walkers, one on each, who may wait but never turn back (Alt and
//! Godau: Computing the Fréchet distance between two polygonal curves, 1995). For a given distance the pairs of places
//! that are near enough form the free space; within a cell, which is a segment of each polyline, it is convex. So it
//! suffices to keep which part of each side of a cell can be reached, and to go from cell to cell. Only cells that can be
//! reached are looked at: of polylines that are near each other, about as many as there are segments.

use crate::mesh::difference;
use core::ops::ControlFlow;
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::vector::dot;

/// What is known of two polylines.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Nearness {
    /// Both can be walked within the distance of each other.
    Near,
    /// They cannot.
    Apart,
    /// More cells can be reached than were to be looked at.
    Unknown,
}

/// A part of a side of a cell, from 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Part {
    low: f64,
    high: f64,
}

impl Part {
    /// What of it lies at a place or beyond.
    fn from(self, low: f64) -> Option<Self> {
        let low = self.low.max(low);
        (low <= self.high).then_some(Self { low, ..self })
    }

    const fn begins(self) -> bool {
        self.low <= 0.0
    }

    const fn ends(self) -> bool {
        self.high >= 1.0
    }
}

/// Whether two polylines of two points or more lie within a distance of each other all the way. Takes the cells that it looks
/// at from those that are left.
pub(crate) fn nearness(
    first: &[Point3],
    second: &[Point3],
    distance: f64,
    cells_left: &mut usize,
) -> Nearness {
    let (Some(&start), Some(&end)) = (first.first(), first.last()) else {
        return Nearness::Apart;
    };
    let ends = second.first().zip(second.last());
    let are_ends_near = ends.is_some_and(|(other_start, other_end)| {
        start.distance(*other_start).to_mm() <= distance && end.distance(*other_end).to_mm() <= distance
    });
    if first.len() < 2 || second.len() < 2 || !are_ends_near {
        return Nearness::Apart;
    }
    let mut walk = Walk {
        second,
        distance,
        cells_left,
        left: Vec::new(),
        right: Vec::new(),
    };
    walk.begin(start);
    let mut bottom = Some(());
    for pair in first.windows(2) {
        let below = bottom
            .and_then(|()| walk.free_along([pair[0], pair[1]], 0))
            .filter(|part| part.begins());
        if walk.column([pair[0], pair[1]], below).is_break() {
            return Nearness::Unknown;
        }
        if walk.right.is_empty() {
            return Nearness::Apart;
        }
        bottom = below.filter(|part| part.ends()).map(|_| ());
        core::mem::swap(&mut walk.left, &mut walk.right);
    }
    let is_reached = walk
        .left
        .last()
        .is_some_and(|(row, part)| row + 2 == second.len() && part.ends());
    if is_reached {
        Nearness::Near
    } else {
        Nearness::Apart
    }
}

/// On the way along the first polyline.
struct Walk<'a> {
    second: &'a [Point3],
    distance: f64,
    cells_left: &'a mut usize,
    /// What can be reached at the point that the first polyline has come to: parts of segments of the second one, in order.
    left: Vec<(usize, Part)>,
    /// The same at the next point.
    right: Vec<(usize, Part)>,
}

impl Walk<'_> {
    /// What can be reached from the start without a step along the first polyline.
    fn begin(&mut self, start: Point3) {
        for row in 0..self.second.len() - 1 {
            let part = self.free_beside(start, row).filter(|part| part.begins());
            self.left.extend(part.map(|part| (row, part)));
            if part.is_none_or(|part| !part.ends()) {
                break;
            }
        }
    }

    /// Goes through the cells over a segment of the first polyline; `below` is what can be reached of it at the start of
    /// the second one.
    fn column(&mut self, segment: [Point3; 2], below: Option<Part>) -> ControlFlow<()> {
        self.right.clear();
        let mut bottom = below;
        let mut known = 0;
        let mut row = 0;
        while row + 1 < self.second.len() {
            let next = self.left.get(known).copied();
            let left = match next {
                Some((at, part)) if at == row => {
                    known += 1;
                    Some(part)
                }
                Some((at, _)) if bottom.is_none() => {
                    row = at;
                    continue;
                }
                None if bottom.is_none() => break,
                Some(_) | None => None,
            };
            match self.cells_left.checked_sub(1) {
                Some(cells) => *self.cells_left = cells,
                None => return ControlFlow::Break(()),
            }
            let (right, top) = (
                self.free_beside(segment[1], row),
                self.free_along(segment, row + 1),
            );
            let right = match (bottom, left) {
                (Some(_), _) => right,
                (None, Some(left)) => right.and_then(|part| part.from(left.low)),
                (None, None) => None,
            };
            bottom = match (left, bottom) {
                (Some(_), _) => top,
                (None, Some(bottom)) => top.and_then(|part| part.from(bottom.low)),
                (None, None) => None,
            };
            self.right.extend(right.map(|part| (row, part)));
            row += 1;
        }
        ControlFlow::Continue(())
    }

    /// The part of a segment of the second polyline that is near a point.
    fn free_beside(&self, point: Point3, row: usize) -> Option<Part> {
        let [a, b] = [row, row + 1].map(|at| self.second.get(at).copied());
        near(point, [a?, b?], self.distance)
    }

    /// The part of a segment that is near a point of the second polyline.
    fn free_along(&self, segment: [Point3; 2], row: usize) -> Option<Part> {
        near(self.second.get(row).copied()?, segment, self.distance)
    }
}

/// The part of a segment within a distance of a point: half a chord of the ball about the point to either side of the foot
/// of its perpendicular.
fn near(point: Point3, [a, b]: [Point3; 2], distance: f64) -> Option<Part> {
    let (along, to) = (difference(b, a), difference(point, a));
    let length = dot(along, along);
    if length == 0.0 {
        let is_near = a.distance(point).to_mm() <= distance;
        return is_near.then_some(Part { low: 0.0, high: 1.0 });
    }
    let middle = dot(to, along) / length;
    let off: [f64; 3] = core::array::from_fn(|i| to[i] - middle * along[i]);
    let spread = (distance * distance - dot(off, off)) / length;
    if spread.partial_cmp(&0.0).is_none_or(core::cmp::Ordering::is_lt) {
        return None;
    }
    let spread = spread.sqrt();
    // Ends that are near count as a whole, whatever rounding makes of the roots.
    let is_near = |end: Point3| end.distance(point).to_mm() <= distance;
    let low = if is_near(a) { 0.0 } else { middle - spread };
    let high = if is_near(b) { 1.0 } else { middle + spread };
    let part = Part {
        low: low.max(0.0),
        high: high.min(1.0),
    };
    (part.low <= part.high).then_some(part)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn points(flat: &[f64]) -> Vec<Point3> {
        flat.chunks(3).map(|p| Point3::new(p[0], p[1], p[2])).collect()
    }

    /// The discrete distance of Eiter and Mannila (1994), over points only.
    fn discrete(p: &[Point3], q: &[Point3]) -> f64 {
        let mut table = vec![vec![0.0_f64; q.len()]; p.len()];
        for i in 0..p.len() {
            for j in 0..q.len() {
                let before = match (i, j) {
                    (0, 0) => 0.0,
                    (0, j) => table[0][j - 1],
                    (i, 0) => table[i - 1][0],
                    (i, j) => table[i - 1][j].min(table[i][j - 1]).min(table[i - 1][j - 1]),
                };
                table[i][j] = p[i].distance(q[j]).to_mm().max(before);
            }
        }
        table[p.len() - 1][q.len() - 1]
    }

    /// Points on a polyline, so many a segment.
    fn finer(p: &[Point3], parts: u32) -> Vec<Point3> {
        let between = |pair: &[Point3], part: u32| {
            let t = f64::from(part) / f64::from(parts);
            let at = |a: f64, b: f64| a + t * (b - a);
            Point3::new(
                at(pair[0].x, pair[1].x),
                at(pair[0].y, pair[1].y),
                at(pair[0].z, pair[1].z),
            )
        };
        let mut points: Vec<Point3> = p
            .windows(2)
            .flat_map(|pair| (0..parts).map(move |part| between(pair, part)))
            .collect();
        points.extend(p.last());
        points
    }

    proptest! {
        #[test]
        fn it_lies_between_discrete_distances(
            p in prop::collection::vec(-5.0..5.0f64, 6..18), q in prop::collection::vec(-5.0..5.0f64, 6..18),
        ) {
            let (p, q) = (points(&p[..p.len() / 3 * 3]), points(&q[..q.len() / 3 * 3]));
            // Points of both this close together differ from the continuous distance by no more than their spacing.
            let parts = 40;
            let above = discrete(&finer(&p, parts), &finer(&q, parts));
            let longest = p.windows(2).chain(q.windows(2)).map(|s| s[0].distance(s[1]).to_mm()).fold(0.0, f64::max);
            let below = above - longest / f64::from(parts);
            prop_assert_eq!(nearness(&p, &q, above + 1e-9, &mut 10_000), Nearness::Near);
            prop_assert_eq!(nearness(&p, &q, below - 1e-9, &mut 10_000), Nearness::Apart);
            prop_assert_eq!(nearness(&q, &p, above + 1e-9, &mut 10_000), Nearness::Near);
        }

        #[test]
        fn other_points_on_the_same_way_are_near(
            p in prop::collection::vec(-5.0..5.0f64, 9..30), parts in 1..7u32,
        ) {
            let p = points(&p[..p.len() / 3 * 3]);
            prop_assert_eq!(nearness(&p, &finer(&p, parts), 1e-9, &mut 100_000), Nearness::Near);
        }
    }

    #[test]
    fn there_and_back_is_not_the_way_itself() {
        let straight = points(&[0.0, 0.0, 0.0, 10.0, 0.0, 0.0]);
        let back = points(&[0.0, 0.0, 0.0, 8.0, 0.0, 0.0, 2.0, 0.0, 0.0, 10.0, 0.0, 0.0]);
        // The walker on the straight way waits at 5.
        assert_eq!(nearness(&straight, &back, 3.0, &mut 100), Nearness::Near);
        assert_eq!(nearness(&straight, &back, 2.99, &mut 100), Nearness::Apart);
        assert_eq!(nearness(&straight, &back, 3.0, &mut 2), Nearness::Unknown);
        assert_eq!(nearness(&straight, &straight[..1], 3.0, &mut 9), Nearness::Apart);
        assert_eq!(nearness(&[], &[], 3.0, &mut 9), Nearness::Apart);
    }
}
