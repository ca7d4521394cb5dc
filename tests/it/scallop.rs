//! Simulated scallops of whole jobs against the bound of their lattice (`docs/process.md`, "Scallop").

use crate::pipeline::{Files, compile};
use proptest::prelude::*;
use vcutc::driver::Outcome;
use vcutc::vcut::asked::Lattice;
use vcutc::vcut::plan::parameters::VcutParameters;
use vcutc::vcut::plan::{PlannedVcut, blade_reach};

const WIDTH: f64 = 120.0;
const LATTICES: [&str; 3] = ["orthogonal", "interlaced", "free"];

/// A random job: the shape of its lattice, and a profile by its heights and how steep it may be against the flanks.
#[derive(Clone, Debug)]
struct Random {
    lattice: &'static str,
    residual: &'static str,
    swing: f64,
    layer: f64,
    overlap: f64,
    thickness: f64,
    allowance: f64,
    start: f64,
    /// Lengths in mm and slopes, as shares of the flanks' slope.
    pieces: Vec<(f64, f64)>,
}

fn a_job() -> impl Strategy<Value = Random> {
    let lattice = (
        prop::sample::select(LATTICES.to_vec()),
        prop::sample::select(vec!["discard", "lift", "shift"]),
        15.0..75.0_f64,
        2.0..8.0_f64,
        prop_oneof![Just(0.0), 0.0..0.7_f64],
    );
    let rest = (
        prop::sample::select(vec![0.0, 2.0]),
        prop::sample::select(vec![0.0, 1.5]),
        10.0..35.0_f64,
        prop::collection::vec((2.0..30.0_f64, -0.95..0.95_f64), 3..20),
    );
    (lattice, rest).prop_map(
        |((lattice, residual, swing, layer, overlap), (thickness, allowance, start, pieces))| Random {
            lattice,
            residual,
            swing,
            layer,
            overlap,
            thickness,
            allowance,
            start,
            pieces,
        },
    )
}

impl Random {
    /// The profile as text: nowhere steeper than its pieces say.
    fn profile(&self) -> String {
        let flank = 1.0 / self.swing.to_radians().tan();
        let (mut x, mut z) = (0.0, self.start);
        let mut text = format!("start (0 mm, {z:.3} mm)");
        for &(length, slope) in self.pieces.iter().cycle() {
            let to = WIDTH.min(x + length);
            z = (z + slope * flank * (to - x)).clamp(5.0, 55.0);
            x = to;
            text += &format!(" line to ({x:.3} mm, {z:.3} mm)");
            if x >= WIDTH {
                break;
            }
        }
        text
    }

    fn outcome(&self) -> Outcome {
        let Self {
            lattice,
            residual,
            swing,
            layer,
            overlap,
            thickness,
            allowance,
            ..
        } = self;
        // Rounded up to an even number of micrometres: interlaced lattices jump in reach below the full step.
        let wide = 2.0 * (1.0 - overlap) * layer * swing.to_radians().tan();
        let step = (wide * 500.0).ceil() / 500.0;
        let text = format!(
            "job \"random\"
            stock {{ size = ({WIDTH} mm, 50 mm, 60 mm) }}
            profile {{ {} }}
            blade long {{ cutting_length = 500 mm, half_apex = 2 deg, thickness = {thickness} mm, edges = double }}
            rough vcut {{
                blade = long, lattice = {lattice}, rake = 85 deg, residual = {residual}, allowance = {allowance} mm
                swing = {swing} deg, layer = {layer:.3} mm, step = {step:.3} mm
                feed {{ cut = 200 mm/s, travel = 200 mm/s, reorient = 90 deg/s }}
                clearance = 10 mm
            }}",
            self.profile()
        );
        compile("random.vcut", &Files::default().with("random.vcut", text))
    }
}

/// What no point of the machined contour is farther from the part than, where that is nowhere steeper than the flanks: from any
/// point above the part, the nearest lattice point below both flanks through it lies no farther, and either was cut or
/// lies in the part.
fn bound(parameters: &VcutParameters, allowance: f64, x: f64) -> f64 {
    let (layer, step) = (parameters.layer.to_mm(), parameters.step.to_mm());
    let half = step / 2.0;
    let rise = parameters.flanks.slope * half;
    let of_lattice = match parameters.lattice {
        Lattice::Orthogonal | Lattice::Free => libm::hypot(half, layer + rise),
        Lattice::Interlaced if x < half || x > WIDTH - half => libm::hypot(half, 2.0 * layer + rise),
        Lattice::Interlaced | Lattice::Fitted => (layer + rise).max(libm::hypot(half, layer)),
    };
    of_lattice + allowance + parameters.drop.to_mm()
}

/// The simulated scallop over its bound; none where nothing was to be cut.
fn share(job: &Random) -> Option<f64> {
    let outcome = job.outcome();
    let report = &outcome.compiled.as_ref()?.report;
    let vcut = PlannedVcut::of(&*outcome.plan.as_ref()?.operations[0]).unwrap();
    let scallop = report.scallop;
    Some(scallop.height.to_mm() / bound(&vcut.parameters, job.allowance, scallop.peak.x))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(150))]
    #[test]
    fn no_scallop_is_above_the_bound_where_the_part_is_no_steeper_than_the_flanks(job in a_job()) {
        if let Some(share) = share(&job) {
            prop_assert!(share <= 1.0 + 1e-3, "{share}");
        }
    }
}

/// The bound of the planner is this one away from the sides, up to a swing of 60 degrees.
#[test]
fn the_planners_bound_is_the_true_one_but_for_wide_interlaced_lattices_and_sides() {
    let mut of_interlaced = Vec::new();
    for lattice in LATTICES {
        for swing in [20.0, 40.0, 59.9, 65.0] {
            let job = Random {
                lattice,
                residual: "discard",
                swing,
                layer: 4.0,
                overlap: 0.0,
                thickness: 0.0,
                allowance: 0.0,
                start: 20.0,
                pieces: vec![(WIDTH, 0.0)],
            };
            let outcome = job.outcome();
            let vcut = PlannedVcut::of(&*outcome.plan.as_ref().unwrap().operations[0]).unwrap();
            let VcutParameters {
                lattice,
                layer,
                step,
                flanks,
                ..
            } = vcut.parameters;
            let planners = blade_reach::scallop_bound(lattice, layer, step, flanks.slope).to_mm();
            let share = bound(&vcut.parameters, 0.0, WIDTH / 2.0) / planners;
            match lattice {
                Lattice::Orthogonal | Lattice::Free => assert!((share - 1.0).abs() < 1e-9, "{share}"),
                Lattice::Interlaced | Lattice::Fitted => of_interlaced.push(share > 1.0 + 1e-3),
            }
        }
    }
    assert_eq!(of_interlaced, [false; 4]);
}

/// Beside walls steeper than the flanks any height may stay: no V gets there, whatever the layer and the step.
#[test]
fn steep_walls_keep_more_than_any_lattice_promises() {
    let job = Random {
        lattice: "orthogonal",
        residual: "discard",
        swing: 60.0,
        layer: 3.0,
        overlap: 0.5,
        thickness: 0.0,
        allowance: 0.0,
        start: 8.0,
        pieces: vec![(60.0, 0.0), (4.0, 15.0), (60.0, 0.0)],
    };
    let share = share(&job).unwrap();
    assert!(share > 1.5, "{share}");
}
