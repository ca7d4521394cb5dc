//! The way of an axis move: whether the blade stays out of the stock.

use super::path::{AxesViolation, Block, are_axes_refuted, prove_axes};
use super::survey::Survey;
use glam::DVec3;
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::ir::{Blade, Program};
use vcutc_machine::kinematics::Joints;

/// What is in the way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Obstacle {
    /// Where on the way, from 0 to 1.
    pub at: f64,
    /// The lowest point of the blade there, in W; none where an axis is beyond its limit instead.
    pub lowest: Option<Point3>,
}

/// Proves that an axis move keeps blade and tool out of the stock.
pub(super) fn clear(survey: &Survey<'_>, from: &Joints, to: &Joints) -> Result<(), Obstacle> {
    let points = outline(survey);
    prove_axes(&survey.rig, from, to, &points, &stock(survey.program)).map_err(|breach| Obstacle {
        at: breach.at,
        lowest: match breach.what {
            AxesViolation::Stock { lowest } => Some(Point3::new(lowest.x, lowest.y, lowest.z)),
            AxesViolation::Limit { .. } => None,
        },
    })
}

/// Whether samples show what [`clear`] would find out about the stock, sooner.
pub(super) fn is_refuted(survey: &Survey<'_>, from: &Joints, to: &Joints) -> bool {
    let points = outline(survey);
    are_axes_refuted(&survey.rig, from, to, &points, &stock(survey.program))
}

fn stock(program: &Program) -> Block {
    let stock = program.stock;
    Block {
        low: DVec3::ZERO,
        high: DVec3::new(stock.width.to_mm(), stock.depth.to_mm(), stock.height.to_mm()),
    }
}

/// Points of the blade frame T between which blade and tool lie: those of the blade at hand, and the flange. The arm beyond the flange is farther away from the work than these.
fn outline(survey: &Survey<'_>) -> Vec<DVec3> {
    let blade = survey.program.blade(survey.tool);
    let hull = blade.into_iter().flat_map(Blade::hull).map(DVec3::from_array);
    hull.chain([survey.rig.flange_in_blade.position]).collect()
}
