//! The set-up sheet of a job: one page of paper for the person at the machine.
//!
//! It holds what has to be put right by hand before the first run: blade, frames, stock, generator, and a list of what the
//! compiler does not check. Long lists are folded so that it stays on one page of A4. Like the report it loads nothing, and
//! the same job gives the same bytes.

use super::Material;
use super::digest::hexadecimal;
use super::facts;
use super::page::html::escaped;
use super::page::policy::{Requests, policy};
use vcutc_backend_api::ir::Edges;
use vcutc_backend_api::units::Duration;
use vcutc_driver::Outcome;
use vcutc_driver::checks::{Checks, ReadBack};
use vcutc_driver::summary::time;
use vcutc_picture::{Prefix, setup};

const STYLE: &str = include_str!("assets/sheet.css");
/// Most layers that have a row each; more than that are folded into one.
const MOST_LAYERS: usize = 12;
/// Most files of the program that are named one by one.
const MOST_FILES: usize = 4;

/// The sheet of an outcome, with the files of its program and what came of reading them again, if it was written for a target;
/// none while its job has errors.
#[must_use]
pub fn sheet(outcome: &Outcome, files: &[(&str, &[u8])], read_back: Option<ReadBack>) -> Option<String> {
    let material = Material::of(outcome)?;
    let job = material.job;
    let machine = job.machine.as_ref();
    let mut body = header(outcome, &material);
    body += "<div class=\"columns\">\n";
    body += &section("Stock and zero of the work", &stock(&material));
    body += &section("Blade", &blades(&material));
    body += &section("Cuts", &cuts(&material));
    body += &section(
        "Machine and program",
        &(rows(&[facts::control(machine), facts::speeds(&material)].concat()) + &programs(files)),
    );
    body += "</div>\n<div class=\"columns\" style=\"grid-template-columns: 1fr\">\n";
    body += &section(
        "To check by hand",
        &checklist(&material, &material.compiled.checks.with(read_back)),
    );
    body += "</div>\n<p class=\"signed\"><span>Set up by</span><span>Date</span><span>Blade no.</span></p>\n";
    Some(document(&escaped(&job.name), &body))
}

/// The document around its content.
fn document(name: &str, body: &str) -> String {
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta http-equiv=\"Content-Security-Policy\" content=\"{}\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>{name} - set-up sheet</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n{body}\
         <footer>Made by vcutc {}. All frames: x, y, z in mm, then a, b, c in deg, turned about z, the new y and the new x.</footer>\n\
         </body>\n</html>\n",
        policy(&[], Requests::None),
        env!("CARGO_PKG_VERSION")
    )
}

fn section(title: &str, body: &str) -> String {
    format!("<section>\n<h2>{title}</h2>\n{body}</section>\n")
}

/// Rows of names and values.
fn rows(rows: &[(&str, String)]) -> String {
    let rows: String = rows
        .iter()
        .map(|(name, value)| {
            format!(
                "<tr><th scope=\"row\">{name}</th><td>{}</td></tr>\n",
                escaped(value)
            )
        })
        .collect();
    format!("<table class=\"facts\">\n<tbody>\n{rows}</tbody>\n</table>\n")
}

fn header(outcome: &Outcome, material: &Material<'_>) -> String {
    let job = material.job;
    let machine = job.machine.as_ref().map_or_else(
        || "no machine".to_owned(),
        |machine| format!("{} ({})", machine.name, machine.model.name),
    );
    let report = &material.compiled.report;
    format!(
        "<header>\n<h1><small>Set-up sheet</small>{}</h1>\n<p>{}<br>{}<br>{}, {}, {}</p>\n</header>\n",
        escaped(&job.name),
        escaped(outcome.sources.name(job.name_span.file)),
        escaped(&machine),
        time(report.times.all.total()),
        counted(report.cuts(), "cut"),
        counted(report.layers.len(), "layer"),
    )
}

fn stock(material: &Material<'_>) -> String {
    let stock = material.job.stock;
    let sketch = setup::stock(&setup::Stock {
        ids: Prefix::new("stock-"),
        size: [stock.width, stock.depth, stock.height].map(|length| length.to_mm()),
    });
    let facts = [
        facts::stock(material.job),
        facts::base(material.job.machine.as_ref()),
    ];
    sketch + &rows(&facts.concat())
}

/// The blades, with the way they are held.
fn blades(material: &Material<'_>) -> String {
    let named = facts::blades(material);
    let sketch = named.first().map_or_else(String::new, |blade| {
        setup::blade(&setup::Blade {
            ids: Prefix::new("blade-"),
            length: blade.cutting_length.value.to_mm(),
            tangent: libm::tan(blade.half_apex.value.to_rad()),
            edges: match blade.edges {
                Edges::Single => setup::Edges::One,
                Edges::Double => setup::Edges::Two,
            },
        })
    });
    let tool = facts::tool(material.job.machine.as_ref());
    sketch + &rows(&[facts::of_blades(&named), tool].concat())
}

/// A row of the list of cuts.
struct Layer {
    name: String,
    cuts: usize,
    /// Lowest and highest tip, in mm.
    z: [f64; 2],
    time: Duration,
}

/// The cuts layer by layer, with a sum.
fn cuts(material: &Material<'_>) -> String {
    let layers = layers(material);
    let (shown, folded) = layers.split_at(match layers.len() {
        count if count > MOST_LAYERS => MOST_LAYERS - 1,
        count => count,
    });
    let mut html = String::from(
        "<table>\n<thead><tr><th scope=\"col\">layer</th><th scope=\"col\" class=\"n\">cuts</th>\
         <th scope=\"col\" class=\"n\">tips at z, mm</th><th scope=\"col\" class=\"n\">time</th></tr></thead>\n<tbody>\n",
    );
    for layer in shown {
        html += &row(layer);
    }
    if let (Some(first), Some(last)) = (folded.first(), folded.last()) {
        html += &row(&together(folded, format!("{} to {}", first.name, last.name)));
    }
    let report = &material.compiled.report;
    let rest = report.times.rest.total();
    if rest > Duration::ZERO {
        html += &format!(
            "<tr><th scope=\"row\">from and to home</th><td></td><td></td><td class=\"n\">{}</td></tr>\n",
            time(rest)
        );
    }
    html += &format!(
        "<tr class=\"sum\"><th scope=\"row\">all</th><td class=\"n\">{}</td><td></td><td class=\"n\">{}</td></tr>\n",
        report.cuts(),
        time(report.times.all.total())
    );
    html + "</tbody>\n</table>\n"
}

fn row(layer: &Layer) -> String {
    let [low, high] = layer.z;
    let z = if high - low < 0.005 {
        format!("{low:.2}")
    } else {
        format!("{low:.2} to {high:.2}")
    };
    format!(
        "<tr><th scope=\"row\">{}</th><td class=\"n\">{}</td><td class=\"n\">{z}</td><td class=\"n\">{}</td></tr>\n",
        layer.name,
        layer.cuts,
        time(layer.time)
    )
}

/// The layers of all operations in the order of work; those of several are named `operation.layer`.
fn layers(material: &Material<'_>) -> Vec<Layer> {
    let operations = &material.plan.operations;
    let times = &material.compiled.report.times.layers;
    let mut layers = Vec::new();
    for (number, planned) in (0_u16..).zip(operations) {
        for cuts in planned.tips().chunk_by(|a, b| a.layer == b.layer) {
            let layer = cuts.first().map_or(0, |cut| cut.layer);
            let heights = cuts.iter().map(|cut| cut.tip.z);
            let taken = times
                .iter()
                .find(|time| time.operation.0 == number && time.layer == layer)
                .map_or(Duration::ZERO, |time| time.timing.total());
            layers.push(Layer {
                name: if operations.len() > 1 {
                    format!("{}.{layer}", number + 1)
                } else {
                    layer.to_string()
                },
                cuts: cuts.len(),
                z: [
                    heights.clone().fold(f64::INFINITY, f64::min),
                    heights.fold(f64::NEG_INFINITY, f64::max),
                ],
                time: taken,
            });
        }
    }
    layers
}

fn together(layers: &[Layer], name: String) -> Layer {
    Layer {
        name,
        cuts: layers.iter().map(|layer| layer.cuts).sum(),
        z: [
            layers
                .iter()
                .map(|layer| layer.z[0])
                .fold(f64::INFINITY, f64::min),
            layers
                .iter()
                .map(|layer| layer.z[1])
                .fold(f64::NEG_INFINITY, f64::max),
        ],
        time: layers.iter().map(|layer| layer.time).sum(),
    }
}

/// The files of the program, and what they are known by.
fn programs(files: &[(&str, &[u8])]) -> String {
    if files.is_empty() {
        return rows(&[("program", "not written for any target".to_owned())]);
    }
    let (named, others) = files.split_at(match files.len() {
        count if count > MOST_FILES => MOST_FILES - 1,
        count => count,
    });
    let row = |name: &str, digest: &str| {
        format!(
            "<tr><th scope=\"row\">{}</th><td><code>{digest}</code></td></tr>\n",
            escaped(name)
        )
    };
    let mut html = String::from(
        "<table>\n<thead><tr><th scope=\"col\">program</th><th scope=\"col\">SHA-256</th></tr></thead>\n<tbody>\n",
    );
    for (name, bytes) in named {
        html += &row(name, &hexadecimal(bytes));
    }
    if !others.is_empty() {
        let all: Vec<u8> = others
            .iter()
            .flat_map(|(_, bytes)| bytes.iter().copied())
            .collect();
        let name = format!("{} more, one after the other", others.len());
        html += &row(&name, &hexadecimal(&all));
    }
    html + "</tbody>\n</table>\n"
}

/// What has to be right on the floor, and then what the compiler did not check of this program.
fn checklist(material: &Material<'_>, checks: &Checks) -> String {
    let mut on_the_floor = vec![
        "Blade as named above, sharp, clamped; tip and flat calibrated: the tool frame on the control is the one above.",
        "Base frame measured at the corner of the stock that is marked zero; x, y and z point as in the sketch.",
        "Stock of the size above, fixed so that nothing of the fixture is in the way of the blade.",
        "Stand clear: the way from home and back to it is free.",
        "Generator switches on at its output and says that it is ready; amplitude as for this core.",
    ];
    let machine = material.job.machine.as_ref();
    if machine.is_some_and(|machine| machine.load.is_none()) {
        on_the_floor.push("Load data on the control are those of this blade and holder.");
    }
    let list = |lines: &[String]| {
        let items: String = lines
            .iter()
            .map(|line| format!("<li>{}</li>\n", escaped(line)))
            .collect();
        format!("<ul>\n{items}</ul>\n")
    };
    let on_the_floor: Vec<String> = on_the_floor.into_iter().map(str::to_owned).collect();
    format!(
        "{}<h3>Not checked by the compiler</h3>\n{}",
        list(&on_the_floor),
        list(&checks.by_hand())
    )
}

/// `1 layer`, `2 layers`.
fn counted(count: usize, what: &str) -> String {
    match count {
        1 => format!("1 {what}"),
        _ => format!("{count} {what}s"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_files_are_named_and_more_are_known_together() {
        let bytes: Vec<String> = (0..6).map(|number| number.to_string()).collect();
        let files: Vec<(&str, &[u8])> = bytes
            .iter()
            .map(|name| (name.as_str(), name.as_bytes()))
            .collect();
        let html = programs(&files);
        assert!(html.contains("3 more, one after the other"), "{html}");
        assert!(html.contains(&hexadecimal(b"345")), "{html}");
        assert!(programs(&files[..4]).contains(&hexadecimal(b"3")));
    }
}
