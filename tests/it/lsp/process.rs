//! The server as a process: what an editor writes to its standard input, and reads from its standard output.

use super::editor::{BLADES, position};
use serde_json::{Value, json};
use std::io::{BufReader, Read};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use vcutc::lsp::wire;

/// The server as a process in a folder of its own.
pub(super) struct Process {
    pub(super) child: Child,
    pub(super) input: ChildStdin,
    pub(super) output: BufReader<ChildStdout>,
    pub(super) folder: tempfile::TempDir,
    version: i64,
    id: i64,
}

impl Process {
    pub(super) fn start() -> Self {
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
            version: 0,
            id: 1000,
        }
    }

    pub(super) fn send(&mut self, message: &Value) {
        wire::write(&mut self.input, message).unwrap();
    }

    pub(super) fn notify(&mut self, method: &str, params: &Value) {
        self.send(&wire::notification(method, params));
    }

    /// The next message, which is an answer or a notification.
    pub(super) fn next(&mut self) -> Value {
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
    pub(super) fn wait_for(&mut self, method: &str) -> Value {
        loop {
            let message = self.next();
            if message["method"].as_str().unwrap_or_default() == method {
                return message;
            }
        }
    }

    pub(super) fn ask(&mut self, id: i64, method: &str, params: &Value) -> Value {
        self.send(&json!({ "jsonrpc": "2.0", "id": id, "method": method, "params": params }));
        loop {
            let answer = self.wait_for("");
            if answer["id"] == json!(id) {
                return answer;
            }
        }
    }

    pub(super) fn uri(&self, name: &str) -> String {
        format!("file://{}/{name}", self.folder.path().to_str().unwrap())
    }

    /// The codes of the next diagnostics for a version of the job.
    pub(super) fn codes_of(&mut self, version: i64) -> Vec<String> {
        loop {
            let message = self.wait_for("textDocument/publishDiagnostics");
            if message["params"]["version"] == json!(version) {
                let diagnostics = message["params"]["diagnostics"].as_array().unwrap();
                return diagnostics
                    .iter()
                    .map(|found| found["code"].as_str().unwrap().to_owned())
                    .collect();
            }
        }
    }

    /// Introduces itself as a client that can do this, and gives what the server can do.
    pub(super) fn introduce(&mut self, capabilities: &Value) -> Value {
        let folder = json!([{ "uri": self.uri(""), "name": "shop" }]);
        let introduction =
            json!({ "processId": null, "capabilities": capabilities, "workspaceFolders": folder });
        let answer = self.ask(1, "initialize", &introduction);
        self.notify("initialized", &json!({}));
        answer["result"]["capabilities"].clone()
    }

    /// Writes a file into the folder.
    pub(super) fn write(&self, name: &str, text: &str) {
        std::fs::write(self.folder.path().join(name), text).unwrap();
    }

    /// Opens a document, or replaces the whole text of one that is open.
    pub(super) fn show(&mut self, name: &str, text: &str) {
        self.version += 1;
        let uri = self.uri(name);
        if self.version == 1 {
            let document = json!({ "uri": uri, "languageId": "vcut", "version": 1, "text": text });
            self.notify("textDocument/didOpen", &json!({ "textDocument": document }));
        } else {
            let document = json!({ "uri": uri, "version": self.version });
            let change = json!({ "textDocument": document, "contentChanges": [{ "text": text }] });
            self.notify("textDocument/didChange", &change);
        }
    }

    /// The result of a request about a byte of a document with that text.
    pub(super) fn about(&mut self, method: &str, name: &str, text: &str, at: usize) -> Value {
        self.id += 1;
        let params = json!({
            "textDocument": { "uri": self.uri(name) },
            "position": position(text, at),
            "context": { "triggerKind": 1 },
        });
        let answer = self.ask(self.id, &format!("textDocument/{method}"), &params);
        assert!(answer.get("error").is_none(), "{answer}");
        answer["result"].clone()
    }

    /// The diagnostics that are reported next of a document, of its latest version.
    pub(super) fn diagnostics(&mut self, name: &str) -> Vec<Value> {
        let uri = self.uri(name);
        loop {
            let message = self.wait_for("textDocument/publishDiagnostics");
            if message["params"]["uri"] == json!(uri) && message["params"]["version"] == json!(self.version) {
                return message["params"]["diagnostics"].as_array().unwrap().clone();
            }
        }
    }

    /// Ends it, as agreed.
    pub(super) fn end(mut self) {
        assert_eq!(self.ask(2, "shutdown", &Value::Null)["result"], Value::Null);
        self.notify("exit", &Value::Null);
        assert_eq!(self.child.wait().unwrap().code(), Some(0));
    }
}
