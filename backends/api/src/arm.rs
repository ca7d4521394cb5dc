//! What controllers of arms with six axes do not take, as far as it is the same for all of them but for the numbers.

use crate::backend::MachineMismatch;
use crate::findings::{Findings, Number};
use crate::ir::{Action, AxisKind, Cell, Load, MOST_AXES, MachineKind, Maker, OpId, PlacedFrame};
use crate::motion::{ReachableProgram, Stretch};
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

/// What sets the machine of a program apart from the arms of a maker: those with six rotary axes, of which the dialect names
/// every configuration that the motion uses.
pub fn foreign_arm(
    program: &ReachableProgram,
    cell: &Cell,
    wanted: Maker,
    is_named: impl Fn(&Stretch) -> bool,
) -> Option<MachineMismatch> {
    let mut kinds = cell.axes.iter().map(|axis| axis.kind);
    let is_arm = cell.axes.len() == MOST_AXES
        && kinds.all(|kind| kind == AxisKind::Rotary)
        && program.motion().stretches.iter().all(is_named);
    foreign(cell.kind, cell.maker, wanted).or((!is_arm).then_some(MachineMismatch::Arm))
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
        for (id, op) in (0..).map(OpId).zip(&tables.ops) {
            let action = &op.action;
            self.op(id, action);
            if let Some(to) = action.tip() {
                self.point(Some(id), ["X", "Y", "Z"], to, limits.farthest_mm);
            }
            if let Some(via) = action.via().and_then(|via| tables.via(via)) {
                self.point(Some(id), ["X", "Y", "Z"], via, limits.farthest_mm);
            }
            if let Some(feed) = action.feed().and_then(|feed| tables.feed(feed)) {
                let (value, unit) = limits.speed_unit.of(feed);
                let what = "tip speed";
                self.range(Some(id), &Number { what, value, unit }, limits.tip_speed);
            }
            if let Some(rate) = action.rate().and_then(|rate| tables.rate(rate)) {
                let number = Number {
                    what: "reorientation rate",
                    value: rate.to_deg_per_s(),
                    unit: "deg/s",
                };
                self.range(Some(id), &number, limits.rate);
            }
            also(self, id, action);
        }
    }

    /// The origin of a frame that the program states itself, and not the controller.
    pub fn frame(&mut self, names: [&'static str; 3], placed: PlacedFrame, limits: &ArmLimits) {
        if placed.number.is_none() {
            self.point(None, names, placed.frame.origin, limits.farthest_mm);
        }
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
}
