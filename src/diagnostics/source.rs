//! Source texts and places in them.
//!
//! Files are asked of a [`Loader`], so that the compiler itself never touches a disk. Every text that a diagnostic
//! can point into is a file of the [`SourceMap`], also texts that are not files, such as a `--set` of the command line.

use std::fmt;
use std::ops::Range;

/// Number of a file in its [`SourceMap`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct FileId(u32);

impl FileId {
    /// Of a text that is read by itself, such as a sheet of the catalogue: the first file of its source map.
    pub const ALONE: Self = Self(0);
}

/// A stretch of bytes in a file.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Span {
    pub file: FileId,
    /// First byte.
    pub start: u32,
    /// One past the last byte.
    pub end: u32,
}

impl Span {
    /// The stretch of these bytes. Files are far smaller than 4 GB ([`LARGEST_FILE`]); an offset beyond is cut off.
    #[must_use]
    pub fn of_bytes(file: FileId, range: Range<usize>) -> Self {
        let offset = |at: usize| u32::try_from(at).unwrap_or(u32::MAX);
        Self {
            file,
            start: offset(range.start),
            end: offset(range.end),
        }
    }

    /// The bytes, for slicing a text.
    #[must_use]
    pub const fn bytes(self) -> Range<usize> {
        self.start as usize..self.end as usize
    }

    /// The stretch from the start of this one to the end of `last` (which lies in the same file).
    #[must_use]
    pub fn to(self, last: Self) -> Self {
        Self {
            end: last.end.max(self.end),
            ..self
        }
    }

    /// The empty stretch right before this one.
    #[must_use]
    pub const fn before(self) -> Self {
        Self {
            end: self.start,
            ..self
        }
    }

    /// The empty stretch after this one.
    #[must_use]
    pub const fn after(self) -> Self {
        Self {
            start: self.end,
            ..self
        }
    }
}

/// `3..9`: trees are full of spans, and on several lines each they would drown what people look for. The file of a tree is
/// known from where the tree came from.
impl fmt::Debug for Span {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}..{}", self.start, self.end)
    }
}

/// Something with its place.
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct Spanned<T> {
    pub node: T,
    pub span: Span,
}

impl<T> Spanned<T> {
    /// A thing at a place.
    #[must_use]
    pub const fn new(node: T, span: Span) -> Self {
        Self { node, span }
    }

    /// Another thing at the same place.
    #[must_use]
    pub fn map<U>(self, f: impl FnOnce(T) -> U) -> Spanned<U> {
        Spanned {
            node: f(self.node),
            span: self.span,
        }
    }
}

/// The thing, then ` @3..9`.
impl<T: fmt::Debug> fmt::Debug for Spanned<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.node.fmt(f)?;
        write!(f, " @{:?}", self.span)
    }
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SourceFile {
    /// The name people see, such as `shop/blades.vcut` or `--set width=90mm`.
    pub name: String,
    pub text: String,
}

/// All source texts of a run.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct SourceMap {
    files: Vec<SourceFile>,
}

impl SourceMap {
    /// Adds a text; the name need not be new.
    pub fn add(&mut self, name: impl Into<String>, text: impl Into<String>) -> FileId {
        let id = FileId(u32::try_from(self.files.len()).unwrap_or(u32::MAX));
        self.files.push(SourceFile {
            name: name.into(),
            text: text.into(),
        });
        id
    }

    /// The text of an id of this map.
    #[must_use]
    pub fn get(&self, id: FileId) -> Option<&SourceFile> {
        self.files.get(id.0 as usize)
    }

    /// All files in the order they were added.
    pub fn iter(&self) -> impl Iterator<Item = (FileId, &SourceFile)> {
        (0..).map(FileId).zip(&self.files)
    }

    /// The name of a file; empty for an id of another map.
    #[must_use]
    pub fn name(&self, id: FileId) -> &str {
        self.get(id).map_or("", |file| &file.name)
    }

    /// The text of a span; empty when it does not fit the file.
    #[must_use]
    pub fn slice(&self, span: Span) -> &str {
        let text = self.get(span.file).map_or("", |file| file.text.as_str());
        text.get(span.start as usize..span.end as usize)
            .unwrap_or_default()
    }
}

/// Gives the compiler the bytes at a path.
pub trait Loader {
    /// The bytes of a file. `path` uses `/`, is free of `.` and inner `..`, and is relative to wherever the root job's
    /// own path is relative to.
    ///
    /// # Errors
    /// Why not, in the words of the loader.
    fn load(&self, path: &str) -> Result<Vec<u8>, LoadError>;

    /// As [`Self::load`], for a file of data that may have this many bytes.
    ///
    /// # Errors
    /// As for [`Self::load`]. The loader may have a lower limit.
    fn load_data(&self, path: &str, most: u64) -> Result<Vec<u8>, LoadError> {
        let bytes = self.load(path)?;
        match bytes.len() as u64 <= most {
            true => Ok(bytes),
            false => Err(LoadError::TooLarge(most)),
        }
    }

    /// What is in a folder, for help with a path that leads nowhere and for editors; nothing where that is not known. The path is
    /// as for files; that of the folder that they are relative to is empty.
    fn list(&self, folder: &str) -> Vec<Entry> {
        let _ = folder;
        Vec::new()
    }
}

/// Something in a folder, by its name there.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Entry {
    Folder(String),
    File(String),
}

/// What is in a folder when these are the paths of all files there are.
pub fn entries_among<'p>(paths: impl IntoIterator<Item = &'p str>, folder: &str) -> Vec<Entry> {
    let mut found: Vec<Entry> = paths
        .into_iter()
        .filter_map(|path| match (folder, path.strip_prefix(folder)?) {
            ("" | "/", rest) => Some(rest),
            (_, rest) => rest.strip_prefix('/'),
        })
        .map(|rest| match rest.split_once('/') {
            Some((folder, _)) => Entry::Folder(folder.to_owned()),
            None => Entry::File(rest.to_owned()),
        })
        .collect();
    found.sort();
    found.dedup();
    found
}

/// Why a file could not be had.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum LoadError {
    /// There is none of that name.
    NotFound,
    /// It is larger than the compiler reads; the limit in bytes.
    TooLarge(u64),
    /// Anything else, in words.
    Other(String),
}

impl fmt::Display for LoadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotFound => f.write_str("there is no such file"),
            Self::TooLarge(limit) => write!(f, "it is larger than {limit} bytes"),
            Self::Other(reason) => f.write_str(reason),
        }
    }
}

/// Largest source file that is read, in bytes: a job of this size would have over a million lines.
pub const LARGEST_FILE: u64 = 64 << 20;

/// Largest file of triangles that is read, in bytes.
pub const LARGEST_MESH_FILE: u64 = 1 << 30;

/// The text that a file's bytes are.
///
/// A byte order mark stays in the text, so that byte offsets are those of the file; the parser passes over it.
///
/// # Errors
/// The number of bytes before the first that is not UTF-8.
pub fn text_from_bytes(bytes: Vec<u8>) -> Result<String, usize> {
    String::from_utf8(bytes).map_err(|error| error.utf8_error().valid_up_to())
}

/// The path that `target`, written in the file `from`, means: relative to that file's folder, with `.` and `..`
/// resolved where they can be.
#[must_use]
pub fn join_path(from: &str, target: &str) -> String {
    let folder = from.rsplit_once('/').map_or("", |(folder, _)| folder);
    let is_absolute = target.starts_with('/');
    let mut parts: Vec<&str> = Vec::new();
    let base = if is_absolute { "" } else { folder };
    for part in base.split('/').chain(target.split('/')) {
        match part {
            "" | "." => {}
            ".." if parts.last().is_some_and(|&last| last != "..") => {
                parts.pop();
            }
            _ => parts.push(part),
        }
    }
    let root = if is_absolute || folder.starts_with('/') {
        "/"
    } else {
        ""
    };
    format!("{root}{}", parts.join("/"))
}

/// How a file is named in the file `from`: the other way round of [`join_path`]. None where that takes the
/// name of a folder that is not known.
#[must_use]
pub fn path_from(from: &str, target: &str) -> Option<String> {
    let folder = from.rsplit_once('/').map_or("", |(folder, _)| folder);
    let is_absolute = target.starts_with('/');
    if from.starts_with('/') != is_absolute {
        return is_absolute.then(|| target.to_owned());
    }
    let parts = |path| str::split(path, '/').filter(|part| !part.is_empty());
    let same = |(one, other): &(&str, &str)| one == other;
    let shared = parts(folder).zip(parts(target)).take_while(same).count();
    let up = parts(folder).skip(shared);
    if up.clone().any(|part| part == "..") {
        return None;
    }
    let up = up.map(|_| "..");
    Some(up.chain(parts(target).skip(shared)).collect::<Vec<_>>().join("/"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_lead_back_to_what_they_were_made_from() {
        for (from, target, named) in [
            ("rib.vcut", "heights.csv", "heights.csv"),
            ("jobs/rib.vcut", "jobs/shop/blades.vcut", "shop/blades.vcut"),
            ("jobs/rib.vcut", "shop/blades.vcut", "../shop/blades.vcut"),
            ("/a/b/rib.vcut", "/a/c/d.csv", "../c/d.csv"),
            ("/a/b/rib.vcut", "/a/b/d.csv", "d.csv"),
            ("a/rib.vcut", "/b.vcut", "/b.vcut"),
            ("../jobs/rib.vcut", "../data/d.csv", "../data/d.csv"),
        ] {
            assert_eq!(path_from(from, target).as_deref(), Some(named));
            assert_eq!(join_path(from, named), target);
        }
        assert_eq!(path_from("../rib.vcut", "data/d.csv"), None);
    }

    #[test]
    fn folders_hold_what_begins_with_their_path() {
        let paths = ["a/b.csv", "a/c/d.csv", "a/c/e.csv", "ab.csv", "/x/y"];
        let file = |name: &str| Entry::File(name.to_owned());
        let folder = |name: &str| Entry::Folder(name.to_owned());
        assert_eq!(entries_among(paths, "a"), [folder("c"), file("b.csv")]);
        assert_eq!(entries_among(paths, "a/c"), [file("d.csv"), file("e.csv")]);
        assert_eq!(entries_among(paths, "/x"), [file("y")]);
        assert_eq!(entries_among(paths, "/"), [folder("x")]);
        assert_eq!(entries_among(["a/b", "c"], ""), [folder("a"), file("c")]);
    }

    #[test]
    fn paths_are_relative_to_the_file_that_names_them() {
        assert_eq!(
            join_path("jobs/rib.vcut", "shop/blades.vcut"),
            "jobs/shop/blades.vcut"
        );
        assert_eq!(
            join_path("jobs/rib.vcut", "../shop/blades.vcut"),
            "shop/blades.vcut"
        );
        assert_eq!(join_path("rib.vcut", "./blades.vcut"), "blades.vcut");
        assert_eq!(join_path("rib.vcut", "../blades.vcut"), "../blades.vcut");
        assert_eq!(join_path("/a/rib.vcut", "b.vcut"), "/a/b.vcut");
        assert_eq!(join_path("a/rib.vcut", "/b.vcut"), "/b.vcut");
    }
}
