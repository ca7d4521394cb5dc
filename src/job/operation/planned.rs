//! The planned job: every choice made, nothing promised. What a plan of an operation is to the stages after it.

use super::judged::{FromAbove, Judged, Tilts};
use super::search::RouteSet;
use super::{Operation, Trials, WorksThere};
use crate::description::{ParameterFigure, ParameterTable};
use crate::{BladeRef, Machine, Order, Shaded, SoundField, Sourced};
use core::any::Any;
use core::fmt::Debug;
use std::sync::Arc;
use vcutc_backend_api::builder::ProgramBuilder;
use vcutc_backend_api::ir::{CutKind, OperationId, Program, SourceRef, Stock};
use vcutc_backend_api::units::{Angle, Area, Duration, Length};
use vcutc_diagnostics::Diagnostic;
use vcutc_geometry::curve::Point2;
use vcutc_geometry::profile::Profile;
use vcutc_simulation::prove::{Bound, Compensation, Finding, Passes, Replay};
use vcutc_simulation::report::Report;
use vcutc_simulation::surface::Side;

/// A job with every choice made.
#[derive(Clone, Debug, PartialEq)]
pub struct PlannedJob {
    /// The job's name.
    pub name: String,
    /// The stock.
    pub stock: Stock,
    /// The part's polyline; of a surface that of its shadow.
    pub profile: Profile,
    /// The part where it changes along y.
    pub surface: Option<Arc<Shaded>>,
    /// How far it may be off the part as drawn.
    pub tolerance: Length,
    /// The machine, if the job has one.
    pub machine: Option<Machine>,
    /// The operations in order.
    pub operations: Vec<Box<dyn PlannedOperation>>,
}

impl PlannedJob {
    /// How many cuts it has.
    #[must_use]
    pub fn cuts(&self) -> usize {
        self.operations.iter().map(|planned| planned.cuts()).sum()
    }

    /// The times of its operations by the mean-value model, together.
    #[must_use]
    pub fn estimate(&self) -> Duration {
        let operations = self.operations.iter();
        operations.map(|planned| planned.estimate().time).sum()
    }

    /// The tightest limit on the scallop across the cuts, of operations that leave the same at every y, with the operation; the first among equals.
    #[must_use]
    pub fn scallop_limit(&self) -> Option<(OperationId, Sourced<Length>)> {
        let limits = (0..)
            .zip(&self.operations)
            // What tracks on a surface leave, its sections show.
            .filter(|(_, planned)| {
                !matches!(planned.bound().passes, Some(Passes::Tracks(_) | Passes::Region))
            })
            .filter_map(|(index, planned)| Some((OperationId(index), planned.asked().scallop_limit()?)));
        limits.min_by(|(_, a), (_, b)| a.value.total_cmp(&b.value))
    }

    /// The next routes, narrower than these, under which the planner would choose something else than this plan.
    #[must_use]
    pub fn routes_below(&self, routes: RouteSet) -> Option<RouteSet> {
        let mut next = routes.narrower();
        while let Some(routes) = next {
            if !self.operations.iter().all(|planned| planned.is_within(routes)) {
                break;
            }
            next = routes.narrower();
        }
        next
    }

    /// The plan of an operation.
    #[must_use]
    pub fn operation(&self, operation: OperationId) -> Option<&dyn PlannedOperation> {
        let planned = self.operations.get(usize::from(operation.0))?;
        Some(&**planned)
    }
}

/// An operation with every choice made.
pub trait PlannedOperation: PlannedValue + Any + Debug + Send + Sync {
    /// What the job asks for.
    fn asked(&self) -> &dyn Operation;

    /// The same, to be changed where the plan stays what it is.
    fn asked_mut(&mut self) -> &mut dyn Operation;

    /// Takes the same operation of another text for what the job asks for.
    fn set_asked(&mut self, asked: &dyn Operation) {
        self.asked_mut().assign(asked);
    }

    /// How many cuts it has.
    fn cuts(&self) -> usize {
        self.tips().len()
    }

    /// Its cuts in the order of the plan: layer by layer, each from left to right. None of one whose cuts no section shows.
    fn tips(&self) -> Vec<PlannedTip> {
        Vec::new()
    }

    /// Its ways over a region of the plan, in the order of the program, layer by layer; none of one whose cuts sections show.
    fn ways(&self) -> Vec<PlannedWay> {
        Vec::new()
    }

    /// The blade that makes a cut of this shape: the first one, where an operation has one only.
    fn blade_of(&self, _shape: CutShape) -> Option<BladeRef<'_>> {
        self.asked().blades().first().copied()
    }

    /// Half the opening angle of the cuts; zero of one that cuts no Vs.
    fn swing(&self) -> Angle {
        Angle::ZERO
    }

    /// Order of the flanks.
    fn order(&self) -> Order {
        Order::Point
    }

    /// How far cuts run out beyond the stock.
    fn extension(&self) -> Length;

    /// What the proof holds its cuts to.
    fn bound(&self) -> Bound<'_>;

    /// Judges what the replay of straight cuts does not show of it, after that: adds what is wrong, and what it does.
    fn judge(&self, _: Judged<'_>, _: &mut Replay) {}

    /// Its cuts from above, as a program states them; none where sections show them.
    fn seen_from_above(&self, _: OperationId, _: &Program) -> Option<FromAbove> {
        None
    }

    /// How far its disc leans from the normal of a part that changes along y; none where no disc follows one.
    fn tilts(&self) -> Option<Tilts> {
        None
    }

    /// The sound field that its passes follow, if they follow one.
    fn sound_field(&self) -> Option<SoundField> {
        None
    }

    /// What the mean-value model says of it.
    fn estimate(&self) -> Estimate;

    /// Whether the planner would choose the same among these routes only.
    fn is_within(&self, _routes: RouteSet) -> bool {
        true
    }

    /// The same cuts in rows, in this order of flanks and with no wider swing than this, where they are open: a plan of which
    /// a few motions say whether a machine may follow.
    fn in_rows(
        &self,
        _order: Option<Order>,
        _swing: Option<Angle>,
        _stock: Stock,
    ) -> Box<dyn PlannedOperation> {
        self.copied()
    }

    /// The same plan with its tips offset; none of an operation that cannot be compensated.
    fn compensated(&self, _by: Compensation) -> Option<Box<dyn PlannedOperation>> {
        None
    }

    /// Writes its motions down.
    fn lower(&self, source: SourceRef, builder: &mut ProgramBuilder);

    /// Explains what a proof found wrong with a cut; so many cuts have the same fault.
    fn explain(
        &self,
        finding: Finding,
        count: usize,
        trials: &mut dyn Trials,
        works: &mut WorksThere<'_>,
    ) -> Diagnostic;

    /// Says what helps where more stays on the part than its limit on scallop allows, as the diagnostic reports.
    fn help_with_scallop(
        &self,
        over_limit: Diagnostic,
        _report: &Report,
        _trials: &mut dyn Trials,
    ) -> Diagnostic {
        over_limit
    }

    /// What there is to warn of, however well it proves.
    fn warnings(&self) -> Vec<Diagnostic> {
        Vec::new()
    }

    /// The area of the stock's cross-section that it is to cut away; zero where no section shows it.
    fn to_remove(&self, _profile: &Profile, _top: &[Point2]) -> Area {
        Area::mm2(0.0)
    }

    /// Warns where much of that stays.
    fn explain_what_stays(&self, _balance: Balance<'_>, _compile: &Compile<'_>) -> Option<Diagnostic> {
        None
    }

    /// The limits on time and cuts that it breaks, when it takes this long, with what it keeps.
    fn broken_limits(&self, _asked: &dyn Operation, _time: Duration) -> Option<Diagnostic> {
        None
    }

    /// Its parameters, in the order of the language reference.
    fn parameters(&self) -> Vec<ParameterFigure> {
        Vec::new()
    }

    /// Its parameters for people, with where each is from.
    fn tables(&self) -> Vec<ParameterTable>;

    /// Lines of the summary: names and texts.
    fn summary(&self, _report: &Report) -> Vec<(&'static str, String)> {
        Vec::new()
    }

    /// What was chosen for a field that was left open, and why; none for other fields.
    fn chosen(&self, _field: &str) -> Option<(String, String)> {
        None
    }

    /// How its cuts are laid out, in words: what they are called, and their measures.
    fn layout(&self) -> [String; 2];
}

/// The times and cuts of the mean-value model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// The time.
    pub time: Duration,
    /// The cuts, on average.
    pub cuts: f64,
}

/// What an operation is to cut away, and how much of that stays.
#[derive(Clone, Copy, Debug)]
pub struct Balance<'b> {
    /// The job's plan.
    pub plan: &'b PlannedJob,
    /// What it leaves.
    pub report: &'b Report,
    /// The operation that is to cut away the most.
    pub operation: OperationId,
    /// What that is.
    pub whole: Area,
}

impl<'b> Balance<'b> {
    /// By the operation that is to cut away the most; the last one among equals.
    #[must_use]
    pub fn of(plan: &'b PlannedJob, report: &'b Report) -> Option<Self> {
        let stock = plan.stock;
        let top = [0.0, stock.width.to_mm()].map(|x| Point2 {
            x,
            z: stock.height.to_mm(),
        });
        let wholes = (0..)
            .zip(&plan.operations)
            .map(|(index, planned)| (OperationId(index), planned.to_remove(&plan.profile, &top)));
        let (operation, whole) = wholes.max_by(|(_, one), (_, other)| one.total_cmp(other))?;
        Some(Self {
            plan,
            report,
            operation,
            whole,
        })
    }

    /// The area that stays.
    #[must_use]
    pub fn stays(&self) -> Area {
        self.whole - self.report.removed
    }

    /// The share that stays.
    #[must_use]
    pub fn share(&self) -> f64 {
        let whole = self.whole.to_mm2();
        if whole > 0.0 {
            (self.stays().to_mm2() / whole).max(0.0)
        } else {
            0.0
        }
    }
}

/// Compiles the job with a change of an operation, as far as its machine; none where it has errors.
pub type Compile<'c> = dyn Fn(&dyn Fn(&mut dyn Operation)) -> Option<(PlannedJob, Report)> + 'c;

/// One cut.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlannedTip {
    /// The layer it belongs to, counted from 1 at the top. A layer that cuts nothing has no number.
    pub layer: u32,
    /// Where the blade's tip runs, in the x-z plane.
    pub tip: Point2,
    /// Why the tip is there.
    pub origin: TipOrigin,
    /// What it does to the cross-section.
    pub shape: CutShape,
}

/// A way of a blade over a region of the plan, from where it goes down to where it goes up. Lengths are in mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlannedWay {
    /// The layer it belongs to, counted from 1 at the top.
    pub layer: u32,
    /// Which way of its layer it is, counted from 1.
    pub number: u32,
    pub kind: WayKind,
    /// Which of the operation's blades goes along it, counted from 0.
    pub blade: usize,
    /// Where it begins, in x and y.
    pub from: [f64; 2],
    /// Its depth, and where the material begins above it.
    pub heights: [f64; 2],
    /// How long it is, without its way down.
    pub length: f64,
    pub entry: WayEntry,
}

/// What a blade does along a way.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WayKind {
    /// It slits.
    Slit,
    /// A crusher clears.
    Pass,
    /// A disc frees a strip, or rows of them.
    Strip,
}

impl WayKind {
    #[must_use]
    pub const fn word(self) -> &'static str {
        match self {
            Self::Slit => "slit",
            Self::Pass => "pass",
            Self::Strip => "strip",
        }
    }
}

/// How a blade gets to the beginning of a way.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WayEntry {
    /// At depth, from beside the stock.
    Open,
    /// Straight down into the material.
    Plunge,
    /// Down to and fro along a line.
    Ramp,
    /// Down round and round.
    Helix,
    /// Straight down into a hole.
    Hole,
    /// Straight down where it has been.
    Return,
}

impl WayEntry {
    #[must_use]
    pub const fn word(self) -> &'static str {
        match self {
            Self::Open => "open",
            Self::Plunge => "plunge",
            Self::Ramp => "ramp",
            Self::Helix => "helix",
            Self::Hole => "opening",
            Self::Return => "return",
        }
    }
}

/// What a cut does to the cross-section, as far as pictures of plans show it. Lengths are in mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CutShape {
    /// What its tip does not say follows from the cuts before it: flanks up to the surface, a rim through it.
    Plain,
    /// As `Plain`, with flanks whose swings are not the operation's.
    Narrowed { left: Angle, right: Angle },
    /// A slit from its tip straight up.
    Slit {
        /// The height of the surface.
        top: f64,
    },
    /// A disc with the centre of its edge at the tip frees a strip.
    Strip(PlannedStrip),
    /// A disc with the centre of its edge at the tip takes the skin off the part.
    Track {
        /// Where it stands on the part.
        contact: Point2,
        /// How far its axis leans along the feed, seen from the normal of the part.
        lead: Angle,
        /// How far it is turned about the feed, away from the upright; positive where the axis leans towards -x.
        roll: Angle,
    },
}

impl CutShape {
    /// What people call it.
    #[must_use]
    pub const fn kind(self) -> CutKind {
        match self {
            Self::Plain | Self::Narrowed { .. } => CutKind::Cut,
            Self::Slit { .. } => CutKind::Slit,
            Self::Strip(_) => CutKind::Strip,
            Self::Track { .. } => CutKind::Track,
        }
    }
}

/// A strip as it is planned, in mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlannedStrip {
    /// Its lower left corner.
    pub low: Point2,
    /// Its upper right corner.
    pub high: Point2,
    /// The side that the disc comes from.
    pub open: Side,
    /// The radius of the disc's edge.
    pub radius: f64,
    /// How far the disc's axis leans along its feed.
    pub lead: Angle,
}

/// Why a tip is where it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TipOrigin {
    /// A point of the lattice.
    Lattice,
    /// Given by the job.
    Given,
    /// Raised to clear the part.
    Lifted,
    /// Moved sideways to clear the part.
    Shifted,
    /// Raised because the blade does not reach the full depth at once.
    Relieved,
}

crate::words! {
    TipOrigin { Lattice = "lattice", Given = "given", Lifted = "lifted", Shifted = "shifted", Relieved = "relieved" }
}

/// Cloning and comparing of plans; every type that can be cloned and compared has it.
pub trait PlannedValue {
    /// A copy.
    fn copied(&self) -> Box<dyn PlannedOperation>;

    /// Whether the two are the same plan.
    fn is_same(&self, other: &dyn PlannedOperation) -> bool;
}

impl<T: PlannedOperation + Clone + PartialEq> PlannedValue for T {
    fn copied(&self) -> Box<dyn PlannedOperation> {
        Box::new(self.clone())
    }

    fn is_same(&self, other: &dyn PlannedOperation) -> bool {
        let other: &dyn Any = other;
        other.downcast_ref::<T>() == Some(self)
    }
}

impl Clone for Box<dyn PlannedOperation> {
    fn clone(&self) -> Self {
        (**self).copied()
    }
}

impl PartialEq for dyn PlannedOperation {
    fn eq(&self, other: &Self) -> bool {
        self.is_same(other)
    }
}
