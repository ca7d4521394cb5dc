//! What the time is spent on.

use crate::Material;
use vcutc_backend_api::units::Duration;
use vcutc_driver::summary;
use vcutc_picture::{Prefix, times};
use vcutc_simulation::timing::{Kind, LayerTime, Timing};

/// What a kind is called in pictures.
pub(super) const fn name(kind: Kind) -> &'static str {
    match kind {
        Kind::Cutting => "cutting",
        Kind::Turning => "turning",
        Kind::Travel => "travel",
        Kind::Waiting => "waiting",
        Kind::Axes => "all axes",
        Kind::Changes => "changes of blade",
    }
}

/// What the time is spent on, by kind of motion and by layer (`picture::times`).
#[must_use]
pub fn time(material: &Material<'_>, ids: Prefix) -> String {
    let spent = &material.compiled.report.times;
    // Most programs have one blade.
    let has_it = |kind: &Kind| *kind != Kind::Changes || spent.all.changes > Duration::ZERO;
    let there: Vec<Kind> = Kind::ALL.into_iter().filter(has_it).collect();
    let seconds =
        |timing: &Timing| -> Vec<f64> { there.iter().map(|kind| timing.of(*kind).to_s()).collect() };
    let operations = material.compiled.program.verified().program().operations.len();
    let of_layer = |layer: &LayerTime| times::Row {
        name: match operations {
            0 | 1 => layer.layer.to_string(),
            _ => format!("{}.{}", u32::from(layer.operation.0) + 1, layer.layer),
        },
        seconds: seconds(&layer.timing),
    };
    let rest = times::Row {
        name: "no layer".to_owned(),
        seconds: seconds(&spent.rest),
    };
    let rows: Vec<times::Row> = spent
        .layers
        .iter()
        .map(of_layer)
        .chain([rest])
        .filter(|row| row.seconds.iter().sum::<f64>() > 0.0)
        .collect();
    let described = there.iter().map(|&kind| times::Kind {
        name: name(kind),
        seconds: spent.all.of(kind).to_s(),
        words: summary::time(spent.all.of(kind)),
    });
    let kinds: Vec<times::Kind> = described.collect();
    let total = summary::time(spent.all.total());
    times::draw(&times::Times {
        heading: times::Heading {
            ids,
            title: &format!("{}: time", material.plan.name),
            subtitle: &format!("{total} in all"),
        },
        kinds: &kinds,
        rows: &rows,
    })
}
