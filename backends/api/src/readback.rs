//! Programs read back from their text.
//!
//! What was written is read again by a reader of the same dialect, which knows nothing of what should be there, and compared
//! with the program that it was made from. The same serves for files that people may have edited: the reader
//! reports statement by statement, in the order in which the controller carries them out, what the machine
//! will do.
//!
//! * A [`Reader`] turns text into [`Statement`]s. It is tolerant of layout and strict about meaning: what it does not know is
//!   [`Effect::Unknown`], what it cannot read [`Effect::Unreadable`]; it never guesses and never stops.
//! * [`Comparator`] says what is different between one op and one command, with numbers.
//! * [`Replay`] takes a whole program's statements and finds the first that is not the next op, or a restatement of what holds
//!   already at the beginning of a part.
//! * [`normalized()`] is a statement without its layout: two statements with the same normalized text do the same.

mod comparator;
mod normalize;
mod replay;
mod resolution;
mod signals;
#[cfg(test)]
#[cfg(feature = "testkit")]
mod tests;

pub use comparator::{Comparator, Mismatch, Moment, rotary_way};
pub use normalize::normalized;
pub use replay::{Divergence, DivergenceKind, Replay};
pub use resolution::COARSEST;

use crate::bundle::Bundle;
use crate::geometry::{Frame, Orientation, Point3};
use crate::ir::{AxisValues, Cell, Switch};
use crate::motion::Branch;
use crate::options::Options;
use crate::units::{Angle, AngularSpeed, Duration, Length, Speed};
use core::ops::Range;
use serde::{Deserialize, Serialize};

/// A file of a program.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ProgramFile {
    /// Its name, without folders.
    pub name: String,
    /// Its text.
    pub text: String,
}

/// The files of a bundle. Bytes that are not UTF-8 are taken for Latin-1, which is what controllers write.
#[must_use]
pub fn program_files(bundle: &Bundle) -> Vec<ProgramFile> {
    let files = bundle.files().iter();
    files
        .map(|(name, bytes)| ProgramFile {
            name: name.clone(),
            text: decoded(bytes),
        })
        .collect()
}

/// Text of a file of a controller: UTF-8, or else Latin-1.
#[must_use]
pub fn decoded(bytes: &[u8]) -> String {
    match core::str::from_utf8(bytes) {
        Ok(text) => text.to_owned(),
        Err(_) => bytes.iter().map(|&byte| char::from(byte)).collect(),
    }
}

/// The name of a file without its extension, and the extension, which is empty where there is none.
#[must_use]
pub fn stem(file: &str) -> (&str, &str) {
    file.rsplit_once('.').unwrap_or((file, ""))
}

/// Whether a file has one of these extensions, whatever their case.
#[must_use]
pub fn has_extension(file: &str, known: &[&str]) -> bool {
    let (_, extension) = stem(file);
    known.iter().any(|known| extension.eq_ignore_ascii_case(known))
}

/// What a program is read from, and for whom.
#[derive(Clone, Copy)]
pub struct Sources<'a> {
    /// All files of the program.
    pub files: &'a [ProgramFile],
    /// The machine that it is for.
    pub cell: &'a Cell,
    /// The options of its backend.
    pub options: &'a Options,
}

/// A stretch of bytes in a file of a program.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Place {
    /// Place of the file in [`Sources::files`].
    pub file: u32,
    /// First byte.
    pub start: u32,
    /// One past the last byte.
    pub end: u32,
}

impl Place {
    /// A stretch of bytes of a file; what lies beyond 4 GiB counts as there.
    #[must_use]
    pub fn of(file: usize, bytes: Range<usize>) -> Self {
        let [file, start, end] =
            [file, bytes.start, bytes.end].map(|value| u32::try_from(value).unwrap_or(u32::MAX));
        Self { file, start, end }
    }
}

/// A statement of a program, comments apart.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Statement {
    /// Where it stands.
    pub place: Place,
    /// What it does.
    #[serde(rename = "says")]
    pub effect: Effect,
}

/// What a statement does.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Effect {
    /// The machine does something.
    #[serde(rename = "deed")]
    Command(Command),
    /// A frame is set, which holds for all that follows.
    Frame(FrameRole, FrameSetting),
    /// Something that is known and does nothing by itself, or that other statements have taken into account: a declaration, a
    /// speed, a mode.
    Setting,
    /// A part begins that could be started alone. It sets up everything again, and may restate the machine's state.
    PartBegins,
    /// Nobody knows what.
    Unknown,
    /// It is no statement of the dialect; what would be one stands in the text.
    Unreadable {
        /// What was expected, such as `a number after X`.
        expected: String,
    },
}

impl Effect {
    /// What the machine does by it, if anything.
    #[must_use]
    pub const fn command(&self) -> Option<&Command> {
        match self {
            Self::Command(command) => Some(command),
            Self::Frame(..) | Self::Setting | Self::PartBegins | Self::Unknown | Self::Unreadable { .. } => {
                None
            }
        }
    }

    /// That something else is expected.
    #[must_use]
    pub fn expected(what: impl Into<String>) -> Self {
        let expected = what.into();
        Self::Unreadable { expected }
    }
}

/// Which frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum FrameRole {
    /// The blade seen from the flange ([`Cell::tools`]).
    Tool,
    /// The workpiece seen from the machine's root ([`Cell::base`]).
    Base,
}

/// What a frame is set to.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum FrameSetting {
    /// By value.
    Value(Frame),
    /// By the number under which the controller keeps it.
    Number(u32),
}

/// What the machine does.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Command {
    /// All axes go to these values, arriving together.
    Axes(AxisValues),
    /// All axes go to the values at a pose, arriving together.
    AxesToPose(Target),
    /// The tip goes straight to a pose (or stays where it is, while the blade turns).
    Straight {
        /// Where it ends.
        to: Target,
        /// How fast.
        pace: Pace,
        /// How it ends.
        end: End,
    },
    /// The tip goes on an arc to a pose.
    Round {
        /// Which arc.
        on: Circle,
        /// Where it ends.
        to: Target,
        /// How fast.
        pace: Pace,
        /// How it ends.
        end: End,
    },
    /// A digital output is switched.
    Switch {
        /// Its number.
        output: u32,
        /// To what.
        state: Switch,
    },
    /// The control's own spindle turns at this speed, or stands where there is none.
    Spin(Option<AngularSpeed>),
    /// Waits until a digital input is high.
    AwaitInput(u32),
    /// Waits.
    Wait(Duration),
    /// Another blade is put in: from this place, or by hand where there is none.
    ChangeTool(Option<u32>),
}

impl Command {
    /// Whether it moves the machine.
    #[must_use]
    pub const fn is_motion(&self) -> bool {
        match self {
            Self::Axes(_) | Self::AxesToPose(_) | Self::Straight { .. } | Self::Round { .. } => true,
            Self::Switch { .. }
            | Self::Spin(_)
            | Self::AwaitInput(_)
            | Self::Wait(_)
            | Self::ChangeTool(_) => false,
        }
    }
}

/// The arc from where the tip is to where it goes, as dialects state it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Circle {
    /// By a point between its ends.
    Via(Point3),
    /// By its centre, and the axis about which it goes by the rule of the right hand.
    About {
        /// Its centre.
        centre: Point3,
        /// The direction of the axis.
        axis: Point3,
    },
}

/// A pose as dialects say it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Target {
    /// Where the tip is, in W.
    pub tip: Point3,
    /// How the blade is held.
    pub held: Held,
}

/// How the blade is held.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Held {
    /// By the orientation of T in W, and the way to stand where that is said.
    Orientation(Orientation, Option<Configuration>),
    /// By the positions of the machine's rotary axes, at their places among its axes; linear axes hold 0.
    Rotary(AxisValues),
}

/// A way to stand in the numbers of a dialect: KRL's status and turn, RAPID's confdata. What they mean is the dialect's
/// affair; equal numbers are the same way.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(transparent)]
pub struct Configuration(pub [i32; 4]);

/// How fast a motion goes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Pace {
    /// Speed of the tip and rate of turning, whichever takes longer.
    Speeds {
        /// Of the tip.
        tip: Option<Speed>,
        /// Of the blade.
        turn: Option<AngularSpeed>,
    },
    /// Speed of the tip and rates of swivel and twist ([`crate::swivel`]), whichever takes longest. They are rounded down. On an arc the
    /// speed of the tip alone has to be slow enough: a controller that turns the blade with its way may not limit that turn.
    Apart {
        /// Of the tip.
        tip: Option<Speed>,
        /// Of the swivel of the tool's direction.
        swivel: Option<AngularSpeed>,
        /// Of the twist about it.
        twist: Option<AngularSpeed>,
    },
    /// Speed of the tip alone decides.
    Tip(Speed),
    /// The motion takes a minute divided by this.
    PerMinute(f64),
    /// Rate of the rotary axes, as the root of the sum of their squares.
    Rotary(AngularSpeed),
}

/// How a motion ends.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum End {
    /// At a standstill on the point.
    Exact,
    /// Without a stop where the next motion continues in the same direction, the tip never further off the two ways than this.
    Through {
        /// How far.
        within: Length,
    },
    /// Somewhere near it, on the way to the next.
    Rounded,
}

/// How far what a dialect prints may be from what it was given: half a unit of the last place.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Resolution {
    /// Of each coordinate and of each linear axis.
    pub length: Length,
    /// Of an orientation: the largest angle by which it can be turned.
    pub attitude: Angle,
    /// Of each rotary axis.
    pub axis: Angle,
    /// Of speeds of the tip.
    pub speed: Speed,
    /// Of rates of turning.
    pub rate: AngularSpeed,
    /// Of inverse times, in 1/min.
    pub per_minute: f64,
    /// Of waits.
    pub time: Duration,
}

/// Whether a dialect's programs set a frame or leave it to who sets up the machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Frames {
    /// Every part sets tool and base before its first motion.
    InProgram,
    /// The operator does.
    OnMachine,
}

/// Reads a dialect.
pub trait Reader: Sync {
    /// Whether a file of this name looks like one of the dialect's, by its extension.
    fn recognises(&self, file: &str) -> bool;

    /// How finely programs with these options are printed.
    fn resolution(&self, options: &Options) -> Resolution;

    /// Who sets tool and base.
    fn frames(&self) -> Frames;

    /// How the dialect says the way to stand on a branch with the axes there; none where it does not say it.
    fn configuration(&self, branch: Branch, axes: AxisValues) -> Option<Configuration>;

    /// Whether its programs name the waypoints of ops ([`crate::motion::Motion::waypoints`]), so that one that is missing is
    /// a difference.
    fn states_waypoints(&self) -> bool {
        false
    }

    /// Reports the statements of a program in the order in which they are carried out. A statement that is
    /// never carried out is reported as [`Effect::Setting`] or [`Effect::Unknown`] where it stands.
    ///
    /// Bounded in time and memory on any text.
    fn read(&self, sources: Sources<'_>, visit: &mut dyn FnMut(Statement));
}
