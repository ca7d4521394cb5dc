//! A leaning disc: its edge against the circle sampled in space, and plans against a raster of heights.

use super::*;
use crate::plan::blades::{Extent, TOUCH};
use proptest::prelude::*;
use vcutc_geometry::offset::offset_up;
use vcutc_simulation::surface::Side;

/// The lowest height over x that the circle of the edge has anywhere along y, from its points in space: the axis leans by the
/// lead along y.
fn swept(wheel: &Wheel, centre: Point2) -> Vec<Point2> {
    const POINTS: u32 = 50_000;
    let radius = wheel.radius.to_mm();
    let circle = (0..POINTS).map(|i| {
        let around = core::f64::consts::TAU * f64::from(i) / f64::from(POINTS);
        let along = radius * libm::sin(around);
        Point2::new(
            centre.x + radius * libm::cos(around),
            centre.z - along * libm::sin(wheel.lead.to_rad()),
        )
    });
    circle.collect()
}

/// The height of the edge over x when the centre is there; none beyond the rim. All in mm.
fn edge_over(wheel: &Wheel, centre: Point2, x: f64) -> Option<f64> {
    let (radius, off) = (wheel.radius.to_mm(), x - centre.x);
    (off.abs() <= radius).then(|| centre.z - wheel.lead.sin() * (radius * radius - off * off).sqrt())
}

fn leaning(lead: f64, beyond: f64) -> Wheel {
    let mut wheel = blades().wheel;
    wheel.lead = Angle::deg(lead);
    wheel.beyond = Length::mm(beyond);
    wheel
}

#[test]
fn measures_of_the_edge() {
    let close = |value: f64, expected: f64| assert!((value - expected).abs() < 6e-5, "{value} {expected}");
    for (lead, sink, along, falls) in [(3.0, 1.3084, 24.9657, 1.0467), (5.0, 2.1789, 24.9049, 1.7431)] {
        let wheel = leaning(lead, 0.0);
        close(wheel.sink().to_mm(), sink);
        close(wheel.overhang().to_mm(), along);
        // From the rim to the open side of a strip of 10 mm.
        let centre = wheel.centre_over(
            Extent {
                left: 0.0,
                right: 10.0,
                floor: 0.0,
            },
            Side::Left,
        );
        let fall = edge_over(&wheel, centre, 10.0).unwrap() - edge_over(&wheel, centre, 0.0).unwrap();
        close(fall, falls);
    }
    let wheel = leaning(3.0, 0.5);
    close((wheel.sink() - wheel.rise()).to_mm(), 0.2604);
    // Against a flank of slope 0.1 the edge is deepest at x* = 22.1499, 2.8217 below the flank through its centre.
    let flank = Profile::new(vec![Point2::new(-30.0, -3.0), Point2::new(30.0, 3.0)]).unwrap();
    close(wheel.entry(&flank, Point2::new(0.0, 0.0)), 2.8217);
    let steepness: f64 = 0.01 + wheel.lead.sin() * wheel.lead.sin();
    close(25.0 * 0.1 / steepness.sqrt(), 22.1499);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20))]

    #[test]
    fn entries_are_those_of_the_circle_in_space(
        heights in prop::collection::vec(0.0..20.0_f64, 12), lead in 0.0..8.0_f64, x in -10.0..120.0_f64, z in 5.0..30.0_f64,
    ) {
        let corners = (0_u32..).zip(&heights).map(|(i, &z)| Point2::new(10.0 * f64::from(i), z)).collect();
        let part = Profile::new(corners).unwrap();
        let wheel = leaning(lead, 0.0);
        let centre = Point2::new(x, z);
        let circle = swept(&wheel, centre);
        let within = circle.iter().filter(|point| (0.0..=110.0).contains(&point.x));
        let sampled = within.map(|point| part.height(point.x) - point.z).fold(f64::NEG_INFINITY, f64::max);
        let entry = wheel.entry(&part, centre);
        prop_assert!(entry >= sampled - 1e-9, "{entry} {sampled}");
        prop_assert!(entry <= sampled + 1e-2, "{entry} {sampled}");
    }
}

/// Heights of a surface at many x.
struct Raster {
    heights: Vec<f64>,
    slits: Vec<Slit>,
}

/// Samples in a millimetre.
const PER_MM: f64 = 20.0;

impl Raster {
    fn x(i: usize) -> f64 {
        // Between the places of cuts.
        (i as f64 + 0.4873) / PER_MM
    }

    /// Carries a pass out: over the rest of its cover only slivers may stand above the edge, the strip must end at a slit that
    /// reaches down to the edge or at what is as low, and the part must stay below.
    fn pass(&mut self, bound: &Profile, wheel: &Wheel, strip: &Strip) {
        let shave = wheel.sink().to_mm() + 1e-6;
        let ends = |x: f64, side: Side| {
            let edge = edge_over(wheel, strip.centre, x).unwrap();
            let by_slit = self
                .slits
                .iter()
                .any(|slit| (slit.x - x).abs() < 1e-6 && slit.bottom <= edge + TOUCH);
            let beside = match side {
                Side::Left => x - 1.0 / PER_MM,
                Side::Right => x + 1.0 / PER_MM,
            };
            let place = (beside * PER_MM) as usize;
            let is_low = beside < 0.0
                || self
                    .heights
                    .get(place)
                    .is_none_or(|&height| height <= edge + shave);
            by_slit || is_low
        };
        assert!(
            ends(strip.left, Side::Left) && ends(strip.right, Side::Right),
            "{strip:?}"
        );
        let body: Vec<f64> = wheel
            .body
            .iter()
            .map(|shaft| (shaft.radius + wheel.clearance).to_mm())
            .collect();
        for i in 0..self.heights.len() {
            let x = Self::x(i);
            let Some(edge) = edge_over(wheel, strip.centre, x) else {
                continue;
            };
            assert!(
                bound.height(x) <= edge + 1e-6,
                "the part at {x}: {} {edge}",
                bound.height(x)
            );
            let height = &mut self.heights[i];
            let off = (x - strip.centre.x).abs();
            assert!(
                body.iter()
                    .all(|&room| off > room - 1.1e-3 || *height <= strip.centre.z + 1e-6),
                "the body at {x}"
            );
            let is_strip = (strip.left..=strip.right).contains(&x);
            let is_undercut = match strip.open {
                Side::Left => x > strip.right,
                Side::Right => x < strip.left,
            };
            if is_strip {
                assert!(
                    *height - edge <= wheel.depth.to_mm() + 1e-6,
                    "a chip of {}",
                    *height - edge
                );
                *height = height.min(edge);
            } else if !is_undercut {
                assert!(
                    *height <= edge + shave,
                    "{} stands over {edge} at {x}: {strip:?}",
                    *height
                );
                *height = height.min(edge);
            }
        }
    }
}

fn check(sample: &Sample, bound: &Profile, blades: &Blades, plan: &PlannedRect) {
    let mut raster = Raster {
        heights: vec![sample.height; (sample.width * PER_MM) as usize],
        slits: Vec::new(),
    };
    for stage in &plan.stages {
        match stage {
            Stage::Slits { slits, .. } => {
                for &slit in slits {
                    let standoff = blades.knife.standoff.to_mm();
                    for off in [-standoff, 0.0, standoff] {
                        assert!(bound.height(slit.x + off) <= slit.bottom + 1e-6);
                    }
                    raster.slits.push(slit);
                }
            }
            Stage::Strips { strips, .. } => strips
                .iter()
                .for_each(|strip| raster.pass(bound, &blades.wheel, strip)),
        }
    }
    // The plan's contour is no lower than what is left, and no higher than the lead makes it.
    let sink = blades.wheel.sink().to_mm();
    for (i, &height) in raster.heights.iter().enumerate() {
        let x = Raster::x(i);
        let pairs = plan.contour.windows(2);
        let step = pairs
            .filter(|pair| pair[0].x <= x && x <= pair[1].x)
            .map(|pair| pair[0].z)
            .fold(0.0, f64::max);
        assert!(
            height <= step + 1.1e-3 && height >= step - sink - 1e-6,
            "{height} {step} at {x}"
        );
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(30))]

    #[test]
    fn plans_for_leaning_discs_come_out(
        ends in (2.0..45.0_f64, 2.0..50.0_f64, 2.0..50.0_f64, 2.0..45.0_f64), inner in (5.0..45.0_f64, 55.0..95.0_f64),
        lead in 0.0..6.0_f64, allowance in 0.0..3.0_f64, standoff in 0.0..1.0_f64, beyond in 0.0..1.0_f64,
        limit in 6.0..16.0_f64, residual in prop_oneof![Just(Residual::Lift), Just(Residual::Shift), Just(Residual::Mixed), Just(Residual::Discard)],
    ) {
        let (a, b, c, d) = ends;
        let sample = Sample::bezier([(0.0, a), (inner.0, b), (inner.1, c), (100.0, d)], 50.0);
        let bound = offset_up(&sample.part, Length::mm(allowance));
        let mut blades = blades();
        blades.knife.standoff = Length::mm(standoff);
        blades.wheel = Wheel { depth: Length::mm(10.0), width: Length::mm(14.0), ..leaning(lead, beyond) };
        let mut wish = Wish {
            layer: Auto::Auto,
            step: Auto::Auto,
            through: Auto::Auto,
            rounding: Rounding::Grid,
            worth: WORTH,
            ..wish(residual)
        };
        wish.limits.scallop = Some(Length::mm(limit)).filter(|_| residual == Residual::Mixed);
        let work = Work { bound: &bound, allowance: Length::mm(allowance), ..sample.work() };
        match plan(work, &blades, &wish, 100_000) {
            Ok(plan) => check(&sample, &bound, &blades, &plan),
            Err(Refusal::Scallop { .. } | Refusal::Closed(_) | Refusal::Nothing) => {}
            Err(other) => prop_assert!(false, "{:?}", other),
        }
    }
}
