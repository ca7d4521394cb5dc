//! Redundant Vs of random jobs: what is left is proven, as little as all of the section says, and needed to the last V.

use super::super::chip::Chip;
use crate::PlannedVcut;
use crate::asked::{Lattice, Redundant, Residual};
use crate::plan::PlannedCut;
use crate::plan::removable::Removable;
use crate::plan::tests::a_job;
use crate::samples::{given, operation, paper_job, planned};
use proptest::prelude::*;
use vcutc_backend_api::units::{Angle, Length};
use vcutc_diagnostics::source::SourceMap;
use vcutc_geometry::curve::Point2;
use vcutc_job::{Auto, Body, BodyStage, CheckedJob, PlannedJob};
use vcutc_process::plan::plan as plan_job;
use vcutc_process::verdict::{Proven, prove, scallop_excess};
use vcutc_simulation::contour::farthest;
use vcutc_simulation::report::area_under;
use vcutc_simulation::surface::Surface;

fn with(job: &CheckedJob, redundant: Redundant) -> Option<(PlannedJob, Proven)> {
    let mut job = job.clone();
    operation(&mut job).redundant.value = Auto::Given(redundant);
    let plan = plan_job(&job).0?;
    let proven = prove(&plan, &SourceMap::default()).unwrap();
    Some((plan, proven))
}

fn is_sound(plan: &PlannedJob, proven: &Proven) -> bool {
    proven.is_sound() && scallop_excess(plan, &proven.report).is_none()
}

/// How much stays under what Vs leave, in mm2; none where one of their chips does not come free, or they leave more than the limit:
/// all of the section, layer by layer.
fn stays(vcut: &PlannedVcut, cuts: &[PlannedCut], plan: &PlannedJob, limit: Length) -> Option<f64> {
    let mut surface = Surface::untouched(plan.stock);
    for layer in cuts.chunk_by(|one, next| one.layer == next.layer) {
        if !layer
            .iter()
            .all(|cut| Chip::of(&vcut.parameters, cut.tip).comes_free(&mut surface))
        {
            return None;
        }
        layer.iter().for_each(|cut| surface.release(cut.vee()));
    }
    let corners: Vec<Point2> = surface.corners().collect();
    (farthest(&corners, &plan.profile).height <= limit).then(|| area_under(&corners))
}

/// The tips of the Vs that are left when each is skipped in turn that all others do without.
///
/// None where all Vs leave a tenth of what is to go or more: then no more may stay, which rounding decides.
fn left_over(vcut: &PlannedVcut, plan: &PlannedJob, limit: Length) -> Option<Vec<Point2>> {
    let mut cuts = vcut.cuts.clone();
    // No more than a tenth of what is to go stays in all, or as much as all Vs leave.
    let removable = Removable::new(&plan.profile, &vcut.asked);
    let whole = removable.under(&Surface::untouched(plan.stock).corners().collect::<Vec<_>>());
    let mut after = Surface::untouched(plan.stock);
    cuts.iter().for_each(|cut| after.release(cut.vee()));
    let corners: Vec<Point2> = after.corners().collect();
    let room = 0.1 * whole.to_mm2() - removable.under(&corners).to_mm2();
    let most = area_under(&corners) + room;
    if room <= 0.0 {
        return None;
    }
    let mut place = cuts.len();
    while place > 0 {
        // The last layer first, and each from the right.
        place -= 1;
        let skipped = cuts.remove(place);
        if stays(vcut, &cuts, plan, limit).is_none_or(|area| area > most) {
            cuts.insert(place, skipped);
        }
    }
    Some(cuts.into_iter().map(|cut| cut.tip).collect())
}

prop_compose! {
    fn a_body()(from in 0.0..20.0_f64, radius in 2.0..25.0_f64) -> (f64, f64) {
        (from, radius)
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(96))]

    #[test]
    fn what_is_skipped_nothing_needs(mut job in a_job(), layer in 1.0..8.0_f64, body in prop::option::of(a_body())) {
        let asked = operation(&mut job);
        asked.residual.value = Auto::Given(Residual::Mixed);
        asked.swing.value = Auto::Given(asked.swing.value.or(Angle::deg(40.0)));
        asked.layer.value = Auto::Given(Length::mm(layer));
        let from = asked.blade.cutting_length.value;
        let span = asked.blade.span;
        asked.blade.body = body.map(|(above, radius)| Body {
            span,
            stages: vec![BodyStage {
                from: given(from + Length::mm(above)),
                radius: given(Length::mm(radius)),
            }],
        });
        let Some((all, proven_all)) = with(&job, Redundant::Keep) else { return Ok(()) };
        let (thinned, proven) = with(&job, Redundant::Skip).unwrap();
        let (every, some) = (planned(&all), planned(&thinned));
        prop_assert_eq!(every.skipped, 0);
        prop_assert_eq!(some.skipped + some.cuts.len(), every.cuts.len());
        if !is_sound(&all, &proven_all) {
            return Ok(());
        }
        prop_assert!(is_sound(&thinned, &proven), "{:?}", proven.findings);
        prop_assert!(proven_all.bodies.contact.is_some() || proven.bodies.contact.is_none());
        prop_assert_eq!(proven.report.cuts(), some.cuts.len());
        // Each V is one of them, in the same order, and layers are numbered one by one.
        let mut rest = every.cuts.iter();
        for cut in &some.cuts {
            prop_assert!(rest.any(|one| (one.tip, one.origin, one.swings) == (cut.tip, cut.origin, cut.swings)));
        }
        let numbers: Vec<u32> = some.cuts.iter().map(|cut| cut.layer).collect();
        prop_assert!(numbers[0] == 1 && numbers.windows(2).all(|pair| pair[1] - pair[0] <= 1));
        if every.cuts.len() > 150 || some.skipped == 0 && body.is_some() {
            return Ok(());
        }
        // What all Vs leave is known to a micrometre only.
        let Some(limit) = some.asked.limits.scallop else { return Ok(()) };
        let Some(mut needed) = left_over(every, &all, limit.value) else { return Ok(()) };
        if needed.is_empty() {
            // All of the stock may stay: then it is cut as usual.
            needed = every.cuts.iter().map(|cut| cut.tip).collect();
        }
        let tips: Vec<Point2> = some.cuts.iter().map(|cut| cut.tip).collect();
        prop_assert_eq!(tips, needed);
    }
}

/// Steps as close as the scallop needs, in layers as thick as the blade reaches: what is above the last ones is overlapped many times.
fn close_steps() -> CheckedJob {
    let mut job = paper_job(vec![Point2 { x: 0.0, z: 11.0 }, Point2 { x: 85.0, z: 11.0 }]);
    let asked = operation(&mut job);
    asked.lattice.value = Auto::Given(Lattice::Orthogonal);
    asked.residual.value = Auto::Given(Residual::Mixed);
    asked.swing.value = Auto::Given(Angle::deg(45.0));
    asked.layer.value = Auto::Given(Length::mm(3.0));
    asked.step.value = Auto::Given(Length::mm(2.0));
    asked.limits.scallop = Some(given(Length::mm(2.0)));
    job
}

#[test]
fn layers_above_the_last_one_need_fewer_vs() {
    let job = close_steps();
    let [(all, _), (thinned, proven)] =
        [Redundant::Keep, Redundant::Skip].map(|way| with(&job, way).unwrap());
    assert!(is_sound(&thinned, &proven), "{:?}", proven.findings);
    let (every, some) = (planned(&all), planned(&thinned));
    assert!(
        some.cuts.len() * 2 < every.cuts.len(),
        "{} of {}",
        some.cuts.len(),
        every.cuts.len()
    );
    // What is given is cut, unless the job says otherwise.
    let plan = plan_job(&job).0.unwrap();
    assert_eq!(planned(&plan).cuts, every.cuts);
}
