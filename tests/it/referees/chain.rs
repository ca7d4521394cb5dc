//! A program with a chain, which no job has yet, and the axes of a pretend gantry that carries it out.

use core::f64::consts::{FRAC_1_SQRT_2, PI};
use core::num::NonZeroU32;
use vcutc_backend_api::geometry::{Frame, Orientation, Point3};
use vcutc_backend_api::ir::{
    Action, AxisKind, AxisValues, FeedId, Joint, Op, OrientationId, Program, RateId, Site, Switch, ViaId,
};
use vcutc_backend_api::motion::{Branch, Motion, ReachableProgram, Stretch};
use vcutc_backend_api::segments::Path;
use vcutc_backend_api::units::Length;
use vcutc_backend_api::verify::verify;

/// From the point where the axes B and A meet to the tip, in mm.
const ARM: f64 = 200.0;

/// The upright blade: x of T along +y, y along +x, z down.
const UPRIGHT: [f64; 4] = [0.0, FRAC_1_SQRT_2, FRAC_1_SQRT_2, 0.0];

/// The program with a chain at the end of its last operation, whose blade is the second: along y, up on one arc and down on another
/// in the plane of y and z, the blade turning with its way, and along y. The axes are those of a head with B carrying A.
pub(super) fn chained(mut program: Program, blend: Length) -> ReachableProgram {
    let is_off = |op: &Op| matches!(op.action, Action::Ultrasonic { state: Switch::Off });
    let place = program.ops.iter().rposition(is_off).unwrap();
    let is_cut = |op: &&Op| matches!(op.site, Site::Cut { .. });
    let site = program.ops[..place].iter().rfind(is_cut).unwrap().site;
    let actions = actions(&mut program);
    program.blend = blend;
    program.ops.splice(
        place..place,
        actions.into_iter().map(|action| Op { site, action }),
    );
    for axis in program.cell.iter_mut().flat_map(|cell| &mut cell.axes) {
        let far = match axis.kind {
            AxisKind::Linear => 10_000.0,
            AxisKind::Rotary => PI,
        };
        (axis.min, axis.max) = (-far, far);
    }
    let verified = verify(program).unwrap();
    let motion = motion(verified.program());
    ReachableProgram::assemble(verified, motion, &|_, axes| blade_in_work(axes)).unwrap()
}

fn actions(program: &mut Program) -> Vec<Action> {
    let [width, depth, height] =
        [program.stock.width, program.stock.depth, program.stock.height].map(Length::to_mm);
    let (x, low, safe, radius) = (0.5 * width, 0.8 * height, height + 20.0, 0.4 * depth);
    let (begin, end) = (0.1 * depth, depth + 40.0);
    let [level, rising] = [-20.0_f64, -5.0].map(|lean| {
        program.orientations.push(leaning(lean.to_radians()));
        OrientationId(u32::try_from(program.orientations.len() - 1).unwrap())
    });
    let up = |angle: f64| {
        let (sin, cos) = libm::sincos(angle.to_radians());
        Point3::new(x, begin + radius * sin, low + radius * (1.0 - cos))
    };
    let top = up(15.0);
    // About a point above, then about its mirror image in the joint.
    let down = |angle: f64| {
        let before = up(15.0 - angle);
        Point3::new(x, 2.0 * top.y - before.y, 2.0 * top.z - before.z)
    };
    let mut via = |point| {
        program.vias.push(point);
        Some(ViaId(
            NonZeroU32::new(u32::try_from(program.vias.len()).unwrap()).unwrap(),
        ))
    };
    let vias = [via(up(7.0)), via(down(8.0))];
    let (feed, rate) = (FeedId(0), RateId(0));
    let follow = |to, orientation, via, joint| Action::Follow {
        to,
        orientation,
        via,
        feed,
        rate,
        joint,
    };
    let last = down(15.0);
    let at = |y, z| Point3::new(x, y, z);
    vec![
        Action::Travel {
            to: at(-40.0, safe),
            orientation: level,
            feed,
            rate,
        },
        Action::Approach {
            to: at(-40.0, low),
            feed,
        },
        follow(at(begin, low), level, None, Joint::Through),
        follow(top, rising, vias[0], Joint::Through),
        follow(last, level, vias[1], Joint::Through),
        follow(at(end, last.z), level, None, Joint::Stop),
        Action::Retract {
            to: at(end, safe),
            feed,
        },
    ]
}

fn motion(program: &Program) -> Motion {
    let cell = program.cell.as_ref().unwrap();
    let mut axes = cell.home.unwrap();
    let (mut ends, mut stretches) = (Vec::new(), Vec::new());
    for segment in program.segments() {
        if matches!(segment.op.action, Action::AxisTravel { .. }) {
            let branch = Branch::Numbered(0);
            let from = segment.id;
            stretches.push(Stretch { from, branch });
        }
        axes = match (segment.path(), segment.target()) {
            (Path::Home, _) => cell.home.unwrap(),
            (Path::Change, _) => cell.change.unwrap().at,
            (_, Some(to)) => axes_at(to.tip, program.orientation(to.orientation).unwrap()),
            (_, None) => axes,
        };
        ends.push(axes);
    }
    Motion {
        ends,
        stretches,
        waypoints: Vec::new(),
    }
}

/// The axes X, Y, Z, B and A that hold the blade there.
fn axes_at(tip: Point3, held: Orientation) -> AxisValues {
    let [x, y, z] = held.matrix().map(|row| row[2]);
    let (b, a) = (libm::atan2(-x, -z), libm::atan2(y, libm::hypot(x, z)));
    AxisValues([tip.x - ARM * x, tip.y - ARM * y, tip.z - ARM * z, b, a, 0.0])
}

/// Where axis values hold the blade: frame T in the workpiece frame W.
fn blade_in_work(axes: &AxisValues) -> Frame {
    let [x, y, z, b, a, _] = axes.0;
    let (sin, cos) = libm::sincos(b / 2.0);
    let [w, i, j, k] = product([cos, 0.0, sin, 0.0], leaning(a).quaternion());
    let orientation = Orientation::from_quaternion(w, i, j, k).unwrap();
    let [out_x, out_y, out_z] = orientation.matrix().map(|row| row[2]);
    Frame {
        origin: Point3::new(x + ARM * out_x, y + ARM * out_y, z + ARM * out_z),
        orientation,
    }
}

/// The upright blade turned about x.
fn leaning(angle: f64) -> Orientation {
    let (sin, cos) = libm::sincos(angle / 2.0);
    let [w, x, y, z] = product([cos, sin, 0.0, 0.0], UPRIGHT);
    Orientation::from_quaternion(w, x, y, z).unwrap()
}

/// Product of two quaternions, scalar part first.
fn product([aw, ax, ay, az]: [f64; 4], [bw, bx, by, bz]: [f64; 4]) -> [f64; 4] {
    [
        aw * bw - ax * bx - ay * by - az * bz,
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
    ]
}
