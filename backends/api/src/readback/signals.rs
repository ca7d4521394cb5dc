//! What a program does without moving: it switches generator and spindle, waits, and changes the blade.

use super::Command;
use super::comparator::{Comparator, Mismatch, Moment, Which};
use crate::ir::{Action, Blade, OpId, Ready, Spindle, Switch};
use crate::state::{Drive, State};
use crate::units::AngularSpeed;

/// Half of a turn a minute, the last place of a spindle's speed.
const HALF_A_TURN: f64 = 0.5 + 1e-9;

impl Comparator<'_> {
    /// In what a command is not the op at a moment, which moves nothing.
    pub(super) fn signal(
        &self,
        moment: Moment,
        action: Action,
        command: &Command,
        found: &mut Vec<Mismatch>,
    ) {
        let cell = self.program().cell.as_ref();
        match (action, command) {
            (Action::Ultrasonic { state }, Command::Switch { output, state: is }) => {
                let should = cell.and_then(|cell| cell.ultrasonic);
                output_is((*output, *is), (should, state), found);
            }
            (Action::Spin { state }, command) => match (cell.and_then(|cell| cell.spindle), command) {
                (Some(Spindle::Output(should)), Command::Switch { output, state: is }) => {
                    output_is((*output, *is), (Some(should), state), found);
                }
                (Some(Spindle::Own), Command::Spin(is)) => {
                    let should = self.spin(moment.before, state);
                    if !self.is_same_spin(*is, should) {
                        found.push(Mismatch::Spin { is: *is, should });
                    }
                }
                (_, _) => found.push(Mismatch::Kind),
            },
            (Action::AwaitReady, command) => match (cell.map(|cell| cell.ready), command) {
                (Some(Ready::Input(should)), &Command::AwaitInput(is)) => {
                    if is != should {
                        found.push(Mismatch::Input { is, should });
                    }
                }
                (Some(Ready::After(should)), Command::Wait(is)) => self.wait(*is, should, found),
                (_, _) => found.push(Mismatch::Kind),
            },
            (Action::ToolChange { tool }, &Command::ChangeTool(is)) => {
                let should = cell.and_then(|cell| cell.named_place(tool));
                if is != should {
                    found.push(Mismatch::ToolPlace { is, should });
                }
            }
            (Action::Dwell { time }, Command::Wait(is)) => self.wait(*is, time, found),
            (_, _) => found.push(Mismatch::Kind),
        }
    }

    /// How fast the blade at hand turns once the spindle is switched; none where it stands.
    fn spin(&self, at: State, state: Switch) -> Option<AngularSpeed> {
        let blade = self.program().blade(at.tool);
        blade.and_then(Blade::spin).filter(|_| state == Switch::On)
    }

    /// Whether two speeds of the spindle are the same within what is printed: whole turns a minute.
    fn is_same_spin(&self, is: Option<AngularSpeed>, should: Option<AngularSpeed>) -> bool {
        match (is, should) {
            (Some(is), Some(should)) => (is.to_rev_per_min() - should.to_rev_per_min()).abs() <= HALF_A_TURN,
            (None, None) => true,
            (Some(_), None) | (None, Some(_)) => false,
        }
    }

    /// Whether a command leaves everything as it is before an op: the move to where the machine stands already, the state of
    /// generator or spindle once more.
    #[must_use]
    pub fn restates(&self, moment: Moment, command: &Command) -> bool {
        let program = self.program();
        let cell = program.cell.as_ref();
        let before = moment.op.0.checked_sub(1).map(OpId);
        let stands = before.and_then(|before| self.reachable().axes_after(before));
        let generator = moment.before.generator;
        let runs = [generator, moment.before.spindle].contains(&Drive::Running);
        let mut found = Vec::new();
        match (command, before, moment.before.place.pose()) {
            (Command::Axes(is), _, _) => match stands {
                Some(should) => self.axes(is, &should, Which::All, &mut found),
                None => return false,
            },
            (Command::AxesToPose(target), Some(before), Some(pose)) => {
                self.target(before, target, pose, &mut found);
            }
            (Command::Switch { output, state }, _, _) => {
                let is_of =
                    |drive: Drive, number: Option<u32>| *state == drive.is_on() && number == Some(*output);
                let spindle = cell.and_then(|cell| cell.spindle);
                return is_of(generator, cell.and_then(|cell| cell.ultrasonic))
                    || is_of(moment.before.spindle, spindle.and_then(Spindle::output));
            }
            (Command::Spin(is), _, _) => {
                let runs = moment.before.spindle.is_on();
                let is_own = cell.and_then(|cell| cell.spindle) == Some(Spindle::Own);
                return is_own && self.is_same_spin(*is, self.spin(moment.before, runs));
            }
            (Command::AwaitInput(is), _, _) => {
                return runs && cell.is_some_and(|cell| cell.ready == Ready::Input(*is));
            }
            (Command::Wait(is), _, _) => match cell.map(|cell| cell.ready) {
                Some(Ready::After(should)) if runs => self.wait(*is, should, &mut found),
                _ => return false,
            },
            (
                Command::AxesToPose(_)
                | Command::Straight { .. }
                | Command::Round { .. }
                | Command::ChangeTool(_),
                _,
                _,
            ) => {
                return false;
            }
        }
        found.is_empty()
    }
}

fn output_is(is: (u32, Switch), should: (Option<u32>, Switch), found: &mut Vec<Mismatch>) {
    if (Some(is.0), is.1) != should {
        found.push(Mismatch::Output { is, should });
    }
}
