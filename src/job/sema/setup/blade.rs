//! The blades that an operation names, each of the kind that it cuts with.

use crate::blades::OfKind;
use crate::sema::fields::{FieldSpec, Fields, Takes, value};
use crate::sema::names::Thing;
use crate::sema::read::{Reader, looks_like};
use crate::sema::report::Checked;
use crate::sema::session::Session;
use crate::sema::written::Written;
use crate::{Blade, BladeKind};
use vcutc_diagnostics::source::{Span, Spanned};
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_syntax::ast::Expr;

/// `blade = NAME`, of a straight blade.
pub const BLADE: FieldSpec = value("blade", "dagger")
    .required()
    .takes(Takes::Blade("straight"));

/// The blade that a field names.
pub fn blade<B: OfKind>(
    field: &str,
    fields: &Fields<'_>,
    written: Written<'_>,
    session: &mut Session<'_>,
) -> Checked<B> {
    let mut reader = Reader::new(written.scope, &mut session.reports);
    let expr = fields.required_value(field, reader.reports)?;
    let blade = find(field, expr, written.blades, &mut reader)?;
    match B::of(blade) {
        Some(blade) => Ok(blade.clone()),
        None => {
            let diagnostic = of_another_kind(blade, B::KIND, expr.span, (fields, written));
            Err(reader.reports.push(diagnostic))
        }
    }
}

fn of_another_kind(
    blade: &Blade,
    wanted: BladeKind,
    at: Span,
    (fields, written): (&Fields<'_>, Written<'_>),
) -> Diagnostic {
    let blade = blade.by_ref();
    let (name, kind, right) = (blade.name(), blade.kind().words(), wanted.words());
    let diagnostic = Diagnostic::new(
        Code::WrongBlade,
        format!("{} cuts with {right}; `{name}` is {kind}", fields.title()),
        at,
        format!("needs {right}"),
    )
    .and(blade.span(), format!("defined as {kind}"));
    let blades = written.blades.iter().flatten().map(Blade::by_ref);
    let fitting: Vec<&str> = blades
        .filter(|blade| blade.kind() == wanted)
        .map(|blade| blade.name())
        .collect();
    match fitting.as_slice() {
        [] => {
            let (name, example) = example(wanted);
            diagnostic.help(format!(
                "define one, such as `{example}`, and write `blade = {name}`"
            ))
        }
        [one] => diagnostic.fix(format!("use `{one}`, which is {}", wanted.said_of()), at, *one),
        several => {
            let several: Vec<String> = several.iter().map(|name| format!("`{name}`")).collect();
            diagnostic.help(format!(
                "the {} defined are {}",
                wanted.plural(),
                several.join(", ")
            ))
        }
    }
}

/// The name of a blade, and how it is defined.
const fn example(kind: BladeKind) -> (&'static str, &'static str) {
    match kind {
        BladeKind::Straight => (
            "dagger",
            "blade dagger { cutting_length = 30 mm, half_apex = 8 deg, thickness = 1.5 mm, edges = double }",
        ),
        BladeKind::Disc => (
            "wheel",
            "blade wheel = disc { radius = 25 mm, thickness = 1.5 mm, depth = 10 mm, width = 12 mm, spin = 3000 rev/min, \
             body (1.5 mm, 8 mm) (60 mm, 25 mm) }",
        ),
        BladeKind::Crusher => (
            "hog",
            "blade hog = crusher { radius = 6 mm, height = 24 mm, spin = 18000 rev/min, ramp = 5 deg }",
        ),
    }
}

/// The blade that the operation names.
fn find<'b>(
    field: &str,
    expr: &Spanned<Expr>,
    blades: &'b [Checked<Blade>],
    reader: &mut Reader<'_>,
) -> Checked<&'b Blade> {
    let names = reader.scope.names;
    let is_blade = |thing| matches!(thing, Thing::Blade(_));
    let Expr::Name(name) = &expr.node else {
        let diagnostic = Diagnostic::new(
            Code::WrongKind,
            format!(
                "`{field}` takes the name of a blade, not {}",
                looks_like(&expr.node)
            ),
            expr.span,
            "expected the name of a blade here",
        );
        let diagnostic = match names.list(is_blade) {
            Some(list) => diagnostic.help(format!("the blades defined are {list}")),
            None => diagnostic.help("define one with `blade dagger { ... }` and write `blade = dagger`"),
        };
        return Err(reader.reports.push(diagnostic));
    };
    let blade = match names.get(name).map(|definition| definition.thing) {
        Some(Thing::Blade(index)) => blades.get(index),
        Some(Thing::Let(_) | Thing::Region(_) | Thing::Machine(_)) | None => None,
    };
    match blade {
        Some(Ok(blade)) => Ok(blade),
        Some(Err(reported)) => Err(*reported),
        None => Err(names.not_a("blade", name, expr.span, is_blade, reader.reports)),
    }
}
