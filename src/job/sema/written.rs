//! A block of an operation as it is written, with what its check may look at.

use super::eval::Scope;
use super::fields::Place;
use super::report::Checked;

use crate::{Blade, NamedRegion};
use vcutc_backend_api::ir::Stock;
use vcutc_diagnostics::source::Spanned;
use vcutc_syntax::ast::Block;

/// A block of an operation.
#[derive(Clone, Copy)]
pub struct Written<'a> {
    /// The block.
    pub block: &'a Block,
    /// Where it is.
    pub place: Place,
    /// The names that its values may use.
    pub scope: Scope<'a>,
    /// The blades of the job, in order.
    pub blades: &'a [Checked<Blade>],
    /// The regions of the job, in order.
    pub regions: &'a [Checked<NamedRegion>],
    /// The stock, unless it is at fault.
    pub stock: Option<Spanned<Stock>>,
}
