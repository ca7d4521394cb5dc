//! A field of `limits` that is bounded from below and above.

use super::fields::Fields;
use super::quantity::{Measured, Quantity};
use super::read::Reader;
use super::report::Checked;
use crate::{Bounds, Sourced};
use vcutc_diagnostics::source::Span;
use vcutc_diagnostics::{Code, Diagnostic};

/// Bounds from below and above, which must leave something between them.
pub fn both<T: Measured + Copy + PartialOrd>(
    fields: &Fields<'_>,
    name: &str,
    reader: &mut Reader<'_>,
) -> Checked<Bounds<T>> {
    let least: Checked<Option<Sourced<T>>> = reader.least(fields, name);
    let most: Checked<Option<Sourced<T>>> = reader.optional(fields, name);
    let bounds = Bounds {
        least: least?,
        most: most?,
    };
    if let (Some(least), Some(most)) = (bounds.least, bounds.most)
        && least.value > most.value
        && let (Some(low), Some(high)) = (least.span, most.span)
    {
        return Err(reader
            .reports
            .push(crossed(name, (text(least.value), low), (text(most.value), high))));
    }
    Ok(bounds)
}

fn text<T: Measured>(value: T) -> String {
    Quantity::new(value.to_base(), T::DIMENSION).text()
}

/// Bounds that no value keeps.
fn crossed(name: &str, (least, low): (String, Span), (most, high): (String, Span)) -> Diagnostic {
    Diagnostic::new(
        Code::OutOfRange,
        format!("no `{name}` is at least {least} and at most {most}"),
        low,
        format!("at least {least}"),
    )
    .and(high, format!("at most {most}"))
    .fix_all(
        format!("swap the two: at least {most} and at most {least}"),
        &[(low, most), (high, least)],
    )
}
