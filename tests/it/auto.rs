//! What `auto` chooses, compared with choices made by hand.

use crate::pipeline::{Files, compile};
use vcutc::driver::Compiled;
use vcutc::job::Order;
use vcutc::vcut::PlannedVcut;

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

/// A job whose arm follows its widest swings only V by V, which turns the blade in the work, and somewhat narrower ones layer by
/// layer.
fn leaning(order: &str) -> String {
    format!(
        r#"job "leaning"
stock {{ size = (200 mm, 300 mm, 45 mm) }}
profile {{ start (0 mm, 18 mm) bezier (60 mm, 40 mm) (120 mm, 44 mm) to (200 mm, 14 mm) }}
blade k {{ cutting_length = 30 mm, half_apex = 8 deg, thickness = 1.5 mm, edges = double }}
rough vcut {{
  blade = k
  rake = 60 deg
  order = {order}
  limits {{ scallop <= 6 mm }}
  feed {{ cut = 200 mm/s, travel = 300 mm/s, reorient = 60 deg/s }}
  clearance = 20 mm
}}
machine cell = robot "kuka/kr210_r3100_ultra" {{
  tool = frame(x = 0 mm, y = 0 mm, z = 310 mm, a = 0 deg, b = 0 deg, c = 0 deg)
  base = frame(x = 1700 mm, y = -700 mm, z = 850 mm, a = 90 deg, b = 0 deg, c = 0 deg)
  home = joints(0 deg, -90 deg, 90 deg, 0 deg, 45 deg, 0 deg)
}}
"#
    )
}

#[test]
fn a_narrower_swing_is_taken_where_it_costs_less_than_a_slower_route() {
    let compiled = |order| {
        let outcome = compile(
            "leaning.vcut",
            &Files::default().with("leaning.vcut", leaning(order)),
        );
        let vcut = PlannedVcut::of(&*outcome.plan.unwrap().operations[0])
            .unwrap()
            .clone();
        (vcut, outcome.compiled.unwrap())
    };
    let (by_point, slower) = compiled("point");
    let (chosen, faster) = compiled("auto");
    assert_eq!((by_point.order, chosen.order), (Order::Point, Order::Layer));
    assert!(chosen.parameters.swing < by_point.parameters.swing);
    let seconds = |compiled: &Compiled| compiled.report.times.all.total().to_s();
    let (slower, with_narrower) = (seconds(&slower), seconds(&faster));
    assert!(
        with_narrower < 0.95 * slower,
        "{with_narrower} s, by point {slower} s"
    );
    // What the machine did not follow is what hints after the success start from.
    assert!(faster.not_followed.is_some());
}
