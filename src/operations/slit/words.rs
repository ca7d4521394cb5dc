//! What a plan of slits along walls says of itself: parameters, and lines of the summary.

use crate::decided::Planned;
use vcutc_backend_api::words::counted;
use vcutc_diagnostics::number::show;
use vcutc_job::description::{
    ParameterFigure, ParameterRow, ParameterTable, angle_text, length_text, millimetres, motion_rows,
};

/// The tables: tool, cut, motion.
pub(crate) fn tables(planned: &Planned) -> Vec<ParameterTable> {
    let asked = &planned.asked;
    let blade = &asked.blade;
    let tool = vec![
        ParameterRow::written("blade", blade.name.clone(), blade.span),
        ParameterRow::of("cutting_length", blade.cutting_length, length_text),
        ParameterRow::of("half_apex", blade.half_apex, angle_text),
        ParameterRow::of("thickness", blade.thickness, length_text),
    ];
    let cut = vec![
        ParameterRow::written("region", asked.region.name.clone(), asked.region_span),
        ParameterRow::of("floor", asked.floor, length_text),
        ParameterRow::of("allowance", asked.allowance, length_text),
        ParameterRow::of("residual", asked.residual, length_text),
    ];
    let motion = motion_rows(&asked.setup, asked.plunge_feed);
    [("Tool", tool), ("Cut", cut), ("Motion", motion)]
        .map(|(caption, rows)| ParameterTable { caption, rows })
        .to_vec()
}

pub(crate) fn parameters(planned: &Planned) -> Vec<ParameterFigure> {
    let asked = &planned.asked;
    vec![
        ParameterFigure::fixed("floor", &asked.floor, millimetres(asked.floor.value)),
        ParameterFigure::fixed("allowance", &asked.allowance, millimetres(asked.allowance.value)),
        ParameterFigure::fixed("residual", &asked.residual, millimetres(asked.residual.value)),
    ]
}

pub(crate) fn summary(planned: &Planned) -> Vec<(&'static str, String)> {
    let plan = &planned.plan;
    let text = format!(
        "{} along walls of {} mm",
        counted(plan.slits.len(), "slit"),
        show((plan.knife.height * 1e3).round() / 1e3)
    );
    vec![("walls", text)]
}

/// `slits` and their measures.
pub(crate) fn layout(planned: &Planned) -> [String; 2] {
    let height = show((planned.plan.knife.height * 1e3).round() / 1e3);
    ["slits".to_owned(), format!("walls of {height} mm")]
}
