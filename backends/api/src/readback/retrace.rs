//! A whole program's statements against its ops.

use super::{Deed, FrameRole, FrameSetting, Frames, Judge, Mismatch, Moment, Place, Says, Statement};
use crate::ir::{OpId, PlacedFrame, Program};
use crate::motion::{Waypoint, pose_after};
use crate::state::{Generator, State};
use crate::stroke::Pose;

/// Follows a program's statements. What is read must be its ops, one after the other, each once; in between only
/// settings, and at the head of a part a restatement of what holds already.
pub struct Retrace<'p> {
    judge: Judge<'p>,
    frames: Frames,
    /// Where each op was read.
    places: Vec<Place>,
    departure: Option<Departure>,
    at: Option<Pose>,
    state: State,
    restating: Restating,
    waypoints: core::slice::Iter<'p, Waypoint>,
    waypoint: Option<&'p Waypoint>,
    tool: Seen,
    base: Seen,
}

/// Whether a restatement may come.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Restating {
    Allowed,
    Over,
}

/// Whether a frame was set in the part at hand.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Seen {
    Not,
    AsItShould,
}

/// The first place where a program is not what it should be.
#[derive(Clone, Debug, PartialEq)]
pub struct Departure {
    /// The op that was to come; none behind the last.
    pub op: Option<OpId>,
    /// What stands there; nothing when the program ended too soon.
    pub place: Option<Place>,
    /// What is wrong.
    pub what: DepartureKind,
}

/// What is wrong.
#[derive(Clone, Debug, PartialEq)]
pub enum DepartureKind {
    /// The deed differs from the op.
    Differs(Vec<Mismatch>),
    /// The program ends before its last op.
    Ends,
    /// Something is done that no op says.
    More,
    /// A frame has another value.
    Frame(FrameRole),
    /// A motion comes before the frame is set.
    NoFrame(FrameRole),
    /// A statement is not understood, or cannot be read.
    NotUnderstood,
}

/// A program that was read back as it should be.
#[derive(Clone, Debug, PartialEq)]
pub struct Retraced {
    /// Where each op stands.
    pub places: Vec<Place>,
}

impl<'p> Retrace<'p> {
    /// Nothing read yet.
    #[must_use]
    pub fn new(judge: Judge<'p>, frames: Frames) -> Self {
        let mut waypoints = judge.reachable().motion().waypoints.iter();
        let waypoint = waypoints.next();
        Self {
            judge,
            frames,
            places: Vec::with_capacity(judge.reachable().program().ops.len()),
            departure: None,
            at: None,
            state: State::START,
            restating: Restating::Over,
            waypoints,
            waypoint,
            tool: Seen::Not,
            base: Seen::Not,
        }
    }

    fn program(&self) -> &'p Program {
        self.judge.reachable().program()
    }

    fn next(&self) -> OpId {
        OpId(u32::try_from(self.places.len()).unwrap_or(u32::MAX))
    }

    fn depart(&mut self, place: Option<Place>, what: DepartureKind) {
        let next = self.next();
        let op = ((next.0 as usize) < self.program().ops.len()).then_some(next);
        self.departure.get_or_insert(Departure { op, place, what });
    }

    /// Takes the next statement.
    pub fn heed(&mut self, statement: &Statement) {
        if self.departure.is_some() {
            return;
        }
        let place = Some(statement.place);
        match &statement.says {
            Says::Setting => {}
            Says::PartBegins => {
                self.restating = Restating::Allowed;
                (self.tool, self.base) = (Seen::Not, Seen::Not);
            }
            Says::Frame(role, setting) => self.frame(*role, setting, place),
            Says::Deed(deed) => self.deed(deed, statement.place),
            Says::Unknown | Says::Unreadable { .. } => self.depart(place, DepartureKind::NotUnderstood),
        }
    }

    fn frame(&mut self, role: FrameRole, setting: &FrameSetting, place: Option<Place>) {
        let cell = self.program().cell.as_ref();
        let should = cell.map(|cell| match role {
            FrameRole::Tool => cell.tool,
            FrameRole::Base => cell.base,
        });
        if should.is_some_and(|should| self.judge.is_frame(setting, &should)) {
            match role {
                FrameRole::Tool => self.tool = Seen::AsItShould,
                FrameRole::Base => self.base = Seen::AsItShould,
            }
        } else {
            self.depart(place, DepartureKind::Frame(role));
        }
    }

    fn deed(&mut self, deed: &Deed, place: Place) {
        if self.frames == Frames::InProgram && is_motion(deed) {
            for (role, seen) in [(FrameRole::Tool, self.tool), (FrameRole::Base, self.base)] {
                if seen == Seen::Not {
                    return self.depart(Some(place), DepartureKind::NoFrame(role));
                }
            }
        }
        let moment = Moment {
            op: self.next(),
            at: self.at,
        };
        let restates =
            self.restating == Restating::Allowed && self.judge.restates(moment, self.state.generator, deed);
        let Some(op) = self.program().ops.get(moment.op.0 as usize) else {
            if !restates {
                self.depart(Some(place), DepartureKind::More);
            }
            return;
        };
        let due = self.waypoint.filter(|waypoint| waypoint.op == moment.op);
        let found = match due {
            Some(waypoint) if self.judge.needs_waypoints() => {
                let found = self.judge.mismatches_on_the_way(moment, waypoint, deed);
                if found.is_empty() {
                    self.restating = Restating::Over;
                    self.waypoint = self.waypoints.next();
                } else if !restates {
                    self.depart(Some(place), DepartureKind::Differs(found));
                }
                return;
            }
            Some(_) | None => self.judge.mismatches(moment, deed),
        };
        if found.is_empty() {
            self.restating = Restating::Over;
            while self.waypoint.is_some_and(|waypoint| waypoint.op <= moment.op) {
                self.waypoint = self.waypoints.next();
            }
            self.places.push(place);
            self.at = pose_after(self.at, &op.action);
            self.state = self.state.after(&op.action);
        } else if restates {
            // Nothing changes.
        } else if let Some(waypoint) = due
            && self.judge.passes(moment, waypoint, deed)
        {
            self.waypoint = self.waypoints.next();
        } else {
            self.depart(Some(place), DepartureKind::Differs(found));
        }
    }

    /// What came of it when there are no more statements.
    ///
    /// # Errors
    /// The first place where the program is not what it should be.
    pub fn finish(mut self) -> Result<Retraced, Departure> {
        if self.places.len() < self.program().ops.len() {
            self.depart(None, DepartureKind::Ends);
        }
        match self.departure {
            Some(departure) => Err(departure),
            None => Ok(Retraced { places: self.places }),
        }
    }

    /// Whether the ultrasonic generator runs at the place reached.
    #[must_use]
    pub const fn generator(&self) -> Generator {
        self.state.generator
    }
}

const fn is_motion(deed: &Deed) -> bool {
    match deed {
        Deed::Axes(_) | Deed::AxesToPose(_) | Deed::Straight { .. } => true,
        Deed::Switch { .. } | Deed::AwaitInput(_) | Deed::Wait(_) => false,
    }
}

impl Judge<'_> {
    /// Whether a frame is set to what it should be.
    #[must_use]
    pub fn is_frame(&self, setting: &FrameSetting, should: &PlacedFrame) -> bool {
        match (*setting, should.number) {
            (FrameSetting::Number(is), Some(number)) => is == number,
            (FrameSetting::Value(is), None) => self.is_same_frame(&is, &should.frame),
            (FrameSetting::Number(_) | FrameSetting::Value(_), _) => false,
        }
    }
}
