//! The value chosen for an `auto`, at its place.

use super::analysis::Analysis;
use super::sites::Site;

/// The result for a field that was left open.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Chosen {
    /// This, and why.
    As {
        /// The value, as it would be written.
        value: String,
        /// What was compared, or what kept it from coming out better; empty if there is nothing to say.
        why: String,
    },
    /// Nothing is known: the job is not planned yet, or cannot be.
    Unknown,
}

/// What became of the `auto` at a site.
pub(super) fn chosen(analysis: &Analysis, path: &str, site: &Site<'_>) -> Chosen {
    match looked_up(analysis, path, site) {
        Some((value, why)) => Chosen::As { value, why },
        None => Chosen::Unknown,
    }
}

fn looked_up(analysis: &Analysis, path: &str, site: &Site<'_>) -> Option<(String, String)> {
    // Only the job's own file has operations.
    if analysis.root != path {
        return None;
    }
    let field = site.place.field?.name;
    let plan = analysis.planned()?.plan.as_ref()?;
    plan.operations.get(site.place.operation?)?.chosen(field)
}
