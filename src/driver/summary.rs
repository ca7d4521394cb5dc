//! The figures of a program for people: a headline, and a few lines below it.

pub mod air;
pub mod chosen;
pub(crate) mod families;
pub mod processes;
pub mod times;

use crate::checks::Checks;
use crate::families::ComparedFamily;
use crate::left_over::{Below, LeftOver};
use crate::ways::Comparison;
use vcutc_backend_api::ir::Site;
use vcutc_backend_api::script::duration_words;
use vcutc_backend_api::units::{Duration, Length};
use vcutc_backend_api::words::counted;
use vcutc_diagnostics::number::show;
use vcutc_job::{BladeRef, Order, PlannedJob, PlannedOperation};
use vcutc_motion::figures::ReachFigures;
use vcutc_motion::pace::Basis;
use vcutc_motion::summary as reach_summary;
use vcutc_simulation::body::Passage;
use vcutc_simulation::prove::{Cleared, Passes, Slit, Standing, Tracked};
use vcutc_simulation::report::Report;
use vcutc_surface::residual::{Over, Volume};

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
    for planned in &plan.operations {
        let rows = planned.summary(report).into_iter();
        lines.extend(rows.map(|(name, text)| row(name, &text)));
    }
    lines.push(row("time", &times::in_all(&report.times.all)));
    lines.push(row("basis", &times::basis(basis)));
    lines.push(row("estimate", &estimate(plan, report)));
    lines.extend(
        report
            .cleared
            .iter()
            .map(|cleared| row("cleared", &pocket(cleared))),
    );
    lines.extend(report.slit.iter().map(|slit| row("slit", &walls(slit))));
    if is_of_regions(plan) {
        lines.extend(of_machine(reach));
        return lines;
    }
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
    lines.extend(report.body.map(|nearest| row("body", &body(nearest))));
    if reach.is_some() {
        lines.push(row("in hand", IN_HAND));
    }
    lines.extend(of_machine(reach));
    lines
}

fn of_machine(reach: Option<&ReachFigures>) -> impl Iterator<Item = String> {
    let reach = reach.into_iter().flat_map(reach_summary::lines);
    reach.map(|(name, text)| row(name, &text))
}

/// Whether a job does nothing that a section shows: it works in regions of the plan only.
#[must_use]
pub fn is_of_regions(plan: &PlannedJob) -> bool {
    let mut operations = plan.operations.iter();
    operations.all(|planned| is_of_a_region(&**planned))
}

/// Whether an operation works in a region of the plan, which no section shows.
#[must_use]
pub fn is_of_a_region(planned: &dyn PlannedOperation) -> bool {
    matches!(planned.bound().passes, Some(Passes::Region))
}

/// `1.53 m in 2 layers; 0.00 mm2 uncut, 27.3 mm2 in corners beyond reach; rim in the material 78 deg on average, at most 121 deg`.
fn pocket(cleared: &Cleared) -> String {
    let layers = counted(cleared.layers, "layer");
    format!(
        "{:.2} m of passes in {layers}; at most {:.2} mm2 of a layer stay uncut, and {:.1} mm2 are beyond the tool's reach; the rim is \
         in the material by {:.0} deg on average, at the speed of cutting by at most {:.1} deg",
        cleared.way.to_mm() / 1000.0,
        cleared.uncut.to_mm2(),
        cleared.beyond_reach.to_mm2(),
        cleared.mean_engagement.to_deg(),
        cleared.engagement.to_deg(),
    ) + &standing(cleared.standing)
}

/// `; beside the slits at most 31.2 mm2 of a layer stand, in 2 pillars (the limit on pillars counts all beyond reach)`.
fn standing(standing: Option<Standing>) -> String {
    standing.map_or_else(String::new, |standing| {
        let area = standing.area.to_mm2();
        let pillars = counted(standing.pillars, "pillar");
        format!(
            "; beside the slits at most {area:.1} mm2 of a layer stand, in {pillars} (the limit on pillars counts all beyond reach)"
        )
    })
}

/// `0.26 m in 5 slits; the sides of the blade stay at least 0.009 mm off the walls, and at most 0.03 mm of core stays at their foot; ...`.
fn walls(slit: &Slit) -> String {
    let slits = counted(slit.slits, "slit");
    let corners = if slit.in_corners > Length::ZERO {
        format!(", {:.3} mm in acute corners", slit.in_corners.to_mm())
    } else {
        String::new()
    };
    let way = slit.way.to_mm() / 1000.0;
    let edge = format!("at most {:.1} mm of edge is used", slit.edge.to_mm());
    if slit.to_wall.to_mm().is_infinite() {
        return format!("{way:.2} m in {slits}, none along a wall; {edge}");
    }
    format!(
        "{way:.2} m in {slits}; the sides of the blade stay at least {:.3} mm off the walls, and at most {:.3} mm of core stays at their \
         foot{corners}; {edge}",
        slit.to_wall.to_mm(),
        slit.stays.to_mm(),
    )
}

/// Adds what is left over a part that changes along y, by straight cuts, and by tracks that follow it. The lines before are about its
/// shadow.
pub(crate) fn with_surface(
    mut lines: Vec<String>,
    left_over: Option<&LeftOver>,
    tracked: &[Tracked],
) -> Vec<String> {
    let Some(LeftOver {
        all,
        shaded,
        below,
        level,
    }) = left_over
    else {
        return lines;
    };
    let Over { height, place } = all.highest;
    let [x, y] = place.map(|length| format!("{:.1} mm", length.to_mm()));
    let after = if tracked.is_empty() { "" } else { " after roughing" };
    lines.push(row(
        "surface",
        &format!(
            "{} stay on the part{after}, at most {:.2} mm above it at x {x}, y {y}",
            litres(all.volume),
            height.to_mm()
        ),
    ));
    lines.extend(tracked.iter().map(|tracked| row("finished", &finished(tracked))));
    // Of a part that is the same at every y nothing to speak of.
    if shaded.to_mm3() < LEAST_SHADED {
        return lines;
    }
    let why = match below {
        Below::Shadow => {
            "below the part's shadow along y, where the cuts do not get; area and scallop are measured from the shadow"
        }
        Below::Lines => {
            "below the straight lines that cover the part, where the cuts do not get; area and scallop are measured from their lower ends"
        }
        Below::Curves => {
            "below the curves that cover the part, where the cuts do not get; area and scallop are measured from their lower ends"
        }
    };
    lines.push(row("shadow", &format!("{} of that lie {why}", litres(*shaded))));
    if let Some(level) = level {
        lines.push(row(
            "follow",
            &format!(
                "there up to {:.2} mm stay above the part; `follow = auto` of `rough vcut` looks for cuts that rise and fall with it and \
                 leave less",
                level.to_mm()
            ),
        ));
    }
    lines
}

/// `at most 0.098 mm stay on the part, at x 12.5 mm, y 80.0 mm, in 31 sections; the disc enters it by at most 0.020 mm`.
fn finished(tracked: &Tracked) -> String {
    let [x, y, _] = tracked.at;
    let [least, most] = tracked.leads.map(|lead| format!("{:.2}", lead.to_deg()));
    format!(
        "at most {:.3} mm stay on the part, at x {x:.1} mm, y {y:.1} mm, and {:.3} mm on average, in {} sections; the disc enters it by \
         at most {:.3} mm; {} tracks, {} poses, on which its face rises by {least} to {most} deg from its way",
        tracked.left.to_mm(),
        tracked.mean.to_mm(),
        tracked.sections,
        tracked.entry.to_mm(),
        tracked.tracks,
        tracked.poses,
    )
}

/// Volumes below this, in mm3, show as 0.000 l.
const LEAST_SHADED: f64 = 500.0;

/// `0.213 l`.
fn litres(volume: Volume) -> String {
    format!("{:.3} l", volume.to_litres())
}

/// Adds what there is to say of what the job leaves open as a whole: how its cuts follow the part, and ways to do its operations.
pub(crate) fn with_choices(lines: &mut Vec<String>, families: &[ComparedFamily], comparisons: &[Comparison]) {
    let at = lines.len().min(2);
    let choices = families::lines(families)
        .into_iter()
        .chain(processes::lines(comparisons));
    lines.splice(at..at, choices);
}

/// `at least 3.20 mm above the stock in cuts, nearest in layer 7, cut 12`.
fn body(nearest: Passage) -> String {
    let place = match nearest.site {
        Site::Cut { layer, cut, .. } => {
            let kind = nearest.kind.noun();
            format!(", nearest in layer {layer}, {kind} {cut}")
        }
        Site::Program | Site::Operation(_) | Site::Layer { .. } => String::new(),
    };
    format!(
        "at least {:.2} mm above the stock in cuts{place}",
        nearest.clearance.to_mm()
    )
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
    let at_least = if basis.untimed > 0 { "at least " } else { "" };
    let height = report.scallop.height.to_mm();
    let mut parts = vec![
        format!("{at_least}{}", time(report.times.all.total())),
        format!(
            "{} in {}",
            counted(report.cuts(), "cut"),
            counted(report.layers.len(), "layer")
        ),
        match plan.scallop_limit() {
            Some((_, limit)) => format!("scallop {height:.2} of {} mm", show(limit.value.to_mm())),
            None => format!("scallop {height:.2} mm"),
        },
    ];
    if is_of_regions(plan) {
        parts.truncate(2);
    }
    parts.extend(reach.map(reach_summary::least_margin));
    format!("{}: {}", plan.name, parts.join(", "))
}

/// The longest edge that a straight blade of the job has.
#[must_use]
pub fn longest_blade(plan: &PlannedJob) -> Length {
    let blades = plan
        .operations
        .iter()
        .flat_map(|planned| planned.asked().blades());
    let edges = blades.filter_map(|blade| match blade {
        BladeRef::Straight(blade) => Some(blade.cutting_length.value),
        BladeRef::Disc(_) | BladeRef::Crusher(_) => None,
    });
    edges.fold(Length::ZERO, Length::max)
}

/// What of the blade no proof can see.
const IN_HAND: &str = "check how the blade is clamped: leading edge at tool x, flat square to tool y (docs/language.md, `tool`)";

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

/// A line of a summary: a name, and what there is to say of it.
#[must_use]
pub fn row(name: &str, text: &str) -> String {
    format!("  {name:<14} {text}")
}

/// The time by the mean-value model, and how far it is from the planned one.
fn estimate(plan: &PlannedJob, report: &Report) -> String {
    let estimate = plan.estimate();
    format!(
        "{} by the rough formula{}",
        time(estimate),
        against(estimate, report.times.all.total(), |percent| why_else(
            plan, percent
        ))
    )
}

/// ` (4.2 % too high)`: how far the model and the planned program agree.
fn against(estimate: Duration, planned: Duration, why: impl FnOnce(f64) -> String) -> String {
    if planned <= Duration::ZERO {
        return String::new();
    }
    let percent = (estimate.to_s() / planned.to_s() - 1.0) * 100.0;
    let way = if percent < 0.0 { "low" } else { "high" };
    let why = if percent.abs() > FAR_APART {
        why(percent)
    } else {
        String::new()
    };
    format!(" ({:.1} % too {way}{why})", percent.abs())
}

/// From this many percent on the summary says why model and program differ.
const FAR_APART: f64 = 20.0;

/// What the mean-value model does not see of a plan, where it is so many percent too high: where the part and the sides of the stock
/// take Vs away or ask for more, and that the route turns the blade less.
fn why_else(plan: &PlannedJob, percent: f64) -> String {
    let planned = plan.cuts();
    let operations = || plan.operations.iter();
    let estimated: f64 = operations().map(|planned| planned.estimate().cuts).sum();
    let is_by_layer = operations().any(|planned| planned.order() == Order::Layer);
    let differs = (estimated - planned as f64).abs() >= 0.5;
    let counts = differs.then(|| format!("it assumes {estimated:.0} cuts, the plan has {planned}"));
    let turns = (is_by_layer && percent > 0.0)
        .then(|| "it ignores `order = layer`, which reorients the blade less often".to_owned());
    let changes = (plan.operations.len() > 1 && percent < 0.0)
        .then(|| "it leaves out what lies between operations".to_owned());
    let reasons: Vec<String> = counts.into_iter().chain(turns).chain(changes).collect();
    if reasons.is_empty() {
        return String::new();
    }
    format!(": {}", reasons.join("; "))
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
    fn the_model_is_compared_with_the_planned_time() {
        let shown = |estimate: f64, planned: f64| {
            against(Duration::s(estimate), Duration::s(planned), |_| {
                ": why".to_owned()
            })
        };
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
