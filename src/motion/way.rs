//! The way of an axis move: whether the blade and its body stay out of the stock.

use super::path::{AxesViolation, Block, Solid, are_axes_refuted, prove_axes};
use super::survey::Survey;
use super::sweep::BladePart;
use glam::DVec3;
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::ir::Program;
use vcutc_backend_api::units::Length;
use vcutc_machine::kinematics::Joints;

/// What is in the way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Obstacle {
    /// Where on the way, from 0 to 1.
    pub at: f64,
    pub what: Obstruction,
}

/// What is wrong with an axis move. Places are the lowest of that part of the blade, in W.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Obstruction {
    /// An axis is beyond its limit.
    Limit,
    /// A part of the blade is in the stock.
    Stock(BladePart, Point3),
    /// A part of the blade cannot be shown to stay out of the stock.
    Unproven(BladePart, Point3),
}

/// Proves that an axis move keeps blade and tool out of the stock.
pub(super) fn clear(survey: &Survey<'_>, from: &Joints, to: &Joints) -> Result<(), Obstacle> {
    let solids = solids(survey);
    prove_axes(&survey.rig, from, to, &solids, &stock(survey.program)).map_err(|breach| Obstacle {
        at: breach.at,
        what: match breach.what {
            AxesViolation::Stock { solid, lowest } => Obstruction::Stock(part(solid), point(lowest)),
            AxesViolation::Unproven { solid, lowest } => Obstruction::Unproven(part(solid), point(lowest)),
            AxesViolation::Limit { .. } => Obstruction::Limit,
        },
    })
}

/// What one of the [`solids`] is: the blade itself is the first one.
const fn part(solid: usize) -> BladePart {
    if solid == 0 {
        BladePart::Edge
    } else {
        BladePart::Body
    }
}

fn point(place: DVec3) -> Point3 {
    Point3::new(place.x, place.y, place.z)
}

/// Whether samples show what [`clear`] would find out about the stock, sooner.
pub(super) fn is_refuted(survey: &Survey<'_>, from: &Joints, to: &Joints) -> bool {
    are_axes_refuted(&survey.rig, from, to, &solids(survey), &stock(survey.program))
}

fn stock(program: &Program) -> Block {
    let stock = program.stock;
    Block {
        low: DVec3::ZERO,
        high: DVec3::new(stock.width.to_mm(), stock.depth.to_mm(), stock.height.to_mm()),
    }
}

/// What the axes carry: all between the blade at hand and the flange, then the stages of its body, where they are stated. The last one
/// ends as far from the tip as the flange is. The arm beyond the flange is farther away from the work than these.
fn solids(survey: &Survey<'_>) -> Vec<Solid> {
    let flange = survey.rig.flange_in_blade.position;
    let Some(blade) = survey.program.blade(survey.tool) else {
        return vec![Solid::Hull(vec![flange])];
    };
    let hull = blade.hull().into_iter().map(DVec3::from_array);
    let hull = Solid::Hull(hull.chain([flange]).collect());
    let stages = blade
        .stages(Length::mm(flange.length()))
        .into_iter()
        .map(|stage| {
            let ends = stage.heights.map(|height| DVec3::new(0.0, 0.0, -height.to_mm()));
            let radius = stage.radius.to_mm();
            Solid::Cylinder { ends, radius }
        });
    core::iter::once(hull).chain(stages).collect()
}
