//! How long a program takes, op by op, at its programmed speeds.
//!
//! A move that turns the blade along takes as long as the slower of its two parts, as controllers do it. Acceleration is
//! left out (the job says nothing of it), and so is the way from and to home, which depends on the machine's axes.

use vcutc_backend_api::ir::{Action, Program, Ready};
use vcutc_backend_api::motion::pose_after;
use vcutc_backend_api::stroke::{Pose, Stroke};
use vcutc_backend_api::units::Duration;
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

/// How long each op takes, in the order of the program.
#[must_use]
pub fn op_times(program: &VerifiedProgram) -> Vec<Duration> {
    let program = program.program();
    let mut at = None;
    let time = |action: &Action, at: Option<Pose>| match action {
        Action::AwaitReady => match program.cell.as_ref().map(|cell| cell.ready) {
            Some(Ready::After(time)) => time,
            Some(Ready::Input(_)) | None => Duration::ZERO,
        },
        Action::Dwell { time } => *time,
        action => at
            .and_then(|from| Stroke::of(program, from, action))
            .map_or(Duration::ZERO, |stroke| stroke.duration()),
    };
    let mut times = Vec::with_capacity(program.ops.len());
    for op in &program.ops {
        times.push(time(&op.action, at));
        at = pose_after(at, &op.action);
    }
    times
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
    at: Option<Pose>,
    timing: Timing,
}

impl Clock<'_> {
    fn op(&mut self, action: Action) {
        let stroke = self.at.and_then(|from| Stroke::of(self.program, from, &action));
        let time = stroke.map_or(Duration::ZERO, |stroke| stroke.duration());
        match action {
            // How long the axes take is for the machine to say, not for the tip.
            Action::Home
            | Action::AxisTravel { .. }
            | Action::Ultrasonic { .. }
            | Action::ToolChange { .. } => {}
            Action::Travel { .. } | Action::Approach { .. } | Action::Retract { .. } => {
                self.timing.travel += time;
            }
            Action::Cut { .. } => self.timing.cutting += time,
            Action::Turn { .. } => self.timing.turning += time,
            Action::AwaitReady => {
                if let Some(Ready::After(time)) = self.program.cell.as_ref().map(|cell| cell.ready) {
                    self.timing.waiting += time;
                }
            }
            Action::Dwell { time } => self.timing.waiting += time,
        }
        self.at = pose_after(self.at, &action);
    }
}
