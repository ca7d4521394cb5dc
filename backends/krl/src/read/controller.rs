//! What single instructions do.

use super::setup::{Need, Setup, Wanted};
use super::types::{
    Approximation, Component, Coordinates, Motion, MotionWord, Phrase, Target, Value, Variable, is_same_name,
};
use super::variables::{Asker, Outcome, Variables};
use crate::configuration::Configuration;
use vcutc_backend_api::geometry::{Frame, Orientation, Point3, Zyx};
use vcutc_backend_api::ir::{AxisValues, Switch};
use vcutc_backend_api::readback::{Deed, End, FrameRole, FrameSetting, Held, Says, Stance, Target as Goal};
use vcutc_backend_api::units::{Angle, Duration};

/// The state that instructions change.
pub(super) struct Controller<'a> {
    wanted: Wanted<'a>,
    setup: Setup,
    pub(super) variables: Variables,
    /// What the last target said, and the ones before it where it left something out.
    last: Coordinates,
    /// The angles A, B, C of some of the last targets, and what they are: most moves keep them, or change between two.
    turned: [([f64; 3], Orientation); 4],
    /// Which of them is the oldest.
    oldest: usize,
}

/// Why a motion is not told as a deed.
enum MotionError {
    Unknown,
    Expected(&'static str),
}

impl From<MotionError> for Says {
    fn from(error: MotionError) -> Self {
        match error {
            MotionError::Unknown => Self::Unknown,
            MotionError::Expected(what) => Says::expected(what),
        }
    }
}

impl<'a> Controller<'a> {
    pub(super) fn new(wanted: Wanted<'a>) -> Self {
        Self {
            wanted,
            setup: Setup::default(),
            variables: Variables::default(),
            last: Coordinates::default(),
            turned: [([0.0; 3], Orientation::IDENTITY); 4],
            oldest: 0,
        }
    }

    /// `BAS (#INITMOV,0 )` at the head of a routine, which may have been started alone.
    pub(super) fn begin(&mut self) {
        self.setup = Setup::started();
        self.last = Coordinates::default();
    }

    /// What an instruction does.
    pub(super) fn carry_out(&mut self, asker: Asker<'_>, phrase: &Phrase<'_>) -> Says {
        match phrase {
            Phrase::Motion(motion) => match self.motion(asker, motion) {
                Ok(deed) => Says::Deed(deed),
                Err(error) => {
                    // Nobody knows where it leads, so nobody knows what later targets leave out.
                    self.last = Coordinates::default();
                    error.into()
                }
            },
            Phrase::Assignment { to, value } => self.assign(asker, to, value),
            Phrase::Bas { command, value } => self.bas(command, *value),
            Phrase::WaitSec(seconds) if *seconds >= 0.0 => Says::Deed(Deed::Wait(Duration::s(*seconds))),
            Phrase::WaitSec(_) => Says::expected("a time that is not negative"),
            Phrase::WaitFor(variable) => match variable.index_in("$IN") {
                Some(input) => Says::Deed(Deed::AwaitInput(input)),
                None => Says::Unknown,
            },
            Phrase::Arc(_) => {
                self.last = Coordinates::default();
                Says::Unknown
            }
            Phrase::Halt | Phrase::Other(_) | Phrase::Call { .. } => Says::Unknown,
            Phrase::Unreadable { expected } => Says::expected(*expected),
            Phrase::Mark(_)
            | Phrase::Def { .. }
            | Phrase::End
            | Phrase::DefDat { .. }
            | Phrase::EndDat
            | Phrase::Ext { .. }
            | Phrase::Declaration(_) => Says::expected("an instruction, or `END`"),
        }
    }

    fn bas(&mut self, command: &str, value: Option<f64>) -> Says {
        let frame = |role| match value.and_then(whole) {
            Some(number) => Says::Frame(role, FrameSetting::Number(number)),
            None => Says::Unknown,
        };
        if is_same_name(command, "TOOL") {
            frame(FrameRole::Tool)
        } else if is_same_name(command, "BASE") {
            frame(FrameRole::Base)
        } else if is_same_name(command, "VEL_PTP") {
            self.setup.axis_speed(value, self.wanted)
        } else {
            Says::Unknown
        }
    }

    fn assign(&mut self, asker: Asker<'_>, to: &Variable<'_>, value: &Value<'_>) -> Says {
        if let Some(output) = to.index_in("$OUT") {
            return match value {
                Value::Bool(true) => switch(output, Switch::On),
                Value::Bool(false) => switch(output, Switch::Off),
                Value::Variable(_) => Says::Unknown,
                Value::Number(_)
                | Value::Enum(_)
                | Value::Text(_)
                | Value::Coordinates(_)
                | Value::Structure(_) => Says::expected("`TRUE` or `FALSE`"),
            };
        }
        if to.is("$TOOL") {
            return self.frame(asker, FrameRole::Tool, "TOOL_DATA", value);
        }
        if to.is("$BASE") {
            return self.frame(asker, FrameRole::Base, "BASE_DATA", value);
        }
        if let Some(says) = self.setup.assign(to, value, self.wanted) {
            return says;
        }
        match self.variables.assign(asker, to, value) {
            Outcome::Known => Says::Setting,
            Outcome::Unknown => Says::Unknown,
        }
    }

    fn frame(&mut self, asker: Asker<'_>, role: FrameRole, table: &str, value: &Value<'_>) -> Says {
        if let Value::Variable(variable) = value
            && let Some(number) = variable.index_in(table)
        {
            return Says::Frame(role, FrameSetting::Number(number));
        }
        let value = self.variables.value(asker, value);
        let values = value.and_then(|value| value.all(Component::TIP).zip(value.all(Component::ANGLES)));
        match values {
            Some(([x, y, z], angles)) => Says::Frame(
                role,
                FrameSetting::Value(Frame {
                    origin: Point3::new(x, y, z),
                    orientation: orientation(angles),
                }),
            ),
            None => Says::Unknown,
        }
    }

    fn motion(&mut self, asker: Asker<'_>, motion: &Motion<'_>) -> Result<Deed, MotionError> {
        let named;
        let target = match &motion.target {
            Target::Literal(coordinates) => coordinates,
            Target::Variable(variable) => {
                let known = self.variables.get(asker, variable);
                named = known.ok_or(MotionError::Expected("a position that is declared"))?;
                &named
            }
        };
        let external = Component::EXTERNAL.into_iter();
        let mut external = external.filter_map(|component| target.get(component));
        if external.any(|value| value != 0.0) {
            return Err(MotionError::Unknown);
        }
        let tail = &motion.tail;
        if tail.second.is_some() || tail.directions.is_some() || !tail.with.is_empty() {
            return Err(MotionError::Unknown);
        }
        let (need, end) = match (motion.word, tail.approximation) {
            (MotionWord::Ptp | MotionWord::Sptp, None) => (Need::Axes, End::Exact),
            (MotionWord::Lin | MotionWord::Slin, None) => (Need::Straight, End::Exact),
            (MotionWord::Lin, Some(Approximation::Distance))
            | (MotionWord::Slin, Some(Approximation::Spline)) => (Need::Rounded, End::Rounded),
            (
                MotionWord::Ptp
                | MotionWord::Sptp
                | MotionWord::Lin
                | MotionWord::Slin
                | MotionWord::PtpRel
                | MotionWord::LinRel
                | MotionWord::SptpRel
                | MotionWord::SlinRel,
                _,
            ) => return Err(MotionError::Unknown),
        };
        if let Some(missing) = self.setup.missing(need, self.wanted) {
            return Err(MotionError::Expected(missing));
        }
        match need {
            Need::Axes if target.has_any(&Component::AXES) => self.axes(target).map(Deed::Axes),
            Need::Axes => {
                let stance = match (target.get(Component::S), target.get(Component::T)) {
                    (Some(status), Some(turn)) => whole(status)
                        .zip(whole(turn))
                        .and_then(|(status, turn)| Configuration { status, turn }.stance()),
                    (_, _) => None,
                };
                self.goal(target, stance).map(Deed::AxesToPose)
            }
            Need::Straight | Need::Rounded => {
                // The controller takes S and T from where the motion begins.
                let to = self.goal(target, None)?;
                let pace = self.setup.pace();
                Ok(Deed::Straight { to, pace, end })
            }
        }
    }

    fn goal(&mut self, target: &Coordinates, stance: Option<Stance>) -> Result<Goal, MotionError> {
        if target.has_any(&Component::AXES) {
            return Err(MotionError::Expected("a pose: X, Y, Z, A, B, C"));
        }
        let [x, y, z] = self.complete(target, Component::TIP)?;
        let angles = self.complete(target, Component::ANGLES)?;
        let orientation = self.orientation(angles);
        self.last.forget();
        self.remember(Component::TIP, [x, y, z]);
        self.remember(Component::ANGLES, angles);
        Ok(Goal {
            tip: Point3::new(x, y, z),
            held: Held::Orientation(orientation, stance),
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
        let degrees = self.complete(target, Component::AXES)?;
        self.last.forget();
        self.remember(Component::AXES, degrees);
        Ok(AxisValues(degrees.map(f64::to_radians)))
    }

    /// Components, with those of the last target where this one leaves some out.
    fn complete<const N: usize>(
        &self,
        target: &Coordinates,
        components: [Component; N],
    ) -> Result<[f64; N], MotionError> {
        let mut values = [0.0; N];
        for (value, component) in values.iter_mut().zip(components) {
            let given = target.get(component).or_else(|| self.last.get(component));
            *value = given.ok_or(MotionError::Expected(
                "all components, where no target before it has them",
            ))?;
        }
        Ok(values)
    }

    fn remember<const N: usize>(&mut self, components: [Component; N], values: [f64; N]) {
        for (component, value) in components.into_iter().zip(values) {
            self.last.set(component, value);
        }
    }
}

const fn switch(output: u32, state: Switch) -> Says {
    Says::Deed(Deed::Switch { output, state })
}

/// `R = Rz(A) Ry(B) Rx(C)`, from degrees.
fn orientation([a, b, c]: [f64; 3]) -> Orientation {
    Orientation::from_zyx(Zyx {
        a: Angle::deg(a),
        b: Angle::deg(b),
        c: Angle::deg(c),
    })
}

/// A number that counts something.
fn whole(value: f64) -> Option<u32> {
    let is_whole = (0.0..=f64::from(u32::MAX)).contains(&value) && value.fract() == 0.0;
    is_whole.then_some(value as u32)
}
