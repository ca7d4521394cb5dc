//! Documents that are not jobs of their own, and names over several files.

use super::editor::{BLADES, Editor, RIB, uri};
use serde_json::{Value, json};

const RIB_AT: &str = "/shop/rib.vcut";
const BLADES_AT: &str = "/shop/blades.vcut";

fn shop() -> Editor {
    let other = RIB.replace("\"rib\"", "\"other\"").replace("60 mm", "70 mm");
    let aside = "job \"aside\"\nlet dagger_count = 3\n";
    let files = [
        ("rib.vcut", RIB),
        ("blades.vcut", BLADES),
        ("jobs/other.vcut", &other.replace("\"blades", "\"../blades")),
        ("aside.vcut", aside),
    ];
    Editor::with(&files)
}

#[test]
fn a_library_lacks_nothing() {
    let mut editor = Editor::with(&[("blades.vcut", BLADES)]);
    editor.open(BLADES_AT);
    assert_eq!(editor.codes(BLADES_AT), [""; 0]);
    editor.replace(BLADES_AT, "7.13 deg", "7.13 mm");
    assert_eq!(editor.codes(BLADES_AT), ["VC0203"]);
}

/// Names of a shop's files may be defined in one another; a job of the workspace says which belong together.
#[test]
fn a_library_is_looked_at_from_a_job_that_uses_it() {
    let mut editor = Editor::with(&[
        (
            "rib.vcut",
            &RIB.replace("use \"blades.vcut\"", "use \"blades.vcut\"\nuse \"speeds.vcut\""),
        ),
        (
            "blades.vcut",
            &BLADES.replace("let slow = 200 mm/s", "let slow = base_speed / 2"),
        ),
        ("speeds.vcut", "let base_speed = 24 m/min\n"),
    ]);
    editor.open(BLADES_AT);
    assert_eq!(editor.codes(BLADES_AT), [""; 0]);
    assert_eq!(
        editor.diagnostics(RIB_AT),
        [json!(null); 0],
        "nobody asked about the job"
    );
    let at = editor.at(BLADES_AT, "let sl|ow");
    let answer = editor.ask("textDocument/hover", at).unwrap();
    assert!(
        answer["contents"]["value"]
            .as_str()
            .unwrap()
            .contains("`200 mm/s`"),
        "{answer}"
    );
}

#[test]
fn an_open_document_counts_before_its_file() {
    let mut editor = shop();
    editor.open(RIB_AT);
    editor.open(BLADES_AT);
    assert_eq!(editor.codes(RIB_AT), [""; 0]);
    editor.replace(BLADES_AT, "blade dagger", "blade scalpel");
    assert_eq!(editor.codes(RIB_AT), ["VC0201"]);
    editor.close(BLADES_AT);
    assert_eq!(editor.codes(RIB_AT), [""; 0], "the file on the disk has it still");
    editor.open_as(BLADES_AT, "blade dagger {}\n");
    assert_eq!(editor.codes(BLADES_AT), ["VC0206"; 4]);
    editor.close(RIB_AT);
    assert_eq!(editor.codes(RIB_AT), [""; 0], "what is closed has no diagnostics");
}

#[test]
fn renaming_reaches_every_file_that_sees_the_name() {
    let mut editor = shop();
    editor.open(RIB_AT);
    let at = editor.at(RIB_AT, "blade = da|gger");
    let range = editor.ask("textDocument/prepareRename", at.clone()).unwrap();
    assert_eq!(range["placeholder"], "dagger");
    let mut params = at;
    params["newName"] = json!("long_dagger");
    let edit = editor.ask("textDocument/rename", params).unwrap();
    let files: Vec<&String> = edit["changes"].as_object().unwrap().keys().collect();
    assert_eq!(
        files,
        [&uri(BLADES_AT), &uri("/shop/jobs/other.vcut"), &uri(RIB_AT)]
    );
    editor.make(&edit);
    assert_eq!(editor.codes(RIB_AT), [""; 0]);
    assert!(editor.files.0[BLADES_AT].starts_with("blade long_dagger {"));
    assert!(editor.files.0["/shop/jobs/other.vcut"].contains("blade = long_dagger"));
    assert!(editor.files.0["/shop/aside.vcut"].contains("dagger_count"));
}

#[test]
fn references_are_found_in_files_that_are_not_open() {
    let mut editor = shop();
    editor.open(BLADES_AT);
    let mut at = editor.at(BLADES_AT, "let sl|ow");
    at["context"] = json!({ "includeDeclaration": false });
    let places = editor.ask("textDocument/references", at).unwrap();
    let files: Vec<&str> = places
        .as_array()
        .unwrap()
        .iter()
        .map(|place| place["uri"].as_str().unwrap())
        .collect();
    assert_eq!(files, [uri("/shop/jobs/other.vcut"), uri(RIB_AT)]);
}

#[test]
fn names_that_would_mean_something_else_are_refused() {
    let mut editor = shop();
    editor.open(RIB_AT);
    for (new, why) in [
        ("auto", "is reserved by the language"),
        ("let", "is reserved by the language"),
        ("radius", "is reserved by the language"),
        ("3x", "is not a name"),
        ("a-b", "is not a name"),
        ("slow", "is a value already, in /shop/blades.vcut"),
        ("dagger", "is a blade already"),
    ] {
        let mut params = editor.at(RIB_AT, "let wi|dth");
        params["newName"] = json!(new);
        let error = editor.ask("textDocument/rename", params).unwrap_err();
        assert_eq!(error["code"], -32803);
        assert!(error["message"].as_str().unwrap().contains(why), "{new}: {error}");
    }
    // The variable of a formula would catch the name.
    editor.replace(
        RIB_AT,
        "start (0 mm, 12 mm) line to (half, 16 mm) line to (width, 12 mm)",
        "z(x) = 12 mm + x * 0 + half * 0",
    );
    assert_eq!(editor.codes(RIB_AT), [""; 0]);
    let mut params = editor.at(RIB_AT, "let ha|lf");
    params["newName"] = json!("x");
    let error = editor.ask("textDocument/rename", params).unwrap_err();
    assert!(
        error["message"].as_str().unwrap().contains("another meaning"),
        "{error}"
    );
    for piece in ["ro|ugh vcut", "la|yer = 5", "dis|card", "1|2 m/min", "au|to"] {
        let at = editor.at(RIB_AT, piece);
        assert!(editor.ask("textDocument/prepareRename", at).is_err(), "{piece}");
    }
}

/// A word that a field takes is not a name, even where a name is spelt alike.
#[test]
fn words_of_fields_are_not_renamed() {
    let mut editor = shop();
    editor.open_as(
        RIB_AT,
        &RIB.replace("let width = 60 mm", "let point = 1\nlet width = 60 mm * point"),
    );
    assert_eq!(editor.codes(RIB_AT), [""; 0]);
    let mut params = editor.at(RIB_AT, "let po|int");
    params["newName"] = json!("share");
    let edit = editor.ask("textDocument/rename", params).unwrap();
    assert_eq!(edit["changes"][&uri(RIB_AT)].as_array().map(Vec::len), Some(2));
    editor.make(&edit);
    assert!(editor.text(RIB_AT).contains("order = point"));
    assert_eq!(editor.diagnostics(RIB_AT), [Value::Null; 0]);
}

/// The tool of a blade bears its name, and its fields are offered and known.
#[test]
fn a_blade_is_renamed_in_the_tools_that_hold_it() {
    let mut editor = shop();
    let cell = "\nmachine cell = robot \"kuka/kr210_r3100_ultra\" {\n  tool dagger {\n    frame = frame(x = 0 mm, y = 0 mm, \
                z = 310 mm, a = 0 deg, b = 0 deg, c = 0 deg)\n  }\n  base = frame(x = 1700 mm, y = -600 mm, z = 650 mm, \
                a = 90 deg, b = 0 deg, c = 0 deg)\n}\n";
    editor.open_as(RIB_AT, &format!("{RIB}{cell}"));
    let mut params = editor.at(RIB_AT, "blade = da|gger");
    params["newName"] = json!("scalpel");
    let edit = editor.ask("textDocument/rename", params).unwrap();
    editor.make(&edit);
    assert!(editor.text(RIB_AT).contains("tool scalpel {"));
    assert_eq!(editor.codes(RIB_AT), [""; 0]);
}
