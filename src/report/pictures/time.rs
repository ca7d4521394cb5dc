//! What the time is spent on.

use crate::picture::{Prefix, times};
use crate::report::Material;
use crate::summary;
use std::collections::BTreeMap;
use vcutc_backend_api::ir::{Action, Site};
use vcutc_backend_api::units::Duration;

/// Kinds of motion, in the order in which pictures show them.
pub(super) const KINDS: [&str; 5] = ["cutting", "turning", "travel", "waiting", "all axes"];

/// Which of the kinds an action is; none for those that take no time.
pub(super) const fn kind(action: &Action) -> Option<usize> {
    match action {
        Action::Cut { .. } => Some(0),
        Action::Turn { .. } => Some(1),
        Action::Travel { .. } | Action::Approach { .. } | Action::Retract { .. } => Some(2),
        Action::AwaitReady | Action::Dwell { .. } => Some(3),
        Action::Home | Action::AxisTravel { .. } => Some(4),
        Action::Ultrasonic { .. } | Action::ToolChange { .. } => None,
    }
}

/// What the time is spent on, by kind of motion and by layer (`picture::times`).
#[must_use]
pub fn time(material: &Material<'_>, ids: Prefix) -> String {
    let program = material.compiled.program.verified().program();
    let mut by_kind = [0.0; KINDS.len()];
    let mut by_layer: BTreeMap<Place, [f64; KINDS.len()]> = BTreeMap::new();
    for (op, time) in program.ops.iter().zip(&material.compiled.op_times) {
        if let Some(kind) = kind(&op.action) {
            let layer = by_layer.entry(Place::of(op.site)).or_default();
            for sums in [&mut by_kind, layer] {
                if let Some(sum) = sums.get_mut(kind) {
                    *sum += time.to_s();
                }
            }
        }
    }
    let several = program.operations.len() > 1;
    let rows: Vec<times::Row> = by_layer
        .iter()
        .filter(|(_, seconds)| seconds.iter().sum::<f64>() > 0.0)
        .map(|(place, seconds)| times::Row {
            name: place.name(several),
            seconds: seconds.to_vec(),
        })
        .collect();
    let kinds: Vec<times::Kind> = KINDS
        .into_iter()
        .zip(by_kind)
        .map(|(name, seconds)| times::Kind {
            name,
            seconds,
            words: summary::time(Duration::s(seconds)),
        })
        .collect();
    let total = summary::time(Duration::s(by_kind.iter().sum()));
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

/// What of the job time is spent on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Place {
    /// A layer of an operation.
    Layer(u16, u32),
    /// What belongs to no layer: the start and the end.
    Else,
}

impl Place {
    const fn of(site: Site) -> Self {
        match site {
            Site::Program | Site::Operation(_) => Self::Else,
            Site::Layer { operation, layer } | Site::Cut { operation, layer, .. } => {
                Self::Layer(operation.0, layer.get())
            }
        }
    }

    fn name(self, several: bool) -> String {
        match self {
            Self::Layer(operation, layer) if several => format!("{}.{layer}", u32::from(operation) + 1),
            Self::Layer(_, layer) => layer.to_string(),
            Self::Else => "else".to_owned(),
        }
    }
}
