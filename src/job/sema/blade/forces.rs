//! `forces { ... }`: what a blade pushes with, as it was measured.

mod edge;
mod rim;
mod teeth;

pub(super) use edge::{EDGE_FORCES, of_edge};
pub(super) use rim::{RIM_FORCES, of_rim};
pub(super) use teeth::{TEETH_FORCES, of_teeth};

use crate::forces::Statement;
use crate::sema::eval::Scope;
use crate::sema::field_ranges::SPREAD;
use crate::sema::fields::{FieldSpec, Fields, value};
use crate::sema::read::Reader;
use crate::sema::report::Checked;
use crate::sema::session::Session;
use vcutc_diagnostics::source::Span;
use vcutc_syntax::ast::Block;

/// How sure all forces are, and where they are from.
const SPREAD_FIELD: FieldSpec = value("spread", "30 %").required().within(SPREAD);
const SOURCE_FIELD: FieldSpec = value("source", "\"our dynamometer, protocol 12\"").required();

/// Where a blade states its forces, if it does.
#[derive(Clone, Copy)]
pub(super) struct Given<'s> {
    pub(super) span: Span,
    pub(super) scope: Scope<'s>,
}

impl<'s> Given<'s> {
    /// The forces of a blade, if these fields of it state some.
    pub(super) fn check<F>(
        self,
        fields: &Fields<'_>,
        session: &mut Session<'_>,
        stated: fn(&Block, Self, &mut Session<'_>) -> Checked<F>,
    ) -> Checked<Option<F>> {
        match fields.block("forces")? {
            Some(inner) => stated(inner, self, session).map(Some),
            None => Ok(None),
        }
    }

    fn statement(self, fields: &Fields<'_>, reader: &mut Reader<'_>) -> Checked<Statement> {
        let spread = reader.required(fields, "spread");
        let named = fields.required_value("source", reader.reports);
        let source = reader.text(fields, "source");
        named?;
        Ok(Statement {
            span: self.span,
            spread: spread?,
            source: source?.map(|source| source.node).unwrap_or_default(),
        })
    }
}
