//! What a proof finds wrong with a pocket that is freed, in words.

use crate::asked::FreePocket;
use vcutc_diagnostics::number::show;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_process::verdict::floors::with_higher_floor;
use vcutc_process::verdict::words::explained as in_words;
use vcutc_simulation::prove::{ClearingFault, CutFault, Finding, SlitFault};

pub(crate) fn explained(asked: &FreePocket, finding: Finding) -> Diagnostic {
    match finding.fault {
        CutFault::Clearing(ClearingFault::Pillars { area, limit }) => {
            let area = show((area.to_mm2() * 10.0).ceil() / 10.0);
            let limits = asked.limits.pillars.and_then(|limit| limit.span);
            let diagnostic = Diagnostic::new(
                Code::PillarsStay,
                format!(
                    "{area} mm2 in the corners of `{}` are beyond the rim of `{}`, which has a radius of {} mm; the limit on pillars is {} mm2",
                    asked.region.name,
                    asked.disc.name,
                    show(asked.disc.radius.value.to_mm()),
                    show(limit.to_mm2())
                ),
                asked.region_span,
                "has corners that are sharper than the rim",
            )
            .help("use a smaller disc, rounder corners, or clear the corners with a crusher");
            match limits {
                Some(span) => diagnostic
                    .and(asked.disc.radius.span.unwrap_or(asked.disc.span), "its radius")
                    .fix(format!("let {area} mm2 stand"), span, format!("{area} mm2")),
                None => diagnostic,
            }
        }
        CutFault::Slit(SlitFault::Body { by, .. }) => {
            with_higher_floor(in_words(asked, finding), asked.floor.value, by)
        }
        CutFault::Slit(SlitFault::Stays { by, .. }) if by.is_finite() => in_words(asked, finding).help(
            "use a narrower straight blade, a larger hollow radius, or a wider `limits { residual <= ... }`",
        ),
        CutFault::Clearing(ClearingFault::Body { .. }) => {
            in_words(asked, finding).help("use a disc whose body is slimmer down there")
        }
        _ => in_words(asked, finding),
    }
}
