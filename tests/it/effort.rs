//! `--effort high`: more plans, none slower, and a program that says so.

use crate::pipeline::{Files, rendered};
use crate::repository::root;
use vcutc::driver::{self, Outcome, Request, SearchEffort, Typed};
use vcutc::registry;

fn compiled(effort: SearchEffort, path: &str, files: &Files) -> Outcome {
    let request = Request {
        path,
        loader: files,
        overrides: &[],
        machine: None,
        options: Typed::default(),
        effort,
        operations: registry::OPERATIONS,
        targets: &registry::backends(),
    };
    let outcome = driver::compile(request, &mut |_| {}).unwrap();
    assert!(
        outcome.compiled.is_some(),
        "{}",
        rendered(&outcome.diagnostics, &outcome)
    );
    outcome
}

/// Of its moves, in s.
fn time(outcome: &Outcome) -> f64 {
    let compiled = outcome.compiled.as_ref().unwrap();
    compiled.report.times.all.total().to_s()
}

/// A hump of which little may stay.
fn job(height: u32, scallop: &str) -> String {
    format!(
        "job \"hump\"\n\nstock {{ size = (120 mm, 60 mm, 55 mm) }}\n\n\
         profile {{ z(x) = {height} mm - (x - 60 mm)^2 / 150 mm }}\n\n\
         blade dagger {{ cutting_length = 22 mm, half_apex = 7.13 deg, thickness = 0.5 mm, edges = double }}\n\n\
         rough vcut {{\n  blade = dagger\n  rake = 60 deg\n  limits {{ scallop <= {scallop} }}\n  \
         feed {{ cut = 100 mm/s, travel = 200 mm/s, reorient = 90 deg/s }}\n  clearance = 10 mm\n}}\n"
    )
}

#[test]
fn more_plans_find_no_slower_program() {
    let mut gained = 0.0;
    for (height, scallop) in [(30, "3 mm"), (34, "4.5 mm"), (38, "2.2 mm"), (41, "6 mm")] {
        let files = Files::of(root()).with("hump.vcut", job(height, scallop));
        let [normal, high] = [SearchEffort::Normal, SearchEffort::High]
            .map(|effort| time(&compiled(effort, "hump.vcut", &files)));
        assert!(high <= normal, "{height} mm, {scallop}: {high} s, {normal} s");
        gained += normal - high;
    }
    assert!(gained > 0.0);
}

/// A tighter limit, and the fewest cuts, are asked for as well: neither of them is faster than what the job is cut with.
#[test]
fn no_other_aim_is_faster_with_more_effort() {
    // A ridge for which the usual search for time is beaten by the one for cuts.
    let ridge = |limit: &str, objective: &str| {
        format!(
            "job \"ridge\"\n\nstock {{ size = (301 mm, 133 mm, 61 mm) }}\n\n\
             profile {{ z(x) = 30 mm - 0.00101544 / 1 mm * (x - 150.5 mm)^2 }}\n\n\
             blade dagger {{ cutting_length = 20 mm, half_apex = 5.6 deg, thickness = 1.6 mm, edges = double }}\n\n\
             rough vcut {{\n  blade = dagger\n  rake = 64 deg\n  allowance = 1 mm\n  objective = {objective}\n  \
             limits {{ scallop <= {limit} }}\n  \
             feed {{ cut = 246 mm/s, travel = 342 mm/s, reorient = 38 deg/s }}\n  clearance = 11 mm\n}}\n"
        )
    };
    let of = |effort, limit, objective| {
        let files = Files::of(root()).with("ridge.vcut", ridge(limit, objective));
        time(&compiled(effort, "ridge.vcut", &files))
    };
    let usual = of(SearchEffort::Normal, "5.7 mm", "time");
    let high = of(SearchEffort::High, "5.7 mm", "time");
    let others = [("5.13 mm", "time"), ("5.7 mm", "cuts")];
    let others = others.map(|(limit, objective)| of(SearchEffort::Normal, limit, objective));
    assert!(
        others.iter().any(|other| *other < 0.99 * usual),
        "{others:?}, {usual} s"
    );
    assert!(others.iter().all(|other| high <= *other), "{others:?}, {high} s");
}

/// What is given leaves nothing to search for; the hash in a program's head says how it was made all the same.
#[test]
fn a_job_that_leaves_nothing_open_stays_as_it_is() {
    let files = Files::of(root().join("examples"));
    let [normal, high] =
        [SearchEffort::Normal, SearchEffort::High].map(|effort| compiled(effort, "block_cui.vcut", &files));
    let report = |outcome: &Outcome| outcome.compiled.as_ref().unwrap().report.clone();
    assert_eq!(report(&normal).cuts(), report(&high).cuts());
    assert!((time(&normal) - time(&high)).abs() < 1e-9);
    let hash = |outcome: &Outcome| vcutc::syntax::fingerprint::of_job(&outcome.sources);
    assert_ne!(hash(&normal), hash(&high));
}
