//! Programs on their way into a folder: written, or compared with what is there.

use super::files::load_program;
use super::output::{Destination, Output, Placed};
use std::fs;
use std::path::Path;
use vcutc_backend_api::backend::Backend;
use vcutc_backend_api::bundle::Sink;
use vcutc_diagnostics::source::LoadError;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_diff::{Change, FileChange, Sides, compare, family};
use vcutc_driver::checks::ReadBack;
use vcutc_driver::{self as driver, EmitFailure, Outcome};
use vcutc_readback::Written;

/// What is done with a program that is complete.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Fate {
    /// It is written.
    Write,
    /// It is compared with the files that are there, and nothing is written.
    Compare,
}

/// What a folder holds of a program, compared with what its job gives.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Differences {
    /// Files that are not as they should be, by their paths as people see them.
    pub(super) changes: Vec<FileChange>,
    /// How many files are as they should be.
    pub(super) same: usize,
}

/// The result for a program.
#[derive(Default)]
pub(super) struct Made {
    /// Further diagnostics.
    pub(super) diagnostics: Vec<Diagnostic>,
    /// The files of a program that was written.
    pub(super) placed: Vec<Placed>,
    /// What sets the folder apart from a program that was compared.
    pub(super) differences: Option<Differences>,
    /// What else needs saying of files.
    pub(super) remarks: Vec<String>,
    /// How the text was looked at, where one was made.
    pub(super) read_back: Option<ReadBack>,
}

/// A program of which all files are complete.
pub(super) struct Complete {
    /// What is done with it.
    pub(super) ready: Ready,
    /// The names of its files.
    pub(super) names: Vec<String>,
    /// How its text was looked at.
    pub(super) read_back: ReadBack,
}

/// A complete program that has not taken its place yet.
pub(super) enum Ready {
    /// Under passing names, with what there is to warn of.
    Staged(Box<Output>, Vec<Diagnostic>),
    Compared(Differences),
}

/// Why there is none.
pub(super) enum NotReady {
    /// The job and the target do not go together.
    Diagnostics(Vec<Diagnostic>),
    /// A file or folder is in the way.
    Trouble(String),
}

impl From<EmitFailure> for NotReady {
    fn from(failure: EmitFailure) -> Self {
        match failure {
            EmitFailure::Diagnostics(diagnostics) => Self::Diagnostics(diagnostics),
            EmitFailure::Sink(reason) => Self::Trouble(reason),
        }
    }
}

impl Ready {
    /// What there is to warn of before the files take their places.
    pub(super) fn warnings(&self) -> &[Diagnostic] {
        match self {
            Self::Staged(_, diagnostics) => diagnostics,
            Self::Compared(_) => &[],
        }
    }

    /// Lets the files take their places.
    fn settle(self) -> Result<Made, String> {
        match self {
            Self::Staged(output, diagnostics) => Ok(Made {
                diagnostics,
                placed: output.publish()?,
                ..Made::default()
            }),
            Self::Compared(differences) => Ok(Made {
                differences: Some(differences),
                ..Made::default()
            }),
        }
    }
}

impl Complete {
    /// Lets the files take their places.
    pub(super) fn settle(self) -> Result<Made, String> {
        Ok(Made {
            read_back: Some(self.read_back),
            ..self.ready.settle()?
        })
    }
}

/// The program of an outcome that has one.
pub(super) fn make(
    outcome: &Outcome,
    backend: &dyn Backend,
    to: &Destination,
    fate: Fate,
) -> Result<Option<Complete>, NotReady> {
    let Some(written) = driver::write(outcome, backend)? else {
        return Ok(None);
    };
    let names: Vec<String> = written
        .bundle
        .files()
        .iter()
        .map(|(name, _)| name.clone())
        .collect();
    let ready = match (fate, to) {
        (Fate::Compare, Destination::Folder(folder)) => {
            Ready::Compared(differences(outcome, &written, &names, folder).map_err(NotReady::Trouble)?)
        }
        (Fate::Write, Destination::Folder(folder)) => {
            let stale = family::stale(&names, &names_in(folder));
            let warnings = warning(outcome, &stale, folder);
            Ready::Staged(Box::new(staged(&written, to)?), warnings.into_iter().collect())
        }
        // There is nothing to compare with; the command line refuses it.
        (Fate::Write | Fate::Compare, Destination::Stdout(_)) => {
            Ready::Staged(Box::new(staged(&written, to)?), Vec::new())
        }
    };
    Ok(Some(Complete {
        ready,
        names,
        read_back: read_back(&written),
    }))
}

/// Whether the text of a program was read again.
pub(super) const fn read_back(written: &Written) -> ReadBack {
    match &written.places {
        Some(_) => ReadBack::Same,
        None => ReadBack::NoReader,
    }
}

fn staged(written: &Written, to: &Destination) -> Result<Output, NotReady> {
    let mut output = Output::to(to);
    for (name, bytes) in written.bundle.files() {
        let taken = output.file(name).and_then(|()| output.write(bytes));
        taken.map_err(|error| NotReady::Trouble(error.0))?;
    }
    Ok(output)
}

fn differences(
    outcome: &Outcome,
    written: &Written,
    names: &[String],
    folder: &Path,
) -> Result<Differences, String> {
    let program = outcome
        .compiled
        .as_ref()
        .map(|compiled| compiled.program.verified().program());
    let mut found = Differences::default();
    let shown = |name: &str| folder.join(name).display().to_string();
    for (index, (name, bytes)) in written.bundle.files().iter().enumerate() {
        let earlier = earlier_bytes(&folder.join(name))?;
        let sides = Sides {
            earlier: earlier.as_deref(),
            fresh: bytes,
        };
        let about = |bytes: core::ops::Range<usize>| written.about(program?, index, &bytes);
        match compare(sides, &about) {
            None => found.same += 1,
            Some(change) => found.changes.push(FileChange {
                name: shown(name),
                change,
            }),
        }
    }
    let stale = family::stale(names, &names_in(folder));
    found.changes.extend(stale.iter().map(|name| FileChange {
        name: shown(name),
        change: Change::Stale,
    }));
    Ok(found)
}

fn earlier_bytes(path: &Path) -> Result<Option<Vec<u8>>, String> {
    match load_program(path) {
        Ok(bytes) => Ok(Some(bytes)),
        Err(LoadError::NotFound) => Ok(None),
        Err(reason) => Err(format!("cannot read {}: {reason}", path.display())),
    }
}

/// The names in a folder; none for one that is not there. Names that are not text do not belong to the
/// compiler.
pub(super) fn names_in(folder: &Path) -> Vec<String> {
    let Ok(entries) = fs::read_dir(folder) else {
        return Vec::new();
    };
    entries
        .filter_map(|entry| entry.ok()?.file_name().into_string().ok())
        .collect()
}

/// Parts that stay behind in the folder.
fn warning(outcome: &Outcome, stale: &[String], folder: &Path) -> Option<Diagnostic> {
    let job = outcome.job.as_ref()?;
    let (first, last) = (stale.first()?, stale.last()?);
    let (names, are) = match stale.len() {
        1 => (first.clone(), "1 file in the folder is".to_owned()),
        2 => (
            format!("{first} and {last}"),
            "2 files in the folder are".to_owned(),
        ),
        count => (
            format!("{first} to {last}"),
            format!("{count} files in the folder are"),
        ),
    };
    Some(
        Diagnostic::new(
            Code::StaleParts,
            format!("{are} of an earlier version of this program: {names}"),
            job.name_span,
            "the program of this job no longer has these parts",
        )
        .help(format!("remove from {}: {}", folder.display(), stale.join(" "))),
    )
}
