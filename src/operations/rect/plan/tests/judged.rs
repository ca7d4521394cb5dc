//! Random parts: whatever is planned must come out before the judge, and what is refused as closed must really be stuck.

use super::judge::{Judge, Pass, carried_out};
use super::*;
use crate::plan::blades::Extent;
use crate::plan::ground::{Ground, Sizes, Terms};
use crate::plan::layout::{Layout, Piece};
use crate::plan::slits::of_group;
use proptest::prelude::*;
use vcutc_geometry::offset::offset_up;
use vcutc_simulation::surface::Side;

fn curve() -> impl Strategy<Value = Sample> {
    let end = 2.0..50.0_f64;
    let inner = (5.0..45.0_f64, 55.0..95.0_f64);
    (end.clone(), end.clone(), end.clone(), end, inner)
        .prop_map(|(a, b, c, d, (x, y))| Sample::bezier([(0.0, a), (x, b), (y, c), (100.0, d)], 50.0))
}

fn discs() -> impl Strategy<Value = Blades> {
    let beyond = prop_oneof![Just(0.0), 0.1..0.6_f64];
    let standoff = prop_oneof![Just(0.0), 0.1..1.0_f64];
    let flange = prop_oneof![Just(None), (3.0..30.0_f64, 10.0..40.0_f64).prop_map(Some)];
    let covers = prop_oneof![Just(Cover::Standing), Just(Cover::Uncut), Just(Cover::Uncut)];
    (15.0..60.0_f64, 4.0..9.0_f64, beyond, standoff, flange, covers).prop_map(
        |(radius, shank, beyond, standoff, flange, covers)| {
            let mut blades = blades();
            blades.knife.covers = covers;
            blades.knife.standoff = Length::mm(standoff);
            let wheel = &mut blades.wheel;
            wheel.radius = Length::mm(radius);
            wheel.beyond = Length::mm(beyond);
            wheel.clearance = Length::mm(0.5);
            let shaft = |from, radius| Shaft {
                from: Length::mm(from),
                radius: Length::mm(radius),
            };
            wheel.body = core::iter::once(shaft(0.0, shank))
                .chain(flange.map(|(from, radius)| shaft(from, radius)))
                .collect();
            blades
        },
    )
}

fn residuals() -> impl Strategy<Value = Residual> {
    prop_oneof![
        Just(Residual::Discard),
        Just(Residual::Lift),
        Just(Residual::Shift),
        Just(Residual::Mixed)
    ]
}

/// Whether strips that were laid out by a strategy can be freed in any order, by trying each from both sides again and again: how
/// many cannot. All slits are there from the beginning, which helps at most.
fn stuck(sample: &Sample, blades: &Blades, wish: &Wish, sizes: Sizes) -> usize {
    let terms = Terms {
        work: sample.work(),
        knife: &blades.knife,
        wheel: &blades.wheel,
        down_to: Length::ZERO,
        rounding: wish.rounding,
        worth: wish.worth,
    };
    let ground = Ground::new(terms, sizes);
    let layout = match wish.residual.or(Residual::Mixed) {
        Residual::Discard => Layout::discard(&ground),
        Residual::Lift => Layout::lift(&ground),
        Residual::Shift | Residual::Mixed => Layout::shift(&ground),
    };
    let mut terrain = ground.before();
    let layers = layout.pieces.chunk_by(|one, next| one.layer == next.layer);
    let slits: Vec<Slit> = layers
        .flat_map(|layer| of_group(&ground, layer, &mut terrain))
        .collect();
    let from = |piece: &Piece, open| {
        let Extent { left, right, floor } = piece.extent;
        let (radius, beyond) = (blades.wheel.radius.to_mm(), blades.wheel.beyond.to_mm());
        let x = if open == Side::Left {
            right + beyond - radius
        } else {
            left - beyond + radius
        };
        Pass {
            centre: Point2::new(x, floor),
            left,
            right,
            open,
        }
    };
    let both = |piece: &Piece| [from(piece, Side::Left), from(piece, Side::Right)];
    let passes: Vec<Pass> = layout.pieces.iter().flat_map(both).collect();
    let mut judge = Judge::new(sample, &sample.part, blades, &slits, &passes);
    slits.iter().for_each(|&slit| judge.presume(slit));
    let mut left = layout.pieces;
    loop {
        let before = left.len();
        left.retain(|piece| {
            // Through a strip above it would be a pass for the two at once.
            let Extent { left, right, .. } = piece.extent;
            let is_uncovered = judge.highest_over(left, right) <= piece.top + 1e-6;
            // The slits of lower layers are there already and may cut a little of the neighbour off.
            let mut frees = |pass| {
                judge.pass(pass).is_ok() && judge.highest_over(left, right) <= piece.extent.floor + 1e-6
            };
            !(is_uncovered && both(piece).into_iter().any(&mut frees))
        });
        if left.len() == before {
            return before;
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(25))]

    #[test]
    fn plans_come_out_and_closed_places_are_stuck(
        sample in curve(), blades in discs(), residual in residuals(), layer in 6.0..10.0_f64, share in 0.3..1.0_f64,
        through in 1..3_u32, limit in prop_oneof![Just(None), (3.0..15.0_f64).prop_map(Some)],
    ) {
        let (widest, _) = blades.wheel.widest_strip(Length::mm(layer));
        prop_assume!(widest.to_mm() > 5.0);
        let step = (widest.to_mm() * share).max(5.0);
        let layer = layer / f64::from(through);
        let through = if residual == Residual::Shift { 1 } else { through };
        let mut wish = Wish {
            layer: Auto::Given(Length::mm(layer)),
            step: Auto::Given(Length::mm(step)),
            through: Auto::Given(through),
            worth: WORTH,
            ..wish(residual)
        };
        wish.limits.scallop = limit.filter(|_| residual == Residual::Mixed).map(Length::mm);
        match sample.plan(&blades, &wish) {
            Ok(plan) => carried_out(&sample, &sample.part, &blades, &[&plan]),
            Err(Refusal::Closed(closed)) => {
                if residual != Residual::Mixed {
                    let stuck = stuck(&sample, &blades, &wish, Sizes { layer, step });
                    prop_assert_eq!(stuck, closed.strips);
                }
                prop_assert!(closed.left < closed.right);
                if let Some(down_to) = closed.down_to {
                    wish.down_to = down_to;
                    let plan = sample.plan(&blades, &wish);
                    prop_assert!(plan.is_ok(), "{:?}", plan.err());
                    let lowest = plan.unwrap().strips().map(|strip| strip.floor).fold(f64::INFINITY, f64::min);
                    prop_assert!(lowest >= down_to.to_mm() - 1e-9);
                }
            }
            Err(Refusal::TooHighForSlit { top, bottom, needed, edge, .. }) => {
                prop_assert!(blades.knife.covers == Cover::Standing);
                prop_assert!(needed > edge && top.to_mm() - bottom.to_mm() > 10.0);
            }
            Err(Refusal::Scallop { left, limit, .. }) => prop_assert!(left > limit),
            Err(Refusal::Nothing) => {}
            Err(other) => prop_assert!(false, "{:?}", other),
        }
    }

    /// On the grid, with an allowance and everything open.
    #[test]
    fn open_values_come_to_plans_that_come_out(
        sample in curve(), blades in discs(), allowance in 0.0..4.0_f64, limit in 4.0..16.0_f64,
    ) {
        let bound = offset_up(&sample.part, Length::mm(allowance));
        prop_assume!(blades.wheel.widest_strip(Length::mm(10.0)).0.to_mm() > 5.0);
        let mut wish = Wish {
            layer: Auto::Auto,
            step: Auto::Auto,
            through: Auto::Auto,
            rounding: Rounding::Grid,
            worth: WORTH,
            ..wish(Residual::Mixed)
        };
        wish.limits.scallop = Some(Length::mm(limit));
        wish.limits.step.least = Some(Length::mm(5.0));
        wish.limits.layer.least = Some(Length::mm(4.0));
        let work = Work { bound: &bound, allowance: Length::mm(allowance), ..sample.work() };
        match plan(work, &blades, &wish, 100_000) {
            Ok(plan) => {
                prop_assert!(plan.left.to_mm() <= limit + 1.1e-3);
                carried_out(&sample, &bound, &blades, &[&plan]);
            }
            Err(
                Refusal::Scallop { .. }
                | Refusal::Closed(_)
                | Refusal::TooHighForSlit { .. }
                | Refusal::Nothing,
            ) => {}
            Err(other) => prop_assert!(false, "{:?}", other),
        }
    }

    /// A second operation with other sizes cuts what a first one has left.
    #[test]
    fn what_an_operation_before_left_comes_out(
        sample in curve(), blades in discs(), residual in residuals(), other in residuals(),
        layers in (6.0..10.0_f64, 4.0..10.0_f64), steps in (5.0..15.0_f64, 5.0..15.0_f64), down_to in 10.0..40.0_f64,
        limit in prop_oneof![Just(None), (3.0..15.0_f64).prop_map(Some)],
    ) {
        let sized = |layer: f64, step: f64, residual| {
            let (widest, _) = blades.wheel.widest_strip(Length::mm(layer));
            (widest.to_mm() > 5.0).then(|| Wish {
                layer: Auto::Given(Length::mm(layer)),
                step: Auto::Given(Length::mm(step.min(widest.to_mm()))),
                worth: WORTH,
                ..wish(residual)
            })
        };
        let (Some(mut first), Some(mut second)) = (sized(layers.0, steps.0, residual), sized(layers.1, steps.1, other)) else {
            return Ok(());
        };
        first.down_to = Length::mm(down_to);
        second.limits.scallop = limit.filter(|_| other == Residual::Mixed).map(Length::mm);
        let Ok(above) = sample.plan(&blades, &first) else { return Ok(()) };
        let before = above.contour.clone();
        let work = Work { before: &before, ..sample.work() };
        match plan(work, &blades, &second, 100_000) {
            Ok(below) => {
                prop_assert!(below.left <= above.left + Length::mm(1e-6));
                carried_out(&sample, &sample.part, &blades, &[&above, &below]);
            }
            Err(
                Refusal::Closed(_)
                | Refusal::TooHighForSlit { .. }
                | Refusal::Scallop { .. }
                | Refusal::Nothing,
            ) => {}
            Err(other) => prop_assert!(false, "{:?}", other),
        }
    }
}
