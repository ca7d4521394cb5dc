//! The passes over pockets, from above.

use crate::Material;
use vcutc_backend_api::units::Length;
use vcutc_picture::Prefix;
use vcutc_picture::passes::{self, Heading, Passes, Stretch};
use vcutc_process::clearing::shown::{Shown, points, shown};
use vcutc_process::slitting;
use vcutc_region::piece::Piece;

/// How far points of arcs lie apart.
const APART: Length = Length::mm(0.5);

/// The passes of the first layer of each pocket, by how much of the tool's rim is in the material (`picture::passes`); none of a job
/// without pockets.
#[must_use]
pub fn passes(material: &Material<'_>, ids: Prefix) -> Option<String> {
    let program = material.compiled.program.verified().program();
    let shown = shown(material.plan, program);
    let slit = slitting::shown(material.plan, program);
    if shown.is_empty() && slit.is_empty() {
        return None;
    }
    let lines = |of: fn(&Shown) -> &[Piece]| -> Vec<Vec<[f64; 2]>> {
        shown.iter().flat_map(of).map(|piece| line(*piece)).collect()
    };
    let mut walls = lines(|shown| &shown.walls);
    let slit_walls = slit.iter().flat_map(|slit| &slit.walls).map(|wall| line(*wall));
    for wall in slit_walls {
        if !walls.contains(&wall) {
            walls.push(wall);
        }
    }
    let ways = slit.iter().flat_map(|slit| &slit.ways);
    let slits: Vec<Vec<[f64; 2]>> = ways
        .map(|way| way.iter().flat_map(|piece| line(*piece)).collect())
        .collect();
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
            title: &title(material),
            subtitle: &figures(material),
        },
        size: [stock.width, stock.depth].map(Length::to_mm),
        walls: &walls,
        open: &lines(|shown| &shown.open),
        slits: &slits,
        stretches: &stretches,
        entries: &entries,
        uncut: &uncut,
    }))
}

/// What the pockets come to, in words.
#[must_use]
pub fn figures(material: &Material<'_>) -> String {
    let report = &material.compiled.report;
    let mut parts = Vec::new();
    if !report.cleared.is_empty() {
        let uncut = report.cleared.iter().map(|cleared| cleared.uncut.to_mm2());
        let way: f64 = report.cleared.iter().map(|cleared| cleared.way.to_mm()).sum();
        parts.push(format!(
            "{:.2} m in all layers, at most {:.2} mm² of a layer stay uncut",
            way / 1000.0,
            uncut.fold(0.0, f64::max)
        ));
    }
    if !report.slit.is_empty() {
        let way: f64 = report.slit.iter().map(|slit| slit.way.to_mm()).sum();
        let stays = report.slit.iter().map(|slit| slit.stays.to_mm());
        parts.push(format!(
            "{:.2} m of slits, at most {:.3} mm left at their foot",
            way / 1000.0,
            stays.fold(0.0, f64::max)
        ));
    }
    parts.join("; ")
}

fn title(material: &Material<'_>) -> String {
    let what = if material.compiled.report.cleared.is_empty() {
        "slits along walls"
    } else {
        "passes of the first layer of each pocket"
    };
    format!("{}: {what}", material.plan.name)
}

fn line(piece: Piece) -> Vec<[f64; 2]> {
    points(piece, APART).into_iter().map(|at| [at.x, at.y]).collect()
}
