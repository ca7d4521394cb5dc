//! What the ops of a program move, compared with a walk that knows nothing of states: for every op it looks back through the ops
//! before it. The programs are those of the jobs in `tests/jobs`, whole and with random ops left out.

use crate::repository::root;
use proptest::prelude::*;
use std::fs;
use std::sync::LazyLock;
use vcutc_backend_api::exchange::Exchange;
use vcutc_backend_api::geometry::{Orientation, Point3};
use vcutc_backend_api::ir::{Action, Op, OpId, OrientationId, Program, Switch};
use vcutc_backend_api::segments::{LimitedBy, LinearSegment, Path, Segment};
use vcutc_backend_api::state::{Drive, Place, TipPose};

static PROGRAMS: LazyLock<Vec<Program>> = LazyLock::new(|| {
    let folders = fs::read_dir(root().join("tests/jobs")).unwrap();
    let mut files: Vec<_> = folders
        .map(|folder| folder.unwrap().path().join("ir.json"))
        .filter(|file| file.exists())
        .collect();
    files.sort();
    let read = files.iter().map(|file| {
        let form: Exchange<'_> = serde_json::from_str(&fs::read_to_string(file).unwrap()).unwrap();
        form.program.into_owned()
    });
    read.collect()
});

/// Where an op leads the tip.
fn tip_of(op: &Op) -> Option<Point3> {
    match op.action {
        Action::Travel { to, .. }
        | Action::AxisTravel { to, .. }
        | Action::Approach { to, .. }
        | Action::Retract { to, .. }
        | Action::Cut { to, .. }
        | Action::Follow { to, .. } => Some(to),
        _ => None,
    }
}

/// How an op leaves the blade turned.
fn orientation_of(op: &Op) -> Option<OrientationId> {
    match op.action {
        Action::Travel { orientation, .. }
        | Action::AxisTravel { orientation, .. }
        | Action::Follow { orientation, .. } => Some(orientation),
        Action::Turn { to, .. } => Some(to),
        _ => None,
    }
}

/// Where the machine is after some ops.
fn place_after(ops: &[Op]) -> Place {
    let loses_tip = |op: &Op| {
        matches!(
            op.action,
            Action::Home | Action::ChangePlace | Action::ToolChange { .. }
        )
    };
    let lost = ops.iter().rposition(loses_tip);
    let since = &ops[lost.map_or(0, |lost| lost + 1)..];
    // Only an op that states both leads from home, or from nowhere, to a pose.
    let states_both = |op: &Op| tip_of(op).is_some() && orientation_of(op).is_some();
    let Some(first) = since.iter().position(states_both) else {
        return match lost.map(|lost| (ops[lost].action, &ops[..lost])) {
            Some((Action::Home, _)) => Place::Home,
            Some((Action::ChangePlace, _)) => Place::Change,
            // A change of the blade moves no axis.
            Some((_, before)) => match place_after(before) {
                Place::Pose(_) => Place::Unknown,
                place => place,
            },
            None => Place::Unknown,
        };
    };
    let posed = &since[first..];
    Place::Pose(TipPose {
        tip: posed.iter().rev().find_map(tip_of).unwrap(),
        orientation: posed.iter().rev().find_map(orientation_of).unwrap(),
    })
}

fn generator_after(ops: &[Op]) -> Drive {
    ops.iter().fold(Drive::Off, |drive, op| match (op.action, drive) {
        (Action::Ultrasonic { state: Switch::On }, _) => Drive::Starting,
        (Action::Ultrasonic { state: Switch::Off }, _) => Drive::Off,
        (Action::AwaitReady, Drive::Starting) => Drive::Running,
        (_, drive) => drive,
    })
}

/// The angle of a rotation by the trace of its matrix, in rad.
fn angle(from: Orientation, to: Orientation) -> f64 {
    let (a, b) = (from.matrix(), to.matrix());
    let trace: f64 = (0..3)
        .flat_map(|row| (0..3).map(move |column| (row, column)))
        .map(|(row, column)| a[row][column] * b[row][column])
        .sum();
    ((trace - 1.0) / 2.0).clamp(-1.0, 1.0).acos()
}

/// Seconds that the tip and the turn of a straight op need, each on its own.
fn seconds(program: &Program, op: &Op, from: TipPose, to: TipPose) -> [f64; 2] {
    let (feed, rate) = match op.action {
        Action::Travel { feed, rate, .. } | Action::Follow { feed, rate, .. } => (Some(feed), Some(rate)),
        Action::Approach { feed, .. } | Action::Retract { feed, .. } | Action::Cut { feed, .. } => {
            (Some(feed), None)
        }
        Action::Turn { rate, .. } => (None, Some(rate)),
        other => panic!("{other:?} is not straight"),
    };
    let way = libm::hypot(
        libm::hypot(to.tip.x - from.tip.x, to.tip.y - from.tip.y),
        to.tip.z - from.tip.z,
    );
    let held = |pose: TipPose| program.orientations[pose.orientation.0 as usize];
    let turn = angle(held(from), held(to));
    [
        feed.map_or(0.0, |id| way / program.feeds[usize::from(id.0)].to_mm_per_s()),
        rate.map_or(0.0, |id| turn / program.rates[usize::from(id.0)].to_rad_per_s()),
    ]
}

fn is_straight(program: &Program, op: &Op, before: Place, line: &LinearSegment) {
    let Place::Pose(from) = before else {
        panic!("{op:?} is straight from {before:?}");
    };
    let to = TipPose {
        tip: tip_of(op).unwrap_or(from.tip),
        orientation: orientation_of(op).unwrap_or(from.orientation),
    };
    assert_eq!((line.from, line.to), (from, to), "{op:?}");
    let [moving, turning] = seconds(program, op, from, to);
    // The trace of a matrix gives small angles to half the digits only.
    let near = |a: f64, b: f64| (a - b).abs() < 1e-6;
    assert!(
        near(line.duration().to_s(), moving.max(turning)),
        "{op:?}: {line:?}"
    );
    match line.limited_by() {
        None => assert!(moving.max(turning) < 1e-6, "{op:?}"),
        Some(LimitedBy::Feed(_)) => assert!(moving > turning - 1e-6, "{op:?}"),
        Some(LimitedBy::Rate(_)) => assert!(turning > moving - 1e-6, "{op:?}"),
    }
}

fn is_as_walked(program: &Program, index: usize, segment: &Segment<'_>) {
    let (op, past) = (&program.ops[index], &program.ops[..index]);
    assert_eq!(segment.id, OpId(u32::try_from(index).unwrap()));
    assert_eq!(segment.op, op);
    assert_eq!(segment.before.place, place_after(past), "{op:?}");
    assert_eq!(segment.before.generator, generator_after(past), "{op:?}");
    assert_eq!(
        segment.end(),
        place_after(&program.ops[..=index]).pose(),
        "{op:?}"
    );
    let before = segment.before.place;
    match (op.action, before.pose(), segment.path()) {
        (Action::Home, _, Path::Home) | (Action::ChangePlace, _, Path::Change) => {}
        (Action::AxisTravel { to: tip, orientation }, _, Path::Axes(to))
        | (
            Action::Travel {
                to: tip, orientation, ..
            }
            | Action::Follow {
                to: tip, orientation, ..
            },
            None,
            Path::Axes(to),
        ) => {
            assert_eq!(to, TipPose { tip, orientation });
        }
        (
            Action::Travel { .. }
            | Action::Approach { .. }
            | Action::Retract { .. }
            | Action::Cut { .. }
            | Action::Follow { via: None, .. }
            | Action::Turn { .. },
            Some(_),
            Path::Linear(line),
        ) => is_straight(program, op, before, &line),
        (
            Action::Approach { .. } | Action::Retract { .. } | Action::Cut { .. } | Action::Turn { .. },
            None,
            Path::Still,
        )
        | (
            Action::Ultrasonic { .. }
            | Action::Spin { .. }
            | Action::AwaitReady
            | Action::Dwell { .. }
            | Action::ToolChange { .. },
            _,
            Path::Still,
        ) => {}
        (action, _, path) => panic!("{action:?} from {before:?} moves {path:?}"),
    }
}

/// Every `step`th op, because the walk looks back through all ops before it.
fn compare(program: &Program, step: usize) {
    let mut segments = program.segments();
    assert_eq!(segments.len(), program.ops.len());
    for (index, segment) in segments.by_ref().enumerate().step_by(step) {
        is_as_walked(program, index, &segment);
    }
    let middle = program.ops.len() / 2;
    if let Some(begin) = program.segment(OpId(u32::try_from(middle).unwrap())) {
        let tail = program.segments_of(middle..program.ops.len(), begin.before);
        assert!(tail.eq(program.segments().skip(middle)), "from {begin:?} on");
    }
    assert_eq!(segments.state().place, place_after(&program.ops));
    assert_eq!(segments.state().generator, generator_after(&program.ops));
}

#[test]
fn whole_programs_move_as_they_are_walked() {
    assert!(PROGRAMS.len() > 15);
    for program in &*PROGRAMS {
        compare(program, 1);
    }
}

proptest! {
    #[test]
    fn programs_with_gaps_move_as_they_are_walked(
        which in any::<prop::sample::Index>(),
        left_out in prop::collection::vec(any::<prop::sample::Index>(), 1..40),
        begin in 0_usize..60,
    ) {
        let mut program = which.get(&PROGRAMS).clone();
        program.ops.drain(..begin.min(program.ops.len()));
        for index in left_out {
            if !program.ops.is_empty() {
                program.ops.remove(index.index(program.ops.len()));
            }
        }
        compare(&program, 7);
    }
}

/// A program that refers to speeds that it does not have is walked all the same; its verifier says what is wrong.
#[test]
fn ops_of_unknown_speeds_move_nothing() {
    let mut program = PROGRAMS[0].clone();
    program.feeds.clear();
    for (index, segment) in program.segments().enumerate() {
        let is_line = matches!(segment.path(), Path::Linear(_));
        assert_eq!(
            is_line,
            matches!(segment.op.action, Action::Turn { .. }),
            "{segment:?}"
        );
        let place = place_after(&program.ops[..=index]);
        assert_eq!(segment.end(), place.pose(), "{segment:?}");
    }
}
