//! The usual slips: what hands used to other languages and other keyboards write, and how it is written here.

use super::bad::{Bad, Fault, shown};
use super::grammar::Rule;
use super::lexical::{Token, TokenKind};
use vcutc_diagnostics::{Code, Diagnostic, Edit, Fix};

/// The message for a usual slip, if the mistake is one.
pub(super) fn find(bad: &Bad<'_>, fault: &Fault<'_>) -> Option<Diagnostic> {
    let found = fault.found?;
    numbers(bad, fault, found)
        .or_else(|| parted_unit(bad, fault, found))
        .or_else(|| decimal_comma_before(bad, found))
        .or_else(|| marks(bad, fault, found))
        .or_else(|| characters(bad, found))
}

/// One token that should be another.
fn instead(bad: &Bad<'_>, found: Token, headline: &str, label: &str, replacement: &str) -> Diagnostic {
    let span = bad.span(found.start..found.end);
    let title = if replacement.is_empty() {
        format!("delete `{}`", shown(bad.token(found)))
    } else {
        format!("write `{replacement}`")
    };
    Diagnostic::new(Code::UnexpectedText, headline, span, label).fix(title, span, replacement)
}

/// Numbers in other notations.
fn numbers(bad: &Bad<'_>, fault: &Fault<'_>, found: Token) -> Option<Diagnostic> {
    let is_number = |token: Option<Token>| token.filter(|token| token.kind == TokenKind::Number);
    let before = is_number(fault.before).filter(|before| before.end == found.start);
    let next = is_number(fault.next).filter(|next| next.start == found.end);
    match (bad.token(found), before, next) {
        (",", Some(before), Some(next)) => {
            let right = format!("{}.{}", bad.token(before), bad.token(next));
            let span = bad.span(before.start..next.end);
            Some(
                Diagnostic::new(
                    Code::UnexpectedText,
                    "a decimal comma",
                    span,
                    "decimals are written with a point",
                )
                .fix(format!("write `{right}`"), span, right.clone()),
            )
        }
        (".", None, Some(next)) => {
            let right = format!("0.{}", bad.token(next));
            let span = bad.span(found.start..next.end);
            Some(
                Diagnostic::new(
                    Code::UnexpectedText,
                    "a number begins with a digit",
                    span,
                    "no digit before the point",
                )
                .fix(format!("write `{right}`"), span, right.clone()),
            )
        }
        (".", Some(before), None) => Some(instead(
            bad,
            found,
            "a decimal point without decimals",
            &format!("no digit follows; `{}` alone is enough", bad.token(before)),
            "",
        )),
        _ => None,
    }
}

/// Units of inertia are one word, however many others write.
const PARTED: [(&str, &str); 2] = [("m2", "kgm2"), ("mm2", "kgmm2")];

/// A unit in two words.
fn parted_unit(bad: &Bad<'_>, fault: &Fault<'_>, found: Token) -> Option<Diagnostic> {
    let mass = fault.before.filter(|before| bad.token(*before) == "kg")?;
    let (_, unit) = PARTED.iter().find(|(second, _)| *second == bad.token(found))?;
    let span = bad.span(mass.start..found.end);
    Some(
        Diagnostic::new(
            Code::UnexpectedText,
            format!("a unit in two words, `{}`", bad.slice(mass.start..found.end)),
            span,
            "this unit is one word",
        )
        .fix(format!("write `{unit}`"), span, *unit),
    )
}

/// A value too many in brackets that hold `60,5 mm`, which reads as two.
fn decimal_comma_before(bad: &Bad<'_>, found: Token) -> Option<Diagnostic> {
    if bad.token(found) != "," {
        return None;
    }
    let before = bad.slice(0..found.start);
    let opened = before.rfind('(')?;
    let is_digit = |byte: Option<&u8>| byte.is_some_and(u8::is_ascii_digit);
    let bytes = before.as_bytes();
    let comma = (opened..before.len()).find(|&at| {
        bytes.get(at) == Some(&b',') && is_digit(bytes.get(at.wrapping_sub(1))) && is_digit(bytes.get(at + 1))
    })?;
    let start = before.get(..comma)?.rfind(|c: char| !c.is_ascii_digit())? + 1;
    let rest = before.get(comma + 1..)?;
    let end = comma + 1 + rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(rest.len());
    let right = before.get(start..end)?.replace(',', ".");
    let span = bad.span(start..end);
    Some(
        Diagnostic::new(
            Code::UnexpectedText,
            "a decimal comma",
            span,
            "decimals are written with a point",
        )
        .fix(format!("write `{right}`"), span, right.clone()),
    )
}

/// Marks of other languages.
fn marks(bad: &Bad<'_>, fault: &Fault<'_>, found: Token) -> Option<Diagnostic> {
    let slip = |headline, label, right| Some(instead(bad, found, headline, label, right));
    match bad.token(found) {
        ":" if fault.expects(Rule::equals) => {
            slip("expected `=`, found `:`", "a value is given with `=`", "=")
        }
        "==" if fault.expects(Rule::equals) => slip(
            "expected `=`, found `==`",
            "a value is given with a single `=`",
            "=",
        ),
        "<" if fault.expects(Rule::at_most) => {
            slip("expected `<=`, found `<`", "an upper limit is written `<=`", "<=")
        }
        ">" if fault.expects(Rule::at_least) => {
            slip("expected `>=`, found `>`", "a lower limit is written `>=`", ">=")
        }
        ";" if fault
            .next
            .is_some_and(|next| !matches!(bad.token(next), ")" | "}")) =>
        {
            slip(
                "`;` does not belong here",
                "commas separate values and entries",
                ",",
            )
        }
        ";" => slip(
            "`;` does not belong here",
            "a line end or a comma ends an entry",
            "",
        ),
        "," if is_doubled(bad, fault, found) => slip(
            "`,` does not belong here",
            "one comma between values and entries is enough",
            "",
        ),
        "#" => slip("`#` does not belong here", "comments begin with `//`", "//"),
        "+" if fault.expects_value() => slip(
            "`+` does not belong here",
            "a positive number has no sign before it",
            "",
        ),
        "*" if fault.expects_value() => joined(bad, fault, "**", "`**` is not an operator", "^"),
        ">" if fault.expects_value() => joined(bad, fault, "=>", "`=>` is not a relation", ">="),
        "[" => Some(
            Diagnostic::new(
                Code::UnexpectedText,
                "`[` does not belong here",
                bad.span(found.start..found.end),
                "brackets of this kind are not used",
            )
            .help("write values that belong together as `(a, b, c)`"),
        ),
        "'" => Some(
            Diagnostic::new(
                Code::UnexpectedText,
                "`'` does not belong here",
                bad.span(found.start..found.end),
                "quotes of this kind are not used",
            )
            .help("write a text in double quotes, as in `\"text\"`"),
        ),
        "centre" if fault.expects(Rule::center_word) || fault.expects(Rule::arc_center) => {
            slip("expected `center`, found `centre`", "spelled `center`", "center")
        }
        _ => None,
    }
}

/// Whether a comma has another one before it or after it.
fn is_doubled(bad: &Bad<'_>, fault: &Fault<'_>, found: Token) -> bool {
    let is_comma = |token: Option<Token>| token.is_some_and(|token| bad.token(token) == ",");
    let end = bad.start.saturating_add(found.end);
    let follows = bad
        .text
        .get(end..)
        .is_some_and(|rest| rest.trim_start_matches([' ', '\t']).starts_with(','));
    is_comma(fault.before) || is_comma(fault.next) || follows
}

/// Two marks that are one elsewhere.
fn joined(bad: &Bad<'_>, fault: &Fault<'_>, wrong: &str, headline: &str, right: &str) -> Option<Diagnostic> {
    let range = fault.before?.start..fault.found?.end;
    let span = bad.span(range.clone());
    (bad.slice(range) == wrong).then(|| {
        Diagnostic::new(
            Code::UnexpectedText,
            headline,
            span,
            format!("it is written `{right}` here"),
        )
        .fix(format!("write `{right}`"), span, right)
    })
}

/// Characters of other keyboards and of word processors.
fn characters(bad: &Bad<'_>, found: Token) -> Option<Diagnostic> {
    let c = bad.token(found).chars().next()?;
    let (name, right) = match c {
        '°' => ("a degree sign", " deg"),
        '\u{2212}' | '\u{2013}' | '\u{2014}' => ("a dash", "-"),
        '×' | '·' | '⋅' => ("a multiplication sign", "*"),
        '÷' => ("a division sign", "/"),
        '≤' => ("a sign that is written with two characters", "<="),
        '≥' => ("a sign that is written with two characters", ">="),
        c if is_fancy_quote(c) => return Some(fancy_quotes(bad, found)),
        c if c.is_whitespace() || c == '\u{feff}' || c == '\u{200b}' => ("a special space", " "),
        _ => return None,
    };
    let shown_right = right.trim();
    let help = match shown_right {
        "" => "write an ordinary space".to_owned(),
        right => format!("write `{right}`"),
    };
    let span = bad.span(found.start..found.start + c.len_utf8());
    Some(
        Diagnostic::new(
            Code::UnexpectedText,
            format!("{name} (U+{:04X}) does not belong here", u32::from(c)),
            span,
            "this character is not part of the language",
        )
        .fix(help, span, right),
    )
}

const fn is_fancy_quote(c: char) -> bool {
    matches!(c, '\u{201c}' | '\u{201d}' | '\u{201e}' | '«' | '»')
}

/// Quotes of a word processor come in pairs, so both are corrected.
fn fancy_quotes(bad: &Bad<'_>, found: Token) -> Diagnostic {
    let line = bad.slice(found.start..bad.mended.len());
    let line = line.lines().next().unwrap_or_default();
    let quotes = line.char_indices().filter(|&(_, c)| is_fancy_quote(c));
    let edits = quotes.map(|(at, c)| Edit {
        span: bad.span(found.start + at..found.start + at + c.len_utf8()),
        replacement: "\"".to_owned(),
    });
    let mut report = Diagnostic::new(
        Code::UnexpectedText,
        "a typographic quote does not belong here",
        bad.span(found.start..found.end),
        "texts need straight double quotes",
    );
    report.fixes.push(Fix {
        title: "write `\"`".to_owned(),
        edits: edits.take(2).collect(),
    });
    report
}
