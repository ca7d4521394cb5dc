//! Larger limits on the scallop than a job's, to be offered.

use super::refusal::{Ladder, Offer};
use crate::asked::RoughVcut;
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::number::show;

/// How much wider each limit on scallop that may do is than the one before, and how many there are: far enough from the
/// finest surface to the coarsest.
const WIDER: f64 = 1.6;
const MOST_WIDER: i32 = 14;

/// Larger limits on scallop than the job's, and than what stays on the part anyway.
pub(super) fn wider_scallops(asked: &RoughVcut, stays: Length) -> Ladder {
    let Some(limit) = asked.limits.scallop else {
        return Vec::new();
    };
    let Some(span) = limit.span else {
        return Vec::new();
    };
    let narrowest = limit.value.max(stays).to_mm();
    (1..=MOST_WIDER)
        .map(|count| {
            let wide = narrowest * libm::pow(WIDER, f64::from(count));
            let per_mm = if wide < 1.0 { 100.0 } else { 10.0 };
            let wide = (wide * per_mm).ceil() / per_mm;
            let mut changed = asked.clone();
            if let Some(limit) = &mut changed.limits.scallop {
                limit.value = Length::mm(wide);
            }
            let text = format!("{} mm", show(wide));
            Offer {
                title: format!("use `scallop <= {text}`"),
                edits: vec![(span, text)],
                changed,
            }
        })
        .collect()
}
