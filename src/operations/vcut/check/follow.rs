//! What does not go with cuts that rise and fall with the part.

use crate::asked::{Avoid, Compensate, RoughVcut};
use vcutc_backend_api::units::Angle;
use vcutc_diagnostics::number::show;
use vcutc_diagnostics::source::Span;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_job::Auto;
use vcutc_job::follow::Family;

/// The smallest swing of cuts that are not level ([`vcutc_geometry::spine::Spine::STEEPEST_FLANK`]).
pub(crate) const NARROWEST_ALONG: Angle = Angle::deg(5.0);

/// A field that only level cuts take, of an operation whose cuts are not.
pub(crate) fn misfit(operation: &RoughVcut) -> Option<Diagnostic> {
    if operation.family == Family::Straight {
        return None;
    }
    if operation.avoid.value == Avoid::Swing {
        return Some(narrower_along(operation));
    }
    if let Auto::Given(swing) = operation.swing.value
        && swing < NARROWEST_ALONG
    {
        return Some(too_narrow_along(operation, swing));
    }
    (operation.compensate.value == Compensate::Forces).then(|| compensated_along(operation))
}

/// A value that only level cuts take, of an operation whose cuts follow a spine.
struct LevelOnly {
    field: &'static str,
    value: &'static str,
    span: Option<Span>,
    label: &'static str,
    /// What the other value does, and its word.
    instead: (&'static str, &'static str),
}

impl LevelOnly {
    fn refused(self, operation: &RoughVcut) -> Diagnostic {
        let Self { field, value, .. } = self;
        let head = operation.setup.head_span;
        let place = self.span.unwrap_or(head);
        let word = operation.family.word();
        let (title, other) = self.instead;
        Diagnostic::new(
            Code::CannotFollow,
            format!("`{field} = {value}` does not go with `follow = {word}`"),
            place,
            self.label,
        )
        .and(
            operation.follow.span.unwrap_or(head),
            "these cuts rise and fall with the part",
        )
        .help(format!("delete `{field}`, or cut straight"))
        .fix(format!("{title}: `{other}`"), place, other)
    }
}

/// Narrower flanks along a spine.
fn narrower_along(operation: &RoughVcut) -> Diagnostic {
    let narrower = LevelOnly {
        field: "avoid",
        value: Avoid::Swing.word(),
        span: operation.avoid.span,
        label: "narrower flanks are cut straight only",
        instead: ("raise tips where Vs do not fit", Avoid::Lift.word()),
    };
    narrower.refused(operation)
}

/// Tips offset along a spine.
fn compensated_along(operation: &RoughVcut) -> Diagnostic {
    let compensated = LevelOnly {
        field: "compensate",
        value: Compensate::Forces.word(),
        span: operation.compensate.span,
        label: "only tips of level cuts are offset",
        instead: (
            "leave the tips where they are planned",
            Compensate::Nothing.word(),
        ),
    };
    compensated.refused(operation)
}

/// A swing with which a blade that is off its spine by a little spoils much of its flank.
fn too_narrow_along(operation: &RoughVcut, swing: Angle) -> Diagnostic {
    let head = operation.setup.head_span;
    let word = operation.family.word();
    let (swing, least) = (show(swing.to_deg()), show(NARROWEST_ALONG.to_deg()));
    Diagnostic::new(
        Code::CannotFollow,
        format!("a swing of {swing} deg is too narrow for `follow = {word}`"),
        operation.swing.span.unwrap_or(head),
        format!("cuts that rise and fall take at least {least} deg"),
    )
    .and(
        operation.follow.span.unwrap_or(head),
        "these cuts rise and fall with the part",
    )
    .help(format!("use a `swing` of at least {least} deg, or cut straight"))
}
