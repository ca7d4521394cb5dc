//! Pieces of chains against points of the blade sampled in space.

use super::Piece;
use crate::course::samples::{STOCK, Sample, courses, height};
use crate::surface::{Surface, Vee};
use proptest::prelude::*;
use vcutc_backend_api::ir::{Blade, Edges, Shape, Straight};
use vcutc_backend_api::units::{Angle, Length};
use vcutc_geometry::curve::Point2;

fn blade(cutting_length: f64, thickness: f64) -> Blade {
    Blade {
        name: "dagger".to_owned(),
        shape: Shape::Straight(Straight {
            cutting_length: Length::mm(cutting_length),
            half_apex: Angle::deg(7.0),
            thickness: Length::mm(thickness),
            edges: Edges::Double,
        }),
        body: None,
    }
}

/// Points of both faces of the blade at a share of a course, in space.
fn skin(sample: &Sample, blade: &Blade, share: f64) -> impl Iterator<Item = [f64; 3]> {
    let tip = sample.tip(share);
    let blade = blade.straight().unwrap();
    let (length, half) = (blade.cutting_length.to_mm(), blade.thickness.to_mm() / 2.0);
    let (sine, cosine) = libm::sincos(blade.half_apex.to_rad());
    let sample = *sample;
    (0..=12_u32).flat_map(move |up| {
        let up = length * f64::from(up) / 12.0;
        [-1.0, -0.5, 0.0, 0.5, 1.0].into_iter().flat_map(move |side| {
            [-half, half].map(|aside| {
                let off = sample.seen(share, [side * sine * up, aside, -cosine * up]);
                core::array::from_fn(|i| tip[i] + off[i])
            })
        })
    })
}

proptest! {
    #[test]
    fn the_deepest_entry_is_that_of_points_in_space(
        sample in courses(),
        (cutting_length, thickness) in (10.0..60.0_f64, 0.1..2.0_f64),
        heights in prop::collection::vec(0.0..60.0_f64, 6),
        blend in prop_oneof![Just(0.0), 0.01..1.0_f64],
    ) {
        let part: Vec<Point2> = (0_u32..).zip(&heights).map(|(i, &z)| Point2::new(20.0 * f64::from(i), z)).collect();
        let blade = blade(cutting_length, thickness);
        let piece = Piece::new(sample.course(Length::mm(blend)), &blade, STOCK);
        let found = piece.entry(&part).map_or(0.0, |entry| entry.depth);
        let (mut sampled, mut leaves) = (0.0_f64, false);
        for share in (0..=300_u32).map(|i| f64::from(i) / 300.0) {
            for [x, y, z] in skin(&sample, &blade, share) {
                let over = (0.0..=STOCK.depth.to_mm()).contains(&y);
                leaves |= !over;
                // Off by the blend, straight down.
                let depth = height(&part, x).map_or(0.0, |part| part - z + blend);
                sampled = sampled.max(if over { depth } else { 0.0 });
            }
        }
        prop_assert!(sampled <= found + super::RESOLUTION, "{sampled} deep, {found} found");
        // Distance of neighbouring samples, times slopes of the part; beside the stock nothing is sampled.
        prop_assert!(leaves || blend > 0.0 || found <= sampled + 6.0, "{sampled} deep, {found} found");
    }

    #[test]
    fn no_point_of_an_edge_beyond_what_is_used_is_in_the_work(
        sample in courses(),
        cutting_length in 10.0..60.0_f64,
        tips in prop::collection::vec((0.0..100.0_f64, 5.0..60.0_f64), 0..5),
    ) {
        let mut surface = Surface::untouched(STOCK);
        for (x, z) in tips {
            surface.release(Vee::even(Point2::new(x, z), 1.3));
        }
        let blade = blade(cutting_length, 1.0);
        let used = Piece::new(sample.course(Length::ZERO), &blade, STOCK).edge_used(&mut surface).unwrap();
        let corners: Vec<Point2> = surface.corners().collect();
        let (sine, cosine) = libm::sincos(blade.straight().unwrap().half_apex.to_rad());
        for share in (0..=300_u32).map(|i| f64::from(i) / 300.0) {
            let tip = sample.tip(share);
            for edge in [sine, -sine].map(|aside| sample.seen(share, [aside, 0.0, -cosine])) {
                for up in (0..=60_u32).map(|i| cutting_length * f64::from(i) / 60.0) {
                    let [x, y, z]: [f64; 3] = core::array::from_fn(|i| tip[i] + up * edge[i]);
                    let over = (0.0..=STOCK.depth.to_mm()).contains(&y);
                    let inside = height(&corners, x).is_some_and(|top| z < top - 1e-6);
                    prop_assert!(!(over && inside) || up <= used + super::RESOLUTION, "{up} in the work, {used} used");
                }
            }
        }
    }
}

/// The whole floor of a pocket, cut exactly down to a flat part: nothing is entered, however the upright blade turns.
#[test]
fn an_upright_blade_turns_on_a_flat_part() {
    let part = [Point2::new(0.0, 20.0), Point2::new(100.0, 20.0)];
    let sample = Sample::level_quarter(20.0);
    let piece = Piece::new(sample.course(Length::ZERO), &blade(50.0, 1.0), STOCK);
    assert_eq!(piece.entry(&part), None);
    let mut surface = Surface::untouched(STOCK);
    let used = piece.edge_used(&mut surface).unwrap();
    // 40 mm of height, along edges 7 deg off the upright.
    let expected = 40.0 / libm::cos(7.0_f64.to_radians());
    assert!((used - expected).abs() < 1e-9, "{used} {expected}");
    let lower = Sample::level_quarter(19.5);
    let entry = Piece::new(lower.course(Length::mm(0.25)), &blade(50.0, 1.0), STOCK).entry(&part);
    assert!(
        entry.is_some_and(|entry| (entry.depth - 0.75).abs() < 1e-9),
        "{entry:?}"
    );
}
