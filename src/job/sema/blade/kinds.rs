//! The tables of fields of the kinds of blades.

use super::forces::{EDGE_FORCES, RIM_FORCES, TEETH_FORCES};
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
        block("forces", OF_AN_EDGE).takes(Takes::Fields(&EDGE_FORCES)),
    ],
    inner: Inner::Refused,
};

const OF_AN_EDGE: &str = "{ drag = 1.0 N/mm, axial = 0.3 N/mm, side = 0.2 N/mm, spread = 30 %, \
     measured { feed = 200 mm/s, rake = 60 deg, swing = 35 deg }, source = \"our dynamometer\" }";
const OF_A_RIM: &str = "{ drag = 1.0 N/mm, axial = 0.5 N/mm, radial = 0.2 N/mm, spread = 30 %, \
     measured { feed = 50 mm/s, spin = 3000 rev/min }, source = \"our dynamometer\" }";
const OF_TEETH: &str = "{ teeth = 2, helix = 30 deg, \
     cutting = pressure(tangential = 20 N/mm2, radial = 8 N/mm2, axial = 6 N/mm2), \
     edge = force(tangential = 0.4 N/mm, radial = 0.5 N/mm, axial = 0.1 N/mm), spread = 30 %, \
     measured { chip = 0.1 mm, spin = 18000 rev/min }, source = \"our dynamometer\" }";

const DISC: BlockSpec = BlockSpec {
    title: "`disc`",
    fields: &[
        value("radius", "25 mm").required().within(SIZE),
        value("thickness", "1.5 mm").required().within(SIZE),
        value("depth", "10 mm").required().within(SIZE),
        value("width", "12 mm").required().within(SIZE),
        value("spin", "3000 rev/min").required().within(SPIN),
        points("body", "(1.5 mm, 8 mm) (60 mm, 25 mm)").required(),
        block("forces", OF_A_RIM).takes(Takes::Fields(&RIM_FORCES)),
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
        block("forces", OF_TEETH).takes(Takes::Fields(&TEETH_FORCES)),
    ],
    inner: Inner::Refused,
};

pub(super) const EDGES: &[(&str, Edges)] = &[("single", Edges::Single), ("double", Edges::Double)];
