//! Finishing on parts that change along y: tracks on which height and posture of the disc change.
//!
//! | Stage | Here |
//! | --- | --- |
//! | one track: poses, run-in, run-out | [`lay`] |
//! | all of them: step, lead, side tilt, order | [`plan`] |
//! | the plan, and what stages ask of it | `planned` |

pub mod lay;
pub mod plan;
mod planned;

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
