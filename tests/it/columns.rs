//! Cuts along columns and fans: what their programs do to the stock, by the blade in space and by dexels; and programs that were changed.

use crate::follow::{
    ALLOWANCE, DEPTH, DEXEL, GIVEN, HEIGHT, NONE, Part, REST, blade_of, codes, compiled, findings, flanks,
    is_refused, laid_out, least_gap, left_in, of_cut, outcome_of, program_of, rough,
};
use crate::pipeline::{Files, compile};
use proptest::prelude::*;
use vcutc::diagnostics::{Code, has_errors};
use vcutc::driver::Outcome;
use vcutc::job::follow::Guide;
use vcutc::simulation::prove::{CutFault, Findings};
use vcutc_backend_api::ir::{Action, Op, Program};
use vcutc_geometry::columns::Columns;

/// A part of straight lines along y.
const HYPAR: Part = Part {
    middle: 36.0,
    twist: 700.0,
    ..Part::LEVEL
};

/// A part that bends along y in another way over each x.
const WARPED: Part = Part {
    across: 400.0,
    along: 2500.0,
    warp: 60_000.0,
    ..Part::LEVEL
};

/// The columns of a job.
fn columns_of(outcome: &Outcome) -> &Columns {
    let part = &outcome.job.as_ref().unwrap().part;
    part.guide().and_then(Guide::columns).unwrap()
}

/// That a job is proven, that nothing of it enters the part, that all chips come out, and that what is left in sections is what the
/// program is said to leave.
fn is_right(outcome: &Outcome, part: Part) {
    assert!(!has_errors(&outcome.diagnostics), "{:?}", outcome.diagnostics);
    let compiled = outcome.compiled.as_ref().unwrap();
    let program = compiled.program.verified().program();
    let blade = blade_of(program);
    let columns = columns_of(outcome);
    let is_fan = columns.is_fan();
    let flanks = flanks(program, if is_fan { 5.0 } else { 0.5 });
    assert!(!flanks.is_empty());
    let off = columns.deviation(blade.cutting_length.to_mm()).both();
    let gap = least_gap(&flanks, blade, &|x, y| part.height(x, y));
    // Formulas are met within 10 um.
    assert!(gap >= ALLOWANCE - 0.011, "{gap}");
    let vees = &compiled.report.columns;
    assert!(!vees.is_empty());
    let highest = compiled.left_over.unwrap().all.highest.height.to_mm();
    for y in [0.05, 31.0, 75.0, 118.3, DEPTH - 0.05] {
        let dexels = left_in(&flanks, y, blade, if is_fan { 0.12 } else { 0.3 });
        for column in 0..=500 {
            // Dexels stand 0.1 mm apart.
            let x = f64::from(column) * 2.0 * DEXEL;
            let left = dexels.height(x);
            let said = vees.iter().map(|vee| vee.height([x, y], columns.knots()));
            let said = said.fold(HEIGHT, f64::min);
            // A flank counts as out where less than 0.12 mm is left above it, which adds up where flanks are parallel.
            let more = left - said;
            assert!(
                (-0.15 - off..0.35 + off).contains(&more),
                "x {x} y {y}: {left} left, {said} said"
            );
            let stays = left - part.height(x, y);
            assert!(stays >= ALLOWANCE - 0.15, "x {x} y {y}: {stays}");
            assert!(stays <= highest + 0.35 + off, "x {x} y {y}: {stays} {highest}");
        }
    }
}

fn followed(part: Part, follow: &str) -> Outcome {
    compiled(&part.surface(), &format!("{GIVEN}\n  follow = {follow}"))
}

#[test]
fn a_hypar_is_roughed_by_a_fan() {
    let lifted = GIVEN.replace("mixed", "lift");
    let roughed =
        |part: Part, follow: &str| compiled(&part.surface(), &format!("{lifted}\n  follow = {follow}"));
    let outcome = roughed(HYPAR, "fan");
    is_right(&outcome, HYPAR);
    let left = |outcome: &Outcome| {
        let left = outcome.compiled.as_ref().unwrap().left_over.unwrap();
        (left.shaded.to_litres(), left.all.highest.height.to_mm())
    };
    // No spine follows it: what is left of it is the fall of its lines, up to 10.7 mm. A fan leaves what a lattice leaves of a plane.
    let spine = roughed(HYPAR, "spine");
    let plane = roughed(Part { twist: NONE, ..HYPAR }, "straight");
    let [(below, high), (below_spine, high_spine), (_, high_plane)] = [&outcome, &spine, &plane].map(left);
    assert!(below < 1e-3 && below_spine > 0.03, "{below} {below_spine}");
    assert!(high_spine > high + 5.0, "{high_spine} {high}");
    assert!(high < high_plane + 0.1, "{high} {high_plane}");
}

#[test]
fn an_upright_blade_follows_a_fan() {
    let given = GIVEN.replace("layer = 8 mm", "layer = 6 mm");
    let text = format!(
        "{REST}surface {{ {} }}\n{}",
        HYPAR.surface(),
        rough(&format!("{given}\n  follow = fan")).replace("60 deg", "90 deg")
    );
    let outcome = compile("job.vcut", &Files::default().with("job.vcut", text));
    is_right(&outcome, HYPAR);
}

#[test]
fn open_parameters_are_chosen_so_that_chips_come_free() {
    let outcome = compiled(&HYPAR.surface(), "follow = fan\n  limits { scallop <= 9 mm }");
    is_right(&outcome, HYPAR);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn programs_along_fans_do_what_they_are_said_to_do(
        across in prop_oneof![300.0..1000.0_f64, -1000.0..-400.0_f64],
        along in prop_oneof![Just(NONE), 1500.0..5000.0_f64, -5000.0..-1500.0_f64],
        twist in prop_oneof![500.0..2000.0_f64, -2000.0..-500.0_f64],
        slope in -0.06..0.06_f64, swing in 30.0..50.0_f64, layer in 5.0..8.0_f64, step in 6.0..9.0_f64,
        residual in prop_oneof![Just("mixed"), Just("lift")], single: bool,
    ) {
        let part = Part { middle: 36.0, across, along, twist, slope, ..Part::LEVEL };
        let outcome = outcome_of(part, single, &laid_out([swing, layer, step], residual, "fan"));
        if !is_refused(&outcome) {
            is_right(&outcome, part);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(8))]

    #[test]
    fn programs_along_columns_do_what_they_are_said_to_do(
        across in prop_oneof![200.0..1000.0_f64, -1000.0..-400.0_f64],
        along in prop_oneof![Just(NONE), 800.0..4000.0_f64, -4000.0..-800.0_f64],
        twist in prop_oneof![Just(NONE), 700.0..3000.0_f64, -3000.0..-700.0_f64],
        warp in prop_oneof![45_000.0..200_000.0_f64, -200_000.0..-45_000.0_f64],
        slope in -0.06..0.06_f64, swing in 30.0..50.0_f64, layer in 5.0..8.0_f64, step in 6.0..9.0_f64,
        residual in prop_oneof![Just("mixed"), Just("lift")], single: bool,
    ) {
        let part = Part { middle: 36.0, across, along, twist, slope, warp };
        let outcome = outcome_of(part, single, &laid_out([swing, layer, step], residual, "columns"));
        if !is_refused(&outcome) {
            prop_assert!(columns_of(&outcome).slabs() > 1);
            is_right(&outcome, part);
        }
    }
}

/// A program with the ways of a cut changed.
fn changed(program: &Program, is_changed: impl Fn(&Op) -> bool, by: impl Fn(f64) -> f64) -> Program {
    let mut changed = program.clone();
    for op in changed.ops.iter_mut().filter(|op| is_changed(op)) {
        if let Action::Follow { to, .. } | Action::Travel { to, .. } | Action::Approach { to, .. } =
            &mut op.action
        {
            to.z += by(to.y);
        }
    }
    changed
}

#[test]
fn changed_programs_are_found() {
    let outcome = followed(HYPAR, "fan");
    let plan = outcome.plan.as_ref().unwrap();
    let program = program_of(&outcome).clone();
    assert_eq!(findings(plan, &program), Findings::default());
    let last = program
        .ops
        .iter()
        .filter_map(|op| match (op.site, op.action) {
            (vcutc_backend_api::ir::Site::Cut { layer, cut, .. }, Action::Follow { .. }) => {
                Some((layer.get(), cut.get()))
            }
            _ => None,
        })
        .next_back()
        .unwrap();
    let of_last = |op: &Op| of_cut(op, last.0, last.1);
    // Steeper than its blade is held.
    let tilted = changed(&program, of_last, |y| y * 1e-3);
    let (_, finding) = findings(plan, &tilted).strays.unwrap();
    assert!(matches!(finding.fault, CutFault::Strays { .. }), "{finding:?}");
    // All of it lower.
    let lower = findings(plan, &changed(&program, of_last, |_| -8.0));
    let entered = lower.overcut.unwrap();
    let CutFault::Overcut { depth, .. } = entered.fault else {
        panic!("{entered:?}")
    };
    assert!((0.1..8.01).contains(&depth.to_mm()), "{depth:?}");
}

/// What lies below what cuts can reach, in litres, and how high material stays at most.
fn left(outcome: &Outcome) -> (f64, f64) {
    let left = outcome.compiled.as_ref().unwrap().left_over.unwrap();
    (left.shaded.to_litres(), left.all.highest.height.to_mm())
}

#[test]
fn a_warped_part_is_roughed_by_columns() {
    let outcome = followed(WARPED, "columns");
    is_right(&outcome, WARPED);
    assert!(columns_of(&outcome).slabs() > 10);
    // Neither one spine nor straight lines follow it.
    let (below, _) = left(&outcome);
    for follow in ["spine", "fan"] {
        let (other, _) = left(&followed(WARPED, follow));
        assert!(below < 1e-3 && other > 0.01, "{follow}: {below} {other}");
    }
}

#[test]
fn a_dome_is_roughed_by_columns() {
    let dome = Part {
        across: 200.0,
        along: 1200.0,
        ..Part::LEVEL
    };
    let outcome = followed(dome, "columns");
    is_right(&outcome, dome);
    // A spine follows it as well.
    let [(_, columns), (_, spine)] = [left(&outcome), left(&followed(dome, "spine"))];
    assert!((columns - spine).abs() < 0.5, "{columns} {spine}");
}

/// Columns of a part of straight lines are a fan.
#[test]
fn columns_of_straight_lines_are_a_fan() {
    let [columns, fan] = ["columns", "fan"].map(|follow| followed(HYPAR, follow));
    assert!(columns_of(&columns).is_fan());
    is_right(&columns, HYPAR);
    assert!((left(&columns).1 - left(&fan).1).abs() < 0.05);
}

#[test]
fn open_parameters_of_columns_are_chosen_so_that_chips_come_free() {
    let outcome = compiled(
        &WARPED.surface(),
        "follow = columns\n  limits { scallop <= 9 mm }",
    );
    is_right(&outcome, WARPED);
}

#[test]
fn an_upright_blade_follows_columns() {
    let given = GIVEN.replace("layer = 8 mm", "layer = 6 mm");
    let text = format!(
        "{REST}surface {{ {} }}\n{}",
        WARPED.surface(),
        rough(&format!("{given}\n  follow = columns")).replace("60 deg", "90 deg")
    );
    let outcome = compile("job.vcut", &Files::default().with("job.vcut", text));
    is_right(&outcome, WARPED);
}

/// The first of all ways that leaves hardly more than the best.
#[test]
fn auto_follows_as_little_as_does() {
    let chosen = |part: Part, more: &str| {
        let text = format!(
            "{REST}surface {{ {} }}\n{}",
            part.surface(),
            rough(&format!("{GIVEN}\n  follow = auto"))
        );
        let outcome = compile(
            "job.vcut",
            &Files::default().with("job.vcut", format!("{text}{more}")),
        );
        let part = &outcome.job.as_ref().unwrap().part;
        match part.guide() {
            None => "straight",
            Some(Guide::Spine(spine)) if spine.knots().len() == 2 => "pitched",
            Some(Guide::Spine(_)) => "spine",
            Some(Guide::Columns(columns)) if columns.is_fan() => "fan",
            Some(Guide::Columns(_)) => "columns",
        }
    };
    let ridge = Part {
        across: 300.0,
        ..Part::LEVEL
    };
    assert_eq!(chosen(ridge, ""), "straight");
    assert_eq!(chosen(Part { slope: 0.1, ..ridge }, ""), "pitched");
    assert_eq!(
        chosen(
            Part {
                along: 1500.0,
                ..ridge
            },
            ""
        ),
        "spine"
    );
    assert_eq!(chosen(HYPAR, ""), "fan");
    assert_eq!(chosen(WARPED, ""), "columns");
    // Beside other operations cuts have no ways of their own.
    let other = rough(&format!("{GIVEN}\n  follow = auto"));
    assert_eq!(chosen(WARPED, &other), "spine");
}

/// One knot of one cut 0.004 mm lower: as much as chains may bend.
#[test]
fn a_knot_that_is_off_its_column_is_found() {
    let outcome = followed(WARPED, "columns");
    let plan = outcome.plan.as_ref().unwrap();
    let program = program_of(&outcome).clone();
    assert_eq!(findings(plan, &program), Findings::default());
    let mut one_knot = program.clone();
    let knots = one_knot.ops.iter_mut().filter(|op| of_cut(op, 2, 5));
    let mut knots = knots.filter_map(|op| match &mut op.action {
        Action::Follow { to, .. } => Some(to),
        _ => None,
    });
    knots.nth(3).unwrap().z -= 0.004;
    let (count, finding) = findings(plan, &one_knot).strays.unwrap();
    assert_eq!((count, finding.layer.get(), finding.cut.get()), (1, 2, 5));
    assert!(matches!(finding.fault, CutFault::Strays { .. }), "{finding:?}");
    // All of one cut lower, its ways too.
    let lower = findings(plan, &changed(&program, |op| of_cut(op, 2, 5), |_| -6.0));
    assert!(lower.overcut.is_some() || lower.not_freed.is_some());
}

#[test]
fn what_a_fan_cannot_do_is_refused() {
    let codes = |text: String| codes(&compile("job.vcut", &Files::default().with("job.vcut", text)));
    let follow = |more: &str| rough(&format!("{GIVEN}\n  follow = fan\n  {more}"));
    let profile = "profile { start (0 mm, 30 mm), line to (100 mm, 20 mm) }\n";
    let hypar = format!("surface {{ {} }}\n", HYPAR.surface());
    assert_eq!(
        codes(format!("{REST}{profile}{}", follow(""))),
        [Code::CannotFollow]
    );
    assert_eq!(
        codes(format!("{REST}{hypar}{}", follow("avoid = swing"))),
        [Code::CannotFollow]
    );
    let two = format!("{REST}{hypar}{}{}", follow(""), follow(""));
    assert_eq!(codes(two), [Code::CannotFollow]);
    let body = REST.replace(
        "edges          = double",
        "edges          = double\n  body (25 mm, 8 mm)",
    );
    assert_eq!(
        codes(format!("{body}{hypar}{}", follow(""))),
        [Code::CannotFollow]
    );
}
