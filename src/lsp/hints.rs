//! Values beside the text: the values chosen for `auto`, and the results of calculations.

use super::analysis::Analysis;
use super::chosen::{Chosen, chosen};
use super::sites::{Kind, Site, sites};
use core::ops::Range;
use vcutc_diagnostics::source::Spanned;
use vcutc_job::sema::study::Evaluator;
use vcutc_syntax::ast::Expr;

/// Most hints of an answer. More cannot be read at once.
const MOST_HINTS: usize = 5000;

/// A value to be shown after a place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Hint {
    /// After this byte.
    pub(super) at: usize,
    pub(super) value: String,
    /// More about it.
    pub(super) why: String,
}

/// The hints in a stretch of a file.
pub(super) fn hints(analysis: &Analysis, path: &str, within: Range<usize>) -> Vec<Hint> {
    let Some((_, ast)) = analysis.file(path) else {
        return Vec::new();
    };
    let evaluator = analysis.study.evaluator();
    let mut found = Vec::new();
    for site in sites(ast, analysis.study.operations) {
        if found.len() >= MOST_HINTS {
            break;
        }
        let span = site.span.bytes();
        if span.end < within.start || span.start > within.end {
            continue;
        }
        if let Kind::Auto = site.kind {
            found.extend(of_auto(analysis, path, &site));
        } else if let Kind::Value(value) = site.kind {
            of_value(value, &site, &evaluator, &mut found);
        }
    }
    found
}

fn of_auto(analysis: &Analysis, path: &str, site: &Site<'_>) -> Option<Hint> {
    match chosen(analysis, path, site) {
        Chosen::As { value, why } => Some(Hint {
            at: site.span.end as usize,
            value,
            why,
        }),
        Chosen::Unknown => None,
    }
}

/// What a value comes to, if its text does not say so itself; of lists and calls that describe a thing, each part.
fn of_value(value: &Spanned<Expr>, site: &Site<'_>, evaluator: &Evaluator<'_>, found: &mut Vec<Hint>) {
    let mut open = vec![value];
    while let Some(part) = open.pop() {
        match &part.node {
            Expr::Number { .. } | Expr::Text(_) => {}
            Expr::Tuple(values) => open.extend(values.iter().rev()),
            Expr::Negate(inner) if matches!(inner.node, Expr::Number { .. }) => {}
            // Words of the field are not values; names of blades have none.
            Expr::Name(name) if name == "pi" || is_word(site, part) => {}
            Expr::Name(_) | Expr::Negate(_) | Expr::Binary { .. } => {
                found.extend(computed(part, evaluator));
            }
            Expr::Call { arguments, .. } => match computed(part, evaluator) {
                Some(hint) => found.push(hint),
                None => open.extend(arguments.iter().map(|argument| &argument.value).rev()),
            },
        }
    }
}

fn is_word(site: &Site<'_>, part: &Spanned<Expr>) -> bool {
    use vcutc_job::sema::vocabulary::Takes;
    let takes_words = matches!(site.place.field.map(|field| field.takes), Some(Takes::Words(_)));
    takes_words && part.span == site.span
}

fn computed(part: &Spanned<Expr>, evaluator: &Evaluator<'_>) -> Option<Hint> {
    let value = evaluator.value(part)?;
    let shown = value.texts(part).into_iter().next()?;
    Some(Hint {
        at: part.span.end as usize,
        value: shown,
        why: value.texts(part).join(" = "),
    })
}
