//! Fitted tips: faster than rows and columns, within the distances that the job gives, and clear of the body of the blade.

use crate::pipeline::{Files, compile, rendered};
use vcutc::driver::Outcome;
use vcutc::geometry::curve::Point2;
use vcutc::vcut::asked::Lattice;
use vcutc::vcut::plan::{PARAMETERS, PlannedVcut};

const WAVE: &str = "
    stock { size = (220 mm, 180 mm, 70 mm) }
    profile { z(x) = 24 mm + 9 mm * cos(360 deg * x / 180 mm) }
    blade dagger { cutting_length = 22 mm, half_apex = 8 deg, thickness = 0.5 mm, edges = double }
";

/// More stands above fitted tips than between rows and columns: the body meets it.
const WIDE_BODY: &str = "
    stock { size = (251 mm, 102 mm, 55 mm) }
    profile { start (0 mm, 20 mm) line to (73 mm, 19 mm) line to (184 mm, 27 mm) line to (251 mm, 25 mm) }
    blade dagger {
        cutting_length = 36 mm, half_apex = 10.5 deg, thickness = 1 mm, edges = double
        body (39 mm, 4 mm) (66 mm, 12 mm)
    }
";

const LIMITS: &str = "limits { scallop <= 3 mm, swing <= 45 deg }";

fn outcome(work: &str, more: &str) -> Outcome {
    let text = format!(
        "job \"part\" {work}
        rough vcut {{
            blade = dagger, rake = 60 deg, {more}
            feed {{ cut = 150 mm/s, travel = 200 mm/s, reorient = 90 deg/s }}
            clearance = 10 mm
        }}"
    );
    compile("part.vcut", &Files::default().with("part.vcut", text))
}

fn compiled(work: &str, more: &str) -> Outcome {
    let outcome = outcome(work, more);
    let messages = rendered(&outcome.diagnostics, &outcome);
    assert!(outcome.compiled.is_some(), "{more}: {messages}");
    outcome
}

fn planned(outcome: &Outcome) -> &PlannedVcut {
    PlannedVcut::of(&*outcome.plan.as_ref().unwrap().operations[0]).unwrap()
}

fn time(outcome: &Outcome) -> f64 {
    outcome.compiled.as_ref().unwrap().report.times.all.total().to_s()
}

#[test]
fn programs_are_faster_by_a_tenth_than_on_any_lattice_of_rows_and_columns() {
    let open = compiled(WAVE, LIMITS);
    assert_eq!(planned(&open).parameters.lattice, Lattice::Fitted);
    let left = open.compiled.as_ref().unwrap().report.scallop.height.to_mm();
    assert!(left <= 3.0 + 1e-3, "{left} mm");
    for lattice in ["orthogonal", "interlaced"] {
        let other = compiled(WAVE, &format!("lattice = {lattice}, {LIMITS}"));
        let [fitted, other] = [&open, &other].map(time);
        assert!(fitted < 0.9 * other, "{fitted} s, {lattice} {other} s");
    }
}

/// 55 Vs laid out for less than the limit do what 56 do that use it up.
#[test]
fn tips_are_laid_out_for_less_than_the_limit_where_that_is_faster() {
    let work = "
        stock { size = (270 mm, 494 mm, 41 mm) }
        profile { z(x) = 22 mm - 5 mm * cos(360 deg * x / 270 mm) }
        blade dagger { cutting_length = 17 mm, half_apex = 9.6 deg, thickness = 0 mm, edges = double }
    ";
    let open = compiled(work, "limits { scallop <= 3.5 mm }");
    let left = open.compiled.as_ref().unwrap().report.scallop.height.to_mm();
    assert!(left < 0.985 * 3.5, "{left} mm");
    // What was compared is what is cut.
    let vcut = planned(&open);
    let by_simulation = vcut
        .decisions
        .iter()
        .find(|decision| decision.field == PARAMETERS)
        .unwrap();
    let lattice = vcut
        .decisions
        .iter()
        .find(|decision| decision.field == "lattice")
        .unwrap();
    assert_eq!(by_simulation.taken.standing, lattice.taken.standing);
}

/// The tips whose Vs are seen in the end, from left to right.
fn last_tips(vcut: &PlannedVcut) -> Vec<Point2> {
    let slope = vcut.parameters.flanks.slope;
    let tips: Vec<Point2> = vcut.cuts.iter().map(|cut| cut.tip).collect();
    let is_seen = |tip: &Point2| {
        let mut others = tips.iter().filter(|other| *other != tip);
        others.all(|other| tip.z < other.z + slope * (tip.x - other.x).abs())
    };
    let mut seen: Vec<Point2> = tips.iter().copied().filter(is_seen).collect();
    seen.sort_by(|one, other| one.x.total_cmp(&other.x));
    seen
}

#[test]
fn steps_that_are_given_or_limited_are_kept() {
    for more in [
        "step = 5 mm, limits { scallop <= 3 mm, swing <= 45 deg }",
        "limits { scallop <= 3 mm, swing <= 45 deg, step <= 5 mm }",
        "swing = 40 deg, layer = 8 mm, overlap = 70 %, limits { scallop <= 3 mm }",
    ] {
        let outcome = compiled(WAVE, &format!("lattice = fitted, redundant = keep, {more}"));
        let seen = last_tips(planned(&outcome));
        let steps = seen.windows(2).map(|pair| pair[1].x - pair[0].x);
        let widest = steps.fold(0.0, f64::max);
        assert!(seen.len() > 40 && widest < 5.0 + 1e-6, "{more}: {widest} mm");
    }
}

#[test]
fn plans_whose_body_would_meet_the_work_are_not_taken() {
    let limits = "limits { scallop <= 6 mm, swing <= 45 deg }";
    let open = compiled(WIDE_BODY, limits);
    assert_ne!(planned(&open).parameters.lattice, Lattice::Fitted);
    let fitted = outcome(
        WIDE_BODY,
        &format!("lattice = fitted, swing = 45 deg, layer = 14 mm, {limits}"),
    );
    assert!(fitted.compiled.is_none());
}

/// What the flanks cannot follow is said by the proof, which knows the place.
#[test]
fn a_wall_steeper_than_the_flanks_keeps_more_than_the_limit() {
    let wall = "
        stock { size = (290 mm, 100 mm, 60 mm) }
        profile { start (0 mm, 8 mm) line to (140 mm, 8 mm) line to (141 mm, 30 mm) line to (290 mm, 30 mm) }
        blade dagger { cutting_length = 30 mm, half_apex = 8 deg, thickness = 0.5 mm, edges = double }
    ";
    let outcome = outcome(
        wall,
        "lattice = fitted, swing = 45 deg, limits { scallop <= 3 mm }",
    );
    let messages = rendered(&outcome.diagnostics, &outcome);
    assert!(messages.contains("error[VC0403]"), "{messages}");
}
