//! Fitted tips of random jobs: proven, and against last rows that are searched for by brute force.

use super::Fitting;
use crate::asked::Lattice;
use crate::plan::parameters::{self, VcutParameters};
use crate::plan::tests::a_job;
use crate::samples::{given, operation, paper_job};
use proptest::prelude::*;
use vcutc_backend_api::units::{Angle, Length};
use vcutc_diagnostics::source::SourceMap;
use vcutc_geometry::cone;
use vcutc_geometry::curve::Point2;
use vcutc_job::{Auto, CheckedJob, PlanningJob};
use vcutc_process::plan::plan as plan_job;
use vcutc_process::verdict::{prove, scallop_excess};
use vcutc_simulation::surface::Surface;

/// The job with fitted tips of a swing, under a limit on the scallop.
fn fitted(job: &mut CheckedJob, swing: f64, limit: f64) {
    let asked = operation(job);
    asked.lattice.value = Auto::Given(Lattice::Fitted);
    asked.overlap.value = Auto::Auto;
    asked.swing.value = Auto::Given(Angle::deg(swing));
    asked.limits.scallop = Some(given(Length::mm(limit)));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(128))]

    #[test]
    fn every_chip_comes_free_and_no_more_stays_than_may(
        mut job in a_job(),
        swing in 12.0..70.0_f64,
        limit in 1.0..12.0_f64,
        layer in prop::option::of(0.2..1.0_f64),
        step in prop::option::of(1.0..30.0_f64),
    ) {
        fitted(&mut job, swing, limit);
        let asked = operation(&mut job);
        asked.step.value = step.map_or(Auto::Auto, |step| Auto::Given(Length::mm(step)));
        let reach = asked.blade.cutting_length.value
            * (asked.setup.rake.value - asked.blade.half_apex.value).sin()
            * Angle::deg(swing).cos();
        asked.layer.value = layer.map_or(Auto::Auto, |share| Auto::Given(reach * share));
        let Some(plan) = plan_job(&job).0 else { return Ok(()) };
        let proven = prove(&plan, &SourceMap::default()).unwrap();
        // Where they leave more than the limit the job fails anyway, and rows without number may rise along a wall.
        if fits(&job, swing) {
            prop_assert!(proven.is_sound(), "{:?}", proven.findings);
            prop_assert!(scallop_excess(&plan, &proven.report).is_none());
        }
    }

    #[test]
    fn no_last_row_of_a_raster_has_fewer_tips(
        heights in prop::collection::vec(4.0..18.0_f64, 4..7),
        swing in 25.0..60.0_f64,
        limit in 2.0..7.0_f64,
    ) {
        let apart = WIDTH / (heights.len() - 1) as f64;
        let corners = heights.iter().enumerate().map(|(place, &z)| Point2 { x: apart * place as f64, z });
        let corners: Vec<Point2> = corners.collect();
        let mut job = paper_job(corners.clone());
        fitted(&mut job, swing, limit);
        let found = last_row(&job, swing);
        let least = least_of_a_raster(&corners, swing, limit);
        match (found, least) {
            (Some(found), Some(least)) => prop_assert!(found.len() <= least, "{} of {least}", found.len()),
            (None, Some(least)) => prop_assert!(false, "none of {least}"),
            (_, None) => {}
        }
    }
}

const WIDTH: f64 = 85.0;

/// The parameters of a job with a given swing, and the last row of its widest steps.
fn last_row(job: &CheckedJob, swing: f64) -> Option<Vec<Point2>> {
    with_fitting(job, swing, |fitting, _| fitting.last_row(f64::INFINITY).ok())
}

/// Whether the flanks can leave no more than the limit.
fn fits(job: &CheckedJob, swing: f64) -> bool {
    with_fitting(job, swing, |fitting, _| fitting.last_row(f64::INFINITY).is_ok())
}

fn with_fitting<T>(job: &CheckedJob, swing: f64, ask: impl Fn(&mut Fitting<'_>, &VcutParameters) -> T) -> T {
    let mut job = job.clone();
    operation(&mut job).layer.value = Auto::Given(Length::mm(1.0));
    operation(&mut job).step.value = Auto::Given(Length::mm(1.0));
    let asked = operation(&mut job).clone();
    let planning = PlanningJob::of(&job).unwrap();
    let found = parameters::resolve_on(&planning, &asked, vec![Lattice::Fitted]).unwrap();
    assert_eq!(found.swing, Angle::deg(swing));
    let bound = vcutc_geometry::offset::offset_up(&planning.profile, asked.allowance.value);
    let clearance = cone::clearance(&bound, found.flanks.slope);
    let before = Surface::untouched(job.stock);
    let mut fitting = Fitting::new(&planning, &asked, &found, &clearance, &before, 10_000);
    ask(&mut fitting, &found)
}

/// How close the tips of the raster are, and the points at which what stays between them is measured.
const RASTER: f64 = 0.5;
const MEASURED: f64 = 0.1;

/// The fewest tips on a raster that leave no more than the limit on a part of straight lines: every tip as low as its V may go, every
/// two of them, and every one with either side, measured point by point.
fn least_of_a_raster(part: &[Point2], swing: f64, limit: f64) -> Option<usize> {
    let slope = 1.0 / libm::tan(swing.to_radians());
    let count = (WIDTH / RASTER) as usize;
    let fine = |x: f64| height(part, x);
    let tips: Vec<Point2> = (0..=count)
        .map(|place| {
            let x = place as f64 * RASTER;
            let corners = part.iter().map(|corner| corner.z - slope * (corner.x - x).abs());
            // On straight lines flatter or steeper than the flanks, the part touches a V at a corner or below its tip.
            Point2 {
                x,
                z: corners.fold(fine(x), f64::max),
            }
        })
        .collect();
    let is_low = |left: Option<Point2>, right: Option<Point2>| {
        let (from, to) = (left.map_or(0.0, |tip| tip.x), right.map_or(WIDTH, |tip| tip.x));
        let points = ((to - from) / MEASURED).ceil() as usize;
        (0..=points).all(|point| {
            let x = (from + point as f64 * MEASURED).min(to);
            let over = |tip: Point2| tip.z + slope * (tip.x - x).abs();
            let z = [left, right].into_iter().flatten().map(over).fold(50.0, f64::min);
            distance(part, Point2 { x, z }) <= limit - MEASURED * slope.max(1.0)
        })
    };
    // The fewest tips of a row that ends with each.
    let mut least: Vec<Option<usize>> = Vec::new();
    for (place, &tip) in tips.iter().enumerate() {
        let first = is_low(None, Some(tip)).then_some(1);
        let longer = (0..place).filter_map(|before| {
            let count = least[before]?;
            is_low(Some(tips[before]), Some(tip)).then_some(count + 1)
        });
        let best = longer.chain(first).min();
        least.push(best);
    }
    let ends = tips
        .iter()
        .zip(&least)
        .filter(|(tip, _)| is_low(Some(**tip), None));
    ends.filter_map(|(_, least)| *least).min()
}

fn height(part: &[Point2], x: f64) -> f64 {
    let pair = part
        .windows(2)
        .find(|pair| x <= pair[1].x)
        .unwrap_or(&part[part.len() - 2..]);
    pair[0].z + (pair[1].z - pair[0].z) * (x - pair[0].x) / (pair[1].x - pair[0].x)
}

fn distance(part: &[Point2], point: Point2) -> f64 {
    let to = |pair: &[Point2]| {
        let (dx, dz) = (pair[1].x - pair[0].x, pair[1].z - pair[0].z);
        let along = ((point.x - pair[0].x) * dx + (point.z - pair[0].z) * dz) / (dx * dx + dz * dz);
        let along = along.clamp(0.0, 1.0);
        libm::hypot(point.x - pair[0].x - along * dx, point.z - pair[0].z - along * dz)
    };
    part.windows(2).map(to).fold(f64::INFINITY, f64::min)
}
