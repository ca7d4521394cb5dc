//! `vcutc place`: what it prints, what it writes, and what it refuses.

use super::{copy, folder, names, vcutc};
use crate::repository::{read, root};
use serde_json::Value;
use std::fs;
use std::path::Path;

const EXAMPLE: &str = "examples/out_of_reach.vcut";
/// Bounds that hold the example's picture, from `docs/place.md`.
const BOUNDS: [&str; 8] = [
    "--x",
    "1500..3000",
    "--y",
    "-1400..600",
    "--z",
    "400..800",
    "--yaw",
    "0..30",
];

/// The base that `vcutc place` prints makes the job compile, and the picture is the one in the documentation.
#[test]
fn the_base_that_is_printed_makes_the_job_compile() {
    let out = folder();
    let map = out.path().join("map.svg");
    let job = read(EXAMPLE);
    let arguments = [&["place", EXAMPLE][..], &BOUNDS, &["-o", map.to_str().unwrap()]].concat();
    let run = vcutc(root(), &arguments);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    assert_eq!(job, read(EXAMPLE), "the job stays as it is");
    let base = run
        .stdout
        .lines()
        .find_map(|line| line.strip_prefix("  base = "))
        .unwrap_or_else(|| panic!("{}", run.stdout));

    let start = job.find("frame(x = 2900 mm").unwrap();
    let end = start + job[start..].find(')').unwrap() + 1;
    let moved = format!("{}{base}{}", &job[..start], &job[end..]);
    for folder in ["shop", "airfoils"] {
        copy(&root().join("examples").join(folder), &out.path().join(folder));
    }
    fs::write(out.path().join("moved.vcut"), moved).unwrap();
    let run = vcutc(out.path(), &["check", "moved.vcut"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);

    let drawn = fs::read_to_string(map).unwrap();
    assert_eq!(
        drawn,
        read("docs/pictures/out_of_reach.svg"),
        "write it again with the command in docs/place.md"
    );
}

/// However far away the base is: where nothing is near and no bounds were given, the search goes all around
/// the robot.
#[test]
fn a_base_far_away_is_brought_into_reach() {
    let out = folder();
    let near = read("tests/process/err/VC0510_far_away.vcut");
    let far = near.replace("x = 3600 mm, y = -600 mm", "x = 6600 mm, y = 2600 mm");
    assert_ne!(near, far);
    fs::write(out.path().join("far.vcut"), &far).unwrap();
    let run = vcutc(out.path(), &["place", "far.vcut"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    let line = run.stdout.lines().find_map(|line| line.strip_prefix("  base = "));
    let base = line.unwrap_or_else(|| panic!("{}", run.stdout));
    let moved = far.replace(
        "frame(x = 6600 mm, y = 2600 mm, z = 650 mm, a = 90 deg, b = 0 deg, c = 0 deg)",
        base,
    );
    assert_ne!(moved, far);
    fs::write(out.path().join("moved.vcut"), moved).unwrap();
    let run = vcutc(out.path(), &["check", "moved.vcut"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    // A search within given bounds uses no others.
    let run = vcutc(out.path(), &["place", "far.vcut", "--z", "600..700"]);
    assert_eq!(run.code, Some(1), "{}", run.stdout);
}

#[test]
fn a_machine_that_reaches_nothing_gets_an_answer_too() {
    let arguments = [
        "place",
        EXAMPLE,
        "--x",
        "5000",
        "--y",
        "0",
        "--z",
        "0",
        "--yaw",
        "0",
        "--message-format",
        "json",
    ];
    let run = vcutc(root(), &arguments);
    assert_eq!(run.code, Some(1), "{}", run.stderr);
    let answer: Value = serde_json::from_str(&run.stdout).unwrap();
    assert_eq!(
        (&answer["kind"], &answer["best"]),
        (&"placement".into(), &Value::Null)
    );
    assert!(answer["now"]["trouble"].is_string());
    assert_eq!(answer["map"]["margins"], serde_json::json!([[null]]));
}

#[test]
fn a_job_without_a_machine_has_nothing_to_place() {
    let run = vcutc(root(), &["place", "tests/jobs/no_machine/job.vcut"]);
    assert_eq!(run.code, Some(1), "{}", run.stderr);
    assert!(run.stderr.contains("this job has none"), "{}", run.stderr);
}

#[test]
fn bounds_and_files_that_cannot_be_are_refused() {
    let run = vcutc(root(), &["place", EXAMPLE, "--x", "2000..1000"]);
    assert_eq!(run.code, Some(2));
    assert!(
        run.stderr.contains("the first number is above the second"),
        "{}",
        run.stderr
    );
    let out = folder();
    let run = vcutc(out.path(), &["place", "none.vcut", "-o", "map.svg"]);
    assert_eq!(run.code, Some(2));
    assert!(names(out.path()).is_empty());
}

#[test]
fn a_map_is_a_picture_in_svg() {
    for name in ["map.png", "-"] {
        let run = vcutc(root(), &["place", EXAMPLE, "-o", name]);
        assert_eq!(run.code, Some(2), "{}", run.stderr);
        assert!(run.stderr.contains("ends in .svg"), "{}", run.stderr);
    }
}

/// A job whose arm yields, with forces of its blade.
fn soft(base: &str) -> String {
    let job = read("tests/process/err/VC0533_soft_arm.vcut");
    let now = "frame(x = 1900 mm, y = -30 mm, z = 850 mm, a = 90 deg, b = 0 deg, c = 0 deg)";
    assert!(job.contains(now) && job.contains("deviation <= 0.002 mm"));
    job.replace(now, base)
        .replace("deviation <= 0.002 mm", "deviation <= 1 mm")
}

/// The largest deviation of a job either way, in mm, and its margin; none where it does not compile.
fn deviation_of(folder: &Path, base: &str) -> Option<[f64; 2]> {
    fs::write(folder.join("soft.vcut"), soft(base)).unwrap();
    let run = vcutc(folder, &["check", "soft.vcut", "--message-format", "json"]);
    if run.code != Some(0) {
        return None;
    }
    let summary = run.stdout.lines().chain(run.stderr.lines()).find_map(|line| {
        let value: Value = serde_json::from_str(line).ok()?;
        (value["kind"] == "summary").then_some(value)
    });
    let summary = summary.unwrap_or_else(|| panic!("{} {}", run.stdout, run.stderr));
    let of = &summary["deviation"]["operations"][0];
    let most = ["into_waste", "into_part"].map(|way| of[way]["most"].as_f64().unwrap());
    Some([most[0].max(most[1]), summary["reach"]["margin"].as_f64().unwrap()])
}

/// The place with the smallest deviation: the job compiles there with that deviation, and no place of a coarse grid is better.
#[test]
fn no_place_of_a_grid_has_a_smaller_deviation() {
    let out = folder();
    copy(
        &root().join("tests/process/err/support"),
        &out.path().join("support"),
    );
    let place = |objective: &str| -> Value {
        fs::write(
            out.path().join("soft.vcut"),
            soft("frame(x = 1900 mm, y = -30 mm, z = 850 mm, a = 90 deg, b = 0 deg, c = 0 deg)"),
        )
        .unwrap();
        let bounds = [
            "--x",
            "1500..2100",
            "--y",
            "-330..270",
            "--z",
            "700..1000",
            "--yaw",
            "-30..30",
        ];
        let asked = [
            &[
                "place",
                "soft.vcut",
                "--objective",
                objective,
                "--message-format",
                "json",
            ],
            &bounds[..],
        ];
        let run = vcutc(out.path(), &asked.concat());
        assert_eq!(run.code, Some(0), "{}", run.stderr);
        serde_json::from_str(&run.stdout).unwrap()
    };
    let stiffest = place("deviation");
    let best = &stiffest["best"];
    let least = best["deviation"].as_f64().unwrap();
    assert!(
        least < stiffest["now"]["deviation"].as_f64().unwrap(),
        "{stiffest}"
    );
    let [found, margin] = deviation_of(out.path(), best["base"].as_str().unwrap()).unwrap();
    assert!((found - least).abs() < 1e-4, "{found} against {least}");
    assert!(
        margin >= 0.1 && (margin - best["margin"].as_f64().unwrap()).abs() < 1e-3,
        "{best}"
    );
    // The map has the deviations of its places, the least of them about that of the best place.
    let map = stiffest["map"]["deviations"].as_array().unwrap();
    let values = map
        .iter()
        .flat_map(|row| row.as_array().unwrap())
        .filter_map(Value::as_f64);
    let on_map = values.fold(f64::INFINITY, f64::min);
    assert!(
        on_map <= least && on_map > 0.5 * least,
        "{on_map} on the map, {least} proven"
    );

    let mut compared = 0;
    for x in [1500, 1700, 1900, 2100] {
        for y in [-330, -30, 270] {
            for (z, a) in [(700, 60), (850, 90), (1000, 120)] {
                let base =
                    format!("frame(x = {x} mm, y = {y} mm, z = {z} mm, a = {a} deg, b = 0 deg, c = 0 deg)");
                let Some([deviation, margin]) = deviation_of(out.path(), &base) else {
                    continue;
                };
                if margin >= 0.1 {
                    compared += 1;
                    assert!(
                        deviation >= 0.99 * least,
                        "{base}: {deviation} mm, {least} mm in the best place"
                    );
                }
            }
        }
    }
    assert!(compared >= 10, "{compared} places compared");
    // The margin alone finds another place.
    let by_margin = place("margin");
    assert!(
        by_margin["best"]["margin"].as_f64().unwrap() >= margin,
        "{by_margin}"
    );
    assert!(by_margin["best"]["deviation"].is_null() && by_margin["map"]["deviations"].is_null());
}

/// Wherever the base is now, the place has the deviation and the margin of the job there.
#[test]
fn the_deviation_of_a_place_is_that_of_the_job_there() {
    let out = folder();
    copy(
        &root().join("tests/process/err/support"),
        &out.path().join("support"),
    );
    let place = |now: &str, bounds: &[&str]| -> Value {
        fs::write(out.path().join("soft.vcut"), soft(now)).unwrap();
        let asked = [
            "place",
            "soft.vcut",
            "--objective",
            "deviation",
            "--message-format",
            "json",
        ];
        let run = vcutc(out.path(), &[&asked[..], bounds].concat());
        assert_eq!(run.code, Some(0), "{} {}", run.stdout, run.stderr);
        serde_json::from_str(&run.stdout).unwrap()
    };
    let base =
        |x: i32| format!("frame(x = {x} mm, y = -30 mm, z = 850 mm, a = 90 deg, b = 0 deg, c = 0 deg)");
    let cases: [(i32, &[&str]); 3] = [
        // Out of reach: there the job would be planned along another route.
        (2900, &["--x", "1600", "--y", "0", "--z", "850", "--yaw", "0"]),
        // The best places by the taught poses have a margin of a little less than 10 % between them.
        (
            1900,
            &[
                "--x",
                "1000..2400",
                "--y",
                "-30..30",
                "--z",
                "250..1150",
                "--yaw",
                "60..90",
            ],
        ),
        (
            1900,
            &[
                "--x",
                "1700..1900",
                "--y",
                "0",
                "--z",
                "550..1150",
                "--yaw",
                "0..10",
            ],
        ),
    ];
    for (now, bounds) in cases {
        let answer = place(&base(now), bounds);
        let best = &answer["best"];
        let [deviation, margin] = deviation_of(out.path(), best["base"].as_str().unwrap()).unwrap();
        let said = best["deviation"].as_f64().unwrap();
        assert!(
            (deviation - said).abs() < 1e-4,
            "{bounds:?}: {deviation} mm in the job, {said} mm said"
        );
        assert!(margin >= 0.1, "{bounds:?}: {best}");
    }
    // Another base within the last bounds, found by hand.
    let by_hand = "frame(x = 1700 mm, y = 0 mm, z = 898 mm, a = 90 deg, b = 0 deg, c = 0 deg)";
    let [by_hand, margin] = deviation_of(out.path(), by_hand).unwrap();
    let found = place(&base(1900), cases[2].1)["best"]["deviation"]
        .as_f64()
        .unwrap();
    assert!(
        margin >= 0.1 && found <= 1.005 * by_hand,
        "{found} mm found, {by_hand} mm by hand"
    );
}

#[test]
fn a_place_is_chosen_for_a_deviation_that_is_known() {
    let run = vcutc(
        root(),
        &["place", "examples/crown.vcut", "--objective", "deviation"],
    );
    assert_eq!(run.code, Some(1), "{}", run.stdout);
    assert!(
        run.stderr.contains("error[VC0535]")
            && run.stderr.contains("no place can be chosen for its deviation"),
        "{}",
        run.stderr
    );
}
