//! The grammar rule by rule, the shape of the tree, and hostile texts.

use super::ast::{Curve, Entry, HeadPart, Item, Operator, SurfaceFile};
use super::*;
use proptest::prelude::*;
use vcutc_diagnostics::Code;
use vcutc_diagnostics::render::{ColorChoice, render};
use vcutc_diagnostics::source::SourceMap;

fn parsed(text: &str) -> (Ast, Vec<Diagnostic>) {
    let file = SourceMap::default().add("t.vcut", text);
    let mut diagnostics = Vec::new();
    let ast = parse(file, text, &mut diagnostics);
    (ast, diagnostics)
}

fn codes(text: &str) -> Vec<Code> {
    parsed(text).1.iter().map(|d| d.code).collect()
}

/// A value with brackets around all that belongs together, and units in square ones.
fn shape(text: &str) -> String {
    let file = SourceMap::default().add("t", text);
    let mut diagnostics = Vec::new();
    match parse_expression(file, text, 0, &mut diagnostics) {
        Some(value) => {
            assert_eq!(diagnostics, []);
            shape_of(&value.node)
        }
        None => diagnostics.first().map_or("?", |d| d.code.number()).to_owned(),
    }
}

fn shape_of(value: &Expr) -> String {
    let list = |values: Vec<String>| values.join(", ");
    match value {
        Expr::Number { value, unit: None } => format!("{value}"),
        Expr::Number {
            value,
            unit: Some(unit),
        } => format!("{value}[{}]", unit.node),
        Expr::Text(text) => format!("{text:?}"),
        Expr::Name(name) => name.clone(),
        Expr::Call { function, arguments } => {
            let arguments = arguments.iter().map(|argument| match &argument.name {
                Some(name) => format!("{}: {}", name.node, shape_of(&argument.value.node)),
                None => shape_of(&argument.value.node),
            });
            format!("{}<{}>", function.node, list(arguments.collect()))
        }
        Expr::Negate(inner) => format!("(- {})", shape_of(&inner.node)),
        Expr::Binary {
            operator,
            left,
            right,
        } => {
            let sign = match operator.node {
                Operator::Add => "+",
                Operator::Subtract => "-",
                Operator::Multiply => "*",
                Operator::Divide => "/",
                Operator::Power => "^",
            };
            format!("({} {sign} {})", shape_of(&left.node), shape_of(&right.node))
        }
        Expr::Tuple(values) => format!("<{}>", list(values.iter().map(|v| shape_of(&v.node)).collect())),
    }
}

#[test]
fn values_group_as_in_mathematics() {
    for (text, expected) in [
        ("1 + 2 * 3", "(1 + (2 * 3))"),
        ("1 - 2 - 3", "((1 - 2) - 3)"),
        ("8 / 4 / 2", "((8 / 4) / 2)"),
        ("2^3^2", "(2 ^ (3 ^ 2))"),
        ("-2^2", "(- (2 ^ 2))"),
        ("2^-1", "(2 ^ (- 1))"),
        ("2^-3^2", "(2 ^ (- (3 ^ 2)))"),
        ("-2 * 3", "((- 2) * 3)"),
        ("2 * -3 + 1", "((2 * (- 3)) + 1)"),
        ("- - 1", "(- (- 1))"),
        ("(1 + 2) * 3", "((1 + 2) * 3)"),
        ("((1))", "1"),
        ("a-b", "(a - b)"),
        ("max(1, min(2, x))", "max<1, min<2, x>>"),
        ("frame(x = 0 mm, y = -a)", "frame<x: 0[mm], y: (- a)>"),
        ("f()", "f<>"),
        ("f(1,)", "f<1>"),
        ("(1, 2 mm, (3))", "<1, 2[mm], 3>"),
        ("1 // one\n + /* two */ 2", "(1 + 2)"),
        ("\"a \\\"b\\\" \\\\ // c\"", "\"a \\\"b\\\" \\\\ // c\""),
    ] {
        assert_eq!(shape(text), expected, "{text}");
    }
}

#[test]
fn numbers_and_their_units() {
    for (text, expected) in [
        ("4.4 mm", "4.4[mm]"),
        ("4.4mm", "4.4[mm]"),
        ("200 mm/s", "200[mm/s]"),
        ("6 m / s", "(6[m] / s)"),
        ("8 mm/2", "(8[mm] / 2)"),
        ("30 %", "30[%]"),
        ("1.5e3 mm", "1500[mm]"),
        ("1e-3", "0.001"),
        ("2 e", "2[e]"),
        ("2\n", "2"),
        ("4 mm^2", "(4[mm] ^ 2)"),
        ("1e308", &format!("{}", 1e308)),
        ("1e309 mm", "VC0106"),
        ("1 2", "VC0101"),
        (".5", "VC0101"),
        ("5.", "VC0101"),
        ("+5", "VC0101"),
        ("1_000", "VC0101"),
        ("", "VC0101"),
        ("()", "VC0101"),
        ("(1", "VC0102"),
        ("1)", "VC0103"),
        ("\"a", "VC0104"),
        ("4\"", "VC0204"),
        ("4.5 \"", "VC0204"),
    ] {
        assert_eq!(shape(text), expected, "{text}");
    }
}

#[test]
fn places_are_exact() {
    let text = "let w = 85 mm // c\nblade b { x = (1, 2) y <= a + b }";
    let (ast, diagnostics) = parsed(text);
    assert_eq!(diagnostics, []);
    let slice = |span: vcutc_diagnostics::source::Span| &text[span.bytes()];
    let [Item::Let { name, value, span }, Item::Block(block)] = &ast.items[..] else {
        panic!("{ast:?}");
    };
    assert_eq!(
        (slice(name.span), slice(value.span), slice(*span)),
        ("w", "85 mm", "let w = 85 mm")
    );
    assert_eq!(slice(block.span), "blade b { x = (1, 2) y <= a + b }");
    assert_eq!(slice(block.head[1].span), "b");
    let [
        Entry::Field { value, span, .. },
        Entry::Limit {
            relation,
            value: bound,
            span: limit,
            ..
        },
    ] = &block.entries[..]
    else {
        panic!("{block:?}");
    };
    assert_eq!((slice(value.span), slice(*span)), ("(1, 2)", "x = (1, 2)"));
    assert_eq!(
        (slice(relation.span), slice(bound.span), slice(*limit)),
        ("<=", "a + b", "y <= a + b")
    );
}

#[test]
fn a_single_value_lies_where_the_caller_says() {
    let file = SourceMap::default().add("--set width=90mm", "width=90mm");
    let value = parse_expression(file, "90mm", 6, &mut Vec::new()).unwrap();
    assert_eq!(value.span.bytes(), 6..10);
    let mut diagnostics = Vec::new();
    assert_eq!(parse_expression(file, "90 mm +", 6, &mut diagnostics), None);
    assert_eq!(diagnostics[0].primary.span.bytes(), 13..13);
}

#[test]
fn heads_of_blocks() {
    let (ast, _) = parsed("machine cell = robot \"kuka/kr210\" { krl { a = 1 } }");
    let Some(Item::Block(block)) = ast.items.first() else {
        panic!("{ast:?}");
    };
    let head: Vec<&HeadPart> = block.head.iter().map(|part| &part.node).collect();
    let word = |word: &str| HeadPart::Word(word.to_owned());
    assert_eq!(
        head,
        [
            &word("machine"),
            &word("cell"),
            &HeadPart::Equals,
            &word("robot"),
            &HeadPart::Text("kuka/kr210".to_owned())
        ]
    );
    assert!(matches!(&block.entries[..], [Entry::Block(inner)] if inner.entries.len() == 1));
}

#[test]
fn a_unit_is_not_a_name_of_what_follows() {
    for text in [
        "b { layer = 4 step = 3 mm }",
        "b { layer = 4 swing <= 3 mm }",
        "b { layer = 4 feed { } }",
        "b { layer = 4, feed { } }",
        "b { layer = 4 z(x) = 3 mm }",
    ] {
        let (ast, diagnostics) = parsed(text);
        assert_eq!(diagnostics, [], "{text}");
        let Some(Item::Block(block)) = ast.items.first() else {
            panic!("{ast:?}");
        };
        assert_eq!(block.entries.len(), 2, "{text}");
        let Some(Entry::Field { value, .. }) = block.entries.first() else {
            panic!("{block:?}");
        };
        assert_eq!(shape_of(&value.node), "4", "{text}");
    }
}

#[test]
fn statements_that_are_read_and_statements_that_are_not() {
    let item = |text: &str| text.to_owned();
    let entry = |text: &str| format!("b {{\n{text}\n}}");
    let right = [
        item("job \"a\""),
        item("job\n\"a\""),
        item("use \"a\" use \"b\" // c"),
        item("let a = 1 let b = 2"),
        item("stock {}"),
        item("jobs { }"),
        item("\u{feff}let a = 1\r\nlet b = 2\r\n"),
        entry("a = 1, b = 2, "),
        entry("a = 1 b = 2"),
        entry("a = auto\nb = \"x\""),
        entry("a = 1\n+ 2"),
        entry("a >= 1 b <= 2"),
        entry("z(x) = x"),
        entry("start (0, 1)"),
        entry("start = 1 line = 2 to = 3"),
        entry("line to (a + b, -1)"),
        entry("arc to (0, 1) radius -1"),
        entry("arc to (0, 1) center (0, 0) arc to (0, 1) through (1, 1)"),
        entry("bezier to (0, 1) spline (0, 1) to (0, 2) polyline (0, 1) (0, 2) to (0, 3)"),
        entry("points \"f\" airfoil \"g\" { side = upper }"),
        entry("points \"f\" { x = { } }").replace("{ }", "1"),
        entry("dxf \"f\" { layer = \"SKIN\" } svg \"g\""),
        entry("dxf = 1 svg = 2"),
        item("profile = dxf(\"f\")"),
        item("profile = svg(\"f\", layer = \"a\", side = upper,)\nlet b = 1"),
        item("profile =\n  points (\"f\" unit = in x = 3 mm)"),
    ];
    for text in right {
        assert_eq!(codes(&text), [], "{text}");
    }
    let wrong = [
        item("job a"),
        item("job \"a\" { }"),
        item("use"),
        item("let = 1"),
        item("let a = b c"),
        item("a = 1"),
        item("let a = 1, let b = 2").replace(", let b = 2", ","),
        item("stock [ ]"),
        item("5 { }"),
        item("profile = step(\"f\")"),
        item("profile = dxf"),
        item("profile = dxf()"),
        item("profile = dxf(\"f\", layer)"),
        entry("a = "),
        entry("a = 1 2"),
        entry("a = b = c"),
        entry("a < 1"),
        entry("a => 1"),
        entry("z() = 1"),
        entry("z(1) = 1"),
        entry("start 0, 1"),
        entry("start (0)"),
        entry("start (0, 1, 2)"),
        entry("line (0, 1)"),
        entry("arc to (0, 1)"),
        entry("bezier (0, 1)"),
        entry("points f"),
        entry("a = f(1 2)"),
        entry("a = f(x = )"),
        entry("a = (1, , 2)"),
        entry("$"),
        entry(","),
    ];
    for text in wrong {
        assert_eq!(codes(&text), [Code::UnexpectedText], "{text}");
    }
}

#[test]
fn surfaces_are_read() {
    let text = "surface { mesh \"a.stl\" { unit = mm } grid \"b.csv\" z(u, v) = u * v }
        surface { loft { at 0 mm { line to (1, 2) } at 2 * 3 in { } at a + (4 ft) { z(x) = x } } }
        profile { start (0 mm, 1 mm) }
        rough vcut { feed = 5 mm limits { step = 4 } at = 5 }";
    let (ast, found) = parsed(text);
    assert_eq!(found, []);
    let blocks = ast.items.iter().map(|item| match item {
        Item::Block(block) => block,
        other => panic!("{other:?}"),
    });
    let blocks: Vec<&ast::Block> = blocks.collect();
    let [sources, loft, _, plain] = &blocks[..] else {
        panic!("{ast:?}");
    };
    let [
        Entry::SurfaceFile { kind, options, .. },
        Entry::SurfaceFile { .. },
        Entry::Formula { variables, .. },
    ] = &sources.entries[..]
    else {
        panic!("{sources:?}");
    };
    assert_eq!((kind.node, options.len()), (SurfaceFile::Mesh, 1));
    assert_eq!(
        variables
            .iter()
            .map(|name| name.node.as_str())
            .collect::<String>(),
        "uv"
    );
    let [Entry::Block(loft)] = &loft.entries[..] else {
        panic!("{loft:?}");
    };
    let places = loft.entries.iter().map(|entry| match entry {
        Entry::Station { at, entries, .. } => (shape_of(&at.node), entries.len()),
        other => panic!("{other:?}"),
    });
    let places: Vec<_> = places.collect();
    let expected = [("0[mm]", 1), ("(2 * 3[in])", 0), ("(a + 4[ft])", 1)];
    assert_eq!(places, expected.map(|(at, count)| (at.to_owned(), count)));
    assert_eq!(plain.entries.len(), 3);
}

#[test]
fn words_of_surfaces_are_names_elsewhere() {
    let text = "let step = 3 mm let row = 2
        surface { step \"a.stp\" nurbs { degree = (1, 1), row (0, 1, 2) (row, step, 3, 4) row (1, 2) u_knots = (0, 0) } }
        rough vcut { step = step * row limits { step <= 4 mm } row = 5 mm step <= row }";
    let (ast, found) = parsed(text);
    assert_eq!(found, []);
    let [_, _, Item::Block(surface), Item::Block(plain)] = &ast.items[..] else {
        panic!("{ast:?}");
    };
    let [Entry::SurfaceFile { kind, .. }, Entry::Block(nurbs)] = &surface.entries[..] else {
        panic!("{surface:?}");
    };
    assert_eq!(kind.node, SurfaceFile::Step);
    let rows = nurbs.entries.iter().filter_map(|entry| match entry {
        Entry::ControlRow { points, .. } => Some(points),
        _ => None,
    });
    let rows: Vec<Vec<String>> = rows
        .map(|points| points.iter().map(|point| shape_of(&point.node)).collect())
        .collect();
    assert_eq!(rows, [vec!["<0, 1, 2>", "<row, step, 3, 4>"], vec!["<1, 2>"]]);
    assert_eq!((nurbs.entries.len(), plain.entries.len()), (4, 4));
}

#[test]
fn arcs_and_splines_keep_their_points() {
    let (ast, _) = parsed("profile { bezier (1, 2) (3, 4) to (5, 6) arc to (7, 8) radius 9 mm }");
    let Some(Item::Block(block)) = ast.items.first() else {
        panic!("{ast:?}");
    };
    let curves: Vec<&Curve> = block
        .entries
        .iter()
        .map(|entry| match entry {
            Entry::Curve { curve, .. } => &**curve,
            other => panic!("{other:?}"),
        })
        .collect();
    let [
        Curve::Bezier { control, to },
        Curve::Arc {
            by: ast::ArcBy::Radius(radius),
            ..
        },
    ] = &curves[..]
    else {
        panic!("{block:?}");
    };
    assert_eq!(control.len(), 2);
    assert_eq!(
        (shape_of(&to.first.node), shape_of(&to.second.node)),
        ("5".to_owned(), "6".to_owned())
    );
    assert_eq!(shape_of(&radius.node), "9[mm]");
}

#[test]
fn nesting_is_bounded_at_64() {
    let nested = |depth: usize| format!("let a = {}1{}", "(".repeat(depth), ")".repeat(depth));
    assert_eq!(codes(&nested(64)), []);
    assert_eq!(codes(&nested(65)), [Code::NestedTooDeeply]);
    let blocks = |depth: usize| format!("{}{}", "a {\n".repeat(depth), "}\n".repeat(depth));
    assert_eq!(codes(&blocks(64)), []);
    assert_eq!(codes(&blocks(65)), [Code::NestedTooDeeply]);
    let row = |operators: usize| format!("let a = 1{}", " ^ 1".repeat(operators));
    assert_eq!(codes(&row(250)), []);
    assert_eq!(codes(&row(251)), [Code::NestedTooDeeply]);
    let minus = |operators: usize| format!("let a = {}1", "-".repeat(operators));
    assert_eq!(codes(&minus(250)), []);
    assert_eq!(codes(&minus(251)), [Code::NestedTooDeeply]);
}

#[test]
fn what_is_wrong_elsewhere_does_not_spoil_what_is_right() {
    let text = "job \"a\"\nlet w = = 3\nstock { size = 1 mm, x = $, y = 2 }\nlet v = 4\nrough vcut {\n  limits {\n    swing <= 1\n  b = 2\n}\nlet u = 5\n";
    let (ast, diagnostics) = parsed(text);
    let found: Vec<Code> = diagnostics.iter().map(|d| d.code).collect();
    assert_eq!(
        found,
        [Code::UnexpectedText, Code::UnexpectedText, Code::UnclosedBracket]
    );
    let entries: Vec<usize> = ast
        .items
        .iter()
        .map(|item| match item {
            Item::Block(block) => block.entries.len(),
            Item::Job { .. } | Item::Use { .. } | Item::Let { .. } => 0,
        })
        .collect();
    assert_eq!(entries, [0, 2, 0, 2, 0], "job, stock, v, rough, u");
}

#[test]
fn the_list_of_mistakes_is_kept_short() {
    let (_, diagnostics) = parsed(&"let a = $\n".repeat(123));
    assert_eq!(diagnostics.len(), 20);
    assert!(
        diagnostics[19].notes[0].starts_with("103 more"),
        "{:?}",
        diagnostics[19]
    );
}

/// The parser's work is bounded by a number of calls that is linear in the length of the text
/// ([`grammar`]), so a text that took more than linear work would be reported as too entangled.
#[test]
fn hostile_texts_take_linear_work() {
    let blocks = |depth: usize, inner: &str| "a = {".repeat(depth) + inner + &"}".repeat(depth);
    let calls = |depth: usize, inner: &str| {
        let (open, close) = ("f(".repeat(depth), ")".repeat(depth));
        format!("let a = {open}{inner}{close}")
    };
    for text in [
        "(".repeat(100_000),
        "{".repeat(100_000),
        "{ a {".repeat(20_000),
        "a {".repeat(30_000),
        "a { b = (".repeat(10_000),
        "-".repeat(100_000),
        format!("let a = {}1", "-".repeat(100_000)),
        format!("let a = 1{}", "^1".repeat(50_000)),
        format!("let a = {}1", "(1 + ".repeat(20_000)),
        "a\n".repeat(50_000),
        "a ".repeat(50_000),
        "\"".repeat(100_001),
        "\"\n".repeat(20_000),
        ")".repeat(100_000),
        "}\n".repeat(50_000),
        "a {\n".repeat(20_000) + &"}\n".repeat(20_000),
        "/*".repeat(50_000),
        "// x\n".repeat(20_000),
        "1 // x\n".repeat(20_000),
        "= ".repeat(50_000),
        ",".repeat(50_000),
        "a { ".to_owned() + &"b = 1 $, ".repeat(10_000) + "}",
        blocks(60, "$"),
        blocks(60, &"b c d ".repeat(2_000)),
        calls(60, "$"),
        calls(60, &"1 mm, ".repeat(10_000)),
        calls(60, &"(1, 2), ".repeat(100)) + " $",
    ] {
        for diagnostic in parsed(&text).1 {
            let entangled = diagnostic.message.contains("entangled");
            assert!(!entangled, "{}", text.chars().take(40).collect::<String>());
        }
    }
}

#[test]
fn a_megabyte_of_noise() {
    // Numbers without pattern (xorshift, Marsaglia 2003), the same in every run.
    let mut state = 0x2545_F491_4F6C_DD1D_u64;
    let mut next = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        state
    };
    let bytes: Vec<u8> = (0..1 << 20).map(|_| next().to_le_bytes()[3]).collect();
    assert!(!codes(&String::from_utf8_lossy(&bytes)).is_empty());
    let characters: String = bytes.iter().map(|byte| char::from(byte & 0x7f)).collect();
    assert!(!codes(&characters).is_empty());
    let tokens: String = (0..150_000)
        .map(|_| TOKENS[next() as usize % TOKENS.len()])
        .collect();
    assert!(!codes(&tokens).is_empty());
}

pub(super) const TOKENS: &[&str] = &[
    "job ", "use ", "let ", "stock ", "a ", "mm ", "start ", "line ", "to ", "arc ", "radius ", "points ",
    "auto ", "(", ")", "(", ")", "{", "}", "{", "}", "=", "=", "<=", ">=", ",", ",", "+", "-", "*", "/", "^",
    "%", "1", "2.5 mm", "1e999", "\"x\"", "\"", "\\", "// c\n", "/* c */", "/*", "\n", "\n", "\r\n", "\n  ",
    "$", ";", "°", "é", "\u{feff}",
];

#[test]
fn brackets_put_in_are_never_mentioned() {
    for text in [
        "a { b = f(",
        "a {\n  b = (1 +\n  c = 2\n}",
        "let a = (1, 2\nlet b = 3",
        "a { b (// c\n",
    ] {
        let (_, diagnostics) = parsed(text);
        let found: Vec<Code> = diagnostics.iter().map(|d| d.code).collect();
        assert!(
            found.iter().all(|&code| code == Code::UnclosedBracket),
            "{text} {diagnostics:#?}"
        );
    }
}

#[test]
fn a_block_without_its_end_ends_with_the_file() {
    let (ast, _) = parsed("stock { a = 1");
    let Some(Item::Block(block)) = ast.items.first() else {
        panic!("{ast:?}");
    };
    assert_eq!((block.span.bytes(), block.entries.len()), (0..13, 1));
}

/// Whatever the text, it is read without a panic, its mistakes can be shown, and all places lie in the text.
fn is_survived(text: &str) {
    let mut sources = SourceMap::default();
    let file = sources.add("t.vcut", text);
    let mut diagnostics = Vec::new();
    parse(file, text, &mut diagnostics);
    for diagnostic in &diagnostics {
        for label in std::iter::once(&diagnostic.primary).chain(&diagnostic.secondary) {
            let range = label.span.bytes();
            assert!(text.get(range.clone()).is_some(), "{range:?} of {text:?}");
        }
        for fix in &diagnostic.fixes {
            assert!(
                vcutc_diagnostics::fix::apply(text, file, &fix.edits).is_some(),
                "{fix:?}"
            );
        }
    }
    let rendered = render(&diagnostics, &sources, ColorChoice::Colored);
    assert_eq!(rendered.is_empty(), diagnostics.is_empty());
    parse_expression(file, text, 0, &mut Vec::new());
}

proptest! {
    #[test]
    fn any_text_is_survived(text in any::<String>()) {
        is_survived(&text);
    }

    #[test]
    fn any_row_of_tokens_is_survived(tokens in prop::collection::vec(prop::sample::select(TOKENS), 0..60)) {
        is_survived(&tokens.concat());
    }

    /// Cutting a piece out of a right job: the kind of text an editor sees all day.
    #[test]
    fn any_part_of_a_job_is_survived(from in 0_usize..1500, length in 0_usize..40) {
        let job = include_str!("../../tests/syntax/ok/sketch.vcut");
        let kept = |c: &(usize, char)| !(from..from + length).contains(&c.0);
        let text: String = job.char_indices().filter(kept).map(|(_, c)| c).collect();
        is_survived(&text);
    }
}
