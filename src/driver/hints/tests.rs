//! Hints are tried: applied, a job takes the time that they state.

use super::*;
use crate::{Outcome, Request, SearchEffort, Typed, compile};
use vcutc_diagnostics::source::{LoadError, Loader};
use vcutc_job::sema::kind::Operations;
use vcutc_process::plan::plan;
use vcutc_remedy::fallback::NotFollowed;
use vcutc_remedy::hints::{MOST_HINTS, WORTH_IT};
use vcutc_remedy::trial;

/// Few cuts, with a `reorient` that no axis of the head follows.
const JOB: &str = r#"job "tip"
stock { size = (200 mm, 100 mm, 40 mm) }
profile { start (0 mm, 30 mm) line to (200 mm, 10 mm) }
blade knife { cutting_length = 30 mm, half_apex = 4 deg, thickness = 1 mm, edges = double }
rough vcut {
  blade = knife
  rake = 55 deg
  lattice = orthogonal
  swing = 35 deg
  limits { scallop <= 12 mm }
  feed { cut = 200 mm/s, travel = 280 mm/s, reorient = 200 deg/s }
  clearance = 20 mm
}
machine m = five_axis "gantry.toml" {
  tool = frame(x = 0 mm, y = 0 mm, z = 160 mm, a = -90 deg, b = 0 deg, c = 0 deg)
  base = frame(x = 350 mm, y = 300 mm, z = 0 mm, a = 0 deg, b = 0 deg, c = 0 deg)
  home = axes(x = 300 mm, y = 200 mm, z = -200 mm, b = 0 deg, a = 0 deg)
  ultrasonic = output(3)
}
"#;

const GANTRY: &str = include_str!("../../../examples/shop/gantry.toml");

struct One<'t>(&'t str);

impl Loader for One<'_> {
    fn load(&self, path: &str) -> Result<Vec<u8>, LoadError> {
        match path {
            "tip.vcut" => Ok(self.0.as_bytes().to_vec()),
            "gantry.toml" => Ok(GANTRY.as_bytes().to_vec()),
            _ => Err(LoadError::NotFound),
        }
    }
}

fn outcome(text: &str) -> Outcome {
    let request = Request {
        path: "tip.vcut",
        loader: &One(text),
        overrides: &[],
        machine: None,
        options: Typed::default(),
        effort: SearchEffort::Normal,
        operations: Operations(&[&vcutc_vcut::Vcut]),
        targets: &[],
    };
    compile(request, &mut |_| ()).unwrap()
}

/// The program of a slow turn, for a job whose machine did not follow the fast one that it asks for.
fn made_slow() -> (CheckedJob, Compiled) {
    let fast = outcome(JOB).job.unwrap();
    let slow = outcome(&JOB.replace("reorient = 200", "reorient = 20"));
    let mut compiled = slow.compiled.unwrap();
    let plan = plan(&fast).0.unwrap();
    let machine = plan.machine.as_ref().unwrap();
    let unreached = trial::carried_out(&plan, machine, &Wanted::ALWAYS).unwrap_err();
    let unreachable = unreached.unreachable().unwrap().clone();
    compiled.not_followed = Some(Box::new(NotFollowed { plan, unreachable }));
    (fast, compiled)
}

#[test]
fn applied_hints_take_the_time_that_they_state() {
    let (job, compiled) = made_slow();
    let now = compiled.report.times.all.total();
    let found = hints(&job, &compiled, &Wanted::ALWAYS);
    assert!(!found.is_empty() && found.len() <= MOST_HINTS);
    assert!(found.is_sorted_by(|one, other| one.saved >= other.saved));
    assert!(
        found
            .iter()
            .any(|hint| hint.fix.title.starts_with("`reorient = "))
    );
    for hint in found {
        let mut text = JOB.to_owned();
        for edit in hint.fix.edits.iter().rev() {
            text.replace_range(edit.span.bytes(), &edit.replacement);
        }
        assert_ne!(text, JOB, "{hint:?}");
        let time = outcome(&text).compiled.unwrap().report.times.all.total();
        assert_eq!(time, hint.time, "{hint:?}");
        assert!((1.0 - time / now - hint.saved).abs() < 1e-12);
        assert!(hint.saved >= WORTH_IT, "{hint:?}");
    }
}

#[test]
fn a_machine_that_follows_and_who_does_not_wait_get_no_hints() {
    let (job, mut compiled) = made_slow();
    let (wanted, interest) = Wanted::while_held();
    drop(interest);
    assert_eq!(hints(&job, &compiled, &wanted), []);
    compiled.not_followed = None;
    assert_eq!(hints(&job, &compiled, &Wanted::ALWAYS), []);
}
