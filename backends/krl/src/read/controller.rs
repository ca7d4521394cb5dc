//! What single instructions do.

use super::setup::{Need, Setup, Wanted};
use super::tools;
use crate::configuration::StatusAndTurn;
use crate::interpreter::position::{Position, orientation};
use crate::interpreter::variables::Outcome;
use crate::interpreter::{Context, State};
use crate::syntax::{
    Approximation, Component, Coordinates, Directions, Motion, Path, Phrase, Planner, Points, Value,
    Variable, is_same_name,
};
use vcutc_backend_api::geometry::{Frame, Orientation, Point3};
use vcutc_backend_api::ir::{AxisValues, Switch, ToolId};
use vcutc_backend_api::readback::{
    Command, Configuration, Effect, End, FrameRole, FrameSetting, Held, Target as Goal,
};
use vcutc_backend_api::units::Duration;

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

/// Why a motion is not told as a command.
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
                    // Nobody knows where it leads, so nobody knows what later targets leave out.
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
            Phrase::Arc(_) => {
                self.state.position = Position::default();
                Effect::Unknown
            }
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

    /// Another blade is in: nobody knows where its tip is, what the flange carries, or what the routine or a person has set.
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
        let external = Component::EXTERNAL.into_iter();
        let mut external = external.filter_map(|component| target.get(component));
        if external.any(|value| value != 0.0) {
            return Err(MotionError::Unknown);
        }
        let tail = &motion.tail;
        if tail.second.is_some() || tail.directions.is_some() || !tail.with.is_empty() {
            return Err(MotionError::Unknown);
        }
        let (need, end) = match (motion.points, motion.path, motion.planner, tail.approximation) {
            (Points::Absolute, Path::Axes, _, None) => (Need::Axes, End::Exact),
            (Points::Absolute, Path::Straight, _, None) => (Need::Straight, End::Exact),
            (Points::Absolute, Path::Straight, Planner::Classic, Some(Approximation::Distance))
            | (Points::Absolute, Path::Straight, Planner::Spline, Some(Approximation::Spline)) => {
                (Need::Rounded, End::Rounded)
            }
            (Points::Absolute | Points::Relative, _, _, _) => return Err(MotionError::Unknown),
        };
        if let Some(missing) = self.setup.missing(need, self.wanted) {
            return Err(MotionError::Expected(missing));
        }
        match need {
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
            Need::Straight | Need::Rounded => {
                // The controller takes S and T from where the motion begins.
                let to = self.goal(target, None)?;
                let pace = self.setup.pace();
                Ok(Command::Straight { to, pace, end })
            }
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
