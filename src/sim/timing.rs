//! How long a program takes, op by op, at its programmed speeds.
//!
//! A move that turns the blade along takes as long as the slower of its two parts, as controllers do it. Acceleration is
//! left out (the job says nothing of it), and so is the way from and to home, which depends on the machine's axes.

use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::ir::{Action, FeedId, OrientationId, Program, RateId, Ready};
use vcutc_backend_api::units::{Angle, Duration};
use vcutc_backend_api::verify::VerifiedProgram;

/// Time by what it is spent on.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Timing {
    /// Through the work.
    pub cutting: Duration,
    /// Turning about the still tip.
    pub turning: Duration,
    /// Through the air.
    pub travel: Duration,
    /// Waiting.
    pub waiting: Duration,
}

impl Timing {
    /// All of it.
    #[must_use]
    pub fn total(&self) -> Duration {
        self.cutting + self.turning + self.travel + self.waiting
    }
}

/// Adds up a program's times.
#[must_use]
pub fn timing(program: &VerifiedProgram) -> Timing {
    let mut clock = Clock {
        program: program.program(),
        at: None,
        timing: Timing::default(),
    };
    for op in &program.program().ops {
        clock.op(op.action);
    }
    clock.timing
}

struct Clock<'p> {
    program: &'p Program,
    at: Option<(Point3, OrientationId)>,
    timing: Timing,
}

impl Clock<'_> {
    fn op(&mut self, action: Action) {
        match action {
            Action::Home => self.at = None,
            // How long the axes take is for the machine to say, not for the tip.
            Action::AxisTravel { to, orientation } => self.at = Some((to, orientation)),
            Action::Travel {
                to,
                orientation,
                feed,
                rate,
            } => {
                if let Some((from, held)) = self.at {
                    let moving = self.line(from, to, feed);
                    self.timing.travel += moving.max(self.turn(held, orientation, rate));
                }
                self.at = Some((to, orientation));
            }
            Action::Approach { to, feed } | Action::Retract { to, feed } => {
                let time = self.straight(to, feed);
                self.timing.travel += time;
            }
            Action::Cut { to, feed, .. } => {
                let time = self.straight(to, feed);
                self.timing.cutting += time;
            }
            Action::Turn { to, rate } => {
                if let Some((tip, held)) = self.at {
                    self.timing.turning += self.turn(held, to, rate);
                    self.at = Some((tip, to));
                }
            }
            Action::AwaitReady => {
                if let Some(Ready::After(time)) = self.program.cell.as_ref().map(|cell| cell.ready) {
                    self.timing.waiting += time;
                }
            }
            Action::Dwell { time } => self.timing.waiting += time,
            Action::Ultrasonic { .. } | Action::ToolChange { .. } => {}
        }
    }

    fn straight(&mut self, to: Point3, feed: FeedId) -> Duration {
        let Some((from, held)) = self.at else {
            return Duration::ZERO;
        };
        self.at = Some((to, held));
        self.line(from, to, feed)
    }

    fn line(&self, from: Point3, to: Point3, feed: FeedId) -> Duration {
        let feed = self.program.feeds.get(usize::from(feed.0));
        feed.map_or(Duration::ZERO, |&feed| from.distance(to) / feed)
    }

    fn turn(&self, from: OrientationId, to: OrientationId, rate: RateId) -> Duration {
        if from == to {
            return Duration::ZERO;
        }
        let orientation = |id: OrientationId| self.program.orientations.get(id.0 as usize);
        let angle = match (orientation(from), orientation(to)) {
            (Some(from), Some(&to)) => from.angle_to(to),
            (Some(_) | None, _) => Angle::ZERO,
        };
        let rate = self.program.rates.get(usize::from(rate.0));
        rate.map_or(Duration::ZERO, |&rate| angle / rate)
    }
}
