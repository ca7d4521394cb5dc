//! Fans against closed forms, and Vs over them against what they cover.

use super::*;
use proptest::prelude::*;

fn profile(points: &[(f64, f64)]) -> Profile {
    Profile::new(points.iter().map(|&(x, z)| Point2::new(x, z)).collect()).unwrap()
}

/// The hyperbolic paraboloid `60 + (x - 300) (y - 500) / 3000` over 600 x 1000 mm.
fn hypar() -> Fan {
    let slopes = [(0.0, -0.1), (600.0, 0.1)].map(|(x, slope)| Point2::new(x, slope));
    let front = profile(&[(0.0, 110.0), (600.0, 10.0)]);
    let back = profile(&[(0.0, 10.0), (600.0, 110.0)]);
    Fan::new([front, back], slopes.to_vec(), Length::mm(1000.0)).unwrap()
}

#[test]
fn a_hypar_is_a_roof_over_its_lower_ends() {
    let fan = hypar();
    let shadow = fan.shadow();
    for (x, z) in [
        (0.0, 10.0),
        (150.0, 35.0),
        (300.0, 60.0),
        (450.0, 35.0),
        (600.0, 10.0),
    ] {
        assert!((shadow.height(x) - z).abs() < 1e-9, "{x}");
        for y in [0.0, 250.0, 1000.0] {
            let part = 60.0 + (x - 300.0) * (y - 500.0) / 3000.0;
            assert!((shadow.height(x) + fan.rise(x, y) - part).abs() < 1e-9, "{x} {y}");
        }
    }
    assert!((fan.shear() - 1.0 / 3.0).abs() < 1e-12);
    // From x = 450 the lines get steeper to the right, and turn the other way beyond 300.
    let [left, right] = fan.opening(450.0);
    assert!(
        (left - 1.0 / 3.0).abs() < 1e-9 && right.abs() < 1e-9,
        "{left} {right}"
    );
}

proptest! {
    /// A V whose lower end lies above the section is clear of the part everywhere.
    #[test]
    fn what_is_above_the_section_is_clear(
        heights in prop::collection::vec((10.0..60.0_f64, 10.0..60.0_f64, -0.3..0.3_f64), 2..12),
        flank in 0.5..3.0_f64, share in 0.0..1.0_f64, looks in prop::collection::vec((0.0..1.0_f64, 0.0..1.0_f64), 40),
    ) {
        let x = |number: usize| 20.0 * number as f64;
        let end = |of: fn(&(f64, f64, f64)) -> f64| {
            let points = heights.iter().enumerate().map(|(number, height)| Point2::new(x(number), of(height)));
            points.collect::<Vec<_>>()
        };
        let ends = [end(|height| height.0), end(|height| height.1)].map(|points| Profile::new(points).unwrap());
        let fan = Fan::new(ends, end(|height| height.2), Length::mm(80.0)).unwrap();
        let tip = x(heights.len() - 1) * share;
        let low = fan.section(flank, Length::ZERO).height(tip);
        for (across, along) in looks {
            let (px, y) = (x(heights.len() - 1) * across, 80.0 * along);
            let [front, back] = fan.ends();
            let part = front.height(px) * (1.0 - along) + back.height(px) * along;
            prop_assert!(low + fan.rise(tip, y) + flank * (px - tip).abs() >= part - 1e-6);
        }
    }

    /// Seen from their lower ends, Vs lie below ones that open by as much less as is said.
    #[test]
    fn sections_of_a_v_lie_below_its_opening(
        slopes in prop::collection::vec(-0.3..0.3_f64, 2..8), share in 0.0..1.0_f64, looks in prop::collection::vec(0.0..1.0_f64, 30),
    ) {
        let width = 20.0 * (slopes.len() - 1) as f64;
        let level = || profile(&[(0.0, 5.0), (width, 5.0)]);
        let corners = slopes.iter().enumerate().map(|(number, &slope)| Point2::new(20.0 * number as f64, slope));
        let fan = Fan::new([level(), level()], corners.collect(), Length::mm(80.0)).unwrap();
        let tip = width * share;
        let opening = fan.opening(tip);
        for look in looks {
            let x = width * look;
            for y in [0.0, 30.0, 80.0] {
                let seen = fan.rise(tip, y) - fan.rise(x, y);
                prop_assert!(seen <= opening[usize::from(x > tip)] * (x - tip).abs() + 1e-9);
            }
        }
    }
}
