//! The intermediate program: what the machine does, op by op. See the crate documentation for its meaning.
//!
//! The serde form is the exchange format (`--emit ir`); its schema is committed as `docs/schema/ir.json`. A change
//! that old readers would misread raises [`IR_VERSION`].

mod blade;
mod cut_kind;
mod op;
mod tools;

pub use blade::{Blade, BodyStage, Crusher, Disc, Edges, Extent, Shape, Spindle, Stage, Straight};
pub use cut_kind::CutKind;
pub use op::{Action, ActionKind, Flank, Joint, Op, Site, Switch};
pub use tools::{Change, Changer, NoTools, Tool, ToolId, Tools};

use crate::geometry::{Frame, Orientation, Point3};
use crate::units::{AngularSpeed, Duration, Length, Mass, Speed};
use core::num::NonZeroU32;
use serde::{Deserialize, Serialize};
use std::borrow::Cow;

/// Version of the exchange form that this crate reads and writes.
pub const IR_VERSION: u32 = 3;

/// A whole program.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Program {
    /// Version of this form, [`IR_VERSION`].
    pub version: u32,
    /// The job's name as written by the user; that of an air cut ends in [`AIR_ENDING`].
    pub name: String,
    /// What it is for.
    #[serde(default, skip_serializing_if = "Purpose::is_work")]
    pub purpose: Purpose,
    /// What people are to read at its head and no op says. Nothing that moves depends on it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub head: Option<Head>,
    /// The stock the program works on.
    pub stock: Stock,
    /// The machine, when the job names one. Without it the program can be checked and shown, not emitted.
    pub cell: Option<Cell>,
    /// The blades in the order in which the operations first cut with them. The program begins with the first one at hand.
    pub blades: Vec<Blade>,
    /// What the ops belong to, in order of work.
    pub operations: Vec<Operation>,
    /// Orientations of T in W that the ops refer to.
    pub orientations: Vec<Orientation>,
    /// Tip speeds that the ops refer to.
    pub feeds: Vec<Speed>,
    /// Reorientation rates that the ops refer to.
    pub rates: Vec<AngularSpeed>,
    /// Points in W by which the ops know their arcs.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub vias: Vec<Point3>,
    /// How far, at most, the tip may leave the pieces of a chain where one continues into the next. Zero where every piece is to be
    /// followed exactly.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub blend: Length,
    /// The ops in the order they are carried out. An op's place in this list is its [`OpId`].
    pub ops: Vec<Op>,
}

/// What the name of an air cut ends in.
pub const AIR_ENDING: &str = "_air";

/// What a program is for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Purpose {
    /// It cuts.
    #[default]
    Work,
    /// A first run above the stock: the ops of a program that cuts, lifted in W, the generator off all the time. Its cuts meet
    /// nothing.
    AirCut {
        /// By how much all tips are lifted.
        lift: Length,
    },
}

impl Program {
    /// An op by its number.
    #[must_use]
    pub fn op(&self, id: OpId) -> Option<&Op> {
        self.ops.get(id.0 as usize)
    }

    /// An operation by its number.
    #[must_use]
    pub fn operation(&self, id: OperationId) -> Option<&Operation> {
        self.operations.get(usize::from(id.0))
    }

    /// A blade by its number.
    #[must_use]
    pub fn blade(&self, id: ToolId) -> Option<&Blade> {
        self.blades.get(usize::from(id.0))
    }

    /// The longest edge of its straight blades.
    #[must_use]
    pub fn longest_edge(&self) -> Length {
        let blades = self.blades.iter().filter_map(Blade::straight);
        blades
            .map(|blade| blade.cutting_length)
            .fold(Length::ZERO, Length::max)
    }

    /// The blades that an operation cuts with.
    pub fn blades_of(&self, operation: OperationId) -> impl Iterator<Item = &Blade> {
        let tools = self
            .operation(operation)
            .into_iter()
            .flat_map(|operation| &operation.tools);
        tools.filter_map(|&tool| self.blade(tool))
    }

    /// An orientation by its number.
    #[must_use]
    pub fn orientation(&self, id: OrientationId) -> Option<Orientation> {
        self.orientations.get(id.0 as usize).copied()
    }

    /// A tip speed by its number.
    #[must_use]
    pub fn feed(&self, id: FeedId) -> Option<Speed> {
        self.feeds.get(usize::from(id.0)).copied()
    }

    /// A point of an arc by its number.
    #[must_use]
    pub fn via(&self, ViaId(number): ViaId) -> Option<Point3> {
        self.vias.get(number.get() as usize - 1).copied()
    }

    /// A reorientation rate by its number.
    #[must_use]
    pub fn rate(&self, id: RateId) -> Option<AngularSpeed> {
        self.rates.get(usize::from(id.0)).copied()
    }
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde passes references")]
fn is_zero(length: &Length) -> bool {
    *length == Length::ZERO
}

impl Purpose {
    /// Whether the program cuts.
    #[must_use]
    pub const fn is_work(&self) -> bool {
        match self {
            Self::Work => true,
            Self::AirCut { .. } => false,
        }
    }
}

/// What people are to read at the head of a program and no op says.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Head {
    /// Hash of what the program was made from: 64 hexadecimal digits. Equal hashes mean equal jobs.
    pub job: String,
    /// How long it takes, as planned.
    pub time: Duration,
}

/// The stock box, with one corner at the origin of W.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Stock {
    /// Along x, across the cuts.
    pub width: Length,
    /// Along y, along the cuts.
    pub depth: Length,
    /// Along z.
    pub height: Length,
}

/// The machine as far as a program needs it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Cell {
    /// The name the job gives it.
    pub name: String,
    /// What it is.
    pub kind: MachineKind,
    /// Who made its controller.
    pub maker: Maker,
    /// Model as written in the job, such as `kuka/kr210_r3100_ultra`.
    pub model: String,
    /// Its axes in the controller's order; at most [`MOST_AXES`].
    pub axes: Vec<Axis>,
    /// How the machine holds each of the program's blades, in their order.
    pub tools: Tools,
    /// Workpiece frame W seen from the machine's root.
    pub base: PlacedFrame,
    /// Where the axes are when the program starts and ends, when the job states it.
    pub home: Option<AxisValues>,
    /// How blades are changed, when the job states it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub change: Option<Change>,
    /// Digital output that runs the ultrasonic generator.
    pub ultrasonic: Option<u32>,
    /// What spins the blades that spin, when the job states it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spindle: Option<Spindle>,
    /// How the program knows that the blade vibrates and spins.
    pub ready: Ready,
}

/// Kinds of machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum MachineKind {
    /// An articulated arm with six axes.
    Robot,
    /// Three linear axes and two or three rotary ones.
    FiveAxis,
}

/// Who made a machine's controller, as far as dialects care.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Maker {
    /// ABB.
    Abb,
    /// KUKA.
    Kuka,
    /// Anyone else, or not stated.
    Other,
}

/// Most axes that a machine has.
pub const MOST_AXES: usize = 6;

/// Positions of a machine's axes in their order, as its controller counts them: rad for rotary axes, mm for linear ones.
/// Places beyond the machine's axes hold 0.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(transparent)]
pub struct AxisValues(pub [f64; MOST_AXES]);

/// One axis of a machine.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Axis {
    /// Its name on the controller, such as `A1` or `X`.
    pub name: String,
    /// How it moves, which also determines the unit of the numbers below: rad or mm, and a second.
    pub kind: AxisKind,
    /// Smallest position.
    pub min: f64,
    /// Largest position.
    pub max: f64,
    /// Highest rate, when known.
    pub rate: Option<f64>,
    /// Highest acceleration, when known.
    pub acceleration: Option<f64>,
    /// Highest jerk, when known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub jerk: Option<f64>,
}

/// How an axis moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum AxisKind {
    /// It turns.
    Rotary,
    /// It slides.
    Linear,
}

/// A calibrated frame: its values, and the number under which the controller keeps it when the program is to take it from
/// there. The values are always known, for without them nobody could say whether a pose is within reach.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PlacedFrame {
    /// The values.
    pub frame: Frame,
    /// Number in the controller's own table, counted from 1.
    pub number: Option<u32>,
}

/// Data given as values, or by the number under which the controller keeps it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Registered<T> {
    /// The values themselves.
    Value(T),
    /// A number in the controller's own table, counted from 1.
    Number(u32),
}

/// What the flange carries.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Load {
    /// Mass.
    pub mass: Mass,
    /// Centre of mass seen from the flange, in mm.
    pub centre: Point3,
    /// How hard it is to turn; none of a load that counts as a point.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub inertia: Option<Inertia>,
}

/// The moments of inertia of a load about its centre of mass, along the axes of the flange, in kg m2.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Inertia {
    /// About x.
    pub x: f64,
    /// About y.
    pub y: f64,
    /// About z.
    pub z: f64,
}

impl Inertia {
    /// That of a point.
    pub const POINT: Self = Self {
        x: 0.0,
        y: 0.0,
        z: 0.0,
    };

    /// About x, y and z.
    #[must_use]
    pub const fn to_array(self) -> [f64; 3] {
        [self.x, self.y, self.z]
    }

    /// Whether a body can have it: none of the moments is greater than the two others together.
    #[must_use]
    pub fn is_possible(self) -> bool {
        let [x, y, z] = self.to_array();
        let half = (x + y + z) / 2.0;
        half.is_finite() && [x, y, z].iter().all(|moment| (0.0..=half).contains(moment))
    }
}

/// How a program knows that generator and spindle are up before the blade enters.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Ready {
    /// A digital input goes high.
    Input(u32),
    /// Time enough has passed.
    After(Duration),
}

/// One operation of the job, in the user's words.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Operation {
    /// What is done.
    pub kind: OperationKind,
    /// The blades that do it, by their places in [`Program::blades`]: at least one, in the order in which it takes them.
    pub tools: Vec<ToolId>,
    /// Where the job says so.
    pub source: SourceRef,
    /// How far its tips are offset at most against what forces do to its blades, in mm; none where they are not.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub compensation: Option<Length>,
    /// Holes that are open before it, into which its crusher may go straight down.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub openings: Vec<Opening>,
}

/// A round hole in the stock, upright and open from the top down.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Opening {
    /// The middle of its ground, in W.
    pub ground: Point3,
    /// Its radius.
    pub radius: Length,
}

impl Opening {
    /// Whether a round tool of this radius, upright with its tip there, lies within it.
    #[must_use]
    pub fn holds(&self, tip: Point3, radius: Length) -> bool {
        let away = libm::hypot(tip.x - self.ground.x, tip.y - self.ground.y);
        away + radius.to_mm() <= self.radius.to_mm() + WITHIN && tip.z >= self.ground.z - WITHIN
    }
}

/// How far a tool may be beyond an opening by rounding, in mm: a nanometre.
const WITHIN: f64 = 1e-6;

/// A kind of operation: the words of its head in the language, joined by `_`, such as `rough_vcut`. Programs name the kind for
/// people; what their ops mean does not depend on it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(try_from = "String", into = "String")]
pub struct OperationKind(
    #[cfg_attr(feature = "schema", schemars(regex(pattern = "^[a-z]+(_[a-z]+)*$")))] Cow<'static, str>,
);

/// A text that is not the name of a kind of operation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NotAKind;

impl core::fmt::Display for NotAKind {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str("a kind of operation is words of small letters, joined by `_`")
    }
}

impl TryFrom<String> for OperationKind {
    type Error = NotAKind;

    fn try_from(name: String) -> Result<Self, NotAKind> {
        let is_kind = is_name_of_kind(name.as_bytes());
        if is_kind {
            Ok(Self(Cow::Owned(name)))
        } else {
            Err(NotAKind)
        }
    }
}

impl From<OperationKind> for String {
    fn from(OperationKind(name): OperationKind) -> Self {
        name.into_owned()
    }
}

impl OperationKind {
    /// The kind of that name, such as `rough_vcut`; none where it is not one.
    #[must_use]
    pub const fn named(name: &'static str) -> Option<Self> {
        if is_name_of_kind(name.as_bytes()) {
            Some(Self(Cow::Borrowed(name)))
        } else {
            None
        }
    }

    /// Its head in the language: `rough vcut`.
    #[must_use]
    pub fn head(&self) -> String {
        self.0.replace('_', " ")
    }
}

/// Whether a text consists of words of small letters, joined by `_`, and no longer than a line of a program
/// takes.
const fn is_name_of_kind(name: &[u8]) -> bool {
    let mut index = 0;
    let mut is_in_word = false;
    while index < name.len() {
        match name[index] {
            b'a'..=b'z' => is_in_word = true,
            b'_' if is_in_word => is_in_word = false,
            _ => return false,
        }
        index += 1;
    }
    is_in_word && name.len() <= 40
}

/// A place in the job's source text, in bytes.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct SourceRef {
    /// The file, as it was named to the compiler.
    pub file: String,
    /// First byte.
    pub start: u32,
    /// One past the last byte.
    pub end: u32,
}

/// Number of an op: its place in [`Program::ops`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(transparent)]
pub struct OpId(pub u32);

/// Place in [`Program::operations`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(transparent)]
pub struct OperationId(pub u16);

/// Place in [`Program::orientations`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(transparent)]
pub struct OrientationId(pub u32);

/// Place in [`Program::feeds`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(transparent)]
pub struct FeedId(pub u16);

/// Place in [`Program::rates`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(transparent)]
pub struct RateId(pub u16);

/// Number of a point in [`Program::vias`], counted from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(transparent)]
pub struct ViaId(pub NonZeroU32);
