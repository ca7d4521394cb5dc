//! The modes of an arm over the cuts of a program: against the slowest one as repeated multiplication finds it.

use crate::forces::{JOB, STATED, compiled, text};
use crate::pipeline::{Files, rendered};
use crate::repository::root;
use vcutc::diagnostics::{Code, Diagnostic};
use vcutc::driver::Outcome;
use vcutc::dynamics::arm::Arm;
use vcutc::machine::kinematics::Joints;
use vcutc_backend_api::ir::{Action, Registered};

const STIFFNESS: [f64; 6] = [2.2e6, 3.4e6, 2.8e6, 2.4e6, 2.2e6, 0.47e6];

const ELASTICITY: &str = "\n[elasticity]\nstiffness_nm_rad = [2.2e6, 3.4e6, 2.8e6, 2.4e6, 2.2e6, 0.47e6]\n\
    spread = [0.1, 0.1, 0.1, 0.1, 0.1, 0.1]\nconfidence = \"measured\"\nsource = \"made up\"\n";

/// A robot with published masses and a stiffness that is made up.
fn sheet() -> String {
    let sheet = root().join("src/machine/robots/kuka/kr210_r2700_2.toml");
    std::fs::read_to_string(sheet).unwrap() + ELASTICITY
}

fn job(sheet: String, forces: &str) -> Files {
    Files::default()
        .with(JOB, text(forces, "", ""))
        .with("arm.toml", sheet)
}

/// The frequency of the slowest mode in Hz, and the share of each axis of its energy: what `K^-1 M` makes of a vector again and again grows by the largest `1 / w^2`.
fn slowest(arm: &Arm, joints: &Joints) -> (f64, [f64; 6]) {
    let masses = arm.mass_matrix(joints);
    let mut swings = [1.0, 0.9, -0.8, 0.7, 0.6, 0.5];
    let mut growth = 0.0;
    for _ in 0..2000 {
        let next: [f64; 6] = std::array::from_fn(|axis| {
            let needs: f64 = (0..6).map(|other| masses[other][axis] * swings[other]).sum();
            needs / STIFFNESS[axis]
        });
        growth = next.iter().map(|swing| swing * swing).sum::<f64>().sqrt();
        swings = next.map(|swing| swing / growth);
    }
    let energies: [f64; 6] = std::array::from_fn(|axis| STIFFNESS[axis] * swings[axis] * swings[axis]);
    let whole: f64 = energies.iter().sum();
    let shares = energies.map(|energy| energy / whole);
    (1.0 / (std::f64::consts::TAU * growth.sqrt()), shares)
}

#[test]
fn the_slowest_mode_is_that_of_repeated_multiplication() {
    let outcome = compiled(&job(sheet(), ""));
    let compiled = outcome.compiled.as_ref().unwrap();
    let figures = compiled.dynamics.modes.as_ref().expect("modes");
    assert_eq!(figures.modes.len(), 6);
    let reached = compiled.program.reached().unwrap();
    let program = reached.program.program();
    let model = &outcome.job.as_ref().unwrap().machine.as_ref().unwrap().model;
    let (_, tool) = program.cell.as_ref().unwrap().tools.iter().next().unwrap();
    let Some(Registered::Value(load)) = tool.load else {
        panic!("a load")
    };
    let arm = Arm::of(model, Some(load)).unwrap();
    let mut range = [f64::MAX, f64::MIN];
    let mut shares = [0.0; 6];
    for segment in program.segments() {
        if let Action::Cut { .. } = segment.op.action {
            for joints in [
                reached.program.axes_before(segment.id),
                reached.program.axes_after(segment.id),
            ] {
                let (here, shares_here) = slowest(&arm, &joints.unwrap().0);
                if here < range[0] {
                    shares = shares_here;
                }
                range = [range[0].min(here), range[1].max(here)];
            }
        }
    }
    let found = &figures.modes[0];
    assert!(
        found.lowest <= range[0] + 1e-6 && range[1] <= found.highest + 1e-6,
        "{found:?} {range:?}"
    );
    // Between the ends of cuts little is slower or faster.
    assert!(
        range[0] < 1.05 * found.lowest && found.highest < 1.05 * range[1],
        "{found:?} {range:?}"
    );
    assert!(range[1] > 1.05 * range[0], "{range:?}");
    let axis = model
        .axes
        .iter()
        .position(|axis| axis.name == found.axis)
        .unwrap();
    let most = shares.into_iter().fold(0.0, f64::max);
    assert!(
        shares[axis] == most && (most - found.share).abs() < 0.05,
        "{found:?} {shares:?}"
    );
    let line = compiled
        .summary
        .iter()
        .find(|line| line.contains("modes"))
        .expect("a line");
    assert!(line.contains("masses published, stiffness measured"), "{line}");
}

#[test]
fn modes_need_masses_and_stiffness_and_no_forces() {
    let modes = |sheet: String, forces: &str| {
        let outcome = compiled(&job(sheet, forces));
        outcome.compiled.unwrap().dynamics.modes
    };
    let known = modes(sheet(), "");
    assert!(known.is_some());
    assert_eq!(known, modes(sheet(), STATED));
    assert_eq!(modes(sheet().replace(ELASTICITY, ""), ""), None);
    let lumped = sheet().replace("kind = \"full\"", "kind = \"lumped\"");
    assert_ne!(lumped, sheet());
    assert_eq!(modes(lumped, ""), None);
    let without = |sheet: String| sheet[..sheet.find("[dynamics]").unwrap()].to_owned() + ELASTICITY;
    assert_eq!(modes(without(sheet()), ""), None);
}

/// Cells that meet the slowest mode, and the speeds that are offered instead.
#[test]
fn speeds_at_which_cells_meet_a_mode_are_warned_of_and_those_offered_are_not() {
    let figures = compiled(&job(sheet(), ""))
        .compiled
        .unwrap()
        .dynamics
        .modes
        .unwrap();
    let met = figures.modes[0].lowest;
    // Cut at 100 mm/s, the job's edge meets so many cells a second.
    let size = format!("{:.3} mm", 100.0 / met);
    let at = |speed: &str| {
        let text = text("", "", "").replace("24 mm) }", &format!("24 mm), cell_size = {size} }}"));
        let text = text.replace("cut = 100 mm/s", &format!("cut = {speed} mm/s"));
        compiled(&Files::default().with(JOB, text).with("arm.toml", sheet()))
    };
    let warnings = |outcome: &Outcome| -> Vec<Diagnostic> {
        let all = outcome.diagnostics.iter();
        all.filter(|one| one.code == Code::CellsMeetMode)
            .cloned()
            .collect()
    };
    let outcome = at("100");
    let found = warnings(&outcome);
    let [warning] = found.as_slice() else {
        panic!("{}", rendered(&outcome.diagnostics, &outcome))
    };
    let (_, nearest) = warning.help[0].split_once("the nearest are ").unwrap();
    let speeds: Vec<&str> = nearest
        .split(" and ")
        .map(|speed| speed.strip_suffix(" mm/s").unwrap())
        .collect();
    assert_eq!(speeds.len(), 2, "{nearest}");
    for speed in speeds {
        let outcome = at(speed);
        assert_eq!(warnings(&outcome), [], "{speed}");
        let summary = &outcome.compiled.as_ref().unwrap().summary;
        assert!(
            summary.iter().any(|line| line.contains("20 % or more away")),
            "{summary:?}"
        );
    }
}

#[test]
fn cells_are_not_compared_with_modes_that_are_not_known() {
    let text = text("", "", "").replace("24 mm) }", "24 mm), cell_size = 3.2 mm }");
    let stiff = sheet().replace(ELASTICITY, "");
    let outcome = compiled(&Files::default().with(JOB, text).with("arm.toml", stiff));
    let summary = outcome.compiled.unwrap().summary;
    assert!(
        summary
            .iter()
            .any(|line| line.contains("cells") && line.contains("not compared")),
        "{summary:?}"
    );
}
