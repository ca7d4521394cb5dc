//! Surfaces of files that were read before, for repeated checks of the same job.
//!
//! To read a file of a million triangles and to look at all of them takes seconds, and between two runs the file hardly ever changes.
//! A surface is kept with all that it was made from: the hash of the file's bytes, how they are read, where they lie and the stock. Only
//! surfaces of which nothing was reported are kept, so that nothing is left unsaid the next time.

use crate::sema::part::Part;
use core::cell::RefCell;
use vcutc_backend_api::geometry::Frame;
use vcutc_backend_api::ir::Stock;
use vcutc_syntax::ast::SurfaceFile;

/// Most surfaces that are kept.
const MOST: usize = 4;

/// Surfaces that were read before; of several threads each has its own.
#[derive(Debug, Default)]
pub struct Surfaces {
    /// The latest one first.
    kept: RefCell<Vec<(Asked, Part)>>,
}

/// What a surface is made from.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Asked {
    /// The file: its length and its hash.
    pub(crate) content: String,
    pub(crate) kind: SurfaceFile,
    /// The ending of its name in small letters, which says how it is read.
    pub(crate) ending: String,
    /// Of its numbers, in mm, where the job states one.
    pub(crate) unit: Option<f64>,
    pub(crate) place: Frame,
    pub(crate) stock: Stock,
}

impl Surfaces {
    /// The part that was made from the same.
    pub(crate) fn find(&self, asked: &Asked) -> Option<Part> {
        let mut kept = self.kept.borrow_mut();
        let found = kept.iter().position(|(known, _)| known == asked)?;
        kept.get_mut(..=found)?.rotate_right(1);
        kept.first().map(|(_, part)| part.clone())
    }

    /// Keeps a part.
    pub(crate) fn keep(&self, asked: Asked, part: Part) {
        let mut kept = self.kept.borrow_mut();
        kept.insert(0, (asked, part));
        kept.truncate(MOST);
    }
}
