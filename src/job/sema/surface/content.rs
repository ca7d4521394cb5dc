//! What files of triangles, of heights and of B-spline surfaces share: how a job names them, what they hold, and what is reported of
//! them.

use crate::sema::fields::Fields;
use crate::sema::report::Reported;
use crate::sema::session::Session;
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::source::{LARGEST_FILE, Span, Spanned};
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_surface::import::DataError;
use vcutc_surface::mesh::Mesh;
use vcutc_syntax::ast::{Entry, SurfaceFile};

/// Units of files of triangles, in mm: those of drawings.
pub(super) const MESH_UNITS: &[(&str, f64)] = &[
    ("mm", 1.0),
    ("cm", 10.0),
    ("m", 1000.0),
    ("in", 25.4),
    ("ft", 304.8),
];

/// What a file holds.
pub(super) struct Content {
    pub(super) mesh: Mesh,
    /// Of its numbers, in mm.
    pub(super) unit: f64,
    /// How near it lies to what it stands for.
    pub(super) tolerance: Length,
}

impl Content {
    /// Of a file whose triangles are what it stands for.
    pub(super) const fn exact(mesh: Mesh, unit: f64) -> Self {
        Self {
            mesh,
            unit,
            tolerance: Length::ZERO,
        }
    }
}

/// A file as the job names it.
pub(super) struct Named<'a> {
    pub(super) kind: Spanned<SurfaceFile>,
    pub(super) path: &'a Spanned<String>,
    pub(super) options: &'a [Entry],
    pub(super) span: Span,
}

impl Named<'_> {
    /// From its word to its path.
    pub(super) const fn head(&self) -> Span {
        Span {
            end: self.path.span.end,
            ..self.kind.span
        }
    }
}

/// A file of a surface that may be large.
pub(super) struct Loaded {
    /// Its path from here.
    pub(super) path: String,
    pub(super) bytes: Vec<u8>,
    /// What stands for it among the sources.
    pub(super) hash: String,
}

/// A place in a file that cannot be read, and what is said about it.
pub(super) struct Misread {
    pub(super) error: DataError,
    pub(super) code: Code,
    pub(super) headline: String,
    /// What to do about it.
    pub(super) help: &'static str,
}

/// Reports a place in a file that cannot be read: in its text if it is one, else by its byte.
pub(super) fn broken(
    misread: Misread,
    path: &Spanned<String>,
    resolved: &str,
    bytes: Vec<u8>,
    session: &mut Session<'_>,
) -> Reported {
    let Misread {
        error,
        code,
        headline,
        help,
    } = misread;
    let start = usize::try_from(error.start).unwrap_or(usize::MAX);
    let line = 1 + bytes.iter().take(start).filter(|byte| **byte == b'\n').count();
    let is_text = !bytes.contains(&0);
    let is_small = bytes.len() as u64 <= LARGEST_FILE;
    let text = (is_small && is_text)
        .then_some(bytes)
        .and_then(|bytes| String::from_utf8(bytes).ok());
    let diagnostic = match text {
        Some(text) => {
            let span = Span {
                file: session.sources.add(resolved, text),
                start: error.start,
                end: error.end,
            };
            Diagnostic::new(code, headline, span, error.message)
                .and(path.span, "the file is named here")
                .help(help)
        }
        None => {
            let byte = u64::from(error.start) + 1;
            let (place, help) = match (is_text, code) {
                (true, _) => (
                    format!("this is in line {line} of the file, at byte {byte}"),
                    help,
                ),
                (false, Code::BadMesh) => (format!("this is at byte {byte} of the file"), "export it again"),
                (false, _) => (format!("this is at byte {byte} of the file"), help),
            };
            Diagnostic::new(code, headline, path.span, error.message)
                .note(place)
                .help(help)
        }
    };
    session.reports.push(diagnostic)
}

/// That a file states no unit, and the job does not either.
pub(super) fn without_unit(
    path: &Spanned<String>,
    (label, note): (&str, Option<&str>),
    fields: &Fields<'_>,
    session: &mut Session<'_>,
) -> Reported {
    if let Some(reported) = fields.quiet_about("unit") {
        return reported;
    }
    let mut diagnostic = Diagnostic::new(
        Code::MeshWithoutUnit,
        format!("nothing states the unit of `{}`", path.node),
        path.span,
        label,
    );
    diagnostic.notes.extend(note.map(str::to_owned));
    let diagnostic = fields.offer(diagnostic, "state it, for example", "unit = mm");
    session.reports.push(diagnostic)
}

/// That what the notes name in a file was not taken as it stands; none where there are no notes.
pub(super) fn partly_read(
    path: &Spanned<String>,
    done: &str,
    label: &'static str,
    notes: Vec<String>,
) -> Option<Diagnostic> {
    if notes.is_empty() {
        return None;
    }
    let title = format!("parts of `{}` were {done}", path.node);
    let diagnostic = Diagnostic::new(Code::MeshPartlyRead, title, path.span, label);
    Some(notes.into_iter().fold(diagnostic, Diagnostic::note))
}
