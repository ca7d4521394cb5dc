//! What is said to be proven was computed: every machine of the catalogue carries out a job, and what the page of the report, the
//! warnings and the JSON list say of it is compared with the text of its sheet.

use crate::pipeline::{Files, compile, rendered};
use crate::repository::{read, root};
use std::collections::BTreeSet;
use vcutc::diagnostics::Code;
use vcutc::diagnostics::source::SourceMap;
use vcutc::driver::checks::{Check, Outcome as Came};
use vcutc::driver::{Compiled, Outcome, SearchEffort, Typed};
use vcutc::job::CheckedJob;
use vcutc::job::sema;
use vcutc::machine::catalogue;
use vcutc::motion::solve::{Changes, LEAST_CLEARANCE, solve};
use vcutc::process::lower::lower;
use vcutc::process::plan::plan;
use vcutc::report::page::{Further, page};
use vcutc::report::sheet::sheet;
use vcutc_backend_api::verify::verify;

const JOB: &str = "job.vcut";

/// A few slow cuts in front of an arm.
const SMALL: &str = r#"job "small"
stock { size = (12 mm, 10 mm, 12 mm) }
profile { start (0 mm, 6 mm) line to (12 mm, 6 mm) }
blade dagger { cutting_length = 12 mm half_apex = 7.13 deg thickness = 0 mm edges = double }
rough vcut {
  blade = dagger
  rake = 60 deg
  lattice = orthogonal
  swing = 35 deg
  overlap = 0 %
  residual = mixed
  order = point
  sequence = rows
  feed { cut = 20 mm/s, travel = 20 mm/s, reorient = 5 deg/s }
  clearance = 5 mm
}
machine cell = robot "MODEL" {
  tool = frame(x = 0 mm, y = 0 mm, z = 120 mm, a = 0 deg, b = 0 deg, c = 0 deg)
  base = frame(x = X mm, y = 0 mm, z = Z mm, a = TURN deg, b = 0 deg, c = 0 deg)
}
"#;

/// The robots of the catalogue that no trustworthy source states rates for.
const WITHOUT_RATES: [&str; 3] = [
    "kuka/kr120_r2500_pro",
    "kuka/kr210_r2700_prime",
    "kuka/kr240_r2900_ultra",
];

fn checked(text: &str) -> CheckedJob {
    let files = Files::default().with(JOB, text);
    let choices = sema::Choices {
        operations: vcutc::registry::OPERATIONS,
        overrides: &[],
        machine: None,
        options: Typed::default(),
        effort: SearchEffort::Normal,
        surfaces: None,
    };
    let (mut sources, mut diagnostics) = (SourceMap::default(), Vec::new());
    let (_, job) = sema::check(JOB, &files, choices, &mut sources, &mut diagnostics).unwrap();
    job.unwrap_or_else(|| panic!("{diagnostics:#?}"))
}

/// Whether the robot carries out the job, by reach alone: nothing is searched for where it does not.
fn is_reached(text: &str) -> bool {
    let job = checked(text);
    let Some(plan) = plan(&job).0 else {
        return false;
    };
    let program = verify(lower(&plan, &SourceMap::default())).unwrap();
    let model = &job.machine.as_ref().unwrap().model;
    solve(program, model, &LEAST_CLEARANCE, Changes::Never).is_ok()
}

/// A number of a sheet, by the text alone.
fn number(sheet: &str, key: &str) -> f64 {
    let line = sheet.lines().find_map(|line| line.strip_prefix(key)).unwrap();
    let value = line
        .trim_start_matches([' ', '='])
        .split_whitespace()
        .next()
        .unwrap();
    value.parse().unwrap()
}

/// The job where the robot carries it out.
fn job_of(name: &str) -> String {
    let reach = number(catalogue::text(name).unwrap(), "wrist_reach_mm");
    let shares = [0.5, 0.6, 0.4, 0.7];
    let heights = [0.15, 0.3, 0.0, 0.45];
    for turn in [0, 90, 180, -90] {
        for share in shares {
            for height in heights {
                let text = SMALL
                    .replace("MODEL", name)
                    .replace("X mm", &format!("{:.0} mm", reach * share))
                    .replace("Z mm", &format!("{:.0} mm", reach * height))
                    .replace("TURN", &turn.to_string());
                if is_reached(&text) {
                    return text;
                }
            }
        }
    }
    panic!("{name}: no place was found for the work");
}

fn compiled(outcome: &Outcome) -> &Compiled {
    let messages = rendered(&outcome.diagnostics, outcome);
    outcome.compiled.as_ref().unwrap_or_else(|| panic!("{messages}"))
}

/// The paragraphs of the page that say what is proven and what is not, without their tags.
struct Said {
    class: String,
    proven: String,
    not_checked: String,
}

impl Said {
    fn of(outcome: &Outcome) -> Self {
        let page = page(outcome, Further::NOTHING).unwrap();
        let paragraph = |start: &str| {
            let rest = page.split(start).nth(1).unwrap_or_else(|| panic!("no {start}"));
            rest.split("</p>").next().unwrap().to_owned()
        };
        let verdict = paragraph("<p class=\"verdict");
        let (class, proven) = verdict.split_once("\">").unwrap();
        Self {
            class: class.trim().to_owned(),
            proven: proven.to_owned(),
            not_checked: paragraph("<p class=\"unchecked\">"),
        }
    }
}

/// What the set-up sheet leaves to a person, line by line.
fn left_to_people(outcome: &Outcome) -> Vec<String> {
    let sheet = sheet(outcome, &[], None).unwrap();
    let (_, rest) = sheet.split_once("<h3>Not checked by the compiler</h3>").unwrap();
    let list = rest.split("</ul>").next().unwrap();
    let items = list.split("<li>").skip(1);
    items
        .map(|item| item.split("</li>").next().unwrap().to_owned())
        .collect()
}

/// Page and sheet come from one list: what the page does not claim, the sheet leaves to a person, and nothing else. The sheet
/// does not list forces that are not stated.
fn assert_sheet_agrees(name: &str, outcome: &Outcome) {
    let left = left_to_people(outcome);
    let figures = compiled(outcome).checks.figures();
    let open: BTreeSet<&str> = figures
        .iter()
        .filter(|figure| !figure.made && figure.reason != Some("no_forces"))
        .map(|figure| figure.check)
        .collect();
    assert_eq!(left.len(), open.len(), "{name}: {left:#?} for {open:?}");
    let said = Said::of(outcome);
    for (check, on_the_page, on_the_sheet) in [
        ("axis_rate", "speeds of", "speed limits are unknown for"),
        ("elbow_angle", "J3 - J2", "J3 - J2"),
        ("accelerations", "times with accelerations", "without speeding up"),
        ("turns", "sweep of the edge", "where the blade turns beside it"),
        (
            "singular_poses",
            "distance from singularities",
            "comes near a singularity",
        ),
        ("holder", "shank and holder", "Shank and holder"),
        ("collisions", "collisions", "clear each other"),
    ] {
        let is_open = open.contains(check);
        assert_eq!(
            said.not_checked.contains(on_the_page),
            is_open,
            "{name}, {check}: {}",
            said.not_checked
        );
        let is_left = left.iter().any(|line| line.contains(on_the_sheet));
        assert_eq!(is_left, is_open, "{name}, {check}: {left:#?}");
    }
}

fn warns(outcome: &Outcome) -> bool {
    has(outcome, Code::RatesNotChecked)
}

fn has(outcome: &Outcome, code: Code) -> bool {
    outcome
        .diagnostics
        .iter()
        .any(|diagnostic| diagnostic.code == code)
}

/// How many axes of a list were checked against a rate.
fn rates_made(outcome: &Outcome) -> usize {
    let is_rate = |check: &Check| matches!(check, Check::AxisRate(_));
    compiled(outcome)
        .checks
        .iter()
        .filter(|checked| is_rate(&checked.check) && checked.outcome == Came::Made)
        .count()
}

#[test]
fn the_page_claims_of_every_robot_what_its_sheet_lets_check() {
    let mut without = Vec::new();
    for name in catalogue::names().filter(|name| !name.starts_with("generic/")) {
        let sheet = catalogue::text(name).unwrap();
        let has_rates = sheet.lines().any(|line| line.starts_with("speeds_deg_s"));
        let outcome = compile(JOB, &Files::default().with(JOB, job_of(name)));
        let said = Said::of(&outcome);
        assert_sheet_agrees(name, &outcome);
        assert_eq!(rates_made(&outcome), if has_rates { 6 } else { 0 }, "{name}");
        assert_eq!(warns(&outcome), !has_rates, "{name}");
        assert_eq!(
            said.proven.contains("speed limits"),
            has_rates,
            "{name}: {}",
            said.proven
        );
        assert_eq!(
            said.not_checked.contains("the speeds of all axes"),
            !has_rates,
            "{name}: {}",
            said.not_checked
        );
        let is_parallelogram = sheet.contains("j2_j3_parallelogram = true");
        let is_whole = has_rates && !is_parallelogram;
        assert_eq!(has(&outcome, Code::MotionNotChecked), is_parallelogram, "{name}");
        assert_eq!(said.class.is_empty(), is_whole, "{name}: {}", said.class);
        assert_eq!(said.proven.starts_with("Proven: "), is_whole, "{name}");
        assert_eq!(said.not_checked.contains("J3 - J2"), is_parallelogram, "{name}");
        assert!(said.proven.contains("clear of singularities"), "{name}");
        let has_accelerations = sheet.lines().any(|line| line.starts_with("accelerations_deg_s2"));
        assert_eq!(
            said.not_checked.contains("times with accelerations"),
            !has_accelerations,
            "{name}"
        );
        for never in ["shank and holder of the blade", "collisions of the machine"] {
            assert!(said.not_checked.contains(never), "{name}: {}", said.not_checked);
        }
        if !has_rates {
            without.push(name);
        }
    }
    assert_eq!(without, WITHOUT_RATES);
}

#[test]
fn the_page_claims_of_every_five_axis_machine_what_its_sheet_lets_check() {
    let mut refused = Vec::new();
    for name in catalogue::names().filter(|name| name.starts_with("generic/")) {
        let sheet = catalogue::text(name).unwrap();
        let axes = sheet.matches("\n[axis.").count();
        let rates = sheet.lines().filter(|line| line.starts_with("rate_")).count();
        let job = read("tests/process/err/VC0516_no_spindle.vcut")
            .replace("generic/head_head_ac", name)
            .replace("reorient = 60 deg/s", "reorient = 40 deg/s");
        let outcome = compile(JOB, &Files::default().with(JOB, job));
        if outcome.compiled.is_none() {
            // Without a spindle that turns the blade it cannot hold a V-cut.
            assert!(has(&outcome, Code::PostureNeedsAxis), "{name}");
            refused.push(name);
            continue;
        }
        let said = Said::of(&outcome);
        assert_sheet_agrees(name, &outcome);
        assert_eq!(
            (rates_made(&outcome), warns(&outcome)),
            (rates, rates < axes),
            "{name}"
        );
        assert_eq!(
            said.proven.contains("the position and speed limits"),
            rates == axes,
            "{name}"
        );
        assert!(!said.proven.contains("singular"), "{name}: {}", said.proven);
        assert!(!said.not_checked.contains("the sweep of the edge"), "{name}");
        let turns = compiled(&outcome)
            .checks
            .iter()
            .find(|checked| checked.check == Check::Turns);
        assert_eq!(turns.map(|turns| turns.outcome), Some(Came::Made), "{name}");
        assert_eq!(said.class == "in-part", rates < axes, "{name}");
        assert!(!has(&outcome, Code::MotionNotChecked), "{name}");
    }
    assert_eq!(
        refused,
        [
            "generic/head_head_ac",
            "generic/head_head_bc",
            "generic/table_table_ac"
        ]
    );
}

/// A sheet that leaves out the rate of one axis is named with that axis alone.
#[test]
fn an_axis_without_a_rate_is_named() {
    let sheet = catalogue::text("generic/head_head_ba").unwrap();
    let mut is_b = false;
    let lines = sheet.lines().filter(|line| {
        if line.starts_with('[') {
            is_b = *line == "[axis.b]";
        }
        !(is_b && line.starts_with("rate_"))
    });
    let sheet = lines.collect::<Vec<_>>().join("\n");
    let job = read("tests/process/err/VC0516_no_spindle.vcut")
        .replace("generic/head_head_ac", "mill.toml")
        .replace("reorient = 60 deg/s", "reorient = 40 deg/s");
    let outcome = compile(JOB, &Files::default().with(JOB, job).with("mill.toml", sheet));
    let said = Said::of(&outcome);
    assert!(
        said.proven.contains("the speed limits of X, Y, Z and A"),
        "{}",
        said.proven
    );
    assert!(
        said.not_checked
            .contains("the speeds of B, torques of the axes (not known"),
        "{}",
        said.not_checked
    );
    let messages = rendered(&outcome.diagnostics, &outcome);
    assert!(
        messages.contains("warning[VC0517]: the speed limit of B is not known"),
        "{messages}"
    );
}

#[test]
fn without_a_machine_nothing_is_claimed_of_one() {
    let (text, _) = SMALL.split_once("machine").unwrap();
    let outcome = compile(JOB, &Files::default().with(JOB, text));
    let said = Said::of(&outcome);
    assert!(!said.proven.contains("the machine"), "{}", said.proven);
    assert!(
        said.not_checked.contains("reach and the limits of axes"),
        "{}",
        said.not_checked
    );
    assert!(!warns(&outcome));
}

/// The parts into which a limit on scallop goes add up to what stays, and are those of the job: the allowance as written, the
/// standoff over the sine of the swing.
#[test]
fn a_limit_that_binds_says_where_it_goes() {
    let outcome = compile("spoiler_clarky.vcut", &Files::of(root().join("examples")));
    let compiled = compiled(&outcome);
    let line = |name: &str| {
        let lines = compiled.summary.iter();
        let mut found = lines.filter_map(|line| line.trim_start().strip_prefix(name));
        found.next().unwrap_or_else(|| panic!("no {name}")).trim()
    };
    let chosen = |name: &str| {
        let rest = line("auto").split(&format!("{name} = ")).nth(1).unwrap();
        rest.split(' ').next().unwrap().parse::<f64>().unwrap()
    };
    let (_, spent) = line("bound by").split_once("; scallop ").unwrap();
    let (height, parts) = spent.split_once(" of 10 mm = ").unwrap();
    let parts: Vec<(&str, f64)> = parts
        .split(" + ")
        .map(|part| part.split_once(' ').unwrap())
        .map(|(name, value)| (name, value.parse().unwrap()))
        .collect();
    let [("allowance", allowance), ("standoff", standoff), ("cusp", cusp)] = parts[..] else {
        panic!("{parts:?}");
    };
    let rise = chosen("standoff") / chosen("swing").to_radians().sin();
    assert!((standoff - rise).abs() < 0.005 + 1e-9, "{standoff} {rise}");
    assert!((allowance - 0.5).abs() < 1e-9, "{allowance}");
    let height: f64 = height.parse().unwrap();
    assert!((allowance + standoff + cusp - height).abs() < 1e-9, "{spent}");
    assert!((height - compiled.numbers.scallop_mm).abs() < 0.006, "{height}");
}

/// The holder counts as checked where every blade states its body, and nowhere else.
#[test]
fn a_body_that_is_stated_is_checked() {
    let files = Files::of(root().join("examples"));
    let stated = read("examples/deep_saddle.vcut");
    let lines = stated
        .lines()
        .filter(|line| !line.trim_start().starts_with("body "));
    let bare = lines.collect::<Vec<_>>().join("\n");
    for (text, came) in [(stated.as_str(), "made"), (bare.as_str(), "no_body")] {
        let outcome = compile(JOB, &files.clone().with(JOB, text));
        let compiled = compiled(&outcome);
        let figures = compiled.checks.figures();
        let holder = figures.iter().find(|figure| figure.check == "holder").unwrap();
        assert_eq!(holder.reason.unwrap_or("made"), came);
        let is_reported = compiled
            .summary
            .iter()
            .any(|line| line.trim_start().starts_with("body "));
        assert_eq!(is_reported, came == "made");
        assert_eq!(
            compiled.checks.proven().contains("the body of the blade"),
            came == "made"
        );
    }
}
