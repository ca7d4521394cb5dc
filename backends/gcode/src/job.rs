//! What blocks are made from.

use crate::axes::{Word, WorkInOffset};
use crate::controller::ToolNumbers;
use crate::options::Settings;
use crate::tools;
use vcutc_backend_api::ir::ToolId;
use vcutc_backend_api::script::Source;

/// A program, its machine and the options of its job.
#[derive(Clone, Copy)]
pub(crate) struct Job<'a> {
    /// The program and its machine.
    pub(crate) source: Source<'a>,
    /// The options.
    pub(crate) settings: &'a Settings<'a>,
    /// The machine's axes as words.
    pub(crate) words: &'a [Word],
    /// The way into the frame of the work offset.
    pub(crate) work_in_offset: WorkInOffset,
}

impl<'a> Job<'a> {
    /// A program on a machine with these axes.
    pub(crate) fn new(source: Source<'a>, settings: &'a Settings<'a>, words: &'a [Word]) -> Self {
        Self {
            source,
            settings,
            words,
            work_in_offset: WorkInOffset::new(source.cell.base.frame.orientation),
        }
    }

    /// What the control knows a tool by.
    pub(crate) fn tool(&self, id: ToolId) -> ToolNumbers {
        tools::numbers(self.source.cell, self.settings, id)
    }
}
