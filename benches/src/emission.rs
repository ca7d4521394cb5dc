//! The same program text, written in three ways: by the backend, with the standard library's formatting, and as bytes
//! that are already there. All three write the same files with the same bytes.

use std::fs::{self, File};
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};
use std::process::Command;
use vcutc_backend_api::bundle::{Bundle, Sink, SinkError};

/// Writes each chunk to its file at once; nothing is gathered beyond what the backend gathers itself.
#[derive(Debug)]
pub struct Folder {
    path: PathBuf,
    file: Option<File>,
}

impl Folder {
    /// An empty folder of that name, on a disk that has nothing left to do.
    ///
    /// What was written before is still on its way to the disk when the next file is begun, and while it is, writing is
    /// several times slower, by chance: so it is waited for.
    ///
    /// # Panics
    /// When it cannot be made.
    #[must_use]
    pub fn new(path: &Path) -> Self {
        if path.exists() {
            fs::remove_dir_all(path).expect("old files can be removed");
        }
        fs::create_dir_all(path).expect("a folder can be made");
        let settled = Command::new("sync").status().expect("`sync` can be run");
        assert!(settled.success());
        Self {
            path: path.to_owned(),
            file: None,
        }
    }

    fn create(&self, name: &str) -> File {
        File::create(self.path.join(name)).expect("a file can be made")
    }
}

impl Sink for Folder {
    fn file(&mut self, name: &str) -> Result<(), SinkError> {
        self.file = Some(self.create(name));
        Ok(())
    }

    fn write(&mut self, bytes: &[u8]) -> Result<(), SinkError> {
        let file = self.file.as_mut().expect("a file comes before its bytes");
        file.write_all(bytes)
            .map_err(|error| SinkError(error.to_string()))
    }
}

/// A program as its lines: numbers where there are numbers to be formatted.
#[derive(Clone, Debug)]
pub struct Lines {
    files: Vec<(String, Vec<Line>)>,
}

#[derive(Clone, Debug)]
enum Line {
    /// A `LIN` with its six coordinates.
    Move([f64; 6]),
    /// Anything else, without its line end.
    Words(String),
}

impl Lines {
    /// Reads the lines of finished files back.
    ///
    /// # Panics
    /// When a file is not text.
    #[must_use]
    pub fn of(bundle: &Bundle) -> Self {
        let files = bundle.files().iter().map(|(name, bytes)| {
            let text = std::str::from_utf8(bytes).expect("a program is text");
            (name.clone(), text.lines().map(line).collect())
        });
        Self {
            files: files.collect(),
        }
    }

    /// How many lines are motions.
    #[must_use]
    pub fn moves(&self) -> usize {
        let lines = self.files.iter().flat_map(|(_, lines)| lines);
        lines.filter(|line| matches!(line, Line::Move(_))).count()
    }

    /// How many lines there are.
    #[must_use]
    pub fn count(&self) -> usize {
        self.files.iter().map(|(_, lines)| lines.len()).sum()
    }

    /// Writes all files with `write!` through a `BufWriter`.
    ///
    /// # Panics
    /// When the disk does not take them.
    pub fn write(&self, folder: &Folder) {
        for (name, lines) in &self.files {
            let mut out = BufWriter::new(folder.create(name));
            for line in lines {
                write_line(&mut out, line).expect("the disk takes everything");
            }
            out.flush().expect("the disk takes everything");
        }
    }
}

fn line(line: &str) -> Line {
    let inner = line
        .strip_prefix("LIN {X ")
        .and_then(|rest| rest.strip_suffix('}'));
    let numbers = inner.and_then(|inner| {
        let mut values = inner
            .split(',')
            .map(|field| field.trim_start_matches(['Y', 'Z', 'A', 'B', 'C', ' ']));
        let mut next = || values.next()?.parse().ok();
        Some([next()?, next()?, next()?, next()?, next()?, next()?])
    });
    numbers.map_or_else(|| Line::Words(line.to_owned()), Line::Move)
}

fn write_line(out: &mut impl Write, line: &Line) -> std::io::Result<()> {
    match line {
        Line::Move([x, y, z, a, b, c]) => {
            write!(
                out,
                "LIN {{X {x:.3},Y {y:.3},Z {z:.3},A {a:.4},B {b:.4},C {c:.4}}}\r\n"
            )
        }
        Line::Words(words) => write!(out, "{words}\r\n"),
    }
}

/// Writes bytes that are already there.
///
/// # Panics
/// When the disk does not take them.
pub fn write_finished(bundle: &Bundle, folder: &Folder) {
    for (name, bytes) in bundle.files() {
        folder
            .create(name)
            .write_all(bytes)
            .expect("the disk takes everything");
    }
}

/// Makes sure that a folder holds exactly these files.
///
/// # Panics
/// When it does not.
pub fn assert_same_files(bundle: &Bundle, path: &Path) {
    for (name, bytes) in bundle.files() {
        let written = fs::read(path.join(name)).expect("the file is there");
        assert!(written == *bytes, "{name} differs in {}", path.display());
    }
    let count = fs::read_dir(path).expect("the folder is there").count();
    assert_eq!(count, bundle.files().len(), "{}", path.display());
}
