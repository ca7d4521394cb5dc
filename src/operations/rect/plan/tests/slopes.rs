//! What strategies leave on straight slopes: a lifted strip `s sin g`, a shifted one `h cos g`, none more than both together.

use super::judge::carried_out;
use super::*;
use proptest::prelude::*;

/// The largest distance of corners of the contour within a range from the straight line of the part, square to it.
fn left_between(plan: &PlannedRect, sample: &Sample, from: f64, to: f64) -> f64 {
    let [start, end] = [sample.part.points()[0], *sample.part.points().last().unwrap()];
    let slope = libm::atan((end.z - start.z) / (end.x - start.x));
    let corners = plan
        .contour
        .iter()
        .filter(|corner| (from - 1e-9..=to + 1e-9).contains(&corner.x));
    let gaps = corners.map(|corner| {
        let line = start.z + (end.z - start.z) / (end.x - start.x) * (corner.x - start.x);
        (corner.z - line) * libm::cos(slope)
    });
    gaps.fold(0.0, f64::max)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn residuals_of_straight_slopes(
        low in 0.0..20.0_f64, rise in 5.0..45.0_f64, mirrored: bool, layer in 2.0..10.0_f64, step in 3.0..15.0_f64,
    ) {
        let height = low + rise + 2.0 * layer;
        let (a, b) = if mirrored { (low + rise, low) } else { (low, low + rise) };
        let sample = Sample::through(&[(0.0, a), (100.0, b)], height);
        let slope = libm::atan(rise / 100.0);
        let (sine, cosine) = (libm::sin(slope), libm::cos(slope));
        let both = layer * cosine + step * sine;
        let sizes = |residual| Wish { layer: Auto::Given(Length::mm(layer)), step: Auto::Given(Length::mm(step)), ..wish(residual) };
        for residual in [Residual::Discard, Residual::Lift, Residual::Shift, Residual::Mixed] {
            let plan = sample.plan(&blades(), &sizes(residual)).unwrap();
            prop_assert!(plan.left.to_mm() <= both + 1e-6, "{:?}", residual);
            if residual == Residual::Discard {
                carried_out(&sample, &sample.part, &blades(), &[&plan]);
            }
        }
        // Every lifted strip leaves what its width asks for, its corner above the low end.
        let lifted = sample.plan(&blades(), &sizes(Residual::Lift)).unwrap();
        for strip in lifted.strips().filter(|strip| strip.origin == StripOrigin::Lifted) {
            let middle = (strip.left + strip.right) / 2.0;
            let over = lifted.contour.windows(2).find(|pair| pair[0].x < middle && middle < pair[1].x).unwrap();
            let lowest = sample.part.height(strip.left).min(sample.part.height(strip.right));
            let left = (over[0].z - lowest) * cosine;
            prop_assert!((left - (strip.right - strip.left) * sine).abs() < 1e-6, "{left}");
        }
        // Beyond the ends of the part its nearest point is its end: only within does the distance show the whole height.
        let (from, to) = (layer, 100.0 - layer);
        let left = left_between(&lifted, &sample, 0.0, 100.0);
        prop_assert!(left <= step * sine + 1e-6, "{left}");
        let shifted = sample.plan(&blades(), &sizes(Residual::Shift)).unwrap();
        let left = left_between(&shifted, &sample, from, to);
        prop_assert!(left <= layer * cosine + 1e-6, "{left}");
        if rise > 2.0 * layer + rise * 2.0 * layer / 100.0 {
            prop_assert!((left - layer * cosine).abs() < 1e-6, "{left} {}", layer * cosine);
        }
        // Mixed keeps the altitude of a strip's section, and needs no more strips than lifting where that keeps it too.
        let altitude = layer * step / libm::hypot(layer, step);
        let mixed = sample.plan(&blades(), &sizes(Residual::Mixed)).unwrap();
        prop_assert!(mixed.left.to_mm() <= altitude + 1e-6, "{:?} {}", mixed.left, altitude);
        if step * sine <= altitude {
            prop_assert!(mixed.counts().strips <= lifted.counts().strips);
        }
    }
}
