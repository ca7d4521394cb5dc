//! Swings against points of the blade seen from its own frame, as [Yu 9] looks at the part.

use super::*;
use crate::asked::Sequence;
use crate::plan::parameters::resolve;
use crate::plan::tests::a_job;
use crate::samples::{given, operation, paper_job, planned};
use proptest::prelude::*;
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::source::{FileId, SourceMap, Span};
use vcutc_geometry::offset::offset_up;
use vcutc_job::{Auto, Body, BodyStage as Stage, CheckedJob, PlanningJob};
use vcutc_process::plan::plan as plan_job;
use vcutc_process::verdict::prove;
use vcutc_simulation::body::During;
use vcutc_simulation::prove::Findings;

fn points(of: &[(f64, f64)]) -> Vec<Point2> {
    of.iter().map(|&(x, z)| Point2 { x, z }).collect()
}

/// A job whose blade is so long that only the part and what stands keep flanks narrow.
fn job(part: &[(f64, f64)], swing: f64, thickness: f64) -> CheckedJob {
    let mut job = paper_job(points(part));
    let asked = operation(&mut job);
    asked.avoid = given(Avoid::Swing);
    asked.swing.value = Auto::Given(Angle::deg(swing));
    asked.layer.value = Auto::Given(Length::mm(4.0));
    asked.step.value = Auto::Given(Length::mm(4.0 * 2.0 * Angle::deg(swing).tan()));
    asked.blade.cutting_length = given(Length::mm(1000.0));
    asked.blade.thickness = given(Length::mm(thickness));
    job
}

fn with_body(job: &mut CheckedJob, from: f64, radius: f64) {
    let length = |mm: f64| given(Length::mm(mm));
    operation(job).blade.body = Some(Body {
        span: Span::of_bytes(FileId::ALONE, 0..0),
        stages: vec![Stage {
            from: length(from),
            radius: length(radius),
        }],
    });
}

/// What a job's avoidance says of a tip in the uncut stock, in degrees.
fn swings(job: &mut CheckedJob, tip: Point2) -> Option<[f64; 2]> {
    on(job, tip, &mut Surface::flat(85.0, 50.0))
}

fn on(job: &mut CheckedJob, tip: Point2, surface: &mut Surface) -> Option<[f64; 2]> {
    let asked = operation(job).clone();
    let planning = PlanningJob::of(job).unwrap();
    let parameters = resolve(&planning, &asked).unwrap();
    let avoidance = Avoidance::of(&asked, &parameters, &planning.profile, planning.stock).unwrap();
    let Swings { left, right } = avoidance.swings(tip, surface)?;
    Some([left.to_deg(), right.to_deg()])
}

/// A flank in the blade's own frame.
struct Seen {
    tip: Point2,
    sign: f64,
    swing: f64,
    half: f64,
    drop: f64,
}

impl Seen {
    /// A point up the flank and square to it, towards the material.
    fn point(&self, across: f64, up: f64) -> Point2 {
        let (sine, cosine) = libm::sincos(self.swing);
        Point2 {
            x: self.tip.x + self.sign * (across * cosine + up * sine),
            z: self.tip.z + up * cosine - across * sine,
        }
    }

    /// The point of the part that is deepest in the blade or above it, of the part's corners, or of points along the blade; how
    /// deep, about.
    fn depth(&self, part: &Profile) -> f64 {
        let (sine, cosine) = libm::sincos(self.swing);
        let corners = part.points().iter().filter_map(|corner| {
            let (out, up) = (self.sign * (corner.x - self.tip.x), corner.z - self.tip.z);
            let (across, along) = (out * cosine - up * sine, out * sine + up * cosine);
            // By the lowered middle plane, which regular flanks keep to.
            let lowered = out * cosine - (up + self.drop) * sine;
            let is_above = up + self.drop > 0.0;
            let middle = if out >= 0.0 && is_above {
                -lowered
            } else {
                f64::NEG_INFINITY
            };
            let side = if out >= 0.0 && along > 0.0 {
                self.half - across
            } else {
                f64::NEG_INFINITY
            };
            (out >= 0.0).then_some(middle.max(side))
        });
        let along = (0..=4000_u32).map(|i| f64::from(i) * 0.02);
        let side =
            along.flat_map(|up| [-1.0, -0.5, 0.0, 0.5, 1.0].map(|share| self.point(self.half * share, up)));
        let foot = Point2 {
            z: self.tip.z - self.drop,
            ..self.tip
        };
        let own = side
            .chain([foot])
            .filter(|point| self.sign * (point.x - self.tip.x) >= -1e-12 && (0.0..=85.0).contains(&point.x))
            .map(|point| part.height(point.x).min(50.0) - point.z);
        corners.chain(own).fold(f64::NEG_INFINITY, f64::max)
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    /// What is found is clear, and what is wider by two grid steps is not.
    #[test]
    fn the_largest_clear_swing_is_found(
        heights in prop::collection::vec(0.0..45.0_f64, 3..12),
        at in (1.0..84.0_f64, 0.0..20.0_f64),
        swing in 5.0..60.0_f64,
        thickness in prop_oneof![Just(0.0), 0.1..3.0_f64],
    ) {
        let apart = 85.0 / (heights.len() - 1) as f64;
        let part: Vec<(f64, f64)> = (0_u32..).zip(&heights).map(|(i, &z)| ((f64::from(i) * apart).min(85.0), z)).collect();
        let mut job = job(&part, swing, thickness);
        let part = PlanningJob::of(&job).unwrap().profile.clone();
        let half = thickness / 2.0;
        let drop = half / Angle::deg(swing).sin();
        let tip = Point2 { x: at.0, z: part.height(at.0) + drop + at.1 };
        prop_assume!(tip.z < 49.0);
        let found = swings(&mut job, tip);
        for (flank, sign) in [(0, -1.0), (1, 1.0)] {
            let seen = |degrees: f64| Seen { tip, sign, swing: degrees.to_radians(), half, drop };
            match found.map(|both| both[flank]) {
                Some(clear) => {
                    prop_assert!(seen(clear).depth(&part) <= 1e-6, "{clear} {}", seen(clear).depth(&part));
                    let wider = clear + 2e-4;
                    prop_assert!(wider >= swing || seen(wider).depth(&part) > 0.0, "{clear} of {swing}");
                }
                // Then one of the flanks does not even clear as a wall.
                None => {
                    let is_in_the_way = |sign: f64| Seen { tip, sign, swing: 0.0, half, drop }.depth(&part) > -1e-6;
                    let any = [-1.0, 1.0].into_iter().any(is_in_the_way);
                    prop_assert!(any, "no wall is clear");
                }
            }
        }
    }
}

/// Everything with corners where the numbers come out by hand.
#[test]
fn only_a_wall_is_clear_beside_a_wall() {
    // As steep as a profile is.
    let step = [(0.0, 40.0), (30.0, 40.0), (30.000_001, 10.0), (85.0, 10.0)];
    let mut thin = job(&step, 30.0, 0.0);
    let found = swings(
        &mut thin,
        Point2 {
            x: 30.000_001,
            z: 20.0,
        },
    )
    .unwrap();
    assert!(found[0] == 0.0 && (found[1] - 30.0).abs() < 1e-9, "{found:?}");
    // Two millimetres from it: atan(2 / 20).
    let found = swings(&mut thin, Point2 { x: 32.0, z: 20.0 }).unwrap();
    assert!(
        (found[0] - libm::atan(0.1).to_degrees()).abs() < 1e-3 && (found[1] - 30.0).abs() < 1e-9,
        "{found:?}"
    );
    // A thick blade half its thickness from it, and a micrometre nearer.
    let mut thick = job(&step, 30.0, 2.0);
    assert_eq!(
        swings(
            &mut thick,
            Point2 {
                x: 31.000_001,
                z: 20.0
            }
        )
        .unwrap()[0],
        0.0
    );
    assert_eq!(swings(&mut thick, Point2 { x: 30.999, z: 20.0 }), None);
}

#[test]
fn a_corner_on_the_way_decides() {
    // A tooth of the part, 6 mm left of the tip and 12 mm above it.
    let tooth = [
        (0.0, 10.0),
        (30.0, 10.0),
        (34.0, 32.0),
        (38.0, 10.0),
        (85.0, 10.0),
    ];
    let mut job = job(&tooth, 40.0, 0.0);
    let found = swings(&mut job, Point2 { x: 40.0, z: 20.0 }).unwrap();
    assert!(
        (found[0] - libm::atan(0.5).to_degrees()).abs() < 1.1e-4,
        "{found:?}"
    );
    assert!(found[0] <= libm::atan(0.5).to_degrees() && (found[1] - 40.0).abs() < 1e-9);
}

/// The body of radius 8 mm from 40 mm on, rake 60 deg, in a slit 2 mm from a wall that is 40 mm above the slit's end: 9.232 mm too
/// low (`docs/process.md`, "Body of the blade"), and no swing helps.
#[test]
fn a_wall_within_the_body_s_radius_is_not_avoided() {
    let flat = [(0.0, 5.0), (85.0, 5.0)];
    let beside_a_wall = |wall: f64| {
        let mut surface = Surface::flat(85.0, 50.0);
        // All that is right of x 38 goes, down to z 12.
        surface.release(Vee {
            tip: Point2 { x: wall, z: 12.0 },
            left: Some(f64::INFINITY),
            right: Some(1e-3),
        });
        surface
    };
    let mut without = job(&flat, 30.0, 0.0);
    let mut body = without.clone();
    with_body(&mut body, 40.0, 8.0);
    let tip = Point2 { x: 40.0, z: 10.0 };
    let found = on(&mut without, tip, &mut beside_a_wall(38.0)).unwrap();
    assert!(found[0] < 30.0, "{found:?}");
    assert_eq!(on(&mut body, tip, &mut beside_a_wall(38.0)), None);
    // Far enough from it the body passes, with the flank as narrow as without it or narrower.
    let (near, far) = (
        on(&mut body, tip, &mut beside_a_wall(31.9)),
        on(&mut without, tip, &mut beside_a_wall(31.9)),
    );
    let ([with, _], [bare, _]) = (near.unwrap(), far.unwrap());
    assert!(with <= bare && with < 10.0, "{with} {bare}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// Whatever the part, the route and the blade: the proof finds nothing, no cut takes the body into the work, and no point of a
    /// blade is in the part.
    #[test]
    fn what_is_planned_with_narrower_flanks_is_proven(
        mut job in a_job(),
        sequence in prop::sample::select(vec![Sequence::Rows, Sequence::Boustrophedon, Sequence::Nearest]),
        body in prop::option::of((0.0..20.0_f64, 0.5..6.0_f64)),
    ) {
        let asked = operation(&mut job);
        asked.avoid = given(Avoid::Swing);
        asked.sequence.value = Auto::Given(sequence);
        // Given, so that one plan is made and not hundreds.
        asked.swing.value = Auto::Given(asked.swing.value.or(Angle::deg(35.0)));
        if let Some((above, radius)) = body {
            let edge = operation(&mut job).blade.cutting_length.value.to_mm();
            with_body(&mut job, edge + above, radius);
        }
        let Some(plan) = plan_job(&job).0 else { return Ok(()) };
        let proven = prove(&plan, &SourceMap::default());
        let proven = proven.map_err(|faults| TestCaseError::fail(format!("{faults:?}")))?;
        prop_assert_eq!(&proven.findings, &Findings::default());
        let in_cuts = proven.bodies.contact.filter(|(_, contact)| contact.during == During::Cut);
        prop_assert!(in_cuts.is_none(), "{in_cuts:?}");
        let vcut = planned(&plan);
        let bound = offset_up(&plan.profile, vcut.asked.allowance.value);
        let (half, drop) = (vcut.parameters.standoff.to_mm(), vcut.parameters.drop.to_mm());
        for cut in vcut.cuts.iter().filter(|cut| cut.swings != Swings::even(vcut.parameters.swing)) {
            for (swing, sign) in [(cut.swings.left, -1.0), (cut.swings.right, 1.0)] {
                let seen = Seen { tip: cut.tip, sign, swing: swing.to_rad(), half, drop };
                let along = (0..=1000_u32).map(|i| f64::from(i) * 0.05);
                for point in along.flat_map(|up| [-half, 0.0, half].map(|across| seen.point(across, up))) {
                    let part = bound.height(point.x.clamp(0.0, 85.0)).min(50.0);
                    prop_assert!(point.z >= part - 1e-6 || !(0.0..=85.0).contains(&point.x), "{cut:?} {point:?} {part}");
                }
            }
        }
    }
}
