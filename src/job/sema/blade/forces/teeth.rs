//! The forces of a crusher with teeth.

use super::{Given, SOURCE_FIELD, SPREAD_FIELD};
use crate::forces::{ChipParts, MeasuredTeeth, TeethForces};
use crate::sema::arguments::{Parameter, calls};
use crate::sema::eval::Scope;
use crate::sema::field_ranges::{CUTTING_PRESSURE, EDGE_FORCE, HELIX, SIZE, SPIN, TEETH};
use crate::sema::fields::{BlockSpec, Fields, Inner, Takes, block, value};
use crate::sema::quantity::Measured;
use crate::sema::read::Reader;
use crate::sema::report::Checked;
use crate::sema::session::Session;
use crate::sema::setup::inner_place;
use core::num::NonZeroU32;
use vcutc_diagnostics::schema::range::Range;
use vcutc_syntax::ast::Block;

pub(in crate::sema::blade) const TEETH_FORCES: BlockSpec = BlockSpec {
    title: "`forces` of a crusher",
    fields: &[
        value("teeth", "2").required().within(TEETH),
        value("helix", "30 deg").required().within(HELIX),
        value("cutting", CUTTING)
            .required()
            .takes(Takes::Calls(CUTTING_CALLS)),
        value("edge", EDGE).required().takes(Takes::Calls(EDGE_CALLS)),
        SPREAD_FIELD,
        block("measured", "{ chip = 0.1 mm, spin = 18000 rev/min }")
            .required()
            .takes(Takes::Fields(&MEASURED)),
        SOURCE_FIELD,
    ],
    inner: Inner::Refused,
};

const MEASURED: BlockSpec = BlockSpec {
    title: "`measured` of a crusher",
    fields: &[
        value("chip", "0.1 mm").required().within(SIZE),
        value("spin", "18000 rev/min").required().within(SPIN),
    ],
    inner: Inner::Refused,
};

const CUTTING: &str = "pressure(tangential = 20 N/mm2, radial = 8 N/mm2, axial = 6 N/mm2)";
const CUTTING_CALLS: &[(&str, &str)] = &[("pressure", CUTTING)];
const EDGE: &str = "force(tangential = 0.4 N/mm, radial = 0.5 N/mm, axial = 0.1 N/mm)";
const EDGE_CALLS: &[(&str, &str)] = &[("force", EDGE)];

/// What the parts of a force take.
const fn parts(range: Range, typical: [&'static str; 3]) -> [Parameter<'static>; 3] {
    let [tangential, radial, axial] = typical;
    [
        part("tangential", range, tangential),
        part("radial", range, radial),
        part("axial", range, axial),
    ]
}

const fn part(name: &'static str, range: Range, typical: &'static str) -> Parameter<'static> {
    Parameter { name, range, typical }
}

pub(in crate::sema::blade) fn of_teeth(
    inner: &Block,
    given: Given<'_>,
    session: &mut Session<'_>,
) -> Checked<TeethForces> {
    let fields = Fields::sort(&TEETH_FORCES, inner_place(inner), &inner.entries, session);
    let conditions = fields
        .required_block("measured", &mut session.reports)
        .and_then(|inner| measured(inner, given.scope, session));
    let mut reader = Reader::new(given.scope, &mut session.reports);
    let count = fields
        .required_value("teeth", reader.reports)
        .and_then(|expr| reader.whole(expr, TEETH, "`teeth`"));
    let helix = reader.required(&fields, "helix");
    let typical = ["20 N/mm2", "8 N/mm2", "6 N/mm2"];
    let cutting = chip(
        "cutting",
        CUTTING_CALLS,
        &parts(CUTTING_PRESSURE, typical),
        &fields,
        &mut reader,
    );
    let typical = ["0.4 N/mm", "0.5 N/mm", "0.1 N/mm"];
    let edge = chip(
        "edge",
        EDGE_CALLS,
        &parts(EDGE_FORCE, typical),
        &fields,
        &mut reader,
    );
    let statement = given.statement(&fields, &mut reader);
    Ok(TeethForces {
        count: NonZeroU32::new(count?).unwrap_or(NonZeroU32::MIN),
        helix: helix?,
        cutting: cutting?,
        edge: edge?,
        measured: conditions?,
        statement: statement?,
    })
}

fn chip<F: Measured>(
    name: &'static str,
    forms: &'static [(&'static str, &'static str)],
    parts: &[Parameter<'static>; 3],
    fields: &Fields<'_>,
    reader: &mut Reader<'_>,
) -> Checked<ChipParts<F>> {
    let expr = fields.required_value(name, reader.reports)?;
    let call = calls(name, expr, forms, reader.reports)?;
    let [tangential, radial, axial] = call.named(parts, reader)?.map(F::from_base);
    Ok(ChipParts {
        tangential,
        radial,
        axial,
    })
}

fn measured(inner: &Block, scope: Scope<'_>, session: &mut Session<'_>) -> Checked<MeasuredTeeth> {
    let fields = Fields::sort(&MEASURED, inner_place(inner), &inner.entries, session);
    let mut reader = Reader::new(scope, &mut session.reports);
    let chip = reader.required(&fields, "chip");
    let spin = reader.required(&fields, "spin");
    Ok(MeasuredTeeth {
        chip: chip?,
        spin: spin?,
    })
}
