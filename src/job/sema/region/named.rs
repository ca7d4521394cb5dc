//! The region that a field names.

use crate::NamedRegion;
use crate::sema::fields::Fields;
use crate::sema::names::Thing;
use crate::sema::read::{Reader, looks_like};
use crate::sema::report::Checked;
use crate::sema::session::Session;
use crate::sema::written::Written;
use vcutc_diagnostics::source::{Span, Spanned};
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_syntax::ast::Expr;

/// The region that a field names, and where it names it.
pub fn region(
    field: &str,
    fields: &Fields<'_>,
    written: Written<'_>,
    session: &mut Session<'_>,
) -> Checked<(NamedRegion, Span)> {
    let reader = Reader::new(written.scope, &mut session.reports);
    let expr = fields.required_value(field, reader.reports)?;
    let names = reader.scope.names;
    let is_region = |thing| matches!(thing, Thing::Region(_));
    let Expr::Name(name) = &expr.node else {
        let list = names.list(is_region);
        return Err(reader.reports.push(not_a_name(field, expr, list)));
    };
    let found = match names.get(name).map(|definition| definition.thing) {
        Some(Thing::Region(index)) => written.regions.get(index),
        Some(Thing::Let(_) | Thing::Blade(_) | Thing::Machine(_)) | None => None,
    };
    match found {
        Some(Ok(region)) => Ok((region.clone(), expr.span)),
        Some(Err(reported)) => Err(*reported),
        None => Err(names.not_a("region", name, expr.span, is_region, reader.reports)),
    }
}

fn not_a_name(field: &str, expr: &Spanned<Expr>, list: Option<String>) -> Diagnostic {
    let diagnostic = Diagnostic::new(
        Code::WrongKind,
        format!(
            "`{field}` takes the name of a region, not {}",
            looks_like(&expr.node)
        ),
        expr.span,
        "expected the name of a region here",
    );
    match list {
        Some(list) => diagnostic.help(format!("the regions defined are {list}")),
        None => diagnostic.help("define one with `region seat { ... }` and write `region = seat`"),
    }
}
