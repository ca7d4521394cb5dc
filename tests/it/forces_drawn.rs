//! Pictures of torques and of the deviation by forces: what they show is what the summary and the table say.

use crate::cli::vcutc;
use crate::forces::{STATED, arm, compiled, text};
use crate::pictures::{assert_dark, assert_within_its_sheet, picture};
use crate::pipeline::Files;
use serde_json::Value;
use std::collections::BTreeMap;
use tempfile::TempDir;
use vcutc::driver::Outcome;
use vcutc::driver::dynamics::cut_by_cut;
use vcutc::dynamics::cuts::Face;
use vcutc::picture::{Prefix, dark};
use vcutc::report::page::{Further, page};
use vcutc_backend_api::ir::{Action, Flank};

const JOB: &str = "job.vcut";
const LIMITS: &str = "limits { deviation <= 0.04 mm }";
const PICTURES: [&str; 2] = ["torques", "deviation-by-forces"];

/// Weak drives, so that a limit is near.
const DRIVES: &str = "\n[torque]\nlimits_nm = [4000, 4600, 4000, 900, 700, 400]\n\
    confidence = \"published\"\nsource = \"numbers made up for this test\"\n";

/// A job of which all is known.
fn known() -> [(&'static str, String); 2] {
    let machine = "limits { torque <= 60 % }";
    [(JOB, text(STATED, LIMITS, machine)), ("arm.toml", arm() + DRIVES)]
}

fn in_memory(files: &[(&str, String)]) -> Outcome {
    let all = files
        .iter()
        .fold(Files::default(), |all, (name, text)| all.with(name, text.clone()));
    compiled(&all)
}

fn on_disk(files: &[(&str, String)]) -> TempDir {
    let folder = TempDir::new().unwrap();
    for (name, text) in files {
        std::fs::write(folder.path().join(name), text).unwrap();
    }
    folder
}

/// The rows of `--emit dynamics`, by the names of their columns. Empty cells are left out.
fn table(folder: &TempDir) -> Vec<BTreeMap<String, f64>> {
    let run = vcutc(folder.path(), &[JOB, "--emit", "dynamics", "-o", "-", "-q"]);
    let mut lines = run.stdout.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let names = lines.next().unwrap();
    let row = |cells: Vec<&str>| {
        let cells = names.iter().zip(cells);
        let numbers = cells.filter_map(|(name, cell)| Some(((*name).to_owned(), cell.parse().ok()?)));
        numbers.collect()
    };
    lines.map(row).collect()
}

#[test]
fn in_an_air_cut_nothing_pushes_the_blade() {
    let folder = on_disk(&known());
    let columns = |arguments: &[&str]| {
        let all = [&[JOB, "--emit", "dynamics", "-o", "-", "-q"], arguments].concat();
        let table = vcutc(folder.path(), &all).stdout;
        table.lines().next().unwrap().to_owned()
    };
    let (cutting, in_air) = (columns(&[]), columns(&["--air-cut", "100mm"]));
    assert!(
        cutting.contains("deviation_tip_mm") && in_air.contains("A1_weight_nm"),
        "{in_air}"
    );
    assert!(
        !in_air.contains("cutting") && !in_air.contains("deviation"),
        "{in_air}"
    );
}

fn summary(folder: &TempDir) -> Value {
    let run = vcutc(folder.path(), &["check", JOB, "--message-format", "json"]);
    let last = run
        .stderr
        .lines()
        .find(|line| line.contains("\"kind\":\"summary\""))
        .unwrap();
    serde_json::from_str(last).unwrap()
}

/// The number before these words, and the one before that.
fn before<'t>(text: &'t str, words: &str) -> (f64, &'t str) {
    let (before, _) = text.split_once(words).unwrap();
    let (rest, number) = before.rsplit_once(' ').unwrap();
    (number.parse().unwrap(), rest)
}

fn description(picture: &str) -> String {
    let document = roxmltree::Document::parse(picture).unwrap();
    let words = document
        .descendants()
        .find(|node| node.has_tag_name("desc"))
        .unwrap();
    words.text().unwrap().to_owned()
}

#[test]
fn torques_are_those_of_table_and_summary() {
    let files = known();
    let folder = on_disk(&files);
    let (rows, summary) = (table(&folder), summary(&folder));
    let outcome = in_memory(&files);
    let drawn = picture("torques", &outcome, Prefix::new("torques-"));
    let words = description(&drawn);
    for axis in summary["torques"]["axes"].as_array().unwrap() {
        let [name, limit, most] = ["name", "limit", "most"].map(|key| &axis[key]);
        let (name, limit) = (name.as_str().unwrap(), limit.as_f64().unwrap());
        let all = rows.iter().map(|row| {
            let cutting = row
                .get(&format!("{name}_cutting_nm"))
                .copied()
                .unwrap_or_default();
            row[&format!("{name}_nm")] + cutting
        });
        // Between two motions the arm stands still.
        let still = rows.iter().map(|row| row[&format!("{name}_weight_nm")]);
        let extremes = |values: &mut dyn Iterator<Item = f64>| {
            values.fold([f64::MAX, f64::MIN], |[low, high], value| {
                [low.min(value), high.max(value)]
            })
        };
        let [moving, still] = [extremes(&mut all.into_iter()), extremes(&mut still.into_iter())];
        let (_, of_axis) = words.split_once(&format!("{name}: ")).unwrap();
        let (high, rest) = before(of_axis, &format!(" % of {limit} Nm"));
        let low: f64 = rest.trim_end_matches(" to").parse().unwrap();
        let rounding = 0.051;
        let share = |torque: f64| 100.0 * torque / limit;
        assert!(low <= share(moving[0]) + rounding && low >= share(moving[0].min(still[0])) - rounding);
        assert!(high >= share(moving[1]) - rounding && high <= share(moving[1].max(still[1])) + rounding);
        let (_, bound) = of_axis.split_once("at most ").unwrap();
        let (bound, _) = bound.split_once(" %").unwrap();
        let bound: f64 = bound.parse().unwrap();
        assert!(
            (bound - share(most.as_f64().unwrap())).abs() <= 1.0,
            "{name}: {bound} {most}"
        );
        assert!(bound >= high.abs().max(low.abs()) - rounding, "{name}");
    }
    assert!(words.ends_with("Allowed are 60 % of the limits."), "{words}");
    // A2 comes near to what is allowed and to its limit, so both are drawn.
    assert!(drawn.contains(">allowed, 60 %<") && drawn.contains(">above its limit<"));
    assert!(drawn.contains(">50 %<"), "{drawn}");
    let page = page(&outcome, Further::NOTHING).unwrap();
    assert!(page.contains(&drawn));
    assert!(
        page.contains("id=\"torques-phone-title\"")
            && page.contains("Indicative: maker masses, published limits.")
    );
}

/// The bound of each cut holds for all rows of the table, and the largest ones are the figures of the summary.
#[test]
fn deviations_of_cuts_hold_the_table_and_add_up_to_the_summary() {
    let files = known();
    let folder = on_disk(&files);
    let (rows, summary) = (table(&folder), summary(&folder));
    let outcome = in_memory(&files);
    let compiled = outcome.compiled.as_ref().unwrap();
    let each = cut_by_cut(
        outcome.job.as_ref().unwrap(),
        compiled,
        compiled.dynamics.deviation.as_ref().unwrap(),
    )
    .unwrap();
    let rounding = 6e-6;
    let mut seen = 0;
    for row in rows.iter().filter(|row| row.contains_key("deviation_tip_mm")) {
        let op = row["op"] as u32;
        let cut = each.iter().find(|cut| cut.op.0 == op).unwrap();
        for place in ["deviation_tip_mm", "deviation_end_mm"] {
            assert!(
                (-cut.into_part - rounding..=cut.into_waste + rounding).contains(&row[place]),
                "{row:?} {cut:?}"
            );
        }
        seen += 1;
    }
    assert!(seen > 100, "{seen}");
    let program = compiled.program.verified().program();
    for cut in &each {
        let Action::Cut { flank, .. } = program.op(cut.op).unwrap().action else {
            panic!("{cut:?}")
        };
        let face = match flank {
            Flank::Left => Face::Left,
            Flank::Right => Face::Right,
        };
        assert_eq!(cut.face, face);
    }
    let largest = |of: fn(&vcutc::dynamics::deviation::each::CutDeviation) -> f64| {
        each.iter().map(of).fold(0.0, f64::max)
    };
    let of = &summary["deviation"]["operations"][0];
    for (side, most) in [
        ("into_waste", largest(|cut| cut.into_waste)),
        ("into_part", largest(|cut| cut.into_part)),
    ] {
        let figure = of[side]["most"].as_f64().unwrap();
        // The summary is rounded upward to a tenth of a micrometre, and both are proven to within a percent of the largest.
        assert!(
            (most - figure).abs() < 1e-4 + 0.01 * figure,
            "{side}: {most} {figure}"
        );
    }

    let drawn = picture("deviation-by-forces", &outcome, Prefix::new("by-forces-"));
    let words = description(&drawn);
    for (face, name) in [(Face::Left, "left flanks "), (Face::Right, "right flanks ")] {
        let of_face = || each.iter().filter(|cut| cut.face == face);
        let low = of_face().map(|cut| -1000.0 * cut.into_part).fold(0.0, f64::min);
        let high = of_face().map(|cut| 1000.0 * cut.into_waste).fold(0.0, f64::max);
        let range = format!("{name}{low:.1} to {high:.1} um");
        assert!(
            words.contains(&range.replace("-0.0 ", "0.0 ")),
            "{range}: {words}"
        );
    }
    assert!(
        words.contains("; limit 0.04 mm.") && drawn.contains(">limit, 0.04 mm<"),
        "{words}"
    );
    let marked = format!(
        ">{} um<",
        (of["into_waste"]["most"].as_f64().unwrap() * 1e4).round() / 10.0
    );
    assert!(drawn.contains(&marked), "{marked}");
    let page = page(&outcome, Further::NOTHING).unwrap();
    assert!(page.contains(&drawn) && page.contains("id=\"by-forces-phone-title\""));
}

/// What the control leaves of the sag counts in the picture as in the figures.
#[test]
fn sag_widens_the_deviation_of_every_cut() {
    let most = |machine: &str| {
        let files = [(JOB, text(STATED, "", machine)), ("arm.toml", arm())];
        let outcome = in_memory(&files);
        let compiled = outcome.compiled.as_ref().unwrap();
        let sag = compiled
            .dynamics
            .deviation
            .as_ref()
            .unwrap()
            .gravity
            .unwrap()
            .change;
        (
            cut_by_cut(
                outcome.job.as_ref().unwrap(),
                compiled,
                compiled.dynamics.deviation.as_ref().unwrap(),
            )
            .unwrap(),
            0.5 * sag,
        )
    };
    let ((without, sag), (with, _)) = (most("gravity = compensated"), most("gravity = uncompensated"));
    assert_eq!(without.len(), with.len());
    for (one, other) in without.iter().zip(with) {
        assert!((other.into_waste - one.into_waste - sag).abs() < 1e-9);
        assert!((other.into_part - one.into_part - sag).abs() < 1e-9);
    }
}

#[test]
fn pictures_are_of_what_is_known() {
    // Its sheet has the stiffness of the joints, but no masses.
    let robot = text(STATED, "", "").replace("arm.toml", "kuka/kr210_r2700_prime");
    for (files, drawn) in [
        (known().to_vec(), [true, true]),
        (vec![(JOB, text("", "", "")), ("arm.toml", arm())], [true, false]),
        (vec![(JOB, robot)], [false, true]),
    ] {
        let outcome = in_memory(&files);
        let page = page(&outcome, Further::NOTHING).unwrap();
        let folder = on_disk(&files);
        for ((what, id), is_drawn) in PICTURES.into_iter().zip(["torques", "by-forces"]).zip(drawn) {
            assert_eq!(page.contains(&format!("id=\"{id}-title\"")), is_drawn, "{what}");
            assert_eq!(
                page.contains(&format!("id=\"{id}-phone-title\"")),
                is_drawn,
                "{what}"
            );
            let run = vcutc(folder.path(), &["plot", JOB, "--what", what]);
            let code = if is_drawn { Some(0) } else { Some(2) };
            assert_eq!(run.code, code, "{what}: {}", run.stderr);
            if is_drawn {
                assert_eq!(run.stdout, picture(what, &outcome, Prefix::NONE));
            } else {
                assert!(run.stderr.contains("known"), "{}", run.stderr);
            }
        }
    }
}

#[test]
fn pictures_of_forces_are_as_others_are() {
    let outcome = in_memory(&known());
    for what in PICTURES {
        assert_within_its_sheet("pushed", what, &outcome);
        assert_dark("pushed", what, &outcome, &dark(".view svg"));
    }
}
