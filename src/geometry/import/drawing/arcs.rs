//! Curves as arcs, proven to stay within a bound.
//!
//! A curve comes as a fine polyline whose corners lie on it ([`crate::curve`]). A stretch of it becomes a biarc: two arcs that
//! go on in one direction where they meet, and leave the ends of the stretch in the directions of the curve there (Bolton,
//! Biarc curves, Computer-Aided Design 7(2), 1975). Where it strays the stretch is halved; a single chord is a line, so that
//! halving ends.
//!
//! Whether a biarc strays is decided for all of the polyline, not for samples. The normal of the joint parts the polyline; each
//! part must lie between the normals at the ends of its arc and within the tolerance of the circle. On a chord the distance from
//! the centre is convex, so that its values at the ends and in the middle bound it in between ([`Bow::strays`]). As the polyline
//! leads from one end of an arc to the other, no place of the arc is farther from it either.

use super::join::SAME;
use crate::curve::COINCIDENT;
use crate::point::Point2;
use core::f64::consts::PI;

/// A corner that is not one of the polyline's own bends by more than this, in rad.
const CORNER: f64 = 0.1;

/// A line or an arc from one point to another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bow {
    /// Where it begins.
    pub from: Point2,
    /// Where it ends.
    pub to: Point2,
    /// How far it turns, in rad, positive to the left; 0 for a line. At most half a turn.
    pub sweep: f64,
}

impl Bow {
    pub(super) const fn line(from: Point2, to: Point2) -> Self {
        Self { from, to, sweep: 0.0 }
    }

    /// Whether it is a line.
    #[must_use]
    pub fn is_line(&self) -> bool {
        self.sweep == 0.0
    }

    pub(super) fn reversed(self) -> Self {
        Self {
            from: self.to,
            to: self.from,
            sweep: -self.sweep,
        }
    }

    /// An arc below a whole turn, in parts of at most half a turn.
    pub(super) fn of_arc(from: Point2, to: Point2, sweep: f64) -> Vec<Self> {
        if sweep.abs() <= PI {
            return vec![Self { from, to, sweep }.straightened()];
        }
        // The middle is off the chord, to the right of an arc to the left, by half of it times the tangent of a quarter of the
        // angle.
        let half = to.minus(from);
        let height = 0.5 * libm::tan(sweep / 4.0);
        let middle = from.lerp(to, 0.5);
        let top = Point2::new(middle.x + half.z * height, middle.z - half.x * height);
        let part = |from, to| Self {
            from,
            to,
            sweep: sweep / 2.0,
        };
        vec![part(from, top), part(top, to)]
    }

    /// A line where it is as good as one.
    fn straightened(self) -> Self {
        // The sagitta of a flat arc is an eighth of the chord times the angle.
        let is_flat =
            self.from.distance(self.to) * self.sweep.abs() / 8.0 < COINCIDENT && self.sweep.abs() < 1.0;
        if is_flat {
            Self { sweep: 0.0, ..self }
        } else {
            self
        }
    }

    /// The arc that begins in a direction; none of half a turn or more.
    fn tangent(from: Point2, ahead: Point2, to: Point2) -> Option<Self> {
        let chord = to.minus(from);
        // An arc turns through twice the angle between tangent and chord.
        let half = libm::atan2(ahead.cross(chord), ahead.dot(chord));
        let bow = Self {
            from,
            to,
            sweep: 2.0 * half,
        };
        (half.abs() < PI / 2.0).then(|| bow.straightened())
    }

    /// Whether a chain of points from its beginning to its end leaves the tolerance anywhere.
    fn strays(&self, points: &[Point2], tolerance: f64) -> bool {
        let frame = Frame::of(*self);
        let slack = COINCIDENT;
        let is_beside = |point: &Point2| {
            point.minus(self.from).dot(frame.ahead) >= -slack
                && point.minus(self.to).dot(frame.arrival) <= slack
        };
        let is_off = |chord: &[Point2]| {
            // Convex on a chord: the negative distance to the left of an arc to the left, the distance itself of one to the right.
            let sense = if self.sweep > 0.0 { -1.0 } else { 1.0 };
            let [one, middle, other] =
                [0.0, 0.5, 1.0].map(|t| sense * frame.left_of(chord[0].lerp(chord[1], t)));
            let highest = one.max(other);
            let lowest = one.min(other).min(2.0 * middle - highest);
            !(highest <= tolerance && lowest >= -tolerance)
        };
        !points.iter().all(is_beside) || points.windows(2).any(is_off)
    }
}

/// What distances from a bow need. With m its middle, n its left normal there and k its curvature, its line or circle is
/// `2 n.(p - m) - k |p - m|^2 = 0`; no centre enters.
struct Frame {
    middle: Point2,
    normal: Point2,
    bend: f64,
    ahead: Point2,
    arrival: Point2,
}

impl Frame {
    fn of(bow: Bow) -> Self {
        let way = bow.to.minus(bow.from);
        let chord = bow.from.distance(bow.to);
        let along = Point2::new(way.x / chord, way.z / chord);
        let normal = Point2::new(-along.z, along.x);
        let (sin, cos) = libm::sincos(bow.sweep / 2.0);
        let sagitta = chord / 2.0 * sin / (1.0 + cos);
        let half = bow.from.lerp(bow.to, 0.5);
        Self {
            middle: Point2::new(half.x - normal.x * sagitta, half.z - normal.z * sagitta),
            normal,
            bend: 2.0 * sin / chord,
            ahead: Point2::new(along.x * cos + along.z * sin, along.z * cos - along.x * sin),
            arrival: Point2::new(along.x * cos - along.z * sin, along.z * cos + along.x * sin),
        }
    }

    /// How far to the left of the line or circle a point is, negative to the right.
    fn left_of(&self, point: Point2) -> f64 {
        let to = point.minus(self.middle);
        let normal = Point2::new(self.normal.x - to.x * self.bend, self.normal.z - to.z * self.bend);
        (2.0 * self.normal.dot(to) - self.bend * to.dot(to)) / (1.0 + normal.dot(normal).sqrt())
    }
}

/// Lines and arcs that stay within a tolerance of a polyline, and the polyline of them. `fine` is how far the curve is from the
/// polyline: corners that this does not explain stay corners.
pub(super) fn fit(points: &[Point2], tolerance: f64, fine: f64) -> Vec<Bow> {
    let mut bows = Vec::new();
    let mut begin = 0;
    for at in 1..points.len() {
        if at + 1 == points.len() || is_corner(&points[at - 1..=at + 1], fine) {
            fit_smooth(&points[begin..=at], tolerance, &mut bows);
            begin = at;
        }
    }
    bows
}

/// Whether a polyline bends more than that of a smooth curve. Chords of one that are up to `fine` off it bend by at most
/// `8 fine` over the shorter of the two, where the curvature stays the same; twice that is a corner.
fn is_corner(three: &[Point2], fine: f64) -> bool {
    let (before, after) = (three[1].minus(three[0]), three[2].minus(three[1]));
    let bend = libm::atan2(before.cross(after), before.dot(after)).abs();
    let shorter = three[0].distance(three[1]).min(three[1].distance(three[2]));
    bend > CORNER && bend * shorter > 16.0 * fine
}

/// A stretch without corners, halved until its biarcs stay within the tolerance.
fn fit_smooth(points: &[Point2], tolerance: f64, bows: &mut Vec<Bow>) {
    let mut open = vec![(0, points.len() - 1)];
    while let Some((from, to)) = open.pop() {
        let stretch = &points[from..=to];
        if to - from == 1 {
            bows.push(Bow::line(points[from], points[to]));
        } else if let Some(pair) = biarc(stretch, [heading(points, from), heading(points, to)], tolerance) {
            bows.extend(pair);
        } else {
            let middle = from + (to - from) / 2;
            open.extend([(middle, to), (from, middle)]);
        }
    }
}

/// The direction of a curve at a corner of its polyline, not of length 1: that of the circle through three corners. By inversion
/// at one of them the circle becomes a line in that direction, through the images of the others.
fn heading(points: &[Point2], at: usize) -> Point2 {
    let last = points.len() - 1;
    let image = |other: usize| {
        let way = points[other].minus(points[at]);
        let size = way.dot(way).max(f64::MIN_POSITIVE);
        Point2::new(way.x / size, way.z / size)
    };
    match at {
        0 => image(1).minus(image(2.min(last))),
        at if at == last => image(last.saturating_sub(2)).minus(image(last - 1)),
        at => image(at + 1).minus(image(at - 1)),
    }
}

/// The biarc of a stretch in the directions of its ends, with equal lengths of both tangents; none where it strays.
fn biarc(stretch: &[Point2], headings: [Point2; 2], tolerance: f64) -> Option<[Bow; 2]> {
    let (&from, &to) = (stretch.first()?, stretch.last()?);
    let unit = |way: Point2| {
        let size = libm::hypot(way.x, way.z);
        (size > 0.0).then(|| Point2::new(way.x / size, way.z / size))
    };
    let (ahead, arrival) = (unit(headings[0])?, unit(headings[1])?);
    let way = to.minus(from);
    // The tangents of length d end 2 d apart: `|way - d (ahead + arrival)| = 2 d`.
    let along = way.dot(Point2::new(ahead.x + arrival.x, ahead.z + arrival.z));
    let size = way.dot(way);
    let root = (along * along + 2.0 * (1.0 - ahead.dot(arrival)) * size).sqrt();
    let length = size / (along + root);
    if !(along + root > 0.0 && length.is_finite()) {
        return None;
    }
    let first = Point2::new(from.x + length * ahead.x, from.z + length * ahead.z);
    let last = Point2::new(to.x - length * arrival.x, to.z - length * arrival.z);
    let joint = first.lerp(last, 0.5);
    let onward = unit(last.minus(first))?;
    if from.distance(joint).min(joint.distance(to)) < SAME {
        return None;
    }
    let pair = [
        Bow::tangent(from, ahead, joint)?,
        Bow::tangent(joint, onward, to)?,
    ];
    let [before, after] = parted(stretch, joint, onward)?;
    let strays = pair[0].strays(&before, tolerance) || pair[1].strays(&after, tolerance);
    (!strays).then_some(pair)
}

/// A polyline before and after the normal of a joint, which it crosses once.
fn parted(stretch: &[Point2], joint: Point2, onward: Point2) -> Option<[Vec<Point2>; 2]> {
    let progress = |point: &Point2| point.minus(joint).dot(onward);
    let place = stretch.iter().position(|point| progress(point) > 0.0)?;
    let (before, after) = stretch.split_at(place);
    let (&last, &first) = (before.last()?, after.first()?);
    let share = progress(&last) / (progress(&last) - progress(&first));
    let crossing = last.lerp(first, share.clamp(0.0, 1.0));
    let before = before.iter().copied().chain([crossing]).collect();
    let after = [crossing].into_iter().chain(after.iter().copied()).collect();
    Some([before, after])
}

#[cfg(test)]
mod tests;
