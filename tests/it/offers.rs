//! Values that are offered are near the largest or least that works: found again by compiling what lies beside them.

use crate::help::patiently;
use crate::pipeline::{Files, compile, numbers, rendered};
use vcutc::cancellation::Wanted;
use vcutc::diagnostics::Diagnostic;
use vcutc::driver::Outcome;

const JOB: &str = "job.vcut";

/// A part with a steep end: the formulas' scallop bound is far above what its plans leave.
const STEEP: &str = r#"job "steep"
stock { size = (200 mm, 300 mm, 45 mm) }
profile { start (0 mm, 18 mm) bezier (60 mm, 40 mm) (120 mm, 44 mm) to (200 mm, 14 mm) }
blade knife { cutting_length = 30 mm half_apex = 8 deg thickness = 1.5 mm edges = double }
rough vcut {
  blade = knife
  rake = 60 deg
  swing = 35 deg
  limits { scallop <= 6 mm }
  feed { cut = 200 mm/s, travel = 300 mm/s, reorient = 60 deg/s }
  clearance = 20 mm
}
"#;

fn with(from: &str, to: &str) -> String {
    assert!(STEEP.contains(from), "nothing reads {from}");
    STEEP.replace(from, to)
}

fn compiled(text: &str) -> Outcome {
    compile(JOB, &Files::default().with(JOB, text.to_owned()))
}

fn only(outcome: &Outcome, code: &str) -> Diagnostic {
    assert_eq!(
        numbers(&outcome.diagnostics),
        [code],
        "{}",
        rendered(&outcome.diagnostics, outcome)
    );
    outcome.diagnostics[0].clone()
}

/// The number that a fix puts into the place of another, and the fix's title.
fn offered(diagnostic: &Diagnostic, about: &str) -> f64 {
    let fix = diagnostic.fixes.iter().find(|fix| fix.title.contains(about));
    let fix = fix.unwrap_or_else(|| panic!("no offer says {about}: {:#?}", diagnostic.fixes));
    let number = fix.edits[0].replacement.split(' ').next().unwrap();
    number.parse().unwrap()
}

fn works(text: &str) -> bool {
    compiled(text).compiled.is_some()
}

#[test]
fn the_layer_offered_is_about_the_largest_that_works() {
    for edge in [30, 12] {
        let deep = |layer: f64| {
            with("swing = 35 deg", &format!("swing = 35 deg layer = {layer} mm"))
                .replace("cutting_length = 30 mm", &format!("cutting_length = {edge} mm"))
        };
        let outcome = compiled(&deep(25.0));
        let refused = only(&outcome, "VC0401");
        let layer = offered(&refused, "`layer`");
        assert!(works(&deep(layer)), "{layer} mm with an edge of {edge} mm");
        assert!(
            !works(&deep(layer * 1.02)),
            "{layer} mm with an edge of {edge} mm"
        );
        assert!(
            !refused.fixes[0].title.contains("at most"),
            "{}",
            refused.fixes[0].title
        );
    }
}

#[test]
fn values_near_the_stated_one_are_offered_where_limits_conflict() {
    let limited = |layer: f64| {
        with(
            "scallop <= 6 mm",
            &format!("scallop <= 6 mm, layer >= {layer} mm"),
        )
    };
    let layer = offered(&only(&compiled(&limited(20.0)), "VC0306"), "layer >=");
    assert!(layer > 19.0, "{layer} mm");
    assert!(works(&limited(layer)));

    let stepped = |step: f64| with("swing = 35 deg", &format!("swing = 35 deg step = {step} mm"));
    let step = offered(&only(&compiled(&stepped(12.0)), "VC0306"), "step =");
    assert!((step - 12.0).abs() < 1.5, "{step} mm");
    assert!(works(&stepped(step)));
}

/// A limit on cuts that the plan without it keeps changes nothing; one less is refused with that number.
#[test]
fn a_limit_on_cuts_that_the_best_plan_keeps_is_kept() {
    let cuts = |outcome: &Outcome| outcome.compiled.as_ref().map(|compiled| compiled.report.cuts());
    let best = cuts(&compiled(STEEP)).unwrap();
    let limited = |cuts: usize| with("scallop <= 6 mm", &format!("scallop <= 6 mm, cuts <= {cuts}"));
    assert_eq!(cuts(&compiled(&limited(best))), Some(best));
    let outcome = compiled(&limited(best - 1));
    let refused = only(&outcome, "VC0306");
    assert!(
        refused.message.contains(&format!("{best} cuts")),
        "{}",
        refused.message
    );
    assert!((offered(&refused, "cuts <=") - best as f64).abs() < 0.5);
}

/// Too many cuts are put down to what the job states that is small, and to nothing that it does not state.
#[test]
fn too_many_cuts_are_put_down_to_what_is_small() {
    for (from, to, name) in [
        ("swing = 35 deg", "swing = 35 deg step = 10 um", "step"),
        ("scallop <= 6 mm", "scallop <= 6 mm, edge <= 0.01 mm", "edge"),
        ("scallop <= 6 mm", "scallop <= 6 mm, layer <= 0.02 mm", "layer"),
    ] {
        let outcome = compiled(&with(from, to));
        let refused = only(&outcome, "VC0303");
        let said = rendered(&outcome.diagnostics, &outcome);
        assert!(
            refused.fixes.iter().any(|fix| fix.title.contains(name)),
            "{name}: {said}"
        );
        let is_of_scallop = |text: &String| text.contains("scallop");
        assert!(!refused.help.iter().any(is_of_scallop), "{said}");
    }
}

/// What works alone is offered alone; only where it does not, several values are left to the compiler at once.
#[test]
fn values_are_left_to_the_compiler_one_by_one_first() {
    let text = with("swing = 35 deg", "swing = 35 deg layer = 100 mm");
    let outcome = compiled(&text);
    let refused = only(&outcome, "VC0403");
    let said = rendered(&outcome.diagnostics, &outcome);
    assert!(
        refused
            .fixes
            .iter()
            .any(|fix| fix.title == "let the compiler choose: `layer = auto`"),
        "{said}"
    );
}

/// A swing that is open is not said to be too wide.
#[test]
fn advice_names_only_what_the_job_states() {
    let text = with("swing = 35 deg", "layer = 0.1 mm");
    let (_, at_once, _) = patiently(&text, Wanted::never());
    assert_eq!(numbers(&at_once), ["VC0403"]);
    let help = at_once[0].help.join("; ");
    assert!(help.contains("`layer`") && !help.contains("swing"), "{help}");
}
