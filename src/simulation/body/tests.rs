//! Shadows against the numbers of the design and against points sampled in space.

use super::shadow::Shadow;
use super::slant::Slant;
use super::stage::{Axis, Cylinder};
use crate::course::Way;
use crate::course::samples::height;
use proptest::prelude::*;
use vcutc_backend_api::geometry::{Orientation, Point3};
use vcutc_backend_api::ir::{BodyStage, Stock};
use vcutc_backend_api::units::{Angle, Length};
use vcutc_geometry::curve::Point2;

const STOCK: Stock = Stock {
    width: Length::mm(100.0),
    depth: Length::mm(1000.0),
    height: Length::mm(60.0),
};

const LEVEL: Slant = Slant::of(0.0, 0.0);

/// The axis of a blade that cuts a right flank towards +y (`docs/process.md`, "One V-cut").
fn axis(swing: f64, rake: f64) -> Axis {
    let (sine, cosine) = libm::sincos(Angle::deg(swing).to_rad());
    let (rise, lean) = libm::sincos(Angle::deg(rake).to_rad());
    Axis([rise * sine, lean, rise * cosine])
}

fn cylinder(from: f64, radius: f64) -> Cylinder {
    let stages = [BodyStage {
        from: Length::mm(from),
        radius: Length::mm(radius),
    }];
    Cylinder::all(&stages)[0]
}

/// A cut whose tip has that x and z.
fn cut(x: f64, z: f64) -> Way {
    Way {
        from: Point3::new(x, -20.0, z),
        to: Point3::new(x, 1020.0, z),
    }
}

fn shadow(from: f64, radius: f64, swing: f64, rake: f64) -> Shadow {
    let held = axis(swing, rake);
    let stage = cylinder(from, radius).below(STOCK.height.to_mm(), 0.0, held.rise());
    stage.shadow(held, cut(0.0, 0.0), STOCK, LEVEL).unwrap()
}

#[test]
fn a_disc_hangs_as_low_as_computed_apart() {
    for (swing, rake, lowest) in [(40.0, 60.0, 11.5715), (60.0, 60.0, -0.7072), (50.0, 75.0, 9.1574)] {
        let found = shadow(40.0, 20.0, swing, rake).lowest().z;
        assert!((found - lowest).abs() < 5e-5, "{swing} {rake}: {found}");
    }
}

#[test]
fn a_disc_alone_reaches_as_far_aside_as_computed_apart() {
    for (swing, rake, aside) in [(40.0, 60.0, 38.88), (60.0, 60.0, 43.23), (50.0, 75.0, 43.05)] {
        let stages = [(40.0, 20.0), (40.000_001, 1.0)].map(|(from, radius)| BodyStage {
            from: Length::mm(from),
            radius: Length::mm(radius),
        });
        let disc = Cylinder::all(&stages)[0];
        let shadow = disc
            .shadow(axis(swing, rake), cut(0.0, 0.0), STOCK, LEVEL)
            .unwrap();
        assert!(
            (shadow.span().1 - aside).abs() < 5e-3,
            "{swing} {rake}: {:?}",
            shadow.span()
        );
    }
}

#[test]
fn a_stage_begins_where_the_planar_formula_says() {
    // t sin(theta) - r cos(theta) above the tip of an upright blade, and the wall of a slit beside it.
    assert!((shadow(40.0, 8.0, 0.0, 60.0).lowest().z - 30.641).abs() < 5e-4);
    let lowest = shadow(40.0, 8.0, 30.0, 60.0).lowest();
    assert!(
        (lowest.z - 24.708).abs() < 5e-4 && (lowest.x - 21.248).abs() < 5e-4,
        "{lowest:?}"
    );
    let stage = cylinder(40.0, 8.0).below(STOCK.height.to_mm(), 10.0, axis(0.0, 60.0).rise());
    let slit = stage
        .shadow(axis(0.0, 60.0), cut(50.0, 10.0), STOCK, LEVEL)
        .unwrap();
    let wall = [Point2::new(52.0, 50.0), Point2::new(60.0, 50.0)];
    let (at, gap) = slit.nearest_above(&wall).unwrap();
    assert!(
        (at.x - 52.0).abs() < 1e-9 && (gap + 9.232).abs() < 5e-4,
        "{at:?} {gap}"
    );
}

#[test]
fn what_passes_before_the_stock_or_behind_it_is_not_over_it() {
    let held = axis(0.0, 90.0);
    let stage = cylinder(20.0, 5.0).below(STOCK.height.to_mm(), 0.0, held.rise());
    let at = |y: f64| Way {
        from: Point3::new(50.0, y, 0.0),
        to: Point3::new(60.0, y, 0.0),
    };
    assert!(stage.shadow(held, at(-5.1), STOCK, LEVEL).is_none());
    assert!(stage.shadow(held, at(1005.1), STOCK, LEVEL).is_none());
    assert!(stage.shadow(held, at(-4.9), STOCK, LEVEL).is_some());
}

#[test]
fn a_leaning_stage_counts_as_far_as_it_is_over_the_stock() {
    // Leaning towards +y by 45 degrees from behind the stock: nothing of it is over the stock.
    let held = axis(0.0, 45.0);
    let stage = cylinder(20.0, 1.0).below(STOCK.height.to_mm(), 0.0, held.rise());
    let behind = Way {
        from: Point3::new(50.0, 990.0, 0.0),
        to: Point3::new(50.0, 990.0, 0.0),
    };
    assert!(stage.shadow(held, behind, STOCK, LEVEL).is_none());
    // From before the stock: from where it enters on.
    let before = Way {
        from: Point3::new(50.0, -40.0, 0.0),
        to: Point3::new(50.0, -40.0, 0.0),
    };
    let lowest = stage.shadow(held, before, STOCK, LEVEL).unwrap().lowest().z;
    let half = 0.5_f64.sqrt();
    assert!((lowest - (40.0 - half - half)).abs() < 1e-9, "{lowest}");
}

/// Points of the skin of a cylinder with its tip at a place, in space.
fn skin(from: f64, to: f64, radius: f64, Axis([x, y, z]): Axis) -> Vec<[f64; 3]> {
    // Two unit vectors square to the axis.
    let flat = libm::hypot(x, z);
    let one = [z / flat, 0.0, -x / flat];
    let other = [-x * y / flat, flat, -z * y / flat];
    let point = |height: f64, out: f64, turned: f64| {
        let (sine, cosine) = libm::sincos(turned);
        let aside = |i: usize| out * (cosine * one[i] + sine * other[i]);
        [
            height * x + aside(0),
            height * y + aside(1),
            height * z + aside(2),
        ]
    };
    let mut points = Vec::new();
    for turned in (0..360_u32).map(|degree| f64::from(degree).to_radians()) {
        points
            .extend((0..=100_u32).map(|i| point(from + (to - from) * f64::from(i) / 100.0, radius, turned)));
        for end in [from, to] {
            points.extend((0..10_u32).map(|i| point(end, radius * f64::from(i) / 10.0, turned)));
        }
    }
    points
}

proptest! {
    #[test]
    fn the_clearance_is_that_of_points_in_space(
        from in 15.0..40.0_f64,
        length in 1.0..40.0_f64,
        radius in 1.0..12.0_f64,
        swing in -65.0..65.0_f64,
        rake in 30.0..=90.0_f64,
        tip in (0.0..100.0_f64, 0.0..40.0_f64),
        heights in prop::collection::vec(0.0..60.0_f64, 11),
        slope in prop_oneof![Just(0.0), -1.0..1.0_f64],
    ) {
        let slant = Slant::of(slope, 0.0);
        let line: Vec<Point2> = (0_u32..).zip(&heights).map(|(i, &z)| Point2::new(10.0 * f64::from(i), z)).collect();
        let held = axis(swing, rake);
        let stages = [(from, radius), (from + length, 1.0)].map(|(from, radius)| BodyStage {
            from: Length::mm(from),
            radius: Length::mm(radius),
        });
        // A way along the slant, all along the stock.
        let mut way = cut(tip.0, tip.1);
        way.from.z += slope * way.from.y;
        way.to.z += slope * way.to.y;
        let shadow = Cylinder::all(&stages)[0].shadow(held, way, STOCK, slant).unwrap();
        let found = shadow.nearest_above(&line).map(|(_, gap)| gap);
        let over = skin(from, from + length, radius, held).into_iter().filter_map(|[x, y, z]| {
            Some(tip.1 + z - slope * y - height(&line, tip.0 + x)?)
        });
        let sampled = over.fold(f64::INFINITY, f64::min);
        match found {
            Some(gap) => {
                prop_assert!(sampled >= gap - 1e-9, "a point lies {} mm lower", gap - sampled);
                // Slopes of the section times the distance of neighbouring points; beside the stock there may be none.
                let is_at_side = shadow.span().1 < 1.0 || shadow.span().0 > 99.0;
                prop_assert!(is_at_side || sampled <= gap + 3.0, "all points lie {} mm higher", sampled - gap);
            }
            None => prop_assert!(sampled.is_infinite()),
        }
    }

    #[test]
    fn what_is_over_the_stock_is_in_the_shadow(
        from in 15.0..40.0_f64,
        length in 1.0..40.0_f64,
        radius in 1.0..25.0_f64,
        swing in -65.0..65.0_f64,
        rake in 30.0..=150.0_f64,
        y in -40.0..20.0_f64,
    ) {
        let held = axis(swing, rake);
        let stages = [(from, radius), (from + length, 1.0)].map(|(from, radius)| BodyStage {
            from: Length::mm(from),
            radius: Length::mm(radius),
        });
        let tip = Point3::new(0.0, y, 0.0);
        // Before the stock, and as far behind it.
        for (tip, Axis([x, along, z])) in [
            (tip, held),
            (Point3::new(0.0, STOCK.depth.to_mm() - y, 0.0), Axis([held.0[0], -held.0[1], held.0[2]])),
        ] {
            let held = Axis([x, along, z]);
            let shadow = Cylinder::all(&stages)[0].shadow(held, Way { from: tip, to: tip }, STOCK, LEVEL);
            for [x, y, z] in skin(from, from + length, radius, held) {
                if (0.0..=STOCK.depth.to_mm()).contains(&(tip.y + y)) {
                    let shadow = shadow.as_ref();
                    prop_assert!(shadow.is_some_and(|shadow| z >= shadow.lower(x) - 1e-9), "{x} {y} {z}");
                }
            }
        }
    }

    #[test]
    fn a_way_covers_what_the_places_on_it_cover(
        from in 15.0..40.0_f64,
        radius in 1.0..12.0_f64,
        swing in -65.0..65.0_f64,
        rake in 30.0..=90.0_f64,
        ends in ((0.0..100.0_f64, 0.0..40.0_f64), (0.0..100.0_f64, 0.0..40.0_f64)),
        x in 0.0..100.0_f64,
    ) {
        let held = axis(swing, rake);
        let at = |(x, z): (f64, f64)| Point3::new(x, 500.0, z);
        let way = Way { from: at(ends.0), to: at(ends.1) };
        let stage = cylinder(from, radius).below(STOCK.height.to_mm(), 0.0, held.rise());
        let whole = stage.shadow(held, way, STOCK, LEVEL).unwrap();
        let places = (0..=2000_u32).map(|i| {
            let share = f64::from(i) / 2000.0;
            stage.shadow(held, way.part(share, share), STOCK, LEVEL).unwrap()
        });
        let lowest = places
            .filter(|shadow| (shadow.span().0..=shadow.span().1).contains(&x))
            .map(|shadow| shadow.lower(x))
            .fold(f64::INFINITY, f64::min);
        let (left, right) = whole.span();
        if (left..=right).contains(&x) {
            let found = whole.lower(x);
            prop_assert!(found <= lowest + 1e-9, "{found} {lowest}");
            let is_inside = (left + 0.5..=right - 0.5).contains(&x);
            prop_assert!(!is_inside || found >= lowest - 1.5, "{found} {lowest}");
        } else {
            prop_assert!(lowest.is_infinite());
        }
    }
}

#[test]
fn the_axis_of_an_upright_blade_rises() {
    let upright = Orientation::from_quaternion(0.0, 1.0, 0.0, 0.0).unwrap();
    assert!((Axis::of(upright).rise() - 1.0).abs() < 1e-12);
}
