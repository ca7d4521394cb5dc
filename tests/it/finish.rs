//! `finish disc` through all stages and targets: what the programs leave, by points of the disc in space; read back; and refused.

use crate::pipeline::Files;
use crate::rect::machines;
use crate::repository::root;
use vcutc::diagnostics::{Code, has_errors};
use vcutc::driver::{self, Outcome, Request, Typed};
use vcutc::readback::{Fresh, Reference};
use vcutc::registry;
use vcutc::simulation::prove::watched;
use vcutc_backend_api::ir::{Action, Program};
use vcutc_backend_api::readback::ProgramFile;

const CAP: &str = "z(x) = 30 mm - (x - 60 mm)^2 / 300 mm";
/// Hollow with a radius of 150 mm.
const TROUGH: &str = "z(x) = 16 mm + (x - 60 mm)^2 / 300 mm";

fn job(profile: &str, finish: &str) -> String {
    format!(
        "job \"cap\"\n\nstock {{ size = (120 mm, 200 mm, 40 mm) }}\n\nprofile {{ {profile} }}\n\n\
         blade dagger {{ cutting_length = 30 mm, half_apex = 7.13 deg, thickness = 0.5 mm, edges = double }}\n\
         blade wheel = disc {{\n  radius = 25 mm, thickness = 1 mm, depth = 10 mm, width = 50 mm, spin = 3000 rev/min\n  \
         body (1 mm, 8 mm) (60 mm, 25 mm)\n}}\n\n\
         rough vcut {{\n  blade = dagger\n  rake = 60 deg\n  limits {{ swing <= 50 deg, scallop <= 6 mm }}\n  \
         allowance = 0.3 mm\n  residual = lift\n  feed {{ cut = 150 mm/s, travel = 200 mm/s, reorient = 90 deg/s }}\n  \
         clearance = 10 mm\n}}\n\n\
         finish disc {{\n  blade = wheel\n  {finish}\n  feed {{ cut = 100 mm/s, travel = 200 mm/s, reorient = 90 deg/s }}\n  \
         clearance = 10 mm\n}}\n\n{}",
        machines()
    )
}

const USUAL: &str = "limits { scallop <= 0.1 mm, lead <= 12 deg }\n  over_hub = 9 mm";

fn compiled(text: String, machine: &str) -> Outcome {
    let files = Files::of(root().join("examples")).with("cap.vcut", text);
    let request = Request {
        path: "cap.vcut",
        loader: &files,
        overrides: &[],
        machine: Some(machine),
        options: Typed::default(),
        operations: registry::OPERATIONS,
        targets: &registry::backends(),
    };
    driver::compile(request, &mut |_| {}).unwrap()
}

/// Points of the disc's edge on all its ways through the work, over x and z.
fn edge(program: &Program, radius: f64) -> Vec<(f64, f64)> {
    let mut points = Vec::new();
    for op in &program.ops {
        let Action::Follow { to, orientation, .. } = op.action else {
            continue;
        };
        let held = program.orientation(orientation).unwrap().matrix();
        for i in 0..2000_u32 {
            let (sine, cosine) = libm::sincos(f64::from(i) / 2000.0 * core::f64::consts::TAU);
            let off = |row: usize| radius * (held[row][0] * cosine + held[row][1] * sine);
            points.push((to.x + off(0), to.z + off(2)));
        }
    }
    points
}

#[test]
fn no_point_of_the_disc_enters_the_part_and_all_of_it_is_covered() {
    for (profile, sense) in [(CAP, -1.0), (TROUGH, 1.0)] {
        let part = |x: f64| {
            let off = (x - 60.0) * (x - 60.0) / 300.0;
            if sense < 0.0 { 30.0 - off } else { 16.0 + off }
        };
        let outcome = compiled(job(profile, USUAL), "kuka");
        assert!(!has_errors(&outcome.diagnostics), "{:?}", outcome.diagnostics);
        let compiled = outcome.compiled.unwrap();
        let points = edge(compiled.program.verified().program(), 25.0);
        // The polyline of the part is within a hundredth of a millimetre of it.
        for &(x, z) in points.iter().filter(|(x, _)| (0.0..=120.0).contains(x)) {
            assert!(z >= part(x) - 0.011, "{profile}: {z} at x {x}");
        }
        // The lowest point of any edge over each half millimetre is at most the scallop above the part.
        let mut lowest = [f64::INFINITY; 240];
        for (x, z) in points {
            let place = (x * 2.0).floor();
            if (0.0..240.0).contains(&place) {
                let above = z - part(x);
                let lowest = &mut lowest[place as usize];
                *lowest = lowest.min(above);
            }
        }
        let highest = lowest.iter().copied().fold(0.0, f64::max);
        assert!(highest < 0.125, "{profile}: {highest}");
        // Who replays without asking what is wrong sees the same surface, as pictures do.
        let (_, left) = watched(compiled.program.verified(), &mut |_, _, _| {});
        for corner in left.corners() {
            assert!(corner.z <= part(corner.x) + 0.125, "{corner:?}");
        }
        assert!(compiled.report.scallop.height.to_mm() <= 0.1);
    }
}

#[test]
fn all_targets_write_tracks_and_read_them_back() {
    for (machine, target) in [("kuka", "krl"), ("abb", "rapid"), ("gantry", "gcode")] {
        let outcome = compiled(job(CAP, USUAL), machine);
        assert!(
            !has_errors(&outcome.diagnostics),
            "{machine}: {:?}",
            outcome.diagnostics
        );
        let backend = registry::backend(target).unwrap();
        let written = driver::write(&outcome, backend).unwrap().unwrap();
        let is_same = |files: &[ProgramFile]| {
            let reached = outcome.compiled.as_ref().unwrap().program.reached();
            let (job, plan) = (outcome.job.as_ref(), outcome.plan.as_ref());
            let fresh = Fresh::of(job, plan, reached, &written, backend.reader().unwrap()).unwrap();
            let verdict = Reference::new(fresh).verify(files, &[], &mut outcome.sources.clone());
            !has_errors(&verdict.diagnostics)
        };
        assert!(is_same(&written.files), "{target}");
        // One digit of the last place at which the tip goes through the work.
        let mut files = written.files.clone();
        let file = files
            .iter_mut()
            .find(|file| file.text.contains("21.003"))
            .unwrap();
        file.text = file.text.replacen("21.003", "20.003", 1);
        assert!(!is_same(&files), "{target}");
    }
}

fn codes(finish: &str) -> Vec<Code> {
    let outcome = compiled(job(CAP, finish), "kuka");
    outcome.diagnostics.iter().map(|one| one.code).collect()
}

#[test]
fn what_does_not_go_is_refused_with_what_does() {
    // Strips run over the hub.
    let outcome = compiled(job(CAP, "limits { scallop <= 0.1 mm }"), "kuka");
    let [refused] = outcome.diagnostics.as_slice() else {
        panic!("{:?}", outcome.diagnostics);
    };
    assert_eq!(refused.code, Code::BladesTooSmall);
    let offered = refused.help[0].split("over_hub = ").nth(1).unwrap();
    let height = offered.split(" mm").next().unwrap();
    let with = |over_hub: &str| {
        codes(&format!(
            "limits {{ scallop <= 0.1 mm }}\n  over_hub = {over_hub} mm"
        ))
    };
    assert_eq!(with(height), []);
    let less: f64 = height.parse::<f64>().unwrap() - 1.0;
    assert_eq!(with(&less.to_string()), [Code::BladesTooSmall]);
    // Grooves end too high for so little lead.
    let thick = |lead: &str| {
        let finish = format!("lead = {lead} deg, limits {{ scallop <= 0.1 mm }}\n  over_hub = 9 mm");
        compiled(
            job(CAP, &finish).replace("allowance = 0.3 mm", "allowance = 2 mm"),
            "kuka",
        )
    };
    let outcome = thick("3");
    let refused = &outcome.diagnostics[0];
    assert_eq!(refused.code, Code::ChipNotFreed);
    let lead = refused.help[0].split("lead = ").nth(1).unwrap();
    let lead = lead.split(" deg").next().unwrap();
    assert!(!has_errors(&thick(lead).diagnostics), "{lead}");
    // Tracks too far apart for the limit.
    assert_eq!(
        codes("step = 30 mm, limits { scallop <= 0.1 mm }\n  over_hub = 9 mm"),
        [Code::ScallopOverLimit]
    );
    assert_eq!(
        codes("limits { scallop <= 0.1 mm, lead <= 2 deg }"),
        [Code::LimitsConflict]
    );
    assert_eq!(
        codes("lead = 0 deg, limits { scallop <= 0.1 mm }"),
        [Code::OutOfRange]
    );
    assert_eq!(codes("over_hub = 9 mm"), [Code::MissingField]);
}
