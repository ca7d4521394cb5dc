//! For whom a program is read.

use crate::axes::Word;
use crate::options::Settings;
use crate::statement::Scope;
use vcutc_backend_api::ir::Cell;

/// A machine and the options of a job.
#[derive(Clone, Copy)]
pub(super) struct Context<'a> {
    pub(super) cell: &'a Cell,
    pub(super) settings: &'a Settings<'a>,
    /// The machine's axes as words.
    pub(super) words: &'a [Word],
}

impl<'a> Context<'a> {
    /// What blocks are read with.
    pub(super) const fn scope(&self) -> Scope<'a> {
        Scope {
            words: self.words,
            approximation: self.settings.common.approximation,
        }
    }
}
