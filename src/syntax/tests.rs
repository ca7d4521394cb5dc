use super::*;
use crate::source::SourceMap;

fn codes(text: &str) -> Vec<&'static str> {
    let mut sources = SourceMap::default();
    let file = sources.add("t.vcut", text);
    let mut found = Vec::new();
    parse(file, text, &mut found);
    found.iter().map(|d| d.code.number()).collect()
}

#[test]
fn sketch() {
    let text = include_str!("../../tests/syntax/ok/sketch.vcut");
    let mut sources = SourceMap::default();
    let file = sources.add("t.vcut", text);
    let mut found = Vec::new();
    let ast = parse(file, text, &mut found);
    assert_eq!(found, []);
    assert_eq!(ast.items.len(), 8);
}

#[test]
fn hostile_texts_take_linear_work() {
    for text in [
        "(".repeat(100_000),
        "{".repeat(100_000),
        "{ a {".repeat(50_000),
        "a {".repeat(50_000),
        "a { b = (".repeat(50_000),
        format!("let a = {}1", "-".repeat(100_000)),
        format!("let a = 1{}", "^1".repeat(100_000)),
        format!("let a = 1{}", " + 1 mm".repeat(100_000)),
        "a\n".repeat(100_000),
        "a ".repeat(100_000),
        "\"".repeat(100_000),
        ")".repeat(100_000),
        "}".repeat(100_000),
        "}\n".repeat(100_000),
        "a {\n".repeat(50_000) + &"}\n".repeat(50_000),
        "/*".repeat(100_000),
        "// x\n".repeat(100_000),
        "1 // x\n".repeat(100_000),
        "f(".repeat(60) + &"1, ".repeat(100_000),
        "= ".repeat(100_000),
        "a = {".repeat(60) + "$" + &"}".repeat(60),
        ",".repeat(100_000),
        format!("let a = {}1$", "f(".repeat(60)),
    ] {
        let codes = codes(&text);
        println!("{} {:?}", &text[..10], codes);
    }
}
