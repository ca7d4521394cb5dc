//! The set-up sheet of a job: one page of paper for the person at the machine.
//!
//! It holds what has to be put right by hand before the first run: blade, frames, stock, generator, and a list of what the
//! compiler does not check. Long lists are folded so that it stays on one page of A4. Like the report it loads nothing, and
//! the same job gives the same bytes.

use super::Material;
use super::digest::hexadecimal;
use super::page::html::escaped;
use super::page::policy::{Requests, policy};
use crate::driver::Outcome;
use crate::job::{Blade, Machine, RoughVcut};
use crate::picture::{Prefix, setup};
use crate::plan::parameters::show;
use crate::plan::{PlannedOperation, PlannedVcut};
use crate::summary::time;
use vcutc_backend_api::geometry::Frame;
use vcutc_backend_api::ir::{AxisKind, Edges, Ready, Registered};
use vcutc_backend_api::units::Duration;

const STYLE: &str = include_str!("assets/sheet.css");
/// Most layers that have a row each; more than that are folded into one.
const MOST_LAYERS: usize = 12;
/// Most files of the program that are named one by one.
const MOST_FILES: usize = 4;

/// The sheet of an outcome, with the files of its program, if it was written for a target; none while its job has errors.
#[must_use]
pub fn sheet(outcome: &Outcome, files: &[(&str, &[u8])]) -> Option<String> {
    let material = Material::of(outcome)?;
    let job = material.job;
    let vcuts: Vec<&PlannedVcut> = material
        .plan
        .operations
        .iter()
        .map(|PlannedOperation::RoughVcut(vcut)| vcut)
        .collect();
    let machine = job.machine.as_ref();
    let mut body = header(outcome, &material);
    body += "<div class=\"columns\">\n";
    body += &section("Stock and zero of the work", &(stock(&material) + &base(machine)));
    body += &section("Blade", &blades(&vcuts, machine));
    body += &section("Cuts", &cuts(&material, &vcuts));
    body += &section(
        "Machine and program",
        &(generator(machine) + &feeds(&vcuts) + &programs(files)),
    );
    body += "</div>\n<div class=\"columns\" style=\"grid-template-columns: 1fr\">\n";
    body += &section("To check by hand: the compiler cannot", &checklist(&material));
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
    let size = [stock.width, stock.depth, stock.height].map(|length| length.to_mm());
    let sketch = setup::stock(&setup::Stock {
        ids: Prefix::new("stock-"),
        size,
    });
    let [x, y, z] = size.map(show);
    sketch + &rows(&[("stock x, y, z", format!("{x} x {y} x {z} mm"))])
}

/// Where the work is.
fn base(machine: Option<&Machine>) -> String {
    let Some(machine) = machine else {
        return rows(&[("base frame", "the job has no machine".to_owned())]);
    };
    rows(&[("base frame", frame(&machine.base.value.frame))])
}

fn frame(frame: &Frame) -> String {
    let (origin, turn) = (frame.origin, frame.orientation.to_zyx());
    let [a, b, c] = [turn.a, turn.b, turn.c].map(|angle| show(angle.to_deg()));
    let [x, y, z] = [origin.x, origin.y, origin.z].map(show);
    format!("x {x}, y {y}, z {z}; a {a}, b {b}, c {c}")
}

/// The blades, each once, with the way they are held.
fn blades(vcuts: &[&PlannedVcut], machine: Option<&Machine>) -> String {
    let mut named: Vec<&Blade> = Vec::new();
    for blade in vcuts.iter().map(|vcut| &vcut.asked.blade) {
        if named.iter().all(|other| other.name != blade.name) {
            named.push(blade);
        }
    }
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
    let mut list: Vec<(&str, String)> = named.iter().map(|blade| ("blade", words(blade))).collect();
    if let Some(machine) = machine {
        let tool = &machine.tool.value.frame;
        list.push(("tool frame", frame(tool)));
        let [edge, flat, tip] = axes(tool);
        list.push((
            "tool axes",
            format!("x (edge) {edge}; y (flat) {flat}; z (out of the tip) {tip}, seen from the flange"),
        ));
    }
    sketch + &rows(&list)
}

fn words(blade: &Blade) -> String {
    let edges = match blade.edges {
        Edges::Single => "single",
        Edges::Double => "double",
    };
    format!(
        "{}: {edges} edge {} mm long, half apex {} deg, {} mm thick",
        blade.name,
        show(blade.cutting_length.value.to_mm()),
        show(blade.half_apex.value.to_deg()),
        show(blade.thickness.value.to_mm())
    )
}

/// Where x, y and z of a tool point, seen from the flange.
fn axes(tool: &Frame) -> [String; 3] {
    let matrix = tool.orientation.matrix();
    [0, 1, 2].map(|column| direction(matrix.map(|row| row[column])))
}

/// A direction in words: an axis where it is one within half a degree.
fn direction(parts: [f64; 3]) -> String {
    // The cosine of half a degree.
    const NEARLY: f64 = 0.999_962;
    let along = ["x", "y", "z"]
        .into_iter()
        .zip(parts)
        .find(|(_, part)| part.abs() > NEARLY);
    match along {
        Some((name, part)) if part > 0.0 => format!("+{name}"),
        Some((name, _)) => format!("-{name}"),
        None => {
            let [x, y, z] = parts.map(|part| format!("{:.2}", part + 0.0));
            format!("({x}, {y}, {z})")
        }
    }
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
fn cuts(material: &Material<'_>, vcuts: &[&PlannedVcut]) -> String {
    let layers = layers(material, vcuts);
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
fn layers(material: &Material<'_>, vcuts: &[&PlannedVcut]) -> Vec<Layer> {
    let times = &material.compiled.report.times.layers;
    let mut layers = Vec::new();
    for (number, vcut) in (0_u16..).zip(vcuts) {
        for cuts in vcut.cuts.chunk_by(|a, b| a.layer == b.layer) {
            let layer = cuts.first().map_or(0, |cut| cut.layer);
            let heights = cuts.iter().map(|cut| cut.tip.z);
            let taken = times
                .iter()
                .find(|time| time.operation.0 == number && time.layer == layer)
                .map_or(Duration::ZERO, |time| time.timing.total());
            layers.push(Layer {
                name: if vcuts.len() > 1 {
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

fn generator(machine: Option<&Machine>) -> String {
    let Some(machine) = machine else {
        return String::new();
    };
    let output = machine.ultrasonic.map_or_else(
        || "no output given".to_owned(),
        |output| format!("output {}", output.value),
    );
    let ready = match machine.ready.value {
        Ready::Input(number) => format!("ready at input {number}"),
        Ready::After(time) => format!("ready {} s after switching on", show(time.to_s())),
    };
    let mut list = vec![("generator", format!("{output}, {ready}"))];
    list.extend(machine.load.map(|load| match load.value {
        Registered::Number(number) => ("load", format!("number {number} of the controller")),
        Registered::Value(load) => {
            let [x, y, z] = [load.centre.x, load.centre.y, load.centre.z].map(show);
            (
                "load",
                format!("{} kg at x {x}, y {y}, z {z} mm", show(load.mass.to_kg())),
            )
        }
    }));
    list.extend(machine.home.map(|home| {
        let axes = machine.model.axes.iter().zip(home.value.0);
        let values = axes.map(|(axis, value)| match axis.kind {
            AxisKind::Rotary => format!("{} {}", axis.name, show(value.to_degrees())),
            AxisKind::Linear => format!("{} {} mm", axis.name, show(value)),
        });
        ("home", values.collect::<Vec<_>>().join(", "))
    }));
    rows(&list)
}

fn feeds(vcuts: &[&PlannedVcut]) -> String {
    let mut list: Vec<(&str, String)> = Vec::new();
    for RoughVcut {
        cut_feed,
        travel_feed,
        reorient_rate,
        clearance,
        ..
    } in vcuts.iter().map(|vcut| &vcut.asked)
    {
        let words = format!(
            "cut {} mm/s, travel {} mm/s, turn {} deg/s; clearance {} mm",
            show(cut_feed.value.to_mm_per_s()),
            show(travel_feed.value.to_mm_per_s()),
            show(reorient_rate.value.to_deg_per_s()),
            show(clearance.value.to_mm())
        );
        if list.iter().all(|(_, known)| *known != words) {
            list.push(("speeds", words));
        }
    }
    rows(&list)
}

/// The files of the program, and what they are known by.
fn programs(files: &[(&str, &[u8])]) -> String {
    if files.is_empty() {
        return rows(&[("program", "give --target to have its files named here".to_owned())]);
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

/// What the compiler does not know.
fn checklist(material: &Material<'_>) -> String {
    let mut list = vec![
        "Blade as named above, sharp, clamped; tip and flat calibrated: the tool frame on the control is the one above.".to_owned(),
        "Base frame measured at the corner of the stock that is marked zero; x, y and z point as in the sketch.".to_owned(),
        "Stock of the size above, fixed so that nothing of the fixture is in the way of the blade.".to_owned(),
        "Shank, holder, arm, table, cables: collisions are not computed. Watch the first run in the air.".to_owned(),
        "Stand clear: the way from home and back to it is free.".to_owned(),
        "Generator switches on at its output and says that it is ready; amplitude as for this core.".to_owned(),
    ];
    if let Some(machine) = &material.job.machine {
        let axes = &machine.model.axes;
        let unknown: Vec<&str> = axes
            .iter()
            .filter(|axis| axis.rate.is_none())
            .map(|axis| axis.name.as_str())
            .collect();
        if !unknown.is_empty() {
            list.push(format!(
                "Speeds of {}: not known to the compiler, so not checked.",
                unknown.join(", ")
            ));
        }
        if machine.load.is_none() {
            list.push("Load data on the control are those of this blade and holder.".to_owned());
        }
    }
    list.push(format!(
        "Times as the first part takes them; they were computed from: {}.",
        material.compiled.times.basis_words
    ));
    let items: String = list
        .iter()
        .map(|item| format!("<li>{}</li>\n", escaped(item)))
        .collect();
    format!("<ul>\n{items}</ul>\n")
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
    fn directions_are_axes_where_they_are() {
        assert_eq!(direction([0.0, -1.0, 0.0]), "-y");
        assert_eq!(direction([1.0, 0.001, 0.0]), "+x");
        assert_eq!(direction([0.6, 0.0, -0.8]), "(0.60, 0.00, -0.80)");
    }

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
