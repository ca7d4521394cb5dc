//! Where the time goes: by kind of motion and by layer.

use super::figure::{Ids, Zoom, figure};
use super::{Section, Subject};
use crate::Material;
use crate::html::{Column, Html, paragraph, percent, table};
use crate::pictures;
use vcutc_backend_api::ir::Action;
use vcutc_backend_api::units::Duration;
use vcutc_backend_api::words::counted;
use vcutc_driver::summary::time;
use vcutc_simulation::timing::Timing;

pub(super) fn section(subject: Subject<'_>) -> Section {
    let report = &subject.material.compiled.report;
    let whole = &report.times.all;
    let mut body = paragraph(&agreement(subject, whole.total()));
    let basis = &subject.material.compiled.times.basis_words;
    body += paragraph(&format!("Basis: {basis}."));
    body += figure(
        &Ids {
            page: "time-",
            phone: "time-phone-",
        },
        Zoom::Fixed,
        "The time by kind of motion and by layer.",
        &|ids| pictures::time(&subject.material, ids),
    );
    body += by_kind(whole);
    body += by_blade(&subject.material).unwrap_or_default();
    body += by_layer(&subject.material);
    Section {
        id: "time",
        title: "Time",
        body,
    }
}

/// How the mean-value model and the program agree.
fn agreement(subject: Subject<'_>, total: Duration) -> String {
    let estimate = subject.material.plan.estimate();
    let apart = match (estimate.to_s() / total.to_s() - 1.0) * 100.0 {
        percent if percent >= 0.05 => format!(" ({percent:.1} % too high)"),
        percent if percent <= -0.05 => format!(" ({:.1} % too low)", -percent),
        _ => String::new(),
    };
    format!(
        "The program takes {}. The mean-value formula, which uses only the parameters, gives {}{apart}.",
        time(total),
        time(estimate)
    )
}

fn by_kind(whole: &Timing) -> Html {
    let columns = [
        Column::Words("Kind"),
        Column::Numbers("time"),
        Column::Numbers("share"),
    ];
    let total = whole.total();
    let kinds = [
        ("cutting", whole.cutting),
        ("turning about the still tip", whole.turning),
        ("travel through the air", whole.travel),
        ("axis moves", whole.axes),
        ("waiting", whole.waiting),
    ];
    let changes = (whole.changes > Duration::ZERO).then_some(("changes of blade", whole.changes));
    let rows = kinds
        .into_iter()
        .chain(changes)
        .chain([("all", whole.total())])
        .map(|(kind, spent)| vec![kind.to_owned(), time(spent), share(spent, total)]);
    table("Time by kind", &columns, rows)
}

/// How long each blade of several is at hand, and how long it takes to change them.
fn by_blade(material: &Material<'_>) -> Option<Html> {
    let program = material.compiled.program.verified().program();
    if program.blades.len() < 2 {
        return None;
    }
    let (mut spent, mut changing) = (vec![Duration::ZERO; program.blades.len()], Duration::ZERO);
    let mut changes = 0;
    for (segment, time) in program.segments().zip(&material.compiled.op_times) {
        if matches!(segment.op.action, Action::ToolChange { .. }) {
            changes += 1;
            changing += *time;
        } else if let Some(spent) = spent.get_mut(usize::from(segment.before.tool.0)) {
            *spent += *time;
        }
    }
    let total = spent.iter().copied().sum::<Duration>() + changing;
    let columns = [
        Column::Words("Blade"),
        Column::Numbers("time"),
        Column::Numbers("share"),
    ];
    let names = program.blades.iter().map(|blade| blade.name.clone());
    let changed = counted(changes, "change");
    let rows = names.zip(spent).chain([(changed, changing)]);
    let rows = rows.map(|(name, spent)| vec![name, time(spent), share(spent, total)]);
    Some(table("Time by blade", &columns, rows))
}

fn share(spent: Duration, total: Duration) -> String {
    if total > Duration::ZERO {
        percent(spent / total)
    } else {
        String::new()
    }
}

fn by_layer(material: &Material<'_>) -> Html {
    let report = &material.compiled.report;
    let ops = &material.compiled.program.verified().program().ops;
    // A V has two flanks, slits and strips are not counted in flanks.
    let (what, each) = if ops.iter().any(|op| matches!(op.action, Action::Follow { .. })) {
        ("cuts", 1)
    } else {
        ("flanks", 2)
    };
    let columns = [
        Column::Words("Layer"),
        Column::Numbers(what),
        Column::Numbers("cutting"),
        Column::Numbers("turning"),
        Column::Numbers("travel"),
        Column::Numbers("other"),
        Column::Numbers("all"),
    ];
    let row = |name: String, flanks: usize, spent: &Timing| {
        let times = [
            spent.cutting,
            spent.turning,
            spent.travel,
            spent.axes + spent.waiting + spent.changes,
            spent.total(),
        ];
        [name, flanks.to_string()]
            .into_iter()
            .chain(times.map(time))
            .collect::<Vec<_>>()
    };
    let layers = &report.times.layers;
    let several = layers.iter().any(|layer| layer.operation.0 > 0);
    // Cuts are counted layer by layer, in the same order.
    let of_layers = layers.iter().zip(&report.layers).map(|(layer, (_, cuts))| {
        let name = if several {
            format!(
                "{} of operation {}",
                layer.layer,
                u32::from(layer.operation.0) + 1
            )
        } else {
            layer.layer.to_string()
        };
        row(name, each * cuts, &layer.timing)
    });
    let rows = core::iter::once(row("no layer".to_owned(), 0, &report.times.rest)).chain(of_layers);
    html!(in "<div class=\"long\">{table}</div>\n", table = table("Time by layer", &columns, rows))
}
