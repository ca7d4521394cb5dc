//! Tips that are offset against the forces of the blade: against the oracle of [`crate::forces`], which knows the kinematics of the
//! arm alone.

use crate::forces::{Drawn, JOB, Place, arm, compiled, cuts, shift, text};
use crate::pipeline::{Files, all_diagnostics, compile, emit, emit_for, fixed, krl, numbers, rendered};
use glam::DVec3;
use proptest::prelude::*;
use std::collections::BTreeMap;
use std::sync::LazyLock;
use vcutc::driver::Outcome;
use vcutc::driver::dynamics::cut_by_cut;
use vcutc::dynamics::deviation::figures::{OperationDeviation, millimetres};
use vcutc::motion::rig::Rig;
use vcutc::registry;
use vcutc::simulation::prove::{Compensation, VNumber};
use vcutc_backend_api::ir::{Action, OpId, Site};
use vcutc_backend_api::verify::VerifiedProgram;

/// Ten times what [`crate::forces::STATED`] states, as of a blade whose ultrasound is weak.
const STRONG: &str = "forces { drag = 11 N/mm, axial = 4 N/mm, side = 3 N/mm, \
    tip = force(drag = 30 N, axial = 10 N, side = 20 N), spread = 20 %, \
    measured { feed = 100 mm/s, rake = 60 deg, swing = 35 deg }, source = \"this test\" }";

const COMPENSATED: &str = "allowance = 0.5 mm compensate = forces";
const PLAIN: &str = "allowance = 0.5 mm";

fn job(forces: &str, operation: &str, machine: &str) -> Files {
    Files::default()
        .with(JOB, text(forces, operation, machine))
        .with("arm.toml", arm())
}

static OFF: LazyLock<Outcome> = LazyLock::new(|| compiled(&job(STRONG, PLAIN, "")));
static OFFSET: LazyLock<Outcome> = LazyLock::new(|| compiled(&job(STRONG, COMPENSATED, "")));

fn verified(outcome: &Outcome) -> &VerifiedProgram {
    outcome.compiled.as_ref().unwrap().program.verified()
}

fn figures(outcome: &Outcome) -> &OperationDeviation {
    let figures = outcome.compiled.as_ref().unwrap().dynamics.deviation.as_ref();
    &figures.unwrap().operations[0]
}

fn compensation(outcome: &Outcome) -> &Compensation {
    let report = &outcome.compiled.as_ref().unwrap().report;
    report.compensations[0].as_ref().unwrap()
}

/// The x and z of every tip, flank by flank.
fn tips(outcome: &Outcome) -> Vec<(OpId, VNumber, [f64; 2])> {
    let program = verified(outcome).program();
    let cuts = program.ends().filter_map(|(id, op, after)| {
        let (Action::Cut { .. }, Site::Cut { layer, cut, .. }) = (op.action, op.site) else {
            return None;
        };
        let tip = after.place.pose()?.tip;
        Some((id, (layer, cut), [tip.x, tip.z]))
    });
    cuts.collect()
}

#[test]
fn both_flanks_of_a_v_are_offset_alike_and_nothing_else_changes() {
    let by = compensation(&OFFSET);
    let (plain, offset) = (tips(&OFF), tips(&OFFSET));
    assert_eq!(plain.len(), offset.len());
    let mut largest = 0.0_f64;
    for ((op, vee, before), (other, _, after)) in plain.iter().zip(&offset) {
        assert_eq!(op, other);
        let offset = by.offset(*vee);
        let moved = [after[0] - before[0], after[1] - before[1]];
        assert!(
            (moved[0] - offset.x).abs() < 1e-9 && (moved[1] - offset.z).abs() < 1e-9,
            "{vee:?} {moved:?}"
        );
        largest = largest.max(libm::hypot(offset.x, offset.z));
    }
    assert!(largest > 0.05, "{largest}");
    let stated = verified(&OFFSET).program().operations[0].compensation.unwrap();
    assert!((stated.to_mm() - largest).abs() < 1e-12);
    assert_eq!(verified(&OFF).program().operations[0].compensation, None);
    // What is left of the stock under load is what was planned.
    let [plain, offset] = [&OFF, &OFFSET].map(|outcome| &outcome.compiled.as_ref().unwrap().report);
    assert_eq!(plain.layers, offset.layers);
    assert_eq!(plain.contour.len(), offset.contour.len());
    for (one, other) in plain.contour.iter().zip(&offset.contour) {
        assert!((one.x - other.x).abs() < 1e-9 && (one.z - other.z).abs() < 1e-9);
    }
}

/// How far a flank lies from where it was planned, along its normal, while these forces and springs push all of its edge.
fn off(outcome: &Outcome, place: Place, drawn: Drawn) -> f64 {
    let Place { op, way, joints, .. } = place;
    let compiled = outcome.compiled.as_ref().unwrap();
    let rig = Rig::of(outcome.job.as_ref().unwrap().machine.as_ref().unwrap());
    let used = compiled.report.edges.iter().find(|used| used.op == op).unwrap();
    let yields = shift(&rig, &joints, way, used.length.to_mm(), drawn);
    yields + along_normal(outcome, place)
}

/// How far a tip is offset along the normal of its flank.
fn along_normal(outcome: &Outcome, place: Place) -> f64 {
    let rig = Rig::of(outcome.job.as_ref().unwrap().machine.as_ref().unwrap());
    let y = rig.blade_in_work(&place.joints).rotation.y_axis;
    let normal = if y.z > 0.0 { y } else { -y };
    let find = |of: &Outcome| tips(of).into_iter().find(|(op, ..)| *op == place.op).unwrap().2;
    let (written, planned) = (find(outcome), find(&OFF));
    normal.dot(DVec3::new(written[0] - planned[0], 0.0, written[1] - planned[1]))
}

const STATED_FORCES: Drawn = Drawn {
    times: 10.0,
    parts: [0.0; 3],
    springs: [0.0; 6],
    from: 0.0,
    to: 1.0,
    up: 0.0,
};

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, ..ProptestConfig::default() })]
    #[test]
    fn under_load_no_flank_is_off_by_more_than_the_figures(
        parts in prop::array::uniform3(-1.0..=1.0_f64),
        springs in prop::array::uniform6(-1.0..=1.0_f64),
        up in prop_oneof![Just(0.0), Just(1.0), 0.0..=1.0_f64],
        at in any::<prop::sample::Index>(),
    ) {
        let all = cuts(&OFFSET);
        let place = all[at.index(all.len())];
        let off = off(&OFFSET, place, Drawn { parts, springs, up, ..STATED_FORCES });
        let of = figures(&OFFSET);
        prop_assert!(off <= of.into_waste.most + 1e-7 && -off <= of.into_part.most + 1e-7, "{off} {of:?}");
        let compiled = OFFSET.compiled.as_ref().unwrap();
        let figures = compiled.dynamics.deviation.as_ref().unwrap();
        let each = cut_by_cut(OFFSET.job.as_ref().unwrap(), compiled, figures).unwrap();
        let cut = each.iter().find(|cut| cut.op == place.op).unwrap();
        prop_assert!(off <= cut.into_waste + 1e-7 && -off <= cut.into_part + 1e-7, "{off} {cut:?}");
    }
}

/// With forces and springs as stated, what stays of a deviation is less than half of it on every cut that yields by more than the grid.
#[test]
fn compensation_takes_most_of_the_deviation_out() {
    let mut worst: BTreeMap<OpId, [f64; 2]> = BTreeMap::new();
    let all = cuts(&OFF).into_iter().zip(cuts(&OFFSET));
    for (before, after) in all {
        let [plain, left] = [
            off(&OFF, before, STATED_FORCES),
            off(&OFFSET, after, STATED_FORCES),
        ];
        let of = worst.entry(before.op).or_default();
        *of = [of[0].max(plain.abs()), of[1].max(left.abs())];
    }
    assert!(worst.len() > 10);
    for (op, [plain, left]) in worst {
        assert!(left < 0.5 * plain.max(0.004), "{op:?}: {plain} {left}");
    }
}

#[test]
fn the_summary_states_how_much_deeper_flanks_lie_where_less_pushes() {
    let deepest = cuts(&OFFSET)
        .into_iter()
        .map(|place| -along_normal(&OFFSET, place))
        .fold(0.0, f64::max);
    let figure = figures(&OFFSET).compensation.as_ref().unwrap();
    // Nothing pushes somewhere, and hardly anything pushes these flanks farther into the part.
    assert!(
        figure.deeper >= deepest - 1e-9 && figure.deeper < 1.3 * deepest,
        "{figure:?} {deepest}"
    );
    assert_eq!(figures(&OFF).compensation, None);
    let compiled = OFFSET.compiled.as_ref().unwrap();
    assert!(compiled.summary.iter().any(|line| line.contains("compensated")));
    assert!(compiled.checks.proven().contains("where less pushes the blade"));
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, ..ProptestConfig::default() })]
    #[test]
    fn whatever_is_in_the_material_no_flank_lies_deeper_than_stated(
        parts in prop::array::uniform3(-1.0..=1.0_f64),
        springs in prop::array::uniform6(-1.0..=1.0_f64),
        from in prop_oneof![Just(0.0), 0.0..=1.0_f64],
        to in prop_oneof![Just(0.0), Just(1.0), 0.0..=1.0_f64],
        up in prop_oneof![Just(0.0), Just(1.0), 0.0..=1.0_f64],
        at in any::<prop::sample::Index>(),
    ) {
        let all = cuts(&OFFSET);
        let place = all[at.index(all.len())];
        let drawn = Drawn { times: 10.0, parts, springs, from: from.min(to), to: from.max(to), up };
        let off = off(&OFFSET, place, drawn);
        let deeper = figures(&OFFSET).compensation.as_ref().unwrap().deeper;
        prop_assert!(-off <= deeper + 1e-7, "{off} {deeper}");
    }
}

/// Over forces and stretches of the edge at one end or the other, soft springs: some flank lies nearly as deep as stated.
#[test]
fn the_depth_that_is_stated_is_nearly_reached() {
    let mut deepest = 0.0_f64;
    for place in cuts(&OFFSET) {
        for corner in 0..64_u32 {
            let end = |bit: u32| f64::from(corner >> bit & 1);
            let drawn = Drawn {
                times: 10.0,
                parts: [0, 1, 2].map(|bit| 2.0 * end(bit) - 1.0),
                springs: [-1.0; 6],
                from: end(3).min(end(4)),
                to: end(4),
                up: end(5),
            };
            deepest = deepest.max(-off(&OFFSET, place, drawn));
        }
        deepest = deepest.max(-along_normal(&OFFSET, place));
    }
    let deeper = figures(&OFFSET).compensation.as_ref().unwrap().deeper;
    assert!(
        deepest <= deeper + 1e-7 && deepest >= 0.9 * deeper,
        "{deepest} {deeper}"
    );
}

/// The lines of a program that a control carries out.
fn statements(outcome: &Outcome) -> Vec<String> {
    let bundle = emit(outcome).unwrap();
    let texts = bundle.files().iter();
    let texts = texts.map(|(_, bytes)| String::from_utf8_lossy(bytes).into_owned());
    let lines = texts.flat_map(|text| text.lines().map(str::to_owned).collect::<Vec<_>>());
    lines.filter(|line| !line.starts_with(';')).collect()
}

#[test]
fn nothing_to_compensate_is_the_same_program() {
    let nothing = compiled(&job(STRONG, "allowance = 0.5 mm compensate = nothing", ""));
    assert_eq!(statements(&nothing), statements(&OFF));
    assert_ne!(statements(&OFFSET), statements(&OFF));
}

#[test]
fn programs_name_their_compensation_for_people() {
    for target in [krl(), registry::backend("rapid").unwrap()] {
        let sheet = match target.id() {
            "rapid" => arm().replace("manufacturer = \"KUKA\"", "manufacturer = \"ABB\""),
            _ => arm(),
        };
        let text = match target.id() {
            "rapid" => text(STRONG, COMPENSATED, "").replace(
                "output(12)",
                "output(12) rapid { ultrasonic_signal = \"doBlade\" }",
            ),
            _ => text(STRONG, COMPENSATED, ""),
        };
        let files = Files::default().with(JOB, text).with("arm.toml", sheet);
        let outcome = compiled(&files);
        // Which includes that it reads back as the same program.
        let bundle = emit_for(target, &outcome).unwrap();
        let (_, largest) = compensation(&outcome).largest().unwrap();
        let words = format!(
            "operation 1: tips offset for forces, at most {:.3} mm",
            (1000.0 * largest).ceil() / 1000.0
        );
        let named = bundle.files().iter();
        let named = named
            .map(|(_, bytes)| String::from_utf8_lossy(bytes))
            .any(|text| text.contains(&words));
        assert!(named, "{}", target.id());
    }
}

/// A part that the tips of the last layer come near to.
fn near(allowance: &str) -> Files {
    let operation = format!("allowance = {allowance} compensate = forces");
    let text = text(STRONG, &operation, "").replace("lattice = orthogonal", "lattice = free");
    let text = text.replace("layer = 7 mm", "layer = 5 mm");
    Files::default().with(JOB, text).with("arm.toml", arm())
}

#[test]
fn a_tip_offset_into_the_part_is_refused_with_what_helps() {
    let files = near("0.01 mm");
    let outcome = compile(JOB, &files);
    let diagnostics = all_diagnostics(&outcome);
    assert_eq!(
        numbers(&diagnostics),
        ["VC0538"],
        "{}",
        rendered(&diagnostics, &outcome)
    );
    let roomy = compile(JOB, &near("0.3 mm"));
    assert!(roomy.compiled.is_some());
    let found = diagnostics.into_iter().next().unwrap();
    assert!(
        found.message.contains("where less pushes the blade"),
        "{}",
        found.message
    );
    let [fix] = found.fixes.as_slice() else {
        panic!("{found:?}")
    };
    let mended = compile(JOB, &fixed(&files, &outcome, fix));
    assert!(
        mended.compiled.is_some(),
        "{}",
        rendered(&all_diagnostics(&mended), &mended)
    );
}

/// The blade's side towards the part, which lies half its thickness deeper, stays out of the part wherever a tip is written.
#[test]
fn what_is_written_stays_out_of_the_part() {
    let outcome = compiled(&near("0.1 mm"));
    let part = |x: f64| 8.0 + 4.0 * x / 50.0;
    let (sine, slope) = (35.0_f64.to_radians().sin(), 1.0 / 35.0_f64.to_radians().tan());
    let mut nearest = f64::INFINITY;
    for (_, _, [x, z]) in tips(&outcome) {
        for step in 0..=500 {
            let there = f64::from(step) * 0.1;
            let side = z + slope * (there - x).abs() - 0.5 / sine;
            nearest = nearest.min(side - part(there));
        }
    }
    // The allowance is used up in part.
    assert!((-1e-9..0.1).contains(&nearest), "{nearest}");
}

#[test]
fn a_limit_that_compensation_keeps_is_mended_by_it() {
    let limit = "allowance = 0.5 mm limits { deviation <= 0.06 mm }";
    let files = job(STRONG, limit, "");
    let outcome = compile(JOB, &files);
    let diagnostics = all_diagnostics(&outcome);
    assert_eq!(numbers(&diagnostics), ["VC0533"]);
    let is_compensation = |fix: &&vcutc::diagnostics::Fix| fix.title.contains("compensate = forces");
    let fix = diagnostics[0].fixes.iter().find(is_compensation).unwrap();
    let mended = compile(JOB, &fixed(&files, &outcome, fix));
    assert!(
        mended.compiled.is_some(),
        "{}",
        rendered(&all_diagnostics(&mended), &mended)
    );
    let of = figures(&mended);
    let most = of.into_waste.most.max(of.into_part.most);
    assert!(most <= 0.06);
    let words = format!("which leaves {} under load", millimetres(most));
    assert!(fix.title.contains(&words), "{} {words}", fix.title);
}

#[test]
fn what_is_not_known_cannot_be_compensated() {
    let cases = [
        (job("", COMPENSATED, ""), "states no forces"),
        (
            job(STRONG, COMPENSATED, "").with("arm.toml", without_springs()),
            "does not state how its joints yield",
        ),
        (
            Files::default()
                .with(
                    JOB,
                    text(STRONG, COMPENSATED, "gravity = uncompensated").replace("load = load", "// "),
                )
                .with("arm.toml", arm()),
            "its masses or its load are not known",
        ),
    ];
    for (files, words) in cases {
        let outcome = compile(JOB, &files);
        let diagnostics = all_diagnostics(&outcome);
        assert!(outcome.compiled.is_none());
        assert_eq!(numbers(&diagnostics), ["VC0538"]);
        assert!(
            diagnostics[0].message.contains(words),
            "{}",
            diagnostics[0].message
        );
    }
}

fn without_springs() -> String {
    let sheet = arm();
    let (before, after) = sheet.split_once("[elasticity]").unwrap();
    let after = &after[after.find("[dynamics]").unwrap()..];
    format!("{before}{after}")
}

#[test]
fn an_offset_that_needs_more_edge_than_there_is_is_refused() {
    let with_edge = |length: &str, operation: &str| {
        let text = text(STRONG, operation, "")
            .replace("cutting_length = 20 mm", &format!("cutting_length = {length}"));
        Files::default().with(JOB, text).with("arm.toml", arm())
    };
    let used = |outcome: &Outcome| outcome.compiled.as_ref().unwrap().report.longest_edge.to_mm();
    let [plain, offset] = [&OFF, &OFFSET].map(|outcome| used(outcome));
    assert!(offset > plain + 0.05, "{plain} {offset}");
    // Enough of it as planned, but not with the tips offset.
    let short = format!("{} mm", (plain * 100.0).ceil() / 100.0);
    assert!(compile(JOB, &with_edge(&short, PLAIN)).compiled.is_some());
    let outcome = compile(JOB, &with_edge(&short, COMPENSATED));
    let diagnostics = all_diagnostics(&outcome);
    assert!(
        numbers(&diagnostics).contains(&"VC0538"),
        "{}",
        rendered(&diagnostics, &outcome)
    );
    assert!(diagnostics.iter().any(|found| found.message.contains("may need")));
}

#[test]
fn only_figures_of_compensated_operations_are_meant_under_load() {
    let text = text(STRONG, PLAIN, "");
    let from = text.find("rough vcut").unwrap();
    let to = text.find("machine cell").unwrap();
    let second = text[from..to]
        .replace(PLAIN, COMPENSATED)
        .replace("layer = 7 mm", "layer = 3 mm");
    let both = format!("{}{second}{}", &text[..to], &text[to..]);
    let outcome = compiled(&Files::default().with(JOB, both).with("arm.toml", arm()));
    let lines = &outcome.compiled.as_ref().unwrap().summary;
    let line = lines
        .iter()
        .find(|line| line.trim_start().starts_with("deviation"))
        .unwrap();
    let (waste, _) = line.split_once("into the waste").unwrap();
    let waste_of_first = line.contains("into the waste (layer 1, cut 6 of operation 1");
    assert!(waste_of_first && !waste.contains("under load"), "{line}");
}

#[test]
fn without_forces_nothing_is_offset() {
    let nothing = "forces { drag = 0 N/mm, axial = 0 N/mm, side = 0 N/mm, spread = 20 %, \
        measured { feed = 100 mm/s, rake = 60 deg, swing = 35 deg }, source = \"this test\" }";
    let outcome = compiled(&job(nothing, COMPENSATED, ""));
    assert_eq!(statements(&outcome), statements(&OFF));
    let bundle = emit(&outcome).unwrap();
    let texts = bundle.files().iter();
    let mut texts = texts.map(|(_, bytes)| String::from_utf8_lossy(bytes));
    assert!(texts.any(|text| text.contains("operation 1: tips offset for forces, at most 0 mm")));
}

#[test]
fn a_given_tip_is_not_helped_by_an_allowance() {
    let text = text(STRONG, "compensate = forces", "")
        .replace("lattice = orthogonal", "tips (25 mm, 10.9 mm)")
        .replace("layer = 7 mm", "")
        .replace("24 mm)", "20 mm)");
    let outcome = compile(JOB, &Files::default().with(JOB, text).with("arm.toml", arm()));
    let diagnostics = all_diagnostics(&outcome);
    assert_eq!(
        numbers(&diagnostics),
        ["VC0538"],
        "{}",
        rendered(&diagnostics, &outcome)
    );
    assert!(diagnostics[0].fixes.is_empty());
    assert!(
        diagnostics[0].help[0].starts_with("raise this tip"),
        "{:?}",
        diagnostics[0].help
    );
}
