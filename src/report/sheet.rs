//! The set-up sheet of a job: one page of paper for the person at the machine.
//!
//! It holds what has to be set up by hand before the first run: blade, frames, stock, generator, and a list
//! of what the compiler does not check. Long lists are folded so that it stays on one page of A4. Like the
//! report it loads nothing, and the same job gives the same bytes.

use super::Material;
use super::digest::hexadecimal;
use super::facts;
use super::html::{Html, Markup, with_code};
use super::page::policy::{Requests, policy};
use vcutc_backend_api::ir::Changer;
use vcutc_backend_api::units::Duration;
use vcutc_backend_api::words::counted;
use vcutc_driver::Outcome;
use vcutc_driver::checks::ReadBack;
use vcutc_driver::summary::time;
use vcutc_job::BladeRef;
use vcutc_picture::{Prefix, setup};

const STYLE: &str = include_str!("assets/sheet.css");
/// Most layers that have a row each; more than that are folded into one.
const MOST_LAYERS: usize = 12;
/// Most files of the program that are named one by one.
const MOST_FILES: usize = 4;

/// The sheet of an outcome, with the files of its program and the result of reading them again, if it was
/// written for a target; none while its job has errors.
#[must_use]
pub fn sheet(outcome: &Outcome, files: &[(&str, &[u8])], read_back: Option<ReadBack>) -> Option<String> {
    let material = Material::of(outcome)?;
    let (job, report) = (material.job, &material.compiled.report);
    let machine = job.machine.as_ref();
    let named = machine.map_or_else(
        || "no machine".to_owned(),
        |machine| format!("{} ({})", machine.name, machine.model.name),
    );
    let program = [facts::control(&material), facts::speeds(&material)].concat();
    let sheet = html!(
        "sheet.html",
        policy = policy(&[], Requests::None),
        name = job.name,
        style = Html::trusted(STYLE),
        file = outcome.sources.name(job.name_span.file),
        machine = named,
        time = time(report.times.all.total()),
        cuts = counted(report.cuts(), "cut"),
        layers = counted(report.layers.len(), "layer"),
        stock = stock(&material),
        blades_are = if has_several(&material) { "Blades" } else { "Blade" },
        blade = blades(&material),
        layers_table = cuts(&material),
        program = rows(&program) + programs(files),
        on_the_floor = items(on_the_floor(&material)),
        numbers_of = if has_several(&material) {
            "Blades no."
        } else {
            "Blade no."
        },
        not_checked = items(
            material
                .compiled
                .checks
                .with(read_back)
                .by_hand()
                .iter()
                .map(|line| with_code(line))
        ),
        version = env!("CARGO_PKG_VERSION"),
    );
    Some(sheet.into_text())
}

/// Rows of names and values.
fn rows(rows: &[(&str, String)]) -> Html {
    let row = |(name, value): &(&str, String)| {
        html!(
            in "<tr><th scope=\"row\">{name}</th><td>{value}</td></tr>\n",
            name = name,
            value = value
        )
    };
    html!("facts.html", rows = rows.iter().map(row).collect::<Html>())
}

fn items<T: Markup>(lines: impl IntoIterator<Item = T>) -> Html {
    let item = |line: T| html!(in "<li>{line}</li>\n", line = line);
    lines.into_iter().map(item).collect()
}

fn stock(material: &Material<'_>) -> Html {
    let stock = material.job.stock;
    let size = [stock.width, stock.depth, stock.height].map(|length| length.to_mm());
    let sketch = setup::stock(Prefix::new("stock-"), size);
    let facts = [
        facts::stock(material.job),
        facts::base(material.job.machine.as_ref()),
    ];
    Html::trusted(sketch) + rows(&facts.concat())
}

/// Whether the program changes the blade.
fn has_several(material: &Material<'_>) -> bool {
    facts::changes(material.compiled.program.verified().program()) > 0
}

/// The blades, with the way they are held.
fn blades(material: &Material<'_>) -> Html {
    let named = facts::blades(material);
    let straight = named.iter().find_map(|blade| match blade {
        BladeRef::Straight(blade) => Some(*blade),
        BladeRef::Disc(_) | BladeRef::Crusher(_) => None,
    });
    let sketch = straight.map_or_else(String::new, |blade| {
        let (edge, half_apex) = (blade.cutting_length.value, blade.half_apex.value);
        setup::blade(
            Prefix::new("blade-"),
            blade.edges,
            edge.to_mm(),
            half_apex.to_rad(),
        )
    });
    let sketched = match (straight, &named[..]) {
        (None, _) | (_, [_]) => Vec::new(),
        (Some(blade), _) => vec![("sketch", blade.name.clone())],
    };
    let tool = facts::tool(material);
    Html::trusted(sketch) + rows(&[sketched, facts::of_blades(&named), tool].concat())
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
fn cuts(material: &Material<'_>) -> Html {
    let layers = layers(material);
    let (shown, folded) = layers.split_at(match layers.len() {
        count if count > MOST_LAYERS => MOST_LAYERS - 1,
        count => count,
    });
    let mut rows: Html = shown.iter().map(row).collect();
    if let (Some(first), Some(last)) = (folded.first(), folded.last()) {
        rows += row(&together(folded, format!("{} to {}", first.name, last.name)));
    }
    let report = &material.compiled.report;
    let rest = Some(report.times.rest.total()).filter(|rest| *rest > Duration::ZERO);
    let rest = rest.map(|rest| {
        html!(
            in "<tr><th scope=\"row\">{what}</th><td></td><td></td><td class=\"n\">{time}</td></tr>\n",
            what = if has_several(material) {
                "home, changes of blade"
            } else {
                "from and to home"
            },
            time = time(rest)
        )
    });
    html!(
        "sheet_cuts.html",
        rows = rows,
        rest = rest,
        cuts = report.cuts(),
        time = time(report.times.all.total()),
    )
}

fn row(layer: &Layer) -> Html {
    let [low, high] = layer.z;
    let z = if high - low < 0.005 {
        format!("{low:.2}")
    } else {
        format!("{low:.2} to {high:.2}")
    };
    html!(
        in "<tr><th scope=\"row\">{name}</th><td class=\"n\">{cuts}</td><td class=\"n\">{z}</td><td class=\"n\">{time}</td></tr>\n",
        name = layer.name,
        cuts = layer.cuts,
        z = z,
        time = time(layer.time)
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
fn programs(files: &[(&str, &[u8])]) -> Html {
    if files.is_empty() {
        return rows(&[("program", "not written for any target".to_owned())]);
    }
    let (named, others) = files.split_at(match files.len() {
        count if count > MOST_FILES => MOST_FILES - 1,
        count => count,
    });
    let row = |name: &str, bytes: &[u8]| {
        html!(
            in "<tr><th scope=\"row\">{name}</th><td><code>{digest}</code></td></tr>\n",
            name = name,
            digest = hexadecimal(bytes)
        )
    };
    let mut rows: Html = named.iter().map(|(name, bytes)| row(name, bytes)).collect();
    if !others.is_empty() {
        let all: Vec<u8> = others
            .iter()
            .flat_map(|(_, bytes)| bytes.iter().copied())
            .collect();
        rows += row(&format!("{} more, one after the other", others.len()), &all);
    }
    html!("sheet_files.html", rows = rows)
}

/// What has to be right on the floor.
fn on_the_floor(material: &Material<'_>) -> Vec<String> {
    let machine = material.job.machine.as_ref();
    let several = has_several(material);
    let mut lines = Vec::new();
    lines.push(if several {
        "Blades as named above, sharp, clamped, each one calibrated: the tool frames on the control are the ones above."
    } else {
        "Blade as named above, sharp, clamped; tip and flat calibrated: the tool frame on the control is the one above."
    });
    lines.extend([
        "Base frame measured at the corner of the stock that is marked zero; x, y and z point as in the sketch.",
        "Stock of the size above, fixed so that nothing of the fixture is in the way of the blade.",
        "Stand clear: the way from home and back to it is free.",
        "Generator switches on at its output and says that it is ready; amplitude as for this core.",
    ]);
    let spins = |blade: &BladeRef<'_>| match blade {
        BladeRef::Straight(_) => false,
        BladeRef::Disc(_) | BladeRef::Crusher(_) => true,
    };
    if facts::blades(material).iter().any(spins) {
        lines.push("Spindle switches on at its output, turns the right way, and as fast as its blade needs.");
    }
    if machine.is_some_and(|machine| machine.tools.iter().any(|tool| tool.load.is_none())) {
        lines.push(if several {
            "Load data on the control are those of each blade with its holder."
        } else {
            "Load data on the control are those of this blade and holder."
        });
    }
    let mut lines: Vec<String> = lines.into_iter().map(str::to_owned).collect();
    lines.extend(change(material));
    lines
}

/// What has to be right where the blade is changed.
fn change(material: &Material<'_>) -> Option<String> {
    let program = material.compiled.program.verified().program();
    let first = program.blades.first().filter(|_| has_several(material))?;
    let others = match material.job.machine.as_ref()?.change?.change.by {
        Changer::Program => "the others in their places of the changer",
        Changer::Hand => "the others at hand",
    };
    Some(format!(
        "Blade {} in the machine, {others}; the way to where blades are changed and back is free.",
        first.name
    ))
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
        let html = programs(&files).into_text();
        assert!(html.contains("3 more, one after the other"), "{html}");
        assert!(html.contains(&hexadecimal(b"345")), "{html}");
        assert!(programs(&files[..4]).into_text().contains(&hexadecimal(b"3")));
    }
}
