//! Answers to questions about a place.

use super::editor::{BLADES, Editor, RIB, offset, uri};
use serde_json::{Value, json};

const PATH: &str = "/shop/rib.vcut";

fn rib() -> Editor {
    let mut editor = Editor::with(&[("rib.vcut", RIB), ("blades.vcut", BLADES)]);
    editor.open(PATH);
    assert_eq!(editor.codes(PATH), [""; 0]);
    editor
}

fn hover(editor: &mut Editor, piece: &str) -> String {
    let at = editor.at(PATH, piece);
    let answer = editor.ask("textDocument/hover", at).unwrap();
    answer["contents"]["value"]
        .as_str()
        .unwrap_or_default()
        .to_owned()
}

#[test]
fn hovering_shows_values_units_and_formulas() {
    let mut editor = rib();
    for (piece, parts) in [
        (
            "ra|ke  = 60",
            vec![
                "angle between tool axis and feed",
                "Enters as `theta`",
                "[Cui 2]",
                "`60 deg` = `1.0472 rad`",
            ],
        ),
        ("travel = |12 m/min", vec!["`12 m/min` = `200 mm/s`, a speed"]),
        (
            "12 |m/min",
            vec!["`m/min`: metre per minute", "`1 m/min` = `16.6667 mm/s`, a speed"],
        ),
        (
            "to (ha|lf,",
            vec![
                "`half` = `30 mm`, a length",
                "let half  = width / 2",
                "Defined in /shop/rib.vcut",
            ],
        ),
        (
            "blade = da|gger",
            vec![
                "`dagger`, a straight blade",
                "cutting_length = 20 mm",
                "Defined in /shop/blades.vcut",
            ],
        ),
        ("cut = sl|ow", vec!["`slow` = `200 mm/s`"]),
        ("residual = disc|ard", vec!["such a cut is left out"]),
        (
            "swing = au|to",
            vec![
                "`auto`",
                "Chosen as: together, the values that minimize the objective",
            ],
        ),
        ("lim|its {", vec!["limits on the choice"]),
        ("swing <|= 45", vec![]),
        (
            "sw|ing <= 45",
            vec!["**swing** of `limits`", "Here `45 deg` = `0.785398 rad`"],
        ),
        ("ro|ugh vcut", vec!["V-shaped roughing of the stock"]),
        ("us|e \"blades", vec!["The path is relative to the file"]),
        ("li|ne to (half", vec!["`line`: a straight line"]),
        ("\"bla|des.vcut\"", vec!["The file `/shop/blades.vcut`"]),
        ("Ri|ppe", vec![]),
    ] {
        let shown = hover(&mut editor, piece);
        assert_eq!(shown.is_empty(), parts.is_empty(), "{piece}: {shown}");
        for part in parts {
            assert!(shown.contains(part), "{piece}: {shown}");
        }
    }
}

fn labels(editor: &mut Editor, piece: &str) -> Vec<String> {
    let at = editor.at(PATH, piece);
    let offered = editor.ask("textDocument/completion", at).unwrap();
    let mut items: Vec<Value> = offered.as_array().unwrap().clone();
    items.sort_by_key(|item| item["sortText"].as_str().unwrap().to_owned());
    items
        .iter()
        .map(|item| item["label"].as_str().unwrap().to_owned())
        .collect()
}

#[test]
fn what_is_missing_in_a_block_is_offered_first() {
    let mut editor = rib();
    editor.replace(PATH, "  rake  = 60 deg\n", "  \n");
    editor.replace(PATH, "  clearance = 10 mm\n", "");
    assert_eq!(editor.codes(PATH), ["VC0206", "VC0206"]);
    let offered = labels(&mut editor, "dagger\n  |\n");
    assert_eq!(
        &offered[..3],
        ["all fields that rough still needs", "clearance", "rake"]
    );
    assert!(offered.contains(&"objective".to_owned()));
    assert!(!offered.contains(&"swing".to_owned()), "it is there: {offered:?}");
    // What is offered for all of them makes the job right.
    let at = editor.at(PATH, "dagger\n  |\n");
    let items = editor.ask("textDocument/completion", at).unwrap();
    let all = items
        .as_array()
        .unwrap()
        .iter()
        .find(|item| item["label"].as_str().unwrap().starts_with("all "));
    let text = all.unwrap()["textEdit"]["newText"].as_str().unwrap();
    assert_eq!(text, "rake = ${1:60 deg}\nclearance = ${2:10 mm}");
    editor.replace(
        PATH,
        "dagger\n  \n",
        "dagger\n  rake = 60 deg\nclearance = 10 mm\n",
    );
    assert_eq!(editor.codes(PATH), [""; 0]);
}

#[test]
fn units_words_names_and_machines_that_fit_are_offered() {
    let mut editor = rib();
    assert_eq!(
        labels(&mut editor, "clearance = 10 |mm"),
        ["cm", "ft", "in", "m", "mm", "um"]
    );
    assert_eq!(
        labels(&mut editor, "reorient = 90 |deg/s"),
        ["deg/s", "rad/s", "rev/min", "rev/s"]
    );
    assert_eq!(
        labels(&mut editor, "residual = |discard"),
        ["auto", "discard", "lift", "mixed", "shift"]
    );
    assert_eq!(labels(&mut editor, "blade = |dagger"), ["dagger"]);
    assert_eq!(labels(&mut editor, "cut = |slow")[0], "200 mm/s");
    assert!(labels(&mut editor, "cut = s|low").starts_with(&["slow".to_owned()]));
    let layer = labels(&mut editor, "layer = |5 mm");
    assert_eq!(&layer[..3], ["auto", "half", "width"]);
    assert!(layer.contains(&"sqrt".to_owned()));
    assert_eq!(labels(&mut editor, "𝒳 half| of it"), [""; 0]);
    let end = RIB.len();
    editor.type_in(
        PATH,
        end..end,
        "machine arm = robot \"kuka/kr210\" { tool = frame(x = 0 mm, ) }\n",
    );
    let models = labels(&mut editor, "robot \"kuka/kr210|\"");
    assert!(models.len() > 30 && models.contains(&"kuka/kr210_r3100_ultra".to_owned()));
    assert_eq!(
        labels(&mut editor, "frame(x = 0 mm, |)"),
        ["a", "b", "c", "q", "y", "z"]
    );
    assert!(labels(&mut editor, "{ |tool").starts_with(&["base".to_owned()]));
    let top = labels(&mut editor, "}\n|machine");
    assert!(
        top.contains(&"blade".to_owned()) && !top.contains(&"stock".to_owned()),
        "{top:?}"
    );
    editor.replace(PATH, "machine arm = robot", "machine arm = ro");
    assert_eq!(labels(&mut editor, "machine arm = ro|"), ["five_axis", "robot"]);
    editor.type_in(PATH, end..end, "blade wheel = di\n");
    assert_eq!(
        labels(&mut editor, "blade wheel = di|"),
        ["crusher", "disc", "straight"]
    );
    editor.replace(PATH, "blade wheel = di", "blade wheel = disc { radius = 25 mm }");
    let fields = labels(&mut editor, "disc { |radius");
    assert!(fields.contains(&"spin".to_owned()) && !fields.contains(&"edges".to_owned()));
}

#[test]
fn files_of_fitting_endings_are_offered_where_a_path_is_written() {
    let mut editor = Editor::with(&[
        ("rib.vcut", RIB),
        ("blades.vcut", BLADES),
        ("feeds/soft.vcut", "let soft = 100 mm/s\n"),
        ("heights.csv", "x,z\n0,18\n85,14\n"),
        ("feeds/notes.txt", "points of another day\n"),
        ("clark.dat", "no coordinates yet\n"),
        ("arm.toml", "\n"),
    ]);
    editor.open(PATH);
    assert_eq!(
        labels(&mut editor, "use \"|blades.vcut\""),
        ["blades.vcut", "feeds/"],
        "a file does not use itself"
    );
    editor.replace(PATH, "use \"blades.vcut\"", "use \"feeds/\"");
    assert_eq!(labels(&mut editor, "use \"feeds/|\""), ["feeds/soft.vcut"]);
    editor.replace(PATH, "use \"feeds/\"", "use \"blades.vcut\"");
    let end = RIB.len();
    for (line, piece, expected) in [
        (
            "profile { points \"he\" }",
            "points \"he|\"",
            vec!["heights.csv", "feeds/"],
        ),
        (
            "profile { airfoil \"\" }",
            "airfoil \"|\"",
            vec!["clark.dat", "feeds/"],
        ),
        (
            "profile = points(\"\")",
            "points(\"|\"",
            vec!["heights.csv", "feeds/"],
        ),
        (
            "profile { points \"feeds/\" }",
            "points \"feeds/|\"",
            vec!["feeds/notes.txt"],
        ),
        ("profile { dxf \"\" }", "dxf \"|\"", vec!["feeds/"]),
        ("job \"\"", "job \"|\"", vec![]),
    ] {
        let line = format!("{line}\n");
        editor.type_in(PATH, end..end, &line);
        assert_eq!(labels(&mut editor, piece), expected, "{line}");
        editor.type_in(PATH, end..end + line.len(), "");
    }
    editor.type_in(PATH, end..end, "machine arm = robot \"\" { }\n");
    let machines = labels(&mut editor, "robot \"|\"");
    assert!(
        machines.contains(&"arm.toml".to_owned()) && machines.contains(&"kuka/kr210_r3100_ultra".to_owned())
    );
}

#[test]
fn a_near_file_is_a_quick_fix() {
    let mut editor = Editor::with(&[("rib.vcut", RIB), ("blades.vcut", BLADES)]);
    editor.open(PATH);
    editor.replace(PATH, "use \"blades.vcut\"", "use \"blade.vcut\"");
    assert!(editor.codes(PATH).contains(&"VC0212".to_owned()));
    let at = editor.at(PATH, "use \"bla|de.vcut\"");
    let params = json!({
        "textDocument": at["textDocument"],
        "range": { "start": at["position"], "end": at["position"] },
        "context": { "diagnostics": [] }
    });
    let actions = editor.ask("textDocument/codeAction", params).unwrap();
    let action = &actions.as_array().unwrap()[0];
    assert_eq!(action["title"], "Did you mean `\"blades.vcut\"`?");
    assert!(action.to_string().contains("\\\"blades.vcut\\\""), "{action}");
}

#[test]
fn clients_without_snippets_get_texts() {
    let mut editor = Editor::with(&[("rib.vcut", RIB), ("blades.vcut", BLADES)]);
    editor.server = vcutc::lsp::Server::new(vcutc::registry::OPERATIONS, &vcutc::registry::backends());
    editor
        .ask("initialize", json!({ "processId": null, "capabilities": {} }))
        .unwrap();
    editor.open(PATH);
    let at = editor.at(PATH, "|stock {");
    let items = editor.ask("textDocument/completion", at).unwrap();
    let blade = items
        .as_array()
        .unwrap()
        .iter()
        .find(|item| item["label"] == "blade")
        .unwrap();
    assert_eq!(blade["textEdit"]["newText"], "blade name {\n  \n}");
}

#[test]
fn definitions_lead_over_files() {
    let mut editor = rib();
    let at = editor.at(PATH, "blade = dag|ger");
    let place = editor.ask("textDocument/definition", at).unwrap();
    assert_eq!(place["uri"], uri("/shop/blades.vcut"));
    assert_eq!(place["range"]["start"], json!({ "line": 0, "character": 6 }));
    let at = editor.at(PATH, "width / 2|");
    assert_eq!(editor.ask("textDocument/definition", at).unwrap(), Value::Null);
    let at = editor.at(PATH, "\"bl|ades.vcut\"");
    let file = editor.ask("textDocument/definition", at).unwrap();
    assert_eq!(file["uri"], uri("/shop/blades.vcut"));
    let at = editor.at(PATH, "let wi|dth");
    let marks = editor.ask("textDocument/documentHighlight", at).unwrap();
    assert_eq!(marks.as_array().unwrap().len(), 4);
}

/// Umlauts, letters of two units and a byte order mark before a place do not move it.
#[test]
fn places_are_counted_in_utf_16() {
    let mut editor = rib();
    editor.replace(PATH, "swing <= 45 deg", "/* 𝒳🔪ä */ swing <= 45");
    let diagnostics = editor.diagnostics(PATH);
    assert_eq!(diagnostics[0]["code"], "VC0203");
    let line = editor
        .text(PATH)
        .lines()
        .position(|line| line.contains("45"))
        .unwrap();
    let column = "  limits { /* 𝒳🔪ä */ swing <= ".encode_utf16().count();
    assert_eq!(
        diagnostics[0]["range"]["start"],
        json!({ "line": line, "character": column })
    );
    let at = editor.at(PATH, "|// 𝒳 half of it");
    let _ = editor.ask("textDocument/hover", at).unwrap();
    let range = json!({ "start": diagnostics[0]["range"]["start"], "end": diagnostics[0]["range"]["end"] });
    let params = json!({
        "textDocument": { "uri": uri(PATH) }, "range": range, "context": { "diagnostics": diagnostics },
    });
    let actions = editor.ask("textDocument/codeAction", params).unwrap();
    assert_eq!(actions[0]["kind"], "quickfix");
    let edit = actions[0]["edit"].clone();
    editor.make(&edit);
    assert_eq!(editor.codes(PATH), [""; 0], "{edit}");
}

#[test]
fn second_parties_are_related() {
    let mut editor = rib();
    editor.replace(PATH, "let half", "let slow = 3 mm\nlet half");
    let diagnostics = editor.diagnostics(PATH);
    let twice = diagnostics
        .iter()
        .find(|diagnostic| diagnostic["code"] == "VC0202")
        .unwrap();
    let other = &twice["relatedInformation"][0];
    assert_eq!(other["location"]["uri"], uri("/shop/blades.vcut"));
    assert_eq!(other["message"], "first defined here, in another file");
}

#[test]
fn the_outline_has_items_and_fields() {
    let mut editor = rib();
    let outline = editor
        .ask(
            "textDocument/documentSymbol",
            json!({ "textDocument": { "uri": uri(PATH) } }),
        )
        .unwrap();
    let names: Vec<&str> = outline
        .as_array()
        .unwrap()
        .iter()
        .map(|item| item["name"].as_str().unwrap())
        .collect();
    assert_eq!(
        names,
        [
            "rib",
            "blades.vcut",
            "width",
            "half",
            "stock",
            "profile",
            "rough vcut"
        ]
    );
    let fields: Vec<&str> = outline[6]["children"]
        .as_array()
        .unwrap()
        .iter()
        .map(|item| item["name"].as_str().unwrap())
        .collect();
    assert_eq!(&fields[..3], ["blade", "rake", "swing"]);
}

/// Every fold begins where a bracket or a comment opens, and ends in the line before it closes, or with the comment.
#[test]
fn blocks_and_comments_of_several_lines_fold() {
    let mut editor = rib();
    editor.replace(PATH, "let half", "/* first\n   second */\nlet half");
    let folds = editor
        .ask(
            "textDocument/foldingRange",
            json!({ "textDocument": { "uri": uri(PATH) } }),
        )
        .unwrap();
    let text = editor.text(PATH).to_owned();
    let lines: Vec<&str> = text.lines().collect();
    let line = |fold: &serde_json::Value, key: &str| usize::try_from(fold[key].as_u64().unwrap()).unwrap();
    let folds = folds.as_array().unwrap();
    for fold in folds {
        let (first, last) = (line(fold, "startLine"), line(fold, "endLine"));
        if fold["kind"] == "comment" {
            assert!(lines[first].contains("/*") && lines[last].ends_with("*/"));
        } else {
            assert!(lines[first].ends_with('{'), "{}", lines[first]);
            assert!(
                lines[last + 1].trim_start().starts_with('}'),
                "{}",
                lines[last + 1]
            );
        }
    }
    let of_several_lines = lines.iter().filter(|line| line.ends_with('{')).count();
    assert_eq!(folds.len(), of_several_lines + 1);
}

/// Every token, put back at its place, is what its class says.
#[test]
fn colours_are_those_of_the_words() {
    let mut editor = rib();
    let legend = vec![
        "comment",
        "string",
        "number",
        "keyword",
        "operator",
        "variable",
        "class",
        "property",
        "enumMember",
        "function",
        "parameter",
        "unit",
    ];
    let tokens = editor
        .ask(
            "textDocument/semanticTokens/full",
            json!({ "textDocument": { "uri": uri(PATH) } }),
        )
        .unwrap();
    let numbers: Vec<u64> = tokens["data"]
        .as_array()
        .unwrap()
        .iter()
        .map(|n| n.as_u64().unwrap())
        .collect();
    let (mut line, mut character) = (0, 0);
    let mut found = Vec::new();
    for token in numbers.chunks(5) {
        character = if token[0] == 0 {
            character + token[1]
        } else {
            token[1]
        };
        line += token[0];
        let text = editor.text(PATH);
        let start = offset(text, &json!({ "line": line, "character": character }));
        let end = offset(text, &json!({ "line": line, "character": character + token[2] }));
        found.push((
            text[start..end].to_owned(),
            legend[usize::try_from(token[3]).unwrap()],
        ));
    }
    for (word, class) in [
        ("// Eine Rippe für den Flügel 🔪 𝒳", "comment"),
        ("job", "keyword"),
        ("\"rib\"", "string"),
        ("60", "number"),
        ("mm", "unit"),
        ("m/min", "unit"),
        ("// 𝒳 half of it", "comment"),
        ("half", "variable"),
        ("line", "keyword"),
        ("to", "keyword"),
        ("rough", "keyword"),
        ("vcut", "keyword"),
        ("rake", "property"),
        ("auto", "keyword"),
        ("discard", "enumMember"),
        ("<=", "operator"),
        ("/", "operator"),
        ("dagger", "variable"),
    ] {
        assert!(
            found.contains(&(word.to_owned(), class)),
            "{word} {class}: {found:?}"
        );
    }
}

#[test]
fn calculations_have_hints() {
    let mut editor = rib();
    let whole = json!({ "start": { "line": 0, "character": 0 }, "end": { "line": 99, "character": 0 } });
    let params = json!({ "textDocument": { "uri": uri(PATH) }, "range": whole });
    let hints = editor.ask("textDocument/inlayHint", params).unwrap();
    let shown: Vec<String> = hints
        .as_array()
        .unwrap()
        .iter()
        .map(|hint| {
            format!(
                "{}:{} {}",
                hint["position"]["line"],
                hint["position"]["character"],
                hint["label"].as_str().unwrap()
            )
        })
        .collect();
    assert_eq!(
        shown,
        [
            "4:21 = 30 mm",
            "5:21 = 60 mm",
            "6:43 = 30 mm",
            "6:66 = 60 mm",
            "18:19 = 200 mm/s"
        ]
    );
}

#[test]
fn what_is_not_understood_is_refused() {
    let mut editor = rib();
    let error = editor.ask("textDocument/unheardOf", json!({})).unwrap_err();
    assert_eq!(error["code"], -32601);
    let error = editor
        .ask("textDocument/hover", json!({ "position": "there" }))
        .unwrap_err();
    assert_eq!(error["code"], -32602);
    let at = json!({ "textDocument": { "uri": "file:///nowhere.vcut" }, "position": { "line": 3, "character": 4 } });
    assert_eq!(editor.ask("textDocument/hover", at).unwrap(), Value::Null);
    editor.notify("textDocument/didChange", json!({ "nonsense": true }));
    let [message] = editor.log.as_slice() else {
        panic!("{:?}", editor.log);
    };
    assert!(
        message.starts_with("`textDocument/didChange` cannot be read: "),
        "{message}"
    );
    editor.notify("$/unheardOf", Value::Null);
    assert_eq!(editor.ask("shutdown", Value::Null).unwrap(), Value::Null);
    let at = editor.at(PATH, "wi|dth");
    assert_eq!(editor.ask("textDocument/hover", at).unwrap_err()["code"], -32600);
}

#[test]
fn what_a_workspace_defines_is_found_by_a_part_of_its_name() {
    let mut editor = rib();
    let found = |editor: &mut Editor, query: &str| -> Vec<String> {
        let found = editor.ask("workspace/symbol", json!({ "query": query })).unwrap();
        let found = found.as_array().unwrap().iter();
        found
            .map(|symbol| {
                let (name, at) = (symbol["name"].as_str().unwrap(), &symbol["location"]);
                assert!(at["range"]["start"]["line"].is_u64(), "{symbol}");
                format!("{name} in {}", at["uri"].as_str().unwrap())
            })
            .collect()
    };
    // A blade of a library that is not open, and a value of the open job, whatever the case of the letters.
    assert_eq!(found(&mut editor, "DAG"), ["dagger in file:///shop/blades.vcut"]);
    assert_eq!(found(&mut editor, "half"), ["half in file:///shop/rib.vcut"]);
    assert_eq!(found(&mut editor, "rib"), ["rib in file:///shop/rib.vcut"]);
    assert_eq!(found(&mut editor, "nothing of the kind"), [""; 0]);
}
