//! The forces of a straight blade.

use super::{Given, SOURCE_FIELD, SPREAD_FIELD};
use crate::forces::{EdgeForces, EdgeParts, MeasuredEdge};
use crate::sema::arguments::{Parameter, calls};
use crate::sema::eval::Scope;
use crate::sema::field_ranges::{EDGE_FORCE, FORCE, GROWTH, RAKE, SPEED, SWING_OR_UPRIGHT};
use crate::sema::fields::{BlockSpec, Fields, Inner, Takes, block, value};
use crate::sema::quantity::Measured as _;
use crate::sema::read::Reader;
use crate::sema::report::Checked;
use crate::sema::session::Session;
use crate::sema::setup::inner_place;
use vcutc_backend_api::units::Force;
use vcutc_diagnostics::source::Spanned;
use vcutc_syntax::ast::{Block, Expr};

pub(in crate::sema::blade) const EDGE_FORCES: BlockSpec = BlockSpec {
    title: "`forces`",
    fields: &[
        value("drag", "1.0 N/mm").required().within(EDGE_FORCE),
        value("axial", "0.3 N/mm").required().within(EDGE_FORCE),
        value("side", "0.2 N/mm").required().within(EDGE_FORCE),
        value("tip", TIP).takes(Takes::Calls(TIPS)),
        SPREAD_FIELD,
        value("failed", "1.42").within(GROWTH),
        block("measured", "{ feed = 200 mm/s, rake = 60 deg, swing = 35 deg }")
            .required()
            .takes(Takes::Fields(&MEASURED)),
        SOURCE_FIELD,
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

pub(in crate::sema::blade) fn of_edge(
    inner: &Block,
    given: Given<'_>,
    session: &mut Session<'_>,
) -> Checked<EdgeForces> {
    let fields = Fields::sort(&EDGE_FORCES, inner_place(inner), &inner.entries, session);
    let conditions = fields
        .required_block("measured", &mut session.reports)
        .and_then(|inner| measured(inner, given.scope, session));
    let mut reader = Reader::new(given.scope, &mut session.reports);
    let drag = reader.required(&fields, "drag");
    let axial = reader.required(&fields, "axial");
    let side = reader.required(&fields, "side");
    let tip = match fields.value("tip") {
        Ok(Some(expr)) => at_tip(expr, &mut reader),
        Ok(None) => Ok(EdgeParts::default()),
        Err(reported) => Err(reported),
    };
    let failed = reader.optional(&fields, "failed");
    let statement = given.statement(&fields, &mut reader);
    Ok(EdgeForces {
        edge: EdgeParts {
            drag: drag?.value,
            axial: axial?.value,
            side: side?.value,
        },
        tip: tip?,
        failed: failed?,
        measured: conditions?,
        statement: statement?,
    })
}

fn measured(inner: &Block, scope: Scope<'_>, session: &mut Session<'_>) -> Checked<MeasuredEdge> {
    let fields = Fields::sort(&MEASURED, inner_place(inner), &inner.entries, session);
    let mut reader = Reader::new(scope, &mut session.reports);
    let feed = reader.required(&fields, "feed");
    let rake = reader.required(&fields, "rake");
    let swing = reader.required(&fields, "swing");
    Ok(MeasuredEdge {
        feed: feed?,
        rake: rake?,
        swing: swing?,
    })
}

fn at_tip(expr: &Spanned<Expr>, reader: &mut Reader<'_>) -> Checked<EdgeParts<Force>> {
    let call = calls("tip", expr, TIPS, reader.reports)?;
    let [drag, axial, side] = call.named(PARTS, reader)?.map(Force::from_base);
    Ok(EdgeParts { drag, axial, side })
}
