//! The plan of slits along walls: how deep, and where.

use crate::asked::SlitWalls;
use crate::refused::{LOWEST, Why};
use core::f64::consts::FRAC_PI_2;
use vcutc_backend_api::units::{Duration, Length};
use vcutc_geometry::grid;
use vcutc_job::operation::Ground;
use vcutc_process::from_above::highest;
use vcutc_process::lower::BLEND;
use vcutc_process::pen::step_of;
use vcutc_region::piece::Piece;
use vcutc_region::slits::{Knife, Slit, slits};

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

/// How far slits keep from walls beyond what must be kept, so that rounding to the grid of programs takes nothing of it, in mm.
const GRID: f64 = 0.004;

/// How much less than a right angle there is between the edges of a blade at most, in rad: one edge upright, the other one would lie.
const BLUNT: f64 = 0.01;

/// The shortest lines that may stand for an arc, in mm: the rounding of their ends turns shorter ones by more than 0.2 deg, and a program
/// lets a way leave the plane of its blade by 0.45 deg.
const SHORTEST_STEP: f64 = 0.6;

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
    let half_apex = asked.blade.half_apex.value.to_rad();
    // The longer edge, where the other one stands upright.
    let needed = height / libm::cos(2.0 * half_apex);
    let available = asked.blade.cutting_length.value;
    if 2.0 * half_apex >= FRAC_PI_2 - BLUNT {
        return Err(Why::Blunt);
    }
    if needed > available.to_mm() {
        return Err(Why::TooDeep {
            height: Length::mm(height),
            needed: Length::mm(needed),
        });
    }
    let knife = Knife {
        half_apex,
        half: asked.blade.thickness.value.to_mm() / 2.0,
        keep: asked.allowance.value.to_mm() + BLEND.to_mm() + GRID,
        height,
        run_out: asked.setup.run_out.value.to_mm(),
        grid: grid::SPACING,
    };
    let slits = slits(&asked.region.region, knife).map_err(Why::Misfit)?;
    if slits.is_empty() {
        return Err(Why::NoWalls);
    }
    let ways = slits.iter().flat_map(|slit| &slit.pieces).map(|piece| piece.way);
    let is_short = |way: &Piece| step_of(*way).is_some_and(|step| step < SHORTEST_STEP);
    if let Some(way) = ways.into_iter().find(is_short) {
        return Err(Why::Short { way });
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
