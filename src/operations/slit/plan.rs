//! The plan of slits along walls: how deep, and where.

use crate::asked::SlitWalls;
use crate::refused::{LOWEST, Why};
use vcutc_backend_api::units::{Duration, Length};
use vcutc_job::operation::Ground;
use vcutc_process::from_above::highest;
use vcutc_process::slits::fit;
use vcutc_region::slits::{Knife, Slit};

/// Slits with every choice made.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// The height of the stock over the region, in mm.
    pub top: f64,
    /// The height from which on all is air, in mm.
    pub air: f64,
    /// The blade at its depth.
    pub knife: Knife,
    /// In the order of cutting.
    pub slits: Vec<Slit>,
}

/// Plans the slits in what the operations before have left.
///
/// # Errors
/// What prevents a plan.
pub(crate) fn plan(asked: &SlitWalls, ground: &Ground<'_>) -> Result<Plan, Why> {
    let mut before = ground.before.clone();
    let reach = asked.blade.cutting_length.value.to_mm();
    let top = highest(&mut before, &asked.region.region, reach);
    let floor = asked.floor.value.to_mm();
    let height = top - floor;
    if height < LOWEST {
        return Err(Why::NothingThere { top: Length::mm(top) });
    }
    let knife = fit::knife(asked.fit(), height)?;
    let slits = fit::along_walls(asked.fit(), knife)?;
    if slits.is_empty() {
        return Err(Why::NoWalls);
    }
    Ok(Plan {
        top,
        air: ground.job.stock.height.to_mm(),
        knife,
        slits,
    })
}

impl Plan {
    /// How long it takes at the programmed speeds, about.
    pub(crate) fn time(&self, asked: &SlitWalls) -> Duration {
        let way: f64 = self.way().to_mm();
        let count = self.slits.len() as f64;
        let down = Length::mm(self.air - asked.floor.value.to_mm()) * count;
        let lifts = asked.setup.clearance.value * (2.0 * count);
        Length::mm(way) / asked.setup.cut_feed.value
            + down / asked.plunge_feed.value
            + lifts / asked.setup.travel_feed.value
    }

    /// How long all slits are, together.
    pub(crate) fn way(&self) -> Length {
        let pieces = self.slits.iter().flat_map(|slit| &slit.pieces);
        Length::mm(pieces.map(|piece| piece.way.length()).sum())
    }
}
