//! Texts in TOML as people write them: read once, with all flaws at their places.

pub mod flaw;
pub mod table;

use flaw::Flaw;
use table::Table;
use toml::de::DeTable;

/// What a document is called in messages, and looks like.
#[derive(Clone, Copy, Debug)]
pub struct Wording {
    /// Its name, such as `sheet`.
    pub name: &'static str,
    /// What lines of it look like.
    pub looks: &'static str,
}

/// Largest document in bytes. Sheets of the catalogue are below 10 000.
pub const LARGEST: usize = 1 << 18;

/// Most flaws of one document that are told.
pub const MOST_FLAWS: usize = 20;

/// Reads a document.
///
/// # Errors
/// What is wrong with it, in the order of the text; the first [`MOST_FLAWS`] of it.
pub fn parse<T>(
    text: &str,
    wording: Wording,
    read: impl FnOnce(&Table<'_>, &mut Vec<Flaw>) -> Option<T>,
) -> Result<T, Vec<Flaw>> {
    if text.len() > LARGEST {
        return Err(vec![too_large(text.len(), wording)]);
    }
    let (root, errors) = DeTable::parse_recoverable(text);
    let mut flaws: Vec<Flaw> = errors
        .iter()
        .map(|error| unreadable(error, text, wording))
        .collect();
    // What could be read of a broken file would only add complaints about what seems to be missing.
    let document = if flaws.is_empty() {
        read(&Table::root(root.get_ref(), wording.name), &mut flaws)
    } else {
        None
    };
    match document {
        Some(document) if flaws.is_empty() => Ok(document),
        Some(_) | None => {
            flaws.sort_by_key(|flaw| (flaw.span.start, flaw.span.end));
            flaws.truncate(MOST_FLAWS);
            Err(flaws)
        }
    }
}

fn too_large(size: usize, wording: Wording) -> Flaw {
    let (size, most, name) = (size / 1000, LARGEST / 1000, wording.name);
    Flaw::new(
        0..0,
        format!("the {name} has {size} kB, at most {most} kB are read"),
        "too large",
    )
}

fn unreadable(error: &toml::de::Error, text: &str, wording: Wording) -> Flaw {
    let Wording { name, looks } = wording;
    let span = error.span().unwrap_or(0..0);
    let end = span.end.min(text.len());
    let reason = error.message().lines().next().unwrap_or_default();
    Flaw::new(
        span.start.min(end)..end,
        format!("the {name} is not TOML: {reason}"),
        "cannot be read",
    )
    .help(format!("a {name} has lines such as {looks}"))
}
