//! Strips of `rough rect` that are left out, because the body of the straight blade has no room beside their slits.

use crate::pipeline::Files;
use crate::rect::{codes, job, machines, planned};
use crate::repository::root;
use vcutc::diagnostics::Code;
use vcutc::driver::{self, Outcome, Request, SearchEffort, Typed};
use vcutc::registry;

/// A floor at 20 mm beside a plateau of some height, with a straight blade whose body begins 40 mm above the tip.
fn beside_a_plateau(height: f64, more: &str) -> String {
    let text = job(
        &format!(
            "start (0 mm, 20 mm) line to (69 mm, 20 mm) line to (70 mm, {height} mm) line to (100 mm, {height} mm)"
        ),
        &format!("layer = 10 mm, step = 10 mm, residual = discard, through = 1{more}"),
    );
    text.replace("60 mm, 50 mm) }", "60 mm, 80 mm) }")
        .replace("edges = double }", "edges = double, body (40 mm, 8 mm) }")
        .replace("cutting_length = 13 mm", "cutting_length = 40 mm")
        .replace("(60 mm, 25 mm)", "(60 mm, 12 mm)")
        .replace(&machines(), "")
}

/// The body of radius 8 mm comes down to 40 sin(60 deg) - 8 cos(60 deg) = 30.641 mm above the tip. So of slits at 70, 60, .., 20 mm
/// beside a plateau those stay uncut whose tips lie farther than that below it, and the proof, which looks at the body on its own, finds
/// nothing.
#[test]
fn strips_whose_slits_take_the_body_into_a_wall_are_left_out() {
    for (height, left_out) in [(50.0, 0), (55.0, 1), (69.0, 2), (75.0, 3)] {
        let outcome = proven(beside_a_plateau(height, ""));
        // A warning says so where much stays for that reason.
        let warned = codes(&outcome);
        assert!(
            warned.is_empty() || (left_out > 0 && warned == [Code::MuchStays]),
            "{height}: {warned:?}"
        );
        let plan = &planned(&outcome).plan;
        assert_eq!(plan.room.left_out(), left_out, "{height}");
        let without = proven(beside_a_plateau(height, "").replace(", body (40 mm, 8 mm) }", " }"));
        let all = &planned(&without).plan;
        assert_eq!(all.room.left_out(), 0);
        assert_eq!(plan.strips().count() + left_out, all.strips().count(), "{height}");
        // What is left out stands, so limits count it, and the message says why.
        let limited = proven(beside_a_plateau(height, ", limits { scallop <= 11 mm }"));
        if left_out == 0 {
            assert_eq!(codes(&limited), [], "{height}");
        } else {
            assert_eq!(codes(&limited), [Code::ScallopOverLimit], "{height}");
            let notes = &limited.diagnostics[0].notes;
            assert!(
                notes.iter().any(|note| note.contains("the body of `dagger`")),
                "{height}: {notes:?}"
            );
        }
    }
}

fn proven(text: String) -> Outcome {
    let files = Files::of(root().join("examples")).with("strips.vcut", text);
    let request = Request {
        path: "strips.vcut",
        loader: &files,
        overrides: &[],
        machine: None,
        options: Typed::default(),
        effort: SearchEffort::Normal,
        operations: registry::OPERATIONS,
        targets: &registry::backends(),
    };
    driver::compile(request, &mut |_| {}).unwrap()
}
