//! What a plan of a pocket to be freed says of itself: parameters, lines of the summary, and values of fields that were left open.

use crate::decided::Planned;
use vcutc_backend_api::words::counted;
use vcutc_diagnostics::number::show;
use vcutc_job::Auto;
use vcutc_job::description::{
    ParameterFigure, ParameterRow, ParameterTable, length_text, millimetres, motion_rows,
};

const WIDEST: &str = "the widest that the disc frees beside its shank";
const FEWEST: &str = "the fewest equal layers that the disc takes";

/// The tables: tools, cut, motion.
pub(crate) fn tables(planned: &Planned) -> Vec<ParameterTable> {
    let (asked, plan) = (&planned.asked, &planned.plan);
    let (blade, disc) = (&asked.blade, &asked.disc);
    let tools = vec![
        ParameterRow::written("blade", blade.name.clone(), blade.span),
        ParameterRow::of("cutting_length", blade.cutting_length, length_text),
        ParameterRow::of("thickness", blade.thickness, length_text),
        ParameterRow::written("disc", disc.name.clone(), disc.span),
        ParameterRow::of("radius", disc.radius, length_text),
        ParameterRow::of("depth", disc.depth, length_text),
        ParameterRow::of("width", disc.width, length_text),
    ];
    let cut = vec![
        ParameterRow::written("region", asked.region.name.clone(), asked.region_span),
        ParameterRow::of("floor", asked.floor, length_text),
        ParameterRow::open("step", &asked.step, length_text(plan.step), WIDEST),
        ParameterRow::open("layer", &asked.layer, length_text(plan.layer), FEWEST),
        ParameterRow::of("through", asked.through, |layers| {
            counted(layers as usize, "layer")
        }),
        ParameterRow::of("chip", asked.chip, length_text),
        ParameterRow::of("allowance", asked.allowance, length_text),
    ];
    let motion = motion_rows(&asked.setup, asked.plunge_feed);
    [("Tools", tools), ("Cut", cut), ("Motion", motion)]
        .map(|(caption, rows)| ParameterTable { caption, rows })
        .to_vec()
}

pub(crate) fn parameters(planned: &Planned) -> Vec<ParameterFigure> {
    let (asked, plan) = (&planned.asked, &planned.plan);
    vec![
        ParameterFigure::fixed("floor", &asked.floor, millimetres(asked.floor.value)),
        ParameterFigure::open("step", &asked.step, millimetres(plan.step)),
        ParameterFigure::open("layer", &asked.layer, millimetres(plan.layer)),
        ParameterFigure::fixed("chip", &asked.chip, millimetres(asked.chip.value)),
        ParameterFigure::fixed("allowance", &asked.allowance, millimetres(asked.allowance.value)),
    ]
}

pub(crate) fn summary(planned: &Planned) -> Vec<(&'static str, String)> {
    let (asked, plan) = (&planned.asked, &planned.plan);
    let open = [
        ("step", asked.step.value == Auto::Auto),
        ("layer", asked.layer.value == Auto::Auto),
    ];
    let chosen = open.into_iter().filter(|(_, is_open)| *is_open);
    let chosen = chosen.filter_map(|(field, _)| Some(format!("{field} = {}", value(planned, field)?.0)));
    let chosen: Vec<String> = chosen.collect();
    let mut lines = Vec::new();
    if !chosen.is_empty() {
        lines.push(("auto", chosen.join(", ")));
    }
    let round = |value: f64| show((value * 1e3).round() / 1e3);
    let slits: usize = plan.stages.iter().map(|stage| stage.slits.len()).sum();
    lines.push((
        "strips",
        format!(
            "{} of {} mm; in each {} of {} mm along the open side, and {} of {} mm along the walls; {}, {}",
            counted(plan.layers(), "layer"),
            round(plan.layer.to_mm()),
            counted(plan.rows, "row"),
            round(plan.row.to_mm()),
            counted(plan.rings as usize, "strip"),
            round(plan.step.to_mm()),
            counted(slits, "slit"),
            counted(plan.changes(), "change"),
        ),
    ));
    lines.push((
        "disc",
        format!(
            "`{}` stands upright: its face must be ground hollow, so that only its rim touches the floor",
            asked.disc.name
        ),
    ));
    lines
}

fn value(planned: &Planned, field: &str) -> Option<(String, &'static str)> {
    Some(match field {
        "step" => (length_text(planned.plan.step), WIDEST),
        "layer" => (length_text(planned.plan.layer), FEWEST),
        _ => return None,
    })
}

/// What was chosen for a field that was left open, and why.
pub(crate) fn chosen(planned: &Planned, field: &str) -> Option<(String, String)> {
    value(planned, field).map(|(value, why)| (value, why.to_owned()))
}

/// `strips` and their measures.
pub(crate) fn layout(planned: &Planned) -> [String; 2] {
    let measures = format!(
        "rows of {} mm",
        show((planned.plan.row.to_mm() * 1e3).round() / 1e3)
    );
    ["strips".to_owned(), measures]
}
