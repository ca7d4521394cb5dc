//! A job on every arrangement of five-axis machines: those that hold its postures carry it out, the others say what they lack.

use crate::pipeline::{Files, compile, compile_on, numbers, rendered};
use crate::repository::{read, root};
use glam::{DMat3, DVec3};
use vcutc::diagnostics::Code;
use vcutc::job::CheckedJob;
use vcutc::motion::pace::paced;
use vcutc::motion::rigs::Rigs;
use vcutc::motion::solve::{Changes, LEAST_CLEARANCE, Reached, Unreached, solve};
use vcutc::motion::trajectory::{Spacing, trajectory};
use vcutc::motion::verdict::explain;
use vcutc::simulation::timing::op_times;
use vcutc::vcut::PlannedVcut;
use vcutc_backend_api::ir::{Action, AxisKind, Joint};
use vcutc_backend_api::testkit::chained;
use vcutc_backend_api::units::{Angle, Length};
use vcutc_backend_api::verify::verify;

/// The job of an example, which asks for `generic/head_head_ac`, on another machine.
fn on(machine: &str) -> Vec<String> {
    let job = read("tests/process/err/VC0516_no_spindle.vcut")
        .replace("generic/head_head_ac", machine)
        // C under an upright blade turns much farther than the blade.
        .replace("reorient = 60 deg/s", "reorient = 40 deg/s");
    let files = Files::default().with("job.vcut", job);
    let outcome = compile("job.vcut", &files);
    assert_eq!(outcome.compiled.is_some(), outcome.diagnostics.is_empty());
    numbers(&outcome.diagnostics)
        .into_iter()
        .map(str::to_owned)
        .collect()
}

#[test]
fn arrangements_that_swing_and_rake_carry_out_a_job() {
    for machine in [
        "head_head_ba",
        "head_table_ab",
        "table_table_ab",
        "head_head_ac_spindle",
    ] {
        assert!(on(&format!("generic/{machine}")).is_empty(), "{machine}");
    }
}

#[test]
fn the_others_say_that_they_lack_a_spindle() {
    for machine in ["head_head_ac", "head_head_bc", "table_table_ac"] {
        assert_eq!(on(&format!("generic/{machine}")), ["VC0516"], "{machine}");
    }
}

/// On a head that swings and rakes, a blade that is mounted turned is reported as such.
#[test]
fn a_blade_that_is_mounted_turned_is_reported() {
    let job = read("tests/process/err/VC0516_no_spindle.vcut")
        .replace("head_head_ac", "head_head_ba")
        .replace("a = -90 deg", "a = -80 deg");
    let files = Files::default().with("job.vcut", job.clone());
    let outcome = compile("job.vcut", &files);
    let [diagnostic] = outcome.diagnostics.as_slice() else {
        panic!("{:#?}", outcome.diagnostics);
    };
    assert_eq!(diagnostic.code.number(), "VC0516");
    assert!(
        diagnostic
            .message
            .ends_with("its plane would be turned by 10 deg"),
        "{}",
        diagnostic.message
    );
    assert!(outcome.sources.slice(diagnostic.primary.span).contains("-80 deg"));
}

/// The axes that are shown all along a program are those that were proven: within their limits, without a jump, and at the
/// end of every op where the program says.
#[test]
fn the_axes_shown_go_on_without_a_jump() {
    let job = read("tests/process/err/VC0516_no_spindle.vcut")
        .replace("generic/head_head_ac", "generic/head_head_ac_spindle")
        .replace("reorient = 60 deg/s", "reorient = 25 deg/s");
    let outcome = compile("job.vcut", &Files::default().with("job.vcut", job));
    let job = outcome.job.expect("the job has a meaning");
    let machine = job.machine.expect("it has a machine");
    let compiled = outcome.compiled.expect("it compiles");
    let reached = compiled.program.reached().expect("it is reached");
    let cell = reached
        .program
        .program()
        .cell
        .clone()
        .expect("the program has it too");
    let rigs = Rigs::of(&machine.model, &cell, reached.program.program());
    let rig = rigs.first();
    let mut last: Option<[f64; 6]> = None;
    let mut rows = 0;
    trajectory(&reached.program, &rigs, &Spacing::CLOSE, |sample| {
        rows += 1;
        for (axis, value) in rig.axes.iter().zip(sample.joints) {
            assert!(
                (axis.min - 1e-6..=axis.max + 1e-6).contains(&value),
                "{:?}: {} at {value}",
                sample.op,
                axis.name
            );
        }
        if let Some(last) = last {
            // The first three slide.
            for (now, before) in sample.joints.iter().zip(last).skip(3) {
                let step = (now - before).abs();
                assert!(step < 0.5, "{:?}: {step} rad at once", sample.op);
            }
        }
        if (sample.done - 1.0).abs() < 1e-9 {
            let end = reached
                .program
                .axes_after(sample.op)
                .expect("every op has an end");
            assert_eq!(end.0, sample.joints);
        }
        last = Some(sample.joints);
        Ok::<(), ()>(())
    })
    .expect("nothing ends it");
    assert!(rows > 100, "{rows}");
}

/// The ends of the edges, followed along the axes of whole programs, stay beside the stock or above what is cut last: no turn takes
/// them over the work. On the head whose C axis carries the blade round a cone that takes a longer extension than on the others.
#[test]
fn no_turn_takes_an_edge_over_the_work() {
    let mut extensions = Vec::new();
    for machine in [
        "head_head_ba",
        "head_table_ab",
        "table_table_ab",
        "head_head_ac_spindle",
    ] {
        let job = read("tests/process/err/VC0516_no_spindle.vcut")
            .replace("generic/head_head_ac", &format!("generic/{machine}"))
            .replace("reorient = 60 deg/s", "reorient = 40 deg/s");
        let outcome = compile("job.vcut", &Files::default().with("job.vcut", job));
        let model = &outcome.job.as_ref().unwrap().machine.as_ref().unwrap().model;
        let compiled = outcome.compiled.as_ref().unwrap_or_else(|| panic!("{machine}"));
        let reached = compiled.program.reached().unwrap();
        let program = reached.program.program();
        let cell = program.cell.clone().unwrap();
        let rigs = Rigs::of(model, &cell, program);
        let rig = rigs.first();
        let blade = &program.blades[0];
        let blade = blade.straight().unwrap();
        let (sin, cos) = libm::sincos(blade.half_apex.to_rad());
        let length = blade.cutting_length.to_mm();
        let stock = program.stock;
        let (mut turning, mut nearest) = (0, f64::INFINITY);
        trajectory(&reached.program, &rigs, &Spacing::CLOSE, |sample| {
            let turns = matches!(program.ops[sample.op.0 as usize].action, Action::Turn { .. });
            if turns {
                turning += 1;
                let held = rig.blade_in_work(&sample.joints);
                for side in [-1.0, 1.0] {
                    let end =
                        held.rotation * DVec3::new(side * length * sin, 0.0, -length * cos) + held.position;
                    let outside = (-end.y)
                        .max(end.y - stock.depth.to_mm())
                        .max(end.z - stock.height.to_mm());
                    nearest = f64::min(nearest, outside);
                }
            }
            Ok::<(), ()>(())
        })
        .unwrap();
        assert!(turning > 100, "{machine}: {turning}");
        // `run_out` is 2 mm.
        assert!(nearest > 1.9, "{machine}: {nearest}");
        let vcut = PlannedVcut::of(&*outcome.plan.as_ref().unwrap().operations[0]).unwrap();
        extensions.push(vcut.parameters.extension.to_mm());
    }
    let [swings, on_table, both_under, round_a_cone] = extensions[..] else {
        panic!("{extensions:?}");
    };
    assert_eq!((swings, swings), (on_table, both_under));
    assert!(round_a_cone > swings + 0.5, "{extensions:?}");
}

/// The rate that a job asks for is the blade's highest: followed along the axes of whole programs it never turns faster, and at the
/// fastest place of its slowest turns about as fast.
#[test]
fn no_turn_is_faster_than_the_job_asks_for() {
    for (machine, asked) in [
        ("head_head_ba", 40.0),
        ("head_table_ab", 40.0),
        ("table_table_ab", 40.0),
        ("head_head_ac_spindle", 25.0),
    ] {
        let job = read("tests/process/err/VC0516_no_spindle.vcut")
            .replace("generic/head_head_ac", &format!("generic/{machine}"))
            .replace("reorient = 60 deg/s", &format!("reorient = {asked} deg/s"));
        let outcome = compile("job.vcut", &Files::default().with("job.vcut", job));
        let model = &outcome.job.as_ref().unwrap().machine.as_ref().unwrap().model;
        let compiled = outcome.compiled.as_ref().unwrap_or_else(|| panic!("{machine}"));
        let reached = compiled.program.reached().unwrap();
        let program = reached.program.program();
        let rigs = Rigs::of(model, program.cell.as_ref().unwrap(), program);
        let rig = rigs.first();
        let durations: Vec<f64> = program
            .segments()
            .map(|segment| segment.line().map_or(0.0, |line| line.duration().to_s()))
            .collect();
        let (mut fastest, mut before) = (0.0_f64, None);
        trajectory(&reached.program, &rigs, &Spacing::CLOSE, |sample| {
            let held = rig.blade_in_work(&sample.joints).rotation;
            let duration = durations[sample.op.0 as usize];
            if let Some((op, done, was)) = before
                && op == sample.op
                && duration > 0.0
                && sample.done > done
            {
                let turned: DMat3 = held * DMat3::transpose(&was);
                // Between close postures: from the antisymmetric part, which is exact where the trace is not.
                let axis = DVec3::new(
                    turned.y_axis.z - turned.z_axis.y,
                    turned.z_axis.x - turned.x_axis.z,
                    turned.x_axis.y - turned.y_axis.x,
                );
                let angle = libm::asin((axis.length() / 2.0).min(1.0)).to_degrees();
                fastest = fastest.max(angle / ((sample.done - done) * duration));
            }
            before = Some((sample.op, sample.done, held));
            Ok::<(), ()>(())
        })
        .unwrap();
        assert!(fastest <= asked * (1.0 + 1e-6), "{machine}: {fastest}");
        assert!(fastest >= asked * 0.98, "{machine}: {fastest}");
    }
}

/// A turn that sweeps the blade through the work names the extension that is enough, and a tenth of a millimetre less is not.
#[test]
fn a_turn_too_near_the_work_says_how_far_is_enough() {
    let with = |extension: &str| {
        let job = read("tests/process/err/VC0528_short_extension.vcut").replace("6.1 mm", extension);
        compile("job.vcut", &Files::default().with("job.vcut", job))
    };
    let refused = with("6.1 mm");
    assert_eq!(numbers(&refused.diagnostics), ["VC0528"]);
    let messages = rendered(&refused.diagnostics, &refused);
    assert!(
        messages.contains("let the blade turn with `extension = 8.6 mm`"),
        "{messages}"
    );
    assert_eq!(numbers(&with("8.5 mm").diagnostics), ["VC0528"]);
    assert!(with("8.6 mm").compiled.is_some());
}

/// A body that is wider than the edges enters the work on the way of the rotary axes, where a turn about one axis would not take it: it
/// is named, and so is the extension that is enough. Without it nothing is in the way.
#[test]
fn a_body_too_near_the_work_says_how_far_is_enough() {
    let job = read("tests/process/err/VC0528_body_over_the_work.vcut");
    let with = |extension: &str, body: &str| {
        let text = job
            .replace("= 12 mm", extension)
            .replace("body (10 mm, 7 mm)", body);
        compile("job.vcut", &Files::default().with("job.vcut", text))
    };
    let body = "body (10 mm, 7 mm)";
    let refused = with("= 12 mm", body);
    assert_eq!(numbers(&refused.diagnostics), ["VC0528"]);
    let messages = rendered(&refused.diagnostics, &refused);
    for words in [
        "takes the blade above its edges through the work",
        "`extension = 13.6 mm`",
    ] {
        assert!(messages.contains(words), "{messages}");
    }
    assert_eq!(numbers(&with("= 13.5 mm", body).diagnostics), ["VC0528"]);
    assert!(with("= 13.6 mm", body).compiled.is_some());
    assert!(with("= auto", body).compiled.is_some());
    assert!(with("= 12 mm", "").compiled.is_some());
}

/// The user's own sheet states the limit, so the message points there and not only at the model's name in the job.
#[test]
fn a_limit_points_at_its_line_in_the_sheet() {
    let sheet = read("examples/shop/gantry.toml");
    let stated = sheet.lines().find(|line| line.starts_with("range_deg")).unwrap();
    let narrow = "range_deg = [-20.0, 20.0]";
    let files = Files::of(root().join("examples")).with("shop/gantry.toml", sheet.replace(stated, narrow));
    let outcome = compile_on(Some("gantry"), "spoiler_clarky.vcut", &files);
    let refused = &outcome.diagnostics[0];
    assert_eq!(refused.code, Code::AxisLimit);
    let pointed: Vec<&str> = refused
        .secondary
        .iter()
        .map(|label| outcome.sources.slice(label.span))
        .collect();
    assert_eq!(pointed, ["[-20.0, 20.0]"]);
}

/// A chain with two quarter arcs about the vertical, on the machine of a job whose base is tilted.
fn chain_on(tilt: &str, joints: impl Fn(Joint) -> Joint) -> (CheckedJob, Result<Reached, Unreached>) {
    let upright = "z = 50 mm, a = 0 deg, b = 0 deg, c = 0 deg";
    let job = read("tests/process/err/VC0528_short_extension.vcut")
        .replace("6.1 mm", "20 mm")
        // A chain takes its speed from a table that has both.
        .replace("travel = 200 mm/s", "travel = 150 mm/s")
        .replace(upright, &format!("z = 50 mm, a = 0 deg, b = 0 deg, c = {tilt}"));
    let outcome = compile("job.vcut", &Files::default().with("job.vcut", job));
    let compiled = outcome.compiled.expect("it compiles");
    let program = compiled
        .program
        .reached()
        .expect("it is reached")
        .program
        .program();
    let mut program = chained(program.clone(), Angle::deg(60.0), Length::mm(0.2));
    for op in &mut program.ops {
        if let Action::Follow { joint, .. } = &mut op.action {
            *joint = joints(*joint);
        }
    }
    let program = verify(program).expect("it keeps all rules");
    let job = outcome.job.expect("the job has a meaning");
    let model = &job.machine.as_ref().expect("it has a machine").model;
    let solved = solve(program, model, &LEAST_CLEARANCE, Changes::Never);
    (job, solved)
}

#[test]
fn a_chain_on_tilted_work_takes_the_blade_off_its_place() {
    let (_, upright) = chain_on("0 deg", |joint| joint);
    assert!(upright.is_ok());
    let (job, tilted) = chain_on("4 deg", |joint| joint);
    let unreached = tilted.unwrap_err();
    let why = explain(&job, unreached.unreachable().expect("it is no fault")).expect("it has a machine");
    let diagnostics = [why.with_advice()];
    assert_eq!(numbers(&diagnostics), ["VC0530"]);
    assert!(
        diagnostics[0]
            .message
            .starts_with("the rotary axes take the blade "),
        "{}",
        diagnostics[0].message
    );
}

/// A chain takes less time than the same pieces with a rest at each joint, and more than at programmed speeds.
#[test]
fn a_chain_is_timed_as_one_course() {
    for jerk in [None, Some(20_000.0)] {
        let timed = |joints: fn(Joint) -> Joint| {
            let (job, reached) = chain_on("0 deg", joints);
            let mut model = (*job.machine.expect("it has a machine").model).clone();
            model.path.acceleration = Some(1500.0);
            model.path.jerk = jerk;
            for axis in &mut model.axes {
                axis.acceleration = Some(match axis.kind {
                    AxisKind::Linear => 2000.0,
                    AxisKind::Rotary => 20.0,
                });
            }
            let reached = reached.expect("it is reached");
            let paced = paced(&reached.program, &model);
            assert_eq!(paced.basis.unfollowed, 0);
            let programmed = op_times(reached.program.verified());
            let pieces = reached
                .program
                .program()
                .ops
                .iter()
                .zip(paced.times.iter().zip(programmed));
            let follows = pieces.filter(|(op, _)| matches!(op.action, Action::Follow { .. }));
            follows.fold([0.0, 0.0], |[sum, least], (_, (time, programmed))| {
                [sum + time.to_s(), least + programmed.to_s()]
            })
        };
        let ([through, least], [stopped, _]) = (timed(|joint| joint), timed(|_| Joint::Stop));
        assert!(through > least, "{jerk:?}: {least} {through}");
        // Its arcs are slow, since the blade turns with them, so that rests take little. With jerk they may be the faster way.
        let most = if jerk.is_none() { 0.996 } else { 1.0 };
        assert!(through <= most * stopped, "{jerk:?}: {through} {stopped}");
    }
}
