//! `blade NAME { ... }`.

mod body;

use super::eval::Scope;
use super::fields::{BlockSpec, Fields, Inner, Place, Takes, points, value};
use super::range::{DISTANCE, HALF_APEX, SIZE};
use super::read::{Reader, words_of};
use super::report::Checked;
use super::session::Session;
use crate::Blade;
use vcutc_backend_api::ir::Edges;
use vcutc_diagnostics::source::Spanned;
use vcutc_syntax::ast::Block;

pub(crate) const SPEC: BlockSpec = BlockSpec {
    title: "`blade`",
    fields: &[
        value("cutting_length", "10 mm").required().within(SIZE),
        value("half_apex", "7.13 deg").required().within(HALF_APEX),
        value("thickness", "1.5 mm").required().within(DISTANCE),
        value("edges", "double")
            .required()
            .takes(Takes::Words(|| words_of(EDGES))),
        points("body", "(40 mm, 8 mm) (90 mm, 30 mm)"),
    ],
    inner: Inner::Refused,
};

const EDGES: &[(&str, Edges)] = &[("single", Edges::Single), ("double", Edges::Double)];

/// A blade.
pub(crate) fn check(
    name: Spanned<&str>,
    block: &Block,
    place: Place,
    scope: Scope<'_>,
    session: &mut Session<'_>,
) -> Checked<Blade> {
    let fields = Fields::sort(&SPEC, place, &block.entries, session);
    let mut reader = Reader::new(scope, &mut session.reports);
    let cutting_length = reader.required(&fields, "cutting_length");
    let half_apex = reader.required(&fields, "half_apex");
    let thickness = reader.required(&fields, "thickness");
    let edges = fields
        .required_value("edges", reader.reports)
        .and_then(|expr| reader.word("edges", expr, EDGES));
    let body = body::check(&fields, cutting_length.ok(), &mut reader);
    Ok(Blade {
        name: name.node.to_owned(),
        span: name.span,
        cutting_length: cutting_length?,
        half_apex: half_apex?,
        thickness: thickness?,
        edges: edges?.value,
        body: body?,
    })
}
