//! The proof against dense sampling, on random moves of several arms.

use super::*;

/// By how much the axes keep within all bounds, in parts of the margin below which the proof may refuse: 1 deg of angle,
/// 5 mm, 5 percent of the rate. Negative where a bound is broken.
fn margin(rig: &Rig<'_>, found: &Sampled) -> f64 {
    let degree = 1.0_f64.to_radians();
    let mut margin = f64::INFINITY;
    for (i, axis) in rig.axes.iter().enumerate() {
        margin = margin.min((axis.max - found.high[i]) / degree);
        margin = margin.min((found.low[i] - axis.min) / degree);
        if let Some(most) = axis.rate {
            margin = margin.min((most - found.rate[i]) / (0.05 * most));
        }
    }
    let clearance = &found.clearance;
    margin
        .min((clearance.wrist - LEAST.wrist) / degree)
        .min((clearance.elbow - LEAST.elbow) / degree)
        .min((clearance.shoulder - LEAST.shoulder) / 5.0)
}

fn agrees_with_sampling(model: &Model, moves: u32, longest: f64, most_turn: f64) {
    agree_with_sampling(random_move, model, moves, longest, most_turn);
}

fn agree_with_sampling(draw: Draw, model: &Model, moves: u32, longest: f64, most_turn: f64) {
    let rig = rig(model);
    let arm = arm_of(model);
    let mut dice = Dice(u64::from(moves));
    let (mut proven, mut refused, mut seen_sooner) = (0, 0, 0);
    for number in 0..moves {
        let (course, branch, start) = draw(&mut dice, &rig, rig.axes, longest, most_turn);
        let proof = prove(&rig, &course, branch, &start, &LEAST);
        let sampled = sample(&rig, &arm, &course, branch, &start);
        if let Some(seen) = refuted(&rig, &course, branch, &start) {
            assert!(proof.is_err(), "{}, move {number}: {seen:?}", model.name);
            seen_sooner += 1;
        }
        let margin = sampled.as_ref().map_or(-1.0, |found| margin(&rig, found));
        match proof {
            Ok(proof) => {
                let found = sampled.unwrap();
                assert!(
                    margin > -1e-6,
                    "{}, move {number}: a violation was missed",
                    model.name
                );
                holds(
                    &model.axes,
                    &proof,
                    &found,
                    &format!("{}, move {number}", model.name),
                );
                proven += 1;
            }
            Err(breach) => {
                assert!(
                    margin < 1.0,
                    "{}, move {number}: {breach:?} with a margin of {margin}",
                    model.name
                );
                refused += 1;
            }
        }
    }
    assert!(
        proven > moves / 10 && refused > moves / 10,
        "{proven} and {refused}: the moves are one-sided"
    );
    assert!(
        2 * seen_sooner > refused,
        "{}: samples show only {seen_sooner} of {refused}",
        model.name
    );
}

/// All samples lie within what was proven, and what was proven is not much more than the samples: it may be more by a part of
/// the room to the limits.
fn holds(axes: &[Axis], proof: &Proof, found: &Sampled, name: &str) {
    const ROUNDING: f64 = 1e-9;
    for (i, axis) in axes.iter().enumerate() {
        assert!(proof.low[i] <= found.low[i] + ROUNDING, "{name}, axis {i}");
        assert!(proof.high[i] >= found.high[i] - ROUNDING, "{name}, axis {i}");
        assert!(
            proof.rate[i] >= found.rate[i] * (1.0 - 1e-6) - 1e-6,
            "{name}, axis {i}: {} {}",
            proof.rate[i],
            found.rate[i]
        );
        assert!(
            (proof.end[i] - found.end[i]).abs() <= ROUNDING,
            "{name}, axis {i}"
        );
        let wide = (proof.high[i] - proof.low[i]) - (found.high[i] - found.low[i]);
        let room = [proof.low[i] - axis.min, axis.max - proof.high[i]];
        let may_be = room.map(|room| 2.0 * (0.02 * room).max(0.1_f64.to_radians()));
        assert!(wide <= may_be[0] + may_be[1], "{name}, axis {i}: {wide}");
    }
    let (proven, seen) = (&proof.clearance, &found.clearance);
    assert!(proven.wrist <= seen.wrist + ROUNDING, "{name}");
    assert!(proven.elbow <= seen.elbow + ROUNDING, "{name}");
    assert!(proven.shoulder <= seen.shoulder + 1e-6, "{name}");
}

#[test]
fn agrees_with_dense_sampling_on_short_moves() {
    for model in [kuka(), beside(), rods()] {
        agrees_with_sampling(&model, 1000, 60.0, 0.6);
    }
}

#[test]
fn agrees_with_dense_sampling_on_long_moves() {
    for model in [kuka(), beside(), rods()] {
        agrees_with_sampling(&model, 100, 1000.0, PI * 0.9);
    }
}

#[test]
fn arcs() {
    for model in [kuka(), beside(), rods()] {
        agree_with_sampling(random_arc, &model, 300, 60.0, 0.6);
    }
}
