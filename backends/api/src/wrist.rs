//! How far the last three axes of an arm turn in one move, and the points between which they do not turn too far.
//!
//! ABB's controllers choose how to stand at every programmed point, and stop where axis 4 or 6 would be 90 deg or more from
//! what the confdata of the point says (`ConfL\On`). Longer turns are taken apart: [`spaced`] chooses where.

use crate::ir::AxisValues;
use crate::units::Angle;

/// An axis must turn by less than this between two programmed points.
pub const TOO_FAR: Angle = Angle::deg(90.0);

/// By how much an axis turns at most between two points of [`spaced`]: some room below [`TOO_FAR`] for rounding and for arms
/// that are not quite what their model says.
pub const FAR: Angle = Angle::deg(80.0);

/// Room for the way between two samples when turns are taken apart evenly.
const UNEVEN: Angle = Angle::deg(5.0);

/// The largest angle by which one of the axes 4, 5 and 6 turns from one place to another.
#[must_use]
pub fn turn(from: &AxisValues, to: &AxisValues) -> Angle {
    let turns = from
        .0
        .iter()
        .zip(to.0)
        .skip(3)
        .map(|(from, to)| (to - from).abs());
    Angle::rad(turns.fold(0.0, f64::max))
}

/// Of samples on the way from the axes at its start to those at its end, in order and each with how much of the way is done,
/// so many that no axis of the wrist turns by more than [`FAR`] from one to the next: about evenly spaced, and none where the
/// way as a whole is no longer. Samples must lie closer together than that.
#[must_use]
pub fn spaced(start: AxisValues, samples: &[(f64, AxisValues)], end: AxisValues) -> Vec<(f64, AxisValues)> {
    let whole = turn(&start, &end);
    if whole <= FAR {
        return Vec::new();
    }
    let pieces = (whole / FAR).ceil();
    let most = (whole / pieces + UNEVEN).min(FAR);
    let mut chosen: Vec<(f64, AxisValues)> = Vec::new();
    let mut last = start;
    let mut before: Option<(f64, AxisValues)> = None;
    let ends = core::iter::once(end);
    for next in samples
        .iter()
        .map(|sample| sample.1)
        .chain(ends)
        .zip(samples.iter().copied().map(Some).chain([None]))
    {
        let (axes, sample) = next;
        if turn(&last, &axes) > most
            && let Some(point) = before.take()
        {
            chosen.push(point);
            last = point.1;
        }
        before = sample;
    }
    chosen
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn axes(degrees: [f64; 3]) -> AxisValues {
        let [four, five, six] = degrees.map(f64::to_radians);
        AxisValues([7.0, 8.0, 9.0, four, five, six])
    }

    /// A way on which every axis turns evenly.
    fn even(to: [f64; 3], samples: u32) -> Vec<(f64, AxisValues)> {
        (1..samples)
            .map(|sample| {
                let done = f64::from(sample) / f64::from(samples);
                (done, axes(to.map(|angle| angle * done)))
            })
            .collect()
    }

    fn places(to: [f64; 3]) -> Vec<i64> {
        let chosen = spaced(axes([0.0; 3]), &even(to, 360), axes(to));
        chosen
            .iter()
            .map(|(done, _)| (done * 100.0).round() as i64)
            .collect()
    }

    #[test]
    fn short_turns_are_left_whole_and_long_ones_taken_apart() {
        assert_eq!(places([80.0, 10.0, -80.0]), [0; 0]);
        assert_eq!(places([0.0, 0.0, 100.0]).len(), 1);
        assert_eq!(places([-180.0, 0.0, 100.0]).len(), 2);
        assert_eq!(places([0.0, 0.0, 350.0]).len(), 4);
        // Evenly, but for the room that samples need.
        assert_eq!(places([100.0, 0.0, 0.0]), [55]);
    }

    proptest! {
        #[test]
        fn no_piece_is_too_long(
            to in [-700.0..700.0_f64, -200.0..200.0, -700.0..700.0],
            bend in -0.9..0.9_f64,
        ) {
            // Not evenly: the way bends.
            let bent: Vec<_> = (1..2000)
                .map(|sample| {
                    let done = f64::from(sample) / 2000.0;
                    let gone = done + bend * done * (1.0 - done);
                    (done, axes(to.map(|angle| angle * gone)))
                })
                .collect();
            let (start, end) = (axes([0.0; 3]), axes(to));
            let chosen = spaced(start, &bent, end);
            let mut last = start;
            for axes in chosen.iter().map(|(_, axes)| *axes).chain([end]) {
                prop_assert!(turn(&last, &axes) <= FAR);
                last = axes;
            }
            prop_assert!(chosen.windows(2).all(|pair| pair[0].0 < pair[1].0));
        }
    }
}
