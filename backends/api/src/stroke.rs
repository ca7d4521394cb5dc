//! A motion of the tip between two poses, and how long it takes at its programmed speeds.
//!
//! A move that turns the blade along takes as long as the slower of its two parts, as controllers do it.

use crate::geometry::{Frame, Point3};
use crate::ir::{Action, OrientationId, Program};
use crate::units::{Angle, AngularSpeed, Duration, Length, Speed};

/// A pose of a program: where the tip is in W, and how the blade is held.
pub type Pose = (Point3, OrientationId);

/// A motion of the tip on a straight line, of length zero for a turn about the still tip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stroke {
    /// Where it begins.
    pub from: Pose,
    /// Where it ends.
    pub to: Pose,
    /// How far the tip goes.
    pub length: Length,
    /// How far the blade turns.
    pub turn: Angle,
    /// Speed of the tip; none for a turn about the still tip.
    pub feed: Option<Speed>,
    /// Rate at which the blade turns at most; none where it does not turn.
    pub rate: Option<AngularSpeed>,
}

impl Stroke {
    /// The motion of an action that begins at a pose; none for actions that move nothing, or all axes, and for ids that
    /// are not in the program's tables.
    #[must_use]
    pub fn of(program: &Program, from: Pose, action: &Action) -> Option<Self> {
        let orientation = |id: OrientationId| program.orientations.get(id.0 as usize);
        Self::turning(program, from, action, |held, then| {
            Some(orientation(held)?.angle_to(*orientation(then)?))
        })
    }

    /// The same, with the angle between two different postures from somebody who knows it: the few of a program are asked for
    /// again and again. `None` for ids that are not in the program's tables.
    #[must_use]
    pub fn turning(
        program: &Program,
        from: Pose,
        action: &Action,
        angle: impl FnOnce(OrientationId, OrientationId) -> Option<Angle>,
    ) -> Option<Self> {
        let (tip, held) = from;
        let (to, feed, rate) = match *action {
            Action::Travel {
                to,
                orientation,
                feed,
                rate,
            } => ((to, orientation), Some(feed), Some(rate)),
            Action::Approach { to, feed } | Action::Retract { to, feed } | Action::Cut { to, feed, .. } => {
                ((to, held), Some(feed), None)
            }
            Action::Turn { to, rate } => ((tip, to), None, Some(rate)),
            Action::Home
            | Action::AxisTravel { .. }
            | Action::Ultrasonic { .. }
            | Action::AwaitReady
            | Action::Dwell { .. }
            | Action::ToolChange { .. } => return None,
        };
        let turn = if held == to.1 {
            Angle::ZERO
        } else {
            angle(held, to.1)?
        };
        let feed = match feed {
            Some(id) => Some(*program.feeds.get(usize::from(id.0))?),
            None => None,
        };
        let rate = match rate {
            Some(id) => Some(*program.rates.get(usize::from(id.0))?),
            None => None,
        };
        Some(Self {
            from,
            to,
            length: tip.distance(to.0),
            turn,
            feed,
            rate,
        })
    }

    /// How long it takes.
    #[must_use]
    pub fn duration(&self) -> Duration {
        let moving = self.feed.map_or(Duration::ZERO, |feed| self.length / feed);
        let turning = match self.rate {
            Some(rate) if self.turn > Angle::ZERO => self.turn / rate,
            Some(_) | None => Duration::ZERO,
        };
        moving.max(turning)
    }

    /// The blade frame T in W when so much of the way is done, from 0 to 1: the tip on its line, the blade turned about one
    /// fixed axis. None for a stroke of another program.
    #[must_use]
    pub fn frame_at(&self, program: &Program, done: f64) -> Option<Frame> {
        let ((from, held), (to, then)) = (self.from, self.to);
        let between = |from: f64, to: f64| from + (to - from) * done;
        let orientation = |id: OrientationId| program.orientations.get(id.0 as usize);
        Some(Frame {
            origin: Point3::new(
                between(from.x, to.x),
                between(from.y, to.y),
                between(from.z, to.z),
            ),
            orientation: orientation(held)?.towards(*orientation(then)?, done),
        })
    }
}
