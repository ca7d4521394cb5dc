//! What an operation is to every stage: the interface between the stages and the folders in `src/operations`.
//!
//! An operation passes through three types. A [`Kind`](crate::sema::kind::Kind) says how it is written and checks it. What
//! it checked is an [`Operation`], which plans itself. The plan is a [`PlannedOperation`], which writes itself down as
//! motions, explains what a proof finds wrong with it, and describes itself for summary, report and editor. The stages know
//! no more of it than that.

pub mod judged;
pub mod less;
pub mod planned;
pub mod planning;
pub mod search;

use super::follow::{Family, Follow, Guide};
use super::{BladeRef, Setup, Sourced};
use core::any::Any;
use core::fmt::Debug;
use planned::PlannedOperation;
use planning::PlanningJob;
use search::SearchSpace;
use vcutc_backend_api::units::{Angle, Length};
use vcutc_cancellation::{Effort, Wanted};
use vcutc_diagnostics::Diagnostic;
use vcutc_diagnostics::source::Span;
use vcutc_simulation::surface::Surface;

/// An operation as the job asks for it.
pub trait Operation: OperationValue + Any + Debug + Send + Sync {
    /// What all operations state.
    fn setup(&self) -> &Setup;

    /// Its blades, at least one, in the order in which it takes them.
    fn blades(&self) -> Vec<BladeRef<'_>>;

    /// The same, to be changed.
    fn setup_mut(&mut self) -> &mut Setup;

    /// Replaces every place of its own in the job's text by this one, those of its blades among them; the set-up's are not its own.
    fn forget_places(&mut self, place: Span);

    /// The most material that may stay on the part, if it is limited.
    fn scallop_limit(&self) -> Option<Sourced<Length>> {
        None
    }

    /// How wide what its disc meets of a strip is at most, with what the rim runs beyond it; none of an operation without a disc.
    fn widest_strip(&self) -> Option<Length> {
        None
    }

    /// How far the forces of its blade may push it off, if that is limited.
    fn deviation_limit(&self) -> Option<Sourced<Length>> {
        None
    }

    /// Where the job asks that its tips are offset against the forces of its blade, if it does.
    fn compensates(&self) -> Option<Span> {
        None
    }

    /// The same operation with its tips offset against the forces of its blade; none where that cannot be, or is asked already.
    fn compensating(&self) -> Option<Variant> {
        None
    }

    /// The same operation so that it stays so much farther out of the part, at least.
    fn keeping_more(&self, _by: Length) -> Option<Variant> {
        None
    }

    /// The same operation so that it leaves less on the part, but no less than this along its normal, for one that takes off
    /// the rest; what changes the least comes first.
    fn leaving_less(&self, _least: Length) -> Vec<Variant> {
        Vec::new()
    }

    /// How much it takes off the part at most, where it takes off what others have left.
    fn takes_off(&self) -> Option<Sourced<Length>> {
        None
    }

    /// How its cuts follow a part that changes along y; none where that is nothing that it has to choose.
    fn follows(&self) -> Option<Sourced<Follow>> {
        Some(Sourced {
            value: Follow::Straight,
            span: None,
        })
    }

    /// The same operation with its cuts made to follow the part so; as it is where that is nothing that it has to choose.
    ///
    /// # Errors
    /// What else it asks that does not go with that.
    fn following(&self, _family: Family) -> Result<Box<dyn Operation>, Box<Diagnostic>> {
        Ok(self.copied())
    }

    /// The same operation with it left open how its cuts follow the part; none where that is nothing that it has to choose, or is open.
    fn following_best(&self) -> Option<Variant> {
        None
    }

    /// Makes its cuts follow what they follow in this job: those of all its operations follow the part alike.
    /// `others` is the longest edge of the straight blades of the other operations, if there are any.
    fn go_along(&mut self, _guide: &Guide, _others: Option<Length>) {}

    /// What its open parameters are to make least.
    fn aim(&self) -> Aim {
        Aim::Time
    }

    /// The swing, where it is left to the compiler or not.
    fn swing(&self) -> Swing {
        Swing::Given
    }

    /// The narrowest swing that the job allows, if it says so.
    fn narrowest_swing(&self) -> Option<Angle> {
        None
    }

    /// The same operation otherwise, as far as it can be cut otherwise: what may help a machine that does not follow.
    fn variants(&self, _planned: &dyn PlannedOperation, _of: Variation) -> Vec<Variant> {
        Vec::new()
    }

    /// The same operation with this swing; none where it has no swing to choose.
    fn at_swing(&self, _swing: Angle) -> Option<Variant> {
        None
    }

    /// The operation without limits on the plan as a whole (time, cuts); none where it has none.
    fn without_plan_limits(&self) -> Option<Box<dyn Operation>> {
        None
    }

    /// Takes over limits that a plan of it chose.
    fn settle(&mut self, _planned: &dyn PlannedOperation) -> Settled {
        Settled::AsAsked
    }

    /// Plans it.
    ///
    /// # Errors
    /// Why there is no plan: at once, before suggestions are searched.
    fn plan<'j>(&'j self, ground: Ground<'j>) -> Result<Laid, Box<dyn Unplanned + 'j>>;

    /// Whether there is a plan of it with nothing wrong, as far as is seen with so much work; none where planning and proving
    /// the job says it as soon.
    fn is_plannable(&self, _ground: Ground<'_>, _effort: &mut Effort) -> Option<bool> {
        None
    }
}

/// What open parameters are to make least.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Aim {
    /// The time.
    Time,
    /// What stays on the part.
    Scallop,
    /// The number of cuts.
    Cuts,
    /// The longest edge in use.
    Edge,
}

/// Whether the compiler chooses the swing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Swing {
    /// It does.
    Open,
    /// The job gives it.
    Given,
}

/// Whether an operation took over a limit of its plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Settled {
    /// It did.
    Limited,
    /// It is as the job asks.
    AsAsked,
}

/// How an operation may be cut otherwise.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Variation {
    /// In another order of its flanks.
    Order,
    /// With a smaller swing, the widest first.
    SmallerSwing,
    /// With smaller swings only where the blade does not fit.
    NarrowerFlanks,
}

/// An operation cut otherwise.
#[derive(Debug)]
pub struct Variant {
    /// What to do, in the imperative.
    pub advice: String,
    /// What to write where; empty where the value is not written anywhere.
    pub edits: Vec<(Span, String)>,
    /// The operation then.
    pub operation: Box<dyn Operation>,
}

/// The work as an operation finds it, and how much of what is open is searched.
#[derive(Clone, Debug)]
pub struct Ground<'j> {
    /// The job, with its part as lines.
    pub job: PlanningJob<'j>,
    /// What the operations before it left of the stock.
    pub before: Surface,
    /// What is considered.
    pub space: SearchSpace,
    /// Most cuts that it may have.
    pub cuts_left: usize,
    /// Whether the plan is still wanted.
    pub wanted: Wanted,
}

/// An operation planned.
#[derive(Debug)]
pub struct Laid {
    /// The plan.
    pub planned: Box<dyn PlannedOperation>,
    /// What it leaves of the stock.
    pub after: Surface,
}

/// Whether the job compiles with these changes of its text, as far as the stages after planning can say: the
/// machine of the job, and its target.
pub type WorksThere<'w> = dyn FnMut(&[(Span, String)]) -> bool + 'w;

/// Why an operation has no plan.
pub trait Unplanned {
    /// What there is to report, with changes that work, as far as so much work finds them.
    fn diagnostics(
        &self,
        wanted: &Wanted,
        effort: &mut Effort,
        works: &mut WorksThere<'_>,
    ) -> Vec<Diagnostic>;
}

/// Where nothing can be tried.
impl Unplanned for Diagnostic {
    fn diagnostics(&self, _: &Wanted, _: &mut Effort, _: &mut WorksThere<'_>) -> Vec<Diagnostic> {
        vec![self.clone()]
    }
}

/// Changes of one operation of a job, tried before they are offered.
pub trait Trials {
    /// Whether the job plans and proves with a change of the operation, within all its limits.
    fn proves(&mut self, change: &dyn Fn(&mut dyn Operation)) -> bool;

    /// The plan of the operation with a change; none where something is wrong with the job then.
    fn planned(&mut self, change: &dyn Fn(&mut dyn Operation)) -> Option<Box<dyn PlannedOperation>>;
}

/// Cloning and comparing of operations; every type that can be cloned and compared has it.
pub trait OperationValue {
    /// A copy.
    fn copied(&self) -> Box<dyn Operation>;

    /// Whether the two ask for the same.
    fn is_same(&self, other: &dyn Operation) -> bool;

    /// Takes over what another operation of this type asks for.
    fn assign(&mut self, other: &dyn Operation);
}

impl<T: Operation + Clone + PartialEq> OperationValue for T {
    fn copied(&self) -> Box<dyn Operation> {
        Box::new(self.clone())
    }

    fn is_same(&self, other: &dyn Operation) -> bool {
        let other: &dyn Any = other;
        other.downcast_ref::<T>() == Some(self)
    }

    fn assign(&mut self, other: &dyn Operation) {
        let other: &dyn Any = other;
        if let Some(other) = other.downcast_ref() {
            self.clone_from(other);
        }
    }
}

impl Clone for Box<dyn Operation> {
    fn clone(&self) -> Self {
        (**self).copied()
    }
}

impl PartialEq for dyn Operation {
    fn eq(&self, other: &Self) -> bool {
        self.is_same(other)
    }
}
