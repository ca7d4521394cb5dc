//! What client and server agree upon: units of positions, who asks for diagnostics, folders, and requests that are taken back.

use super::editor::RIB;
use super::process::Process;
use serde_json::{Value, json};

const NAME: &str = "rib.vcut";

/// A place is counted in what was agreed upon, in both directions.
#[test]
fn positions_are_counted_as_agreed() {
    let text = RIB.replace("swing <= 45 deg", "/* 𝒳🔪ä */ swing <= 45");
    let before = "  limits { /* 𝒳🔪ä */ swing <= ";
    let line = text.lines().position(|line| line.starts_with(before)).unwrap();
    for (offered, agreed, column) in [
        (json!(["utf-8", "utf-16"]), "utf-8", before.len()),
        (
            json!(["utf-16", "utf-8"]),
            "utf-16",
            before.encode_utf16().count(),
        ),
        (json!(["utf-32"]), "utf-32", before.chars().count()),
        (json!(["utf-7"]), "utf-16", before.encode_utf16().count()),
        (Value::Null, "utf-16", before.encode_utf16().count()),
    ] {
        let mut process = Process::start();
        let can = process.introduce(&json!({ "general": { "positionEncodings": offered } }));
        assert_eq!(can["positionEncoding"], agreed);
        process.show(NAME, &text);
        let diagnostics = process.diagnostics(NAME);
        assert_eq!(diagnostics[0]["code"], "VC0203");
        let start = json!({ "line": line, "character": column });
        assert_eq!(diagnostics[0]["range"]["start"], start, "{agreed}");
        let at = json!({ "textDocument": { "uri": process.uri(NAME) }, "position": start });
        let answer = process.ask(5, "textDocument/hover", &at);
        let text = answer["result"]["contents"]["value"].as_str().unwrap_or_default();
        assert!(text.contains("`45`"), "{agreed}: {answer}");
        process.end();
    }
}

/// A client that asks for diagnostics is not sent any of what is open, and is notified when planning has
/// found more.
#[test]
fn diagnostics_are_reported_on_request() {
    let asking = json!({
        "textDocument": { "diagnostic": {} },
        "workspace": { "diagnostics": { "refreshSupport": true } },
    });
    let mut process = Process::start();
    let can = process.introduce(&asking);
    assert_eq!(can["diagnosticProvider"]["interFileDependencies"], true);
    // Too deep for the blade: only the proof knows.
    let deep = RIB
        .replace("layer = 5 mm", "layer = 8 mm")
        .replace("swing = auto", "swing = 45 deg")
        .replace("step  = auto", "step  = 16 mm");
    process.show(NAME, &deep);
    let document = json!({ "textDocument": { "uri": process.uri(NAME) } });
    let first = process.ask(10, "textDocument/diagnostic", &document);
    assert_eq!(first["result"], json!({ "kind": "full", "items": [] }));
    let again = process.next();
    assert_eq!(again["method"], "workspace/diagnostic/refresh", "{again}");
    process.send(&json!({ "jsonrpc": "2.0", "id": again["id"], "result": null }));
    let second = process.ask(11, "textDocument/diagnostic", &document);
    assert_eq!(second["result"]["items"][0]["code"], "VC0401", "{second}");
    process.end();
}

/// Clients that cannot be asked to ask again are sent everything.
#[test]
fn diagnostics_are_sent_to_all_others() {
    let mut process = Process::start();
    let can = process.introduce(&json!({ "textDocument": { "diagnostic": {} } }));
    assert_eq!(can["diagnosticProvider"], Value::Null);
    process.show(NAME, "job \"a\"\n}\n");
    assert!(!process.diagnostics(NAME).is_empty());
    process.end();
}

#[test]
fn a_request_that_is_taken_back_is_answered_so() {
    let mut process = Process::start();
    process.introduce(&json!({}));
    process.show(NAME, RIB);
    // In one piece, so that all of it waits when the first is looked at.
    let mut all = Vec::new();
    let uri = process.uri(NAME);
    let mut add = |message: &Value| vcutc::lsp::wire::write(&mut all, message).unwrap();
    for id in 50..90 {
        let params = json!({ "textDocument": { "uri": uri } });
        add(
            &json!({ "jsonrpc": "2.0", "id": id, "method": "textDocument/semanticTokens/full", "params": params }),
        );
    }
    add(&json!({ "jsonrpc": "2.0", "method": "$/cancelRequest", "params": { "id": 89 } }));
    std::io::Write::write_all(&mut process.input, &all).unwrap();
    let mut answered = 0;
    loop {
        let answer = process.wait_for("");
        answered += 1;
        if answer["id"] == json!(89) {
            assert_eq!(answer["error"]["code"], -32800, "{answer}");
            break;
        }
    }
    assert_eq!(answered, 40, "every request has an answer");
    process.end();
}

/// Names are looked for in the folders of the workspace as they are now.
#[test]
fn folders_come_and_go() {
    let mut process = Process::start();
    let can = process.introduce(&json!({}));
    assert_eq!(can["workspace"]["workspaceFolders"]["changeNotifications"], true);
    process.write("other.vcut", &RIB.replace("\"rib\"", "\"other\""));
    process.show(NAME, RIB);
    let at = RIB.find("slow").unwrap();
    let files = |process: &mut Process, id: i64| {
        let params = json!({
            "textDocument": { "uri": process.uri(NAME) },
            "position": super::editor::position(RIB, at),
            "context": { "includeDeclaration": true },
        });
        let places = process.ask(id, "textDocument/references", &params);
        let mut files: Vec<String> = places["result"]
            .as_array()
            .unwrap()
            .iter()
            .map(|place| {
                place["uri"]
                    .as_str()
                    .unwrap()
                    .rsplit('/')
                    .next()
                    .unwrap()
                    .to_owned()
            })
            .collect();
        files.dedup();
        files
    };
    assert_eq!(files(&mut process, 20), ["blades.vcut", "other.vcut", "rib.vcut"]);
    let folder = json!([{ "uri": process.uri(""), "name": "shop" }]);
    let gone = json!({ "event": { "added": [], "removed": folder } });
    process.notify("workspace/didChangeWorkspaceFolders", &gone);
    assert_eq!(files(&mut process, 21), ["blades.vcut", "rib.vcut"]);
    let back = json!({ "event": { "added": folder, "removed": [] } });
    process.notify("workspace/didChangeWorkspaceFolders", &back);
    assert_eq!(files(&mut process, 22), ["blades.vcut", "other.vcut", "rib.vcut"]);
    process.end();
}
