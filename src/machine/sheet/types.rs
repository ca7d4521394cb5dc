//! What the forms of sheets share: one is for robots, one for five-axis machines.

use crate::facts::Sources;
use crate::kinematics::Mechanism;
use vcutc_backend_api::ir::{Axis, Maker};
use vcutc_diagnostics::Diagnostic;
use vcutc_diagnostics::document::table::Table;
use vcutc_diagnostics::schema::field::FieldSpec;

/// How sheets of one kind of machine are read.
#[derive(Clone, Copy)]
pub(super) struct Form {
    /// The fields of the sheet as a whole, in addition to those that all sheets have.
    pub(super) fields: &'static [FieldSpec],
    /// Reads what is particular to the kind.
    pub(super) read: fn(&Table<'_>, Maker, &mut Vec<Diagnostic>) -> Option<Body>,
}

/// What is particular to one kind of machine.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Body {
    pub(super) axes: Vec<Axis>,
    /// How they move the flange; none when a fault has been found in it.
    pub(super) mechanism: Option<Mechanism>,
    /// Where the numbers come from.
    pub(super) sources: Vec<Sources>,
    /// For [`Facts::remarks`](crate::facts::Facts::remarks).
    pub(super) remarks: Vec<String>,
}
