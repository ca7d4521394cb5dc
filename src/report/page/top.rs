//! The top of the page: what was made, what is proven of it, and its key numbers.

use super::Subject;
use super::html::escaped;
use crate::checks::{Checks, Standing};
use crate::diag::render::{ColorChoice, render};
use crate::plan::parameters::show;
use crate::reach_summary::margin_words;
use crate::summary::{self, time};

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
        verdict(&subject.material.compiled.checks)
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
    for (name, value, remark) in rows(subject) {
        numbers += &format!(
            "<div><dt>{name}</dt><dd>{}<small>{}</small></dd></div>\n",
            escaped(&value),
            escaped(&remark)
        );
    }
    numbers + "</dl>\n"
}

/// Name, value and remark of each key number.
fn rows(subject: Subject<'_>) -> Vec<(&'static str, String, String)> {
    let material = subject.material;
    let (compiled, report) = (material.compiled, &material.compiled.report);
    let mut rows = vec![
        (
            "Time",
            time(report.times.all.total()),
            format!("cutting {}", time(report.times.all.cutting)),
        ),
        (
            "Cuts",
            report.cuts().to_string(),
            format!("in {}", counted(report.layers.len(), "layer")),
        ),
        (
            "Largest scallop",
            format!("{:.2} mm", report.scallop.height.to_mm()),
            scallop_limit(subject),
        ),
        (
            "Edge in use",
            format!("{} mm", show(report.longest_edge.to_mm())),
            format!("of {} mm", show(summary::longest_blade(material.plan).to_mm())),
        ),
        (
            "Removed",
            format!("{:.0} mm²", report.removed.to_mm2()),
            format!("{:.1} mm² stay on the part", report.residual.to_mm2()),
        ),
        (
            "Contours correlate",
            format!("{:.2} %", report.correlation * 100.0),
            "machined and theoretical".to_owned(),
        ),
    ];
    if let Some(figures) = &compiled.figures {
        rows.push((
            "Least margin",
            margin_words(figures.margin),
            format!("{} at {}", figures.least.of, figures.least.at.words),
        ));
    }
    rows
}

fn scallop_limit(subject: Subject<'_>) -> String {
    summary::scallop_limit(subject.material.plan).map_or_else(
        || "no limit".to_owned(),
        |limit| format!("limit {} mm", show(limit.to_mm())),
    )
}

/// `1 layer`, `2 layers`.
fn counted(count: usize, what: &str) -> String {
    match count {
        1 => format!("1 {what}"),
        _ => format!("{count} {what}s"),
    }
}
