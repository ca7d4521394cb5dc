//! Where programs go: a folder, or standard output. All files or none.
//!
//! A [`Folder`] writes every file under a passing name beside its place and renames them all once the last byte of the
//! last one is on the disk. What it guarantees:
//!
//! * A run that fails before the renames (a full disk, a fault in the backend) changes nothing.
//! * A file that has the very bytes already is left alone, so that its time of change stays.
//! * Each rename is atomic: a reader sees the old file or the new one, whole.
//! * When a rename fails, the files renamed before it get their earlier versions back, and those that had none are
//!   removed. Should even that fail, the message names the copy that holds the earlier version.
//! * It does not guarantee that several files change in the same instant (no file system does): a power cut between two
//!   renames can leave a new file beside an old one, and a killed run can leave `.vcutc-*` files behind.

use super::os_words::os_words;
use std::fs::{self, File, Permissions};
use std::io::{self, BufRead, BufReader, BufWriter, Read, Seek, Write};
use std::path::{Path, PathBuf};
use tempfile::{Builder, NamedTempFile, SpooledTempFile, TempPath};
use vcutc_backend_api::bundle::{Sink, SinkError};

/// Programs up to this size wait in memory for their way to standard output, in bytes.
const SPOOL_IN_MEMORY: usize = 8 << 20;
/// How many bytes of two files are compared at once.
const COMPARED_AT_ONCE: usize = 1 << 16;

/// Where files go.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Destination {
    /// Into a folder.
    Folder(PathBuf),
    /// To standard output.
    Stdout(Headings),
}

/// Whether files on standard output are headed by a line `; file: NAME`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Headings {
    Shown,
    /// They are not: there is one file only, and its format is not ours to add to.
    Omitted,
}

/// What became of a file, by its path as people see it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Placed {
    /// It is new, or has other bytes than before.
    Written(String),
    /// It took the place of a program of another job.
    Replaced {
        path: String,
        /// The job whose program was there, as the head of that says it.
        job: String,
    },
    /// It had these bytes already and was left alone, with the time of its last change.
    Unchanged(String),
}

impl Placed {
    pub(super) fn path(&self) -> &str {
        match self {
            Self::Written(path) | Self::Replaced { path, .. } | Self::Unchanged(path) => path,
        }
    }

    /// Whether its bytes are new.
    pub(super) const fn is_new(&self) -> bool {
        match self {
            Self::Written(_) | Self::Replaced { .. } => true,
            Self::Unchanged(_) => false,
        }
    }

    /// The job whose program it replaced.
    pub(super) fn replaced(&self) -> Option<&str> {
        match self {
            Self::Replaced { job, .. } => Some(job),
            Self::Written(_) | Self::Unchanged(_) => None,
        }
    }
}

/// Files on their way.
pub(super) enum Output {
    /// Into a folder.
    Folder(Folder),
    /// To standard output.
    Stdout(Spool),
}

impl Output {
    /// Files on their way to a destination. A folder that does not exist is made for the first file.
    pub(super) fn to(destination: &Destination) -> Self {
        match destination {
            Destination::Folder(folder) => Self::Folder(Folder::new(folder)),
            Destination::Stdout(headings) => Self::Stdout(Spool::new(*headings)),
        }
    }

    /// Lets the files appear, all of them or none. Returns what became of each; standard output has none.
    pub(super) fn publish(self) -> Result<Vec<Placed>, String> {
        match self {
            Self::Folder(folder) => folder.publish(),
            Self::Stdout(spool) => spool.publish().map(|()| Vec::new()),
        }
    }
}

/// Writes one file whole or not at all, by its path. Returns what became of it.
pub(super) fn one_file(path: &Path, bytes: &[u8]) -> Result<Vec<Placed>, String> {
    let name = path
        .file_name()
        .and_then(|name| name.to_str())
        .ok_or_else(|| format!("{} is not a name for a file", path.display()))?;
    let folder = match path.parent() {
        Some(parent) if parent != Path::new("") => parent.to_owned(),
        Some(_) | None => PathBuf::from("."),
    };
    let mut output = Output::to(&Destination::Folder(folder));
    output.file(name).map_err(|error| error.to_string())?;
    output.write(bytes).map_err(|error| error.to_string())?;
    output.publish()
}

/// Replaces the text of a file that is there, whole or not at all. It keeps its permissions, and a link to it stays a link.
pub(super) fn rewrite(path: &Path, bytes: &[u8]) -> Result<(), String> {
    let in_words = |error: io::Error| os_words(&error);
    let path = fs::canonicalize(path).map_err(in_words)?;
    let permissions = fs::metadata(&path).map_err(in_words)?.permissions();
    if permissions.readonly() {
        return Err("it is write-protected: change its permissions first".to_owned());
    }
    let folder = path.parent().ok_or("it has no folder")?;
    let mut file = passing_file(folder).map_err(in_words)?;
    file.write_all(bytes).map_err(in_words)?;
    file.as_file().set_permissions(permissions).map_err(in_words)?;
    file.as_file().sync_all().map_err(in_words)?;
    file.persist(&path).map_err(|error| in_words(error.error))?;
    Ok(())
}

impl Sink for Output {
    fn file(&mut self, name: &str) -> Result<(), SinkError> {
        match self {
            Self::Folder(folder) => folder.start(name),
            Self::Stdout(spool) => spool.start(name),
        }
        .map_err(SinkError)
    }

    fn write(&mut self, bytes: &[u8]) -> Result<(), SinkError> {
        match self {
            Self::Folder(folder) => folder.append(bytes),
            Self::Stdout(spool) => spool.append(bytes),
        }
        .map_err(SinkError)
    }
}

/// Files on their way into a folder.
pub(super) struct Folder {
    path: PathBuf,
    current: Option<(String, BufWriter<NamedTempFile>)>,
    complete: Vec<Staged>,
}

/// A complete file under its passing name.
struct Staged {
    name: String,
    passing: TempPath,
}

/// A file that has taken its place, and the version before it.
struct Published {
    path: PathBuf,
    earlier: Option<TempPath>,
}

impl Folder {
    fn new(path: &Path) -> Self {
        Self {
            path: path.to_owned(),
            current: None,
            complete: Vec::new(),
        }
    }

    fn start(&mut self, name: &str) -> Result<(), String> {
        self.finish_current()?;
        if !is_plain_file_name(name) {
            return Err(format!("{name:?} is not a plain file name"));
        }
        // Some file systems take RIB.SRC and rib.src for the same.
        if self
            .complete
            .iter()
            .any(|file| file.name.eq_ignore_ascii_case(name))
        {
            return Err(format!("file {name} is written twice"));
        }
        let file = fs::create_dir_all(&self.path)
            .and_then(|()| passing_file(&self.path))
            .map_err(|error| self.refused(&error))?;
        self.current = Some((name.to_owned(), BufWriter::new(file)));
        Ok(())
    }

    fn refused(&self, error: &io::Error) -> String {
        let folder = self.path.display();
        if self.path.is_file() {
            format!("cannot write into {folder}: it is a file, not a folder")
        } else {
            format!("cannot write into {folder}: {}", os_words(error))
        }
    }

    fn append(&mut self, bytes: &[u8]) -> Result<(), String> {
        match &mut self.current {
            Some((name, writer)) => writer
                .write_all(bytes)
                .map_err(|error| format!("cannot write {name}: {}", os_words(&error))),
            None => Err("bytes before the first file".to_owned()),
        }
    }

    fn finish_current(&mut self) -> Result<(), String> {
        let Some((name, writer)) = self.current.take() else {
            return Ok(());
        };
        let failed = |error: io::Error| format!("cannot write {name}: {}", os_words(&error));
        let file = writer.into_inner().map_err(|error| failed(error.into_error()))?;
        file.as_file().sync_all().map_err(failed)?;
        self.complete.push(Staged {
            passing: file.into_temp_path(),
            name,
        });
        Ok(())
    }

    fn publish(mut self) -> Result<Vec<Placed>, String> {
        self.finish_current()?;
        let mut published = Vec::with_capacity(self.complete.len());
        let mut placed = Vec::with_capacity(self.complete.len());
        for staged in self.complete {
            let path = self.path.join(&staged.name);
            let shown = path.display().to_string();
            // One that cannot be compared is replaced.
            if same_bytes(&path, &staged.passing).unwrap_or(false) {
                placed.push(Placed::Unchanged(shown));
                continue;
            }
            placed.push(match (owner(&path), owner(&staged.passing)) {
                (Some(job), Some(other)) if job != other => Placed::Replaced { path: shown, job },
                (_, _) => Placed::Written(shown),
            });
            match replace(&path, staged.passing) {
                Ok(file) => published.push(file),
                Err(reason) => return Err(take_back(published, reason)),
            }
        }
        Ok(placed)
    }
}

/// How much of a program is looked at for the name of its job, in bytes: its head has it.
const HEAD: u64 = 4096;

/// The job that a program was written for, as its head says it; none where the file is something else.
fn owner(path: &Path) -> Option<String> {
    let is_file = fs::symlink_metadata(path).is_ok_and(|file| file.is_file());
    let mut head = Vec::new();
    File::open(path)
        .ok()
        .filter(|_| is_file)?
        .take(HEAD)
        .read_to_end(&mut head)
        .ok()?;
    String::from_utf8_lossy(&head)
        .lines()
        .find_map(owner_in)
        .map(str::to_owned)
}

/// The job's name in a line `; job NAME`, in the comments of whatever language.
fn owner_in(line: &str) -> Option<&str> {
    let (_, comment) = line.split_once([';', '!', '('])?;
    let comment = comment.trim_start().trim_end().trim_end_matches(')');
    let (word, name) = comment.split_once(' ')?;
    let is_hash = name.len() > 5
        && name
            .get(..5)
            .is_some_and(|start| start.eq_ignore_ascii_case("hash "));
    (word.eq_ignore_ascii_case("job") && !is_hash).then_some(name)
}

/// Whether two files hold the same bytes.
fn same_bytes(one: &Path, other: &Path) -> io::Result<bool> {
    let (first, second) = (fs::symlink_metadata(one)?, fs::metadata(other)?);
    if !first.is_file() || first.len() != second.len() {
        return Ok(false);
    }
    let [mut one, mut other] = [
        BufReader::with_capacity(COMPARED_AT_ONCE, File::open(one)?),
        BufReader::with_capacity(COMPARED_AT_ONCE, File::open(other)?),
    ];
    loop {
        let (left, right) = (one.fill_buf()?, other.fill_buf()?);
        let length = left.len().min(right.len());
        if length == 0 {
            return Ok(left.len() == right.len());
        }
        if left.get(..length) != right.get(..length) {
            return Ok(false);
        }
        one.consume(length);
        other.consume(length);
    }
}

/// Puts a complete file in its place, keeping the version before it.
fn replace(path: &Path, passing: TempPath) -> Result<Published, String> {
    let failed = |error: io::Error| format!("cannot write {}: {}", path.display(), os_words(&error));
    let earlier = keep_earlier(path).map_err(failed)?;
    passing.persist(path).map_err(|error| failed(error.error))?;
    Ok(Published {
        path: path.to_owned(),
        earlier,
    })
}

/// A second name for the version that is there now, so that it can be put back: a hard link where the file system has
/// them, else a copy. The file itself stays in its place all the while.
fn keep_earlier(path: &Path) -> io::Result<Option<TempPath>> {
    match fs::symlink_metadata(path) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
        Err(error) => return Err(error),
        Ok(metadata) if metadata.is_file() || metadata.is_symlink() => {}
        Ok(_) => return Err(io::Error::other("something that is not a file has this name")),
    }
    let folder = path.parent().unwrap_or(Path::new(""));
    let mut builder = Builder::new();
    builder.prefix(".vcutc-earlier-");
    if let Ok(link) = builder.make_in(folder, |name| fs::hard_link(path, name)) {
        return Ok(Some(link.into_temp_path()));
    }
    let copy = builder.tempfile_in(folder)?.into_temp_path();
    fs::copy(path, &copy)?;
    Ok(Some(copy))
}

/// Undoes renames after one has failed; returns what to report.
fn take_back(published: Vec<Published>, reason: String) -> String {
    let mut message = reason;
    for Published { path, earlier } in published.into_iter().rev() {
        match earlier {
            None => {
                if let Err(error) = fs::remove_file(&path) {
                    message += &format!(
                        "; {} is new and could not be removed: {}",
                        path.display(),
                        os_words(&error)
                    );
                }
            }
            Some(earlier) => {
                if let Err(failure) = earlier.persist(&path) {
                    message += &left_behind(&path, failure.path);
                }
            }
        }
    }
    message
}

fn left_behind(path: &Path, earlier: TempPath) -> String {
    let place = earlier.to_path_buf();
    match earlier.keep() {
        Ok(kept) => format!(
            "; {} is new, its earlier version is {}",
            path.display(),
            kept.display()
        ),
        Err(error) => format!(
            "; {} is new, its earlier version may be in {}: {error}",
            path.display(),
            place.display()
        ),
    }
}

/// A file that others may read, as the user's umask allows (temporary files are private otherwise).
fn passing_file(folder: &Path) -> io::Result<NamedTempFile> {
    let mut builder = Builder::new();
    builder.prefix(".vcutc-");
    if let Some(permissions) = ordinary_permissions() {
        builder.permissions(permissions);
    }
    builder.tempfile_in(folder)
}

#[cfg(unix)]
#[allow(clippy::unnecessary_wraps, reason = "other platforms have none")]
fn ordinary_permissions() -> Option<Permissions> {
    use std::os::unix::fs::PermissionsExt;
    Some(Permissions::from_mode(0o666))
}

#[cfg(not(unix))]
fn ordinary_permissions() -> Option<Permissions> {
    None
}

fn is_plain_file_name(name: &str) -> bool {
    let is_special = matches!(name, "" | "." | "..");
    !is_special && !name.contains(['/', '\\', ':', '\0'])
}

/// Files on their way to standard output, held back until all are complete.
pub(super) struct Spool {
    headings: Headings,
    content: SpooledTempFile,
    has_file: bool,
}

impl Spool {
    fn new(headings: Headings) -> Self {
        Self {
            headings,
            content: SpooledTempFile::new(SPOOL_IN_MEMORY),
            has_file: false,
        }
    }

    fn start(&mut self, name: &str) -> Result<(), String> {
        self.has_file = true;
        match self.headings {
            Headings::Shown => self.append(format!("; file: {name}\n").as_bytes()),
            Headings::Omitted => Ok(()),
        }
    }

    fn append(&mut self, bytes: &[u8]) -> Result<(), String> {
        if !self.has_file {
            return Err("bytes before the first file".to_owned());
        }
        self.content
            .write_all(bytes)
            .map_err(|error| format!("cannot hold the output: {}", os_words(&error)))
    }

    fn publish(mut self) -> Result<(), String> {
        let mut stdout = io::stdout().lock();
        let copied = self
            .content
            .rewind()
            .and_then(|()| io::copy(&mut self.content, &mut stdout))
            .and_then(|_| stdout.flush());
        ignore_broken_pipe(copied)
            .map_err(|error| format!("cannot write to standard output: {}", os_words(&error)))
    }
}

/// A reader that has seen enough is not an error.
pub(super) fn ignore_broken_pipe(result: io::Result<()>) -> io::Result<()> {
    match result {
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
        other => other,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn folder_with(path: &Path, files: &[(&str, &str)]) -> Folder {
        let mut folder = Folder::new(path);
        for (name, text) in files {
            folder.start(name).unwrap();
            folder.append(text.as_bytes()).unwrap();
        }
        folder
    }

    fn names(path: &Path) -> Vec<String> {
        let mut names: Vec<_> = fs::read_dir(path)
            .unwrap()
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    }

    #[test]
    fn files_appear_only_when_published() {
        let root = tempfile::tempdir().unwrap();
        let path = root.path().join("new/deep");
        let folder = folder_with(&path, &[("a.src", "A"), ("a.dat", "D")]);
        assert!(names(&path).iter().all(|name| name.starts_with(".vcutc-")));
        let written = folder.publish().unwrap();
        assert_eq!(written.len(), 2);
        assert_eq!(names(&path), ["a.dat", "a.src"]);
        assert_eq!(fs::read_to_string(path.join("a.src")).unwrap(), "A");
    }

    #[test]
    fn a_dropped_folder_leaves_nothing() {
        let root = tempfile::tempdir().unwrap();
        fs::write(root.path().join("a.src"), "old").unwrap();
        drop(folder_with(root.path(), &[("a.src", "new"), ("b.src", "new")]));
        assert_eq!(names(root.path()), ["a.src"]);
        assert_eq!(fs::read_to_string(root.path().join("a.src")).unwrap(), "old");
    }

    #[test]
    fn a_failing_rename_takes_the_ones_before_it_back() {
        let root = tempfile::tempdir().unwrap();
        fs::write(root.path().join("a.src"), "old").unwrap();
        // A folder of that name stands in the way of the third file.
        fs::create_dir(root.path().join("c.src")).unwrap();
        let folder = folder_with(
            root.path(),
            &[("a.src", "new"), ("b.src", "new"), ("c.src", "new")],
        );
        let message = folder.publish().unwrap_err();
        assert!(message.contains("c.src"), "{message}");
        assert_eq!(names(root.path()), ["a.src", "c.src"]);
        assert_eq!(fs::read_to_string(root.path().join("a.src")).unwrap(), "old");
    }

    #[test]
    fn earlier_versions_are_replaced_without_a_trace() {
        let root = tempfile::tempdir().unwrap();
        fs::write(root.path().join("a.src"), "old").unwrap();
        folder_with(root.path(), &[("a.src", "new")]).publish().unwrap();
        assert_eq!(names(root.path()), ["a.src"]);
        assert_eq!(fs::read_to_string(root.path().join("a.src")).unwrap(), "new");
    }

    #[test]
    fn names_that_leave_the_folder_are_refused() {
        let root = tempfile::tempdir().unwrap();
        let mut folder = Folder::new(root.path());
        for name in ["", ".", "..", "../a", "a/b", "/a", "a\\b", "C:a", "a\0b"] {
            assert!(folder.start(name).is_err(), "{name:?}");
        }
    }

    #[test]
    fn a_name_is_taken_once_whatever_its_case() {
        let root = tempfile::tempdir().unwrap();
        let mut folder = folder_with(root.path(), &[("rib.src", "")]);
        assert!(folder.start("RIB.SRC").is_err());
        assert!(folder.start("rib.src").is_err());
    }

    #[cfg(unix)]
    #[test]
    fn files_are_as_readable_as_any_other_file_of_the_user() {
        use std::os::unix::fs::PermissionsExt;
        let root = tempfile::tempdir().unwrap();
        fs::write(root.path().join("ordinary"), "").unwrap();
        folder_with(root.path(), &[("a.src", "")]).publish().unwrap();
        let mode = |name: &str| fs::metadata(root.path().join(name)).unwrap().permissions().mode();
        assert_eq!(mode("a.src"), mode("ordinary"));
    }
}
