//! A fresh program compared with the files of an earlier run, as text.
//!
//! Unlike `vcutc verify`, which asks what a controller would do, this asks whether a repository holds the very bytes that a
//! job gives today. Nothing is read or written here: the caller passes the bytes of the files.

pub mod align;
pub mod family;
pub mod text;

pub use text::{Hunk, Line, LineKind, TextChange};

/// What became of one file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Change {
    /// Its text differs.
    Text(TextChange),
    /// Only its line ends differ, or the break after its last line.
    LineEnds {
        /// Lines that end in CR LF in the earlier file.
        earlier_crlf: usize,
        /// Lines that end in CR LF in the fresh one.
        fresh_crlf: usize,
    },
    /// The folder has no such file.
    Missing,
    /// The folder has it from an earlier run, and the program has it no more.
    Stale,
}

/// A file that is not as the job gives it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FileChange {
    /// Its name in the folder.
    pub name: String,
    /// What differs.
    pub change: Change,
}

/// A file of a fresh program with the bytes of the earlier one.
#[derive(Clone, Copy, Debug)]
pub struct Sides<'a> {
    /// The earlier bytes, if there is such a file.
    pub earlier: Option<&'a [u8]>,
    /// The fresh bytes.
    pub fresh: &'a [u8],
}

/// What sets a file apart from its earlier version; none when nothing does.
///
/// `about` says what the bytes at a place of the fresh file do, in a few words.
#[must_use]
pub fn compare(
    sides: Sides<'_>,
    about: &dyn Fn(core::ops::Range<usize>) -> Option<String>,
) -> Option<Change> {
    match sides.earlier {
        None => Some(Change::Missing),
        Some(earlier) if earlier == sides.fresh => None,
        Some(earlier) => Some(text::change(earlier, sides.fresh, about)),
    }
}
