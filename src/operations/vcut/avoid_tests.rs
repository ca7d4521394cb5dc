//! Whole plans beside places that are steeper than the flanks.

use crate::PlannedVcut;
use crate::asked::{Avoid, Sequence};
use crate::plan::avoid::Swings;
use crate::plan::{PlannedCut, TipOrigin, Way};
use crate::samples::{given, operation, paper_job, planned};
use vcutc_backend_api::units::{Angle, Length};
use vcutc_diagnostics::source::{FileId, SourceMap, Span};
use vcutc_geometry::curve::Point2;
use vcutc_job::{Auto, Body, BodyStage, CheckedJob, PlannedJob};
use vcutc_process::plan::plan as plan_job;
use vcutc_process::verdict::{Proven, prove};
use vcutc_simulation::prove::{CutFault, Findings};
use vcutc_simulation::surface::Surface;

/// A plateau left of a place that is much steeper than the flanks: 28 mm down over 1 mm.
fn beside_a_step(avoid: Avoid) -> CheckedJob {
    let part = [(0.0, 40.0), (30.0, 40.0), (31.0, 12.0), (85.0, 12.0)];
    let mut job = paper_job(part.map(|(x, z)| Point2 { x, z }).to_vec());
    let asked = operation(&mut job);
    asked.swing.value = Auto::Given(Angle::deg(30.0));
    asked.layer.value = Auto::Given(Length::mm(4.0));
    asked.step.value = Auto::Given(Length::mm(4.0));
    asked.avoid = given(avoid);
    job
}

fn plan(job: &CheckedJob) -> PlannedJob {
    plan_job(job).0.unwrap()
}

fn proof(plan: &PlannedJob) -> Proven {
    prove(plan, &SourceMap::default()).unwrap()
}

fn narrowed(vcut: &PlannedVcut) -> Vec<PlannedCut> {
    let regular = Swings::even(vcut.parameters.swing);
    let cuts = vcut.cuts.iter().copied();
    cuts.filter(|cut| cut.swings != regular).collect()
}

#[test]
fn less_stays_beside_a_steep_place() {
    let [lift, swing] = [Avoid::Lift, Avoid::Swing].map(|avoid| {
        let plan = plan(&beside_a_step(avoid));
        let proven = proof(&plan);
        assert_eq!(proven.findings, Findings::default());
        (planned(&plan).clone(), proven.report)
    });
    assert_eq!((lift.0.cuts.len(), narrowed(&lift.0).len()), (130, 0));
    assert_eq!((swing.0.cuts.len(), narrowed(&swing.0).len()), (136, 11));
    let bound = swing.0.parameters.scallop_bound(&swing.0.asked).to_mm();
    let heights = [&lift, &swing].map(|(_, report)| report.scallop.height.to_mm());
    // The lattice leaves at most 7.727 mm where the part is less steep than its flanks.
    assert!((bound - 7.727).abs() < 1e-3, "{bound}");
    assert!(
        (heights[0] - 10.759).abs() < 1e-3 && heights[1] < bound,
        "{heights:?}"
    );
    let less = lift.1.residual.to_mm2() - swing.1.residual.to_mm2();
    assert!(less > 60.0, "{less}");
    // Left flanks alone are narrowed, and on a grid that programs print.
    for cut in narrowed(&swing.0) {
        let parts = cut.swings.left.to_deg() * 1e4;
        assert!((parts - parts.round()).abs() < 1e-6, "{cut:?}");
        assert!(
            cut.swings.right == swing.0.parameters.swing && cut.way == Way::Over,
            "{cut:?}"
        );
    }
}

/// The choice of open parameters counts on it: wider flanks and half the cuts under the same limit.
#[test]
fn fewer_cuts_keep_a_limit() {
    let [lift, swing] = [Avoid::Lift, Avoid::Swing].map(|avoid| {
        let mut job = beside_a_step(avoid);
        let asked = operation(&mut job);
        (asked.swing.value, asked.layer.value, asked.step.value) = (Auto::Auto, Auto::Auto, Auto::Auto);
        asked.sequence.value = Auto::Given(Sequence::Rows);
        asked.limits.scallop = Some(given(Length::mm(8.0)));
        let plan = plan(&job);
        let proven = proof(&plan);
        assert_eq!(proven.findings, Findings::default());
        assert!(
            proven.report.scallop.height <= Length::mm(8.001),
            "{:?}",
            proven.report
        );
        planned(&plan).cuts.len()
    });
    assert!(swing * 3 < lift * 2, "{swing} of {lift}");
}

/// A body that regular flanks take into the step, 0.573 mm deep into the part.
#[test]
fn bodies_stay_out_of_a_steep_place() {
    let contact = |avoid| {
        let mut job = beside_a_step(avoid);
        let length = |mm| given(Length::mm(mm));
        operation(&mut job).blade.body = Some(Body {
            span: Span::of_bytes(FileId::ALONE, 0..0),
            stages: vec![BodyStage {
                from: length(20.0),
                radius: length(1.5),
            }],
        });
        let plan = plan(&job);
        let proven = proof(&plan);
        assert_eq!(proven.findings, Findings::default());
        (narrowed(planned(&plan)).len(), proven.bodies.contact)
    };
    let (_, lift) = contact(Avoid::Lift);
    let in_part = lift.unwrap().1.in_part.unwrap();
    assert!((in_part.to_mm() - 0.573).abs() < 1e-3, "{in_part:?}");
    assert_eq!(contact(Avoid::Swing), (11, None));
}

/// What one V cuts that is put in the place of a plan, with a blade 1 mm thick.
fn one(tip: Point2, swings: Swings) -> Findings {
    let mut job = beside_a_step(Avoid::Swing);
    operation(&mut job).blade.thickness = given(Length::mm(1.0));
    let mut plan = plan(&job);
    let mut vcut = planned(&plan).clone();
    vcut.cuts = vec![PlannedCut {
        layer: 1,
        tip,
        swings,
        origin: TipOrigin::Lattice,
        way: Way::Over,
    }];
    let (order, stock) = (vcut.order, plan.stock);
    plan.operations = vec![Box::new(vcut.along(
        order,
        Sequence::Rows,
        &Surface::untouched(stock),
        stock,
    ))];
    proof(&plan).findings
}

/// The side of a wall is half a millimetre beside its tip, where the step is at 40 - 28 (x - 30).
#[test]
fn the_sides_of_narrow_flanks_are_proven() {
    let swings = Swings {
        left: Angle::ZERO,
        right: Angle::deg(30.0),
    };
    let depth = |x: f64| {
        one(Point2 { x, z: 20.0 }, swings)
            .overcut
            .map(|finding| finding.fault)
    };
    let Some(CutFault::Overcut { at, depth: deep }) = depth(31.2) else {
        panic!("not found")
    };
    assert!(
        (at.x - 30.7).abs() < 1e-9 && (deep.to_mm() - 0.4).abs() < 1e-9,
        "{at:?} {deep:?}"
    );
    assert_eq!(depth(31.215), None);
    assert!(depth(31.214).is_some());
}
