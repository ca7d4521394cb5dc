//! The data of a playback as JSON, in a form that may stand inside of a page.

use super::bodies::{Body, Carrier, Shape};
use super::taken::Taken;
use super::timeline::Timeline;
use super::track::Track;
use super::{Cell, Playback};
use crate::packing::{self, column};
use serde_json::{Value, json};
use vcutc_backend_api::geometry::{Orientation, Point3};
use vcutc_backend_api::ir::{
    ActionKind, Axis, AxisKind, Blade, BodyStage, Edges, Shape as BladeShape, Stock, Straight,
};
use vcutc_backend_api::units::Length;
use vcutc_geometry::curve::Point2;
use vcutc_machine::kinematics::linkage::{Joint, Linkage};
use vcutc_machine::kinematics::pose::Pose;
use vcutc_simulation::cross_section::Crack;

/// The data as JSON text, for an element of the page.
pub(super) fn text(playback: &Playback<'_>) -> String {
    let value = json!({
        "stock": stock(playback.stock),
        "spine": playback.spine,
        "part": playback.part.iter().map(corner).collect::<Vec<_>>(),
        "blades": playback.blades.iter().map(blade).collect::<Vec<_>>(),
        "changes": playback.changes.iter().map(|(op, tool)| json!([op, tool.0])).collect::<Vec<_>>(),
        "several": playback.operations > 1,
        "pockets": playback.pockets,
        "walls": playback.walls,
        "taken": playback.taken.as_ref().map(taken),
        "orientations": playback.orientations.iter().map(quaternion).collect::<Vec<_>>(),
        "kinds": ActionKind::NAMES,
        "timeline": timeline(&playback.timeline),
        "cell": playback.cell.as_ref().map(cell),
    });
    packing::document(&value)
}

fn stock(stock: Stock) -> Value {
    let lengths = [stock.width, stock.depth, stock.height];
    json!(lengths.map(|length| length.to_mm()))
}

fn corner(corner: &Point2) -> Value {
    json!([corner.x, corner.z])
}

fn taken(taken: &Taken) -> Value {
    let slit = |(op, slit): &(usize, Crack)| json!([op, slit.x, slit.bottom]);
    let chip = |(op, floor): &(usize, Vec<Point2>)| json!([op, floor.iter().map(corner).collect::<Vec<_>>()]);
    json!({
        "slits": taken.slits.iter().map(slit).collect::<Vec<_>>(),
        "chips": taken.chips.iter().map(chip).collect::<Vec<_>>(),
    })
}

/// The edge, and the stages of the body as far as they are stated: where each begins above the tip, and its radius.
fn blade(blade: &Blade) -> Value {
    let mut shown = shape(blade);
    if let Some(body) = &blade.body {
        let stage = |stage: &BodyStage| json!([stage.from.to_mm(), stage.radius.to_mm()]);
        shown["body"] = body.iter().map(stage).collect();
    }
    shown
}

fn shape(blade: &Blade) -> Value {
    match blade.shape {
        BladeShape::Straight(straight) => dagger(straight),
        BladeShape::Disc(disc) => drum(disc.radius, disc.thickness),
        BladeShape::Crusher(crusher) => drum(crusher.radius, crusher.height),
    }
}

fn dagger(blade: Straight) -> Value {
    json!({
        "length": blade.cutting_length.to_mm(),
        "halfApex": blade.half_apex.to_rad(),
        "thickness": blade.thickness.to_mm(),
        "edges": match blade.edges {
            Edges::Single => 1,
            Edges::Double => 2,
        },
    })
}

fn drum(radius: Length, height: Length) -> Value {
    json!({ "radius": radius.to_mm(), "height": height.to_mm() })
}

fn quaternion(orientation: &Orientation) -> Value {
    json!(orientation.quaternion())
}

fn timeline(timeline: &Timeline) -> Value {
    json!({
        "kinds": column(&timeline.kinds),
        "operations": column(&timeline.operations),
        "layers": column(&timeline.layers),
        "cuts": column(&timeline.cuts),
        "tips": column(&timeline.tips),
        "held": column(&timeline.held),
        "arcs": { "ops": column(&timeline.arcs), "vias": column(&timeline.vias) },
        "seconds": column(&timeline.seconds),
    })
}

fn cell(cell: &Cell<'_>) -> Value {
    let Linkage {
        tool,
        work,
        flange_at_zero,
        mount_at_zero,
    } = &cell.linkage;
    json!({
        "axes": cell.axes.iter().map(axis).collect::<Vec<_>>(),
        "tool": tool.iter().map(joint).collect::<Vec<_>>(),
        "work": work.iter().map(joint).collect::<Vec<_>>(),
        "flangeAtZero": matrix(flange_at_zero),
        "mountAtZero": matrix(mount_at_zero),
        "bladesInFlange": cell.blades_in_flange.iter().map(matrix).collect::<Vec<_>>(),
        "workInMount": matrix(&cell.work_in_mount),
        "bodies": cell.bodies.iter().map(body).collect::<Vec<_>>(),
        "track": track(&cell.track, cell.axes.len()),
    })
}

fn axis(axis: &Axis) -> Value {
    json!({ "name": axis.name, "kind": kind(axis.kind) })
}

const fn kind(kind: AxisKind) -> &'static str {
    match kind {
        AxisKind::Rotary => "rotary",
        AxisKind::Linear => "linear",
    }
}

fn joint(joint: &Joint) -> Value {
    json!({
        "kind": kind(joint.kind),
        "point": joint.line.point.to_array(),
        "direction": joint.line.direction.to_array(),
        "weights": joint.weights,
    })
}

/// Column by column, as WebGL has it.
fn matrix(pose: &Pose) -> Value {
    let turned = pose.rotation.to_cols_array_2d();
    let column = |at: [f64; 3], last: f64| at.into_iter().chain([last]);
    let columns = turned.into_iter().flat_map(|axis| column(axis, 0.0));
    let all = columns.chain(column(pose.position.to_array(), 1.0));
    json!(all.collect::<Vec<_>>())
}

fn body(body: &Body) -> Value {
    let (chain, joints) = match body.carrier {
        Carrier::Tool(joints) => ("tool", joints),
        Carrier::Work(joints) => ("work", joints),
    };
    let point = |at: Point3| [at.x, at.y, at.z];
    match body.shape {
        Shape::Bar { from, to, radius } => json!({
            "chain": chain, "joints": joints, "shape": "bar",
            "from": point(from), "to": point(to), "radius": radius,
        }),
        Shape::Block { low, high } => json!({
            "chain": chain, "joints": joints, "shape": "block",
            "from": point(low), "to": point(high),
        }),
    }
}

fn track(track: &Track, axes: usize) -> Value {
    json!({
        "start": track.start.iter().take(axes).collect::<Vec<_>>(),
        "counts": column(&track.counts),
        "done": column(&track.done),
        "values": column(&track.values),
        "low": track.low,
        "step": track.step,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use vcutc_backend_api::units::Length;
    use vcutc_machine::catalogue;
    use vcutc_machine::kinematics::linkage::Linkage;

    #[test]
    fn no_name_ends_the_element_that_holds_it() {
        let model = catalogue::find("kuka/kr210_r3100_ultra").unwrap();
        let name = "</script><script>alert(1)</script><!-- & \u{2028}\"'\\";
        let mut axes = model.axes.clone();
        axes[0].name = name.to_owned();
        let playback = Playback {
            spine: vec![[0.0, 0.0], [10.0, 0.0]],
            stock: Stock {
                width: Length::mm(1.0),
                depth: Length::mm(1.0),
                height: Length::mm(1.0),
            },
            part: &[],
            blades: &[],
            changes: Vec::new(),
            operations: 1,
            pockets: Vec::new(),
            walls: Vec::new(),
            taken: None,
            orientations: &[],
            timeline: Timeline::default(),
            cell: Some(Cell {
                axes: &axes,
                linkage: Linkage::from(&model.mechanism),
                blades_in_flange: vec![Pose::IDENTITY],
                work_in_mount: Pose::IDENTITY,
                bodies: Vec::new(),
                track: Track {
                    start: [0.0; 6],
                    counts: Vec::new(),
                    done: Vec::new(),
                    values: Vec::new(),
                    low: Vec::new(),
                    step: Vec::new(),
                },
            }),
        };
        let text = text(&playback);
        assert!(!text.contains(['<', '>', '&']), "{text}");
        let read: Value = serde_json::from_str(&text).unwrap();
        assert_eq!(read["cell"]["axes"][0]["name"], name);
    }
}
