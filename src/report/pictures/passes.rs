//! The passes over pockets, from above.

use super::ways::points;
use crate::Material;
use vcutc_backend_api::ir::OperationId;
use vcutc_backend_api::units::Length;
use vcutc_job::operation::judged::FromAbove;
use vcutc_picture::Prefix;
use vcutc_picture::passes::{self, Heading, Passes, Stretch};
use vcutc_region::piece::Piece;

/// The passes of the first layer of each pocket, by how much of the tool's rim is in the material (`picture::passes`), and slits along
/// walls; none of a job without either.
#[must_use]
pub fn passes(material: &Material<'_>, ids: Prefix) -> Option<String> {
    let program = material.compiled.program.verified().program();
    let operations = (0..).map(OperationId).zip(&material.plan.operations);
    let seen = operations.filter_map(|(operation, planned)| planned.seen_from_above(operation, program));
    let seen: Vec<FromAbove> = seen.collect();
    if seen.is_empty() {
        return None;
    }
    let lines = |of: fn(&FromAbove) -> &[Piece]| -> Vec<Vec<[f64; 2]>> {
        seen.iter().flat_map(of).map(|piece| points(*piece)).collect()
    };
    // A pocket and the slits along its walls have the same walls.
    let mut walls: Vec<Vec<[f64; 2]>> = Vec::new();
    for wall in lines(|seen| &seen.walls) {
        if !walls.contains(&wall) {
            walls.push(wall);
        }
    }
    let slits = seen.iter().flat_map(|seen| &seen.slits);
    let slits: Vec<Vec<[f64; 2]>> = slits
        .map(|way| way.iter().flat_map(|piece| points(*piece)).collect())
        .collect();
    let stretches = seen.iter().flat_map(|seen| &seen.stretches);
    let stretches: Vec<Stretch> = stretches
        .map(|(piece, engagement)| Stretch {
            points: points(*piece),
            engagement: engagement.to_degrees(),
        })
        .collect();
    let entries = seen.iter().flat_map(|seen| &seen.entries);
    let entries: Vec<[f64; 2]> = entries.map(|at| [at.x, at.y]).collect();
    let uncut = seen.iter().flat_map(|seen| &seen.uncut);
    let uncut: Vec<[f64; 4]> = uncut
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
        open: &lines(|seen| &seen.open),
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
