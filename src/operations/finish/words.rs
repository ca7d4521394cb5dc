//! What a plan of finishing says of itself: parameters, lines of the summary, and values of fields that were left open.

use crate::asked::{FinishDisc, Sequence};
use crate::decided::Planned;
use vcutc_backend_api::units::{Angle, Length};
use vcutc_diagnostics::number::show;
use vcutc_job::Auto;
use vcutc_job::description::{
    ParameterFigure, ParameterRow, ParameterTable, angle_text, degrees, length_text, millimetres, rate_text,
    speed_text,
};

const FEWEST: &str = "the fewest tracks that keep the limit on scallop, as simulated";
const LEAST: &str = "the least with which all strips come free and nothing is entered";
const PAST: &str = "the least with which strips pass the hub, or none where they may run over it";
const FREES: &str = "the first of crests, descending, rightwards and leftwards in which all strips come free";

/// What is said alike of all plans of finishing: what was asked, and what was chosen.
#[derive(Clone, Copy)]
pub(crate) struct Chosen<'c> {
    pub(crate) asked: &'c FinishDisc,
    pub(crate) step: Length,
    /// Where the lead differs from place to place, the least one.
    pub(crate) lead: Angle,
    pub(crate) side: Angle,
    pub(crate) sequence: Sequence,
}

impl<'c> Chosen<'c> {
    pub(crate) const fn of(planned: &'c Planned) -> Self {
        Self {
            asked: &planned.asked,
            step: planned.plan.step,
            lead: planned.plan.lead,
            side: planned.plan.side,
            sequence: planned.plan.sequence,
        }
    }
}

/// The tables: blade, cut, motion.
pub(crate) fn tables(plan: Chosen<'_>) -> Vec<ParameterTable> {
    let asked = plan.asked;
    let blade = vec![
        ParameterRow::written("blade", asked.disc.name.clone(), asked.disc.span),
        ParameterRow::of("radius", asked.disc.radius, length_text),
        ParameterRow::of("depth", asked.disc.depth, length_text),
        ParameterRow::of("width", asked.disc.width, length_text),
    ];
    let cut = vec![
        ParameterRow::open("step", &asked.step, length_text(plan.step), FEWEST),
        ParameterRow::open("lead", &asked.lead, angle_text(plan.lead), LEAST),
        ParameterRow::open("side", &asked.side, angle_text(plan.side), PAST),
        ParameterRow::open(
            "sequence",
            &asked.sequence,
            plan.sequence.word().to_owned(),
            FREES,
        ),
        ParameterRow::of("relief", asked.relief, angle_text),
        ParameterRow::of("over_hub", asked.over_hub, length_text),
        ParameterRow::of("allowance", asked.allowance, length_text),
    ];
    let motion = vec![
        ParameterRow::of("feed cut", asked.setup.cut_feed, speed_text),
        ParameterRow::of("feed travel", asked.setup.travel_feed, speed_text),
        ParameterRow::of("feed reorient", asked.setup.reorient_rate, rate_text),
        ParameterRow::of("clearance", asked.setup.clearance, length_text),
        ParameterRow::of("run_out", asked.setup.run_out, length_text),
    ];
    [("Blade", blade), ("Cut", cut), ("Motion", motion)]
        .map(|(caption, rows)| ParameterTable { caption, rows })
        .to_vec()
}

pub(crate) fn parameters(plan: Chosen<'_>) -> Vec<ParameterFigure> {
    let asked = plan.asked;
    vec![
        ParameterFigure::open("step", &asked.step, millimetres(plan.step)),
        ParameterFigure::open("lead", &asked.lead, degrees(plan.lead)),
        ParameterFigure::open("side", &asked.side, degrees(plan.side)),
        ParameterFigure::fixed("over_hub", &asked.over_hub, millimetres(asked.over_hub.value)),
        ParameterFigure::fixed("allowance", &asked.allowance, millimetres(asked.allowance.value)),
    ]
}

/// What was chosen of what was left open.
pub(crate) fn chosen_line(plan: Chosen<'_>) -> Option<(&'static str, String)> {
    let asked = plan.asked;
    let open = [
        ("step", asked.step.value == Auto::Auto),
        ("lead", asked.lead.value == Auto::Auto),
        ("side", asked.side.value == Auto::Auto),
        ("sequence", asked.sequence.value == Auto::Auto),
    ];
    let chosen = open.into_iter().filter(|(_, is_open)| *is_open);
    let chosen = chosen.filter_map(|(field, _)| Some(format!("{field} = {}", self::chosen(plan, field)?.0)));
    let chosen: Vec<String> = chosen.collect();
    (!chosen.is_empty()).then(|| ("auto", chosen.join(", ")))
}

/// What was chosen, and the tracks.
pub(crate) fn summary(planned: &Planned) -> Vec<(&'static str, String)> {
    let mut lines: Vec<_> = chosen_line(Chosen::of(planned)).into_iter().collect();
    let steepest = planned.plan.tracks.iter().map(|track| track.roll.to_deg().abs());
    lines.push((
        "finish",
        format!(
            "{} tracks, {} mm apart, lead {} deg, rolled by up to {} deg",
            planned.plan.tracks.len(),
            show(planned.plan.step.to_mm()),
            show(planned.plan.lead.to_deg()),
            show(Angle::deg(steepest.fold(0.0, f64::max)).to_deg()),
        ),
    ));
    lines
}

/// What was chosen for a field that was left open, and why.
pub(crate) fn chosen(plan: Chosen<'_>, field: &str) -> Option<(String, String)> {
    let (value, why) = match field {
        "step" => (length_text(plan.step), FEWEST),
        "lead" => (angle_text(plan.lead), LEAST),
        "side" => (angle_text(plan.side), PAST),
        "sequence" => (plan.sequence.word().to_owned(), FREES),
        _ => return None,
    };
    Some((value, why.to_owned()))
}

/// `tracks` and their measures.
pub(crate) fn layout(plan: Chosen<'_>) -> [String; 2] {
    let measures = format!(
        "step {} mm, lead {} deg",
        show(plan.step.to_mm()),
        show(plan.lead.to_deg())
    );
    ["tracks".to_owned(), measures]
}
