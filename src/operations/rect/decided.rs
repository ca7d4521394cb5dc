//! Rectangular roughing with every choice made, and what it leaves.

use crate::asked::{AIR, RoughRect};
use crate::plan::{PlannedRect, Stage, Strip};
use vcutc_backend_api::units::Length;
use vcutc_geometry::profile::Profile;
use vcutc_simulation::cross_section::CrossSection;
use vcutc_simulation::disc::{Disc, DiscPass};
use vcutc_simulation::surface::Surface;

/// Rectangular roughing, planned.
#[derive(Clone, Debug, PartialEq)]
pub struct Planned {
    pub asked: RoughRect,
    pub plan: PlannedRect,
    /// The part with its allowance.
    pub bound: Profile,
    pub extensions: Extensions,
    /// Distance of the straight blade's middle plane from the material that stays.
    pub standoff: Length,
}

/// How far cuts run out beyond the stock, on either side: as far as their blade reaches over the work while it turns, and the
/// run-out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extensions {
    pub slits: Length,
    pub strips: Length,
}

impl Planned {
    /// What it leaves of what the operations before left.
    pub(crate) fn leaves(&self, before: Surface) -> Surface {
        let mut section = CrossSection::new(before);
        let disc = Disc {
            radius: self.asked.disc.radius.value,
            depth: None,
            width: None,
            body: Vec::new(),
        };
        for stage in &self.plan.stages {
            match stage {
                Stage::Slits { slits, .. } => {
                    for slit in slits {
                        section.slit(slit.x, slit.bottom);
                    }
                }
                Stage::Strips { strips, .. } => {
                    for strip in strips {
                        section.pass_unguarded(&disc, &self.pass(strip));
                    }
                }
            }
        }
        section.into_surface()
    }

    fn pass(&self, strip: &Strip) -> DiscPass {
        DiscPass {
            centre: strip.centre,
            lead: self.asked.lead.value,
            side: strip.open.opposite(),
            beyond: self.asked.beyond.value,
            shave: None,
            clearance: AIR,
        }
    }
}
