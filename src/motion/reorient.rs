//! Turns of five-axis machines at the rate that the job asks for.
//!
//! The rate of an op is that of the shortest turn between its postures. Rotary axes that go each at a constant rate turn the blade
//! on a longer way ([`super::path::five_axis`]), so in the time of the shortest turn it is turned faster than the job allows: a few
//! per cent on a head that swings and rakes, by half on one whose C axis carries the blade round a cone. Here such ops get the rate
//! with which the blade never turns faster than it should ([`vcutc_machine::kinematics::five_axis::FiveAxis::fastest_turn`]).

use vcutc_backend_api::ir::{Action, Program, RateId};
use vcutc_backend_api::motion::Motion;
use vcutc_backend_api::segments::{LimitedBy, Segment};
use vcutc_backend_api::units::AngularSpeed;
use vcutc_machine::kinematics::Mechanism;

/// Rates are rounded down to so many parts of a degree a second, so that equal turns have equal rates.
const UNITS: f64 = 10_000.0;
/// Turns that are longer than the shortest one by no more than this part are as long.
const SAME: f64 = 1e-6;

/// A program whose blade never turns faster than the rates of this one say, carried out by a five-axis machine as in the motion.
/// None where it does not anyway.
#[must_use]
pub fn slowed(program: &Program, motion: &Motion, mechanism: &Mechanism) -> Option<Program> {
    let machine = match mechanism {
        Mechanism::FiveAxis(machine) => machine,
        Mechanism::OrthoParallel(_) | Mechanism::Mounted(_) | Mechanism::Serial(_) => return None,
    };
    let mut slowed = program.clone();
    let mut is_slower = false;
    for segment in program.segments() {
        let index = segment.id.0 as usize;
        let before = index.checked_sub(1).and_then(|before| motion.ends.get(before));
        let (Some(start), Some(end)) = (before, motion.ends.get(index)) else {
            continue;
        };
        let Some((asked, share)) = asked(&segment, machine.fastest_turn(&start.0, &end.0)) else {
            continue;
        };
        let Some(rate) = known_or_new(&mut slowed.rates, rounded_down(asked, share)) else {
            continue;
        };
        let action = slowed.ops.get_mut(index).map(|op| &mut op.action);
        if let Some(Action::Travel { rate: known, .. } | Action::Turn { rate: known, .. }) = action {
            *known = rate;
            is_slower = true;
        }
    }
    is_slower.then_some(slowed)
}

/// The rate that an op asks for, and the part of it at which its blade turns no faster than that; none of ops that do not turn
/// faster.
fn asked(segment: &Segment<'_>, fastest: f64) -> Option<(AngularSpeed, f64)> {
    let line = segment.line()?;
    let asked = line.rate?;
    let shortest = line.turn.to_rad();
    if shortest <= 0.0 {
        // Both postures are one; no rate of turning paces the op.
        return None;
    }
    // A travel whose tip takes longer may turn slowly enough as it is.
    let turns_at = match line.limited_by()? {
        LimitedBy::Feed(_) => fastest / line.duration().to_s(),
        LimitedBy::Rate(_) => fastest / shortest * asked.to_rad_per_s(),
    };
    let is_faster = turns_at > asked.to_rad_per_s() * (1.0 + SAME);
    is_faster.then_some((asked, shortest / fastest))
}

fn rounded_down(rate: AngularSpeed, share: f64) -> AngularSpeed {
    let units = (rate.to_deg_per_s() * share * UNITS).floor();
    // No job asks for less than a ten-thousandth of a degree a second.
    AngularSpeed::deg_per_s(if units > 0.0 {
        units / UNITS
    } else {
        rate.to_deg_per_s() * share
    })
}

/// The number of a rate, which is added to the table where it is not there yet. None where the table is full.
pub(super) fn known_or_new(rates: &mut Vec<AngularSpeed>, rate: AngularSpeed) -> Option<RateId> {
    let place = rates
        .iter()
        .position(|known| *known == rate)
        .unwrap_or(rates.len());
    let id = RateId(u16::try_from(place).ok()?);
    if place == rates.len() {
        rates.push(rate);
    }
    Some(id)
}
