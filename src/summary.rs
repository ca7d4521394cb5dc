//! The figures of a program for people: a few lines behind a compilation.

pub mod air;
pub mod times;

use crate::job::Order;
use crate::pace::Basis;
use crate::plan::decision::{Decision, Excess, Standing};
use crate::plan::parameters::show;
use crate::plan::{PlannedJob, PlannedOperation};
use crate::reach_summary::{self, ReachFigures};
use crate::sim::report::Report;
use vcutc_backend_api::script::duration_words;
use vcutc_backend_api::units::Duration;

/// Most layers whose cuts are listed one by one.
const LISTED_LAYERS: usize = 24;

/// The lines of the summary.
#[must_use]
pub fn summary(
    plan: &PlannedJob,
    report: &Report,
    basis: Basis,
    reach: Option<&ReachFigures>,
) -> Vec<String> {
    let (cuts, layers) = (report.cuts(), report.layers.len());
    let mut lines = vec![format!(
        "{}: {cuts} {} in {layers} {}",
        plan.name,
        if cuts == 1 { "cut" } else { "cuts" },
        if layers == 1 { "layer" } else { "layers" },
    )];
    lines.push(row("per layer", &cuts_per_layer(report)));
    for operation in &plan.operations {
        let PlannedOperation::RoughVcut(vcut) = operation;
        let choices: Vec<String> = vcut
            .parameters
            .choices(&vcut.asked)
            .iter()
            .map(|c| format!("{} = {}", c.name, c.value))
            .collect();
        if !choices.is_empty() {
            lines.push(row("auto", &choices.join(", ")));
        }
        let reasons = vcut.parameters.reasons(&vcut.asked);
        if !reasons.is_empty() {
            lines.push(row("bound by", &reasons.join(", ")));
        }
        for decision in &vcut.decisions {
            lines.push(row(decision.field, &compared(decision)));
        }
    }
    lines.push(row("time", &times::in_all(&report.times.all)));
    lines.push(row("basis", &times::basis(basis)));
    let estimate = plan
        .operations
        .iter()
        .map(|PlannedOperation::RoughVcut(vcut)| vcut.estimate)
        .sum();
    lines.push(row(
        "estimate",
        &format!(
            "{} by the mean-value model, from the parameters alone{}",
            time(estimate),
            against(estimate, report.times.all.total(), &why_else(plan))
        ),
    ));
    lines.push(row(
        "area",
        &format!(
            "{:.1} mm2 removed, {:.1} mm2 stay on the part",
            report.removed.to_mm2(),
            report.residual.to_mm2()
        ),
    ));
    lines.push(row(
        "scallop",
        &format!(
            "at most {:.2} mm at x {:.1} mm, {:.2} mm on average; contours correlate to {:.2} %{}",
            report.scallop.height.to_mm(),
            report.scallop.peak.x,
            report.mean_scallop.to_mm(),
            report.correlation * 100.0,
            hollow(report)
        ),
    ));
    lines.push(row(
        "edge",
        &format!("{} mm in use at most", show(report.longest_edge.to_mm())),
    ));
    if reach.is_some() {
        lines.push(row("in hand", IN_HAND));
    }
    let reach = reach.into_iter().flat_map(reach_summary::lines);
    lines.extend(reach.map(|(name, text)| row(name, &text)));
    lines
}

/// What of the blade no proof can see.
const IN_HAND: &str = "check how the blade is clamped: leading edge at tool x, flat square to tool y (docs/language.md, `tool`)";

/// `mixed: 1 min 52.0 s; lift 1 min 58.3 s; discard leaves 11.2 mm (limit 10 mm)`.
#[must_use]
pub fn compared(decision: &Decision) -> String {
    let others = decision
        .others
        .iter()
        .map(|other| format!("; {} {}", other.what, standing(other.standing)));
    let taken = &decision.taken;
    format!("{}: {}", taken.what, standing(taken.standing)) + &others.collect::<String>()
}

fn standing(standing: Standing) -> String {
    match standing {
        Standing::Takes(duration) => time(duration),
        Standing::Exceeds(Excess::Time { time: taken, limit }) => {
            format!("{} (limit {})", time(taken), time(limit))
        }
        Standing::Exceeds(Excess::Cuts { cuts, limit }) => {
            format!("{cuts} cuts (limit {})", show(limit.floor()))
        }
        Standing::Leaves { height, limit } => format!(
            "leaves {:.2} mm (limit {} mm)",
            height.to_mm(),
            show((limit.to_mm() * 100.0).floor() / 100.0)
        ),
        Standing::Fails(1) => "leaves a chip".to_owned(),
        Standing::Fails(count) => format!("leaves {count} chips"),
        Standing::Impossible => "cuts nothing".to_owned(),
        Standing::ByModel(duration) => format!("{} by the model, not planned", time(duration)),
        Standing::Last => "the machine does not follow the others".to_owned(),
        Standing::Narrowed => "the widest tried that the machine follows".to_owned(),
        Standing::NotFollowed => "the machine does not follow".to_owned(),
        Standing::LeftOut => "left out, for the machine did not follow".to_owned(),
        Standing::NotCompared => "not compared, there are too many cuts".to_owned(),
    }
}

/// What there is to say where the part is farther from the machined contour than that is from the part.
fn hollow(report: &Report) -> String {
    let Some(deepest) = report.hollow() else {
        return String::new();
    };
    format!(
        "; the part lies up to {:.2} mm from the machined contour at x {:.1} mm",
        deepest.height.to_mm(),
        deepest.peak.x
    )
}

fn row(name: &str, text: &str) -> String {
    format!("  {name:<10} {text}")
}

/// `, 4.2 % above the time`: how far the model and the planned program agree.
fn against(estimate: Duration, planned: Duration, why: &str) -> String {
    if planned <= Duration::ZERO {
        return String::new();
    }
    let percent = (estimate.to_s() / planned.to_s() - 1.0) * 100.0;
    let way = if percent < 0.0 { "below" } else { "above" };
    let why = if percent.abs() > FAR_APART { why } else { "" };
    format!(", {:.1} % {way} the time{why}", percent.abs())
}

/// From so many percent on it is said why model and program differ.
const FAR_APART: f64 = 20.0;

/// What the mean-value model does not see of a plan: where the part and the sides of the stock take Vs away or ask for more, and
/// that the route turns the blade less.
fn why_else(plan: &PlannedJob) -> String {
    let vcuts = || {
        plan.operations
            .iter()
            .map(|PlannedOperation::RoughVcut(vcut)| vcut)
    };
    let planned: usize = vcuts().map(|vcut| vcut.cuts.len()).sum();
    let estimated: f64 = vcuts().map(|vcut| vcut.estimated_cuts).sum();
    let is_by_layer = vcuts().any(|vcut| vcut.order == Order::Layer);
    let counts = format!(": it reckons with {estimated:.0} cuts for the mean depth, the plan has {planned}");
    let turns = if is_by_layer {
        "; it does not know of `order = layer`, which turns the blade less"
    } else {
        ""
    };
    counts + turns
}

fn cuts_per_layer(report: &Report) -> String {
    let listed: Vec<String> = report
        .layers
        .iter()
        .take(LISTED_LAYERS)
        .map(|(_, cuts)| cuts.to_string())
        .collect();
    let more = report.layers.len().saturating_sub(LISTED_LAYERS);
    let rest = if more > 0 {
        format!(" ... and {more} layers more")
    } else {
        String::new()
    };
    listed.join(" ") + &rest
}

/// `1 h 02 min 03 s`, `2 min 05.4 s`, `5.4 s`.
#[must_use]
pub fn time(duration: Duration) -> String {
    duration_words(duration)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_model_is_held_against_the_planned_time() {
        let shown =
            |estimate: f64, planned: f64| against(Duration::s(estimate), Duration::s(planned), ": why");
        assert_eq!(shown(90.0, 100.0), ", 10.0 % below the time");
        assert_eq!(shown(101.26, 100.0), ", 1.3 % above the time");
        assert_eq!(shown(130.0, 100.0), ", 30.0 % above the time: why");
        assert_eq!(shown(1.0, 0.0), "");
    }

    #[test]
    fn times_never_show_sixty_seconds() {
        let shown = |seconds: f64| time(Duration::s(seconds));
        assert_eq!(shown(5.44), "5.4 s");
        assert_eq!(shown(59.96), "1 min 00.0 s");
        assert_eq!(shown(125.4), "2 min 05.4 s");
        assert_eq!(shown(3599.7), "1 h 00 min 00 s");
        assert_eq!(shown(3723.2), "1 h 02 min 03 s");
    }
}
