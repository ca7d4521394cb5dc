//! The playback of a report, read back from the page: it is the program, and its machine is the one that was proven.
//!
//! The readers here are made for these tests: base64 by arithmetic, matrices as lists of rows.

use crate::pipeline::{Files, compile};
use crate::repository::read;
use crate::shop::{compiled, compiling, folder};
use serde_json::Value;
use std::convert::Infallible;
use vcutc::driver::Outcome;
use vcutc::motion::rigs::Rigs;
use vcutc::motion::trajectory::{Spacing, trajectory};
use vcutc::report::playback::section;

use vcutc::report::playback::track::{Knot, TURN_ERROR, WAY_ERROR, between};
use vcutc_backend_api::ir::{Action, ActionKind, AxisKind, Flank, Program, Site};
use vcutc_backend_api::state::TipPose;

fn shown(outcome: &Outcome) -> String {
    section(outcome.plan.as_ref().unwrap(), outcome.compiled.as_ref().unwrap())
}

fn program(outcome: &Outcome) -> &Program {
    outcome.compiled.as_ref().unwrap().program.verified().program()
}

/// The data in a page.
fn data(page: &str) -> Value {
    let (_, rest) = page.split_once("id=\"vcut-playback-data\">").unwrap();
    let (text, _) = rest.split_once("</script>").unwrap();
    serde_json::from_str(text).unwrap()
}

pub(crate) fn bytes(text: &Value) -> Vec<u8> {
    let digit = |c: char| {
        let alphabet = ('A'..='Z').chain('a'..='z').chain('0'..='9').chain(['+', '/']);
        alphabet.into_iter().position(|other| other == c)
    };
    let mut bits = Vec::new();
    for value in text.as_str().unwrap().chars().filter_map(digit) {
        bits.extend((0..6).rev().map(|bit| value >> bit & 1));
    }
    let whole = bits.chunks_exact(8);
    whole
        .map(|bits| bits.iter().fold(0, |byte, &bit| byte << 1 | u8::from(bit == 1)))
        .collect()
}

pub(crate) fn numbers<const SIZE: usize, N>(text: &Value, read: fn([u8; SIZE]) -> N) -> Vec<N> {
    let bytes = bytes(text);
    let chunks = bytes.chunks_exact(SIZE);
    chunks.map(|chunk| read(chunk.try_into().unwrap())).collect()
}

pub(crate) fn list(value: &Value) -> Vec<f64> {
    let numbers = value.as_array().unwrap().iter();
    numbers.map(|number| number.as_f64().unwrap()).collect()
}

/// The axes at all knots of each op, after where they were before it.
fn knots(cell: &Value) -> Vec<Vec<Knot>> {
    let track = &cell["track"];
    let (low, step) = (list(&track["low"]), list(&track["step"]));
    let done = numbers(&track["done"], u16::from_le_bytes);
    let values = numbers(&track["values"], u16::from_le_bytes);
    let mut at = [0.0; 6];
    at[..low.len()].copy_from_slice(&list(&track["start"]));
    let mut all = done.iter().zip(values.chunks(low.len())).map(|(done, values)| {
        let mut joints = [0.0; 6];
        for (axis, &value) in values.iter().enumerate() {
            joints[axis] = low[axis] + step[axis] * f64::from(value);
        }
        let done = f64::from(*done) / 65_535.0;
        Knot { done, joints }
    });
    let counts = numbers(&track["counts"], u32::from_le_bytes);
    let of_op = |count: u32| {
        let start = Knot {
            done: 0.0,
            joints: at,
        };
        let mut knots = vec![start];
        knots.extend(all.by_ref().take(count as usize));
        at = knots.last().unwrap().joints;
        knots
    };
    counts.into_iter().map(of_op).collect()
}

fn name(action: &Action) -> &'static str {
    match action {
        Action::Home => "home",
        Action::Travel { .. } => "travel",
        Action::AxisTravel { .. } => "axis_travel",
        Action::Approach { .. } => "approach",
        Action::Retract { .. } => "retract",
        Action::Cut {
            flank: Flank::Left, ..
        } => "cut_left",
        Action::Cut {
            flank: Flank::Right, ..
        } => "cut_right",
        Action::Follow { .. } => "follow",
        Action::Turn { .. } => "turn",
        Action::Ultrasonic { .. } => "ultrasonic",
        Action::Spin { .. } => "spin",
        Action::AwaitReady => "await_ready",
        Action::Dwell { .. } => "dwell",
        Action::ChangePlace => "change_place",
        Action::ToolChange { .. } => "tool_change",
    }
}

fn counted(site: Site) -> (u16, u32, u32) {
    match site {
        Site::Program => (0, 0, 0),
        Site::Operation(operation) => (operation.0 + 1, 0, 0),
        Site::Layer { operation, layer } => (operation.0 + 1, layer.get(), 0),
        Site::Cut {
            operation,
            layer,
            cut,
        } => (operation.0 + 1, layer.get(), cut.get()),
    }
}

#[test]
fn a_page_says_every_op_of_the_program() {
    for (job, pairings) in compiling() {
        let outcome = compiled(pairings[0].machine, &job);
        let data = data(&shown(outcome));
        let columns = &data["timeline"];
        let kinds = bytes(&columns["kinds"]);
        let operations = numbers(&columns["operations"], u16::from_le_bytes);
        let layers = numbers(&columns["layers"], u32::from_le_bytes);
        let cuts = numbers(&columns["cuts"], u32::from_le_bytes);
        let tips = numbers(&columns["tips"], i32::from_le_bytes);
        let held = numbers(&columns["held"], u32::from_le_bytes);
        let arcs = numbers(&columns["arcs"]["ops"], u32::from_le_bytes);
        let vias = numbers(&columns["arcs"]["vias"], i32::from_le_bytes);
        let seconds = numbers(&columns["seconds"], f64::from_le_bytes);
        let times = &outcome.compiled.as_ref().unwrap().op_times;
        let program = program(outcome);
        assert_eq!(kinds.len(), program.ops.len(), "{job}");
        for (i, segment) in program.segments().enumerate() {
            let (op, pose) = (segment.op, segment.end());
            assert_eq!(
                ActionKind::NAMES[usize::from(kinds[i])],
                name(&op.action),
                "{job} {i}"
            );
            assert_eq!((operations[i], layers[i], cuts[i]), counted(op.site), "{job} {i}");
            assert_eq!(seconds[i], times[i].to_s(), "{job} {i}");
            assert_eq!(
                held[i],
                pose.map_or(0, |pose| pose.orientation.0 + 1),
                "{job} {i}"
            );
            if let Some(via) = op.action.via().and_then(|via| program.via(via)) {
                let place = arcs.iter().position(|&arc| arc as usize == i).unwrap();
                let read = vias[3 * place..3 * place + 3]
                    .iter()
                    .map(|&part| f64::from(part) / 1000.0);
                assert_eq!(read.collect::<Vec<_>>(), [via.x, via.y, via.z], "{job} {i}");
            }
            if let Some(TipPose { tip, .. }) = pose {
                // To the last bit, because the section is cut with them.
                let read = tips[3 * i..3 * i + 3].iter().map(|&tip| f64::from(tip) / 1000.0);
                assert_eq!(read.collect::<Vec<_>>(), [tip.x, tip.y, tip.z], "{job} {i}");
            }
        }
    }
}

#[test]
fn axes_are_shown_all_along_the_program() {
    for (job, pairings) in compiling() {
        for pairing in pairings {
            let outcome = compiled(pairing.machine, &job);
            let knots = knots(&data(&shown(outcome))["cell"]);
            let reached = outcome.compiled.as_ref().unwrap().program.reached().unwrap();
            let cell = program(outcome).cell.as_ref().unwrap();
            let machine = outcome.job.as_ref().unwrap().machine.as_ref().unwrap();
            let rigs = Rigs::of(&machine.model, cell, program(outcome));
            let taken: Result<(), Infallible> =
                trajectory(&reached.program, &rigs, &Spacing::CLOSE, |sample| {
                    let interpolated = between(&knots[sample.op.0 as usize], sample.done);
                    for (axis, (interpolated, joint)) in
                        cell.axes.iter().zip(interpolated.iter().zip(sample.joints))
                    {
                        let most = match axis.kind {
                            AxisKind::Rotary => TURN_ERROR,
                            AxisKind::Linear => WAY_ERROR,
                        };
                        let off = (interpolated - joint).abs();
                        assert!(
                            off <= most,
                            "{job}, {pairing:?}: {} off by {off} in {sample:?}",
                            axis.name
                        );
                    }
                    Ok(())
                });
            assert!(taken.is_ok());
        }
    }
}

type Rows = [[f64; 4]; 4];

fn product(a: &Rows, b: &Rows) -> Rows {
    core::array::from_fn(|row| core::array::from_fn(|column| (0..4).map(|i| a[row][i] * b[i][column]).sum()))
}

fn rows(value: &Value) -> Rows {
    let columns = list(value);
    core::array::from_fn(|row| core::array::from_fn(|column| columns[column * 4 + row]))
}

/// The motion of a joint: by quaternions, turned about a line through a point.
fn motion(joint: &Value, axes: &[f64]) -> Rows {
    let weights = list(&joint["weights"]);
    let amount: f64 = weights.iter().zip(axes).map(|(weight, axis)| weight * axis).sum();
    let (point, direction) = (list(&joint["point"]), list(&joint["direction"]));
    let slides = joint["kind"] == "linear";
    let (sine, w) = if slides {
        (0.0, 1.0)
    } else {
        (amount / 2.0).sin_cos()
    };
    let q: Vec<f64> = direction.iter().map(|part| part * sine).collect();
    let square: f64 = q.iter().map(|part| part * part).sum();
    let turn = |i: usize, j: usize| {
        let across = match (3 + j - i) % 3 {
            0 => return w * w - square + 2.0 * q[i] * q[i],
            1 => -q[(i + 2) % 3],
            _ => q[(i + 1) % 3],
        };
        2.0 * (q[i] * q[j] + w * across)
    };
    let shift = |i: usize| {
        let turned: f64 = (0..3).map(|j| turn(i, j) * point[j]).sum();
        point[i] - turned + if slides { direction[i] * amount } else { 0.0 }
    };
    core::array::from_fn(|i| {
        core::array::from_fn(|j| match (i, j) {
            (3, 3) => 1.0,
            (3, _) => 0.0,
            (_, 3) => shift(i),
            (_, _) => turn(i, j),
        })
    })
}

fn chain(joints: &Value, axes: &[f64], ends: [&Value; 2]) -> Rows {
    let moved = joints.as_array().unwrap().iter().map(|joint| motion(joint, axes));
    let constant = ends.into_iter().map(rows);
    moved
        .chain(constant)
        .reduce(|outer, inner| product(&outer, &inner))
        .unwrap()
}

/// The tip in W by products of the page's matrices: seen from the work, whose frame is brought to the machine's.
fn tip(cell: &Value, axes: &[f64], tool: usize) -> [f64; 3] {
    let blade = chain(
        &cell["tool"],
        axes,
        [&cell["flangeAtZero"], &cell["bladesInFlange"][tool]],
    );
    let work = chain(&cell["work"], axes, [&cell["mountAtZero"], &cell["workInMount"]]);
    let away: Vec<f64> = (0..3).map(|i| blade[i][3] - work[i][3]).collect();
    core::array::from_fn(|axis| (0..3).map(|i| work[i][axis] * away[i]).sum())
}

#[test]
fn the_pages_machine_brings_the_blade_where_the_program_has_it() {
    for (job, pairings) in compiling() {
        for pairing in pairings {
            let outcome = compiled(pairing.machine, &job);
            let data = data(&shown(outcome));
            let reached = outcome.compiled.as_ref().unwrap().program.reached().unwrap();
            for segment in program(outcome).segments() {
                let number = segment.id.0;
                let (Some(pose), Some(axes)) = (segment.end(), reached.program.axes_after(segment.id)) else {
                    continue;
                };
                let wanted = pose.tip;
                let [x, y, z] = tip(&data["cell"], &axes.0, usize::from(segment.before.tool.0));
                let off = (x - wanted.x)
                    .abs()
                    .max((y - wanted.y).abs())
                    .max((z - wanted.z).abs());
                assert!(off < 1e-5, "{job}, {pairing:?}: op {number} off by {off} mm");
            }
        }
    }
}

#[test]
fn ten_thousand_cuts_take_less_than_twelve_megabytes() {
    for (job, pairings) in compiling() {
        let outcome = compiled(pairings[0].machine, &job);
        let page = shown(outcome);
        let (_, rest) = page.split_once("id=\"vcut-playback-data\">").unwrap();
        let size = rest.split_once("</script>").unwrap().0.len();
        let cuts = outcome.compiled.as_ref().unwrap().report.cuts();
        let follows = |action: &Action| action.kind() == ActionKind::Follow;
        let poses = program(outcome)
            .ops
            .iter()
            .filter(|op| follows(&op.action))
            .count();
        // The machine, the contour and the postures come once. Single-edged blades turn half round between cuts, which takes the
        // most. Tracks on surfaces and cuts along spines take many poses each: 35 bytes an op, which are 47 of text.
        assert!(
            size < 60_000 + 1200 * cuts + 60 * poses,
            "{job}: {size} bytes for {cuts} cuts and {poses} poses on tracks"
        );
    }
}

#[test]
fn the_same_job_gives_the_same_page_and_asks_nothing_of_the_network() {
    let page = || shown(&compile("block_cui.vcut", &folder()));
    let first = page();
    assert_eq!(first, page());
    for outside in ["http:", "https:", "import(", "fetch(", "src=", "url("] {
        assert!(!first.contains(outside), "{outside}");
    }
}

#[test]
fn a_job_without_a_machine_is_played_by_its_blade() {
    let text = read("examples/block_cui.vcut");
    let (job, _) = text.split_once("machine cell").unwrap();
    let outcome = compile("job.vcut", &Files::default().with("job.vcut", job));
    assert_eq!(data(&shown(&outcome))["cell"], Value::Null);
}
