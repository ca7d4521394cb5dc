//! Redundant Vs: skipped, kept, and written down.

use crate::pipeline::{Files, compile_on, rendered};
use crate::repository::root;
use vcutc::driver::Outcome;
use vcutc::vcut::asked::Lattice;
use vcutc::vcut::plan::PlannedVcut;

const JOB: &str = "bowl.vcut";

/// A hollow of which little may stay, with everything open but for this.
fn job(more: &str) -> String {
    format!(
        "job \"bowl\"\n\nstock {{ size = (85 mm, 120 mm, 50 mm) }}\n\n\
         profile {{ z(x) = 14 mm + (x - 42.5 mm)^2 / 120 mm }}\n\n\
         blade dagger {{ cutting_length = 14 mm, half_apex = 7.13 deg, thickness = 0.5 mm, edges = double }}\n\n\
         rough vcut {{\n  blade = dagger\n  rake = 60 deg\n  {more}\n  \
         feed {{ cut = 200 mm/s, travel = 200 mm/s, reorient = 60 deg/s }}\n  clearance = 10 mm\n}}\n"
    )
}

/// The limits of most of these jobs.
const LIMITS: &str = "limits { scallop <= 2 mm, swing <= 45 deg }";

fn compiled(more: &str) -> Outcome {
    let outcome = compile_on(None, JOB, &Files::of(root()).with(JOB, job(more)));
    assert!(
        outcome.compiled.is_some(),
        "{}",
        rendered(&outcome.diagnostics, &outcome)
    );
    outcome
}

fn planned(outcome: &Outcome) -> &PlannedVcut {
    PlannedVcut::of(&*outcome.plan.as_ref().unwrap().operations[0]).unwrap()
}

/// Of its moves, in s.
fn time(outcome: &Outcome) -> f64 {
    let compiled = outcome.compiled.as_ref().unwrap();
    compiled.report.times.all.total().to_s()
}

fn line(outcome: &Outcome, name: &str) -> Option<String> {
    let summary = &outcome.compiled.as_ref().unwrap().summary;
    let line = summary.iter().find(|line| line.trim_start().starts_with(name))?;
    Some(line.trim_start()[name.len()..].trim_start().to_owned())
}

#[test]
fn what_is_left_open_is_faster_without_them() {
    let [open, kept] = [LIMITS.to_owned(), format!("{LIMITS} redundant = keep")].map(|more| compiled(&more));
    let (skipped, all) = (planned(&open).skipped, planned(&open).cuts.len());
    assert!(skipped > 0 && planned(&kept).skipped == 0);
    assert!(
        time(&open) < 0.95 * time(&kept),
        "{} s, {} s",
        time(&open),
        time(&kept)
    );
    let words = format!("{skipped} of {} Vs, which are redundant", skipped + all);
    assert_eq!(line(&open, "skipped"), Some(words));
    assert_eq!(line(&kept, "skipped"), None);
    let report = &open.compiled.as_ref().unwrap().report;
    assert_eq!(report.cuts(), all);
    assert!(report.scallop.height.to_mm() <= 2.0 + 1e-3);
}

/// What was chosen gives the same Vs when a job states it.
#[test]
fn a_choice_that_is_written_down_comes_out_alike() {
    let open = compiled(LIMITS);
    let vcut = planned(&open);
    let found = &vcut.parameters;
    assert_eq!(found.lattice, Lattice::Fitted);
    let written = format!(
        "{LIMITS} lattice = {} swing = {} deg layer = {} mm step = {} mm order = {} sequence = {} redundant = {}",
        found.lattice.word(),
        found.swing.to_deg(),
        found.layer.to_mm(),
        found.step.to_mm(),
        vcut.order.word(),
        vcut.sequence.word(),
        vcut.redundant().word(),
    );
    let written = compiled(&written);
    assert_eq!(planned(&written).cuts, vcut.cuts);
    assert!((time(&written) - time(&open)).abs() < 1e-6);
}

#[test]
fn distances_that_the_job_bounds_are_kept() {
    for bounded in [
        "limits { scallop <= 2 mm, swing <= 45 deg, step <= 12 mm }",
        "limits { scallop <= 2 mm, swing <= 45 deg, layer <= 9 mm }",
        "limits { scallop <= 2 mm } swing = 45 deg layer = 4 mm",
        "limits { scallop <= 2 mm, swing <= 45 deg } avoid = swing",
    ] {
        assert_eq!(planned(&compiled(bounded)).skipped, 0, "{bounded}");
    }
    let asked = compiled("limits { scallop <= 2 mm } swing = 45 deg layer = 4 mm redundant = skip");
    assert!(planned(&asked).skipped > 0);
}

/// Neither takes more cuts than the other where it is to take few.
#[test]
fn the_fewest_cuts_are_no_more_than_the_fastest_plan_has() {
    let [fast, few] = [LIMITS.to_owned(), format!("{LIMITS} objective = cuts")].map(|more| compiled(&more));
    let [fast, few] = [&fast, &few].map(|outcome| planned(outcome).cuts.len());
    assert!(few <= fast, "{few} of {fast}");
}

#[test]
fn given_tips_are_all_cut() {
    let tips = "swing = 40 deg tips (20 mm, 45 mm) (60 mm, 45 mm)";
    assert_eq!(planned(&compiled(tips)).skipped, 0);
    let text = job(&format!("{tips} redundant = skip"));
    let outcome = compile_on(None, JOB, &Files::of(root()).with(JOB, text));
    let messages = rendered(&outcome.diagnostics, &outcome);
    assert!(
        messages.contains("VC1001") && messages.contains("`redundant` does not go with given tips"),
        "{messages}"
    );
}
