//! The distance that the middle plane of a straight blade keeps from the material that stays.

use vcutc_backend_api::units::Length;
use vcutc_diagnostics::number::show;
use vcutc_diagnostics::source::Span;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_job::StraightBlade;

/// The least one: half the thickness of the blade.
#[must_use]
pub fn least(blade: &StraightBlade) -> Length {
    blade.thickness.value / 2.0
}

/// A standoff with which the sides of the blade would enter what stays.
#[must_use]
pub fn too_small(blade: &StraightBlade, standoff: Length, span: Span) -> Diagnostic {
    let (standoff, least) = (show(standoff.to_mm()), show(least(blade).to_mm()));
    let thickness = show(blade.thickness.value.to_mm());
    Diagnostic::new(
        Code::OutOfRange,
        format!("with a standoff of {standoff} mm the blade's side would enter the part"),
        span,
        format!("less than half the blade's thickness, {least} mm"),
    )
    .and(
        blade.thickness.span.unwrap_or(blade.span),
        format!("{thickness} mm thick"),
    )
    .help(format!("use at least {least} mm, or leave it `auto`"))
    .fix("let the compiler choose: `auto`", span, "auto")
}
