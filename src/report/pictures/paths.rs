//! The path of a milling program beside that of the V-cuts made of it (`picture::paths`).

use super::{Machined, machined};
use crate::Material;
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::ir::{ActionKind, Program, Shape};
use vcutc_backend_api::state::TipPose;
use vcutc_picture::{Prefix, paths};

/// Both paths, that of the milling program in the axes of the job.
#[must_use]
pub fn paths(material: &Material<'_>, milling: &[Vec<[f64; 3]>], ids: Prefix) -> String {
    let Machined { contour, .. } = machined(material);
    let program = material.compiled.program.verified().program();
    let track = Track::of(program);
    let stock = program.stock;
    let flanks = track.blades.len();
    paths::draw(&paths::Paths {
        heading: paths::Heading {
            ids,
            title: &format!("{}: tool paths", material.plan.name),
            subtitle: &format!("{} V-cuts, {flanks} flanks, from a milling program", flanks / 2),
        },
        blank: [stock.width, stock.depth, stock.height].map(|size| size.to_mm()),
        contour: &contour,
        milling,
        cutting: &track.tip,
        blades: &track.blades,
    })
}

/// Where the tip goes, and how the blade stands where flanks begin.
#[derive(Default)]
struct Track {
    tip: Vec<[f64; 3]>,
    blades: Vec<[[f64; 3]; 2]>,
}

impl Track {
    fn of(program: &Program) -> Self {
        let mut track = Self::default();
        for segment in program.segments() {
            let kind = segment.op.action.kind();
            if let (ActionKind::CutLeft | ActionKind::CutRight, Some(start)) = (kind, segment.start()) {
                track.blades.extend(blade(program, start));
            }
            if let Some(to) = segment.target().filter(|_| kind != ActionKind::Turn) {
                track.tip.push([to.tip.x, to.tip.y, to.tip.z]);
            }
        }
        track
    }
}

/// The blade at a pose, from its tip along its axis, as long as its edge.
fn blade(program: &Program, pose: TipPose) -> Option<[[f64; 3]; 2]> {
    let blades = program.blades.iter();
    let length = blades
        .map(|blade| match blade.shape {
            Shape::Straight(straight) => straight.cutting_length.to_mm(),
            Shape::Disc(disc) => disc.thickness.to_mm(),
            Shape::Crusher(crusher) => crusher.height.to_mm(),
        })
        .reduce(f64::max)?;
    let [[_, _, x], [_, _, y], [_, _, z]] = program.orientation(pose.orientation)?.matrix();
    let Point3 { x: tx, y: ty, z: tz } = pose.tip;
    Some([[tx, ty, tz], [tx - x * length, ty - y * length, tz - z * length]])
}
