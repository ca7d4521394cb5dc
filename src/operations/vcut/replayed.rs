//! Proof, times and figures of small programs against what can be worked out by hand.

use crate::PlannedVcut;
use crate::asked::Residual;
use crate::samples::{operation, paper_job, planned};
use vcutc_backend_api::units::{Angle, Length};
use vcutc_backend_api::verify::verify;
use vcutc_diagnostics::source::SourceMap;
use vcutc_geometry::curve::Point2;
use vcutc_geometry::profile::Profile;
use vcutc_job::Auto;
use vcutc_process::lower::lower;
use vcutc_process::plan::plan as plan_job;
use vcutc_process::verdict::prove;
use vcutc_simulation::prove::{Bound, CutFault, Findings, replay};
use vcutc_simulation::timing::timing;

fn flat(z: f64) -> Vec<Point2> {
    vec![Point2 { x: 0.0, z }, Point2 { x: 85.0, z }]
}

#[test]
fn a_layer_too_deep_needs_the_edge_that_geometry_says() {
    let mut job = paper_job(flat(13.1));
    let asked = operation(&mut job);
    asked.swing.value = Auto::Given(Angle::deg(34.16));
    asked.layer.value = Auto::Given(Length::mm(5.0));
    let plan = plan_job(&job).0.unwrap();
    let findings = prove(&plan, &SourceMap::default()).unwrap().findings;
    let (count, worst) = findings.not_freed.unwrap();
    let CutFault::NotFreed { needed, available } = worst.fault else {
        panic!("{worst:?}")
    };
    // Orthogonal without overlap: 3h/2 of vertical reach [Cui 4].
    let expected = 1.5 * 5.0 / (Angle::deg(34.16).cos() * Angle::deg(60.0 - 7.13).sin());
    assert!((needed.to_mm() - expected).abs() < 2e-3, "{needed:?} {expected}");
    assert_eq!(available, Length::mm(10.0));
    // The first layer comes free, all others fail but for the cuts at the right side of the stock.
    assert_eq!(worst.layer.get(), 2);
    assert!(
        count > 60 && findings.blocked.is_none() && findings.overcut.is_none(),
        "{count}"
    );
}

#[test]
fn a_cut_into_the_part_is_found_with_its_place_and_depth() {
    let job = paper_job(flat(13.1));
    let plan = plan_job(&job).0.unwrap();
    let program = verify(lower(&plan, &SourceMap::default())).unwrap();
    let vcut = planned(&plan);
    let lowest = vcut
        .cuts
        .iter()
        .map(|cut| cut.tip.z)
        .fold(f64::INFINITY, f64::min);
    // A part that stands a little higher than the one planned for, in one place only.
    let victim = vcut
        .cuts
        .iter()
        .rev()
        .find(|cut| cut.tip.z <= lowest && (1.0..84.0).contains(&cut.tip.x))
        .unwrap()
        .tip;
    let bump = Profile::new(vec![
        Point2 { x: 0.0, z: 13.1 },
        Point2 {
            x: victim.x - 0.5,
            z: 13.1,
        },
        Point2 {
            x: victim.x,
            z: victim.z + 0.25,
        },
        Point2 {
            x: victim.x + 0.5,
            z: 13.1,
        },
        Point2 { x: 85.0, z: 13.1 },
    ])
    .unwrap();
    let found = replay(&program, &[Bound::of(&bump)]).findings.overcut.unwrap();
    let CutFault::Overcut { at, depth } = found.fault else {
        panic!("{found:?}")
    };
    assert!(
        (at.x - victim.x).abs() < 1e-9 && (depth.to_mm() - 0.25).abs() < 1e-9,
        "{found:?}"
    );
    assert_eq!(found.tip, victim);
    // The blade's thickness lowers its side towards the part.
    let thick = Bound {
        drop: Length::mm(lowest - 13.1 + 0.1),
        ..Bound::of(&plan.profile)
    };
    let found = replay(&program, &[thick]).findings.overcut.unwrap();
    let CutFault::Overcut { depth, .. } = found.fault else {
        panic!("{found:?}")
    };
    assert!((depth.to_mm() - 0.1).abs() < 1e-9);
}

#[test]
fn wide_cuts_after_narrow_ones_are_blocked_by_their_walls() {
    let mut job = paper_job(flat(13.1));
    let narrow = operation(&mut job);
    narrow.swing.value = Auto::Given(Angle::deg(10.0));
    narrow.layer.value = Auto::Given(Length::mm(5.0));
    narrow.step.value = Auto::Given(Length::mm(14.0));
    let mut wide = narrow.clone();
    wide.swing.value = Auto::Given(Angle::deg(45.0));
    wide.layer.value = Auto::Given(Length::mm(3.0));
    wide.step.value = Auto::Auto;
    // `auto` would raise the cuts until they are clear.
    wide.residual.value = Auto::Given(Residual::Discard);
    job.operations.push(Box::new(wide));
    let plan = plan_job(&job).0.unwrap();
    let findings = prove(&plan, &SourceMap::default()).unwrap().findings;
    let (_, first) = findings.blocked.unwrap();
    let CutFault::Blocked { at, by } = first.fault else {
        panic!("{first:?}")
    };
    // At a swing of 45 deg flanks rise as far as they go aside.
    let flank = first.tip.z + (at.x - first.tip.x).abs();
    assert!((at.z - flank - by.to_mm()).abs() < 1e-6, "{first:?}");
    assert!(by > Length::ZERO, "{first:?}");
}

#[test]
fn program_time_is_the_papers_time_of_each_cut() {
    let job = paper_job(flat(13.1));
    let plan = plan_job(&job).0.unwrap();
    let proven = prove(&plan, &SourceMap::default()).unwrap();
    let vcut = planned(&plan);
    let t = timing(&proven.program).all;
    let cuts = f64::from(u32::try_from(vcut.cuts.len()).unwrap());
    let layers = f64::from(vcut.cuts.last().unwrap().layer);
    // [Cui 9]: (2D + 4b) / v1 for the two flanks, phi / omega for the turn between them.
    let b = vcut.parameters.extension.to_mm();
    assert!((t.cutting.to_s() - cuts * (2.0 * 50.0 + 4.0 * b) / 200.0).abs() < 1e-6);
    let phi = 2.0 * libm::acos(vcut.parameters.swing.cos() * Angle::deg(60.0).sin());
    let turn = phi / 90.0_f64.to_radians();
    assert!((t.turning.to_s() - cuts * turn).abs() < 1e-6);
    // On to the next point while turning back, max(phi / omega, s / v2); between layers up, across and down.
    let along = (cuts - layers) * turn.max(vcut.parameters.step.to_mm() / 200.0);
    let across = t.travel.to_s() - along;
    let depths: f64 = vcut
        .cuts
        .chunk_by(|a, b| a.layer == b.layer)
        .map(|layer| 60.0 - layer[0].tip.z)
        .sum();
    assert!(
        (across - (2.0 * depths / 200.0 + (layers - 1.0) * turn)).abs() < 0.2,
        "{across}"
    );
}

#[test]
fn a_later_operation_may_come_closer_to_the_part() {
    let mut job = paper_job(flat(13.1));
    let first = operation(&mut job);
    first.allowance.value = Length::mm(12.0);
    let mut second = first.clone();
    second.allowance.value = Length::ZERO;
    job.operations.push(Box::new(second));
    let plan = plan_job(&job).0.unwrap();
    let proven = prove(&plan, &SourceMap::default()).unwrap();
    assert_eq!(proven.findings, Findings::default());
    // The earlier one is still compared with its own bound.
    let program = verify(lower(&plan, &SourceMap::default())).unwrap();
    let [rough, fine] = [0, 1].map(|index| PlannedVcut::of(&*plan.operations[index]).unwrap());
    let bound = |part, drop| Bound {
        drop: Length::mm(drop),
        ..Bound::of(part)
    };
    let bounds = [bound(&rough.bound, 30.0), bound(&fine.bound, 0.0)];
    let found = replay(&program, &bounds).findings.overcut.unwrap();
    assert_eq!(found.operation.0, 0);
}
