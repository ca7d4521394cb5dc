//! Whether a ring has two sides, and which way round it goes.
//!
//! A ring has an upper and a lower side when it is a simple closed curve. That is shown in one of two ways:
//!
//! * Both ways from its leftmost corner to its rightmost never lead back to the left, nor up and down again at one x.
//!   Then they are a simple closed curve if one lies over the other at every corner of both, and so everywhere, since
//!   both are straight in between. Here they may overlap by what flattening curves may have moved them: sides that meet in
//!   a cusp, as at the end of many airfoils, cross each other once they are flattened.
//! * Of any other ring no two segments have a point in common but neighbours their corner. All pairs that lie beside each
//!   other are looked at ([`first_pair`]); where rounding leaves the answer open they count as meeting.

use super::join::SAME;
use super::pairs::{Dense, Extent, first_pair};
use crate::point::Point2;

/// Which way round a ring goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Turn {
    /// Its inside is on its left.
    Left,
    /// Its inside is on its right.
    Right,
}

/// Why a ring has no sides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum RingError {
    /// Nothing lies between its sides.
    NoArea,
    /// Two of its segments meet that are not neighbours.
    Meets {
        at: Point2,
        /// The segments, by the corners they begin with.
        segments: [usize; 2],
    },
    /// It lies beside itself so often that not all of it is looked at.
    Dense,
}

/// Proves that a ring is a simple closed curve, or that its sides, where they run from left to right, overlap by
/// `accuracy` at most. The first corner is not repeated at the end.
pub(super) fn prove_simple(ring: &[Point2], accuracy: f64) -> Result<Turn, RingError> {
    let Some(ways) = Ways::of(ring) else {
        return match meeting(ring, &|_| true)? {
            Some(error) => Err(error),
            None if area(ring) > 0.0 => Ok(Turn::Left),
            None => Ok(Turn::Right),
        };
    };
    match ways.order(accuracy) {
        Order::Under => Ok(Turn::Left),
        Order::Over => Ok(Turn::Right),
        Order::Alike => Err(RingError::NoArea),
        Order::Changes { from, to } => {
            let is_there = |at: Point2| (from - SAME..=to + SAME).contains(&at.x);
            Err(meeting(ring, &is_there)?.unwrap_or_else(|| ways.turn_at(from)))
        }
    }
}

/// The two ways of a ring from its leftmost corner to its rightmost, x never falling.
struct Ways {
    /// Where the first begins, as a place in the ring.
    start: usize,
    /// How many corners the ring has.
    corners: usize,
    /// The one that the ring goes.
    on: Vec<Point2>,
    /// The other, from left to right too.
    back: Vec<Point2>,
}

/// How the way on lies to the way back.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Order {
    Under,
    Over,
    /// They are the same within the accuracy.
    Alike,
    /// It is under the other at one of these and over it at the other.
    Changes {
        from: f64,
        to: f64,
    },
}

impl Ways {
    /// None if one of them leads back.
    fn of(ring: &[Point2]) -> Option<Self> {
        let place = |better: fn(f64, f64) -> bool| {
            let first = (0, ring.first()?.x);
            let found = ring.iter().enumerate().fold(first, |best, (place, point)| {
                if better(point.x, best.1) {
                    (place, point.x)
                } else {
                    best
                }
            });
            Some(found.0)
        };
        let (left, right) = (place(|x, best| x < best)?, place(|x, best| x > best)?);
        let way = |from: usize, to: usize| -> Vec<Point2> {
            let steps = (to + ring.len() - from) % ring.len();
            (0..=steps).map(|step| ring[(from + step) % ring.len()]).collect()
        };
        let mut back = way(right, left);
        back.reverse();
        Some(Self {
            start: left,
            corners: ring.len(),
            on: never_back(way(left, right))?,
            back: never_back(back)?,
        })
    }

    /// Both are straight between the corners of both, so that these decide.
    fn order(&self, accuracy: f64) -> Order {
        let mut all: Vec<f64> = self.on.iter().chain(&self.back).map(|point| point.x).collect();
        all.sort_by(f64::total_cmp);
        all.dedup();
        // The last x at which the way on must be under the other, and over it.
        let (mut under, mut over) = (None, None);
        for x in all {
            let (on, back) = (Span::at(&self.on, x), Span::at(&self.back, x));
            if on.low < back.high - accuracy {
                under = Some(x);
            }
            if back.low < on.high - accuracy {
                over = Some(x);
            }
            if let (Some(one), Some(other)) = (under, over) {
                return Order::Changes {
                    from: one.min(other),
                    to: one.max(other),
                };
            }
        }
        match (under, over) {
            (Some(_), _) => Order::Under,
            (None, Some(_)) => Order::Over,
            (None, None) => Order::Alike,
        }
    }

    /// The message where the ways change places by less than rounding.
    fn turn_at(&self, x: f64) -> RingError {
        let place = self
            .on
            .partition_point(|point| point.x < x)
            .min(self.on.len() - 1);
        let segment = (self.start + place) % self.corners;
        RingError::Meets {
            at: self.on[place],
            segments: [segment, segment],
        }
    }
}

/// A way whose x never falls, and which does not turn round where it leads straight up or down. What falls by rounding
/// is made level.
fn never_back(mut way: Vec<Point2>) -> Option<Vec<Point2>> {
    for at in 1..way.len() {
        let last = way[at - 1].x;
        if way[at].x < last - SAME {
            return None;
        }
        way[at].x = way[at].x.max(last);
    }
    let turns = |three: &[Point2]| {
        let is_upright = three[0].x.total_cmp(&three[2].x).is_eq();
        is_upright && (three[1].z - three[0].z) * (three[2].z - three[1].z) < 0.0
    };
    (!way.windows(3).any(turns)).then_some(way)
}

/// The heights of a way at one x.
struct Span {
    low: f64,
    high: f64,
}

impl Span {
    fn at(way: &[Point2], x: f64) -> Self {
        let first = way.partition_point(|point| point.x < x);
        let last = way.partition_point(|point| point.x <= x);
        let heights = match (
            first.checked_sub(1).and_then(|place| way.get(place)),
            way.get(first),
        ) {
            (Some(before), Some(after)) if first == last => {
                let z = before.lerp(*after, (x - before.x) / (after.x - before.x)).z;
                return Self { low: z, high: z };
            }
            _ => way.get(first..last).unwrap_or_default(),
        };
        let start = (f64::INFINITY, f64::NEG_INFINITY);
        let (low, high) = heights
            .iter()
            .fold(start, |(low, high), point| (low.min(point.z), high.max(point.z)));
        Self { low, high }
    }
}

/// The first two segments found that meet where `counts` says so and are not neighbours, or are neighbours
/// that fold.
fn meeting(ring: &[Point2], counts: &dyn Fn(Point2) -> bool) -> Result<Option<RingError>, RingError> {
    let count = ring.len();
    let segment = |place: usize| [ring[place], ring[(place + 1) % count]];
    let extents: Vec<Extent> = (0..count)
        .map(|place| {
            let [from, to] = segment(place);
            Extent::of(from, to)
        })
        .collect();
    let found = first_pair(&extents, &mut |one, other| {
        let (a, b) = (segment(one), segment(other));
        let at = if other == one + 1 {
            fold(a, b)
        } else if one == 0 && other + 1 == count {
            fold(b, a)
        } else {
            common_point(a, b)
        };
        at.filter(|at| counts(*at)).map(|at| RingError::Meets {
            at,
            segments: [one, other],
        })
    });
    found.map_err(|Dense| RingError::Dense)
}

/// Where a segment lies on the one before.
fn fold([from, corner]: [Point2; 2], [_, to]: [Point2; 2]) -> Option<Point2> {
    let leads_back = corner.minus(from).dot(to.minus(corner)) < 0.0;
    (leads_back && side_of([from, corner], to) == Hand::On).then_some(corner)
}

/// On which side of a line a point is.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Hand {
    Left,
    Right,
    /// On it, as far as doubles can show.
    On,
}

/// The sign of the area of a triangle, or `On` where rounding may have changed it (the bound of Shewchuk's orient2d, 1997,
/// rounded up).
fn side_of([from, to]: [Point2; 2], point: Point2) -> Hand {
    let left = (from.x - point.x) * (to.z - point.z);
    let right = (from.z - point.z) * (to.x - point.x);
    let area = left - right;
    let bound = 4.0 * f64::EPSILON * (left.abs() + right.abs());
    if area > bound {
        Hand::Left
    } else if area < -bound {
        Hand::Right
    } else {
        Hand::On
    }
}

/// A point that two segments whose boxes meet have in common.
fn common_point(a: [Point2; 2], b: [Point2; 2]) -> Option<Point2> {
    let on_b = a.map(|point| side_of(b, point));
    let on_a = b.map(|point| side_of(a, point));
    let is_beside = |hands: [Hand; 2]| hands[0] == hands[1] && hands[0] != Hand::On;
    if is_beside(on_b) || is_beside(on_a) {
        return None;
    }
    // An end of one on the other, if there is one.
    let ends = a.into_iter().zip(on_b).map(|(end, hand)| (end, hand, b));
    let ends = ends.chain(b.into_iter().zip(on_a).map(|(end, hand)| (end, hand, a)));
    let mut touching = ends.filter(|(end, hand, [from, to])| {
        *hand == Hand::On && Extent::of(*end, *end).meets(Extent::of(*from, *to))
    });
    if let Some((end, _, _)) = touching.next() {
        return Some(end);
    }
    let (along, across) = (a[1].minus(a[0]), b[1].minus(b[0]));
    let size = along.cross(across);
    // Parallel ones that rounding leaves open lie on one line; their boxes meet.
    if size.abs() <= f64::MIN_POSITIVE {
        return Some(a[0]);
    }
    let share = b[0].minus(a[0]).cross(across) / size;
    Some(a[0].lerp(a[1], share.clamp(0.0, 1.0)))
}

/// Twice the area inside of a ring, above 0 when it turns left.
fn area(ring: &[Point2]) -> f64 {
    let Some(&origin) = ring.first() else {
        return 0.0;
    };
    ring.windows(2)
        .map(|pair| pair[0].minus(origin).cross(pair[1].minus(origin)))
        .sum()
}

#[cfg(test)]
mod tests;
