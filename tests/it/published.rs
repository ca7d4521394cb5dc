//! The numbers of the papers, from the whole compiler and from the simulated surface.
//!
//! The counts of cuts were confirmed by an independent simulation of polygons. It laid columns from the stock's side
//! inwards; the compiler centres them, so that cuts at the sides need no more edge than others, which takes one column
//! more on orthogonal lattices here.

use crate::pipeline::{Files, compile, rendered};
use vcutc::driver::Outcome;
use vcutc::geometry::curve::Point2;
use vcutc::simulation::surface::{Surface, Vee};
use vcutc::vcut::plan::PlannedVcut;

/// Rake less half the apex angle of the blade of Cui et al.: what the leading edge makes with the feed.
pub(crate) const LEAD_DEG: f64 = 60.0 - 7.13;

/// The block down to a plane.
const PLANE: &str = "start (0 mm, 13.1 mm) line to (85 mm, 13.1 mm)";

/// The block with 3137 mm2 to remove.
pub(crate) const ARC: &str = "start (0 mm, 6 mm) arc to (85 mm, 6 mm) through (42.5 mm, 16.514 mm)";

/// The parameters of a lattice: swing in degrees, layer and step in mm, and the edge length of the blade.
struct Parameters {
    lattice: &'static str,
    swing: f64,
    layer: f64,
    step: f64,
    edge: f64,
}

/// The optimum of the paper. Its layer is rounded up: 10.003 mm of edge are in use.
const PAPER: Parameters = Parameters {
    lattice: "orthogonal",
    swing: 34.16,
    layer: 4.4,
    step: 5.97,
    edge: 10.004,
};

/// The optimum with the exact reach of overlapping cuts.
const EXACT: Parameters = Parameters {
    lattice: "orthogonal",
    swing: 35.75,
    layer: 6.47,
    step: 4.658,
    edge: 10.0,
};

/// The optimum on the interlaced lattice; the step is never below `2 h tan(swing)` after rounding.
const INTERLACED: Parameters = Parameters {
    lattice: "interlaced",
    swing: 50.0,
    layer: 4.997,
    step: 11.912,
    edge: 10.0,
};

/// The block of Cui et al. with the blade and the speeds of its table 1. Cuts run out as far as the edge needs [Cui 5] and
/// no further, as in the paper's estimate.
fn block(profile: &str, parameters: &Parameters) -> Outcome {
    let Parameters {
        lattice,
        swing,
        layer,
        step,
        edge,
    } = parameters;
    let extension = edge * LEAD_DEG.to_radians().cos() + 0.001;
    let text = format!(
        "job \"block\"
        stock {{ size = (85 mm, 50 mm, 50 mm) }}
        profile {{ {profile} }}
        blade dagger {{ cutting_length = {edge} mm, half_apex = 7.13 deg, thickness = 0 mm, edges = double }}
        rough vcut {{
            blade = dagger, lattice = {lattice}, rake = 60 deg, residual = discard
            swing = {swing} deg, layer = {layer} mm, step = {step} mm, extension = {extension} mm
            feed {{ cut = 200 mm/s, travel = 200 mm/s, reorient = 90 deg/s }}
            clearance = 10 mm
        }}"
    );
    let outcome = compile("block.vcut", &Files::default().with("block.vcut", text));
    assert_eq!(rendered(&outcome.diagnostics, &outcome), "");
    outcome
}

fn planned(outcome: &Outcome) -> &PlannedVcut {
    PlannedVcut::of(&*outcome.plan.as_ref().unwrap().operations[0]).unwrap()
}

/// Layers, cuts, area removed in mm2 and the longest edge in use in mm.
fn outcome_of(parameters: &Parameters) -> (usize, usize, f64, f64) {
    let outcome = block(PLANE, parameters);
    let report = &outcome.compiled.as_ref().unwrap().report;
    let edge = report.longest_edge.to_mm();
    (report.layers.len(), report.cuts(), report.removed.to_mm2(), edge)
}

#[test]
fn the_papers_optimum_frees_every_chip_of_the_block() {
    let (layers, cuts, removed, edge) = outcome_of(&PAPER);
    assert_eq!(
        (layers, cuts),
        (8, 8 * 15),
        "14 columns from the side inwards: 112"
    );
    assert!((removed - 2799.0).abs() < 15.0, "{removed}");
    // [Cui 4]: 3h/2 of vertical reach.
    let reach = 1.5 * 4.4 / 34.16_f64.to_radians().cos() / LEAD_DEG.to_radians().sin();
    assert!((edge - reach).abs() < 2e-3, "{edge} {reach}");
}

#[test]
fn overlapping_cuts_may_be_deeper_than_the_paper_lets_them() {
    let (layers, cuts, removed, _) = outcome_of(&EXACT);
    assert_eq!(
        (layers, cuts),
        (5, 5 * 19),
        "18 columns from the side inwards: 90"
    );
    assert!((removed - 2609.0).abs() < 15.0, "{removed}");
}

#[test]
fn interlaced_cuts_take_half_the_paper() {
    let (layers, cuts, removed, edge) = outcome_of(&INTERLACED);
    assert_eq!((layers, cuts), (7, 53));
    assert!((removed - 2764.0).abs() < 15.0, "{removed}");
    assert!(edge <= 10.0, "{edge}");
    let (layers, cuts, removed, _) = outcome_of(&Parameters {
        lattice: "interlaced",
        swing: 40.0,
        layer: 6.0,
        step: 10.07,
        edge: 10.0,
    });
    assert_eq!((layers, cuts), (6, 51));
    assert!((removed - 2780.0).abs() < 15.0, "{removed}");
}

#[test]
fn estimates_are_those_of_the_exact_reach() {
    for (parameters, seconds) in [(EXACT, 261.6), (INTERLACED, 169.6)] {
        let estimate = planned(&block(ARC, &parameters)).estimate.to_s();
        assert!(
            (estimate - seconds).abs() < 0.1,
            "{estimate} instead of {seconds}"
        );
    }
}

/// The area under a surface.
fn area(surface: &Surface) -> f64 {
    let corners: Vec<Point2> = surface.corners().collect();
    let strips = corners
        .windows(2)
        .map(|pair| (pair[1].x - pair[0].x) * (pair[0].z + pair[1].z) / 2.0);
    strips.sum()
}

/// The chip of a cut in the middle of a layer with both neighbours on one side done, far from the sides and the top.
fn measured_chip(swing: f64, layer: f64, shift: f64) -> f64 {
    let slope = 1.0 / swing.tan();
    let step = 2.0 * layer / slope;
    let mut surface = Surface::flat(30.0 * step, 10.0 * layer);
    let mut chip = 0.0;
    for number in 1..=6_u32 {
        let offset = if number % 2 == 0 { shift * step } else { 0.0 };
        for column in 0..30_u32 {
            let tip = Point2 {
                x: (f64::from(column) + 0.25) * step + offset,
                z: layer * (10.0 - f64::from(number)),
            };
            let before = area(&surface);
            surface.release(Vee::even(tip, slope));
            if (number, column) == (6, 15) {
                chip = before - area(&surface);
            }
        }
    }
    chip
}

#[test]
fn chips_are_as_large_as_the_formulas_say() {
    for (edge, swing_deg) in [(10.0, 45.0_f64), (10.0, 34.16), (32.0, 20.0), (6.0, 60.0)] {
        let swing = swing_deg.to_radians();
        let d = edge * LEAD_DEG.to_radians().sin();
        // Orthogonal: h = 2/3 d cos(alpha) [Cui 4], chip 4/9 d^2 sin(2 alpha) [Cui 1, 3].
        let orthogonal = measured_chip(swing, 2.0 / 3.0 * d * swing.cos(), 0.0);
        let expected = 4.0 / 9.0 * d * d * (2.0 * swing).sin();
        assert!(
            (orthogonal / expected - 1.0).abs() < 1e-6,
            "{orthogonal} {expected}"
        );
        // Interlaced: h = d cos(alpha), chip d^2 sin(2 alpha).
        let interlaced = measured_chip(swing, d * swing.cos(), 0.5);
        let expected = d * d * (2.0 * swing).sin();
        assert!(
            (interlaced / expected - 1.0).abs() < 1e-6,
            "{interlaced} {expected}"
        );
    }
}

#[test]
fn lattices_need_the_edge_that_the_reference_says() {
    // Without overlap: 3h/2, h and 2h of vertical reach; the free lattice only where tips of two layers miss each other.
    let used = |lattice, layer: f64, profile| {
        let swing = 45.0_f64;
        let parameters = Parameters {
            lattice,
            swing,
            layer,
            step: 2.0 * layer,
            edge: 20.0,
        };
        let report = block(profile, &parameters).compiled.unwrap().report;
        let vertical = report.longest_edge.to_mm() * swing.to_radians().cos() * LEAD_DEG.to_radians().sin();
        vertical / layer
    };
    assert!((used("orthogonal", 4.0, PLANE) - 1.5).abs() < 1e-3);
    assert!((used("interlaced", 4.0, PLANE) - 1.0).abs() < 1e-3);
    let free = used(
        "free",
        4.0,
        "start (0 mm, 45 mm) line to (42.5 mm, 10 mm) line to (85 mm, 45 mm)",
    );
    assert!((1.5..=2.0).contains(&free), "{free}");
}

/// The block with everything open within the limits of table 1, and what else is said.
fn open_block(more: &str) -> Outcome {
    let text = format!(
        "job \"block\"
        stock {{ size = (85 mm, 50 mm, 50 mm) }}
        profile {{ {ARC} }}
        blade dagger {{ cutting_length = 10 mm, half_apex = 7.13 deg, thickness = 0 mm, edges = double }}
        rough vcut {{
            blade = dagger, rake = 60 deg, limits {{ swing <= 50 deg, scallop <= 10 mm }}, {more}
            feed {{ cut = 200 mm/s, travel = 200 mm/s, reorient = 90 deg/s }}
            clearance = 10 mm
        }}"
    );
    let outcome = compile("block.vcut", &Files::default().with("block.vcut", text));
    assert_eq!(rendered(&outcome.diagnostics, &outcome), "");
    outcome
}

#[test]
fn what_is_left_open_comes_out_as_the_optimum_of_the_paper() {
    let outcome = open_block("model = paper");
    let chosen = &planned(&outcome).parameters;
    // Table 1, to the digits that the formulas give: 34.155 deg, 4.398 mm, 5.968 mm.
    assert!((chosen.swing.to_deg() - 34.155).abs() < 2e-3, "{chosen:?}");
    assert!((chosen.layer.to_mm() - 4.398).abs() < 2e-3, "{chosen:?}");
    assert!((chosen.step.to_mm() - 5.968).abs() < 2e-3, "{chosen:?}");
}

#[test]
fn the_exact_formulas_and_the_free_choice_of_the_lattice_are_faster() {
    let seconds = |more: &str| planned(&open_block(more)).estimate.to_s();
    let (paper, orthogonal, best) = (
        seconds("model = paper"),
        seconds("lattice = orthogonal"),
        seconds("lattice = auto"),
    );
    assert!(orthogonal < paper, "{orthogonal} {paper}");
    assert!(best < orthogonal, "{best} {orthogonal}");
}

/// [Yu 5]: over a flat part a discarded layer leaves a saw-tooth and what is left of its own height: 16.70 mm.
#[test]
fn a_discarded_layer_leaves_what_the_paper_says() {
    let text = "job \"block\"
        stock { size = (60 mm, 1000 mm, 70 mm) }
        profile { start (0 mm, 10 mm) line to (60 mm, 10 mm) }
        blade dagger { cutting_length = 12.543 mm, half_apex = 7.13 deg, thickness = 0 mm, edges = double }
        rough vcut {
            blade = dagger, rake = 60 deg, swing = 30 deg, residual = discard, limits { scallop <= 20 mm }
            feed { cut = 10 m/min, travel = 6000 m/min, reorient = 10000 deg/s }
            clearance = 10 mm, run_out = 0 mm
        }";
    let outcome = compile(
        "block.vcut",
        &Files::default().with("block.vcut", text.to_owned()),
    );
    assert_eq!(rendered(&outcome.diagnostics, &outcome), "");
    let left = outcome.compiled.as_ref().unwrap().report.scallop.height.to_mm();
    assert!((left - 16.70).abs() < 5e-3, "{left}");
}
