//! `reorient` as the highest rate of turning: programs whose axes are too slow for it turn the blade more slowly, and plans are
//! compared on the machine.

use crate::pipeline::{Files, compile, rendered};
use vcutc::driver::{Compiled, Outcome};
use vcutc::motion::rig::Rig;
use vcutc::motion::rigs::Rigs;
use vcutc_backend_api::ir::{Action, Program};
use vcutc_backend_api::motion::Motion;
use vcutc_backend_api::segments::{LinearSegment, Path};
use vcutc_backend_api::units::AngularSpeed;

const JOB: &str = "job.vcut";

/// Shares of `reorient`, as `docs/reach.md` lists them.
const SHARES: [f64; 9] = [1.0, 0.9, 0.8, 0.7, 0.6, 0.5, 0.4, 0.32, 0.25];

/// A hollow in front of an arm, at a height of the base, cut with a swing.
fn text(swing: &str, reorient: u32, height: u32) -> String {
    format!(
        r#"job "hollow"
stock {{ size = (160 mm, 120 mm, 45 mm) }}
profile {{ z(x) = 12 mm + (x - 80 mm)^2 / 400 mm }}
blade k {{ cutting_length = 20 mm, half_apex = 7 deg, thickness = 0 mm, edges = double }}
rough vcut {{
  blade = k
  rake = 60 deg
  swing = {swing}
  limits {{ scallop <= 5 mm }}
  feed {{ cut = 150 mm/s, travel = 250 mm/s, reorient = {reorient} deg/s }}
  clearance = 15 mm
}}
machine cell = robot "kuka/kr210_r3100_ultra" {{
  tool = frame(x = 0 mm, y = 0 mm, z = 310 mm, a = 0 deg, b = 0 deg, c = 0 deg)
  base = frame(x = 1700 mm, y = -300 mm, z = {height} mm, a = 90 deg, b = 0 deg, c = 0 deg)
  home = joints(0 deg, -90 deg, 90 deg, 0 deg, 45 deg, 0 deg)
}}
"#
    )
}

fn hollow(swing: &str, reorient: u32, height: u32) -> Files {
    Files::default().with(JOB, text(swing, reorient, height))
}

fn made(outcome: &Outcome) -> &Compiled {
    let messages = rendered(&outcome.diagnostics, outcome);
    outcome.compiled.as_ref().unwrap_or_else(|| panic!("{messages}"))
}

fn seconds(outcome: &Outcome) -> f64 {
    made(outcome).report.times.all.total().to_s()
}

/// The highest share of its rate that an axis uses on a straight motion, by inverse kinematics at many places.
fn fastest_share(program: &Program, line: &LinearSegment, motion: &Motion, op: usize, rig: &Rig<'_>) -> f64 {
    const PLACES: u32 = 1500;
    let branch = motion
        .stretches
        .iter()
        .rfind(|stretch| stretch.from.0 as usize <= op)
        .unwrap()
        .branch;
    let mut before = motion.ends[op - 1].0;
    let time = line.duration().to_s() / f64::from(PLACES);
    let mut fastest = 0.0_f64;
    for place in 1..=PLACES {
        let frame = line
            .frame_at(program, f64::from(place) / f64::from(PLACES))
            .unwrap();
        let flange = rig.flange_in_root(&frame.into());
        let here = rig.mechanism.on_branch(&flange, branch, &before).unwrap();
        for ((axis, from), to) in rig.axes.iter().zip(before).zip(here) {
            fastest = fastest.max((to - from).abs() / time / axis.rate.unwrap());
        }
        before = here;
    }
    fastest
}

/// The same motion with its blade turned at another rate.
fn at(line: &LinearSegment, rate: f64) -> LinearSegment {
    LinearSegment {
        rate: Some(AngularSpeed::deg_per_s(rate)),
        ..*line
    }
}

#[test]
fn turns_are_as_fast_as_axes_follow_and_no_faster() {
    let asked = 140.0;
    let outcome = compile(JOB, &hollow("42 deg", 140, 850));
    let reached = made(&outcome).program.reached().unwrap();
    let (program, motion) = (reached.program.program(), reached.program.motion());
    let model = &outcome.job.as_ref().unwrap().machine.as_ref().unwrap().model;
    let rigs = Rigs::of(model, program.cell.as_ref().unwrap(), program);
    let rates = SHARES.map(|share| {
        if share < 1.0 {
            (asked * share).floor()
        } else {
            asked
        }
    });
    let (mut slower, mut turning) = (0, 0);
    for segment in program.segments() {
        let (Path::Linear(line), Action::Travel { .. } | Action::Turn { .. }) =
            (segment.path(), segment.op.action)
        else {
            continue;
        };
        if !line.turns() {
            continue;
        }
        turning += 1;
        let rate = line.rate.unwrap().to_deg_per_s();
        let place = rates
            .iter()
            .position(|known| (known - rate).abs() < 1e-9)
            .expect("one of the rates");
        let op = segment.id.0 as usize;
        let share = fastest_share(program, &line, motion, op, rigs.during(segment.id));
        assert!(share <= 1.0, "op {op} needs {share} of a rate at {rate} deg/s");
        if place > 0 {
            slower += 1;
            let next = at(&line, rates[place - 1]);
            let faster = share * (line.duration() / next.duration());
            assert!(
                faster > 0.99,
                "op {op} could turn at {} deg/s: {faster}",
                rates[place - 1]
            );
        }
    }
    let figures = made(&outcome).figures.as_ref().unwrap().slower.clone().unwrap();
    assert_eq!((figures.motions, figures.of), (slower, turning));
    assert!(slower > 0 && slower < turning, "{slower} of {turning}");
    let line = made(&outcome)
        .summary
        .iter()
        .find(|line| line.starts_with("  turns "))
        .unwrap();
    assert!(
        line.contains(&format!(
            "{slower} of {turning} motions that turn the blade are slower than `reorient`"
        )),
        "{line}"
    );
    assert!(line.contains(&format!("{} would need ", figures.axis)), "{line}");
}

#[test]
fn turns_that_axes_follow_keep_their_rate() {
    let outcome = compile(JOB, &hollow("42 deg", 40, 850));
    assert_eq!(made(&outcome).figures.as_ref().unwrap().slower, None);
    assert!(
        !made(&outcome)
            .summary
            .iter()
            .any(|line| line.starts_with("  turns "))
    );
}

/// A limit on the time holds with slower turns too: what keeps it only with faster ones is refused, or planned otherwise.
#[test]
fn limits_on_time_hold_with_slower_turns() {
    let files = |limit: &str| {
        let text = text("42 deg", 140, 850);
        Files::default().with(
            JOB,
            text.replace("scallop <= 5 mm", &format!("scallop <= 5 mm{limit}")),
        )
    };
    let usual = seconds(&compile(JOB, &files("")));
    for share in [0.9, 0.95, 0.99, 1.01] {
        let limit = usual * share;
        let outcome = compile(JOB, &files(&format!(", time <= {limit:.3} s")));
        if outcome.compiled.is_some() {
            // Axis moves from home and back are not those of an operation.
            let taken = made(&outcome).report.times.all.total() - made(&outcome).report.times.all.axes;
            assert!(taken.to_s() <= limit, "{taken:?} of {limit} s");
        }
        assert!(share < 1.0 || outcome.compiled.is_some());
    }
}

/// On a base where the wrist is nearly straight at usual swings, what the compiler chooses takes no longer than what it makes of
/// any swing that is given.
#[test]
fn a_swing_that_is_chosen_on_the_machine_is_no_slower_than_those_given_by_hand() {
    for height in [500, 850, 1200] {
        let chosen = seconds(&compile(JOB, &hollow("auto", 140, height)));
        for swing in [16, 22, 28, 34, 40, 46] {
            let given = compile(JOB, &hollow(&format!("{swing} deg"), 140, height));
            if given.compiled.is_some() {
                let given = seconds(&given);
                assert!(
                    chosen <= given * 1.03,
                    "z {height} mm: {chosen} s, with {swing} deg {given} s"
                );
            }
        }
    }
}
