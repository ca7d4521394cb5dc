//! How far what the cuts leave is from the part.

use super::figure::{Ids, Zoom, figure};
use super::{Section, Subject};
use crate::html::{Column, Html, table};
use crate::pictures;
use vcutc_driver::left_over::LeftOver;
use vcutc_simulation::prove::Tracked;
use vcutc_simulation::report::Report;
use vcutc_surface::residual::{Over, Volume};

pub(super) fn section(subject: Subject<'_>) -> Section {
    let material = &subject.material;
    let deviation = figure(
        &Ids {
            page: "deviation-",
            phone: "deviation-phone-",
        },
        Zoom::Free,
        "The distance of the machined contour from the part.",
        &|ids| pictures::deviation(material, ids),
    );
    let correlation = figure(
        &Ids {
            page: "correlation-",
            phone: "correlation-phone-",
        },
        Zoom::Free,
        "The correlation of machined and theoretical contour, shifted against each other.",
        &|ids| pictures::correlation(material, ids),
    );
    Section {
        id: "deviation",
        title: "Deviation",
        body: html!(
            in "{deviation}{figures}<details>\n<summary>Correlation of the contours</summary>\n{correlation}</details>\n",
            deviation = deviation,
            figures = figures(subject),
            correlation = correlation,
        ),
    }
}

/// The figures by which [Cui IV.B] judges a contour, and how they are meant.
fn figures(subject: Subject<'_>) -> Html {
    let report = &subject.material.compiled.report;
    let columns = [
        Column::Words("Figure"),
        Column::Numbers("value"),
        Column::Sentences("what it is"),
    ];
    let rows = [
        (
            "largest deviation",
            format!("{:.2} mm", report.largest_deviation().to_mm()),
            largest(report),
        ),
        (
            "highest scallop",
            format!("{:.2} mm", report.scallop.height.to_mm()),
            format!(
                "the largest distance of the machined contour from the nearest point of the part, at x {:.1} mm; limits on \
                     the scallop bound this one",
                report.scallop.peak.x
            ),
        ),
        (
            "mean scallop",
            format!("{:.2} mm", report.mean_scallop.to_mm()),
            "area that stays on the part, over the profile's length".to_owned(),
        ),
        (
            "cross-correlation",
            format!("{:.2} %", report.correlation * 100.0),
            "the largest normalised one over all shifts, of both contours at 1000 points [Cui 15]".to_owned(),
        ),
    ];
    let left_over = subject.material.compiled.left_over.as_ref();
    let over_surface = left_over.into_iter().flat_map(over_surface);
    let finished = report.tracked.iter().flat_map(finished);
    let rows = rows
        .into_iter()
        .chain(over_surface)
        .chain(finished)
        .map(|(name, value, meaning)| vec![name.to_owned(), value, meaning]);
    table("Machined and theoretical contour", &columns, rows)
}

/// What is left over a part that changes along y, of which the figures above measure the shadow.
fn over_surface(left: &LeftOver) -> [(&'static str, String, String); 3] {
    let litres = |volume: Volume| format!("{:.3} l", volume.to_litres());
    let Over { height, place } = left.all.highest;
    let [x, y] = place.map(|length| format!("{:.1} mm", length.to_mm()));
    [
        (
            "left over the surface",
            litres(left.all.volume),
            "all that stands above the part; the figures above measure its shadow along y".to_owned(),
        ),
        (
            "below the shadow",
            litres(left.shaded),
            "what of that straight cuts along y do not reach".to_owned(),
        ),
        (
            "highest above the surface",
            format!("{:.2} mm", height.to_mm()),
            format!("straight above the part, at x {x}, y {y}"),
        ),
    ]
}

/// What tracks on a surface leave, of which the other figures know nothing: they are those of roughing.
fn finished(tracked: &Tracked) -> [(&'static str, String, String); 3] {
    let [x, y, _] = tracked.at;
    [
        (
            "left after finishing",
            format!("{:.3} mm", tracked.left.to_mm()),
            format!(
                "the largest distance from the part in {} sections across the tracks, at x {x:.1} mm, y {y:.1} mm; all figures \
                 above are of what roughing leaves",
                tracked.sections
            ),
        ),
        (
            "mean after finishing",
            format!("{:.3} mm", tracked.mean.to_mm()),
            "area that stays in these sections, over their length".to_owned(),
        ),
        (
            "entry of the disc",
            format!("{:.3} mm", tracked.entry.to_mm()),
            "how deep it enters the part between two poses, along z, at most".to_owned(),
        ),
    ]
}

/// Where the largest deviation is, and of which contour from which.
fn largest(report: &Report) -> String {
    let both = "the largest distance from a point of one contour to the other";
    match report.hollow() {
        Some(hollow) => format!(
            "{both}: here the deepest corner of the part that no cut reaches, at x {:.1} mm",
            hollow.peak.x
        ),
        None => format!(
            "{both}: of the machined contour from the part, at x {:.1} mm",
            report.scallop.peak.x
        ),
    }
}
