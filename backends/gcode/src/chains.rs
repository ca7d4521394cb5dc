//! Chains: how far the tip may leave them where they go on, and what of them a control does not take.
//!
//! A chain continues without a stop under a word that states a distance: `G64 P` of LinuxCNC keeps the tip within P of the programmed
//! way [L-GC]; `G641 ADIS=` of Sinumerik leaves a piece no farther than ADIS from its end, so the tip stays within ADIS of that
//! end, and passes a joint without a corner as it is [S-B1]; cycle 32 of Heidenhain keeps it within T [H-620]. Fanuc's `G64`
//! and `G05.1 Q1` state none: how far the tip leaves its way depends on parameters and speeds [F-30]; so
//! there a chain has one piece.
//!
//! Sinumerik stops before a block without motion [S-B1]. So the plane of an arc, and the stop at the end of a chain, are words of
//! the block of the motion itself; cycle 32 has no place there.

use crate::arcs::{self, NoArc};
use crate::controller::{Arcs, FARTHEST};
use crate::job::Job;
use crate::options::Settings;
use crate::pace::Pace;
use crate::statement::FeedMode;
use vcutc_backend_api::backend::BackendIssue;
use vcutc_backend_api::findings::{Findings, Number};
use vcutc_backend_api::ir::{Action, Joint, OpId};
use vcutc_backend_api::number::FixedDecimal;
use vcutc_backend_api::segments::LinearSegment;
use vcutc_backend_api::units::Length;

/// Decimals of the distance: what every control reads [H-620].
const DISTANCE: FixedDecimal = FixedDecimal::new(4);

/// Smallest distance. LinuxCNC takes `P0` for no distance at all [L-GC]; below this value controls stop
/// between blocks.
const SMALLEST_BLEND: Length = Length::mm(0.001);

const NO_DISTANCE: &str =
    "pieces of a chain that go on into each other: Fanuc has no word for how far the tip may leave them";

const OBLIQUE: &str = "arcs out of the planes XY, ZX and YZ of the work offset";

const NOT_HORIZONTAL: &str = "arcs out of the plane XY of the work offset, which `C` needs";

const LOST: &str = "arcs that the decimals of the program cannot hold";

const STILL: &str = "pieces of a chain that are shorter than the last decimal";

/// The distance as it is printed: rounded down, and less than how far the job rounds corners in the air by a unit where the two are
/// the same, so that a reader can distinguish them.
pub(crate) fn printed_blend(within: Length, settings: &Settings<'_>) -> Length {
    let down = DISTANCE.floored(within.to_mm());
    let is_taken = settings
        .common
        .approximation
        .is_some_and(|taken| (taken.to_mm() - down).abs() < 0.5 * DISTANCE.unit());
    Length::mm(if is_taken { down - DISTANCE.unit() } else { down })
}

/// What a control does not take of a piece of a chain.
pub(crate) fn piece(
    job: &Job<'_>,
    op: OpId,
    (action, line): (&Action, &LinearSegment),
    pace: Option<Pace>,
    found: &mut Findings,
) {
    let Action::Follow { joint, .. } = *action else {
        return;
    };
    let mut unsupported = |what| found.report(what, BackendIssue::Unsupported { op, what });
    if pace.is_some_and(|pace| pace.mode != FeedMode::Tip) {
        unsupported(STILL);
    }
    match arcs::written(job, line) {
        Ok(_) => {}
        Err(NoArc::Lost) => unsupported(LOST),
        Err(NoArc::Oblique) => unsupported(match job.settings.facts().arcs {
            Arcs::AboutPole => NOT_HORIZONTAL,
            Arcs::InPlanes | Arcs::InAnyPlane => OBLIQUE,
        }),
    }
    match joint {
        Joint::Stop => {}
        Joint::Through if job.settings.controller.through(SMALLEST_BLEND).is_none() => {
            unsupported(NO_DISTANCE);
        }
        Joint::Through => {
            let number = Number {
                what: "blend of chains",
                value: job.source.program().blend.to_mm(),
                unit: "mm",
            };
            found.range(Some(op), &number, (SMALLEST_BLEND.to_mm(), FARTHEST));
        }
    }
}
