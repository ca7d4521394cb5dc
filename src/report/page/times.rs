//! Where the time goes: by kind of motion and by layer.

use super::figure::{Zoom, figure};
use super::html::{Column, paragraph, percent, table};
use super::{Section, Subject};
use crate::picture::Prefix;
use crate::plan::PlannedOperation;
use crate::report::pictures;
use crate::summary::time;
use std::collections::BTreeMap;
use vcutc_backend_api::ir::{Action, OperationId, Site};
use vcutc_backend_api::units::Duration;

/// What time is spent on.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Spent {
    cutting: Duration,
    turning: Duration,
    travel: Duration,
    axes: Duration,
    waiting: Duration,
}

impl Spent {
    fn add(&mut self, action: Action, time: Duration) {
        let kind = match action {
            Action::Cut { .. } => &mut self.cutting,
            Action::Turn { .. } => &mut self.turning,
            Action::Travel { .. } | Action::Approach { .. } | Action::Retract { .. } => &mut self.travel,
            Action::Home | Action::AxisTravel { .. } => &mut self.axes,
            Action::AwaitReady
            | Action::Dwell { .. }
            | Action::Ultrasonic { .. }
            | Action::ToolChange { .. } => &mut self.waiting,
        };
        *kind += time;
    }

    fn total(&self) -> Duration {
        self.cutting + self.turning + self.travel + self.axes + self.waiting
    }
}

/// A layer of an operation; none for what serves no layer.
type Place = Option<(OperationId, u32)>;

/// The section.
pub(super) fn section(subject: Subject<'_>) -> Section {
    let (whole, layers) = spent(subject);
    let mut body = paragraph(&agreement(subject, whole.total()));
    let basis = &subject.material.compiled.times.basis_words;
    body += &paragraph(&format!("Basis: {basis}."));
    body += &figure(
        &pictures::time(&subject.material, Prefix::new("time-")),
        Zoom::Fixed,
        "What the time is spent on.",
    );
    body += &by_kind(&whole);
    body += &by_layer(&layers);
    Section {
        id: "time",
        title: "Time",
        body,
    }
}

/// Adds up the ops' times.
fn spent(subject: Subject<'_>) -> (Spent, BTreeMap<Place, (usize, Spent)>) {
    let compiled = subject.material.compiled;
    let program = compiled.program.verified().program();
    let (mut whole, mut layers) = (Spent::default(), BTreeMap::<Place, (usize, Spent)>::new());
    for (op, &time) in program.ops.iter().zip(&compiled.op_times) {
        let place = match op.site {
            Site::Program | Site::Operation(_) => None,
            Site::Layer { operation, layer } | Site::Cut { operation, layer, .. } => {
                Some((operation, layer.get()))
            }
        };
        whole.add(op.action, time);
        let (flanks, layer) = layers.entry(place).or_default();
        *flanks += usize::from(matches!(op.action, Action::Cut { .. }));
        layer.add(op.action, time);
    }
    (whole, layers)
}

/// How the mean-value model and the program agree.
fn agreement(subject: Subject<'_>, total: Duration) -> String {
    let operations = subject.material.plan.operations.iter();
    let estimate: Duration = operations
        .map(|PlannedOperation::RoughVcut(vcut)| vcut.estimate)
        .sum();
    let apart = match total.to_s() {
        seconds if seconds > 0.0 => format!(", {:+.1} %", (estimate.to_s() / seconds - 1.0) * 100.0),
        _ => String::new(),
    };
    format!(
        "The program takes {}. The mean-value model says {}{apart}, from the parameters alone.",
        time(total),
        time(estimate)
    )
}

fn by_kind(whole: &Spent) -> String {
    let columns = [
        Column::Words("Kind"),
        Column::Numbers("time"),
        Column::Numbers("share"),
    ];
    let Spent {
        cutting,
        turning,
        travel,
        axes,
        waiting,
    } = *whole;
    let total = whole.total().to_s();
    let kinds = [
        ("cutting", cutting),
        ("turning about the still tip", turning),
        ("travel through the air", travel),
        ("moves of all axes", axes),
        ("waiting", waiting),
    ];
    let rows = kinds
        .into_iter()
        .chain([("all", whole.total())])
        .map(|(kind, spent)| {
            let share = if total > 0.0 {
                percent(spent.to_s() / total)
            } else {
                String::new()
            };
            vec![kind.to_owned(), time(spent), share]
        });
    table("Time by kind", &columns, rows)
}

fn by_layer(layers: &BTreeMap<Place, (usize, Spent)>) -> String {
    let columns = [
        Column::Words("Layer"),
        Column::Numbers("flanks"),
        Column::Numbers("cutting"),
        Column::Numbers("turning"),
        Column::Numbers("travel"),
        Column::Numbers("other"),
        Column::Numbers("all"),
    ];
    let several = layers.keys().flatten().any(|(operation, _)| operation.0 > 0);
    let rows = layers.iter().map(|(place, (flanks, spent))| {
        let name = match place {
            None => "outside of layers".to_owned(),
            Some((operation, layer)) if several => {
                format!("{layer} of operation {}", u32::from(operation.0) + 1)
            }
            Some((_, layer)) => layer.to_string(),
        };
        let times = [
            spent.cutting,
            spent.turning,
            spent.travel,
            spent.axes + spent.waiting,
            spent.total(),
        ];
        [name, flanks.to_string()]
            .into_iter()
            .chain(times.map(time))
            .collect()
    });
    format!(
        "<div class=\"long\">{}</div>\n",
        table("Time by layer", &columns, rows)
    )
}
