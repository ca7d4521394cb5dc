//! Checked jobs for tests.
#![allow(
    clippy::unwrap_used,
    clippy::indexing_slicing,
    reason = "tests fail by panics"
)]

use crate::PlannedVcut;
use crate::asked::{Avoid, Compensate, Formulas, Lattice, Limits, Objective, Residual, RoughVcut, Sequence};
use vcutc_backend_api::ir::{Edges, Stock};
use vcutc_backend_api::units::{Angle, AngularSpeed, Length, Speed};
use vcutc_diagnostics::source::{SourceMap, Span};
use vcutc_geometry::curve::Point2;
use vcutc_job::follow::{Family, Follow};
use vcutc_job::search::SearchEffort;
use vcutc_job::{Auto, CheckedJob, Direction, Order, Part, PlannedJob, Setup, Sourced, StraightBlade};

/// A value that the job gives, at no place.
pub fn given<T>(value: T) -> Sourced<T> {
    Sourced { value, span: None }
}

fn nowhere() -> Span {
    let mut sources = SourceMap::default();
    Span {
        file: sources.add("test", ""),
        start: 0,
        end: 0,
    }
}

/// The block of the paper, its blade and speeds; everything else at its default or `auto`.
pub fn paper_job(profile: Vec<Point2>) -> CheckedJob {
    let span = nowhere();
    let mm = |value| given(Length::mm(value));
    CheckedJob {
        name: "block".to_owned(),
        name_span: span,
        stock: Stock {
            width: Length::mm(85.0),
            depth: Length::mm(50.0),
            height: Length::mm(50.0),
        },
        stock_span: span,
        cell_size: None,
        part: Part::through(profile).unwrap(),
        profile_span: span,
        open: Vec::new(),
        families: Vec::new(),
        operations: vec![Box::new(RoughVcut {
            setup: Setup {
                head_span: span,
                rake: given(Angle::deg(60.0)),
                direction: Some(given(Direction::Alternate)),
                cut_feed: given(Speed::mm_per_s(200.0)),
                travel_feed: given(Speed::mm_per_s(200.0)),
                reorient_rate: given(AngularSpeed::deg_per_s(90.0)),
                clearance: mm(10.0),
                extension: Some(given(Auto::Auto)),
                run_out: mm(2.0),
            },
            blade: StraightBlade {
                name: "dagger".to_owned(),
                span,
                cutting_length: mm(10.0),
                half_apex: given(Angle::deg(7.13)),
                thickness: mm(0.0),
                edges: Edges::Double,
                body: None,
                forces: None,
            },
            tips: None,
            lattice: given(Auto::Given(Lattice::Orthogonal)),
            swing: given(Auto::Auto),
            layer: given(Auto::Auto),
            step: given(Auto::Auto),
            overlap: given(Auto::Given(0.0)),
            objective: given(Objective::Time),
            formulas: given(Formulas::Exact),
            limits: Limits::default(),
            allowance: mm(0.0),
            residual: given(Auto::Given(Residual::Mixed)),
            redundant: given(Auto::Auto),
            avoid: given(Avoid::Lift),
            order: given(Auto::Given(Order::Point)),
            sequence: given(Auto::Given(Sequence::Rows)),
            standoff: given(Auto::Auto),
            follow: given(Follow::Straight),
            family: Family::Straight,
            compensate: given(Compensate::Nothing),
            along: None,
        })],
        effort: SearchEffort::Normal,
        machine: None,
    }
}

/// The only operation of a job.
pub fn operation(job: &mut CheckedJob) -> &mut RoughVcut {
    RoughVcut::of_mut(&mut *job.operations[0]).unwrap()
}

/// The plan of the only operation of a job.
pub fn planned(plan: &PlannedJob) -> &PlannedVcut {
    PlannedVcut::of(&*plan.operations[0]).unwrap()
}
