//! How the blade is held: the postures of V-cutting as rotations of the blade frame T in the workpiece frame W.
//!
//! `R(alpha, sigma) = Ry(alpha) Rx(-sigma (90 deg - theta)) R0` with `R0 = [+Y +X -Z]`: swing `alpha` leans the shank
//! towards +x, rake `theta` leans it along the feed, `sigma` is the sense of the feed along y. A double-edged blade keeps
//! `x_t` towards +y on both ways; a single-edged one is turned half round about its own axis when it cuts towards -y.
//! See `docs/process.md`, "Frames and posture".

use core::ops::Range;
use glam::{DMat3, DQuat, DVec3};
use vcutc_backend_api::geometry::Orientation;
use vcutc_backend_api::ir::{Edges, Flank};
use vcutc_backend_api::units::{Angle, Length};

/// Turns up to this are made at once. Beyond it the two ways round come too near to one another for comfort: the program
/// would depend on the last digits of the angles.
const LARGEST_SINGLE_TURN: Angle = Angle::deg(150.0);

/// Into how many steps a turn is divided to see how far the blade lies over the work on the way. The edge moves by less than
/// a degree and a half a step, so between two of them it lies at most a ten-thousandth of its length further.
const TURN_STEPS: u32 = 128;

/// Shares of a swing at which turns between narrower flanks are looked at.
const LOOKED_AT: [f64; 5] = [0.0, 0.25, 0.5, 0.75, 1.0];

/// Sense of the feed along y.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Feed {
    /// Towards +y (`sigma = +1`).
    Forward,
    /// Towards -y (`sigma = -1`).
    Backward,
}

impl Feed {
    /// The other sense.
    #[must_use]
    pub const fn reversed(self) -> Self {
        match self {
            Self::Forward => Self::Backward,
            Self::Backward => Self::Forward,
        }
    }

    /// A coordinate along y as it grows along the feed.
    #[must_use]
    pub const fn along(self, y: f64) -> f64 {
        match self {
            Self::Forward => y,
            Self::Backward => -y,
        }
    }

    const fn sigma(self) -> f64 {
        match self {
            Self::Forward => 1.0,
            Self::Backward => -1.0,
        }
    }
}

/// What the postures of an operation have in common.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Holder {
    /// Half the opening angle of the V.
    pub swing: Angle,
    /// Angle between tool axis and feed.
    pub rake: Angle,
    /// Which sides of the blade cut.
    pub edges: Edges,
}

impl Holder {
    /// The posture that cuts a flank while feeding that way.
    #[must_use]
    pub fn cutting(self, flank: Flank, feed: Feed) -> Orientation {
        let alpha = match flank {
            Flank::Left => -self.swing.to_rad(),
            Flank::Right => self.swing.to_rad(),
        };
        let lean = -feed.sigma() * (core::f64::consts::FRAC_PI_2 - self.rake.to_rad());
        let held = DQuat::from_rotation_y(alpha) * DQuat::from_rotation_x(lean) * upright();
        let about_its_axis = match (self.edges, feed) {
            (Edges::Double, Feed::Forward | Feed::Backward) | (Edges::Single, Feed::Forward) => {
                DQuat::IDENTITY
            }
            (Edges::Single, Feed::Backward) => DQuat::from_rotation_z(core::f64::consts::PI),
        };
        orientation(held * about_its_axis)
    }

    /// The posture that cuts a flank along a way that rises by `slope` with y. Seen along y the flanks keep the swing, so seen
    /// along the way they open to `tan(a) = tan(swing) / cos(mu)`: the level posture of that swing, pitched about x by
    /// `mu = atan(slope)`.
    #[must_use]
    pub fn cutting_along(self, flank: Flank, feed: Feed, slope: f64) -> Orientation {
        if slope == 0.0 {
            return self.cutting(flank, feed);
        }
        let pitch = libm::atan(slope);
        let opened = Self {
            swing: Angle::rad(libm::atan(self.swing.tan() / libm::cos(pitch))),
            ..self
        };
        let [w, x, y, z] = opened.cutting(flank, feed).quaternion();
        orientation(DQuat::from_rotation_x(pitch) * DQuat::from_xyzw(x, y, z, w))
    }

    /// The posture of an upright plane turned by `yaw` about z, counter-clockwise seen from above, with the feed along the turned y.
    #[must_use]
    pub fn turned(self, yaw: Angle, feed: Feed) -> Orientation {
        let upright = Self {
            swing: Angle::ZERO,
            ..self
        };
        let [w, x, y, z] = upright.cutting(Flank::Left, feed).quaternion();
        orientation(DQuat::from_rotation_z(yaw.to_rad()) * DQuat::from_xyzw(x, y, z, w))
    }

    /// The posture by way of which a turn is made that would otherwise come near half a revolution.
    #[must_use]
    pub fn by_way_of(self, from: Orientation, to: Orientation) -> Option<Orientation> {
        (from.angle_to(to) > LARGEST_SINGLE_TURN).then(|| self.between())
    }

    /// How far an edge of that length lies over the work at most, measured along y from the tip, while the blade turns from
    /// any cut to any cut the other way.
    #[must_use]
    pub fn turning_overhang(self, edge: Length, half_apex: Angle) -> Length {
        let (left, right) = (Flank::Left, Flank::Right);
        let turns = [(left, left), (left, right), (right, left), (right, right)]
            .into_iter()
            .flat_map(|(from, to)| {
                [Feed::Forward, Feed::Backward]
                    .map(|feed| (self.cutting(from, feed), self.cutting(to, feed.reversed())))
            });
        edge * self.widest_sweep(turns, half_apex)
    }

    /// The same between cuts at any swings up to its own, each flank at another: as far as at those that are looked at.
    #[must_use]
    pub fn overhang_up_to_its_swing(self, edge: Length, half_apex: Angle) -> Length {
        let flanks = LOOKED_AT.into_iter().flat_map(|share| {
            let narrower = Self {
                swing: self.swing * share,
                ..self
            };
            [Flank::Left, Flank::Right].map(|flank| (narrower, flank))
        });
        let flanks: Vec<(Self, Flank)> = flanks.collect();
        let turns = flanks.iter().flat_map(|&(before, from)| {
            flanks.iter().flat_map(move |&(after, to)| {
                [Feed::Forward, Feed::Backward]
                    .map(|feed| (before.cutting(from, feed), after.cutting(to, feed.reversed())))
            })
        });
        edge * self.widest_sweep(turns, half_apex)
    }

    /// The largest share of its length by which an edge reaches along y during some turns.
    fn widest_sweep(self, turns: impl Iterator<Item = (Orientation, Orientation)>, half_apex: Angle) -> f64 {
        turns
            .map(|(from, to)| match self.by_way_of(from, to) {
                Some(between) => sweep(from, between, half_apex).max(sweep(between, to, half_apex)),
                None => sweep(from, to, half_apex),
            })
            .fold(0.0, f64::max)
    }

    /// The posture by way of which a turn of nearly half a revolution is made, so that there is only one way round each
    /// half: upright, and for a single edge a quarter turned about the blade's own axis. There and back go the same way, so
    /// that no turn winds up the blade's cable.
    fn between(self) -> Orientation {
        let quarter = match self.edges {
            Edges::Double => DQuat::IDENTITY,
            Edges::Single => DQuat::from_rotation_z(core::f64::consts::FRAC_PI_2),
        };
        orientation(upright() * quarter)
    }
}

/// The largest share of its length by which an edge reaches along y during a turn about one axis.
fn sweep(from: Orientation, to: Orientation, half_apex: Angle) -> f64 {
    let quaternion = |o: Orientation| {
        let [w, x, y, z] = o.quaternion();
        DQuat::from_xyzw(x, y, z, w)
    };
    let (from, to) = (quaternion(from), quaternion(to));
    // From the tip along either edge, in the blade frame.
    let edges = [-1.0, 1.0].map(|side| DVec3::new(side * half_apex.sin(), 0.0, -half_apex.cos()));
    let reach = |edge: DVec3, step: u32| {
        let held = from.slerp(to, f64::from(step) / f64::from(TURN_STEPS));
        (held * edge).y.abs()
    };
    let at = |step: u32| {
        edges
            .map(|edge| reach(edge, step))
            .into_iter()
            .fold(0.0, f64::max)
    };
    let ends = at(0).max(at(TURN_STEPS));
    let between = edges
        .into_iter()
        .flat_map(|edge| {
            let steps = peaks(from, to, edge).into_iter().flatten();
            steps.map(move |step| reach(edge, step))
        })
        .fold(0.0, f64::max);
    if between > ends { between + 1e-4 } else { ends }
}

/// Steps of a turn among which is the one, ends apart, where an edge reaches farthest along y, if it reaches farther there than at
/// the ends: those about the places where its way along y turns round, or all.
///
/// About a fixed axis that way is `a + r cos(angle t - phase)`; it turns round where the cosine is 1 or -1.
fn peaks(from: DQuat, to: DQuat, edge: DVec3) -> [Range<u32>; 4] {
    // The shorter way, as slerp goes it; both seen from where the turn begins.
    let to = if from.dot(to) < 0.0 { -to } else { to };
    let turn = from.conjugate() * to;
    let along_y = from.conjugate() * DVec3::Y;
    let sine = turn.xyz().length();
    let axis = turn.xyz() / sine.max(f64::MIN_POSITIVE);
    let angle = 2.0 * libm::atan2(sine, turn.w);
    let on_cosine = along_y.dot(edge) - along_y.dot(axis) * axis.dot(edge);
    let on_sine = along_y.dot(axis.cross(edge));
    // Where almost nothing moves, rounding says which step is the farthest.
    let is_plain = angle > 0.01 && libm::hypot(on_cosine, on_sine) > 1e-4;
    if !is_plain {
        return [1..TURN_STEPS, 0..0, 0..0, 0..0];
    }
    let phase = libm::atan2(on_sine, on_cosine);
    let steps_of = f64::from(TURN_STEPS) / angle;
    // Phase and angle are within half a turn, so no other half turns lie on the way.
    [-1.0, 0.0, 1.0, 2.0].map(|half_turns| {
        let step = (half_turns * core::f64::consts::PI + phase) * steps_of;
        clamped(step - 1.5).max(1)..clamped(step + 2.5).min(TURN_STEPS)
    })
}

/// A step as a whole number, none below the first and above the last one.
fn clamped(step: f64) -> u32 {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "between the first step and the last one"
    )]
    let whole = step.clamp(0.0, f64::from(TURN_STEPS)) as u32;
    whole
}

/// `R0`: blade over the work, tip down, leading side towards +y.
/// How a blade that spins is held upright: all operations hold it alike.
#[must_use]
pub fn spinning_upright() -> Orientation {
    let holder = Holder {
        swing: Angle::ZERO,
        rake: Angle::deg(90.0),
        edges: Edges::Double,
    };
    holder.cutting(Flank::Left, Feed::Forward)
}

fn upright() -> DQuat {
    DQuat::from_mat3(&DMat3::from_cols(DVec3::Y, DVec3::X, DVec3::NEG_Z))
}

fn orientation(q: DQuat) -> Orientation {
    // Products of unit quaternions are never zero.
    Orientation::from_quaternion(q.w, q.x, q.y, q.z).unwrap_or(Orientation::IDENTITY)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Matrix3, Rotation3, Vector3};
    use proptest::prelude::*;

    const PAPER: Holder = Holder {
        swing: Angle::deg(34.16),
        rake: Angle::deg(60.0),
        edges: Edges::Double,
    };

    /// The formula of `docs/process.md`, "Frames and posture", by another crate.
    fn by_matrices(alpha: f64, theta: f64, sigma: f64) -> Matrix3<f64> {
        let r0 = Matrix3::from_columns(&[Vector3::y(), Vector3::x(), -Vector3::z()]);
        let about_x = Rotation3::from_axis_angle(
            &Vector3::x_axis(),
            -sigma * (core::f64::consts::FRAC_PI_2 - theta),
        );
        let about_y = Rotation3::from_axis_angle(&Vector3::y_axis(), alpha);
        about_y.matrix() * about_x.matrix() * r0
    }

    /// As [`sweep`], by looking at every step.
    fn sweep_by_all_steps(from: Orientation, to: Orientation, half_apex: Angle) -> f64 {
        let quaternion = |o: Orientation| {
            let [w, x, y, z] = o.quaternion();
            DQuat::from_xyzw(x, y, z, w)
        };
        let at = |step: u32| {
            let held = quaternion(from).slerp(quaternion(to), f64::from(step) / f64::from(TURN_STEPS));
            [-1.0, 1.0]
                .map(|side| {
                    (held * DVec3::new(side * half_apex.sin(), 0.0, -half_apex.cos()))
                        .y
                        .abs()
                })
                .into_iter()
                .fold(0.0, f64::max)
        };
        let ends = at(0).max(at(TURN_STEPS));
        let between = (1..TURN_STEPS).map(at).fold(0.0, f64::max);
        if between > ends { between + 1e-4 } else { ends }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]

        #[test]
        fn the_farthest_step_is_among_those_that_are_looked_at(
            swing in 0.5..89.0_f64, rake in prop_oneof![10.0..=90.0_f64, Just(90.0), Just(60.0)],
            half_apex in prop_oneof![0.0..20.0_f64, Just(0.0)], single: bool,
        ) {
            let edges = if single { Edges::Single } else { Edges::Double };
            let holder = Holder { swing: Angle::deg(swing), rake: Angle::deg(rake), edges };
            let half_apex = Angle::deg(half_apex);
            let postures = [Flank::Left, Flank::Right]
                .into_iter()
                .flat_map(|flank| [Feed::Forward, Feed::Backward].map(|feed| holder.cutting(flank, feed)))
                .chain([holder.between()]);
            let postures: Vec<Orientation> = postures.collect();
            for from in &postures {
                for to in &postures {
                    prop_assert_eq!(
                        sweep(*from, *to, half_apex).to_bits(),
                        sweep_by_all_steps(*from, *to, half_apex).to_bits()
                    );
                }
            }
        }
    }

    /// Numbers of pitched cuts that were computed by independent scripts: rake 60 deg, swing 35 deg, at slopes of 0, 5 and 10 deg.
    #[test]
    fn pitched_blades_are_held_as_published() {
        let holder = Holder {
            swing: Angle::deg(35.0),
            rake: Angle::deg(60.0),
            edges: Edges::Double,
        };
        for (pitch, opened, turn) in [
            (0.0, 35.0, 89.626_709),
            (5.0, 35.102_702, 89.771_567),
            (10.0, 35.413_183, 90.210_619),
        ] {
            let slope = Angle::deg(pitch).tan();
            let held = |flank, feed| holder.cutting_along(flank, feed, slope);
            let right = held(Flank::Right, Feed::Forward);
            // Seen along the way, the plane leans by the opened swing.
            let m = right.matrix();
            let normal = DVec3::new(m[0][1], m[1][1], m[2][1]);
            let (rise, level) = libm::sincos(Angle::deg(pitch).to_rad());
            let way = DVec3::new(0.0, level, rise);
            assert!(normal.dot(way).abs() < 1e-12);
            let lean = libm::asin(normal.dot(DVec3::X)).to_degrees();
            assert!(
                (90.0 - lean - opened).abs() < 1e-6 || (lean - (90.0 - opened)).abs() < 1e-6,
                "{lean}"
            );
            // Seen along y its flank rises by cot(35 deg) all the same.
            let rise = -normal.x / normal.z;
            assert!((rise - 1.0 / Angle::deg(35.0).tan()).abs() < 1e-12, "{rise}");
            let turned = held(Flank::Left, Feed::Forward).angle_to(held(Flank::Right, Feed::Backward));
            assert!((turned.to_deg() - turn).abs() < 1e-6, "{turned:?}");
        }
        let m = holder
            .cutting_along(Flank::Right, Feed::Forward, Angle::deg(5.0).tan())
            .matrix();
        let shank = [-m[0][2], -m[1][2], -m[2][2]];
        for (ours, published) in shank.into_iter().zip([0.498_002_57, 0.436_346_20, 0.749_396_72]) {
            assert!((ours - published).abs() < 1e-8, "{shank:?}");
        }
    }

    /// An edge of 40 mm reaches 28.76 mm ahead where it goes down by 11.3 deg, so that in a valley of radius 1000 mm a flank lies
    /// 0.4137 mm below the V of its tip.
    #[test]
    fn a_pitched_edge_reaches_as_far_ahead_as_published() {
        let holder = Holder {
            swing: Angle::deg(35.0),
            rake: Angle::deg(60.0),
            edges: Edges::Double,
        };
        let slope = -Angle::deg(11.3).tan();
        let m = holder.cutting_along(Flank::Right, Feed::Forward, slope).matrix();
        let (sine, cosine) = libm::sincos(Angle::deg(7.13).to_rad());
        let ahead = [-1.0, 1.0].map(|side| 40.0 * (m[1][0] * side * sine - m[1][2] * cosine));
        let ahead = ahead.into_iter().fold(0.0, f64::max);
        assert!((ahead * ahead / 2000.0 - 0.4137).abs() < 2e-4, "{ahead}");
    }

    proptest! {
        #[test]
        fn follows_the_formula(swing in 1.0..80.0_f64, rake in 10.0..=90.0_f64, right: bool, forward: bool) {
            let holder = Holder { swing: Angle::deg(swing), rake: Angle::deg(rake), edges: Edges::Double };
            let (flank, alpha) = if right { (Flank::Right, swing) } else { (Flank::Left, -swing) };
            let (feed, sigma) = if forward { (Feed::Forward, 1.0) } else { (Feed::Backward, -1.0) };
            let ours = holder.cutting(flank, feed).matrix();
            let theirs = by_matrices(alpha.to_radians(), rake.to_radians(), sigma);
            for (row, ours) in ours.iter().enumerate() {
                for (column, ours) in ours.iter().enumerate() {
                    prop_assert!((ours - theirs[(row, column)]).abs() < 1e-12);
                }
            }
        }

        #[test]
        fn turns_by_the_angle_of_the_paper(swing in 1.0..80.0_f64, rake in 10.0..=90.0_f64) {
            // [Cui 9]: 2 acos(cos(alpha) sin(theta)).
            let (swing, rake) = (Angle::deg(swing), Angle::deg(rake));
            let holder = Holder { swing, rake, edges: Edges::Double };
            let turn = holder.cutting(Flank::Left, Feed::Forward).angle_to(holder.cutting(Flank::Right, Feed::Backward));
            let paper = 2.0 * libm::acos(swing.cos() * rake.sin());
            prop_assert!((turn.to_rad() - paper).abs() < 1e-7);
        }

        #[test]
        fn turns_by_way_of_the_posture_between_are_unambiguous(swing in 1.0..80.0_f64, rake in 10.0..=90.0_f64, single: bool) {
            let edges = if single { Edges::Single } else { Edges::Double };
            let holder = Holder { swing: Angle::deg(swing), rake: Angle::deg(rake), edges };
            for flank in [Flank::Left, Flank::Right] {
                for feed in [Feed::Forward, Feed::Backward] {
                    prop_assert!(holder.cutting(flank, feed).angle_to(holder.between()).to_deg() < 170.0);
                }
            }
        }

        #[test]
        fn double_edges_lie_farthest_over_the_work_when_they_cut(swing in 1.0..70.0_f64, rake in 30.0..=90.0_f64, half_apex in 1.0..15.0_f64) {
            let (rake, half_apex) = (Angle::deg(rake), Angle::deg(half_apex));
            let holder = Holder { swing: Angle::deg(swing), rake, edges: Edges::Double };
            let overhang = holder.turning_overhang(Length::mm(10.0), half_apex).to_mm();
            // [Cui 5].
            prop_assert!((overhang - 10.0 * (rake - half_apex).cos()).abs() < 2e-3);
        }

        #[test]
        fn turns_between_narrower_flanks_stay_within_the_overhang(
            swing in 1.0..80.0_f64, shares in prop::array::uniform2(0.0..=1.0_f64), rake in 10.0..=90.0_f64,
            half_apex in 0.0..20.0_f64, single: bool,
        ) {
            let edges = if single { Edges::Single } else { Edges::Double };
            let half_apex = Angle::deg(half_apex);
            let at = |share: f64| Holder { swing: Angle::deg(swing * share), rake: Angle::deg(rake), edges };
            let most = at(1.0).overhang_up_to_its_swing(Length::mm(1.0), half_apex).to_mm();
            for from in [Flank::Left, Flank::Right] {
                for to in [Flank::Left, Flank::Right] {
                    for feed in [Feed::Forward, Feed::Backward] {
                        let (from, to) = (at(shares[0]).cutting(from, feed), at(shares[1]).cutting(to, feed.reversed()));
                        let turn = at(1.0).widest_sweep(core::iter::once((from, to)), half_apex);
                        prop_assert!(turn <= most + 0.01, "{turn} {most}");
                    }
                }
            }
        }

        #[test]
        fn single_edges_lead_both_ways(swing in 1.0..80.0_f64, rake in 10.0..=90.0_f64) {
            let holder = Holder { swing: Angle::deg(swing), rake: Angle::deg(rake), edges: Edges::Single };
            // The leading side points along the feed both ways.
            for (feed, sign) in [(Feed::Forward, 1.0), (Feed::Backward, -1.0)] {
                prop_assert!(holder.cutting(Flank::Left, feed).matrix()[1][0] * sign > 0.0);
            }
        }
    }

    #[test]
    fn the_papers_turn_is_88_4_degrees() {
        let turn = PAPER
            .cutting(Flank::Left, Feed::Forward)
            .angle_to(PAPER.cutting(Flank::Right, Feed::Backward));
        assert!((turn.to_deg() - 88.4).abs() < 0.05, "{}", turn.to_deg());
    }
}
