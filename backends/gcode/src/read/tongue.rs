//! How each dialect says what all of them mean.
//!
//! A [`Tongue`] turns one statement into an [`Order`]. What the words of ISO 6983 have in common is in [`standard_g`]; a dialect
//! says only what is its own.

mod fanuc;
mod heidenhain;
mod linuxcnc;
mod sinumerik;

use super::lines::Style;
use super::order::{Context, Habit, Mode, Motion, Order, Parsed, Routine, Trouble};
use super::words::Number;
use crate::dialect::{Controller, FeedMode};
use vcutc_backend_api::readback::End;
use vcutc_backend_api::units::Duration;

/// A way of reading G-code.
pub(super) trait Tongue: Sync {
    /// What comments and block numbers look like.
    fn style(&self) -> Style;

    /// Habits that have to be said before the tip moves, each with the words that say it.
    fn habits(&self) -> &'static [(Habit, &'static str)];

    /// What holds without being said.
    fn unsaid(&self) -> &'static [Mode];

    /// Whether the work offset, or the operator's choice of it, is a matter of the program.
    fn work_offset(&self) -> WorkOffset;

    /// The tool that must be named for moves of all axes; none where it does not matter.
    fn tool_of_axis_moves(&self) -> Option<u32> {
        None
    }

    /// The words behind which all is stopped at a standstill, for messages.
    fn exact(&self) -> &'static str;

    /// Which files begin with their name.
    fn heads(&self) -> Heads;

    /// What ends the program and a part, for messages.
    fn endings(&self) -> [&'static str; 2];

    /// The name under which a file is called.
    fn routine<'t>(&self, file: &'t str, text: &'t str) -> Option<Routine<'t>>;

    /// What can be called by a name for which there is no part, for messages.
    fn callable(&self, _: Routine<'_>) -> String {
        "the name of a part, called once".to_owned()
    }

    /// What a statement orders.
    fn order<'t>(&self, code: &'t str, context: Context<'_>) -> Parsed<Order<'t>>;
}

/// Who says the work offset.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum WorkOffset {
    /// The program.
    Said,
    /// The program where the job gives a number, or else the operator.
    Preset,
}

/// Which files begin with their name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Heads {
    None,
    OfParts,
    All,
}

/// How programs for a controller are read.
pub(super) const fn of(controller: Controller) -> &'static dyn Tongue {
    match controller {
        Controller::LinuxCnc => &linuxcnc::LinuxCnc,
        Controller::Fanuc => &fanuc::Fanuc,
        Controller::Sinumerik => &sinumerik::Sinumerik,
        Controller::Heidenhain => &heidenhain::Heidenhain,
    }
}

/// The G codes that mean the same in all dialects that have them, in tenths. False for others.
fn standard_g(code: u32, order: &mut Order<'_>) -> Parsed<bool> {
    match code {
        0 => order.moves(Motion::Rapid)?,
        10 => order.moves(Motion::AtFeed)?,
        // A plane is for arcs, `G40` ends a correction for the tool's radius.
        170 | 400 => {}
        900 => order.set(Mode::Habit(Habit::Absolute))?,
        910 => order.set(Mode::Not(Habit::Absolute))?,
        930 => order.set(Mode::Feed(Some(FeedMode::InverseTime)))?,
        940 => order.set(Mode::Feed(Some(FeedMode::Tip)))?,
        950 => order.set(Mode::Feed(None))?,
        _ => return Ok(false),
    }
    Ok(true)
}

/// The G codes that LinuxCNC and Fanuc share besides, in tenths. False for others.
fn american_g(code: u32, order: &mut Order<'_>) -> Parsed<bool> {
    match code {
        // The end of a cycle for holes.
        800 => {}
        200 => order.set(Mode::Not(Habit::Millimetres))?,
        210 => order.set(Mode::Habit(Habit::Millimetres))?,
        _ => return standard_g(code, order),
    }
    Ok(true)
}

/// Rounding as far as the job says, or else a way to stop that is not its.
fn rounding(distance: Option<Number>, context: Context<'_>) -> Mode {
    let is_that_of_the_job = match (distance, context.settings.common.approximation) {
        (Some(is), Some(should)) => (is.value - should.to_mm()).abs() < 0.6e-6,
        (Some(_), None) | (None, _) => false,
    };
    Mode::Stop(is_that_of_the_job.then_some(End::Rounded))
}

/// A wait of some seconds.
fn seconds(number: Number) -> Parsed<Duration> {
    if number.value >= 0.0 {
        Ok(Duration::s(number.value))
    } else {
        Err(Trouble::Expected("a time that is not negative".to_owned()))
    }
}

/// The name of a file without its extension.
fn stem(file: &str) -> &str {
    file.rfind('.').and_then(|at| file.get(..at)).unwrap_or(file)
}
