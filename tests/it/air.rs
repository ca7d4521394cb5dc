//! Air cuts: the program that cuts, higher, slower and silent, for every target.

use crate::pipeline::{Files, compile, compile_on, emit_for, numbers};
use crate::repository::{read, root};
use crate::shop::{CELLS, DIALECTS, folder, folder_for};
use std::fs;
use vcutc::driver::{Outcome, air_cut_height, into_air_cut};
use vcutc::picture::Prefix;
use vcutc::registry;
use vcutc::report::{Material, pictures};
use vcutc_backend_api::backend::Backend;
use vcutc_backend_api::bundle::Bundle;
use vcutc_backend_api::ir::{Action, Program, Purpose, Switch};
use vcutc_backend_api::units::Length;

const EXAMPLE: &str = "spoiler_clarky.vcut";
const LIFT: f64 = 100.0;

fn bench() -> Outcome {
    compile("bench.vcut", &Files::of(root().join("tests/verify")))
}

fn program(outcome: &Outcome) -> &Program {
    outcome.compiled.as_ref().unwrap().program.verified().program()
}

fn lifted(mut outcome: Outcome, height: f64) -> Outcome {
    into_air_cut(&mut outcome, Length::mm(height), &mut |_| {});
    outcome
}

fn texts(bundle: &Bundle) -> Vec<(String, String)> {
    let files = bundle.files().iter();
    files
        .map(|(name, bytes)| (name.clone(), String::from_utf8(bytes.clone()).unwrap()))
        .collect()
}

/// Where an action leads the tip, and what is left of it without heights and speeds.
fn place(action: &Action) -> Option<[f64; 3]> {
    match *action {
        Action::Travel { to, .. }
        | Action::AxisTravel { to, .. }
        | Action::Approach { to, .. }
        | Action::Retract { to, .. }
        | Action::Cut { to, .. } => Some([to.x, to.y, to.z]),
        _ => None,
    }
}

fn is_the_same_higher(cutting: &Program, air: &Program) {
    let kept: Vec<_> = cutting
        .ops
        .iter()
        .filter(|op| op.action != Action::AwaitReady)
        .collect();
    assert_eq!(kept.len(), air.ops.len());
    for (op, up) in kept.into_iter().zip(&air.ops) {
        assert_eq!(op.site, up.site);
        assert_eq!(op.action.kind(), up.action.kind());
        if let (Some(from), Some(to)) = (place(&op.action), place(&up.action)) {
            assert_eq!([from[0], from[1]], [to[0], to[1]]);
            assert!((to[2] - from[2] - LIFT).abs() < 1e-9);
        }
        assert_ne!(up.action, Action::Ultrasonic { state: Switch::On });
    }
    assert!(air.feeds.iter().all(|feed| feed.to_mm_per_s() <= 100.0));
    assert!(air.rates.iter().all(|rate| rate.to_deg_per_s() <= 30.0 + 1e-9));
    assert_eq!((air.stock, &air.cell), (cutting.stock, &cutting.cell));
    assert_eq!(
        air.purpose,
        Purpose::AirCut {
            lift: Length::mm(LIFT)
        }
    );
}

/// Written, and read back by the target's own reader.
fn is_written(outcome: &Outcome, target: &dyn Backend, what: &str) {
    let bundle = emit_for(target, outcome).unwrap_or_else(|found| panic!("{what}: {:?}", numbers(&found)));
    let texts = texts(&bundle);
    assert!(!texts.is_empty());
    for (name, _) in &texts {
        assert!(name.to_ascii_lowercase().contains("_air"), "{what}: {name}");
    }
    let head = texts[0].1.to_ascii_uppercase();
    assert!(
        head.contains("AIR CUT: LIFTED BY 100 MM, GENERATOR OFF"),
        "{what}: {head}"
    );
}

#[test]
fn an_air_cut_is_the_program_higher_on_every_cell() {
    for &(machine, target) in CELLS {
        let outcome = compile_on(Some(machine), EXAMPLE, &folder());
        let cutting = program(&outcome).clone();
        let outcome = lifted(outcome, LIFT);
        assert_eq!(numbers(&outcome.diagnostics), [""; 0], "{machine}");
        is_the_same_higher(&cutting, program(&outcome));
        is_written(&outcome, registry::backend(target).unwrap(), machine);
    }
}

#[test]
fn it_is_written_for_every_control() {
    let gcode = registry::backend("gcode").unwrap();
    for (dialect, _) in DIALECTS {
        let outcome = compile_on(Some("gantry"), EXAMPLE, &folder_for(dialect));
        is_written(&lifted(outcome, LIFT), gcode, dialect);
    }
}

/// The digits after `Z ` of each line of a KRL program.
fn heights(text: &str) -> Vec<f64> {
    let motions = text
        .lines()
        .filter(|line| line.contains("LIN {") || line.contains("PTP {"));
    let height = |line: &str| {
        let rest = line.split_once("Z ")?.1;
        rest.split([',', '}']).next()?.parse().ok()
    };
    motions.filter_map(height).collect()
}

/// By reading the text alone.
#[test]
fn its_text_is_that_of_the_program_higher_and_silent() {
    let krl = registry::backend("krl").unwrap();
    let outcome = bench();
    let cutting = texts(&emit_for(krl, &outcome).unwrap());
    let air = texts(&emit_for(krl, &lifted(outcome, LIFT)).unwrap());
    let of = |texts: &[(String, String)]| {
        texts
            .iter()
            .find(|(name, _)| name.ends_with(".src"))
            .unwrap()
            .1
            .clone()
    };
    let (cutting, air) = (of(&cutting), of(&air));
    assert!(cutting.contains("]=TRUE") && cutting.contains("WAIT "));
    assert!(!air.contains("]=TRUE") && !air.contains("WAIT "), "{air}");
    let (low, high) = (heights(&cutting), heights(&air));
    assert!(low.len() > 10 && low.len() == high.len());
    for (low, high) in low.iter().zip(&high) {
        assert!((high - low - LIFT).abs() < 1e-6, "{low} {high}");
    }
}

/// The height of a help line.
fn offered(outcome: &Outcome) -> f64 {
    let [found] = outcome.diagnostics.as_slice() else {
        panic!("{:?}", numbers(&outcome.diagnostics));
    };
    assert_eq!(found.code.number(), "VC0521");
    let help = found.help.first().unwrap();
    let digits = help.split_once("--air-cut ").unwrap().1;
    digits.split_once("mm").unwrap().0.parse().unwrap()
}

#[test]
fn a_height_that_does_not_do_is_refused_with_one_that_does() {
    for height in [1.0, 9000.0] {
        let outcome = lifted(bench(), height);
        assert!(outcome.compiled.is_none());
        let offered = offered(&outcome);
        assert!(lifted(bench(), offered).compiled.is_some(), "{offered}");
        // About the least one, or the greatest.
        let beyond = if height < offered {
            offered - 1.0
        } else {
            offered + 100.0
        };
        assert!(lifted(bench(), beyond).compiled.is_none(), "{offered}");
    }
}

#[test]
fn heights_are_lengths() {
    for (text, mm) in [
        ("100mm", 100.0),
        ("100 mm", 100.0),
        ("10 cm", 100.0),
        ("0.1m", 100.0),
    ] {
        assert!(
            (air_cut_height(text).unwrap().to_mm() - mm).abs() < 1e-9,
            "{text}"
        );
    }
    for text in [
        "", "mm", "-5mm", "0", "100", "100deg", "100 mn", "11 m", "nan", "inf mm",
    ] {
        assert!(air_cut_height(text).is_err(), "{text}");
    }
}

#[test]
fn long_names_keep_their_ending() {
    let name = "a_name_that_is_much_longer_than_controls_take";
    let text = read("tests/verify/bench.vcut").replacen("job \"bench\"", &format!("job \"{name}\""), 1);
    assert!(text.contains(name));
    let files = Files::of(root().join("tests/verify")).with("bench.vcut", text);
    let krl = registry::backend("krl").unwrap();
    let outcome = compile("bench.vcut", &files);
    let cutting = texts(&emit_for(krl, &outcome).unwrap());
    let air = texts(&emit_for(krl, &lifted(outcome, LIFT)).unwrap());
    assert!(air[0].0.ends_with("_air.src"), "{}", air[0].0);
    assert!(
        cutting
            .iter()
            .all(|(name, _)| air.iter().all(|(other, _)| other != name))
    );
}

/// `UPDATE_PICTURES=1` rewrites it.
#[test]
fn the_figure_of_the_blade_is_true() {
    let outcome = compile("wavy_panel.vcut", &folder());
    let drawn = pictures::blade(&Material::of(&outcome).unwrap(), Prefix::NONE).unwrap();
    let path = "docs/images/blade.svg";
    if std::env::var_os("UPDATE_PICTURES").is_some() {
        fs::write(root().join(path), &drawn).unwrap();
    }
    assert_eq!(fs::read_to_string(root().join(path)).unwrap_or_default(), drawn);
    assert!(read("docs/language.md").contains("(images/blade.svg)"));
}
