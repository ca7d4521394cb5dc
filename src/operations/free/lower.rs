//! The moves of freeing a pocket: the slits of some layers, then for each of them the ways of the disc.

use crate::decided::Planned;
use crate::plan::Stage as Layers;
use core::num::NonZeroU32;
use vcutc_backend_api::builder::ProgramBuilder;
use vcutc_backend_api::ir::{OperationId, OperationKind, Site, SourceRef};
use vcutc_backend_api::units::Length;
use vcutc_job::Setup;
use vcutc_process::beside::{Drive, Entrance, Stage, Step, Writer};
use vcutc_process::lower::BLEND;
use vcutc_process::pen::{Pace, Path, Pen};
use vcutc_process::posture::spinning_upright;
use vcutc_process::slits::lower::{Heights, Series};
use vcutc_region::pass::Pass;

/// What programs call it.
pub(crate) const KIND: OperationKind = OperationKind::named("free_pocket").unwrap();

/// Appends the ops of one operation.
pub(crate) fn lower(planned: &Planned, source: SourceRef, builder: &mut ProgramBuilder) {
    let asked = &planned.asked;
    let operation = builder.operation(KIND, asked.blade.in_program(), source);
    builder.blend(BLEND);
    let mut layer = NonZeroU32::MIN;
    let mut above = planned.plan.top;
    for stage in &planned.plan.stages {
        builder.change(asked.blade.in_program());
        slit(planned, (stage, above), (operation, layer), builder);
        builder.change(asked.disc.in_program());
        let setup = Setup {
            cut_feed: asked.free_feed,
            ..asked.setup.clone()
        };
        let stage_of_disc = Stage {
            operation,
            feed: builder.feed(asked.free_feed.value),
            extension: Length::ZERO,
            hang: Length::ZERO,
            drives: &[Drive::Spindle, Drive::Generator],
        };
        let mut writer = Writer::new(stage_of_disc, &setup, builder);
        let paces = writer.paces(&setup, asked.plunge_feed.value);
        // Slits of a layer come first, so its ways of the disc are counted on from them.
        let mut begun = stage.slits.len();
        for &floor in &stage.floors {
            for (number, pass) in planned.plan.passes.iter().enumerate() {
                let path = path(pass, floor);
                let steps = path
                    .stretches
                    .iter()
                    .map(|stretch| paces.step(stretch, spinning_upright()));
                let steps: Vec<Step> = steps.collect();
                let number = u32::try_from(begun + number).unwrap_or(u32::MAX);
                let site = Site::Cut {
                    operation,
                    layer,
                    cut: NonZeroU32::MIN.saturating_add(number),
                };
                writer.path(site, Entrance::of(path.from, spinning_upright()), &steps);
            }
            begun = 0;
            layer = layer.saturating_add(1);
            above = floor;
        }
        writer.leave();
    }
}

/// The slits of some layers, the first of which has this number and begins at a height.
fn slit(
    planned: &Planned,
    (stage, above): (&Layers, f64),
    (operation, layer): (OperationId, NonZeroU32),
    builder: &mut ProgramBuilder,
) {
    let (asked, plan) = (&planned.asked, &planned.plan);
    let of_blade = Stage {
        operation,
        feed: builder.feed(asked.setup.cut_feed.value),
        extension: Length::ZERO,
        hang: Length::ZERO,
        drives: &[Drive::Generator],
    };
    let mut writer = Writer::new(of_blade, &asked.setup, builder);
    let paces = writer.paces(&asked.setup, asked.plunge_feed.value);
    let series = Series {
        slits: &stage.slits,
        heights: Heights {
            top: above,
            floor: stage.floors.last().copied().unwrap_or(above),
            air: plan.air,
        },
        edges: asked.blade.edges,
        operation,
        layer,
    };
    series.write(writer, paces);
}

/// A way of the disc at the floor of a layer.
fn path(pass: &Pass, floor: f64) -> Path {
    let mut pieces = pass.pieces.iter();
    let begin = pass.pieces.first().map(|piece| piece.from);
    let mut pen = Pen::at(begin.unwrap_or(vcutc_region::place::Place::new(0.0, 0.0)), floor);
    pieces
        .by_ref()
        .for_each(|piece| pen.piece(*piece, floor, Pace::Cut));
    pen.finish()
}
