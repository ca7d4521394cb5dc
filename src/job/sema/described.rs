//! Files that describe machines, and the profiles of their post-processors.

use super::files::{Relative, not_loaded, text_of};
use super::report::Checked;
use super::session::Session;
use vcutc_diagnostics::source::{FileId, Span};
use vcutc_diagnostics::{Code, Diagnostic};

/// What a file describes. Each of its faults is reported with the place where the file is named.
pub(crate) fn read<T>(
    path: &str,
    relative: Relative,
    named_at: Span,
    session: &mut Session<'_>,
    parse: impl FnOnce(FileId, &str) -> Result<T, Vec<Diagnostic>>,
) -> Checked<T> {
    let bytes = session.loader.load(path).map_err(|error| {
        let diagnostic = not_loaded(&named_at, path, relative, &error, session);
        session.reports.push(diagnostic)
    })?;
    let (file, fault) = text_of(session, path, bytes, Some(named_at));
    if let Some(reported) = fault {
        return Err(reported);
    }
    let text = session.sources.get(file).map_or("", |file| file.text.as_str());
    parse(file, text).map_err(|faults| {
        let named = |fault: Diagnostic| fault.and(named_at, "the file is named here");
        match session.reports.append(faults.into_iter().map(named).collect()) {
            Some(reported) => reported,
            None => session.reports.push(unexplained(path, named_at)),
        }
    })
}

/// A reader that refuses a file without saying why.
fn unexplained(path: &str, named_at: Span) -> Diagnostic {
    Diagnostic::new(
        Code::Internal,
        format!("`{path}` is refused without a reason"),
        named_at,
        "the file is named here",
    )
}
