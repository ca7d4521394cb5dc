//! A pretend machine whose head turns the blade any way: C carries B carries A.
//!
//! The pretend machine of the api has B and A alone, and cannot turn a blade into another direction of its way. This one has C
//! as well, as the last of its axes, and holds the blade as `Rz(C) Ry(B) Rx(A)` turns an upright blade that
//! leads towards +y.

use core::f64::consts::{FRAC_1_SQRT_2, PI};
use vcutc_backend_api::geometry::{Frame, Orientation, Point3};
use vcutc_backend_api::ir::{Action, Axis, AxisValues, Program};
use vcutc_backend_api::motion::{Branch, Motion, ReachableProgram, Stretch};
use vcutc_backend_api::segments::Path;
use vcutc_backend_api::verify::verify;

/// From the point where the axes meet to the tip, in mm.
const ARM: f64 = 560.0;

/// The upright blade: x of T along +y, y along +x, z down.
const UPRIGHT: [f64; 4] = [0.0, FRAC_1_SQRT_2, FRAC_1_SQRT_2, 0.0];

/// A program for the pretend machine of the api, with the motion of this one.
pub(crate) fn on_the_head(mut program: Program) -> ReachableProgram {
    if let Some(cell) = &mut program.cell {
        let axis = Axis {
            name: "C".to_owned(),
            min: -PI,
            max: PI,
            ..cell.axes[3].clone()
        };
        cell.axes.push(axis);
    }
    let verified = verify(program).unwrap();
    let motion = motion(verified.program());
    ReachableProgram::assemble(verified, motion, &|_, axes| blade_in_work(axes)).unwrap()
}

fn motion(program: &Program) -> Motion {
    let cell = program.cell.as_ref().unwrap();
    let mut axes = cell.home.unwrap();
    let mut motion = Motion {
        ends: Vec::new(),
        stretches: Vec::new(),
        waypoints: Vec::new(),
    };
    for segment in program.segments() {
        if matches!(segment.op.action, Action::AxisTravel { .. }) {
            motion.stretches.push(Stretch {
                from: segment.id,
                branch: Branch::Numbered(0),
            });
        }
        axes = match (segment.path(), segment.target()) {
            (Path::Home, _) => cell.home.unwrap(),
            (Path::Change, _) => cell.change.unwrap().at,
            (_, Some(to)) => axes_at(to.tip, program.orientation(to.orientation).unwrap()),
            (_, None) => axes,
        };
        motion.ends.push(axes);
    }
    motion
}

/// The axes that hold the blade there: with C at 0 where B and A can, and with B at 0 otherwise.
fn axes_at(tip: Point3, held: Orientation) -> AxisValues {
    let matrix = held.matrix();
    let [out, across] = [2, 1].map(|column| matrix.map(|row| row[column]));
    let heading = libm::atan2(across[1], across[0]);
    let with = |c: f64| {
        let (sin, cos) = libm::sincos(c);
        let turned = [cos * out[0] + sin * out[1], cos * out[1] - sin * out[0], out[2]];
        let a = libm::atan2(turned[1], libm::hypot(turned[0], turned[2]));
        let b = libm::atan2(-turned[0], -turned[2]);
        AxisValues([
            tip.x - ARM * out[0],
            tip.y - ARM * out[1],
            tip.z - ARM * out[2],
            b,
            a,
            c,
        ])
    };
    let straight = with(0.0);
    let is_held = blade_in_work(&straight).orientation.angle_to(held).to_rad() < 1e-9;
    if is_held { straight } else { with(heading) }
}

/// Where axis values hold the blade: frame T in the workpiece frame W.
fn blade_in_work(axes: &AxisValues) -> Frame {
    let [x, y, z, b, a, c] = axes.0;
    let about = |angle: f64, axis: usize| {
        let (sin, cos) = libm::sincos(angle / 2.0);
        let mut turn = [cos, 0.0, 0.0, 0.0];
        turn[axis] = sin;
        turn
    };
    let turn = product(product(about(c, 3), about(b, 2)), about(a, 1));
    let [w, i, j, k] = product(turn, UPRIGHT);
    let orientation = Orientation::from_quaternion(w, i, j, k).unwrap();
    let [out_x, out_y, out_z] = orientation.matrix().map(|row| row[2]);
    Frame {
        origin: Point3::new(x + ARM * out_x, y + ARM * out_y, z + ARM * out_z),
        orientation,
    }
}

/// Product of two quaternions, scalar part first.
pub(crate) fn product([aw, ax, ay, az]: [f64; 4], [bw, bx, by, bz]: [f64; 4]) -> [f64; 4] {
    [
        aw * bw - ax * bx - ay * by - az * bz,
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
    ]
}
