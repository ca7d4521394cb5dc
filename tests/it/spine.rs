//! Cuts along spines: what their programs do to the stock, by the blade in space and by dexels; and programs that were changed.

use crate::follow::{
    ALLOWANCE, DEPTH, DEXEL, GIVEN, HEIGHT, NONE, Part, REST, blade_of, codes, compiled, findings, flanks,
    is_refused, laid_out, least_gap, left_in, of_cut, outcome_of, program_of, rough,
};
use crate::pipeline::{Files, compile};
use proptest::prelude::*;
use vcutc::diagnostics::{Code, has_errors};
use vcutc::driver::Outcome;
use vcutc::process::verdict::replay;
use vcutc::simulation::prove::{CutFault, Findings};
use vcutc_backend_api::ir::{Action, Joint, Op, ViaId};
use vcutc_backend_api::verify::verify;

/// That a job is proven, that nothing of it enters the part, that all chips come out, and that what is left in sections is what the
/// program is said to leave.
fn is_right(outcome: &Outcome, height: &dyn Fn(f64, f64) -> f64) {
    assert!(!has_errors(&outcome.diagnostics), "{:?}", outcome.diagnostics);
    let compiled = outcome.compiled.as_ref().unwrap();
    let program = compiled.program.verified().program();
    let blade = blade_of(program);
    let flanks = flanks(program, 0.5);
    assert!(!flanks.is_empty());
    let gap = least_gap(&flanks, blade, height);
    // Formulas are met within 10 um.
    assert!(gap >= ALLOWANCE - 0.011, "{gap}");
    let spine = outcome.job.as_ref().unwrap().part.spine().unwrap().clone();
    let off = spine.deviation(blade.cutting_length.to_mm()).both() + 0.1;
    let contour = &compiled.report.contour;
    for y in [0.05, 31.0, 75.0, 118.3, DEPTH - 0.05] {
        let dexels = left_in(&flanks, y, blade, 0.3);
        for pair in contour.windows(2) {
            let [a, b] = [pair[0], pair[1]];
            let x = f64::midpoint(a.x, b.x);
            let said = f64::midpoint(a.z, b.z) + spine.rise(y);
            let left = dexels.height(x);
            // Half a column on a flank of 40 degrees.
            let room = off + 0.15;
            assert!(
                left <= said + room && left >= said.min(HEIGHT) - room,
                "x {x} y {y}: {left} left, {said} said"
            );
            assert!(
                left >= height((x / DEXEL).round() * DEXEL, y) + ALLOWANCE - 0.15,
                "x {x} y {y}"
            );
        }
    }
}

#[test]
fn a_dome_is_roughed_along_its_spine() {
    let part = Part {
        across: 200.0,
        along: 1200.0,
        slope: 0.0,
        ..Part::LEVEL
    };
    let height = |x: f64, y: f64| part.height(x, y);
    let outcome = compiled(&part.surface(), &format!("{GIVEN}\n  follow = spine"));
    is_right(&outcome, &height);
    // Straight cuts leave the fall of the part along y, 4.7 mm; these hardly anything of it.
    let left = |more: &str| {
        let outcome = compiled(&part.surface(), &format!("{GIVEN}\n  {more}"));
        let compiled = outcome.compiled.as_ref().unwrap();
        compiled.left_over.unwrap().shaded.to_litres()
    };
    let (straight, along) = (left("follow = straight"), left("follow = spine"));
    assert!(along < straight / 10.0, "{along} {straight}");
}

#[test]
fn a_slope_is_roughed_by_pitched_cuts() {
    let part = Part {
        across: 400.0,
        along: NONE,
        slope: 0.18,
        ..Part::LEVEL
    };
    let outcome = compiled(&part.surface(), &format!("{GIVEN}\n  follow = pitched"));
    is_right(&outcome, &|x, y| part.height(x, y));
    let spine = outcome.job.as_ref().unwrap().part.spine().unwrap().clone();
    assert!(
        (spine.end_slopes()[0] - 0.18).abs() < 1e-3,
        "{:?}",
        spine.end_slopes()
    );
}

/// A sum of a wave across and one along: what stays is what stays of the wave across alone, but for what the blade lies off its spine,
/// which tips keep clear of, and for the knots.
#[test]
fn a_sum_of_two_waves_is_left_like_the_wave_across() {
    let across = "30 mm + 8 mm * sin(x / 30 mm * 57.3 deg)";
    let along = "+ 5 mm * cos(y / 60 mm * 57.3 deg)";
    let left = |part: String, more: &str| {
        let text = format!("{REST}{part}\n{}", rough(&format!("{GIVEN}\n  {more}")));
        let outcome = compile("job.vcut", &Files::default().with("job.vcut", text));
        assert!(!has_errors(&outcome.diagnostics), "{:?}", outcome.diagnostics);
        let compiled = outcome.compiled.as_ref().unwrap();
        let spine = outcome.job.as_ref().unwrap().part.spine().cloned();
        let blade = blade_of(compiled.program.verified().program());
        let off = spine.map_or(0.0, |spine| spine.deviation(blade.cutting_length.to_mm()).both());
        (compiled.report.scallop.height.to_mm(), off)
    };
    let (profile, _) = left(format!("profile {{ z(x) = {across} }}"), "");
    let (surface, off) = left(
        format!("surface {{ z(x, y) = {across} {along} }}"),
        "follow = spine",
    );
    assert!(off > 0.01, "{off}");
    assert!(surface <= profile + off + 0.1, "{surface} {profile} {off}");
}

#[test]
fn cuts_follow_as_little_as_does() {
    let follow = |part: Part, more: &str| {
        let outcome = compiled(&part.surface(), &format!("{GIVEN}\n  follow = auto\n  {more}"));
        assert!(!has_errors(&outcome.diagnostics), "{:?}", outcome.diagnostics);
        let knots = outcome
            .job
            .as_ref()
            .unwrap()
            .part
            .spine()
            .map(|spine| spine.knots().len());
        knots.unwrap_or(0)
    };
    let part = Part {
        across: 300.0,
        along: NONE,
        slope: 0.0,
        ..Part::LEVEL
    };
    assert_eq!(follow(part, ""), 0);
    assert_eq!(follow(Part { slope: 0.1, ..part }, ""), 2);
    let dome = Part {
        along: 1500.0,
        ..part
    };
    assert!(follow(dome, "") > 2);
    // What falls by 0.2 mm is not worth following.
    assert_eq!(
        follow(
            Part {
                along: 30_000.0,
                ..part
            },
            ""
        ),
        0
    );
}

#[test]
fn an_upright_blade_follows_bends() {
    let part = Part {
        across: 300.0,
        along: 1200.0,
        slope: 0.0,
        ..Part::LEVEL
    };
    let given = GIVEN.replace("layer = 8 mm", "layer = 6 mm");
    let text = format!(
        "{REST}surface {{ {} }}\n{}",
        part.surface(),
        rough(&format!("{given}\n  follow = spine")).replace("60 deg", "90 deg")
    );
    let outcome = compile("job.vcut", &Files::default().with("job.vcut", text));
    is_right(&outcome, &|x, y| part.height(x, y));
}

#[test]
fn bends_of_a_small_radius_are_followed() {
    for along in [320.0, 300.0, 280.0, 260.0] {
        let part = Part {
            across: 300.0,
            along,
            slope: 0.0,
            ..Part::LEVEL
        };
        let outcome = compiled(&part.surface(), &format!("{GIVEN}\n  follow = spine"));
        let spine = outcome.job.as_ref().unwrap().part.spine().cloned();
        let rise = spine.unwrap().highest(0.0, DEPTH);
        // All of the fall, but for what is smoothed.
        assert!(rise > 0.9 * 75.0 * 75.0 / along, "{along}: {rise}");
    }
}

/// A ramp on which the shank of a wide V would lie down.
#[test]
fn a_shank_that_lies_down_is_refused() {
    let surface = "z(x, y) = 5 mm + y * 0.4 - x * 0.01";
    let flat = rough(&format!("{GIVEN}\n  follow = pitched")).replace("rake      = 60", "rake      = 25");
    let text = format!("{REST}surface {{ {surface} }}\n{flat}");
    let outcome = compile("job.vcut", &Files::default().with("job.vcut", text));
    assert_eq!(codes(&outcome), [Code::RakeTooFlat]);
}

/// What a long blade leaves higher in a crest, a short one has to come out of, too.
#[test]
fn what_other_blades_leave_higher_counts() {
    let operation = |blade: &str, tips: &str| {
        format!(
            "rough vcut {{ blade = {blade}, rake = 60 deg, follow = spine, swing = 45 deg, clearance = 10 mm\n  tips {tips}\n  \
             feed {{ cut = 200 mm/s, travel = 200 mm/s, reorient = 90 deg/s }} }}\n"
        )
    };
    let text = format!(
        "job \"hole\"\nstock {{ size = (120 mm, 150 mm, 42 mm) }}\n\
         surface {{ z(x, y) = 30 mm - (x - 60 mm)^2 / 1000 mm - (y - 75 mm)^2 / 450 mm }}\n\
         blade long {{ cutting_length = 32 mm, half_apex = 9 deg, thickness = 1.6 mm, edges = double }}\n\
         blade short {{ cutting_length = 10 mm, half_apex = 7.13 deg, thickness = 1.5 mm, edges = double }}\n{}{}",
        operation("long", "(40 mm, 26 mm) (80 mm, 26 mm)"),
        operation("short", "(60 mm, 35.5 mm)"),
    );
    let outcome = compile("job.vcut", &Files::default().with("job.vcut", text));
    assert_eq!(codes(&outcome), [Code::ChipNotFreed]);
}

/// An arc between two places of a spine, in the plane of the blade.
#[test]
fn arcs_leave_a_spine() {
    let part = Part {
        across: 400.0,
        along: NONE,
        slope: 0.18,
        ..Part::LEVEL
    };
    let outcome = compiled(&part.surface(), &format!("{GIVEN}\n  follow = pitched"));
    let plan = outcome.plan.as_ref().unwrap();
    let mut program = program_of(&outcome).clone();
    let segments: Vec<_> = program
        .segments()
        .map(|segment| segment.line().map(|line| (line.from.tip, line.to)))
        .collect();
    let number = program
        .ops
        .iter()
        .position(|op| matches!(op.action, Action::Follow { .. }))
        .unwrap();
    let (from, to) = segments[number].unwrap();
    let matrix = program.orientation(to.orientation).unwrap().matrix();
    let middle: [f64; 3] = core::array::from_fn(|i| {
        f64::midpoint(from.to_array()[i], to.tip.to_array()[i]) + 0.2 * matrix[i][2]
    });
    program.vias.push(middle.into());
    let Action::Follow { via, .. } = &mut program.ops[number].action else {
        panic!("it is a piece of a chain")
    };
    *via = Some(ViaId(1.try_into().unwrap()));
    let (_, finding) = findings(plan, &program).strays.unwrap();
    let CutFault::Strays { by, .. } = finding.fault else {
        panic!("{finding:?}")
    };
    assert!((0.05..0.3).contains(&by.to_mm()), "{by:?}");
}

/// Parts that fall along y by no more than spines may.
fn parts() -> impl Strategy<Value = Part> {
    let across = prop_oneof![150.0..1000.0_f64, -1000.0..-400.0_f64];
    let along = prop_oneof![700.0..4000.0_f64, -4000.0..-700.0_f64];
    let twist = prop_oneof![Just(NONE), 1500.0..5000.0_f64, -5000.0..-1500.0_f64];
    (across, along, -0.1..0.1_f64, twist).prop_map(|(across, along, slope, twist)| Part {
        across,
        along,
        slope,
        twist,
        ..Part::LEVEL
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(6))]

    #[test]
    fn programs_along_spines_do_what_they_are_said_to_do(
        part in parts(), swing in 30.0..50.0_f64, layer in 5.0..8.0_f64, step in 6.0..10.0_f64,
        residual in prop_oneof![Just("mixed"), Just("lift")], single: bool,
    ) {
        let outcome = outcome_of(part, single, &laid_out([swing, layer, step], residual, "spine"));
        if !is_refused(&outcome) && outcome.job.as_ref().unwrap().part.spine().is_some() {
            is_right(&outcome, &|x, y| part.height(x, y));
        }
    }
}

#[test]
fn changed_programs_are_found() {
    let part = Part {
        across: 200.0,
        along: 1200.0,
        slope: 0.0,
        ..Part::LEVEL
    };
    let outcome = compiled(&part.surface(), &format!("{GIVEN}\n  follow = spine"));
    let plan = outcome.plan.as_ref().unwrap();
    let program = program_of(&outcome).clone();
    assert_eq!(findings(plan, &program), Findings::default());
    // One knot 0.004 mm lower: as much as chains may bend.
    let mut one_knot = program.clone();
    let knots = one_knot.ops.iter_mut().filter(|op| of_cut(op, 2, 5));
    let mut knots = knots.filter_map(|op| match &mut op.action {
        Action::Follow { to, .. } => Some(to),
        _ => None,
    });
    knots.nth(3).unwrap().z -= 0.004;
    let (count, finding) = findings(plan, &one_knot).strays.unwrap();
    assert_eq!((count, finding.layer.get(), finding.cut.get()), (1, 2, 5));
    let CutFault::Strays { by, .. } = finding.fault else {
        panic!("{finding:?}")
    };
    assert!((by.to_mm() - 0.004).abs() < 1e-3, "{by:?}");
    // All of one cut lower, its ways too.
    let lowered = |by: f64| {
        let mut lower = program.clone();
        for op in lower.ops.iter_mut().filter(|op| of_cut(op, 2, 5)) {
            match &mut op.action {
                Action::Follow { to, .. } | Action::Travel { to, .. } | Action::Approach { to, .. } => {
                    to.z -= by
                }
                _ => {}
            }
        }
        findings(plan, &lower)
    };
    assert!(lowered(6.0).overcut.is_some() || lowered(6.0).not_freed.is_some());
    // The second flank of a V is left out.
    let mut half = program.clone();
    let is_piece = |op: &Op| matches!(op.action, Action::Follow { .. }) && of_cut(op, 1, 3);
    let first = half.ops.iter().position(is_piece).unwrap();
    let ends = half.ops[first..]
        .iter()
        .position(|op| {
            matches!(
                op.action,
                Action::Follow {
                    joint: Joint::Stop,
                    ..
                }
            )
        })
        .unwrap();
    let mut passed = false;
    let mut number = 0;
    half.ops.retain(|op| {
        let keep = !(passed && is_piece(op));
        passed |= number == first + ends;
        number += 1;
        keep
    });
    let broken = verify(half);
    // The way back does not fit any more, or the V has one flank.
    if let Ok(program) = broken {
        let (_, finding) = replay(plan, &program).findings.not_freed.unwrap();
        assert!(matches!(finding.fault, CutFault::NotFreed { needed, .. } if !needed.is_finite()));
    }
}

#[test]
fn what_cannot_be_followed_is_refused() {
    let codes = |text: String| codes(&compile("job.vcut", &Files::default().with("job.vcut", text)));
    let follow = |word: &str| rough(&format!("{GIVEN}\n  follow = {word}"));
    let profile = "profile { start (0 mm, 30 mm), line to (100 mm, 20 mm) }\n";
    let dome = "surface { z(x, y) = 38 mm - (y - 75 mm)^2 / 1200 mm }\n";
    assert_eq!(
        codes(format!("{REST}{profile}{}", follow("spine"))),
        [Code::CannotFollow]
    );
    assert_eq!(codes(format!("{REST}{profile}{}", follow("auto"))), []);
    let narrower = rough(&format!("{GIVEN}\n  follow = spine\n  avoid = swing"));
    assert_eq!(codes(format!("{REST}{dome}{narrower}")), [Code::CannotFollow]);
    let narrow = follow("spine").replace("swing = 40 deg", "swing = 4 deg");
    assert_eq!(codes(format!("{REST}{dome}{narrow}")), [Code::CannotFollow]);
    let two = format!("{REST}{dome}{}{}", follow("spine"), follow("straight"));
    assert_eq!(codes(two), [Code::CannotFollow]);
}
