//! `limits { ... }` of an operation: bounds on what may be chosen and on what comes out.

use crate::asked::Limits;
use vcutc_diagnostics::source::Span;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_job::sema::eval::Scope;
use vcutc_job::sema::field_ranges::{LONGEST_TIME, MOST_CUTS, SIZE, SWING};
use vcutc_job::sema::fields::{BlockSpec, Fields, Inner, bounds, limit};
use vcutc_job::sema::quantity::{Measured, Quantity};
use vcutc_job::sema::read::Reader;
use vcutc_job::sema::report::Checked;
use vcutc_job::sema::session::Session;
use vcutc_job::sema::setup::inner_place;
use vcutc_job::{Bounds, Sourced};
use vcutc_syntax::ast::Block;

pub(super) const LIMITS: BlockSpec = BlockSpec {
    title: "`limits`",
    fields: &[
        bounds("swing", "50 deg").within(SWING),
        bounds("layer", "6 mm").within(SIZE),
        bounds("step", "8 mm").within(SIZE),
        limit("scallop", "10 mm").within(SIZE),
        limit("edge", "10 mm").within(SIZE),
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
    let time = reader.optional(&fields, "time");
    let cuts = reader.optional(&fields, "cuts");
    Ok(Limits {
        swing: swing?,
        layer: layer?,
        step: step?,
        scallop: scallop?,
        chosen: None,
        edge: edge?,
        time: time?,
        cuts: cuts?,
    })
}

/// Bounds from below and above, which must leave something between them.
fn both<T: Measured + Copy + PartialOrd>(
    fields: &Fields<'_>,
    name: &str,
    reader: &mut Reader<'_>,
) -> Checked<Bounds<T>> {
    let least: Checked<Option<Sourced<T>>> = reader.least(fields, name);
    let most: Checked<Option<Sourced<T>>> = reader.optional(fields, name);
    let bounds = Bounds {
        least: least?,
        most: most?,
    };
    if let (Some(least), Some(most)) = (bounds.least, bounds.most)
        && least.value > most.value
        && let (Some(low), Some(high)) = (least.span, most.span)
    {
        return Err(reader
            .reports
            .push(crossed(name, (text(least.value), low), (text(most.value), high))));
    }
    Ok(bounds)
}

fn text<T: Measured>(value: T) -> String {
    Quantity::new(value.to_base(), T::DIMENSION).text()
}

/// Bounds that no value keeps.
fn crossed(name: &str, (least, low): (String, Span), (most, high): (String, Span)) -> Diagnostic {
    Diagnostic::new(
        Code::OutOfRange,
        format!("no `{name}` is at least {least} and at most {most}"),
        low,
        format!("at least {least}"),
    )
    .and(high, format!("at most {most}"))
    .fix_all(
        format!("swap the two: at least {most} and at most {least}"),
        &[(low, most), (high, least)],
    )
}
