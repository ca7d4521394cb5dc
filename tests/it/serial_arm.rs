//! Jobs on an arm without a closed form: a UR10e from its URDF through the whole compiler.

use crate::pipeline::{Files, compile, rendered};
use vcutc::diagnostics::{Code, fix};
use vcutc::driver::Outcome;
use vcutc::driver::checks::Standing;
use vcutc::machine::kinematics::Mechanism;
use vcutc::machine::kinematics::pose::Pose;
use vcutc::motion::rigs::Rigs;
use vcutc::motion::solve::Reached;

const JOB: &str = "job.vcut";

/// A few cuts in front of the arm.
const SMALL: &str = r#"job "small"
stock { size = (LENGTH mm, 20 mm, 20 mm) }
profile { start (0 mm, 10 mm) line to (LENGTH mm, 10 mm) }
blade dagger { cutting_length = 12 mm half_apex = 7.13 deg thickness = 0 mm edges = double }
rough vcut {
  blade = dagger
  rake = 60 deg
  lattice = orthogonal
  swing = 35 deg
  direction = alternate
  feed { cut = 50 mm/s, travel = 100 mm/s, reorient = 20 deg/s }
  clearance = 10 mm
}
machine cell = robot "ur10e.urdf" {
  tool = frame(x = 0 mm, y = 0 mm, z = 150 mm, a = 0 deg, b = 0 deg, c = 0 deg)
  base = frame(x = X mm, y = -200 mm, z = 200 mm, a = 0 deg, b = 0 deg, c = 0 deg)
  home = joints(0 deg, -90 deg, 90 deg, -90 deg, -90 deg, 0 deg)
}
"#;

fn small(x: u32, length: u32) -> Files {
    let text = SMALL
        .replace("X mm", &format!("{x} mm"))
        .replace("LENGTH", &length.to_string());
    Files::default().with(JOB, text).with("ur10e.urdf", urdf())
}

/// Universal Robots UR10e by its published lengths, in the form of `ur_description`: joint, parent, child, origin (m, rad).
const JOINTS: [(&str, [f64; 3], [f64; 3]); 6] = [
    ("shoulder_pan", [0.0, 0.0, 0.1807], [0.0, 0.0, 0.0]),
    ("shoulder_lift", [0.0, 0.0, 0.0], [QUARTER, 0.0, 0.0]),
    ("elbow", [-0.6127, 0.0, 0.0], [0.0, 0.0, 0.0]),
    ("wrist_1", [-0.57155, 0.0, 0.17415], [0.0, 0.0, 0.0]),
    ("wrist_2", [0.0, -0.11985, 0.0], [QUARTER, 0.0, 0.0]),
    ("wrist_3", [0.0, 0.11655, 0.0], [QUARTER, PI, PI]),
];

const PI: f64 = core::f64::consts::PI;
const QUARTER: f64 = core::f64::consts::FRAC_PI_2;

fn urdf() -> String {
    let mut links = String::from("<link name=\"base_link\"/>");
    let mut joints = String::new();
    let mut parent = "base_link";
    for (name, [x, y, z], [roll, pitch, yaw]) in JOINTS {
        links += &format!("<link name=\"{name}_link\"/>\n");
        joints += &format!(
            "<joint name=\"{name}_joint\" type=\"revolute\"><origin xyz=\"{x} {y} {z}\" rpy=\"{roll} {pitch} {yaw}\"/>\
             <parent link=\"{parent}_link\"/><child link=\"{name}_link\"/><axis xyz=\"0 0 1\"/>\
             <limit effort=\"0\" lower=\"-6.2\" upper=\"6.2\" velocity=\"2.0\"/></joint>\n"
        )
        .replace("base_link_link", "base_link");
        parent = name;
    }
    format!("<?xml version=\"1.0\"?>\n<robot name=\"ur10e\">\n{links}{joints}</robot>\n")
}

fn reached(outcome: &Outcome) -> &Reached {
    let messages = rendered(&outcome.diagnostics, outcome);
    let compiled = outcome.compiled.as_ref().unwrap_or_else(|| panic!("{messages}"));
    compiled.program.reached().unwrap()
}

#[test]
fn the_axes_bring_the_blade_where_the_program_has_it() {
    let outcome = compile(JOB, &small(700, 30));
    let reached = reached(&outcome);
    let model = &outcome.job.as_ref().unwrap().machine.as_ref().unwrap().model;
    assert!(matches!(model.mechanism, Mechanism::Serial(_)));
    let program = reached.program.program();
    let cell = program.cell.clone().unwrap();
    let rigs = Rigs::of(model, &cell, program);
    let rig = rigs.first();
    let mut checked = 0;
    for (segment, end) in program.segments().zip(&reached.program.motion().ends) {
        let Some(to) = segment.target() else { continue };
        let should = Pose::from(program.frame(to).unwrap());
        let (apart, turned) = rig.blade_in_work(&end.0).apart(&should);
        assert!(apart < 1e-5 && turned < 1e-8, "{apart} mm, {turned}");
        checked += 1;
    }
    assert!(checked > 20, "{checked}");
    // One stretch on one branch, whose axes never jump.
    assert_eq!(reached.report.stretches.len(), 1);
    let mut last = None;
    let jumps = vcutc::motion::trajectory::trajectory(
        &reached.program,
        &rigs,
        &vcutc::motion::trajectory::Spacing::CLOSE,
        |sample| {
            let from = last.replace(sample.joints).unwrap_or(sample.joints);
            let most = from
                .iter()
                .zip(&sample.joints)
                .map(|(a, b)| (a - b).abs())
                .fold(0.0, f64::max);
            if most < 0.2 { Ok(()) } else { Err(most) }
        },
    );
    assert_eq!(jumps, Ok(()));
}

/// The proof meets no singular pose, and measures no distance from one: nothing is claimed of it.
#[test]
fn the_distance_from_singular_poses_is_named_as_not_checked() {
    let outcome = compile(JOB, &small(700, 30));
    let checks = &outcome.compiled.as_ref().unwrap().checks;
    assert_eq!(checks.standing(), Standing::InPart);
    assert!(!checks.proven().contains("singular"), "{}", checks.proven());
    let open = checks.not_checked().unwrap();
    assert!(
        open.contains("the distance from singularities (not measured"),
        "{open}"
    );
}

#[test]
fn work_beyond_the_arm_is_refused() {
    let outcome = compile(JOB, &small(1900, 30));
    assert!(outcome.compiled.is_none());
    let codes: Vec<Code> = outcome
        .diagnostics
        .iter()
        .map(|diagnostic| diagnostic.code)
        .collect();
    assert!(
        codes.contains(&Code::OutOfReach),
        "{}",
        rendered(&outcome.diagnostics, &outcome)
    );
}

/// Steps around the present place lead nowhere there.
#[test]
fn work_far_beyond_the_arm_is_brought_near_it() {
    let files = small(4000, 30);
    let outcome = compile(JOB, &files);
    let messages = rendered(&outcome.diagnostics, &outcome);
    let offered = outcome
        .diagnostics
        .iter()
        .flat_map(|diagnostic| &diagnostic.fixes);
    let offered = offered.into_iter().next().unwrap_or_else(|| panic!("{messages}"));
    assert!(offered.title.starts_with("move the base"), "{messages}");
    let span = offered.edits[0].span;
    let source = outcome.sources.get(span.file).unwrap();
    let text = fix::apply(&source.text, span.file, &offered.edits).unwrap();
    let mended = compile(JOB, &files.with(JOB, text));
    assert!(
        mended.compiled.is_some(),
        "{}",
        rendered(&mended.diagnostics, &mended)
    );
}
