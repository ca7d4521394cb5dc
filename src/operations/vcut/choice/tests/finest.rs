//! The least scallop and the least edge in use, compared with what the least time comes to under limits on them.

use super::{Open, gentle, hill, planned_and_proven, vcut};
use crate::asked::Objective;
use crate::plan::optimum::Bound;
use crate::samples::operation;
use vcutc_backend_api::units::{Duration, Length};
use vcutc_job::{CheckedJob, Sourced};
use vcutc_simulation::prove::Findings;

/// How much more than what the least time shows to be possible may stay, or be used: it is a search, and how many Vs are redundant
/// changes in jumps with the parameters. 16 % is the most that is seen here.
const TOLERANCE: f64 = 1.2;

/// A job made fast under limits on scallop and edge: its time, what it leaves and what it uses.
fn fast(open: &Open, edge: Option<f64>) -> [f64; 3] {
    let mut job = open.job();
    operation(&mut job).limits.edge = edge.map(|edge| Sourced {
        value: Length::mm(edge),
        span: None,
    });
    figures(&job)
}

fn figures(job: &CheckedJob) -> [f64; 3] {
    let (_, proven) = planned_and_proven(job).unwrap();
    assert_eq!(proven.findings, Findings::default());
    let report = proven.report;
    [
        report.times.all.total().to_s(),
        report.scallop.height.to_mm(),
        report.longest_edge.to_mm(),
    ]
}

/// The job with another objective, within a time.
fn within(open: &Open, objective: Objective, seconds: f64) -> CheckedJob {
    let mut job = open.job();
    let asked = operation(&mut job);
    asked.limits.scallop = None;
    asked.objective.value = objective;
    asked.limits.time = Some(Sourced {
        value: Duration::s(seconds),
        span: None,
    });
    job
}

#[test]
fn no_more_stays_than_the_least_time_leaves_in_as_much() {
    for (part, scallop) in [
        (hill as fn(f64) -> f64, 4.0),
        (hill, 1.5),
        (gentle, 3.0),
        (gentle, 1.0),
    ] {
        let (swing, scallop) = (Some(50.0), Some(scallop));
        let open = Open { part, swing, scallop };
        let [time, left, _] = fast(&open, None);
        let [takes, leaves, _] = figures(&within(&open, Objective::Scallop, time + 1e-3));
        assert!(takes <= time + 2e-3, "{takes} s of {time} s");
        assert!(
            leaves <= left * TOLERANCE,
            "{leaves} mm, but {left} mm in {time} s"
        );
    }
}

#[test]
fn no_more_edge_is_used_than_the_least_time_uses_in_as_much() {
    for edge in [8.0, 5.0] {
        let (swing, scallop) = (Some(50.0), None);
        let open = Open {
            part: hill,
            swing,
            scallop,
        };
        let [time, _, used] = fast(&open, Some(edge));
        let [takes, _, uses] = figures(&within(&open, Objective::BladeLoad, time + 1e-3));
        assert!(takes <= time + 2e-3, "{takes} s of {time} s");
        assert!(uses <= used * TOLERANCE, "{uses} mm, but {used} mm in {time} s");
    }
}

#[test]
fn what_is_bound_by_time_leaves_less_in_more() {
    let (swing, scallop) = (Some(50.0), None);
    let open = Open {
        part: hill,
        swing,
        scallop,
    };
    let job = within(&open, Objective::Scallop, 240.0);
    let (plan, _) = planned_and_proven(&job).unwrap();
    assert!(vcut(&plan).parameters.binding.contains(&Bound::Time));
    let [_, left, _] = figures(&job);
    let [_, longer, _] = figures(&within(&open, Objective::Scallop, 400.0));
    assert!(longer < left * 0.8, "{longer} mm of {left} mm");
}
