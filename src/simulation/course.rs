//! How the blade moves along a piece of a way: its tip on a line or an arc, while it turns about one axis in proportion to
//! the way.
//!
//! Proofs look at a span of a course at a time. All that the blade covers there lies near what it covers when, held as in the
//! middle of the span, its tip goes along the chord: a point `r` away from the tip is off by no more than `r` times half the
//! turn of the span, the tip by no more than the sagitta of its arc, and by the blend of a chain.

use vcutc_backend_api::arc::CircularArc;
use vcutc_backend_api::geometry::{Orientation, Point3};
use vcutc_backend_api::ir::{Action, Program};
use vcutc_backend_api::segments::{LinearSegment, Segment};
use vcutc_backend_api::units::Length;
use vcutc_backend_api::vector::length;

/// A straight way of the tip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Way {
    pub(super) from: Point3,
    pub(super) to: Point3,
}

impl Way {
    /// The height of its lower end.
    pub(super) const fn lowest(self) -> f64 {
        self.from.z.min(self.to.z)
    }

    /// A part of it, between two shares.
    pub(super) fn part(self, from: f64, to: f64) -> Self {
        Self {
            from: self.at(from),
            to: self.at(to),
        }
    }

    fn at(self, share: f64) -> Point3 {
        let between = |a: f64, b: f64| a + (b - a) * share;
        Point3::new(
            between(self.from.x, self.to.x),
            between(self.from.y, self.to.y),
            between(self.from.z, self.to.z),
        )
    }
}

/// A share of a course.
#[derive(Clone, Copy, Debug)]
pub(super) struct Span {
    pub(super) from: f64,
    pub(super) to: f64,
}

impl Span {
    pub(super) const WHOLE: Self = Self { from: 0.0, to: 1.0 };

    fn middle(self) -> f64 {
        f64::midpoint(self.from, self.to)
    }

    fn half(self) -> f64 {
        (self.to - self.from) / 2.0
    }

    pub(super) fn halves(self) -> [Self; 2] {
        let middle = self.middle();
        [Self { to: middle, ..self }, Self { from: middle, ..self }]
    }
}

/// Where the tip moves.
#[derive(Clone, Copy, Debug)]
enum Tips {
    Line(Way),
    Arc(CircularArc),
}

/// How the blade moves along a piece of a way.
#[derive(Clone, Copy, Debug)]
pub(super) struct Course {
    tips: Tips,
    from: Orientation,
    to: Orientation,
    /// The axis it turns about, times the angle in rad.
    turn: [f64; 3],
    /// How far the tip may be off, in mm.
    blend: f64,
}

/// What the blade covers on a span, but for so much.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stretch {
    /// The chord of the tip's way.
    pub(super) way: Way,
    /// How the blade is held in the middle.
    pub(super) held: Orientation,
    /// How far the tip may be off the chord, in mm.
    pub(super) tip_off: f64,
    /// The same along x, y and z.
    tip_room: [f64; 3],
    /// Half of how the blade turns: the axis times the angle in rad.
    turn: [f64; 3],
}

impl Stretch {
    /// How far the blade may be turned from how it is held in the middle, in rad.
    pub(super) fn turned(&self) -> f64 {
        length(self.turn)
    }

    /// How far a point may be off that is so far from the tip, in mm.
    pub(super) fn off(&self, from_tip: f64) -> f64 {
        self.tip_off + from_tip * self.turned()
    }

    /// How far along x, y and z a point may be off, seen from the tip as the blade is held in the middle, in mm.
    pub(super) fn room(&self, point: [f64; 3]) -> [f64; 3] {
        let turned = self.turned_room(point);
        core::array::from_fn(|axis| self.tip_room[axis] + turned[axis])
    }

    /// The same, but for how far the tip may be off.
    ///
    /// Turned by `t` about the unit vector `u`, the point `r` moves by `sin t (u x r) - (1 - cos t) (r - u (u . r))`.
    pub(super) fn turned_room(&self, point: [f64; 3]) -> [f64; 3] {
        let angle = self.turned();
        if angle == 0.0 {
            return [0.0; 3];
        }
        let about = self.turn.map(|part| part / angle);
        let [ux, uy, uz] = about;
        let [x, y, z] = point;
        let across = [uy * z - uz * y, uz * x - ux * z, ux * y - uy * x];
        let along = ux * x + uy * y + uz * z;
        core::array::from_fn(|axis| {
            let inward = point[axis] - about[axis] * along;
            across[axis].abs() * angle + inward.abs() * angle * angle / 2.0
        })
    }
}

impl Course {
    /// The course of an op that leads the tip; none of others.
    pub(super) fn of(program: &Program, segment: &Segment<'_>) -> Option<Self> {
        let line = segment.line()?;
        let blend = match segment.op.action {
            // A piece may be left at either end, so all of it counts as blended.
            Action::Follow { .. } => program.blend,
            _ => Length::ZERO,
        };
        let [from, to] = [line.from, line.to].map(|pose| program.orientation(pose.orientation));
        Some(Self::new(&line, [from?, to?], blend))
    }

    /// Along a line or an arc, between two orientations, the tip being off by no more than the blend.
    pub(super) fn new(line: &LinearSegment, [from, to]: [Orientation; 2], blend: Length) -> Self {
        let tips = match line.arc() {
            Some(arc) => Tips::Arc(arc),
            None => Tips::Line(Way {
                from: line.from.tip,
                to: line.to.tip,
            }),
        };
        Self {
            tips,
            from,
            to,
            turn: from.rotation_to(to),
            blend: blend.to_mm(),
        }
    }

    /// The straight way, if the blade keeps its orientation on one and is led along it exactly.
    pub(super) fn straight(&self) -> Option<(Way, Orientation)> {
        match self.tips {
            Tips::Line(way) if self.from == self.to && self.blend == 0.0 => Some((way, self.from)),
            Tips::Line(_) | Tips::Arc(_) => None,
        }
    }

    /// What the blade covers on a span.
    pub(super) fn stretch(&self, span: Span) -> Stretch {
        let (way, sagitta) = match self.tips {
            Tips::Line(way) => (way.part(span.from, span.to), [0.0; 3]),
            Tips::Arc(arc) => {
                let sweep = arc.sweep().to_rad();
                let [from, to] = [span.from, span.to].map(|share| point(arc.at(sweep * share)));
                // Beyond half a turn some points lie beside the chord, and nearer than this to its ends.
                let sagitta = arc.radius().to_mm() * (1.0 - libm::cos(sweep * span.half()));
                // The farthest that a unit vector in the plane of the arc leads along each axis.
                let in_plane = arc.axis().map(|part| (1.0 - part * part).max(0.0).sqrt());
                (Way { from, to }, in_plane.map(|most| sagitta * most))
            }
        };
        Stretch {
            way,
            held: self.from.towards(self.to, span.middle()),
            tip_off: length(sagitta) + self.blend,
            tip_room: sagitta.map(|off| off + self.blend),
            turn: self.turn.map(|part| part * span.half()),
        }
    }

    /// What it covers in the middle of a span, where it is off by nothing but the blend.
    pub(super) fn middle(&self, span: Span) -> Stretch {
        let middle = span.middle();
        self.stretch(Span {
            from: middle,
            to: middle,
        })
    }
}

fn point([x, y, z]: [f64; 3]) -> Point3 {
    Point3::new(x, y, z)
}

/// Courses for tests.
#[cfg(test)]
pub(super) mod samples {
    use super::Course;
    use proptest::prelude::*;
    use vcutc_backend_api::geometry::{Orientation, Point3};
    use vcutc_backend_api::ir::{OrientationId, Stock};
    use vcutc_backend_api::segments::LinearSegment;
    use vcutc_backend_api::state::TipPose;
    use vcutc_backend_api::units::{Angle, Length};
    use vcutc_geometry::curve::Point2;

    /// Height of a polyline at x; none beside it.
    pub(crate) fn height(line: &[Point2], x: f64) -> Option<f64> {
        line.windows(2).find_map(|pair| {
            (pair[0].x..=pair[1].x)
                .contains(&x)
                .then(|| pair[0].z + (pair[1].z - pair[0].z) * (x - pair[0].x) / (pair[1].x - pair[0].x))
        })
    }

    /// The stock under the courses.
    pub(crate) const STOCK: Stock = Stock {
        width: Length::mm(100.0),
        depth: Length::mm(100.0),
        height: Length::mm(60.0),
    };

    /// A course, and where its tip and its blade are at a share of it, computed apart.
    #[derive(Clone, Copy, Debug)]
    pub(crate) struct Sample {
        tips: [[f64; 3]; 3],
        is_arc: bool,
        from: Orientation,
        to: Orientation,
    }

    impl Sample {
        pub(crate) fn course(&self, blend: Length) -> Course {
            let [from, via, to] = self.tips.map(|[x, y, z]| Point3::new(x, y, z));
            let pose = |tip, number| TipPose {
                tip,
                orientation: OrientationId(number),
            };
            let line = LinearSegment {
                from: pose(from, 0),
                to: pose(to, 1),
                via: self.is_arc.then_some(via),
                turn: self.from.angle_to(self.to),
                feed: None,
                rate: None,
            };
            Course::new(&line, [self.from, self.to], blend)
        }

        /// A quarter round at a height, the blade upright and turning with it.
        pub(crate) fn level_quarter(z: f64) -> Self {
            let half = core::f64::consts::FRAC_1_SQRT_2;
            let short = 20.0 * (1.0 - half);
            Self {
                tips: [[40.0, 40.0, z], [40.0 + short, 60.0 - short, z], [60.0, 60.0, z]],
                is_arc: true,
                from: Orientation::from_quaternion(0.0, 1.0, 0.0, 0.0).unwrap(),
                to: Orientation::from_quaternion(0.0, half, half, 0.0).unwrap(),
            }
        }

        /// The tip, by a circle in the coordinates of its plane.
        pub(crate) fn tip(&self, share: f64) -> [f64; 3] {
            let [a, via, b] = self.tips;
            let minus = |p: [f64; 3], q: [f64; 3]| -> [f64; 3] { core::array::from_fn(|i| p[i] - q[i]) };
            let dot = |p: [f64; 3], q: [f64; 3]| -> f64 { (0..3).map(|i| p[i] * q[i]).sum() };
            let unit = |p: [f64; 3]| p.map(|part| part / dot(p, p).sqrt());
            if !self.is_arc {
                return core::array::from_fn(|i| a[i] + (b[i] - a[i]) * share);
            }
            let u = unit(minus(b, a));
            let off = minus(via, a);
            let v = unit(minus(off, u.map(|part| part * dot(off, u))));
            // In the plane: (0, 0), (w, 0), and the point between them at (p, q) with q > 0.
            let (w, p, q) = (dot(minus(b, a), u), dot(off, u), dot(off, v));
            let (cx, cy) = (w / 2.0, (p * p + q * q - w * p) / (2.0 * q));
            let radius = libm::hypot(cx, cy);
            let start = libm::atan2(-cy, -cx);
            // Clockwise, over the side on which q is greater than 0.
            let sweep = (start - libm::atan2(-cy, w - cx)).rem_euclid(core::f64::consts::TAU);
            let angle = start - sweep * share;
            let [x, y] = [cx + radius * libm::cos(angle), cy + radius * libm::sin(angle)];
            core::array::from_fn(|i| a[i] + u[i] * x + v[i] * y)
        }

        /// A vector of T as W sees it, turned in proportion to the way.
        pub(crate) fn seen(&self, share: f64, vector: [f64; 3]) -> [f64; 3] {
            let matrix = self.from.towards(self.to, share).matrix();
            matrix.map(|row| (0..3).map(|i| row[i] * vector[i]).sum())
        }
    }

    fn orientation() -> impl Strategy<Value = Orientation> {
        // Pointing down, and turned from there by any angles.
        (-180.0..180.0_f64, -50.0..50.0_f64, -50.0..50.0_f64).prop_map(|(a, b, c)| {
            let half = |degrees: f64| Angle::deg(degrees).to_rad() / 2.0;
            let turns = [
                [half(a), 0.0, 0.0, 1.0],
                [half(b), 0.0, 1.0, 0.0],
                [half(c), 1.0, 0.0, 0.0],
            ];
            let down = [0.0, 1.0, 0.0, 0.0];
            let [w, x, y, z] = turns.into_iter().rev().fold(down, |held, [half, x, y, z]| {
                let (sine, cosine) = libm::sincos(half);
                product([cosine, sine * x, sine * y, sine * z], held)
            });
            Orientation::from_quaternion(w, x, y, z).unwrap()
        })
    }

    fn product(a: [f64; 4], b: [f64; 4]) -> [f64; 4] {
        let [aw, ax, ay, az] = a;
        let [bw, bx, by, bz] = b;
        [
            aw * bw - ax * bx - ay * by - az * bz,
            aw * bx + ax * bw + ay * bz - az * by,
            aw * by - ax * bz + ay * bw + az * bx,
            aw * bz + ax * by - ay * bx + az * bw,
        ]
    }

    /// Courses over a stock of 100 x 100 x 60 mm, on arcs of up to 300 deg and radii up to 200 mm.
    pub(crate) fn courses() -> impl Strategy<Value = Sample> {
        let tip = || ((10.0..90.0_f64, 10.0..90.0_f64), 0.0..60.0_f64).prop_map(|((x, y), z)| [x, y, z]);
        let drawn = (
            prop::array::uniform3(tip()),
            any::<bool>(),
            orientation(),
            orientation(),
        );
        drawn
            .prop_map(|(tips, is_arc, from, to)| Sample {
                tips,
                is_arc,
                from,
                to,
            })
            .prop_filter("an arc that can be relied on", |sample| {
                let arc = vcutc_backend_api::arc::CircularArc::through(sample.tips);
                sample.from.angle_to(sample.to) < Angle::deg(150.0)
                    && (!sample.is_arc
                        || arc.is_some_and(|arc| {
                            arc.sweep() < Angle::deg(300.0) && arc.radius() < Length::mm(200.0)
                        }))
            })
    }

    proptest! {
        #[test]
        fn no_point_is_farther_off_than_its_room(
            sample in courses(),
            span in (0.0..1.0_f64, 0.0..1.0_f64),
            share in 0.0..1.0_f64,
            point in prop::array::uniform3(-50.0..50.0_f64),
        ) {
            let course = sample.course(Length::ZERO);
            let span = super::Span { from: span.0.min(span.1), to: span.0.max(span.1) };
            let stretch = course.stretch(span);
            let there = span.from + (span.to - span.from) * share;
            let (tip, off) = (sample.tip(there), sample.seen(there, point));
            let middle = sample.seen(f64::midpoint(span.from, span.to), point);
            let room = stretch.room(middle);
            // It lies no farther from some place of the chord, along all three axes at once.
            let [from, to] = [stretch.way.from, stretch.way.to].map(Point3::to_array);
            let excess = |along: f64| {
                let far = |i: usize| (tip[i] + off[i] - middle[i] - from[i] - (to[i] - from[i]) * along).abs() - room[i];
                (0..3).map(far).fold(f64::NEG_INFINITY, f64::max)
            };
            let least = (0..=4000_u32).map(|i| excess(f64::from(i) / 4000.0)).fold(f64::INFINITY, f64::min);
            prop_assert!(least <= 0.1, "{least} mm beyond");
        }
    }
}
