//! The passes over pockets, from above.

use crate::Material;
use vcutc_backend_api::units::Length;
use vcutc_picture::Prefix;
use vcutc_picture::passes::{self, Heading, Passes, Stretch};
use vcutc_process::clearing::shown::{Shown, points, shown};
use vcutc_region::piece::Piece;

/// How far points of arcs lie apart.
const APART: Length = Length::mm(0.5);

/// The passes of the first layer of each pocket, by how much of the tool's rim is in the material (`picture::passes`); none of a job
/// without pockets.
#[must_use]
pub fn passes(material: &Material<'_>, ids: Prefix) -> Option<String> {
    let shown = shown(material.plan, material.compiled.program.verified().program());
    if shown.is_empty() {
        return None;
    }
    let lines = |of: fn(&Shown) -> &[Piece]| -> Vec<Vec<[f64; 2]>> {
        shown.iter().flat_map(of).map(|piece| line(*piece)).collect()
    };
    let stretches: Vec<Stretch> = shown
        .iter()
        .flat_map(|shown| &shown.stretches)
        .map(|(piece, engagement)| Stretch {
            points: line(*piece),
            engagement: engagement.to_degrees(),
        })
        .collect();
    let entries: Vec<[f64; 2]> = shown
        .iter()
        .flat_map(|shown| &shown.entries)
        .map(|at| [at.x, at.y])
        .collect();
    let uncut: Vec<[f64; 4]> = shown
        .iter()
        .flat_map(|shown| &shown.uncut)
        .map(|square| {
            let (low, side) = (square.low, square.side);
            [low.x, low.x + side, low.y, low.y + side]
        })
        .collect();
    let stock = material.plan.stock;
    Some(passes::draw(&Passes {
        heading: Heading {
            ids,
            title: &format!("{}: passes of the first layer of each pocket", material.plan.name),
            subtitle: &figures(material),
        },
        size: [stock.width, stock.depth].map(Length::to_mm),
        walls: &lines(|shown| &shown.walls),
        open: &lines(|shown| &shown.open),
        stretches: &stretches,
        entries: &entries,
        uncut: &uncut,
    }))
}

/// What the pockets come to, in words.
#[must_use]
pub fn figures(material: &Material<'_>) -> String {
    let cleared = &material.compiled.report.cleared;
    let uncut = cleared
        .iter()
        .map(|cleared| cleared.uncut.to_mm2())
        .fold(0.0, f64::max);
    let way: f64 = cleared.iter().map(|cleared| cleared.way.to_mm()).sum();
    format!(
        "{:.2} m in all layers, at most {uncut:.2} mm² of a layer stay uncut",
        way / 1000.0
    )
}

fn line(piece: Piece) -> Vec<[f64; 2]> {
    points(piece, APART).into_iter().map(|at| [at.x, at.y]).collect()
}
