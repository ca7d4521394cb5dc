//! The figures of an air cut for people: what was proven of it, and what was not.

use super::{IN_HAND, row, time, times};
use crate::air_cut::{TIP_SPEED, TURNING_RATE};
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::number::show;
use vcutc_motion::figures::ReachFigures;
use vcutc_motion::pace::Basis;
use vcutc_motion::summary as reach_summary;
use vcutc_simulation::report::Report;

/// An air cut.
#[derive(Clone, Debug, PartialEq)]
pub struct AirFigures {
    /// The program's name.
    pub name: String,
    /// By how much it is lifted.
    pub lift: Length,
    /// How far its lowest tip is above the stock; none where it moves no tip.
    pub gap: Option<Length>,
    /// Whether it can be proven that a machine carries it out.
    pub machine: Mover,
}

/// What moves the blade.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mover {
    /// Nothing: the job has no machine.
    None,
    /// A machine that stands as it does in the program that cuts.
    StandsAlike,
    /// A machine that stands in another way.
    StandsOtherwise,
}

/// The lines of the summary.
#[must_use]
pub fn summary(air: &AirFigures, report: &Report, basis: Basis, reach: Option<&ReachFigures>) -> Vec<String> {
    let mut lines = vec![
        format!(
            "{}: AIR CUT, lifted by {} mm, generator off; {} cuts through the air in {}",
            air.name,
            show(air.lift.to_mm()),
            report.cuts(),
            time(report.times.all.total()),
        ),
        row("heights", &proven(air, reach)),
        row(
            "not proven",
            "chips, contour and scallop, because nothing is cut: compile without --air-cut for those",
        ),
        row(
            "speeds",
            &format!(
                "at most {} mm/s and {} deg/s, or the job's if lower; axis moves as the target sets them",
                show(TIP_SPEED.to_mm_per_s()),
                show(TURNING_RATE.to_deg_per_s())
            ),
        ),
    ];
    match air.machine {
        Mover::None | Mover::StandsAlike => {}
        Mover::StandsOtherwise => lines.push(row(
            "posture",
            "NOT the program's: at that height another configuration has a larger margin, so cables and limits differ from the real run",
        )),
    }
    lines.push(row("time", &times::in_all(&report.times.all)));
    lines.push(row("basis", &times::basis(basis)));
    if reach.is_some() {
        lines.push(row("in hand", IN_HAND));
    }
    let reach = reach.into_iter().flat_map(reach_summary::lines);
    lines.extend(reach.map(|(name, text)| row(name, &text)));
    lines
}

fn proven(air: &AirFigures, reach: Option<&ReachFigures>) -> String {
    let gap = match air.gap {
        Some(gap) => format!(
            "every tip stays at least {} mm above the stock",
            show(gap.to_mm())
        ),
        None => "no tip moves".to_owned(),
    };
    let Some(reach) = reach else {
        return format!("{gap}; reach is not proven, because the job has no machine");
    };
    let rates = if reach.axes.iter().all(|axis| axis.rate_limit.is_some()) {
        "position and speed limits"
    } else {
        "limits"
    };
    format!("{gap}; every motion is within the {rates} of the axes")
}
