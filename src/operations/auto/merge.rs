//! What blocks share, with what else one of them says.

use vcutc_syntax::ast::{Block, Entry, HeadPart, Relation};

/// What an entry is about. Two entries of one block that are about the same exclude each other.
#[derive(PartialEq)]
enum About<'e> {
    Field(&'e str),
    AtMost(&'e str),
    AtLeast(&'e str),
    Block(&'e str),
}

fn about(entry: &Entry) -> Option<About<'_>> {
    match entry {
        Entry::Field { name, .. } => Some(About::Field(&name.node)),
        Entry::Limit { name, relation, .. } => Some(match relation.node {
            Relation::AtMost => About::AtMost(&name.node),
            Relation::AtLeast => About::AtLeast(&name.node),
        }),
        Entry::Block(block) => Some(About::Block(word(block)?)),
        Entry::Formula { .. }
        | Entry::Curve { .. }
        | Entry::Row { .. }
        | Entry::ControlRow { .. }
        | Entry::SurfaceFile { .. }
        | Entry::Station { .. } => None,
    }
}

/// The word of a block with one.
fn word(block: &Block) -> Option<&str> {
    match block.head.as_slice() {
        [head] => match &head.node {
            HeadPart::Word(word) => Some(word),
            HeadPart::Text(_) | HeadPart::Equals => None,
        },
        _ => None,
    }
}

/// Whether an entry is a block with one of these words.
pub(crate) fn is_block(entry: &Entry, words: &[&str]) -> bool {
    match entry {
        Entry::Block(block) => word(block).is_some_and(|word| words.contains(&word)),
        Entry::Field { .. }
        | Entry::Limit { .. }
        | Entry::Formula { .. }
        | Entry::Curve { .. }
        | Entry::Row { .. }
        | Entry::ControlRow { .. }
        | Entry::SurfaceFile { .. }
        | Entry::Station { .. } => false,
    }
}

/// What is shared, with entries of one's own: these replace what is about the same, and blocks have the entries of both.
pub(crate) fn with(shared: &[Entry], own: &[Entry]) -> Vec<Entry> {
    let is_own = |entry: &Entry| {
        let what = about(entry);
        what.is_some() && own.iter().any(|own| about(own) == what)
    };
    let rest = shared.iter().filter(|entry| !is_own(entry));
    rest.cloned()
        .chain(own.iter().map(|own| joined(shared, own)))
        .collect()
}

/// An entry of one's own; a block with what the shared one of its name says.
fn joined(shared: &[Entry], own: &Entry) -> Entry {
    let Entry::Block(own) = own else {
        return own.clone();
    };
    let shared = shared.iter().find_map(|entry| match entry {
        Entry::Block(block) if word(block).is_some() && word(block) == word(own) => Some(block),
        _ => None,
    });
    let mut block = own.clone();
    if let Some(shared) = shared {
        block.entries = with(&shared.entries, &own.entries);
    }
    Entry::Block(block)
}
