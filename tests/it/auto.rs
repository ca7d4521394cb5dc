//! What `auto` chooses, compared with choices made by hand.

use crate::pipeline::{Files, compile};

/// A job of an arched part whose best lattice an earlier search missed: its even and odd rows end at different places.
fn arched(lattice: &str, layer: &str, step: &str) -> String {
    format!(
        r#"job "arched"
stock {{ size = (157 mm, 356 mm, 66 mm) }}
profile {{ start (0 mm, 25.8 mm) bezier (47.1 mm, 36.2 mm) (109.9 mm, 32 mm) to (157 mm, 30 mm) }}
blade k {{ cutting_length = 34 mm, half_apex = 7 deg, thickness = 1.5 mm, edges = double }}
rough vcut {{
  blade = k
  rake = 50 deg
  lattice = {lattice}
  layer = {layer}
  step = {step}
  limits {{ swing <= 32 deg, scallop <= 9 mm }}
  allowance = 0.5 mm
  feed {{ cut = 200 mm/s, travel = 200 mm/s, reorient = 90 deg/s }}
  clearance = 10 mm
}}
"#
    )
}

#[test]
fn what_auto_chooses_is_no_slower_than_a_lattice_chosen_by_hand() {
    let seconds = |lattice, layer, step| {
        let text = arched(lattice, layer, step);
        let outcome = compile("arched.vcut", &Files::default().with("arched.vcut", text));
        let compiled = outcome.compiled.unwrap();
        assert!(compiled.report.scallop.height.to_mm() <= 9.0);
        compiled.report.times.all.total().to_s()
    };
    let by_hand = seconds("interlaced", "18.196 mm", "8.5 mm");
    let chosen = seconds("auto", "auto", "auto");
    assert!(chosen <= by_hand, "{chosen} s, by hand {by_hand} s");
}
