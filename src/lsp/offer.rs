//! What can be written at a cursor, one by one.

use lsp_types::CompletionItemKind;

/// Something that can be written.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Offer {
    /// What it is called in the list.
    pub(super) label: String,
    /// What kind of thing it is.
    pub(super) kind: CompletionItemKind,
    /// What is written. `$1` and `${1:...}` are places to go on at, as in the protocol's snippets.
    pub(super) snippet: String,
    /// A few words beside the label.
    pub(super) detail: String,
    /// Markdown.
    pub(super) documentation: Option<String>,
    /// Which offers come first.
    pub(super) rank: Rank,
}

/// Which offers come first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Rank {
    /// What must be there.
    Needed,
    /// What fits best.
    Fitting,
    /// Everything else.
    Possible,
}

/// A text in which `$`, `}` and `\` mean themselves.
pub(super) fn verbatim(text: &str) -> String {
    text.replace('\\', "\\\\").replace('$', "\\$").replace('}', "\\}")
}

/// An offer of a word as it is.
pub(super) fn offer(label: &str, kind: CompletionItemKind, rank: Rank) -> Offer {
    Offer {
        label: label.to_owned(),
        kind,
        snippet: verbatim(label),
        detail: String::new(),
        documentation: None,
        rank,
    }
}
