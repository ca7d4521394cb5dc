//! Random jobs, planned and proven: no overcut, every kept chip freed, every V complete.

use crate::geom::curve::Point2;
use crate::geom::profile::Profile;
use crate::job::{
    Auto, Blade, CheckedJob, Direction, Lattice, Limits, Operation, Order, Residual, RoughVcut, Sourced,
};
use crate::sim::prove::Findings;
use crate::source::{SourceMap, Span};
use crate::verdict;
use proptest::prelude::*;
use vcutc_backend_api::ir::{Edges, Stock};
use vcutc_backend_api::units::{Angle, AngularSpeed, Length, Speed};

fn given<T>(value: T) -> Sourced<T> {
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
pub(crate) fn paper_job(profile: Vec<Point2>) -> CheckedJob {
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
        profile: Profile::new(profile).unwrap(),
        profile_span: span,
        operations: vec![Operation::RoughVcut(RoughVcut {
            span,
            head_span: span,
            blade: Blade {
                name: "dagger".to_owned(),
                span,
                cutting_length: mm(10.0),
                half_apex: given(Angle::deg(7.13)),
                thickness: mm(0.0),
                edges: Edges::Double,
            },
            lattice: given(Lattice::Orthogonal),
            rake: given(Angle::deg(60.0)),
            swing: given(Auto::Auto),
            layer: given(Auto::Auto),
            step: given(Auto::Auto),
            overlap: given(0.0),
            limits: Limits {
                swing: None,
                scallop: None,
            },
            allowance: mm(0.0),
            residual: given(Residual::Auto),
            order: given(Order::Point),
            direction: given(Direction::Alternate),
            cut_feed: given(Speed::mm_per_s(200.0)),
            travel_feed: given(Speed::mm_per_s(200.0)),
            reorient_rate: given(AngularSpeed::deg_per_s(90.0)),
            clearance: mm(10.0),
            extension: given(Auto::Auto),
            run_out: mm(2.0),
            standoff: given(Auto::Auto),
        })],
        machine: None,
    }
}

pub(crate) fn operation(job: &mut CheckedJob) -> &mut RoughVcut {
    match &mut job.operations[0] {
        Operation::RoughVcut(asked) => asked,
    }
}

fn a_profile() -> impl Strategy<Value = Vec<Point2>> {
    // Corners at random distances and heights: hills, hollows, steps up to nearly vertical.
    prop::collection::vec((0.2..30.0_f64, 0.0..48.0_f64), 2..14).prop_map(|corners| {
        let width: f64 = corners.iter().skip(1).map(|(dx, _)| dx).sum();
        let mut x = 0.0;
        let mut points = Vec::new();
        for (index, (dx, z)) in corners.into_iter().enumerate() {
            if index > 0 {
                x += dx * 85.0 / width;
            }
            points.push(Point2 { x: x.min(85.0), z });
        }
        if let Some(last) = points.last_mut() {
            last.x = 85.0;
        }
        points
    })
}

prop_compose! {
    fn a_job()(
        profile in a_profile(),
        lattice in prop::sample::select(vec![Lattice::Orthogonal, Lattice::Interlaced, Lattice::Free]),
        order in prop::sample::select(vec![Order::Point, Order::Layer]),
        direction in prop::sample::select(vec![Direction::Alternate, Direction::Forward, Direction::Backward]),
        edges in prop::sample::select(vec![Edges::Single, Edges::Double]),
        swing in prop::option::of(10.0..65.0_f64),
        rake in 20.0..=90.0_f64,
        blade in (4.0..40.0_f64, 2.0..15.0_f64, 0.0..3.0_f64),
        overlap in prop::sample::select(vec![0.0, 0.0, 0.1, 0.3, 0.5, 0.7]),
        allowance in 0.0..4.0_f64,
        scallop in prop::option::of(3.0..20.0_f64),
    ) -> CheckedJob {
        let mut job = paper_job(profile);
        let asked = operation(&mut job);
        asked.lattice.value = lattice;
        asked.order.value = order;
        asked.direction.value = direction;
        asked.blade.edges = edges;
        asked.swing.value = swing.map_or(Auto::Auto, |swing| Auto::Given(Angle::deg(swing)));
        asked.rake.value = Angle::deg(rake);
        asked.blade.cutting_length.value = Length::mm(blade.0);
        asked.blade.half_apex.value = Angle::deg(blade.1);
        asked.blade.thickness.value = Length::mm(blade.2);
        asked.overlap.value = overlap;
        asked.allowance.value = Length::mm(allowance);
        asked.limits.scallop = scallop.map(|limit| given(Length::mm(limit)));
        job
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]

    #[test]
    fn what_is_planned_is_proven(job in a_job()) {
        let (plan, diagnostics) = super::choose(&job);
        let Some(plan) = plan else {
            prop_assert!(!diagnostics.is_empty());
            return Ok(());
        };
        let proven = verdict::prove(&plan, &SourceMap::default());
        let proven = proven.map_err(|faults| TestCaseError::fail(format!("{faults:?}")))?;
        prop_assert_eq!(&proven.findings, &Findings::default());
        let super::PlannedOperation::RoughVcut(vcut) = &plan.operations[0];
        prop_assert_eq!(proven.report.cuts(), vcut.cuts.len());
        // Nothing is left that was not there: stock = removed + residual + part.
        let part = plan.profile.area_below(0.0, 85.0);
        let whole = proven.report.removed + proven.report.residual + part;
        prop_assert!((whole.to_mm2() - 85.0 * 50.0).abs() < 1e-6);
    }
}
