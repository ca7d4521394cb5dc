//! `avoid = swing`: Vs with narrower flanks beside a step, from the job to programs of all targets and back.

use crate::pipeline::{Files, compile_on, emit_for, fixed, numbers, rendered};
use crate::rect::is_same;
use crate::repository::root;
use vcutc::driver::{self, Outcome};
use vcutc::registry;
use vcutc::vcut::plan::PlannedVcut;
use vcutc_backend_api::readback::ProgramFile;

const JOB: &str = "step.vcut";

/// A step of 28 mm within 1 mm, and a blade whose body begins this high.
fn job(more: &str, body: &str) -> String {
    format!(
        "job \"step\"\n\nuse \"shop/cells.vcut\"\n\nstock {{ size = (85 mm, 50 mm, 50 mm) }}\n\n\
         profile {{ start (0 mm, 40 mm) polyline (30 mm, 40 mm) (31 mm, 12 mm) to (85 mm, 12 mm) }}\n\n\
         blade dagger {{ cutting_length = 10 mm, half_apex = 7.13 deg, thickness = 0.5 mm, edges = double {body} }}\n\n\
         rough vcut {{\n  blade = dagger\n  lattice = orthogonal\n  rake = 60 deg\n  swing = 30 deg\n  layer = 4 mm\n  \
         step = 4 mm\n  residual = mixed\n  {more}\n  \
         feed {{ cut = 200 mm/s, travel = 200 mm/s, reorient = 30 deg/s }}\n  clearance = 10 mm\n}}\n\n\
         cell {{ machine = large_cell }}\n"
    )
}

fn files(text: String) -> Files {
    Files::of(root().join("examples")).with(JOB, text)
}

fn compiled(text: String, machine: &str) -> Outcome {
    compile_on(Some(machine), JOB, &files(text))
}

/// What stays on the part in mm2, its largest height in mm, and how many Vs have narrower flanks.
fn stays(outcome: &Outcome) -> (f64, f64, usize) {
    let messages = rendered(&outcome.diagnostics, outcome);
    let report = &outcome
        .compiled
        .as_ref()
        .unwrap_or_else(|| panic!("{messages}"))
        .report;
    let plan = outcome.plan.as_ref().unwrap();
    let vcut = PlannedVcut::of(&*plan.operations[0]).unwrap();
    (
        report.residual.to_mm2(),
        report.scallop.height.to_mm(),
        vcut.narrowed().count(),
    )
}

#[test]
fn less_stays_beside_a_step() {
    let lift = compiled(job("", ""), "large_cell");
    let swing = compiled(job("avoid = swing", ""), "large_cell");
    let (lifted, narrowed) = (stays(&lift), stays(&swing));
    assert!((lifted.1 - 10.76).abs() < 0.01 && lifted.2 == 0, "{lifted:?}");
    assert!(
        (narrowed.1 - 7.47).abs() < 0.01 && narrowed.2 == 11,
        "{narrowed:?}"
    );
    assert!(narrowed.0 < lifted.0 - 60.0, "{lifted:?} {narrowed:?}");
    let says = |outcome: &Outcome| outcome.compiled.as_ref().unwrap().summary.join("\n");
    let line = "avoid          11 Vs with narrower flanks, down to ";
    assert!(says(&swing).contains(line), "{}", says(&swing));
    assert!(!says(&lift).contains("avoid"), "{}", says(&lift));
}

/// `lift` is the default, and stating it changes nothing.
#[test]
fn lift_is_what_happens_without_the_field() {
    let programs = ["", "avoid = lift"].map(|more| {
        let outcome = compiled(job(more, ""), "large_cell");
        let bundle = emit_for(registry::backend("krl").unwrap(), &outcome).unwrap();
        let files = bundle
            .files()
            .iter()
            .map(|(name, bytes)| (name.clone(), bytes.clone()));
        files
            .filter(|(name, _)| name.ends_with(".src"))
            .collect::<Vec<_>>()
    });
    // The head of a program has the hash of its job.
    let without_head = |files: &[(String, Vec<u8>)]| {
        let texts = files.iter().map(|(name, bytes)| {
            let text = String::from_utf8_lossy(bytes);
            let lines = text.lines().filter(|line| !line.starts_with(';'));
            format!("{name}\n{}", lines.collect::<Vec<_>>().join("\n"))
        });
        texts.collect::<Vec<_>>()
    };
    let [without, with] = programs;
    assert!(!without.is_empty());
    assert_eq!(without_head(&without), without_head(&with));
}

#[test]
fn every_target_reads_narrower_flanks_back() {
    for (machine, target) in [
        ("large_cell", "krl"),
        ("abb_cell", "rapid"),
        ("gantry", "gcode"),
        ("knife_gantry", "gcode"),
    ] {
        let outcome = compiled(job("avoid = swing", ""), machine);
        assert!(stays(&outcome).2 > 5, "{machine}");
        let backend = registry::backend(target).unwrap();
        let written = driver::write(&outcome, backend).unwrap().unwrap();
        let files = written.files.clone();
        assert!(is_same(&outcome, backend, &files), "{machine}");
        assert!(!is_same(&outcome, backend, &without_a_cut(&files)), "{machine}");
    }
}

/// The files without the last straight move of one of them.
fn without_a_cut(files: &[ProgramFile]) -> Vec<ProgramFile> {
    let mut files = files.to_vec();
    let is_move = |line: &&str| ["LIN ", "MoveL ", "G1 "].iter().any(|word| line.contains(word));
    for file in &mut files {
        if let Some(last) = file.text.lines().rfind(is_move) {
            file.text = file.text.replacen(last, "", 1);
            return files;
        }
    }
    panic!("no move");
}

/// A limit that flanks of 30 deg do not keep: narrower ones where needed are offered, and do.
#[test]
fn narrower_flanks_are_offered_where_they_keep_a_limit() {
    let text = job("limits { scallop <= 8 mm }", "");
    let outcome = compiled(text.clone(), "large_cell");
    offers_narrower_flanks(&text, &outcome);
}

/// A body that regular flanks take into the step.
#[test]
fn narrower_flanks_are_offered_where_they_keep_a_body_out() {
    let text = job("", "body (20 mm, 1.5 mm)");
    let outcome = compiled(text.clone(), "large_cell");
    assert_eq!(numbers(&outcome.diagnostics), ["VC0405"]);
    offers_narrower_flanks(&text, &outcome);
}

fn offers_narrower_flanks(text: &str, outcome: &Outcome) {
    let messages = rendered(&outcome.diagnostics, outcome);
    let mut fixes = outcome
        .diagnostics
        .iter()
        .flat_map(|diagnostic| &diagnostic.fixes);
    let fix = fixes.find(|fix| fix.title.contains("`avoid = swing`"));
    let fix = fix.unwrap_or_else(|| panic!("{messages}"));
    let changed = fixed(&files(text.to_owned()), outcome, fix);
    let after = compile_on(Some("large_cell"), JOB, &changed);
    assert!(stays(&after).2 > 0);
}
