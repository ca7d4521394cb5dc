//! Ortho-parallel arms with a spherical wrist: their closed-form inverse kinematics, computed along a span.
//!
//! These are the formulas of [`vcutc_machine::kinematics::opw`] (Brandstötter, Angerer, Hofbaur 2014), with [`Along`] in the place
//! of numbers. Every root and arc exists on the whole span or the span is refused, so what comes out is one continuous
//! branch. Several courses are computed side by side, as lanes of a vector.

use super::bounds::Stretch;
use super::course::{CARRIED, Flange, Flight, ROUND, Shape, Span};
use super::types::{Clearance, Singularity, Violation};
use super::wide::Wide;
use core::f64::consts::PI;
use glam::DVec3;
use pulp::{Arch, Simd, WithSimd};
use vcutc_backend_api::motion::{Branch, Elbow, Shoulder, Wrist};
use vcutc_geometry::number::{Along, Held, Interval, Number};
use vcutc_machine::kinematics::opw::{Coupling, Opw};

/// The branch of an arm.
#[derive(Clone, Copy, Debug)]
pub(super) struct ArmBranch {
    pub(super) shoulder: Shoulder,
    pub(super) elbow: Elbow,
    pub(super) wrist: Wrist,
}

impl ArmBranch {
    /// None for a branch that has only a number.
    pub(super) const fn of(branch: Branch) -> Option<Self> {
        match branch {
            Branch::Arm {
                shoulder,
                elbow,
                wrist,
            } => Some(Self {
                shoulder,
                elbow,
                wrist,
            }),
            Branch::Numbered(_) => None,
        }
    }
}

impl From<ArmBranch> for Branch {
    fn from(branch: ArmBranch) -> Self {
        let ArmBranch {
            shoulder,
            elbow,
            wrist,
        } = branch;
        Self::Arm {
            shoulder,
            elbow,
            wrist,
        }
    }
}

/// How many courses are proven side by side.
pub(super) const LANES: usize = 8;

/// A number of each lane.
type Row = [f64; LANES];

/// An arm on a branch that carries the flange along spans of several courses, a lane each. It is computed with what
/// instructions the processor has. Which these are does not show in the answers, nor does what is in the other lanes: nothing is
/// reordered or fused.
#[derive(Clone, Debug)]
pub(super) struct Carrying<'a> {
    pub(super) arm: &'a Opw,
    pub(super) branch: ArmBranch,
    shape: Shape,
    carried: [Row; CARRIED],
    /// What comes on top on arcs.
    round: [Row; ROUND],
    middle: Row,
    half: Row,
    /// How many lanes are in use, from the first one on.
    lanes: usize,
    /// What the arm does on the spans.
    swept: Swept,
}

impl<'a> Carrying<'a> {
    pub(super) const fn new(arm: &'a Opw, branch: ArmBranch, shape: Shape) -> Self {
        Self {
            arm,
            branch,
            shape,
            carried: [[0.0; LANES]; CARRIED],
            round: [[0.0; LANES]; ROUND],
            middle: [0.5; LANES],
            half: [0.5; LANES],
            lanes: 0,
            swept: Swept::NOWHERE,
        }
    }

    /// Puts a course into a lane. It has the shape of all others.
    pub(super) fn take(&mut self, lane: usize, flight: &Flight) {
        let numbers = flight.carried(DVec3::new(0.0, 0.0, -self.arm.c4)).numbers();
        put_in_lane(&mut self.carried, lane, numbers);
        if let Some(numbers) = flight.round() {
            put_in_lane(&mut self.round, lane, numbers);
        }
        self.lanes = self.lanes.max(lane + 1);
    }

    /// Sets the span of a lane.
    pub(super) fn set(&mut self, lane: usize, span: Span) {
        if let (Some(middle), Some(half)) = (self.middle.get_mut(lane), self.half.get_mut(lane)) {
            (*middle, *half) = (span.middle, span.half);
        }
    }

    /// Computes what the arm does on all spans.
    pub(super) fn sweep(&mut self) {
        Arch::new().dispatch(Sweep(self));
    }

    /// What it was found to do on the span of a lane.
    pub(super) fn stretch(&self, lane: usize) -> Result<Stretch, Violation> {
        self.swept.stretch(lane)
    }
}

fn put_in_lane<const COUNT: usize>(rows: &mut [Row; COUNT], lane: usize, numbers: [f64; COUNT]) {
    for (row, number) in rows.iter_mut().zip(numbers) {
        if let Some(place) = row.get_mut(lane) {
            *place = number;
        }
    }
}

/// The computation, for any kind of vector.
struct Sweep<'c, 'a>(&'c mut Carrying<'a>);

impl WithSimd for Sweep<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self(all) = self;
        for first in (0..all.lanes).step_by(S::F64_LANES) {
            let carried = wide(simd, &all.carried, first);
            let round = match all.shape {
                Shape::Straight | Shape::Turning => None,
                Shape::Arc => Some(&wide(simd, &all.round, first)),
            };
            let middle = Wide::new(simd, rest(&all.middle, first));
            let half = Wide::new(simd, rest(&all.half, first));
            let flange = Flange::over(&carried, round, all.shape, [middle, half]);
            let posture = posture(all.arm, all.branch, &flange);
            all.swept.write(first, &posture, half);
        }
    }
}

#[inline(always)]
fn wide<S: Simd, const COUNT: usize>(simd: S, rows: &[Row; COUNT], first: usize) -> [Wide<S>; COUNT] {
    let mut all = [Wide::new(simd, &[]); COUNT];
    for (wide, row) in all.iter_mut().zip(rows) {
        *wide = Wide::new(simd, rest(row, first));
    }
    all
}

#[inline(always)]
fn rest(row: &Row, first: usize) -> &[f64] {
    row.get(first..).unwrap_or_default()
}

/// An arm along a span.
#[derive(Clone, Copy, Debug)]
struct Posture<N> {
    /// The controller's angles, each up to whole turns.
    axes: [Along<N>; 6],
    /// How near singular poses it comes: wrist, elbow, shoulder.
    clearance: [N; 3],
    refusal: Refusal<N>,
}

/// The same by parts of the course, for each lane.
#[derive(Clone, Debug)]
struct Swept {
    axes: [SweptAxis; 6],
    clearance: [Row; 3],
    refusal: Row,
}

/// An axis on the spans of all lanes.
#[derive(Clone, Copy, Debug)]
struct SweptAxis {
    begin: Interval<Row>,
    value: Interval<Row>,
    end: Interval<Row>,
    rate: Interval<Row>,
    excess: Row,
    rate_excess: Row,
}

impl Swept {
    const NOWHERE: Self = Self {
        axes: [SweptAxis {
            begin: NONE,
            value: NONE,
            end: NONE,
            rate: NONE,
            excess: [0.0; LANES],
            rate_excess: [0.0; LANES],
        }; 6],
        clearance: [[0.0; LANES]; 3],
        refusal: [OUT_OF_REACH; LANES],
    };

    /// Writes down what some lanes do.
    #[inline(always)]
    fn write<S: Simd>(&mut self, first: usize, posture: &Posture<Wide<S>>, half: Wide<S>) {
        let by_course = half.of(1.0) / half;
        for (swept, axis) in self.axes.iter_mut().zip(&posture.axes) {
            let excess = axis.bend().width();
            put_both(&mut swept.begin, first, axis.begin());
            put_both(&mut swept.value, first, axis.value());
            put_both(&mut swept.end, first, axis.end());
            put_both(&mut swept.rate, first, axis.rate().scaled(by_course));
            // A true second derivative lies somewhere in `bend`; the rest of `bend` is excess.
            put(&mut swept.excess, first, half.of(0.5) * excess);
            put(&mut swept.rate_excess, first, excess * by_course);
        }
        for (row, clearance) in self.clearance.iter_mut().zip(posture.clearance) {
            put(row, first, clearance);
        }
        put(&mut self.refusal, first, posture.refusal.0);
    }

    fn stretch(&self, lane: usize) -> Result<Stretch, Violation> {
        if let Some(violation) = violation(self.refusal[lane]) {
            return Err(violation);
        }
        let axes = &self.axes;
        let [wrist, elbow, shoulder] = self.clearance;
        Ok(Stretch {
            begin: core::array::from_fn(|axis| of_lane(&axes[axis].begin, lane)),
            value: core::array::from_fn(|axis| of_lane(&axes[axis].value, lane)),
            end: core::array::from_fn(|axis| of_lane(&axes[axis].end, lane)),
            rate: core::array::from_fn(|axis| of_lane(&axes[axis].rate, lane)),
            excess: core::array::from_fn(|axis| axes[axis].excess[lane]),
            rate_excess: core::array::from_fn(|axis| axes[axis].rate_excess[lane]),
            clearance: Clearance {
                wrist: wrist[lane],
                elbow: elbow[lane],
                shoulder: shoulder[lane],
            },
        })
    }
}

const NONE: Interval<Row> = Interval::exactly([0.0; LANES]);

const fn of_lane(rows: &Interval<Row>, lane: usize) -> Interval {
    Interval {
        low: rows.low[lane],
        high: rows.high[lane],
    }
}

#[inline(always)]
fn put_both<S: Simd>(rows: &mut Interval<Row>, first: usize, interval: Interval<Wide<S>>) {
    put(&mut rows.low, first, interval.low);
    put(&mut rows.high, first, interval.high);
}

#[inline(always)]
fn put<S: Simd>(row: &mut Row, first: usize, numbers: Wide<S>) {
    if let Some(lanes) = row.get_mut(first..first + S::F64_LANES) {
        lanes.copy_from_slice(numbers.lanes());
    }
}

/// Why a span is refused, as a number, since lanes may be refused for different reasons: 0 if it is not.
#[derive(Clone, Copy, Debug)]
struct Refusal<N>(N);

/// What a radicand that is not positive on a span means, unless it is positive nowhere.
#[derive(Clone, Copy)]
enum Near {
    Shoulder,
    Elbow,
    Wrist,
}

impl Near {
    const fn number(self) -> f64 {
        match self {
            Self::Shoulder => 2.0,
            Self::Elbow => 3.0,
            Self::Wrist => 4.0,
        }
    }
}

const OUT_OF_REACH: f64 = 1.0;

fn violation(refusal: f64) -> Option<Violation> {
    if refusal == 0.0 {
        None
    } else if refusal == Near::Shoulder.number() {
        Some(Violation::Singular(Singularity::Shoulder(0.0)))
    } else if refusal == Near::Elbow.number() {
        Some(Violation::Singular(Singularity::Elbow(0.0)))
    } else if refusal == Near::Wrist.number() {
        Some(Violation::Singular(Singularity::Wrist(0.0)))
    } else {
        Some(Violation::OutOfReach)
    }
}

impl<N: Number> Refusal<N> {
    /// The quantity; where it does not exist the span is refused, unless it was before. Where the radicand is positive nowhere, the
    /// place is out of reach.
    #[inline(always)]
    fn held(&mut self, held: Held<N>, radicand: Along<N>, near: Near) -> Along<N> {
        let zero = self.0.of(0.0);
        let why = radicand
            .value()
            .high
            .below(zero, zero.of(OUT_OF_REACH), zero.of(near.number()));
        let here = zero.below(held.exists, zero, why);
        self.0 = zero.below(self.0, self.0, here);
        held.along
    }

    /// Nothing is in reach.
    #[inline(always)]
    fn nowhere(&mut self) {
        let zero = self.0.of(0.0);
        self.0 = zero.below(self.0, self.0, zero.of(OUT_OF_REACH));
    }
}

/// The controller's angles of an arm on a span of a course, each up to whole turns; none where the span is refused.
pub(super) fn posture_on(arm: &Opw, branch: ArmBranch, flight: &Flight, span: Span) -> Option<[Along; 6]> {
    let carried = flight.carried(DVec3::new(0.0, 0.0, -arm.c4)).numbers();
    let round = flight.round();
    let flange = Flange::over(&carried, round.as_ref(), flight.shape(), [span.middle, span.half]);
    let posture = posture(arm, branch, &flange);
    violation(posture.refusal.0).is_none().then_some(posture.axes)
}

/// The posture of the arm on a branch that carries the flange along a span.
#[inline(always)]
fn posture<N: Number>(arm: &Opw, branch: ArmBranch, flange: &Flange<N>) -> Posture<N> {
    let mut refusal = Refusal(flange.point[0].value().low.of(0.0));
    let (q1, wrist_x, wrist_z) = shoulder(arm, branch.shoulder, flange, &mut refusal);
    let (q2, q3, psi) = elbow(arm, branch.elbow, wrist_x, wrist_z, &mut refusal);
    let (q4, q5, q6, bent) = wrist(arm, branch.wrist, [q1, q2 + q3], flange, &mut refusal);
    Posture {
        axes: controller_angles(arm, [q1, q2, q3, q4, q5, q6]),
        clearance: [from_line(bent), from_line(psi), least_magnitude(wrist_x)],
        refusal,
    }
}

/// Axis 1, and the wrist centre in the frame that turns with it: forward of axis 1, and upward from the root.
#[inline(always)]
fn shoulder<N: Number>(
    arm: &Opw,
    side: Shoulder,
    flange: &Flange<N>,
    refusal: &mut Refusal<N>,
) -> (Along<N>, Along<N>, Along<N>) {
    let [x, y, z] = flange.point;
    let square = (x.squared() + y.squared()).plus(-arm.b * arm.b);
    let near = Near::Shoulder;
    let distance = refusal.held(square.root(), square, near);
    let forward = match side {
        Shoulder::Front => distance,
        Shoulder::Back => -distance,
    };
    let sideways = Along::constant(square.value().low.of(arm.b));
    let turned = refusal.held(Along::arc(sideways, forward), square, near);
    let q1 = refusal.held(Along::arc(y, x), square, near) - turned;
    (q1, forward, z)
}

/// Axes 2 and 3, and the angle between the upper arm and the line from axis 3 to the wrist centre, which is signed.
#[inline(always)]
fn elbow<N: Number>(
    arm: &Opw,
    side: Elbow,
    wrist_x: Along<N>,
    wrist_z: Along<N>,
    refusal: &mut Refusal<N>,
) -> (Along<N>, Along<N>, Along<N>) {
    let (forward, up) = (wrist_x.plus(-arm.a1), wrist_z.plus(-arm.c1));
    let fore = libm::hypot(arm.a2, arm.c3);
    let scale = 1.0 / (2.0 * arm.c2 * fore);
    if !scale.is_finite() {
        refusal.nowhere();
    }
    // The law of cosines.
    let cosine = (forward.squared() + up.squared()).plus(-arm.c2 * arm.c2 - fore * fore) * scale;
    let square = (-cosine.squared()).plus(1.0);
    let near = Near::Elbow;
    let folded = refusal.held(square.root(), square, near);
    let sine = match side {
        Elbow::Forward => folded,
        Elbow::Backward => -folded,
    };
    let psi = refusal.held(Along::arc(sine, cosine), square, near);
    let line = refusal.held(Along::arc(forward, up), square, near);
    let inner = refusal.held(
        Along::arc(sine * fore, (cosine * fore).plus(arm.c2)),
        square,
        near,
    );
    let q3 = psi.plus(-libm::atan2(arm.a2, arm.c3));
    (line - inner, q3, psi)
}

/// Axes 4, 5 and 6, and by how much the hand is bent.
#[inline(always)]
fn wrist<N: Number>(
    arm: &Opw,
    side: Wrist,
    [q1, q23]: [Along<N>; 2],
    flange: &Flange<N>,
    refusal: &mut Refusal<N>,
) -> (Along<N>, Along<N>, Along<N>, Along<N>) {
    let ((sin1, cos1), (sin23, cos23)) = (q1.sin_cos(), q23.sin_cos());
    let [hand_x, hand_y, hand_z] = flange.axes;
    // In the frame that turns with axis 1, then in the forearm's.
    let tool_forward = cos1 * hand_z[0] + sin1 * hand_z[1];
    let x = cos23 * tool_forward - sin23 * hand_z[2];
    let y = cos1 * hand_z[1] - sin1 * hand_z[0];
    let z = sin23 * tool_forward + cos23 * hand_z[2];
    let square = x.squared() + y.squared();
    let near = Near::Wrist;
    let off_line = refusal.held(square.root(), square, near);
    let bent = refusal.held(Along::arc(off_line, z), square, near);
    let roll_x = sin23 * (cos1 * hand_x[0] + sin1 * hand_x[1]) + cos23 * hand_x[2];
    let roll_y = sin23 * (cos1 * hand_y[0] + sin1 * hand_y[1]) + cos23 * hand_y[2];
    // `side` is the sign of the controller's axis 5.
    let positive = match side {
        Wrist::Positive => arm.signs[4] > 0.0,
        Wrist::Negative => arm.signs[4] < 0.0,
    };
    let (q4, q5, q6) = if positive {
        (Along::arc(y, x), bent, Along::arc(roll_y, -roll_x))
    } else {
        (Along::arc(-y, -x), -bent, Along::arc(-roll_y, roll_x))
    };
    (
        refusal.held(q4, square, near),
        q5,
        refusal.held(q6, square, near),
        bent,
    )
}

#[inline(always)]
fn controller_angles<N: Number>(arm: &Opw, q: [Along<N>; 6]) -> [Along<N>; 6] {
    let mut angles = q;
    for ((angle, offset), sign) in angles.iter_mut().zip(arm.offsets).zip(arm.signs) {
        *angle = angle.plus(offset) * sign;
    }
    if arm.coupling == Coupling::Parallelogram {
        angles[2] = angles[2] + angles[1];
    }
    angles
}

/// How far an angle keeps from 0 and from half a turn.
#[inline(always)]
fn from_line<N: Number>(angle: Along<N>) -> N {
    let value = angle.value();
    let zero = value.low.of(0.0);
    // Of a negative angle that of its opposite.
    let low = value.low.below(zero, -value.high, value.low);
    let high = value.low.below(zero, -value.low, value.high);
    low.lesser(low.of(PI) - high).greater(zero)
}

#[inline(always)]
fn least_magnitude<N: Number>(quantity: Along<N>) -> N {
    let value = quantity.value();
    value.low.greater(-value.high).greater(value.low.of(0.0))
}
