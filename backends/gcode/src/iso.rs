//! Codes that mean the same on all controllers that have them (ISO 6983).

use crate::statement::{
    Convention, Coordinates, FeedMode, Mode, Motion, Number, Order, Parsed, Plane, Scope, Sense, expected,
};
use vcutc_backend_api::readback::End;
use vcutc_backend_api::units::{Duration, Length};

/// What M codes do on all controls, as the rest of a sentence.
pub(crate) const fn m_code(code: u32) -> Option<&'static str> {
    match code {
        0 | 1 => Some("stops the program"),
        2 | 30 => Some("ends the program"),
        6 => Some("changes the tool"),
        19 => Some("turns the spindle"),
        98 => Some("calls a program"),
        99 => Some("ends a part"),
        _ => None,
    }
}

/// The G codes that mean the same in all dialects that have them, in tenths. False for others.
pub(crate) fn g_code(code: u32, order: &mut Order<'_>) -> Parsed<bool> {
    match code {
        0 => order.moves(Motion::Rapid)?,
        10 => order.moves(Motion::AtFeed)?,
        20 => order.moves(Motion::Round(Sense::Clockwise))?,
        30 => order.moves(Motion::Round(Sense::Counterclockwise))?,
        170 => order.set(Mode::Plane(Plane::Xy))?,
        180 => order.set(Mode::Plane(Plane::Zx))?,
        190 => order.set(Mode::Plane(Plane::Yz))?,
        // The end of a correction for the tool's radius.
        400 => {}
        900 => order.set(Mode::Convention(Convention::Absolute))?,
        910 => order.set(Mode::Not(Convention::Absolute))?,
        930 => order.set(Mode::Feed(Some(FeedMode::InverseTime)))?,
        940 => order.set(Mode::Feed(Some(FeedMode::Tip)))?,
        950 => order.set(Mode::Feed(None))?,
        _ => return Ok(false),
    }
    Ok(true)
}

/// Further G codes that LinuxCNC and Fanuc share, in tenths. False for others.
pub(crate) fn american_g_code(code: u32, order: &mut Order<'_>) -> Parsed<bool> {
    match code {
        // The end of a cycle for holes.
        800 => {}
        200 => order.set(Mode::Not(Convention::Millimetres))?,
        210 => order.set(Mode::Convention(Convention::Millimetres))?,
        530 => order.coordinates = Coordinates::Machine,
        540 | 550 | 560 | 570 | 580 | 590 => order.set(Mode::Work(code / 10 - 53))?,
        _ => return g_code(code, order),
    }
    Ok(true)
}

/// Rounding as far as the job says of corners in the air, or else what a chain continues with. A distance of 0
/// means none.
pub(crate) fn rounding(distance: Option<Number>, scope: Scope<'_>) -> Mode {
    let end = distance.filter(|distance| distance.value > 0.0).map(|distance| {
        let of_job = scope.approximation;
        match of_job.is_some_and(|should| (distance.value - should.to_mm()).abs() < 0.6e-6) {
            true => End::Rounded,
            false => End::Through {
                within: Length::mm(distance.value),
            },
        }
    });
    Mode::Stop(end)
}

/// A wait of some seconds.
pub(crate) fn seconds(number: Number) -> Parsed<Duration> {
    if number.value >= 0.0 {
        Ok(Duration::s(number.value))
    } else {
        expected("a time that is not negative")
    }
}
