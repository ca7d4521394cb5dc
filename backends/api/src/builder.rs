//! Writes a program: collects its ops and the tables that they refer to.

use crate::geometry::{Orientation, Point3};
use crate::ir::{
    Action, Blade, Cell, FeedId, IR_VERSION, Op, Opening, Operation, OperationId, OperationKind,
    OrientationId, Program, Purpose, RateId, Site, SourceRef, Stock, ToolId, ViaId,
};
use crate::state::{Drive, State};
use crate::units::{AngularSpeed, Length, Speed};
use core::num::NonZeroU32;
use std::collections::BTreeMap;

/// A program in the making.
#[derive(Clone, Debug)]
pub struct ProgramBuilder {
    program: Program,
    /// The place of each orientation in its table, by the bits of its quaternion.
    orientations: BTreeMap<[u64; 4], u32>,
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
            orientations: BTreeMap::new(),
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

    /// Where the tip is; none at home or wherever the machine was left.
    #[must_use]
    #[inline]
    pub const fn tip(&self) -> Option<Point3> {
        match self.state.place.pose() {
            Some(pose) => Some(pose.tip),
            None => None,
        }
    }

    /// How the blade is held; none at home or wherever the machine was left.
    #[must_use]
    #[inline]
    pub fn held(&self) -> Option<Orientation> {
        let OrientationId(index) = self.state.place.pose()?.orientation;
        self.program.orientations.get(index as usize).copied()
    }

    /// Appends an op; leaves out what the cell does not have (home angles, a place for changes, a generator, a spindle).
    #[inline]
    pub fn op(&mut self, site: Site, action: Action) {
        let cell = self.program.cell.as_ref();
        let exists = match &action {
            Action::Home => cell.is_some_and(|cell| cell.home.is_some()),
            Action::ChangePlace => cell.is_some_and(|cell| cell.change.is_some()),
            Action::Ultrasonic { .. } => cell.is_some_and(|cell| cell.ultrasonic.is_some()),
            Action::Spin { .. } => cell.is_some_and(|cell| cell.spindle.is_some()) && self.spins(),
            Action::AwaitReady => [self.state.generator, self.state.spindle].contains(&Drive::Starting),
            _ => true,
        };
        if exists {
            self.state.advance(&action);
            self.program.ops.push(Op { site, action });
        }
    }

    /// Whether the blade at hand is one that spins.
    fn spins(&self) -> bool {
        let blade = self.program.blade(self.state.tool);
        blade.is_some_and(|blade| blade.spin().is_some())
    }

    /// Adds an operation, and says what ops refer to it by. Its first blade is put in where another one is at hand.
    pub fn operation(&mut self, kind: OperationKind, blade: Blade, source: SourceRef) -> OperationId {
        let tool = self.put_in(blade);
        let tools = vec![tool];
        self.program.operations.push(Operation {
            kind,
            tools,
            source,
            compensation: None,
            openings: Vec::new(),
        });
        OperationId(id(self.program.operations.len() - 1))
    }

    /// Notes how far the tips of the latest operation are offset at most against what forces do to its blades.
    pub fn compensated(&mut self, by: Length) {
        if let Some(operation) = self.program.operations.last_mut() {
            operation.compensation = Some(by);
        }
    }

    /// Notes a hole that is open before the latest operation.
    pub fn opening(&mut self, opening: Opening) {
        if let Some(operation) = self.program.operations.last_mut() {
            operation.openings.push(opening);
        }
    }

    /// Goes on with the latest operation with another of its blades, which is put in where it is not at hand.
    pub fn change(&mut self, blade: Blade) {
        let tool = self.put_in(blade);
        if let Some(operation) = self.program.operations.last_mut()
            && !operation.tools.contains(&tool)
        {
            operation.tools.push(tool);
        }
    }

    fn put_in(&mut self, blade: Blade) -> ToolId {
        let tool = ToolId(id(find_or_push(&mut self.program.blades, blade)));
        if self.state.tool != tool {
            self.op(Site::Program, Action::ChangePlace);
            self.op(Site::Program, Action::ToolChange { tool });
        }
        tool
    }

    /// An orientation of the table, added where it is new.
    #[inline]
    pub fn orientation(&mut self, orientation: Orientation) -> OrientationId {
        let table = &mut self.program.orientations;
        // Programs of V cuts have a handful, and look one up for each op.
        let among_first = table.iter().take(FEW).position(|known| *known == orientation);
        if let Some(place) = among_first.and_then(|place| u32::try_from(place).ok()) {
            return OrientationId(place);
        }
        // Tracks on surfaces have one for each pose. The sum turns a negative zero into a positive one, as equality does.
        let key = orientation.quaternion().map(|part| (part + 0.0).to_bits());
        let place = *self.orientations.entry(key).or_insert_with(|| {
            table.push(orientation);
            u32::try_from(table.len() - 1).unwrap_or(u32::MAX)
        });
        OrientationId(place)
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

    /// Lets the tip leave the pieces of chains by so much where one continues into the next.
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

/// So many orientations are compared one by one before they are looked up.
const FEW: usize = 8;

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
