//! Cuts along a fan: what their programs do to the stock, by the blade in space and by dexels, which know neither fans nor slabs; and
//! programs that were changed.

use crate::pipeline::{Files, compile};
use crate::spine::{
    ALLOWANCE, DEPTH, DEXEL, GIVEN, HEIGHT, REST, blade_of, codes, compiled, findings, flanks, least_gap,
    left_in, of_cut, program_of, rough,
};
use proptest::prelude::*;
use vcutc::diagnostics::{Code, has_errors};
use vcutc::driver::Outcome;
use vcutc::simulation::prove::{CutFault, Findings};
use vcutc_backend_api::ir::{Action, Op, Program};

/// A part of straight lines along y, with a wave across them and one along them that no straight line follows.
#[derive(Clone, Copy, Debug)]
struct Part {
    across: f64,
    along: f64,
    twist: f64,
    slope: f64,
}

impl Part {
    const HYPAR: Self = Self {
        across: 1e9,
        along: 1e9,
        twist: 700.0,
        slope: 0.0,
    };

    fn height(self, x: f64, y: f64) -> f64 {
        let (u, v) = (x - 50.0, y - 75.0);
        36.0 - u * u / self.across - v * v / self.along + u * v / self.twist + v * self.slope
    }

    fn surface(self) -> String {
        let [u, v] = ["(x - 50 mm)", "(y - 75 mm)"];
        let Self {
            across,
            along,
            twist,
            slope,
        } = self;
        format!(
            "z(x, y) = 36 mm - {u}^2 / ({across} mm) - {v}^2 / ({along} mm) + {u} * {v} / ({twist} mm) + {v} * ({slope})"
        )
    }
}

/// That a job is proven, that nothing of it enters the part, that all chips come out, and that what is left in sections is what the
/// program is said to leave.
fn is_right(outcome: &Outcome, part: Part) {
    assert!(!has_errors(&outcome.diagnostics), "{:?}", outcome.diagnostics);
    let compiled = outcome.compiled.as_ref().unwrap();
    let program = compiled.program.verified().program();
    let blade = blade_of(program);
    let flanks = flanks(program, 5.0);
    assert!(!flanks.is_empty());
    let gap = least_gap(&flanks, blade, &|x, y| part.height(x, y));
    // Formulas are met within 10 um.
    assert!(gap >= ALLOWANCE - 0.011, "{gap}");
    let rulings = &compiled.report.rulings;
    assert!(!rulings.is_empty());
    let highest = compiled.left_over.unwrap().all.highest.height.to_mm();
    for y in [0.05, 31.0, 75.0, 118.3, DEPTH - 0.05] {
        let dexels = left_in(&flanks, y, blade, 0.12);
        for column in 0..=500 {
            // Dexels stand 0.1 mm apart.
            let x = f64::from(column) * 2.0 * DEXEL;
            let left = dexels.height(x);
            let said = rulings.iter().map(|vee| vee.height([x, y], DEPTH));
            let said = said.fold(HEIGHT, f64::min);
            // A flank counts as out where less than 0.12 mm is left above it, which adds up where flanks are parallel.
            let more = left - said;
            assert!(
                (-0.15..0.35).contains(&more),
                "x {x} y {y}: {left} left, {said} said"
            );
            let stays = left - part.height(x, y);
            assert!(stays >= ALLOWANCE - 0.15, "x {x} y {y}: {stays}");
            assert!(stays <= highest + 0.35, "x {x} y {y}: {stays} {highest}");
        }
    }
}

fn fan(part: Part, more: &str) -> Outcome {
    compiled(&part.surface(), &format!("{GIVEN}\n  follow = fan\n  {more}"))
}

#[test]
fn a_hypar_is_roughed_by_a_fan() {
    let lifted = GIVEN.replace("mixed", "lift");
    let roughed =
        |part: Part, follow: &str| compiled(&part.surface(), &format!("{lifted}\n  follow = {follow}"));
    let outcome = roughed(Part::HYPAR, "fan");
    is_right(&outcome, Part::HYPAR);
    let left = |outcome: &Outcome| {
        let left = outcome.compiled.as_ref().unwrap().left_over.unwrap();
        (left.shaded.to_litres(), left.all.highest.height.to_mm())
    };
    // No spine follows it: what is left of it is the fall of its lines, up to 10.7 mm. A fan leaves what a lattice leaves of a plane.
    let spine = roughed(Part::HYPAR, "spine");
    let plane = roughed(
        Part {
            twist: 1e9,
            ..Part::HYPAR
        },
        "straight",
    );
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
        Part::HYPAR.surface(),
        rough(&format!("{given}\n  follow = fan")).replace("60 deg", "90 deg")
    );
    let outcome = compile("job.vcut", &Files::default().with("job.vcut", text));
    is_right(&outcome, Part::HYPAR);
}

#[test]
fn open_parameters_are_chosen_so_that_chips_come_free() {
    let outcome = compiled(
        &Part::HYPAR.surface(),
        "follow = fan\n  limits { scallop <= 9 mm }",
    );
    is_right(&outcome, Part::HYPAR);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn programs_along_fans_do_what_they_are_said_to_do(
        across in prop_oneof![300.0..1000.0_f64, -1000.0..-400.0_f64],
        along in prop_oneof![Just(1e9), 1500.0..5000.0_f64, -5000.0..-1500.0_f64],
        twist in prop_oneof![500.0..2000.0_f64, -2000.0..-500.0_f64],
        slope in -0.06..0.06_f64, swing in 30.0..50.0_f64, layer in 5.0..8.0_f64, step in 6.0..9.0_f64,
        residual in prop_oneof![Just("mixed"), Just("lift")], single: bool,
    ) {
        let part = Part { across, along, twist, slope };
        let edges = if single { "single" } else { "double" };
        let text = format!(
            "{}surface {{ {} }}\n{}",
            REST.replace("double", edges),
            part.surface(),
            rough(&format!(
                "lattice = orthogonal\n  swing = {swing:.3} deg\n  layer = {layer:.3} mm\n  step = {step:.3} mm\n  order = point\n  \
                 sequence = rows\n  residual = {residual}\n  follow = fan"
            )),
        );
        let outcome = compile("job.vcut", &Files::default().with("job.vcut", text));
        // Some lattices ask for more than the blade has; the proof says so.
        let is_refused = outcome.diagnostics.iter().any(|diagnostic| {
            matches!(diagnostic.code, Code::ChipNotFreed | Code::NothingToCut)
        });
        if !is_refused {
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
    let outcome = fan(Part::HYPAR, "");
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

#[test]
fn what_a_fan_cannot_do_is_refused() {
    let codes = |text: String| codes(&compile("job.vcut", &Files::default().with("job.vcut", text)));
    let follow = |more: &str| rough(&format!("{GIVEN}\n  follow = fan\n  {more}"));
    let profile = "profile { start (0 mm, 30 mm), line to (100 mm, 20 mm) }\n";
    let hypar = format!("surface {{ {} }}\n", Part::HYPAR.surface());
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
