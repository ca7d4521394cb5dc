//! Holes that a tool is to go down in.

use crate::asked::ClearPocket;
use vcutc_diagnostics::number::show;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_region::distance::Walls;
use vcutc_region::place::Place;

/// The hole, if the tool does not fit into it or it does not lie within the region.
pub(super) fn out_of_place(asked: &ClearPocket) -> Option<Diagnostic> {
    let opening = asked.opening?;
    let span = opening.span.unwrap_or(asked.setup.head_span);
    let (hole, radius) = (opening.value, asked.crusher.radius);
    if hole.radius < radius.value {
        let diagnostic = Diagnostic::new(
            Code::NoEntry,
            format!(
                "`{}` has a radius of {} mm, the opening {} mm",
                asked.crusher.name,
                show(radius.value.to_mm()),
                show(hole.radius.to_mm())
            ),
            span,
            "narrower than the tool",
        );
        let by = radius.span.unwrap_or(asked.crusher.span);
        return Some(
            diagnostic
                .and(by, "its radius")
                .help("use a narrower tool, or delete `opening`: the tool then goes down a ramp or a helix"),
        );
    }
    let region = &asked.region.region;
    let at = Place::new(hole.x.to_mm(), hole.y.to_mm());
    let to_wall = Walls::of(region).distance(at);
    let is_within = region.contains(at) && to_wall >= hole.radius.to_mm() - ROUNDING;
    if is_within {
        return None;
    }
    let (message, help) = if region.contains(at) {
        (
            format!(
                "the opening has a radius of {} mm, and the nearest wall of `{}` is {} mm from its middle",
                show(hole.radius.to_mm()),
                asked.region.name,
                show((to_wall * 1e3).floor() / 1e3)
            ),
            "give it another place, or the radius that is open within the walls",
        )
    } else {
        (
            format!(
                "the middle of the opening, ({} mm, {} mm), lies outside of `{}`",
                show(at.x),
                show(at.y),
                asked.region.name
            ),
            "give it a place within the region",
        )
    };
    let diagnostic = Diagnostic::new(Code::NoEntry, message, span, "not within the region");
    Some(diagnostic.and(asked.region_span, "the region").help(help))
}

/// How far a hole may be beyond a wall by rounding, in mm.
const ROUNDING: f64 = 1e-6;
