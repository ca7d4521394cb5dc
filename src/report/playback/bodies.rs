//! What a machine looks like, as far as its kinematics shows: simple bodies around the lines of its axes.
//!
//! No maker's shape is known here, so an arm is rounded bars from axis to axis, and a five-axis machine a bridge along Y that
//! slides along X, a carriage on it, a ram, a head and a table. Sizes that the kinematics leaves open follow from the
//! machine's own: they are for the eye, and nothing is proven with them.

use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::ir::{Axis, AxisKind};
use vcutc_machine::kinematics::joint_axis::JointAxis;
use vcutc_machine::kinematics::linkage::{Joint, Linkage};

/// What carries a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Carrier {
    /// The joints up to here of the chain to the flange, none for what stands still.
    Tool(usize),
    /// The joints up to here of the chain to the work.
    Work(usize),
}

/// A body's shape with all axes at zero, in the machine's frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape {
    /// A round bar with round ends.
    Bar {
        /// Where its middle line begins.
        from: Point3,
        to: Point3,
        /// Its radius, in mm.
        radius: f64,
    },
    /// A box along the axes of the frame.
    Block {
        /// Its lowest corner.
        low: Point3,
        /// Its highest corner.
        high: Point3,
    },
}

/// A body of the machine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Body {
    /// What carries it.
    pub carrier: Carrier,
    pub shape: Shape,
}

/// The bodies of a machine with these axes, on which work with these corners is mounted; they are seen from the mount.
#[must_use]
pub fn bodies(linkage: &Linkage, axes: &[Axis], corners: &[Point3]) -> Vec<Body> {
    let slides = linkage
        .tool
        .iter()
        .take_while(|joint| joint.kind == AxisKind::Linear)
        .count();
    let arm = linkage.tool.get(slides..).unwrap_or_default();
    let size = size(linkage, arm);
    let mut bodies = links(linkage, slides, arm, size);
    if let (3, Some(first)) = (slides, arm.first().or(linkage.tool.last())) {
        let floor = linkage.mount_at_zero.position.z;
        bodies.extend(gantry(point(first.line.point), floor, axes, size));
        bodies.push(table(linkage, corners, size));
    }
    bodies
}

/// The length of the way along all links, at least 200 mm: what thicknesses are measured by.
fn size(linkage: &Linkage, arm: &[Joint]) -> f64 {
    let ends = arm.iter().map(|joint| joint.line.point);
    let places: Vec<_> = ends.chain([linkage.flange_at_zero.position]).collect();
    let ways = places.iter().zip(places.iter().skip(1));
    ways.map(|(a, b)| a.distance(*b)).sum::<f64>().max(200.0)
}

/// Bars from each rotary axis to the next and to the flange, thinner from link to link.
fn links(linkage: &Linkage, slides: usize, arm: &[Joint], size: f64) -> Vec<Body> {
    let flange = JointAxis {
        point: linkage.flange_at_zero.position,
        direction: linkage.flange_at_zero.rotation.z_axis,
    };
    let lines: Vec<JointAxis> = arm.iter().map(|joint| joint.line).chain([flange]).collect();
    let mut bodies = Vec::new();
    let mut from = lines.first().map(|line| line.point);
    let mut radius = size * 0.045;
    for (link, pair) in lines.windows(2).enumerate() {
        let (&[line, next], Some(begin)) = (pair, from) else {
            continue;
        };
        // Along the axis first, then square to it.
        let along = line.direction * (next.point - begin).dot(line.direction);
        let corner = begin + along;
        for (from, to) in [(begin, corner), (corner, next.point)] {
            if from.distance(to) > size * 1e-3 {
                bodies.push(Body {
                    carrier: Carrier::Tool(slides + link + 1),
                    shape: Shape::Bar {
                        from: point(from),
                        to: point(to),
                        radius,
                    },
                });
            }
        }
        from = Some(next.point);
        radius *= 0.86;
    }
    bodies
}

/// A bridge along Y on two posts that X moves, a carriage that Y moves as well, and a ram above the head. The
/// posts end at `floor`.
fn gantry(head: Point3, floor: f64, axes: &[Axis], size: f64) -> Vec<Body> {
    let range = |axis: usize| axes.get(axis).map_or([0.0, 0.0], |axis| [axis.min, axis.max]);
    let (y, z) = (range(1), range(2));
    let half = size * 0.18;
    let bridge = head.z + z[1] + 2.0 * half;
    let (behind, ends) = (head.x + half, [head.y + y[0] - half, head.y + y[1] + half]);
    let block = |joints, low: [f64; 3], high: [f64; 3]| Body {
        carrier: Carrier::Tool(joints),
        shape: Shape::Block {
            low: point(low),
            high: point(high),
        },
    };
    let post = |from: f64| {
        let to = from + 2.0 * half;
        block(
            1,
            [behind, from, floor.min(bridge)],
            [behind + 1.6 * half, to, bridge],
        )
    };
    vec![
        post(ends[0] - 2.0 * half),
        post(ends[1]),
        block(
            1,
            [behind, ends[0] - 2.0 * half, bridge],
            [behind + 1.6 * half, ends[1] + 2.0 * half, bridge + 2.0 * half],
        ),
        block(
            2,
            [head.x - half * 0.2, head.y - 1.4 * half, bridge - half * 0.4],
            [behind + 1.8 * half, head.y + 1.4 * half, bridge + 2.4 * half],
        ),
        block(
            3,
            [head.x - half * 0.7, head.y - half * 0.7, head.z + half],
            [
                head.x + half * 0.7,
                head.y + half * 0.7,
                bridge + 2.0 * half + z[1] - z[0],
            ],
        ),
    ]
}

/// A plate under the work, from the mount to somewhat beyond the work's corners.
fn table(linkage: &Linkage, corners: &[Point3], size: f64) -> Body {
    let mount = linkage.mount_at_zero.position;
    let (rim, thick) = (size * 0.4, size * 0.15);
    let reach = |from: f64, of: &dyn Fn(&Point3) -> f64| {
        let places = || corners.iter().map(of).chain([0.0]);
        let (low, high) = (places().fold(0.0, f64::min), places().fold(0.0, f64::max));
        [from + low - rim, from + high + rim]
    };
    let (x, y) = (
        reach(mount.x, &|corner| corner.x),
        reach(mount.y, &|corner| corner.y),
    );
    // The work lies on its lowest corner.
    let top = corners.iter().map(|corner| corner.z).reduce(f64::min);
    let top = mount.z + top.unwrap_or(0.0);
    Body {
        carrier: Carrier::Work(linkage.work.len()),
        shape: Shape::Block {
            low: Point3::new(x[0], y[0], top - thick),
            high: Point3::new(x[1], y[1], top),
        },
    }
}

fn point(at: impl Into<[f64; 3]>) -> Point3 {
    let [x, y, z] = at.into();
    Point3::new(x, y, z)
}
