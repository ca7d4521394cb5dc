//! What the job asks of its machine: angles, rates and margins.

use super::figure::{Zoom, framed};
use super::html::{Column, escaped, near, table, terms};
use super::{Section, Subject};
use crate::pictures;
use vcutc_diagnostics::number::show;
use vcutc_motion::summary::{self as reach_summary, AxisFigure, ReachFigures, SingularFigure, margin_words};
use vcutc_picture::Prefix;

/// An axis with less than this share of half its range left, or of its rate, is marked, as in the picture.
const SCARCE: f64 = 0.05;

/// The section; none for a job without a machine.
pub(super) fn section(subject: Subject<'_>) -> Option<Section> {
    let figures = subject.material.compiled.figures.as_ref()?;
    let mut body = String::new();
    let lines = reach_summary::lines(figures);
    body += &terms(lines.iter().map(|(name, line)| (*name, line.as_str())));
    let ids = [Prefix::new("joints-"), Prefix::for_phones("joints-phone-")];
    if let Some([page, phone]) = pictures::joints_twice(&subject.material, ids) {
        let caption = "Positions, speeds and margins of the axes over time, with the axis moves from and to home; the \
                       table below leaves these out. Axis speeds are those at the programmed speeds.";
        body += &framed(&page, "for-page", Zoom::Free, caption);
        body += &framed(&phone, "for-phones", Zoom::Free, caption);
    }
    let blade = |ids| pictures::blade(&subject.material, ids);
    let places = [Prefix::new("blade-"), Prefix::for_phones("blade-phone-")];
    if let [Some(page), Some(phone)] = places.map(blade) {
        let caption = "How to clamp the blade for this program, over the work at swing 0, with the axes of `tool`: hold it \
                       beside the flange and compare. The proofs do not cover the direction of edge and flat.";
        body += &framed(&page, "for-page", Zoom::Fixed, caption);
        body += &framed(&phone, "for-phones", Zoom::Fixed, caption);
    }
    body += &axes(figures);
    if !figures.singular.is_empty() {
        body += &singular(figures);
    }
    Some(Section {
        id: "machine",
        title: "Machine",
        body,
    })
}

fn axes(figures: &ReachFigures) -> String {
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

fn axis(axis: &AxisFigure) -> Vec<String> {
    let unit = axis.unit;
    let share = match axis.rate_limit {
        Some(limit) if limit > 0.0 => {
            let words = format!("{:.0} %", axis.rate / limit * 100.0);
            if axis.rate > (1.0 - SCARCE) * limit {
                near(&words)
            } else {
                words
            }
        }
        Some(_) | None => "unknown".to_owned(),
    };
    vec![
        escaped(&axis.name),
        format!("{:.2} {unit}", axis.low),
        format!("{:.2} {unit}", axis.high),
        format!("{} to {} {unit}", show(axis.min), show(axis.max)),
        if axis.margin < SCARCE {
            near(&margin_words(axis.margin))
        } else {
            margin_words(axis.margin)
        },
        escaped(&axis.margin_at.words),
        format!("{:.2} {unit}/s", axis.rate),
        share,
        escaped(&axis.rate_at.words),
    ]
}

fn singular(figures: &ReachFigures) -> String {
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
                escaped(&at.words),
            ]
        },
    );
    table("Distance from singularities", &columns, rows)
}
