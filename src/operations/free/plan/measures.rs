//! What the blades and the job ask of strips.

use crate::asked::{AIR, FreePocket};
use crate::refused::Why;
use vcutc_backend_api::units::Length;
use vcutc_job::Auto;
use vcutc_process::lower::{BLEND, ROUNDING_ROOM};

/// What the blades and the job ask of strips, in mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Measures {
    pub(super) radius: f64,
    /// The shank with its air.
    pub(super) shank: f64,
    /// Half the thickness of the straight blade.
    pub(super) half: f64,
    /// What the straight blade and the rim keep from walls.
    pub(super) keeps: [f64; 2],
    /// How far the rim runs on beyond a slit.
    pub(super) over: f64,
    /// The width of strips along walls.
    pub(super) step: f64,
    /// The widest row.
    pub(super) widest: f64,
    /// The thickness of a layer, and the depth of the pocket.
    pub(super) thick: f64,
    pub(super) deep: f64,
    /// Half the angle between the edges of the straight blade, in rad.
    pub(super) half_apex: f64,
    /// How far ways run on beyond open sides.
    pub(super) reach: f64,
    pub(super) chip: f64,
}

/// Strips have to be so much wider than a slit, in thicknesses.
const LEAST: f64 = 2.0;

/// What rounding may take of a limit, in mm.
const ROUNDING: f64 = 1e-6;

impl Measures {
    /// Of layers of this thickness in a pocket of this depth, in mm.
    pub(super) fn of(asked: &FreePocket, [thick, deep]: [f64; 2]) -> Result<Self, Why> {
        let radius = asked.disc.radius.value.to_mm();
        let stages = asked.disc.body.stages.iter();
        let low = stages.filter(|stage| stage.from.value.to_mm() < thick);
        let shank = low.map(|stage| stage.radius.value.to_mm()).fold(0.0, f64::max) + AIR.to_mm();
        let half = asked.blade.thickness.value.to_mm() / 2.0;
        if half <= 0.0 {
            return Err(Why::TooThin);
        }
        let knife = vcutc_process::slits::fit::knife(asked.fit(), thick).map_err(Why::Unfit)?;
        let allowance = asked.allowance.value.to_mm();
        let over = half + knife.keep - allowance;
        let rim = allowance + BLEND.to_mm() + ROUNDING_ROOM.to_mm();
        let most = (radius - shank - over).min(asked.disc.width.value.to_mm());
        let step = match asked.step.value {
            Auto::Given(step) => step.to_mm(),
            Auto::Auto => most,
        };
        if step > most + ROUNDING || step < LEAST * 2.0 * half {
            return Err(Why::Width {
                step: Length::mm(step),
                most: Length::mm(most),
                least: Length::mm(LEAST * 2.0 * half),
            });
        }
        Ok(Self {
            radius,
            shank,
            half,
            keeps: [knife.keep, rim],
            over,
            step,
            widest: asked.step.value.or(asked.disc.width.value).to_mm(),
            thick,
            deep,
            half_apex: knife.half_apex,
            reach: radius + asked.setup.run_out.value.to_mm(),
            chip: asked.chip.value.to_mm(),
        })
    }

    /// How much farther out the slits along walls lie than strips begin, whose rim keeps more from walls for its rounding.
    pub(super) fn farther_out(&self) -> f64 {
        let [knife, rim] = self.keeps;
        rim + self.over - (knife + self.half)
    }

    /// How far from walls ground belongs to the slits along them.
    pub(super) fn beside_walls(&self) -> f64 {
        self.keeps[0] + self.half
    }

    /// How far the level lies from the walls that bounds the rows of so many strips along walls.
    pub(super) fn level(&self, rings: u32) -> f64 {
        self.radius + self.keeps[1] + f64::from(rings) * self.step
    }
}
