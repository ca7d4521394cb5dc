//! The server as a process, over its standard input and output.

use super::editor::RIB;
use super::process::Process;
use serde_json::{Value, json};
use std::io::{Read, Write};
use vcutc::lsp::wire::{self, Incoming};

#[test]
fn a_whole_conversation() {
    let mut process = Process::start();
    let early = process.ask(1, "textDocument/hover", &json!({}));
    assert_eq!(early["error"]["code"], -32002);
    let folder = process.uri("");
    let introduction = json!({ "processId": null, "capabilities": {}, "rootUri": folder });
    let answer = process.ask(2, "initialize", &introduction);
    assert_eq!(answer["result"]["serverInfo"]["name"], "vcutc");
    assert_eq!(answer["result"]["capabilities"]["positionEncoding"], "utf-16");
    process.notify("initialized", &json!({}));

    let uri = process.uri("rib.vcut");
    let document = json!({ "uri": uri, "languageId": "vcut", "version": 1, "text": RIB });
    process.notify("textDocument/didOpen", &json!({ "textDocument": document }));
    assert_eq!(process.codes_of(1), [""; 0]);

    // After an umlaut, a knife and a letter of two units.
    let first = "// Eine Rippe für den Flügel 🔪 𝒳".encode_utf16().count();
    let change = |version: i64, line: usize, from: usize, to: usize, text: &str| {
        let range =
            json!({ "start": { "line": line, "character": from }, "end": { "line": line, "character": to } });
        json!({ "textDocument": { "uri": uri, "version": version }, "contentChanges": [{ "range": range, "text": text }] })
    };
    process.notify("textDocument/didChange", &change(2, 0, first, first, "\n}"));
    assert_eq!(process.codes_of(2), ["VC0103"]);
    process.notify("textDocument/didChange", &change(3, 1, 0, 1, ""));
    assert_eq!(process.codes_of(3), [""; 0]);

    // What is not a message is answered, and the conversation goes on.
    write!(process.input, "Content-Length: 9\r\n\r\n{{nonsense").unwrap();
    assert_eq!(process.wait_for("")["error"]["code"], -32700);
    process.send(&json!([1, 2, 3]));
    assert_eq!(process.wait_for("")["error"]["code"], -32600);
    assert_eq!(process.ask(3, "no/such", &json!({}))["error"]["code"], -32601);

    // Many edits without waiting: the last version is reported.
    for version in 4..304 {
        let text = if version % 2 == 0 { "1" } else { "" };
        let to = usize::from(version % 2 == 1);
        process.notify("textDocument/didChange", &change(version, 5, 23, 23 + to, text));
    }
    assert_eq!(process.codes_of(303), [""; 0]);

    // The thread that plans answers in its time.
    let everything = json!({ "start": { "line": 0, "character": 0 }, "end": { "line": 99, "character": 0 } });
    let mut hints = Vec::new();
    for id in 100..700 {
        let params = json!({ "textDocument": { "uri": uri }, "range": everything });
        let answer = process.ask(id, "textDocument/inlayHint", &params);
        hints = answer["result"].as_array().unwrap().clone();
        if hints.iter().any(|hint| hint["label"] == "= 45 deg") {
            break;
        }
        std::thread::sleep(std::time::Duration::from_millis(300));
    }
    assert!(hints.iter().any(|hint| hint["label"] == "= 45 deg"), "{hints:?}");

    assert_eq!(process.ask(5, "shutdown", &Value::Null)["result"], Value::Null);
    process.notify("exit", &Value::Null);
    assert_eq!(process.child.wait().unwrap().code(), Some(0));
}

#[test]
fn an_end_without_a_message_shows_in_the_exit_status() {
    let mut process = Process::start();
    process.notify("exit", &Value::Null);
    assert_eq!(process.child.wait().unwrap().code(), Some(1));

    let mut process = Process::start();
    process.input.write_all(b"GET / HTTP/1.1\r\n\r\n").unwrap();
    assert_eq!(process.child.wait().unwrap().code(), Some(1));
    let log = said(&mut process);
    assert!(
        log.contains("the conversation cannot continue: headers without a length"),
        "{log}"
    );

    let Process { mut child, input, .. } = Process::start();
    drop(input);
    assert_eq!(child.wait().unwrap().code(), Some(1));
}

/// What a server that has ended wrote to its log.
fn said(process: &mut Process) -> String {
    let mut said = String::new();
    let mut stderr = process.child.stderr.take().unwrap();
    stderr.read_to_string(&mut said).unwrap();
    said
}

#[test]
fn what_is_not_a_message_is_reported_in_the_log() {
    let mut process = Process::start();
    process.introduce(&json!({}));
    write!(process.input, "Content-Length: 9\r\n\r\n{{nonsense").unwrap();
    assert_eq!(process.wait_for("")["error"]["code"], -32700);
    process.notify("textDocument/didOpen", &json!({ "textDocument": 7 }));
    let message = process.wait_for("window/logMessage");
    let text = message["params"]["message"].as_str().unwrap();
    assert!(
        text.starts_with("`textDocument/didOpen` cannot be read: "),
        "{text}"
    );
    process.notify("exit", &Value::Null);
    process.child.wait().unwrap();
    let log = said(&mut process);
    assert!(
        log.contains("a message of the editor cannot be read: key must be"),
        "{log}"
    );
}

/// Some clients do not escape what RFC 3986 wants escaped. They get their own letters back.
#[test]
fn uris_are_taken_as_the_client_spells_them() {
    let mut process = Process::start();
    std::fs::create_dir(process.folder.path().join("Flügel 2 [neu]")).unwrap();
    process.introduce(&json!({}));
    process.write("Flügel 2 [neu]/blades.vcut", super::editor::BLADES);
    process.write("Flügel 2 [neu]/rib.vcut", RIB);
    let wrong = RIB.replace("layer = 5 mm", "layer = 5 mn");
    process.show("Flügel 2 [neu]/rib.vcut", &wrong);
    let diagnostics = process.diagnostics("Flügel 2 [neu]/rib.vcut");
    assert_eq!(diagnostics.len(), 1, "{diagnostics:?}");
    process.show("Flügel 2 [neu]/rib.vcut", RIB);
    assert_eq!(process.diagnostics("Flügel 2 [neu]/rib.vcut"), [Value::Null; 0]);
    process.end();
}

/// A job of many fine cuts, which takes minutes to plan.
fn slow() -> String {
    let operation = "rough vcut {
  blade = dagger  lattice = auto  rake = 60 deg  swing = auto  layer = auto  step = auto
  limits { scallop <= 0.9 mm }
  feed { cut = 200 mm/s, travel = 200 mm/s, reorient = 90 deg/s }
  clearance = 10 mm
}
";
    format!(
        "job \"wave\"
stock {{ size = (400 mm, 60 mm, 90 mm) }}
profile {{ z(x) = 50 mm + 24 mm * sin(x / 60 mm * 180 deg) }}
blade dagger {{ cutting_length = 40 mm  half_apex = 7 deg  thickness = 1 mm  edges = double }}
{}",
        operation.repeat(10)
    )
}

#[test]
fn a_text_does_not_wait_for_the_plan_of_the_one_before() {
    let mut process = Process::start();
    process.introduce(&json!({}));
    process.show("rib.vcut", &slow());
    assert_eq!(process.diagnostics("rib.vcut"), [Value::Null; 0]);
    // Long enough for its planning to have begun, and far too short for it to end.
    std::thread::sleep(std::time::Duration::from_secs(2));
    process.show("rib.vcut", RIB);
    assert_eq!(process.diagnostics("rib.vcut"), [Value::Null; 0]);
    let at = RIB.find("step  = auto").unwrap() + "step  = a".len();
    let mut text = String::new();
    for _ in 0..400 {
        let answer = process.about("hover", "rib.vcut", RIB, at);
        text = answer["contents"]["value"]
            .as_str()
            .unwrap_or_default()
            .to_owned();
        if text.starts_with("`auto` is `10 mm`") {
            break;
        }
        std::thread::sleep(std::time::Duration::from_millis(100));
    }
    assert!(text.starts_with("`auto` is `10 mm`"), "{text}");
    process.end();
}

/// What the server writes is what its own reader reads.
#[test]
fn the_answer_is_framed() {
    let mut process = Process::start();
    process.send(&json!({ "jsonrpc": "2.0", "id": "a", "method": "initialize", "params": { "capabilities": {}, "processId": null } }));
    let read = wire::read(&mut process.output).unwrap();
    assert_eq!(read, Incoming::Response);
    process.child.kill().unwrap();
    process.child.wait().unwrap();
}
