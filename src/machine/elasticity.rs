//! The part of a sheet that describes how the joints of an arm yield.
//!
//! ```toml
//! [elasticity]
//! stiffness_nm_rad = [2.2072e6, 3.3767e6, 2.7757e6, 2.3502e6, 2.1575e6, 0.4671e6]
//! spread = [0.08, 0.02, 0.02, 0.39, 0.15, 0.04]
//! confidence = "measured"
//! source = "our own identification, protocol 21"
//! ```
//!
//! Each joint is a spring between its motor, which the control holds in place, and its link. Links, foot, tool and blade are taken as
//! stiff, and backlash is not in the numbers.

use super::masses::{Backing, backing};
use super::ranges::{SPREAD, STIFFNESS};
use vcutc_diagnostics::Diagnostic;
use vcutc_diagnostics::document::table::Table;
use vcutc_diagnostics::schema::field::{FieldSpec, optional, value};

/// Its heading.
pub(super) const KEY: &str = "elasticity";

/// How the joints of an arm yield.
#[derive(Clone, Debug, PartialEq)]
pub struct Elasticity {
    /// At the controller's axes, in Nm/rad; positive.
    pub stiffness: [f64; 6],
    /// By which share of itself each of them may be off, either way; at least 0 and below 1.
    pub spread: [f64; 6],
    pub backing: Backing,
    pub sources: Vec<String>,
}

const FIELDS: &[FieldSpec] = &[
    value("stiffness_nm_rad", "[2.2e6, 3.4e6, 2.8e6, 2.4e6, 2.2e6, 0.47e6]")
        .required()
        .within(STIFFNESS),
    value("spread", "[0.1, 0.1, 0.1, 0.4, 0.2, 0.1]")
        .required()
        .within(SPREAD),
    optional("confidence"),
    value("source", "\"our own identification\"").required(),
    optional("note"),
];

impl Elasticity {
    /// Reads the table, when the sheet has one.
    pub(super) fn read(root: &Table<'_>, faults: &mut Vec<Diagnostic>) -> Option<Self> {
        let table = root.table(KEY, FIELDS, faults)?;
        let stiffness = table.numbers("stiffness_nm_rad", faults);
        let spread = table.numbers("spread", faults);
        table.text("note", faults);
        Some(Self {
            backing: backing(&table, faults),
            sources: table.texts("source", faults),
            stiffness: stiffness?,
            spread: spread?,
        })
    }
}
