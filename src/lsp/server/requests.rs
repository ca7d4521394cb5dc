//! The requests of a running conversation, and their answers in the protocol's terms.

use super::{Delivery, Insertion, Server, parsed};
use crate::Workspace;
use crate::analysis::Analysis;
use crate::completion::completion;
use crate::diagnostics::{Lines, edits_of, hint_in_protocol, in_protocol, workspace_edit};
use crate::folding::folds;
use crate::formatting::formatting;
use crate::hints::hints;
use crate::hover::hover;
use crate::names::{
    changes_meaning, definition_at, file_meant, name_at, occurrences, places, refused, sites_at,
};
use crate::offer::Offer;
use crate::paths::Folder;
use crate::sites::{Kind, Path};
use crate::symbols::{defined as defined_in, symbols};
use crate::text::Text;
use crate::tokens::{legend, modifiers, semantic_tokens};
use crate::uri::{path_of, uri_of};
use crate::wire::{Fault, notification};
use lsp_types::{
    CodeActionKind, CodeActionParams, CompletionItem, CompletionParams, CompletionTextEdit,
    DocumentDiagnosticParams, DocumentFormattingParams, DocumentSymbol, DocumentSymbolParams, Documentation,
    FoldingRange, FoldingRangeParams, GotoDefinitionParams, Hover, HoverContents, HoverParams, InlayHint,
    InlayHintKind, InlayHintLabel, InlayHintParams, InlayHintTooltip, InsertTextFormat, Location,
    MarkupContent, MarkupKind, Position, Range, ReferenceParams, RenameParams, SemanticTokens,
    SemanticTokensParams, TextDocumentIdentifier, TextDocumentPositionParams, TextEdit,
    WorkspaceSymbolParams,
};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use vcutc_diagnostics::Fix;
use vcutc_diagnostics::source::Span;
use vcutc_machine::Origin;

/// So many symbols are enough for one answer.
const MOST_FOUND: usize = 1000;

/// A result, or why there is none.
pub(super) type Answer = Result<Value, (Fault, String)>;

/// What the server can do, in what this client understands.
pub(super) fn introduction(server: &Server) -> Value {
    let diagnostics = match server.delivery {
        Delivery::Pushed => Value::Null,
        Delivery::Pulled => json!({
            "identifier": "vcutc", "interFileDependencies": true, "workspaceDiagnostics": false,
        }),
    };
    json!({
        "capabilities": {
            "positionEncoding": server.documents.encoding.name(),
            "workspace": { "workspaceFolders": { "supported": true, "changeNotifications": true } },
            "diagnosticProvider": diagnostics,
            "textDocumentSync": { "openClose": true, "change": 2, "save": { "includeText": false } },
            "hoverProvider": true,
            "completionProvider": { "triggerCharacters": ["=", "\"", "/", " ", "("] },
            "definitionProvider": true,
            "referencesProvider": true,
            "documentHighlightProvider": true,
            "documentSymbolProvider": true,
            "workspaceSymbolProvider": true,
            "codeActionProvider": { "codeActionKinds": ["quickfix"] },
            "renameProvider": { "prepareProvider": true },
            "inlayHintProvider": true,
            "documentFormattingProvider": true,
            "foldingRangeProvider": true,
            "semanticTokensProvider": {
                "legend": { "tokenTypes": legend(), "tokenModifiers": modifiers() },
                "full": true
            }
        },
        "serverInfo": { "name": "vcutc", "version": env!("CARGO_PKG_VERSION") }
    })
}

/// Asks the client to ask for diagnostics again.
pub(super) fn ask_again(number: u64) -> Value {
    let id = format!("diagnostics-{number}");
    json!({ "jsonrpc": "2.0", "id": id, "method": "workspace/diagnostic/refresh" })
}

/// Reports to the user of the client, in its log.
pub(super) fn warning(text: &str) -> Value {
    const WARNING: u8 = 2;
    notification("window/logMessage", &json!({ "type": WARNING, "message": text }))
}

/// Asks the client to notify of changes of files that jobs name.
pub(super) fn watch_files() -> Value {
    // Drawings often come with endings in capitals, which some clients distinguish.
    let endings = "vcut,toml,urdf,csv,dat,txt,dxf,svg,CSV,DAT,TXT,DXF,SVG";
    let watchers = json!([{ "globPattern": format!("**/*.{{{endings}}}") }]);
    let registration = json!({
        "id": "files",
        "method": "workspace/didChangeWatchedFiles",
        "registerOptions": { "watchers": watchers },
    });
    json!({
        "jsonrpc": "2.0",
        "id": "watch-files",
        "method": "client/registerCapability",
        "params": { "registrations": [registration] },
    })
}

/// Meets a request.
pub(super) fn meet(server: &mut Server, method: &str, params: Value, files: &dyn Workspace) -> Answer {
    Ok(match method {
        "textDocument/hover" => json!(hovered(server, parsed(params)?)),
        "textDocument/completion" => json!(completed(server, parsed(params)?, files)),
        "textDocument/definition" => json!(defined(server, parsed(params)?)),
        "textDocument/references" => json!(referred(server, parsed(params)?, files)),
        "textDocument/documentHighlight" => json!(highlighted(server, parsed(params)?)),
        "textDocument/documentSymbol" => json!(outlined(server, parsed(params)?)),
        "workspace/symbol" => json!(found(server, &parsed(params)?, files)),
        "textDocument/codeAction" => json!(quick_fixes(server, parsed(params)?)),
        "textDocument/prepareRename" => renamable(server, parsed(params)?)?,
        "textDocument/rename" => renamed(server, parsed(params)?, files)?,
        "textDocument/formatting" => json!(formatted(server, parsed(params)?)),
        "textDocument/foldingRange" => json!(folded(server, parsed(params)?)),
        "textDocument/inlayHint" => json!(hinted(server, parsed(params)?)),
        "textDocument/diagnostic" => reported(server, &parsed(params)?),
        "textDocument/semanticTokens/full" => json!(coloured(server, parsed(params)?)),
        _ => return Err((Fault::MethodNotFound, format!("there is no method `{method}`"))),
    })
}

/// An open document with what is known of it.
struct Asked<'s> {
    path: String,
    text: &'s Text,
    analysis: &'s Analysis,
}

/// The document of a request; none for one that is not open, or not of the language.
fn asked<'s>(server: &'s Server, document: &TextDocumentIdentifier) -> Option<Asked<'s>> {
    let path = path_of(&document.uri);
    let text = server.documents.texts.get(&path)?;
    let analysis = server.documents.about(&path)?;
    Some(Asked { path, text, analysis })
}

/// The diagnostics of a document.
fn reported(server: &Server, params: &DocumentDiagnosticParams) -> Value {
    let items = server.asked_for(&path_of(&params.text_document.uri));
    json!({ "kind": "full", "items": items })
}

fn markdown(value: String) -> MarkupContent {
    MarkupContent {
        kind: MarkupKind::Markdown,
        value,
    }
}

fn hovered(server: &Server, params: HoverParams) -> Option<Hover> {
    let at = params.text_document_position_params;
    let asked = asked(server, &at.text_document)?;
    let offset = asked.text.offset(at.position);
    let found = hover(asked.analysis, &asked.path, offset, &server.targets)?;
    Some(Hover {
        contents: HoverContents::Markup(markdown(found.text)),
        range: Some(asked.text.range(found.span.bytes())),
    })
}

fn completed(
    server: &Server,
    params: CompletionParams,
    files: &dyn Workspace,
) -> Option<Vec<CompletionItem>> {
    let at = params.text_document_position;
    let asked = asked(server, &at.text_document)?;
    let offset = asked.text.offset(at.position);
    let folder = Folder {
        file: &asked.path,
        files,
    };
    let found = completion(
        asked.text.as_str(),
        offset,
        asked.analysis,
        &server.targets,
        &folder,
    );
    let range = asked.text.range(found.replaces);
    let offers = found.offers.into_iter();
    Some(offers.map(|offer| item(offer, range, server.insertion)).collect())
}

fn item(offer: Offer, range: Range, insertion: Insertion) -> CompletionItem {
    let (format, text) = match insertion {
        Insertion::Snippets => (InsertTextFormat::SNIPPET, offer.snippet),
        Insertion::Plain => (InsertTextFormat::PLAIN_TEXT, plain(&offer.snippet)),
    };
    CompletionItem {
        sort_text: Some(format!("{}{}", offer.rank as u8, offer.label)),
        filter_text: Some(offer.label.clone()),
        label: offer.label,
        kind: Some(offer.kind),
        detail: (!offer.detail.is_empty()).then_some(offer.detail),
        documentation: offer
            .documentation
            .map(|text| Documentation::MarkupContent(markdown(text))),
        insert_text_format: Some(format),
        text_edit: Some(CompletionTextEdit::Edit(TextEdit {
            range,
            new_text: text,
        })),
        ..CompletionItem::default()
    }
}

/// A snippet without its places: `$1` is nothing, `${1:4 mm}` is `4 mm`, `\}` is `}`.
pub(super) fn plain(snippet: &str) -> String {
    let mut text = String::new();
    let mut letters = snippet.chars().peekable();
    let mut open = 0_usize;
    while let Some(letter) = letters.next() {
        match letter {
            '\\' => text.extend(letters.next()),
            '}' if open > 0 => open -= 1,
            '$' if letters.peek() == Some(&'{') => {
                open += 1;
                let skipped = letters.by_ref().find(|letter| *letter == ':' || *letter == '}');
                if skipped == Some('}') {
                    open -= 1;
                }
            }
            '$' => while letters.next_if(char::is_ascii_digit).is_some() {},
            letter => text.push(letter),
        }
    }
    text
}

/// The place of a span of an analysis, as the client calls its file.
fn location(server: &Server, analysis: &Analysis, span: Span) -> Option<Location> {
    let source = analysis.sources.get(span.file)?;
    Some(Location {
        uri: server.documents.uri(&source.name)?,
        range: Text::new(&source.text, server.documents.encoding).range(span.bytes()),
    })
}

fn defined(server: &Server, params: GotoDefinitionParams) -> Option<Location> {
    let at = params.text_document_position_params;
    let asked = asked(server, &at.text_document)?;
    let offset = asked.text.offset(at.position);
    match definition_at(asked.analysis, &asked.path, offset) {
        Some(definition) => location(server, asked.analysis, definition.name.span),
        None => named_file(server, &asked, offset),
    }
}

/// The file that the text under the cursor names.
fn named_file(server: &Server, asked: &Asked<'_>, offset: usize) -> Option<Location> {
    let sites = sites_at(asked.analysis, &asked.path, offset);
    let meant = sites.iter().find_map(|site| {
        let Kind::Path(path, written) = site.kind else {
            return None;
        };
        let is_file = path != Path::Model || Origin::of(written) != Origin::Catalogue;
        is_file.then(|| file_meant(asked.analysis, site.span.file, written))
    })?;
    let start = Position::default();
    Some(Location {
        uri: server.documents.uri(&meant).or_else(|| uri_of(&meant))?,
        range: Range { start, end: start },
    })
}

/// All analyses in which a name of an open document may be used, and the name.
fn users_of_name(
    server: &mut Server,
    at: &TextDocumentPositionParams,
    files: &dyn Workspace,
) -> Option<(String, Vec<Analysis>)> {
    let asked = asked(server, &at.text_document)?;
    let offset = asked.text.offset(at.position);
    let name = name_at(asked.analysis, &asked.path, offset)?.text;
    let known = asked.analysis.study.definition(&name)?;
    let home = asked.analysis.sources.name(known.name.span.file).to_owned();
    let users = server.documents.users(&home, files);
    Some((name, users))
}

fn referred(server: &mut Server, params: ReferenceParams, files: &dyn Workspace) -> Option<Vec<Location>> {
    let (name, users) = users_of_name(server, &params.text_document_position, files)?;
    let users: Vec<&Analysis> = users.iter().collect();
    let mut found: Vec<Location> = Vec::new();
    for (path, (text, spans)) in places(&users, &name, server.documents.encoding) {
        let Some(uri) = server.documents.uri(&path) else {
            continue;
        };
        found.extend(spans.iter().map(|&(start, end)| Location {
            uri: uri.clone(),
            range: text.range(start as usize..end as usize),
        }));
    }
    if !params.context.include_declaration {
        let definition = users.iter().find_map(|user| {
            let known = user.study.definition(&name)?;
            location(server, user, known.name.span)
        });
        found.retain(|place| Some(place) != definition.as_ref());
    }
    Some(found)
}

fn highlighted(server: &Server, params: lsp_types::DocumentHighlightParams) -> Option<Vec<Value>> {
    let at = params.text_document_position_params;
    let asked = asked(server, &at.text_document)?;
    let offset = asked.text.offset(at.position);
    let name = name_at(asked.analysis, &asked.path, offset)?;
    let spans = occurrences(asked.analysis, &name.text).into_iter();
    let in_file = spans.filter(|span| span.file == name.span.file);
    Some(
        in_file
            .map(|span| json!({ "range": asked.text.range(span.bytes()) }))
            .collect(),
    )
}

fn folded(server: &Server, params: FoldingRangeParams) -> Option<Vec<FoldingRange>> {
    let asked = asked(server, &params.text_document)?;
    let (_, ast) = asked.analysis.file(&asked.path)?;
    Some(folds(ast, asked.text))
}

fn outlined(server: &Server, params: DocumentSymbolParams) -> Option<Vec<DocumentSymbol>> {
    let asked = asked(server, &params.text_document)?;
    let (_, ast) = asked.analysis.file(&asked.path)?;
    Some(symbols(ast, asked.text))
}

/// What the files of the workspace define, by a part of its name.
fn found(server: &mut Server, params: &WorkspaceSymbolParams, files: &dyn Workspace) -> Vec<Value> {
    let wanted = params.query.to_lowercase();
    let encoding = server.documents.encoding;
    let mut found: Vec<Value> = Vec::new();
    for (path, known) in server.documents.whole_workspace(files) {
        let Some((file, ast)) = known.file(&path) else {
            continue;
        };
        let text = known.sources.get(file).map_or("", |file| file.text.as_str());
        let text = Text::new(text, encoding);
        let Some(uri) = server.documents.uri(&path) else {
            continue;
        };
        let named = defined_in(ast, &text).into_iter();
        let named = named.filter(|symbol| symbol.name.to_lowercase().contains(&wanted));
        found.extend(named.map(|symbol| {
            json!({
                "name": symbol.name,
                "kind": symbol.kind,
                "containerName": path.rsplit('/').next(),
                "location": { "uri": uri, "range": symbol.selection_range },
            })
        }));
        if found.len() >= MOST_FOUND {
            break;
        }
    }
    found
}

/// The fixes of the diagnostics that touch a range.
fn quick_fixes(server: &Server, params: CodeActionParams) -> Vec<Value> {
    let path = path_of(&params.text_document.uri);
    let mut actions: Vec<Value> = Vec::new();
    for known in server.documents.speaking() {
        let (sources, diagnostics) = known.reported();
        let mut lines = Lines::of(sources, server.documents.encoding);
        for diagnostic in diagnostics {
            let (of_file, reported) = in_protocol(diagnostic, |path| known.file(path).is_some(), &mut lines);
            if of_file != path || !touches(reported.range, params.range) {
                continue;
            }
            for fix in &diagnostic.fixes {
                let Some(mut action) = action(fix, &reported, &mut lines) else {
                    continue;
                };
                action["isPreferred"] = json!(diagnostic.fixes.len() == 1);
                if !actions.contains(&action) {
                    actions.push(action);
                }
            }
        }
        for hint in known.hints() {
            let shown = hint_in_protocol(hint, &mut lines);
            let touched =
                shown.filter(|(of_file, reported)| *of_file == path && touches(reported.range, params.range));
            actions.extend(touched.and_then(|(_, reported)| action(&hint.fix, &reported, &mut lines)));
        }
    }
    actions
}

/// A change that an editor can make; none where it has no place in a file.
fn action(fix: &Fix, reported: &lsp_types::Diagnostic, lines: &mut Lines<'_>) -> Option<Value> {
    Some(json!({
        "title": capitalised(&fix.title),
        "kind": CodeActionKind::QUICKFIX,
        "diagnostics": [reported],
        "edit": edits_of(fix, lines)?,
    }))
}

fn touches(a: Range, b: Range) -> bool {
    a.start <= b.end && b.start <= a.end
}

fn capitalised(text: &str) -> String {
    let mut letters = text.chars();
    let first = letters.next().into_iter().flat_map(char::to_uppercase);
    first.chain(letters).collect()
}

fn renamable(server: &Server, at: TextDocumentPositionParams) -> Answer {
    let name = asked(server, &at.text_document).and_then(|asked| {
        let offset = asked.text.offset(at.position);
        let name = name_at(asked.analysis, &asked.path, offset)?;
        Some(json!({ "range": asked.text.range(name.span.bytes()), "placeholder": name.text }))
    });
    name.ok_or_else(nothing_to_rename)
}

fn nothing_to_rename() -> (Fault, String) {
    let why =
        "only names of values, blades and machines can be renamed, and only where they are defined somewhere";
    (Fault::RequestFailed, why.to_owned())
}

fn renamed(server: &mut Server, params: RenameParams, files: &dyn Workspace) -> Answer {
    let found = users_of_name(server, &params.text_document_position, files);
    let (name, users) = found.ok_or_else(nothing_to_rename)?;
    let users: Vec<&Analysis> = users.iter().collect();
    let new = params.new_name.as_str();
    if let Some(why) = refused(&users, &name, new) {
        return Err((Fault::RequestFailed, why));
    }
    let places = places(&users, &name, server.documents.encoding);
    let open = &server.documents.texts;
    if let Some(why) = changes_meaning(&users, &places, (&name, new), open, files) {
        return Err((Fault::RequestFailed, why));
    }
    let mut changes: BTreeMap<String, Vec<TextEdit>> = BTreeMap::new();
    for (path, (text, spans)) in places {
        let uri = server.documents.uri(&path).ok_or_else(|| {
            let why = format!("`{path}` cannot be written as a URI");
            (Fault::RequestFailed, why)
        })?;
        let edits = spans.iter().map(|&(start, end)| TextEdit {
            range: text.range(start as usize..end as usize),
            new_text: new.to_owned(),
        });
        changes.insert(uri.as_str().to_owned(), edits.collect());
    }
    Ok(workspace_edit(changes))
}

fn formatted(server: &Server, params: DocumentFormattingParams) -> Option<Vec<TextEdit>> {
    let path = path_of(&params.text_document.uri);
    server.documents.texts.get(&path).and_then(formatting)
}

fn hinted(server: &Server, params: InlayHintParams) -> Option<Vec<InlayHint>> {
    let asked = asked(server, &params.text_document)?;
    let within = asked.text.offset(params.range.start)..asked.text.offset(params.range.end);
    let hints = hints(asked.analysis, &asked.path, within).into_iter();
    let shown = hints.map(|hint| InlayHint {
        position: asked.text.position(hint.at),
        label: InlayHintLabel::String(format!("= {}", hint.value)),
        kind: Some(InlayHintKind::TYPE),
        text_edits: None,
        tooltip: (!hint.why.is_empty()).then_some(InlayHintTooltip::String(hint.why)),
        padding_left: Some(true),
        padding_right: None,
        data: None,
    });
    Some(shown.collect())
}

fn coloured(server: &Server, params: SemanticTokensParams) -> Option<SemanticTokens> {
    let asked = asked(server, &params.text_document)?;
    let (_, ast) = asked.analysis.file(&asked.path)?;
    Some(SemanticTokens {
        result_id: None,
        data: semantic_tokens(ast, asked.analysis.study.operations, asked.text),
    })
}
