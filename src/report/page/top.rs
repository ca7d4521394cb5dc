//! The top of the page: what was made, what is proven of it, and its key numbers.

use super::Subject;
use crate::html::{Html, unbroken, with_code};
use vcutc_backend_api::units::{Angle, Area, Length};
use vcutc_backend_api::words::counted;
use vcutc_diagnostics::render::{ColorChoice, render};
use vcutc_driver::checks::{Checks, Standing};
use vcutc_driver::summary::{self, time};
use vcutc_motion::summary::margin_words;
use vcutc_simulation::report::Report;

/// The header: job, machine, verdict, warnings.
pub(super) fn header(subject: Subject<'_>) -> Html {
    let job = subject.material.job;
    let machine = job.machine.as_ref().map_or_else(
        || "no machine".to_owned(),
        |machine| format!("{} ({})", machine.name, machine.model.name),
    );
    html!(
        "header.html",
        name = job.name,
        file = subject.sources.name(job.name_span.file),
        machine = machine,
        verdict = verdict(&subject.material.compiled.checks.with(subject.further.read_back)),
        warnings = (!subject.warnings.is_empty()).then(|| warnings(subject)),
    )
}

fn warnings(subject: Subject<'_>) -> Html {
    let text = render(subject.warnings, subject.sources, ColorChoice::Plain);
    html!(
        "warnings.html",
        count = counted(subject.warnings.len(), "warning"),
        lines = Html::lines(text.strip_suffix('\n').unwrap_or(&text))
    )
}

/// What is proven, and apart from that what is not checked.
fn verdict(checks: &Checks) -> Html {
    let standing = checks.standing();
    let class = match standing {
        Standing::Proven => "verdict",
        Standing::InPart => "verdict in-part",
    };
    let open = checks.not_checked().map(|open| {
        html!(
            in "<p class=\"unchecked\"><strong>Not checked:</strong> {open}.</p>\n",
            open = with_code(&open)
        )
    });
    html!(
        in "<p class=\"{class}\">{standing}: {proven}.</p>\n{open}",
        class = class,
        standing = standing.words(),
        proven = checks.proven(),
        open = open
    )
}

/// The key numbers as a list of terms and values.
pub(super) fn key_numbers(subject: Subject<'_>) -> Html {
    let row = |key: Key| {
        let class = match key.room {
            Room::Enough => None,
            Room::Scarce => Some(html!(in " class=\"scarce\"")),
        };
        html!(
            in "<div{class}><dt>{name}</dt><dd>{value}<small>{remark}</small></dd></div>\n",
            class = class,
            name = key.name,
            value = unbroken(&key.value),
            remark = unbroken(&key.remark)
        )
    };
    let rows: Html = rows(subject).into_iter().map(row).collect();
    html!(in "<dl class=\"key\">\n{rows}</dl>\n", rows = rows)
}

struct Key {
    name: &'static str,
    value: String,
    remark: String,
    room: Room,
}

/// How far a number is from its limit.
enum Room {
    /// Far, or it has none.
    Enough,
    /// Less than a twentieth of the limit.
    Scarce,
}

impl Room {
    /// What a share of a limit leaves.
    fn of(share: f64) -> Self {
        if share > 0.95 { Self::Scarce } else { Self::Enough }
    }
}

fn rows(subject: Subject<'_>) -> Vec<Key> {
    let compiled = subject.material.compiled;
    let report = &compiled.report;
    let mut rows = vec![
        free(
            "Time",
            time(report.times.all.total()),
            format!("cutting {}", time(report.times.all.cutting)),
        ),
        free(
            "Cuts",
            report.cuts().to_string(),
            format!("in {}", counted(report.layers.len(), "layer")),
        ),
    ];
    if !summary::is_of_regions(subject.material.plan) {
        rows.extend(of_section(subject));
    }
    rows.extend(of_regions(report));
    if let Some(figures) = &compiled.figures {
        rows.push(Key {
            name: "Least margin",
            value: margin_words(figures.margin),
            remark: format!("{} at {}", figures.least.of, figures.least.at.words),
            room: Room::of(1.0 - figures.margin),
        });
    }
    rows
}

const fn free(name: &'static str, value: String, remark: String) -> Key {
    Key {
        name,
        value,
        remark,
        room: Room::Enough,
    }
}

/// Of pockets and slits along walls.
fn of_regions(report: &Report) -> Vec<Key> {
    let mut rows = Vec::new();
    let uncut = report.cleared.iter().map(|cleared| cleared.uncut);
    if let Some(uncut) = uncut.max_by(Area::total_cmp) {
        rows.push(free(
            "Uncut",
            format!("{:.2} mm²", uncut.to_mm2()),
            "of a layer of a pocket, at most".to_owned(),
        ));
    }
    let engaged = report.cleared.iter().map(|cleared| cleared.engagement);
    if let Some(engaged) = engaged.max_by(Angle::total_cmp) {
        rows.push(free(
            "Engagement",
            format!("{:.0}°", engaged.to_deg()),
            "of the rim at the speed of cutting, at most".to_owned(),
        ));
    }
    let stays = report.slit.iter().map(|slit| slit.stays);
    if let Some(stays) = stays.max_by(Length::total_cmp) {
        rows.push(free(
            "Left on walls",
            format!("{:.3} mm", stays.to_mm()),
            "at their foot, at most".to_owned(),
        ));
    }
    rows
}

/// Of cuts that a section shows.
fn of_section(subject: Subject<'_>) -> Vec<Key> {
    let material = subject.material;
    let (compiled, report) = (material.compiled, &material.compiled.report);
    let limit = material.plan.scallop_limit().map(|(_, limit)| limit.value);
    let scallop = report.scallop.height;
    let (edge, blade) = (report.longest_edge, summary::longest_blade(material.plan));
    let (left, removed) = (report.residual.to_mm2(), report.removed.to_mm2());
    let mut rows = vec![
        Key {
            name: "Largest scallop",
            value: format!("{:.2} mm", scallop.to_mm()),
            remark: {
                let limit = limit.map_or_else(
                    || "no limit".to_owned(),
                    |limit| format!("limit {:.2} mm", limit.to_mm()),
                );
                match compiled.left_over {
                    Some(_) if !report.tracked.is_empty() => format!("of roughing, from the shadow, {limit}"),
                    Some(_) => format!("from the shadow, {limit}"),
                    None => limit,
                }
            },
            room: limit.map_or(Room::Enough, |limit| Room::of(scallop.to_mm() / limit.to_mm())),
        },
        Key {
            name: "Edge in use",
            value: format!("{:.2} mm", edge.to_mm()),
            remark: format!("of {:.2} mm", blade.to_mm()),
            room: Room::of(edge.to_mm() / blade.to_mm()),
        },
        free(
            "Removed",
            format!("{removed:.2} mm²"),
            "of the cross-section".to_owned(),
        ),
    ];
    let finished = report
        .tracked
        .iter()
        .map(|tracked| tracked.left)
        .max_by(Length::total_cmp);
    rows.push(match (&compiled.left_over, finished) {
        (Some(_), Some(left)) => free(
            "Material left",
            format!("{:.3} mm", left.to_mm()),
            "at most, from the surface, in sections across the tracks".to_owned(),
        ),
        (Some(over), None) => free(
            "Material left",
            format!("{:.3} l", over.all.volume.to_litres()),
            format!(
                "at most {:.2} mm above the surface",
                over.all.highest.height.to_mm()
            ),
        ),
        (None, _) => free(
            "Material left",
            format!("{:.2} %", share(left, left + removed) * 100.0),
            format!("{left:.2} mm² stay on the part"),
        ),
    });
    rows
}

/// A part of a whole; nothing of nothing.
fn share(part: f64, whole: f64) -> f64 {
    if whole > 0.0 { part / whole } else { 0.0 }
}
