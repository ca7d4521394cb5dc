//! What the job asks of its machine: angles, rates and margins.

use super::figure::{Zoom, framed};
use super::{Section, Subject};
use crate::html::{Column, Html, near, table, terms};
use crate::pictures;
use vcutc_diagnostics::number::{rounded, show};
use vcutc_dynamics::deviation::figures::{DeviationFigures, ShiftFigure, SwingFigure, millimetres};
use vcutc_dynamics::figures::{TorqueFigures, percent};
use vcutc_dynamics::modes::figures::ModeFigures;
use vcutc_motion::figures::{AxisFigure, ReachFigures, SingularFigure};
use vcutc_motion::summary::{self as reach_summary, margin_words};
use vcutc_picture::Prefix;

/// An axis with less than this share of half its range left, or of its rate, is marked, as in the picture.
const SCARCE: f64 = 0.05;

/// The section; none for a job without a machine.
pub(super) fn section(subject: Subject<'_>) -> Option<Section> {
    let figures = subject.material.compiled.figures.as_ref()?;
    let lines = reach_summary::lines(figures);
    let mut body = terms(lines.iter().map(|(name, line)| (*name, line.as_str())));
    let ids = [Prefix::new("joints-"), Prefix::for_phones("joints-phone-")];
    if let Some([page, phone]) = pictures::joints_twice(&subject.material, ids) {
        let caption = "Positions, speeds and margins of the axes over time, with the axis moves from and to home; the \
                       table below leaves these out. Axis speeds are those at the programmed speeds.";
        body += framed(page, "for-page", Zoom::Free, caption);
        body += framed(phone, "for-phones", Zoom::Free, caption);
    }
    let blade = |ids| pictures::blade(&subject.material, ids);
    let places = [Prefix::new("blade-"), Prefix::for_phones("blade-phone-")];
    if let [Some(page), Some(phone)] = places.map(blade) {
        let caption = "How to clamp the blade for this program, over the work at swing 0, with the axes of `tool`: hold it \
                       beside the flange and compare. The proofs do not cover the direction of edge and flat.";
        body += framed(page, "for-page", Zoom::Fixed, caption);
        body += framed(phone, "for-phones", Zoom::Fixed, caption);
    }
    body += axes(figures);
    if !figures.singular.is_empty() {
        body += singular(figures);
    }
    if let Some(figures) = &subject.material.compiled.dynamics.torques {
        let ids = [Prefix::new("torques-"), Prefix::for_phones("torques-phone-")];
        if let Some(drawn) = pictures::torques(&subject.material, ids) {
            let [page, phone] = drawn.pictures;
            body += framed(page, "for-page", Zoom::Free, &drawn.caption);
            body += framed(phone, "for-phones", Zoom::Free, &drawn.caption);
        }
        body += torques(figures);
    }
    if let Some(figures) = &subject.material.compiled.dynamics.deviation {
        let ids = [Prefix::new("by-forces-"), Prefix::for_phones("by-forces-phone-")];
        if let Some([page, phone]) = pictures::by_forces(&subject.material, ids) {
            let caption = by_forces_caption(figures);
            body += framed(page, "for-page", Zoom::Free, &caption);
            body += framed(phone, "for-phones", Zoom::Free, &caption);
        }
        body += deviations(figures);
    }
    if let Some(figures) = &subject.material.compiled.dynamics.modes {
        body += modes(figures);
    }
    Some(Section {
        id: "machine",
        title: "Machine",
        body,
    })
}

fn axes(figures: &ReachFigures) -> Html {
    let columns = [
        Column::Words("Axis"),
        Column::Numbers("from"),
        Column::Numbers("to"),
        Column::Numbers("limits"),
        Column::Numbers("margin"),
        Column::Words("nearest to a limit at"),
        Column::Numbers("fastest"),
        Column::Numbers("of its rate"),
        Column::Words("fastest at"),
    ];
    table("Use of the axes", &columns, figures.axes.iter().map(axis))
}

/// The torques of the axes, with how far one may rely on them.
fn torques(figures: &TorqueFigures) -> Html {
    let columns = [
        Column::Words("Axis"),
        Column::Numbers("at most"),
        Column::Numbers("weight"),
        Column::Numbers("motion"),
        Column::Numbers("cutting"),
        Column::Numbers("of its limit"),
        Column::Words("at"),
    ];
    let newton_metres = |torque: f64| Html::text(&format!("{:.1} Nm", rounded(torque, 10.0)));
    let rows = figures.axes.iter().map(|axis| {
        vec![
            Html::text(&axis.name),
            newton_metres(axis.most),
            newton_metres(axis.weight),
            newton_metres(axis.motion),
            newton_metres(axis.cutting),
            match (axis.share(), axis.limit) {
                (Some(share), Some(limit)) => {
                    by_room(1.0 - share)(&format!("{} % of {} Nm", percent(share), show(limit)))
                }
                (_, _) => Html::text("unknown"),
            },
            Html::text(&axis.at.words),
        ]
    });
    let caption = format!(
        "Torques at programmed speeds{} ({})",
        figures.apart(),
        figures.backing()
    );
    table(&caption, &columns, rows)
}

/// What the picture of the deviation shows of each cut.
fn by_forces_caption(figures: &DeviationFigures) -> String {
    let limits = figures.operations.iter().filter_map(|of| of.limit);
    let least = limits.reduce(f64::min).map_or_else(String::new, |limit| {
        format!(
            " The lowest limit is {} mm; limits are drawn where cuts come near them.",
            show(limit)
        )
    });
    let compensated = if figures.operations.iter().any(|of| of.compensation.is_some()) {
        " Of compensated operations they hold while all of the edge that a cut uses is in the material."
    } else {
        ""
    };
    format!(
        "How far the forces of the blade push each cut off along the normal of its flank, over the x of its tip: into the waste \
         above zero, into the part below. The bars are bounds, proven on all of each cut for all forces and stiffnesses within \
         their spread.{compensated} Stiffness {}.{least}",
        figures.stiffness.word()
    )
}

/// How far the forces of the blades push cuts off, operation by operation.
fn deviations(figures: &DeviationFigures) -> Html {
    let columns = [
        Column::Words("Operation"),
        Column::Numbers("into the waste"),
        Column::Words("at"),
        Column::Numbers("into the part"),
        Column::Words("at"),
        Column::Numbers("limit"),
        Column::Numbers("at entry, into the waste"),
        Column::Numbers("at entry, into the part"),
    ];
    let swing = |entry: Option<&SwingFigure>| {
        Html::text(&entry.map_or_else(|| "unknown".to_owned(), |entry| millimetres(entry.most)))
    };
    let most = |shift: &ShiftFigure| Html::text(&millimetres(shift.most));
    let place = |shift: &ShiftFigure| Html::text(&shift.words());
    let rows = figures.operations.iter().map(|of| {
        vec![
            Html::text(&(of.operation + 1).to_string()),
            most(&of.into_waste),
            place(&of.into_waste),
            most(&of.into_part),
            place(&of.into_part),
            of.limit.map_or_else(
                || Html::text("none"),
                |limit| Html::text(&format!("{} mm", show(limit))),
            ),
            swing(of.at_entry.as_ref().map(|entry| &entry.into_waste)),
            swing(of.at_entry.as_ref().map(|entry| &entry.into_part)),
        ]
    });
    let lines = figures.lines();
    let others = lines
        .iter()
        .filter(|(name, _)| !["deviation", "at entry"].contains(name));
    let words: Vec<String> = others.map(|(name, text)| format!("{name}: {text}")).collect();
    let caption = format!(
        "Deviation of the flanks by the forces of the blade, at most; stiffness {}. {}",
        figures.stiffness.word(),
        words.join("; "),
    );
    table(&caption, &columns, rows)
}

/// How the arm swings by itself over the cuts.
fn modes(figures: &ModeFigures) -> Html {
    let columns = [
        Column::Words("Mode"),
        Column::Numbers("lowest"),
        Column::Numbers("highest"),
        Column::Words("most by"),
    ];
    let hertz = |frequency: f64| Html::text(&format!("{:.1} Hz", rounded(frequency, 10.0)));
    let rows = (1..).zip(&figures.modes).map(|(number, mode): (u8, _)| {
        vec![
            Html::text(&number.to_string()),
            hertz(mode.lowest),
            hertz(mode.highest),
            Html::text(&format!(
                "{}, {:.0} % of the energy where it is slowest",
                mode.axis,
                100.0 * mode.share
            )),
        ]
    });
    let caption = format!(
        "Modes of the arm on its joints over the cuts, at the beginning, the middle and the end of each ({})",
        figures.backing()
    );
    table(&caption, &columns, rows)
}

fn axis(axis: &AxisFigure) -> Vec<Html> {
    let unit = axis.unit;
    let share = match axis.rate_limit {
        Some(limit) if limit > 0.0 => {
            let share = axis.rate / limit;
            by_room(1.0 - share)(&format!("{:.0} %", share * 100.0))
        }
        Some(_) | None => Html::text("unknown"),
    };
    let margin = by_room(axis.margin)(&margin_words(axis.margin));
    let text = Html::text;
    vec![
        text(&axis.name),
        text(&format!("{:.2} {unit}", axis.low)),
        text(&format!("{:.2} {unit}", axis.high)),
        text(&format!("{} to {} {unit}", show(axis.min), show(axis.max))),
        margin,
        text(&axis.margin_at.words),
        text(&format!("{:.2} {unit}/s", axis.rate)),
        share,
        text(&axis.rate_at.words),
    ]
}

/// How a value is set that has so much of its limit left.
fn by_room(left: f64) -> fn(&str) -> Html {
    if left < SCARCE { near } else { Html::text }
}

fn singular(figures: &ReachFigures) -> Html {
    let columns = [
        Column::Words("Singular pose"),
        Column::Numbers("distance"),
        Column::Numbers("percentage of the maximum"),
        Column::Words("nearest at"),
    ];
    let rows = figures.singular.iter().map(
        |SingularFigure {
             kind,
             unit,
             distance,
             share,
             at,
         }| {
            vec![
                (*kind).to_owned(),
                format!("{distance:.2} {unit}"),
                margin_words(*share),
                at.words.clone(),
            ]
        },
    );
    table("Distance from singularities", &columns, rows)
}
