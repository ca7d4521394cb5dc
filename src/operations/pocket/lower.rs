//! The moves of clearing a pocket: for each layer the ways down, the passes with their links, and the ways up.

use crate::decided::Planned;
use core::num::NonZeroU32;
use vcutc_backend_api::builder::ProgramBuilder;
use vcutc_backend_api::ir::{OperationKind, Site, SourceRef};
use vcutc_backend_api::units::Length;
use vcutc_process::beside::{Drive, Entrance, Stage, Step, Writer};
use vcutc_process::lower::BLEND;
use vcutc_process::posture::spinning_upright;

/// What programs call it.
pub(crate) const KIND: OperationKind = OperationKind::named("clear_pocket").unwrap();

/// Appends the ops of one operation.
pub(crate) fn lower(planned: &Planned, source: SourceRef, builder: &mut ProgramBuilder) {
    let asked = &planned.asked;
    let operation = builder.operation(KIND, asked.crusher.in_program(), source);
    if let Some(opening) = asked.opening_in_program() {
        builder.opening(opening);
    }
    builder.blend(BLEND);
    let stage = Stage {
        operation,
        feed: builder.feed(asked.setup.cut_feed.value),
        extension: Length::ZERO,
        hang: Length::ZERO,
        drives: &[Drive::Spindle],
    };
    let mut writer = Writer::new(stage, &asked.setup, builder);
    let paces = writer.paces(&asked.setup, asked.plunge_feed.value);
    let mut number = NonZeroU32::MIN;
    for layer in planned.paths() {
        let mut pass = NonZeroU32::MIN;
        for path in layer {
            let steps: Vec<Step> = path
                .stretches
                .iter()
                .map(|stretch| paces.step(stretch, spinning_upright()))
                .collect();
            let site = Site::Cut {
                operation,
                layer: number,
                cut: pass,
            };
            writer.path(site, Entrance::of(path.from, spinning_upright()), &steps);
            pass = pass.saturating_add(1);
        }
        number = number.saturating_add(1);
    }
    writer.leave();
}
