//! Rules of generator and spindle: what drives the blade is up when it cuts, and off when it is changed.

use super::{Capability, Rule, Walk};
use crate::ir::{Ready, Spindle, Switch};
use crate::state::{Drive, State};

impl Walk<'_> {
    pub(super) fn ultrasonic(&mut self) {
        self.needs = self.needs.with(Capability::Output);
        self.require(self.is_wired(), Rule::TableReference);
    }

    pub(super) fn spin(&mut self, before: State, state: Switch) {
        match self.spindle() {
            Some(Spindle::Own) => self.needs = self.needs.with(Capability::Spindle),
            Some(Spindle::Output(_)) => self.needs = self.needs.with(Capability::Output),
            None => self.fault(Rule::TableReference),
        }
        let blade = self.program.blade(before.tool);
        let spins = blade.is_some_and(|blade| blade.spin().is_some());
        self.require(spins || state == Switch::Off, Rule::IdleSpindle);
    }

    pub(super) fn await_ready(&mut self, before: State) {
        let drives = [before.generator, before.spindle];
        self.require(drives.contains(&Drive::Starting), Rule::ReadyNotAwaited);
        let capability = match self.program.cell.as_ref().map(|cell| cell.ready) {
            Some(Ready::Input(_)) => Capability::AwaitInput,
            Some(Ready::After(_)) | None => Capability::Dwell,
        };
        self.needs = self.needs.with(capability);
    }

    /// The blade vibrates and spins as its kind does, where the machine drives it and the program cuts.
    pub(super) fn is_driven(&mut self, state: State) {
        let Some(blade) = self.program.blade(state.tool) else {
            return;
        };
        if !self.program.purpose.is_work() {
            return;
        }
        if self.is_wired() && blade.vibrates() {
            self.runs(state.generator, Rule::SilentCut);
        }
        if self.spindle().is_some() && blade.spin().is_some() {
            self.runs(state.spindle, Rule::StillCut);
        }
    }

    fn runs(&mut self, drive: Drive, off: Rule) {
        match drive {
            Drive::Off => self.fault(off),
            Drive::Starting => self.fault(Rule::ReadyNotAwaited),
            Drive::Running => {}
        }
    }

    /// Whether the machine has an output for the generator.
    fn is_wired(&self) -> bool {
        let cell = self.program.cell.as_ref();
        cell.is_some_and(|cell| cell.ultrasonic.is_some())
    }

    fn spindle(&self) -> Option<Spindle> {
        self.program.cell.as_ref()?.spindle
    }

    /// Whether a machine that is to carry out the program can spin its blades.
    pub(super) fn can_spin(&self) -> bool {
        let spins = self.program.blades.iter().any(|blade| blade.spin().is_some());
        !spins || self.program.cell.is_none() || self.spindle().is_some()
    }
}

/// Whether nothing drives the blade.
pub(super) fn is_still(state: State) -> bool {
    state.generator == Drive::Off && state.spindle == Drive::Off
}
