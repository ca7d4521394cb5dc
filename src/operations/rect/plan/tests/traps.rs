//! Places where plans go wrong by a hair or by a thought not thought.

use super::judge::carried_out;
use super::*;
use crate::plan::blades::{Extent, Hold, WidthBound};
use crate::plan::refusal::Closed;
use crate::plan::slits::entry;
use vcutc_backend_api::ir::Edges;
use vcutc_diagnostics::source::{FileId, Span};
use vcutc_job::{Body, BodyStage, Disc, Sourced, StraightBlade};
use vcutc_simulation::surface::Side;

fn planned(sample: &Sample, wish: &Wish) -> PlannedRect {
    let blades = blades();
    let plan = sample.plan(&blades, wish).unwrap();
    carried_out(sample, &sample.part, &blades, &[&plan]);
    plan
}

fn given(size: f64) -> Auto<Length> {
    Auto::Given(Length::mm(size))
}

#[test]
fn a_multiple_of_the_step_up_to_rounding() {
    // A tenth has no exact double, so neither have its sums.
    let step = 0.1 + 0.2;
    assert!(60.0 * 0.3 < 60.0 * step);
    for (width, step, strips) in [
        (60.0, 10.0, 6),
        (60.0 * 0.3, step, 60),
        (60.0 * step, 0.3, 60),
        (61.0, 10.0, 7),
    ] {
        let sample = Sample::through(&[(0.0, 40.0), (width, 40.0)], 50.0);
        for residual in [Residual::Discard, Residual::Shift] {
            let plan = planned(
                &sample,
                &Wish {
                    step: given(step),
                    ..wish(residual)
                },
            );
            assert_eq!(plan.counts().strips, strips, "{width} {step}");
        }
    }
}

#[test]
fn the_last_layer_is_thinner() {
    let sample = Sample::through(&[(0.0, 13.0), (60.0, 13.0)], 50.0);
    let plan = planned(&sample, &wish(Residual::Discard));
    assert_eq!(plan.levels, [40.0, 30.0, 20.0, 13.0]);
    assert_eq!(plan.counts().strips, 24);
    assert_eq!(plan.left, Length::ZERO);
    // A whole number of layers up to rounding has no further one.
    let tenths = Sample::through(&[(0.0, 0.7), (60.0, 0.7)], 1.0);
    let plan = planned(
        &tenths,
        &Wish {
            layer: given(0.1),
            ..wish(Residual::Discard)
        },
    );
    assert_eq!(plan.levels.len(), 3);
}

/// The valley of the comparison: its first layer is free, the other fifteen strips are stuck.
#[test]
fn a_closed_valley_is_refused_with_its_place() {
    let sample = Sample::valley();
    let refused = sample.plan(&blades(), &wish(Residual::Shift)).unwrap_err();
    let Refusal::Closed(closed) = refused else {
        panic!("{refused:?}");
    };
    let Closed {
        layer,
        left,
        right,
        strips,
        down_to,
    } = closed;
    assert_eq!((layer, strips), (2, 15));
    let half = 50.0 * (2.0_f64 / 3.0).sqrt();
    assert!((left.to_mm() - (50.0 - half)).abs() < 1e-2 && (right.to_mm() - (50.0 + half)).abs() < 1e-2);
    assert_eq!(down_to, Some(Length::mm(40.0)));
    let plan = planned(
        &sample,
        &Wish {
            down_to: Length::mm(40.0),
            ..wish(Residual::Shift)
        },
    );
    assert_eq!(plan.counts().strips, 10);
}

/// Two hollows, of which the left one opens to the side.
#[test]
fn the_height_that_opens_a_valley_is_the_lower_crest() {
    let corners = [
        (0.0, 33.0),
        (20.0, 36.0),
        (50.0, 12.0),
        (80.0, 44.0),
        (100.0, 45.0),
    ];
    let refused = Sample::through(&corners, 50.0)
        .plan(&blades(), &wish(Residual::Lift))
        .unwrap_err();
    let Refusal::Closed(closed) = refused else {
        panic!("{refused:?}");
    };
    assert_eq!(closed.down_to, Some(Length::mm(36.0)));
}

#[test]
fn a_pocket_of_one_strip_is_closed() {
    let sample = Sample::through(
        &[
            (0.0, 50.0),
            (29.9, 50.0),
            (30.0, 20.0),
            (36.0, 20.0),
            (36.1, 50.0),
            (60.0, 50.0),
        ],
        50.0,
    );
    let refused = sample.plan(&blades(), &wish(Residual::Shift)).unwrap_err();
    let Refusal::Closed(closed) = refused else {
        panic!("{refused:?}");
    };
    assert_eq!((closed.layer, closed.strips, closed.down_to), (1, 3, None));
}

/// Where the part is as high as the stock, nothing is cut and walls stay; at the sides of the stock there are no slits.
#[test]
fn a_part_as_high_as_the_stock_in_places() {
    let sample = Sample::through(&[(0.0, 50.0), (30.0, 50.0), (30.001, 30.0), (100.0, 30.0)], 50.0);
    let plan = planned(&sample, &wish(Residual::Discard));
    // Six columns of two layers beside one wall: as many slits as strips.
    let counts = plan.counts();
    assert_eq!((counts.strips, counts.slits), (12, 12));
    assert!(
        plan.strips()
            .all(|strip| strip.left >= 40.0 && strip.open == Side::Right)
    );
    assert!(plan.slits().all(|slit| slit.x >= 40.0 && slit.x <= 90.0));
    let wide = Wish {
        step: given(13.0),
        ..wish(Residual::Shift)
    };
    let plan = planned(&sample, &wide);
    let walls = plan.slits().filter(|slit| (slit.x - 30.001).abs() < 1e-3).count();
    assert_eq!((plan.counts().strips, plan.counts().slits, walls), (12, 12, 2));
}

/// A stock as narrow as one strip needs no slit, so the straight blade never comes.
#[test]
fn nothing_to_slit() {
    let plan = planned(&Sample::flat(9.0, 50.0), &wish(Residual::Discard));
    assert_eq!(plan.stages.len(), 1);
    assert_eq!(
        (plan.counts().slits, plan.counts().strips, plan.counts().changes),
        (0, 4, 0)
    );
}

#[test]
fn a_disc_larger_than_the_stock() {
    let mut blades = blades();
    blades.wheel.radius = Length::mm(60.0);
    let sample = Sample::flat(60.0, 70.0);
    let plan = sample.plan(&blades, &wish(Residual::Discard)).unwrap();
    carried_out(&sample, &sample.part, &blades, &[&plan]);
    assert_eq!(plan.counts().strips, 36);
    assert!(
        plan.strips()
            .all(|strip| strip.centre.x < 1e-9 || strip.centre.x > 60.0 - 1e-9)
    );
}

/// On both sides of a crest strips are cut towards it.
#[test]
fn no_pass_goes_over_a_crest() {
    let plan = planned(&Sample::language(), &wish(Residual::Lift));
    let crest = Sample::language().part.highest().x;
    for strip in plan.strips().filter(|strip| strip.floor < 28.0) {
        let open = if strip.right <= crest {
            Side::Left
        } else {
            Side::Right
        };
        assert_eq!(strip.open, open, "{strip:?}");
        assert!(strip.right <= crest || strip.left >= crest - 10.0);
    }
    let sides: Vec<Side> = plan.strips().map(|strip| strip.open).collect();
    assert!(sides.contains(&Side::Left) && sides.contains(&Side::Right));
}

/// From left to right throughout, the disc would cut through the crest of the language page's part.
#[test]
fn passes_over_the_crest_would_enter_the_part() {
    let sample = Sample::language();
    let plan = planned(&sample, &wish(Residual::Lift));
    let wheel = blades().wheel;
    let entry = |strip: &Strip, open| {
        let extent = Extent {
            left: strip.left,
            right: strip.right,
            floor: strip.floor,
        };
        wheel.entry(&sample.part, wheel.centre_over(extent, open))
    };
    let naive = plan
        .strips()
        .map(|strip| entry(strip, Side::Left))
        .fold(0.0, f64::max);
    assert!(naive > 0.49, "{naive}");
    assert!(plan.strips().all(|strip| entry(strip, strip.open) < 1e-9));
}

/// A strip as wide as the body lets it be is cut, a nanometre more is too wide.
#[test]
fn strips_as_wide_as_the_body_lets_them_be() {
    let sample = Sample::through(&[(0.0, 40.0), (64.0, 40.0)], 50.0);
    let plan = planned(
        &sample,
        &Wish {
            step: given(16.0),
            ..wish(Residual::Discard)
        },
    );
    assert_eq!(plan.counts().strips, 4);
    let wide = sample.plan(
        &blades(),
        &Wish {
            step: given(16.001),
            ..wish(Residual::Discard)
        },
    );
    let Err(Refusal::TooWide { widest, limit, bound }) = wide else {
        panic!("{wide:?}");
    };
    assert!((widest.to_mm() - 16.001).abs() < 1e-9 && (limit.to_mm() - 16.0).abs() < 1e-9);
    assert_eq!(bound, WidthBound::Body { stage: 0 });
    let mut narrow = blades();
    narrow.wheel.width = Length::mm(9.0);
    let wide = sample.plan(&narrow, &wish(Residual::Discard));
    assert!(matches!(
        wide,
        Err(Refusal::TooWide {
            bound: WidthBound::Disc,
            ..
        })
    ));
}

#[test]
fn layers_deeper_than_edge_or_chip_allow() {
    let sample = Sample::flat(60.0, 50.0);
    let deep = sample.plan(
        &blades(),
        &Wish {
            layer: given(12.0),
            ..wish(Residual::Discard)
        },
    );
    let Err(Refusal::TooDeepForSlits { needed, edge, .. }) = deep else {
        panic!("{deep:?}");
    };
    assert!((needed.to_mm() - 15.052).abs() < 1e-3 && (edge.to_mm() - 12.543).abs() < 1e-9);
    let mut leaning = blades();
    leaning.wheel.depth = Length::mm(10.0);
    leaning.wheel.lead = Angle::deg(3.0);
    let thick = sample.plan(&leaning, &wish(Residual::Discard));
    let Err(Refusal::TooThick { chip, depth, .. }) = thick else {
        panic!("{thick:?}");
    };
    assert!((chip.to_mm() - 11.308).abs() < 1e-3);
    assert_eq!(depth, Length::mm(10.0));
    // Left open it is the thickest that both take.
    let open = sample
        .plan(
            &leaning,
            &Wish {
                layer: Auto::Auto,
                ..wish(Residual::Discard)
            },
        )
        .unwrap();
    assert!(
        (open.layer.to_mm() - (10.0 - 1.3084)).abs() < 1e-4,
        "{:?}",
        open.layer
    );
}

#[test]
fn an_edge_that_does_not_lead_cuts_no_slit() {
    let mut blades = blades();
    blades.knife.rake = Angle::deg(7.0);
    let refused = Sample::straight().plan(&blades, &wish(Residual::Lift));
    assert!(matches!(refused, Err(Refusal::NoEdge { .. })));
}

/// Blades as jobs define them.
#[test]
fn blades_of_a_job() {
    let span = Span {
        file: FileId::ALONE,
        start: 0,
        end: 0,
    };
    let mm = |mm: f64| Sourced {
        value: Length::mm(mm),
        span: None,
    };
    let stage = |from, radius| BodyStage {
        from: mm(from),
        radius: mm(radius),
    };
    let disc = Disc {
        name: "wheel".to_owned(),
        span,
        radius: mm(25.0),
        thickness: mm(1.5),
        depth: mm(10.0),
        width: mm(12.0),
        spin: Sourced {
            value: AngularSpeed::deg_per_s(360.0),
            span: None,
        },
        body: Body {
            span,
            stages: vec![stage(0.0, 8.0), stage(60.0, 25.0)],
        },
        forces: None,
    };
    let hold = Hold {
        lead: Angle::ZERO,
        beyond: Length::mm(0.5),
        clearance: Length::mm(1.0),
    };
    let wheel = Wheel::of(&disc, hold);
    let (limit, bound) = wheel.widest_strip(Length::mm(10.0));
    assert_eq!((limit, bound), (Length::mm(12.0), WidthBound::Disc));
    let wide = Disc {
        width: mm(30.0),
        ..disc
    };
    let (limit, bound) = Wheel::of(&wide, hold).widest_strip(Length::mm(10.0));
    assert!((limit.to_mm() - 15.5).abs() < 1e-9);
    assert_eq!(bound, WidthBound::Body { stage: 0 });
    let dagger = StraightBlade {
        name: "dagger".to_owned(),
        span,
        cutting_length: mm(12.543),
        half_apex: Sourced {
            value: Angle::deg(7.13),
            span: None,
        },
        thickness: mm(1.5),
        edges: Edges::Double,
        body: None,
        forces: None,
    };
    let knife = Knife::of(&dagger, Angle::deg(60.0), Auto::Auto, Cover::Uncut);
    assert_eq!(knife.standoff, Length::mm(0.75));
    assert!((knife.deepest().to_mm() - 10.0).abs() < 1e-3);
}

#[test]
fn what_cannot_be_planned_is_said() {
    let none = Sample::through(&[(0.0, 50.0), (60.0, 50.0)], 50.0);
    assert_eq!(none.plan(&blades(), &wish(Residual::Lift)), Err(Refusal::Nothing));
    let sample = Sample::straight();
    let through = Wish {
        layer: given(5.0),
        through: Auto::Given(2),
        ..wish(Residual::Shift)
    };
    assert_eq!(
        sample.plan(&blades(), &through),
        Err(Refusal::NoColumns { through: 2 })
    );
    let mut tight = wish(Residual::Lift);
    tight.limits.scallop = Some(Length::mm(2.8));
    let refused = sample.plan(&blades(), &tight);
    assert!(matches!(refused, Err(Refusal::Scallop { left, .. }) if (left.to_mm() - 2.8735).abs() < 1e-3));
    tight.step = Auto::Auto;
    let plan = planned(&sample, &tight);
    assert!(plan.left.to_mm() <= 2.8 && plan.step.to_mm() < 10.0);
    let mut few = wish(Residual::Lift);
    few.limits.changes = Some(3);
    assert_eq!(
        sample.plan(&blades(), &few),
        Err(Refusal::Over(Over::Changes(Exceeded {
            found: 7,
            limit: 3,
            works: Some(7)
        })))
    );
    for size in [0.0, 1e-9, f64::NAN, f64::INFINITY] {
        let odd = Wish {
            layer: given(size),
            ..wish(Residual::Lift)
        };
        assert!(sample.plan(&blades(), &odd).is_err(), "{size}");
        let odd = Wish {
            step: given(size),
            ..wish(Residual::Lift)
        };
        assert!(sample.plan(&blades(), &odd).is_err(), "{size}");
    }
}

/// A wall higher than the edge beside a slit: what has been cut there before is not cut again.
#[test]
fn a_slit_beside_a_high_wall_is_refused() {
    let sample = Sample::through(&[(0.0, 10.0), (50.0, 10.0), (50.01, 45.0), (100.0, 45.0)], 50.0);
    let wish = wish(Residual::Discard);
    let mut blades = blades();
    let plan = sample.plan(&blades, &wish).unwrap();
    carried_out(&sample, &sample.part, &blades, &[&plan]);
    assert!(plan.slits().all(|slit| slit.uncut - slit.bottom < 10.0 + 1e-9));
    blades.knife.covers = Cover::Standing;
    let refused = sample.plan(&blades, &wish);
    assert!(
        matches!(refused, Err(Refusal::TooHighForSlit { x, .. }) if x == Length::mm(50.0)),
        "{refused:?}"
    );
}

#[test]
fn a_thick_blade_keeps_off_the_part() {
    let mut blades = blades();
    blades.knife.standoff = Length::mm(1.0);
    let sample = Sample::straight();
    let plan = sample.plan(&blades, &wish(Residual::Shift)).unwrap();
    carried_out(&sample, &sample.part, &blades, &[&plan]);
    let slit = Slit {
        x: 50.0,
        bottom: 25.3,
        uncut: 30.0,
        top: 30.0,
    };
    assert_eq!(entry(slit, &sample.part, &blades.knife), None);
    let lower = Slit {
        bottom: 25.299,
        ..slit
    };
    let entered = entry(lower, &sample.part, &blades.knife).unwrap();
    assert!((entered - 1e-3).abs() < 1e-9);
}

/// A sample of which operations before have left a floor at 20 mm, a strip at its left, and a block of 2.5 mm on it.
fn with_a_block(height: f64) -> Sample {
    let mut sample = Sample::flat(100.0, 50.0);
    let corners = [
        (0.0, 30.0),
        (10.0, 30.0),
        (10.0, 20.0),
        (42.0, 20.0),
        (42.0, 20.0 + height),
        (44.5, 20.0 + height),
        (44.5, 20.0),
        (100.0, 20.0),
    ];
    sample.before = corners.map(|(x, z)| Point2::new(x, z)).to_vec();
    sample
}

#[test]
fn scraps_of_operations_before_are_left() {
    let counted = |sample: &Sample, blades: &Blades, wish: &Wish| {
        let plan = sample.plan(blades, wish).unwrap();
        plan.counts().strips
    };
    let upper = Wish {
        worth: WORTH,
        down_to: Length::mm(20.0),
        ..wish(Residual::Discard)
    };
    // A twentieth of a strip is 5 mm2.
    assert_eq!(counted(&with_a_block(2.1), &blades(), &upper), 2);
    let scrap = with_a_block(1.9);
    assert_eq!(counted(&scrap, &blades(), &upper), 1);
    // It comes out with the strip below, where both blades go so deep.
    let mut long = blades();
    long.knife.edge = Length::mm(16.0);
    let lower = Wish {
        worth: WORTH,
        ..wish(Residual::Discard)
    };
    let plan = scrap.plan(&long, &lower).unwrap();
    assert_eq!(plan.counts().strips, 1 + 10);
    let strip = plan.strips().find(|strip| strip.left == 40.0).unwrap();
    assert_eq!((strip.top, strip.floor), (21.9, 10.0));
    assert_eq!(counted(&scrap, &blades(), &lower), 2 + 10);
    // It is cut all the same where less may stay, and where the disc takes no thicker strip.
    let mut limited = upper;
    limited.limits.scallop = Some(Length::mm(11.0));
    assert_eq!(counted(&scrap, &blades(), &limited), 2);
    let mut thin = long;
    thin.wheel.depth = Length::mm(11.0);
    assert_eq!(counted(&scrap, &thin, &lower), 2 + 10);
    // Nothing but scraps is nothing to cut.
    let mut alone = scrap;
    alone.before = alone.before.split_off(2);
    alone.before.insert(0, Point2::new(0.0, 20.0));
    assert_eq!(
        alone
            .plan(
                &blades(),
                &Wish {
                    layer: given(30.0),
                    ..limited.clone()
                }
            )
            .err(),
        None
    );
    limited.limits.scallop = None;
    assert_eq!(
        alone
            .plan(
                &blades(),
                &Wish {
                    layer: given(30.0),
                    ..limited
                }
            )
            .err(),
        Some(Refusal::Nothing)
    );
}
