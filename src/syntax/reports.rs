//! The list of what is wrong with one file's text, kept to a length that people read.

use vcutc_diagnostics::Diagnostic;

/// Most mistakes of one file that are reported; after so many the rest tends to be consequences.
const MOST: usize = 20;

/// What is wrong, with a count of what was left out.
#[derive(Debug, Default)]
pub(super) struct Reports {
    list: Vec<Diagnostic>,
    left_out: usize,
}

impl Reports {
    /// Takes one up, or counts it once the list is full.
    pub(super) fn push(&mut self, report: Diagnostic) {
        self.push_with(|| report);
    }

    /// As [`Reports::push`], for reports that are costly to make.
    pub(super) fn push_with(&mut self, report: impl FnOnce() -> Diagnostic) {
        if self.list.len() < MOST {
            self.list.push(report());
        } else {
            self.left_out += 1;
        }
    }

    /// The list in the order of the text; the last one says how many more there are.
    pub(super) fn finish(mut self) -> Vec<Diagnostic> {
        self.list.sort_by_key(|report| report.primary.span);
        if self.left_out > 0
            && let Some(last) = self.list.last_mut()
        {
            last.notes.push(format!(
                "{} more mistakes of this kind in this file are not shown",
                self.left_out
            ));
        }
        self.list
    }
}
