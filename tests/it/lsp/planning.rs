//! What is known of a job only when it has been planned, and only as long as its text stays.

use super::editor::{BLADES, Editor, RIB, uri};
use crate::repository::read;
use serde_json::{Value, json};
use vcutc::diagnostics::source::{LoadError, Loader};
use vcutc::driver::Unhurried;
use vcutc::driver::memory::Memory;
use vcutc::lsp::Task;
use vcutc::registry;

const PATH: &str = "/shop/rib.vcut";

fn plan(editor: &mut Editor) {
    let task = editor.server.task().expect("a job to plan");
    let done = task.run(&editor.files, &registry::backends(), &mut Memory::none());
    let messages = editor.server.finish(done);
    editor.take(&messages);
}

fn hints(editor: &mut Editor) -> Vec<String> {
    let whole = json!({ "start": { "line": 9, "character": 0 }, "end": { "line": 13, "character": 0 } });
    let params = json!({ "textDocument": { "uri": uri(PATH) }, "range": whole });
    let hints = editor.ask("textDocument/inlayHint", params).unwrap();
    let hints = hints.as_array().unwrap().iter();
    hints
        .map(|hint| hint["label"].as_str().unwrap().to_owned())
        .collect()
}

#[test]
fn auto_shows_what_it_became() {
    let mut editor = Editor::with(&[("rib.vcut", RIB), ("blades.vcut", BLADES)]);
    editor.open(PATH);
    assert_eq!(hints(&mut editor), [""; 0]);
    plan(&mut editor);
    assert!(editor.server.task().is_none(), "it is planned once");
    // The widest swing within the limit, and by [Cui 6, 7] the step that lets Vs just meet: 2 * 5 mm * tan(45 deg).
    assert_eq!(hints(&mut editor), ["= 45 deg", "= 10 mm"]);
    let at = editor.at(PATH, "step  = au|to");
    let answer = editor.ask("textDocument/hover", at).unwrap();
    let text = answer["contents"]["value"].as_str().unwrap();
    assert!(text.starts_with("`auto` is `10 mm`\n\nbound by "), "{text}");
    let at = editor.at(PATH, "job \"r|ib\"");
    let answer = editor.ask("textDocument/hover", at).unwrap();
    assert!(
        answer["contents"]["value"].as_str().unwrap().contains("rib: "),
        "{answer}"
    );
}

#[test]
fn what_planning_finds_is_reported_and_taken_back() {
    let deep = RIB
        .replace("layer = 5 mm", "layer = 8 mm")
        .replace("swing = auto", "swing = 45 deg")
        .replace("step  = auto", "step  = 16 mm");
    let mut editor = Editor::with(&[("rib.vcut", &deep), ("blades.vcut", BLADES)]);
    editor.open(PATH);
    assert_eq!(editor.codes(PATH), [""; 0]);
    plan(&mut editor);
    assert_eq!(editor.codes(PATH), ["VC0401"]);
    editor.replace(PATH, "layer = 8 mm", "layer = 8.2 mm");
    assert_eq!(editor.codes(PATH), [""; 0], "nothing is known of this text yet");
    plan(&mut editor);
    assert_eq!(editor.codes(PATH), ["VC0401"]);
}

#[test]
fn a_refusal_is_reported_before_help_is_looked_for() {
    let deep = RIB
        .replace("layer = 5 mm", "layer = 8 mm")
        .replace("swing = auto", "swing = 45 deg")
        .replace("step  = auto", "step  = 16 mm");
    let mut editor = Editor::with(&[("rib.vcut", &deep), ("blades.vcut", BLADES)]);
    editor.open(PATH);
    let task = editor.server.task().unwrap();
    let mut early = Vec::new();
    let done = task.run_reporting(
        &editor.files,
        &registry::backends(),
        &mut Memory::none(),
        (&mut Unhurried, &mut |done| early.push(done)),
    );
    assert_eq!(early.len(), 1);
    let mut texts = Vec::new();
    for done in early.into_iter().chain([done]) {
        let messages = editor.server.finish(done);
        texts.push(serde_json::to_string(&messages).unwrap());
        editor.take(&messages);
        assert_eq!(editor.codes(PATH), ["VC0401"]);
        assert!(editor.server.task().is_none(), "it is planned once");
    }
    assert!(texts.iter().all(|text| text.contains("VC0401")), "{texts:#?}");
    assert_ne!(texts[0], texts[1], "help comes with the second message");
}

/// An example that its machine makes slow: what would help comes after the plan, says where it is to be written, and goes with the text.
#[test]
fn what_would_help_comes_after_the_plan() {
    let names = [
        "rib_dxf.vcut",
        "shop/blades.vcut",
        "shop/cells.vcut",
        "shop/speeds.vcut",
        "shop/gantry.toml",
        "shop/knife_gantry.toml",
        "drawings/rib.dxf",
    ];
    let texts = names.map(|name| (name, read(&format!("examples/{name}"))));
    let files: Vec<(&str, &str)> = texts.iter().map(|(name, text)| (*name, text.as_str())).collect();
    let mut editor = Editor::with(&files);
    let job = "/shop/rib_dxf.vcut";
    editor.open(job);
    let task = editor.server.task().unwrap();
    let mut early = Vec::new();
    let done = task.run_reporting(
        &editor.files,
        &registry::backends(),
        &mut Memory::none(),
        (&mut Unhurried, &mut |done| early.push(done)),
    );
    assert_eq!(early.len(), 1, "the plan is reported before hints are looked for");
    let at_once = editor.server.finish(early.remove(0));
    assert!(!serde_json::to_string(&at_once).unwrap().contains("saves"));
    let at = editor.at(job, "job \"rib|_dxf\"");
    let hover = editor.ask("textDocument/hover", at.clone()).unwrap();
    assert!(
        hover["contents"]["value"].as_str().unwrap().contains("14 cuts"),
        "the figures are there: {hover}"
    );

    let messages = editor.server.finish(done);
    editor.take(&messages);
    let (uri, hint) = shown_hint(&editor).expect("a hint");
    assert_eq!(hint["severity"], 3, "information: {hint}");
    let params = json!({
        "textDocument": { "uri": uri },
        "range": hint["range"],
        "context": { "diagnostics": [] },
    });
    let actions = editor.ask("textDocument/codeAction", params).unwrap();
    let action = &actions[0];
    assert!(action["title"].as_str().unwrap().contains("saves"), "{actions}");
    assert_eq!(action["diagnostics"][0], hint);
    let edit = &action["edit"]["changes"][uri.as_str()][0];
    assert_eq!(edit["range"], hint["range"]);
    assert!(edit["newText"].as_str().unwrap().starts_with("frame("), "{edit}");

    editor.replace(job, "limits    { swing", "limits  { swing");
    assert_eq!(shown_hint(&editor), None, "of another text nothing is known");
}

/// The first hint that is shown, and the file that it is about.
fn shown_hint(editor: &Editor) -> Option<(String, Value)> {
    editor.published.iter().find_map(|(uri, params)| {
        let mut all = params["diagnostics"].as_array()?.iter();
        let hint = all.find(|one| {
            one["message"]
                .as_str()
                .is_some_and(|text| text.contains("which saves"))
        })?;
        Some((uri.clone(), hint.clone()))
    })
}

/// An answer for a text that has changed meanwhile is dropped.
#[test]
fn stale_plans_are_not_shown() {
    let mut editor = Editor::with(&[("rib.vcut", RIB), ("blades.vcut", BLADES)]);
    editor.open(PATH);
    let task = editor.server.task().unwrap();
    editor.replace(PATH, "swing <= 45 deg", "swing <= 30 deg");
    let done = task.run(&editor.files, &registry::backends(), &mut Memory::none());
    assert_eq!(editor.server.finish(done), [Value::Null; 0]);
    assert_eq!(hints(&mut editor), [""; 0]);
    plan(&mut editor);
    let narrow = RIB.replace("swing <= 45 deg", "swing <= 30 deg");
    let mut fresh = Editor::with(&[("rib.vcut", &narrow), ("blades.vcut", BLADES)]);
    fresh.open(PATH);
    plan(&mut fresh);
    assert_eq!(hints(&mut editor), hints(&mut fresh));
    assert_eq!(hints(&mut editor).len(), 2);
}

#[test]
fn planning_can_be_left_to_the_command_line() {
    let mut editor = Editor::with(&[("rib.vcut", RIB), ("blades.vcut", BLADES)]);
    editor.server = vcutc::lsp::Server::new(registry::OPERATIONS, &registry::backends());
    let params =
        json!({ "processId": null, "capabilities": {}, "initializationOptions": { "planning": "never" } });
    editor.ask("initialize", params).unwrap();
    editor.open(PATH);
    assert!(editor.server.task().is_none());
}

/// Files that count how often they are read.
struct Counted<'f> {
    files: &'f super::editor::Memory,
    reads: core::cell::Cell<usize>,
}

impl Loader for Counted<'_> {
    fn load(&self, path: &str) -> Result<Vec<u8>, LoadError> {
        self.reads.set(self.reads.get() + 1);
        self.files.load(path)
    }
}

/// How often files are read when a task is run.
fn reads(editor: &mut Editor, task: Task) -> usize {
    let counted = Counted {
        files: &editor.files,
        reads: core::cell::Cell::new(0),
    };
    let done = task.run(&counted, &registry::backends(), &mut Memory::none());
    let reads = counted.reads.get();
    let messages = editor.server.finish(done);
    editor.take(&messages);
    reads
}

#[test]
fn a_text_that_has_changed_is_planned_no_further() {
    let mut editor = Editor::with(&[("rib.vcut", RIB), ("blades.vcut", BLADES)]);
    editor.open(PATH);
    let task = editor.server.task().unwrap();
    editor.replace(PATH, "swing <= 45 deg", "swing <= 30 deg");
    assert_eq!(reads(&mut editor, task), 0);
    let task = editor.server.task().expect("the new text is to be planned");
    assert_ne!(reads(&mut editor, task), 0);
    assert_eq!(hints(&mut editor).len(), 2);
}

/// Saving, and changes of files that say nothing new, do not restart the work.
#[test]
fn what_says_the_same_is_planned_on() {
    let mut editor = Editor::with(&[("rib.vcut", RIB), ("blades.vcut", BLADES)]);
    editor.open(PATH);
    let task = editor.server.task().unwrap();
    let saved = json!({ "textDocument": { "uri": uri(PATH) } });
    editor.notify("textDocument/didSave", saved.clone());
    editor.settle();
    assert!(editor.server.task().is_none(), "it is being planned");
    assert_ne!(reads(&mut editor, task), 0);
    assert_eq!(hints(&mut editor).len(), 2);
    editor.notify("textDocument/didSave", saved);
    editor.settle();
    assert_eq!(hints(&mut editor).len(), 2, "it stays planned");
    assert!(editor.server.task().is_none());

    let longer = BLADES.replace("20 mm", "21 mm");
    assert_ne!(longer, BLADES);
    editor.files.0.insert("/shop/blades.vcut".to_owned(), longer);
    editor.notify("workspace/didChangeWatchedFiles", json!({ "changes": [] }));
    editor.settle();
    assert!(editor.server.task().is_some());
}

#[test]
fn the_job_that_was_changed_last_is_planned_first() {
    let other = "/shop/other.vcut";
    let mut editor = Editor::with(&[("rib.vcut", RIB), ("other.vcut", RIB), ("blades.vcut", BLADES)]);
    editor.open(other);
    let first = editor.server.task().unwrap();
    editor.server.put_off();
    editor.open(PATH);
    editor.server.put_off();
    assert_eq!(reads(&mut editor, first), 0, "it was put off");
    for path in [PATH, other] {
        let task = editor.server.task().unwrap();
        assert_ne!(reads(&mut editor, task), 0);
        let at = editor.at(path, "step  = au|to");
        let answer = editor.ask("textDocument/hover", at).unwrap();
        let text = answer["contents"]["value"].as_str().unwrap();
        assert!(text.starts_with("`auto` is `"), "{path}: {text}");
    }
    assert!(editor.server.task().is_none());
}
