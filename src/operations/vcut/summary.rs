//! What the plan of V-shaped roughing says of itself: lines of the summary, parameters for other programs, and the value of a
//! field that was left open.

use crate::asked::{Avoid, Lattice, Redundant, RoughVcut, WhyChosen};
use crate::plan::PlannedVcut;
use crate::plan::avoid::Swings;
use crate::plan::decision::{Decision, Excess, Standing};
use vcutc_backend_api::script::duration_words as time;
use vcutc_backend_api::units::{Angle, Length};
use vcutc_diagnostics::number::show;
use vcutc_job::Auto;
use vcutc_job::description::{ParameterFigure, degrees, millimetres, number, word};
use vcutc_job::follow::{Follow, Guide};
use vcutc_simulation::report::Report;

/// `scallop <= 5.2 mm (chosen, for the job sets none: ...)`: the limit as the job may say it, and where it is from.
fn chosen_limit(asked: &RoughVcut) -> Option<String> {
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

/// How many Vs were skipped as redundant, where there are any or they are to be skipped.
pub(crate) fn skipped(vcut: &PlannedVcut) -> Option<String> {
    let (skipped, all) = (vcut.skipped, vcut.skipped + vcut.cuts.len());
    match skipped {
        0 if vcut.asked.redundant.value == Auto::Given(Redundant::Skip) => Some(format!("none of {all} Vs")),
        0 => None,
        _ => Some(format!("{skipped} of {all} Vs, which are redundant")),
    }
}

/// What was chosen for an operation, what it came up against, and what it was compared with.
pub(crate) fn summary(vcut: &PlannedVcut, report: &Report) -> Vec<(&'static str, String)> {
    let mut lines = Vec::new();
    let choices: Vec<String> = vcut
        .parameters
        .choices(&vcut.asked)
        .iter()
        .map(|c| format!("{} = {}", c.name, c.value))
        .collect();
    if !choices.is_empty() {
        lines.push(("auto", choices.join(", ")));
    }
    lines.extend(chosen_limit(&vcut.asked).map(|limit| ("limit", limit)));
    let reasons = vcut.parameters.reasons(&vcut.asked);
    if !reasons.is_empty() {
        let spent =
            scallop_spent(vcut, report).map_or_else(String::new, |spent| format!("; scallop {spent}"));
        lines.push(("bound by", format!("{}{spent}", reasons.join(", "))));
    }
    lines.extend(skipped(vcut).map(|skipped| ("skipped", skipped)));
    lines.extend(avoided(vcut).map(|avoided| ("avoid", avoided)));
    lines.extend(followed(&vcut.asked).map(|followed| ("follow", followed)));
    lines.extend(vcut.searched.map(|searched| ("searched", searched.words())));
    for decision in &vcut.decisions {
        lines.push(("compared", format!("{}: {}", decision.field, compared(decision))));
    }
    lines
}

/// `along a spine that rises by up to 12.5 mm, in 42 pieces; heights are above it`, where cuts are not level.
fn followed(asked: &RoughVcut) -> Option<String> {
    if asked.follow.value == Follow::Straight {
        return None;
    }
    let Some(along) = &asked.along else {
        let why = match asked.follow.value {
            Follow::Auto => {
                "no other cuts that job and machine allow leave much less, or keep to what the job asks as fast"
            }
            _ => "no way that the blade can follow leaves less",
        };
        return Some(format!("straight: {why}"));
    };
    let spine = match &along.guide {
        Guide::Spine(spine) => spine,
        Guide::Columns(columns) => {
            let pitch = libm::atan(columns.steepest()).to_degrees();
            return Some(match columns.slabs() {
                1 => format!(
                    "a fan: every cut is straight, pitched by up to {pitch:.2} deg; heights are those of lower ends"
                ),
                slabs => format!(
                    "columns: every cut has a way of its own in {slabs} pieces, pitched by up to {pitch:.2} deg; heights are those of \
                     lower ends"
                ),
            });
        }
    };
    let [first, _] = spine.end_slopes();
    let rise = spine.highest(0.0, spine.depth());
    Some(match spine.knots().len() - 1 {
        1 => format!(
            "pitched by {:.2} deg, cuts rise by {rise:.2} mm towards {}y; heights are above the lower end",
            libm::atan(first.abs()).to_degrees(),
            if first > 0.0 { "+" } else { "-" },
        ),
        pieces => format!(
            "along a spine that rises by up to {rise:.2} mm, in {pieces} pieces; heights are above the spine"
        ),
    })
}

/// `7 Vs with narrower flanks, down to 0 deg`, where the job asks for them.
fn avoided(vcut: &PlannedVcut) -> Option<String> {
    if vcut.asked.avoid.value == Avoid::Lift {
        return None;
    }
    let narrowed: Vec<Swings> = vcut.narrowed().collect();
    let least = narrowed.iter().map(|swings| swings.least()).reduce(Angle::min);
    Some(match (narrowed.len(), least) {
        (_, None) => "no V needs narrower flanks".to_owned(),
        (1, Some(least)) => format!("1 V with narrower flanks, down to {} deg", show(least.to_deg())),
        (count, Some(least)) => {
            format!(
                "{count} Vs with narrower flanks, down to {} deg",
                show(least.to_deg())
            )
        }
    })
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
        hundredths(found.drop - found.below),
    );
    let bends = hundredths(found.below);
    let shown = |hundredths: f64| format!("{:.2}", hundredths / 100.0);
    let of = format!("{} of {} mm", shown(height), show(limit.value.to_mm()));
    let cusp = height - allowance - standoff - bends;
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
    if bends > 0.0 {
        parts.push(format!("bends {}", shown(bends)));
    }
    parts.push(format!("cusp {}", shown(cusp)));
    Some(format!("{of} = {}", parts.join(" + ")))
}

/// `interlaced 1 min 52.0 s; orthogonal 1 min 58.3 s; free leaves 11.2 mm (limit 10 mm)`: what was taken comes first.
pub(crate) fn compared(decision: &Decision) -> String {
    match decision.taken.standing {
        Standing::Narrowed => return narrowed(decision, "the machine cannot follow a wider one"),
        Standing::OnMachine => return narrowed(decision, "the best found on the machine"),
        _ => {}
    }
    let all = core::iter::once(&decision.taken).chain(&decision.others);
    let words: Vec<String> = all
        .map(|one| format!("{}{}", one.what, standing(one.standing)))
        .collect();
    words.join("; ")
}

/// `at most 24.8 deg: the machine cannot follow a wider one (A4 would need 242.0 deg/s of 179.0 deg/s at 40 deg)`.
fn narrowed(decision: &Decision, why: &str) -> String {
    let lacks: Vec<&str> = decision.others.iter().map(|other| other.what.as_str()).collect();
    format!("{}: {why} ({})", decision.taken.what, lacks.join("; "))
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
        Standing::OnMachine => ", the best found on the machine".to_owned(),
        Standing::Narrowed => ", the widest tried that the machine can follow".to_owned(),
        Standing::NotFollowed => ": the machine cannot follow it".to_owned(),
        Standing::LeftOut => ": not possible, the machine cannot follow it".to_owned(),
        Standing::NotCompared => ", not compared because there are too many cuts".to_owned(),
    }
}

pub(crate) fn parameters(vcut: &PlannedVcut) -> Vec<ParameterFigure> {
    let (asked, found) = (&vcut.asked, &vcut.parameters);
    let mut all = of_the_lattice(vcut);
    all.extend([
        ParameterFigure::open("swing", &asked.swing, degrees(found.swing)),
        ParameterFigure::fixed("rake", &asked.setup.rake, degrees(asked.setup.rake.value)),
        ParameterFigure::open(
            "extension",
            &asked.setup.extension(),
            millimetres(found.extension),
        ),
        ParameterFigure::open("standoff", &asked.standoff, millimetres(found.standoff)),
        ParameterFigure::fixed("allowance", &asked.allowance, millimetres(asked.allowance.value)),
        ParameterFigure::open("order", &asked.order, word(vcut.order.word())),
        ParameterFigure::fixed(
            "direction",
            &asked.setup.direction(),
            word(asked.setup.direction().value.word()),
        ),
        ParameterFigure::fixed(
            "clearance",
            &asked.setup.clearance,
            millimetres(asked.setup.clearance.value),
        ),
        ParameterFigure::fixed(
            "run_out",
            &asked.setup.run_out,
            millimetres(asked.setup.run_out.value),
        ),
    ]);
    if asked.avoid.value == Avoid::Swing {
        let avoid = word(asked.avoid.value.word());
        all.push(ParameterFigure::fixed("avoid", &asked.avoid, avoid));
    }
    if asked.follow.value != Follow::Straight {
        let family = word(asked.family.word());
        all.push(ParameterFigure::open("follow", &asked.follow.open(), family));
    }
    all.extend(speeds(asked));
    all
}

/// What says nothing where tips are given.
fn of_the_lattice(vcut: &PlannedVcut) -> Vec<ParameterFigure> {
    let (asked, found) = (&vcut.asked, &vcut.parameters);
    if asked.tips.is_some() {
        return Vec::new();
    }
    let mut figures = vec![
        ParameterFigure::open("lattice", &asked.lattice, word(found.lattice.word())),
        ParameterFigure::open("layer", &asked.layer, millimetres(found.layer)),
        ParameterFigure::open("step", &asked.step, millimetres(found.step)),
    ];
    if found.lattice != Lattice::Fitted {
        figures.extend([
            ParameterFigure::open("overlap", &asked.overlap, number(overlap(vcut), None)),
            ParameterFigure::open("residual", &asked.residual, word(vcut.strategy.word())),
        ]);
    }
    figures.extend([
        ParameterFigure::open("redundant", &asked.redundant, word(vcut.redundant().word())),
        ParameterFigure::open("sequence", &asked.sequence, word(vcut.sequence.word())),
    ]);
    figures
}

/// The share by which neighbouring cuts overlap, `s = 2 (1 - eps) h tan(alpha)` [Cui 6, 7]: a given step decides it.
fn overlap(vcut: &PlannedVcut) -> f64 {
    let found = &vcut.parameters;
    match vcut.asked.step.value {
        Auto::Auto => found.overlap,
        Auto::Given(step) => 1.0 - step.to_mm() * found.flanks.slope / (2.0 * found.layer.to_mm()),
    }
}

fn speeds(asked: &RoughVcut) -> [ParameterFigure; 3] {
    let rate = asked.setup.reorient_rate.value.to_deg_per_s();
    let speed = |value: f64| number(value, Some("mm/s"));
    [
        ParameterFigure::fixed(
            "cut",
            &asked.setup.cut_feed,
            speed(asked.setup.cut_feed.value.to_mm_per_s()),
        ),
        ParameterFigure::fixed(
            "travel",
            &asked.setup.travel_feed,
            speed(asked.setup.travel_feed.value.to_mm_per_s()),
        ),
        ParameterFigure::fixed(
            "reorient",
            &asked.setup.reorient_rate,
            number(rate, Some("deg/s")),
        ),
    ]
}

/// What was chosen for a field that was left open, and why.
pub(crate) fn chosen(planned: &PlannedVcut, field: &str) -> Option<(String, String)> {
    let value = chosen_value(planned, field)?;
    Some((value, why_chosen(planned, field)))
}

/// The value of a field that was left open.
fn chosen_value(planned: &PlannedVcut, field: &str) -> Option<String> {
    let choices = planned.parameters.choices(&planned.asked);
    if let Some(choice) = choices.into_iter().find(|choice| choice.name == field) {
        return Some(choice.value);
    }
    let is_fitted = planned.parameters.lattice == Lattice::Fitted;
    match field {
        "overlap" | "residual" if is_fitted => None,
        "overlap" => Some(overlap_text(planned)),
        "residual" => Some(planned.strategy.word().to_owned()),
        "redundant" => Some(planned.redundant().word().to_owned()),
        "order" => Some(planned.order.word().to_owned()),
        "sequence" => Some(planned.sequence.word().to_owned()),
        _ => None,
    }
}

/// The share by which neighbouring cuts overlap, by step and layer: `s = 2 (1 - eps) h tan(alpha)` [Cui 6, 7].
fn overlap_text(planned: &PlannedVcut) -> String {
    let parameters = &planned.parameters;
    let share = 1.0 - parameters.step.to_mm() * parameters.flanks.slope / (2.0 * parameters.layer.to_mm());
    format!("{:.1} %", share * 100.0)
}

/// Why it came out so.
fn why_chosen(planned: &PlannedVcut, field: &str) -> String {
    let decision = planned.decisions.iter().find(|decision| decision.field == field);
    if let Some(decision) = decision {
        return compared(decision);
    }
    if field == "redundant" {
        return skipped(planned).unwrap_or_default();
    }
    let reasons = planned.parameters.reasons(&planned.asked);
    let is_bound = matches!(field, "lattice" | "swing" | "layer" | "step" | "overlap");
    if is_bound && !reasons.is_empty() {
        format!("bound by {}", reasons.join(", "))
    } else {
        String::new()
    }
}
