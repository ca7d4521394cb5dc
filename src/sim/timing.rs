//! How long a program takes, op by op, at its programmed speeds; and where that time goes.
//!
//! A move that turns the blade along takes as long as the slower of its two parts, as controllers do it. How long moves of
//! all axes take depends on the machine, and so does what acceleration adds: nothing of either is said here.

use vcutc_backend_api::ir::{Action, OperationId, Program, Ready, Site};
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
    /// Moves of all axes: to and from home, and to another way to stand.
    pub axes: Duration,
    /// Waiting.
    pub waiting: Duration,
}

/// What time is spent on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Cutting,
    Turning,
    Travel,
    Axes,
    Waiting,
}

impl Timing {
    /// All of it.
    #[must_use]
    pub fn total(&self) -> Duration {
        self.cutting + self.turning + self.travel + self.axes + self.waiting
    }

    fn add(&mut self, kind: Kind, time: Duration) {
        match kind {
            Kind::Cutting => self.cutting += time,
            Kind::Turning => self.turning += time,
            Kind::Travel => self.travel += time,
            Kind::Axes => self.axes += time,
            Kind::Waiting => self.waiting += time,
        }
    }
}

/// The time of a layer: its cuts, and getting there and leaving.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LayerTime {
    /// The operation.
    pub operation: OperationId,
    /// The layer, from the top, counted from 1.
    pub layer: u32,
    /// What its time is spent on.
    pub timing: Timing,
}

/// Where the time of a program goes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Times {
    /// Of all ops.
    pub all: Timing,
    /// Layer by layer, in order of work; what belongs to no layer is in [`Times::all`] only.
    pub layers: Vec<LayerTime>,
}

/// How long each op takes at programmed speeds, in the order of the program.
#[must_use]
pub fn op_times(program: &VerifiedProgram) -> Vec<Duration> {
    let program = program.program();
    let mut at = None;
    let mut times = Vec::with_capacity(program.ops.len());
    for op in &program.ops {
        times.push(op_time(program, &op.action, at));
        at = pose_after(at, &op.action);
    }
    times
}

fn op_time(program: &Program, action: &Action, at: Option<Pose>) -> Duration {
    match action {
        Action::AwaitReady => match program.cell.as_ref().map(|cell| cell.ready) {
            Some(Ready::After(time)) => time,
            Some(Ready::Input(_)) | None => Duration::ZERO,
        },
        Action::Dwell { time } => *time,
        Action::Home
        | Action::AxisTravel { .. }
        | Action::Ultrasonic { .. }
        | Action::ToolChange { .. }
        | Action::Travel { .. }
        | Action::Approach { .. }
        | Action::Retract { .. }
        | Action::Cut { .. }
        | Action::Turn { .. } => at
            .and_then(|from| Stroke::of(program, from, action))
            .map_or(Duration::ZERO, |stroke| stroke.duration()),
    }
}

/// Adds up a program's times at programmed speeds.
#[must_use]
pub fn timing(program: &VerifiedProgram) -> Times {
    times(program, &op_times(program))
}

/// Adds up the times of a program's ops, one for each, by what they are spent on.
#[must_use]
pub fn times(program: &VerifiedProgram, op_times: &[Duration]) -> Times {
    let mut times = Times::default();
    let mut at = None;
    for (op, &time) in program.program().ops.iter().zip(op_times) {
        if let Some(kind) = kind(&op.action, at) {
            times.all.add(kind, time);
            if let Some(layer) = layer(&mut times.layers, op.site) {
                layer.timing.add(kind, time);
            }
        }
        at = pose_after(at, &op.action);
    }
    times
}

/// What an op that begins at a pose spends time on; ops that switch something spend none.
const fn kind(action: &Action, at: Option<Pose>) -> Option<Kind> {
    Some(match (action, at) {
        // Without a pose to start from there is no line to go along.
        (Action::Home | Action::AxisTravel { .. }, _) | (Action::Travel { .. }, None) => Kind::Axes,
        (Action::Travel { .. }, Some(_)) | (Action::Approach { .. } | Action::Retract { .. }, _) => {
            Kind::Travel
        }
        (Action::Cut { .. }, _) => Kind::Cutting,
        (Action::Turn { .. }, _) => Kind::Turning,
        (Action::AwaitReady | Action::Dwell { .. }, _) => Kind::Waiting,
        (Action::Ultrasonic { .. } | Action::ToolChange { .. }, _) => return None,
    })
}

/// The entry of a site's layer, the last one of them or a new one; none for what belongs to no layer.
fn layer(layers: &mut Vec<LayerTime>, site: Site) -> Option<&mut LayerTime> {
    let (operation, layer) = match site {
        Site::Program | Site::Operation(_) => return None,
        Site::Layer { operation, layer } | Site::Cut { operation, layer, .. } => (operation, layer.get()),
    };
    let is_open = layers
        .last()
        .is_some_and(|last| last.operation == operation && last.layer == layer);
    if !is_open {
        layers.push(LayerTime {
            operation,
            layer,
            timing: Timing::default(),
        });
    }
    layers.last_mut()
}
