//! Programs that are reported faithfully are followed to their end. Where one statement is reported wrongly,
//! they are followed up to it.

use super::{
    Circle, Command, Comparator, Configuration, Divergence, DivergenceKind, Effect, End, FrameRole,
    FrameSetting, Frames, Held, Mismatch, Pace, Place, Reader, Replay, Resolution, Sources, Statement,
    Target,
};
use crate::geometry::{Orientation, Point3};
use crate::ir::Spindle;
use crate::ir::{Action, AxisValues, Joint, OpId, Program, Ready, Switch};
use crate::motion::{Branch, Motion, ReachableProgram, Waypoint, Wrist};
use crate::options::Options;
use crate::segments::LinearSegment;
use crate::testkit::{Crossing, Recipe, axes_at, blade_in_work, chained, reachable, samples};
use crate::units::{Angle, AngularSpeed, Duration, Length, Speed};
use crate::verify::verify;
use proptest::prelude::*;

/// A dialect that says everything, and prints three decimals.
struct Plain;

const RESOLUTION: Resolution = Resolution {
    length: Length::mm(0.0005),
    attitude: Angle::rad(1e-5),
    axis: Angle::rad(1e-5),
    speed: Speed::mm_per_s(0.0005),
    rate: AngularSpeed::rad_per_s(1e-5),
    per_minute: 0.0005,
    time: Duration::s(0.0005),
};

impl Reader for Plain {
    fn recognises(&self, _file: &str) -> bool {
        true
    }
    fn resolution(&self, _options: &Options) -> Resolution {
        RESOLUTION
    }
    fn frames(&self) -> Frames {
        Frames::InProgram
    }
    fn configuration(&self, branch: Branch, axes: AxisValues) -> Option<Configuration> {
        let Branch::Arm { wrist, .. } = branch else {
            return None;
        };
        Some(Configuration([
            i32::from(wrist == Wrist::Negative),
            i32::from(axes.0[3] < 0.0),
            0,
            0,
        ]))
    }
    fn read(&self, _sources: Sources<'_>, _heed: &mut dyn FnMut(Statement)) {}
}

fn target(program: &ReachableProgram, op: OpId, tip: Point3, orientation: Orientation) -> Target {
    let axes = program.axes_after(op).unwrap();
    let configuration = Plain.configuration(program.branch_after(op).unwrap(), axes);
    Target {
        tip,
        held: Held::Orientation(orientation, configuration),
    }
}

/// What the ops of a program say, put as commands.
fn commands_of(reachable: &ReachableProgram) -> Vec<Command> {
    let program = reachable.program();
    let cell = program.cell.as_ref().unwrap();
    let mut commands = Vec::new();
    for segment in program.segments() {
        let target = || {
            let there = program.frame(segment.end().unwrap()).unwrap();
            target(reachable, segment.id, there.origin, there.orientation)
        };
        commands.push(match segment.op.action {
            Action::Home => Command::Axes(cell.home.unwrap()),
            Action::AxisTravel { .. } => Command::AxesToPose(target()),
            Action::Ultrasonic { state } => Command::Switch {
                output: cell.ultrasonic.unwrap(),
                state,
            },
            Action::Spin { state } => match cell.spindle.unwrap() {
                Spindle::Output(output) => Command::Switch { output, state },
                Spindle::Own => {
                    let spin = program.blade(segment.before.tool).unwrap().spin();
                    Command::Spin(spin.filter(|_| state == Switch::On))
                }
            },
            Action::AwaitReady => match cell.ready {
                Ready::Input(input) => Command::AwaitInput(input),
                Ready::After(time) => Command::Wait(time),
            },
            Action::Dwell { time } => Command::Wait(time),
            Action::Travel { .. }
            | Action::Approach { .. }
            | Action::Retract { .. }
            | Action::Cut { .. }
            | Action::Turn { .. } => {
                let line = segment.line().unwrap();
                Command::Straight {
                    to: target(),
                    pace: speeds(&line),
                    end: End::Exact,
                }
            }
            Action::Follow { joint, .. } => {
                let line = segment.line().unwrap();
                let end = match joint {
                    Joint::Through => End::Through {
                        within: program.blend,
                    },
                    Joint::Stop => End::Exact,
                };
                let (to, pace) = (target(), speeds(&line));
                match line.via {
                    Some(via) => Command::Round {
                        on: Circle::Via(via),
                        to,
                        pace,
                        end,
                    },
                    None => Command::Straight { to, pace, end },
                }
            }
            Action::ChangePlace => Command::Axes(cell.change.unwrap().at),
            Action::ToolChange { tool } => Command::ChangeTool(cell.tools.at(tool).place),
        });
    }
    commands
}

fn speeds(line: &LinearSegment) -> Pace {
    Pace::Speeds {
        tip: line.feed,
        turn: line.rate,
    }
}

fn frames(program: &Program) -> Vec<Effect> {
    let cell = program.cell.as_ref().unwrap();
    let frames = [
        (FrameRole::Tool, cell.tools.first().frame),
        (FrameRole::Base, cell.base),
    ];
    let effect = frames.map(|(role, placed)| {
        let value = FrameSetting::Value(placed.frame);
        Effect::Frame(role, placed.number.map_or(value, FrameSetting::Number))
    });
    effect.to_vec()
}

fn replayed(reachable: &ReachableProgram, effect: Vec<Effect>) -> Result<Vec<Place>, Divergence> {
    let mut replay = Replay::new(Comparator::new(reachable, &Plain, RESOLUTION), Plain.frames());
    for (start, effect) in (0..).zip(effect) {
        let end = start + 1;
        let place = Place { file: 0, start, end };
        replay.take(&Statement { place, effect });
    }
    replay.finish()
}

/// The frames, and then commands.
fn whole(reachable: &ReachableProgram, commands: impl IntoIterator<Item = Command>) -> Vec<Effect> {
    let commands = commands.into_iter().map(Effect::Command);
    frames(reachable.program()).into_iter().chain(commands).collect()
}

fn sample() -> ReachableProgram {
    let recipe = Recipe {
        operations: 2,
        crossing: Crossing::ByAxes,
        dwell: Some(Duration::s(0.25)),
        ..Recipe::default()
    };
    let program = chained(recipe.program(), Angle::deg(60.0), Length::mm(0.1));
    reachable(verify(program).unwrap()).unwrap()
}

#[test]
fn faithful_programs_are_followed_op_by_op() {
    let all = samples().unwrap().into_iter().chain([("chain", sample())]);
    for (name, program) in all {
        let commands = commands_of(&program);
        let count = commands.len();
        let replayed = replayed(&program, whole(&program, commands)).unwrap();
        let starts: Vec<u32> = replayed.iter().map(|place| place.start).collect();
        assert_eq!(starts, (2..).take(count).collect::<Vec<u32>>(), "{name}");
    }
}

#[test]
fn a_dropped_deed_is_missed_unless_nothing_would_change() {
    let program = sample();
    let commands = commands_of(&program);
    for drop in 0..commands.len() {
        let mut shorter = commands.clone();
        shorter.remove(drop);
        let divergence = replayed(&program, whole(&program, shorter)).unwrap_err();
        assert!(
            divergence.op.is_some_and(|op| op.0 as usize >= drop),
            "{divergence:?}"
        );
    }
}

#[test]
fn swapped_deeds_are_noticed_unless_they_are_equal() {
    let program = sample();
    let commands = commands_of(&program);
    for first in 1..commands.len() {
        let mut swapped = commands.clone();
        swapped.swap(first - 1, first);
        if swapped != commands {
            let divergence = replayed(&program, whole(&program, swapped)).unwrap_err();
            assert!(divergence.op.unwrap().0 as usize >= first - 1);
        }
    }
}

#[test]
fn one_deed_more_is_one_too_many() {
    let program = sample();
    let commands = commands_of(&program);
    for repeated in 0..commands.len() {
        let mut longer = commands.clone();
        longer.insert(repeated, commands[repeated]);
        assert!(replayed(&program, whole(&program, longer)).is_err(), "{repeated}");
    }
    let after = commands.iter().copied().chain([commands[0]]);
    let divergence = replayed(&program, whole(&program, after)).unwrap_err();
    assert_eq!((divergence.op, divergence.what), (None, DivergenceKind::More));
}

/// At the head of a part the state of the machine may be said once more, and nothing else.
#[test]
fn parts_restate_what_holds() {
    let program = sample();
    let commands = commands_of(&program);
    let ops = &program.program().ops;
    let retracted = |op: &crate::ir::Op| matches!(op.action, Action::Retract { .. });
    let cut = ops.iter().position(retracted).unwrap() + 1;
    let (before, after) = commands.split_at(cut);
    let pose = {
        let last = program.program().segments().nth(cut - 1).unwrap();
        let there = program.program().frame(last.end().unwrap()).unwrap();
        Command::AxesToPose(target(&program, last.id, there.origin, there.orientation))
    };
    let cell = program.program().cell.as_ref().unwrap();
    let on = Command::Switch {
        output: cell.ultrasonic.unwrap(),
        state: Switch::On,
    };
    let off = Command::Switch {
        output: cell.ultrasonic.unwrap(),
        state: Switch::Off,
    };
    let Ready::After(time) = cell.ready else { panic!() };
    let with = |part: Option<Effect>, restated: &[Command]| {
        let mut effect = whole(&program, before.iter().copied());
        let begins = part.is_some();
        effect.extend(part);
        if begins {
            effect.extend(frames(program.program()));
        }
        effect.extend(restated.iter().chain(after).copied().map(Effect::Command));
        replayed(&program, effect).is_ok()
    };
    let begins = || Some(Effect::PartBegins);
    assert!(with(begins(), &[]));
    assert!(with(begins(), &[pose, on, Command::Wait(time)]));
    assert!(!with(None, &[pose]));
    assert!(!with(begins(), &[off]));
    assert!(!with(begins(), &[Command::Wait(time * 2.0)]));
    assert!(!with(begins(), &[commands[1]]));
}

#[test]
fn frames_come_first_and_have_their_values() {
    let program = sample();
    let commands: Vec<Effect> = commands_of(&program).into_iter().map(Effect::Command).collect();
    let frames = frames(program.program());
    let kind = |effect: Vec<Effect>| replayed(&program, effect).map_err(|divergence| divergence.what);
    let without_base = frames.iter().take(1).chain(&commands).cloned().collect();
    assert_eq!(kind(without_base), Err(DivergenceKind::NoFrame(FrameRole::Base)));
    let Effect::Frame(_, tool) = frames[0].clone() else {
        panic!()
    };
    let moved = match tool {
        FrameSetting::Value(mut frame) => {
            frame.origin.z += 0.002;
            FrameSetting::Value(frame)
        }
        FrameSetting::Number(_) => panic!(),
    };
    for setting in [moved, FrameSetting::Number(1)] {
        let effect = [Effect::Frame(FrameRole::Tool, setting)];
        let effect = effect
            .into_iter()
            .chain(frames.clone())
            .chain(commands.clone())
            .collect();
        assert_eq!(kind(effect), Err(DivergenceKind::Frame(FrameRole::Tool)));
    }
}

#[test]
fn what_is_not_understood_is_never_passed_over() {
    let program = sample();
    for effect in [
        Effect::Unknown,
        Effect::Unreadable {
            expected: "a number".to_owned(),
        },
    ] {
        let mut all = whole(&program, commands_of(&program));
        all.insert(7, effect);
        let divergence = replayed(&program, all).unwrap_err();
        assert_eq!(divergence.what, DivergenceKind::NotUnderstood);
        assert_eq!(divergence.place.unwrap().start, 7);
    }
}

/// The way of a long turn may be said in steps, at its waypoints and nowhere else.
#[test]
fn waypoints_are_passed_in_their_order() {
    let program = sample();
    let ops = &program.program().ops;
    let turn = ops
        .iter()
        .position(|op| matches!(op.action, Action::Turn { .. }))
        .unwrap();
    let segment = program.program().segments().nth(turn).unwrap();
    let (op, line) = (segment.id, segment.line().unwrap());
    let (before, after) = (
        program.axes_after(OpId(op.0 - 1)).unwrap(),
        program.axes_after(op).unwrap(),
    );
    let Some(Branch::Arm { wrist, .. }) = program.branch_after(op) else {
        panic!()
    };
    let waypoint = |done: f64| {
        let frame = line.frame_at(program.program(), done).unwrap();
        let near = AxisValues(core::array::from_fn(|axis| {
            before.0[axis] + (after.0[axis] - before.0[axis]) * done
        }));
        Waypoint {
            op,
            done,
            frame,
            axes: axes_at(frame.origin, frame.orientation, wrist, near),
        }
    };
    let motion = Motion {
        waypoints: vec![waypoint(0.3), waypoint(0.6)],
        ..program.motion().clone()
    };
    let program =
        ReachableProgram::assemble(program.verified().clone(), motion, &|_, axes| blade_in_work(axes))
            .unwrap();
    let commands = commands_of(&program);
    let Command::Straight { pace, .. } = commands[turn] else {
        panic!()
    };
    let step = |waypoint: &Waypoint| Command::Straight {
        to: Target {
            tip: waypoint.frame.origin,
            held: Held::Orientation(
                waypoint.frame.orientation,
                Plain.configuration(program.branch_after(op).unwrap(), waypoint.axes),
            ),
        },
        pace,
        end: End::Exact,
    };
    let steps: Vec<Command> = program.motion().waypoints.iter().map(step).collect();
    let with = |steps: &[Command]| {
        let mut commands = commands.clone();
        commands.splice(turn..turn, steps.iter().copied());
        replayed(&program, whole(&program, commands)).is_ok()
    };
    assert!(with(&steps));
    assert!(with(&[]));
    assert!(!with(&[steps[1], steps[0]]));
    assert!(!with(&[steps[0], steps[0]]));
}

fn tip_moved(mut tip: Point3, which: usize, by: f64) -> Option<Point3> {
    let coordinate = match which {
        0 => &mut tip.x,
        1 => &mut tip.y,
        2 => &mut tip.z,
        _ => return None,
    };
    *coordinate += by * RESOLUTION.length.to_mm();
    Some(tip)
}

/// Each number of a command that the op says.
fn nudged(command: Command, which: usize, by: f64) -> Option<Command> {
    let tip = |target: Target| {
        let tip = tip_moved(target.tip, which, by)?;
        Some(Target { tip, ..target })
    };
    match command {
        Command::Axes(mut values) => {
            *values.0.get_mut(which)? += by * RESOLUTION.axis.to_rad();
            Some(Command::Axes(values))
        }
        Command::AxesToPose(target) => tip(target).map(Command::AxesToPose),
        Command::Straight { to, pace, end } => match (which, pace) {
            (0..=2, _) => tip(to).map(|to| Command::Straight { to, pace, end }),
            (
                3,
                Pace::Speeds {
                    tip: Some(speed),
                    turn,
                },
            ) => Some(Command::Straight {
                to,
                pace: Pace::Speeds {
                    tip: Some(speed + RESOLUTION.speed * by),
                    turn,
                },
                end,
            }),
            _ => None,
        },
        Command::Round { on, to, pace, end } => match on {
            Circle::Via(via) if which > 2 => {
                let moved = tip_moved(via, which - 3, by)?;
                let on = Circle::Via(moved);
                Some(Command::Round { on, to, pace, end })
            }
            Circle::Via(_) | Circle::About { .. } => tip(to).map(|to| Command::Round { on, to, pace, end }),
        },
        Command::Wait(time) => (which == 0).then(|| Command::Wait(time + RESOLUTION.time * by)),
        Command::Switch { .. } | Command::Spin(_) | Command::AwaitInput(_) | Command::ChangeTool(_) => None,
    }
}

proptest! {
    /// Half a unit of the last place is rounding; a whole one is another number.
    #[test]
    fn numbers_are_held_to_what_is_printed(
        place in any::<proptest::sample::Index>(),
        which in 0_usize..6,
        within in -1.0..1.0_f64,
        beyond in prop_oneof![-9.0..-1.1_f64, 1.1..9.0_f64],
    ) {
        let program = sample();
        let mut commands = commands_of(&program);
        let place = place.index(commands.len());
        let command = commands[place];
        if let Some(near) = nudged(command, which, within) {
            commands[place] = near;
            prop_assert!(replayed(&program, whole(&program, commands.clone())).is_ok());
        }
        if let Some(far) = nudged(command, which, beyond) {
            commands[place] = far;
            let divergence = replayed(&program, whole(&program, commands)).unwrap_err();
            prop_assert_eq!(divergence.op.unwrap().0 as usize, place);
            let DivergenceKind::Differs(found) = divergence.what else { panic!() };
            prop_assert!(found.iter().all(|mismatch| *mismatch != Mismatch::Kind));
        }
    }

    /// Rates of turning are rounded down: by less than a unit of the last place, and never up.
    #[test]
    fn rates_are_never_above_the_plan(
        place in any::<proptest::sample::Index>(),
        below in 0.0..1.9_f64,
        off in prop_oneof![-9.0..-0.1_f64, 2.1..9.0_f64],
    ) {
        let program = sample();
        let commands = commands_of(&program);
        let turning = |(place, command): (usize, &Command)| match command {
            Command::Straight { to, pace: Pace::Speeds { tip, turn: Some(rate) }, end } => Some((place, *to, *tip, *rate, *end)),
            _ => None,
        };
        // Travels that keep the blade as it is have a rate, too, and it does not matter.
        let is_turn = |place: &usize| matches!(program.program().ops[*place].action, Action::Turn { .. });
        let turns: Vec<_> = commands
            .iter()
            .enumerate()
            .filter(|(place, _)| is_turn(place))
            .filter_map(turning)
            .collect();
        let (place, to, tip, rate, end) = turns[place.index(turns.len())];
        let at = |by: f64| {
            let mut commands = commands.clone();
            let turn = Some(rate - RESOLUTION.rate * by);
            commands[place] = Command::Straight { to, pace: Pace::Speeds { tip, turn }, end };
            replayed(&program, whole(&program, commands))
        };
        prop_assert!(at(below).is_ok());
        prop_assert_eq!(at(off).unwrap_err().op.unwrap().0 as usize, place);
    }

    /// The way between two orientations: its ends, its even pace, and both against the exponential of its axis.
    #[test]
    fn a_blade_turns_about_one_axis(
        (a, b, c) in (-3.0..3.0_f64, -1.5..1.5_f64, -3.0..3.0_f64),
        (x, y, z) in (-1.0..1.0_f64, -1.0..1.0_f64, 0.1..1.0_f64),
        angle in 0.0..3.0_f64,
        done in 0.0..1.0_f64,
    ) {
        let from = Orientation::from_zyx(crate::geometry::Zyx {
            a: Angle::rad(a),
            b: Angle::rad(b),
            c: Angle::rad(c),
        });
        let length = (x * x + y * y + z * z).sqrt();
        let turned = |by: f64| {
            let (sine, cosine) = libm::sincos(by / 2.0);
            let [w1, x1, y1, z1] = from.quaternion();
            let [w2, x2, y2, z2] = [cosine, sine * x / length, sine * y / length, sine * z / length];
            Orientation::from_quaternion(
                w1 * w2 - x1 * x2 - y1 * y2 - z1 * z2,
                w1 * x2 + x1 * w2 + y1 * z2 - z1 * y2,
                w1 * y2 - x1 * z2 + y1 * w2 + z1 * x2,
                w1 * z2 + x1 * y2 - y1 * x2 + z1 * w2,
            )
            .unwrap()
        };
        let on_the_way = from.towards(turned(angle), done);
        prop_assert!(on_the_way.angle_to(turned(angle * done)).to_rad() < 1e-9);
    }
}
