//! What the robot should do, straight from the ops and the motion, to be compared with what the reader makes of the text.

use super::reader::{Event, Matrix, Pose};
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::ir::{Action, AxisValues, Changer, OpId, OrientationId, Ready, Switch};
use vcutc_backend_api::motion::ReachableProgram;

/// What an op should come to.
#[derive(Clone, Debug)]
pub(crate) struct Step {
    /// What the robot does.
    event: Event,
    /// The motion by which a module that begins after the op gets to where the op ends.
    restart: Option<Event>,
}

/// A step for each op. `status` computes `S` from axis values, in another way than the backend.
pub(crate) fn steps(program: &ReachableProgram, status: &dyn Fn(&AxisValues) -> u32) -> Vec<Step> {
    let cell = program.program().cell.as_ref().unwrap();
    let home = || Event::Axes(cell.home.unwrap().0.map(f64::to_degrees));
    let mut at: Option<(Point3, OrientationId)> = None;
    let mut speeds = (f64::NAN, None);
    let mut restart = None;
    let step = |(id, op): (OpId, &vcutc_backend_api::ir::Op)| {
        let from = at;
        if let Some(pose) = target(&op.action, at) {
            at = Some(pose);
            restart = Some(point(program, id, pose, status));
        }
        speeds = speeds_of(program, &op.action, speeds);
        let event = match op.action {
            Action::Home => {
                at = None;
                restart = Some(home());
                home()
            }
            Action::AxisTravel { .. } => restart.clone().unwrap(),
            Action::Travel { .. }
            | Action::Approach { .. }
            | Action::Retract { .. }
            | Action::Cut { .. }
            | Action::Follow { .. }
            | Action::Turn { .. } => {
                let via = op.action.via().and_then(|via| program.program().via(via));
                line(program, from, (at.unwrap(), via), speeds)
            }
            Action::Ultrasonic { state } => Event::Output(cell.ultrasonic.unwrap(), state == Switch::On),
            Action::Spin { state } => {
                let output = cell.spindle.unwrap().output();
                Event::Output(output.unwrap(), state == Switch::On)
            }
            Action::AwaitReady => match cell.ready {
                Ready::Input(input) => Event::Await(input),
                Ready::After(time) => Event::Wait(time.to_s()),
            },
            Action::Dwell { time } => Event::Wait(time.to_s()),
            Action::ChangePlace => {
                at = None;
                restart = None;
                Event::Axes(cell.change.unwrap().at.0.map(f64::to_degrees))
            }
            Action::ToolChange { tool } => Event::Change(match cell.change.unwrap().by {
                Changer::Program => cell.tools.at(tool).place,
                Changer::Hand => None,
            }),
        };
        Step {
            event,
            restart: restart.clone(),
        }
    };
    program.verified().ops().map(step).collect()
}

/// `T` from axis values: a bit for each angle that reads as negative with nine decimals.
pub(crate) fn turn(axes: &AxisValues) -> u32 {
    let is_negative = |angle: f64| {
        let text = format!("{:.9}", angle.to_degrees());
        text.starts_with('-') && text.contains(|c: char| ('1'..='9').contains(&c))
    };
    let bits = axes.0.iter().rev();
    bits.fold(0, |bits, &axis| 2 * bits + u32::from(is_negative(axis)))
}

fn point(
    program: &ReachableProgram,
    op: OpId,
    at: (Point3, OrientationId),
    status: &dyn Fn(&AxisValues) -> u32,
) -> Event {
    let axes = program.axes_after(op).unwrap();
    Event::Point {
        to: pose(program, at),
        status: status(&axes),
        turn: turn(&axes),
    }
}

fn target(action: &Action, at: Option<(Point3, OrientationId)>) -> Option<(Point3, OrientationId)> {
    match *action {
        Action::Travel { to, orientation, .. } | Action::AxisTravel { to, orientation } => {
            Some((to, orientation))
        }
        Action::Approach { to, .. } | Action::Retract { to, .. } | Action::Cut { to, .. } => {
            Some((to, at.unwrap().1))
        }
        Action::Turn { to, .. } => Some((at.unwrap().0, to)),
        Action::Follow { to, orientation, .. } => Some((to, orientation)),
        _ => None,
    }
}

fn speeds_of(
    program: &ReachableProgram,
    action: &Action,
    (feed, rate): (f64, Option<f64>),
) -> (f64, Option<f64>) {
    let tables = program.program();
    let feed_of = |id: vcutc_backend_api::ir::FeedId| tables.feeds[usize::from(id.0)].to_m_per_s();
    let rate_of = |id: vcutc_backend_api::ir::RateId| Some(tables.rates[usize::from(id.0)].to_deg_per_s());
    match *action {
        Action::Travel { feed, rate, .. } | Action::Follow { feed, rate, .. } => {
            (feed_of(feed), rate_of(rate))
        }
        Action::Approach { feed, .. } | Action::Retract { feed, .. } | Action::Cut { feed, .. } => {
            (feed_of(feed), rate)
        }
        Action::Turn { rate, .. } => (feed, rate_of(rate)),
        _ => (feed, rate),
    }
}

fn line(
    program: &ReachableProgram,
    from: Option<(Point3, OrientationId)>,
    (at, via): ((Point3, OrientationId), Option<Point3>),
    (feed, rate): (f64, Option<f64>),
) -> Event {
    let to = pose(program, at);
    let turned = from.filter(|from| from.1 != at.1);
    // On an arc the controller need not limit the turn, so the tip goes as slowly as the turn needs.
    let feed = match (turned, via, rate) {
        (Some(from), Some(via), Some(rate)) => {
            let (_, _, whole) = parts(&pose(program, from).axes, &to.axes);
            let way = arc_length([from.0, via, at.0].map(Point3::to_array));
            // Rounded down, so that it is never too fast.
            feed.min((way * rate / whole.to_degrees() * 1000.0).floor() / 1e6)
        }
        _ => feed,
    };
    let rates = turned.zip(rate).map(|(from, rate)| {
        let (swivel, twist, whole) = parts(&pose(program, from).axes, &to.axes);
        let of = |part: f64| rate * (part / whole).max(0.1);
        (of(swivel), of(twist))
    });
    Event::Line {
        to,
        via: via.map(Point3::to_array),
        feed,
        rates,
        rounded: false,
    }
}

/// The length of the arc from one point through another to a third: the radius of their circle by their triangle's sides and area, and
/// the angles at which the halves are seen from its centre, each below half a turn.
#[allow(clippy::disallowed_methods, reason = "another arc sine than the writer's")]
fn arc_length([a, b, c]: [[f64; 3]; 3]) -> f64 {
    let side = |p: [f64; 3], q: [f64; 3]| (0..3).map(|i| (p[i] - q[i]).powi(2)).sum::<f64>().sqrt();
    let (first, second, whole) = (side(a, b), side(b, c), side(a, c));
    let half = (first + second + whole) / 2.0;
    let area = (half * (half - first) * (half - second) * (half - whole)).sqrt();
    let radius = first * second * whole / (4.0 * area);
    [first, second]
        .iter()
        .map(|chord| 2.0 * radius * (chord / 2.0 / radius).min(1.0).asin())
        .sum()
}

/// How far a turn swivels the tool's x, twists about it, and turns in all: by matrices, in rad. What is left of the turn when x
/// has been brought to where it ends, about the line square to both, is the twist.
#[allow(clippy::disallowed_methods, reason = "another arc tangent than the writer's")]
pub(crate) fn parts(from: &Matrix, to: &Matrix) -> (f64, f64, f64) {
    let column = |m: &Matrix, c: usize| [m[0][c], m[1][c], m[2][c]];
    let (x, x_then) = (column(from, 0), column(to, 0));
    let square = cross(x, x_then);
    let (sine, cosine) = (dot(square, square).sqrt(), dot(x, x_then));
    let y = column(from, 1);
    let y_swivelled = if sine < 1e-12 {
        y
    } else {
        // Rodrigues' formula.
        let n = square.map(|part| part / sine);
        let (along, aside) = (dot(n, y), cross(n, y));
        core::array::from_fn(|i| y[i] * cosine + aside[i] * sine + n[i] * along * (1.0 - cosine))
    };
    let y_then = column(to, 1);
    let off = cross(y_swivelled, y_then);
    let twist = dot(off, off).sqrt().atan2(dot(y_swivelled, y_then));
    let trace: f64 = (0..3).map(|c| dot(column(from, c), column(to, c))).sum();
    let skew = (0..3).map(|c| cross(column(from, c), column(to, c)));
    let skew = skew.fold([0.0; 3], |sum: [f64; 3], part| {
        core::array::from_fn(|i| sum[i] + part[i])
    });
    let whole = dot(skew, skew).sqrt().atan2(trace - 1.0);
    (sine.atan2(cosine), twist, whole)
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

fn pose(program: &ReachableProgram, (tip, held): (Point3, OrientationId)) -> Pose {
    Pose {
        tip: [tip.x, tip.y, tip.z],
        axes: program.verified().orientation(held).matrix(),
    }
}

/// Tolerances: half a unit in the last place of each number.
#[derive(Clone, Copy)]
pub(crate) struct Rounding {
    pub(crate) mm: f64,
    pub(crate) deg: f64,
}

impl Rounding {
    pub(crate) fn of_decimals(decimals: i32) -> Self {
        Self {
            mm: 0.5001 * 10_f64.powi(-decimals),
            deg: 0.5001 * 10_f64.powi(-(decimals + 1).min(6)),
        }
    }
}

/// Whether two events are the same but for rounding; whether a corner is rounded is not compared.
pub(crate) fn same(got: &Event, want: &Event, rounding: Rounding) -> bool {
    let near = |a: f64, b: f64, by: f64| (a - b).abs() <= by;
    match (got, want) {
        (Event::Axes(got), Event::Axes(want)) => {
            got.iter().zip(want).all(|(&a, &b)| near(a, b, rounding.deg))
        }
        (
            Event::Line {
                to: got,
                via,
                feed,
                rates,
                ..
            },
            Event::Line {
                to: want,
                via: wanted_via,
                feed: wanted_feed,
                rates: wanted_rates,
                ..
            },
        ) => {
            let vias_agree = match (via, wanted_via) {
                (Some(got), Some(want)) => got.iter().zip(want).all(|(&a, &b)| near(a, b, rounding.mm)),
                (got, want) => got == want,
            };
            near(*feed, *wanted_feed, 0.5001e-6)
                && vias_agree
                && rates_agree(*rates, *wanted_rates)
                && poses_agree(got, want, rounding)
        }
        (
            Event::Point {
                to: got,
                status,
                turn,
            },
            Event::Point {
                to: want,
                status: wanted_status,
                turn: wanted_turn,
            },
        ) => (status, turn) == (wanted_status, wanted_turn) && poses_agree(got, want, rounding),
        (Event::Wait(got), Event::Wait(want)) => near(*got, *want, 0.5001e-6),
        (got, want) => got == want,
    }
}

/// The reader demands rates of moves that turn the blade. They are rounded down to four decimals.
fn rates_agree(got: Option<(f64, f64)>, want: Option<(f64, f64)>) -> bool {
    let below = |got: f64, want: f64| (-1e-6..=1.0001e-4).contains(&(want - got));
    let pair = got.zip(want);
    pair.is_none_or(|(got, want)| below(got.0, want.0) && below(got.1, want.1))
}

pub(crate) fn poses_agree(got: &Pose, want: &Pose, rounding: Rounding) -> bool {
    // Three angles, each off by half a unit, turn an axis by at most their sum.
    let turn = 3.0 * rounding.deg.to_radians();
    let tips = got
        .tip
        .iter()
        .zip(want.tip)
        .all(|(a, b)| (a - b).abs() <= rounding.mm);
    tips && entries(&got.axes)
        .zip(entries(&want.axes))
        .all(|(a, b)| (a - b).abs() <= turn)
}

fn entries(matrix: &Matrix) -> impl Iterator<Item = f64> {
    matrix.iter().flatten().copied()
}

/// Compares what a bundle's main program did with what the ops say, op by op. At the start of every part but the first
/// the state that the part before ended in must come again: its last pose, and generator and spindle as they were.
pub(crate) fn compare(got: &[Event], want: &[Step], rounding: Rounding) -> Result<(), String> {
    let mut got = got.iter().peekable();
    let mut history = History::default();
    for step in want {
        let wanted = &step.event;
        while let Some(Event::Module(_) | Event::Tool(_) | Event::Base(_)) = got.peek() {
            let Some(Event::Module(name)) = got.next() else {
                continue;
            };
            if name.contains("_p") && !name.ends_with("_p001") {
                history.expect_again(&mut got, rounding)?;
            }
        }
        match got.next() {
            Some(event) if same(event, wanted, rounding) || history.is_same_turn(event, wanted, rounding) => {
                history.note(step);
            }
            other => return Err(format!("{other:?} instead of {wanted:?}")),
        }
    }
    match got.next() {
        None => Ok(()),
        Some(event) => only_setup(event)
            .then_some(())
            .ok_or(format!("{event:?} too much")),
    }
}

fn only_setup(event: &Event) -> bool {
    matches!(event, Event::Module(_) | Event::Tool(_) | Event::Base(_))
}

#[derive(Default)]
struct History {
    /// The motion to where the last op ended.
    restart: Option<Event>,
    /// The outputs that are on, in the order in which they were switched on, and what was waited for since.
    drives: Vec<Event>,
    awaited: Option<Event>,
}

impl History {
    fn note(&mut self, step: &Step) {
        self.restart.clone_from(&step.restart);
        let event = &step.event;
        match event {
            Event::Output(_, true) => self.drives.push(event.clone()),
            Event::Output(number, false) => {
                self.drives
                    .retain(|on| !matches!(on, Event::Output(other, _) if other == number));
                if self.drives.is_empty() {
                    self.awaited = None;
                }
            }
            // The samples dwell only while all of them are off.
            Event::Await(_) | Event::Wait(_) if !self.drives.is_empty() => self.awaited = Some(event.clone()),
            _ => {}
        }
    }

    /// A turn about the still tip runs at its rate; the feed that happens to be set is of no account.
    fn is_same_turn(&self, got: &Event, want: &Event, rounding: Rounding) -> bool {
        let (
            Some(Event::Point { to: from, .. }),
            Event::Line { to: got, rates, .. },
            Event::Line {
                to: want,
                rates: wanted,
                ..
            },
        ) = (&self.restart, got, want)
        else {
            return false;
        };
        from.tip == want.tip && rates_agree(*rates, *wanted) && poses_agree(got, want, rounding)
    }

    fn expect_again<'e>(
        &self,
        got: &mut std::iter::Peekable<impl Iterator<Item = &'e Event>>,
        rounding: Rounding,
    ) -> Result<(), String> {
        while got
            .next_if(|event| matches!(event, Event::Tool(_) | Event::Base(_)))
            .is_some()
        {}
        for wanted in self.restart.iter().chain(&self.drives).chain(&self.awaited) {
            let event = got.next().ok_or("a part without a start")?;
            if !same(event, wanted, rounding) {
                return Err(format!("a part starts with {event:?} instead of {wanted:?}"));
            }
        }
        Ok(())
    }
}
