//! What a plan of a pocket says of itself: parameters, lines of the summary, and values of fields that were left open.

use crate::asked::{Pattern, WayIn};
use crate::decided::Planned;
use crate::plan::Entry;
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::number::show;
use vcutc_job::description::{
    ParameterFigure, ParameterRow, ParameterTable, angle_text, degrees, length_text, millimetres, motion_rows,
};
use vcutc_job::{Auto, Hole};

const FASTEST: &str = "the pattern that takes the least time of those that keep the limits";
const RADIUS: &str = "the widest with which nothing stays between passes";
const FEWEST: &str = "the fewest equal layers that the tool cuts";
const ROUNDEST: &str = "as round as leaves nothing between passes";
const HALF: &str = "half the step, which rounds corners to about that radius";
const QUICKEST: &str = "the faster of a ramp and a helix, on each way down";
const ALONG: &str = "the faster of 0 deg and 90 deg";

/// The tables: tool, cut, motion.
pub(crate) fn tables(planned: &Planned) -> Vec<ParameterTable> {
    let asked = &planned.asked;
    let crusher = &asked.crusher;
    let blade = vec![
        ParameterRow::written("blade", crusher.name.clone(), crusher.span),
        ParameterRow::of("radius", crusher.radius, length_text),
        ParameterRow::of("height", crusher.height, length_text),
        ParameterRow::of("ramp", crusher.ramp, angle_text),
    ];
    let plan = &planned.plan;
    let mut cut = vec![
        ParameterRow::written("region", asked.region.name.clone(), asked.region_span),
        ParameterRow::of("floor", asked.floor, length_text),
        ParameterRow::open("pattern", &asked.pattern, plan.pattern.word().to_owned(), FASTEST),
        ParameterRow::open("step", &asked.step, length_text(plan.step), RADIUS),
        ParameterRow::open("layer", &asked.layer, length_text(layer(planned)), FEWEST),
    ];
    match plan.pattern {
        Pattern::Sfs => cut.push(ParameterRow::open(
            "corners",
            &asked.corners,
            corners(planned),
            ROUNDEST,
        )),
        Pattern::Zigzag => cut.push(ParameterRow::open(
            "angle",
            &asked.angle,
            angle_text(plan.angle),
            ALONG,
        )),
        Pattern::Field => {
            let lift = plan
                .field
                .map_or_else(String::new, |field| length_text(field.lift));
            cut.push(ParameterRow::open("lift", &asked.lift, lift, HALF));
            cut.push(ParameterRow::of("axis", asked.axis, |axis| {
                axis.word().to_owned()
            }));
        }
        Pattern::Offset => {}
    }
    cut.push(ParameterRow::open(
        "entry",
        &asked.entry,
        entries(planned),
        QUICKEST,
    ));
    if let Some(opening) = asked.opening {
        cut.push(ParameterRow::of("opening", opening, |hole| {
            let Hole { x, y, radius } = hole;
            let [x, y, radius] = [x, y, radius].map(length_text);
            format!("({x}, {y}) radius {radius}")
        }));
    }
    cut.push(ParameterRow::of("allowance", asked.allowance, length_text));
    let motion = motion_rows(&asked.setup, asked.plunge_feed);
    [("Tool", blade), ("Cut", cut), ("Motion", motion)]
        .map(|(caption, rows)| ParameterTable { caption, rows })
        .to_vec()
}

pub(crate) fn parameters(planned: &Planned) -> Vec<ParameterFigure> {
    let (asked, plan) = (&planned.asked, &planned.plan);
    let mut figures = vec![
        ParameterFigure::fixed("floor", &asked.floor, millimetres(asked.floor.value)),
        ParameterFigure::open("step", &asked.step, millimetres(plan.step)),
        ParameterFigure::open("layer", &asked.layer, millimetres(layer(planned))),
        ParameterFigure::fixed("allowance", &asked.allowance, millimetres(asked.allowance.value)),
    ];
    match plan.pattern {
        Pattern::Sfs => {
            let corners = plan.corners.map(millimetres);
            figures.extend(corners.map(|value| ParameterFigure::open("corners", &asked.corners, value)));
        }
        Pattern::Zigzag => figures.push(ParameterFigure::open("angle", &asked.angle, degrees(plan.angle))),
        Pattern::Field => {
            let lift = plan.field.map(|field| millimetres(field.lift));
            figures.extend(lift.map(|value| ParameterFigure::open("lift", &asked.lift, value)));
        }
        Pattern::Offset => {}
    }
    figures
}

fn corners(planned: &Planned) -> String {
    let corners = planned.plan.corners;
    corners.map_or_else(|| "as round as possible".to_owned(), length_text)
}

/// How the tool gets down, in the order in which it does.
fn entries(planned: &Planned) -> String {
    let mut words: Vec<&str> = Vec::new();
    for run in &planned.plan.runs {
        let word = match run.entry {
            Entry::Ramp { .. } => WayIn::Ramp.word(),
            Entry::Helix { .. } => WayIn::Helix.word(),
            Entry::Open { .. } => WayIn::Open.word(),
            Entry::Hole { .. } => "opening",
            Entry::Return { .. } => continue,
        };
        if !words.contains(&word) {
            words.push(word);
        }
    }
    words.join(", ")
}

/// How thick the layers are.
fn layer(planned: &Planned) -> Length {
    let plan = &planned.plan;
    let floors = plan.floors.first();
    Length::mm(floors.map_or(0.0, |first| plan.top - first))
}

/// Of all fields that were left open, what was chosen.
fn chosen_line(planned: &Planned) -> Option<(&'static str, String)> {
    let asked = &planned.asked;
    let pattern = planned.plan.pattern;
    let open = [
        ("pattern", asked.pattern.value == Auto::Auto),
        ("step", asked.step.value == Auto::Auto),
        ("layer", asked.layer.value == Auto::Auto),
        (
            "corners",
            asked.corners.value == Auto::Auto && pattern == Pattern::Sfs,
        ),
        (
            "angle",
            asked.angle.value == Auto::Auto && pattern == Pattern::Zigzag,
        ),
        (
            "lift",
            asked.lift.value == Auto::Auto && pattern == Pattern::Field,
        ),
    ];
    let chosen = open.into_iter().filter(|(_, is_open)| *is_open);
    let words: Vec<String> = chosen
        .filter_map(|(field, _)| {
            Some(format!(
                "{field} = {}{}",
                value(planned, field)?.0,
                others(planned, field)
            ))
        })
        .collect();
    (!words.is_empty()).then(|| ("auto", words.join(", ")))
}

/// What the patterns that were not taken would take.
fn others(planned: &Planned, field: &str) -> String {
    let plan = &planned.plan;
    if field != "pattern" || plan.tried.len() < 2 {
        return String::new();
    }
    let times = plan.tried.iter().map(|(pattern, time)| {
        format!(
            "{} {} s",
            pattern.word(),
            show((time.to_s() * 10.0).round() / 10.0)
        )
    });
    format!(" ({} a layer)", times.collect::<Vec<_>>().join(", "))
}

pub(crate) fn summary(planned: &Planned) -> Vec<(&'static str, String)> {
    let plan = &planned.plan;
    let mut lines: Vec<_> = chosen_line(planned).into_iter().collect();
    let (layers, passes) = (plan.floors.len(), plan.passes);
    let plural = |count: usize, one: &str, many: &str| {
        if count == 1 {
            format!("1 {one}")
        } else {
            format!("{count} {many}")
        }
    };
    lines.push((
        "pocket",
        format!(
            "{} of {} mm, {} in each, {} mm apart",
            plural(layers, "layer", "layers"),
            show((layer(planned).to_mm() * 1e3).round() / 1e3),
            plural(passes, "pass", "passes"),
            show((plan.step.to_mm() * 1e3).round() / 1e3),
        ),
    ));
    lines
}

fn value(planned: &Planned, field: &str) -> Option<(String, &'static str)> {
    let plan = &planned.plan;
    Some(match field {
        "pattern" => (plan.pattern.word().to_owned(), FASTEST),
        "step" => (length_text(plan.step), RADIUS),
        "layer" => (length_text(layer(planned)), FEWEST),
        "corners" => (corners(planned), ROUNDEST),
        "angle" => (angle_text(plan.angle), ALONG),
        "entry" => (entries(planned), QUICKEST),
        "lift" => (length_text(plan.field?.lift), HALF),
        _ => return None,
    })
}

/// What was chosen for a field that was left open, and why.
pub(crate) fn chosen(planned: &Planned, field: &str) -> Option<(String, String)> {
    value(planned, field).map(|(value, why)| (value, why.to_owned()))
}

/// `passes` and their measures.
pub(crate) fn layout(planned: &Planned) -> [String; 2] {
    let measures = format!(
        "pattern {}, step {} mm",
        planned.plan.pattern.word(),
        show(planned.plan.step.to_mm())
    );
    ["passes".to_owned(), measures]
}
