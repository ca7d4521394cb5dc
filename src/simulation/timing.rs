//! How long a program takes, op by op, at its programmed speeds; and where that time goes.
//!
//! A move that turns the blade along takes as long as the slower of its two parts, as controllers do it. How long moves of
//! all axes take depends on the machine, and so does what acceleration adds: nothing of either is said here.

use crate::by_layer::ByLayer;
use vcutc_backend_api::ir::{Action, OperationId, Program, Ready, Site};
use vcutc_backend_api::segments::Segment;
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
    /// For the generator.
    pub waiting: Duration,
    /// For a blade to be changed, where that takes a known time.
    pub changes: Duration,
}

/// What time is spent on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A way through the work.
    Cutting,
    /// A turn about the still tip.
    Turning,
    /// A way through the air.
    Travel,
    Waiting,
    /// A move of all axes.
    Axes,
    /// A change of blade.
    Changes,
}

impl Kind {
    /// All of them, in the order in which people read them.
    pub const ALL: [Self; 6] = [
        Self::Cutting,
        Self::Turning,
        Self::Travel,
        Self::Waiting,
        Self::Axes,
        Self::Changes,
    ];

    /// What an action spends time on; those that switch something spend none.
    #[must_use]
    pub const fn of(action: &Action) -> Option<Self> {
        Some(match action {
            Action::Cut { .. } | Action::Follow { .. } => Self::Cutting,
            Action::Turn { .. } => Self::Turning,
            Action::Travel { .. } | Action::Approach { .. } | Action::Retract { .. } => Self::Travel,
            Action::AwaitReady | Action::Dwell { .. } => Self::Waiting,
            Action::ToolChange { .. } => Self::Changes,
            Action::Home | Action::ChangePlace | Action::AxisTravel { .. } => Self::Axes,
            Action::Ultrasonic { .. } | Action::Spin { .. } => return None,
        })
    }
}

impl Timing {
    #[must_use]
    pub fn total(&self) -> Duration {
        self.cutting + self.turning + self.travel + self.axes + self.waiting + self.changes
    }

    /// What is spent on a kind.
    #[must_use]
    pub const fn of(&self, kind: Kind) -> Duration {
        match kind {
            Kind::Cutting => self.cutting,
            Kind::Turning => self.turning,
            Kind::Travel => self.travel,
            Kind::Waiting => self.waiting,
            Kind::Axes => self.axes,
            Kind::Changes => self.changes,
        }
    }

    fn add(&mut self, kind: Kind, time: Duration) {
        match kind {
            Kind::Cutting => self.cutting += time,
            Kind::Turning => self.turning += time,
            Kind::Travel => self.travel += time,
            Kind::Axes => self.axes += time,
            Kind::Waiting => self.waiting += time,
            Kind::Changes => self.changes += time,
        }
    }
}

/// The time of a layer: its cuts, and getting there and leaving.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LayerTime {
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
    /// Layer by layer, from the top of the first operation on, in whatever order they were worked on.
    pub layers: Vec<LayerTime>,
    /// Of the ops that belong to no layer.
    pub rest: Timing,
}

/// How long each op takes at programmed speeds, in the order of the program.
#[must_use]
pub fn op_times(program: &VerifiedProgram) -> Vec<Duration> {
    let program = program.program();
    let mut times = Vec::with_capacity(program.ops.len());
    times.extend(program.segments().map(|segment| op_time(program, &segment)));
    times
}

fn op_time(program: &Program, segment: &Segment<'_>) -> Duration {
    let ready = program.cell.as_ref().map(|cell| cell.ready);
    let change = program.cell.as_ref().and_then(|cell| cell.change);
    match (segment.line(), segment.op.action) {
        (Some(line), _) => line.duration(),
        (None, Action::Dwell { time }) => time,
        (None, Action::AwaitReady) => match ready {
            Some(Ready::After(time)) => time,
            Some(Ready::Input(_)) | None => Duration::ZERO,
        },
        (None, Action::ToolChange { .. }) => change.map_or(Duration::ZERO, |change| change.time),
        (None, _) => Duration::ZERO,
    }
}

/// How long a program takes in all at programmed speeds: the total of what [`timing`] says of all ops.
#[must_use]
pub fn total(program: &VerifiedProgram) -> Duration {
    let mut all = Timing::default();
    for (op, time) in program.program().ops.iter().zip(op_times(program)) {
        if let Some(kind) = Kind::of(&op.action) {
            all.add(kind, time);
        }
    }
    all.total()
}

/// Adds up a program's times at programmed speeds.
#[must_use]
pub fn timing(program: &VerifiedProgram) -> Times {
    times(program, &op_times(program))
}

/// Adds up the times of a program's ops, one for each, by what they are spent on.
#[must_use]
pub fn times(program: &VerifiedProgram, op_times: &[Duration]) -> Times {
    let (mut all, mut rest) = (Timing::default(), Timing::default());
    let mut layers = ByLayer::<Timing>::default();
    for (op, &time) in program.program().ops.iter().zip(op_times) {
        let Some(kind) = Kind::of(&op.action) else {
            continue;
        };
        let place = match op.site {
            Site::Program | Site::Operation(_) => &mut rest,
            Site::Layer { operation, layer } | Site::Cut { operation, layer, .. } => {
                layers.of((operation, layer))
            }
        };
        place.add(kind, time);
        all.add(kind, time);
    }
    let layers = layers
        .into_all()
        .map(|((operation, layer), timing)| LayerTime {
            operation,
            layer: layer.get(),
            timing,
        })
        .collect();
    Times { all, layers, rest }
}
