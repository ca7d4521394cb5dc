//! Which files a run asked for, and whether they are still as they were.
//!
//! Stamps are looked at again and again, instead of asking the system to report changes: that also works on shares of a
//! network, where systems do not report changes; it does not matter whether an editor writes a file, renames
//! another one over it or makes a new one; and a file that is not there yet has a stamp as well. A job has a
//! handful of files, so that looking costs almost nothing; where it is slow it is done less often
//! ([`Pause`]).

use std::collections::BTreeMap;
use std::fs::{self, Metadata};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant, SystemTime};
use vcutc_diagnostics::source::{Entry, LoadError, Loader};

/// What distinguishes two versions of a file; none for a file that is not there.
type Stamp = Option<Version>;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Version {
    modified: Option<SystemTime>,
    length: u64,
    /// Which file of the disk it is, and when anything about it changed last.
    identity: Identity,
}

#[cfg(unix)]
type Identity = (u64, i64, i64);
#[cfg(not(unix))]
type Identity = Option<SystemTime>;

#[cfg(unix)]
fn identity(metadata: &Metadata) -> Identity {
    use std::os::unix::fs::MetadataExt;
    (metadata.ino(), metadata.ctime(), metadata.ctime_nsec())
}

#[cfg(not(unix))]
fn identity(metadata: &Metadata) -> Identity {
    metadata.created().ok()
}

fn stamp(path: &str) -> Stamp {
    let metadata = fs::metadata(path).ok()?;
    Some(Version {
        modified: metadata.modified().ok(),
        length: metadata.len(),
        identity: identity(&metadata),
    })
}

/// The files that a run has asked for so far, for an observer on another thread.
#[derive(Default)]
pub(super) struct Asked(Mutex<BTreeMap<String, Stamp>>);

impl Asked {
    /// The files with their versions as the run found them.
    pub(super) fn stamps(&self) -> Stamps {
        Stamps(self.files().clone())
    }

    /// Keeps a file in mind that is about to be read: a change in between is seen afterwards. Of a file that is read twice the
    /// first stamp counts, for the same reason.
    fn note(&self, path: &str) {
        let stamp = stamp(path);
        self.files().entry(path.to_owned()).or_insert(stamp);
    }

    fn files(&self) -> MutexGuard<'_, BTreeMap<String, Stamp>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Hands files on and keeps in mind which were asked for, and as which version.
pub(super) struct Recorder<'d> {
    disk: &'d dyn Loader,
    asked: &'d Asked,
}

impl<'d> Recorder<'d> {
    pub(super) const fn new(disk: &'d dyn Loader, asked: &'d Asked) -> Self {
        Self { disk, asked }
    }
}

impl Loader for Recorder<'_> {
    fn load(&self, path: &str) -> Result<Vec<u8>, LoadError> {
        self.asked.note(path);
        self.disk.load(path)
    }

    fn load_data(&self, path: &str, most: u64) -> Result<Vec<u8>, LoadError> {
        self.asked.note(path);
        self.disk.load_data(path, most)
    }

    fn list(&self, folder: &str) -> Vec<Entry> {
        self.disk.list(folder)
    }
}

/// Files with their versions.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Stamps(BTreeMap<String, Stamp>);

impl Stamps {
    /// The same files as they are now.
    pub(super) fn now(&self) -> Self {
        Self(self.0.keys().map(|path| (path.clone(), stamp(path))).collect())
    }

    /// Whether a file that `earlier` has is gone.
    pub(super) fn lacks_a_file_of(&self, earlier: &Self) -> bool {
        let is_there = |stamps: &Self, path| stamps.0.get(path).is_some_and(Option::is_some);
        self.0
            .keys()
            .any(|path| !is_there(self, path) && is_there(earlier, path))
    }

    /// How many files there are.
    pub(super) fn count(&self) -> usize {
        self.0.len()
    }
}

/// Shortest time between two looks at the files.
const SHORTEST: Duration = Duration::from_millis(5);
const LONGEST: Duration = Duration::from_secs(2);
/// How many times as long as a look the pause after it is.
const IDLE: u32 = 20;

/// How long to wait before the next look: at most a twentieth of the time goes into looking.
pub(super) struct Pause {
    length: Duration,
}

impl Pause {
    pub(super) const fn new() -> Self {
        Self { length: SHORTEST }
    }

    pub(super) const fn length(&self) -> Duration {
        self.length
    }

    /// Looks, and sets the pause by how long that took.
    pub(super) fn look(&mut self, stamps: &Stamps) -> Stamps {
        let start = Instant::now();
        let now = stamps.now();
        self.length = after(start.elapsed());
        now
    }
}

/// The pause after a look that took so long.
fn after(look: Duration) -> Duration {
    look.saturating_mul(IDLE).clamp(SHORTEST, LONGEST)
}

#[cfg(test)]
mod tests {
    use super::super::super::files::Disk;
    use super::*;

    #[test]
    fn a_twentieth_of_the_time_at_most_goes_into_looking() {
        let ms = Duration::from_millis;
        assert_eq!(after(Duration::ZERO), ms(5));
        assert_eq!(after(Duration::from_micros(100)), ms(5));
        assert_eq!(after(ms(4)), ms(80));
        assert_eq!(after(ms(100)), ms(2000));
        assert_eq!(after(Duration::MAX), ms(2000));
        assert_eq!(Pause::new().length(), ms(5));
    }

    #[test]
    fn every_way_to_change_a_file_is_seen() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
        let (job, missing) = (path("rib.vcut"), path("none.vcut"));
        fs::write(&job, "one").unwrap();
        let (disk, asked) = (Disk::around(&job), Asked::default());
        let recorder = Recorder::new(&disk, &asked);
        assert_eq!(recorder.load(&job), Ok(b"one".to_vec()));
        assert_eq!(recorder.load(&missing), Err(LoadError::NotFound));
        let first = asked.stamps();
        assert_eq!((first.count(), &first.now()), (2, &first));

        fs::write(&job, "three").unwrap();
        let longer = first.now();
        assert_ne!(longer, first);

        // A version of the same length and age in its place.
        let age = fs::metadata(&job).unwrap().modified().unwrap();
        fs::write(path("new"), "seven").unwrap();
        let file = fs::File::options().write(true).open(path("new")).unwrap();
        file.set_modified(age).unwrap();
        fs::rename(path("new"), &job).unwrap();
        let renamed = first.now();
        assert_ne!(renamed, longer);

        fs::write(&missing, "").unwrap();
        let appeared = first.now();
        assert_ne!(appeared, renamed);
        assert!(!appeared.lacks_a_file_of(&renamed));

        fs::remove_file(&job).unwrap();
        assert!(first.now().lacks_a_file_of(&appeared));
    }
}
