//! Texts in TOML as people write them: read once, with all faults at their places.

pub mod table;

use crate::source::{FileId, Span};
use crate::{Code, Diagnostic};
use table::Table;
use toml::de::DeTable;

/// A kind of document, for messages.
#[derive(Clone, Copy, Debug)]
pub struct Wording {
    /// Its name, such as `sheet`.
    pub name: &'static str,
    /// What lines of it look like.
    pub looks: &'static str,
    /// The code of its faults.
    pub code: Code,
}

/// Largest document in bytes. Sheets of the catalogue are below 10 000.
pub const LARGEST: usize = 1 << 18;

/// Most faults of one document that are reported.
pub const MOST_FAULTS: usize = 20;

/// Reads a document.
///
/// # Errors
/// What is wrong with it, in the order of the text; the first [`MOST_FAULTS`] of it.
pub fn parse<T>(
    file: FileId,
    text: &str,
    wording: Wording,
    read: impl FnOnce(Table<'_>, &mut Vec<Diagnostic>) -> Option<T>,
) -> Result<T, Vec<Diagnostic>> {
    if text.len() > LARGEST {
        return Err(vec![too_large(file, text.len(), wording)]);
    }
    let (root, errors) = DeTable::parse_recoverable(text);
    let mut faults: Vec<Diagnostic> = errors
        .iter()
        .map(|error| unreadable(error, file, text, wording))
        .collect();
    // What could be read of a broken file would only add messages about what seems to be missing.
    let document = if faults.is_empty() {
        read(Table::root(root.get_ref(), file, wording), &mut faults)
    } else {
        None
    };
    match document {
        Some(document) if faults.is_empty() => Ok(document),
        Some(_) | None => {
            faults.sort_by_key(|fault| fault.primary.span);
            faults.truncate(MOST_FAULTS);
            Err(faults)
        }
    }
}

fn too_large(file: FileId, size: usize, wording: Wording) -> Diagnostic {
    let (size, most, name) = (size / 1000, LARGEST / 1000, wording.name);
    Diagnostic::new(
        wording.code,
        format!("the {name} has {size} kB, at most {most} kB are read"),
        Span::of_bytes(file, 0..0),
        "too large",
    )
}

fn unreadable(error: &toml::de::Error, file: FileId, text: &str, wording: Wording) -> Diagnostic {
    let Wording { name, looks, code } = wording;
    let span = error.span().unwrap_or(0..0);
    let end = span.end.min(text.len());
    let reason = error.message().lines().next().unwrap_or_default();
    Diagnostic::new(
        code,
        format!("the {name} is not TOML: {reason}"),
        Span::of_bytes(file, span.start.min(end)..end),
        "cannot be read",
    )
    .help(format!("a {name} has lines such as {looks}"))
}
