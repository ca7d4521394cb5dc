//! What controllers of arms with six axes do not take, as far as it is the same for all of them but for the numbers.

use crate::backend::MachineMismatch;
use crate::findings::{Findings, Number};
use crate::geometry::Point3;
use crate::ir::{Action, AxisKind, Cell, FeedId, Load, MOST_AXES, MachineKind, Maker, OpId, Program, RateId};
use crate::motion::ReachableProgram;
use crate::units::Speed;

/// The numbers of a controller.
#[derive(Clone, Copy, Debug)]
pub struct ArmLimits {
    /// Largest coordinate, in mm.
    pub farthest_mm: f64,
    /// In which unit the speed of the tip is written.
    pub speed_unit: SpeedUnit,
    /// Slowest and fastest speed of the tip, in this unit.
    pub tip_speed: (f64, f64),
    /// Slowest and fastest rate of turning, in deg/s.
    pub rate: (f64, f64),
    /// Lightest and heaviest load, in kg.
    pub load_kg: (f64, f64),
}

/// In which unit a controller takes the speed of the tip.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SpeedUnit {
    /// m/s.
    MetresPerSecond,
    /// mm/s.
    MillimetresPerSecond,
}

impl SpeedUnit {
    fn of(self, speed: Speed) -> (f64, &'static str) {
        match self {
            Self::MetresPerSecond => (speed.to_m_per_s(), "m/s"),
            Self::MillimetresPerSecond => (speed.to_mm_per_s(), "mm/s"),
        }
    }
}

/// What sets machines of a kind and maker apart from the arms of a maker.
#[must_use]
pub fn foreign(kind: MachineKind, maker: Maker, wanted: Maker) -> Option<MachineMismatch> {
    match kind {
        MachineKind::FiveAxis => Some(MachineMismatch::Kind),
        MachineKind::Robot => (maker != wanted).then_some(MachineMismatch::Maker),
    }
}

/// Whether a machine has as many rotary axes as an arm, and no others.
#[must_use]
pub fn has_six_rotary_axes(cell: &Cell) -> bool {
    let mut kinds = cell.axes.iter().map(|axis| axis.kind);
    cell.axes.len() == MOST_AXES && kinds.all(|kind| kind == AxisKind::Rotary)
}

impl Findings {
    /// The numbers of every op must be within limits; `also` checks what else there is to an op.
    pub fn arm_ops(
        &mut self,
        program: &ReachableProgram,
        limits: &ArmLimits,
        also: &mut dyn FnMut(&mut Self, OpId, &Action),
    ) {
        let tables = program.program();
        self.ops(program, &mut |found, segment| {
            let (id, action) = (segment.id, &segment.op.action);
            match *action {
                Action::Travel { to, feed, rate, .. } => {
                    found.target(id, to, limits);
                    found.feed(id, tables, feed, limits);
                    found.rate(id, tables, rate, limits);
                }
                Action::Approach { to, feed }
                | Action::Retract { to, feed }
                | Action::Cut { to, feed, .. } => {
                    found.target(id, to, limits);
                    found.feed(id, tables, feed, limits);
                }
                Action::AxisTravel { to, .. } => found.target(id, to, limits),
                Action::Turn { rate, .. } => found.rate(id, tables, rate, limits),
                Action::Home
                | Action::Ultrasonic { .. }
                | Action::AwaitReady
                | Action::Dwell { .. }
                | Action::ToolChange { .. } => {}
            }
            also(found, id, action);
        });
    }

    /// What the flange carries.
    pub fn load(&mut self, load: Load, limits: &ArmLimits) {
        let mass = Number {
            what: "load mass",
            value: load.mass.to_kg(),
            unit: "kg",
        };
        self.range(None, &mass, limits.load_kg);
        self.point(
            None,
            ["load X", "load Y", "load Z"],
            load.centre,
            limits.farthest_mm,
        );
    }

    fn target(&mut self, op: OpId, to: Point3, limits: &ArmLimits) {
        self.point(Some(op), ["X", "Y", "Z"], to, limits.farthest_mm);
    }

    fn feed(&mut self, op: OpId, program: &Program, feed: FeedId, limits: &ArmLimits) {
        if let Some(&feed) = program.feeds.get(usize::from(feed.0)) {
            let (value, unit) = limits.speed_unit.of(feed);
            let what = "tip speed";
            self.range(Some(op), &Number { what, value, unit }, limits.tip_speed);
        }
    }

    fn rate(&mut self, op: OpId, program: &Program, rate: RateId, limits: &ArmLimits) {
        if let Some(rate) = program.rates.get(usize::from(rate.0)) {
            let number = Number {
                what: "reorientation rate",
                value: rate.to_deg_per_s(),
                unit: "deg/s",
            };
            self.range(Some(op), &number, limits.rate);
        }
    }
}
