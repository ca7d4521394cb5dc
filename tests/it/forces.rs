//! How far the forces of a blade push its cuts off: against an oracle that knows the kinematics of the arm alone.

use crate::pipeline::{Files, all_diagnostics, compile, emit, fixed, rendered};
use crate::repository::root;
use glam::DVec3;
use proptest::prelude::*;
use std::collections::BTreeMap;
use vcutc::diagnostics::{Code, Severity};
use vcutc::driver::Outcome;
use vcutc::driver::dynamics::{cut_by_cut, pushed_blades};
use vcutc::dynamics::cuts::{Cuts, Known};
use vcutc::dynamics::deviation::Deviations;
use vcutc::machine::kinematics::Joints;
use vcutc::motion::rig::Rig;
use vcutc::motion::rigs::Rigs;
use vcutc::motion::trajectory::{Spacing, trajectory};
use vcutc_backend_api::ir::{Action, OpId};

pub(crate) const JOB: &str = "job.vcut";

/// A job of V cuts.
pub(crate) fn text(forces: &str, limits: &str, machine: &str) -> String {
    format!(
        r#"job "pushed"
stock {{ size = (50 mm, 300 mm, 24 mm) }}
profile {{ start (0 mm, 8 mm) line to (50 mm, 12 mm) }}
blade dagger {{ cutting_length = 20 mm half_apex = 7.13 deg thickness = 1 mm edges = double {forces} }}
rough vcut {{
  blade = dagger rake = 60 deg lattice = orthogonal swing = 35 deg layer = 7 mm order = point
  {limits}
  feed {{ cut = 100 mm/s, travel = 100 mm/s, reorient = 20 deg/s }}
  clearance = 10 mm
}}
machine cell = robot "arm.toml" {{
  tool = frame(x = 20 mm, y = -10 mm, z = 310 mm, a = 0 deg, b = 30 deg, c = 0 deg)
  base = frame(x = 1700 mm, y = -30 mm, z = 850 mm, a = 90 deg, b = 0 deg, c = 0 deg)
  load = load(mass = 14.5 kg, x = 0 mm, y = 0 mm, z = 140 mm)
  home = joints(0 deg, -90 deg, 90 deg, 0 deg, 45 deg, 0 deg)
  ultrasonic = output(12)
  {machine}
}}
"#
    )
}

/// The same on an arm of which everything is known.
fn job(forces: &str, limits: &str, machine: &str) -> Files {
    Files::default()
        .with(JOB, text(forces, limits, machine))
        .with("arm.toml", arm())
}

/// The sheet of that arm.
pub(crate) fn arm() -> String {
    let folder = root().join("tests/process/err/support");
    let sheet = |name: &str| std::fs::read_to_string(folder.join(name)).unwrap();
    // The masses of one, and the stiffness of the other.
    let weak = sheet("weak_arm.toml");
    let masses = &weak[weak.find("[dynamics]").unwrap()..];
    let masses = &masses[..masses.find("[torque]").unwrap_or(masses.len())];
    sheet("soft_arm.toml") + "\n" + masses
}

const STIFFNESS: [f64; 6] = [2.2e6, 3.4e6, 2.8e6, 2.4e6, 2.2e6, 0.47e6];
pub(crate) const STATED: &str = "forces { drag = 1.1 N/mm, axial = 0.4 N/mm, side = 0.3 N/mm, \
    tip = force(drag = 3 N, axial = 1 N, side = 2 N), spread = 20 %, \
    measured { feed = 100 mm/s, rake = 60 deg, swing = 35 deg }, source = \"this test\" }";

#[track_caller]
pub(crate) fn compiled(files: &Files) -> Outcome {
    let outcome = compile(JOB, files);
    assert!(
        outcome.compiled.is_some(),
        "{}",
        rendered(&all_diagnostics(&outcome), &outcome)
    );
    outcome
}

/// How a place of the blade moves for each rad of an axis, by differences.
pub(crate) fn moved(rig: &Rig<'_>, joints: &Joints, in_blade: DVec3, axis: usize) -> DVec3 {
    let there = |by: f64| {
        let mut joints = *joints;
        joints[axis] += by;
        let blade = rig.blade_in_work(&joints);
        blade.rotation * in_blade + blade.position
    };
    (there(1e-5) - there(-1e-5)) / 2e-5
}

/// What the oracle draws: all forces and all springs, within their spread, and what of the edge is in the material.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Drawn {
    /// How many times [`STATED`] the forces are.
    pub(crate) times: f64,
    pub(crate) parts: [f64; 3],
    pub(crate) springs: [f64; 6],
    /// From where to where it is in the material, as shares of its length.
    pub(crate) from: f64,
    pub(crate) to: f64,
    /// The place of the edge, likewise.
    pub(crate) up: f64,
}

/// By how much a place of the edge shifts along the normal of the flank, in mm: from the force, place by place along the edge, and
/// what it turns each axis by. A flank, the way along y, and everything in N and mm.
pub(crate) fn shift(rig: &Rig<'_>, joints: &Joints, way: f64, edge: f64, drawn: Drawn) -> f64 {
    let blade = rig.blade_in_work(joints);
    let [x, y, z] = [0, 1, 2].map(|axis| blade.rotation.col(axis));
    let normal = if y.z > 0.0 { y } else { -y };
    let way = DVec3::Y * way;
    let leading = if x.dot(way) > 0.0 { x } else { -x };
    let half_apex = 7.13_f64.to_radians();
    let along = leading * half_apex.sin() - z * half_apex.cos();
    let of = |[drag, axial, side]: [f64; 3]| -way * drag - z * axial + normal * side;
    let part = |amount: [f64; 3]| {
        let each = amount.iter().zip(drawn.parts);
        let each: Vec<f64> = each
            .map(|(amount, part)| drawn.times * amount * (1.0 + 0.2 * part))
            .collect();
        of([each[0], each[1], each[2]])
    };
    let (per_length, tip) = (part([1.1, 0.4, 0.3]), part([3.0, 1.0, 2.0]));
    let (from, used) = (drawn.from * edge, (drawn.to - drawn.from) * edge);
    let in_blade = |up: f64| blade.rotation.transpose() * (along * up);
    let mut shift = 0.0;
    for (axis, stiffness) in STIFFNESS.iter().enumerate() {
        let slices = 200;
        let work: f64 = (0..slices)
            .map(|slice| {
                let up = from + used * (f64::from(slice) + 0.5) / f64::from(slices);
                moved(rig, joints, in_blade(up), axis).dot(per_length) * used / f64::from(slices)
            })
            .sum::<f64>()
            + moved(rig, joints, DVec3::ZERO, axis).dot(tip);
        // In Nmm for a rad, and springs in Nm for a rad.
        let spring = 1000.0 * stiffness * (1.0 + 0.1 * drawn.springs[axis]);
        shift += moved(rig, joints, in_blade(drawn.up * edge), axis).dot(normal) * work / spring;
    }
    shift
}

/// A place of a cut.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    pub(crate) op: OpId,
    done: f64,
    /// Along y: 1 or -1.
    pub(crate) way: f64,
    pub(crate) joints: Joints,
}

/// The cuts of a program with the axes at places of them.
pub(crate) fn cuts(outcome: &Outcome) -> Vec<Place> {
    let reached = outcome.compiled.as_ref().unwrap().program.reached().unwrap();
    let program = reached.program.program();
    let model = &outcome.job.as_ref().unwrap().machine.as_ref().unwrap().model;
    let rigs = Rigs::of(model, program.cell.as_ref().unwrap(), program);
    let mut found = Vec::new();
    let spacing = Spacing {
        way: 40.0,
        ..Spacing::CLOSE
    };
    let Ok(()) = trajectory(&reached.program, &rigs, &spacing, |sample| {
        let segment = program.segment(sample.op).unwrap();
        if let Action::Cut { .. } = segment.op.action {
            let line = segment.line().unwrap();
            let way = (line.to.tip.y - line.from.tip.y).signum();
            found.push(Place {
                op: sample.op,
                done: sample.done,
                way,
                joints: sample.joints,
            });
        }
        Ok::<(), core::convert::Infallible>(())
    });
    found
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, ..ProptestConfig::default() })]
    #[test]
    fn no_place_of_an_edge_is_off_by_more_than_the_figures(
        parts in prop::array::uniform3(-1.0..=1.0_f64),
        springs in prop::array::uniform6(-1.0..=1.0_f64),
        from in prop_oneof![Just(0.0), 0.0..=1.0_f64],
        to in prop_oneof![Just(1.0), 0.0..=1.0_f64],
        up in prop_oneof![Just(0.0), Just(1.0), 0.0..=1.0_f64],
        at in any::<prop::sample::Index>(),
    ) {
        let outcome = compiled(&job(STATED, "", ""));
        let compiled = outcome.compiled.as_ref().unwrap();
        let figures = compiled.dynamics.deviation.as_ref().unwrap();
        let [of] = figures.operations.as_slice() else { panic!("one operation") };
        let machine = outcome.job.as_ref().unwrap().machine.as_ref().unwrap();
        let all = cuts(&outcome);
        let Place { op, way, joints, .. } = all[at.index(all.len())];
        let used = compiled.report.edges.iter().find(|used| used.op == op).unwrap();
        let drawn = Drawn { times: 1.0, parts, springs, from: from.min(to), to: from.max(to), up };
        let off = shift(&Rig::of(machine), &joints, way, used.length.to_mm(), drawn);
        prop_assert!(off <= of.into_waste.most + 1e-7, "{off} {of:?}");
        prop_assert!(-off <= of.into_part.most + 1e-7, "{off} {of:?}");
        let each = cut_by_cut(outcome.job.as_ref().unwrap(), compiled, compiled.dynamics.deviation.as_ref().unwrap()).unwrap();
        let cut = each.iter().find(|cut| cut.op == op).unwrap();
        prop_assert!(off <= cut.into_waste + 1e-7 && -off <= cut.into_part + 1e-7, "{off} {cut:?}");
    }
}

#[test]
fn the_figures_are_reached() {
    let outcome = compiled(&job(STATED, "", ""));
    let compiled = outcome.compiled.as_ref().unwrap();
    let figures = compiled.dynamics.deviation.as_ref().unwrap();
    let [of] = figures.operations.as_slice() else {
        panic!("one operation")
    };
    let machine = outcome.job.as_ref().unwrap().machine.as_ref().unwrap();
    let rig = Rig::of(machine);
    // Soft springs, and forces at one end or the other.
    let mut reached: BTreeMap<OpId, f64> = BTreeMap::new();
    for Place { op, way, joints, .. } in cuts(&outcome) {
        let used = compiled.report.edges.iter().find(|used| used.op == op).unwrap();
        for corner in 0..16_u32 {
            let parts = [0, 1, 2].map(|part| if corner >> part & 1 == 0 { -1.0 } else { 1.0 });
            let drawn = Drawn {
                times: 1.0,
                parts,
                springs: [-1.0; 6],
                from: 0.0,
                to: 1.0,
                up: f64::from(corner >> 3),
            };
            let off = shift(&rig, &joints, way, used.length.to_mm(), drawn);
            let most = reached.entry(op).or_default();
            *most = most.max(off);
        }
    }
    let high = reached.values().copied().fold(0.0, f64::max);
    assert!(high >= 0.9 * of.into_waste.most, "{high} {of:?}");
    let each = cut_by_cut(
        outcome.job.as_ref().unwrap(),
        compiled,
        compiled.dynamics.deviation.as_ref().unwrap(),
    )
    .unwrap();
    assert_eq!(each.len(), reached.len());
    for cut in each {
        // Where axes push against each other, the worst springs are not all soft.
        let high = reached[&cut.op];
        assert!(high >= 0.75 * cut.into_waste, "{high} {cut:?}");
    }
}

/// How far an edge swings about where it would rest when all of it comes in at once, in mm: the root of what 1 N along the normal yields,
/// times the root of what the force does on the springs, in N and mm.
fn swing(rig: &Rig<'_>, joints: &Joints, way: f64, edge: f64, parts: [f64; 3]) -> f64 {
    let blade = rig.blade_in_work(joints);
    let [x, y, z] = [0, 1, 2].map(|axis| blade.rotation.col(axis));
    let normal = if y.z > 0.0 { y } else { -y };
    let way = DVec3::Y * way;
    let leading = if x.dot(way) > 0.0 { x } else { -x };
    let half_apex = 7.13_f64.to_radians();
    let along = leading * half_apex.sin() - z * half_apex.cos();
    let force = |[drag, axial, side]: [f64; 3]| {
        let [drag, axial, side] =
            [(drag, 0), (axial, 1), (side, 2)].map(|(amount, part)| amount * parts[part]);
        -way * drag - z * axial + normal * side
    };
    let (per_length, tip) = (force([1.1, 0.4, 0.3]), force([3.0, 1.0, 2.0]));
    let (mut yields, mut pushes) = (0.0, 0.0);
    for (axis, stiffness) in STIFFNESS.iter().enumerate() {
        let spring = 1000.0 * 0.9 * stiffness;
        let at = |up: f64| moved(rig, joints, blade.rotation.transpose() * (along * up), axis);
        let torque = at(0.5 * edge).dot(per_length) * edge + at(0.0).dot(tip);
        pushes += torque * torque / spring;
        let normal = at(edge).dot(normal);
        yields += normal * normal / spring;
    }
    libm::sqrt(yields * pushes)
}

/// With soft springs and all forces at one end: an edge that comes in at once may swing as far from where it would rest.
#[test]
fn an_edge_that_comes_in_at_once_swings_within_the_figures_and_nearly_reaches_them() {
    let outcome = compiled(&job(STATED, "", ""));
    let compiled = outcome.compiled.as_ref().unwrap();
    let figures = compiled.dynamics.deviation.as_ref().unwrap();
    let [of] = figures.operations.as_slice() else {
        panic!("one operation")
    };
    let entry = of.at_entry.as_ref().unwrap();
    let machine = outcome.job.as_ref().unwrap().machine.as_ref().unwrap();
    let rig = Rig::of(machine);
    let (mut waste, mut part) = (0.0_f64, 0.0_f64);
    for Place { op, way, joints, .. } in cuts(&outcome) {
        let used = compiled.report.edges.iter().find(|used| used.op == op).unwrap();
        let edge = used.length.to_mm();
        for corner in 0..8_u32 {
            let parts = [0, 1, 2].map(|part| if corner >> part & 1 == 0 { -1.0 } else { 1.0 });
            let drawn = Drawn {
                times: 1.0,
                parts,
                springs: [-1.0; 6],
                from: 0.0,
                to: 1.0,
                up: 1.0,
            };
            let rests = shift(&rig, &joints, way, edge, drawn);
            let swings = swing(&rig, &joints, way, edge, parts.map(|part| 1.0 + 0.2 * part));
            waste = waste.max(rests + swings);
            part = part.max(swings - rests);
        }
    }
    let (most_waste, most_part) = (entry.into_waste.most, entry.into_part.most);
    assert!(
        0.9 * most_waste <= waste && waste <= most_waste + 1e-7,
        "{waste} {entry:?}"
    );
    assert!(part <= most_part + 1e-7, "{part} {entry:?}");
    assert!(most_waste > 1.5 * of.into_waste.most && most_part > of.into_part.most);
    assert!(compiled.summary.iter().any(|line| line.contains("at entry")));
}

#[test]
fn a_place_of_a_cut_has_the_shift_of_forces_as_stated() {
    let outcome = compiled(&job(STATED, "", ""));
    let compiled = outcome.compiled.as_ref().unwrap();
    let checked = outcome.job.as_ref().unwrap();
    let machine = checked.machine.as_ref().unwrap();
    let reached = compiled.program.reached().unwrap();
    let program = reached.program.program();
    let rigs = Rigs::of(&machine.model, program.cell.as_ref().unwrap(), program);
    let known = Known {
        model: &machine.model,
        reached: &reached.program,
        rigs: &rigs,
        edges: &compiled.report.edges,
        compensations: &compiled.report.compensations,
    };
    let cuts_of = Cuts::of(known, &pushed_blades(checked)).unwrap();
    let deviations = Deviations::of(&cuts_of, None).unwrap();
    let rig = Rig::of(machine);
    let mut seen = 0;
    for Place {
        op,
        done,
        way,
        joints,
    } in cuts(&outcome)
    {
        let there = cuts_of.in_place(op, done, &joints).unwrap();
        let off = deviations.in_place(op, done, &joints).unwrap();
        let stated = |up: f64| {
            let drawn = Drawn {
                times: 1.0,
                parts: [0.0; 3],
                springs: [0.0; 6],
                from: 0.0,
                to: 1.0,
                up,
            };
            shift(&rig, &joints, way, there.engaged.to_mm(), drawn)
        };
        let tolerance = 1e-8;
        assert!(
            (off.tip - stated(0.0)).abs() < tolerance,
            "{there:?} {}",
            stated(0.0)
        );
        assert!(
            (off.end - stated(1.0)).abs() < tolerance,
            "{there:?} {}",
            stated(1.0)
        );
        // The drives work against the drag.
        assert!(there.force.y * way < 0.0);
        seen += 1;
    }
    assert!(seen > 10);
}

#[test]
fn forces_change_no_program() {
    let body = |forces: &str, limits: &str, machine: &str| {
        let bundle = emit(&compiled(&job(forces, limits, machine))).unwrap();
        let texts = bundle
            .files()
            .iter()
            .map(|(_, bytes)| String::from_utf8_lossy(bytes).into_owned());
        // The head names the job's hash, which is another one.
        let lines: Vec<String> = texts
            .flat_map(|text| text.lines().map(str::to_owned).collect::<Vec<_>>())
            .collect();
        lines
            .into_iter()
            .filter(|line| !line.starts_with(';'))
            .collect::<Vec<_>>()
    };
    let bodies = [
        body("", "", ""),
        body(STATED, "", ""),
        body(STATED, "limits { deviation <= 1 mm }", "gravity = compensated"),
    ];
    assert_eq!(bodies[0], bodies[1]);
    assert_eq!(bodies[0], bodies[2]);
}

#[test]
fn a_job_without_forces_says_what_is_not_checked() {
    let outcome = compiled(&job("", "", ""));
    let compiled = outcome.compiled.as_ref().unwrap();
    assert_eq!(compiled.dynamics.deviation, None);
    let not_checked = compiled.checks.not_checked().unwrap();
    assert!(
        not_checked
            .contains("how far the forces of the blade push it off (not all blades state their forces)"),
        "{not_checked}"
    );
    assert!(!compiled.summary.iter().any(|line| line.contains("deviation")));
}

/// The change of sag over the program counts where the control leaves it, and only there.
#[test]
fn sag_counts_where_it_is_not_compensated() {
    let most = |machine: &str| {
        let outcome = compiled(&job(STATED, "", machine));
        let figures = outcome.compiled.unwrap().dynamics.deviation.unwrap();
        let gravity = figures.gravity.unwrap();
        (figures.operations[0].into_waste.most, gravity.change)
    };
    let (silent, change) = most("");
    let (compensated, same) = most("gravity = compensated");
    let (left, again) = most("gravity = uncompensated");
    assert_eq!((silent, change), (compensated, same));
    assert_eq!(change, again);
    assert!(change > 0.1, "{change}");
    assert!((left - silent - 0.5 * change).abs() < 1e-9);
}

#[test]
fn a_limit_that_is_passed_is_an_error_with_one_that_is_kept() {
    let files = job(STATED, "limits { deviation <= 0.002 mm }", "");
    let outcome = compile(JOB, &files);
    assert!(outcome.compiled.is_none());
    let passed = outcome
        .diagnostics
        .iter()
        .find(|diagnostic| diagnostic.code == Code::DeviationAboveLimit);
    let passed = passed.expect("an error");
    assert_eq!(passed.severity(), Severity::Error);
    let mended = compile(JOB, &fixed(&files, &outcome, &passed.fixes[0]));
    assert!(
        mended.compiled.is_some(),
        "{}",
        rendered(&all_diagnostics(&mended), &mended)
    );
}

#[test]
fn a_limit_without_a_machine_is_not_silently_kept() {
    let text = text(STATED, "limits { deviation <= 1 mm }", "");
    let alone = text[..text.find("machine cell").unwrap()].to_owned();
    let outcome = compile(JOB, &Files::default().with(JOB, alone));
    assert!(
        outcome
            .diagnostics
            .iter()
            .any(|diagnostic| diagnostic.code == Code::LimitNotChecked)
    );
}
