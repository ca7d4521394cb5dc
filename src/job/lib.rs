//! The checked job: what a job means, with all names, units and files resolved, and `auto` still open.
//!
//! Every value that a later stage may have to complain about knows where it was written. What an operation is, at every
//! stage, [`operation`] says; the operations themselves lie in `src/operations`.

mod blades;
pub mod description;
pub mod follow;
pub mod forces;
pub mod operation;
mod places;
mod regions;
pub mod sema;
pub mod setup;
mod tools;
pub mod ways;

pub use blades::{Blade, BladeKind, BladeRef, Body, BodyStage, Crusher, Disc, StraightBlade};
pub use operation::planned::{self, PlannedJob, PlannedOperation};
pub use operation::planning::PlanningJob;
pub use operation::{Operation, search};
pub use regions::{Hole, NamedRegion, SoundField, Sources};
pub use sema::families::Candidate;
pub use sema::part::{Part, Shaded};
pub use setup::Setup;
pub use tools::{HeldChange, HeldTool, HeldTools};

use search::SearchEffort;
use std::sync::Arc;
use vcutc_backend_api::ir::{AxisKind, AxisValues, MachineKind, PlacedFrame, Ready, Spindle, Stock};
use vcutc_backend_api::profile::Profile as Habits;
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::source::{Span, Spanned};
use vcutc_machine::{LimitPlaces, Model};

/// A value and where it was written; `None` when it is a default.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sourced<T> {
    pub value: T,
    /// Where the value is (not the field's name).
    pub span: Option<Span>,
}

/// A value that may be left to the compiler.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Auto<T> {
    /// `auto`.
    Auto,
    Given(T),
}

impl<T> Auto<T> {
    /// What is given, or this.
    pub fn or(self, otherwise: T) -> T {
        match self {
            Self::Auto => otherwise,
            Self::Given(value) => value,
        }
    }
}

/// A job without contradictions in itself. Whether it can be cut is for the planner to say.
#[derive(Clone, Debug, PartialEq)]
pub struct CheckedJob {
    /// The job's name.
    pub name: String,
    pub name_span: Span,
    pub stock: Stock,
    /// Where the stock's size is.
    pub stock_span: Span,
    /// From wall to wall of the core's cells, where the job states it.
    pub cell_size: Option<Sourced<Length>>,
    /// The part, spanning the stock from side to side and lying within it.
    pub part: Part,
    pub profile_span: Span,
    /// What to do, in order; at least one.
    pub operations: Vec<Box<dyn Operation>>,
    /// Which of the operations may be done otherwise: each stands here in its first way.
    pub open: Vec<ways::OpenChoice>,
    /// How all cuts may follow the part, in the order in which that is tried, where the job leaves it open. The operations stand here with
    /// level cuts then.
    pub families: Vec<Candidate>,
    /// How hard the best of what it leaves open is searched for.
    pub effort: SearchEffort,
    /// On what: the one that `cell` names, else the one in the job's own file, else the only one there is.
    pub machine: Option<Machine>,
}

/// Bounds of a value from below and above. Not crossed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds<T> {
    /// The value is at least that.
    pub least: Option<Sourced<T>>,
    /// The value is at most that.
    pub most: Option<Sourced<T>>,
}

impl<T: Copy + PartialOrd> Bounds<T> {
    /// Whether a value keeps them.
    #[must_use]
    pub fn hold(self, value: T) -> bool {
        self.least.is_none_or(|least| value >= least.value)
            && self.most.is_none_or(|most| value <= most.value)
    }
}

impl<T> Default for Bounds<T> {
    fn default() -> Self {
        Self {
            least: None,
            most: None,
        }
    }
}

/// Order of the flanks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Order {
    /// Both flanks of a V, then the next V [Cui 2020].
    Point,
    /// All left flanks of a layer, then all its right flanks [Yu 2019].
    Layer,
}

impl Order {
    /// The one that this one is not.
    #[must_use]
    pub const fn other(self) -> Self {
        match self {
            Self::Point => Self::Layer,
            Self::Layer => Self::Point,
        }
    }
}

/// Direction of the cuts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// To and fro. A single-edged blade is turned half round in between.
    Alternate,
    /// Always towards +y, with a way back through the air.
    Forward,
    /// Always towards -y, with a way back through the air.
    Backward,
}

/// The machine as the job states it.
#[derive(Clone, Debug, PartialEq)]
pub struct Machine {
    pub name: String,
    pub head_span: Span,
    /// What it is: its axes and how they move it.
    pub model: Arc<Model>,
    /// Where the model's name is.
    pub model_span: Span,
    /// Where the file of the machine states the limits of its axes; empty for machines of the catalogue.
    pub limit_spans: Vec<LimitPlaces>,
    /// How it holds the blades.
    pub tools: HeldTools,
    /// Workpiece frame seen from the machine's root.
    pub base: Sourced<PlacedFrame>,
    /// Where the axes are at home.
    pub home: Option<Sourced<AxisValues>>,
    /// How blades are changed.
    pub change: Option<HeldChange>,
    /// Output that runs the generator.
    pub ultrasonic: Option<Sourced<u32>>,
    /// Output that runs the drive of blades that spin. Without it a five-axis machine has its control's own spindle, and a robot
    /// none.
    pub spindle: Option<Sourced<u32>>,
    /// How readiness is known. Default: 0.5 s after switching on.
    pub ready: Sourced<Ready>,
    /// Whether its control takes out how far its arm sags under its own weight; none where the job does not state it.
    pub gravity: Option<Sourced<Gravity>>,
    /// The share of its drive's torque that an axis may use; all of it where the job does not state it.
    pub torque_limit: Option<Sourced<f64>>,
    /// Options for targets: one for each nested block such as `krl { ... }`.
    pub targets: Vec<TargetOptions>,
}

/// What a control does about the weight of its arm.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Gravity {
    /// It sets the axes so that the tool is where it should be, however the arm sags.
    Compensated,
    /// It leaves the arm to sag.
    Uncompensated,
}

impl Machine {
    /// How many rotary axes it has.
    #[must_use]
    pub fn rotary_axes(&self) -> usize {
        let axes = self.model.axes.iter();
        axes.filter(|axis| axis.kind == AxisKind::Rotary).count()
    }

    /// Whether it can hold the plane of a blade along any way, for which it takes three of them.
    #[must_use]
    pub fn turns_planes(&self) -> bool {
        self.rotary_axes() >= 3
    }

    /// What spins a blade.
    #[must_use]
    pub fn spindle(&self) -> Option<Spindle> {
        match (self.spindle, self.model.kind()) {
            (Some(output), _) => Some(Spindle::Output(output.value)),
            (None, MachineKind::FiveAxis) => Some(Spindle::Own),
            (None, MachineKind::Robot) => None,
        }
    }
}

/// Options of one target, evaluated but not yet compared with what the target takes.
#[derive(Clone, Debug, PartialEq)]
pub struct TargetOptions {
    pub target: String,
    pub span: Span,
    /// Keys and values in the order written.
    pub given: Vec<GivenOption>,
    /// What the file says that `profile` names, and where it is named.
    pub profile: Option<Spanned<Habits>>,
}

#[derive(Clone, Debug, PartialEq)]
pub struct GivenOption {
    pub key: String,
    pub key_span: Span,
    pub value: GivenValue,
    pub value_span: Span,
}

/// The value of an option as given.
#[derive(Clone, Debug, PartialEq)]
pub enum GivenValue {
    /// A pure number.
    Ratio(f64),
    Length(Length),
    /// A text; options of several lines are given as a tuple of texts.
    Texts(Vec<String>),
    /// A bare word.
    Word(String),
    /// The word `default`: as if the option were not given.
    Default,
}

/// What the variants of a choice are called in the language, in one place for the code that reads it and the
/// code that writes about it.
#[macro_export]
macro_rules! words {
    ($($choice:ident { $($variant:ident = $word:literal),+ $(,)? })+) => {
        $(impl $choice {
            /// All of them, with what they are called in the language.
            pub const WORDS: &'static [(&'static str, Self)] = &[$(($word, Self::$variant)),+];

            /// What it is called in the language.
            #[must_use]
            pub const fn word(self) -> &'static str {
                match self {
                    $(Self::$variant => $word),+
                }
            }
        })+
    };
}

words! {
    Order { Point = "point", Layer = "layer" }
    Direction { Alternate = "alternate", Forward = "forward", Backward = "backward" }
}
