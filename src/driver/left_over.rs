//! What cuts leave over a part that changes along y.
//!
//! They leave the same height at every y, with the spine that they follow taken off, so they cannot go below the part's shadow; those that
//! have ways of their own cannot go below the cover that these make. What lies between these and the part is left whatever they do; it
//! shows how well such cuts suit the part.

use vcutc_backend_api::units::Length;
use vcutc_geometry::curve::Point2;
use vcutc_job::follow::Guide;
use vcutc_job::{CheckedJob, Machine, Part};
use vcutc_simulation::report::Report;
use vcutc_surface::residual::{Standing, Volume};
use vcutc_surface::spine::Rising;

/// What is left over a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LeftOver {
    /// All that is left.
    pub all: Standing,
    /// What of it lies below the shadow, or below the cover of columns.
    pub shaded: Volume,
    /// Below what that lies.
    pub below: Below,
    /// How high material stays above the part at most where level cuts are infinitely close, as a grid of its heights shows; where it
    /// would be much less along a spine, or along lines with slopes of their own.
    pub level: Option<Length>,
}

/// What cuts cannot go below, however close they are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Below {
    /// The shadow of the part.
    Shadow,
    /// The straight lines that cover it.
    Lines,
    /// The curved ways that do.
    Curves,
}

/// Level cuts leave much more where they leave so many times as much, and that is more than so many mm.
const MUCH: (f64, f64) = (2.0, 1.0);

/// What level cuts leave, where that is much; none where the machine cannot pitch blades.
fn left_by_level_cuts(part: &Part, machine: Option<&Machine>) -> Option<Length> {
    if machine.is_some_and(|machine| !machine.turns_planes()) {
        return None;
    }
    let surface = part.surface().filter(|_| part.guide().is_none())?;
    let (times, least) = MUCH;
    let level = surface.left_by_straight_cuts();
    let along = part.fitted(Rising::Freely).map(|fitted| fitted.leaves);
    let along = along.into_iter().chain(part.left_by_lines()).reduce(f64::min)?;
    (level > times * along && level > least).then(|| Length::mm(level))
}

impl LeftOver {
    /// What the cuts of a program leave; none over a profile.
    pub(crate) fn of(job: &CheckedJob, report: &Report) -> Option<Self> {
        let (part, stock) = (&job.part, job.stock);
        let surface = part.levelled()?;
        let below = |corners: &[Point2]| part.left_by(corners, &report.columns, stock);
        // Checking a job refuses surfaces that are too tangled for this.
        let all = surface.standing(&below(&report.contour)?).ok()??;
        let (shaded, lies_below) = match part.guide().and_then(Guide::columns) {
            Some(columns) => {
                let lines = if columns.is_fan() {
                    Below::Lines
                } else {
                    Below::Curves
                };
                (surface.below_columns(columns).ok()?, lines)
            }
            None => {
                let shadow = part.tessellated(Part::TOLERANCE)?;
                let standing = surface.standing(&below(shadow.points())?).ok()??;
                (standing.volume, Below::Shadow)
            }
        };
        Some(Self {
            all,
            shaded,
            below: lies_below,
            level: left_by_level_cuts(part, job.machine.as_ref()),
        })
    }
}
