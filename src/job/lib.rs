//! The checked job: what a job means, with all names, units and files resolved, and `auto` still open.
//!
//! Every value that a later stage may have to complain about knows where it was written.

mod places;
#[cfg(any(test, feature = "samples"))]
pub mod samples;
pub mod sema;

use std::sync::Arc;
use vcutc_backend_api::ir::{AxisValues, Edges, Load, PlacedFrame, Ready, Registered, Stock};
use vcutc_backend_api::profile::Profile as Habits;
use vcutc_backend_api::units::{Angle, AngularSpeed, Area, Duration, Length, Speed};
use vcutc_diagnostics::source::{Span, Spanned};
use vcutc_geometry::curve::Point2;
use vcutc_geometry::profile::Profile;
use vcutc_machine::Model;

/// A value and where it was written; `None` when it is a default.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sourced<T> {
    /// The value.
    pub value: T,
    /// Where the value stands (not the field's name).
    pub span: Option<Span>,
}

/// A value that may be left to the compiler.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Auto<T> {
    /// `auto`.
    Auto,
    /// Given.
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
    /// Where the name stands.
    pub name_span: Span,
    /// The stock.
    pub stock: Stock,
    /// Where the stock's size stands.
    pub stock_span: Span,
    /// The part's profile, spanning the stock from side to side and lying within it.
    pub profile: Profile,
    /// Where the profile stands.
    pub profile_span: Span,
    /// What to do, in order; at least one.
    pub operations: Vec<Operation>,
    /// On what: the one that `cell` names, else the one in the job's own file, else the only one there is.
    pub machine: Option<Machine>,
}

impl CheckedJob {
    /// Area of the cross-section above the part (A_C).
    #[must_use]
    pub fn area_to_remove(&self) -> Area {
        let width = self.stock.width.to_mm();
        Area::mm2(width * self.stock.height.to_mm()) - self.profile.area_below(0.0, width)
    }
}

/// One operation.
#[derive(Clone, Debug, PartialEq)]
pub enum Operation {
    /// `rough vcut { ... }`.
    RoughVcut(RoughVcut),
}

/// A straight blade.
#[derive(Clone, Debug, PartialEq)]
pub struct Blade {
    /// Its name.
    pub name: String,
    /// Where it is defined.
    pub span: Span,
    /// Usable edge length from the tip; positive.
    pub cutting_length: Sourced<Length>,
    /// Half the apex angle; at least 0 and below 90 degrees.
    pub half_apex: Sourced<Angle>,
    /// Thickness; zero or more.
    pub thickness: Sourced<Length>,
    /// Which sides cut.
    pub edges: Edges,
}

/// V-shaped roughing. Ranges given here are checked.
#[derive(Clone, Debug, PartialEq)]
pub struct RoughVcut {
    /// Where its head (`rough vcut`) stands: the place for complaints about the operation as a whole.
    pub head_span: Span,
    /// The blade.
    pub blade: Blade,
    /// Where the tips run, in the order in which they are cut; none for a lattice. Where they are given, `lattice`, `layer`
    /// and `step` are what they come nearest to, `residual` and `sequence` have no say, and the swing is given.
    pub tips: Option<Arc<Tips>>,
    /// How tips are laid out.
    pub lattice: Sourced<Auto<Lattice>>,
    /// Angle between tool axis and feed; above 0 to 90 degrees.
    pub rake: Sourced<Angle>,
    /// Half the opening angle of the V; above 0 and below 90 degrees.
    pub swing: Sourced<Auto<Angle>>,
    /// Layer spacing; positive.
    pub layer: Sourced<Auto<Length>>,
    /// Spacing of tips within a layer; positive.
    pub step: Sourced<Auto<Length>>,
    /// Overlap of neighbouring cuts when the step is left open; 0 to below 1.
    pub overlap: Sourced<Auto<f64>>,
    /// What the open parameters are to make least. Default `time`.
    pub objective: Sourced<Objective>,
    /// By which formulas they are chosen. Default `exact`.
    pub formulas: Sourced<Formulas>,
    /// Bounds.
    pub limits: Limits,
    /// Material that must stay on the part, measured along its normal; zero or more. Default 0.
    pub allowance: Sourced<Length>,
    /// What becomes of tips that would cut the part.
    pub residual: Sourced<Auto<Residual>>,
    /// Order of the flanks.
    pub order: Sourced<Auto<Order>>,
    /// Order of the Vs.
    pub sequence: Sourced<Auto<Sequence>>,
    /// Direction of the cuts. Default `alternate`.
    pub direction: Sourced<Direction>,
    /// Cutting speed; positive.
    pub cut_feed: Sourced<Speed>,
    /// Speed through the air; positive.
    pub travel_feed: Sourced<Speed>,
    /// Rate of turning the blade; positive.
    pub reorient_rate: Sourced<AngularSpeed>,
    /// Height of the safe plane above the stock; positive.
    pub clearance: Sourced<Length>,
    /// How far cuts run out beyond the stock; `auto` is the blade's overhang plus `run_out`.
    pub extension: Sourced<Auto<Length>>,
    /// Air between the blade and the stock where it turns; zero or more. Default 2 mm.
    pub run_out: Sourced<Length>,
    /// Distance of the blade's middle plane from the material that stays; `auto` is half the blade's thickness.
    pub standoff: Sourced<Auto<Length>>,
}

/// Tips that a job gives.
#[derive(Clone, Debug, PartialEq)]
pub struct Tips {
    /// The tips in the order in which they are cut, at least one, within the stock.
    pub tips: Vec<Tip>,
    /// Where the word `tips` stands.
    pub span: Span,
}

/// A tip that a job gives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tip {
    /// Where it runs in the x-z plane of the workpiece, in mm.
    pub point: Point2,
    /// Where it is written.
    pub span: Span,
}

/// Bounds on what the planner may choose and on the result.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Limits {
    /// The swing.
    pub swing: Bounds<Angle>,
    /// Layer spacing.
    pub layer: Bounds<Length>,
    /// Spacing of tips within a layer.
    pub step: Bounds<Length>,
    /// Largest height of material left standing: distance of the machined contour from the nearest point of the part.
    pub scallop: Option<Sourced<Length>>,
    /// How `scallop` was chosen, where the job sets no such limit and the compiler chose one; none in a job as written.
    pub chosen: Option<ChosenScallop>,
    /// Longest edge that a cut may use.
    pub edge: Option<Sourced<Length>>,
    /// Longest time of the operation, as planned.
    pub time: Option<Sourced<Duration>>,
    /// Most V-cuts of the operation, as planned; at least 1.
    pub cuts: Option<Sourced<f64>>,
}

/// How a limit on the scallop was chosen for an operation that has none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChosenScallop {
    /// The mean depth of what the operation is to take away, along the part.
    pub depth: Length,
    /// What the limit was taken for.
    pub why: WhyChosen,
}

/// Why a limit on the scallop is the chosen one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WhyChosen {
    /// It is the widest of those tried under which at most a tenth stays of what is to go.
    LittleStays,
    /// It is the widest of those tried; under none of them, however tight, a tenth or less stayed.
    MoreStays,
    /// It is the tightest of those tried that a plan keeps.
    TightestKept,
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

/// What the open parameters of an operation are to make least, within its limits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Objective {
    /// Processing time.
    Time,
    /// Height of material left standing on the part.
    Scallop,
    /// Number of V-cuts.
    Cuts,
    /// Length of edge in the material.
    BladeLoad,
}

/// By which formulas open parameters are chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Formulas {
    /// Those of the paper as printed [Cui 8-14].
    Paper,
    /// The blade's true reach and the lattice's true scallop (`docs/process.md`).
    Exact,
}

/// How tips are laid out [Cui fig. 4].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lattice {
    /// The same x in every layer.
    Orthogonal,
    /// Every other layer shifted by half a step.
    Interlaced,
    /// Every layer on its own, its outer tips on the part's profile.
    Free,
}

/// In which order the Vs of an operation are cut.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sequence {
    /// Layer by layer, each from left to right.
    Rows,
    /// Layer by layer, to and fro.
    Boustrophedon,
    /// Always the nearest one whose chip comes free.
    Nearest,
}

/// What becomes of a tip that would cut the part.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Residual {
    /// It is dropped.
    Discard,
    /// It is raised until it clears the part.
    Lift,
    /// It slides within its layer until it clears the part.
    Shift,
    /// Dropped where the residual stays within the limit, else raised, else moved if its chip does not come free there.
    /// Regular tips whose chips do not come free are raised by the least that frees them.
    Mixed,
}

/// Order of the flanks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Order {
    /// Both flanks of a V, then the next V [Cui 2020].
    Point,
    /// All left flanks of a layer, then all its right flanks [Yu 2019].
    Layer,
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
    /// Its name.
    pub name: String,
    /// Where its head stands.
    pub head_span: Span,
    /// What it is: its axes and how they move it.
    pub model: Arc<Model>,
    /// Where the model's name stands.
    pub model_span: Span,
    /// Blade frame seen from the flange.
    pub tool: Sourced<PlacedFrame>,
    /// Workpiece frame seen from the machine's root.
    pub base: Sourced<PlacedFrame>,
    /// What the flange carries.
    pub load: Option<Sourced<Registered<Load>>>,
    /// Where the axes are at home.
    pub home: Option<Sourced<AxisValues>>,
    /// Output that runs the generator.
    pub ultrasonic: Option<Sourced<u32>>,
    /// How readiness is known. Default: 0.5 s after switching on.
    pub ready: Sourced<Ready>,
    /// Options for targets: one for each nested block such as `krl { ... }`.
    pub targets: Vec<TargetOptions>,
}

/// Options of one target, evaluated but not yet held against what the target takes.
#[derive(Clone, Debug, PartialEq)]
pub struct TargetOptions {
    /// The target's name.
    pub target: String,
    /// Where the name stands.
    pub span: Span,
    /// Keys and values in the order written.
    pub given: Vec<GivenOption>,
    /// What the file says that `profile` names, and where it is named.
    pub profile: Option<Spanned<Habits>>,
}

/// One option as given.
#[derive(Clone, Debug, PartialEq)]
pub struct GivenOption {
    /// Its key.
    pub key: String,
    /// Where the key stands.
    pub key_span: Span,
    /// Its value.
    pub value: GivenValue,
    /// Where the value stands.
    pub value_span: Span,
}

/// The value of an option as given.
#[derive(Clone, Debug, PartialEq)]
pub enum GivenValue {
    /// A pure number.
    Ratio(f64),
    /// A length.
    Length(Length),
    /// A text; options of several lines are given as a tuple of texts.
    Texts(Vec<String>),
    /// A bare word.
    Word(String),
    /// The word `default`: as if the option were not given.
    Default,
}

/// What the variants of a choice are called in the language, in one place for those who read it and those who speak of it.
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
    Lattice { Orthogonal = "orthogonal", Interlaced = "interlaced", Free = "free" }
    Objective { Time = "time", Scallop = "scallop", Cuts = "cuts", BladeLoad = "blade_load" }
    Formulas { Paper = "paper", Exact = "exact" }
    Residual { Discard = "discard", Lift = "lift", Shift = "shift", Mixed = "mixed" }
    Order { Point = "point", Layer = "layer" }
    Sequence { Rows = "rows", Boustrophedon = "boustrophedon", Nearest = "nearest" }
    Direction { Alternate = "alternate", Forward = "forward", Backward = "backward" }
}
