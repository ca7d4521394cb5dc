//! Teeth that mill: against the case of [Ha 2019], against equation 38 as Budak 2006 has it, and against hand calculations.

mod case;

use super::*;
use core::f64::consts::FRAC_PI_2;
use proptest::prelude::*;

/// The cutter of the paper, with the coefficients of its first or second case.
fn of_the_paper(cutting: [f64; 3], edge: [f64; 3]) -> Teeth {
    Teeth {
        count: 2,
        lag: libm::tan(30.0_f64.to_radians()) / 6.35,
        cutting,
        edge,
    }
}

fn cases() -> [Teeth; 2] {
    [
        of_the_paper([1825.0, 770.0, 735.0], [29.7, 55.7, 1.8]),
        of_the_paper([1698.0, 438.0, 591.0], [24.7, 42.9, 5.5]),
    ]
}

/// A cut: how thick its chips are and how deep it is, in mm, and between which angles teeth are in the material, in rad.
#[derive(Clone, Copy, Debug)]
struct Milling {
    chip: f64,
    depth: f64,
    engaged: [f64; 2],
}

/// That of the paper: down milling, half of the tool in the material.
const PAPER: Milling = Milling {
    chip: 0.1,
    depth: 0.5,
    engaged: [FRAC_PI_2, PI],
};

/// The stretches of the depth on which a tooth is in the material, by its angle at the tip, as the angles of their ends. The tooth
/// comes in again after each turn.
fn stretches(teeth: &Teeth, cut: Milling, at_tip: f64) -> Vec<[f64; 2]> {
    let [from, to] = cut.engaged;
    let highest = at_tip - teeth.lag * cut.depth;
    (-60..=2)
        .map(|turn| {
            let turned = f64::from(turn) * TAU;
            [
                (from + turned).max(highest) - turned,
                (to + turned).min(at_tip) - turned,
            ]
        })
        .filter(|[begin, end]| begin < end)
        .collect()
}

/// The force of all teeth at an angle, with equation 38 for each: from the larger angle at the lower end of a stretch to the smaller one
/// at its upper end.
fn by_equation_38(teeth: &Teeth, cut: Milling, angle: f64) -> [f64; 3] {
    let ([ktc, krc, kac], [kte, kre, kae]) = (teeth.cutting, teeth.edge);
    let (s, k) = (cut.chip, teeth.lag);
    let integral = |t: f64| {
        let (double_sine, double_cosine) = libm::sincos(2.0 * t);
        let (sine, cosine) = libm::sincos(t);
        [
            s / (4.0 * k) * (-ktc * double_cosine + krc * (2.0 * t - double_sine))
                + (kte * sine - kre * cosine) / k,
            -s / (4.0 * k) * (ktc * (2.0 * t - double_sine) + krc * double_cosine)
                + (kte * cosine + kre * sine) / k,
            (kac * s * cosine - kae * t) / k,
        ]
    };
    let mut force = [0.0; 3];
    for tooth in 0..teeth.count {
        let at_tip = angle + f64::from(tooth) * TAU / f64::from(teeth.count);
        for [begin, end] in stretches(teeth, cut, at_tip) {
            let [upper, lower] = [integral(begin), integral(end)];
            for part in 0..3 {
                force[part] += upper[part] - lower[part];
            }
        }
    }
    force
}

/// The same by adding up the force on each length, at many heights.
fn by_lengths(teeth: &Teeth, cut: Milling, angle: f64) -> [f64; 3] {
    let mut force = [0.0; 3];
    for tooth in 0..teeth.count {
        let at_tip = angle + f64::from(tooth) * TAU / f64::from(teeth.count);
        for [begin, end] in stretches(teeth, cut, at_tip) {
            let count = 2000;
            let each = (end - begin) / f64::from(count);
            for number in 0..count {
                let here = teeth.on_length(begin + (f64::from(number) + 0.5) * each, cut.chip);
                for part in 0..3 {
                    force[part] += here[part] * each / teeth.lag;
                }
            }
        }
    }
    force
}

#[track_caller]
fn assert_near(found: [f64; 3], wanted: [f64; 3], within: f64) {
    for (found, wanted) in found.iter().zip(wanted) {
        assert!((found - wanted).abs() <= within, "{found} {wanted}");
    }
}

#[test]
fn the_forces_of_the_paper_are_met() {
    let [first, second] = cases();
    let wanted = [
        (first, 100.0, [-49.259738, 113.790469, 37.224250]),
        (first, 120.0, [-8.494257, 112.808739, 33.133070]),
        (first, 150.0, [28.317708, 73.232978, 19.991972]),
        (second, 120.0, [6.015862, 95.668271, 28.668020]),
    ];
    for (teeth, angle, wanted) in wanted {
        let angle = f64::to_radians(angle);
        assert_near(by_lengths(&teeth, PAPER, angle), wanted, 1e-5);
        assert_near(by_equation_38(&teeth, PAPER, angle), wanted, 1e-6);
    }
}

#[test]
fn the_means_and_the_largest_forces_of_the_paper_are_met() {
    let wanted = [
        ([0.7599, 42.5318, 12.1479], 130.63),
        ([5.1406, 35.4694, 10.7811], 111.23),
    ];
    for (teeth, (mean, largest)) in cases().into_iter().zip(wanted) {
        let count = 3600;
        let forces: Vec<[f64; 3]> = (0..count)
            .map(|place| by_equation_38(&teeth, PAPER, f64::from(place) * TAU / f64::from(count)))
            .collect();
        let found =
            array::from_fn(|part| forces.iter().map(|force| force[part]).sum::<f64>() / f64::from(count));
        assert_near(found, mean, 1e-4);
        let sizes = forces.iter().map(|[x, y, z]| libm::sqrt(x * x + y * y + z * z));
        assert!((sizes.fold(0.0, f64::max) - largest).abs() < 0.01);
    }
}

/// One tooth without a helix that is only pushed against its motion: `K s sin t` a mm, of which `-sin t cos t` is along the feed.
#[test]
fn one_tooth_pushes_as_computed_by_hand() {
    let teeth = Teeth {
        count: 1,
        lag: 0.0,
        cutting: [100.0, 0.0, 0.0],
        edge: [0.0; 3],
    };
    let milled = teeth.milled(Length::mm(0.2), Length::mm(3.0));
    let near = |found: f64, wanted: f64| assert!((found - wanted).abs() < 0.02, "{found} {wanted}");
    let [along, across, axial] = milled.any;
    near(along.high, 30.0);
    near(along.low, -30.0);
    near(across.high, 60.0);
    near(across.low, 0.0);
    near(axial.high, 0.0);
    near(milled.turning, 60.0);
    near(milled.mean[1], 15.0);
}

#[test]
fn a_chip_is_the_feed_for_each_tooth() {
    let [teeth, _] = cases();
    let spin = AngularSpeed::rad_per_s(TAU * 1000.0 / 60.0);
    let chip = teeth.chip(Speed::mm_per_s(200.0 / 60.0), spin);
    assert!((chip.to_mm() - 0.1).abs() < 1e-12);
}

fn any_teeth() -> impl Strategy<Value = Teeth> {
    (
        1_u32..9,
        1e-3..0.6_f64,
        prop::array::uniform3(0.0..40.0_f64),
        prop::array::uniform3(0.0..2.0_f64),
    )
        .prop_map(|(count, lag, cutting, edge)| Teeth {
            count,
            lag,
            cutting,
            edge,
        })
}

proptest! {
    /// Equation 38 against the force on each length.
    #[test]
    fn both_ways_of_integrating_agree(
        teeth in any_teeth(),
        chip in 0.0..0.5_f64,
        depth in 0.1..30.0_f64,
        engaged in prop::array::uniform2(0.0..PI),
        angle in 0.0..TAU,
    ) {
        let [from, to] = engaged;
        let cut = Milling { chip, depth, engaged: [from.min(to), from.max(to)] };
        let (closed, summed) = (by_equation_38(&teeth, cut, angle), by_lengths(&teeth, cut, angle));
        for (closed, summed) in closed.iter().zip(summed) {
            prop_assert!((closed - summed).abs() < 1e-4 * (1.0 + summed.abs()), "{closed} {summed}");
        }
    }

    #[test]
    fn no_force_is_beyond_its_bounds(
        teeth in any_teeth(),
        chip in 0.0..0.5_f64,
        thinner in 0.0..=1.0_f64,
        depth in 0.1..30.0_f64,
        shallower in 0.0..=1.0_f64,
        engaged in prop::array::uniform2(0.0..PI),
        angle in 0.0..TAU,
    ) {
        let milled = teeth.milled(Length::mm(chip), Length::mm(depth));
        let [from, to] = engaged;
        let engaged = [from.min(to), from.max(to)];
        let cut = Milling { chip: chip * thinner, depth: depth * shallower, engaged };
        let force = by_equation_38(&teeth, cut, angle);
        for (force, any) in force.iter().zip(milled.any) {
            prop_assert!(any.low - 1e-9 <= *force && *force <= any.high + 1e-9, "{force} {any:?}");
        }
    }

    /// Each bound is nearly met where just that part of the front is in the material that pushes so.
    #[test]
    fn bounds_are_nearly_met(teeth in any_teeth(), chip in 0.01..0.5_f64, depth in 0.1..30.0_f64) {
        let milled = teeth.milled(Length::mm(chip), Length::mm(depth));
        let ends: Vec<(usize, f64, f64)> = (0..3)
            .flat_map(|part| [(part, 1.0, milled.any[part].high), (part, -1.0, -milled.any[part].low)])
            .collect();
        for (part, sign, bound) in ends {
            let mut most = 0.0_f64;
            for chip in [0.0, chip] {
                // What of the front pushes so is one stretch of it, or two at its ends.
                let pushes = |angle: f64| sign * teeth.on_length(angle, chip)[part] > 0.0;
                let angles: Vec<f64> = (0..=2000).map(|k| f64::from(k) * PI / 2000.0).filter(|&angle| pushes(angle)).collect();
                let stretches: Vec<[f64; 2]> = angles.chunk_by(|one, next| next - one < 0.002).map(|run| [run[0], run[run.len() - 1]]).collect();
                let met = (0..2000).map(|k| {
                    let angle = f64::from(k) * TAU / 2000.0;
                    let each = stretches.iter().map(|&engaged| by_equation_38(&teeth, Milling { chip, depth, engaged }, angle)[part]);
                    sign * each.sum::<f64>()
                });
                most = met.fold(most, f64::max);
            }
            prop_assert!(most > 0.85 * bound - 0.02, "{part} {sign}: {most} of {bound}");
        }
    }

    /// The mean by the formula against that over many places.
    #[test]
    fn means_are_those_over_a_turn(teeth in any_teeth(), chip in 0.0..0.5_f64, depth in 0.1..5.0_f64) {
        let cut = Milling { chip, depth, engaged: [0.0, PI] };
        let count = 720;
        let each = (0..count).map(|k| by_equation_38(&teeth, cut, (f64::from(k) + 0.5) * TAU / f64::from(count)));
        let sums = each.fold([0.0; 3], |sum, force| array::from_fn(|part| sum[part] + force[part]));
        let milled = teeth.milled(Length::mm(chip), Length::mm(depth));
        for (sum, mean) in sums.iter().zip(milled.mean) {
            let found = sum / f64::from(count);
            prop_assert!((found - mean).abs() < 2e-2 * (1.0 + mean.abs()), "{found} {mean}");
        }
    }
}
