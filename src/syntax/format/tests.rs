//! The layout on chosen texts, and what must hold for any.

use super::format;
use crate::ast::Ast;
use crate::parse;
use proptest::prelude::*;
use vcutc_diagnostics::Diagnostic;
use vcutc_diagnostics::source::SourceMap;

fn parsed(text: &str) -> (Ast, Vec<Diagnostic>) {
    let file = SourceMap::default().add("t.vcut", text);
    let mut diagnostics = Vec::new();
    let ast = parse(file, text, &mut diagnostics);
    (ast, diagnostics)
}

fn formatted(text: &str) -> String {
    let file = SourceMap::default().add("t.vcut", text);
    match format(file, text) {
        Ok(formatted) => formatted,
        Err(found) => panic!("{found:?}\n{text}"),
    }
}

/// Checks the layout of a text, and that it is the layout of itself.
fn assert_layout(text: &str, expected: &str) {
    let found = formatted(text);
    assert_eq!(found, expected, "\n{found}");
    assert_eq!(formatted(expected), expected);
}

#[test]
fn blanks_stand_where_they_belong() {
    for (value, expected) in [
        ("4.4mm", "4.4 mm"),
        ("30%", "30 %"),
        ("200mm/s", "200 mm/s"),
        ("6 m / s", "6 m / s"),
        ("8 mm/2", "8 mm / 2"),
        ("1e3", "1e3"),
        ("x ^ 2", "x^2"),
        ("- ( a+b )*-c", "-(a + b) * -c"),
        ("2^ - 1", "2^-1"),
        ("max ( a,b , )", "max(a, b)"),
        ("frame(x=0mm,y=-a)", "frame(x = 0 mm, y = -a)"),
        ("( \"a  b\" )", "(\"a  b\")"),
        ("f( )", "f()"),
        ("größe-1", "größe - 1"),
        ("e\u{301}tat*2", "e\u{301}tat * 2"),
    ] {
        assert_layout(&format!("let v={value}"), &format!("let v = {expected}\n"));
    }
}

#[test]
fn surfaces_are_laid_out_as_profiles_are() {
    assert_layout(
        "surface {\nloft{\nat 0mm{start(0mm,1mm)line to(2mm,3mm)}\nat(2*3 mm){z(x)=x}\n}\n}",
        "surface {\n  loft {\n    at 0 mm       { start (0 mm, 1 mm), line to (2 mm, 3 mm) }\n    at (2 * 3 mm) { z(x) = x }\n  }\n}\n",
    );
    assert_layout(
        "surface{mesh \"a.stl\"{unit=mm,place=frame(x=0mm)}}",
        "surface { mesh \"a.stl\" { unit = mm, place = frame(x = 0 mm) } }\n",
    );
    assert_layout("surface {\nz(x,y)=x+y\n}", "surface {\n  z(x, y) = x + y\n}\n");
}

#[test]
fn neighbours_share_a_column() {
    assert_layout(
        "rough vcut {\nblade=b\nfeed{cut=1 mm/s}\nrake   = 60deg\n\nlattice = free\n// on its own\nz(x)=x\nstep<=2mm\n}",
        "rough vcut {\n  blade = b\n  feed  { cut = 1 mm/s }\n  rake  = 60 deg\n\n  lattice = free\n  // on its own\n  z(x) = x\n  step <= 2 mm\n}\n",
    );
    assert_layout(
        "profile { start(0mm,1mm)\nline to (2 mm, 3 mm)\narc to(4mm,5mm)radius -3mm }",
        "profile {\n  start (0 mm, 1 mm)\n  line  to (2 mm, 3 mm)\n  arc   to (4 mm, 5 mm) radius -3 mm\n}\n",
    );
    assert_layout(
        "let a=1\nlet long=2\n\nlet b=3",
        "let a    = 1\nlet long = 2\n\nlet b = 3\n",
    );
    let long = "a_name_of_more_than_twenty_four_letters";
    assert_layout(
        &format!("b {{\n  x = 1\n  {long} = 2\n  yy = 3\n}}\n"),
        &format!("b {{\n  x = 1\n  {long} = 2\n  yy = 3\n}}\n"),
    );
}

#[test]
fn blocks_stay_on_one_line_if_they_were_and_fit() {
    assert_layout("a{x=1 y=2,}", "a { x = 1, y = 2 }\n");
    assert_layout("a{x=1\ny=2}", "a {\n  x = 1\n  y = 2\n}\n");
    assert_layout("a{}\nb{\n}", "a {}\nb {}\n");
    let fields: Vec<_> = (0..12).map(|n| format!("field_{n} = {n}")).collect();
    let many = fields.join("\n  ").replace("_0 =", "_0  =");
    let many: String = (1..10).fold(many, |text, n| {
        text.replace(&format!("_{n} ="), &format!("_{n}  ="))
    });
    assert_layout(
        &format!("a {{ {} }}", fields.join(", ")),
        &format!("a {{\n  {many}\n}}\n"),
    );
}

#[test]
fn long_values_are_wrapped() {
    let long = |n: usize| format!("{}_{n}", "long".repeat(9));
    let [a, b, c] = [long(1), long(2), long(3)];
    assert_layout(
        &format!("let v = {a} + {b} * {c}"),
        &format!("let v = {a}\n  + {b}\n  * {c}\n"),
    );
    assert_layout(
        &format!("let v = max({a}, min({b}, {c}))"),
        &format!("let v = max(\n  {a},\n  min({b}, {c}),\n)\n"),
    );
    assert_layout(
        &format!("p {{ spline ({a}, {b}) (1, 2) to (1, {c}) }}"),
        &format!("p {{\n  spline\n    ({a}, {b})\n    (1, 2)\n    to (1, {c})\n}}\n"),
    );
    // A comment on its own line among points keeps it.
    assert_layout(
        "p { tips // of these\n (1, 2) // behind\n // below\n (3, 4) }",
        "p {\n  tips                                        // of these\n    (1, 2)                                    // behind\n    // below\n    (3, 4)\n}\n",
    );
    // A point has no comma after its second value.
    assert_layout(
        &format!("p {{\n  start ({a}{b}, {c}{a})\n}}"),
        &format!("p {{\n  start (\n      {a}{b},\n      {c}{a}\n    )\n}}\n")
            .replace("      ", "    ")
            .replace("\n    )", "\n  )"),
    );
}

#[test]
fn comments_stay_where_they_are() {
    assert_layout("// a\n\n\n\n// b\n\n", "// a\n\n// b\n");
    assert_layout(
        "a { // of a\n/* on its own */\nx=1// of x  \n// last\n} // behind",
        "a {                                           // of a\n  /* on its own */\n  x = 1                                       // of x\n  // last\n}                                             // behind\n",
    );
    assert_layout("a{/* in */}", "a { /* in */ }\n");
    assert_layout(
        "a{x=1/* one */,/* two */y=2}",
        "a { x = 1 /* one */, /* two */ y = 2 }\n",
    );
    assert_layout(
        "let v = 1+// one\n2",
        "let v = 1\n  +                                           // one\n  2\n",
    );
    assert_layout(
        "let v=(1 // one\n,2, // two\n// three\n/* four */ 4\n// end\n)",
        "let v = (\n  1,                                          // one\n  2,                                          // two\n  // three\n  /* four */ 4,\n  // end\n)\n",
    );
    assert_layout(
        "job /* a */ \"b\"/* c */// d",
        "job /* a */ \"b\"                               /* c */ // d\n",
    );
    assert_layout("/* a\r\n  b */ job \"c\"", "/* a\n  b */ job \"c\"\n");
}

/// A text whose own-line comments all keep their lines, and whose other ones begin in one column.
#[test]
fn comments_of_their_own_line_keep_it_within_statements() {
    let text = "job
  // own
  \"a\"
let a = 12 mm                                 // behind
  // own
  + 3 mm                                      // behind
let b = max(                                  // behind
  // own
  1 mm,
  // own
  2 mm,                                       // behind
  // own
  3 mm,
)
stock
  // own
  /* own */
{
  size = (1, 2, 3)
}
blade                                         // behind
{
  x
    /* own */
    = 4
  limits {
    swing <= 50 deg
    // own
    scallop <= 10 mm
  }
}
profile {
  line
    // own
    to (1, 2)
  arc  to (1 mm, 2 mm)                        // behind
    // own
    radius                                    // behind
    3 mm
}
let f = -
  // own
  3
";
    assert_layout(text, text);
    assert_layout(
        "let b = max(1,2\n// own\n,3)",
        "let b = max(\n  1,\n  2,\n  // own\n  3,\n)\n",
    );
    assert_layout(
        "let b = max(1,2\n/* own */\n,3)",
        "let b = max(\n  1,\n  2,\n  /* own */\n  3,\n)\n",
    );
}

#[test]
fn a_comment_ends_a_unit() {
    assert_layout("let a = 12 m/* c *//min", "let a = 12 m /* c */ / min\n");
    assert_layout("let a = 12 m / /* c */min", "let a = 12 m / /* c */ min\n");
}

#[test]
fn line_ends_and_marks_of_other_systems_are_brought_into_line() {
    assert_layout(
        "\u{feff}job \"a\"\r\n\r\n\r\nlet b = 1\rlet c = 2",
        "job \"a\"\n\nlet b = 1\nlet c = 2\n",
    );
    assert_layout("", "");
    assert_layout("\n \t\n", "");
    assert_layout("\tlet\ta\t=\t1", "let a = 1\n");
}

#[test]
fn texts_with_mistakes_are_refused_with_the_usual_messages() {
    let text = "let a = ";
    let file = SourceMap::default().add("t.vcut", text);
    assert_eq!(format(file, text), Err(parsed(text).1));
}

/// A tree without its places: what is written as `3..9` in it.
fn without_places(ast: &Ast) -> String {
    let mut shown = String::new();
    let mut rest = format!("{ast:?}");
    while let Some(at) = rest.find("..") {
        let before = rest[..at].trim_end_matches(|c: char| c.is_ascii_digit()).len();
        let after = rest[at + 2..].trim_start_matches(|c: char| c.is_ascii_digit());
        shown += &rest[..before];
        rest = after.to_owned();
    }
    shown + &rest
}

/// The comments of a text, found letter by letter.
fn comments(text: &str) -> Vec<String> {
    let text = text.replace("\r\n", "\n").replace('\r', "\n");
    let mut found = Vec::new();
    let mut rest = text.as_str();
    while let Some(at) = rest.find(['"', '/']) {
        rest = &rest[at..];
        let length = if rest.starts_with("//") {
            let length = rest.find('\n').unwrap_or(rest.len());
            found.push(rest[..length].trim_end().to_owned());
            length
        } else if let Some(inside) = rest.strip_prefix("/*") {
            let length = inside.find("*/").unwrap() + 4;
            found.push(rest[..length].to_owned());
            length
        } else if let Some(inside) = rest.strip_prefix('"') {
            inside.find('"').unwrap() + 2
        } else {
            1
        };
        rest = &rest[length..];
    }
    found
}

/// What may be wherever blanks may.
fn gap() -> impl Strategy<Value = &'static str> {
    prop_oneof![
        6 => Just(""),
        6 => Just(" "),
        1 => prop::sample::select(&["\n", "\r\n", "\t", "\n\n\n", "\r", " \n "][..]),
        1 => prop::sample::select(&["// a = {\n", " // \"b\" \r\n", "//\n// c\n", "\n// d\n\n"][..]),
        1 => prop::sample::select(&["/* ( */", " /* ü */ ", "/**//* f */", "/* g\n  h */", "\n/* i */\n", "\n/* j */ "][..]),
    ]
}

/// These pieces with gaps between them.
fn pieces(parts: Vec<BoxedStrategy<String>>) -> BoxedStrategy<String> {
    let count = parts.len();
    (parts, prop::collection::vec(gap(), count))
        .prop_map(|(parts, gaps)| {
            parts
                .into_iter()
                .zip(gaps)
                .map(|(part, gap)| part + gap)
                .collect()
        })
        .boxed()
}

fn mark(text: &'static str) -> BoxedStrategy<String> {
    Just(text.to_owned()).boxed()
}

fn name() -> BoxedStrategy<String> {
    prop::sample::select(
        &[
            "a",
            "width",
            "to",
            "line",
            "radius",
            "a_rather_long_name_of_something",
            "größe",
            "e\u{301}",
        ][..],
    )
    .prop_map(str::to_owned)
    .boxed()
}

fn text() -> BoxedStrategy<String> {
    prop::sample::select(&["\"\"", "\"a // b\"", "\"/* ü  x\""][..])
        .prop_map(str::to_owned)
        .boxed()
}

const NUMBERS: &[&str] = &["1", "4.4mm", "12 m/s", "30 %", "1e3\tmm", "6 m / 2", "007.50 deg"];

fn number() -> BoxedStrategy<String> {
    prop::sample::select(NUMBERS).prop_map(str::to_owned).boxed()
}

fn value() -> BoxedStrategy<String> {
    prop_oneof![4 => number(), 2 => name(), 1 => text()]
        .prop_recursive(3, 24, 4, |inner| {
            let inner = inner.boxed();
            let list = |start: BoxedStrategy<String>, least: usize| {
                let values = prop::collection::vec(pieces(vec![inner.clone(), mark(",")]), least..4);
                pieces(vec![
                    start,
                    values.prop_map(|values| values.concat()).boxed(),
                    mark(")"),
                ])
            };
            let call = list(mark("max("), 1);
            let argument = pieces(vec![mark("frame("), name(), mark("="), inner.clone(), mark(")")]);
            let group = list(mark("("), 2);
            let alone = pieces(vec![mark("("), inner.clone(), mark(")")]);
            let negative = pieces(vec![mark("-"), inner.clone()]);
            let operator = prop::sample::select(&["+", "-", "*", " / ", "^"][..])
                .prop_map(str::to_owned)
                .boxed();
            let sum = pieces(vec![inner.clone(), operator, inner]);
            prop_oneof![call, argument, group, alone, negative, sum]
        })
        .boxed()
}

fn point() -> BoxedStrategy<String> {
    pieces(vec![mark("("), value(), mark(","), value(), mark(")")])
}

fn entry() -> BoxedStrategy<String> {
    let relation = prop::sample::select(&["=", "<=", ">="][..])
        .prop_map(str::to_owned)
        .boxed();
    let points = prop::collection::vec(point(), 0..4)
        .prop_map(|points| points.concat())
        .boxed();
    prop_oneof![
        6 => pieces(vec![name(), relation, value()]),
        1 => pieces(vec![mark("z(x)"), mark("="), value()]),
        1 => pieces(vec![mark("start"), point()]),
        1 => pieces(vec![mark("arc "), mark("to"), point(), mark("radius "), value()]),
        1 => pieces(vec![mark("spline"), points, mark("to"), point()]),
        1 => pieces(vec![mark("points"), text()]),
    ]
    .prop_recursive(2, 12, 4, |inner| {
        let entries = prop::collection::vec(separated(inner.boxed()), 0..4);
        let entries = entries.prop_map(|entries| entries.concat()).boxed();
        let head = prop::sample::select(&["krl ", "limits", "points \"a\" ", "blade x "][..])
            .prop_map(str::to_owned)
            .boxed();
        pieces(vec![head, mark("{"), entries, mark("}")])
    })
    .boxed()
}

/// An entry and what sets it apart from the next one.
fn separated(entry: BoxedStrategy<String>) -> BoxedStrategy<String> {
    let separator = prop::sample::select(&["\n", ",", ", ", "\n\n", " // end\n", ", // end\n"][..]);
    let separator = separator.prop_map(str::to_owned).boxed();
    pieces(vec![entry, separator])
}

fn item() -> BoxedStrategy<String> {
    let entries = prop::collection::vec(separated(entry()), 0..6)
        .prop_map(|entries| entries.concat())
        .boxed();
    let item = prop_oneof![
        1 => pieces(vec![mark("use "), text()]),
        2 => pieces(vec![mark("let "), name(), mark("="), value()]),
        3 => pieces(vec![mark("rough "), mark("vcut"), mark("{"), entries, mark("}")]),
    ];
    pieces(vec![item.boxed(), mark("\n")])
}

fn job() -> impl Strategy<Value = String> {
    let mistakes = |text: &String| parsed(text).1.is_empty();
    (gap(), prop::collection::vec(item(), 0..5))
        .prop_map(|(gap, items)| format!("{gap}{}", items.concat()))
        .prop_filter("a job without mistakes", mistakes)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, max_local_rejects: 1_000_000, ..ProptestConfig::default() })]

    #[test]
    fn what_a_job_says_stays_and_the_layout_is_final(text in job()) {
        let once = formatted(&text);
        prop_assert_eq!(&formatted(&once), &once, "{}", text);
        prop_assert_eq!(without_places(&parsed(&once).0), without_places(&parsed(&text).0));
        prop_assert_eq!(comments(&once), comments(&text));
        prop_assert!(once.is_empty() || once.ends_with('\n') && !once.ends_with("\n\n"), "{:?}", once);
        prop_assert!(!once.contains(['\r', '\t']), "{:?}", once);
        prop_assert!(!once.contains(" \n"), "{:?}", once);
    }
}
