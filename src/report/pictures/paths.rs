//! The path of a milling program beside that of the V-cuts made of it (`picture::paths`).

use super::{Machined, machined};
use crate::Material;
use vcutc_backend_api::geometry::{Orientation, Point3};
use vcutc_backend_api::ir::{Action, OrientationId, Program};
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
        let mut held: Option<OrientationId> = None;
        for op in &program.ops {
            match op.action {
                Action::Travel { to, orientation, .. } | Action::AxisTravel { to, orientation } => {
                    held = Some(orientation);
                    track.go(to);
                }
                Action::Turn { to, .. } => held = Some(to),
                Action::Approach { to, .. } | Action::Retract { to, .. } => track.go(to),
                Action::Cut { to, .. } => {
                    let attitude = held.and_then(|held| program.orientations.get(held.0 as usize));
                    track.stand(attitude.copied(), program);
                    track.go(to);
                }
                Action::Home
                | Action::Ultrasonic { .. }
                | Action::AwaitReady
                | Action::Dwell { .. }
                | Action::ToolChange { .. } => {}
            }
        }
        track
    }

    fn go(&mut self, to: Point3) {
        self.tip.push([to.x, to.y, to.z]);
    }

    /// The blade from its tip along its axis, as long as its edge.
    fn stand(&mut self, attitude: Option<Orientation>, program: &Program) {
        let longest = program
            .operations
            .iter()
            .map(|operation| operation.blade.cutting_length.to_mm());
        let (Some(&tip), Some(attitude), Some(length)) =
            (self.tip.last(), attitude, longest.reduce(f64::max))
        else {
            return;
        };
        let [[_, _, x], [_, _, y], [_, _, z]] = attitude.matrix();
        let [tx, ty, tz] = tip;
        self.blades
            .push([tip, [tx - x * length, ty - y * length, tz - z * length]]);
    }
}
