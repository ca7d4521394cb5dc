//! A job on every arrangement of five-axis machines: those that hold its postures carry it out, the others say what they lack.

use crate::pipeline::{Files, compile, numbers};
use crate::repository::read;
use vcutc::reach::solve::rig;
use vcutc::reach::trajectory::{Spacing, trajectory};

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

/// On a head that swings and rakes, a blade that is mounted turned is told of as such.
#[test]
fn a_blade_that_is_mounted_turned_is_told_of() {
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
            .ends_with("its plane would stay turned by 10 deg"),
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
    let rig = rig(&machine.model, &cell);
    let mut last: Option<[f64; 6]> = None;
    let mut rows = 0;
    trajectory(&reached.program, &rig, &Spacing::CLOSE, |sample| {
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
