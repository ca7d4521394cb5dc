//! The moves of finishing (`docs/process.md`, "Finishing with a disc"): tracks to and fro along y, with turns beside the work.

use crate::asked::FinishDisc;
use crate::decided::Planned;
use crate::plan::Track;
use core::num::NonZeroU32;
use vcutc_backend_api::builder::ProgramBuilder;
use vcutc_backend_api::ir::{Edges, Flank, OperationKind, Site, SourceRef};
use vcutc_backend_api::units::{Angle, Length};
use vcutc_process::beside::{Drive, Motion, Pass, Stage, Writer};
use vcutc_process::posture::{Feed, Holder};

/// What programs call it.
pub(crate) const KIND: OperationKind = OperationKind::named("finish_disc").unwrap();

/// Appends the ops of one operation.
pub(crate) fn lower(planned: &Planned, source: SourceRef, builder: &mut ProgramBuilder) {
    let asked = &planned.asked;
    let operation = builder.operation(KIND, asked.disc.in_program(), source);
    let stage = Stage {
        operation,
        feed: builder.feed(asked.setup.cut_feed.value),
        extension: extension(planned),
        hang: asked.disc.radius.value,
        drives: &[Drive::Spindle, Drive::Generator],
    };
    let mut writer = Writer::new(stage, &asked.setup, builder);
    let mut cut = NonZeroU32::MIN;
    for track in &planned.plan.tracks {
        let (holder, flank) = posture(track, planned.plan.lead);
        writer.pass(&Pass {
            site: Site::Cut {
                operation,
                layer: NonZeroU32::MIN,
                cut,
            },
            at: track.centre,
            holder,
            flank,
            motion: Motion::Follow,
        });
        cut = cut.saturating_add(1);
    }
    writer.leave();
}

/// How the disc is held on a track: as a flank that leans to the side to which the part falls, its axis along the feed by the lead.
fn posture(track: &Track, lead: Angle) -> (Holder, Flank) {
    let holder = Holder {
        swing: Angle::rad(track.roll.to_rad().abs()),
        rake: Angle::deg(90.0) - lead,
        edges: Edges::Double,
    };
    let flank = if track.roll >= Angle::ZERO {
        Flank::Left
    } else {
        Flank::Right
    };
    (holder, flank)
}

/// How far beside the work the disc is clear of it while it turns.
pub(crate) fn extension(planned: &Planned) -> Length {
    let FinishDisc { setup, disc, .. } = &planned.asked;
    let blade = disc.in_program();
    let reach = planned.plan.tracks.iter().map(|track| {
        let (holder, flank) = posture(track, planned.plan.lead);
        let held = [Feed::Forward, Feed::Backward].map(|feed| holder.cutting(flank, feed));
        let [near, far] = blade.extent(held).y;
        far.max(-near)
    });
    Length::mm(reach.fold(disc.radius.value.to_mm(), f64::max)) + setup.run_out.value
}
