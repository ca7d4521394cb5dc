//! Writes a program: collects its ops and the tables that they refer to.

use crate::geometry::{Orientation, Point3};
use crate::ir::{
    Action, Blade, Cell, FeedId, IR_VERSION, Op, Operation, OperationId, OperationKind, OrientationId,
    Program, Purpose, RateId, Site, SourceRef, Stock, ToolId, ViaId,
};
use crate::state::State;
use crate::units::{AngularSpeed, Length, Speed};
use core::num::NonZeroU32;

/// A program in the making.
#[derive(Clone, Debug)]
pub struct ProgramBuilder {
    program: Program,
    /// After the last op.
    state: State,
}

impl ProgramBuilder {
    /// A program without ops.
    #[must_use]
    pub fn new(name: &str, stock: Stock, cell: Option<Cell>) -> Self {
        Self {
            program: Program {
                version: IR_VERSION,
                name: name.to_owned(),
                purpose: Purpose::Work,
                head: None,
                stock,
                cell,
                blades: Vec::new(),
                operations: Vec::new(),
                orientations: Vec::new(),
                feeds: Vec::new(),
                rates: Vec::new(),
                vias: Vec::new(),
                blend: Length::ZERO,
                ops: Vec::new(),
            },
            state: State::START,
        }
    }

    /// The stock.
    #[must_use]
    pub const fn stock(&self) -> Stock {
        self.program.stock
    }

    /// Whether the tip is at a point of W, and not at home or wherever the machine was left.
    #[must_use]
    #[inline]
    pub const fn knows_tip(&self) -> bool {
        self.state.place.pose().is_some()
    }

    /// How the blade is held; none at home or wherever the machine was left.
    #[must_use]
    #[inline]
    pub fn held(&self) -> Option<Orientation> {
        let OrientationId(index) = self.state.place.pose()?.orientation;
        self.program.orientations.get(index as usize).copied()
    }

    /// Appends an op; leaves out what the cell does not have (home angles, a place for changes, a generator).
    #[inline]
    pub fn op(&mut self, site: Site, action: Action) {
        let cell = self.program.cell.as_ref();
        let exists = match &action {
            Action::Home => cell.is_some_and(|cell| cell.home.is_some()),
            Action::ChangePlace => cell.is_some_and(|cell| cell.change.is_some()),
            Action::Ultrasonic { .. } | Action::AwaitReady => {
                cell.is_some_and(|cell| cell.ultrasonic.is_some())
            }
            _ => true,
        };
        if exists {
            self.state = self.state.after(&action);
            self.program.ops.push(Op { site, action });
        }
    }

    /// Adds an operation, and says what ops refer to it by. Its blade is put in where another one is at hand.
    pub fn operation(&mut self, kind: OperationKind, blade: Blade, source: SourceRef) -> OperationId {
        let tool = ToolId(id(find_or_push(&mut self.program.blades, blade)));
        if self.state.tool != tool {
            self.op(Site::Program, Action::ChangePlace);
            self.op(Site::Program, Action::ToolChange { tool });
        }
        self.program.operations.push(Operation { kind, tool, source });
        OperationId(id(self.program.operations.len() - 1))
    }

    /// An orientation of the table, added where it is new.
    #[inline]
    pub fn orientation(&mut self, orientation: Orientation) -> OrientationId {
        let place = find_or_push(&mut self.program.orientations, orientation);
        OrientationId(u32::from(id(place)))
    }

    /// A speed of the table, added where it is new.
    #[inline]
    pub fn feed(&mut self, feed: Speed) -> FeedId {
        FeedId(id(find_or_push(&mut self.program.feeds, feed)))
    }

    /// A point by which an op knows its arc.
    pub fn via(&mut self, point: Point3) -> ViaId {
        self.program.vias.push(point);
        let number = u32::try_from(self.program.vias.len()).unwrap_or(u32::MAX);
        ViaId(NonZeroU32::new(number).unwrap_or(NonZeroU32::MAX))
    }

    /// Lets the tip leave the pieces of chains by so much where one goes on into the next.
    pub const fn blend(&mut self, most: Length) {
        self.program.blend = most;
    }

    /// A rate of the table, added where it is new.
    #[inline]
    pub fn rate(&mut self, rate: AngularSpeed) -> RateId {
        RateId(id(find_or_push(&mut self.program.rates, rate)))
    }

    /// The program.
    #[must_use]
    pub fn finish(self) -> Program {
        self.program
    }
}

/// A handful of entries each: a job has few operations, each with few postures and speeds.
fn id(place: usize) -> u16 {
    u16::try_from(place).unwrap_or(u16::MAX)
}

fn find_or_push<T: PartialEq>(table: &mut Vec<T>, entry: T) -> usize {
    table.iter().position(|known| *known == entry).unwrap_or_else(|| {
        table.push(entry);
        table.len() - 1
    })
}
