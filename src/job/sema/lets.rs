//! The values of `let`s, whatever order they are written in.
//!
//! A `let` is worked out after all those it names. The walk keeps its own stack, so that a chain of a hundred
//! thousand `let`s is as good as one; a path that comes back to itself is a circle and is reported whole.

use super::dimension::Dimension;
use super::eval::{Scope, walk};
use super::names::{Names, Thing};
use super::quantity::Quantity;
use super::report::{Checked, Reports};
use super::scope::Let;
use vcutc_diagnostics::source::{Span, Spanned};
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_syntax::ast::Expr;

/// A `let` on the way to its value.
struct Visit {
    index: usize,
    /// `let`s it names, with the places; walked from the back.
    needs: Vec<(usize, Span)>,
    /// The place from which it is being visited next.
    through: Option<Span>,
}

/// Works out all `let`s.
pub(crate) fn evaluate(
    lets: &[Let<'_>],
    names: &Names<'_>,
    reports: &mut Reports,
) -> Vec<Option<Checked<Quantity>>> {
    let mut values: Vec<Option<Checked<Quantity>>> = vec![None; lets.len()];
    let mut on_path = vec![false; lets.len()];
    for start in 0..lets.len() {
        let mut path = Vec::new();
        visit(start, lets, names, &values, &mut on_path, &mut path);
        while let Some(top) = path.last_mut() {
            if let Some((needed, place)) = top.needs.pop() {
                top.through = Some(place);
                if on_path.get(needed) == Some(&true) {
                    report_circle(needed, &path, lets, &mut values, reports);
                } else {
                    visit(needed, lets, names, &values, &mut on_path, &mut path);
                }
                continue;
            }
            let index = top.index;
            path.pop();
            if let Some(flag) = on_path.get_mut(index) {
                *flag = false;
            }
            if matches!(values.get(index), Some(None)) {
                let value = worth(index, lets, names, &values, reports);
                if let Some(slot) = values.get_mut(index) {
                    *slot = value;
                }
            }
        }
    }
    values
}

/// Puts a `let` without a value on the path.
fn visit(
    index: usize,
    lets: &[Let<'_>],
    names: &Names<'_>,
    values: &[Option<Checked<Quantity>>],
    on_path: &mut [bool],
    path: &mut Vec<Visit>,
) {
    let (Some(None), Some(subject), Some(flag)) =
        (values.get(index), lets.get(index), on_path.get_mut(index))
    else {
        return;
    };
    *flag = true;
    let mut needs = needs_of(subject.value, names);
    needs.reverse();
    path.push(Visit {
        index,
        needs,
        through: None,
    });
}

/// The `let`s that an expression names, in the order written.
fn needs_of(expr: &Spanned<Expr>, names: &Names<'_>) -> Vec<(usize, Span)> {
    let need = |part: &Spanned<Expr>| {
        let Expr::Name(name) = &part.node else { return None };
        match names.get(name)?.thing {
            Thing::Let(index) => Some((index, part.span)),
            Thing::Blade(_) | Thing::Region(_) | Thing::Machine(_) => None,
        }
    };
    walk(expr).filter_map(need).collect()
}

/// The value of a `let` whose needs are all known.
fn worth(
    index: usize,
    lets: &[Let<'_>],
    names: &Names<'_>,
    values: &[Option<Checked<Quantity>>],
    reports: &mut Reports,
) -> Option<Checked<Quantity>> {
    let subject = lets.get(index)?;
    let scope = Scope {
        names,
        lets,
        values,
        variables: &[],
    };
    let value = scope.evaluate(subject.value, reports);
    Some(value.and_then(|value| keeps_dimension(subject, value, &scope, reports)))
}

/// A value from the command line must be of the kind that the file gives the name.
fn keeps_dimension(
    subject: &Let<'_>,
    value: Quantity,
    scope: &Scope<'_>,
    reports: &mut Reports,
) -> Checked<Quantity> {
    let Some(original) = subject.original else {
        return Ok(value);
    };
    // A trial: what is wrong with a definition that is not used does not matter. A definition by names that are not
    // worked out yet has no value here; then the places that use the name check the dimension.
    let Ok(before) = scope.evaluate(original, &mut Reports::default()) else {
        return Ok(value);
    };
    if before.dimension == value.dimension {
        return Ok(value);
    }
    let name = &subject.name.node;
    let (wanted, found) = (before.dimension.words(), value.dimension.words());
    let sample = if value.dimension == Dimension::PURE {
        before.dimension.show(value.value)
    } else {
        before.text()
    };
    let diagnostic = Diagnostic::new(
        Code::WrongDimension,
        format!("`{name}` is {wanted}, but `--set` makes it {found}"),
        subject.value.span,
        format!("this is {found}"),
    )
    .and(original.span, format!("{wanted} in the file: {}", before.text()))
    .help(format!("give it like `--set \"{name}={sample}\"`"));
    Err(reports.push(diagnostic))
}

/// Handles a circle that leads from a `let` on the path back to itself: all that are in it have no value.
fn report_circle(
    first: usize,
    path: &[Visit],
    lets: &[Let<'_>],
    values: &mut [Option<Checked<Quantity>>],
    reports: &mut Reports,
) {
    if matches!(values.get(first), Some(Some(_))) {
        return;
    }
    let Some(subject) = lets.get(first) else { return };
    let start = path.iter().rposition(|visit| visit.index == first).unwrap_or(0);
    let circle = path.get(start..).unwrap_or_default();
    // Two circles through one name are one fault to correct first.
    let known = circle.iter().find_map(|visit| match values.get(visit.index) {
        Some(Some(Err(reported))) => Some(*reported),
        _ => None,
    });
    let reported = match known {
        Some(reported) => reported,
        None => reports.push(circle_diagnostic(subject, circle, lets)),
    };
    for visit in circle {
        if let Some(slot) = values.get_mut(visit.index) {
            *slot = Some(Err(reported));
        }
    }
}

/// A circle with the places where each of its names needs the next.
fn circle_diagnostic(subject: &Let<'_>, circle: &[Visit], lets: &[Let<'_>]) -> Diagnostic {
    let name = |visit: &Visit| {
        lets.get(visit.index)
            .map_or("", |subject| subject.name.node.as_str())
    };
    let way = if circle.len() > 1 {
        ", through other names"
    } else {
        ""
    };
    let mut diagnostic = Diagnostic::new(
        Code::LetCycle,
        format!("`{}` depends on itself{way}", subject.name.node),
        subject.name.span,
        "has no value of its own",
    );
    let targets = circle.iter().skip(1).chain(circle.first());
    for (visit, target) in circle.iter().zip(targets).take(MOST_SHOWN) {
        if let Some(place) = visit.through {
            diagnostic = diagnostic.and(place, format!("`{}` needs `{}` here", name(visit), name(target)));
        }
    }
    if circle.len() > MOST_SHOWN {
        let rest = circle.len() - MOST_SHOWN;
        diagnostic = diagnostic.note(format!("the circle continues through {rest} more names"));
    }
    diagnostic.help("give one of these names a value that needs none of the others")
}

/// Most names of a circle that are shown.
const MOST_SHOWN: usize = 12;
