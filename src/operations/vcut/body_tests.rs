//! Bodies of blades in whole programs, against points of their skin followed through space.

use crate::samples::{operation, paper_job};
use proptest::prelude::*;
use std::collections::BTreeMap;
use vcutc_backend_api::ir::{Action, OpId, Program, Stock};
use vcutc_backend_api::segments::{LinearSegment, Segment};
use vcutc_backend_api::units::{Angle, Length};
use vcutc_backend_api::verify::VerifiedProgram;
use vcutc_diagnostics::source::{FileId, SourceMap, Span};
use vcutc_geometry::curve::Point2;
use vcutc_job::{Auto, Body, BodyStage, CheckedJob, Sourced};
use vcutc_process::plan::plan;
use vcutc_process::verdict::{Proven, bounds, prove};
use vcutc_simulation::body::{During, watched};
use vcutc_simulation::prove::accompanied;
use vcutc_simulation::surface::Surface;

/// Deeper than rounding and the resolution of turns.
const DEEP: f64 = 0.02;

fn body(stages: &[(f64, f64)]) -> Body {
    let length = |mm: f64| Sourced {
        value: Length::mm(mm),
        span: None,
    };
    let stages = stages.iter().map(|&(from, radius)| BodyStage {
        from: length(from),
        radius: length(radius),
    });
    Body {
        span: Span::of_bytes(FileId::ALONE, 0..0),
        stages: stages.collect(),
    }
}

fn proven(job: &CheckedJob) -> Option<Proven> {
    prove(&plan(job).0?, &SourceMap::default()).ok()
}

/// Points of the skin of a body that may come below the top of the stock, seen from the tip in the blade's frame.
fn skin(stages: &[(f64, f64)]) -> Vec<[f64; 3]> {
    let ends = stages.iter().skip(1).map(|&(from, _)| from).chain([150.0]);
    let mut points = Vec::new();
    for (&(from, radius), to) in stages.iter().zip(ends) {
        for turned in (0..24_u32).map(|i| f64::from(i) * core::f64::consts::TAU / 24.0) {
            let (sine, cosine) = libm::sincos(turned);
            let along = (0..12_u32).map(|i| from + (to - from) * f64::from(i) / 12.0);
            points.extend(along.map(|height| [radius * cosine, radius * sine, -height]));
        }
    }
    points
}

/// How far above the section the lowest of some points comes on a line; none where all pass beside the stock.
fn lowest(
    program: &Program,
    line: &LinearSegment,
    points: &[[f64; 3]],
    surface: &mut Surface,
) -> Option<f64> {
    let Stock { width, depth, .. } = program.stock;
    let [from, to] =
        [line.from, line.to].map(|pose| (pose.tip, program.orientation(pose.orientation).unwrap()));
    let mut lowest: Option<f64> = None;
    for done in (0..=16_u32).map(|i| f64::from(i) / 16.0) {
        let m = from.1.towards(to.1, done).matrix();
        let tip =
            [(from.0.x, to.0.x), (from.0.y, to.0.y), (from.0.z, to.0.z)].map(|(a, b)| a + (b - a) * done);
        for point in points {
            let [x, y, z] = [0, 1, 2].map(|i| tip[i] + (0..3).map(|j| m[i][j] * point[j]).sum::<f64>());
            if (0.0..=width.to_mm()).contains(&x) && (0.0..=depth.to_mm()).contains(&y) {
                let gap = z - surface.height(x);
                lowest = Some(lowest.map_or(gap, |known| known.min(gap)));
            }
        }
    }
    lowest
}

/// A motion on a line, and how far the lowest of all points stays above the section in it.
struct Met {
    op: OpId,
    during: During,
    gap: f64,
}

fn sampled(verified: &VerifiedProgram, points: &[[f64; 3]]) -> Vec<Met> {
    let program = verified.program();
    let segments: Vec<Segment<'_>> = program.segments().collect();
    let mut found = Vec::new();
    accompanied(verified, &[], &mut |id, surface| {
        let segment = segments[id.0 as usize];
        if let Some(gap) = segment
            .line()
            .and_then(|line| lowest(program, &line, points, surface))
        {
            let during = match segment.op.action {
                Action::Cut { .. } => During::Cut,
                _ => During::Way,
            };
            found.push(Met { op: id, during, gap });
        }
    });
    found
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]
    #[test]
    fn what_points_in_space_meet_is_found(
        from in 15.0..60.0_f64,
        radius in 3.0..25.0_f64,
        more in (5.0..40.0_f64, 3.0..40.0_f64),
        swing in 15.0..55.0_f64,
        rake in 50.0..=90.0_f64,
        ends in (5.0..40.0_f64, 5.0..40.0_f64),
    ) {
        let stages = [(from, radius), (from + more.0, more.1)];
        let mut job = paper_job(vec![Point2::new(0.0, ends.0), Point2::new(85.0, ends.1)]);
        let asked = operation(&mut job);
        asked.swing.value = Auto::Given(Angle::deg(swing.round()));
        asked.setup.rake.value = Angle::deg(rake.round());
        asked.blade.body = Some(body(&stages));
        let Some(planned) = plan(&job).0 else {
            return Err(TestCaseError::reject("no plan"));
        };
        let proven = prove(&planned, &SourceMap::default()).unwrap();
        let met = sampled(&proven.program, &skin(&stages));
        let mut found = BTreeMap::new();
        let same = watched(&proven.program, &bounds(&planned), &mut |contact| {
            found.insert(contact.passage.op, contact);
        });
        prop_assert_eq!(same, proven.bodies);
        prop_assert_eq!(same.contact.map_or(0, |(count, _)| count), found.len());
        for met in met.iter().filter(|met| met.gap < -DEEP) {
            prop_assert!(found.contains_key(&met.op), "{:?} {}", met.op, met.gap);
        }
        let cuts = met.iter().filter(|met| met.during == During::Cut);
        let in_cuts = cuts.map(|met| met.gap).fold(f64::INFINITY, f64::min);
        let least = match (same.contact, same.nearest) {
            (Some((_, contact)), _) if contact.during == During::Cut => contact.passage.clearance.to_mm(),
            (_, Some(nearest)) => nearest.clearance.to_mm(),
            (_, None) => f64::INFINITY,
        };
        prop_assert!(least <= in_cuts + 1e-6, "{least} {in_cuts}");
        prop_assert!(least.is_infinite() || least >= in_cuts - 6.0, "{least} {in_cuts}");
    }
}

#[test]
fn a_body_that_is_not_stated_is_not_looked_at() {
    let job = paper_job(vec![Point2::new(0.0, 13.1), Point2::new(85.0, 13.1)]);
    let proven = proven(&job).unwrap();
    assert_eq!(proven.bodies, vcutc_simulation::body::Bodies::default());
    assert!(proven.is_sound());
}

/// The least height at which a body is clear, and a micrometre less.
#[test]
fn a_micrometre_decides() {
    let mut job = paper_job(vec![Point2::new(0.0, 13.1), Point2::new(85.0, 13.1)]);
    let mut contact = |from: f64| {
        operation(&mut job).blade.body = Some(body(&[(from, 20.0)]));
        proven(&job).unwrap().bodies.contact
    };
    let (mut low, mut high) = (14.0, 140.0);
    assert!(contact(low).is_some() && contact(high).is_none());
    while high - low > 1e-4 {
        let middle = f64::midpoint(low, high);
        if contact(middle).is_some() {
            low = middle;
        } else {
            high = middle;
        }
    }
    let (_, just) = contact(low).unwrap();
    let depth = -just.passage.clearance.to_mm();
    assert!(
        depth > 0.0 && depth < 1e-4 && just.during == During::Cut,
        "{just:?}"
    );
    assert!(contact(high).is_none() && contact(low - 1e-3).is_some());
}
