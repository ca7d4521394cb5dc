//! What is made of warnings.

use vcutc_diagnostics::{Code, Diagnostic, has_errors};

/// What is made of warnings.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Warnings {
    Shown,
    /// They end a run as errors do: nothing is written.
    Denied {
        /// But these are only shown.
        allowed: Vec<Code>,
    },
}

impl Warnings {
    /// Whether the diagnostics keep a run from writing anything.
    pub(super) fn refuse(&self, diagnostics: &[Diagnostic]) -> bool {
        has_errors(diagnostics)
            || match self {
                Self::Shown => false,
                Self::Denied { allowed } => diagnostics.iter().any(|one| !allowed.contains(&one.code)),
            }
    }

    /// Why nothing was written, where it is not for errors.
    pub(super) fn remark(&self, diagnostics: &[Diagnostic]) -> Option<&'static str> {
        let is_for_warnings = self.refuse(diagnostics) && !has_errors(diagnostics);
        is_for_warnings.then_some("warnings are denied")
    }
}
