//! The forces of a disc.

use super::{Given, SOURCE_FIELD, SPREAD_FIELD};
use crate::forces::{MeasuredRim, RimForces, RimParts};
use crate::sema::eval::Scope;
use crate::sema::field_ranges::{EDGE_FORCE, GROWTH, SPEED, SPIN};
use crate::sema::fields::{BlockSpec, Fields, Inner, Takes, block, value};
use crate::sema::read::Reader;
use crate::sema::report::Checked;
use crate::sema::session::Session;
use crate::sema::setup::inner_place;
use vcutc_syntax::ast::Block;

pub(in crate::sema::blade) const RIM_FORCES: BlockSpec = BlockSpec {
    title: "`forces` of a disc",
    fields: &[
        value("drag", "1.0 N/mm").required().within(EDGE_FORCE),
        value("axial", "0.5 N/mm").required().within(EDGE_FORCE),
        value("radial", "0.2 N/mm").required().within(EDGE_FORCE),
        SPREAD_FIELD,
        value("failed", "1.42").within(GROWTH),
        block("measured", "{ feed = 50 mm/s, spin = 3000 rev/min }")
            .required()
            .takes(Takes::Fields(&MEASURED)),
        SOURCE_FIELD,
    ],
    inner: Inner::Refused,
};

const MEASURED: BlockSpec = BlockSpec {
    title: "`measured` of a disc",
    fields: &[
        value("feed", "50 mm/s").required().within(SPEED),
        value("spin", "3000 rev/min").required().within(SPIN),
    ],
    inner: Inner::Refused,
};

pub(in crate::sema::blade) fn of_rim(
    inner: &Block,
    given: Given<'_>,
    session: &mut Session<'_>,
) -> Checked<RimForces> {
    let fields = Fields::sort(&RIM_FORCES, inner_place(inner), &inner.entries, session);
    let conditions = fields
        .required_block("measured", &mut session.reports)
        .and_then(|inner| measured(inner, given.scope, session));
    let mut reader = Reader::new(given.scope, &mut session.reports);
    let drag = reader.required(&fields, "drag");
    let axial = reader.required(&fields, "axial");
    let radial = reader.required(&fields, "radial");
    let failed = reader.optional(&fields, "failed");
    let statement = given.statement(&fields, &mut reader);
    Ok(RimForces {
        rim: RimParts {
            drag: drag?.value,
            axial: axial?.value,
            radial: radial?.value,
        },
        failed: failed?,
        measured: conditions?,
        statement: statement?,
    })
}

fn measured(inner: &Block, scope: Scope<'_>, session: &mut Session<'_>) -> Checked<MeasuredRim> {
    let fields = Fields::sort(&MEASURED, inner_place(inner), &inner.entries, session);
    let mut reader = Reader::new(scope, &mut session.reports);
    let feed = reader.required(&fields, "feed");
    let spin = reader.required(&fields, "spin");
    Ok(MeasuredRim {
        feed: feed?,
        spin: spin?,
    })
}
