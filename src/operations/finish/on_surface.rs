//! Finishing on parts that change along y: tracks on which height and posture of the disc change.
//!
//! | Stage | Here |
//! | --- | --- |
//! | one track: poses, run-in, run-out | [`lay`] |
//! | all of them: step, lead, side tilt, order | [`plan`] |
//! | does the disc enter the part in its poses, or between them | [`entry`] |
//! | what comes free, and what stays, in sections across the tracks | [`way`], [`sections`] |
//! | both of a finished program, as findings | `proof` |
//! | the plan, and what stages ask of it | `planned` |

pub mod entry;
pub mod lay;
pub mod plan;
mod planned;
mod proof;
pub mod sections;
pub mod way;

pub use planned::PlannedOnSurface;

use crate::asked::FinishDisc;
use crate::plan::Wish;
use plan::Refusal;
use vcutc_job::operation::{Ground, Laid};
use vcutc_surface::surface::Surface;

/// Plans an operation on a surface.
///
/// # Errors
/// Why there is no plan.
pub(crate) fn planned(
    asked: &FinishDisc,
    wish: &Wish,
    surface: &Surface,
    ground: &Ground<'_>,
) -> Result<Laid, Refusal> {
    let plan = plan::plan(asked, wish, surface, ground)?;
    let planned = PlannedOnSurface {
        asked: asked.clone(),
        plan,
        shadow: (*ground.job.profile).clone(),
        spine: ground.job.part.spine().cloned(),
    };
    Ok(Laid {
        planned: Box::new(planned),
        // No section shows what tracks leave that change along y. No operation may come after them.
        after: ground.before.clone(),
    })
}
