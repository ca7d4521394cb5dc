//! An intermediate program against what an interpreter makes of the emitted text.

use super::canon::{Canon, Control, Kinematics, NOTHING, Position, SPINDLE};
use vcutc_backend_api::arc::CircularArc;
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::ir::{
    Action, AxisKind, AxisValues, Cell, Changer, Joint, OpId, Ready, Spindle, Switch,
};
use vcutc_backend_api::motion::ReachableProgram;

/// What has to happen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Deed {
    /// All axes to these values, at whatever speed.
    Axes(Position),
    /// The tip straight to X, Y, Z, the rotary axes to A, B, C.
    Straight {
        /// Where it begins. The interpreter does not know this where the meaning of X, Y, Z has just changed from axes to tip.
        from: Position,
        /// Where it ends.
        to: Position,
        /// How long it takes.
        seconds: f64,
        /// How it ends.
        end: End,
    },
    /// The same on an arc.
    Round {
        /// Where it begins.
        from: Position,
        /// Where it ends.
        to: Position,
        /// The point about which the tip goes.
        centre: [f64; 3],
        /// The axis about which it goes, by the rule of the right hand.
        axis: [f64; 3],
        /// How long it takes.
        seconds: f64,
        /// How it ends.
        end: End,
    },
    /// The generator is switched.
    Switch(u32, bool),
    /// A wait, in s.
    Wait(f64),
    /// Another blade is put in.
    Change {
        /// From this place of the changer; by a person where there is no place.
        place: Option<u32>,
        /// Its length, in mm.
        length: f64,
    },
}

/// How a motion has to end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum End {
    /// Standing still.
    Exact,
    /// As it likes: it leads through the air, and so does the next.
    Free,
    /// Without a stop, the tip no farther from both ways than this, in mm.
    Through(f64),
}

/// What has to happen by an intermediate program, with the op that asks for it. Waits for inputs are not among it: the
/// interpreter does not print them.
pub(super) fn deeds(program: &ReachableProgram) -> Vec<(OpId, Deed)> {
    let ir = program.program();
    let cell = ir.cell.as_ref().unwrap();
    let mut deeds = Vec::new();
    let followers = ir.ops.iter().skip(1).map(Some).chain([None]);
    for (segment, next) in ir.segments().zip(followers) {
        let (id, op) = (segment.id, segment.op);
        let axes = program.axes_after(id).unwrap();
        let deed = match (op.action, segment.line()) {
            (_, Some(line)) => {
                let before = program.axes_after(OpId(id.0 - 1)).unwrap();
                let (from, to) = (pose(cell, line.from.tip, &before), pose(cell, line.to.tip, &axes));
                let seconds = line.duration().to_s();
                let end = end(&op.action, next.map(|next| &next.action), ir.blend.to_mm());
                match line.arc() {
                    Some(arc) => Deed::Round {
                        from,
                        to,
                        centre: turned(cell, arc.centre()),
                        axis: turned(cell, arc.axis()),
                        seconds,
                        end,
                    },
                    None => Deed::Straight {
                        from,
                        to,
                        seconds,
                        end,
                    },
                }
            }
            (Action::Home | Action::AxisTravel { .. } | Action::ChangePlace, None) => {
                Deed::Axes(words(cell, &axes))
            }
            (Action::Ultrasonic { state }, None) => {
                Deed::Switch(cell.ultrasonic.unwrap(), matches!(state, Switch::On))
            }
            (Action::Spin { state }, None) => {
                let output = match cell.spindle.unwrap() {
                    Spindle::Own => SPINDLE,
                    Spindle::Output(number) => number,
                };
                Deed::Switch(output, matches!(state, Switch::On))
            }
            (Action::AwaitReady, None) => match cell.ready {
                Ready::After(time) => Deed::Wait(time.to_s()),
                Ready::Input(_) => continue,
            },
            (Action::Dwell { time }, None) => Deed::Wait(time.to_s()),
            (Action::ToolChange { tool }, None) => {
                let by = cell.change.unwrap().by;
                let tool = cell.tools.at(tool);
                Deed::Change {
                    place: tool.place.filter(|_| by == Changer::Program),
                    length: tool.frame.frame.origin.z,
                }
            }
            (action, None) => panic!("{id:?}: {action:?} is none of these programs"),
        };
        deeds.push((id, deed));
    }
    deeds
}

/// How a motion has to end by what it is and what follows it. Cuts begin and end standing still, turns leave the tip where it
/// is, outputs are switched where the motion before them ends, and an approach ends at the work.
fn end(motion: &Action, next: Option<&Action>, blend: f64) -> End {
    match (motion, next) {
        (
            Action::Follow {
                joint: Joint::Through,
                ..
            },
            _,
        ) => End::Through(blend),
        (
            Action::Travel { .. } | Action::Retract { .. },
            Some(Action::Travel { .. } | Action::Approach { .. } | Action::Retract { .. }),
        ) => End::Free,
        (
            Action::Home
            | Action::Travel { .. }
            | Action::AxisTravel { .. }
            | Action::Approach { .. }
            | Action::Retract { .. }
            | Action::Cut { .. }
            | Action::Follow { .. }
            | Action::Turn { .. }
            | Action::Ultrasonic { .. }
            | Action::Spin { .. }
            | Action::AwaitReady
            | Action::Dwell { .. }
            | Action::ChangePlace
            | Action::ToolChange { .. },
            _,
        ) => End::Exact,
    }
}

/// Axis values as words: each in the place of its letter, the other places at 0.
fn words(cell: &Cell, axes: &AxisValues) -> Position {
    let mut words = [0.0; 6];
    for (axis, value) in cell.axes.iter().zip(axes.0) {
        let place = "XYZABC".find(&axis.name).unwrap();
        words[place] = match axis.kind {
            AxisKind::Linear => value,
            AxisKind::Rotary => value.to_degrees(),
        };
    }
    words
}

/// A direction or a way of the work as the work offset sees it, which is not turned when the work is.
fn turned(cell: &Cell, [x, y, z]: [f64; 3]) -> [f64; 3] {
    let base = cell.base.frame.orientation.matrix();
    base.map(|row| row[0] * x + row[1] * y + row[2] * z)
}

/// A tip and the rotary axes as words.
fn pose(cell: &Cell, tip: Point3, axes: &AxisValues) -> Position {
    let [_, _, _, a, b, c] = words(cell, axes);
    let [x, y, z] = turned(cell, tip.to_array());
    [x, y, z, a, b, c]
}

/// How far a program may be from what it should do, given the decimals that it prints.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tolerance {
    /// Of lengths, in mm.
    pub(super) length: f64,
    /// Of angles, in degrees.
    pub(super) angle: f64,
    /// By how much corners in the air may be cut, in mm.
    pub(super) corners: f64,
    /// The length of the first blade, in mm.
    pub(super) tool: f64,
}

impl Tolerance {
    /// Half a unit of the last decimal that the program has, and half of one that the interpreter prints.
    pub(super) fn of_decimals(lengths: i32, angles: i32, corners: f64, tool: f64) -> Self {
        let half = |decimals: i32| 0.500_001 * 10.0_f64.powi(-decimals) + NOTHING;
        Self {
            length: half(lengths),
            angle: half(angles),
            corners,
            tool,
        }
    }

    fn is_there(&self, is: &Position, should: &Position) -> bool {
        (0..6).all(|axis| {
            let most = if axis < 3 { self.length } else { self.angle };
            (is[axis] - should[axis]).abs() <= most
        })
    }
}

/// A time is kept to a thousandth of itself, and to a millisecond: the way it is measured by is rounded, and so is F.
fn same_time(is: f64, should: f64) -> bool {
    (is - should).abs() <= 1e-3 * should + 1e-3
}

/// What the machine is set to, and where it is. Nothing is known of either before a program says it.
#[derive(Clone, Copy, Debug, Default)]
struct Machine {
    at: Option<(Position, Kinematics)>,
    kinematics: Option<Kinematics>,
    control: Option<Control>,
    tool: Option<f64>,
    /// The length of the blade that was put in.
    blade: Option<f64>,
    output: Option<(u32, bool)>,
}

impl Machine {
    /// Whether it is set as a deed needs it: axis values mean the axes only without tip control, and tips the tip only with it,
    /// for the right blade.
    fn is_set_for(&self, deed: &Deed, within: Tolerance) -> bool {
        let stands_still = self.control == Some(Control::ExactStop);
        match deed {
            Deed::Axes(_) => self.kinematics == Some(Kinematics::Axes) && stands_still,
            Deed::Straight { end, .. } | Deed::Round { end, .. } => {
                let has_blade = self
                    .tool
                    .is_some_and(|tool| (tool - self.blade.unwrap_or(within.tool)).abs() <= NOTHING);
                let ends_well = match (end, self.control) {
                    (End::Exact, _) => stands_still,
                    (End::Free, Some(Control::Continuous { tolerance })) => tolerance <= within.corners,
                    (End::Free, Some(Control::ExactStop | Control::ExactPath)) => true,
                    (End::Through(within), Some(Control::Continuous { tolerance })) => tolerance <= *within,
                    (End::Free, None) | (End::Through(_), _) => false,
                };
                self.kinematics == Some(Kinematics::Tip) && has_blade && ends_well
            }
            Deed::Change { .. } => {
                let is_off = self.output.is_none_or(|(_, on)| !on);
                self.kinematics == Some(Kinematics::Axes) && stands_still && is_off
            }
            Deed::Switch(..) | Deed::Wait(_) => stands_still,
        }
    }

    /// Whether this changes nothing but what the machine is set to. The length of the blade belongs to the
    /// tip's kinematics, so with these on the axes would jump at another.
    fn takes_aside(&self, did: &Canon) -> bool {
        match *did {
            Canon::Feed { to, .. } | Canon::Traverse { to } => self.at.is_some_and(|(at, kinematics)| {
                Some(kinematics) == self.kinematics
                    && (0..6).all(|axis| (at[axis] - to[axis]).abs() <= NOTHING)
            }),
            // Outputs are off before a program begins.
            Canon::Output { number, on } => self.output.map_or(!on, |known| known == (number, on)),
            Canon::ToolLength(length) => {
                self.kinematics == Some(Kinematics::Axes) || self.tool == Some(length)
            }
            Canon::Kinematics(_) | Canon::Control(_) => true,
            Canon::End => self.kinematics == Some(Kinematics::Axes),
            Canon::Arc { .. } | Canon::Dwell(_) | Canon::ChangeTool(_) | Canon::Stop => false,
        }
    }

    fn after(self, did: &Canon) -> Self {
        match *did {
            Canon::Feed { to, .. } | Canon::Arc { to, .. } | Canon::Traverse { to } => Self {
                at: self.kinematics.map(|kinematics| (to, kinematics)),
                ..self
            },
            Canon::Output { number, on } => Self {
                output: Some((number, on)),
                ..self
            },
            Canon::Kinematics(kinematics) => Self {
                kinematics: Some(kinematics),
                ..self
            },
            Canon::Control(control) => Self {
                control: Some(control),
                ..self
            },
            Canon::ToolLength(length) => Self {
                tool: Some(length),
                ..self
            },
            Canon::Dwell(_) | Canon::ChangeTool(_) | Canon::Stop | Canon::End => self,
        }
    }
}

/// Whether a program does what it should, in the same order, and nothing else, with the machine set for it each time.
///
/// A motion that leads nowhere and an output that is as it was already may be said again, as parts of a program do.
pub(super) fn compare(deeds: &[(OpId, Deed)], canon: &[Canon], within: Tolerance) -> Result<(), String> {
    let mut ahead = deeds.iter().copied().peekable();
    let mut machine = Machine::default();
    let mut has_ended = false;
    for did in canon {
        if has_ended {
            return Err(format!("{did:?} behind the end"));
        }
        if let Some((id, deed)) = ahead.peek()
            && carries_out(did, deed, within)
        {
            if !machine.is_set_for(deed, within) {
                return Err(format!("{id:?}: {did:?} with {machine:?}"));
            }
            if let Some((_, Deed::Change { length, .. })) = ahead.next() {
                machine.blade = Some(length);
            }
        } else if !machine.takes_aside(did) {
            let wanted = ahead.peek();
            return Err(format!("{did:?} with {machine:?} where {wanted:?} is wanted"));
        }
        machine = machine.after(did);
        has_ended = matches!(did, Canon::End);
    }
    match ahead.next() {
        Some(left) => Err(format!("{left:?} is never done")),
        None if !has_ended => Err("the program does not end".to_owned()),
        None => Ok(()),
    }
}

/// The way that F counts along, by LinuxCNC's rule: that of the tip where it moves, that of the rotary axes otherwise.
fn way(from: &Position, to: &Position) -> f64 {
    let length = |axes: core::ops::Range<usize>| {
        let squares = axes.map(|axis| (to[axis] - from[axis]).powi(2));
        squares.sum::<f64>().sqrt()
    };
    match length(0..3) {
        along if along > NOTHING => along,
        _ => length(3..6),
    }
}

fn carries_out(did: &Canon, deed: &Deed, within: Tolerance) -> bool {
    match (did, deed) {
        (Canon::Feed { to, .. } | Canon::Traverse { to }, Deed::Axes(axes)) => within.is_there(to, axes),
        (
            Canon::Feed { to: there, rate },
            Deed::Straight {
                from, to, seconds, ..
            },
        ) => within.is_there(there, to) && same_time(way(from, to) / rate * 60.0, *seconds),
        (
            Canon::Arc {
                to: there,
                centre: is,
                axis: turns,
                rate,
            },
            Deed::Round {
                from,
                to,
                centre,
                axis,
                seconds,
                ..
            },
        ) => {
            let ends = [from, to].map(|[x, y, z, ..]| [*x, *y, *z]);
            let length = CircularArc::about(*is, *turns, ends).map(|arc| arc.length().to_mm());
            // The centre is the printed start and the printed way to it.
            let is_there = (0..3).all(|place| (is[place] - centre[place]).abs() <= 2.0 * within.length);
            let along: f64 = (0..3).map(|place| turns[place] * axis[place]).sum();
            within.is_there(there, to)
                && is_there
                && along > 1.0 - 1e-6
                && length.is_some_and(|length| same_time(length / rate * 60.0, *seconds))
        }
        (Canon::Output { number, on }, Deed::Switch(output, state)) => (number, on) == (output, state),
        (Canon::ChangeTool(is), Deed::Change { place, .. }) => Some(*is) == *place,
        (Canon::Stop, Deed::Change { place, .. }) => place.is_none(),
        (Canon::Dwell(seconds), Deed::Wait(time)) => same_time(*seconds, *time),
        (_, _) => false,
    }
}
