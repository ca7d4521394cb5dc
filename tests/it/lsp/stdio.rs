//! The server as a process, over its standard input and output.

use super::editor::{BLADES, RIB};
use serde_json::{Value, json};
use std::io::{BufReader, Read, Write};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use vcutc::lsp::wire::{self, Incoming};

struct Process {
    child: Child,
    input: ChildStdin,
    output: BufReader<ChildStdout>,
    folder: tempfile::TempDir,
}

impl Process {
    fn start() -> Self {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("blades.vcut"), BLADES).unwrap();
        let mut child = Command::new(env!("CARGO_BIN_EXE_vcutc"))
            .args(["lsp", "--stdio"])
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        Self {
            input: child.stdin.take().unwrap(),
            output: BufReader::new(child.stdout.take().unwrap()),
            child,
            folder,
        }
    }

    fn send(&mut self, message: &Value) {
        wire::write(&mut self.input, message).unwrap();
    }

    fn notify(&mut self, method: &str, params: &Value) {
        self.send(&wire::notification(method, params));
    }

    /// The next message, which is an answer or a notification.
    fn next(&mut self) -> Value {
        let mut header = String::new();
        while !header.ends_with("\r\n\r\n") {
            let mut byte = [0];
            self.output.read_exact(&mut byte).unwrap();
            header.push(char::from(byte[0]));
        }
        let length = header
            .strip_prefix("Content-Length: ")
            .unwrap()
            .trim()
            .parse()
            .unwrap();
        let mut body = vec![0; length];
        self.output.read_exact(&mut body).unwrap();
        serde_json::from_slice(&body).unwrap()
    }

    /// The next message of that method, or the next answer for the empty one.
    fn wait_for(&mut self, method: &str) -> Value {
        loop {
            let message = self.next();
            if message["method"].as_str().unwrap_or_default() == method {
                return message;
            }
        }
    }

    fn ask(&mut self, id: i64, method: &str, params: &Value) -> Value {
        self.send(&json!({ "jsonrpc": "2.0", "id": id, "method": method, "params": params }));
        loop {
            let answer = self.wait_for("");
            if answer["id"] == json!(id) {
                return answer;
            }
        }
    }

    fn uri(&self, name: &str) -> String {
        format!("file://{}/{name}", self.folder.path().to_str().unwrap())
    }

    /// The codes of the next diagnostics for a version of the job.
    fn codes_of(&mut self, version: i64) -> Vec<String> {
        loop {
            let told = self.wait_for("textDocument/publishDiagnostics");
            if told["params"]["version"] == json!(version) {
                let diagnostics = told["params"]["diagnostics"].as_array().unwrap();
                return diagnostics
                    .iter()
                    .map(|found| found["code"].as_str().unwrap().to_owned())
                    .collect();
            }
        }
    }
}

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

    // Behind an umlaut, a knife and a letter of two units.
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

    // What is no message is answered, and the conversation goes on.
    write!(process.input, "Content-Length: 9\r\n\r\n{{nonsense").unwrap();
    assert_eq!(process.wait_for("")["error"]["code"], -32700);
    process.send(&json!([1, 2, 3]));
    assert_eq!(process.wait_for("")["error"]["code"], -32600);
    assert_eq!(process.ask(3, "no/such", &json!({}))["error"]["code"], -32601);

    // Many edits without waiting: the last version is told of.
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
fn an_end_without_a_word_is_told_by_the_exit_status() {
    let mut process = Process::start();
    process.notify("exit", &Value::Null);
    assert_eq!(process.child.wait().unwrap().code(), Some(1));

    let mut process = Process::start();
    process.input.write_all(b"GET / HTTP/1.1\r\n\r\n").unwrap();
    assert_eq!(process.child.wait().unwrap().code(), Some(1));

    let Process { mut child, input, .. } = Process::start();
    drop(input);
    assert_eq!(child.wait().unwrap().code(), Some(1));
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
