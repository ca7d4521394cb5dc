//! What single instructions do.

use super::setup::{Need, Setup, Wanted};
use super::tools;
use crate::configuration::StatusAndTurn;
use crate::interpreter::position::{Position, orientation};
use crate::interpreter::variables::Outcome;
use crate::interpreter::{Context, State};
use crate::syntax::{
    Approximation, Arc, Component, Coordinates, Directions, Motion, Path, Phrase, Planner, Points, Tail,
    Value, Variable, is_same_name,
};
use vcutc_backend_api::arc::CircularArc;
use vcutc_backend_api::geometry::{Frame, Orientation, Point3};
use vcutc_backend_api::ir::{AxisValues, Switch, ToolId};
use vcutc_backend_api::readback::{
    Circle, Command, Configuration, Effect, End, FrameRole, FrameSetting, Held, Target as Goal,
};
use vcutc_backend_api::units::{Angle, Duration};

/// The state that instructions change.
pub(super) struct Controller<'a> {
    wanted: Wanted<'a>,
    setup: Setup,
    pub(super) state: State,
    /// The angles A, B, C of some of the last targets, and what they are: most moves keep them, or change between two.
    turned: [([f64; 3], Orientation); 4],
    /// Which of them is the oldest.
    oldest: usize,
}

/// How far the attitude at an auxiliary point may be from that on the way: points are printed, and so is the share of the way.
const SAME_ATTITUDE: Angle = Angle::deg(0.05);

/// Where a motion may be left for the next one.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Left {
    AtEnd,
    Before,
}

/// Where a motion may be left, by the words after its target.
fn is_left(planner: Planner, tail: &Tail<'_>) -> Result<Left, MotionError> {
    if tail.second.is_some() || tail.directions.is_some() || !tail.with.is_empty() {
        return Err(MotionError::Unknown);
    }
    match (planner, tail.approximation) {
        (_, None) => Ok(Left::AtEnd),
        (Planner::Classic, Some(Approximation::Distance))
        | (Planner::Spline, Some(Approximation::Spline)) => Ok(Left::Before),
        (Planner::Classic | Planner::Spline, Some(_)) => Err(MotionError::Unknown),
    }
}

/// Whether external axes, which no machine of ours has, go somewhere.
fn moves_external_axes(target: &Coordinates) -> bool {
    let external = Component::EXTERNAL.into_iter();
    external
        .filter_map(|component| target.get(component))
        .any(|value| value != 0.0)
}

/// Why a motion is not reported as a command.
enum MotionError {
    Unknown,
    Expected(&'static str),
}

const INCOMPLETE: MotionError = MotionError::Expected("all components, where no target before it has them");

impl From<MotionError> for Effect {
    fn from(error: MotionError) -> Self {
        match error {
            MotionError::Unknown => Self::Unknown,
            MotionError::Expected(what) => Effect::expected(what),
        }
    }
}

impl<'a> Controller<'a> {
    pub(super) fn new(wanted: Wanted<'a>) -> Self {
        Self {
            wanted,
            setup: Setup::default(),
            state: State::default(),
            turned: [([0.0; 3], Orientation::IDENTITY); 4],
            oldest: 0,
        }
    }

    /// `BAS (#INITMOV,0 )` at the head of a routine, which may have been started alone.
    pub(super) fn begin(&mut self) {
        self.setup = Setup::started();
        self.state.position = Position::default();
    }

    /// What an instruction does.
    pub(super) fn carry_out(&mut self, context: Context<'_>, phrase: &Phrase<'_>) -> Effect {
        match phrase {
            Phrase::Motion(motion) => match self.motion(context, motion) {
                Ok(command) => Effect::Command(command),
                Err(error) => {
                    // It is not known where it leads, so what later targets leave out is not known either.
                    self.state.position = Position::default();
                    error.into()
                }
            },
            Phrase::Assignment { to, value } => self.assign(context, to, value),
            Phrase::Bas { command, value } => self.bas(command, *value),
            Phrase::WaitSec(seconds) if *seconds >= 0.0 => {
                Effect::Command(Command::Wait(Duration::s(*seconds)))
            }
            Phrase::WaitSec(_) => Effect::expected("a time that is not negative"),
            Phrase::WaitFor(variable) => match variable.index_in("$IN") {
                Some(input) => Effect::Command(Command::AwaitInput(input)),
                None => Effect::Unknown,
            },
            Phrase::Arc(arc) => match self.arc(context, arc) {
                Ok(command) => Effect::Command(command),
                Err(error) => {
                    self.state.position = Position::default();
                    error.into()
                }
            },
            Phrase::Halt => self.halt(),
            Phrase::Other(_) | Phrase::Call { .. } => Effect::Unknown,
            Phrase::Unreadable { expected } => Effect::expected(*expected),
            _ => Effect::expected("an instruction, or `END`"),
        }
    }

    /// A call of the routine that changes the blade, if it is one.
    pub(super) fn call(&mut self, name: &str, arguments: &str) -> Option<Effect> {
        let change = tools::called(self.wanted, name, arguments)?;
        self.changed(self.wanted.cell.tools.at_place(change));
        Some(Effect::Command(Command::ChangeTool(Some(change))))
    }

    /// A stop is a change by hand where the machine is said to have such changes.
    fn halt(&mut self) -> Effect {
        if !tools::are_changed_by_hand(self.wanted) {
            return Effect::Unknown;
        }
        self.changed(None);
        Effect::Command(Command::ChangeTool(None))
    }

    /// Another blade is in: it is not known where its tip is, what the flange carries, or what the routine or
    /// a person has set.
    fn changed(&mut self, tool: Option<ToolId>) {
        self.wanted.tool = tool;
        self.setup = Setup::started();
        self.state.position = Position::default();
    }

    /// What a frame is set to. From that of a tool it follows which one a person has put in.
    fn set(&mut self, role: FrameRole, setting: FrameSetting) -> Effect {
        if role == FrameRole::Tool && self.wanted.tool.is_none() {
            self.wanted.tool = tools::of_frame(self.wanted, &setting);
        }
        Effect::Frame(role, setting)
    }

    fn bas(&mut self, command: &str, value: Option<f64>) -> Effect {
        let mut frame = |role| match value.and_then(whole) {
            Some(number) => self.set(role, FrameSetting::Number(number)),
            None => Effect::Unknown,
        };
        if is_same_name(command, "TOOL") {
            frame(FrameRole::Tool)
        } else if is_same_name(command, "BASE") {
            frame(FrameRole::Base)
        } else if is_same_name(command, "VEL_PTP") {
            self.setup.axis_speed(value, self.wanted)
        } else {
            Effect::Unknown
        }
    }

    fn assign(&mut self, context: Context<'_>, to: &Variable<'_>, value: &Value<'_>) -> Effect {
        if let Some(output) = to.index_in("$OUT") {
            return match value {
                Value::Bool(true) => switch(output, Switch::On),
                Value::Bool(false) => switch(output, Switch::Off),
                Value::Variable(_) => Effect::Unknown,
                _ => Effect::expected("`TRUE` or `FALSE`"),
            };
        }
        if to.is("$TOOL") {
            return self.frame(context, FrameRole::Tool, "TOOL_DATA", value);
        }
        if to.is("$BASE") {
            return self.frame(context, FrameRole::Base, "BASE_DATA", value);
        }
        if let Some(effect) = self.setup.assign(to, value, self.wanted) {
            return effect;
        }
        match self.state.variables.assign(context, to, value) {
            Outcome::Known => Effect::Setting,
            Outcome::Unknown => Effect::Unknown,
        }
    }

    fn frame(&mut self, context: Context<'_>, role: FrameRole, table: &str, value: &Value<'_>) -> Effect {
        if let Value::Variable(variable) = value
            && let Some(number) = variable.index_in(table)
        {
            return self.set(role, FrameSetting::Number(number));
        }
        let value = self.state.variables.value(context, value);
        let values = value.and_then(|value| value.all(Component::TIP).zip(value.all(Component::ANGLES)));
        match values {
            Some(([x, y, z], angles)) => self.set(
                role,
                FrameSetting::Value(Frame {
                    origin: Point3::new(x, y, z),
                    orientation: orientation(angles),
                }),
            ),
            None => Effect::Unknown,
        }
    }

    fn motion(&mut self, context: Context<'_>, motion: &Motion<'_>) -> Result<Command, MotionError> {
        let target = &self
            .state
            .coordinates(context, &motion.target)
            .ok_or(MotionError::Expected("a position that is declared"))?;
        if moves_external_axes(target) {
            return Err(MotionError::Unknown);
        }
        let need = match (motion.points, motion.path) {
            (Points::Absolute, Path::Axes) => Need::Axes,
            (Points::Absolute, Path::Straight) => Need::Straight,
            (Points::Relative, _) => return Err(MotionError::Unknown),
        };
        let is_left = is_left(motion.planner, &motion.tail)?;
        if let Some(missing) = self.setup.missing(need, self.wanted) {
            return Err(MotionError::Expected(missing));
        }
        match need {
            Need::Axes if is_left == Left::Before => Err(MotionError::Unknown),
            Need::Axes if target.has_any(&Component::AXES) => self.axes(target).map(Command::Axes),
            Need::Axes => {
                let configuration = match (target.get(Component::S), target.get(Component::T)) {
                    (Some(status), Some(turn)) => whole(status)
                        .zip(whole(turn))
                        .and_then(|(status, turn)| StatusAndTurn { status, turn }.configuration()),
                    (_, _) => None,
                };
                self.goal(target, configuration).map(Command::AxesToPose)
            }
            Need::Straight | Need::Arc => {
                let end = self.end(is_left)?;
                // The controller takes S and T from where the motion begins.
                let to = self.goal(target, None)?;
                let pace = self.setup.pace();
                Ok(Command::Straight { to, pace, end })
            }
        }
    }

    fn end(&self, is_left: Left) -> Result<End, MotionError> {
        match is_left {
            Left::AtEnd => Ok(End::Exact),
            Left::Before => self.setup.left(self.wanted).map_err(MotionError::Expected),
        }
    }

    /// A motion on an arc. How the blade is held at its auxiliary point, where that is stated, must be how it
    /// gets there.
    fn arc(&mut self, context: Context<'_>, arc: &Arc<'_>) -> Result<Command, MotionError> {
        let coordinates = |target| self.state.coordinates(context, target);
        let [through, target] = [&arc.through, &arc.target].map(coordinates);
        let declared = through.zip(target);
        let (through, target) = declared.ok_or(MotionError::Expected("positions that are declared"))?;
        let is_known = arc.points == Points::Absolute && arc.angle.is_none();
        if !is_known || [through, target].iter().any(moves_external_axes) {
            return Err(MotionError::Unknown);
        }
        if through.has_any(&Component::AXES) {
            return Err(MotionError::Expected("an auxiliary point: X, Y, Z"));
        }
        let is_left = is_left(arc.planner, &arc.tail)?;
        if let Some(missing) = self.setup.missing(Need::Arc, self.wanted) {
            return Err(MotionError::Expected(missing));
        }
        let end = self.end(is_left)?;
        let begin = self.state.position;
        let pose = |position: Position| position.all(Component::TIP).zip(position.all(Component::ANGLES));
        let from = pose(begin).ok_or(INCOMPLETE)?;
        let on_way = begin.at_pose(&through, Points::Absolute, Directions::Base);
        let via = on_way.and_then(|at| at.all(Component::TIP)).ok_or(INCOMPLETE)?;
        let to = self.goal(&target, None)?;
        let states_attitude = through.has_any(&Component::ANGLES);
        if arc.planner == Planner::Spline && !states_attitude {
            return Err(MotionError::Expected("an auxiliary point: X, Y, Z, A, B, C"));
        }
        if states_attitude {
            let held = on_way
                .and_then(|at| at.all(Component::ANGLES))
                .ok_or(INCOMPLETE)?;
            self.holds_on_arc((from, to), via, held)?;
        }
        let on = Circle::Via(Point3::from(via));
        let pace = self.setup.pace();
        Ok(Command::Round { on, to, pace, end })
    }

    /// Whether the blade is held at a point of an arc as it is when it gets there.
    fn holds_on_arc(
        &mut self,
        ((from, angles), to): (([f64; 3], [f64; 3]), Goal),
        via: [f64; 3],
        held: [f64; 3],
    ) -> Result<(), MotionError> {
        let Held::Orientation(end, _) = to.held else {
            return Err(MotionError::Unknown);
        };
        let arc = CircularArc::through([from, via, to.tip.to_array()]);
        let done = arc.map(|arc| arc.done_at(via));
        let done = done.ok_or(MotionError::Expected("three points that do not lie on a line"))?;
        let there = self.orientation(angles).towards(end, done);
        if there.angle_to(self.orientation(held)) <= SAME_ATTITUDE {
            Ok(())
        } else {
            let what = "an auxiliary point where the blade is held as it is on the way there";
            Err(MotionError::Expected(what))
        }
    }

    fn goal(
        &mut self,
        target: &Coordinates,
        configuration: Option<Configuration>,
    ) -> Result<Goal, MotionError> {
        if target.has_any(&Component::AXES) {
            return Err(MotionError::Expected("a pose: X, Y, Z, A, B, C"));
        }
        let after = self.state.position;
        let after = after.at_pose(target, Points::Absolute, Directions::Base);
        let pose = after.and_then(|after| after.all(Component::TIP).zip(after.all(Component::ANGLES)));
        let (after, ([x, y, z], angles)) = after.zip(pose).ok_or(INCOMPLETE)?;
        self.state.position = after;
        Ok(Goal {
            tip: Point3::new(x, y, z),
            held: Held::Orientation(self.orientation(angles), configuration),
        })
    }

    fn orientation(&mut self, angles: [f64; 3]) -> Orientation {
        let known = self.turned.iter().find(|(known, _)| *known == angles);
        if let Some(&(_, orientation)) = known {
            return orientation;
        }
        let orientation = orientation(angles);
        if let Some(place) = self.turned.get_mut(self.oldest) {
            *place = (angles, orientation);
        }
        self.oldest = (self.oldest + 1) % self.turned.len();
        orientation
    }

    fn axes(&mut self, target: &Coordinates) -> Result<AxisValues, MotionError> {
        if target.has_any(&Component::TIP) || target.has_any(&Component::ANGLES) {
            return Err(MotionError::Expected("either a pose or axes"));
        }
        let after = self.state.position.at_axes(target);
        let degrees = after.all(Component::AXES).ok_or(INCOMPLETE)?;
        self.state.position = after;
        Ok(AxisValues(degrees.map(f64::to_radians)))
    }
}

const fn switch(output: u32, state: Switch) -> Effect {
    Effect::Command(Command::Switch { output, state })
}

/// A number that counts something.
fn whole(value: f64) -> Option<u32> {
    let is_whole = (0.0..=f64::from(u32::MAX)).contains(&value) && value.fract() == 0.0;
    is_whole.then_some(value as u32)
}
