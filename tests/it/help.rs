//! Refusals at once, and help that works: what is offered for a job is made in its text, and the text compiled again.

use crate::pipeline::{Files, compile, fixed, numbers, rendered};
use vcutc::cancellation::Wanted;
use vcutc::diagnostics::Diagnostic;
use vcutc::diagnostics::source::SourceMap;
use vcutc::driver::memory::Memory;
use vcutc::driver::{self, Outcome, Patience, Request, Run, SearchEffort, Stage, Typed};
use vcutc::registry;

const JOB: &str = "job.vcut";

/// A job of the tests that its machine is too slow for.
const TOO_FAST: &str = include_str!("../process/err/VC0512_reorienting_too_fast.vcut");

/// Notes what is reported at once, and wants no more or all there is.
struct Noting {
    wanted: Wanted,
    at_once: Vec<Diagnostic>,
}

impl Patience for Noting {
    fn refused(&mut self, diagnostics: &[Diagnostic], sources: &SourceMap) -> Wanted {
        assert!(sources.iter().next().is_some(), "places point into texts");
        self.at_once = diagnostics.to_vec();
        self.wanted.clone()
    }

    fn cut_short(&self) -> Option<String> {
        Some("that was all the time".to_owned())
    }

    fn slowed(&mut self) -> Wanted {
        self.wanted.clone()
    }
}

pub(crate) fn patiently(text: &str, wanted: Wanted) -> (Outcome, Vec<Diagnostic>, Vec<Stage>) {
    let files = Files::default().with(JOB, text);
    let request = Request {
        path: JOB,
        loader: &files,
        overrides: &[],
        machine: None,
        options: Typed::default(),
        effort: SearchEffort::Normal,
        operations: vcutc::registry::OPERATIONS,
        targets: &registry::backends(),
    };
    let mut noting = Noting {
        wanted,
        at_once: Vec::new(),
    };
    let mut stages = Vec::new();
    let mut enter = |stage| stages.push(stage);
    let run = Run {
        memory: &mut Memory::none(),
        wanted: &Wanted::ALWAYS,
        patience: &mut noting,
    };
    let outcome = driver::compile_in(run, request, &mut enter);
    (outcome.unwrap(), noting.at_once, stages)
}

#[test]
fn a_refusal_is_reported_before_help_is_looked_for() {
    let (outcome, at_once, stages) = patiently(TOO_FAST, Wanted::ALWAYS);
    assert_eq!(numbers(&at_once), ["VC0512"]);
    assert!(at_once[0].fixes.is_empty(), "{at_once:#?}");
    assert!(
        !at_once[0].help.is_empty(),
        "something to do is said all the same"
    );
    assert_eq!(stages.last(), Some(&Stage::Helping));
    assert_eq!(numbers(&outcome.diagnostics), ["VC0512"]);
    assert!(
        !outcome.diagnostics[0].fixes.is_empty(),
        "{:#?}",
        outcome.diagnostics
    );
    assert_eq!(outcome.diagnostics[0].message, at_once[0].message);
}

#[test]
fn without_help_the_refusal_says_what_was_cut_short() {
    let (outcome, at_once, _) = patiently(TOO_FAST, Wanted::never());
    assert_eq!(numbers(&outcome.diagnostics), ["VC0512"]);
    let [only] = &outcome.diagnostics[..] else {
        panic!()
    };
    assert!(only.fixes.is_empty());
    assert_eq!(
        only.notes.last().map(String::as_str),
        Some("that was all the time")
    );
    assert_eq!(only.primary, at_once[0].primary);
}

/// Numbers between 0 and 1 that look random and are the same in every run.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        // Constants of Knuth's MMIX generator; its upper bits are the good ones.
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn between(&mut self, least: f64, most: f64) -> f64 {
        ((least + (most - least) * self.next()) * 10.0).round() / 10.0
    }
}

/// A small job with a robot that is likely to be refused: for its layer, its step, its limits, its speeds or its place.
fn likely_refused(numbers: &mut Numbers) -> String {
    let (width, height) = (numbers.between(40.0, 120.0), numbers.between(20.0, 50.0));
    let (left, right) = (
        numbers.between(2.0, height * 0.7),
        numbers.between(2.0, height * 0.7),
    );
    let edge = numbers.between(8.0, 30.0);
    let fault = numbers.next();
    let mut fields = "swing = auto".to_owned();
    let (mut scallop, mut cut, mut reorient, mut far) = (8.0, 150.0, 45.0, 0.0);
    match fault {
        few if few < 0.25 => {
            let (swing, layer) = (numbers.between(20.0, 45.0), numbers.between(10.0, 40.0));
            fields = format!("swing = {swing} deg layer = {layer} mm");
        }
        few if few < 0.45 => {
            let (swing, step) = (numbers.between(20.0, 45.0), numbers.between(10.0, 40.0));
            fields = format!("swing = {swing} deg step = {step} mm");
        }
        few if few < 0.65 => scallop = numbers.between(0.6, 3.0),
        few if few < 0.8 => reorient = numbers.between(150.0, 400.0),
        few if few < 0.9 => cut = numbers.between(2500.0, 5000.0),
        _ => far = numbers.between(300.0, 1200.0),
    }
    format!(
        r#"job "drawn"
stock {{ size = ({width} mm, 40 mm, {height} mm) }}
profile {{ start (0 mm, {left} mm) line to ({width} mm, {right} mm) }}
blade knife {{ cutting_length = {edge} mm half_apex = 7 deg thickness = 0 mm edges = double }}
rough vcut {{
  blade = knife
  rake = 55 deg
  {fields}
  limits {{ swing <= 45 deg, scallop <= {scallop} mm }}
  feed {{ cut = {cut} mm/s, travel = 300 mm/s, reorient = {reorient} deg/s }}
  clearance = 10 mm
}}
machine cell = robot "kuka/kr210_r3100_ultra" {{
  tool = frame(x = 0 mm, y = 0 mm, z = 310 mm, a = 0 deg, b = 0 deg, c = 0 deg)
  base = frame(x = {} mm, y = -100 mm, z = 650 mm, a = 90 deg, b = 0 deg, c = 0 deg)
  home = joints(0 deg, -90 deg, 90 deg, 0 deg, 45 deg, 0 deg)
  ultrasonic = output(7)
  krl {{ approximation = 2 mm }}
}}
"#,
        1700.0 + far
    )
}

/// Every offer, made in the text, leaves nothing wrong: neither with the cuts, nor for the machine, nor for its target. More
/// jobs are drawn with `VCUTC_DRAWN_JOBS=300`.
#[test]
fn what_is_offered_for_drawn_jobs_works_on_their_machine() {
    let drawn = std::env::var("VCUTC_DRAWN_JOBS").ok();
    let drawn: usize = drawn.map_or(10, |count| count.parse().unwrap());
    let mut numbers_drawn = Numbers(20_240_611);
    let (mut refused, mut offered) = (0, 0);
    for index in 0..drawn {
        let text = likely_refused(&mut numbers_drawn);
        let files = Files::default().with(JOB, text.clone());
        let outcome = compile(JOB, &files);
        refused += usize::from(outcome.compiled.is_none());
        for diagnostic in &outcome.diagnostics {
            for fix in &diagnostic.fixes {
                offered += 1;
                let after = compile(JOB, &fixed(&files, &outcome, fix));
                assert!(
                    after.compiled.is_some(),
                    "job {index}: {}\n{text}\n{}",
                    fix.title,
                    rendered(&after.diagnostics, &after)
                );
            }
        }
    }
    assert!(
        refused * 3 >= drawn,
        "{refused} of {drawn} are refused: nothing is tested"
    );
    assert!(offered * 2 >= refused, "{offered} offers for {refused} refusals");
}

/// What the target of the machine's own block does not take is known before anything is written, with a speed that it takes.
#[test]
fn what_the_target_of_the_machine_refuses_is_refused_by_a_check() {
    let text = include_str!("../process/err/VC0606_too_fast.vcut").replace(
        "  ready      = after(0.8 s)",
        "  ready      = after(0.8 s)\n  krl { approximation = 1 mm }",
    );
    let files = Files::default().with(JOB, text);
    let outcome = compile(JOB, &files);
    assert_eq!(numbers(&outcome.diagnostics), ["VC0606"]);
    assert!(outcome.compiled.is_none());
    let [fix] = &outcome.diagnostics[0].fixes[..] else {
        panic!("{}", rendered(&outcome.diagnostics, &outcome));
    };
    let after = compile(JOB, &fixed(&files, &outcome, fix));
    assert!(
        after.compiled.is_some(),
        "{}: {}",
        fix.title,
        rendered(&after.diagnostics, &after)
    );
}

/// A job that a robot follows only with axis moves in the place of nearly all travels.
const MANY_AXIS_MOVES: &str = r#"job "many"
stock { size = (120 mm, 60 mm, 45 mm) }
profile { start (0 mm, 17 mm) line to (120 mm, 20 mm) }
blade knife { cutting_length = 29 mm half_apex = 6.02 deg thickness = 1.25 mm edges = double }
rough vcut {
  blade = knife
  rake = 50.6 deg
  lattice = orthogonal
  swing = 29.07 deg
  layer = 9.52 mm
  step = 8.76 mm
  order = point
  direction = forward
  feed { cut = 272 mm/s, travel = 316 mm/s, reorient = 56 deg/s }
  clearance = 12 mm
}
machine m = robot "abb/irb6700_155_285" {
  tool = frame(x = 0 mm, y = 0 mm, z = 310 mm, a = 0 deg, b = 0 deg, c = 0 deg)
  base = frame(x = 1618 mm, y = -325.4 mm, z = 637.2 mm, a = 90 deg, b = 0 deg, c = 0 deg)
  home = joints(0 deg, 0 deg, 0 deg, 0 deg, 45 deg, 0 deg)
}
"#;

#[test]
fn many_moves_of_all_axes_are_warned_of() {
    let outcome = compile(JOB, &Files::default().with(JOB, MANY_AXIS_MOVES));
    assert_eq!(
        numbers(&outcome.diagnostics),
        ["VC0527"],
        "{}",
        rendered(&outcome.diagnostics, &outcome)
    );
    let compiled = outcome.compiled.as_ref().expect("it is a warning");
    let changes = compiled.program.reached().unwrap().report.changes.len();
    assert!(changes > 10, "{changes}");
    let message = &outcome.diagnostics[0].message;
    assert!(message.contains(&format!("{changes} of ")), "{message}");
}
