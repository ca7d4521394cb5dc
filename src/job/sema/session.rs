//! What the checks of one run share: the loader, the source texts, and what has been found so far.

use super::kept_surfaces::Surfaces;
use super::report::{Checked, Reported, Reports};
use std::collections::BTreeMap;
use std::sync::Arc;
use vcutc_backend_api::profile::Profile;
use vcutc_diagnostics::source::{FileId, Loader, SourceMap, Span};
use vcutc_machine::{LimitPlaces, Model};

/// A model, and where its file states the limits of its axes.
#[derive(Clone, Debug)]
pub(crate) struct Described {
    pub(crate) model: Arc<Model>,
    pub(crate) limits: Vec<LimitPlaces>,
}

/// One run.
pub struct Session<'a> {
    /// Where files come from.
    pub loader: &'a dyn Loader,
    pub sources: &'a mut SourceMap,
    /// Surfaces of files that runs before have read, if there are such runs.
    pub(crate) surfaces: Option<&'a Surfaces>,
    /// What has been found.
    pub reports: Reports,
    /// Files of which a part could not be read. What seems to be missing there may be in the unreadable part.
    damaged: BTreeMap<FileId, Reported>,
    /// Machines read so far, by name of the catalogue or path of the file: a shop may put one arm into several cells.
    pub(crate) machines: BTreeMap<String, Checked<Described>>,
    /// Profiles read so far, by path: the cells of a shop may share one.
    pub profiles: BTreeMap<String, Checked<Profile>>,
    /// Set when definitions may be missing because a file could not be had or read in full.
    incomplete: Option<Reported>,
}

impl<'a> Session<'a> {
    /// A run that has found nothing yet.
    pub fn new(loader: &'a dyn Loader, sources: &'a mut SourceMap) -> Self {
        Self {
            loader,
            sources,
            surfaces: None,
            reports: Reports::default(),
            damaged: BTreeMap::new(),
            machines: BTreeMap::new(),
            profiles: BTreeMap::new(),
            incomplete: None,
        }
    }

    /// Remembers that a part of a file could not be read.
    pub fn set_damaged(&mut self, file: FileId, reported: Reported) {
        self.damaged.insert(file, reported);
        self.incomplete = Some(reported);
    }

    /// Remembers that a whole file is missing.
    pub const fn set_incomplete(&mut self, reported: Reported) {
        self.incomplete = Some(reported);
    }

    /// Whether a part of the file at that place could not be read.
    pub fn damage_at(&self, place: Span) -> Option<Reported> {
        self.damaged.get(&place.file).copied()
    }

    /// Whether definitions may be missing.
    pub const fn incomplete(&self) -> Option<Reported> {
        self.incomplete
    }
}

/// The whole text of a file as a place of no extent at its start.
pub const fn start_of(file: FileId) -> Span {
    Span {
        file,
        start: 0,
        end: 0,
    }
}
