//! Polylines in space: places on them, and parts of them.

use crate::mesh::difference;
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::vector::dot;

/// A place on a polyline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Place {
    /// The segment, from 0.
    pub(crate) segment: usize,
    /// Where on it, from 0 to 1.
    pub(crate) share: f64,
}

impl Place {
    /// The point there.
    pub(crate) fn on(self, points: &[Point3]) -> Option<Point3> {
        let (a, b) = (points.get(self.segment)?, points.get(self.segment + 1)?);
        let at = |a: f64, b: f64| a * (1.0 - self.share) + b * self.share;
        Some(Point3::new(at(a.x, b.x), at(a.y, b.y), at(a.z, b.z)))
    }
}

/// The place of a segment nearest to a point, from 0 to 1, and their distance in mm.
pub(crate) fn foot(point: Point3, [a, b]: [Point3; 2]) -> (f64, f64) {
    let (along, to) = (difference(b, a), difference(point, a));
    let length = dot(along, along);
    let share = if length > 0.0 {
        (dot(to, along) / length).clamp(0.0, 1.0)
    } else {
        0.0
    };
    let off: [f64; 3] = core::array::from_fn(|i| to[i] - share * along[i]);
    (share, dot(off, off).sqrt())
}

/// The place nearest to a point, and their distance in mm.
pub(crate) fn nearest(points: &[Point3], point: Point3) -> Option<(Place, f64)> {
    let segments = points.windows(2).enumerate();
    let feet = segments.map(|(segment, pair)| {
        let (share, distance) = foot(point, [pair[0], pair[1]]);
        (Place { segment, share }, distance)
    });
    feet.min_by(|a, b| a.1.total_cmp(&b.1))
}

/// A closed polyline from another place on.
pub(crate) fn rotated(points: &[Point3], place: Place) -> Option<Vec<Point3>> {
    let start = place.on(points)?;
    let mut turned = vec![start];
    turned.extend_from_slice(points.get(place.segment + 1..)?);
    // The last point is the first one again.
    turned.extend_from_slice(points.get(1..=place.segment)?);
    turned.push(start);
    Some(turned)
}

/// The part of a polyline between two points that lie within a distance in mm of it. None if they do not, or if it is not
/// certain which part is meant.
pub(crate) fn between(points: &[Point3], [start, end]: [Point3; 2], distance: f64) -> Option<Vec<Point3>> {
    let (&first, &last) = (points.first()?, points.last()?);
    let apart = |a: Point3, b: Point3| a.distance(b).to_mm();
    if apart(start, end) <= distance {
        // All of a curve that is no more than a point; of others it is not certain whether none or all is meant.
        let is_a_point = points.iter().all(|&point| apart(point, start) <= distance);
        return is_a_point.then(|| vec![start, end]);
    }
    // Ends are ends, even if the curve comes by once more.
    let place = |point: Point3| {
        if apart(point, first) <= distance && apart(point, first) <= apart(point, last) {
            Some(Place {
                segment: 0,
                share: 0.0,
            })
        } else if apart(point, last) <= distance {
            let segment = points.len().checked_sub(2)?;
            Some(Place { segment, share: 1.0 })
        } else {
            only_place(points, point, distance)
        }
    };
    let (from, to) = (place(start)?, place(end)?);
    let is_forward = (from.segment, from.share) <= (to.segment, to.share);
    let (low, high) = if is_forward { (from, to) } else { (to, from) };
    let mut part = vec![low.on(points)?];
    part.extend_from_slice(points.get(low.segment + 1..=high.segment)?);
    part.push(high.on(points)?);
    if !is_forward {
        part.reverse();
    }
    Some(part)
}

/// The place of a polyline within a distance of a point; none if there are several that others lie between, or none.
fn only_place(points: &[Point3], point: Point3, most: f64) -> Option<Place> {
    let mut best: Option<(f64, Place)> = None;
    let mut last_near: Option<usize> = None;
    for (segment, pair) in points.windows(2).enumerate() {
        let (share, distance) = foot(point, [pair[0], pair[1]]);
        if distance > most {
            continue;
        }
        if last_near.is_some_and(|near| near + 1 < segment) {
            return None;
        }
        last_near = Some(segment);
        if best.is_none_or(|(least, _)| distance < least) {
            best = Some((distance, Place { segment, share }));
        }
    }
    best.map(|(_, place)| place)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Three sides of a square of 10, and back to 1 from its start.
    fn hook() -> Vec<Point3> {
        let corners = [[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0], [0.0, 1.0]];
        corners.map(|[x, y]| Point3::new(x, y, 5.0)).to_vec()
    }

    #[test]
    fn parts_go_from_one_point_to_the_other() {
        let at = |x: f64, y: f64| Point3::new(x, y, 5.0);
        let part = between(&hook(), [at(4.0, 0.01), at(10.0, 6.0)], 0.02).unwrap();
        assert_eq!(part, [at(4.0, 0.0), at(10.0, 0.0), at(10.0, 6.0)]);
        let back = between(&hook(), [at(10.0, 6.0), at(4.0, 0.01)], 0.02).unwrap();
        assert_eq!(back, [at(10.0, 6.0), at(10.0, 0.0), at(4.0, 0.0)]);
        assert_eq!(
            between(&hook(), [at(0.0, 0.0), at(0.0, 1.0)], 0.02).unwrap(),
            hook()
        );
        // Off the way; near both ends of it; no way at all.
        assert_eq!(between(&hook(), [at(4.0, 1.0), at(10.0, 6.0)], 0.02), None);
        assert_eq!(between(&hook(), [at(0.0, 0.5), at(10.0, 6.0)], 0.1), None);
        assert_eq!(between(&hook(), [at(4.0, 0.0), at(4.0, 0.0)], 0.1), None);
    }

    #[test]
    fn parts_of_ways_that_cross_themselves_are_not_guessed() {
        let corners = [[0.0, 0.0], [10.0, 10.0], [10.0, 0.0], [0.0, 10.0]];
        let points = corners.map(|[x, y]| Point3::new(x, y, 5.0));
        let at = |x: f64, y: f64| Point3::new(x, y, 5.0);
        assert_eq!(between(&points, [at(0.0, 0.0), at(5.0, 5.0)], 0.01), None);
        assert!(between(&points, [at(0.0, 0.0), at(6.0, 6.0)], 0.01).is_some());
    }

    #[test]
    fn closed_polylines_start_where_they_are_wanted() {
        let at = |x: f64, y: f64| Point3::new(x, y, 0.0);
        let square = [
            at(0.0, 0.0),
            at(2.0, 0.0),
            at(2.0, 2.0),
            at(0.0, 2.0),
            at(0.0, 0.0),
        ];
        let (place, distance) = nearest(&square, at(3.0, 1.0)).unwrap();
        assert_eq!(
            (place, distance),
            (
                Place {
                    segment: 1,
                    share: 0.5
                },
                1.0
            )
        );
        let turned = [
            at(2.0, 1.0),
            at(2.0, 2.0),
            at(0.0, 2.0),
            at(0.0, 0.0),
            at(2.0, 0.0),
            at(2.0, 1.0),
        ];
        assert_eq!(rotated(&square, place).unwrap(), turned);
    }
}
