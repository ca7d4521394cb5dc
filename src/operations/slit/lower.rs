//! The moves of slitting walls: down, along a wall with the blade in the plane of its way, and up.

use crate::decided::Planned;
use core::num::NonZeroU32;
use vcutc_backend_api::builder::ProgramBuilder;
use vcutc_backend_api::ir::{OperationKind, SourceRef};
use vcutc_backend_api::units::Length;
use vcutc_process::beside::{Drive, Stage, Writer};
use vcutc_process::lower::BLEND;
use vcutc_process::slits::lower::{Heights, Series};

/// What programs call it.
pub(crate) const KIND: OperationKind = OperationKind::named("slit_walls").unwrap();

/// Appends the ops of one operation.
pub(crate) fn lower(planned: &Planned, source: SourceRef, builder: &mut ProgramBuilder) {
    let (asked, plan) = (&planned.asked, &planned.plan);
    let operation = builder.operation(KIND, asked.blade.in_program(), source);
    builder.blend(BLEND);
    let stage = Stage {
        operation,
        feed: builder.feed(asked.setup.cut_feed.value),
        extension: Length::ZERO,
        hang: Length::ZERO,
        drives: &[Drive::Generator],
    };
    let mut writer = Writer::new(stage, &asked.setup, builder);
    let paces = writer.paces(&asked.setup, asked.plunge_feed.value);
    let series = Series {
        slits: &plan.slits,
        heights: Heights {
            top: plan.top,
            floor: asked.floor.value.to_mm(),
            air: plan.air,
        },
        edges: asked.blade.edges,
        operation,
        layer: NonZeroU32::MIN,
    };
    series.write(writer, paces);
}
