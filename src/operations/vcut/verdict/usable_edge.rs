//! What the edge of a cut is compared with.

use crate::asked::RoughVcut;
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::number::show;
use vcutc_diagnostics::source::Span;

/// What the edge of a cut is compared with: the blade's, or the limit on it.
pub(super) struct UsableEdge {
    pub(super) span: Span,
    /// In a sentence: `the blade has 10 mm`.
    pub(super) has: String,
    /// After `more edge than`.
    pub(super) than: &'static str,
    pub(super) label: String,
}

impl UsableEdge {
    pub(super) fn of(asked: &RoughVcut, available: Length) -> Self {
        let (blade, length) = (&asked.blade, show(available.to_mm()));
        match asked.limits.edge {
            Some(limit) if limit.value < blade.cutting_length.value => Self {
                span: limit.span.unwrap_or(asked.setup.head_span),
                has: format!("the limit is {length} mm"),
                than: "the limit allows",
                label: "the limit".to_owned(),
            },
            Some(_) | None => Self {
                span: blade.cutting_length.span.unwrap_or(blade.span),
                has: format!("the blade has {length} mm"),
                than: "the blade has",
                label: format!("{length} mm of edge"),
            },
        }
    }
}
