//! What each op of a program moves: [`Program::segments`].
//!
//! An op says where a motion ends. Where it begins, and what holds meanwhile, follows from the ops before it. This is worked
//! out here, once, for everything that follows a program: the verifier, the proofs, the times, the reports, read-back.
//!
//! A [`Segment`] is a plain value without allocation.

use crate::arc::CircularArc;
use crate::geometry::{Frame, Point3};
use crate::ir::{Action, Op, OpId, OrientationId, Program};
use crate::state::{State, TipPose};
use crate::units::{Angle, AngularSpeed, Duration, Length, Speed};
use core::iter::FusedIterator;
use core::ops::Range;
use core::slice::Iter;

/// An op with what holds when it begins, and what it moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment<'p> {
    /// Its number.
    pub id: OpId,
    /// The op: what of the job it serves, and what is done.
    pub op: &'p Op,
    /// The state of the machine when it begins.
    pub before: State,
    to: Option<TipPose>,
    turn: Option<Angle>,
    program: &'p Program,
}

/// What an op moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Path {
    /// Nothing.
    Still,
    /// All axes to their home values.
    Home,
    /// All axes to where the cell changes blades.
    Change,
    /// All axes to a pose of the blade, each straight to its value.
    Axes(TipPose),
    /// The blade, its tip on a line or an arc.
    Linear(LinearSegment),
}

/// A motion of the tip on a straight line, or on an arc, while the blade turns about one fixed axis. A turn about the still tip
/// has length zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinearSegment {
    /// Where it begins.
    pub from: TipPose,
    /// Where it ends.
    pub to: TipPose,
    /// A point of the arc on which the tip moves; none on a straight line.
    pub via: Option<Point3>,
    /// How far the blade turns.
    pub turn: Angle,
    /// Speed of the tip; none for a turn about the still tip.
    pub feed: Option<Speed>,
    /// Rate at which the blade turns at most; none for an op that keeps its orientation.
    pub rate: Option<AngularSpeed>,
}

/// What decides how long a straight motion takes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LimitedBy {
    /// The speed of the tip.
    Feed(Speed),
    /// The rate at which the blade turns.
    Rate(AngularSpeed),
}

impl Segment<'_> {
    /// The pose of the blade when it begins, where that is known.
    #[must_use]
    #[inline]
    pub const fn start(&self) -> Option<TipPose> {
        self.before.place.pose()
    }

    /// The pose of the blade when it ends, where that is known.
    #[must_use]
    #[inline]
    pub const fn end(&self) -> Option<TipPose> {
        // An op that leads to a pose ends in it, so no state has to be worked out.
        match self.to {
            Some(to) => Some(to),
            None => self.after().place.pose(),
        }
    }

    /// The state of the machine when it ends.
    #[must_use]
    #[inline(always)]
    pub const fn after(&self) -> State {
        let mut state = self.before;
        state.lead(&self.op.action, self.to);
        state
    }

    /// The pose to which it leads the blade, where it leads it to one.
    #[must_use]
    #[inline]
    pub const fn target(&self) -> Option<TipPose> {
        self.to
    }

    /// How far the blade turns; none where the program does not have its orientations.
    #[must_use]
    #[inline]
    pub const fn turn(&self) -> Option<Angle> {
        self.turn
    }

    /// What moves.
    #[must_use]
    #[inline(always)]
    pub fn path(&self) -> Path {
        match (&self.op.action, self.start(), self.to) {
            (Action::Home, ..) => Path::Home,
            (Action::ChangePlace, ..) => Path::Change,
            // Without a pose the blade is at home, where it was changed or somewhere unknown, so the motion has no line to follow.
            (Action::AxisTravel { .. }, _, Some(to)) | (_, None, Some(to)) => Path::Axes(to),
            (_, Some(from), Some(to)) => {
                let line = LinearSegment::with(self.program, [from, to], &self.op.action, self.turn);
                line.map_or(Path::Still, Path::Linear)
            }
            (_, _, None) => Path::Still,
        }
    }

    /// The straight motion, if it is one.
    #[must_use]
    #[inline]
    pub fn line(&self) -> Option<LinearSegment> {
        match self.path() {
            Path::Linear(line) => Some(line),
            Path::Still | Path::Home | Path::Change | Path::Axes(_) => None,
        }
    }
}

impl Path {
    /// The pose to which it leads; none for axis values.
    #[must_use]
    pub const fn target(&self) -> Option<TipPose> {
        match self {
            Self::Axes(to) => Some(*to),
            Self::Linear(line) => Some(line.to),
            Self::Still | Self::Home | Self::Change => None,
        }
    }

    /// The straight motion, if it is one.
    #[must_use]
    #[inline]
    pub const fn line(&self) -> Option<&LinearSegment> {
        match self {
            Self::Linear(line) => Some(line),
            Self::Still | Self::Home | Self::Change | Self::Axes(_) => None,
        }
    }

    /// Whether all axes move at once.
    #[must_use]
    pub const fn is_of_axes(&self) -> bool {
        match self {
            Self::Home | Self::Change | Self::Axes(_) => true,
            Self::Still | Self::Linear(_) => false,
        }
    }
}

impl LinearSegment {
    /// The straight motion of an action that begins at a pose; none for an action that moves nothing, or all axes, and for ids
    /// that are not in the program's tables.
    #[must_use]
    pub fn of(program: &Program, from: TipPose, action: &Action) -> Option<Self> {
        let to = action.leads_to(Some(from))?;
        Self::with(
            program,
            [from, to],
            action,
            angle(program, [from.orientation, to.orientation]),
        )
    }

    /// The same with its end, and how far the blade turns, from elsewhere.
    #[inline(always)]
    fn with(
        program: &Program,
        [from, to]: [TipPose; 2],
        action: &Action,
        turn: Option<Angle>,
    ) -> Option<Self> {
        let (feed, rate) = match (action.feed(), action.rate()) {
            (Some(feed), Some(rate)) => (Some(program.feed(feed)?), Some(program.rate(rate)?)),
            (Some(feed), None) => (Some(program.feed(feed)?), None),
            (None, Some(rate)) => (None, Some(program.rate(rate)?)),
            (None, None) => return None,
        };
        Some(Self {
            from,
            to,
            via: action.via().and_then(|via| program.via(via)),
            turn: turn?,
            feed,
            rate,
        })
    }

    /// How far the tip goes.
    #[must_use]
    #[inline(always)]
    pub fn length(&self) -> Length {
        match self.arc() {
            Some(arc) => arc.length(),
            None => self.from.tip.distance(self.to.tip),
        }
    }

    /// The arc on which the tip moves; none on a straight line.
    #[must_use]
    // A call would need the whole segment in memory, also on a straight line.
    #[inline(always)]
    pub fn arc(&self) -> Option<CircularArc> {
        let via = self.via?;
        CircularArc::through([self.from.tip, via, self.to.tip].map(Point3::to_array))
    }

    /// The point of the arc in the middle of a stretch of it, from what is done where the stretch begins to what is done where it
    /// ends; none on a straight line.
    #[must_use]
    pub fn via_between(&self, [from, to]: [f64; 2]) -> Option<Point3> {
        let arc = self.arc()?;
        let middle = 0.5 * (from + to);
        Some(Point3::from(arc.at(arc.sweep().to_rad() * middle)))
    }

    /// Whether the blade is held otherwise at its end.
    #[must_use]
    pub fn turns(&self) -> bool {
        self.from.orientation != self.to.orientation
    }

    /// How long it takes: as long as the slower of its two parts, as controllers do it.
    #[must_use]
    #[inline]
    pub fn duration(&self) -> Duration {
        let [moving, turning] = self.times();
        moving.max(turning)
    }

    /// Which of its two parts is the slower one; none for a motion that takes no time.
    #[must_use]
    pub fn limited_by(&self) -> Option<LimitedBy> {
        let [moving, turning] = self.times();
        if moving.max(turning) <= Duration::ZERO {
            None
        } else if moving > turning {
            self.feed.map(LimitedBy::Feed)
        } else {
            self.rate.map(LimitedBy::Rate)
        }
    }

    /// How long the tip and the blade's turn take on their own.
    #[inline]
    fn times(&self) -> [Duration; 2] {
        let moving = self.feed.map_or(Duration::ZERO, |feed| self.length() / feed);
        let turning = match self.rate {
            Some(rate) if self.turn > Angle::ZERO => self.turn / rate,
            Some(_) | None => Duration::ZERO,
        };
        [moving, turning]
    }

    /// The blade frame T in W when so much of the way is done, from 0 to 1: the tip on its way, the blade turned about one
    /// fixed axis. None for a motion of another program.
    #[must_use]
    pub fn frame_at(&self, program: &Program, done: f64) -> Option<Frame> {
        let [from, to] = [program.frame(self.from)?, program.frame(self.to)?];
        let between = |from: f64, to: f64| from + (to - from) * done;
        let (begin, end) = (from.origin, to.origin);
        let origin = match self.arc() {
            Some(arc) => Point3::from(arc.at(arc.sweep().to_rad() * done)),
            None => Point3::new(
                between(begin.x, end.x),
                between(begin.y, end.y),
                between(begin.z, end.z),
            ),
        };
        Some(Frame {
            origin,
            orientation: from.orientation.towards(to.orientation, done),
        })
    }
}

impl Program {
    /// The ops with what each of them moves, one after the other.
    #[must_use]
    pub fn segments(&self) -> Segments<'_> {
        self.segments_of(0..self.ops.len(), State::START)
    }

    /// The same for a run of ops that begins in a state.
    #[must_use]
    pub fn segments_of(&self, ops: Range<usize>, start: State) -> Segments<'_> {
        let first = u32::try_from(ops.start).unwrap_or(u32::MAX);
        Segments {
            program: self,
            next: OpId(first),
            ops: self.ops.get(ops).unwrap_or_default().iter(),
            state: start,
            angles: Angles(Vec::new()),
        }
    }

    /// The ops, each with the state of the machine after it: a walk for those who do not ask how the blade gets there.
    pub fn ends(&self) -> impl Iterator<Item = (OpId, &Op, State)> {
        let ops = (0..).map(OpId).zip(&self.ops);
        ops.scan(State::START, |state, (id, op)| {
            state.advance(&op.action);
            Some((id, op, *state))
        })
    }

    /// Shows what [`Program::ends`] gives, op by op, without a copy of the state for each.
    #[inline]
    pub fn show_ends<'p>(&'p self, mut show: impl FnMut(OpId, &'p Op, &State)) {
        let mut state = State::START;
        for (id, op) in (0..).map(OpId).zip(&self.ops) {
            state.advance(&op.action);
            show(id, op, &state);
        }
    }

    /// The state of the machine after the last op.
    #[must_use]
    pub fn end(&self) -> State {
        self.ends().last().map_or(State::START, |(_, _, end)| end)
    }

    /// What one op moves. All ops before it are walked.
    #[must_use]
    pub fn segment(&self, op: OpId) -> Option<Segment<'_>> {
        self.segments().nth(op.0 as usize)
    }

    /// The blade frame T in W at a pose of this program.
    #[must_use]
    pub fn frame(&self, pose: TipPose) -> Option<Frame> {
        Some(Frame {
            origin: pose.tip,
            orientation: self.orientation(pose.orientation)?,
        })
    }
}

/// The segments of a program, see [`Program::segments`].
#[derive(Clone, Debug)]
pub struct Segments<'p> {
    program: &'p Program,
    next: OpId,
    ops: Iter<'p, Op>,
    state: State,
    angles: Angles,
}

impl<'p> Iterator for Segments<'p> {
    type Item = Segment<'p>;

    // Within the loop that asks, a segment is worked out only as far as the loop uses it.
    #[inline(always)]
    fn next(&mut self) -> Option<Segment<'p>> {
        let op = self.ops.next()?;
        let from = self.state.place.pose();
        let to = op.action.leads_to(from);
        let turn = match (from, to) {
            (Some(from), Some(to)) if from.orientation != to.orientation => {
                (self.angles).between(self.program, [from.orientation, to.orientation])
            }
            (_, _) => Some(Angle::ZERO),
        };
        let segment = Segment {
            id: self.next,
            op,
            before: self.state,
            to,
            turn,
            program: self.program,
        };
        self.next = OpId(segment.id.0.saturating_add(1));
        self.state.lead(&op.action, to);
        Some(segment)
    }

    #[inline]
    fn size_hint(&self) -> (usize, Option<usize>) {
        self.ops.size_hint()
    }
}

impl ExactSizeIterator for Segments<'_> {}
impl FusedIterator for Segments<'_> {}

impl Segments<'_> {
    /// The state of the machine before the next op, or after the last.
    #[must_use]
    pub const fn state(&self) -> State {
        self.state
    }
}

/// Angles between orientations, each computed once: a program has a handful of them for all its ops.
#[derive(Clone, Debug)]
struct Angles(Vec<([OrientationId; 2], Angle)>);

impl Angles {
    /// Programs with more pairs compute the rest each time, so that looking never takes long.
    const MOST: usize = 32;

    #[inline]
    fn between(&mut self, program: &Program, ids: [OrientationId; 2]) -> Option<Angle> {
        match self.0.iter().find(|(known, _)| *known == ids) {
            Some((_, known)) => Some(*known),
            None => self.computed(program, ids),
        }
    }

    #[cold]
    fn computed(&mut self, program: &Program, ids: [OrientationId; 2]) -> Option<Angle> {
        let angle = angle(program, ids)?;
        if self.0.len() < Self::MOST {
            self.0.push((ids, angle));
        }
        Some(angle)
    }
}

fn angle(program: &Program, [from, to]: [OrientationId; 2]) -> Option<Angle> {
    // Rounding must not make a turn of none.
    if from == to {
        return Some(Angle::ZERO);
    }
    Some(program.orientation(from)?.angle_to(program.orientation(to)?))
}
