//! The server as a machine of states: from a message to messages.

mod requests;

use super::Workspace;
use super::analysis::{Analysis, Done, Finding, Planning, Task};
use super::diagnostics::{Lines, hint_in_protocol, in_protocol};
use super::documents::{Called, Documents, Language};
use super::spelling::Spellings;
use super::text::Encoding;
use super::uri::path_of;
use super::wire::{Fault, Incoming, answer, notification, refusal};
use lsp_types::{
    DidChangeTextDocumentParams, DidChangeWorkspaceFoldersParams, DidCloseTextDocumentParams,
    DidOpenTextDocumentParams, InitializeParams, PositionEncodingKind, PublishDiagnosticsParams,
    WorkspaceFolder,
};
use serde::de::DeserializeOwned;
use serde_json::{Value, json};
use std::collections::{BTreeMap, BTreeSet};
use vcutc_backend_api::backend::Backend;
use vcutc_cancellation::Wanted;
use vcutc_job::sema::kind::Operations;

/// How far the conversation is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Stage {
    /// The client has not introduced itself.
    Fresh,
    /// In full swing.
    Running,
    /// The client has asked to stop.
    Stopping,
    /// It has said good-bye.
    Over(Ending),
}

/// How a conversation ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ending {
    /// As agreed: first `shutdown`, then `exit`.
    Agreed,
    /// Without `shutdown`.
    Abrupt,
}

/// What the client can take.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Insertion {
    #[default]
    Plain,
    /// Texts with places to go on at.
    Snippets,
}

/// When jobs are planned.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum PlanningWish {
    /// Whenever a job has no errors.
    #[default]
    WhileTyping,
    /// Never: `vcutc check` does it.
    Never,
}

/// What reports that files on the disk have changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Watching {
    /// The client, if it does so by itself.
    Unasked,
    /// The client, when it is asked to.
    OnRequest,
}

/// How the client learns of the diagnostics of open documents.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Delivery {
    /// They are sent when there is something new.
    #[default]
    Pushed,
    /// It asks for them, and is notified when it should ask again.
    Pulled,
}

/// What was last published about a file.
type Published = (Option<i32>, Vec<lsp_types::Diagnostic>);

/// A language server.
pub struct Server {
    stage: Stage,
    pub(super) documents: Documents,
    published: BTreeMap<String, Published>,
    pub(super) targets: Vec<&'static dyn Backend>,
    pub(super) insertion: Insertion,
    planning: PlanningWish,
    watching: Watching,
    pub(super) delivery: Delivery,
    refreshes: u64,
    spellings: Spellings,
}

impl Server {
    /// A server that knows these operations and targets.
    #[must_use]
    pub fn new(operations: Operations, targets: &[&'static dyn Backend]) -> Self {
        Self {
            stage: Stage::Fresh,
            documents: Documents::new(operations),
            published: BTreeMap::new(),
            targets: targets.to_vec(),
            insertion: Insertion::default(),
            planning: PlanningWish::default(),
            watching: Watching::Unasked,
            delivery: Delivery::default(),
            refreshes: 0,
            spellings: Spellings::default(),
        }
    }

    /// How the conversation ended, once it has.
    #[must_use]
    pub const fn ending(&self) -> Option<Ending> {
        match self.stage {
            Stage::Over(ending) => Some(ending),
            Stage::Fresh | Stage::Running | Stage::Stopping => None,
        }
    }

    /// Takes a message and gives those that answer it.
    pub fn handle(&mut self, message: Incoming, files: &dyn Workspace) -> Vec<Value> {
        let messages = match message {
            Incoming::Request {
                id,
                method,
                mut params,
            } => {
                self.spellings.read(&mut params);
                let mut messages = Vec::new();
                // Questions are about the text as it is now.
                if self.stage == Stage::Running {
                    messages = self.settled(files);
                }
                messages.push(match self.request(&method, params, files) {
                    Ok(result) => answer(&id, &result),
                    Err((fault, why)) => refusal(&id, fault, &why),
                });
                messages
            }
            Incoming::Notification { method, mut params } => {
                self.spellings.read(&mut params);
                self.notification(&method, params).unwrap_or_else(|(_, why)| {
                    // It has no answer, but what it says is lost.
                    vec![requests::warning(&format!("`{method}` cannot be read: {why}"))]
                })
            }
            Incoming::Response => Vec::new(),
            Incoming::Malformed { refusal, .. } => vec![refusal],
        };
        self.spelled(messages)
    }

    /// Messages with URIs as the client spells them.
    fn spelled(&self, mut messages: Vec<Value>) -> Vec<Value> {
        for message in &mut messages {
            self.spellings.write(message);
        }
        messages
    }

    fn request(&mut self, method: &str, params: Value, files: &dyn Workspace) -> requests::Answer {
        match (self.stage, method) {
            (Stage::Fresh, "initialize") => {
                self.agree(&params);
                self.introduced(&parsed(params)?);
                self.stage = Stage::Running;
                Ok(requests::introduction(self))
            }
            (Stage::Fresh, _) => Err((Fault::NotInitialized, "`initialize` comes first".to_owned())),
            (Stage::Running, "initialize") => Err((
                Fault::InvalidRequest,
                "the server is initialized already".to_owned(),
            )),
            (Stage::Running, "shutdown") => {
                self.stage = Stage::Stopping;
                Ok(Value::Null)
            }
            (Stage::Running, _) => requests::meet(self, method, params, files),
            (Stage::Stopping | Stage::Over(_), _) => {
                Err((Fault::InvalidRequest, "the server has been shut down".to_owned()))
            }
        }
    }

    /// Takes what the client can do from its introduction.
    fn agree(&mut self, introduction: &Value) {
        let can = |what: &str| {
            let capability = introduction.pointer(&format!("/capabilities/{what}"));
            capability == Some(&Value::Bool(true))
        };
        self.delivery = delivery(introduction);
        if can("textDocument/completion/completionItem/snippetSupport") {
            self.insertion = Insertion::Snippets;
        }
        if can("workspace/didChangeWatchedFiles/dynamicRegistration") {
            self.watching = Watching::OnRequest;
        }
        if introduction.pointer("/initializationOptions/planning") == Some(&json!("never")) {
            self.planning = PlanningWish::Never;
        }
    }

    fn introduced(&mut self, params: &InitializeParams) {
        let encodings = params.capabilities.general.as_ref();
        let encodings = encodings.and_then(|general| general.position_encodings.as_deref());
        let names = encodings
            .unwrap_or_default()
            .iter()
            .map(PositionEncodingKind::as_str);
        self.documents.encoding = Encoding::agreed(names);
        let folders = params.workspace_folders.iter().flatten();
        self.documents.folders = folders.map(|folder| path_of(&folder.uri)).collect();
        #[expect(deprecated, reason = "clients without folders still send their root so")]
        if self.documents.folders.is_empty()
            && let Some(root) = &params.root_uri
        {
            self.documents.folders = vec![path_of(root)];
        }
    }

    fn notification(&mut self, method: &str, params: Value) -> Result<Vec<Value>, (Fault, String)> {
        match (self.stage, method) {
            (Stage::Running, "initialized") if self.watching == Watching::OnRequest => {
                return Ok(vec![requests::watch_files()]);
            }
            (Stage::Stopping, "exit") => self.stage = Stage::Over(Ending::Agreed),
            (_, "exit") => self.stage = Stage::Over(Ending::Abrupt),
            (Stage::Running, "textDocument/didOpen") => {
                let params = parsed::<DidOpenTextDocumentParams>(params)?;
                self.opened(params);
            }
            (Stage::Running, "textDocument/didChange") => {
                let params = parsed::<DidChangeTextDocumentParams>(params)?;
                self.changed(&params);
            }
            (Stage::Running, "textDocument/didClose") => {
                let params = parsed::<DidCloseTextDocumentParams>(params)?;
                self.documents.close(&path_of(&params.text_document.uri));
            }
            (Stage::Running, "workspace/didChangeWorkspaceFolders") => {
                let params = parsed::<DidChangeWorkspaceFoldersParams>(params)?;
                self.moved(&params);
            }
            (Stage::Running, "textDocument/didSave" | "workspace/didChangeWatchedFiles") => {
                self.documents.forget_all();
            }
            // Others are ignored.
            _ => {}
        }
        Ok(Vec::new())
    }

    /// Takes other folders for those of the workspace.
    fn moved(&mut self, params: &DidChangeWorkspaceFoldersParams) {
        let path = |folder: &WorkspaceFolder| path_of(&folder.uri);
        let gone: Vec<String> = params.event.removed.iter().map(path).collect();
        let folders = &mut self.documents.folders;
        folders.retain(|folder| !gone.contains(folder));
        folders.extend(params.event.added.iter().map(path));
        self.documents.forget_all();
    }

    fn opened(&mut self, params: DidOpenTextDocumentParams) {
        let document = params.text_document;
        let path = path_of(&document.uri);
        let language = if document.language_id == "vcut" || path.ends_with(".vcut") {
            Language::Vcut
        } else {
            Language::Other
        };
        let called = Called {
            uri: document.uri,
            version: document.version,
            language,
        };
        self.documents.open(path, called, &document.text);
    }

    fn changed(&mut self, params: &DidChangeTextDocumentParams) {
        let path = path_of(&params.text_document.uri);
        let Some(text) = self.documents.texts.get(&path) else {
            return;
        };
        let text = text.changed(&params.content_changes);
        self.documents.change(&path, params.text_document.version, text);
    }

    /// Looks at what has changed, and publishes the diagnostics that have changed. To be called when no more messages wait.
    pub fn settle(&mut self, files: &dyn Workspace) -> Vec<Value> {
        if self.stage != Stage::Running {
            return Vec::new();
        }
        let messages = self.settled(files);
        self.spelled(messages)
    }

    fn settled(&mut self, files: &dyn Workspace) -> Vec<Value> {
        self.documents.look(files);
        self.publish()
    }

    /// Reports what is known of every file, where that has changed.
    fn publish(&mut self) -> Vec<Value> {
        let mut reported = self.reported();
        let mut messages = Vec::new();
        let mut is_other = false;
        let paths: BTreeSet<String> = reported.keys().chain(self.published.keys()).cloned().collect();
        for path in paths {
            let version = self.documents.called.get(&path).map(|called| called.version);
            let now = (version, reported.remove(&path).unwrap_or_default());
            let is_gone = now.1.is_empty() && version.is_none();
            let before = self.published.get(&path);
            if before == Some(&now) || before.is_none() && is_gone {
                continue;
            }
            if self.delivery == Delivery::Pulled && version.is_some() {
                // Of a new version the client asks by itself.
                is_other |= before.is_some_and(|(known, _)| *known == version);
                self.published.insert(path, now);
                continue;
            }
            let Some(uri) = self.documents.uri(&path) else {
                continue;
            };
            let params = PublishDiagnosticsParams {
                uri,
                diagnostics: now.1.clone(),
                version,
            };
            messages.push(notification("textDocument/publishDiagnostics", &json!(params)));
            if is_gone {
                self.published.remove(&path);
            } else {
                self.published.insert(path, now);
            }
        }
        if is_other {
            self.refreshes += 1;
            messages.push(requests::ask_again(self.refreshes));
        }
        messages
    }

    /// The diagnostics of a document, for a client that asks for them.
    pub(super) fn asked_for(&self, path: &str) -> Vec<lsp_types::Diagnostic> {
        self.reported().remove(path).unwrap_or_default()
    }

    /// The diagnostics by file; open documents are listed even without any.
    fn reported(&self) -> BTreeMap<String, Vec<lsp_types::Diagnostic>> {
        let open = self.documents.called.iter();
        let mut reported: BTreeMap<String, Vec<lsp_types::Diagnostic>> = open
            .filter(|(_, called)| called.language == Language::Vcut)
            .map(|(path, _)| (path.clone(), Vec::new()))
            .collect();
        for known in self.documents.speaking() {
            let is_open = self.documents.called.contains_key(&known.root);
            let (sources, diagnostics) = known.reported();
            let mut lines = Lines::of(sources, self.documents.encoding);
            for hint in known.hints() {
                if let Some((path, shown)) = hint_in_protocol(hint, &mut lines)
                    && (is_open || self.documents.called.contains_key(&path))
                {
                    reported.entry(path).or_default().push(shown);
                }
            }
            for diagnostic in diagnostics {
                let (path, shown) = in_protocol(diagnostic, |path| known.file(path).is_some(), &mut lines);
                // A file of points that is open is marked too, beside the job that names it.
                let aside = in_protocol(diagnostic, |_| true, &mut lines);
                let aside = Some(aside)
                    .filter(|(other, _)| *other != path && self.documents.called.contains_key(other));
                for (path, diagnostic) in [(path, shown)].into_iter().chain(aside) {
                    // A job that was looked for to understand a library is not complained about itself.
                    if !is_open && !self.documents.called.contains_key(&path) {
                        continue;
                    }
                    let of_file = reported.entry(path).or_default();
                    if !of_file.contains(&diagnostic) {
                        of_file.push(diagnostic);
                    }
                }
            }
        }
        reported
    }

    /// A job to be planned, if there is one: the one that was changed last. The caller lets it run when and where it likes, one
    /// at a time, and hands back what it gives.
    pub fn task(&mut self) -> Option<Task> {
        if self.stage != Stage::Running || self.planning == PlanningWish::Never {
            return None;
        }
        let is_due = |known: &&mut Analysis| matches!(known.planning, Planning::Due);
        let due = self.documents.analyses.values_mut().filter(is_due);
        let known = due.max_by_key(|known| known.stamp)?;
        let (wanted, interest) = Wanted::while_held();
        known.planning = Planning::UnderWay(interest);
        Some(Task {
            root: known.root.clone(),
            operations: self.documents.operations,
            stamp: known.stamp,
            open: self.documents.texts.clone(),
            wanted,
        })
    }

    /// Puts off a job that is being planned if another one was changed after it: its task ends early, and there will be another.
    pub fn put_off(&mut self) {
        let all = self.documents.analyses.values();
        let due = all.filter(|known| matches!(known.planning, Planning::Due));
        let Some(latest) = due.map(|known| known.stamp).max() else {
            return;
        };
        for known in self.documents.analyses.values_mut() {
            let is_busy = matches!(known.planning, Planning::UnderWay(_) | Planning::Helping(..));
            if is_busy && known.stamp < latest {
                known.planning = Planning::Due;
            }
        }
    }

    /// Takes the result of a task, and publishes it if it is about the current text.
    pub fn finish(&mut self, done: Done) -> Vec<Value> {
        let Some(known) = self.documents.numbered(&done.root, done.stamp) else {
            return Vec::new();
        };
        known.planning = match done.result {
            Finding::Planned(planned) => Planning::Done(planned),
            Finding::AtOnce(planned) => match core::mem::replace(&mut known.planning, Planning::Due) {
                Planning::UnderWay(interest) => Planning::Helping(interest, planned),
                // Put off meanwhile: it is due again.
                other @ (Planning::Needless | Planning::Due | Planning::Helping(..) | Planning::Done(_)) => {
                    other
                }
            },
            Finding::Unreadable => Planning::Needless,
            // Put off: it is due again.
            Finding::Needless => return Vec::new(),
        };
        let messages = self.publish();
        self.spelled(messages)
    }
}

/// How a client wants to learn of diagnostics. One that asks must also be willing to ask again when planning has found more.
fn delivery(introduction: &Value) -> Delivery {
    let asks = introduction.pointer("/capabilities/textDocument/diagnostic");
    let again = introduction.pointer("/capabilities/workspace/diagnostics/refreshSupport");
    match (asks, again) {
        (Some(_), Some(Value::Bool(true))) => Delivery::Pulled,
        (Some(_) | None, _) => Delivery::Pushed,
    }
}

/// The parameters of a message.
pub(super) fn parsed<T: DeserializeOwned>(params: Value) -> Result<T, (Fault, String)> {
    serde_json::from_value(params).map_err(|error| (Fault::InvalidParams, error.to_string()))
}
