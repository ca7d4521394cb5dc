//! Job files on the real file system.

use super::os_words::os_words;
use std::cell::RefCell;
use std::collections::BTreeSet;
use std::fs::{self, File, Metadata};
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use vcutc_diagnostics::source::{Entry, LARGEST_FILE, LoadError, Loader};
use vcutc_diagnostics::suggest::nearest;

/// How a job from standard input is called in messages.
const STDIN_NAME: &str = "<stdin>";

/// Files below the current folder, and the job itself when it came from standard input.
pub(super) struct Disk {
    job: String,
    from_stdin: Option<Result<Vec<u8>, LoadError>>,
    /// What was read so far.
    read: RefCell<BTreeSet<PathBuf>>,
}

impl Disk {
    /// The files around a job; `-` reads the job from standard input.
    pub(super) fn around(job: &str) -> Self {
        if job == "-" {
            Self {
                job: STDIN_NAME.to_owned(),
                from_stdin: Some(read_bounded(io::stdin().lock(), LARGEST_FILE)),
                read: RefCell::default(),
            }
        } else {
            Self {
                job: with_forward_slashes(job),
                from_stdin: None,
                read: RefCell::default(),
            }
        }
    }

    /// The job's path, as the compiler knows it and as people see it.
    pub(super) fn job(&self) -> &str {
        &self.job
    }

    /// Says that the job is made from a file that the compiler does not ask for.
    #[cfg(feature = "krl")]
    pub(super) fn is_made_from(&self, path: &Path) {
        self.read.borrow_mut().extend(fs::canonicalize(path));
    }

    /// Refuses to write over a file that the job was made from.
    pub(super) fn spares(&self, path: &Path) -> Result<(), String> {
        // What is not there cannot be written over.
        match fs::canonicalize(path) {
            Ok(whole) if self.read.borrow().contains(&whole) => Err(format!(
                "{} is an input of the job: choose another name for the output",
                path.display()
            )),
            Ok(_) | Err(_) => Ok(()),
        }
    }
}

impl Loader for Disk {
    fn load(&self, path: &str) -> Result<Vec<u8>, LoadError> {
        match &self.from_stdin {
            Some(text) if path == STDIN_NAME => text.clone(),
            Some(_) | None => {
                if path == self.job
                    && let Some(why) = no_job(path)
                {
                    return Err(LoadError::Other(why));
                }
                let path = Path::new(path);
                self.read.borrow_mut().extend(fs::canonicalize(path));
                load_file(path)
            }
        }
    }

    fn load_data(&self, path: &str, most: u64) -> Result<Vec<u8>, LoadError> {
        let path = Path::new(path);
        self.read.borrow_mut().extend(fs::canonicalize(path));
        load_bounded(path, most)
    }

    fn list(&self, folder: &str) -> Vec<Entry> {
        list_folder(folder)
    }
}

/// Most entries of a folder that are looked at.
const MOST_ENTRIES: usize = 5000;

/// What is in a folder, without what is hidden; nothing of one that cannot be read.
pub(super) fn list_folder(folder: &str) -> Vec<Entry> {
    let path = Path::new(if folder.is_empty() { "." } else { folder });
    let Ok(entries) = fs::read_dir(path) else {
        return Vec::new();
    };
    let mut found: Vec<Entry> = entries
        .flatten()
        .take(MOST_ENTRIES)
        .filter_map(|entry| {
            let name = entry.file_name().into_string().ok()?;
            // Links count as what they lead to.
            let kind = fs::metadata(entry.path()).ok()?;
            match name.starts_with('.') {
                true => None,
                false if kind.is_dir() => Some(Entry::Folder(name)),
                false => kind.is_file().then_some(Entry::File(name)),
            }
        })
        .collect();
    found.sort();
    found
}

/// What a file that is there is instead of a job, by its ending, and how it is used.
fn no_job(path: &str) -> Option<String> {
    let name = path.rsplit('/').next()?;
    let (_, ending) = name.rsplit_once('.')?;
    let named = |what: &str, word: &str| {
        format!("it is {what}, not a job; a job names it: `profile {{ {word} \"{name}\" {{ ... }} }}`")
    };
    let why = match ending.to_ascii_lowercase().as_str() {
        "csv" => {
            format!("it is a file of points, not a job; a job names it: `profile {{ points \"{name}\" }}`")
        }
        "dat" if !is_text_of_krl(path) => named("a file of an airfoil", "airfoil"),
        "stl" | "obj" | "ply" => {
            format!(
                "it is a mesh, not a job; a job names it: `surface {{ mesh \"{name}\" {{ unit = mm }} }}`"
            )
        }
        "dxf" => named("a drawing", "dxf"),
        "svg" => named("a drawing", "svg"),
        "src" | "dat" | "mod" | "ngc" | "nc" | "mpf" => {
            "it is a program, not a job; `vcutc verify JOB PROGRAM` compares it with its job".to_owned()
        }
        _ => return None,
    };
    Path::new(path).is_file().then_some(why)
}

/// Whether a `.dat` is one of a KUKA program: there is a `.src` beside it.
fn is_text_of_krl(path: &str) -> bool {
    Path::new(path).with_extension("src").is_file()
}

/// Largest file of a program that is read, in bytes: some four million motions.
const LARGEST_PROGRAM: u64 = 256 << 20;

/// The bytes of a file of a program.
pub(super) fn load_program(path: &Path) -> Result<Vec<u8>, LoadError> {
    load_bounded(path, LARGEST_PROGRAM)
}

/// The name of a job's file without folder and ending; what comes from standard input is called so.
pub(super) fn stem(job: &str) -> &str {
    let file = job.rsplit('/').next().unwrap_or(job);
    let stem = file.strip_suffix(".vcut").unwrap_or(file);
    if stem.starts_with('<') { "stdin" } else { stem }
}

/// The job file that was most likely meant by a path that leads nowhere: the one that lacks only its ending, else one of the
/// folder that is spelt alike.
pub(super) fn job_near(path: &str) -> Option<String> {
    let with_ending = format!("{path}.vcut");
    if Path::new(&with_ending).is_file() {
        return Some(with_ending);
    }
    let path = Path::new(path);
    let folder = path.parent().filter(|folder| *folder != Path::new(""));
    let wanted = path.file_name()?.to_str()?;
    let wanted = wanted.strip_suffix(".vcut").unwrap_or(wanted);
    let entries = fs::read_dir(folder.unwrap_or(Path::new("."))).ok()?;
    let jobs: Vec<String> = entries
        .filter_map(|entry| entry.ok()?.file_name().into_string().ok())
        .filter_map(|name| Some(name.strip_suffix(".vcut")?.to_owned()))
        .collect();
    let near = nearest(wanted, jobs.iter().map(String::as_str));
    let name = format!("{}.vcut", near.first()?);
    let found = folder.map_or_else(|| PathBuf::from(&name), |folder| folder.join(&name));
    Some(found.display().to_string())
}

/// The bytes of a file of ordinary size.
pub(super) fn load_file(path: &Path) -> Result<Vec<u8>, LoadError> {
    load_bounded(path, LARGEST_FILE)
}

/// The bytes of a file of at most so many.
pub(super) fn load_bounded(path: &Path, most: u64) -> Result<Vec<u8>, LoadError> {
    // Asked before opening: opening a named pipe would wait for a writer.
    let metadata = std::fs::metadata(path).map_err(|error| load_error(&error))?;
    refuse_special(&metadata)?;
    if metadata.len() > most {
        return Err(LoadError::TooLarge(most));
    }
    read_bounded(File::open(path).map_err(|error| load_error(&error))?, most)
}

fn refuse_special(metadata: &Metadata) -> Result<(), LoadError> {
    if metadata.is_dir() {
        Err(LoadError::Other("it is a folder".to_owned()))
    } else if metadata.is_file() {
        Ok(())
    } else {
        Err(LoadError::Other(
            "it is a device or a pipe; use `-` to read a job from standard input".to_owned(),
        ))
    }
}

/// Reads to the end, but not beyond the limit: files can grow, and some report no length.
fn read_bounded(reader: impl Read, most: u64) -> Result<Vec<u8>, LoadError> {
    let mut bytes = Vec::new();
    reader
        .take(most + 1)
        .read_to_end(&mut bytes)
        .map_err(|error| load_error(&error))?;
    if bytes.len() as u64 > most {
        Err(LoadError::TooLarge(most))
    } else {
        Ok(bytes)
    }
}

fn load_error(error: &io::Error) -> LoadError {
    match error.kind() {
        io::ErrorKind::NotFound => LoadError::NotFound,
        _ => LoadError::Other(os_words(error)),
    }
}

/// The compiler joins paths with `/`, which Windows takes too; elsewhere `\` is a letter like any other.
pub(super) fn with_forward_slashes(path: &str) -> String {
    if cfg!(windows) {
        path.replace('\\', "/")
    } else {
        path.to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_missing_file_is_distinguished_from_an_unreadable_one() {
        let folder = tempfile::tempdir().unwrap();
        let missing = folder.path().join("none.vcut");
        assert_eq!(load_file(&missing), Err(LoadError::NotFound));
        assert_eq!(
            load_file(folder.path()),
            Err(LoadError::Other("it is a folder".to_owned()))
        );
    }

    #[test]
    fn a_file_above_the_limit_is_refused_without_reading_it() {
        let file = tempfile::NamedTempFile::new().unwrap();
        file.as_file().set_len(LARGEST_FILE + 1).unwrap();
        assert_eq!(load_file(file.path()), Err(LoadError::TooLarge(LARGEST_FILE)));
    }

    #[test]
    fn a_reader_without_end_is_stopped_at_the_limit() {
        assert_eq!(
            read_bounded(io::repeat(b' '), LARGEST_FILE),
            Err(LoadError::TooLarge(LARGEST_FILE))
        );
    }

    #[cfg(unix)]
    #[test]
    fn a_device_is_refused_before_it_is_opened() {
        let result = load_file(Path::new("/dev/zero"));
        assert!(
            matches!(&result, Err(LoadError::Other(why)) if why.contains("device")),
            "{result:?}"
        );
    }
}
