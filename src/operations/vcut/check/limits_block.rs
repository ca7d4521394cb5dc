//! `limits { ... }` of an operation: bounds on what may be chosen and on what comes out.

use crate::asked::Limits;
use vcutc_job::sema::both::both;
use vcutc_job::sema::eval::Scope;
use vcutc_job::sema::field_ranges::{LONGEST_TIME, MOST_CUTS, SIZE, SWING};
use vcutc_job::sema::fields::{BlockSpec, Fields, Inner, bounds, limit};
use vcutc_job::sema::read::Reader;
use vcutc_job::sema::report::Checked;
use vcutc_job::sema::session::Session;
use vcutc_job::sema::setup::inner_place;
use vcutc_syntax::ast::Block;

pub(super) const LIMITS: BlockSpec = BlockSpec {
    title: "`limits`",
    fields: &[
        bounds("swing", "50 deg").within(SWING),
        bounds("layer", "6 mm").within(SIZE),
        bounds("step", "8 mm").within(SIZE),
        limit("scallop", "10 mm").within(SIZE),
        limit("edge", "10 mm").within(SIZE),
        limit("deviation", "0.2 mm").within(SIZE),
        limit("time", "10 min").within(LONGEST_TIME),
        limit("cuts", "200").within(MOST_CUTS),
    ],
    inner: Inner::Refused,
};

/// The bounds of the block, if there is one.
pub(super) fn check(inner: Option<&Block>, scope: Scope<'_>, session: &mut Session<'_>) -> Checked<Limits> {
    let Some(inner) = inner else {
        return Ok(Limits::default());
    };
    let fields = Fields::sort(&LIMITS, inner_place(inner), &inner.entries, session);
    let mut reader = Reader::new(scope, &mut session.reports);
    let swing = both(&fields, "swing", &mut reader);
    let layer = both(&fields, "layer", &mut reader);
    let step = both(&fields, "step", &mut reader);
    let scallop = reader.optional(&fields, "scallop");
    let edge = reader.optional(&fields, "edge");
    let deviation = reader.optional(&fields, "deviation");
    let time = reader.optional(&fields, "time");
    let cuts = reader.optional(&fields, "cuts");
    Ok(Limits {
        swing: swing?,
        layer: layer?,
        step: step?,
        scallop: scallop?,
        chosen: None,
        edge: edge?,
        deviation: deviation?,
        time: time?,
        cuts: cuts?,
    })
}
