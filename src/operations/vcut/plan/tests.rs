//! Random jobs, planned and proven: no overcut, every kept chip freed, every V complete.

use crate::asked::{Formulas, Lattice, Limits, Objective, Residual, RoughVcut};
use crate::plan::parameters::ScallopBy;
use crate::samples::{given, operation, paper_job, planned};
use proptest::prelude::*;
use vcutc_backend_api::ir::{Edges, Stock};
use vcutc_backend_api::units::{Angle, Length};
use vcutc_diagnostics::source::SourceMap;
use vcutc_geometry::curve::Point2;
use vcutc_job::{Auto, Bounds, CheckedJob, Direction, Order, Part, PlannedJob, PlanningJob};
use vcutc_process::plan::plan as plan_job;
use vcutc_process::verdict::{Proven, prove};
use vcutc_simulation::prove::Findings;

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
    pub(crate) fn a_job()(
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
        asked.lattice.value = Auto::Given(lattice);
        asked.order.value = Auto::Given(order);
        asked.setup.direction = Some(given(direction));
        asked.blade.edges = edges;
        asked.swing.value = swing.map_or(Auto::Auto, |swing| Auto::Given(Angle::deg(swing)));
        asked.setup.rake.value = Angle::deg(rake);
        asked.blade.cutting_length.value = Length::mm(blade.0);
        asked.blade.half_apex.value = Angle::deg(blade.1);
        asked.blade.thickness.value = Length::mm(blade.2);
        asked.overlap.value = Auto::Given(overlap);
        asked.allowance.value = Length::mm(allowance);
        asked.limits.scallop = scallop.map(|limit| given(Length::mm(limit)));
        job
    }
}

/// The plan of a job and its proof; none when the planner refuses the job, which it then says why.
fn planned_and_proven(job: &CheckedJob) -> Result<Option<(PlannedJob, Proven)>, TestCaseError> {
    let (plan, diagnostics) = plan_job(job);
    let Some(plan) = plan else {
        prop_assert!(!diagnostics.is_empty());
        return Ok(None);
    };
    let proven = prove(&plan, &SourceMap::default());
    let proven = proven.map_err(|faults| TestCaseError::fail(format!("{faults:?}")))?;
    Ok(Some((plan, proven)))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]

    #[test]
    fn what_is_planned_is_proven(job in a_job()) {
        let Some((plan, proven)) = planned_and_proven(&job)? else { return Ok(()) };
        prop_assert_eq!(&proven.findings, &Findings::default());
        let vcut = planned(&plan);
        prop_assert_eq!(proven.report.cuts(), vcut.cuts.len());
        // Nothing is left that was not there: stock = removed + residual + part.
        let part = plan.profile.area_below(0.0, 85.0);
        let whole = proven.report.removed + proven.report.residual + part;
        prop_assert!((whole.to_mm2() - 85.0 * 50.0).abs() < 1e-6);
    }
}

/// Leaves the sizes, the residual and the route to the compiler.
pub(crate) fn all_auto(asked: &mut RoughVcut) {
    asked.swing.value = Auto::Auto;
    asked.layer.value = Auto::Auto;
    asked.step.value = Auto::Auto;
    asked.overlap.value = Auto::Auto;
    asked.residual.value = Auto::Auto;
    asked.order.value = Auto::Auto;
    asked.sequence.value = Auto::Auto;
}

prop_compose! {
    /// Jobs that leave everything to the compiler, within limits that may be sensible or not.
    fn an_open_job()(
        mut job in a_stubborn_job(),
        objective in prop::sample::select(vec![Objective::Time, Objective::Scallop, Objective::Cuts, Objective::BladeLoad]),
        formulas in prop::sample::select(vec![Formulas::Exact, Formulas::Exact, Formulas::Paper]),
        swing in (prop::option::of(5.0..40.0_f64), prop::option::of(30.0..70.0_f64)),
        layer in (prop::option::of(0.7..3.0_f64), prop::option::of(2.0..12.0_f64)),
        step in (prop::option::of(0.7..3.0_f64), prop::option::of(2.0..12.0_f64)),
        scallop in prop::option::of(3.0..20.0_f64),
        edge in prop::option::of(2.0..20.0_f64),
        cuts in prop::option::of(20.0..400.0_f64),
        lattice in prop::sample::select(vec![
            Auto::Auto, Auto::Auto, Auto::Given(Lattice::Orthogonal), Auto::Given(Lattice::Interlaced), Auto::Given(Lattice::Free),
        ]),
    ) -> CheckedJob {
        let bounds = |(least, most): (Option<f64>, Option<f64>)| Bounds {
            least: least.filter(|&least| most.is_none_or(|most| least <= most)).map(|value| given(Length::mm(value))),
            most: most.map(|value| given(Length::mm(value))),
        };
        let asked = operation(&mut job);
        asked.lattice.value = lattice;
        asked.objective.value = objective;
        asked.formulas.value = formulas;
        all_auto(asked);
        asked.setup.extension = Some(given(Auto::Auto));
        asked.standoff.value = Auto::Auto;
        asked.limits = Limits {
            swing: Bounds {
                least: swing.0.filter(|&least| swing.1.is_none_or(|most| least <= most)).map(|value| given(Angle::deg(value))),
                most: swing.1.map(|value| given(Angle::deg(value))),
            },
            layer: bounds(layer),
            step: bounds(step),
            scallop: scallop.map(|value| given(Length::mm(value))),
            edge: edge.map(|value| given(Length::mm(value))),
            deviation: None,
            time: None,
            cuts: cuts.map(given),
            chosen: None,
        };
        job
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn what_is_chosen_keeps_the_limits_and_is_proven(job in an_open_job()) {
        let Some((plan, proven)) = planned_and_proven(&job)? else { return Ok(()) };
        prop_assert_eq!(&proven.findings, &Findings::default());
        let vcut = planned(&plan);
        let (limits, chosen) = (&vcut.asked.limits, &vcut.parameters);
        prop_assert!(limits.swing.hold(chosen.swing), "{chosen:?}");
        prop_assert!(limits.layer.hold(chosen.layer), "{chosen:?}");
        prop_assert!(limits.step.hold(chosen.step), "{chosen:?}");
        // The lattice's own bound, without the optimiser.
        let bound = match (vcut.asked.formulas.value, chosen.lattice) {
            // As printed: sigma is 1 + rho, whatever the swing.
            (Formulas::Paper, Lattice::Interlaced) => chosen.layer + chosen.step * (chosen.flanks.slope / 2.0),
            (Formulas::Paper | Formulas::Exact, _) => super::blade_reach::scallop_bound(chosen.lattice, chosen.layer, chosen.step, chosen.flanks.slope),
        };
        // What is simulated may exceed the limit by the micrometre that the choice allows.
        let (stays, excess) = match chosen.scallop_by {
            ScallopBy::Bound => (bound + vcut.asked.allowance.value + chosen.drop, Length::mm(1e-6)),
            ScallopBy::Simulation => (proven.report.scallop.height, Length::mm(1e-3)),
        };
        prop_assert!(limits.scallop.is_none_or(|limit| stays <= limit.value + excess), "{chosen:?} {stays:?}");
        let edge = limits.edge.map_or(Length::mm(f64::INFINITY), |limit| limit.value);
        prop_assert!(proven.report.longest_edge <= edge + Length::mm(1e-6), "{chosen:?}");
        // Neighbouring Vs meet, but for the micrometre that rounding may take.
        let widest = chosen.layer * 2.0 * chosen.swing.tan();
        prop_assert!(chosen.step <= widest + Length::mm(2e-3), "{chosen:?}");
        prop_assert!(chosen.lattice_fits());
    }
}

prop_compose! {
    /// Jobs with everything given that can be given, sensible or not, on stocks of any size.
    fn a_stubborn_job()(
        mut job in a_job(),
        size in (20.0..300.0_f64, 10.0..80.0_f64),
        residual in prop::sample::select(vec![Residual::Discard, Residual::Lift, Residual::Shift, Residual::Mixed]),
        layer in prop::option::of(0.7..9.0_f64),
        step in prop::option::of(0.7..15.0_f64),
        extension in prop::option::of(0.0..60.0_f64),
        standoff in prop::option::of(0.0..3.0_f64),
        run_out in 0.0..10.0_f64,
    ) -> CheckedJob {
        let (width, height) = size;
        let scale = |p: &Point2| Point2 { x: p.x * width / 85.0, z: p.z * height / 50.0 };
        let part = PlanningJob::of(&job).unwrap().profile;
        let points: Vec<Point2> = part.points().iter().map(scale).collect();
        job.stock = Stock { width: Length::mm(points.last().unwrap().x), height: Length::mm(height), ..job.stock };
        job.part = Part::through(points).unwrap();
        let auto = |value: Option<f64>| value.map_or(Auto::Auto, |value| Auto::Given(Length::mm(value)));
        let asked = operation(&mut job);
        asked.residual.value = Auto::Given(residual);
        asked.layer.value = auto(layer);
        asked.step.value = auto(step);
        asked.setup.extension = Some(given(auto(extension)));
        asked.standoff.value = auto(standoff);
        asked.setup.run_out.value = Length::mm(run_out);
        job
    }
}

/// Distance of a point from a V: to its tip where that is nearest, else to a flank; negative within the V.
fn distance_from_vee(tip: Point2, slope: f64, point: Point2) -> f64 {
    let length = (1.0 + slope * slope).sqrt();
    let (aside, above) = ((point.x - tip.x).abs(), point.z - tip.z);
    // Along the nearer flank from the tip, and square to it.
    let (along, beside) = ((aside + slope * above) / length, (slope * aside - above) / length);
    if along < 0.0 {
        libm::hypot(aside, above)
    } else {
        beside
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]

    #[test]
    fn no_strategy_enters_the_part(job in a_stubborn_job()) {
        let Some((plan, proven)) = planned_and_proven(&job)? else { return Ok(()) };
        prop_assert_eq!(proven.findings.overcut, None);
        // The same without offsets and envelopes: no point of the part lies nearer to the V of a cut's material side than the
        // allowance. (The flattened offset may be a micrometre above the true one, never below.)
        let vcut = planned(&plan);
        let allowance = vcut.asked.allowance.value.to_mm();
        let standoff = vcut.parameters.standoff.to_mm();
        let slope = vcut.parameters.flanks.slope;
        for cut in &vcut.cuts {
            let side = Point2 { z: cut.tip.z - vcut.parameters.drop.to_mm(), ..cut.tip };
            for pair in plan.profile.points().windows(2) {
                for share in [0.0, 0.25, 0.5, 0.75, 1.0] {
                    let point = Point2 {
                        x: pair[0].x + (pair[1].x - pair[0].x) * share,
                        z: pair[0].z + (pair[1].z - pair[0].z) * share,
                    };
                    let distance = distance_from_vee(side, slope, point);
                    prop_assert!(distance >= allowance - 1e-6, "{cut:?} {point:?} {distance}");
                }
            }
        }
        prop_assert!(standoff >= vcut.asked.blade.thickness.value.to_mm() / 2.0);
    }
}
