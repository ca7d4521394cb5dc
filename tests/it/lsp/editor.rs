//! An editor without a screen: a server in this process, files in memory, and its own count of positions.

use serde_json::{Value, json};
use std::collections::BTreeMap;
use vcutc::diagnostics::source::{Entry, LoadError, Loader, entries_among};
use vcutc::job::sema::kind::Operations;
use vcutc::lsp::wire::Incoming;
use vcutc::lsp::{Server, Workspace};
use vcutc::registry;

/// Files by path.
#[derive(Default)]
pub(crate) struct Memory(pub(crate) BTreeMap<String, String>);

impl Loader for Memory {
    fn load(&self, path: &str) -> Result<Vec<u8>, LoadError> {
        let text = self.0.get(path).ok_or(LoadError::NotFound)?;
        Ok(text.clone().into_bytes())
    }

    fn list(&self, folder: &str) -> Vec<Entry> {
        entries_among(self.0.keys().map(String::as_str), folder)
    }
}

impl Workspace for Memory {
    fn job_files(&self, folders: &[String]) -> Vec<String> {
        let is_within = |path: &&String| folders.iter().any(|folder| path.starts_with(folder));
        let jobs = self.0.keys().filter(|path| path.ends_with(".vcut"));
        jobs.filter(is_within).cloned().collect()
    }
}

/// The editor.
pub(crate) struct Editor {
    pub(crate) server: Server,
    pub(crate) files: Memory,
    /// What was reported last of each document: version and diagnostics.
    pub(crate) published: BTreeMap<String, Value>,
    /// What was written to the log.
    pub(crate) log: Vec<String>,
    texts: BTreeMap<String, (i64, String)>,
    requests: i64,
}

/// The URI of a path of letters that need no escapes.
pub(crate) fn uri(path: &str) -> String {
    format!("file://{path}")
}

/// Line and UTF-16 units of a byte, counted from the front. A line ends with `\n`, `\r\n` or `\r`.
pub(crate) fn position(text: &str, offset: usize) -> Value {
    let (mut line, mut units) = (0, 0);
    for (at, c) in text.char_indices().take_while(|(at, _)| *at < offset) {
        let is_end = c == '\n' || c == '\r' && !text[at + 1..].starts_with('\n');
        (line, units) = if is_end {
            (line + 1, 0)
        } else {
            (line, units + c.len_utf16())
        };
    }
    json!({ "line": line, "character": units })
}

impl Editor {
    /// An editor that has introduced itself, with these files in the folder `/shop`.
    pub(crate) fn with(files: &[(&str, &str)]) -> Self {
        Self::knowing(registry::OPERATIONS, files)
    }

    /// As [`Self::with`], in a language with these operations.
    pub(crate) fn knowing(operations: Operations, files: &[(&str, &str)]) -> Self {
        let files = files
            .iter()
            .map(|(name, text)| (format!("/shop/{name}"), (*text).to_owned()))
            .collect();
        let mut editor = Self {
            server: Server::new(operations, &registry::backends()),
            files: Memory(files),
            published: BTreeMap::new(),
            log: Vec::new(),
            texts: BTreeMap::new(),
            requests: 0,
        };
        let completion = json!({ "completionItem": { "snippetSupport": true } });
        let params = json!({
            "processId": null,
            "capabilities": { "textDocument": { "completion": completion } },
            "workspaceFolders": [{ "uri": uri("/shop"), "name": "shop" }],
        });
        editor.ask("initialize", params).unwrap();
        editor.notify("initialized", json!({}));
        editor
    }

    /// Asks, and gives the result or the error.
    pub(crate) fn ask(&mut self, method: &str, params: Value) -> Result<Value, Value> {
        self.requests += 1;
        let message = Incoming::Request {
            id: json!(self.requests),
            method: method.to_owned(),
            params,
        };
        let mut messages = self.server.handle(message, &self.files);
        let answer = messages.pop().unwrap();
        self.take(&messages);
        assert_eq!(answer["id"], json!(self.requests));
        match answer.get("result") {
            Some(result) => Ok(result.clone()),
            None => Err(answer["error"].clone()),
        }
    }

    pub(crate) fn notify(&mut self, method: &str, params: Value) {
        let message = Incoming::Notification {
            method: method.to_owned(),
            params,
        };
        let messages = self.server.handle(message, &self.files);
        self.take(&messages);
    }

    /// Lets the server look at what has changed.
    pub(crate) fn settle(&mut self) {
        let messages = self.server.settle(&self.files);
        self.take(&messages);
    }

    pub(crate) fn take(&mut self, messages: &[Value]) {
        for message in messages {
            if message["method"] == "window/logMessage" {
                self.log
                    .push(message["params"]["message"].as_str().unwrap().to_owned());
                continue;
            }
            assert_eq!(message["method"], "textDocument/publishDiagnostics", "{message}");
            let params = &message["params"];
            let uri = params["uri"].as_str().unwrap().to_owned();
            self.published.insert(uri, params.clone());
        }
    }

    /// Opens a file as it is on the disk.
    pub(crate) fn open(&mut self, path: &str) {
        let text = self.files.0[path].clone();
        self.open_as(path, &text);
    }

    pub(crate) fn open_as(&mut self, path: &str, text: &str) {
        let document = json!({ "uri": uri(path), "languageId": "vcut", "version": 1, "text": text });
        self.texts.insert(path.to_owned(), (1, text.to_owned()));
        self.notify("textDocument/didOpen", json!({ "textDocument": document }));
        self.settle();
    }

    pub(crate) fn close(&mut self, path: &str) {
        self.texts.remove(path);
        let document = json!({ "uri": uri(path) });
        self.notify("textDocument/didClose", json!({ "textDocument": document }));
        self.settle();
    }

    /// The text of an open document, as this editor has it.
    pub(crate) fn text(&self, path: &str) -> &str {
        &self.texts[path].1
    }

    /// Replaces bytes of an open document, and does not wait for what the server says.
    pub(crate) fn type_in(&mut self, path: &str, bytes: std::ops::Range<usize>, new: &str) {
        let (version, text) = self.texts.get_mut(path).unwrap();
        let range = json!({ "start": position(text, bytes.start), "end": position(text, bytes.end) });
        text.replace_range(bytes, new);
        *version += 1;
        let document = json!({ "uri": uri(path), "version": *version });
        let changes = json!([{ "range": range, "text": new }]);
        let params = json!({ "textDocument": document, "contentChanges": changes });
        self.notify("textDocument/didChange", params);
    }

    /// Replaces the only place of a text by another.
    pub(crate) fn replace(&mut self, path: &str, old: &str, new: &str) {
        let text = self.text(path);
        let at = text.find(old).unwrap_or_else(|| panic!("no {old}"));
        self.type_in(path, at..at + old.len(), new);
        self.settle();
    }

    /// What was reported of a document: its diagnostics.
    pub(crate) fn diagnostics(&self, path: &str) -> Vec<Value> {
        let published = self.published.get(&uri(path));
        published.map_or(Vec::new(), |params| {
            params["diagnostics"].as_array().unwrap().clone()
        })
    }

    /// The codes of a document's diagnostics.
    pub(crate) fn codes(&self, path: &str) -> Vec<String> {
        let diagnostics = self.diagnostics(path);
        diagnostics
            .iter()
            .map(|diagnostic| diagnostic["code"].as_str().unwrap().to_owned())
            .collect()
    }

    /// Parameters for a request about the place of `|` in a piece of the text, which it is not part of.
    pub(crate) fn at(&self, path: &str, piece: &str) -> Value {
        let (before, after) = piece.split_once('|').unwrap();
        let text = self.text(path);
        let found = text.find(&format!("{before}{after}"));
        let at = found.unwrap_or_else(|| panic!("no {piece}")) + before.len();
        json!({ "textDocument": { "uri": uri(path) }, "position": position(text, at) })
    }

    /// Makes the edits of an answer in files and open documents.
    pub(crate) fn make(&mut self, edit: &Value) {
        for (uri, edits) in edit["changes"].as_object().unwrap() {
            let path = uri.strip_prefix("file://").unwrap().to_owned();
            let is_open = self.texts.contains_key(&path);
            let mut text = if is_open {
                self.text(&path).to_owned()
            } else {
                self.files.0[&path].clone()
            };
            let mut edits: Vec<(usize, usize, String)> = edits
                .as_array()
                .unwrap()
                .iter()
                .map(|edit| {
                    let (start, end) = (&edit["range"]["start"], &edit["range"]["end"]);
                    let new = edit["newText"].as_str().unwrap().to_owned();
                    (offset(&text, start), offset(&text, end), new)
                })
                .collect();
            edits.sort();
            for (start, end, new) in edits.into_iter().rev() {
                if is_open {
                    self.type_in(&path, start..end, &new);
                }
                text.replace_range(start..end, &new);
            }
            self.files.0.insert(path, text);
        }
        self.settle();
    }
}

/// The byte of a position.
pub(crate) fn offset(text: &str, at: &Value) -> usize {
    let (line, units) = (at["line"].as_u64().unwrap(), at["character"].as_u64().unwrap());
    let start: usize = text
        .split_inclusive('\n')
        .take(usize::try_from(line).unwrap())
        .map(str::len)
        .sum();
    let mut rest = units;
    let within: usize = text[start..]
        .chars()
        .take_while(|c| {
            let is_before = rest > 0;
            rest = rest.saturating_sub(c.len_utf16() as u64);
            is_before
        })
        .map(char::len_utf8)
        .sum();
    start + within
}

/// A small job that is right and quickly planned.
pub(crate) const RIB: &str = "\
// Eine Rippe für den Flügel 🔪 𝒳
job \"rib\"
use \"blades.vcut\"
let width = 60 mm
let half  = width / 2   // 𝒳 half of it
stock { size = (width, 40 mm, 30 mm) }
profile { start (0 mm, 12 mm) line to (half, 16 mm) line to (width, 12 mm) }
rough vcut {
  blade = dagger
  rake  = 60 deg
  swing = auto
  layer = 5 mm
  step  = auto
  lattice = orthogonal
  residual = discard
  order = point
  sequence = rows
  limits { swing <= 45 deg, scallop <= 30 mm }
  feed { cut = slow, travel = 12 m/min, reorient = 90 deg/s }
  clearance = 10 mm
}
";

/// Its library.
pub(crate) const BLADES: &str = "\
blade dagger { cutting_length = 20 mm, half_apex = 7.13 deg, thickness = 0 mm, edges = double }
let slow = 200 mm/s
";
