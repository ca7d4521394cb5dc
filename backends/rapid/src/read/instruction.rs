//! What an instruction of RAPID does, or that it is not known.
//!
//! Moves are known in the form in which programs for this machine may have them: by literal or named targets, with the tool
//! and the work object of the job, at speeds that are said, under modes that are said. Whatever is meant otherwise
//! (another tool, `ConfL\Off`, an offset) is not reported as a move, since it would lead elsewhere than the
//! text says.

use super::data::{Datum, SpeedData, View, Zone};
use super::sentence::{Optional, Value};
use crate::options::{CHANGE_ROUTINE, READY_SIGNAL, Settings, ULTRASONIC_SIGNAL, zone_members};
use vcutc_backend_api::geometry::Frame;
use vcutc_backend_api::ir::{Cell, Changer, PlacedFrame, Ready, Switch, Tool, ToolId};
use vcutc_backend_api::readback::{
    Circle, Command, Configuration, Effect, End, FrameSetting, Held, Pace, Target,
};
use vcutc_backend_api::units::{AngularSpeed, Duration, Length, Speed};

/// How far members of a zone may be from those of the job, in mm or deg: they are printed with six decimals.
const SAME_ZONE: f64 = 1e-6;

/// How far the attitude of a tool may be from that of the job, in degrees: quaternions are printed with six decimals or more.
const SAME_ATTITUDE_DEG: f64 = 1e-3;

/// The modes that are said to hold. What is not said is what a program before this one left behind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Modes {
    /// `ConfJ\On`.
    conf_j: bool,
    /// `ConfL\On`.
    conf_l: bool,
    /// `SingArea\Off`.
    sing_area: bool,
    /// `CirPathMode\ObjectFrame`, on which arcs alone depend.
    arcs: bool,
}

impl Modes {
    const fn are_said(self) -> bool {
        self.conf_j && self.conf_l && self.sing_area
    }
}

/// An instruction with its arguments. Names are in upper case.
#[derive(Clone, Copy, Debug)]
pub(super) struct Instruction<'s> {
    pub(super) name: &'s str,
    pub(super) required: &'s [Value],
    pub(super) optional: &'s [Optional],
}

/// For whom instructions are read.
#[derive(Clone, Copy)]
pub(super) struct Machine<'a> {
    pub(super) cell: &'a Cell,
    pub(super) settings: &'a Settings<'a>,
}

/// Whether an instruction of that name is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Known {
    Yes,
    No,
}

impl Machine<'_> {
    /// What an instruction says, and whether its name is known at all. Modes that it sets are kept.
    pub(super) fn effect(
        &self,
        instruction: Instruction<'_>,
        view: View<'_>,
        modes: &mut Modes,
    ) -> (Effect, Known) {
        let command = match instruction.name {
            "MOVEL" | "MOVEJ" | "MOVEABSJ" | "MOVEC" if !modes.are_said() => None,
            "MOVEL" | "MOVEJ" | "MOVEABSJ" => self.motion(instruction, view),
            "MOVEC" => self.arc(instruction, view).filter(|_| modes.arcs),
            "SETDO" => self.switch(instruction),
            "WAITDI" => self.await_input(instruction),
            "WAITTIME" => wait(instruction, view),
            "CONFJ" => return (mode(instruction, "ON", &mut modes.conf_j), Known::Yes),
            "CONFL" => return (mode(instruction, "ON", &mut modes.conf_l), Known::Yes),
            "SINGAREA" => return (mode(instruction, "OFF", &mut modes.sing_area), Known::Yes),
            "CIRPATHMODE" => return (mode(instruction, "OBJECTFRAME", &mut modes.arcs), Known::Yes),
            "ACCSET" => return (full(instruction, view, 100.0), Known::Yes),
            // The largest speed as a new program has it [A-INS], or more.
            "VELSET" => return (full(instruction, view, 5000.0), Known::Yes),
            "TPERASE" | "TPWRITE" => return (Effect::Setting, Known::Yes),
            _ => match self.change(instruction) {
                Some(change) => {
                    // A routine of the cell may leave other modes; a person who continues from `Stop` does not.
                    if self.cell.changer() == Some(Changer::Program) {
                        *modes = Modes::default();
                    }
                    Some(change)
                }
                None => return (Effect::Unknown, Known::No),
            },
        };
        (command.map_or(Effect::Unknown, Effect::Command), Known::Yes)
    }

    fn motion(&self, instruction: Instruction<'_>, view: View<'_>) -> Option<Command> {
        let [target, speed, zone, tool] = instruction.required else {
            return None;
        };
        let rest = self.frames(instruction.optional, tool, view)?;
        if instruction.name == "MOVEL" {
            return Some(Command::Straight {
                to: robtarget(target, view)?,
                pace: pace(view.speed(speed)?, &rest, view)?,
                end: self.end(view.zone(zone)?)?,
            });
        }
        self.is_axis_pace(speed, zone, view).then_some(())?;
        match (instruction.name, rest.as_slice()) {
            ("MOVEJ", []) => robtarget(target, view).map(Command::AxesToPose),
            ("MOVEABSJ", [only]) if only.name == "NOEOFFS" && only.value.is_none() => {
                view.jointtarget(target).map(Command::Axes)
            }
            (_, _) => None,
        }
    }

    /// A move on an arc, by a point on the way. How the blade would be held there has no effect.
    fn arc(&self, instruction: Instruction<'_>, view: View<'_>) -> Option<Command> {
        let [via, target, speed, zone, tool] = instruction.required else {
            return None;
        };
        let rest = self.frames(instruction.optional, tool, view)?;
        Some(Command::Round {
            on: Circle::Via(robtarget(via, view)?.tip),
            to: robtarget(target, view)?,
            pace: pace(view.speed(speed)?, &rest, view)?,
            end: self.end(view.zone(zone)?)?,
        })
    }

    /// The tool that a move names.
    fn tool(&self, named: &Value, view: View<'_>) -> Option<ToolId> {
        let Value::Name(name) = named else { return None };
        match view.find(name) {
            Some(Datum::Tool(id)) => Some(*id),
            Some(_) => None,
            None => {
                let kept = self
                    .cell
                    .tools
                    .iter()
                    .filter(|(_, tool)| tool.frame.number.is_some());
                let mut ids = kept.map(|(id, _)| id);
                ids.find(|id| name.eq_ignore_ascii_case(&self.settings.tool(self.cell, *id)))
            }
        }
    }

    /// The tool that an instruction moves with, and its frame; none for one that does not move.
    pub(super) fn moves_with(
        &self,
        instruction: Instruction<'_>,
        view: View<'_>,
    ) -> Option<(ToolId, FrameSetting)> {
        let named = match (instruction.name, instruction.required) {
            ("MOVEL" | "MOVEJ" | "MOVEABSJ", [_, _, _, named]) | ("MOVEC", [_, _, _, _, named]) => named,
            (_, _) => return None,
        };
        let id = self.tool(named, view)?;
        let PlacedFrame { frame, number } = self.cell.tools.get(id)?.frame;
        let setting = number.map_or(FrameSetting::Value(frame), FrameSetting::Number);
        Some((id, setting))
    }

    /// Whether a frame is that of a tool, as it is printed.
    pub(super) fn is_frame(&self, is: &Frame, tool: &Tool) -> bool {
        let should = tool.frame;
        let way = self.settings.common.lengths.half_unit();
        should.number.is_none()
            && is.origin.distance(should.frame.origin).to_mm() <= 4.0 * way
            && is.orientation.angle_to(should.frame.orientation).to_deg() <= SAME_ATTITUDE_DEG
    }

    /// The call of the routine that changes the blade, or a stop for a person who does.
    fn change(&self, instruction: Instruction<'_>) -> Option<Command> {
        let by = self.cell.changer()?;
        let routine = self.settings.given(CHANGE_ROUTINE);
        match (by, instruction.required, instruction.optional) {
            (Changer::Program, [Value::Number(place)], [])
                if routine.is_some_and(|routine| routine.eq_ignore_ascii_case(instruction.name)) =>
            {
                let mut places = self.cell.tools.iter().filter_map(|(_, tool)| tool.place);
                let place = places.find(|known| f64::from(*known) == *place)?;
                Some(Command::ChangeTool(Some(place)))
            }
            (Changer::Hand, [], []) if instruction.name == "STOP" => Some(Command::ChangeTool(None)),
            (Changer::Program | Changer::Hand, _, _) => None,
        }
    }

    /// The optional arguments other than `\WObj`. They are read if tool and work object are those that the program
    /// declares, whose values are reported where they are declared, or those of the controller that the job means.
    fn frames<'o>(
        &self,
        optional: &'o [Optional],
        tool: &Value,
        view: View<'_>,
    ) -> Option<Vec<&'o Optional>> {
        let (named, rest): (Vec<_>, Vec<_>) = optional.iter().partition(|argument| argument.name == "WOBJ");
        let [
            Optional {
                value: Some(Value::Name(work_object)),
                ..
            },
        ] = named.as_slice()
        else {
            return None;
        };
        let is_tool = self.tool(tool, view).is_some();
        let is_work_object = match view.find(work_object) {
            Some(datum) => *datum == Datum::WorkObject,
            None => {
                self.cell.base.number.is_some()
                    && work_object.eq_ignore_ascii_case(&self.settings.work_object(self.cell))
            }
        };
        (is_tool && is_work_object).then_some(rest)
    }

    /// Moves of all axes stop at their ends, and go as fast as the job says.
    fn is_axis_pace(&self, speed: &Value, zone: &Value, view: View<'_>) -> bool {
        let tip = view.speed(speed).map(|speed| speed.tip);
        tip == Some(f64::from(self.settings.home_speed)) && view.zone(zone) == Some(Zone::Fine)
    }

    /// A corner may be rounded in the zone that the job asks for, and a joint of a chain in one of those proportions.
    fn end(&self, zone: Zone) -> Option<End> {
        match zone {
            Zone::Fine => Some(End::Exact),
            Zone::Fly(members) => {
                let [path, ..] = members;
                let distance = Some(Length::mm(path)).filter(|distance| *distance > Length::ZERO)?;
                let alike = members.iter().zip(zone_members(distance));
                let is_one = alike
                    .into_iter()
                    .all(|(is, should)| (is - should).abs() <= SAME_ZONE);
                is_one.then(|| self.settings.common.left(distance))
            }
        }
    }

    fn switch(&self, instruction: Instruction<'_>) -> Option<Command> {
        let ([Value::Name(signal), value], []) = (instruction.required, instruction.optional) else {
            return None;
        };
        let state = match value {
            Value::Number(1.0) => Switch::On,
            Value::Number(0.0) => Switch::Off,
            Value::Name(name) if name == "HIGH" => Switch::On,
            Value::Name(name) if name == "LOW" => Switch::Off,
            Value::Number(_) | Value::Name(_) | Value::Text(_) | Value::List(_) | Value::Other => {
                return None;
            }
        };
        let is_named = |number: &u32| signal.eq_ignore_ascii_case(&self.settings.output(self.cell, *number));
        let own = self.cell.outputs().find(is_named);
        let other = || match self.settings.given(ULTRASONIC_SIGNAL) {
            Some(_) => None,
            None => numbered(signal, "DO"),
        };
        Some(Command::Switch {
            output: own.or_else(other)?,
            state,
        })
    }

    fn await_input(&self, instruction: Instruction<'_>) -> Option<Command> {
        let ([Value::Name(signal), value], []) = (instruction.required, instruction.optional) else {
            return None;
        };
        let is_high = match value {
            Value::Number(number) => *number == 1.0,
            Value::Name(name) => name == "HIGH",
            Value::Text(_) | Value::List(_) | Value::Other => false,
        };
        let input = match (self.settings.given(READY_SIGNAL), self.cell.ready) {
            (Some(name), Ready::Input(number)) => Some(number).filter(|_| signal.eq_ignore_ascii_case(name)),
            (Some(_), Ready::After(_)) => None,
            (None, _) => numbered(signal, "DI"),
        };
        is_high.then_some(Command::AwaitInput(input?))
    }
}

/// The number after the start of a signal's name, as the writer puts it there.
fn numbered(signal: &str, start: &str) -> Option<u32> {
    let digits = signal.strip_prefix(start)?;
    let number: u32 = digits.parse().ok()?;
    (number.to_string() == digits).then_some(number)
}

fn robtarget(value: &Value, view: View<'_>) -> Option<Target> {
    let target = view.robtarget(value)?;
    Some(Target {
        tip: target.tip,
        held: Held::Orientation(target.held, Some(Configuration(target.conf))),
    })
}

/// How fast a move goes: as its speeddata says, but for `\V`, a tip speed in its place, or `\T`, the time it takes.
fn pace(speed: SpeedData, rest: &[&Optional], view: View<'_>) -> Option<Pace> {
    let speeds = |tip: f64| Pace::Speeds {
        tip: Some(Speed::mm_per_s(tip)),
        turn: Some(AngularSpeed::deg_per_s(speed.turn)),
    };
    match rest {
        [] => Some(speeds(speed.tip)),
        [Optional { name, value }] => {
            let number = view.number(value.as_ref()?).filter(|number| *number > 0.0)?;
            match name.as_str() {
                "V" => Some(speeds(number)),
                "T" => Some(Pace::PerMinute(60.0 / number)),
                _ => None,
            }
        }
        [_, _, ..] => None,
    }
}

fn wait(instruction: Instruction<'_>, view: View<'_>) -> Option<Command> {
    let ([time], []) = (instruction.required, instruction.optional) else {
        return None;
    };
    let seconds = view.number(time).filter(|seconds| *seconds >= 0.0)?;
    Some(Command::Wait(Duration::s(seconds)))
}

/// A mode is known in the one form that programs have.
fn mode(instruction: Instruction<'_>, wanted: &str, holds: &mut bool) -> Effect {
    let is_wanted = matches!(
        (instruction.required, instruction.optional),
        ([], [only]) if only.name == wanted && only.value.is_none()
    );
    *holds = is_wanted;
    if is_wanted {
        Effect::Setting
    } else {
        Effect::Unknown
    }
}

/// `AccSet` and `VelSet` that take nothing away.
fn full(instruction: Instruction<'_>, view: View<'_>, second: f64) -> Effect {
    let ([one, other], []) = (instruction.required, instruction.optional) else {
        return Effect::Unknown;
    };
    let is_full =
        view.number(one) == Some(100.0) && view.number(other).is_some_and(|number| number >= second);
    if is_full { Effect::Setting } else { Effect::Unknown }
}
