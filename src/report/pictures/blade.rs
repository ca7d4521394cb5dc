//! The blade of a job as it is held: for people who clamp it.

use crate::Material;
use vcutc_diagnostics::number::show;
use vcutc_job::BladeRef;
use vcutc_picture::{Prefix, blade};

/// The blade of the first operation with the axes of its frame (`picture::blade`); none for a job that plans nothing, and for a blade that
/// is not straight.
#[must_use]
pub fn blade(material: &Material<'_>, ids: Prefix) -> Option<String> {
    let asked = material.plan.operations.first()?.asked();
    let Some(BladeRef::Straight(held)) = asked.blades().into_iter().next() else {
        return None;
    };
    let setup = asked.setup();
    let subtitle = format!(
        "blade `{}`, {} mm long, {} mm thick, over the work at swing 0",
        held.name,
        show(held.cutting_length.value.to_mm()),
        show(held.thickness.value.to_mm())
    );
    Some(blade::draw(&blade::Blade {
        heading: blade::Heading {
            ids,
            title: "The blade in the hand: the axes of `tool`",
            subtitle: &subtitle,
        },
        rake: setup.rake.value.to_rad(),
        half_apex: held.half_apex.value.to_rad(),
        edges: held.edges,
    }))
}
