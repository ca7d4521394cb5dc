//! An intermediate program against what an interpreter makes of the emitted text.

use super::canon::{Canon, NOTHING, Position};
use vcutc_backend_api::ir::{Action, AxisKind, AxisValues, Cell, OpId, Ready, Switch};
use vcutc_backend_api::motion::{ReachableProgram, pose_after};
use vcutc_backend_api::stroke::Stroke;

/// What has to happen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Deed {
    /// All axes to these values, at whatever speed.
    Axes(Position),
    /// The tip straight to X Y Z, the rotary axes to A B C, in so many seconds.
    Straight(Position, f64),
    /// The generator is switched.
    Switch(u32, bool),
    /// A wait, in s.
    Wait(f64),
}

/// What has to happen by an intermediate program, with the op that asks for it. Waits for inputs are not among it: the
/// interpreter does not print them.
pub(super) fn deeds(program: &ReachableProgram) -> Vec<(OpId, Deed)> {
    let ir = program.program();
    let cell = ir.cell.as_ref().unwrap();
    let mut at = None;
    let mut deeds = Vec::new();
    for (id, op) in (0..).map(OpId).zip(&ir.ops) {
        let axes = program.axes_after(id).unwrap();
        let stroke = at.and_then(|from| Stroke::of(ir, from, &op.action));
        at = pose_after(at, &op.action);
        let deed = match (op.action, stroke) {
            (_, Some(stroke)) => {
                let mut to = words(cell, &axes);
                let tip = stroke.to.0;
                to[..3].copy_from_slice(&[tip.x, tip.y, tip.z]);
                Deed::Straight(to, stroke.duration().to_s())
            }
            (Action::Home | Action::AxisTravel { .. }, None) => Deed::Axes(words(cell, &axes)),
            (Action::Ultrasonic { state }, None) => {
                Deed::Switch(cell.ultrasonic.unwrap(), matches!(state, Switch::On))
            }
            (Action::AwaitReady, None) => match cell.ready {
                Ready::After(time) => Deed::Wait(time.to_s()),
                Ready::Input(_) => continue,
            },
            (Action::Dwell { time }, None) => Deed::Wait(time.to_s()),
            (action, None) => panic!("{id:?}: {action:?} is none of these programs"),
        };
        deeds.push((id, deed));
    }
    deeds
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

/// How far a program may be from what it should do, given the decimals that it prints.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tolerance {
    /// Of lengths, in mm.
    pub(super) length: f64,
    /// Of angles, in degrees.
    pub(super) angle: f64,
}

impl Tolerance {
    /// Half a unit of the last decimal that the program has, and half of one that the interpreter prints.
    pub(super) fn of_decimals(lengths: i32, angles: i32) -> Self {
        let half = |decimals: i32| 0.500_001 * 10.0_f64.powi(-decimals) + NOTHING;
        Self {
            length: half(lengths),
            angle: half(angles),
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

/// Whether a program does what it should, in the same order, and nothing else.
///
/// A motion that leads nowhere and an output that is as it was already may be said again, as parts of a program do; `values`
/// are what is put out to choose the kinematics.
pub(super) fn compare(deeds: &[(OpId, Deed)], canon: &[Canon], within: Tolerance) -> Result<(), String> {
    let mut ahead = deeds.iter().copied().peekable();
    let mut at: Option<Position> = None;
    let mut output: Option<(u32, bool)> = None;
    let mut has_ended = false;
    for did in canon {
        if has_ended {
            return Err(format!("{did:?} behind the end"));
        }
        if let Some((_, deed)) = ahead.peek()
            && carries_out(did, deed, within)
        {
            let _ = ahead.next();
        } else if !says_again(did, at.as_ref(), output) {
            return Err(format!("{did:?} where {:?} is wanted", ahead.peek()));
        }
        match *did {
            Canon::Feed { to, .. } | Canon::Traverse { to } => at = Some(to),
            Canon::Output { number, on } => output = Some((number, on)),
            Canon::End => has_ended = true,
            Canon::Dwell(_) | Canon::Value { .. } => {}
        }
    }
    match ahead.next() {
        Some(left) => Err(format!("{left:?} is never done")),
        None if !has_ended => Err("the program does not end".to_owned()),
        None => Ok(()),
    }
}

fn carries_out(did: &Canon, deed: &Deed, within: Tolerance) -> bool {
    match (did, deed) {
        (Canon::Feed { to, .. } | Canon::Traverse { to }, Deed::Axes(axes)) => within.is_there(to, axes),
        (Canon::Feed { to, seconds }, Deed::Straight(pose, time)) => {
            within.is_there(to, pose) && same_time(*seconds, *time)
        }
        (Canon::Output { number, on }, Deed::Switch(output, state)) => (number, on) == (output, state),
        (Canon::Dwell(seconds), Deed::Wait(time)) => same_time(*seconds, *time),
        (_, _) => false,
    }
}

/// Whether this changes nothing.
fn says_again(did: &Canon, at: Option<&Position>, output: Option<(u32, bool)>) -> bool {
    match did {
        Canon::Feed { to, .. } | Canon::Traverse { to } => {
            at.is_some_and(|at| (0..6).all(|axis| (at[axis] - to[axis]).abs() <= NOTHING))
        }
        // Outputs are off before a program begins.
        Canon::Output { number, on } => output.map_or(!on, |known| known == (*number, *on)),
        Canon::Value { .. } | Canon::End => true,
        Canon::Dwell(_) => false,
    }
}
