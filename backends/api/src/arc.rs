//! Circular arcs in space: through three points, or round by an angle.

use crate::units::{Angle, Length};
use crate::vector::{cross, dot, length, minus, plus, scaled};
use core::f64::consts::TAU;

/// An arc in space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CircularArc {
    centre: [f64; 3],
    /// From the centre to where it begins.
    first: [f64; 3],
    /// As long, a quarter further.
    second: [f64; 3],
    /// How far it goes round, in rad; at least 0. A full turn and more where the program says so.
    sweep: f64,
}

/// Least share of the product of two chords that their area is, for them not to lie on one line.
const BENT: f64 = 1e-9;

impl CircularArc {
    /// From one point through another to a third; none where they lie on a line, or two of them in one place.
    #[must_use]
    pub fn through([from, through, to]: [[f64; 3]; 3]) -> Option<Self> {
        let (a, b) = (minus(through, from), minus(to, from));
        let normal = cross(a, b);
        let (aa, bb, nn) = (dot(a, a), dot(b, b), dot(normal, normal));
        if nn <= BENT * BENT * aa * bb || nn == 0.0 {
            return None;
        }
        // The centre of the circle about a triangle, seen from one corner.
        let to_centre = cross(minus(scaled(b, aa), scaled(a, bb)), normal).map(|value| value / (2.0 * nn));
        let centre = plus(from, to_centre);
        let first = to_centre.map(|value| -value);
        let second = scaled(cross(normal, first), 1.0 / libm::sqrt(nn));
        let end = minus(to, centre);
        let angle = libm::atan2(dot(end, second), dot(end, first));
        let sweep = if angle > 0.0 { angle } else { angle + TAU };
        Some(Self {
            centre,
            first,
            second,
            sweep,
        })
    }

    /// About a centre from one point to another, by the rule of the right hand about an axis; none where the first point is on
    /// the axis.
    #[must_use]
    pub fn about(centre: [f64; 3], axis: [f64; 3], [from, to]: [[f64; 3]; 2]) -> Option<Self> {
        let along = length(axis);
        let first = minus(from, centre);
        let second = scaled(cross(axis, first), 1.0 / along);
        let end = minus(to, centre);
        let angle = libm::atan2(dot(end, second), dot(end, first));
        let sweep = if angle > 0.0 { angle } else { angle + TAU };
        let is_round = along > 0.0 && length(second) > 0.0 && sweep.is_finite();
        is_round.then_some(Self {
            centre,
            first,
            second,
            sweep,
        })
    }

    /// The arc on its circle that goes round by an angle: the way it led for angles above 0, the other way for others.
    #[must_use]
    pub fn turned_by(self, angle: Angle) -> Self {
        let sweep = angle.to_rad();
        Self {
            second: if sweep < 0.0 {
                scaled(self.second, -1.0)
            } else {
                self.second
            },
            sweep: sweep.abs(),
            ..self
        }
    }

    /// As seen in other axes: where they put a direction, and where a point.
    #[must_use]
    pub fn seen(
        self,
        direction: impl Fn([f64; 3]) -> [f64; 3],
        point: impl Fn([f64; 3]) -> [f64; 3],
    ) -> Self {
        Self {
            centre: point(self.centre),
            first: direction(self.first),
            second: direction(self.second),
            sweep: self.sweep,
        }
    }

    /// The point at which it ends.
    #[must_use]
    pub fn end(&self) -> [f64; 3] {
        self.at(self.sweep)
    }

    /// The point so far round from where it begins, in rad.
    #[must_use]
    pub fn at(&self, angle: f64) -> [f64; 3] {
        let [x, y] = [libm::cos(angle), libm::sin(angle)];
        plus(self.centre, plus(scaled(self.first, x), scaled(self.second, y)))
    }

    /// The direction in which it continues, so far round from where it begins, in rad; of unit length.
    #[must_use]
    pub fn direction(&self, angle: f64) -> [f64; 3] {
        let [x, y] = [-libm::sin(angle), libm::cos(angle)];
        let along = plus(scaled(self.first, x), scaled(self.second, y));
        scaled(along, 1.0 / self.radius().to_mm())
    }

    /// The point about which it goes.
    #[must_use]
    pub const fn centre(&self) -> [f64; 3] {
        self.centre
    }

    /// From the centre to where it begins, and to where it would be a quarter further.
    #[must_use]
    pub const fn radii(&self) -> [[f64; 3]; 2] {
        [self.first, self.second]
    }

    /// The axis about which it goes, by the rule of the right hand; of unit length.
    #[must_use]
    pub fn axis(&self) -> [f64; 3] {
        let normal = cross(self.first, self.second);
        scaled(normal, 1.0 / length(normal))
    }

    /// How far it goes round; at least 0.
    #[must_use]
    pub const fn sweep(&self) -> Angle {
        Angle::rad(self.sweep)
    }

    /// The radius of its circle.
    #[must_use]
    pub fn radius(&self) -> Length {
        Length::mm(length(self.first))
    }

    /// The length of the way along it.
    #[must_use]
    pub fn length(&self) -> Length {
        self.radius() * self.sweep
    }

    /// How much of its way is done at a point on it, from 0 where it begins to 1 where it ends.
    #[must_use]
    pub fn done_at(&self, point: [f64; 3]) -> f64 {
        let out = minus(point, self.centre);
        let angle = libm::atan2(dot(out, self.second), dot(out, self.first));
        let angle = if angle < 0.0 { angle + TAU } else { angle };
        angle / self.sweep
    }

    /// Points along it, its end among them.
    pub fn points(&self, count: u32) -> impl Iterator<Item = [f64; 3]> {
        (1..=count).map(move |i| self.at(self.sweep * f64::from(i) / f64::from(count)))
    }

    /// The least and the greatest x, y and z on it.
    #[must_use]
    pub fn room(&self) -> [[f64; 3]; 2] {
        let mut room = [self.at(0.0); 2];
        let mut take = |[x, y, z]: [f64; 3]| {
            let [[x0, y0, z0], [x1, y1, z1]] = room;
            room = [
                [x0.min(x), y0.min(y), z0.min(z)],
                [x1.max(x), y1.max(y), z1.max(z)],
            ];
        };
        take(self.end());
        for (first, second) in self.first.into_iter().zip(self.second) {
            let turning = libm::atan2(second, first);
            for angle in [turning, turning + TAU / 2.0, turning + TAU] {
                let angle = if angle < 0.0 { angle + TAU } else { angle };
                if angle < self.sweep {
                    take(self.at(angle));
                }
            }
        }
        room
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn point() -> impl Strategy<Value = [f64; 3]> {
        prop::array::uniform3(-100.0..100.0_f64)
    }

    fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
        let d = minus(a, b);
        dot(d, d).sqrt()
    }

    #[test]
    fn half_a_turn_over_the_top() {
        let arc = CircularArc::through([[0.0, 0.0, 5.0], [10.0, 0.0, 15.0], [20.0, 0.0, 5.0]]).unwrap();
        let [low, high] = arc.room();
        assert!(
            (low[2] - 5.0).abs() < 1e-9 && (high[2] - 15.0).abs() < 1e-9,
            "{low:?} {high:?}"
        );
        assert!(CircularArc::through([[0.0; 3], [1.0, 1.0, 1.0], [3.0, 3.0, 3.0]]).is_none());
    }

    #[test]
    fn a_full_circle_takes_the_room_of_all_of_it() {
        let arc = CircularArc::through([[10.0, 0.0, 5.0], [0.0, 10.0, 5.0], [-10.0, 0.0, 5.0]]).unwrap();
        for turns in [360.0, 720.0, -360.0] {
            let round = arc.turned_by(Angle::deg(turns));
            assert!(distance(round.end(), [10.0, 0.0, 5.0]) < 1e-9);
            let [low, high] = round.room();
            assert!(
                distance(low, [-10.0, -10.0, 5.0]) < 1e-9 && distance(high, [10.0, 10.0, 5.0]) < 1e-9,
                "{low:?} {high:?}"
            );
        }
        let back = arc.turned_by(Angle::deg(-90.0));
        assert!(distance(back.end(), [0.0, -10.0, 5.0]) < 1e-9);
        let [low, high] = back.room();
        assert!(low[1] > -10.1 && high[1] < 0.1, "{low:?} {high:?}");
    }

    proptest! {
        #[test]
        fn it_leads_through_its_points_and_stays_in_its_room(a in point(), b in point(), c in point()) {
            let Some(arc) = CircularArc::through([a, b, c]) else { return Ok(()) };
            let radius = distance(a, arc.centre);
            prop_assume!(radius < 1e4);
            prop_assert!(distance(arc.at(0.0), a) < 1e-6);
            prop_assert!(distance(arc.at(arc.sweep), c) < 1e-5);
            let same = CircularArc::about(arc.centre(), arc.axis(), [a, c]).unwrap();
            prop_assert!(distance(same.at(0.4 * arc.sweep), arc.at(0.4 * arc.sweep)) < 1e-4);
            prop_assert!(distance(arc.at(arc.done_at(b) * arc.sweep), b) < 1e-5);
            let steps = 4000;
            let near_b = arc.points(steps).map(|point| distance(point, b)).fold(f64::INFINITY, f64::min);
            prop_assert!(near_b <= 1e-5 + radius * TAU / f64::from(steps), "{near_b}");
            let [low, high] = arc.room();
            for point in arc.points(steps) {
                for axis in 0..3 {
                    prop_assert!(point[axis] >= low[axis] - 1e-6 && point[axis] <= high[axis] + 1e-6);
                }
            }
        }
    }
}
