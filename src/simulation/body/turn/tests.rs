//! Bodies on turning and circular ways against points of their skin.

use super::entry;
use crate::body::backbone::Backbone;
use crate::body::section::{Ceiling, Section};
use crate::body::stage::Cylinder;
use crate::course::samples::{STOCK, courses, height};
use crate::surface::{Surface, Vee};
use proptest::prelude::*;
use vcutc_backend_api::ir::BodyStage;
use vcutc_backend_api::units::Length;
use vcutc_geometry::curve::Point2;
use vcutc_geometry::spine::{Knot, Spine};

/// A spine over the depth of the stock, whose pieces turn by shares of what they may.
fn bent(slope: f64, bends: &[f64]) -> Spine {
    let depth = STOCK.depth.to_mm();
    let apart = depth / (bends.len() + 1) as f64;
    let mut angle = libm::atan(slope);
    let mut rises = vec![0.0_f64];
    for bend in bends.iter().chain([&0.0]) {
        rises.push(rises[rises.len() - 1] + apart * libm::tan(angle));
        angle += 0.95 * bend * Spine::LARGEST_BEND;
    }
    let least = rises.iter().copied().fold(f64::INFINITY, f64::min);
    let last = rises.len() - 1;
    let knots = rises.iter().enumerate().map(|(number, rise)| Knot {
        y: if number == last {
            depth
        } else {
            apart * number as f64
        },
        rise: rise - least,
    });
    Spine::new(knots.collect()).unwrap()
}

proptest! {
    #[test]
    fn a_body_whose_skin_enters_the_work_is_found(
        sample in courses(),
        (from, radius) in (20.0..60.0_f64, 1.0..12.0_f64),
        tips in prop::collection::vec((0.0..100.0_f64, 5.0..60.0_f64), 0..6),
        blend in prop_oneof![Just(0.0), 0.01..1.0_f64],
        bends in prop::option::of((-0.3..0.3_f64, prop::collection::vec(-1.0..=1.0_f64, 9))),
    ) {
        let spine = bends.map(|(slope, bends)| bent(slope, &bends));
        let rise = |y: f64| spine.as_ref().map_or(0.0, |spine| spine.rise(y));
        let mut surface = Surface::untouched(STOCK);
        for (x, z) in tips {
            surface.release(Vee::even(Point2::new(x, z), 1.3));
        }
        let corners: Vec<Point2> = surface.corners().collect();
        let stages = Cylinder::all(&[BodyStage { from: Length::mm(from), radius: Length::mm(radius) }]);
        let ceiling = Ceiling::of(STOCK);
        let backbone = spine.as_ref().map(Backbone::exact);
        let mut section = Section { stock: STOCK, surface: &mut surface, ceiling: &ceiling, backbone };
        let found = entry(&sample.course(Length::mm(blend)), &stages, &mut section);
        let mut deepest = f64::NEG_INFINITY;
        for share in (0..=150_u32).map(|i| f64::from(i) / 150.0) {
            let tip = sample.tip(share);
            for turned in (0..24_u32).map(|i| f64::from(15 * i).to_radians()) {
                for up in [0.0, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0] {
                    let skin = [radius * libm::cos(turned), radius * libm::sin(turned), -(from + up)];
                    let off = sample.seen(share, skin);
                    let [x, y, z]: [f64; 3] = core::array::from_fn(|i| tip[i] + off[i]);
                    if (0.0..=100.0).contains(&y) {
                        let top = height(&corners, x).map_or(f64::NEG_INFINITY, |top| top + rise(y));
                        deepest = deepest.max(top - z + blend);
                    }
                }
            }
        }
        match found {
            None => prop_assert!(deepest <= super::RESOLUTION, "{deepest} in the work, not found"),
            // The whole of a disc counts where any of it is over the stock; samples are 2 mm apart and more.
            Some(near) => prop_assert!(near.gap < 0.0),
        }
    }
}
