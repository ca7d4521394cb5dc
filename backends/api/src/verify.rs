//! The verifier: the only way from a [`Program`] to a [`VerifiedProgram`].
//!
//! It walks the ops once, with what the machine is doing before each of them ([`Program::segments`]: where the tip is, how
//! the blade is held, whether it vibrates), and checks each op against that. What it promises to backends: every table reference is valid, every
//! number finite, every speed positive, every straight motion starts from a known pose, the first motion is `Home` where
//! there is a home and the next one a move of all axes, no rotation is ambiguous, the blade only meets the stock in cuts,
//! and every cut has one flank on either side at most.
//!
//! | Rules of | Here |
//! | --- | --- |
//! | what the rules are | `rules` |
//! | what a dialect must be able to say | `capability` |
//! | the program as a whole, references, the order of operations, the end | this file |
//! | the numbers of its tables | `sound` |
//! | ways through the air, turns | `air` |
//! | cuts straight through the stock, and their numbers | `cuts` |
//! | chains, blade by blade | `chain` |
//! | generator and spindle | `drives` |

mod air;
mod capability;
mod chain;
#[cfg(test)]
#[cfg(feature = "testkit")]
mod chain_tests;
#[cfg(test)]
#[cfg(feature = "testkit")]
mod change_tests;
mod cuts;
mod drives;
mod rules;
mod sound;
#[cfg(test)]
#[cfg(feature = "testkit")]
mod spin_tests;
#[cfg(test)]
#[cfg(feature = "testkit")]
mod tests;

pub use air::hang;
pub use capability::{Capabilities, Capability};
pub use chain::{LARGEST_KINK, LARGEST_SLIP, LARGEST_SWEEP, goes_face_first};
pub use cuts::UPRIGHT;
pub use rules::Rule;

use crate::geometry::Orientation;
use crate::ir::{
    Action, Extent, Head, IR_VERSION, Op, OpId, Operation, OperationId, OrientationId, Program, Purpose,
    Site, Switch, ToolId,
};
use crate::segments::Segment;
use crate::state::{Place, State};
use crate::units::{Angle, Length};
use air::Extents;
use chain::{Cleared, OpenChain};
use cuts::Pass;

/// A program that has passed [`verify`].
#[derive(Clone, Debug, PartialEq)]
pub struct VerifiedProgram {
    program: Program,
    needs: Capabilities,
    /// Cuts of one flank, in order.
    singles: Vec<OpId>,
}

impl VerifiedProgram {
    /// The program.
    #[must_use]
    pub const fn program(&self) -> &Program {
        &self.program
    }

    /// What a dialect must be able to say.
    #[must_use]
    pub const fn needs(&self) -> Capabilities {
        self.needs
    }

    /// Whether an op is the only flank of its cut.
    #[must_use]
    pub fn is_single(&self, op: OpId) -> bool {
        !self.singles.is_empty() && self.singles.binary_search(&op).is_ok()
    }

    /// The orientation behind an id (the identity for an id of another program).
    #[must_use]
    pub fn orientation(&self, id: OrientationId) -> Orientation {
        self.program.orientation(id).unwrap_or(Orientation::IDENTITY)
    }

    /// The same program with another head, on which no rule depends.
    #[must_use]
    pub fn headed(mut self, head: Option<Head>) -> Self {
        self.program.head = head;
        self
    }

    /// The ops with their numbers.
    pub fn ops(&self) -> impl Iterator<Item = (OpId, &Op)> {
        (0..).map(OpId).zip(&self.program.ops)
    }
}

/// A broken rule. All faults of a program made by this compiler are faults of the compiler.
#[derive(Clone, Debug, PartialEq)]
pub struct Fault {
    /// The op, where the rule is about one.
    pub op: Option<OpId>,
    /// The rule.
    pub rule: Rule,
}

/// Rotations of this size and more are not interpolated in one move: at 180 degrees there are two ways round.
pub const LARGEST_TURN: Angle = Angle::deg(175.0);

/// Coordinates that should be equal may differ by this: a nanometre, far below any controller's resolution.
const SAME: f64 = 1e-6;

/// Checks every rule.
///
/// # Errors
/// All broken rules, in the order of the ops.
pub fn verify(program: Program) -> Result<VerifiedProgram, Vec<Fault>> {
    let mut walk = Walk::new(&program);
    walk.tables();
    let mut segments = program.segments();
    for segment in segments.by_ref() {
        walk.op(&segment);
    }
    walk.ending(segments.state());
    let Walk {
        mut faults,
        needs,
        mut singles,
        ..
    } = walk;
    faults.sort_by_key(|fault| fault.op);
    singles.sort_unstable();
    if faults.is_empty() {
        Ok(VerifiedProgram {
            program,
            needs,
            singles,
        })
    } else {
        Err(faults)
    }
}

struct Walk<'p> {
    program: &'p Program,
    faults: Vec<Fault>,
    needs: Capabilities,
    operation: Option<OperationId>,
    /// The passes of the operation at hand.
    passes: Vec<Pass>,
    /// Cuts of one flank.
    singles: Vec<OpId>,
    current: OpId,
    /// The chain that has not come to a stop.
    chain: Option<OpenChain>,
    /// Where crushers have been.
    cleared: Cleared,
    extents: Extents,
    /// How far below its tip a blade hangs at most, in mm.
    hang: f64,
}

impl<'p> Walk<'p> {
    fn new(program: &'p Program) -> Self {
        Self {
            program,
            hang: hang(program).to_mm(),
            faults: Vec::new(),
            needs: Capabilities::NONE,
            operation: None,
            passes: Vec::new(),
            singles: Vec::new(),
            current: OpId(0),
            chain: None,
            cleared: Cleared::default(),
            extents: Extents::NONE_YET,
        }
    }

    fn fault(&mut self, rule: Rule) {
        self.fault_at(self.current, rule);
    }

    fn fault_at(&mut self, op: OpId, rule: Rule) {
        self.faults.push(Fault { op: Some(op), rule });
    }

    fn require(&mut self, holds: bool, rule: Rule) {
        if !holds {
            self.fault(rule);
        }
    }

    /// Rules about the program as a whole.
    fn tables(&mut self) {
        let p = self.program;
        let positive = |l: Length| l.is_finite() && l > Length::ZERO;
        let mut broken = Vec::new();
        if p.version != IR_VERSION {
            broken.push(Rule::Version);
        }
        let stock = positive(p.stock.width) && positive(p.stock.depth) && positive(p.stock.height);
        let blades = p.blades.iter().all(sound::is_sound_blade);
        let speeds = p.feeds.iter().all(|f| f.is_finite() && f.to_mm_per_s() > 0.0)
            && p.rates.iter().all(|r| r.is_finite() && r.to_rad_per_s() > 0.0);
        let blend = p.blend.is_finite() && p.blend >= Length::ZERO;
        let vias = p.vias.iter().all(|via| via.is_finite());
        let mut openings = p.operations.iter().flat_map(|operation| &operation.openings);
        let openings = openings.all(|hole| hole.ground.is_finite() && positive(hole.radius));
        let cell = p.cell.as_ref();
        let tables = blades && speeds && blend && vias && openings;
        if !(stock && tables && cell.is_none_or(sound::has_sound_numbers)) {
            broken.push(Rule::Number);
        }
        if !cell.is_none_or(|cell| sound::has_sound_axes(&cell.axes)) {
            broken.push(Rule::Axes);
        }
        if !cell.is_none_or(|cell| sound::has_a_tool_for_each(cell, p.blades.len())) {
            broken.push(Rule::Tools);
        }
        if !self.can_spin() {
            broken.push(Rule::NoSpindle);
        }
        let has_blades = |operation: &Operation| {
            let mut tools = operation.tools.iter();
            !operation.tools.is_empty() && tools.all(|&tool| p.blade(tool).is_some())
        };
        if !p.operations.iter().all(has_blades) {
            broken.push(Rule::TableReference);
        }
        self.faults
            .extend(broken.into_iter().map(|rule| Fault { op: None, rule }));
    }

    fn op(&mut self, segment: &Segment<'_>) {
        let (op, before) = (segment.op, segment.before);
        self.current = segment.id;
        self.site(op.site);
        self.blade_at_hand(segment);
        match self.program.purpose {
            Purpose::Work => {}
            Purpose::AirCut { .. } => self.require(self.is_of_an_air_cut(segment), Rule::AirCut),
        }
        self.tables_have(segment);
        self.chain_goes_on(op);
        match op.action {
            Action::Home => self.home(before),
            Action::Travel { to, .. } => self.travel(segment, to),
            Action::AxisTravel { to, .. } => self.axis_travel(segment, to),
            Action::Approach { to, .. } | Action::Retract { to, .. } => self.straight(segment, to),
            Action::Cut { flank, to, .. } => self.cut(segment, flank, to),
            Action::Follow { to, joint, .. } => self.follow(segment, to, joint),
            Action::Turn { to, .. } => self.turn(segment, to),
            Action::Ultrasonic { .. } => self.ultrasonic(),
            Action::Spin { state } => self.spin(before, state),
            Action::AwaitReady => self.await_ready(before),
            Action::Dwell { time } => {
                self.needs = self.needs.with(Capability::Dwell);
                self.require(time.is_finite() && time.to_s() >= 0.0, Rule::Number);
            }
            Action::ChangePlace => self.change_place(before),
            Action::ToolChange { tool } => self.tool_change(before, tool),
        }
    }

    /// Motions of an operation have its blade at hand.
    fn blade_at_hand(&mut self, segment: &Segment<'_>) {
        let operation = segment
            .op
            .site
            .operation()
            .and_then(|id| self.program.operation(id));
        let at_hand = segment.before.tool;
        let is_its_own = operation.is_none_or(|operation| operation.tools.contains(&at_hand));
        self.require(is_its_own || segment.target().is_none(), Rule::OtherBlade);
    }

    fn change_place(&mut self, before: State) {
        self.needs = self
            .needs
            .with(Capability::JointMove)
            .with(Capability::ToolChange);
        let cell = self.program.cell.as_ref();
        self.require(cell.is_some_and(|cell| cell.change.is_some()), Rule::ChangeAway);
        self.require(
            before.place != Place::Unknown || !self.has_home(),
            Rule::KnownStart,
        );
        self.leaves_for_axis_values(before.place, before.tool);
    }

    fn tool_change(&mut self, before: State, tool: ToolId) {
        self.needs = self.needs.with(Capability::ToolChange);
        self.require(self.program.blade(tool).is_some(), Rule::TableReference);
        // Without a machine no place for changes is known.
        let is_there = self.program.cell.is_none() || before.place == Place::Change;
        self.require(is_there && drives::is_still(before), Rule::ChangeAway);
    }

    /// Every id refers to an entry of its table.
    fn tables_have(&mut self, segment: &Segment<'_>) {
        let (program, action) = (self.program, &segment.op.action);
        let held = segment.end().map(|pose| pose.orientation);
        let known = action.feed().is_none_or(|id| program.feed(id).is_some())
            && action.rate().is_none_or(|id| program.rate(id).is_some())
            && action.via().is_none_or(|id| program.via(id).is_some())
            && held.is_none_or(|id| program.orientation(id).is_some());
        self.require(known, Rule::TableReference);
    }

    fn site(&mut self, site: Site) {
        if let Some(operation) = site.operation() {
            self.require(self.program.operation(operation).is_some(), Rule::TableReference);
        }
        let Some(here) = site.operation() else {
            return;
        };
        if self.operation != Some(here) {
            self.require(self.operation.is_none_or(|before| before < here), Rule::Order);
            self.finish_operation();
            self.operation = Some(here);
        }
    }

    fn home(&mut self, before: State) {
        self.needs = self.needs.with(Capability::JointMove);
        self.require(self.has_home(), Rule::HomeAngles);
        self.leaves_for_axis_values(before.place, before.tool);
    }

    fn turn(&mut self, segment: &Segment<'_>, to: OrientationId) {
        self.needs = self.needs.with(Capability::StillTipTurn);
        let Some(from) = segment.start() else {
            self.fault(Rule::KnownStart);
            return;
        };
        self.rotation(segment);
        self.turns_clear(segment.before.tool, &[from.tip], [from.orientation, to]);
    }

    fn ending(&mut self, end: State) {
        self.finish_operation();
        self.require(self.chain.is_none(), Rule::ChainJoint);
        let rests = match end.place {
            Place::Unknown => true,
            Place::Home => self.has_home(),
            Place::Change => false,
            Place::Pose(pose) => !self.has_home() && self.is_outside(&[pose.tip], Extent::TIP),
        };
        self.require(rests && drives::is_still(end), Rule::Ending);
    }

    /// Whether an op of an air cut meets nothing: its tip ends above the stock, and with all tips the straight ways between
    /// them do. The tip is the lowest line of the blade in all postures that may be turned to above the stock, and as long as
    /// the blade is thick, so half of that hangs lower at most.
    fn is_of_an_air_cut(&self, segment: &Segment<'_>) -> bool {
        let lowest = self.program.stock.height.to_mm() + self.hang - SAME;
        match segment.op.action {
            Action::Ultrasonic { state: Switch::On }
            | Action::Spin { state: Switch::On }
            | Action::AwaitReady => false,
            // The tip stays where the op before has led it.
            Action::Turn { .. } => true,
            _ => {
                let arc = segment.line().and_then(|line| line.arc());
                let to = segment.target();
                to.is_none_or(|to| to.tip.z >= lowest) && arc.is_none_or(|arc| arc.room()[0][2] >= lowest)
            }
        }
    }

    fn has_home(&self) -> bool {
        self.program.cell.as_ref().is_some_and(|cell| cell.home.is_some())
    }

    fn rotation(&mut self, segment: &Segment<'_>) {
        self.require(
            segment.turn().is_none_or(|turn| turn < LARGEST_TURN),
            Rule::AmbiguousTurn,
        );
    }
}
