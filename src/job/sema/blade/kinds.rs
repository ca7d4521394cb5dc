//! The tables of fields of the kinds of blades.

use super::forces::FORCES;
use crate::BladeKind;
use crate::sema::field_ranges::{DISTANCE, HALF_APEX, RAMP, SIZE, SPIN};
use crate::sema::fields::{BlockSpec, Inner, Takes, block, points, value};
use crate::sema::read::words_of;
use vcutc_backend_api::ir::Edges;

/// The fields of a blade of this kind.
pub(crate) const fn spec(kind: BladeKind) -> &'static BlockSpec {
    match kind {
        BladeKind::Straight => &STRAIGHT,
        BladeKind::Disc => &DISC,
        BladeKind::Crusher => &CRUSHER,
    }
}

const STRAIGHT: BlockSpec = BlockSpec {
    title: "`blade`",
    fields: &[
        value("cutting_length", "10 mm").required().within(SIZE),
        value("half_apex", "7.13 deg").required().within(HALF_APEX),
        value("thickness", "1.5 mm").required().within(DISTANCE),
        value("edges", "double")
            .required()
            .takes(Takes::Words(|| words_of(EDGES))),
        points("body", "(40 mm, 8 mm) (90 mm, 30 mm)"),
        block("forces", FORCES_SAMPLE).takes(Takes::Fields(&FORCES)),
    ],
    inner: Inner::Refused,
};

const FORCES_SAMPLE: &str = "{ drag = 1.0 N/mm, axial = 0.3 N/mm, side = 0.2 N/mm, spread = 30 %, \
     measured { feed = 200 mm/s, rake = 60 deg, swing = 35 deg }, source = \"our dynamometer\" }";

const DISC: BlockSpec = BlockSpec {
    title: "`disc`",
    fields: &[
        value("radius", "25 mm").required().within(SIZE),
        value("thickness", "1.5 mm").required().within(SIZE),
        value("depth", "10 mm").required().within(SIZE),
        value("width", "12 mm").required().within(SIZE),
        value("spin", "3000 rev/min").required().within(SPIN),
        points("body", "(1.5 mm, 8 mm) (60 mm, 25 mm)").required(),
    ],
    inner: Inner::Refused,
};

const CRUSHER: BlockSpec = BlockSpec {
    title: "`crusher`",
    fields: &[
        value("radius", "6 mm").required().within(SIZE),
        value("height", "24 mm").required().within(SIZE),
        value("spin", "18000 rev/min").required().within(SPIN),
        value("ramp", "5 deg").required().within(RAMP),
        points("body", "(24 mm, 5 mm) (60 mm, 20 mm)"),
    ],
    inner: Inner::Refused,
};

pub(super) const EDGES: &[(&str, Edges)] = &[("single", Edges::Single), ("double", Edges::Double)];
