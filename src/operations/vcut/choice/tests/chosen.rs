//! Limits that are chosen.

use super::*;
use crate::asked::{Formulas, WhyChosen};
use crate::choice::LITTLE;
use crate::plan::removable::Removable;
use vcutc_process::plan::settled;

fn open(part: fn(f64) -> f64, swing: Option<f64>) -> CheckedJob {
    let corners = (0..=170).map(|half| f64::from(half) / 2.0);
    all_open(corners.map(|x| Point2 { x, z: part(x) }).collect(), swing, None)
}

const PARTS: [fn(f64) -> f64; 4] = [hill, wall, gentle, hollow];

#[test]
fn a_chosen_limit_written_down_gives_the_same_cuts() {
    for part in PARTS {
        let job = open(part, Some(45.0));
        let (Some(plan), diagnostics) = plan_job(&job) else {
            panic!("there is a plan")
        };
        assert!(diagnostics.is_empty());
        let chosen = vcut(&plan).asked.limits;
        let limit = chosen.scallop.unwrap().value.to_mm();
        assert!(chosen.chosen.is_some());
        // As a person writes it, with a digit after the point.
        let written: f64 = format!("{limit:.1}").parse().unwrap();
        let mut given = job.clone();
        operation(&mut given).limits.scallop = Some(Sourced {
            value: Length::mm(written),
            span: None,
        });
        let (Some(same), _) = plan_job(&given) else {
            panic!("there is a plan")
        };
        assert_eq!(vcut(&same).parameters, vcut(&plan).parameters);
        assert_eq!(
            (&vcut(&same).cuts, &vcut(&same).runs),
            (&vcut(&plan).cuts, &vcut(&plan).runs)
        );
        // Settled, it is the job with the limit set.
        let settled = settled(&job, &plan).unwrap();
        let (Some(again), _) = plan_job(&settled) else {
            panic!("there is a plan")
        };
        assert_eq!(again, plan);
    }
}

#[test]
fn no_more_than_a_tenth_stays_where_the_limit_says_so() {
    for part in PARTS {
        let job = open(part, Some(45.0));
        let (plan, proven) = planned_and_proven(&job).unwrap();
        let asked = &vcut(&plan).asked;
        let removable = Removable::new(&plan.profile, asked);
        let top = [0.0, 85.0].map(|x| Point2 { x, z: 50.0 });
        let whole = removable.under(&top).to_mm2();
        let share = 1.0 - proven.report.removed.to_mm2() / whole;
        match asked.limits.chosen.unwrap().why {
            WhyChosen::LittleStays => assert!(share <= LITTLE + 1e-3, "{share}"),
            WhyChosen::MoreStays | WhyChosen::TightestKept => assert!(share > LITTLE, "{share}"),
        }
    }
}

#[test]
fn a_chosen_limit_yields_to_those_of_the_job() {
    let mut job = open(gentle, Some(45.0));
    let (plan, proven) = planned_and_proven(&job).unwrap();
    let tight = vcut(&plan).asked.limits.scallop.unwrap().value;
    let seconds = proven.report.times.all.total().to_s() * 0.9;
    operation(&mut job).limits.time = Some(Sourced {
        value: Duration::s(seconds),
        span: None,
    });
    let (plan, diagnostics) = plan_job(&job);
    assert!(diagnostics.is_empty(), "{diagnostics:?}");
    let limits = vcut(plan.as_ref().unwrap()).asked.limits;
    assert!(
        limits.scallop.is_none_or(|limit| limit.value > tight),
        "{limits:?}"
    );
}

#[test]
fn what_the_job_gives_needs_no_limit() {
    let mut job = open(gentle, Some(45.0));
    operation(&mut job).formulas.value = Formulas::Paper;
    let (plan, _) = plan_job(&job);
    assert_eq!(vcut(&plan.unwrap()).asked.limits.chosen, None);
    let mut job = open(gentle, None);
    let asked = operation(&mut job);
    asked.swing.value = Auto::Given(Angle::deg(40.0));
    asked.layer.value = Auto::Given(Length::mm(4.0));
    let (plan, _) = plan_job(&job);
    assert_eq!(vcut(&plan.unwrap()).asked.limits.chosen, None);
}
