//! The rate of turning that a job states is the highest one: where an axis is too slow for it, the blade turns more slowly.
//!
//! The course of a motion is the same at any speed, so whether its axes keep their ranges does not depend on it. A program is
//! therefore carried out with all its turns at the lowest rate that is allowed ([`at_their_slowest`]), and then each motion that
//! turns the blade gets the highest of a few rates that is proven there ([`as_fast_as_followed`]). They are few, so that
//! programs stay easy to read. Cuts and ways along which the blade does not turn keep the speeds that the job states.

use crate::moves::paths;
use crate::path::{Course, Violation, prove};
use crate::reorient::known_or_new;
use crate::rigs::Rigs;
use crate::solve::{LEAST_CLEARANCE, Reached, SlowerTurns, Unreachable};
use vcutc_backend_api::ir::{Action, OpId, OperationId, Program};
use vcutc_backend_api::motion::{Branch, Motion};
use vcutc_backend_api::segments::{LinearSegment, Path};
use vcutc_backend_api::units::{AngularSpeed, Duration};
use vcutc_machine::Model;

/// The rates at which the blade may turn, as shares of the one that the job states. Slower than the last one it would turn for so
/// long that the work had better lie elsewhere.
const SHARES: [f64; 9] = [1.0, 0.9, 0.8, 0.7, 0.6, 0.5, 0.4, 0.32, 0.25];

/// The axis that is too slow for a motion that turns the blade, where that is what keeps a machine from a program, and how fast it
/// would have to move.
#[must_use]
pub fn too_slow(unreachable: &Unreachable) -> Option<(usize, f64)> {
    let failing = unreachable.trouble.hardest()?;
    let (axis, rate) = match failing.worst.what {
        Violation::Rate { axis, rate } => (axis, rate),
        Violation::OutOfReach | Violation::Limit { .. } | Violation::Singular(_) => return None,
    };
    let line = unreachable.program.program().segment(failing.op)?.line()?;
    line.turns().then_some((axis, rate))
}

/// A program whose blade turns at the lowest rate that is allowed; none where nothing turns it.
#[must_use]
pub fn at_their_slowest(program: &Program) -> Option<Program> {
    let lowest = SHARES.last().copied()?;
    let mut slowest = program.clone();
    let mut is_slower = false;
    for (op, line) in turning(program) {
        set(&mut slowest, op, at(&line, lowest)?)?;
        is_slower = true;
    }
    is_slower.then_some(slowest)
}

/// A program that is carried out as in the motion of the one with its slowest turns, with each turn as fast as its axes follow. None
/// where its table of rates has no room for another one.
#[must_use]
pub fn as_fast_as_followed(program: &Program, slowest: &Reached, model: &Model) -> Option<Program> {
    let rigs = Rigs::of(model, program.cell.as_ref()?, program);
    let motion = slowest.program.motion();
    let mut followed = program.clone();
    for (op, line) in turning(program) {
        if let Some(share) = highest_on(program, (op, &line), motion, &rigs).filter(|&share| share < 1.0) {
            set(&mut followed, op, at(&line, share)?)?;
        }
    }
    Some(followed)
}

/// A program with each turn at the lower of the rates that it has in two. None where the table of rates has no room for another one.
#[must_use]
pub fn slower_of(one: &Program, other: &Program) -> Option<Program> {
    let mut slower = one.clone();
    for (op, [rate, line]) in both(one, other) {
        if line.rate < rate.rate {
            set(&mut slower, op, line.rate?)?;
        }
    }
    Some(slower)
}

/// How many turns of a program are slower than as they are stated; none where all are as fast.
#[must_use]
pub fn figures(stated: &Program, slower: &Program, too_slow: (usize, f64)) -> Option<SlowerTurns> {
    let mut lowest: Option<(AngularSpeed, OpId)> = None;
    let mut count = 0;
    for (op, [fast, slow]) in both(stated, slower) {
        if slow.rate < fast.rate {
            count += 1;
            let rate = slow.rate?;
            if lowest.is_none_or(|(least, _)| rate < least) {
                lowest = Some((rate, op));
            }
        }
    }
    Some(SlowerTurns {
        slower: count,
        turning: turning(stated).count(),
        lowest: lowest?,
        longer: longer(stated, slower, |_| true),
        too_slow,
    })
}

/// How much longer the turns of an operation take than as they are stated.
#[must_use]
pub fn longer_in(stated: &Program, slower: &Program, operation: OperationId) -> Duration {
    let is_of_it = |op| {
        let op = slower.op(op);
        op.and_then(|op| op.site.operation()) == Some(operation)
    };
    longer(stated, slower, is_of_it)
}

fn longer(stated: &Program, slower: &Program, counts: impl Fn(OpId) -> bool) -> Duration {
    both(stated, slower)
        .filter(|(op, _)| counts(*op))
        .map(|(_, [fast, slow])| slow.duration() - fast.duration())
        .sum()
}

/// The motions that turn the blade in both of two programs that differ in their rates, and in what became axis moves.
fn both(one: &Program, other: &Program) -> impl Iterator<Item = (OpId, [LinearSegment; 2])> {
    let mut others = turning(other).peekable();
    turning(one).filter_map(move |(op, line)| {
        while others.next_if(|(other, _)| *other < op).is_some() {}
        let (_, same) = others.next_if(|(other, _)| *other == op)?;
        Some((op, [line, same]))
    })
}

/// The highest share of its rate at which the axes follow a motion; none of one that is carried out in another way.
fn highest_on(
    program: &Program,
    (op, line): (OpId, &LinearSegment),
    motion: &Motion,
    rigs: &Rigs<'_>,
) -> Option<f64> {
    let start = motion.ends.get((op.0 as usize).checked_sub(1)?)?;
    let branch = branch_of(motion, op)?;
    let rig = rigs.during(op);
    highest(line, 1.0, |line| {
        Course::of(program, line)
            .is_some_and(|course| prove(rig, &course, branch, &start.0, &LEAST_CLEARANCE).is_ok())
    })
}

/// The highest share of its rate, up to this one, at which a motion is followed. A motion that does not turn the blade has only its
/// own speed.
pub(crate) fn highest(
    line: &LinearSegment,
    most: f64,
    is_followed: impl Fn(&LinearSegment) -> bool,
) -> Option<f64> {
    let slowest = if line.turns() { 0.0 } else { 1.0 };
    let mut shares = SHARES.into_iter();
    shares.find(|&share| {
        share <= most
            && share >= slowest
            && is_followed(&LinearSegment {
                rate: at(line, share),
                ..*line
            })
    })
}

/// How much longer a motion takes at a share of its rate.
pub(crate) fn lengthened(line: &LinearSegment, share: f64) -> Duration {
    let slower = LinearSegment {
        rate: at(line, share),
        ..*line
    };
    slower.duration() - line.duration()
}

/// The rate of a motion at a share of what the job states.
pub(crate) fn at(line: &LinearSegment, share: f64) -> Option<AngularSpeed> {
    let rate = line.rate?;
    Some(if share < 1.0 { plain(rate, share) } else { rate })
}

/// The branch on which an op ends.
fn branch_of(motion: &Motion, op: OpId) -> Option<Branch> {
    let begun = motion.stretches.partition_point(|stretch| stretch.from <= op);
    Some(motion.stretches.get(begun.checked_sub(1)?)?.branch)
}

/// The straight motions that turn the blade.
fn turning(program: &Program) -> impl Iterator<Item = (OpId, LinearSegment)> {
    let lines = (0..).map(OpId).zip(paths(program));
    lines.filter_map(|(op, path)| {
        let (Path::Linear(line), Action::Travel { .. } | Action::Turn { .. }) =
            (path, program.op(op)?.action)
        else {
            return None;
        };
        line.turns().then_some((op, line))
    })
}

/// A share of a rate, as people like to write it: in whole degrees a second from ten on, else in tenths.
fn plain(rate: AngularSpeed, share: f64) -> AngularSpeed {
    let degrees = rate.to_deg_per_s() * share;
    let scale = if degrees >= 10.0 { 1.0 } else { 10.0 };
    let rounded = (degrees * scale).floor() / scale;
    AngularSpeed::deg_per_s(if rounded > 0.0 { rounded } else { degrees })
}

/// Gives an op another rate. None where the table of rates is full.
pub(crate) fn set(program: &mut Program, op: OpId, rate: AngularSpeed) -> Option<()> {
    let id = known_or_new(&mut program.rates, rate)?;
    let action = program.ops.get_mut(op.0 as usize).map(|op| &mut op.action);
    if let Some(Action::Travel { rate: known, .. } | Action::Turn { rate: known, .. }) = action {
        *known = id;
    }
    Some(())
}
