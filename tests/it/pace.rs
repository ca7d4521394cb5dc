//! The time of whole programs: what it is made of, and what the numbers of a machine's sheet do to it.

use crate::pipeline::{Files, compile};
use crate::repository::read;
use vcutc::driver::{Compiled, Finished};
use vcutc::simulation::timing::op_times;
use vcutc_backend_api::units::Duration;

/// The cut block on a KUKA whose sheet has these lines more: some below `[limits]`, some at its end. The swing is given, and turns are
/// slow, so that all sheets get one plan.
fn compiled(limits: &str, end: &str) -> Compiled {
    let sheet = read("src/machine/robots/kuka/kr210_r3100_ultra.toml");
    assert!(!sheet.contains("accelerations_deg_s2"));
    let sheet = sheet.replacen("speeds_deg_s", &format!("{limits}\nspeeds_deg_s"), 1) + end;
    let job = read("examples/block_cui.vcut").replace("kuka/kr210_r3100_ultra", "arm.toml");
    let job = job.replace("swing     = auto", "swing     = 40 deg");
    let job = job.replace("reorient = 90 deg/s", "reorient = 45 deg/s");
    assert!(job.contains("swing     = 40 deg") && job.contains("reorient = 45 deg/s"));
    let files = Files::default().with("job.vcut", job).with("arm.toml", sheet);
    let outcome = compile("job.vcut", &files);
    outcome
        .compiled
        .unwrap_or_else(|| panic!("{:#?}", outcome.diagnostics))
}

fn seconds(compiled: &Compiled) -> f64 {
    let sum: Duration = compiled.op_times.iter().copied().sum();
    let times = &compiled.times;
    // Figures are whole milliseconds.
    assert!((sum.to_s() - times.all.total_s).abs() <= 0.000_501);
    assert!((sum.to_s() - compiled.report.times.all.total().to_s()).abs() < 1e-6);
    // Layers have all but the way from and to home, and waiting for the generator.
    let layers: f64 = times.layers.iter().map(|layer| layer.time.total_s).sum();
    let rounding = 0.000_5 * times.layers.len() as f64 + 1e-6;
    assert!(layers <= sum.to_s() + rounding && layers > 0.9 * sum.to_s());
    assert_eq!(times.layers.len(), compiled.report.layers.len());
    assert_eq!(times.untimed, 0);
    sum.to_s()
}

const ACCELERATIONS: &str = "accelerations_deg_s2 = [200.0, 200.0, 200.0, 300.0, 300.0, 400.0]";

#[test]
fn accelerations_and_jerks_make_a_program_slower() {
    let plain = compiled("", "");
    assert_eq!(plain.times.basis, "speeds");
    let Finished::Reached(reached) = &plain.program else {
        panic!("it has a machine");
    };
    let programmed: Duration = op_times(reached.program.verified()).into_iter().sum();
    let axes = plain.report.times.all.axes.to_s();
    assert!(axes > 0.0 && (seconds(&plain) - programmed.to_s() - axes).abs() < 1e-6);

    // Accelerations beyond all that is needed change nothing.
    let free = compiled("accelerations_deg_s2 = [9e6, 9e6, 9e6, 9e6, 9e6, 9e6]", "");
    assert_eq!(free.times.basis, "accelerations");
    assert!((seconds(&free) / seconds(&plain) - 1.0).abs() < 0.01);

    let ramped = compiled(ACCELERATIONS, "");
    let jerks = format!("{ACCELERATIONS}\njerks_deg_s3 = [2e3, 2e3, 2e3, 3e3, 3e3, 4e3]");
    let smooth = compiled(&jerks, "");
    assert_eq!(smooth.times.basis, "jerks");
    assert!(seconds(&ramped) > seconds(&free) * 1.05);
    assert!(seconds(&smooth) > seconds(&ramped) * 1.05);
    for (slow, fast) in smooth.op_times.iter().zip(&ramped.op_times) {
        assert!(slow.to_s() >= fast.to_s() * 0.995, "{slow:?} {fast:?}");
    }
    for (slow, fast) in ramped.op_times.iter().zip(&plain.op_times) {
        assert!(slow.to_s() >= fast.to_s() * 0.995, "{slow:?} {fast:?}");
    }
}

/// With numbers of the path alone every cut has the closed form `L / v + v / a`.
#[test]
fn the_path_has_accelerations_of_its_own() {
    let plain = compiled("", "");
    let ramped = compiled("", "\n[path]\nacceleration_mm_s2 = 2000.0\n");
    assert_eq!(ramped.times.basis, "accelerations");
    let cuts = 2.0 * f64::from(u32::try_from(ramped.report.cuts()).unwrap());
    let longer = ramped.report.times.all.cutting.to_s() - plain.report.times.all.cutting.to_s();
    // 200 mm/s are gathered in 0.1 s.
    assert!((longer - cuts * 0.1).abs() < 1e-6, "{longer} for {cuts} cuts");
}
