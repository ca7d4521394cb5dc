//! Holes of the stock, such as `hole(x = 40 mm, y = 30 mm, radius = 8 mm)`.

use super::arguments::{Parameter, calls};
use super::field_ranges::{COORDINATE, SIZE};
use super::fields::Fields;
use super::read::{Reader, sourced};
use super::report::Checked;
use crate::{Hole, Sourced};
use vcutc_backend_api::units::Length;

/// How a hole is written.
pub const HOLE: &str = "hole(x = 40 mm, y = 30 mm, radius = 8 mm)";

/// The call that says where a hole is.
pub const CALLS: &[(&str, &str)] = &[("hole", HOLE)];

const VALUES: &[Parameter<'_>; 3] = &[
    Parameter {
        name: "x",
        range: COORDINATE,
        typical: "40 mm",
    },
    Parameter {
        name: "y",
        range: COORDINATE,
        typical: "30 mm",
    },
    Parameter {
        name: "radius",
        range: SIZE,
        typical: "8 mm",
    },
];

/// The hole of a field, if it is given.
pub fn read(name: &str, fields: &Fields<'_>, reader: &mut Reader<'_>) -> Checked<Option<Sourced<Hole>>> {
    let Some(expr) = fields.value(name)? else {
        return Ok(None);
    };
    let call = calls(name, expr, CALLS, reader.reports)?;
    let [x, y, radius] = call.named(VALUES, reader)?.map(Length::mm);
    Ok(Some(sourced(Hole { x, y, radius }, expr.span)))
}
