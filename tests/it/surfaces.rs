//! Roughing of surfaces against roughing of their shadows.

use crate::pipeline::{Files, compile, emit};
use vcutc::diagnostics::has_errors;
use vcutc::driver::Outcome;
use vcutc::job::Part;

/// All but the part.
const REST: &str = "job \"fairing\"
stock { size = (120 mm, 80 mm, 60 mm) }
blade dagger {
  cutting_length = 25 mm
  half_apex      = 7.13 deg
  thickness      = 1.5 mm
  edges          = double
}
machine left = robot \"kuka/kr210_r3100_ultra\" {
  tool       = frame(x = 0 mm, y = 0 mm, z = 310 mm, a = 0 deg, b = 0 deg, c = 0 deg)
  base       = frame(x = 1800 mm, y = -25 mm, z = 700 mm, a = 0 deg, b = 0 deg, c = 0 deg)
  home       = joints(0 deg, -90 deg, 90 deg, 0 deg, 45 deg, 0 deg)
  ultrasonic = output(12)
}
";

const VCUT: &str = "rough vcut {
  blade     = dagger
  lattice   = orthogonal
  rake      = 60 deg
  limits    { swing <= 50 deg, scallop <= 6 mm }
  allowance = 0.5 mm
  feed      { cut = 200 mm/s, travel = 200 mm/s, reorient = 90 deg/s }
  clearance = 10 mm
}
";

const RECT: &str = "blade wheel = disc {
  radius    = 25 mm
  thickness = 1.5 mm
  depth     = 12 mm
  width     = 20 mm
  spin      = 3000 rev/min
  body (1.5 mm, 8 mm) (60 mm, 25 mm)
}
rough rect {
  blade     = dagger
  disc      = wheel
  rake      = 60 deg
  lead      = 3 deg
  allowance = 2 mm
  limits    { scallop <= 12 mm }
  feed      { cut = 10 m/min, free = 6 m/min, travel = 18 m/min, reorient = 90 deg/s }
  clearance = 20 mm
}
";

/// A hill with a shoulder, in mm, at some x.
fn hill(x: f64) -> f64 {
    20.0 + 14.0 * (x / 120.0 * std::f64::consts::PI).sin() + if x > 80.0 { (x - 80.0) * 0.1 } else { 0.0 }
}

fn job(part: &str, operation: &str) -> String {
    format!("{REST}{part}\n{operation}")
}

/// A job with a surface, compiled; its shadow with 17 digits, and its program.
fn roughed(part: &str, operation: &str, files: Files) -> (String, String) {
    let outcome = compile("job.vcut", &files.with("job.vcut", job(part, operation)));
    let checked = outcome
        .job
        .as_ref()
        .unwrap_or_else(|| panic!("{:?}", outcome.diagnostics));
    assert!(checked.part.surface().is_some() || part.starts_with("profile"));
    let shadow = checked.part.tessellated(Part::TOLERANCE).unwrap();
    let points = shadow.points().iter();
    let csv: String = points
        .map(|point| format!("{:.17e},{:.17e}\n", point.x, point.z))
        .collect();
    (csv, program(&outcome))
}

/// The program without the line with the hash of its job: the jobs differ.
fn program(outcome: &Outcome) -> String {
    assert!(!has_errors(&outcome.diagnostics), "{:?}", outcome.diagnostics);
    let bundle = emit(outcome).unwrap();
    let texts = bundle
        .files()
        .iter()
        .map(|file| String::from_utf8_lossy(&file.1).into_owned());
    let texts: Vec<String> = texts.collect();
    let lines = texts.iter().flat_map(|text| text.lines());
    let kept = lines.filter(|line| !line.to_lowercase().contains("hash"));
    kept.collect::<Vec<_>>().join("\n")
}

/// A binary STL of a sheet over the stock: the hill, lower by what `dip` says at each y.
fn stl(dip: impl Fn(f64) -> f64) -> Vec<u8> {
    let (across, along) = (60, 8);
    let corner = |i: usize, j: usize| {
        let (x, y) = (120.0 * i as f64 / across as f64, 80.0 * j as f64 / along as f64);
        [x, y, hill(x) - dip(y)]
    };
    let mut faces = Vec::new();
    for i in 0..across {
        for j in 0..along {
            let [a, b, c, d] = [
                corner(i, j),
                corner(i + 1, j),
                corner(i + 1, j + 1),
                corner(i, j + 1),
            ];
            faces.extend([[a, b, c], [a, c, d]]);
        }
    }
    let mut bytes = vec![b' '; 80];
    bytes.extend((faces.len() as u32).to_le_bytes());
    for face in faces {
        bytes.extend([0.0_f32, 0.0, 1.0].into_iter().flat_map(f32::to_le_bytes));
        let numbers = face.into_iter().flatten().map(|number| number as f32);
        bytes.extend(numbers.flat_map(f32::to_le_bytes));
        bytes.extend([0, 0]);
    }
    bytes
}

fn assert_roughed_as_its_shadow(part: &str, operation: &str, files: &Files) {
    let (shadow, of_surface) = roughed(part, operation, files.clone());
    let files = files.clone().with("shadow.csv", shadow);
    let (again, of_points) = roughed("profile { points \"shadow.csv\" }", operation, files);
    assert!(!again.is_empty() && of_surface.lines().count() > 50);
    assert_eq!(of_surface, of_points, "{part}");
}

#[test]
fn a_formula_that_does_not_depend_on_y_is_roughed_as_its_shadow() {
    let part = "surface { z(x, y) = 20 mm + 14 mm * sin(x / 120 mm * 180 deg) + max(0 mm, x - 80 mm) * 0.1 }";
    assert_roughed_as_its_shadow(part, VCUT, &Files::default());
}

#[test]
fn a_swept_mesh_is_roughed_as_its_shadow() {
    let files = Files::default().with("hill.stl", stl(|_| 0.0));
    assert_roughed_as_its_shadow("surface { mesh \"hill.stl\" { unit = mm } }", VCUT, &files);
}

#[test]
fn what_changes_along_y_is_roughed_as_its_shadow() {
    let files = Files::default().with("hill.stl", stl(|y| (y - 40.0).abs() / 8.0));
    let part = "surface { mesh \"hill.stl\" { unit = mm } }";
    assert_roughed_as_its_shadow(part, VCUT, &files);
    let loft = "surface { loft { at 0 mm { z(x) = 30 mm - x / 10 } at 80 mm { start (0 mm, 20 mm) arc to (120 mm, 20 mm) radius 200 mm } } }";
    assert_roughed_as_its_shadow(loft, VCUT, &Files::default());
}

/// Without a machine that changes blades, so down to the program that targets write.
#[test]
fn rectangular_roughing_takes_the_shadow_too() {
    let program = |part: &str, files: Files| {
        let (rest, _) = REST.split_once("machine").unwrap();
        let files = files.with("job.vcut", format!("{rest}{part}\n{RECT}"));
        let outcome = compile("job.vcut", &files);
        assert!(!has_errors(&outcome.diagnostics), "{:?}", outcome.diagnostics);
        let shadow = outcome
            .job
            .as_ref()
            .unwrap()
            .part
            .tessellated(Part::TOLERANCE)
            .unwrap();
        let points = shadow.points().iter();
        let csv: String = points
            .map(|point| format!("{:.17e},{:.17e}\n", point.x, point.z))
            .collect();
        let compiled = outcome.compiled.as_ref().unwrap();
        (csv, format!("{:?}", compiled.program.verified().program().ops))
    };
    let files = Files::default().with("hill.stl", stl(|y| y / 16.0));
    let (shadow, of_surface) = program("surface { mesh \"hill.stl\" { unit = mm } }", files.clone());
    let (_, of_points) = program(
        "profile { points \"shadow.csv\" }",
        files.with("shadow.csv", shadow),
    );
    assert!(of_surface.len() > 1000);
    assert_eq!(of_surface, of_points);
}

/// The hash in a program's head covers a binary mesh, too.
#[test]
fn another_mesh_is_another_job() {
    let head = |bytes: Vec<u8>| {
        let files = Files::default().with("hill.stl", bytes);
        let text = job("surface { mesh \"hill.stl\" { unit = mm } }", VCUT);
        let outcome = compile("job.vcut", &files.with("job.vcut", text));
        let bundle = emit(&outcome).unwrap();
        let texts: Vec<String> = bundle
            .files()
            .iter()
            .map(|file| String::from_utf8_lossy(&file.1).into_owned())
            .collect();
        let line = texts
            .iter()
            .flat_map(|text| text.lines())
            .find(|line| line.to_lowercase().contains("hash"));
        line.expect("a hash").to_owned()
    };
    let mut other = stl(|_| 0.0);
    // Only the spare bytes of a triangle: the same part.
    other[84 + 48] = 1;
    assert_eq!(head(stl(|_| 0.0)), head(stl(|_| 0.0)));
    assert_ne!(head(stl(|_| 0.0)), head(other));
}
