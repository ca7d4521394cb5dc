//! Where the time of a program goes, for people and for programs: the [`TimeFigures`], their lines and their table.

use super::time;
use serde::Serialize;
use vcutc_motion::pace::{Basis, Kept};
use vcutc_simulation::report::Report;
use vcutc_simulation::timing::{LayerTime, Timing};

/// Where the time of a program goes.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TimeFigures {
    /// `speeds`, `accelerations` or `jerks`: what of the machine the times keep.
    pub basis: &'static str,
    /// The same in words, with the moves that have no time.
    #[serde(skip)]
    pub basis_words: String,
    /// How many axis moves have no time, because it is not known.
    pub untimed: usize,
    /// How many motions have their programmed time, because the axes could not be followed along them.
    #[serde(skip_serializing_if = "is_none")]
    pub unfollowed: usize,
    /// Of the whole program.
    #[serde(flatten)]
    pub all: KindFigures,
    pub layers: Vec<LayerFigure>,
}

const fn is_none(count: &usize) -> bool {
    *count == 0
}

/// Time by what it is spent on, in s.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct KindFigures {
    pub total_s: f64,
    /// Through the work.
    pub cutting_s: f64,
    /// Turning about the still tip.
    pub turning_s: f64,
    /// Through the air.
    pub travel_s: f64,
    /// Axis moves.
    pub axes_s: f64,
    pub waiting_s: f64,
    /// Changes of blade; left out where there are none.
    #[serde(skip_serializing_if = "is_no_time")]
    pub changes_s: f64,
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde asks for a reference")]
fn is_no_time(seconds: &f64) -> bool {
    *seconds <= 0.0
}

/// The time of a layer.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct LayerFigure {
    /// The operation, from 0.
    pub operation: u16,
    /// The layer, from 1.
    pub layer: u32,
    #[serde(flatten)]
    pub time: KindFigures,
}

/// The figures of a report.
#[must_use]
pub fn figures(report: &Report, basis: Basis) -> TimeFigures {
    let layer = |layer: &LayerTime| LayerFigure {
        operation: layer.operation.0,
        layer: layer.layer,
        time: kinds(&layer.timing),
    };
    TimeFigures {
        basis: match basis.kept {
            Kept::Speeds => "speeds",
            Kept::Accelerations => "accelerations",
            Kept::Jerks => "jerks",
        },
        basis_words: self::basis(basis),
        untimed: basis.untimed,
        unfollowed: basis.unfollowed,
        all: kinds(&report.times.all),
        layers: report.times.layers.iter().map(layer).collect(),
    }
}

fn kinds(timing: &Timing) -> KindFigures {
    KindFigures {
        total_s: thousandths(timing.total().to_s()),
        cutting_s: thousandths(timing.cutting.to_s()),
        turning_s: thousandths(timing.turning.to_s()),
        travel_s: thousandths(timing.travel.to_s()),
        axes_s: thousandths(timing.axes.to_s()),
        waiting_s: thousandths(timing.waiting.to_s()),
        changes_s: thousandths(timing.changes.to_s()),
    }
}

/// To a millisecond: what is less is noise of the arithmetic.
fn thousandths(value: f64) -> f64 {
    (value * 1e3).round() / 1e3
}

/// The whole time and what it is made of.
pub(super) fn in_all(timing: &Timing) -> String {
    let mut kinds = vec![
        ("cutting", timing.cutting),
        ("turning", timing.turning),
        ("travel", timing.travel),
        ("waiting", timing.waiting),
    ];
    if timing.axes.to_s() > 0.0 {
        kinds.push(("axis moves", timing.axes));
    }
    if timing.changes.to_s() > 0.0 {
        kinds.push(("changes of blade", timing.changes));
    }
    let kinds: Vec<String> = kinds
        .iter()
        .map(|(name, spent)| format!("{name} {}", time(*spent)))
        .collect();
    format!("{} = {}", time(timing.total()), kinds.join(" + "))
}

/// What the times are based on.
pub(super) fn basis(basis: Basis) -> String {
    let kept = match basis.kept {
        Kept::Speeds => "programmed speeds; starting and stopping take no time",
        Kept::Accelerations => "accelerations of the machine, from stop to stop",
        Kept::Jerks => "accelerations and jerks of the machine, from stop to stop",
    };
    let mut words = kept.to_owned();
    match basis.untimed {
        0 => {}
        1 => words += "; 1 axis move not counted",
        more => words += &format!("; {more} axis moves not counted"),
    }
    match basis.unfollowed {
        0 => {}
        1 => words += "; 1 motion at programmed speed, because the axes cannot be followed",
        more => {
            words += &format!("; {more} motions at programmed speed, because the axes cannot be followed")
        }
    }
    words
}

/// A line for each layer.
#[must_use]
pub fn table(figures: &TimeFigures) -> Vec<String> {
    let head = format!(
        "{:<10} {:>10} {:>10} {:>10} {:>10} {:>10} {:>10}",
        "layer, s", "all", "cutting", "turning", "travel", "all axes", "waiting"
    );
    let line = |layer: &LayerFigure| {
        let t = &layer.time;
        let name = format!("{}.{}", u32::from(layer.operation) + 1, layer.layer);
        format!(
            "{name:<10} {:>10.1} {:>10.1} {:>10.1} {:>10.1} {:>10.1} {:>10.1}",
            t.total_s, t.cutting_s, t.turning_s, t.travel_s, t.axes_s, t.waiting_s
        )
    };
    core::iter::once(head)
        .chain(figures.layers.iter().map(line))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_timed_as_the_rest_is_reported() {
        let basis = |untimed, unfollowed| {
            self::basis(Basis {
                kept: Kept::Jerks,
                untimed,
                unfollowed,
            })
        };
        let kept = "accelerations and jerks of the machine, from stop to stop";
        assert_eq!(basis(0, 0), kept);
        assert_eq!(
            basis(2, 1),
            format!(
                "{kept}; 2 axis moves not counted; 1 motion at programmed speed, because the axes cannot be followed"
            )
        );
    }
}
