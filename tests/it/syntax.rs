//! Job files that can be read, and job files that cannot: each of the latter names the codes it expects in its first
//! line, and its snapshot shows it together with what people get to see.

use std::fs;
use std::path::Path;
use vcutc::diagnostics::Diagnostic;
use vcutc::diagnostics::render::{ColorChoice, render};
use vcutc::diagnostics::source::{FileId, SourceMap, Span, text_from_bytes};
use vcutc::diagnostics::{Code, fix};
use vcutc::syntax::parse;

struct Case {
    sources: SourceMap,
    file: FileId,
    text: String,
    diagnostics: Vec<Diagnostic>,
}

fn read(path: &Path) -> Case {
    let name = path.file_name().unwrap().to_string_lossy().into_owned();
    let text = fs::read_to_string(path).unwrap();
    let mut sources = SourceMap::default();
    let file = sources.add(name, text.clone());
    let mut diagnostics = Vec::new();
    parse(file, &text, &mut diagnostics);
    Case {
        sources,
        file,
        text,
        diagnostics,
    }
}

fn expected_codes(text: &str) -> Vec<&str> {
    let first = text.lines().next().unwrap_or_default();
    let list = first
        .strip_prefix("// expect: ")
        .expect("the first line reads `// expect: VCnnnn ...`");
    list.split_whitespace().collect()
}

#[test]
fn right_files_are_read() {
    insta::glob!("../syntax/ok", "*.vcut", |path| {
        let case = read(path);
        let rendered = render(&case.diagnostics, &case.sources, ColorChoice::Plain);
        assert_eq!(rendered, "", "{}", path.display());
    });
}

#[test]
fn wrong_files_are_explained() {
    let mut surprises = Vec::new();
    insta::glob!("../syntax/err", "*.vcut", |path| {
        let case = read(path);
        let rendered = render(&case.diagnostics, &case.sources, ColorChoice::Plain);
        insta::with_settings!({ omit_expression => true, prepend_module_to_snapshot => false }, {
            insta::assert_snapshot!(format!("{}\n{rendered}", case.text));
        });
        let codes: Vec<&str> = case.diagnostics.iter().map(|d| d.code.number()).collect();
        if codes != expected_codes(&case.text) {
            surprises.push(format!("{}: {codes:?}", path.display()));
        }
    });
    assert!(surprises.is_empty(), "{surprises:#?}");
}

/// An offered fix must fix what it is offered for.
#[test]
fn fixes_mend_what_they_are_offered_for() {
    insta::glob!("../syntax/err", "*.vcut", |path| {
        let case = read(path);
        let offered = case.diagnostics.iter().flat_map(|d| d.fixes.first());
        let edits: Vec<_> = offered.flat_map(|fix| fix.edits.clone()).collect();
        let left = case.diagnostics.iter().filter(|d| d.fixes.is_empty()).count();
        let fixed = fix::apply(&case.text, case.file, &edits).expect("fixes fit the text");
        let mut diagnostics = Vec::new();
        parse(case.file, &fixed, &mut diagnostics);
        let rendered = render(&diagnostics, &case.sources, ColorChoice::Plain);
        assert!(
            diagnostics.len() <= left,
            "{}\n{fixed}\n{rendered}",
            path.display()
        );
    });
}

#[test]
fn every_code_of_the_syntax_has_an_example() {
    for code in Code::ALL.iter().filter(|code| code.number().starts_with("VC01")) {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/check/err");
        let is_its_own = |path: &Path| {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            name.starts_with(code.number())
        };
        let mut paths = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
        let path = paths.find(|path| is_its_own(path));
        let path = path.unwrap_or_else(|| panic!("{} has no example", code.number()));
        let codes = match text_from_bytes(fs::read(&path).unwrap()) {
            Err(_) => vec![Code::NotUtf8.number()],
            Ok(_) => {
                let case = read(&path);
                case.diagnostics.iter().map(|d| d.code.number()).collect()
            }
        };
        assert_eq!(codes, [code.number()], "{}", path.display());
    }
}

/// The pages of the codes show a job that fails and the same job fixed.
#[test]
fn pages_show_what_they_say() {
    // What is not UTF-8 cannot be shown on a page.
    let shown = |code: &&Code| code.number().starts_with("VC01") && **code != Code::NotUtf8;
    for code in Code::ALL.iter().filter(shown) {
        let blocks: Vec<&str> = code
            .page()
            .split("```vcut\n")
            .skip(1)
            .filter_map(|rest| rest.split("```").next())
            .collect();
        let [wrong, right] = blocks[..] else {
            panic!("the page of {} has two examples", code.number());
        };
        let codes = |text: &str| {
            let file = SourceMap::default().add("page", text);
            let mut diagnostics = Vec::new();
            parse(file, text, &mut diagnostics);
            diagnostics.iter().map(|d| d.code).collect::<Vec<_>>()
        };
        assert_eq!(codes(wrong), [*code], "{wrong}");
        assert_eq!(codes(right), [], "{right}");
        let title = format!("# {}: {}\n", code.number(), code.title());
        assert!(code.page().starts_with(&title), "{title}");
    }
}

#[test]
fn labels_lie_in_several_files() {
    let mut sources = SourceMap::default();
    let blades = "// Längen der Klingen\nblade dagger {\n  cutting_length = 10 mm\n}\n";
    let shop = sources.add("shop/blades.vcut", blades);
    let job = "rough vcut {\n  blade = dagger\n\n\n\n  layer = 12 mm  // größer als 10 mm\n}\n";
    let rib = sources.add("rib.vcut", job);
    let place = |file: FileId, text: &str, words: &str| {
        let start = text.find(words).unwrap();
        Span::of_bytes(file, start..start + words.len())
    };
    let diagnostic = Diagnostic::new(
        Code::OutOfRange,
        "the layers are further apart than the blade is long",
        place(rib, job, "12 mm"),
        "12 mm",
    )
    .and(place(shop, blades, "10 mm"), "the blade cuts with 10 mm")
    .and(place(rib, job, "dagger"), "of this blade")
    .note("a layer needs an edge of its own height\nand a little more")
    .help("set `layer` to 9.2 mm or less")
    .fix("leave it to the compiler", place(rib, job, "12 mm"), "auto");
    insta::assert_snapshot!(render(&[diagnostic], &sources, ColorChoice::Plain), @r#"
    error[VC0210]: the layers are further apart than the blade is long
       ╭─[ rib.vcut:6:11 ]
       │
     2 │   blade = dagger
       │           ┬─────
       │           ╰─────── of this blade
       │
     6 │   layer = 12 mm  // größer als 10 mm
       │           ┬────
       │           ╰────── 12 mm
       │
       ├─[ shop/blades.vcut:3:20 ]
       │
     3 │   cutting_length = 10 mm
       │                    ┬────
       │                    ╰────── the blade cuts with 10 mm
       │
       = note: a layer needs an edge of its own height
               and a little more
       = help: set `layer` to 9.2 mm or less
       = help: leave it to the compiler: `auto`
    "#);
}

#[test]
fn lines_too_long_to_draw_are_only_named() {
    let text = format!("let a = {}$", "1 + ".repeat(200));
    let mut sources = SourceMap::default();
    let file = sources.add("long.vcut", text.clone());
    let mut diagnostics = Vec::new();
    parse(file, &text, &mut diagnostics);
    insta::assert_snapshot!(render(&diagnostics, &sources, ColorChoice::Plain), @r#"
    error[VC0101]: expected a value after `...+ 1 + 1 + 1 + 1 + 1 + 1 + 1 +`
      --> long.vcut:1:809: found `$`
       │
       = help: write a value such as `4.4 mm`, `auto` or `"text"`
    "#);
}

#[test]
fn any_span_can_be_drawn() {
    let texts = [
        "",
        "\n",
        "aé\r\nµ\t\u{2028}x\r",
        "\u{feff}end\n\n",
        "\u{1b}[31m\u{202e}",
    ];
    for text in texts {
        let mut sources = SourceMap::default();
        let file = sources.add("t.vcut", text);
        for start in 0..=u32::try_from(text.len()).unwrap() + 2 {
            for end in 0..=u32::try_from(text.len()).unwrap() + 2 {
                let span = Span { file, start, end };
                let diagnostic = Diagnostic::new(Code::UnexpectedText, "m", span, "label one")
                    .and(span.after(), "label two")
                    .note("n");
                let rendered = render(&[diagnostic], &sources, ColorChoice::Plain);
                assert!(rendered.starts_with("error[VC0101]: m\n"));
                assert!(
                    rendered.contains("label one") && rendered.contains("label two"),
                    "{text:?} {span:?}\n{rendered}"
                );
                assert!(!rendered.contains('\u{1b}') && !rendered.contains('\u{202e}'));
            }
        }
    }
}
