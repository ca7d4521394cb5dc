//! What each op of a program moves: its [`Leg`].
//!
//! Programs say where a motion ends; where it begins is where the op before it ended. Here both ends stand together with
//! the time between them, so that the legs of a program can be judged in any order.

use super::path::Course;
use vcutc_backend_api::geometry::{Frame, Point3};
use vcutc_backend_api::ir::{Action, FeedId, OpId, OrientationId, Program, RateId};
use vcutc_machine::kinematics::pose::Pose;

/// A pose that a program teaches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Taught {
    /// Where the tip is, in W.
    pub tip: Point3,
    /// How the blade is held.
    pub held: OrientationId,
}

/// What an op moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Leg {
    Still,
    /// All axes to their home values.
    Home,
    /// All axes to a pose, each straight to its value.
    ByAxes(Taught),
    /// The blade along a course.
    Along(Stroke),
}

impl Leg {
    /// The pose to which it leads; none for home.
    #[must_use]
    pub const fn taught(&self) -> Option<Taught> {
        match self {
            Self::ByAxes(taught) => Some(*taught),
            Self::Along(stroke) => Some(stroke.to),
            Self::Still | Self::Home => None,
        }
    }

    /// The course, if it is one.
    #[must_use]
    pub const fn stroke(&self) -> Option<&Stroke> {
        match self {
            Self::Along(stroke) => Some(stroke),
            Self::Still | Self::Home | Self::ByAxes(_) => None,
        }
    }
}

/// A course between two taught poses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stroke {
    pub from: Taught,
    pub to: Taught,
    /// How long it takes, in s; positive.
    pub duration: f64,
    /// What decides how long it takes.
    pub pace: Pace,
    /// Whether an axis move may take its place.
    pub detour: Detour,
}

/// What decides how long a motion takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Pace {
    /// The tip's speed.
    Feed(FeedId),
    /// The rate at which the blade turns.
    Rate(RateId),
}

/// Whether an axis move may take a motion's place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Detour {
    /// It may: the motion goes through the air, and both of its ends lie above the stock.
    Allowed,
    /// It may not.
    Refused,
}

/// How far the tip may lie below the stock's top and count as above it, in mm (as in the program's verifier).
const SAME: f64 = 1e-6;

/// The legs of a program, one for each op.
#[must_use]
pub fn legs(program: &Program) -> Vec<Leg> {
    let mut at = None;
    program
        .ops
        .iter()
        .map(|op| {
            let leg = leg(program, at, op.action);
            match leg {
                Leg::Still => {}
                Leg::Home => at = None,
                Leg::ByAxes(to) => at = Some(to),
                Leg::Along(stroke) => at = Some(stroke.to),
            }
            leg
        })
        .collect()
}

fn leg(program: &Program, at: Option<Taught>, action: Action) -> Leg {
    match (action, at) {
        (Action::Home, _) => Leg::Home,
        // Before the first pose the blade is at home or nowhere in particular, so there is no line to go along.
        (Action::Travel { to, orientation, .. }, None) | (Action::AxisTravel { to, orientation }, _) => {
            Leg::ByAxes(Taught {
                tip: to,
                held: orientation,
            })
        }
        (
            Action::Travel {
                to,
                orientation,
                feed,
                rate,
            },
            Some(from),
        ) => {
            let to = Taught {
                tip: to,
                held: orientation,
            };
            stroke(
                program,
                from,
                to,
                Some(feed),
                Some(rate),
                detour(program, from, to),
            )
        }
        (
            Action::Approach { to, feed } | Action::Retract { to, feed } | Action::Cut { to, feed, .. },
            Some(from),
        ) => {
            let to = Taught { tip: to, ..from };
            stroke(program, from, to, Some(feed), None, Detour::Refused)
        }
        (Action::Turn { to, rate }, Some(from)) => {
            let to = Taught { held: to, ..from };
            stroke(program, from, to, None, Some(rate), Detour::Refused)
        }
        // The verifier lets no program begin with these.
        (
            Action::Approach { .. } | Action::Retract { .. } | Action::Cut { .. } | Action::Turn { .. },
            None,
        )
        | (
            Action::Ultrasonic { .. } | Action::AwaitReady | Action::Dwell { .. } | Action::ToolChange { .. },
            _,
        ) => Leg::Still,
    }
}

fn detour(program: &Program, from: Taught, to: Taught) -> Detour {
    let top = program.stock.height.to_mm();
    if from.tip.z.min(to.tip.z) >= top - SAME {
        Detour::Allowed
    } else {
        Detour::Refused
    }
}

/// A leg that takes as long as the slower of its two parts, as controllers do it.
fn stroke(
    program: &Program,
    from: Taught,
    to: Taught,
    feed: Option<FeedId>,
    rate: Option<RateId>,
    detour: Detour,
) -> Leg {
    let moving = feed.and_then(|feed| {
        let speed = program.feeds.get(usize::from(feed.0))?;
        Some((Pace::Feed(feed), (from.tip.distance(to.tip) / *speed).to_s()))
    });
    let turning = rate.filter(|_| from.held != to.held).and_then(|rate| {
        let speed = program.rates.get(usize::from(rate.0))?;
        let held = |taught: Taught| program.orientations.get(taught.held.0 as usize).copied();
        Some((
            Pace::Rate(rate),
            (held(from)?.angle_to(held(to)?) / *speed).to_s(),
        ))
    });
    let slowest = moving
        .into_iter()
        .chain(turning)
        .max_by(|(_, a), (_, b)| a.total_cmp(b));
    match slowest {
        Some((pace, duration)) if duration > 0.0 => Leg::Along(Stroke {
            from,
            to,
            duration,
            pace,
            detour,
        }),
        Some(_) | None => Leg::Still,
    }
}

/// The poses of a program's taught points.
#[derive(Clone, Debug)]
pub struct Poses<'p> {
    program: &'p Program,
}

impl<'p> Poses<'p> {
    #[must_use]
    pub const fn of(program: &'p Program) -> Self {
        Self { program }
    }

    /// The blade frame T in W.
    #[must_use]
    pub fn blade_in_work(&self, taught: Taught) -> Option<Pose> {
        let orientation = self.program.orientations.get(taught.held.0 as usize).copied()?;
        Some(Pose::from(Frame {
            origin: taught.tip,
            orientation,
        }))
    }

    /// The course of a stroke.
    #[must_use]
    pub fn course(&self, stroke: &Stroke) -> Option<Course> {
        Some(Course {
            from: self.blade_in_work(stroke.from)?,
            to: self.blade_in_work(stroke.to)?,
            duration: stroke.duration,
        })
    }
}

/// The legs with the numbers of their ops.
pub fn numbered(legs: &[Leg]) -> impl DoubleEndedIterator<Item = (OpId, &Leg)> + ExactSizeIterator {
    legs.iter()
        .enumerate()
        .map(|(index, leg)| (OpId(u32::try_from(index).unwrap_or(u32::MAX)), leg))
}
