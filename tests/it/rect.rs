//! `rough rect`: slits of a straight blade and strips of a disc, from the job to programs of all targets and back.

use crate::pipeline::Files;
use crate::repository::root;
use vcutc::diagnostics::{Code, Diagnostic, Fix, fix, has_errors};
use vcutc::driver::{self, Outcome, Request, SearchEffort, Typed};
use vcutc::picture::Prefix;
use vcutc::process::verdict::bounds;
use vcutc::readback::{Fresh, Reference};
use vcutc::rect::Planned;
use vcutc::registry;
use vcutc::report::page::Further;
use vcutc::report::playback::taken::Taken;
use vcutc::report::{self, Material, pictures};
use vcutc::simulation::disc::{Hold, PassFault};
use vcutc::simulation::prove::{CutFault, replay};
use vcutc_backend_api::backend::Backend;
use vcutc_backend_api::ir::{Action, Program};
use vcutc_backend_api::readback::ProgramFile;
use vcutc_backend_api::verify::verify;

const SLOPE: &str = "start (0 mm, 10 mm) line to (100 mm, 40 mm)";
const HILL: &str = "start (0 mm, 12 mm) line to (50 mm, 38 mm) line to (100 mm, 12 mm)";
const PARABOLA: &str = "z(x) = 32.172 mm - (x - 56.471 mm)^2 / 103.97 mm";
/// As high as the stock in its middle.
const PLATEAU: &str = "start (0 mm, 20 mm) line to (30 mm, 20 mm) line to (30.1 mm, 50 mm) line to (60 mm, 50 mm) \
                       line to (60.1 mm, 20 mm) line to (100 mm, 20 mm)";
const VALLEY: &str =
    "start (0 mm, 40 mm) line to (30 mm, 10 mm) line to (70 mm, 10 mm) line to (100 mm, 40 mm)";

const ROBOT: &str = "tool dagger { frame = frame(x = 0 mm, y = 0 mm, z = 310 mm, a = 0 deg, b = 0 deg, c = 0 deg), place = 1, \
                     load = load(mass = 14 kg, x = 0 mm, y = 0 mm, z = 140 mm) }\n  \
                     tool wheel { frame = frame(x = 0 mm, y = 0 mm, z = 280 mm, a = 0 deg, b = 0 deg, c = 0 deg), place = 2, \
                     load = load(mass = 13 kg, x = 0 mm, y = 0 mm, z = 130 mm) }\n  \
                     base = frame(x = 1700 mm, y = -600 mm, z = 850 mm, a = 90 deg, b = 0 deg, c = 0 deg)\n  \
                     ultrasonic = output(12)\n  spindle = output(13)";

/// Its leading side points along Y while the head is upright.
const GANTRY: &str = "tool dagger { frame = frame(x = 0 mm, y = 0 mm, z = 160 mm, a = -90 deg, b = 0 deg, c = 0 deg), place = 1 }\n  \
                      tool wheel { frame = frame(x = 0 mm, y = 0 mm, z = 150 mm, a = -90 deg, b = 0 deg, c = 0 deg), place = 2 }\n  \
                      base = frame(x = 350 mm, y = 300 mm, z = 0 mm, a = 0 deg, b = 0 deg, c = 0 deg)\n  \
                      home = axes(x = 300 mm, y = 200 mm, z = -200 mm, b = 0 deg, a = 0 deg, c = 0 deg)\n  \
                      change { at = axes(x = 300 mm, y = 100 mm, z = -200 mm, b = 0 deg, a = 0 deg, c = 0 deg), time = 10 s, \
                      by = program }\n  ultrasonic = output(3)\n  gcode { dialect = sinumerik }";

pub(crate) fn job(profile: &str, more: &str) -> String {
    format!(
        "job \"strips\"\n\nstock {{ size = (100 mm, 60 mm, 50 mm) }}\n\nprofile {{ {profile} }}\n\n\
         blade dagger {{ cutting_length = 13 mm, half_apex = 7.13 deg, thickness = 0.5 mm, edges = double }}\n\
         blade wheel = disc {{\n  radius = 25 mm, thickness = 1 mm, depth = 12 mm, width = 20 mm, spin = 3000 rev/min\n  \
         body (1 mm, 8 mm) (60 mm, 25 mm)\n}}\n\n\
         rough rect {{\n  blade = dagger\n  disc = wheel\n  rake = 60 deg\n  {more}\n  \
         feed {{ cut = 150 mm/s, free = 100 mm/s, travel = 200 mm/s, reorient = 90 deg/s }}\n  clearance = 10 mm\n}}\n\n\
         {}",
        machines()
    )
}

/// A KUKA, an ABB and a gantry that change blades `dagger` and `wheel`.
pub(crate) fn machines() -> String {
    let arm = |home: &str, change: &str| {
        format!(
            "{ROBOT}\n  home = joints({home})\n  change {{ at = joints({change}), time = 10 s, by = hand }}"
        )
    };
    let kuka = arm(
        "0 deg, -90 deg, 90 deg, 0 deg, 45 deg, 0 deg",
        "60 deg, -90 deg, 90 deg, 0 deg, 45 deg, 0 deg",
    );
    let abb = arm(
        "0 deg, 0 deg, 0 deg, 0 deg, 45 deg, 0 deg",
        "60 deg, 0 deg, 0 deg, 0 deg, 45 deg, 0 deg",
    );
    format!(
        "machine kuka = robot \"kuka/kr210_r3100_ultra\" {{\n  {kuka}\n}}\n\n\
         machine abb = robot \"abb/irb6700_155_285\" {{\n  {abb}\n}}\n\n\
         machine gantry = five_axis \"shop/knife_gantry.toml\" {{\n  {GANTRY}\n}}\n\ncell {{ machine = kuka }}\n"
    )
}

const TENS: &str = "layer = 10 mm, step = 10 mm, residual = lift";

fn compiled(text: String, machine: &str) -> Outcome {
    let files = Files::of(root().join("examples")).with("strips.vcut", text);
    let request = Request {
        path: "strips.vcut",
        loader: &files,
        overrides: &[],
        machine: Some(machine),
        options: Typed::default(),
        effort: SearchEffort::Normal,
        operations: registry::OPERATIONS,
        targets: &registry::backends(),
    };
    driver::compile(request, &mut |_| {}).unwrap()
}

pub(crate) fn codes(outcome: &Outcome) -> Vec<Code> {
    let codes = outcome.diagnostics.iter().map(|diagnostic| diagnostic.code);
    codes.collect()
}

pub(crate) fn planned(outcome: &Outcome) -> &Planned {
    let planned: &dyn core::any::Any = &*outcome.plan.as_ref().unwrap().operations[0];
    planned.downcast_ref().unwrap()
}

fn program(outcome: &Outcome) -> &Program {
    outcome.compiled.as_ref().unwrap().program.verified().program()
}

/// What the proof finds left is what the planner counted with, and no slit or strip is without its op.
#[test]
fn slopes_and_hills_are_proven_as_planned() {
    for (profile, more) in [
        (SLOPE, TENS),
        (SLOPE, "residual = shift, lead = 0 deg"),
        (
            SLOPE,
            "residual = discard, layer = 5 mm, step = 8 mm, through = 2",
        ),
        (HILL, "lead = 3 deg, allowance = 2 mm"),
        (HILL, "step = 10 mm, through = 2, residual = lift"),
        (HILL, "limits { scallop <= 6 mm }"),
        (SLOPE, "beyond = 0 mm"),
        (
            PLATEAU,
            "layer = 10 mm, step = 10 mm, residual = shift, lead = 0 deg",
        ),
        (PARABOLA, "beyond = 0 mm, step = 13.78 mm"),
    ] {
        let outcome = compiled(job(profile, more), "kuka");
        assert!(
            !has_errors(&outcome.diagnostics),
            "{more}: {:?}",
            outcome.diagnostics
        );
        let report = &outcome.compiled.as_ref().unwrap().report;
        let plan = &planned(&outcome).plan;
        let left = report.largest_deviation().to_mm();
        assert!(left <= plan.left.to_mm() + 2e-3, "{more}: {left} {:?}", plan.left);
        let counts = plan.counts();
        assert_eq!(report.cuts(), counts.slits + counts.strips, "{more}");
        let ops = &program(&outcome).ops;
        let count = |is: fn(&Action) -> bool| ops.iter().filter(|op| is(&op.action)).count();
        assert_eq!(count(|action| matches!(action, Action::Cut { .. })), counts.slits);
        assert_eq!(
            count(|action| matches!(action, Action::Follow { .. })),
            counts.strips
        );
        assert_eq!(
            count(|action| matches!(action, Action::ToolChange { .. })),
            counts.changes,
            "{more}"
        );
    }
}

/// N9 of the sloping part: 28 strips and 27 slits of 10 mm by 10 mm.
#[test]
fn a_slope_takes_as_many_strips_as_by_hand() {
    let outcome = compiled(
        job(
            SLOPE,
            "layer = 10 mm, step = 10 mm, residual = lift, lead = 0 deg, beyond = 0 mm",
        )
        .replace("thickness = 0.5 mm", "thickness = 0 mm"),
        "kuka",
    );
    assert!(!has_errors(&outcome.diagnostics), "{:?}", outcome.diagnostics);
    let counts = planned(&outcome).plan.counts();
    assert_eq!((counts.strips, counts.slits), (28, 27));
    let report = &outcome.compiled.as_ref().unwrap().report;
    assert!(
        (report.removed.to_mm2() - 2350.0).abs() < 0.1,
        "{:?}",
        report.removed
    );
}

/// Of each machine its target, what starts its disc, and an edit.
const CELLS: [(&str, &str, &str, (&str, &str)); 3] = [
    (
        "kuka",
        "krl",
        "$OUT[13]=TRUE",
        ("$OUT[13]=TRUE", "$OUT[13]=FALSE"),
    ),
    (
        "abb",
        "rapid",
        "SetDO do13,1;",
        ("SetDO do13,1;", "SetDO do13,0;"),
    ),
    ("gantry", "gcode", "S3000 M3", ("T2 M6", "T1 M6")),
];

#[test]
fn all_targets_write_strips_and_read_them_back() {
    for (machine, target, word, (from, to)) in CELLS {
        let outcome = compiled(job(SLOPE, TENS), machine);
        assert!(
            !has_errors(&outcome.diagnostics),
            "{machine}: {:?}",
            outcome.diagnostics
        );
        let backend = registry::backend(target).unwrap();
        let written = driver::write(&outcome, backend).unwrap().unwrap();
        let text: String = written.files.iter().map(|file| file.text.as_str()).collect();
        assert!(text.contains(word), "{target}: {text}");
        assert!(is_same(&outcome, backend, &written.files), "{target}");
        let files = edited(&written.files, from, to);
        assert!(!is_same(&outcome, backend, &files), "{target}: {from} to {to}");
    }
}

#[test]
fn a_job_of_eleven_changes_reads_back_on_all_targets() {
    let block = job(
        "start (0 mm, 10 mm) line to (60 mm, 10 mm)",
        "layer = 10 mm, step = 10 mm",
    )
    .replace("size = (100 mm, 60 mm, 50 mm)", "size = (60 mm, 60 mm, 70 mm)");
    for (machine, target, ..) in CELLS {
        let outcome = compiled(block.clone(), machine);
        assert!(
            !has_errors(&outcome.diagnostics),
            "{machine}: {:?}",
            outcome.diagnostics
        );
        let counts = planned(&outcome).plan.counts();
        assert_eq!((counts.slits, counts.strips, counts.changes), (30, 36, 11));
        let backend = registry::backend(target).unwrap();
        let written = driver::write(&outcome, backend).unwrap().unwrap();
        assert!(is_same(&outcome, backend, &written.files), "{target}");
    }
}

/// What a verified program says of passes and slits that were changed, in the words of strips.
#[test]
fn changed_strips_are_reported_as_strips() {
    let outcome = compiled(job(SLOPE, TENS), "kuka");
    let backend = registry::backend("krl").unwrap();
    let written = driver::write(&outcome, backend).unwrap().unwrap();
    let changed = |from: &str, to: &str| {
        let mut files = written.files.clone();
        for file in &mut files {
            file.text = file.text.replace(from, to);
        }
        let messages = said(&outcome, backend, &files);
        move |words: &str| {
            assert!(
                messages.iter().any(|message| message.contains(words)),
                "{words}: {messages:?}"
            )
        }
    };
    // The last pass 4 mm lower.
    let low = changed("X 5.500,Y 87.105,Z 20.459", "X 5.500,Y 87.105,Z 16.459");
    low("the pass of layer 4, strip 6 enters the part by");
    // A slit 3 micrometres higher: its rim passes at 20.19863 there.
    let high = changed("Z 20.198", "Z 20.201");
    high("at the pass of layer 4, strip 6, the strip from x 20 mm to 30.5 mm stays attached");
    high("layer 4, slit 3 goes on below what its strips leave");
}

/// The proof alone, on a program with a slit raised by 2 micrometres, of which 0.63 were to spare.
#[test]
fn a_slit_that_is_short_by_a_micrometre_is_found_in_the_program() {
    let outcome = compiled(job(SLOPE, TENS), "kuka");
    let mut edited = program(&outcome).clone();
    for op in &mut edited.ops {
        if let Action::Approach { to, .. } | Action::Travel { to, .. } | Action::Cut { to, .. } =
            &mut op.action
            && (to.x - 30.0).abs() < 1e-9
            && (to.z - 20.198).abs() < 1e-9
        {
            to.z += 0.002;
        }
    }
    let bounds = bounds(outcome.plan.as_ref().unwrap());
    let verified = verify(edited).unwrap();
    let (_, finding) = replay(&verified, &bounds).findings.strips.unwrap();
    let CutFault::Strip(PassFault::Attached {
        hold: Hold::SlitShort { x, above },
        ..
    }) = finding.fault
    else {
        panic!("{finding:?}")
    };
    assert_eq!(x, 30.0);
    assert!((above.to_mm() - 0.00137).abs() < 1e-4, "{above:?}");
}

/// The disc hangs lower than the straight blade reaches: on this gantry the wheel alone decides whether the work is in reach.
#[cfg(feature = "gcode")]
#[test]
fn the_tool_frame_of_the_disc_decides_where_it_cuts() {
    let with_wheel = |z: &str| {
        job(SLOPE, TENS)
            .replace(
                "z = 0 mm, a = 0 deg, b = 0 deg, c = 0 deg)",
                "z = 930 mm, a = 0 deg, b = 0 deg, c = 0 deg)",
            )
            .replace("z = -200 mm, b = 0", "z = 290 mm, b = 0")
            .replace("z = 150 mm, a = -90", &format!("z = {z} mm, a = -90"))
    };
    assert_eq!(codes(&compiled(with_wheel("160"), "gantry")), []);
    let outcome = compiled(with_wheel("220"), "gantry");
    assert_eq!(codes(&outcome), [Code::AxisLimit]);
    assert!(
        outcome.diagnostics[0].message.contains("takes Z to"),
        "{:?}",
        outcome.diagnostics
    );
}

/// Whether files are the program of a job.
pub(crate) fn is_same(outcome: &Outcome, backend: &dyn Backend, files: &[ProgramFile]) -> bool {
    !has_errors(&verdict(outcome, backend, files))
}

/// What is said of files.
fn said(outcome: &Outcome, backend: &dyn Backend, files: &[ProgramFile]) -> Vec<String> {
    let found = verdict(outcome, backend, files).into_iter();
    found.map(|diagnostic| diagnostic.message).collect()
}

fn verdict(outcome: &Outcome, backend: &dyn Backend, files: &[ProgramFile]) -> Vec<Diagnostic> {
    let written = driver::write(outcome, backend).unwrap().unwrap();
    let reached = outcome.compiled.as_ref().unwrap().program.reached();
    let (job, plan) = (outcome.job.as_ref(), outcome.plan.as_ref());
    let fresh = Fresh::of(job, plan, reached, &written, backend.reader().unwrap()).unwrap();
    let verdict = Reference::new(fresh).verify(files, &[], &mut outcome.sources.clone());
    verdict.diagnostics
}

/// The files with the first place that reads like this changed.
fn edited(files: &[ProgramFile], from: &str, to: &str) -> Vec<ProgramFile> {
    let mut files = files.to_vec();
    let found = files.iter_mut().find(|file| file.text.contains(from));
    let file = found.unwrap_or_else(|| panic!("no {from}"));
    file.text = file.text.replacen(from, to, 1);
    files
}

/// What each control says of a change, of the spindle and of the speed of strips, and what would go wrong without it.
#[cfg(feature = "gcode")]
#[test]
fn every_control_reads_its_changes_back() {
    const EDITS: [(&str, &[(&str, &str)]); 4] = [
        (
            "linuxcnc",
            &[
                ("M5\n", ""),
                ("S3000 M3\n", ""),
                ("G43 H2", "G43 H1"),
                ("T2 M6", "T1 M6"),
            ],
        ),
        (
            "fanuc",
            &[
                ("M5\n", ""),
                ("S3000 M3\n", ""),
                ("G43.4 H2", "G43.4 H1"),
                ("T2 M6", "T1 M6"),
            ],
        ),
        (
            "sinumerik",
            &[
                ("M5\n", ""),
                ("S3000 M3", "S2000 M3"),
                ("T2 M6\n", ""),
                ("TRAORI\n", ""),
            ],
        ),
        (
            "heidenhain",
            &[
                ("M5\n", "M3\n"),
                ("TOOL CALL S3000", "TOOL CALL S2000"),
                ("TOOL CALL 2 Z", "TOOL CALL 1 Z"),
            ],
        ),
    ];
    for &(dialect, options) in crate::shop::DIALECTS {
        let text = job(SLOPE, TENS).replace("dialect = sinumerik", options);
        let outcome = compiled(text, "gantry");
        assert!(
            !has_errors(&outcome.diagnostics),
            "{dialect}: {:?}",
            outcome.diagnostics
        );
        let backend = registry::backend("gcode").unwrap();
        let files = driver::write(&outcome, backend).unwrap().unwrap().files;
        assert!(is_same(&outcome, backend, &files), "{dialect}");
        let (_, edits) = EDITS.iter().find(|(of, _)| *of == dialect).unwrap();
        // And a strip at the speed of slits.
        for &(from, to) in edits.iter().chain(&[("F6000.0", "F9000.0")]) {
            let files = edited(&files, from, to);
            assert!(
                !is_same(&outcome, backend, &files),
                "{dialect}: {from:?} to {to:?}"
            );
        }
    }
}

#[test]
fn pages_show_both_blades() {
    let outcome = compiled(job(SLOPE, TENS), "kuka");
    let page = report::page::page(&outcome, Further::NOTHING).unwrap();
    for words in [
        "<caption>Blades</caption>",
        "<caption>Time by blade</caption>",
        "7 changes",
        "id=\"vcut-playback-data\"",
        "\"body\":[[1.0,8.0],[60.0,25.0]]",
    ] {
        assert!(page.contains(words), "no {words}");
    }
    let summary = &outcome.compiled.as_ref().unwrap().summary;
    assert!(
        summary.iter().any(|line| line.contains("27 slits, 28 strips")),
        "{summary:?}"
    );
}

/// Chips of strips add up to what is removed, and below each lies what the page's viewer is given.
#[test]
fn pictures_and_playback_take_what_the_proof_takes() {
    for (profile, more) in [
        (SLOPE, TENS),
        (
            SLOPE,
            "residual = discard, layer = 5 mm, step = 8 mm, through = 2",
        ),
        (HILL, "lead = 3 deg, allowance = 2 mm"),
    ] {
        let outcome = compiled(job(profile, more), "kuka");
        let material = Material::of(&outcome).unwrap();
        let taken = Taken::of(material.compiled.program.verified(), &[]).unwrap();
        let counts = planned(&outcome).plan.counts();
        assert_eq!(taken.slits.len(), counts.slits, "{more}");
        assert!(taken.chips.len() >= counts.strips, "{more}");
        let mut columns = vec![50.0_f64; 1000];
        for (_, floor) in &taken.chips {
            for (number, column) in columns.iter_mut().enumerate() {
                let x = (number as f64 + 0.5) * 0.1;
                let over = floor.windows(2).find(|pair| pair[0].x <= x && x < pair[1].x);
                if let Some(pair) = over {
                    let share = (x - pair[0].x) / (pair[1].x - pair[0].x);
                    let z = pair[0].z + (pair[1].z - pair[0].z) * share;
                    assert!(z <= *column + 1e-6, "{more}: {x} {z} {column}");
                    *column = z;
                }
            }
        }
        let stands: f64 = columns.iter().map(|z| z * 0.1).sum();
        let removed = 100.0 * 50.0 - stands;
        let proven = material.compiled.report.removed.to_mm2();
        assert!((removed - proven).abs() < 1.0, "{more}: {removed} {proven}");
        let lattice = pictures::lattice(&material, Prefix::NONE);
        for words in [
            format!("{} slits", counts.slits),
            "the disc comes from the arrow".to_owned(),
            "the disc at a strip of each layer".to_owned(),
        ] {
            let is_many = counts.strips >= 100;
            assert!(is_many || lattice.contains(&words), "{more}: no {words}");
        }
        assert!(!lattice.contains("flanks, as far as they cut"), "{more}");
    }
}

/// Programs name all blades of an operation, and count what there is.
#[test]
fn programs_name_both_blades_and_all_kinds_of_cuts() {
    let outcome = compiled(job(SLOPE, TENS), "kuka");
    let written = driver::write(&outcome, registry::backend("krl").unwrap());
    let written = written.unwrap().unwrap();
    let text: String = written.files.iter().map(|file| file.text.as_str()).collect();
    for words in ["27 slits, 28 strips, ", "with blades dagger, wheel"] {
        assert!(text.contains(words), "no {words}");
    }
}

#[test]
fn what_blades_cannot_do_is_refused() {
    let refused = |profile: &str, more: &str| codes(&compiled(job(profile, more), "kuka"));
    assert_eq!(refused(VALLEY, TENS), [Code::NoAccess]);
    assert_eq!(
        refused(SLOPE, "step = 20 mm, layer = 10 mm"),
        [Code::BladesTooSmall]
    );
    assert_eq!(refused(SLOPE, "layer = 12 mm"), [Code::BladesTooSmall]);
    assert_eq!(
        refused(SLOPE, "through = 2, residual = shift"),
        [Code::LimitsConflict]
    );
    assert_eq!(refused(SLOPE, "limits { changes <= 1 }"), [Code::LimitsConflict]);
    assert_eq!(refused(SLOPE, "beyond = 30 mm"), [Code::OutOfRange]);
}

/// A valley: strips down to a height, and Vs below.
fn with_vs(height: &str) -> String {
    let vcut = "\nrough vcut {\n  blade = dagger\n  lattice = interlaced\n  rake = 60 deg\n  swing = 30 deg\n  \
                feed { cut = 150 mm/s, travel = 200 mm/s, reorient = 90 deg/s }\n  clearance = 10 mm\n}\n";
    job(VALLEY, &format!("{TENS}\n  down_to = {height}")) + vcut
}

/// Strips of a disc above, Vs of the straight blade below.
pub(crate) fn both_blades() -> Outcome {
    compiled(with_vs("40 mm"), "kuka")
}

/// The offer of a closed valley is tried: above it the strips come out, and Vs below.
#[test]
fn the_offer_for_a_valley_works_and_vs_cut_the_rest() {
    let outcome = compiled(job(VALLEY, TENS), "kuka");
    let fix = &outcome.diagnostics[0].fixes[0];
    let height = fix.edits[0].replacement.trim();
    let height = height.rsplit("= ").next().unwrap().to_owned();
    let above = compiled(job(VALLEY, &format!("{TENS}\n  down_to = {height}")), "kuka");
    assert!(
        !has_errors(&above.diagnostics),
        "{height}: {:?}",
        above.diagnostics
    );
    let both = compiled(with_vs(&height), "kuka");
    assert!(!has_errors(&both.diagnostics), "{:?}", both.diagnostics);
    let removed = |outcome: &Outcome| outcome.compiled.as_ref().unwrap().report.removed.to_mm2();
    assert!(removed(&both) > removed(&above) + 100.0);
}

/// The text of a job of one file with a change that is offered.
pub(crate) fn mended(text: &str, fix: &Fix) -> String {
    let file = fix.edits[0].span.file;
    fix::apply(text, file, &fix.edits).expect("the change fits the text")
}

/// What is wrong with a job, and what is with its first fix.
fn before_and_after(text: &str) -> (Vec<Code>, Option<Vec<Code>>) {
    let outcome = compiled(text.to_owned(), "kuka");
    let fix = outcome.diagnostics.first().and_then(|one| one.fixes.first());
    let fixed = fix.map(|fix| codes(&compiled(mended(text, fix), "kuka")));
    (codes(&outcome), fixed)
}

#[test]
fn what_a_job_states_keeps_to_its_bounds() {
    // The sides of a thick blade would enter the part.
    let thick =
        job(SLOPE, "standoff = 0 mm, residual = lift").replace("thickness = 0.5 mm", "thickness = 6 mm");
    assert_eq!(
        before_and_after(&thick),
        (vec![Code::OutOfRange], Some(Vec::new()))
    );
    for sizes in [
        "layer = 5 mm, limits { layer <= 4 mm }",
        "step = 5 mm, limits { step >= 6 mm }",
    ] {
        assert_eq!(
            before_and_after(&job(SLOPE, sizes)),
            (vec![Code::OutOfRange], Some(Vec::new())),
            "{sizes}"
        );
    }
    let one_output = job(SLOPE, "").replace("spindle = output(13)", "spindle = output(12)");
    assert!(codes(&compiled(one_output, "kuka")).contains(&Code::OutOfRange));
    // Fewer changes than any plan has that keeps the limit on scallop.
    let few = job(SLOPE, "limits { scallop <= 5 mm, changes <= 1 }");
    assert_eq!(codes(&compiled(few, "kuka")), [Code::LimitsConflict]);
}

/// A lead that leaves hardly any chip is named at once, instead of thousands of thin layers being planned.
#[test]
fn a_lead_that_takes_the_whole_chip_is_refused() {
    for (depth, help) in [("1.31", "use a lead of at most 2.77"), ("0.001", "thicker chips")] {
        let text = job(SLOPE, "").replace("depth = 12 mm", &format!("depth = {depth} mm"));
        let outcome = compiled(text, "kuka");
        assert_eq!(codes(&outcome), [Code::BladesTooSmall], "{depth}");
        assert!(
            outcome.diagnostics[0].help[0].contains(help),
            "{:?}",
            outcome.diagnostics
        );
    }
}

/// The speed of the disc belongs to `rect`: where `feed` is shared, `rough vcut` would not take it.
#[test]
fn the_speed_of_the_disc_is_offered_where_it_belongs() {
    let text = job(SLOPE, "").replace(
        "rough rect {",
        "rough auto {\n  limits { scallop <= 8 mm }\n  rect { disc = wheel }",
    );
    let text = text
        .replace("  disc = wheel\n", "")
        .replace(", free = 100 mm/s", "");
    assert_eq!(
        before_and_after(&text),
        (vec![Code::MissingField], Some(Vec::new()))
    );
}

/// In a valley of crests at 40 mm, layers of 9 mm from 50 mm on end at 41 mm: 40 mm would be a layer of 1 mm more.
#[test]
fn a_height_to_stop_at_leaves_no_thin_layer() {
    for (layer, height) in [("9 mm", "41 mm"), ("10 mm", "40 mm"), ("6 mm", "40 mm")] {
        for down_to in ["", ", down_to = 5 mm"] {
            let text = job(VALLEY, &format!("layer = {layer}, step = 10 mm{down_to}"));
            let outcome = compiled(text.clone(), "kuka");
            assert_eq!(codes(&outcome), [Code::NoAccess], "{layer}");
            let fix = &outcome.diagnostics[0].fixes[0];
            assert!(
                fix.title.contains(&format!("`down_to = {height}`")),
                "{layer}: {}",
                fix.title
            );
            assert_eq!(codes(&compiled(mended(&text, fix), "kuka")), [], "{layer}");
        }
    }
}

/// Another frame of the wheel is the wheel's own value, and not the dagger's.
#[test]
fn a_changed_frame_of_the_wheel_points_at_the_wheel() {
    let text = job(SLOPE, TENS);
    let outcome = compiled(text.clone(), "kuka");
    let backend = registry::backend("krl").unwrap();
    let files = driver::write(&outcome, backend).unwrap().unwrap().files;
    for (z, of) in [("280", "tool wheel"), ("310", "tool dagger")] {
        let changed = edited(
            &files,
            &format!("$TOOL={{X 0.000,Y 0.000,Z {z}.000"),
            "$TOOL={X 0.000,Y 0.000,Z 200.000",
        );
        let found = verdict(&outcome, backend, &changed);
        let labels = found.iter().flat_map(|one| &one.secondary);
        let own = labels.filter(|label| label.text == "the job's own value");
        let starts: Vec<usize> = own.map(|label| label.span.start as usize).collect();
        let block = text.find(of).unwrap();
        let frame = block + text[block..].find("frame = ").unwrap() + "frame = ".len();
        assert!(
            !starts.is_empty() && starts.iter().all(|start| *start == frame),
            "{of}: {starts:?} {frame} {found:?}"
        );
    }
}

/// A slit that was edited is all that is wrong with a program: what comes after changes of blade begins where it should.
#[test]
fn an_edited_slit_says_nothing_of_changes_of_blade() {
    let outcome = compiled(job(SLOPE, TENS), "abb");
    let backend = registry::backend("rapid").unwrap();
    let files = driver::write(&outcome, backend).unwrap().unwrap().files;
    assert_eq!(verdict(&outcome, backend, &files), []);
    // The way down to the slit and the slit itself, 3 mm higher: what it should free stays attached.
    let lifted = edited(&edited(&files, ",20.198]", ",23.198]"), ",20.198]", ",23.198]");
    let found = verdict(&outcome, backend, &lifted);
    let says = |words: &str| found.iter().any(|one| one.message.contains(words));
    assert!(says("stays attached"), "{found:?}");
    assert!(!says("unknown position"), "{found:?}");
}
