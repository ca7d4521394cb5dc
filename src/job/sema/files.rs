//! The files of a job: the root and everything it uses, each loaded once.
//!
//! Files are loaded breadth first, so that a file's number does not depend on how deep the uses are nested. Which
//! file uses which is kept as a graph; circles are found in it afterwards.

use super::near_files;
use super::report::Reported;
use super::session::Session;
use std::collections::{BTreeMap, VecDeque};
use vcutc_diagnostics::source::{FileId, LARGEST_FILE, LoadError, Span, join_path};
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_syntax as syntax;
use vcutc_syntax::ast::{Ast, Item};

/// Most files of one job.
const MOST_FILES: usize = 1000;

/// Most bytes of all files of one job together.
const MOST_BYTES: u64 = 4 * LARGEST_FILE;

/// A file of the job.
pub(crate) struct File {
    pub(crate) id: FileId,
    /// Its tree.
    pub(crate) ast: Ast,
    /// The `use` by which it came in; none for the root.
    pub(crate) used_at: Option<Span>,
}

/// Files in the order of loading; the root is the first.
pub(crate) type Files = Vec<File>;

/// A `use` that leads from one loaded file to another.
struct Edge {
    to: usize,
    span: Span,
}

/// Loads a job's files.
///
/// # Errors
/// When the root file cannot be loaded.
pub(crate) fn load(root: &str, session: &mut Session<'_>) -> Result<Files, LoadError> {
    let bytes = session.loader.load(root)?;
    let mut loading = Loading::new(session);
    loading.take(root, bytes, None);
    loading.follow_uses();
    loading.report_circles();
    Ok(loading.files)
}

/// Text of a file that has been loaded; reports when it is not text.
///
/// The file is added to the source map either way, so that the diagnostic can show where it stops being text.
pub(crate) fn text_of(
    session: &mut Session<'_>,
    name: &str,
    bytes: Vec<u8>,
    named_at: Option<Span>,
) -> (FileId, Option<Reported>) {
    match String::from_utf8(bytes) {
        Ok(text) => (session.sources.add(name, text), None),
        Err(error) => {
            let at = u32::try_from(error.utf8_error().valid_up_to()).unwrap_or(u32::MAX);
            // Up to the first bad byte the lossy text has the same bytes, so the place is right.
            let id = session
                .sources
                .add(name, String::from_utf8_lossy(error.as_bytes()).into_owned());
            let span = Span {
                file: id,
                start: at,
                end: at.saturating_add(3),
            };
            let diagnostic = Diagnostic::new(
                Code::NotUtf8,
                format!("`{name}` is not a UTF-8 text file"),
                span,
                format!("byte {} is not valid here", at.saturating_add(1)),
            )
            .help("save the file as UTF-8 text");
            let diagnostic = match named_at {
                Some(span) => diagnostic.and(span, "the file is named here"),
                None => diagnostic,
            };
            (id, Some(session.reports.push(diagnostic)))
        }
    }
}

/// What a path that does not begin at the root is relative to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Relative {
    /// The folder of the file in which it is written.
    ToItsFile,
    /// The current folder: it was given on the command line.
    ToTheCurrentFolder,
}

impl Relative {
    const fn note(self) -> &'static str {
        match self {
            Self::ToItsFile => "a path is relative to the file that it is written in",
            Self::ToTheCurrentFolder => {
                "a path on the command line is relative to the current folder, not to the job"
            }
        }
    }
}

/// The diagnostic for a file that could not be loaded.
pub(crate) fn not_loaded(
    path: &Span,
    resolved: &str,
    relative: Relative,
    error: &LoadError,
    session: &Session<'_>,
) -> Diagnostic {
    let diagnostic = Diagnostic::new(
        Code::FileNotFound,
        format!("cannot read `{resolved}`"),
        *path,
        error.to_string(),
    );
    match error {
        LoadError::NotFound => near_files::meant(diagnostic.note(relative.note()), *path, resolved, session),
        LoadError::TooLarge(limit) => diagnostic.help(format!("keep files below {} MB", limit / 1_000_000)),
        LoadError::Other(_) => diagnostic.help("check that the file can be read"),
    }
}

struct Loading<'s, 'a> {
    session: &'s mut Session<'a>,
    files: Files,
    /// Numbers in `files` by path; none for a path that could not be loaded.
    known: BTreeMap<String, Option<usize>>,
    edges: Vec<Vec<Edge>>,
    bytes: u64,
}

/// A `use` that is still to be followed.
struct Pending {
    from: usize,
    path: String,
    span: Span,
}

impl<'s, 'a> Loading<'s, 'a> {
    const fn new(session: &'s mut Session<'a>) -> Self {
        Self {
            session,
            files: Vec::new(),
            known: BTreeMap::new(),
            edges: Vec::new(),
            bytes: 0,
        }
    }

    /// Adds a file and parses it.
    fn take(&mut self, path: &str, bytes: Vec<u8>, used_at: Option<Span>) -> usize {
        self.bytes = self.bytes.saturating_add(bytes.len() as u64);
        let (id, fault) = text_of(self.session, path, bytes, used_at);
        let ast = match fault {
            Some(reported) => {
                self.session.set_damaged(id, reported);
                Ast::default()
            }
            None => self.parse(id),
        };
        let number = self.files.len();
        self.files.push(File { id, ast, used_at });
        self.edges.push(Vec::new());
        self.known.insert(join_path("", path), Some(number));
        number
    }

    fn parse(&mut self, id: FileId) -> Ast {
        let mut found = Vec::new();
        let text = self.session.sources.get(id).map_or("", |file| file.text.as_str());
        let ast = syntax::parse(id, text, &mut found);
        if let Some(reported) = self.session.reports.append(found) {
            self.session.set_damaged(id, reported);
        }
        ast
    }

    fn follow_uses(&mut self) {
        let mut queue = VecDeque::new();
        self.enqueue(0, &mut queue);
        while let Some(pending) = queue.pop_front() {
            let known = self.known.get(&pending.path).copied();
            let target = known.unwrap_or_else(|| {
                let loaded = self.load_used(&pending);
                if let Some(number) = loaded {
                    self.enqueue(number, &mut queue);
                }
                loaded
            });
            if let (Some(to), Some(edges)) = (target, self.edges.get_mut(pending.from)) {
                edges.push(Edge {
                    to,
                    span: pending.span,
                });
            }
        }
    }

    /// Queues the uses of a file.
    fn enqueue(&self, from: usize, queue: &mut VecDeque<Pending>) {
        let Some(file) = self.files.get(from) else { return };
        let name = self.session.sources.name(file.id);
        for item in &file.ast.items {
            if let Item::Use { path, .. } = item {
                queue.push_back(Pending {
                    from,
                    path: join_path(name, &path.node),
                    span: path.span,
                });
            }
        }
    }

    fn load_used(&mut self, pending: &Pending) -> Option<usize> {
        if self.files.len() >= MOST_FILES || self.bytes > MOST_BYTES {
            let diagnostic = Diagnostic::new(
                Code::FileNotFound,
                "the job uses too many files",
                pending.span,
                format!("{} files are loaded already", self.files.len()),
            )
            .note(format!(
                "a job has at most {MOST_FILES} files of {} MB in total",
                MOST_BYTES / 1_000_000
            ))
            .help("put the definitions into fewer files");
            return self.missing(pending, diagnostic);
        }
        match self.session.loader.load(&pending.path) {
            Ok(bytes) => Some(self.take(&pending.path, bytes, Some(pending.span))),
            Err(error) => {
                let diagnostic = not_loaded(
                    &pending.span,
                    &pending.path,
                    Relative::ToItsFile,
                    &error,
                    self.session,
                );
                self.missing(pending, diagnostic)
            }
        }
    }

    fn missing(&mut self, pending: &Pending, diagnostic: Diagnostic) -> Option<usize> {
        let reported = self.session.reports.push(diagnostic);
        self.session.set_incomplete(reported);
        self.known.insert(pending.path.clone(), None);
        None
    }

    /// Finds circles: a walk in depth, where an edge back into the path at hand closes one.
    fn report_circles(&mut self) {
        #[derive(Clone, Copy, PartialEq)]
        enum State {
            New,
            OnPath,
            Done,
        }
        let mut state = vec![State::New; self.files.len()];
        // Files on the path from the root, each with the number of its next edge.
        let mut path: Vec<(usize, usize)> = vec![(0, 0)];
        let mut circles = Vec::new();
        while let Some((file, next)) = path.last_mut() {
            let at = *file;
            let edge = self.edges.get(at).and_then(|edges| edges.get(*next));
            *next += 1;
            let Some(slot) = state.get_mut(at) else { break };
            *slot = State::OnPath;
            let Some(edge) = edge else {
                *slot = State::Done;
                path.pop();
                continue;
            };
            match state.get(edge.to) {
                Some(State::New) => path.push((edge.to, 0)),
                Some(State::OnPath) => circles.push(self.circle(&path, edge)),
                Some(State::Done) | None => {}
            }
        }
        for diagnostic in circles {
            self.session.reports.push(diagnostic);
        }
    }

    /// The circle that an edge closes, as one diagnostic with all its uses.
    fn circle(&self, path: &[(usize, usize)], closing: &Edge) -> Diagnostic {
        let name = |number: usize| {
            let file = self.files.get(number);
            file.map_or("", |file| self.session.sources.name(file.id))
        };
        let start = path.iter().position(|&(file, _)| file == closing.to).unwrap_or(0);
        let circle = path.get(start..).unwrap_or_default();
        let own = circle.len() == 1;
        let headline = if own {
            format!("`{}` uses itself", name(closing.to))
        } else {
            format!("`{}` uses itself through other files", name(closing.to))
        };
        let mut diagnostic = Diagnostic::new(
            Code::UseCycle,
            headline,
            closing.span,
            format!("this leads back to `{}`", name(closing.to)),
        )
        .help("move what both files need into a third one that uses neither");
        for pair in circle.windows(2) {
            let [(from, next), (to, _)] = pair else { continue };
            // The edge in work is the one before the next.
            let edge = self
                .edges
                .get(*from)
                .and_then(|edges| edges.get(next.checked_sub(1)?));
            if let Some(edge) = edge {
                diagnostic =
                    diagnostic.and(edge.span, format!("here `{}` uses `{}`", name(*from), name(*to)));
            }
        }
        if own {
            diagnostic.help.clear();
            diagnostic = diagnostic.help("delete this `use`: a file sees its own names anyway");
        }
        diagnostic
    }
}
