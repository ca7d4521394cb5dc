//! Bad statements in words.
//!
//! A statement that the grammar took up as bad is read once more on its own. How far that goes is where the mistake
//! is, and what the grammar could have gone on with there is what the message asks for, in the language's own words.

use super::bad::{Bad, Fault, shown};
use super::grammar::{Mismatch, Rule, read};
use super::lexical::{Bracket, Token, TokenKind, tokens};
use super::{short_forms, slips};
use vcutc_diagnostics::source::Span;
use vcutc_diagnostics::suggest::nearest;
use vcutc_diagnostics::{Code, Diagnostic};

/// What is wrong with a statement that should follow `rule`.
pub(super) fn explain(bad: &Bad<'_>, rule: Rule) -> Diagnostic {
    if let Some(report) = misplaced(bad, rule) {
        return report;
    }
    match read(rule, bad.mended) {
        Err(Mismatch::At { position, expected }) => mismatch(bad, position, &expected),
        Ok(_) | Err(Mismatch::TooMuchWork) => Diagnostic::new(
            Code::UnexpectedText,
            "this does not belong here",
            bad.span(0..bad.mended.trim_end().len()),
            "not a known statement",
        ),
    }
}

/// Statements that are wrong as a whole, not from some place on.
fn misplaced(bad: &Bad<'_>, rule: Rule) -> Option<Diagnostic> {
    let first = bad.tokens().next()?;
    if bad.token(first) == "," {
        return Some(lone_comma(bad.span(first.start..first.end)));
    }
    if first.kind != TokenKind::Word {
        return None;
    }
    if rule == Rule::only_entry {
        misplaced_entry(bad, first)
    } else {
        misplaced_at_the_top(bad, first)
    }
}

fn lone_comma(here: Span) -> Diagnostic {
    Diagnostic::new(
        Code::UnexpectedText,
        "a comma without an entry before it",
        here,
        "one comma between entries is enough",
    )
    .fix("delete it", here, "")
}

/// An entry of a block that begins with a word.
fn misplaced_entry(bad: &Bad<'_>, first: Token) -> Option<Diagnostic> {
    let (word, here) = (bad.token(first), bad.span(first.start..first.end));
    let mut rest = bad.tokens().skip(1);
    let (second, third) = (rest.next(), rest.next());
    match (word, second.map(|token| token.kind)) {
        ("let" | "use" | "job", Some(TokenKind::Word | TokenKind::Text)) => Some(
            Diagnostic::new(
                Code::UnexpectedText,
                format!("`{word}` is not allowed in a block"),
                here,
                "inside a block here",
            )
            .help(format!(
                "move the `{word}` out of the block, to the top of the file"
            )),
        ),
        (_, Some(TokenKind::Open(Bracket::Round)))
            if is_plain_name(word)
                && let [meant, ..] = nearest(word, WITH_POINTS)[..] =>
        {
            Some(
                Diagnostic::new(
                    Code::UnexpectedText,
                    format!("`{}` does not take points", shown(word)),
                    here,
                    "not a word of the language",
                )
                .fix(format!("did you mean `{meant}`?"), here, meant),
            )
        }
        (_, None) if is_leftover(bad) => Some(
            Diagnostic::new(
                Code::UnexpectedText,
                format!("`{}` does not belong here", shown(word)),
                here,
                "the entry before it is complete already",
            )
            .help(format!("delete it, or make it a separate entry: `{word} = ...`")),
        ),
        (_, Some(TokenKind::Word | TokenKind::Text)) if third.is_none() => {
            let value = second?;
            let gap = bad.span(first.end..value.start);
            is_plain_name(word).then(|| missing_equals(word, bad.span(value.start..value.end), gap))
        }
        ("at", Some(_)) => short_forms::station(bad),
        _ => None,
    }
}

/// A statement outside of any block that begins with a word.
fn misplaced_at_the_top(bad: &Bad<'_>, first: Token) -> Option<Diagnostic> {
    let (word, here) = (bad.token(first), bad.span(first.start..first.end));
    let second = bad.tokens().nth(1)?;
    if (second.kind, bad.token(second)) != (TokenKind::Symbol, "=") {
        return None;
    }
    match word {
        "surface" => short_forms::surface(bad),
        "profile" => Some(
            Diagnostic::new(
                Code::UnexpectedText,
                "a profile after `=` is one file",
                here,
                "not a file in a form that the compiler reads",
            )
            .note("kinds of files: points, airfoil, dxf, svg")
            .help("write `profile = dxf(\"rib.dxf\", layer = \"SKIN\")`, or a block `profile { ... }`"),
        ),
        _ if is_value_line(bad) => Some(
            Diagnostic::new(
                Code::UnexpectedText,
                format!("expected `let` before `{word}`"),
                here,
                "a value outside of any block needs `let`",
            )
            .fix(
                format!("write `let {word} = ...`"),
                bad.span(first.start..first.start),
                "let ",
            ),
        ),
        _ => None,
    }
}

/// Words that points in brackets follow.
const WITH_POINTS: [&str; 8] = [
    "start", "bezier", "spline", "polyline", "circle", "tips", "body", "row",
];

/// Whether the statement continues where the one before it ended, with no comma or line end between.
fn is_leftover(bad: &Bad<'_>) -> bool {
    let between = bad.text.get(bad.previous_end..bad.start);
    bad.previous_end > 0
        && between.is_some_and(|between| between.bytes().all(|byte| matches!(byte, b' ' | b'\t')))
}

/// Whether `name = ...` is all there is, and no head of a block.
fn is_value_line(bad: &Bad<'_>) -> bool {
    bad.tokens().all(|token| bad.token(token) != "{") && read(Rule::only_entry, bad.mended).is_ok()
}

/// Whether a word begins nothing but a field.
fn is_plain_name(word: &str) -> bool {
    !matches!(
        word,
        "start"
            | "line"
            | "arc"
            | "bezier"
            | "spline"
            | "polyline"
            | "open"
            | "circle"
            | "points"
            | "airfoil"
            | "dxf"
            | "svg"
            | "tips"
            | "body"
            | "row"
            | "mesh"
            | "grid"
            | "at"
    )
}

fn missing_equals(name: &str, value: Span, gap: Span) -> Diagnostic {
    Diagnostic::new(
        Code::UnexpectedText,
        format!("expected `=` after `{}`", shown(name)),
        value,
        "`=` is missing before this",
    )
    .fix("put `=` between name and value", gap, " = ")
}

/// What is wrong when a statement is right up to `position`, where one of `expected` should follow.
pub(super) fn mismatch(bad: &Bad<'_>, position: usize, expected: &[Rule]) -> Diagnostic {
    let mut before = None;
    let mut found = None;
    let mut next = None;
    for token in bad.tokens() {
        if token.end <= position {
            before = Some(token);
        } else if found.is_none() {
            found = Some(token);
        } else {
            next = Some(token);
            break;
        }
    }
    let fault = Fault {
        before,
        found,
        next,
        expected,
    };
    slips::find(bad, &fault)
        .or_else(|| lost_mark(bad, &fault))
        .unwrap_or_else(|| plain(bad, &fault))
}

/// A value where only `=` or `,` is missing before it.
fn lost_mark(bad: &Bad<'_>, fault: &Fault<'_>) -> Option<Diagnostic> {
    let (before, found) = (fault.before?, fault.found?);
    let is_value = match found.kind {
        TokenKind::Number | TokenKind::Text | TokenKind::Word => true,
        TokenKind::Open(bracket) => bracket == Bracket::Round,
        _ => false,
    };
    let span = bad.span(found.start..found.end);
    let gap = bad.span(before.end..found.start);
    match wanted(fault)? {
        "`=`" if is_value => Some(missing_equals(&context(bad, before), span, gap)),
        "`,` or `)`" if is_value => Some(
            Diagnostic::new(
                Code::UnexpectedText,
                format!("expected `,` or `)` after `{}`", context(bad, before)),
                span,
                format!("found `{}`", shown(bad.token(found))),
            )
            .fix("put a comma between the values", gap, ", "),
        ),
        _ => None,
    }
}

/// The message for a mistake that is not one of the usual slips.
fn plain(bad: &Bad<'_>, fault: &Fault<'_>) -> Diagnostic {
    let wanted = wanted(fault);
    let context = fault.before.map(|before| context(bad, before));
    let message = match (wanted, &context, fault.found) {
        (Some(wanted), Some(context), _) => format!("expected {wanted} after `{context}`"),
        (Some(wanted), None, _) => format!("expected {wanted}"),
        (None, _, Some(found)) => format!("`{}` does not belong here", shown(bad.token(found))),
        (None, _, None) => "this statement is not complete".to_owned(),
    };
    let (span, label) = match (fault.found, &context) {
        (Some(found), Some(context)) if wanted.is_none() => (
            bad.span(found.start..found.end),
            format!("nothing can follow `{context}`"),
        ),
        (Some(found), _) => (
            bad.span(found.start..found.end),
            format!("found `{}`", shown(bad.token(found))),
        ),
        (None, _) => {
            let end = fault.before.map_or(0, |before| before.end);
            (bad.span(end..end), "the statement ends here".to_owned())
        }
    };
    let report = Diagnostic::new(Code::UnexpectedText, message, span, label);
    match help(fault) {
        Some(help) => report.help(help),
        None => report,
    }
}

/// What a message asks for; `None` when the statement should have ended.
fn wanted(fault: &Fault<'_>) -> Option<&'static str> {
    let expects = |rule| fault.expects(rule);
    let words = match () {
        () if expects(Rule::comma) && expects(Rule::close) => "`,` or `)`",
        () if expects(Rule::close) && !fault.expects_value() => "`)`",
        () if expects(Rule::comma) => "`,` and a second coordinate",
        () if expects(Rule::point_open) && expects(Rule::to_word) => "a point or `to`",
        () if expects(Rule::point_open) || expects(Rule::point) => "a point",
        () if expects(Rule::to_word) => "`to`",
        () if expects(Rule::arc_radius) || expects(Rule::radius_word) => "`radius`, `center` or `through`",
        () if fault.expects_value() => "a value",
        () if expects(Rule::text) && !expects(Rule::name) => "a text in quotes",
        // The head of a block can go on with `=` too, but a brace is what it lacks.
        () if expects(Rule::block_open) && expects(Rule::equals) && !expects(Rule::at_most) => "`{`",
        () if expects(Rule::equals) && expects(Rule::block_open) && fault.found.is_none() => "`=` or `{`",
        () if expects(Rule::equals) => "`=`",
        () if expects(Rule::block_open) => "`{`",
        () if expects(Rule::only_item) => "`job`, `use`, `let` or a block",
        () if expects(Rule::only_entry) => "the name of a field or block",
        () if expects(Rule::name) => "a name",
        () => return None,
    };
    Some(words)
}

/// What to do, where the headline does not say it.
fn help(fault: &Fault<'_>) -> Option<&'static str> {
    match wanted(fault)? {
        "`,` and a second coordinate" => Some("a point is written `(x, z)`, as in `(20 mm, 30 mm)`"),
        "a point" => Some("write a point such as `(20 mm, 30 mm)`"),
        "`to`" | "a point or `to`" => {
            Some("the last point of a curve follows the word `to`, as in `to (20 mm, 30 mm)`")
        }
        "`radius`, `center` or `through`" => {
            Some("define the arc: `radius 30 mm`, `center (20 mm, 0 mm)` or `through (20 mm, 30 mm)`")
        }
        "a value" => Some("write a value such as `4.4 mm`, `auto` or `\"text\"`"),
        "a text in quotes" => Some("put it in double quotes, as in `\"spoiler_rib\"`"),
        _ => None,
    }
}

/// The words before a mistake, as many as help to find it.
fn context(bad: &Bad<'_>, before: Token) -> String {
    const LONGEST: usize = 28;
    let is_near = |token: &Token| token.line == before.line && token.end + LONGEST >= before.end;
    let line_start = tokens(bad.mended).find(|token| token.line == before.line);
    let first = tokens(bad.mended).find(is_near).unwrap_or(before);
    let words = shown(bad.slice(first.start.min(before.start)..before.end));
    if line_start.is_some_and(|start| start.start < first.start) {
        format!("...{words}")
    } else {
        words
    }
}
