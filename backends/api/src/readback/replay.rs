//! A whole program's statements against its ops.

use super::{
    Command, Comparator, Effect, FrameRole, FrameSetting, Frames, Mismatch, Moment, Place, Statement,
};
use crate::ir::{Action, OpId, PlacedFrame, Program};
use crate::motion::Waypoint;
use crate::state::{Drive, State};

/// Follows a program's statements. What is read must be its ops, one after the other, each once; in between only
/// settings, and at the head of a part a restatement of what holds already.
pub struct Replay<'p> {
    comparator: Comparator<'p>,
    frames: Frames,
    /// Where each op was read.
    places: Vec<Place>,
    divergence: Option<Divergence>,
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
pub struct Divergence {
    /// The op that was to come; none after the last.
    pub op: Option<OpId>,
    /// What stands there; nothing when the program ended too soon.
    pub place: Option<Place>,
    /// What is wrong.
    pub what: DivergenceKind,
}

/// What is wrong.
#[derive(Clone, Debug, PartialEq)]
pub enum DivergenceKind {
    /// The command differs from the op.
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

impl<'p> Replay<'p> {
    /// Nothing read yet.
    #[must_use]
    pub fn new(comparator: Comparator<'p>, frames: Frames) -> Self {
        let mut waypoints = comparator.reachable().motion().waypoints.iter();
        let waypoint = waypoints.next();
        Self {
            comparator,
            frames,
            places: Vec::with_capacity(comparator.reachable().program().ops.len()),
            divergence: None,
            state: State::START,
            restating: Restating::Over,
            waypoints,
            waypoint,
            tool: Seen::Not,
            base: Seen::Not,
        }
    }

    fn program(&self) -> &'p Program {
        self.comparator.reachable().program()
    }

    fn next(&self) -> OpId {
        OpId(u32::try_from(self.places.len()).unwrap_or(u32::MAX))
    }

    fn diverge(&mut self, place: Option<Place>, what: DivergenceKind) {
        let next = self.next();
        let op = ((next.0 as usize) < self.program().ops.len()).then_some(next);
        self.divergence.get_or_insert(Divergence { op, place, what });
    }

    /// Takes the next statement.
    pub fn take(&mut self, statement: &Statement) {
        if self.divergence.is_some() {
            return;
        }
        let place = Some(statement.place);
        match &statement.effect {
            Effect::Setting => {}
            Effect::PartBegins => {
                self.restating = Restating::Allowed;
                (self.tool, self.base) = (Seen::Not, Seen::Not);
            }
            Effect::Frame(role, setting) => self.frame(*role, setting, place),
            Effect::Command(command) => self.command(command, statement.place),
            Effect::Unknown | Effect::Unreadable { .. } => self.diverge(place, DivergenceKind::NotUnderstood),
        }
    }

    fn frame(&mut self, role: FrameRole, setting: &FrameSetting, place: Option<Place>) {
        let cell = self.program().cell.as_ref();
        let should = cell.map(|cell| match role {
            FrameRole::Tool => cell.tools.at(self.state.tool).frame,
            FrameRole::Base => cell.base,
        });
        if should.is_some_and(|should| self.comparator.is_frame(setting, &should)) {
            match role {
                FrameRole::Tool => self.tool = Seen::AsItShould,
                FrameRole::Base => self.base = Seen::AsItShould,
            }
        } else {
            self.diverge(place, DivergenceKind::Frame(role));
        }
    }

    fn command(&mut self, command: &Command, place: Place) {
        if self.frames == Frames::InProgram && command.is_motion() {
            for (role, seen) in [(FrameRole::Tool, self.tool), (FrameRole::Base, self.base)] {
                if seen == Seen::Not {
                    return self.diverge(Some(place), DivergenceKind::NoFrame(role));
                }
            }
        }
        let moment = Moment {
            op: self.next(),
            before: self.state,
        };
        let restates = self.restating == Restating::Allowed && self.comparator.restates(moment, command);
        let Some(op) = self.program().op(moment.op) else {
            if !restates {
                self.diverge(Some(place), DivergenceKind::More);
            }
            return;
        };
        let due = self.waypoint.filter(|waypoint| waypoint.op == moment.op);
        let found = match due {
            Some(waypoint) if self.comparator.needs_waypoints() => {
                let found = self.comparator.waypoint_mismatches(moment, waypoint, command);
                if found.is_empty() {
                    self.restating = Restating::Over;
                    self.waypoint = self.waypoints.next();
                } else if !restates {
                    self.diverge(Some(place), DivergenceKind::Differs(found));
                }
                return;
            }
            Some(_) | None => self.comparator.mismatches(moment, command),
        };
        if found.is_empty() {
            self.restating = Restating::Over;
            while self.waypoint.is_some_and(|waypoint| waypoint.op <= moment.op) {
                self.waypoint = self.waypoints.next();
            }
            self.places.push(place);
            self.state.advance(&op.action);
            if matches!(op.action, Action::ToolChange { .. }) {
                (self.tool, self.base) = (Seen::Not, Seen::Not);
            }
        } else if restates {
            // Nothing changes.
        } else if let Some(waypoint) = due
            && self.comparator.passes(moment, waypoint, command)
        {
            self.waypoint = self.waypoints.next();
        } else {
            self.diverge(Some(place), DivergenceKind::Differs(found));
        }
    }

    /// Where each op stands, when there are no more statements.
    ///
    /// # Errors
    /// The first place where the program is not what it should be.
    pub fn finish(mut self) -> Result<Vec<Place>, Divergence> {
        if self.places.len() < self.program().ops.len() {
            self.diverge(None, DivergenceKind::Ends);
        }
        match self.divergence {
            Some(divergence) => Err(divergence),
            None => Ok(self.places),
        }
    }

    /// Whether the ultrasonic generator runs at the place reached.
    #[must_use]
    pub const fn generator(&self) -> Drive {
        self.state.generator
    }
}

impl Comparator<'_> {
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
