//! `forces { ... }`: what the edge of a blade pushes with, as it was measured.

use crate::forces::{Forces, Measured, Parts};
use crate::sema::arguments::{Parameter, calls};
use crate::sema::eval::Scope;
use crate::sema::field_ranges::{EDGE_FORCE, FORCE, GROWTH, RAKE, SPEED, SPREAD, SWING_OR_UPRIGHT};
use crate::sema::fields::{BlockSpec, Fields, Inner, Takes, block, value};
use crate::sema::quantity::Measured as _;
use crate::sema::read::Reader;
use crate::sema::report::Checked;
use crate::sema::session::Session;
use crate::sema::setup::inner_place;
use vcutc_backend_api::units::Force;
use vcutc_diagnostics::source::{Span, Spanned};
use vcutc_syntax::ast::{Block, Expr};

pub(crate) const FORCES: BlockSpec = BlockSpec {
    title: "`forces`",
    fields: &[
        value("drag", "1.0 N/mm").required().within(EDGE_FORCE),
        value("axial", "0.3 N/mm").required().within(EDGE_FORCE),
        value("side", "0.2 N/mm").required().within(EDGE_FORCE),
        value("tip", TIP).takes(Takes::Calls(TIPS)),
        value("spread", "30 %").required().within(SPREAD),
        value("failed", "1.42").within(GROWTH),
        block("measured", "{ feed = 200 mm/s, rake = 60 deg, swing = 35 deg }")
            .required()
            .takes(Takes::Fields(&MEASURED)),
        value("source", "\"our dynamometer, protocol 12\"").required(),
    ],
    inner: Inner::Refused,
};

const MEASURED: BlockSpec = BlockSpec {
    title: "`measured`",
    fields: &[
        value("feed", "200 mm/s").required().within(SPEED),
        value("rake", "60 deg").required().within(RAKE),
        value("swing", "35 deg").required().within(SWING_OR_UPRIGHT),
    ],
    inner: Inner::Refused,
};

const TIP: &str = "force(drag = 2 N, axial = 1 N, side = 0 N)";
const TIPS: &[(&str, &str)] = &[("force", TIP)];
const PARTS: &[Parameter<'_>; 3] = &[part("drag", "2 N"), part("axial", "1 N"), part("side", "0 N")];

const fn part(name: &'static str, typical: &'static str) -> Parameter<'static> {
    Parameter {
        name,
        range: FORCE,
        typical,
    }
}

/// The forces, if the blade states some, and where.
pub(super) fn check(
    given: Option<(&Block, Span)>,
    scope: Scope<'_>,
    session: &mut Session<'_>,
) -> Checked<Option<Forces>> {
    match given {
        Some((inner, span)) => stated(inner, span, scope, session).map(Some),
        None => Ok(None),
    }
}

fn stated(inner: &Block, span: Span, scope: Scope<'_>, session: &mut Session<'_>) -> Checked<Forces> {
    let fields = Fields::sort(&FORCES, inner_place(inner), &inner.entries, session);
    let conditions = fields
        .required_block("measured", &mut session.reports)
        .and_then(|inner| measured(inner, scope, session));
    let mut reader = Reader::new(scope, &mut session.reports);
    let drag = reader.required(&fields, "drag");
    let axial = reader.required(&fields, "axial");
    let side = reader.required(&fields, "side");
    let tip = match fields.value("tip") {
        Ok(Some(expr)) => at_tip(expr, &mut reader),
        Ok(None) => Ok(Parts::default()),
        Err(reported) => Err(reported),
    };
    let spread = reader.required(&fields, "spread");
    let failed = reader.optional(&fields, "failed");
    let named = fields.required_value("source", reader.reports);
    let source = reader.text(&fields, "source");
    named?;
    Ok(Forces {
        span,
        edge: Parts {
            drag: drag?.value,
            axial: axial?.value,
            side: side?.value,
        },
        tip: tip?,
        spread: spread?,
        failed: failed?,
        measured: conditions?,
        source: source?.map(|source| source.node).unwrap_or_default(),
    })
}

fn measured(inner: &Block, scope: Scope<'_>, session: &mut Session<'_>) -> Checked<Measured> {
    let fields = Fields::sort(&MEASURED, inner_place(inner), &inner.entries, session);
    let mut reader = Reader::new(scope, &mut session.reports);
    let feed = reader.required(&fields, "feed");
    let rake = reader.required(&fields, "rake");
    let swing = reader.required(&fields, "swing");
    Ok(Measured {
        feed: feed?,
        rake: rake?,
        swing: swing?,
    })
}

fn at_tip(expr: &Spanned<Expr>, reader: &mut Reader<'_>) -> Checked<Parts<Force>> {
    let call = calls("tip", expr, TIPS, reader.reports)?;
    let [drag, axial, side] = call.named(PARTS, reader)?.map(Force::from_base);
    Ok(Parts { drag, axial, side })
}
