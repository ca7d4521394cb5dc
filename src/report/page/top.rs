//! The top of the page: what was made, what is proven of it, and its key numbers.

use super::Subject;
use super::html::{escaped, unbroken};
use vcutc_diagnostics::render::{ColorChoice, render};
use vcutc_driver::checks::{Checks, Standing};
use vcutc_driver::summary::{self, time};
use vcutc_motion::summary::margin_words;

/// The header: job, machine, verdict, warnings.
pub(super) fn header(subject: Subject<'_>) -> String {
    let job = subject.material.job;
    let file = subject.sources.name(job.name_span.file);
    let machine = job.machine.as_ref().map_or_else(
        || "no machine".to_owned(),
        |machine| format!("{} ({})", machine.name, machine.model.name),
    );
    let mut header = format!(
        "<header>\n<h1>{}</h1>\n<p class=\"about\">{} on {}</p>\n{}",
        escaped(&job.name),
        escaped(file),
        escaped(&machine),
        verdict(&subject.material.compiled.checks.with(subject.further.read_back))
    );
    if !subject.warnings.is_empty() {
        let told = render(subject.warnings, subject.sources, ColorChoice::Plain);
        let lines: Vec<String> = told.lines().map(escaped).collect();
        header += &format!(
            "<details open class=\"warnings\"><summary>{}</summary>\n<pre tabindex=\"0\">{}</pre></details>\n",
            counted(subject.warnings.len(), "warning"),
            lines.join("\n")
        );
    }
    header + "</header>\n"
}

/// What is proven, and apart from that what is not checked.
fn verdict(checks: &Checks) -> String {
    let standing = checks.standing();
    let class = match standing {
        Standing::Proven => "verdict",
        Standing::InPart => "verdict in-part",
    };
    let proven = format!("{}: {}.", standing.words(), checks.proven());
    let verdict = format!("<p class=\"{class}\">{}</p>\n", escaped(&proven));
    let open = checks.not_checked().map_or_else(String::new, |open| {
        format!(
            "<p class=\"unchecked\"><strong>Not checked:</strong> {}.</p>\n",
            escaped(&open)
        )
    });
    verdict + &open
}

/// The key numbers as a list of terms and values.
pub(super) fn key_numbers(subject: Subject<'_>) -> String {
    let mut numbers = String::from("<dl class=\"key\">\n");
    for Key {
        name,
        value,
        remark,
        room,
    } in rows(subject)
    {
        let class = match room {
            Room::Enough => "",
            Room::Scarce => " class=\"scarce\"",
        };
        numbers += &format!(
            "<div{class}><dt>{name}</dt><dd>{}<small>{}</small></dd></div>\n",
            unbroken(&value),
            unbroken(&remark)
        );
    }
    numbers + "</dl>\n"
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
    let material = subject.material;
    let (compiled, report) = (material.compiled, &material.compiled.report);
    let free = |name, value, remark| Key {
        name,
        value,
        remark,
        room: Room::Enough,
    };
    let limit = material.plan.scallop_limit().map(|(_, limit)| limit.value);
    let scallop = report.scallop.height;
    let (edge, blade) = (report.longest_edge, summary::longest_blade(material.plan));
    let (left, removed) = (report.residual.to_mm2(), report.removed.to_mm2());
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
        Key {
            name: "Largest scallop",
            value: format!("{:.2} mm", scallop.to_mm()),
            remark: limit.map_or_else(
                || "no limit".to_owned(),
                |limit| format!("limit {:.2} mm", limit.to_mm()),
            ),
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
        free(
            "Material left",
            format!("{:.2} %", share(left, left + removed) * 100.0),
            format!("{left:.2} mm² stay on the part"),
        ),
    ];
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

/// A part of a whole; nothing of nothing.
fn share(part: f64, whole: f64) -> f64 {
    if whole > 0.0 { part / whole } else { 0.0 }
}

/// `1 layer`, `2 layers`.
fn counted(count: usize, what: &str) -> String {
    match count {
        1 => format!("1 {what}"),
        _ => format!("{count} {what}s"),
    }
}
