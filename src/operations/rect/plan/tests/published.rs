//! What the comparison of both processes says of thresholds, break-even and times, by the closed model and by plans.

use super::*;
use crate::plan::model::{Comparison, RectCut, VCut, cuts_per_strip};

fn close(value: f64, expected: f64, tolerance: f64) {
    assert!(
        (value - expected).abs() <= tolerance,
        "{value}, expected {expected}"
    );
}

fn cuts(slits: f64, strips: f64, changes: f64) -> RectCut {
    RectCut {
        slits,
        strips,
        changes,
        layers: 0.0,
        slit_extension: Length::ZERO,
        strip_extension: Length::ZERO,
        slit_turn: Angle::ZERO,
        strip_turn: Angle::ZERO,
    }
}

fn pace(ratio: f64) -> Pace {
    let pace = blades().pace;
    Pace {
        free: pace.slit * ratio,
        ..pace
    }
}

/// With as many slits as strips, the threshold is 0.6 if there are 4/3 Vs for a strip.
#[test]
fn threshold_of_the_feeds() {
    let even = |cuts_per_strip: f64| {
        let comparison = Comparison {
            v: VCut {
                cuts: 30.0 * cuts_per_strip,
                extension: Length::ZERO,
            },
            rect: cuts(30.0, 30.0, 0.0),
        };
        comparison.even_ratio().unwrap()
    };
    let depth = Length::mm(10.0);
    let swing = Angle::deg(30.0);
    // Equal depths and widths: 1 / cos^2(30 deg).
    let step = 2.0 * depth * swing.tan();
    let per_strip = cuts_per_strip(depth, step, depth, swing);
    close(per_strip, 4.0 / 3.0, 1e-9);
    close(even(per_strip), 0.6, 1e-9);
    let square = cuts_per_strip(depth, depth, depth, swing);
    close(square, 2.0 / 3.0_f64.sqrt(), 1e-9);
    close(even(square), 1.0 / (4.0 / 3.0_f64.sqrt() - 1.0), 1e-9);
    close(even(square), 0.7637, 5e-5);
}

fn specimen(changes: f64) -> Comparison {
    Comparison {
        v: VCut {
            cuts: 40.0,
            extension: Length::ZERO,
        },
        rect: cuts(30.0, 30.0, changes),
    }
}

#[test]
fn surfaces_are_parallel_at_the_threshold() {
    let pace = pace(0.6);
    for length in [10.0, 1000.0, 12_345.0] {
        let length = Length::mm(length);
        let gap = specimen(12.0).rect.time(length, &pace) - specimen(12.0).v.time(length, pace.slit);
        close(gap.to_s(), 120.0, 1e-9);
    }
}

#[test]
fn far_from_the_threshold_one_process_wins() {
    let comparison = specimen(12.0);
    let slow = pace(0.3);
    let length = Length::m(1.0);
    let (v, rect) = (
        comparison.v.time(length, slow.slit),
        comparison.rect.time(length, &slow),
    );
    close(v.to_s(), 480.0, 1e-9);
    close(rect.to_s(), 900.0, 1e-9);
    close(rect / v, 1.875, 1e-9);
    let fast = pace(1.0);
    close(comparison.even_length(&fast).unwrap().to_mm(), 1000.0, 1e-9);
    let half = Pace {
        slit: fast.slit * 0.5,
        free: fast.free * 0.5,
        ..fast
    };
    close(comparison.even_length(&half).unwrap().to_mm(), 500.0, 1e-9);
}

/// Slits through two layers: half of them, and half of the changes.
#[test]
fn slits_through_two_layers_lower_the_threshold() {
    let comparison = Comparison {
        rect: cuts(15.0, 30.0, 6.0),
        ..specimen(0.0)
    };
    close(comparison.even_ratio().unwrap(), 30.0 / 65.0, 1e-9);
    close(
        comparison.even_length(&pace(0.6)).unwrap().to_mm(),
        1000.0 * 10.0 / 15.0,
        1e-9,
    );
}

fn block() -> Sample {
    Sample::flat(60.0, 70.0)
}

/// The planned block, with as many Vs as this compiler plans for it.
fn compared(plan: &PlannedRect, v_cuts: f64, extension: f64) -> Comparison {
    let Blades {
        knife, wheel, pace, ..
    } = blades();
    Comparison {
        v: VCut {
            cuts: v_cuts,
            extension: Length::mm(extension),
        },
        rect: RectCut::of(plan.counts(), &knife, &wheel, &pace),
    }
}

#[test]
fn the_block_is_36_strips_between_30_slits() {
    let mut wish = wish(Residual::Mixed);
    wish.limits.scallop = Some(Length::mm(9.9));
    let plan = block().plan(&blades(), &wish).unwrap();
    let counts = plan.counts();
    assert_eq!(
        (counts.strips, counts.slits, counts.layers, counts.changes),
        (36, 30, 6, 11)
    );
    assert_eq!(plan.left, Length::ZERO);
    let v30 = compared(&plan, 45.0, 13.345);
    close(v30.even_ratio().unwrap(), 0.6, 1e-9);
    let length = Length::m(1.0);
    let sixth = pace(0.6);
    close(v30.v.time(length, sixth.slit).to_s(), 554.4, 0.05);
    close(
        (v30.rect.time(length, &sixth) - v30.v.time(length, sixth.slit)).to_s(),
        116.31,
        0.02,
    );
    for (ratio, time) in [(0.3, 1048.73), (0.6, 670.73), (1.0, 519.53)] {
        close(v30.rect.time(length, &pace(ratio)).to_s(), time, 0.01);
    }
    let best = compared(&plan, 41.0, 13.287);
    close(best.v.time(length, sixth.slit).to_s(), 505.07, 0.01);
    close(best.even_ratio().unwrap(), 0.6923, 5e-5);
    close(v30.even_length(&pace(1.0)).unwrap().to_mm(), 757.73, 0.05);
    close(best.even_length(&pace(1.0)).unwrap().to_mm(), 1150.53, 0.1);
    let feed =
        |comparison: &Comparison| comparison.even_feed(length, &pace(1.0)).unwrap().to_mm_per_s() * 0.06;
    close(feed(&v30), 8.667, 1e-3);
    close(feed(&best), 10.681, 1e-3);
}

/// With a limit as high as the layer, the last layer may stay.
#[test]
fn a_limit_of_one_layer_leaves_one_out() {
    let mut wish = wish(Residual::Mixed);
    wish.limits.scallop = Some(Length::mm(10.0));
    let plan = block().plan(&blades(), &wish).unwrap();
    let counts = plan.counts();
    assert_eq!(
        (counts.strips, counts.slits, counts.layers, counts.changes),
        (30, 25, 5, 9)
    );
    close(plan.left.to_mm(), 10.0, 1e-9);
    close(compared(&plan, 45.0, 13.345).even_ratio().unwrap(), 0.4615, 5e-5);
    close(compared(&plan, 41.0, 13.287).even_ratio().unwrap(), 0.5263, 5e-5);
}

/// The planned time adds ways, which at these speeds hardly count.
#[test]
fn planned_times_are_those_of_the_material_and_little_more() {
    let mut wish = wish(Residual::Discard);
    wish.limits.scallop = Some(Length::mm(9.9));
    let plan = block().plan(&blades(), &wish).unwrap();
    let without = compared(&plan, 45.0, 13.345)
        .rect
        .time(Length::m(1.0), &blades().pace);
    assert!(
        plan.time > without && plan.time.to_s() < without.to_s() * 1.005,
        "{:?}",
        plan.time
    );
}
