//! Arms without a closed form: enclosures of what the Jacobian makes of the course.
//!
//! With `v` the twist of the blade about its tip, the axes follow `q' = J(q)^-1 v`. On a line the twist is constant. On an arc
//! its angular part is, and its linear part goes round with the tangent: `v` then stands for the box of all twists on a span.
//! Let `A` be some matrix near `J^-1`, `Q` a box of axis values, and `N` an interval matrix with `I - A J(q)` in it for all
//! `q` of `Q`. From `J q' = v` follows `q' = A v + N q'`. If the row sums of `N` are at most `b < 1`, then `J(q)` is regular on
//! `Q`, no axis is faster there than `|A v| / (1 - b)`, and putting that in on the right gives the box `D` of all rates.
//!
//! **A span.** If `q` at its beginning, plus `D` times its length, lies inside of `Q`, then the axes cannot leave `Q` on the
//! span: they would have to be faster before. So on the span there is one continuous motion, its values are in
//! `q + D [0, length]` and its rates in `D` (the first step of Lohner's method for differential equations; Moore, Kearfott,
//! Cloud 2009, chapter 10).
//!
//! **To the second order.** From `J q' = v` follows `J q'' = v' - J' q'`, which the same argument encloses; `v'` is zero on a
//! line, and on an arc it points to the centre. Then rates lie in `q'(begin) + q'' [0, length]`, and values correspondingly,
//! both with an excess that fades with the square of the length.
//!
//! **The end.** Newton's method improves the end, and the same contraction, on the box that is known to have the true end
//! and the improved one, shows that they are the same but for rounding: the pose, as position of the tip and as the vector
//! `w` of the skew part of `R_end^T R(q)`, has a derivative by `q` that differs from `J` in its angular rows by a factor
//! that is no further from `I` than the angle through which the box can turn the blade. Where that still contracts, the pose
//! is reached once in the box only.
//!
//! **The start** is verified in the same way, so that the axes truly begin within 1e-8 rad of where they are said to.
//!
//! **Singular poses.** On a proven span the Jacobian is regular, so that no singular pose is met. How near one is is not
//! measured: the clearance that is reported is unlimited, and the least one that was asked for is not checked. What keeps these arms away
//! from singular poses is the rates of their axes.

use super::bounds::Stretch;
use super::course::{Flight, Span};
use super::types::{Clearance, Violation};
use glam::DVec3;
use vcutc_backend_api::ir::MOST_AXES;
use vcutc_geometry::number::Interval;
use vcutc_machine::kinematics::pose::Pose;
use vcutc_machine::kinematics::serial::SerialArm;
use vcutc_machine::kinematics::{Joints, newton};

/// How far found axis values may be from the true ones, in rad.
pub(super) const UNCERTAIN: f64 = 1e-8;
/// Most that `N` may have as a row sum: beyond it bounds are of little use.
const LARGEST_DEFECT: f64 = 0.6;

pub(super) type Box6 = [Interval; MOST_AXES];
pub(super) type Vector = [Interval; 3];
type Matrix = [Vector; 3];
pub(super) type Square = [[f64; MOST_AXES]; MOST_AXES];
/// A column of numbers: a twist, or rates of the axes.
type Column = [f64; MOST_AXES];

/// Axis values that bring the flange to a place of the course, to the last digits, if those given do so nearly.
pub(super) fn verified(arm: &SerialArm, flight: &Flight, place: f64, given: &Joints) -> Option<Joints> {
    let tip_in_flange = flight.tip_in_flange();
    let contraction = Contraction {
        arm,
        near_inverse: inverse_at(arm, given, tip_in_flange)?,
        tip_in_flange,
    };
    let known = given.map(|value| Interval::around(value, UNCERTAIN));
    contraction.improved(&known, &flight.flange_at(place))
}

/// What the axes do on a span that they enter at `begin`, proven.
pub(super) fn stretch(
    arm: &SerialArm,
    flight: &Flight,
    span: Span,
    begin: &Joints,
) -> Result<Stretch, Violation> {
    span_of(arm, flight, span, begin).ok_or(Violation::OutOfReach)
}

fn span_of(arm: &SerialArm, flight: &Flight, span: Span, begin: &Joints) -> Option<Stretch> {
    let length = 2.0 * span.half;
    let spin = flight.spin();
    let twist_at = |place: f64| column(flight.velocity_at(place), spin);
    let twist = twist_at(span.middle);
    let tip_in_flange = flight.tip_in_flange();
    let first = inverse_at(arm, begin, tip_in_flange)?;
    let ahead: Joints = core::array::from_fn(|i| begin[i] + times(&first, &twist)[i] * span.half);
    let near_inverse = inverse_at(arm, &ahead, tip_in_flange)?;
    let straight = times(&near_inverse, &twist);
    let contraction = Contraction {
        arm,
        near_inverse,
        tip_in_flange,
    };

    let begin_box = begin.map(|value| Interval::around(value, UNCERTAIN));
    let course_tip = flight.tip_over(span);
    let velocity = flight.velocity_over(span);
    let twists = six(velocity, exactly(spin));
    let first_twist = six(
        flight.velocity_over(at_once(span.middle - span.half)),
        exactly(spin),
    );
    let moved = |rates: &Box6| -> Box6 {
        core::array::from_fn(|i| {
            begin_box[i]
                + rates[i]
                    * Interval {
                        low: 0.0,
                        high: length,
                    }
        })
    };
    let room = 0.1 * length * straight.iter().fold(0.0, |most: f64, rate| most.max(rate.abs()));
    let guess: Box6 = core::array::from_fn(|i| {
        let way = Interval::exactly(straight[i] * length) * Interval { low: -0.2, high: 1.2 };
        begin_box[i] + way + Interval::around(0.0, room + UNCERTAIN)
    });
    let rates = contraction.rates(&guess, &course_tip, &twists)?;
    let value = moved(&rates);
    if !(0..MOST_AXES).all(|i| value[i].within(guess[i].low, guess[i].high)) {
        return None;
    }
    // Once more in the smaller box, and then to the second order.
    let rates = contraction.rates(&value, &course_tip, &twists)?;
    let value = moved(&rates);
    let first_rates = contraction.rates(&begin_box, &course_tip, &first_twist)?;
    let changes = six(flight.acceleration_over(span), [Interval::ZERO; 3]);
    let bends = contraction.bends(&value, &course_tip, &rates, &velocity, &changes)?;
    let (whole, half_square) = (
        Interval {
            low: 0.0,
            high: length,
        },
        Interval {
            low: 0.0,
            high: 0.5 * length * length,
        },
    );
    let by_bends = |time: Interval, square: Interval| -> Box6 {
        core::array::from_fn(|i| begin_box[i] + first_rates[i] * time + bends[i] * square)
    };
    let at_end = by_bends(Interval::exactly(whole.high), Interval::exactly(half_square.high));
    let tighter = by_bends(whole, half_square);
    let end = contraction.improved(&at_end, &flight.flange_at(span.middle + span.half))?;
    Some(Stretch {
        begin: begin_box,
        value: core::array::from_fn(|i| value[i].and(tighter[i])),
        end: end.map(|value| Interval::around(value, UNCERTAIN)),
        rate: core::array::from_fn(|i| rates[i].and(first_rates[i] + bends[i] * whole)),
        excess: bends.map(|bend| bend.width() * half_square.high),
        rate_excess: bends.map(|bend| bend.width() * length),
        clearance: Clearance::UNLIMITED,
    })
}

/// An arm and a matrix that is nearly the inverse of its Jacobian, about the tip.
struct Contraction<'m> {
    arm: &'m SerialArm,
    near_inverse: Square,
    tip_in_flange: DVec3,
}

impl Contraction<'_> {
    /// All rates with which the axes can follow the twists of a box while they are in a box and the tip in another.
    fn rates(&self, joints: &Box6, tip: &Vector, twists: &Box6) -> Option<Box6> {
        let lines = Lines::of(self.arm, joints, self.tip_in_flange);
        let tip = core::array::from_fn(|i| lines.tip[i].and(tip[i]));
        self.solved(&lines, &tip, twists)
    }

    /// All second derivatives of axes that move in a box at rates in another, by the course; `velocity` is the tip's, and the
    /// twist changes by `changes`.
    fn bends(
        &self,
        joints: &Box6,
        tip: &Vector,
        rates: &Box6,
        velocity: &Vector,
        changes: &Box6,
    ) -> Option<Box6> {
        let lines = Lines::of(self.arm, joints, self.tip_in_flange);
        let tip = core::array::from_fn(|i| lines.tip[i].and(tip[i]));
        // Of (J q')' = v': J q'' = v' - J' q'.
        let turns = self.arm.turns_of(*rates, |third, second| third - second);
        let bias = lines.bias(&turns, &tip, velocity);
        let wanted = core::array::from_fn(|i| changes[i] - bias[i]);
        self.solved(&lines, &tip, &wanted)
    }

    /// All solutions `x` of `J x = wanted` for the Jacobians of the lines.
    fn solved(&self, lines: &Lines, tip: &Vector, wanted: &Box6) -> Option<Box6> {
        let defect = self.defect(&lines.jacobian(self.arm, tip));
        let largest = row_sum(&defect);
        if largest.is_nan() || largest > LARGEST_DEFECT {
            return None;
        }
        let straight: Box6 = core::array::from_fn(|i| {
            (0..MOST_AXES).fold(Interval::ZERO, |sum, k| sum + wanted[k] * self.near_inverse[i][k])
        });
        let most = straight
            .iter()
            .fold(0.0, |most: f64, part| most.max(part.magnitude()));
        let mut solution = [Interval::around(0.0, most / (1.0 - largest)); MOST_AXES];
        for _ in 0..3 {
            solution = core::array::from_fn(|i| {
                let more = (0..MOST_AXES).fold(Interval::ZERO, |sum, j| sum + defect[i][j] * solution[j]);
                (straight[i] + more).and(solution[i])
            });
        }
        Some(solution)
    }

    /// The axis values at a pose, to the last digits, when they are known to be in a box.
    fn improved(&self, known: &Box6, flange_in_root: &Pose) -> Option<Joints> {
        let found = newton::refine(self.arm, flange_in_root, &known.map(Interval::middle))?;
        let both: Box6 = core::array::from_fn(|i| known[i].hull(Interval::around(found[i], UNCERTAIN)));
        let lines = Lines::of(self.arm, &both, self.tip_in_flange);
        let defect = row_sum(&self.defect(&lines.jacobian(self.arm, &lines.tip)));
        let turn: f64 = both.iter().map(|value| value.width()).sum();
        let (by_length, by_angle) = self.sensitivity();
        let contracts = defect + 6.0 * by_angle * turn;
        let (apart, turned) = self.arm.forward(&found).apart(flange_in_root);
        let reach = self.tip_in_flange.length();
        let off = (by_length * (apart + reach * turned) + by_angle * turned) / (1.0 - contracts);
        (contracts <= LARGEST_DEFECT && off <= UNCERTAIN).then_some(found)
    }

    /// `I - A J`.
    fn defect(&self, jacobian: &[Box6; MOST_AXES]) -> [Box6; MOST_AXES] {
        core::array::from_fn(|i| {
            core::array::from_fn(|j| {
                let one = Interval::exactly(f64::from(u8::from(i == j)));
                (0..MOST_AXES).fold(one, |sum, k| sum - jacobian[k][j] * self.near_inverse[i][k])
            })
        })
    }

    /// By how much, at most, an axis turns for a mm, and for a rad.
    fn sensitivity(&self) -> (f64, f64) {
        let most = |columns: [usize; 3]| {
            (0..MOST_AXES)
                .map(|i| columns.iter().map(|k| self.near_inverse[i][*k].abs()).sum())
                .fold(0.0, f64::max)
        };
        (most([0, 1, 2]), most([3, 4, 5]))
    }
}

/// The lines of an arm's joints where boxes of joint values bring them, and the tip.
pub(super) struct Lines {
    pub(super) points: [Vector; MOST_AXES],
    pub(super) directions: [Vector; MOST_AXES],
    pub(super) tip: Vector,
}

impl Lines {
    pub(super) fn of(arm: &SerialArm, joints: &Box6, tip_in_flange: DVec3) -> Self {
        let turns = arm.turns_of(*joints, |third, second| third - second);
        let mut rotation =
            [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|row| row.map(Interval::exactly));
        let mut position = [Interval::ZERO; 3];
        let mut lines = Self {
            points: [[Interval::ZERO; 3]; MOST_AXES],
            directions: [[Interval::ZERO; 3]; MOST_AXES],
            tip: [Interval::ZERO; 3],
        };
        for (i, (axis, turn)) in arm.axes().iter().zip(turns).enumerate() {
            let point = exactly(axis.point);
            lines.directions[i] = turned(&rotation, &exactly(axis.direction));
            lines.points[i] = plus(&turned(&rotation, &point), &position);
            let about = about(axis.direction, turn);
            let shift = minus(&point, &turned(&about, &point));
            position = plus(&turned(&rotation, &shift), &position);
            rotation = product(&rotation, &about);
        }
        let at_zero = arm.flange_at_zero();
        let tip = exactly(at_zero.rotation * tip_in_flange + at_zero.position);
        lines.tip = plus(&turned(&rotation, &tip), &position);
        lines
    }

    /// `J' q'`: what the twist changes by while the joints turn at constant rates and the tip has the given velocity.
    fn bias(&self, turns: &Box6, tip: &Vector, velocity: &Vector) -> Box6 {
        let (mut linear, mut angular) = ([Interval::ZERO; 3], [Interval::ZERO; 3]);
        for (i, turn) in turns.iter().enumerate() {
            let (direction, point) = (&self.directions[i], &self.points[i]);
            let (mut spin, mut drift) = ([Interval::ZERO; 3], [Interval::ZERO; 3]);
            for (k, carried_by) in turns.iter().enumerate().take(i) {
                let about = scaled(&self.directions[k], *carried_by);
                spin = plus(&spin, &about);
                drift = plus(&drift, &cross(&about, &minus(point, &self.points[k])));
            }
            let tilts = cross(&spin, direction);
            let sweep = plus(
                &cross(&tilts, &minus(tip, point)),
                &cross(direction, &minus(velocity, &drift)),
            );
            linear = plus(&linear, &scaled(&sweep, *turn));
            angular = plus(&angular, &scaled(&tilts, *turn));
        }
        [
            linear[0], linear[1], linear[2], angular[0], angular[1], angular[2],
        ]
    }

    /// Rows of linear velocity of the tip above rows of angular velocity; a column for each of the controller's joints.
    fn jacobian(&self, arm: &SerialArm, tip: &Vector) -> [Box6; MOST_AXES] {
        let by_turn: [Box6; MOST_AXES] = core::array::from_fn(|i| {
            let angular = self.directions[i];
            let linear = cross(&angular, &minus(tip, &self.points[i]));
            [
                linear[0], linear[1], linear[2], angular[0], angular[1], angular[2],
            ]
        });
        let by_joint: [Box6; MOST_AXES] = core::array::from_fn(|j| {
            let mut only = [0.0; MOST_AXES];
            only[j] = 1.0;
            let turns = arm.turns_of(only, |third, second| third - second);
            core::array::from_fn(|row| {
                (0..MOST_AXES)
                    .filter(|i| turns[*i] != 0.0)
                    .fold(Interval::ZERO, |sum, i| sum + by_turn[i][row] * turns[i])
            })
        });
        core::array::from_fn(|row| core::array::from_fn(|j| by_joint[j][row]))
    }
}

/// The inverse of the Jacobian at axis values, as far as floating point gives it.
pub(super) fn inverse_at(arm: &SerialArm, joints: &Joints, tip_in_flange: DVec3) -> Option<Square> {
    let inverse = arm.jacobian(joints, tip_in_flange).inverse()?;
    let is_moderate = inverse.iter().flatten().all(|entry| entry.abs() < 1e9);
    is_moderate.then_some(inverse)
}

fn times(matrix: &Square, vector: &Column) -> Column {
    core::array::from_fn(|i| (0..MOST_AXES).map(|k| matrix[i][k] * vector[k]).sum())
}

fn row_sum(matrix: &[Box6; MOST_AXES]) -> f64 {
    matrix
        .iter()
        .map(|row| row.iter().map(|entry| entry.magnitude()).sum())
        .fold(0.0, f64::max)
}

/// A twist of its linear and its angular part.
fn column(linear: DVec3, angular: DVec3) -> Column {
    [linear.x, linear.y, linear.z, angular.x, angular.y, angular.z]
}

fn six(linear: Vector, angular: Vector) -> Box6 {
    core::array::from_fn(|i| if i < 3 { linear[i] } else { angular[i - 3] })
}

/// The span of one place.
const fn at_once(place: f64) -> Span {
    Span {
        middle: place,
        half: 0.0,
    }
}

fn exactly(vector: DVec3) -> Vector {
    vector.to_array().map(Interval::exactly)
}

fn plus(a: &Vector, b: &Vector) -> Vector {
    core::array::from_fn(|i| a[i] + b[i])
}

fn minus(a: &Vector, b: &Vector) -> Vector {
    core::array::from_fn(|i| a[i] - b[i])
}

fn scaled(a: &Vector, by: Interval) -> Vector {
    a.map(|part| part * by)
}

fn cross(a: &Vector, b: &Vector) -> Vector {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

fn turned(matrix: &Matrix, vector: &Vector) -> Vector {
    matrix.map(|row| row[0] * vector[0] + row[1] * vector[1] + row[2] * vector[2])
}

fn product(a: &Matrix, b: &Matrix) -> Matrix {
    a.map(|row| core::array::from_fn(|j| row[0] * b[0][j] + row[1] * b[1][j] + row[2] * b[2][j]))
}

/// The rotation about a direction through the origin, by Rodrigues' formula.
fn about(direction: DVec3, angle: Interval) -> Matrix {
    let (sin, cos) = angle.sin_cos();
    let k = direction.to_array();
    let cross = [[0.0, -k[2], k[1]], [k[2], 0.0, -k[0]], [-k[1], k[0], 0.0]];
    core::array::from_fn(|i| {
        core::array::from_fn(|j| {
            let along = k[i] * k[j];
            let across = f64::from(u8::from(i == j)) - along;
            Interval::exactly(along) + cos * across + sin * cross[i][j]
        })
    })
}
