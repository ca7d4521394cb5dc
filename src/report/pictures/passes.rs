//! The passes over pockets, from above.

use super::ways::points;
use crate::Material;
use vcutc_backend_api::ir::OperationId;
use vcutc_backend_api::units::Length;
use vcutc_job::operation::judged::{FromAbove, WhyItStays};
use vcutc_picture::Prefix;
use vcutc_picture::ground::{self, Ground, Staying, Why};
use vcutc_picture::passes::{self, Heading, Passes, Stretch};
use vcutc_region::coverage::Square;
use vcutc_region::piece::Piece;

/// The passes of the first layer of each pocket, by how much of the tool's rim is in the material (`picture::passes`), and slits along
/// walls; none of a job without either.
#[must_use]
pub fn passes(material: &Material<'_>, ids: Prefix) -> Option<String> {
    let seen = seen(material);
    if seen.is_empty() {
        return None;
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
    let uncut: Vec<[f64; 4]> = uncut.map(|square| rectangle(*square)).collect();
    let stock = material.plan.stock;
    Some(passes::draw(&Passes {
        heading: Heading {
            ids,
            title: &title(material),
            subtitle: &figures(material),
        },
        size: [stock.width, stock.depth].map(Length::to_mm),
        walls: &walls(&seen),
        open: &lines(&seen, |seen| &seen.open),
        slits: &slits,
        stretches: &stretches,
        entries: &entries,
        uncut: &uncut,
    }))
}

/// What of the ground of each pocket stays, in its first layer (`picture::ground`); none of a job without pockets.
#[must_use]
pub fn ground(material: &Material<'_>, ids: Prefix) -> Option<String> {
    if material.compiled.report.cleared.is_empty() {
        return None;
    }
    let seen = seen(material);
    let mut places: Vec<Staying> = seen
        .iter()
        .flat_map(|seen| &seen.stays)
        .map(|stays| Staying {
            boxes: stays
                .spot
                .squares
                .iter()
                .map(|square| rectangle(*square))
                .collect(),
            at: [stays.spot.at.x, stays.spot.at.y],
            area: stays.spot.area,
            width: stays.spot.width,
            why: match stays.why {
                WhyItStays::Uncut => Why::Uncut,
                WhyItStays::BeyondReach => Why::BeyondReach,
            },
        })
        .collect();
    // What no pass cuts first: that is what a change of the job may clear.
    places.sort_by(|one, other| {
        let is_uncut = |place: &Staying| place.why == Why::Uncut;
        let by_why = is_uncut(other).cmp(&is_uncut(one));
        by_why.then(other.area.total_cmp(&one.area))
    });
    let stock = material.plan.stock;
    Some(ground::draw(&Ground {
        heading: Heading {
            ids,
            title: &format!(
                "{}: what stays in the first layer of each pocket",
                material.plan.name
            ),
            subtitle: &figures(material),
        },
        size: [stock.width, stock.depth].map(Length::to_mm),
        walls: &walls(&seen),
        open: &lines(&seen, |seen| &seen.open),
        places: &places,
    }))
}

/// The operations of a job that work in regions, from above.
fn seen(material: &Material<'_>) -> Vec<FromAbove> {
    let program = material.compiled.program.verified().program();
    let operations = (0..).map(OperationId).zip(&material.plan.operations);
    let seen = operations.filter_map(|(operation, planned)| planned.seen_from_above(operation, program));
    seen.collect()
}

fn lines(seen: &[FromAbove], of: fn(&FromAbove) -> &[Piece]) -> Vec<Vec<[f64; 2]>> {
    seen.iter().flat_map(of).map(|piece| points(*piece)).collect()
}

/// A pocket and the slits along its walls have the same walls.
fn walls(seen: &[FromAbove]) -> Vec<Vec<[f64; 2]>> {
    let mut walls: Vec<Vec<[f64; 2]>> = Vec::new();
    for wall in lines(seen, |seen| &seen.walls) {
        if !walls.contains(&wall) {
            walls.push(wall);
        }
    }
    walls
}

const fn rectangle(square: Square) -> [f64; 4] {
    let Square { low, side } = square;
    [low.x, low.x + side, low.y, low.y + side]
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
