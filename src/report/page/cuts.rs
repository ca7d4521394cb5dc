//! The cuts one by one, layer by layer and folded away, read back from the program. A row leads to its place in the playback.
//!
//! A page has room for so many rows only: of a program with more cuts each layer has one.

use crate::Material;
use crate::html::{Column, Html, table, unbroken};
use std::collections::BTreeMap;
use vcutc_backend_api::ir::{Action, CutKind, Program, Site};
use vcutc_backend_api::units::Duration;
use vcutc_backend_api::words::counted;
use vcutc_driver::summary::time;

/// Most cuts that have a row each.
const MOST_CUTS: usize = 2000;

/// A cut of the program: both flanks of a V, with the ways to them and between them.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Cut {
    /// Its number within its layer.
    number: u32,
    /// What it does.
    kind: CutKind,
    /// Where the tip runs, in mm.
    x: f64,
    z: f64,
    /// How far the tip goes through the work or beyond its ends while it cuts, in mm.
    way: f64,
    start: Duration,
    /// How long it takes.
    time: Duration,
}

/// The cuts of each layer in the order of work; layers by operation and number, both from 1.
type Layers = BTreeMap<(u32, u32), Vec<Cut>>;

pub(super) fn table_of_cuts(material: &Material<'_>) -> Html {
    let program = material.compiled.program.verified().program();
    let layers = layers(program, &material.compiled.op_times);
    let height = program.stock.height.to_mm();
    let several = program.operations.len() > 1;
    let name = |(operation, layer): (u32, u32)| {
        if several {
            format!("{operation}.{layer}")
        } else {
            layer.to_string()
        }
    };
    folded(&layers, height, &name)
}

/// All of it, folded away; nothing where nothing is cut.
fn folded(layers: &Layers, height: f64, name: &dyn Fn((u32, u32)) -> String) -> Html {
    let count: usize = layers.values().map(Vec::len).sum();
    let body = match count {
        0 => return Html::default(),
        count if count > MOST_CUTS => html!(
            in "<p>{count} cuts are too many for a row each (at most {most}), so each layer has one; the playback has every cut.</p>\n\
                {table}",
            count = count,
            most = MOST_CUTS,
            table = by_layer(layers, name)
        ),
        _ => {
            let hint = "Depth is measured from the top of the stock to the tip, of a disc to the centre of its edge. The way is that of both flanks, with their extensions \
                        beyond the stock. The time includes turns and the way to the cut. Choose a start to see it in the playback.";
            let all = layers
                .iter()
                .map(|(layer, cuts)| layer_of_cuts(&name(*layer), cuts, height));
            html!(in "<p>{hint}</p>\n{layers}", hint = hint, layers = all.collect::<Html>())
        }
    };
    html!("cuts.html", count = count, body = body)
}

/// What the program cuts, in the order of its ops.
fn layers(program: &Program, op_times: &[Duration]) -> Layers {
    let mut layers = Layers::new();
    // Where a cut stands in its layer: its second flank may come after the first ones of all others.
    let mut places: BTreeMap<(u32, u32, u32), usize> = BTreeMap::new();
    let mut now = Duration::ZERO;
    for (segment, time) in program.segments().zip(op_times) {
        if let Site::Cut {
            operation,
            layer,
            cut,
        } = segment.op.site
        {
            let (id, operation) = (operation, u32::from(operation.0) + 1);
            let (layer, number) = (layer.get(), cut.get());
            let cuts = layers.entry((operation, layer)).or_default();
            let place = *places.entry((operation, layer, number)).or_insert(cuts.len());
            if place == cuts.len() {
                cuts.push(Cut {
                    number,
                    kind: CutKind::Cut,
                    x: 0.0,
                    z: 0.0,
                    way: 0.0,
                    start: now,
                    time: Duration::ZERO,
                });
            }
            if let Some(cut) = cuts.get_mut(place) {
                cut.time += *time;
                if matches!(segment.op.action, Action::Cut { .. } | Action::Follow { .. }) {
                    cut.kind = program.cut_kind(id, segment.before.tool);
                }
                if let (Action::Cut { to, .. } | Action::Follow { to, .. }, Some(line)) =
                    (segment.op.action, segment.line())
                {
                    (cut.x, cut.z) = (to.x, to.z);
                    cut.way += line.length().to_mm();
                }
            }
        }
        now += *time;
    }
    layers
}

/// The cuts of a layer, folded away.
fn layer_of_cuts(name: &str, cuts: &[Cut], height: f64) -> Html {
    let row = |cut: &Cut| {
        let start = cut.start.to_s();
        html!(
            "cut.html",
            number = label(cut),
            x = format!("{:.2}", cut.x),
            z = format!("{:.2}", cut.z),
            depth = format!("{:.2}", height - cut.z),
            way = format!("{:.1}", cut.way),
            seek = format!("{start:.3}"),
            start = clock(start),
            time = format!("{:.1}", cut.time.to_s()),
        )
    };
    html!(
        "layer.html",
        name = name,
        words = unbroken(&in_words(cuts)),
        rows = cuts.iter().map(row).collect::<Html>(),
    )
}

/// Its number, and what it is where that is not a V.
fn label(cut: &Cut) -> String {
    match cut.kind {
        CutKind::Cut => cut.number.to_string(),
        CutKind::Slit | CutKind::Strip | CutKind::Track => format!("{} {}", cut.kind.noun(), cut.number),
    }
}

/// `13 cuts, tips at z 28.43 mm, 1 min 27.1 s`.
fn in_words(cuts: &[Cut]) -> String {
    format!(
        "{}, tips at z {} mm, {}",
        counted(cuts.len(), "cut"),
        heights(cuts),
        time(together(cuts))
    )
}

fn together(cuts: &[Cut]) -> Duration {
    cuts.iter().map(|cut| cut.time).sum()
}

/// The heights of the tips, lowest to highest.
fn heights(cuts: &[Cut]) -> String {
    let heights = cuts.iter().map(|cut| cut.z);
    let low = heights.clone().fold(f64::INFINITY, f64::min);
    let high = heights.fold(f64::NEG_INFINITY, f64::max);
    if high - low < 0.005 {
        format!("{low:.2}")
    } else {
        format!("{low:.2} to {high:.2}")
    }
}

/// A row for each layer.
fn by_layer(layers: &Layers, name: &dyn Fn((u32, u32)) -> String) -> Html {
    let columns = [
        Column::Words("Layer"),
        Column::Numbers("cuts"),
        Column::Numbers("tips at z, mm"),
        Column::Numbers("time"),
    ];
    let rows = layers.iter().map(|(layer, cuts)| {
        vec![
            name(*layer),
            cuts.len().to_string(),
            heights(cuts),
            time(together(cuts)),
        ]
    });
    html!(in "<div class=\"long\">{table}</div>\n", table = table("Cuts by layer", &columns, rows))
}

/// `1:02.3`, or `2:01:02.3` where there are hours.
fn clock(seconds: f64) -> String {
    let tenths = (seconds * 10.0).round() as u64;
    let (hours, minutes, rest) = (tenths / 36_000, tenths / 600 % 60, tenths % 600);
    let rest = format!("{:02}.{}", rest / 10, rest % 10);
    if hours > 0 {
        format!("{hours}:{minutes:02}:{rest}")
    } else {
        format!("{minutes}:{rest}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_carry_over() {
        assert_eq!(clock(0.0), "0:00.0");
        assert_eq!(clock(59.97), "1:00.0");
        assert_eq!(clock(3599.96), "1:00:00.0");
        assert_eq!(clock(7262.34), "2:01:02.3");
    }

    /// Layers of a hundred cuts each.
    fn layers_of(count: u32) -> Layers {
        let mut layers = Layers::new();
        for number in 0..count {
            let cut = Cut {
                number: number % 100 + 1,
                kind: CutKind::Cut,
                x: f64::from(number),
                z: 123.456,
                way: 1234.5,
                start: Duration::s(f64::from(number)),
                time: Duration::s(1.0),
            };
            layers.entry((1, number / 100 + 1)).or_default().push(cut);
        }
        layers
    }

    #[test]
    fn a_page_has_room_for_so_many_rows_only() {
        let html = |count: u32| folded(&layers_of(count), 200.0, &|(_, layer)| layer.to_string()).into_text();
        assert_eq!(html(0), "");
        let most = html(2000);
        assert_eq!(
            (
                most.matches("data-seek").count(),
                most.matches("<details").count()
            ),
            (2000, 21)
        );
        assert!(most.len() < 450_000, "{} bytes", most.len());
        for count in [2001, 10_000] {
            let many = html(count);
            let layers = count.div_ceil(100) as usize;
            assert_eq!(
                many.matches("<tr>").count(),
                layers + 1,
                "a row each and the head"
            );
            assert_eq!(many.matches("data-seek").count(), 0);
            assert!(many.contains(&format!("{count} cuts are too many")));
            assert!(many.len() < 40_000, "{} bytes", many.len());
        }
    }

    #[test]
    fn layers_show_their_heights() {
        let cut = |z: f64| Cut {
            kind: CutKind::Cut,
            number: 1,
            x: 0.0,
            z,
            way: 10.0,
            start: Duration::ZERO,
            time: Duration::s(1.5),
        };
        assert_eq!(in_words(&[cut(3.0)]), "1 cut, tips at z 3.00 mm, 1.5 s");
        assert_eq!(
            in_words(&[cut(3.0), cut(1.25)]),
            "2 cuts, tips at z 1.25 to 3.00 mm, 3.0 s"
        );
    }
}
