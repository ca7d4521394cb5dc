//! The air cut: a program lifted above its stock, for the first run of a job on its machine.
//!
//! It is a program of its own, made from the one that cuts: the same ops in the same order, every tip higher by one height, no
//! faster than [`TIP_SPEED`] and [`TURNING_RATE`], and the generator off. Where the program that cuts switches the generator on,
//! this one switches it off, so that it is off even if it was left running; waits for the generator are left out. That
//! the blade stays above the stock is then a rule of the program's form (`Rule::AirCut`), and that the machine carries it out is
//! proven again, as for any other program. Nothing is cut, so nothing is said of chips and contour.

use vcutc_backend_api::ir::{AIR_ENDING, Action, FeedId, Op, Program, Purpose, RateId, Switch};
use vcutc_backend_api::units::{AngularSpeed, Length, Speed};
use vcutc_backend_api::verify::hang;

/// The tip moves no faster. Below the 250 mm/s of manual reduced speed (ISO 10218-1), and slow enough for a hand on the
/// stop button: 0.3 s of reaction are 30 mm.
pub const TIP_SPEED: Speed = Speed::mm_per_s(100.0);

/// The blade turns no faster: the flange of a blade of 300 mm then moves at 157 mm/s.
pub const TURNING_RATE: AngularSpeed = AngularSpeed::deg_per_s(30.0);

/// Heights are offered in whole mm.
const WHOLE: f64 = 1.0;

/// A program as an air cut.
#[must_use]
pub fn lifted(program: &Program, lift: Length) -> Program {
    let mut air = Program {
        name: format!("{}{AIR_ENDING}", program.name),
        purpose: Purpose::AirCut { lift },
        head: None,
        feeds: Vec::new(),
        rates: Vec::new(),
        ops: Vec::new(),
        ..program.clone()
    };
    for via in &mut air.vias {
        via.z += lift.to_mm();
    }
    let feeds = capped(&program.feeds, TIP_SPEED, Speed::min, &mut air.feeds);
    let rates = capped(&program.rates, TURNING_RATE, AngularSpeed::min, &mut air.rates);
    let feed = |id: FeedId| FeedId(number_of(&feeds, usize::from(id.0)));
    let rate = |id: RateId| RateId(number_of(&rates, usize::from(id.0)));
    let up = |action: Action| raised(action, lift, &feed, &rate);
    let ops = program.ops.iter();
    air.ops = ops
        .filter_map(|op| {
            Some(Op {
                action: up(op.action)?,
                ..*op
            })
        })
        .collect();
    air
}

/// The least height at which an air cut of a program stays above the stock by its `clearance` and by half the thickness of its
/// blade, in whole mm.
#[must_use]
pub fn least_lift(program: &Program, clearance: Length) -> Length {
    let Some(lowest) = lowest_tip(program) else {
        return Length::mm(WHOLE);
    };
    let above = clearance.max(hang(program));
    let lift = program.stock.height.to_mm() + above.to_mm() - lowest;
    // A millionth less than a whole number is that number: tips are on a grid, and their sums are rounded.
    Length::mm((lift - 1e-6).ceil().max(WHOLE))
}

/// How far the lowest tip of an air cut is above the stock.
#[must_use]
pub fn least_gap(program: &Program) -> Option<Length> {
    Some(Length::mm(lowest_tip(program)?) - program.stock.height)
}

/// The height of the lowest tip, in mm.
fn lowest_tip(program: &Program) -> Option<f64> {
    let heights = program.segments().filter_map(|segment| {
        let end = segment.end()?.tip.z;
        let arc = segment.line().and_then(|line| line.arc());
        Some(arc.map_or(end, |arc| end.min(arc.room()[0][2])))
    });
    heights.reduce(f64::min)
}

/// An action in the air; none for a wait that has nothing to wait for.
fn raised(
    action: Action,
    lift: Length,
    feed_of: &impl Fn(FeedId) -> FeedId,
    rate_of: &impl Fn(RateId) -> RateId,
) -> Option<Action> {
    let mut action = action;
    match &mut action {
        Action::Travel { to, feed, rate, .. } => {
            to.z += lift.to_mm();
            (*feed, *rate) = (feed_of(*feed), rate_of(*rate));
        }
        Action::AxisTravel { to, .. } => to.z += lift.to_mm(),
        Action::Approach { to, feed } | Action::Retract { to, feed } | Action::Cut { to, feed, .. } => {
            to.z += lift.to_mm();
            *feed = feed_of(*feed);
        }
        Action::Follow { to, feed, rate, .. } => {
            to.z += lift.to_mm();
            (*feed, *rate) = (feed_of(*feed), rate_of(*rate));
        }
        Action::Turn { rate, .. } => *rate = rate_of(*rate),
        Action::Ultrasonic { state } | Action::Spin { state } => *state = Switch::Off,
        Action::AwaitReady => return None,
        Action::Home | Action::ChangePlace | Action::Dwell { .. } | Action::ToolChange { .. } => {}
    }
    Some(action)
}

/// The entries of a table, none above the cap and none twice, and for each of the old ones its place among the new.
fn capped<T: Copy + PartialEq>(
    table: &[T],
    cap: T,
    least: impl Fn(T, T) -> T,
    into: &mut Vec<T>,
) -> Vec<usize> {
    let places = table.iter().map(|&entry| {
        let entry = least(entry, cap);
        into.iter().position(|known| *known == entry).unwrap_or_else(|| {
            into.push(entry);
            into.len() - 1
        })
    });
    places.collect()
}

/// A program that is not from this compiler may refer to entries that do not exist, and still does
/// afterwards.
fn number_of(places: &[usize], id: usize) -> u16 {
    let place = places.get(id).copied().unwrap_or(usize::MAX);
    u16::try_from(place).unwrap_or(u16::MAX)
}
