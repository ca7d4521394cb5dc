//! The moves of rectangular roughing (`docs/process.md`, "Rectangular roughing").
//!
//! Both blades cut to and fro along y. They begin and end beside the work, far enough out that they may turn there: the shank of
//! either leans along its feed, so between two cuts it goes over to the other side. From one stage to the next the blade goes up,
//! generator and spindle stop, and another blade is put in.
//!
//! In each layer slits are numbered from left to right, and after them strips, whatever the order in which they are cut. A slit
//! through several layers belongs to the highest of them.

use crate::asked::RoughRect;
use crate::decided::Planned;
use crate::plan::{self, PlannedRect, Slit, Strip};
use core::num::NonZeroU32;
use std::collections::BTreeMap;
use vcutc_backend_api::builder::ProgramBuilder;
use vcutc_backend_api::ir::{Edges, Flank, OperationId, OperationKind, Site, SourceRef};
use vcutc_backend_api::units::{Angle, Length};
use vcutc_geometry::curve::Point2;
use vcutc_process::beside::{Drive, Motion, Pass, Stage, Writer};
use vcutc_process::posture::Holder;

/// What programs call it.
const KIND: OperationKind = OperationKind::named("rough_rect").unwrap();

/// Appends the ops of one operation.
pub(crate) fn lower(planned: &Planned, source: SourceRef, builder: &mut ProgramBuilder) {
    let asked = &planned.asked;
    let operation = builder.operation(KIND, asked.blade.in_program(), source);
    let numbers = Numbers::of(&planned.plan);
    for stage in &planned.plan.stages {
        match stage {
            plan::Stage::Slits { layers, slits } => {
                builder.change(asked.blade.in_program());
                let stage = slits_stage(planned, operation, builder);
                let mut writer = Writer::new(stage, &asked.setup, builder);
                let layer = *layers.start();
                for slit in slits {
                    writer.pass(&Pass {
                        site: site(operation, layer, numbers.slit(layer, slit)),
                        at: Point2::new(slit.x, slit.bottom),
                        holder: slit_holder(asked),
                        // A slit is the left flank of a V without swing.
                        flank: Flank::Left,
                        motion: Motion::Cut,
                    });
                }
                writer.leave();
            }
            plan::Stage::Strips { strips, .. } => {
                builder.change(asked.disc.in_program());
                let stage = strips_stage(planned, operation, builder);
                let mut writer = Writer::new(stage, &asked.setup, builder);
                for strip in strips {
                    writer.pass(&Pass {
                        site: site(operation, strip.layer, numbers.strip(strip)),
                        at: strip.centre,
                        holder: strip_holder(asked),
                        flank: Flank::Left,
                        motion: Motion::Follow,
                    });
                }
                writer.leave();
            }
        }
    }
}

/// A place in the plan: a layer, and an x in nanometres.
type Place = (u32, i64);

/// The number of each slit and each strip in its layer.
pub(crate) struct Numbers {
    slits: BTreeMap<Place, NonZeroU32>,
    strips: BTreeMap<Place, NonZeroU32>,
}

impl Numbers {
    pub(crate) fn of(plan: &PlannedRect) -> Self {
        let slits = numbered(slits(plan).map(|(layer, slit)| place(layer, slit.x)), |_| 0);
        let before = |layer: u32| slits.range((layer, i64::MIN)..=(layer, i64::MAX)).count();
        let strips = plan.strips().map(|strip| place(strip.layer, strip.left));
        let strips = numbered(strips, before);
        Self { slits, strips }
    }

    fn slit(&self, layer: u32, slit: &Slit) -> NonZeroU32 {
        let number = self.slits.get(&place(layer, slit.x));
        number.copied().unwrap_or(NonZeroU32::MIN)
    }

    fn strip(&self, strip: &Strip) -> NonZeroU32 {
        let number = self.strips.get(&place(strip.layer, strip.left));
        number.copied().unwrap_or(NonZeroU32::MIN)
    }
}

/// Numbers places in each layer from left to right, after so many that come before.
fn numbered(
    places: impl Iterator<Item = Place>,
    before: impl Fn(u32) -> usize,
) -> BTreeMap<Place, NonZeroU32> {
    let sorted: std::collections::BTreeSet<Place> = places.collect();
    let mut numbers = BTreeMap::new();
    let (mut layer, mut count) = (0, 0);
    for at in sorted {
        if at.0 != layer {
            (layer, count) = (at.0, before(at.0));
        }
        let index = u32::try_from(count).unwrap_or(u32::MAX);
        numbers.insert(at, NonZeroU32::MIN.saturating_add(index));
        count += 1;
    }
    numbers
}

/// The slits of a plan with their layers.
pub(crate) fn slits(plan: &PlannedRect) -> impl Iterator<Item = (u32, &Slit)> {
    plan.stages.iter().flat_map(|stage| match stage {
        plan::Stage::Slits { layers, slits } => {
            let layer = *layers.start();
            slits.iter().map(move |slit| (layer, slit)).collect::<Vec<_>>()
        }
        plan::Stage::Strips { .. } => Vec::new(),
    })
}

fn place(layer: u32, x: f64) -> Place {
    (layer, (x * 1e6).round() as i64)
}

fn slits_stage(planned: &Planned, operation: OperationId, builder: &mut ProgramBuilder) -> Stage {
    Stage {
        operation,
        feed: builder.feed(planned.asked.setup.cut_feed.value),
        extension: planned.extensions.slits,
        hang: Length::ZERO,
        drives: &[Drive::Generator],
    }
}

fn strips_stage(planned: &Planned, operation: OperationId, builder: &mut ProgramBuilder) -> Stage {
    Stage {
        operation,
        feed: builder.feed(planned.asked.free_feed.value),
        extension: planned.extensions.strips,
        hang: planned.asked.disc.radius.value * planned.asked.lead.value.sin(),
        drives: &[Drive::Spindle, Drive::Generator],
    }
}

/// How the straight blade is held: upright across the feed.
pub(crate) const fn slit_holder(asked: &RoughRect) -> Holder {
    Holder {
        swing: Angle::ZERO,
        rake: asked.setup.rake.value,
        edges: asked.blade.edges,
    }
}

/// How the disc is held: its axis leans along the feed by the lead.
pub(crate) fn strip_holder(asked: &RoughRect) -> Holder {
    Holder {
        swing: Angle::ZERO,
        rake: Angle::deg(90.0) - asked.lead.value,
        edges: Edges::Double,
    }
}

/// A cut of a layer.
fn site(operation: OperationId, layer: u32, cut: NonZeroU32) -> Site {
    Site::Cut {
        operation,
        layer: NonZeroU32::MIN.saturating_add(layer.saturating_sub(1)),
        cut,
    }
}
