//! Roughing of surfaces against roughing of their shadows.

use crate::pipeline::{Files, compile, emit};
use vcutc::diagnostics::has_errors;
use vcutc::driver::Outcome;
use vcutc::job::Part;
use vcutc::surface::residual::Over;
use vcutc_backend_api::units::Length;

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

pub(crate) const VCUT: &str = "rough vcut {
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

pub(crate) fn job(part: &str, operation: &str) -> String {
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
pub(crate) fn program(outcome: &Outcome) -> String {
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
pub(crate) fn stl(dip: impl Fn(f64) -> f64) -> Vec<u8> {
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

/// What is written as a surface but is the same at every y is roughed, byte for byte, as the profile.
#[test]
fn a_swept_surface_is_roughed_as_its_profile() {
    let drawn = "start (0 mm, 20 mm) arc to (120 mm, 20 mm) radius 200 mm";
    let formula = "20 mm + 14 mm * sin(x / 120 mm * 180 deg) + max(0 mm, x - 80 mm) * 0.1";
    for (surface, profile) in [
        (format!("z(x, y) = {formula}"), format!("z(x) = {formula}")),
        (
            format!("loft {{ at 0 mm {{ {drawn} }} at 80 mm {{ {drawn} }} }}"),
            drawn.to_owned(),
        ),
    ] {
        let (_, of_surface) = roughed(&format!("surface {{ {surface} }}"), VCUT, Files::default());
        let (_, of_profile) = roughed(&format!("profile {{ {profile} }}"), VCUT, Files::default());
        assert!(of_surface.lines().count() > 50);
        assert_eq!(of_surface, of_profile, "{surface}");
    }
}

/// Triangles of formulas and lofts lie within 10 micrometres of what they stand for, so the shadow lies at least as high as that.
#[test]
fn no_cut_enters_what_triangles_stand_for() {
    let dome = |x: f64, y: f64| 50.0 - (x - 60.0).powi(2) / 300.0 - (y - 40.0).powi(2) / 500.0;
    let part = "surface { z(x, y) = 50 mm - (x - 60 mm)^2 / 300 mm - (y - 40 mm)^2 / 500 mm }";
    let outcome = compile("job.vcut", &Files::default().with("job.vcut", job(part, VCUT)));
    let shadow = outcome
        .job
        .as_ref()
        .unwrap()
        .part
        .tessellated(Part::TOLERANCE)
        .unwrap();
    for i in 0..=1200 {
        let x = f64::from(i) / 10.0;
        let above = shadow.height(x) - dome(x, 40.0);
        assert!((0.0..=0.0201).contains(&above), "{above} at {x}");
    }
    // What is left, against columns of half a millimetre.
    let compiled = outcome.compiled.as_ref().unwrap();
    let left = compiled.left_over.unwrap();
    let contour = &compiled.report.contour;
    let machined = |x: f64| {
        let after = contour.partition_point(|corner| corner.x < x);
        let (a, b) = (contour[after - 1], contour[after]);
        a.z + (x - a.x) / (b.x - a.x) * (b.z - a.z)
    };
    let (mut volume, mut highest) = (0.0, 0.0_f64);
    for i in 0..240 {
        let x = 0.25 + 0.5 * f64::from(i);
        for j in 0..160 {
            let height = machined(x) - dome(x, 0.25 + 0.5 * f64::from(j));
            volume += 0.25 * height;
            highest = highest.max(height);
        }
    }
    let Over { height, place } = left.all.highest;
    let found = left.all.volume.to_mm3();
    assert!((found / volume - 1.0).abs() < 2e-3, "{found} {volume}");
    assert!(
        (highest..highest + 0.5).contains(&height.to_mm()),
        "{height:?} {highest}"
    );
    let [x, y] = place.map(Length::to_mm);
    assert!((machined(x.clamp(1e-6, 120.0 - 1e-6)) - dome(x, y) - height.to_mm()).abs() < 0.02);
    let says = |words: &str| compiled.summary.iter().any(|line| line.contains(words));
    assert!(
        says(" l stay on the part, at most ") && says("below the part's shadow"),
        "{:?}",
        compiled.summary
    );
}

/// The heights of an example are those of a hyperbolic paraboloid, at every 30 mm.
#[test]
fn the_saddle_is_its_formula() {
    let text = std::fs::read_to_string(crate::repository::root().join("examples/points/saddle.csv")).unwrap();
    let mut written = "x,y,z\n".to_owned();
    for y in (0..=300).step_by(30) {
        for x in (0..=300).step_by(30) {
            let z = 35.0 + f64::from(x - 150) * f64::from(y - 150) / 1500.0;
            written += &format!("{x},{y},{z}\n");
        }
    }
    assert_eq!(text, written);
}

/// A coloured mesh has above each vertex what the program leaves there: the machined contour over it less its height, which the formula
/// of the part says once more.
#[test]
fn a_coloured_mesh_says_what_is_left_above_each_vertex() {
    let folder = tempfile::tempdir().unwrap();
    let part = "surface { z(x, y) = 40 mm - (x - 60 mm)^2 / 200 mm - (y - 40 mm)^2 / 160 mm }";
    std::fs::write(folder.path().join("job.vcut"), job(part, VCUT)).unwrap();
    let run = crate::cli::vcutc(folder.path(), &["job.vcut", "--emit", "deviation", "-o", "out"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    let bytes = std::fs::read(folder.path().join("out/job.deviation.ply")).unwrap();
    let outcome = compile("job.vcut", &Files::of(folder.path()));
    let contour = outcome.compiled.unwrap().report.contour;
    let end = b"end_header\n";
    let start = bytes.windows(end.len()).position(|window| window == end).unwrap() + end.len();
    let head = std::str::from_utf8(&bytes[..start]).unwrap();
    let count: usize = head
        .split("element vertex ")
        .nth(1)
        .unwrap()
        .lines()
        .next()
        .unwrap()
        .parse()
        .unwrap();
    assert!(count > 1000);
    let values = bytes[start..start + 16 * count].chunks_exact(4);
    let values: Vec<f64> = values
        .map(|value| f64::from(f32::from_le_bytes(value.try_into().unwrap())))
        .collect();
    for vertex in values.chunks_exact(4) {
        let [x, y, z, left] = vertex else { unreachable!() };
        let height = 40.0 - (x - 60.0) * (x - 60.0) / 200.0 - (y - 40.0) * (y - 40.0) / 160.0;
        assert!((z - height).abs() < 0.02, "{vertex:?} {height}");
        let over = contour
            .windows(2)
            .filter(|pair| pair[0].x - 1e-4 <= *x && *x <= pair[1].x + 1e-4);
        let tops = over.map(|pair| {
            let share = ((x - pair[0].x) / (pair[1].x - pair[0].x).max(1e-9)).clamp(0.0, 1.0);
            pair[0].z + (pair[1].z - pair[0].z) * share
        });
        let matches = tops.into_iter().any(|top| (top - z - left).abs() < 1e-3);
        assert!(matches, "{vertex:?}");
    }
    // A profile has no such mesh.
    std::fs::write(
        folder.path().join("flat.vcut"),
        job("profile { z(x) = 30 mm }", VCUT),
    )
    .unwrap();
    let run = crate::cli::vcutc(folder.path(), &["flat.vcut", "--emit", "deviation"]);
    assert_eq!(run.code, Some(2), "{}", run.stderr);
    assert!(
        run.stderr.contains("the job's part is a profile"),
        "{}",
        run.stderr
    );
}
