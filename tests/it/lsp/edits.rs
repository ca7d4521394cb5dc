//! Ten thousand edits at random: after each the server reports what a check of the whole text reports, and
//! answers whatever it is asked.

use super::editor::{BLADES, Editor, Memory, RIB, position, uri};
use serde_json::{Value, json};
use vcutc::diagnostics::source::SourceMap;
use vcutc::diagnostics::{Diagnostic, Severity};
use vcutc::job::sema::study::study;
use vcutc::job::sema::{Choices, Part};
use vcutc::syntax::ast::Item;

/// Numbers that look random and are the same in every run (SplitMix64).
struct Dice(u64);

impl Dice {
    fn roll(&mut self, sides: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        usize::try_from((z ^ (z >> 31)) % sides as u64).unwrap()
    }

    fn one_of<'a>(&mut self, of: &[&'a str]) -> &'a str {
        of[self.roll(of.len())]
    }

    /// A byte of a text at which a character begins, or its end.
    fn place(&mut self, text: &str) -> usize {
        whole(text, text.floor_char_boundary(self.roll(text.len() + 1)))
    }
}

/// A place that a client can name: not between the two characters of a line end.
fn whole(text: &str, place: usize) -> usize {
    let is_between = text[..place].ends_with('\r') && text[place..].starts_with('\n');
    place + usize::from(is_between)
}

const PIECES: &[&str] = &[
    "{",
    "}",
    "(",
    ")",
    "\"",
    "//",
    "/*",
    "*/",
    "=",
    "<=",
    ",",
    "\n",
    "\r\n",
    "\r",
    " ",
    "mm",
    "deg",
    "auto",
    "let x = 3 mm\n",
    "width",
    "dagger",
    "4.4",
    "-",
    "^",
    "ä",
    "🔪",
    "𝒳",
    "job",
    "use \"blades.vcut\"\n",
    "machine m = robot \"kuka/kr16_2\" {",
    "blade b {",
    "rough vcut {",
    "limits {",
    "profile {",
    "line to (1 mm, 2 mm)",
    "1e400",
    "half",
    "/ 0",
    "\u{feff}",
    "slow",
    "krl { decimals = 3 }",
    "frame(x = 0 mm)",
    "z(x) = x",
    "stock",
];

/// What is compared of a diagnostic.
type Published = (String, u64, Value, Value, String);

/// What has to be reported of a text, by the compiler's own check of all of it.
fn expected(path: &str, text: &str, part: Part) -> (Vec<Published>, bool) {
    let files = [
        (path.to_owned(), text.to_owned()),
        ("/shop/blades.vcut".to_owned(), BLADES.to_owned()),
    ];
    let files = Memory(files.into_iter().collect());
    let (mut sources, mut found) = (SourceMap::default(), Vec::new());
    let known = study(
        path,
        part,
        &files,
        Choices {
            operations: vcutc::registry::OPERATIONS,
            ..Choices::default()
        },
        &mut sources,
        &mut found,
    )
    .unwrap();
    let is_job = known.files[0]
        .ast
        .items
        .iter()
        .any(|item| matches!(item, Item::Job { .. }));
    let of_text = |diagnostic: &&Diagnostic| sources.name(diagnostic.primary.span.file) == path;
    let mut all: Vec<Published> = Vec::new();
    for diagnostic in found.iter().filter(of_text) {
        let span = diagnostic.primary.span;
        let place = |offset: u32| position(text, text.floor_char_boundary(offset as usize));
        let severity = if diagnostic.severity() == Severity::Error {
            1
        } else {
            2
        };
        let published = (
            diagnostic.code.number().to_owned(),
            severity,
            place(span.start),
            place(span.end),
            diagnostic.message.clone(),
        );
        if !all.contains(&published) {
            all.push(published);
        }
    }
    (all, is_job)
}

fn published(editor: &Editor, path: &str) -> Vec<Published> {
    let mut all: Vec<Published> = Vec::new();
    for diagnostic in editor.diagnostics(path) {
        let published = (
            diagnostic["code"].as_str().unwrap().to_owned(),
            diagnostic["severity"].as_u64().unwrap(),
            diagnostic["range"]["start"].clone(),
            diagnostic["range"]["end"].clone(),
            diagnostic["message"]
                .as_str()
                .unwrap()
                .lines()
                .next()
                .unwrap()
                .to_owned(),
        );
        if !all.contains(&published) {
            all.push(published);
        }
    }
    all
}

/// A server that has seen nothing but the text reports the same, to the letter.
fn as_a_fresh_server(editor: &Editor, path: &str) {
    let mut fresh = Editor::with(&[("rib.vcut", RIB), ("blades.vcut", BLADES)]);
    let text = editor.text(path);
    fresh.open_as(path, text);
    assert_eq!(editor.diagnostics(path), fresh.diagnostics(path), "{text}");
}

const QUESTIONS: &[&str] = &[
    "hover",
    "completion",
    "definition",
    "references",
    "documentHighlight",
    "documentSymbol",
    "foldingRange",
    "codeAction",
    "prepareRename",
    "rename",
    "inlayHint",
    "semanticTokens/full",
    "formatting",
];

/// Asks something about a random place. A refusal is an answer, but not that the parameters are wrong.
fn ask_something(editor: &mut Editor, path: &str, dice: &mut Dice) {
    let text = editor.text(path).to_owned();
    let (a, b) = (dice.place(&text), dice.place(&text));
    let question = dice.one_of(QUESTIONS);
    let params = json!({
        "textDocument": { "uri": uri(path) },
        "position": position(&text, a),
        "range": { "start": position(&text, a.min(b)), "end": position(&text, a.max(b)) },
        "context": { "includeDeclaration": true, "diagnostics": [], "triggerKind": 1 },
        "options": { "tabSize": 2, "insertSpaces": true },
        "newName": dice.one_of(&["wider", "auto", "half", "3x", "x"]),
    });
    if let Err(error) = editor.ask(&format!("textDocument/{question}"), params) {
        assert_eq!(error["code"], -32803, "{question}: {error}");
    }
}

#[test]
fn ten_thousand_edits_leave_the_server_right() {
    let path = "/shop/rib.vcut";
    let mut editor = Editor::with(&[("rib.vcut", RIB), ("blades.vcut", BLADES)]);
    editor.open(path);
    let mut dice = Dice(7);
    let (mut right, mut compared) = (0, 0);
    for number in 0..10_000 {
        // Now and then everything is as it was, so that edits also meet a text that is right.
        if number % 25 == 0 {
            let whole = editor.text(path).len();
            editor.type_in(path, 0..whole, RIB);
        } else {
            let text = editor.text(path);
            let start = dice.place(text);
            let end = match dice.roll(3) {
                0 => start,
                1 => text.ceil_char_boundary((start + dice.roll(4)).min(text.len())),
                _ => text.ceil_char_boundary((start + dice.roll(40)).min(text.len())),
            };
            let end = whole(text, end);
            let new = if dice.roll(4) == 0 {
                ""
            } else {
                dice.one_of(PIECES)
            };
            editor.type_in(path, start..end, new);
        }
        // Clients send several changes before anybody looks.
        if dice.roll(3) > 0 {
            continue;
        }
        editor.settle();
        let text = editor.text(path).to_owned();
        let (as_job, is_job) = expected(path, &text, Part::Job);
        let published = published(&editor, path);
        let is_right = published == as_job || !is_job && published == expected(path, &text, Part::Library).0;
        assert!(
            is_right,
            "edit {number}:\n{text}\nreported {published:#?}\nexpected {as_job:#?}"
        );
        assert_eq!(editor.published[&uri(path)]["version"].as_i64(), Some(number + 2));
        if compared % 20 == 0 {
            as_a_fresh_server(&editor, path);
        }
        compared += 1;
        right += usize::from(published.is_empty());
        ask_something(&mut editor, path, &mut dice);
    }
    assert!(
        compared > 3000 && right > 100,
        "{compared} compared, {right} right"
    );
}
