//! The figures of a program for people: a headline, and a few lines below it.

pub mod air;
pub mod chosen;
pub mod times;

use crate::checks::Checks;
use vcutc_backend_api::script::duration_words;
use vcutc_backend_api::units::{Duration, Length};
use vcutc_job::{Order, RoughVcut, WhyChosen};
use vcutc_motion::pace::Basis;
use vcutc_motion::summary::{self as reach_summary, ReachFigures};
use vcutc_process::plan::decision::{Decision, Excess, Standing};
use vcutc_process::plan::parameters::show;
use vcutc_process::plan::{PlannedJob, PlannedOperation, PlannedVcut};
use vcutc_process::sim::report::Report;

/// Most layers whose cuts are listed one by one.
const LISTED_LAYERS: usize = 24;

/// The lines of the summary: the answer first, then what it is made of.
#[must_use]
pub fn summary(
    plan: &PlannedJob,
    report: &Report,
    basis: Basis,
    reach: Option<&ReachFigures>,
) -> Vec<String> {
    let mut lines = vec![headline(plan, report, basis, reach)];
    lines.push(row("per layer", &cuts_per_layer(report)));
    for PlannedOperation::RoughVcut(vcut) in &plan.operations {
        lines.extend(of_operation(vcut, report));
    }
    lines.push(row("time", &times::in_all(&report.times.all)));
    lines.push(row("basis", &times::basis(basis)));
    lines.push(row("estimate", &estimate(plan, report)));
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
            "at most {:.2} mm at x {:.1} mm, {:.2} mm on average",
            report.scallop.height.to_mm(),
            report.scallop.peak.x,
            report.mean_scallop.to_mm(),
        ),
    ));
    let correlation = format!(
        "correlation {:.2} %{}",
        report.correlation * 100.0,
        hollow(report)
    );
    lines.push(row("contours", &correlation));
    let (edge, blade) = (
        show(report.longest_edge.to_mm()),
        show(longest_blade(plan).to_mm()),
    );
    lines.push(row("edge", &format!("{edge} of {blade} mm used at most")));
    if reach.is_some() {
        lines.push(row("in hand", IN_HAND));
    }
    let reach = reach.into_iter().flat_map(reach_summary::lines);
    lines.extend(reach.map(|(name, text)| row(name, &text)));
    lines
}

/// `scallop <= 5.2 mm (chosen, for the job sets none: ...)`: the limit as the job may say it, and where it is from.
#[must_use]
pub fn chosen_limit(asked: &RoughVcut) -> Option<String> {
    let (limit, chosen) = (asked.limits.scallop?, asked.limits.chosen?);
    let why = match chosen.why {
        WhyChosen::LittleStays => "",
        WhyChosen::MoreStays => "; more than a tenth of that stays with tighter ones too",
        WhyChosen::TightestKept => "; no plan satisfies a tighter one",
    };
    Some(format!(
        "scallop <= {} mm (chosen, the job sets none: on average {:.1} mm are to be cut away{why})",
        show(limit.value.to_mm()),
        chosen.depth.to_mm()
    ))
}

/// What was chosen for an operation, what it came up against, and what it was compared with.
fn of_operation(vcut: &PlannedVcut, report: &Report) -> Vec<String> {
    let mut lines = Vec::new();
    let choices: Vec<String> = vcut
        .parameters
        .choices(&vcut.asked)
        .iter()
        .map(|c| format!("{} = {}", c.name, c.value))
        .collect();
    if !choices.is_empty() {
        lines.push(row("auto", &choices.join(", ")));
    }
    lines.extend(chosen_limit(&vcut.asked).map(|limit| row("limit", &limit)));
    let reasons = vcut.parameters.reasons(&vcut.asked);
    if !reasons.is_empty() {
        let spent =
            scallop_spent(vcut, report).map_or_else(String::new, |spent| format!("; scallop {spent}"));
        lines.push(row("bound by", &format!("{}{spent}", reasons.join(", "))));
    }
    for decision in &vcut.decisions {
        lines.push(row(
            "compared",
            &format!("{}: {}", decision.field, compared(decision)),
        ));
    }
    lines
}

/// The lines that say what is proven and what is not checked.
#[must_use]
pub fn verdict(checks: &Checks) -> Vec<String> {
    let proven = row(
        checks.standing().words().to_lowercase().as_str(),
        &checks.proven(),
    );
    let open = checks.not_checked().map(|open| row("not checked", &open));
    core::iter::once(proven).chain(open).collect()
}

/// `rib: 2 min 07.8 s, 19 cuts in 2 layers, scallop 9.86 of 10 mm, margin A3 15.1 %`.
fn headline(plan: &PlannedJob, report: &Report, basis: Basis, reach: Option<&ReachFigures>) -> String {
    let counted = |count: usize, what: &str| match count {
        1 => format!("1 {what}"),
        _ => format!("{count} {what}s"),
    };
    let at_least = if basis.untimed > 0 { "at least " } else { "" };
    let height = report.scallop.height.to_mm();
    let mut parts = vec![
        format!("{at_least}{}", time(report.times.all.total())),
        format!(
            "{} in {}",
            counted(report.cuts(), "cut"),
            counted(report.layers.len(), "layer")
        ),
        match scallop_limit(plan) {
            Some(limit) => format!("scallop {height:.2} of {} mm", show(limit.to_mm())),
            None => format!("scallop {height:.2} mm"),
        },
    ];
    parts.extend(reach.map(reach_summary::least_margin));
    format!("{}: {}", plan.name, parts.join(", "))
}

/// The tightest limit on scallop that an operation sets.
#[must_use]
pub fn scallop_limit(plan: &PlannedJob) -> Option<Length> {
    let limits = plan
        .operations
        .iter()
        .filter_map(|PlannedOperation::RoughVcut(vcut)| vcut.asked.limits.scallop);
    limits.map(|limit| limit.value).reduce(Length::min)
}

/// The longest edge that a blade of the job has.
#[must_use]
pub fn longest_blade(plan: &PlannedJob) -> Length {
    let operations = plan.operations.iter();
    operations
        .map(|PlannedOperation::RoughVcut(vcut)| vcut.asked.blade.cutting_length.value)
        .fold(Length::ZERO, Length::max)
}

/// `2.97 of 3 mm = allowance 0.50 + standoff 0.30 + cusp 2.17`: where a limit that decided goes. Tips stay above the part by the
/// allowance, and by the standoff over the sine of the swing, whatever the lattice; only the rest is left for cusps.
fn scallop_spent(vcut: &PlannedVcut, report: &Report) -> Option<String> {
    let limit = vcut.asked.limits.scallop?;
    let found = &vcut.parameters;
    if !found.is_bound_by_scallop() {
        return None;
    }
    let hundredths = |length: Length| (length.to_mm() * 100.0).round();
    let (height, allowance, standoff) = (
        hundredths(report.scallop.height),
        hundredths(vcut.asked.allowance.value),
        hundredths(found.drop),
    );
    let shown = |hundredths: f64| format!("{:.2}", hundredths / 100.0);
    let of = format!("{} of {} mm", shown(height), show(limit.value.to_mm()));
    let cusp = height - allowance - standoff;
    // On slopes the nearest point of the part is nearer than the one below.
    if cusp < 0.0 {
        return Some(of);
    }
    let mut parts = Vec::new();
    if allowance > 0.0 {
        parts.push(format!("allowance {}", shown(allowance)));
    }
    if standoff > 0.0 {
        parts.push(format!("standoff {}", shown(standoff)));
    }
    parts.push(format!("cusp {}", shown(cusp)));
    Some(format!("{of} = {}", parts.join(" + ")))
}

/// What of the blade no proof can see.
const IN_HAND: &str = "check how the blade is clamped: leading edge at tool x, flat square to tool y (docs/language.md, `tool`)";

/// `interlaced 1 min 52.0 s; orthogonal 1 min 58.3 s; free leaves 11.2 mm (limit 10 mm)`: what was taken comes first.
#[must_use]
pub fn compared(decision: &Decision) -> String {
    if decision.taken.standing == Standing::Narrowed {
        return narrowed(decision);
    }
    let all = core::iter::once(&decision.taken).chain(&decision.others);
    let words: Vec<String> = all
        .map(|one| format!("{}{}", one.what, standing(one.standing)))
        .collect();
    words.join("; ")
}

/// `at most 24.8 deg: the machine cannot follow a wider one (A4 would need 242.0 deg/s of 179.0 deg/s at 40 deg)`.
fn narrowed(decision: &Decision) -> String {
    let lacks: Vec<&str> = decision.others.iter().map(|other| other.what.as_str()).collect();
    format!(
        "{}: the machine cannot follow a wider one ({})",
        decision.taken.what,
        lacks.join("; ")
    )
}

fn standing(standing: Standing) -> String {
    match standing {
        Standing::Takes(duration) => format!(" {}", time(duration)),
        Standing::Exceeds(Excess::Time { time: taken, limit }) => {
            format!(" {} (limit {})", time(taken), time(limit))
        }
        Standing::Exceeds(Excess::Cuts { cuts, limit }) => {
            format!(" {cuts} cuts (limit {})", show(limit.floor()))
        }
        Standing::Leaves { height, limit } => format!(
            " leaves {:.2} mm (limit {} mm)",
            height.to_mm(),
            show((limit.to_mm() * 100.0).floor() / 100.0)
        ),
        Standing::Fails(1) => " leaves a chip".to_owned(),
        Standing::Fails(count) => format!(" leaves {count} chips"),
        Standing::Impossible => " cuts nothing".to_owned(),
        Standing::ByModel(duration) => format!(" {} by formula, not planned", time(duration)),
        Standing::Last => ", because the machine cannot follow the others".to_owned(),
        Standing::Narrowed => ", the widest tried that the machine can follow".to_owned(),
        Standing::NotFollowed => ": the machine cannot follow it".to_owned(),
        Standing::LeftOut => ": not possible, the machine cannot follow it".to_owned(),
        Standing::NotCompared => ", not compared because there are too many cuts".to_owned(),
    }
}

/// What there is to say where the part is farther from the machined contour than that is from the part.
fn hollow(report: &Report) -> String {
    let Some(deepest) = report.hollow() else {
        return String::new();
    };
    format!(
        "; deepest unreached corner {:.2} mm at x {:.1} mm (not counted as scallop)",
        deepest.height.to_mm(),
        deepest.peak.x
    )
}

fn row(name: &str, text: &str) -> String {
    format!("  {name:<14} {text}")
}

/// The time by the mean-value model, and how far it is from the planned one.
fn estimate(plan: &PlannedJob, report: &Report) -> String {
    let estimate = plan
        .operations
        .iter()
        .map(|PlannedOperation::RoughVcut(vcut)| vcut.estimate)
        .sum();
    format!(
        "{} by the rough formula{}",
        time(estimate),
        against(estimate, report.times.all.total(), &why_else(plan))
    )
}

/// ` (4.2 % too high)`: how far the model and the planned program agree.
fn against(estimate: Duration, planned: Duration, why: &str) -> String {
    if planned <= Duration::ZERO {
        return String::new();
    }
    let percent = (estimate.to_s() / planned.to_s() - 1.0) * 100.0;
    let way = if percent < 0.0 { "low" } else { "high" };
    let why = if percent.abs() > FAR_APART { why } else { "" };
    format!(" ({:.1} % too {way}{why})", percent.abs())
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
    let counts = format!(": it assumes {estimated:.0} cuts, the plan has {planned}");
    let turns = if is_by_layer {
        "; it ignores `order = layer`, which reorients the blade less often"
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
        assert_eq!(shown(90.0, 100.0), " (10.0 % too low)");
        assert_eq!(shown(101.26, 100.0), " (1.3 % too high)");
        assert_eq!(shown(130.0, 100.0), " (30.0 % too high: why)");
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
