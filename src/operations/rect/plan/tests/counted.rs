//! Strips, slits, residuals and areas of the parts of the comparison, exactly.

use super::*;
use crate::plan::WORTH;
use crate::plan::blades::TOUCH;
use crate::plan::ground::{Ground, Sizes, Terms};
use crate::plan::layout::{Layout, Piece};
use crate::plan::model::Removal;
use crate::plan::slits::of_group;
use proptest::prelude::*;

/// Strips, slits and what stays, whether or not a disc gets at the strips.
pub(super) struct Laid {
    pub(super) strips: usize,
    pub(super) slits: usize,
    pub(super) left: f64,
    pub(super) removed: f64,
}

pub(super) fn laid(sample: &Sample, residual: Residual, layer: f64, step: f64) -> Laid {
    let blades = blades();
    let terms = Terms {
        work: sample.work(),
        knife: &blades.knife,
        wheel: &blades.wheel,
        down_to: Length::ZERO,
        rounding: Rounding::Exact,
        worth: WORTH,
    };
    let ground = Ground::new(terms, Sizes { layer, step });
    let layout = match residual {
        Residual::Discard => Layout::discard(&ground),
        Residual::Lift => Layout::lift(&ground),
        Residual::Shift | Residual::Mixed => Layout::shift(&ground),
    };
    let mut terrain = ground.before();
    let layers = layout.pieces.chunk_by(|one, next| one.layer == next.layer);
    let slits = layers
        .map(|layer| of_group(&ground, layer, &mut terrain).len())
        .sum();
    let area = |piece: &Piece| (piece.extent.right - piece.extent.left) * (piece.top - piece.extent.floor);
    Laid {
        strips: layout.pieces.len(),
        slits,
        left: ground.left_by(&terrain.corners(0.0, ground.width)),
        removed: layout.pieces.iter().map(area).sum(),
    }
}

#[test]
fn strips_and_slits_of_five_parts() {
    let flat = Sample::flat(85.0, 50.0);
    let table = [
        ("bez", Sample::language(), [(19, 17), (28, 25), (20, 18)]),
        ("lin", Sample::straight(), [(19, 18), (28, 27), (21, 20)]),
        ("hill", Sample::hill(), [(14, 13), (22, 21), (18, 17)]),
        ("valley", Sample::valley(), [(22, 23), (30, 32), (25, 26)]),
        ("flat", flat, [(36, 32), (36, 32), (36, 32)]),
    ];
    for (name, sample, expected) in table {
        let counted = [Residual::Discard, Residual::Lift, Residual::Shift].map(|residual| {
            let laid = laid(&sample, residual, 10.0, 10.0);
            (laid.strips, laid.slits)
        });
        assert_eq!(counted, expected, "{name}");
    }
}

#[test]
fn residuals_and_areas() {
    let close = |value: f64, expected: f64, tolerance: f64| {
        assert!(
            (value - expected).abs() <= tolerance,
            "{value}, expected {expected}"
        );
    };
    let slope = libm::atan(0.3);
    let straight = |residual| laid(&Sample::straight(), residual, 10.0, 10.0);
    let lifted = straight(Residual::Lift);
    close(lifted.left, 10.0 * libm::sin(slope), 1e-9);
    close(lifted.left, 2.8735, 5e-5);
    close(lifted.removed, 2350.0, 1e-9);
    let shifted = straight(Residual::Shift);
    close(shifted.left, 10.0 * libm::cos(slope), 1e-9);
    close(shifted.left, 9.5783, 5e-5);
    close(shifted.removed, 2000.0, 1e-9);
    let discarded = straight(Residual::Discard);
    close(discarded.left, 11.494, 5e-4);
    let bound = 10.0 * libm::cos(slope) + 10.0 * libm::sin(slope);
    close(bound, 12.452, 5e-4);
    assert!(discarded.left < bound);
    let language = |residual| laid(&Sample::language(), residual, 10.0, 10.0);
    close(language(Residual::Lift).left, 4.363, 1e-3);
    close(language(Residual::Shift).left, 9.099, 1e-3);
    close(language(Residual::Lift).removed, 2084.48, 0.01);
}

/// `N = a / (h s) + b`, the simplified form of [Yu 2019], over layers and steps of 4, 6, 8 and 10 mm: `a`, `b` and R^2.
fn fitted(residual: Residual) -> [f64; 3] {
    const SIZES: [f64; 4] = [4.0, 6.0, 8.0, 10.0];
    let sample = Sample::language();
    let sizes = SIZES
        .into_iter()
        .flat_map(|layer| SIZES.map(|step| (layer, step)));
    let counted: Vec<(f64, f64)> = sizes
        .map(|(layer, step)| {
            let strips = laid(&sample, residual, layer, step).strips;
            (1.0 / (layer * step), strips as f64)
        })
        .collect();
    let mean = |of: &dyn Fn(&(f64, f64)) -> f64| counted.iter().map(of).sum::<f64>() / counted.len() as f64;
    let (x, y) = (mean(&|point| point.0), mean(&|point| point.1));
    let a = mean(&|point| (point.0 - x) * (point.1 - y)) / mean(&|point| (point.0 - x) * (point.0 - x));
    let b = y - a * x;
    let rest = mean(&|point| (point.1 - a * point.0 - b) * (point.1 - a * point.0 - b));
    let all = mean(&|point| (point.1 - y) * (point.1 - y));
    [a, b, 1.0 - rest / all]
}

#[test]
fn counts_follow_the_simplified_form() {
    for (residual, expected) in [
        (Residual::Discard, [2117.5, -3.7, 0.994]),
        (Residual::Lift, [2318.3, 4.2, 0.994]),
    ] {
        let found = fitted(residual);
        for ((found, expected), within) in found.into_iter().zip(expected).zip([0.05, 0.05, 5e-4]) {
            assert!((found - expected).abs() <= within, "{found}, expected {expected}");
        }
    }
}

/// Slits through two layers of the sample's lifted columns: 16 instead of 25, and 3 changes instead of 7.
#[test]
fn slits_through_two_layers() {
    let mut blades = blades();
    blades.knife.edge = Length::mm(2.0 * 12.543);
    let mut wish = wish(Residual::Lift);
    let one = Sample::language().plan(&blades, &wish).unwrap().counts();
    assert_eq!((one.strips, one.slits, one.changes), (28, 25, 7));
    wish.through = Auto::Given(2);
    let two = Sample::language().plan(&blades, &wish).unwrap();
    let counts = two.counts();
    assert_eq!((counts.strips, counts.slits, counts.changes), (28, 16, 3));
    let deepest = two.slits().map(|slit| slit.top - slit.bottom).fold(0.0, f64::max);
    assert!(deepest <= 20.0 + TOUCH && deepest > 10.0, "{deepest}");
    wish.through = Auto::Auto;
    assert_eq!(Sample::language().plan(&blades, &wish).unwrap().through, 2);
}

fn curve() -> impl Strategy<Value = Sample> {
    let end = 5.0..45.0_f64;
    (
        end.clone(),
        end.clone(),
        end.clone(),
        end,
        20.0..40.0_f64,
        60.0..80.0_f64,
    )
        .prop_map(|(a, b, c, d, x, y)| Sample::bezier([(0.0, a), (x, b), (y, c), (100.0, d)], 50.0))
}

/// The counting formulas, over random curves: a mean error of a few percent.
#[test]
fn counts_without_planning() {
    use proptest::strategy::ValueTree;
    use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};
    let rng = TestRng::from_seed(RngAlgorithm::ChaCha, &[7; 32]);
    let mut runner = TestRunner::new_with_rng(Config::default(), rng);
    let (layer, step) = (5.0, 5.0);
    let mut errors = Vec::new();
    for _ in 0..50 {
        let sample = curve().new_tree(&mut runner).unwrap().current();
        let points = sample.part.points();
        let variation: f64 = points.windows(2).map(|pair| (pair[1].z - pair[0].z).abs()).sum();
        let area = sample.width * sample.height - sample.part.area_below(0.0, sample.width).to_mm2();
        let removal = Removal {
            area: vcutc_backend_api::units::Area::mm2(area),
            variation: Length::mm(variation),
            width: Length::mm(sample.width),
            layers: ((sample.height - sample.part.lowest().z) / layer).floor(),
        };
        for residual in [Residual::Discard, Residual::Lift, Residual::Shift] {
            let counted = laid(&sample, residual, layer, step).strips as f64;
            let formula = removal
                .strips(Length::mm(layer), Length::mm(step), residual)
                .unwrap();
            errors.push((formula / counted - 1.0).abs());
        }
    }
    let mean = errors.iter().sum::<f64>() / errors.len() as f64;
    let largest = errors.iter().copied().fold(0.0, f64::max);
    assert!(mean < 0.02, "{mean}");
    assert!(largest < 0.135, "{largest}");
}
