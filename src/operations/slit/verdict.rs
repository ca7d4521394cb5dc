//! What a proof finds wrong with slits along walls, in words.

use crate::asked::SlitWalls;
use crate::plan::Plan;
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::number::show;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_process::verdict::floors::with_higher_floor;
use vcutc_process::verdict::words::explained as in_words;
use vcutc_region::distance::Walls;
use vcutc_region::foot::RESOLUTION;
use vcutc_region::place::Place;
use vcutc_simulation::prove::{CutFault, Finding, SlitFault};

pub(crate) fn explained(asked: &SlitWalls, plan: &Plan, finding: Finding) -> Diagnostic {
    match finding.fault {
        CutFault::Slit(SlitFault::Stays { by, limit }) if by.is_finite() => {
            stays(asked, plan, finding, (by, limit))
        }
        CutFault::Slit(SlitFault::Body { by, .. }) => {
            with_higher_floor(in_words(asked, finding), asked.floor.value, by)
        }
        _ => in_words(asked, finding),
    }
}

/// More stays at the foot of a wall than may.
fn stays(asked: &SlitWalls, plan: &Plan, finding: Finding, (by, limit): (Length, Length)) -> Diagnostic {
    let round = |value: f64| show((value * 100.0).round() / 100.0);
    let at = format!(
        "({} mm, {} mm)",
        round(finding.tip.x),
        round(finding.y.unwrap_or_default())
    );
    let knife = plan.knife;
    let wide = knife.height * libm::tan(knife.half_apex);
    let by = (by.to_mm() * 1e3).ceil() / 1e3;
    let diagnostic = Diagnostic::new(
        Code::WallLeft,
        format!(
            "{} mm of core stays at the foot of the wall of `{}` at {at}, but the limit is {} mm; {} mm above its tip `{}` is {} mm wide",
            show(by),
            asked.region.name,
            show(limit.to_mm()),
            round(knife.height),
            asked.blade.name,
            round(2.0 * wide)
        ),
        asked.region_span,
        "more stays at the foot than may",
    );
    let diagnostic = match asked.residual.span {
        Some(span) => diagnostic.and(span, "the limit"),
        None => diagnostic.note("the default limit is 0.1 mm"),
    };
    // The proof's bound is above what stays by no more than its resolution, and by what rounding takes.
    let far = asked.allowance.value.to_mm() + limit.to_mm() - 2.0 * RESOLUTION;
    let mut ways = Vec::new();
    let at = Place::new(finding.tip.x, finding.y.unwrap_or_default());
    let hollow = hollow_at(asked, at);
    let least = knife
        .least_radius(far)
        .map(|least| (least * 100.0).ceil() / 100.0);
    if let (Some(least), Some(radius)) = (least, hollow)
        && least > radius
    {
        ways.push(format!("a hollow radius of at least {} mm", show(least)));
        let floor = plan.top - knife.most_height(radius, far);
        ways.push(format!(
            "a floor at {} mm or above",
            show((floor * 100.0).ceil() / 100.0)
        ));
    } else {
        ways.push("a floor higher up".to_owned());
    }
    ways.push("a narrower blade".to_owned());
    let diagnostic = diagnostic.help(format!("use {}", ways.join(", or ")));
    let limit = format!("{} mm", show(by));
    match asked.residual.span {
        Some(span) => diagnostic.fix(format!("let {limit} stay"), span, limit),
        None => diagnostic.help(format!("or let it stay: `limits {{ residual <= {limit} }}`")),
    }
}

/// The radius of the hollow wall at a place, if one is there.
fn hollow_at(asked: &SlitWalls, at: Place) -> Option<f64> {
    let region = &asked.region.region;
    let edge = Walls::of(region).nearest(at)?.edge;
    let wall = region.edges().nth(edge)?.piece;
    wall.radius().filter(|_| wall.sweep > 0.0)
}
