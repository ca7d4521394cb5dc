//! Where the checks put what they find, and the token that proves that a fault has been reported.
//!
//! A check that cannot go on returns [`Reported`], which only [`Reports::push`] makes. So nothing fails silently, and
//! code that builds on the failed part stays quiet instead of reporting a consequence.

use vcutc_diagnostics::Diagnostic;

/// Proof that a diagnostic has been reported.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Reported(());

/// A value, or the proof that its fault has been reported.
pub type Checked<T> = Result<T, Reported>;

/// The diagnostics of one run, or of one trial evaluation.
#[derive(Debug, Default)]
pub struct Reports {
    diagnostics: Vec<Diagnostic>,
}

impl Reports {
    /// Takes a diagnostic.
    pub fn push(&mut self, diagnostic: Diagnostic) -> Reported {
        self.diagnostics.push(diagnostic);
        Reported(())
    }

    /// How many there are.
    pub const fn count(&self) -> usize {
        self.diagnostics.len()
    }

    /// Takes what another stage has found; the token when that was anything.
    pub fn append(&mut self, found: Vec<Diagnostic>) -> Option<Reported> {
        let token = (!found.is_empty()).then_some(Reported(()));
        self.diagnostics.extend(found);
        token
    }

    /// Takes what was found by a second look at the same text, but for faults whose place has that fault already.
    pub fn append_new(&mut self, found: Self) {
        let is_known = |one: &Diagnostic| {
            let mut known = self.diagnostics.iter();
            known.any(|known| known.code == one.code && known.primary.span == one.primary.span)
        };
        let new: Vec<Diagnostic> = found
            .diagnostics
            .into_iter()
            .filter(|one| !is_known(one))
            .collect();
        self.diagnostics.extend(new);
    }

    /// Whether there are more than anybody reads in one go, so that it is time to be brief.
    pub const fn are_many(&self) -> bool {
        self.diagnostics.len() > 200
    }

    /// All of them, in the order in which they were found.
    pub fn into_vec(self) -> Vec<Diagnostic> {
        self.diagnostics
    }
}
