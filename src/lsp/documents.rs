//! The open documents, and the root files from which they are analysed.

use super::Workspace;
use super::analysis::{Analysis, OpenTexts};
use super::text::{Encoding, Text};
use lsp_types::Uri;
use std::collections::{BTreeMap, BTreeSet};
use vcutc_diagnostics::overlay::Overlay;
use vcutc_job::sema::Part;
use vcutc_job::sema::kept_surfaces::Surfaces;
use vcutc_job::sema::kind::Operations;

/// How the client calls an open document.
#[derive(Clone, Debug)]
pub(super) struct Called {
    /// Its URI, letter by letter.
    pub(super) uri: Uri,
    /// Its latest version.
    pub(super) version: i32,
    /// Whether it is a file of the language; other open documents only replace their files.
    pub(super) language: Language,
}

/// The language of a document.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Language {
    /// Jobs and their libraries.
    Vcut,
    /// A machine's sheet, points, anything.
    Other,
}

/// Open documents and what is known of them.
#[derive(Debug, Default)]
pub(super) struct Documents {
    /// The operations of the language.
    pub(super) operations: Operations,
    pub(super) texts: OpenTexts,
    /// How the client calls them.
    pub(super) called: BTreeMap<String, Called>,
    /// What is known of root files, by their paths.
    pub(super) analyses: BTreeMap<String, Analysis>,
    /// What was known before something changed that they may depend on. What still says the same continues from there.
    earlier: BTreeMap<String, Analysis>,
    /// Roots that are not open documents: a job of the workspace for an open library.
    homes: BTreeSet<String>,
    /// Whether the roots must be determined again.
    roots: Roots,
    /// What the client counts positions in.
    pub(super) encoding: Encoding,
    /// Folders of the workspace.
    pub(super) folders: Vec<String>,
    /// Surfaces of files that were read before.
    surfaces: Surfaces,
    stamps: u64,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Roots {
    #[default]
    Unknown,
    Known,
}

impl Documents {
    /// None open yet.
    pub(super) fn new(operations: Operations) -> Self {
        Self {
            operations,
            ..Self::default()
        }
    }

    /// Opens a document, or opens it again.
    pub(super) fn open(&mut self, path: String, called: Called, text: &str) {
        self.texts.insert(path.clone(), Text::new(text, self.encoding));
        self.called.insert(path, called);
        self.forget_all();
    }

    /// Closes a document: from now on its file counts.
    pub(super) fn close(&mut self, path: &str) {
        self.texts.remove(path);
        self.called.remove(path);
        self.forget_all();
    }

    /// Takes the next version of a document.
    pub(super) fn change(&mut self, path: &str, version: i32, text: Text) {
        let Some(called) = self.called.get_mut(path) else {
            return;
        };
        called.version = version;
        self.texts.insert(path.to_owned(), text);
        let is_touched = |root: &String, known: &mut Analysis| root == path || known.concerns(path);
        self.earlier.extend(self.analyses.extract_if(.., is_touched));
        self.roots = Roots::Unknown;
    }

    /// Everything known has to be checked again: files may have changed.
    pub(super) fn forget_all(&mut self) {
        self.earlier.append(&mut self.analyses);
        self.homes.clear();
        self.roots = Roots::Unknown;
    }

    /// Looks at every root that is not known.
    pub(super) fn look(&mut self, files: &dyn Workspace) {
        let open: Vec<String> = self
            .called
            .iter()
            .filter(|(_, called)| called.language == Language::Vcut)
            .map(|(path, _)| path.clone())
            .collect();
        for path in open.iter().chain(&self.homes.clone()) {
            self.look_at(path, files);
        }
        if self.roots == Roots::Unknown {
            self.look_for_roots(&open, files);
        }
        self.earlier.clear();
    }

    fn look_for_roots(&mut self, open: &[String], files: &dyn Workspace) {
        self.roots = Roots::Known;
        self.homes = BTreeSet::new();
        for path in open {
            if self.is_library(path) && self.jobs_of(path).next().is_none() {
                self.find_home(path, files);
            }
        }
        let homes = self.homes.clone();
        self.analyses
            .retain(|root, _| open.contains(root) || homes.contains(root));
    }

    fn look_at(&mut self, path: &str, files: &dyn Workspace) {
        if self.analyses.contains_key(path) {
            return;
        }
        if let Some(known) = self.study(path, files) {
            self.keep(known);
        }
    }

    fn keep(&mut self, known: Analysis) {
        let earlier = self.earlier.remove(&known.root);
        let known = known.inheriting(earlier);
        self.analyses.insert(known.root.clone(), known);
    }

    /// The analysis of that number, unless its text has changed meanwhile.
    pub(super) fn numbered(&mut self, root: &str, stamp: u64) -> Option<&mut Analysis> {
        let known = self.analyses.get_mut(root).or(self.earlier.get_mut(root));
        known.filter(|known| known.stamp == stamp)
    }

    /// What is known of every file of the workspace that is read or could be, each once, by its path.
    pub(super) fn whole_workspace(&mut self, files: &dyn Workspace) -> BTreeMap<String, Analysis> {
        let open = self
            .called
            .iter()
            .filter(|(_, called)| called.language == Language::Vcut);
        let open: Vec<String> = open.map(|(path, _)| path.clone()).collect();
        let paths: BTreeSet<String> = open.into_iter().chain(files.job_files(&self.folders)).collect();
        paths
            .into_iter()
            .filter_map(|path| Some((path.clone(), self.study(&path, files)?)))
            .collect()
    }

    /// What is known of a root file now.
    fn study(&mut self, path: &str, files: &dyn Workspace) -> Option<Analysis> {
        self.stamps += 1;
        let overlay = Overlay {
            texts: &self.texts,
            below: files,
        };
        Analysis::of(path, self.stamps, &overlay, (self.operations, &self.surfaces))
    }

    fn is_library(&self, path: &str) -> bool {
        self.analyses
            .get(path)
            .is_some_and(|known| known.part == Part::Library)
    }

    /// The known jobs that a file belongs to.
    fn jobs_of(&self, path: &str) -> impl Iterator<Item = &Analysis> {
        self.analyses
            .values()
            .filter(move |known| known.part == Part::Job && known.file(path).is_some())
    }

    /// Looks for a job of the workspace that uses a library: names of a shop's files are often defined in one another, and
    /// only a job says which belong together.
    fn find_home(&mut self, library: &str, files: &dyn Workspace) {
        for path in self.users_of(library, files) {
            if let Some(known) = self.study(&path, files)
                && known.part == Part::Job
                && known.file(library).is_some()
            {
                self.homes.insert(path);
                self.keep(known);
                return;
            }
        }
    }

    /// Files of the workspace that may use a file, by their text: they are not open and name it, or use anything at all.
    fn users_of(&self, library: &str, files: &dyn Workspace) -> Vec<String> {
        let name = library.rsplit('/').next().unwrap_or_default();
        let mut direct = Vec::new();
        let mut others = Vec::new();
        for path in files.job_files(&self.folders) {
            if path == library || self.texts.contains_key(&path) {
                continue;
            }
            let Some(text) = files
                .load(&path)
                .ok()
                .and_then(|bytes| String::from_utf8(bytes).ok())
            else {
                continue;
            };
            if text.contains(name) {
                direct.push(path);
            } else if text.contains("use") {
                others.push(path);
            }
        }
        direct.append(&mut others);
        direct
    }

    /// The analyses whose diagnostics are shown: of jobs, and of libraries that belong to none.
    pub(super) fn speaking(&self) -> impl Iterator<Item = &Analysis> {
        self.analyses.values().filter(|known| match known.part {
            Part::Job => true,
            Part::Library => self.jobs_of(&known.root).next().is_none(),
        })
    }

    /// The analysis from which questions about a file are answered.
    pub(super) fn about(&self, path: &str) -> Option<&Analysis> {
        let own = self.analyses.get(path);
        let is_job = own.is_some_and(|known| known.part == Part::Job);
        own.filter(|_| is_job)
            .or_else(|| self.jobs_of(path).next())
            .or(own)
    }

    /// All analyses, also of files that are not open, that a file belongs to: where its names may be used.
    pub(super) fn users(&mut self, path: &str, files: &dyn Workspace) -> Vec<Analysis> {
        let open: Vec<String> = self.analyses.keys().cloned().collect();
        let closed = self.users_of(path, files);
        let all: Vec<Analysis> = open
            .iter()
            .chain(&closed)
            .chain([&path.to_owned()])
            .filter_map(|root| self.study(root, files))
            .filter(|known| known.file(path).is_some())
            .collect();
        let mut seen = BTreeSet::new();
        all.into_iter()
            .filter(|known| seen.insert(known.root.clone()))
            .collect()
    }

    /// The URI of a path, as the client calls it.
    pub(super) fn uri(&self, path: &str) -> Option<Uri> {
        match self.called.get(path) {
            Some(called) => Some(called.uri.clone()),
            None => super::uri::uri_of(path),
        }
    }
}
