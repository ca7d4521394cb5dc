//! A checked job keeps its curves: tessellated within any tolerance they are that near to what was drawn.

use super::{Files, codes};
use vcutc_backend_api::units::Length;
use vcutc_geometry::profile::Profile;
use vcutc_job::{CheckedJob, Part};

fn job(profile: &str) -> CheckedJob {
    let text = format!(
        "job \"test\"\nlet top = 40 mm\nstock {{ size = (80 mm, 50 mm, 50 mm) }}\nprofile {{ {profile} }}\n\
         blade knife {{ cutting_length = 10 mm half_apex = 7 deg thickness = 1 mm edges = double }}\n\
         rough vcut {{ blade = knife lattice = orthogonal rake = 60 deg layer = 4 mm\n\
         feed {{ cut = 200 mm/s travel = 200 mm/s reorient = 90 deg/s }} clearance = 10 mm }}\n"
    );
    let circle = "0\nSECTION\n2\nENTITIES\n0\nARC\n8\n0\n10\n40\n20\n-60\n40\n100\n50\n60\n51\n120\n0\nENDSEC\n0\nEOF\n";
    let (diagnostics, job) = Files::default()
        .with("job.vcut", text)
        .with("arc.dxf", circle)
        .check(&[]);
    assert_eq!(codes(&diagnostics), [], "{diagnostics:?}");
    job.unwrap()
}

/// A circle of 100 mm about (40, -60).
fn circle(x: f64) -> f64 {
    -60.0 + (10_000.0 - (x - 40.0) * (x - 40.0)).sqrt()
}

fn wave(x: f64) -> f64 {
    40.0 - 5.0 * libm::cos(x * 4.5_f64.to_radians())
}

/// The largest distance in height from a function.
fn off(profile: &Profile, height: fn(f64) -> f64) -> f64 {
    let xs = (1..8000).map(|i| f64::from(i) / 100.0);
    xs.map(|x| (profile.height(x) - height(x)).abs())
        .fold(0.0, f64::max)
}

/// The height of a part at an x, both in mm.
type Height = fn(f64) -> f64;

#[test]
fn curves_are_followed_within_any_tolerance() {
    let z = circle(0.0);
    let arc = format!("start (0 mm, {z} mm) arc to (80 mm, {z} mm) radius 100 mm");
    let drawn: [(&str, Height); 3] = [
        (&arc, circle),
        ("z(x) = top - 5 mm * cos(4.5 deg * x / 1 mm)", wave),
        ("dxf \"arc.dxf\" { unit = mm, x = 0 mm }", circle),
    ];
    for (profile, height) in drawn {
        let part: Part = job(profile).part;
        let mut corners = 0;
        for tolerance in [0.1, 0.01, 0.001, 0.0001] {
            let lines = part.tessellated(Length::mm(tolerance)).unwrap();
            // Heights are off by more than distances where the curve is steep: by 1.1 times here at most.
            assert!(
                off(&lines, height) <= 1.1 * tolerance,
                "{profile} within {tolerance}"
            );
            assert!(lines.points().len() >= corners, "{profile} within {tolerance}");
            corners = lines.points().len();
        }
        assert!(corners > 100, "{profile}");
    }
}

#[test]
fn a_formula_keeps_the_values_of_its_names_and_no_places() {
    let written = job("z(x) = top - 5 mm * cos(4.5 deg * x / 1 mm)");
    let elsewhere = job("\n\n z(x) =   top - 5 mm * cos(4.5 deg * x / 1 mm)");
    assert_ne!(written.part, elsewhere.part);
    assert_eq!(written.without_places().part, elsewhere.without_places().part);
}
