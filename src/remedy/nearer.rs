//! The base straight to where the machine works, for work that is so far away that steps around its place lead nowhere.

use crate::base::{Shift, confirmed, nearest};
use crate::case::Case;
use crate::change::{Change, Elsewhere};
use vcutc_backend_api::geometry::{Frame, Point3};
use vcutc_backend_api::ir::{Axis, AxisKind, MachineKind, PlacedFrame, Stock};
use vcutc_backend_api::units::Length;
use vcutc_job::{CheckedJob, Machine};
use vcutc_machine::kinematics::Joints;
use vcutc_motion::rig::Rig;

/// The base straight to where the machine works.
pub(crate) fn nearer(case: &mut Case<'_>) -> Option<Change> {
    match case.machine.model.kind() {
        MachineKind::Robot => towards_the_arm(case),
        MachineKind::FiveAxis => into_the_range(case),
    }
}

/// Distances of the work's middle from the first axis of an arm, as shares of its reach, the farthest first.
const AWAY: [f64; 6] = [0.74, 0.66, 0.58, 0.5, 0.42, 0.35];
/// How far the work is lifted or lowered there, in mm.
const LIFTS: [f64; 5] = [0.0, 200.0, -200.0, 400.0, -400.0];

/// The base straight towards an arm that the work is far away from.
fn towards_the_arm(case: &mut Case<'_>) -> Option<Change> {
    let (middle, reach) = (middle_in_root(case), case.machine.model.reach());
    let distance = libm::hypot(middle.x, middle.y);
    let is_level = middle.z.abs() <= reach;
    if distance <= reach && is_level {
        return None;
    }
    let level = if is_level { 0.0 } else { -tens(middle.z) };
    // Work right above the arm comes in front of it.
    let ahead = if distance > 0.0 {
        [middle.x / distance, middle.y / distance]
    } else {
        [1.0, 0.0]
    };
    let shifts = AWAY.into_iter().flat_map(|share| {
        let way = share * reach - distance;
        let [x, y] = ahead.map(|part| tens(part * way));
        LIFTS.map(|lift| Shift {
            by: [x, y, level + lift],
            turn: 0.0,
        })
    });
    placed(case, shifts.collect())
}

/// Heights of the work's middle between the lowest and the highest place of the tip, as shares.
const HEIGHTS: [f64; 5] = [0.5, 0.35, 0.65, 0.2, 0.8];

/// The base into the middle of what the linear axes of a five-axis machine reach.
fn into_the_range(case: &mut Case<'_>) -> Option<Change> {
    let axes = &case.machine.model.axes;
    let middle = middle_in_root(case);
    let (low, high) = (tip(case, axes, 0.0), tip(case, axes, 1.0));
    let between = |share: f64| {
        let at = |low: f64, high: f64| low + share * (high - low);
        Point3::new(at(low.x, high.x), at(low.y, high.y), at(low.z, high.z))
    };
    let is_within = |at: f64, one: f64, other: f64| at >= one.min(other) && at <= one.max(other);
    if is_within(middle.x, low.x, high.x)
        && is_within(middle.y, low.y, high.y)
        && is_within(middle.z, low.z, high.z)
    {
        return None;
    }
    let aside = between(0.5);
    let shifts = HEIGHTS.map(|share| Shift {
        by: [
            tens(aside.x - middle.x),
            tens(aside.y - middle.y),
            tens(between(share).z - middle.z),
        ],
        turn: 0.0,
    });
    placed(case, shifts.to_vec())
}

/// Where the tip is in the root, with the rotary axes at zero and the linear ones at this share of their ranges.
fn tip(case: &Case<'_>, axes: &[Axis], share: f64) -> Point3 {
    let mut joints: Joints = [0.0; 6];
    for (joint, axis) in joints.iter_mut().zip(axes) {
        *joint = match axis.kind {
            AxisKind::Linear => axis.min + share * (axis.max - axis.min),
            AxisKind::Rotary => 0.0,
        };
    }
    let rig = Rig::of(case.machine);
    rig.point_in_root(Frame::from(rig.blade_in_work(&joints)).origin)
}

/// The nearest of these places that carries out the whole program.
fn placed(case: &mut Case<'_>, shifts: Vec<Shift>) -> Option<Change> {
    let few = |shifts: Vec<Shift>| shifts.into_iter().step_by(LIFTS.len()).collect();
    let elsewhere = nearest(case, shifts, few)?;
    confirmed(case, &elsewhere)
}

/// Whole centimetres: a place of the work in its cell is measured no finer.
fn tens(value: f64) -> f64 {
    (value / 10.0).round() * 10.0
}

/// The middle of the stock, seen from the machine's root.
fn middle_in_root(case: &Case<'_>) -> Point3 {
    middle_of(case.unreachable.program.program().stock, case.machine)
}

fn middle_of(stock: Stock, machine: &Machine) -> Point3 {
    let half = |size: Length| size.to_mm() / 2.0;
    let middle = Point3::new(half(stock.width), half(stock.depth), half(stock.height));
    Rig::of(machine).point_in_root(middle)
}

/// The base level towards the first axis of an arm by this distance in mm, to whole centimetres; none where the work is not so far
/// away.
#[must_use]
pub fn base_nearer(job: &CheckedJob, by: f64) -> Option<Change> {
    let machine = job.machine.as_ref()?;
    let middle = middle_of(job.stock, machine);
    let distance = libm::hypot(middle.x, middle.y);
    let [x, y] = [middle.x, middle.y].map(|part| -tens(part / distance * by));
    let shift = Shift {
        by: [x, y, 0.0],
        turn: 0.0,
    };
    let now = machine.base.value;
    let elsewhere = Elsewhere {
        how: shift.how(),
        base: PlacedFrame {
            frame: shift.of(&now.frame),
            ..now
        },
    };
    (distance > by).then(|| Change::base(job, &elsewhere))
}
