//! What a plan of rectangular roughing says of itself: parameters, lines of the summary, and values of fields that were left open.

use crate::asked::RoughRect;
use crate::decided::Planned;
use vcutc_backend_api::units::Area;
use vcutc_backend_api::words::counted;
use vcutc_diagnostics::number::show;
use vcutc_geometry::curve::Point2;
use vcutc_job::description::{
    ParameterFigure, ParameterRow, ParameterTable, angle_text, degrees, length_text, millimetres, number,
    rate_text, speed_text, word,
};
use vcutc_simulation::report::{Report, area_under};

/// What lies above the part with its allowance, and above `down_to`.
pub(crate) fn to_remove(planned: &Planned, top: &[Point2]) -> Area {
    let floor = planned.asked.down_to.value.to_mm();
    let kept: Vec<Point2> = planned
        .bound
        .points()
        .iter()
        .map(|point| Point2::new(point.x, point.z.max(floor)))
        .collect();
    Area::mm2((area_under(top) - area_under(&kept)).max(0.0))
}

/// The tables: blades, cut, motion.
pub(crate) fn tables(planned: &Planned) -> Vec<ParameterTable> {
    let (asked, plan) = (&planned.asked, &planned.plan);
    let blades = vec![
        ParameterRow::written("blade", asked.blade.name.clone(), asked.blade.span),
        ParameterRow::of("cutting_length", asked.blade.cutting_length, length_text),
        ParameterRow::of("half_apex", asked.blade.half_apex, angle_text),
        ParameterRow::of("thickness", asked.blade.thickness, length_text),
        ParameterRow::written("disc", asked.disc.name.clone(), asked.disc.span),
        ParameterRow::of("radius", asked.disc.radius, length_text),
        ParameterRow::of("depth", asked.disc.depth, length_text),
        ParameterRow::of("width", asked.disc.width, length_text),
    ];
    let cut = vec![
        ParameterRow::of("rake", asked.setup.rake, angle_text),
        ParameterRow::of("lead", asked.lead, angle_text),
        ParameterRow::open("layer", &asked.layer, length_text(plan.layer), AS_SIMULATED),
        ParameterRow::open("step", &asked.step, length_text(plan.step), AS_SIMULATED),
        ParameterRow::open("through", &asked.through, plan.through.to_string(), FASTEST),
        ParameterRow::open(
            "residual",
            &asked.residual,
            plan.residual.word().to_owned(),
            FEWEST,
        ),
        ParameterRow::of("allowance", asked.allowance, length_text),
        ParameterRow::of("down_to", asked.down_to, length_text),
        ParameterRow::of("beyond", asked.beyond, length_text),
    ];
    let motion = vec![
        ParameterRow::of("feed cut", asked.setup.cut_feed, speed_text),
        ParameterRow::of("feed free", asked.free_feed, speed_text),
        ParameterRow::of("feed travel", asked.setup.travel_feed, speed_text),
        ParameterRow::of("feed reorient", asked.setup.reorient_rate, rate_text),
        ParameterRow::of("clearance", asked.setup.clearance, length_text),
        ParameterRow::of("run_out", asked.setup.run_out, length_text),
        ParameterRow::open(
            "standoff",
            &asked.standoff,
            length_text(planned.standoff),
            "half the blade's thickness",
        ),
    ];
    [("Blades", blades), ("Cut", cut), ("Motion", motion)]
        .map(|(caption, rows)| ParameterTable { caption, rows })
        .to_vec()
}

const AS_SIMULATED: &str = "the largest that both blades take within the limits";
const FASTEST: &str = "the least time";
const FEWEST: &str = "at every place what keeps the limit with the fewest strips";

pub(crate) fn parameters(planned: &Planned) -> Vec<ParameterFigure> {
    let (asked, plan) = (&planned.asked, &planned.plan);
    vec![
        ParameterFigure::fixed("rake", &asked.setup.rake, degrees(asked.setup.rake.value)),
        ParameterFigure::fixed("lead", &asked.lead, degrees(asked.lead.value)),
        ParameterFigure::open("layer", &asked.layer, millimetres(plan.layer)),
        ParameterFigure::open("step", &asked.step, millimetres(plan.step)),
        ParameterFigure::open("through", &asked.through, number(f64::from(plan.through), None)),
        ParameterFigure::open("residual", &asked.residual, word(plan.residual.word())),
        ParameterFigure::fixed("allowance", &asked.allowance, millimetres(asked.allowance.value)),
        ParameterFigure::fixed("down_to", &asked.down_to, millimetres(asked.down_to.value)),
        ParameterFigure::fixed("beyond", &asked.beyond, millimetres(asked.beyond.value)),
        ParameterFigure::open("standoff", &asked.standoff, millimetres(planned.standoff)),
    ]
}

/// What was chosen, and how often the blade is changed.
pub(crate) fn summary(planned: &Planned, _: &Report) -> Vec<(&'static str, String)> {
    let counts = planned.plan.counts();
    let chosen = ["layer", "step", "through", "residual"]
        .into_iter()
        .filter_map(|field| {
            let (value, _) = chosen(planned, field)?;
            is_open(planned, field).then(|| format!("{field} = {value}"))
        });
    let chosen: Vec<String> = chosen.collect();
    let mut lines = Vec::new();
    if !chosen.is_empty() {
        lines.push(("auto", chosen.join(", ")));
    }
    lines.push((
        "rect",
        format!(
            "{}, {}, {}",
            counted(counts.slits, "slit"),
            counted(counts.strips, "strip"),
            counted(counts.changes, "change of blade")
        ),
    ));
    lines.extend(left_out(&planned.asked, planned.plan.room.left_out()).map(|text| ("avoid", text)));
    lines
}

/// What stays because the body of the straight blade has no room.
pub(crate) fn left_out(asked: &RoughRect, strips: usize) -> Option<String> {
    (strips > 0).then(|| {
        let verb = if strips == 1 { "is" } else { "are" };
        let strips = counted(strips, "strip");
        format!(
            "{strips} {verb} left out, because the body of `{}` has no room beside the slits",
            asked.blade.name
        )
    })
}

fn is_open(planned: &Planned, field: &str) -> bool {
    use vcutc_job::Auto::Auto;
    let asked = &planned.asked;
    match field {
        "layer" => asked.layer.value == Auto,
        "step" => asked.step.value == Auto,
        "through" => asked.through.value == Auto,
        "residual" => asked.residual.value == Auto,
        _ => false,
    }
}

/// What was chosen for a field that was left open, and why.
pub(crate) fn chosen(planned: &Planned, field: &str) -> Option<(String, String)> {
    let plan = &planned.plan;
    let (value, why) = match field {
        "layer" => (length_text(plan.layer), AS_SIMULATED),
        "step" => (length_text(plan.step), AS_SIMULATED),
        "through" => (plan.through.to_string(), FASTEST),
        "residual" => (plan.residual.word().to_owned(), FEWEST),
        "standoff" => (length_text(planned.standoff), "half the blade's thickness"),
        _ => return None,
    };
    Some((value, why.to_owned()))
}

/// `rectangular` and its measures.
pub(crate) fn layout(planned: &Planned) -> [String; 2] {
    let plan = &planned.plan;
    let measures = format!(
        "layer {} mm, step {} mm, through {}",
        show(plan.layer.to_mm()),
        show(plan.step.to_mm()),
        plan.through
    );
    ["rectangular".to_owned(), measures]
}
